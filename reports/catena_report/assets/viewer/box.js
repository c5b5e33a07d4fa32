// Space that a box repeats: which image of a sphere is meant, and where the box is drawn.
// box: [length x, y, z, tilt xy, xz, yz] as in run_file.md, or null in open space.

const edgesOf = ([lx, ly, lz, xy, xz, yz]) => [[lx, 0, 0], [xy, ly, 0], [xz, yz, lz]];

// A way in edges of the box; 0 along one that does not repeat.
function inEdges([x, y, z], [lx, ly, lz, xy, xz, yz]) {
  const share = (value, edge) => edge > 0 ? value / edge : 0;
  const c = share(z, lz), b = share(y - c * yz, ly);
  return [share(x - b * xy - c * xz, lx), b, c];
}

// Of the images of a point the one nearest to another, and whether it is another than the stored one. Of two spheres
// that collide rounding finds it or one beside it.
function nearestImage(from, to, box) {
  if (!box) return {point: to, across: false};
  const edges = edgesOf(box), whole = inEdges(to.map((value, k) => value - from[k]), box).map((share) => -Math.round(share));
  const steps = (k) => box[k] > 0 ? [0, -1, 1] : [0];
  let best = null, least = Infinity;
  for (const a of steps(0)) for (const b of steps(1)) for (const c of steps(2)) {
    const shift = [whole[0] + a, whole[1] + b, whole[2] + c];
    const point = to.map((value, k) => value + shift.reduce((sum, times, edge) => sum + times * edges[edge][k], 0));
    const away = Math.hypot(...point.map((value, k) => value - from[k]));
    if (away < least) least = away, best = {point, across: shift.some((times) => times !== 0)};
  }
  return best;
}

// The corners of the box around the middle of these spheres, as rows without radius: where it begins does not matter.
// Bit k of a corner's number: it lies at the far end of the k-th edge that repeats.
function cornersOf(spheres, box) {
  if (!box) return [];
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < spheres.length; k += 4)
    for (let axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis], spheres[k + axis]);
      high[axis] = Math.max(high[axis], spheres[k + axis]);
    }
  const edges = edgesOf(box).filter((_, k) => box[k] > 0);
  return Array.from({length: 1 << edges.length}, (_, corner) => [0, 1, 2].map(
      (axis) => edges.reduce((sum, edge, k) => sum + edge[axis] * ((corner >> k & 1) - 0.5), (low[axis] + high[axis]) / 2))
      .concat(0));
}

// [from, to] of each edge, by the numbers of corners.
function boxLines(corners) {
  const lines = [];
  for (let from = 0; from < corners.length; ++from)
    for (let bit = 1; bit < corners.length; bit *= 2) if (!(from & bit)) lines.push([from, from | bit]);
  return lines;
}
