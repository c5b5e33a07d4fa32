// The camera, and the units in which the chain is drawn: an origin and a scale that follow the camera, so that binary32
// on the device has digits to spare wherever it flies.

const fieldOfView = 32;
const tangent = Math.tan(fieldOfView * Math.PI / 360);
const comfortable = [3, 60];     // distances of the camera, in drawn units; outside, the units are chosen anew
const flightMilliseconds = 900;
const firstYaws = [-0.5, -0.25, 0.25, 0.5], firstPitches = [-0.7, -0.42, -0.2];     // sides of the first view, radians

// Where between the two edges of the view, along one of its directions, the eye sees all spheres from the least
// distance: the planes through the eye along both edges touch them.
function fitted(points, direction, backward, slope) {
  const edge = Math.hypot(1, slope) / slope;
  let more = -Infinity, less = -Infinity;
  for (const [p, radius] of points) {
    const near = p.dot(backward) + radius * edge, at = p.dot(direction) / slope;
    more = Math.max(more, near + at);
    less = Math.max(less, near - at);
  }
  return {distance: (more + less) / 2, middle: slope * (more - less) / 2};
}

class CameraRig {
  // onMove: the camera moved; onUnits: so did origin and scale, and everything drawn with them.
  constructor(stage, canvas, onMove, onUnits) {
    Object.assign(this, {stage, onMove, onUnits});
    this.camera = new THREE.PerspectiveCamera(fieldOfView, 1, 1e-3, 1e6);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    Object.assign(this.controls, {enableKeys: false, enableZoom: false, screenSpacePanning: true, zoomSpeed: 1.4});
    this.controls.addEventListener('change', () => this.moved());
  }

  get distance() { return this.camera.position.distanceTo(this.controls.target); }

  setPlacement(placement) {
    this.placement = placement;
    this.lookAtAll();
  }

  setAspect(aspect) {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  moved() {
    const {distance} = this, away = this.controls.target.length();
    if (distance > 0 && (distance < comfortable[0] || distance > comfortable[1] || away > 30 * distance))
      this.recentre(distance);
    this.onMove();
  }

  recentre(distance) {
    const target = this.controls.target;
    const scale = this.scale * 10 / distance;
    if (!(scale > 1e-300 && scale < 1e300)) return;
    this.origin = this.placement.original(target.toArray(), this.origin, this.scale);
    this.scale = scale;
    this.camera.position.sub(target).multiplyScalar(10 / distance);
    target.set(0, 0, 0);
    this.camera.updateMatrixWorld();
    this.onUnits();
  }

  // Of a few sides the one from which the chain fills most of the stage: how far away, looking at what, from where.
  bestView(sample) {
    const {placement} = this, wide = tangent * this.camera.aspect;
    const points = sample.map(
        (sphere) => [new THREE.Vector3(...placement.placePoint(sphere, placement.centre, 1)), sphere[3]]);
    let best = null;
    for (const yaw of firstYaws)
      for (const pitch of firstPitches) {
        const turn = new THREE.Euler(pitch, yaw, 0, 'YXZ');
        const [right, up, backward] =
            [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((a) => new THREE.Vector3(...a).applyEuler(turn));
        const across = fitted(points, right, backward, wide), along = fitted(points, up, backward, tangent);
        const distance = Math.max(across.distance, along.distance);
        if (best && distance >= best.distance) continue;
        const target = right.multiplyScalar(across.middle).add(up.multiplyScalar(along.middle)).toArray();
        best = {distance, target, backward};
      }
    return best;
  }

  // At these spheres and corners of the box; without any, at all that the chain reaches in any frame.
  lookAtAll(frame) {
    this.stopFlight();
    const {sample, corners} = frame ? {sample: sampled(frame.spheres), corners: frame.corners} : this.placement;
    const {distance, target, backward} = this.bestView([...sample, ...corners]);
    this.origin = this.placement.original(target, this.placement.centre, 1);
    this.scale = 10 / (distance * 1.06 || 1);
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(backward).multiplyScalar(10);
    this.controls.update();
    this.onUnits();
  }

  // How far from a contact of that reach it fills a good part of the view.
  viewing(reach) { return reach * 3.2 / (tangent * Math.min(1, this.camera.aspect)); }

  get direction() { return this.camera.position.clone().sub(this.controls.target).normalize().toArray(); }

  // Flies to a point of the input's space, to look at it from a direction of the drawn one.
  flyTo(point, reach, from = this.direction) {
    this.stopFlight();
    const start = this.placement.original(this.controls.target.toArray(), this.origin, this.scale);
    const startDistance = this.distance / this.scale, endDistance = this.viewing(reach);
    const direction = new THREE.Vector3(...this.direction);
    const turn = new THREE.Quaternion().setFromUnitVectors(direction, new THREE.Vector3(...from));
    const begun = performance.now();
    const duration = matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : flightMilliseconds;
    const step = (now) => {
      const t = duration ? Math.min(1, Math.max(0, (now - begun) / duration)) : 1;
      const ease = t * t * (3 - 2 * t);
      // The distance shrinks by a constant factor a moment; coming nearer, the point chosen stays in sight.
      const distance = startDistance * (endDistance / startDistance) ** ease;
      const left = t === 1 ? 0 : startDistance > endDistance
          ? (distance - endDistance) / (startDistance - endDistance) : 1 - ease;
      const where = point.map((value, axis) => value + (start[axis] - value) * left);
      this.controls.target.fromArray(this.placement.placePoint(where, this.origin, this.scale));
      this.camera.position.copy(direction).applyQuaternion(new THREE.Quaternion().slerp(turn, ease))
          .multiplyScalar(distance * this.scale).add(this.controls.target);
      this.controls.update();
      this.moved();
      this.flight = t < 1 ? requestAnimationFrame(step) : 0;
    };
    this.flight = requestAnimationFrame(step);
  }

  stopFlight() {
    if (this.flight) cancelAnimationFrame(this.flight);
    this.flight = 0;
  }

  zoom(factor) {
    this.stopFlight();
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.moved();
  }

  // A point of the input's space as the camera has it: right, up, and backwards from the eye, in drawn units.
  inCamera(point) {
    this.camera.updateMatrixWorld();
    return new THREE.Vector3(...this.placement.placePoint(point, this.origin, this.scale))
        .applyMatrix4(this.camera.matrixWorldInverse);
  }

  // Where a point is seen: pixels from the left and top of the stage, and whether it lies before the eye.
  project(point) {
    const seen = this.inCamera(point);
    const height = this.stage.clientHeight, perUnit = height / 2 / tangent / -seen.z;
    return {x: this.stage.clientWidth / 2 + seen.x * perUnit, y: height / 2 - seen.y * perUnit, before: seen.z < 0};
  }

  // Eye and direction of the ray through a point of the stage.
  ray(x, y) {
    const across = (2 * x / this.stage.clientWidth - 1) * tangent * this.camera.aspect;
    const direction = new THREE.Vector3(across, (1 - 2 * y / this.stage.clientHeight) * tangent, -1);
    return {eye: this.camera.position, direction: direction.normalize().transformDirection(this.camera.matrixWorld)};
  }

  // The axes of the input's space as seen on the screen, right, up and to the reader.
  axes() {
    return [0, 1, 2].map((axis) => {
      const unit = this.placement.turned([0, 1, 2].map((k) => k === axis ? 1 : 0));
      const {x, y, z} = new THREE.Vector3(...unit).transformDirection(this.camera.matrixWorldInverse);
      return {name: 'xyz'[axis], x, y, z};
    });
  }
}
