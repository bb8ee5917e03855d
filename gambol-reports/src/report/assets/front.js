// The front of a search for several objectives: a chart of the compromises found, and a stage on which the chosen one
// moves.

// `energy, J (less is better)`
function objectiveLabel({ name, unit, less_is_better: less }) {
  return `${name}${unit && unit !== "1" ? `, ${unit}` : ""} (${less ? "less" : "more"} is better)`;
}

function objectiveValue({ name, unit }, value) {
  return `${name} ${withUnit(value, unit === "1" ? "" : unit)}`;
}

// A scatter chart of two of the objectives. Clicks choose the nearest point, arrow keys the next one.
class FrontChart {
  constructor(front, choose) {
    Object.assign(this, { front, choose, axes: [0, 1], picked: 0 });
    this.place = document.getElementById("front-chart");
    this.place.tabIndex = 0;
    this.place.dataset.keys = "";
    this.place.setAttribute("role", "slider");
    this.place.setAttribute("aria-label", "Points of the front; arrow keys choose one");
    this.place.setAttribute("aria-valuemin", 1);
    this.place.setAttribute("aria-valuemax", front.points.length);
    if (front.objectives.length > 2) this.buildPicker();
    this.listen();
    new ResizeObserver(() => this.build()).observe(this.place);
    this.build();
  }

  // With more than two objectives the two to be seen can be chosen.
  buildPicker() {
    const picker = document.getElementById("front-axes");
    picker.hidden = false;
    ["Across", "Up"].forEach((name, axis) => {
      const label = element("label", undefined, "pick");
      const select = element("select");
      this.front.objectives.forEach((objective, i) => {
        const option = element("option", objective.name);
        option.value = i;
        option.selected = i === this.axes[axis];
        select.append(option);
      });
      select.addEventListener("change", () => {
        this.axes[axis] = Number(select.value);
        this.width = undefined;
        this.build();
      });
      label.append(element("span", name, "quiet"), select);
      picker.append(label);
    });
  }

  // Where values of an objective lie between two places on the page, with a margin; all alike lie in the middle.
  scale(objective, from, to) {
    const values = this.front.points.map(point => point.values[objective]);
    let low = Math.min(...values);
    let high = Math.max(...values);
    const margin = high > low ? (high - low) * 0.05 : Math.max(Math.abs(high) * 0.05, 0.5);
    low -= margin;
    high += margin;
    return { low, high, at: value => from + (value - low) / (high - low) * (to - from) };
  }

  build() {
    const width = Math.round(this.place.clientWidth);
    if (width < 40 || width === this.width) return;
    this.width = width;
    const narrow = width < 560;
    const height = narrow ? 280 : 360;
    const box = { left: narrow ? 46 : 60, right: width - 16, top: 26, bottom: height - 42 };
    const [across, up] = this.axes;
    this.x = this.scale(across, box.left, box.right);
    this.y = this.scale(up, box.bottom, box.top);
    this.place.replaceChildren();
    const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, "aria-hidden": "true" }, this.place);
    this.drawAxes(root, box, narrow);
    const spots = this.front.points.map(({ values }) => [this.x.at(values[across]), this.y.at(values[up])]);
    if (this.front.objectives.length === 2) {
      svg("polyline", { class: "front-line", points: spots.map(spot => spot.map(v => v.toFixed(1)).join()).join(" ") }, root);
    }
    this.dots = spots.map(([cx, cy]) => svg("circle", { class: "front-point", cx, cy, r: 5 }, root));
    this.spots = spots;
    this.mark();
  }

  drawAxes(root, box, narrow) {
    const decimals = step => Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const vertical = niceTicks(this.y.low, this.y.high, narrow ? 4 : 6);
    for (const tick of vertical.ticks) {
      const y = this.y.at(tick);
      svg("line", { class: Math.abs(tick) < 1e-9 ? "zero" : "grid", x1: box.left, x2: box.right, y1: y, y2: y }, root);
      svg("text", { class: "tick", x: box.left - 8, y: y + 4, "text-anchor": "end" }, root).textContent = fixed(tick, decimals(vertical.step));
    }
    const level = niceTicks(this.x.low, this.x.high, narrow ? 4 : 8);
    for (const tick of level.ticks) {
      const x = this.x.at(tick);
      svg("line", { class: "mark", x1: x, x2: x, y1: box.bottom, y2: box.bottom + 5 }, root);
      svg("text", { class: "tick", x, y: box.bottom + 19, "text-anchor": "middle" }, root).textContent = fixed(tick, decimals(level.step));
    }
    const [across, up] = this.axes.map(axis => objectiveLabel(this.front.objectives[axis]));
    svg("text", { class: "axis", x: 0, y: 11 }, root).textContent = up;
    svg("text", { class: "axis", x: box.right, y: box.bottom + 37, "text-anchor": "end" }, root).textContent = across;
  }

  listen() {
    this.place.addEventListener("click", event => {
      const place = this.place.getBoundingClientRect();
      const [x, y] = [event.clientX - place.left, event.clientY - place.top];
      const distance = ([px, py]) => Math.hypot(px - x, py - y);
      let nearest = 0;
      this.spots.forEach((spot, i) => { if (distance(spot) < distance(this.spots[nearest])) nearest = i; });
      this.pick(nearest);
    });
    this.place.addEventListener("keydown", event => {
      const to = rowForKey(event.key, this.picked, this.front.points);
      if (to === undefined) return;
      event.preventDefault();
      this.pick(Math.min(Math.max(to, 0), this.front.points.length - 1));
    });
  }

  pick(index) {
    this.picked = index;
    this.mark();
    this.choose(index);
  }

  mark() {
    this.dots?.forEach((dot, i) => {
      dot.classList.toggle("chosen", i === this.picked);
      dot.setAttribute("r", i === this.picked ? 8 : 5);
    });
    const point = this.front.points[this.picked];
    this.place.setAttribute("aria-valuenow", this.picked + 1);
    this.place.setAttribute("aria-valuetext", point.values.map((value, i) => objectiveValue(this.front.objectives[i], value)).join(", "));
  }
}

