// The list of pairs. Only the rows in sight exist, so that a million pairs scroll like ten.

const rowHeight = 28;
const pairKinds = ['colliding', 'missing', 'invented'];

class PairList {
  constructor(elements, onPick) {
    Object.assign(this, elements);     // box, order, only, count
    this.onPick = onPick;
    this.spacer = this.box.appendChild(document.createElement('div'));
    this.spacer.className = 'rows';
    this.spacer.setAttribute('role', 'presentation');
    this.box.addEventListener('scroll', () => this.draw());
    this.box.addEventListener('click', (event) => {
      const row = event.target.closest('[data-place]');
      if (row) this.pick(Number(row.dataset.place));
    });
    this.box.addEventListener('keydown', (event) => {
      const step = {ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10, Home: -Infinity, End: Infinity}[event.key];
      if (step === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      this.pick(this.place + step);
    });
    this.order.addEventListener('change', () => this.arrange());
    this.only.addEventListener('input', () => this.arrange());
    this.clear();
  }

  clear() { this.set(new Uint32Array(0), new Uint8Array(0), new Float32Array(0)); }

  // pairs: i, j, i, j, ...; a kind for each, and the spheres of the frame and the box that repeats them.
  set(pairs, kinds, spheres, box = null) {
    Object.assign(this, {pairs, kinds, spheres, space: box, depths: null});
    this.arrange();
  }

  // Of another chain the numbers of spheres say something else.
  unfilter() { this.only.value = ''; }

  depth(item) {
    if (!this.depths) {
      this.depths = Float64Array.from(this.kinds, (_, k) => overlapDepth(
          this.spheres, this.pairs[2 * k], this.pairs[2 * k + 1], this.space));
    }
    return this.depths[item];
  }

  arrange() {
    const {pairs, kinds} = this;
    const wanted = this.only.value.trim();
    const only = Number(wanted);
    let items = Array.from(kinds, (_, k) => k);
    if (wanted !== '') items = items.filter((k) => pairs[2 * k] === only || pairs[2 * k + 1] === only);
    const sign = {deep: -1, shallow: 1}[this.order.value] || 0;
    // What is wrong comes first, whatever the order.
    const rank = (k) => kinds[k] ? 0 : 1;
    items.sort((a, b) => rank(a) - rank(b) || (sign ? sign * (this.depth(a) - this.depth(b)) : 0) ||
                         pairs[2 * a] - pairs[2 * b] || pairs[2 * a + 1] - pairs[2 * b + 1]);
    this.items = items;
    this.place = -1;
    this.spacer.style.height = `${items.length * rowHeight}px`;
    this.box.scrollTop = 0;
    const all = kinds.length;
    this.count.textContent = items.length === all ? all.toLocaleString('en')
                                                  : `${items.length.toLocaleString('en')} of ${all.toLocaleString('en')}`;
    this.box.dataset.empty = items.length ? '' : all ? 'no pair of this sphere' : 'no sphere touches another here';
    this.draw();
  }

  draw() {
    const first = Math.max(0, Math.floor(this.box.scrollTop / rowHeight) - 4);
    const last = Math.min(this.items.length, Math.ceil((this.box.scrollTop + this.box.clientHeight) / rowHeight) + 4);
    const rows = [];
    for (let place = first; place < last; ++place) rows.push(this.row(place));
    this.spacer.replaceChildren(...rows);
    const active = this.place >= first && this.place < last ? `${this.box.id}-${this.place}` : '';
    if (active) this.box.setAttribute('aria-activedescendant', active);
    else this.box.removeAttribute('aria-activedescendant');
  }

  row(place) {
    const item = this.items[place], kind = pairKinds[this.kinds[item]];
    const row = document.createElement('div');
    row.id = `${this.box.id}-${place}`;
    row.dataset.place = place;
    row.className = `row ${kind}`;
    row.style.top = `${place * rowHeight}px`;
    row.setAttribute('role', 'option');
    row.setAttribute('aria-selected', place === this.place);
    row.setAttribute('aria-setsize', this.items.length);
    row.setAttribute('aria-posinset', place + 1);
    const cell = (name, text) => {
      const span = row.appendChild(document.createElement('span'));
      span.className = name;
      span.textContent = text;
    };
    cell('sign', ['●', '◇', '✕'][this.kinds[item]]);
    cell('spheres', `${this.pairs[2 * item]} – ${this.pairs[2 * item + 1]}`);
    cell('word', this.kinds[item] ? kind : '');
    cell('depth', shortNumber(this.depth(item)));
    return row;
  }

  pick(place) {
    if (!this.items.length) return;
    this.place = Math.min(Math.max(place, 0), this.items.length - 1);
    const top = this.place * rowHeight;
    if (top < this.box.scrollTop) this.box.scrollTop = top;
    if (top + rowHeight > this.box.scrollTop + this.box.clientHeight)
      this.box.scrollTop = top + rowHeight - this.box.clientHeight;
    this.draw();
    const item = this.items[this.place];
    this.onPick(this.pairs[2 * item], this.pairs[2 * item + 1], this.kinds[item]);
  }

  // The next pair of a sphere after the one picked; false: it has none.
  pickSphere(sphere) {
    for (let step = 1; step <= this.items.length; ++step) {
      const place = (this.place + step + this.items.length) % this.items.length;
      const item = this.items[place];
      if (this.pairs[2 * item] === sphere || this.pairs[2 * item + 1] === sphere) return this.pick(place), true;
    }
    return false;
  }

  unpick() {
    this.place = -1;
    this.draw();
  }
}

function shortNumber(value) {
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(1).replace('e+', 'e') : value.toPrecision(3);
}
