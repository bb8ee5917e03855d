// The gait emerges: a strip of champions through the generations, all started together, and whole populations drawn
// on one stage.

// A small film of one champion, in time with the others that share its clock.
class FilmTile {
  constructor(replay, model, clock, top, label, groundShare = 0.78) {
    Object.assign(this, { replay, model, clock, top, groundShare });
    this.pose = new Float32Array(replay.size);
    this.frame = element("div", undefined, "stage stage-tile");
    this.canvas = element("canvas");
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", label);
    this.frame.append(this.canvas);
  }

  // A stage measures its canvas, so it is made once the tile is on the page.
  mount() {
    this.stage = new Stage(this.canvas, this.groundShare);
    this.stage.ground = this.replay.ground;
    loop.addView(this);
  }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage && this.stage.stale; }
  set stale(value) { if (this.stage) this.stage.stale = value; }

  draw() {
    const { stage, replay, model } = this;
    poseAt(replay, this.clock.now, this.pose);
    stage.scale = fittingScale(stage, model, this.top, 0.55);
    stage.centreX = middleX(model, this.pose);
    stage.raise = raiseFor(stage, model, this.pose);
    stage.drawScenery(replay.startX, { small: true, plain: true });
    drawShadow(stage, model, this.pose);
    drawCreature(stage, model, this.pose);
  }
}

class StripTile extends FilmTile {
  constructor(entry, replay, model, clock, top, unit) {
    super(replay, model, clock, top, `The best of generation ${entry.generation}`);
    const caption = element("p");
    caption.append(element("span", `generation ${fixed(entry.generation, 0)}`), element("b", withUnit(entry.fitness, unit)));
    this.element = element("li");
    this.element.append(this.frame, caption);
  }
}

function buildStrip(run, model) {
  const entries = (run.strip || []).map(entry => ({ entry, replay: decodeReplay(entry.replay, run.ground) })).filter(item => item.replay);
  if (!entries.length) return;
  document.getElementById("strip").hidden = false;
  const clock = loop.addClock(new Clock(Math.max(...entries.map(item => item.replay.duration))));
  const top = Math.max(...entries.map(item => highestCentre(item.replay)));
  const list = document.getElementById("strip-list");
  const tiles = entries.map(({ entry, replay }) => new StripTile(entry, replay, model, clock, top, run.unit));
  list.append(...tiles.map(tile => tile.element));
  for (const tile of tiles) tile.mount();
  playButton(document.getElementById("strip-play"), clock);
  if (reducedMotion.matches) clock.seek(clock.duration * 0.5);
}

class PopulationView {
  constructor(run, model) {
    Object.assign(this, { model, unit: run.unit });
    this.stage = new Stage(document.getElementById("populations-canvas"), 0.8);
    this.populations = run.populations;
    this.decoded = new Map();
    this.clock = loop.addClock(new Clock(0));
    this.note = document.getElementById("populations-note");
    playButton(document.getElementById("populations-play"), this.clock);
    this.buildPicker();
    this.choose(0);
    this.clock.playing = !reducedMotion.matches;
    if (reducedMotion.matches) this.clock.seek(this.clock.duration * 0.5);
    this.clock.changed();
  }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage.stale; }
  set stale(value) { this.stage.stale = value; }

  buildPicker() {
    const picker = document.getElementById("populations-picker");
    this.populations.forEach((population, i) => {
      const label = document.createElement("label");
      const input = document.createElement("input");
      input.type = "radio";
      input.name = "population";
      input.checked = i === 0;
      input.addEventListener("change", () => this.choose(i));
      const text = document.createElement("span");
      text.textContent = `${i === 0 ? "generation " : ""}${fixed(population.generation, 0)}`;
      label.append(input, text);
      picker.append(label);
    });
  }

  // Decodes a population when it is first looked at; the best comes last, so that it is drawn on top.
  members(index) {
    if (!this.decoded.has(index)) {
      const ground = decodeGround(this.populations[index].ground);
      const rank = member => member.fitness ?? -Infinity;
      const members = this.populations[index].members
        .map(member => ({ fitness: member.fitness, replay: decodeReplay(member.replay, ground) }))
        .filter(member => member.replay)
        .sort((a, b) => rank(a) - rank(b));
      for (const member of members) member.pose = new Float32Array(member.replay.size);
      this.decoded.set(index, members);
    }
    return this.decoded.get(index);
  }

  choose(index) {
    this.now = this.members(index);
    this.clock.setDuration(Math.max(0, ...this.now.map(member => member.replay.duration)));
    this.clock.seek(reducedMotion.matches ? this.clock.duration * 0.5 : 0);
    this.top = Math.max(0, ...this.now.map(member => highestCentre(member.replay)));
    this.stale = true;
    const scores = this.now.map(member => member.fitness).filter(value => value !== null && value !== undefined);
    const failed = this.populations[index].members.length - scores.length;
    const text = [count(this.populations[index].members.length, "member", "members")];
    if (scores.length) text.push(`best ${withUnit(scores[scores.length - 1], this.unit)}`, `median ${withUnit(median(scores), this.unit)}`);
    if (failed) text.push(`${failed} failed`);
    this.note.textContent = text.join(" · ");
    this.stage.canvas.setAttribute("aria-label", `The population of generation ${this.populations[index].generation}: ${this.note.textContent}`);
  }

  // The view widens as the members spread out, and keeps the best in sight when they no longer fit.
  draw() {
    const { stage, model, now } = this;
    if (!now.length) return;
    let left = Infinity, right = -Infinity;
    for (const member of now) {
      poseAt(member.replay, this.clock.now, member.pose);
      member.x = middleX(model, member.pose);
      left = Math.min(left, member.x);
      right = Math.max(right, member.x);
    }
    const best = now[now.length - 1];
    stage.ground = best.replay.ground;
    const fitting = fittingScale(stage, model, this.top, 0.5);
    const span = right - left + model.width * 2;
    stage.scale = Math.max(Math.min(fitting, stage.width / span), fitting / 3.2);
    const half = stage.width / 2 / stage.scale;
    const middle = (left + right) / 2;
    const reach = half - model.width;
    stage.centreX = Math.min(Math.max(middle, best.x - reach), best.x + reach);
    stage.raise = raiseFor(stage, model, best.pose);
    stage.drawScenery(best.replay.startX, { small: stage.width < 560 });
    const alpha = Math.max(0.16, Math.min(0.45, 5 / now.length));
    drawShadow(stage, model, best.pose);
    for (const member of now) {
      const x = stage.screenX(member.x);
      const margin = (model.height + model.width) * stage.scale;
      if (x < -margin || x > stage.width + margin) continue;
      drawCreature(stage, model, member.pose, member === best ? {} : { alpha, plain: now.length > 60 });
    }
  }
}

// The middle value of a sorted list.
function median(sorted) {
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

function buildPopulations(run, model) {
  run.populations = (run.populations || []).filter(population => (population.members || []).some(member => member.replay));
  if (!run.populations.length) return;
  document.getElementById("populations").hidden = false;
  loop.addView(new PopulationView(run, model));
}
