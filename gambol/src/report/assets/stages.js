// The stages of a run: a film of each stage's champion, and what is worth knowing of it.

class StageTile {
  constructor(stage, replay, model, clock, top) {
    Object.assign(this, { replay, model, clock, top });
    this.pose = new Float32Array(replay.size);
    this.element = document.createElement("div");
    this.element.className = "stage stage-tile";
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `The champion of the stage ${stage.name}`);
    this.element.append(this.canvas);
  }

  // A stage measures its canvas, so it is made once the tile is on the page.
  mount() { this.stage = new Stage(this.canvas, 0.55); }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage && this.stage.stale; }
  set stale(value) { if (this.stage) this.stage.stale = value; }

  draw() {
    const { stage, replay, model } = this;
    poseAt(replay, this.clock.now, this.pose);
    stage.ground = replay.ground;
    stage.scale = fittingScale(stage, model, this.top, 0.55);
    stage.centreX = middleX(model, this.pose);
    stage.raise = raiseFor(stage, model, this.pose);
    stage.drawScenery(replay.startX, { small: true, plain: true });
    drawShadow(stage, model, this.pose);
    drawCreature(stage, model, this.pose);
  }
}

function buildStages(run, model) {
  const stages = run.stages || [];
  if (!stages.length) return;
  document.getElementById("stages").hidden = false;
  const list = document.getElementById("stages-list");
  const clock = loop.addClock(new Clock(0));
  const tiles = [];
  for (const stage of stages) {
    const item = document.createElement("li");
    const replay = decodeReplay(stage.film, decodeGround(stage.ground));
    if (replay) {
      const body = stage.creature ? makeModel(stage.creature) : model;
      const tile = new StageTile(stage, replay, body, clock, highestCentre(replay));
      item.append(tile.element);
      tiles.push(tile);
    }
    item.append(element("h3", `${stage.number}. ${stage.name}`));
    const facts = element("dl", undefined, "terms");
    const generations = stage.last_generation >= stage.first_generation
      ? `${fixed(stage.first_generation, 0)} to ${fixed(stage.last_generation, 0)}` : "none";
    const pairs = [["Generations", generations]];
    if (stage.fitness !== null && stage.fitness !== undefined) pairs.push(["Champion", withUnit(stage.fitness, stage.unit)]);
    terms(facts, [...pairs, ...(stage.facts || []).map(({ label, value }) => [label, value])]);
    item.append(facts);
    list.append(item);
  }
  clock.setDuration(Math.max(0, ...tiles.map(tile => tile.replay.duration)));
  for (const tile of tiles) {
    tile.mount();
    loop.addView(tile);
  }
  playButton(document.getElementById("stages-play"), clock);
  clock.playing = !reducedMotion.matches;
  if (reducedMotion.matches) clock.seek(clock.duration * 0.5);
}
