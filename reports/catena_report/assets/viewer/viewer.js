// The viewer: what is chosen, and what follows from it.

const plural = (value, word) => `${value.toLocaleString('en')} ${word}${value === 1 ? '' : 's'}`;

class Viewer {
  constructor(root, views) {
    this.root = root;
    this.views = views;
    const part = (name) => root.querySelector(`[data-part="${name}"]`);
    this.part = part;
    this.pairList = new PairList({box: part('pairs'), order: part('pair-order'), only: part('pair-only'),
                                  count: part('pair-count')}, (i, j, kind) => this.pickPair(i, j, kind));
    this.playback = new Playback({play: part('play'), slider: part('frame'), number: part('frame-number'),
                                  rate: part('rate')}, (position) => this.frameChanged(position), () => this.scene.lookAtAll());
    views.forEach((view, k) => part('view').add(new Option(view.input, k)));
    part('view-label').hidden = views.length < 2;
    part('view').addEventListener('change', () => this.setView(Number(part('view').value)));
    part('variant').addEventListener('change', () => this.setVariant(part('variant').value));
    part('level').addEventListener('input', () => this.setLevel(part('level').valueAsNumber));
    part('level-go').addEventListener('click', () => this.playback.step(this.view.nearest(this.view.treeFrame) - this.position));
    part('reset').addEventListener('click', () => this.reset());
    part('save').addEventListener('click', () => this.save());
    part('copy').addEventListener('click', () => this.copy());
  }

  // The scene comes when three.js has been unpacked; until then, and without it, nothing is drawn.
  start(scene, notice) {
    this.scene = scene;
    this.part('notice').textContent = notice;
    this.part('notice').hidden = !notice;
    this.root.dataset.scene = scene.name;
    addPointing(this);
    addKeys(this);
    new ResizeObserver(() => scene.resize()).observe(this.part('stage'));
    const repaint = () => this.repaint();
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
    new MutationObserver(repaint).observe(document.documentElement, {attributes: true});
    scene.resize();
    this.palette = readPalette(this.root);
    scene.setPalette(this.palette);
    this.setView(0);
  }

  setView(index, frameNumber) {
    this.playback.pause();
    this.index = index;
    this.view = this.views[index];
    this.part('view').value = index;
    this.placement = new Placement(this.view);
    this.along = null;
    this.position = -1;
    this.variant = '';
    this.level = -1;
    this.selected = null;
    this.pairList.unfilter();
    this.part('pair').hidden = true;
    this.scene.setPlacement(this.placement);
    this.fillVariants();
    const slider = this.part('level');
    slider.max = this.view.levels.length - 1;
    slider.value = -1;
    this.part('level-label').hidden = this.view.levels.length === 0;
    this.part('transport').hidden = this.view.frames.length < 2;
    this.part('replay').hidden = !this.view.command;
    const position = frameNumber === undefined ? this.busiestFrame() : this.view.nearest(frameNumber);
    this.playback.setFrames(this.view.frames.map((frame) => frame.frame), position);
    this.scene.lookAtAll(this.frame);
  }

  // The frame with the most pairs says most about a chain.
  busiestFrame() {
    const sizes = this.view.frames.map((frame) => (frame.pairs || '').length);
    return sizes.indexOf(Math.max(...sizes));
  }

  fillVariants() {
    const chooser = this.part('variant');
    chooser.replaceChildren(new Option('every exact variant', ''));
    for (const variant of this.view.variants) {
      const entries = this.view.wrong.filter((entry) => entry.variant === variant);
      const total = (name) => entries.reduce((sum, entry) => sum + entry[name].length, 0);
      chooser.add(new Option(`${variant}: ${total('missing')} missing, ${total('invented')} invented`, variant));
    }
    this.part('variant-label').hidden = this.view.variants.length === 0;
  }

  setVariant(variant) {
    this.variant = variant;
    this.part('variant').value = variant;
    const frames = this.view.wrong.filter((entry) => entry.variant === variant).map((entry) => entry.frame);
    const now = this.view.frames[this.position].frame;
    if (frames.length && !frames.includes(now)) this.playback.step(this.view.nearest(frames[0]) - this.position);
    else this.showPairs();
  }

  setLevel(level) {
    this.level = level;
    this.part('level').value = level;
    this.showBounds();
  }

  frameChanged(position) {
    this.position = position;
    this.frame = this.view.frame(position);
    if (!this.along || this.along.length !== this.frame.spheres.length / 4)
      this.along = this.view.along(this.frame.spheres.length / 4);
    this.showPairs();
    this.showBounds();
  }

