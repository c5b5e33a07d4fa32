// Frames played and scrubbed. A timer runs only while frames are played.

class Playback {
  // onStart: it will move, so all frames should be in sight.
  constructor(elements, onFrame, onStart) {
    Object.assign(this, elements);     // play, slider, number, rate
    Object.assign(this, {onFrame, onStart});
    this.timer = 0;
    this.play.addEventListener('click', () => this.toggle());
    this.slider.addEventListener('input', () => {
      this.pause();
      this.go(this.slider.valueAsNumber);
    });
    this.show();
  }

  // frames: their numbers, in order.
  setFrames(numbers, position) {
    this.pause();
    this.numbers = numbers;
    this.slider.max = Math.max(0, numbers.length - 1);
    for (const control of [this.play, this.slider, this.rate]) control.disabled = numbers.length < 2;
    this.position = -1;
    this.go(position);
  }

  go(position) {
    const count = this.numbers.length;
    const next = (position % count + count) % count;
    if (next === this.position) return;
    this.position = next;
    this.slider.value = next;
    this.number.textContent = `${this.numbers[next]} of ${this.numbers[count - 1]}`;
    this.slider.setAttribute('aria-valuetext', `frame ${this.numbers[next]}`);
    this.onFrame(next);
  }

  step(by) {
    this.pause();
    this.go(this.position + by);
  }

  toggle() { this.timer ? this.pause() : this.start(); }

  start() {
    if (this.numbers.length < 2) return;
    this.onStart();
    const tick = () => {
      this.timer = setTimeout(tick, 1000 / Number(this.rate.value));
      this.go(this.position + 1);
    };
    tick();
    this.show();
  }

  pause() {
    clearTimeout(this.timer);
    this.timer = 0;
    this.show();
  }

  show() {
    this.play.setAttribute('aria-label', this.timer ? 'Pause' : 'Play');
    this.play.dataset.playing = this.timer ? 'yes' : 'no';
  }
}