// The chosen point, moving.
class FrontView {
  constructor(front, model, judged, ground) {
    Object.assign(this, { front, model, judged, ground });
    this.stage = new Stage(document.getElementById("front-canvas"), 0.8);
    this.stage.ground = ground;
    this.clock = loop.addClock(new Clock(0));
    this.decoded = new Map();
    playButton(document.getElementById("front-play"), this.clock);
    this.choose(0);
    this.clock.playing = !reducedMotion.matches;
    this.clock.changed();
  }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage.stale; }
  set stale(value) { this.stage.stale = value; }

  // A replay is decoded when it is first looked at.
  choose(index) {
    const point = this.front.points[index];
    if (!this.decoded.has(index)) this.decoded.set(index, decodeReplay(point.replay, this.ground));
    this.replay = this.decoded.get(index);
    this.pose = new Float32Array(this.replay.size);
    this.top = highestCentre(this.replay);
    this.clock.setDuration(this.replay.duration);
    this.clock.seek(reducedMotion.matches ? this.clock.duration * 0.5 : 0);
    this.stale = true;
    const list = values => values.map((value, i) => objectiveValue(this.front.objectives[i], value)).join(" · ");
    const text = `Point ${point.number}: ${list(point.values)}`;
    const judged = !this.judged ? "" : point.judged ? ` · in a whole episode without variation: ${list(point.judged)}`
      : " · fails in a whole episode without variation";
    this.stage.canvas.setAttribute("aria-label", text);
    const note = document.getElementById("front-note");
    note.replaceChildren(element("strong", text), `${judged} · `, element("code", `${this.front.command} ${point.number}`));
  }

  draw() {
    const { stage, replay, model } = this;
    poseAt(replay, this.clock.now, this.pose);
    stage.scale = fittingScale(stage, model, this.top, 0.5);
    stage.centreX = middleX(model, this.pose) + stage.width * 0.06 / stage.scale;
    stage.raise = raiseFor(stage, model, this.pose);
    stage.drawScenery(replay.startX, { small: stage.width < 560 });
    drawShadow(stage, model, this.pose);
    drawCreature(stage, model, this.pose);
  }
}

function buildFront(run, model) {
  const front = run.front;
  if (!front) return;
  front.points = front.points.filter(point => point.replay?.frames);
  if (!front.points.length) return;
  document.getElementById("front").hidden = false;
  const shown = front.points.length < front.total ? `${front.points.length} of ${fixed(front.total, 0)} points, evenly spread. ` : "";
  const judged = run.summary?.judged;
  const generations = new Set(front.points.map(point => point.generation));
  const when = generations.size > 1 ? "the generation each was evaluated in" : `generation ${fixed(front.points[0].generation, 0)}`;
  const where = judged ? ` The chart has what was measured in training, in ${when}.` : "";
  document.getElementById("front-intro").textContent = `None of these is better than another in one objective without being worse in another. ${shown}`
    + `Click one to see its first seconds.${where}`;
  const view = new FrontView(front, model, judged, run.ground);
  loop.addView(view);
  new FrontChart(front, index => view.choose(index));
}
