// The chain in three dimensions by WebGL. Draws when asked, never by itself.

const giantShare = 0.2;          // a sphere this wide, against the whole, would hide the chain: it is drawn as a shell
const outOfSight = 1e18;         // the shader leaves out what is that far
const slowMilliseconds = 40;     // a picture that takes longer is drawn coarsely while the camera moves

const isSoftware = (gl) => {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  return /swiftshader|llvmpipe|software/i.test(info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '');
};

class GlScene {
  // null where the browser has no WebGL 2.
  static create(stage, onDraw) {
    const probe = document.createElement('canvas').getContext('webgl2');
    if (!probe) return null;
    const software = isSoftware(probe);
    const lose = probe.getExtension('WEBGL_lose_context');
    if (lose) lose.loseContext();
    const canvas = document.createElement('canvas');
    const gl = canvas.getContext('webgl2', {antialias: !software, alpha: false, powerPreference: 'high-performance'});
    return gl ? new GlScene(stage, canvas, gl, software, onDraw) : null;
  }

  constructor(stage, canvas, gl, software, onDraw) {
    this.stage = stage;
    this.canvas = canvas;
    this.software = software;
    this.onDraw = onDraw;
    stage.prepend(canvas);
    this.renderer = new THREE.WebGLRenderer({canvas, context: gl});
    const smooth = gl.getContextAttributes().antialias;
    if (smooth) gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    this.rig = new CameraRig(stage, canvas, () => this.request(true), () => this.changed());
    this.shared = sharedUniforms();
    this.scene = new THREE.Scene();
    this.chain = new DrawnTriangles(sphereMaterial(this.shared, {smooth, least: [1.2, 2]}));
    this.giants = new DrawnTriangles(sphereMaterial(this.shared, {translucent: 0.55}));
    this.outlines = new DrawnTriangles(sphereMaterial(this.shared, {outline: 2.5, least: [4, 4], inTheWay: false}));
    this.bounds = new DrawnTriangles(sphereMaterial(this.shared, {translucent: 0.8, least: [0, 0]}));
    this.marks = new DrawnTriangles(markMaterial(this.shared));
    [this.chain, this.outlines, this.giants, this.bounds, this.marks].forEach((triangles, k) => {
      triangles.mesh.renderOrder = k;
      this.scene.add(triangles.mesh);
    });
    // Behind everything, as lines have not the spheres' depth.
    const line = new THREE.LineBasicMaterial({depthTest: false, depthWrite: false});
    this.box = new THREE.LineSegments(new THREE.BufferGeometry(), line);
    Object.assign(this.box, {frustumCulled: false, renderOrder: -1, visible: false});
    this.scene.add(this.box);
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => this.request());
    this.renders = 0;
    this.milliseconds = 0;
  }

  get name() { return this.software ? 'WebGL in software' : 'WebGL'; }

  setPlacement(placement) {
    this.placement = placement;
    this.spheres = this.boundRows = null;
    this.contacts = [];
    this.selected = null;
    this.rig.setPlacement(placement);
  }

  setSpheres({spheres, corners}, colours) {
    this.spheres = spheres;
    this.corners = corners;
    this.setColours(colours);
  }

  setColours(colours) {
    this.colours = colours;
    this.changed();
  }

  setBounds(rows, palette) {
    this.boundRows = rows;
    this.boundColour = palette.bound;
    this.changed();
  }

  // contacts: {point, small, colour, kind}, kind 0 ring, 1 diamond, 2 cross.
  setContacts(contacts) {
    this.contacts = contacts;
    this.changed();
  }

  // The two spheres of a pair are outlined, and what stands before their contact is cut away; null: none.
  select(pair, palette) {
    this.selected = pair;
    this.inkColour = palette.ink;
    this.changed();
  }

  setPalette(palette) {
    this.shared.ground.value.fromArray(palette.ground).divideScalar(255);
    this.box.material.color = new THREE.Color(...palette.bound.map((value) => value / 255));
    this.renderer.setClearColor(new THREE.Color(...palette.ground.map((value) => value / 255)), 1);
    this.request();
  }

  // What lies on the device is old; it is renewed once, with the next picture.
  changed() {
    this.stale = true;
    this.request();
  }

  // Everything that lies on the device, relative to the present origin.
  upload() {
    this.stale = false;
    if (!this.spheres) return;
    const {placement, spheres, colours, chain, giants, outlines, bounds, marks} = this;
    const {origin, scale} = this.rig;
    const giant = this.giantSpheres();
    this.shells = giant.length;
    const picked = this.selected ? [this.selected.i, this.selected.j] : [];
    const some = (triangles, indices) => {
      triangles.resize(indices.length);
      indices.forEach((i, k) => {
        placement.place(spheres.subarray(4 * i, 4 * i + 4), origin, scale, triangles.rows.subarray(4 * k, 4 * k + 4));
        triangles.tints.set(colours.subarray(4 * i, 4 * i + 4), 4 * k);
      });
    };

    chain.resize(spheres.length / 4);
    placement.place(spheres, origin, scale, chain.rows);
    chain.tints.set(colours);
    chain.chosen(picked);
    const image = this.selected?.across ? [this.selected.j] : [];     // not where the sphere is stored
    some(giants, [...giant, ...image]);
    image.forEach(() => giants.rows.set(placement.place(this.selected.rows[1], origin, scale, []), 4 * giant.length));
    giants.chosen(picked.map((i) => giant.indexOf(i)));
    giant.forEach((i) => chain.rows.fill(outOfSight, 4 * i, 4 * i + 4));
    outlines.resize(picked.length);
    picked.forEach((_, k) => {
      outlines.rows.set(placement.place(this.selected.rows[k], origin, scale, []), 4 * k);
      outlines.tints.set([...this.inkColour, 255], 4 * k);
    });
    this.uploadBox(origin, scale);

    const boundRows = this.boundRows || [];
    bounds.resize(boundRows.length / 4);
    placement.place(boundRows, origin, scale, bounds.rows);
    for (let k = 0; k < boundRows.length; k += 4) bounds.tints.set([...this.boundColour, 255], k);

    marks.resize(this.contacts.length);
    // Many marks of wrong pairs would cover the chain.
    const wrong = this.contacts.filter(({kind}) => kind).length;
    this.shared.markSize.value = Math.max(5, Math.min(12, 12 * Math.sqrt(40 / wrong)));
    this.contacts.forEach(({point, small, colour, kind}, k) => {
      marks.rows.set([...placement.placePoint(point, origin, scale), small * scale], 4 * k);
      marks.tints.set([...colour, [0, 128, 255][kind]], 4 * k);
    });
    for (const triangles of [chain, giants, outlines, bounds, marks]) triangles.changed();
  }

  uploadBox(origin, scale) {
    const {corners, placement, box} = this;
    box.visible = corners.length > 0;
    if (!box.visible) return;
    const ends = boxLines(corners).flat().flatMap((corner) => placement.placePoint(corners[corner], origin, scale));
    box.geometry.dispose();
    box.geometry = new THREE.BufferGeometry();
    box.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(ends), 3));
  }

  // Few and wide among many: drawn as shells, because they would hide the chain.
  giantSpheres() {
    const {spheres} = this, limit = giantShare * this.placement.reach, giant = [];
    if (spheres.length > 4 * 8)
      for (let k = 3; k < spheres.length; k += 4) if (spheres[k] > limit) giant.push((k - 3) / 4);
    return giant.length > 8 ? [] : giant;     // a short, thick chain is no crowd of specks
  }

  lookAtAll(frame) { this.rig.lookAtAll(frame); }
  flyTo(point, reach) { this.rig.flyTo(point, reach); }
  flyToContact(contact) {
    const far = this.rig.viewing(contact.reach);
    const from = clearestDirection(this.spheres, this.placement, contact, this.rig.direction, far);
    this.rig.flyTo(contact.point, contact.reach, from);
  }
  stopFlight() { this.rig.stopFlight(); }
  zoom(factor) { this.rig.zoom(factor); }
  project(point) { return this.rig.project(point); }
  axes() { return this.rig.axes(); }
  setWheelZoom(on) { this.rig.controls.enableZoom = on; }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.stage;
    if (!width || !height) return;
    this.size = [width, height];
    this.rig.setAspect(width / height);
    this.request();
  }

  // moving: more pictures will follow at once.
  request(moving = false) {
    clearTimeout(this.rest);
    this.coarse = moving && this.milliseconds > slowMilliseconds;
    if (this.coarse) this.rest = setTimeout(() => this.request(), 250);
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.draw();
    });
  }

  draw() {
    const {rig, shared, renderer, placement} = this;
    if (!placement || !this.size) return;
    if (this.stale) this.upload();
    const sharp = this.software ? 1 : Math.min(devicePixelRatio || 1, 2), ratio = this.coarse ? 0.5 * sharp : sharp;
    const size = renderer.getSize(new THREE.Vector2());
    if (renderer.getPixelRatio() !== ratio) renderer.setPixelRatio(ratio);
    if (size.x !== this.size[0] || size.y !== this.size[1]) renderer.setSize(...this.size, false);
    shared.pixel.value = 2 * tangent / this.size[1] / Math.min(1, ratio);
    shared.viewport.value.set(...this.size);
    shared.depthRange.value.set(Math.log2(rig.distance) - 14, 1 / 28);
    const centre = rig.inCamera(placement.centre).length(), radius = placement.radius * rig.scale;
    const near = Math.max(centre - radius, rig.distance);
    shared.haze.value.set(near, 0.4 / Math.max(centre + radius - near, 1e-30));
    shared.contactFront.value = 0;
    if (this.selected) {
      const {point, small, reach, rows} = this.selected;
      const nearest = Math.min(...rows.map((row) => rig.inCamera(row).length()));
      shared.contact.value.set(...rig.inCamera(point).toArray(), reach * rig.scale);
      shared.contactFront.value = nearest - 0.4 * small * rig.scale;
    }
    const begun = performance.now();
    renderer.render(this.scene, rig.camera);
    if (this.software && !this.coarse) this.milliseconds = this.wait() - begun;
    ++this.renders;
    this.onDraw();
  }

  // When the picture is finished. Only a software renderer is waited for.
  wait() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now();
  }

  // The sphere under a point of the stage; -1: none.
  pick(x, y) {
    if (!this.spheres) return -1;
    const {eye, direction} = this.rig.ray(x, y), {rows} = this.chain, pixel = 2 * tangent / this.stage.clientHeight;
    let best = -1, nearest = Infinity;
    for (let k = 0; k < this.spheres.length; k += 4) {
      const dx = rows[k] - eye.x, dy = rows[k + 1] - eye.y, dz = rows[k + 2] - eye.z;
      const along = dx * direction.x + dy * direction.y + dz * direction.z;
      if (!(along > 0)) continue;
      const off = (dx - along * direction.x) ** 2 + (dy - along * direction.y) ** 2 + (dz - along * direction.z) ** 2;
      const radius = Math.max(rows[k + 3], 2 * pixel * along);
      if (off > radius * radius) continue;
      const hit = along - Math.sqrt(radius * radius - off);
      if (hit > 0 && hit < nearest) nearest = hit, best = k / 4;
    }
    return best;
  }

  image() {
    this.coarse = false;
    this.draw();
    return this.canvas.toDataURL('image/png');
  }
}
