// Watching a run: its state, its history, the verdict on its champion, the footfalls of the creature that is followed.

const FOOTFALL_SECONDS = 4;
const MOST_ROWS = 600;

class Watch {
  constructor(connection, arena) {
    Object.assign(this, { connection, arena });
    this.rows = [];
    this.stages = [];
    this.run = null;
    this.contacts = [];
    this.footfalls = new Stage(document.getElementById("footfalls-live"), 0, { scenery: false });
    connection.on("opened", event => this.open(event));
    connection.on("state", event => this.setState(event));
    connection.on("generations", event => this.take(event.rows));
    connection.on("stage", event => { this.stages.push({ name: event.name, row: event.row }); this.stale = true; });
    connection.on("verdict", event => this.showVerdict(event));
    const get = name => document.getElementById(name);
    const press = (name, act) => get(name).addEventListener("click", act);
    press("run-pause", () => {
      this.setPace("free");
      const waits = this.state === "paused";
      connection.ask({ do: waits ? "go-on" : "pause" });
      if (!waits) this.expect("training, waits after this generation", ["run-pause"]);
    });
    press("run-step", () => connection.ask({ do: "step" }));
    press("run-stop", () => {
      connection.ask({ do: "stop" });
      this.expect("training, stops after this generation", ["run-stop", "run-pause", "run-step"]);
    });
    get("run-pace").addEventListener("change", event => {
      this.setPace(event.target.value);
      connection.ask({ do: event.target.value === "shown" ? "step" : "go-on" });
    });
    press("run-go-on", () => connection.ask({ do: "go-on", generations: Number(document.getElementById("run-more").value) }));
    arena.onStep = frame => this.note(frame);
    // What is out of sight is not drawn.
    this.chartInSight = true;
    new IntersectionObserver(entries => { this.chartInSight = entries[entries.length - 1].isIntersecting; }, { rootMargin: "80px" })
      .observe(get("fitness-chart"));
  }

  open({ run, config, unit, command, state }) {
    Object.assign(this, { run, config, unit, rows: [], stages: [], contacts: [], last: null });
    const name = config.creature.title || config.creature.name;
    document.getElementById("arena-title").textContent = `${name} · ${config.movement.name}`;
    document.getElementById("run-command").textContent = command;
    document.title = `${name} · Gambol studio`;
    this.clear();
    const isPaced = Boolean(run) && remembered.get("paced run") === run;
    this.setState(state);
    this.setPace(isPaced ? "shown" : "free");
  }

  // Training waits for what is shown, or does not. It is so again when this tab is loaded anew.
  setPace(pace) {
    document.getElementById("run-pace").value = pace;
    remembered.set("paced run", pace === "shown" ? this.run : null);
  }

  // Nothing is known of a run yet.
  clear() {
    this.showVerdict({ usable: undefined, against: [] });
    document.getElementById("fitness-chart").replaceChildren();
    document.getElementById("fitness-legend").replaceChildren();
    this.chart?.close();
    this.chart = null;
  }

  // No run is open any more.
  close() {
    Object.assign(this, { run: null, rows: [], stages: [], contacts: [], last: null });
    document.getElementById("arena-title").textContent = "No run is open";
    document.getElementById("run-command").textContent = "";
    document.title = "Gambol studio";
    this.clear();
    document.getElementById("keep-open").hidden = true;
    this.setState({ state: "ended", reason: "train one in Choose, or open one in Keep" });
  }

  setState(state) {
    const trained = this.state === "running" || this.state === "paused";
    this.state = state.state;
    const words = { running: "training", paused: "training waits", ended: "", broken: "broke off: " };
    this.stateText = words[state.state] + (state.reason || "");
    const get = name => document.getElementById(name);
    const trains = this.state === "running" || this.state === "paused";
    // A training begins without a pause between its generations.
    if (trains && !trained) this.setPace("free");
    get("run-pause").textContent = this.state === "paused" ? "Train on" : "Pause training";
    for (const name of ["run-pause", "run-step", "run-stop", "run-pace"]) get(name).disabled = !trains;
    for (const name of ["run-go-on", "run-more"]) get(name).disabled = trains || !this.run;
    get("run-announced").textContent = this.stateText;
    this.showState();
    // What has been trained is among the runs, with its fitness.
    if (trained && !trains) this.connection.ask({ do: "look" });
  }

  // What was asked for comes after the generation under way.
  expect(text, buttons) {
    this.stateText = text;
    for (const name of buttons) document.getElementById(name).disabled = true;
    this.showState();
  }

  showState() {
    const last = this.last;
    const parts = [this.stateText];
    if (last) parts.push(`generation ${fixed(last.generation, 0)}`, `${large(last.steps)} steps`);
    document.getElementById("run-state").textContent = parts.filter(Boolean).join(" · ");
  }

