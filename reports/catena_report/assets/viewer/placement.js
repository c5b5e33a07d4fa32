// Where a chain lies: its middle, its extent, and the turn that lays its longest direction to the right and its
// shortest towards the reader.

const framesMeasured = 12;
const spheresSampled = 4000;

// Evenly along the chain, at most so many.
function sampled(spheres) {
  const rows = [], stride = 4 * Math.max(1, Math.ceil(spheres.length / 4 / spheresSampled));
  for (let k = 0; k < spheres.length; k += stride) rows.push(spheres.subarray(k, k + 4));
  return rows;
}

class Placement {
  constructor(view) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const step = Math.max(1, Math.ceil(view.frames.length / framesMeasured));
    this.sample = [];     // spheres of the chain in those frames
    this.corners = [];    // of the box that repeats, in those frames
    for (let f = 0; f < view.frames.length; f += step) {
      const {spheres, corners} = view.frame(f);
      this.sample.push(...sampled(spheres));
      for (let k = 0; k < spheres.length; k += 4)
        for (let axis = 0; axis < 3; ++axis) {
          low[axis] = Math.min(low[axis], spheres[k + axis] - spheres[k + 3]);
          high[axis] = Math.max(high[axis], spheres[k + axis] + spheres[k + 3]);
        }
      for (const corner of corners)
        for (let axis = 0; axis < 3; ++axis) {
          low[axis] = Math.min(low[axis], corner[axis]);
          high[axis] = Math.max(high[axis], corner[axis]);
        }
      this.corners.push(...corners);
    }
    this.centre = low.map((value, axis) => (high[axis] + value) / 2);
    this.reach = Math.max(...low.map((value, axis) => (high[axis] - value) / 2)) || 1;
    this.radius = Math.hypot(...low.map((value, axis) => (high[axis] - value) / 2)) || 1;
    this.axes = principalAxes(this.sample, this.centre, this.reach);
  }

  // Rows of spheres relative to an origin, scaled and turned to right, up, reader. In binary64 until the last, so that
  // a chain far from the origin does not tremble.
  place(spheres, origin, scale, out) {
    const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = this.axes;
    for (let k = 0; k < spheres.length; k += 4) {
      const x = spheres[k] - origin[0], y = spheres[k + 1] - origin[1], z = spheres[k + 2] - origin[2];
      out[k] = (ax * x + ay * y + az * z) * scale;
      out[k + 1] = (bx * x + by * y + bz * z) * scale;
      out[k + 2] = (cx * x + cy * y + cz * z) * scale;
      out[k + 3] = spheres[k + 3] * scale;
    }
    return out;
  }

  placePoint(point, origin, scale) {
    return this.axes.map((axis) => axis.reduce((sum, value, k) => sum + value * (point[k] - origin[k]), 0) * scale);
  }

  // The inverse of placePoint.
  original(local, origin, scale) {
    return origin.map((value, k) => value + this.axes.reduce((sum, axis, row) => sum + axis[k] * local[row], 0) / scale);
  }

  // A direction of the input's space as drawn, and back.
  turned(direction) { return this.placePoint(direction, [0, 0, 0], 1); }
  turnedBack(direction) { return this.original(direction, [0, 0, 0], 1); }
}

// Right-handed unit axes, the one of greatest variance first, by Jacobi's rotations of the covariance.
function principalAxes(sample, centre, reach) {
  const points = sample.map((sphere) => centre.map((value, axis) => (sphere[axis] - value) / reach));
  const mean = [0, 1, 2].map((axis) => points.reduce((sum, p) => sum + p[axis], 0) / points.length);
  const m = [0, 1, 2].map((a) => [0, 1, 2].map(
      (b) => points.reduce((sum, p) => sum + (p[a] - mean[a]) * (p[b] - mean[b]), 0)));
  const vectors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];     // rows
  for (let sweep = 0; sweep < 16; ++sweep)
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(m[p][q]) <= 1e-15 * Math.abs(m[0][0] + m[1][1] + m[2][2])) continue;
      const angle = Math.atan2(2 * m[p][q], m[p][p] - m[q][q]) / 2, c = Math.cos(angle), s = Math.sin(angle);
      const turn = (rows) => {
        for (let k = 0; k < 3; ++k) {
          const [u, v] = [rows[p][k], rows[q][k]];
          rows[p][k] = c * u + s * v;
          rows[q][k] = c * v - s * u;
        }
      };
      const transpose = () => {
        for (const [a, b] of [[0, 1], [0, 2], [1, 2]]) [m[a][b], m[b][a]] = [m[b][a], m[a][b]];
      };
      turn(m), transpose(), turn(m), transpose(), turn(vectors);
    }
  const [first, second] = [0, 1, 2].sort((a, b) => m[b][b] - m[a][a] || a - b).map((k) => vectors[k]);
  // Of the two senses of an axis, the one along the input's own.
  const along = (axis) => axis.reduce((sum, value) => sum + value, 0) < 0 ? axis.map((value) => -value) : axis;
  const [a, b] = [along(first), along(second)];
  return [a, b, [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]];
}

// The contact of two spheres, or of one and the nearest image of the other: the point between their surfaces, and a
// reach around it that holds what there is to see.
function contactOf(spheres, i, j, box) {
  const {rows, across} = rowsOfPair(spheres, i, j, box), [a, b] = rows, distance = distanceOf(rows);
  const small = Math.min(a[3], b[3]);
  // Along the line of centres, halfway between where each surface meets it; of one centre in the other's: that centre.
  const along = distance > 0 ? Math.min(Math.max((distance + a[3] - b[3]) / (2 * distance), 0), 1) : 0;
  const axis = [0, 1, 2].map((k) => b[k] - a[k]);
  const point = axis.map((value, k) => a[k] + value * along);
  // A giant's far side need not be seen.
  const half = (distance + Math.min(a[3], 6 * small) + Math.min(b[3], 6 * small)) / 2;
  return {point, small, rows, across, axis: axis.map((value) => value / (distance || 1)), reach: half || 1e-30};
}