  // Exact pairs, and of the chosen variant what it missed and invented; each pair once.
  showPairs() {
    const {frame} = this, wrong = this.view.wrongIn(this.variant, frame.number);
    const count = frame.spheres.length / 4;
    const missing = wrong ? wrong.missing.flat() : [], invented = wrong ? wrong.invented.flat() : [];
    const missed = new Set();
    for (let k = 0; k < missing.length; k += 2) missed.add(missing[k] * count + missing[k + 1]);
    const found = missed.size === 0 ? frame.pairs
        : frame.pairs.filter((_, k) => !missed.has(frame.pairs[k & ~1] * count + frame.pairs[k | 1]));
    const pairs = new Uint32Array(found.length + missing.length + invented.length);
    pairs.set(found);
    pairs.set(missing, found.length);
    pairs.set(invented, found.length + missing.length);
    const kinds = new Uint8Array(pairs.length / 2);
    kinds.fill(1, found.length / 2).fill(2, (found.length + missing.length) / 2);
    this.marked = [['colliding', found], ['missing', missing], ['invented', invented]];
    this.pairs = pairs;
    this.kinds = kinds;
    this.touching = new Uint32Array(count);
    for (const sphere of frame.pairs) ++this.touching[sphere];
    if (this.selected) this.select(null);
    this.pairList.set(pairs, kinds, frame.spheres, frame.box);
    this.paint();
    this.describe(missing.length / 2, invented.length / 2);
  }

  paint() {
    const {scene, palette, frame, pairs, kinds} = this;
    scene.setSpheres(frame, chainColours(palette, this.along, this.marked));
    scene.setContacts(Array.from(kinds, (kind, k) => ({
      ...contactOf(frame.spheres, pairs[2 * k], pairs[2 * k + 1], frame.box), kind, colour: palette[pairKinds[kind]],
    })));
    scene.select(this.selected, palette);
  }

  repaint() {
    const palette = readPalette(this.root);
    if (JSON.stringify(palette) === JSON.stringify(this.palette)) return;
    this.palette = palette;
    this.scene.setPalette(palette);
    this.paint();
    this.showBounds();
  }

  showBounds() {
    const shown = this.level >= 0 && this.frame.number === this.view.treeFrame;
    const rows = shown ? this.view.bounds(this.level) : null;
    this.scene.setBounds(rows, this.palette);
    const stored = this.level >= 0 ? this.view.levels[this.level] : null;
    this.part('legend-bound').hidden = !shown;
    this.part('level-go').hidden = shown || !stored;
    this.part('level-number').textContent = !stored ? 'off'
        : !shown ? `stored for frame ${this.view.treeFrame}`
        : `level ${stored.level}: ${plural(rows.length / 4, 'sphere')}`;
    this.part('level').setAttribute('aria-valuetext', this.part('level-number').textContent);
  }

  describe(missing, invented) {
    const {view, frame} = this;
    const most = this.touching.reduce((a, b) => Math.max(a, b), 0);
    const facts = [plural(frame.spheres.length / 4, 'sphere'), plural(frame.pairs.length / 2, 'pair')];
    if (most) facts.push(`at most ${most} a sphere`);
    if (this.variant) {
      facts.push(missing + invented ? `${this.variant}: ${missing} missing, ${invented} invented`
                                    : `${this.variant}: nothing wrong recorded in this frame`);
    }
    const text = `frame ${frame.number}: ${facts.join(', ')}`;
    this.part('facts').setAttribute('aria-live', this.playback.timer ? 'off' : 'polite');
    this.part('facts').textContent = text;
    this.scene.canvas.setAttribute('aria-label', `The chain ${view.input} in 3-D, ${text}`);
    this.part('command').textContent = view.replay(frame.number, this.variant);
    this.part('legend-box').hidden = !frame.box;
    this.part('legend-colliding').hidden = frame.pairs.length === 0;
    this.part('legend-missing').hidden = missing === 0;
    this.part('legend-invented').hidden = invented === 0;
  }

  pickPair(i, j, kind) {
    this.playback.pause();
    this.select({i, j, kind, ...contactOf(this.frame.spheres, i, j, this.frame.box)});
    this.scene.flyToContact(this.selected);
  }

  select(selected) {
    this.selected = selected;
    this.scene.select(selected, this.palette);
    this.describePair();
    if (!selected) this.pairList.unpick();
  }

  describePair() {
    const {selected} = this, line = this.part('pair');
    line.hidden = !selected;
    if (!selected) return;
    const {i, j, kind, small, across} = selected, depth = overlapDepth(this.frame.spheres, i, j, this.frame.box);
    const share = small > 0 && depth > 0 ? `, ${shortNumber(100 * depth / small)} % of the smaller radius` : '';
    const by = kind ? `, ${['', 'missed', 'invented'][kind]} by ${this.variant}` : '';
    const where = across ? ', across the face of the box' : '';
    line.textContent =
        `${i} – ${j}: ${depth < 0 ? 'apart by' : 'overlap'} ${shortNumber(Math.abs(depth))}${share}${where}${by}`;
  }

  reset() {
    this.select(null);
    this.scene.lookAtAll(this.frame);
  }

  save() {
    const link = document.createElement('a');
    link.href = this.scene.image();
    link.download = `${this.view.input.replace(/[^\w.=-]+/g, '_')}_frame${this.frame.number}.png`;
    link.click();
  }

  async copy() {
    const code = this.part('command'), button = this.part('copy');
    try {
      await navigator.clipboard.writeText(code.textContent);
    } catch {      // a page opened from a file may be refused the clipboard
      getSelection().selectAllChildren(code);
      document.execCommand('copy');
    }
    button.textContent = 'Copied';
    setTimeout(() => { button.textContent = 'Copy'; }, 1500);
  }
}
