// Time: a clock that plays, loops and can be sought, and the one animation loop that ticks the clocks and redraws
// whatever is on screen.

const reducedMotion = window.matchMedia("(prefers-reduced-motion: reduce)");

class Clock {
  constructor(duration) {
    this.setDuration(duration);
    this.time = 0;
    this.speed = 1;
    this.playing = !reducedMotion.matches && duration > 0;
    this.listeners = [];
  }

  // The end is held for a moment, so that the eye can rest on it before the loop begins again.
  setDuration(duration) {
    this.duration = Math.max(duration, 0);
    this.hold = Math.min(0.7, this.duration * 0.3);
    if (this.time > this.duration) this.time = 0;
  }

  get now() { return Math.min(this.time, this.duration); }

  tick(seconds) {
    if (!this.playing || this.duration === 0) return;
    this.time += seconds * this.speed;
    if (this.time > this.duration + this.hold * this.speed) this.time = 0;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.duration);
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.duration) this.time = 0;
    this.changed();
  }

  pause() {
    if (this.playing) { this.playing = false; this.changed(); }
  }

  changed() { for (const listener of this.listeners) listener(); }
  onChange(listener) { this.listeners.push(listener); listener(); }
}

// Ties a button's wording to a clock.
function playButton(button, clock) {
  button.addEventListener("click", () => clock.toggle());
  clock.onChange(() => { button.textContent = clock.playing ? "Pause" : "Play"; });
}

const loop = {
  clocks: [],
  views: [],
  last: 0,

  addClock(clock) { this.clocks.push(clock); return clock; },

  // A view has `clock`, `draw()`, `visible` and `stale`; it is drawn when on screen and out of date.
  addView(view) { view.stale = true; this.views.push(view); return view; },

  redrawAll() { for (const view of this.views) view.stale = true; },

  start() {
    const frame = stamp => {
      const seconds = Math.min((stamp - this.last) / 1000, 0.1);
      this.last = stamp;
      for (const clock of this.clocks) clock.tick(seconds);
      for (const view of this.views) {
        if (!view.visible || (!view.stale && view.drawnAt === view.clock.time)) continue;
        view.stale = false;
        view.drawnAt = view.clock.time;
        view.draw();
      }
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(stamp => { this.last = stamp; frame(stamp); });
    // On paper everything is in sight.
    window.addEventListener("beforeprint", () => {
      for (const view of this.views) view.draw();
      for (const details of document.querySelectorAll("details")) details.open = true;
    });
  },
};
