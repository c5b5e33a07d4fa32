// The chain on a plain 2-D canvas, for browsers without WebGL: the same pictures from one fixed side, without turning.

class FlatScene {
  constructor(stage, onDraw) {
    this.stage = stage;
    this.onDraw = onDraw;
    this.canvas = document.createElement('canvas');
    this.context = this.canvas.getContext('2d');
    stage.prepend(this.canvas);
    this.renders = 0;
  }

  get name() { return '2-D canvas'; }

  setPlacement(placement) {
    this.placement = placement;
    this.half = null;
    this.spheres = this.boundRows = this.selected = null;
    this.contacts = [];
    this.lookAtAll();
  }

  setSpheres({spheres, corners}, colours) {
    this.spheres = spheres;
    this.corners = corners;
    this.rows = this.placement.place(spheres, this.placement.centre, 1 / this.placement.reach,
                                     new Float32Array(spheres.length));
    this.depthOrder = Uint32Array.from({length: spheres.length / 4}, (_, i) => i)
        .sort((i, j) => this.rows[4 * i + 2] - this.rows[4 * j + 2]);
    this.setColours(colours);
  }

  setColours(colours) { this.colours = colours; this.request(); }
  setBounds(rows, palette) { this.boundRows = rows; this.palette = palette; this.request(); }
  setContacts(contacts) { this.contacts = contacts; this.request(); }
  select(pair, palette) { this.selected = pair; this.palette = palette; this.request(); }
  setPalette(palette) { this.palette = palette; this.request(); }
  setWheelZoom() {}
  stopFlight() {}
  axes() {
    return [0, 1, 2].map((axis) => {
      const [x, y, z] = this.placement.turned([0, 1, 2].map((k) => k === axis ? 1 : 0));
      return {name: 'xyz'[axis], x, y, z};
    });
  }

  lookAtAll() {
    this.middle = [0, 0];
    this.zoomed = 1;
    this.request();
  }

  flyTo(point, reach) {
    const [x, y] = this.placement.placePoint(point, this.placement.centre, 1 / this.placement.reach);
    this.middle = [x, y];
    this.zoomed = Math.max(1, this.placement.reach / (3.2 * reach));
    this.request();
  }

  flyToContact({point, reach}) { this.flyTo(point, reach); }

  zoom(factor) {
    this.zoomed = Math.max(0.2, this.zoomed / factor);
    this.request();
  }

  resize() {
    const ratio = Math.min(devicePixelRatio || 1, 2);
    this.canvas.width = this.stage.clientWidth * ratio;
    this.canvas.height = this.stage.clientHeight * ratio;
    this.request();
  }

  request() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.draw();
    });
  }

  // Pixels of a drawn unit, so that all is seen.
  perUnit() {
    const {sample, corners, centre, reach} = this.placement;
    if (!this.half) {
      const seen = [...sample, ...corners].map(
          (sphere) => [this.placement.placePoint(sphere, centre, 1 / reach), sphere[3] / reach]);
      this.half = [0, 1].map((k) => seen.reduce((most, [p, radius]) => Math.max(most, Math.abs(p[k]) + radius), 1e-300));
    }
    return this.zoomed * 0.46 * Math.min(this.stage.clientWidth / this.half[0], this.stage.clientHeight / this.half[1]);
  }

  project(point) {
    const local = this.placement.placePoint(point, this.placement.centre, 1 / this.placement.reach);
    const unit = this.perUnit();
    return {x: this.stage.clientWidth / 2 + (local[0] - this.middle[0]) * unit,
            y: this.stage.clientHeight / 2 - (local[1] - this.middle[1]) * unit, distance: 1, before: true};
  }

  draw() {
    if (!this.placement || !this.spheres || !this.palette) return;
    const {context, rows, colours, palette} = this;
    const ratio = this.canvas.width / this.stage.clientWidth, unit = this.perUnit();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = cssColour(palette.ground);
    context.fillRect(0, 0, this.stage.clientWidth, this.stage.clientHeight);
    const disc = (row, k, least) => {
      context.beginPath();
      context.arc(this.stage.clientWidth / 2 + (row[k] - this.middle[0]) * unit,
                  this.stage.clientHeight / 2 - (row[k + 1] - this.middle[1]) * unit,
                  Math.max(row[k + 3] * unit, least), 0, 2 * Math.PI);
    };
    context.strokeStyle = cssColour(palette.bound);
    context.lineWidth = 1;
    for (const ends of boxLines(this.corners)) {
      const [from, to] = ends.map((corner) => this.project(this.corners[corner]));
      context.beginPath();
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.stroke();
    }
    for (const i of this.depthOrder) {
      const colour = [colours[4 * i], colours[4 * i + 1], colours[4 * i + 2]];
      disc(rows, 4 * i, colours[4 * i + 3] ? 2 : 0.8);
      context.fillStyle = cssColour(colour);
      context.fill();
      if (rows[4 * i + 3] * unit > 2.5) {
        context.strokeStyle = cssColour(palette.ground, 0.5);
        context.stroke();
      }
    }
    if (this.boundRows) {
      const bounds = this.placement.place(this.boundRows, this.placement.centre, 1 / this.placement.reach,
                                          new Float32Array(this.boundRows.length));
      context.strokeStyle = cssColour(palette.bound, 0.6);
      for (let k = 0; k < bounds.length; k += 4) disc(bounds, k, 0.5), context.stroke();
    }
    context.lineWidth = 2;
    for (const {point, colour, kind} of this.contacts) {
      const {x, y} = this.project(point);
      context.strokeStyle = cssColour(colour);
      context.beginPath();
      if (kind === 0) context.arc(x, y, 6, 0, 2 * Math.PI);
      else if (kind === 1) context.moveTo(x, y - 9), context.lineTo(x + 9, y), context.lineTo(x, y + 9),
                           context.lineTo(x - 9, y), context.closePath();
      else context.moveTo(x - 7, y - 7), context.lineTo(x + 7, y + 7), context.moveTo(x - 7, y + 7),
           context.lineTo(x + 7, y - 7);
      context.stroke();
    }
    context.lineWidth = 2.5;
    context.strokeStyle = cssColour(palette.ink);
    if (this.selected)
      for (const row of this.selected.rows) {
        disc(this.placement.place(row, this.placement.centre, 1 / this.placement.reach, []), 0, 4);
        context.stroke();
      }
    context.lineWidth = 1;
    ++this.renders;
    this.onDraw();
  }

  pick(x, y) {
    const unit = this.perUnit();
    for (let k = this.depthOrder.length - 1; k >= 0; --k) {
      const i = this.depthOrder[k];
      const dx = this.stage.clientWidth / 2 + (this.rows[4 * i] - this.middle[0]) * unit - x;
      const dy = this.stage.clientHeight / 2 - (this.rows[4 * i + 1] - this.middle[1]) * unit - y;
      if (Math.hypot(dx, dy) <= Math.max(this.rows[4 * i + 3] * unit, 2)) return i;
    }
    return -1;
  }

  image() {
    this.draw();
    return this.canvas.toDataURL('image/png');
  }
}
