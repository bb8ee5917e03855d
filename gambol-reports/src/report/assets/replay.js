// The champion's replay: the large stage with its controls, keys, readouts and footfall diagram.

const ICONS = {
  play: "M7 4.5v15l12.5-7.5z",
  pause: "M6.5 4.5h4v15h-4zM13.5 4.5h4v15h-4z",
  back: "M5.5 5h2.6v14H5.5zM19 5v14L8.8 12z",
  forward: "M15.9 5h2.6v14h-2.6zM5 5v14l10.2-7z",
  minus: "M5 10.8h14v2.4H5z",
  follow: "M11 2h2v3.1a7 7 0 0 1 5.9 5.9H22v2h-3.1a7 7 0 0 1-5.9 5.9V22h-2v-3.1A7 7 0 0 1 5.1 13H2v-2h3.1A7 7 0 0 1 11 5.1zm1 5a5 5 0 1 0 0 10 5 5 0 0 0 0-10zm0 3a2 2 0 1 1 0 4 2 2 0 0 1 0-4z",
  plus: "M5 10.8h5.8V5h2.4v5.8H19v2.4h-5.8V19h-2.4v-5.8H5z",
};

function setIcon(button, name) {
  button.innerHTML = `<svg viewBox="0 0 24 24" width="20" height="20" aria-hidden="true"><path d="${ICONS[name]}" fill="currentColor"/></svg>`;
}

