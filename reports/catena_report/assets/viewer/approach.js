// From where a contact is seen best: past as few spheres as can be, its two spheres side by side, and not far from where
// the reader looks from now.

const directionsTried = 60;

// Directions all round, evenly, by the golden angle; none so steep that the camera would roll.
function directionsAround() {
  const found = [];
  for (let k = 0; k < directionsTried; ++k) {
    const y = 0.9 * (1 - (2 * k + 1) / directionsTried), angle = k * Math.PI * (3 - Math.sqrt(5));
    const ring = Math.sqrt(1 - y * y);
    found.push([ring * Math.cos(angle), y, ring * Math.sin(angle)]);
  }
  return found;
}

// now: direction from the contact to the reader, as drawn; far: the camera's distance from the contact.
function clearestDirection(spheres, placement, {i, j, point, reach, axis}, now, far) {
  const near = [];     // offsets of the spheres that could stand in the way, and how wide each is
  for (let s = 0; s < spheres.length / 4; ++s) {
    if (s === i || s === j) continue;
    const offset = [0, 1, 2].map((k) => spheres[4 * s + k] - point[k]), radius = spheres[4 * s + 3];
    if (Math.abs(offset[0]) < far + radius && Math.hypot(...offset) < far + radius) near.push([offset, radius + 0.5 * reach]);
  }
  let best = now, least = Infinity;
  for (const drawn of [now, ...directionsAround()]) {
    const towards = placement.turnedBack(drawn);
    const dot = (a) => a[0] * towards[0] + a[1] * towards[1] + a[2] * towards[2];
    let inTheWay = 0;
    for (const [offset, width] of near) {
      const along = dot(offset);
      if (along <= 0.3 * reach || along > far) continue;
      const off = offset[0] ** 2 + offset[1] ** 2 + offset[2] ** 2 - along * along;
      if (off < width * width) ++inTheWay;
    }
    const turning = 1 - (drawn[0] * now[0] + drawn[1] * now[1] + drawn[2] * now[2]);
    const cost = inTheWay + 2 * Math.abs(dot(axis)) + turning;
    if (cost < least) least = cost, best = drawn;
  }
  return best;
}