  take(rows) {
    for (const row of rows) {
      const { fitness, population: evaluations, failures } = row;
      this.rows.push({ generation: this.rows.length + 1, best_so_far: row.best_so_far, best: fitness?.best, mean: fitness?.mean,
        median: fitness?.median, quantiles: fitness, failures, evaluations });
      this.last = row;
    }
    this.stale = true;
  }

  // The history, thinned where it is longer than can be seen: the best and the failures of each stretch are kept.
  get history() {
    const each = Math.ceil(this.rows.length / MOST_ROWS);
    if (each <= 1) return this.rows;
    const thin = [];
    const greatest = (stretch, field) => stretch.reduce((most, row) => (row[field] > (most ?? -Infinity) ? row[field] : most), undefined);
    // No stretch reaches from one stage into the next, and the first row of a stage stands alone: the chart begins anew there.
    const starts = new Set([0, ...this.stages.map(stage => stage.row)]);
    for (let from = 0, to; from < this.rows.length; from = to) {
      to = from + 1;
      if (!starts.has(from)) while (to < Math.min(from + each, this.rows.length) && !starts.has(to)) to++;
      const stretch = this.rows.slice(from, to);
      thin.push({ ...stretch[stretch.length - 1], best: greatest(stretch, "best"), failures: greatest(stretch, "failures") });
    }
    return thin;
  }

  // Redrawn a few times a second, however fast generations come.
  draw(stamp) {
    this.drawFootfalls();
    if (!this.stale || stamp - (this.drawnAt || 0) < 250 || !this.rows.length) return;
    this.drawnAt = stamp;
    this.showState();
    if (!this.chartInSight) return;
    this.stale = false;
    const stages = this.stages.map((stage, i) => ({
      name: stage.name, first_generation: stage.row + 1, last_generation: this.stages[i + 1]?.row ?? this.rows.length }));
    const varied = Object.keys(this.config.variation).length > 0;
    const run = { history: this.history, unit: this.unit, stages, summary: { judged: varied } };
    if (this.chart) this.chart.update(run); else this.chart = new FitnessChart(run);
  }

  showVerdict({ usable, against, near_worlds: near, generation }) {
    const verdict = document.getElementById("verdict");
    const known = usable !== undefined && usable !== null;
    verdict.textContent = !known ? "Not judged" : usable ? "Usable" : "Not usable yet";
    verdict.className = `verdict ${!known ? "verdict-none" : usable ? "verdict-good" : "verdict-bad"}`;
    document.getElementById("against").replaceChildren(...against.map(text => element("li", text)));
    document.getElementById("near").textContent = near ? `Usable in ${near[0]} of ${near[1]} worlds near this one (generation ${generation}).` : "";
  }

  note(frame) {
    if (this.contacts.length && frame.step <= this.contacts[this.contacts.length - 1].step) this.contacts = [];
    // From the start on: what was drawn of another says nothing.
    if (!this.contacts.length) this.footfallsAt = NaN;
    this.contacts.push({ step: frame.step, masks: frame.contacts.slice() });
    if (this.contacts.length > 600) this.contacts.splice(0, 200);
  }

  drawFootfalls() {
    const { stage, footfalls } = { stage: this.footfalls, footfalls: this.contacts };
    const { event, model } = this.arena;
    const last = footfalls[footfalls.length - 1]?.step;
    // Moving by less than a pixel is not seen.
    // A canvas of another size is empty.
    const isDrawn = Math.abs(last - this.footfallsAt) < 4 && !stage.stale;
    if (!stage.visible || !event || !footfalls.length || isDrawn) return;
    this.footfallsAt = last;
    stage.stale = false;
    const c = stage.context;
    stage.resetTransform();
    c.clearRect(0, 0, stage.width, stage.height);
    const span = FOOTFALL_SECONDS / event.time_step;
    const seen = footfalls.filter(({ step }) => step > last - span);
    const parts = model.parts.filter(part => seen.some(({ masks }) => masks[part.index] > 0)).slice(0, 6);
    const left = 110;
    const x = step => left + (step - last + span) / span * (stage.width - left);
    c.font = `12px ${theme.font}`;
    c.textBaseline = "middle";
    parts.forEach((part, row) => {
      const y = row * 15 + 8;
      c.fillStyle = theme.quiet;
      c.fillText(part.name, 0, y, left - 8);
      c.fillStyle = theme.accent;
      seen.forEach(({ step, masks }, i) => {
        if (masks[part.index] > 0) c.fillRect(x(step - (i ? Math.min(step - seen[i - 1].step, 10) : 1)), y - 4, Math.max(x(step) - x(step - (i ? Math.min(step - seen[i - 1].step, 10) : 1)), 1), 8);
      });
    });
  }
}