class ReplayView {
  constructor(run, model, replay, contacts, clock) {
    Object.assign(this, { model, replay, contacts, clock });
    this.stage = new Stage(document.getElementById("replay-canvas"), 0.8);
    this.stage.ground = replay.ground;
    this.pose = new Float32Array(replay.size);
    this.top = highestCentre(replay);
    this.follow = true;
    this.zoom = 1;
    this.stage.canvas.setAttribute("aria-label", `${run.creatureName}: the champion of generation ${run.champion.generation ?? "?"}, `
      + `${fixed(replay.duration, 1)} seconds`);
    this.buildControls();
    this.buildReadouts();
    this.listenToPointer();
    this.listenToKeys();
  }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage.stale; }
  set stale(value) { this.stage.stale = value; }

  buildControls() {
    const get = name => document.getElementById("replay-" + name);
    const play = get("play");
    setIcon(get("back"), "back");
    setIcon(get("forward"), "forward");
    setIcon(get("out"), "minus");
    setIcon(get("in"), "plus");
    this.clock.onChange(() => {
      setIcon(play, this.clock.playing ? "pause" : "play");
      play.setAttribute("aria-label", this.clock.playing ? "Pause" : "Play");
    });
    play.addEventListener("click", () => this.clock.toggle());
    get("back").addEventListener("click", () => this.step(-1));
    get("forward").addEventListener("click", () => this.step(1));
    get("in").addEventListener("click", () => this.zoomBy(1.25));
    get("out").addEventListener("click", () => this.zoomBy(0.8));
    get("speed").addEventListener("change", event => { this.clock.speed = Number(event.target.value); });
    this.followButton = get("follow");
    setIcon(this.followButton, "follow");
    this.followButton.append(element("span", "Follow"));
    this.followButton.addEventListener("click", () => this.setFollow(!this.follow));
    this.scrub = get("scrub");
    this.scrub.max = this.replay.frames - 1;
    this.scrub.addEventListener("input", () => {
      this.clock.pause();
      this.clock.seek(Number(this.scrub.value) * this.replay.timeStep);
    });
  }

  buildReadouts() {
    const list = document.getElementById("replay-readouts");
    this.readouts = {};
    for (const [name, unit] of [["time", "s"], ["distance", "m"], ["height", "m"], ["speed", "m/s"]]) {
      const group = document.createElement("div");
      const term = document.createElement("dt");
      const value = document.createElement("dd");
      const number = document.createElement("span");
      term.textContent = name;
      value.append(number, `\u00a0${unit}`);
      group.append(term, value);
      list.append(group);
      this.readouts[name] = number;
    }
    list.title = "Distance and height of the torso's centre: from where it started, and above the ground. Speed over a quarter of a second.";
  }

  step(frames) {
    this.clock.pause();
    const frame = Math.min(Math.max(frameAt(this.replay, this.clock.now) + frames, 0), this.replay.frames - 1);
    this.clock.seek(frame * this.replay.timeStep);
  }

  zoomBy(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.05), 6);
    this.stale = true;
  }

  setFollow(on) {
    this.follow = on;
    this.followButton.setAttribute("aria-pressed", String(on));
    this.stale = true;
  }

  listenToPointer() {
    const canvas = this.stage.canvas;
    let from = null;
    canvas.addEventListener("pointerdown", event => {
      from = { x: event.clientX, centre: this.stage.centreX, moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!from) return;
      const shift = event.clientX - from.x;
      if (!from.moved && Math.abs(shift) < 5) return;
      if (!from.moved) { from.moved = true; this.setFollow(false); }
      this.stage.centreX = from.centre - shift / this.stage.scale;
      this.stale = true;
    });
    canvas.addEventListener("pointerup", () => {
      if (from && !from.moved) this.clock.toggle();
      from = null;
    });
    canvas.addEventListener("pointercancel", () => { from = null; });
    canvas.addEventListener("wheel", event => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY * 0.004));
    }, { passive: false });
  }

  // Keys work wherever the focus is, as long as a stage of the champion is on screen and no control wants the key.
  listenToKeys() {
    document.addEventListener("keydown", event => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const seen = loop.views.some(view => view.clock === this.clock && view.visible);
      if (!seen || event.target.closest("input, select, textarea, summary, pre, [role=slider], [data-keys]")) return;
      const key = event.key;
      if (key === " ") {
        if (event.target.closest("button")) return;
        this.clock.toggle();
      } else if (key === "ArrowLeft") this.step(event.shiftKey ? -10 : -1);
      else if (key === "ArrowRight") this.step(event.shiftKey ? 10 : 1);
      else if (key === "f" || key === "F") this.setFollow(!this.follow);
      else if (key === "+" || key === "=") this.zoomBy(1.25);
      else if (key === "-" || key === "−") this.zoomBy(0.8);
      else return;
      event.preventDefault();
    });
  }

  draw() {
    const { stage, replay, model, clock } = this;
    const time = clock.now;
    const frame = frameAt(replay, time);
    poseAt(replay, time, this.pose);
    stage.scale = fittingScale(stage, model, this.top, 0.66, stage.width < 560 ? 8 : 64) * this.zoom;
    if (this.follow) stage.centreX = middleX(model, this.pose) + stage.width * 0.06 / stage.scale;
    stage.raise = raiseFor(stage, model, this.pose);
    stage.drawScenery(replay.startX, { small: stage.width < 560 });
    this.drawTrace(frame);
    drawShadow(stage, model, this.pose);
    if (this.contacts) drawContacts(stage, model, this.pose, this.contacts[frame]);
    drawCreature(stage, model, this.pose);
    this.scrub.value = frame;
    this.scrub.style.setProperty("--done", `${100 * frame / Math.max(replay.frames - 1, 1)}%`);
    this.scrub.setAttribute("aria-valuetext", `${fixed(time, 2)} of ${fixed(replay.duration, 2)} seconds`);
    this.readouts.time.textContent = fixed(time, 2);
    this.readouts.distance.textContent = fixed(this.pose[0] - replay.startX, 2);
    this.readouts.height.textContent = fixed(this.pose[1] - surfaceAt(replay.ground, this.pose[0]), 2);
    this.readouts.speed.textContent = fixed(speedAt(replay, frame), 2);
  }

  // The way the torso's centre came, fading with age.
  drawTrace(frame) {
    const { stage, replay } = this;
    const c = stage.context;
    const length = Math.round(2.5 / replay.timeStep);
    const stride = Math.max(1, Math.round(0.02 / replay.timeStep));
    c.strokeStyle = theme.accent;
    c.lineWidth = 1.5;
    c.lineCap = "butt";
    for (let i = Math.max(0, frame - length); i + stride <= frame; i += stride) {
      c.globalAlpha = 0.5 * (1 - (frame - i) / length);
      c.beginPath();
      c.moveTo(stage.screenX(torsoX(replay, i)), stage.screenY(torsoY(replay, i)));
      c.lineTo(stage.screenX(torsoX(replay, i + stride)), stage.screenY(torsoY(replay, i + stride)));
      c.stroke();
    }
    c.globalAlpha = 1;
  }
}

// Footfalls: one row for each part that ever touches the ground, a bar while it does; the present in the middle.
class FootfallView {
  constructor(model, replay, contacts, clock) {
    Object.assign(this, { replay, contacts, clock });
    this.rows = model.parts.filter(part => contacts.some(mask => inMask(mask, part.index)));
    const canvas = document.getElementById("footfalls-canvas");
    canvas.style.height = `${this.rows.length * 15 + 26}px`;
    this.stage = new Stage(canvas, 0, { scenery: false });
    this.spans = this.rows.map(part => spansOf(contacts, part.index));
    canvas.addEventListener("click", event => {
      this.clock.pause();
      this.clock.seek(this.timeAt(event.offsetX));
    });
  }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage.stale; }
  set stale(value) { this.stage.stale = value; }

  layout() {
    const left = this.stage.width < 560 ? 92 : 140;
    const room = this.stage.width - left;
    const span = Math.min(Math.max(this.replay.duration, 0.5), room / 90);
    const from = Math.min(Math.max(this.clock.now - span / 2, 0), Math.max(this.replay.duration - span, 0));
    return { left, room, span, from };
  }

  timeAt(pixel) {
    const { left, room, span, from } = this.layout();
    return from + (pixel - left) / room * span;
  }

  draw() {
    const { stage } = this;
    const c = stage.context;
    const { left, room, span, from } = this.layout();
    const toX = time => left + (time - from) / span * room;
    stage.resetTransform();
    c.clearRect(0, 0, stage.width, stage.height);
    const bottom = this.rows.length * 15 + 4;
    c.font = `12px ${theme.font}`;
    c.textBaseline = "middle";
    this.rows.forEach((part, row) => {
      const y = row * 15 + 9;
      c.textAlign = "left";
      c.fillStyle = theme.quiet;
      c.fillText(part.name, 0, y, left - 10);
      c.fillStyle = theme.line;
      c.fillRect(left, y - 0.5, room, 1);
    });
    c.save();
    c.beginPath();
    c.rect(left, 0, room, stage.height);
    c.clip();
    c.textAlign = "center";
    for (let second = Math.ceil(from); second <= from + span; second++) {
      c.fillStyle = theme.quiet;
      c.fillText(`${second} s`, Math.min(Math.max(toX(second), left + 10), stage.width - 10), bottom + 12);
      c.fillRect(toX(second) - 0.5, bottom, 1, 4);
    }
    c.fillStyle = theme.accent;
    this.spans.forEach((spans, row) => {
      for (const [start, end] of spans) {
        const x = toX(start * this.replay.timeStep);
        const w = toX(end * this.replay.timeStep) - x;
        if (x > stage.width || x + w < left) continue;
        c.beginPath();
        c.roundRect(x, row * 15 + 5, Math.max(w, 1.5), 8, 3);
        c.fill();
      }
    });
    c.restore();
    c.fillStyle = theme.ink;
    c.fillRect(Math.min(toX(this.clock.now), stage.width - 1) - 0.75, 0, 1.5, bottom);
  }
}

// The frames during which a part touches the ground, as [first, one past the last].
function spansOf(contacts, part) {
  const spans = [];
  let start = -1;
  for (let i = 0; i <= contacts.length; i++) {
    const touching = i < contacts.length && inMask(contacts[i], part);
    if (touching && start < 0) start = i;
    if (!touching && start >= 0) { spans.push([start, i]); start = -1; }
  }
  return spans;
}
