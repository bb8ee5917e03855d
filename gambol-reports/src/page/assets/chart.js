// Fitness over generations: bands, lines, axes and a crosshair that mouse, finger and arrow keys can move. The legend
// above the chart doubles as the readout. The first functions serve the other charts over generations too.

const SVG = "http://www.w3.org/2000/svg";

function svg(name, attributes, parent) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
}

// Round numbers that divide a range into about `wanted` steps.
function niceTicks(low, high, wanted) {
  const rough = (high - low) / Math.max(wanted, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= rough * 0.999) || 10 * power;
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; i++) ticks.push(i * step);
  return { ticks, step };
}

// The least and the greatest of any number of values: as arguments of a function there may be too many.
function extremes(values) {
  return values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
}

// The generation axis under a chart.
function drawGenerations(root, rows, box, x, narrow) {
  const [first, last] = [rows[0].generation, rows[rows.length - 1].generation];
  const wanted = Math.min(narrow ? 4 : 8, Math.max(rows.length - 1, 1));
  const ticks = niceTicks(first, Math.max(last, first + 1), wanted).ticks
    .filter(tick => Number.isInteger(tick) && tick >= first && tick <= last);
  if (!ticks.includes(first) && (!ticks.length || x(ticks[0]) - x(first) > 24)) ticks.unshift(first);
  for (const tick of ticks) {
    svg("line", { class: "mark", x1: x(tick), x2: x(tick), y1: box.bottom, y2: box.bottom + 5 }, root);
    svg("text", { class: "tick", x: x(tick), y: box.bottom + 19, "text-anchor": "middle" }, root).textContent = fixed(tick, 0);
  }
  svg("text", { class: "axis", x: box.right, y: box.bottom + 37, "text-anchor": "end" }, root).textContent = "generation";
}

// The index of the row closest to a place on the generation axis.
function nearestRow(rows, x, place) {
  let found = 0;
  rows.forEach((row, i) => {
    if (Math.abs(x(row.generation) - place) < Math.abs(x(rows[found].generation) - place)) found = i;
  });
  return found;
}

// Where a key leads from the row picked; undefined for keys that lead nowhere.
function rowForKey(key, now, rows) {
  return { ArrowLeft: now - 1, ArrowDown: now - 1, ArrowRight: now + 1, ArrowUp: now + 1,
    PageUp: now + 10, PageDown: now - 10, Home: 0, End: rows.length - 1 }[key];
}

// Makes a chart a slider over generations for users who cannot point at it.
function makeSlider(place, rows, label) {
  place.tabIndex = 0;
  place.dataset.keys = "";
  place.setAttribute("role", "slider");
  place.setAttribute("aria-label", label);
  place.setAttribute("aria-valuemin", rows[0].generation);
  place.setAttribute("aria-valuemax", rows[rows.length - 1].generation);
}

const SERIES = [
  { name: "best so far", kind: "best-so-far", value: row => row.best_so_far },
  { name: "best", kind: "best", value: row => row.best },
  { name: "mean", kind: "mean", value: row => row.mean },
  { name: "median", kind: "median", value: row => row.median },
  { name: "25–75 %", kind: "inner", low: row => row.quantiles?.q25, high: row => row.quantiles?.q75 },
  { name: "10–90 %", kind: "outer", low: row => row.quantiles?.q10, high: row => row.quantiles?.q90 },
];

class FitnessChart {
  constructor(run) {
    this.unit = run.unit;
    this.picked = null;
    this.usable = value => value !== null && value !== undefined && Number.isFinite(value);
    this.place = document.getElementById("fitness-chart");
    this.take(run);
    makeSlider(this.place, this.rows, "Fitness over generations; arrow keys choose a generation");
    this.listen();
    this.observer = new ResizeObserver(() => this.build());
    this.observer.observe(this.place);
    this.build();
  }

  // Another run takes its place.
  close() {
    this.observer.disconnect();
    this.listening.abort();
  }

  // The history to be drawn: at least a row.
  take(run) {
    this.rows = run.history;
    this.stages = run.stages || [];
    this.starts = new Set(this.stages.map(stage => stage.first_generation));
    this.failures = this.rows.some(row => row.failures > 0);
    this.series = SERIES.filter(series => this.rows.some(row => this.usable((series.value || series.low)(row))))
      .map(series => run.summary?.judged && series.kind === "best-so-far" ? { ...series, name: "champion, in rapier" } : series);
    this.buildLegend();
  }

  // Another history, of a run that goes on.
  update(run) {
    this.take(run);
    // What was picked stays so, however the history is thinned by now.
    if (this.picked !== null) {
      const index = this.rows.findIndex(row => row.generation >= this.wanted);
      this.picked = index < 0 ? this.rows.length - 1 : index;
    }
    this.width = 0;
    this.place.setAttribute("aria-valuemin", this.rows[0].generation);
    this.place.setAttribute("aria-valuemax", this.rows[this.rows.length - 1].generation);
    this.build();
  }

  buildLegend() {
    const legend = document.getElementById("fitness-legend");
    legend.replaceChildren();
    this.values = [];
    this.generationLabel = document.createElement("div");
    this.generationLabel.className = "legend-generation";
    legend.append(this.generationLabel);
    const entries = [...this.series];
    if (this.failures) entries.push({ name: "failed", kind: "failed" });
    for (const series of entries) {
      const entry = document.createElement("div");
      entry.className = "legend-entry";
      const swatch = document.createElement("i");
      swatch.className = `swatch swatch-${series.kind}`;
      const name = document.createElement("span");
      name.textContent = series.name;
      const value = document.createElement("b");
      entry.append(swatch, name, value);
      legend.append(entry);
      this.values.push({ series, value });
    }
  }

  // The range of the fitness axis. Mean and worst may be dragged far down by one bad individual; they are clipped.
  range() {
    let low = Infinity, high = -Infinity;
    for (const row of this.rows) {
      for (const value of [row.best_so_far, row.best, row.median, row.quantiles?.q10, row.quantiles?.q90]) {
        if (!this.usable(value)) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    if (!Number.isFinite(low)) return [0, 1];
    if (low > 0 && low < high * 0.5) low = 0;
    if (high < 0 && high > low * 0.5) high = 0;
    if (high - low < 1e-9) { low -= 0.5; high += 0.5; }
    const margin = (high - low) * 0.04;
    return [low === 0 ? 0 : low - margin, high === 0 ? 0 : high + margin];
  }

  build() {
    const width = Math.round(this.place.clientWidth);
    if (width < 40 || width === this.width) return;
    this.width = width;
    const narrow = width < 560;
    const failing = this.failures ? 46 : 0;
    const height = (narrow ? 250 : 340) + failing;
    const box = { left: narrow ? 38 : 52, right: width - 16, top: 22, bottom: height - 42 - failing };
    this.box = box;
    const [low, high] = this.range();
    const first = this.rows[0].generation;
    const last = this.rows[this.rows.length - 1].generation;
    const x = generation => last === first ? (box.left + box.right) / 2
      : box.left + (generation - first) / (last - first) * (box.right - box.left);
    const y = value => box.bottom - (value - low) / (high - low) * (box.bottom - box.top);
    Object.assign(this, { x, y, first, last });

    this.place.replaceChildren();
    const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, "aria-hidden": "true" }, this.place);
    const clip = svg("clipPath", { id: "fitness-clip" }, svg("defs", {}, root));
    svg("rect", { x: box.left - 4, y: box.top - 6, width: box.right - box.left + 8, height: box.bottom - box.top + 6 }, clip);
    this.drawAxes(root, low, high, height, narrow);
    const plot = svg("g", { "clip-path": "url(#fitness-clip)" }, root);
    for (const series of [...this.series].reverse()) this.drawSeries(plot, series);
    this.drawStages(root);
    if (this.failures) this.drawFailures(root, height);
    this.cross = svg("g", { class: "cross" }, root);
    this.pick(this.picked ?? this.rows.length - 1, this.picked !== null, this.wanted);
  }

  drawAxes(root, low, high, height, narrow) {
    const { box, x, y } = this;
    const vertical = niceTicks(low, high, narrow ? 4 : 6);
    const decimals = Math.max(0, -Math.floor(Math.log10(vertical.step) + 1e-9));
    for (const tick of vertical.ticks) {
      svg("line", { class: Math.abs(tick) < 1e-9 ? "zero" : "grid", x1: box.left, x2: box.right, y1: y(tick), y2: y(tick) }, root);
      svg("text", { class: "tick", x: box.left - 8, y: y(tick) + 4, "text-anchor": "end" }, root).textContent = fixed(tick, decimals);
    }
    svg("text", { class: "axis", x: 0, y: 11 }, root).textContent = this.unit ? `fitness, ${this.unit}` : "fitness";
    drawGenerations(root, this.rows, box, x, narrow);
  }

  drawSeries(plot, series) {
    const { x, y, usable } = this;
    if (series.low) {
      const rows = this.rows.filter(row => usable(series.low(row)) && usable(series.high(row)));
      const up = rows.map(row => `${x(row.generation).toFixed(1)},${y(series.high(row)).toFixed(1)}`);
      const down = rows.map(row => `${x(row.generation).toFixed(1)},${y(series.low(row)).toFixed(1)}`).reverse();
      svg("polygon", { class: `band band-${series.kind}`, points: [...up, ...down].join(" ") }, plot);
      return;
    }
    let path = "";
    let gap = true;
    for (const row of this.rows) {
      const value = series.value(row);
      // What a stage is worth says nothing of the next.
      if (this.starts.has(row.generation)) gap = true;
      if (!usable(value)) { gap = true; continue; }
      const px = x(row.generation).toFixed(1);
      const py = y(value).toFixed(1);
      path += gap ? `M${px} ${py}` : series.kind === "best-so-far" ? `H${px}V${py}` : `L${px} ${py}`;
      gap = false;
    }
    svg("path", { class: `curve curve-${series.kind}`, d: path }, plot);
    if (this.rows.length === 1 && usable(series.value(this.rows[0]))) {
      svg("circle", { class: `dot dot-${series.kind}`, cx: x(this.first), cy: y(series.value(this.rows[0])), r: 4 }, plot);
    }
  }

  // A line where each stage begins, with its name.
  drawStages(root) {
    const { box, x } = this;
    let free = -Infinity;
    for (const stage of this.stages) {
      if (stage.last_generation < stage.first_generation) continue;
      const px = x(stage.first_generation);
      svg("line", { class: "stage-mark", x1: px, x2: px, y1: box.top - 6, y2: box.bottom }, root);
      // A name that would stand on the one before goes a line lower.
      const lower = px < free ? 14 : 0;
      if (!lower) free = px + 8 + 7.5 * stage.name.length;
      svg("text", { class: "stage-name", x: px + 4, y: box.top + 4 + lower }, root).textContent = stage.name;
    }
  }

  // Failed evaluations as bars on a line of their own under the axis.
  drawFailures(root, height) {
    const { box, x } = this;
    const most = this.rows.reduce((most, row) => Math.max(most, row.failures || 0), 0);
    const base = height - 2;
    svg("text", { class: "axis", x: box.left, y: base - 24 }, root).textContent = `failed evaluations (at most ${most} a generation)`;
    const wide = Math.max(1.2, Math.min(6, (box.right - box.left) / this.rows.length * 0.7));
    // One shape for all: there may be hundreds.
    const bars = this.rows.filter(row => row.failures).map(row => {
      const tall = Math.max(2, 18 * row.failures / most);
      return `M${(x(row.generation) - wide / 2).toFixed(1)} ${base}v${-tall.toFixed(1)}h${wide.toFixed(1)}v${tall.toFixed(1)}z`;
    });
    svg("path", { class: "failed", d: bars.join("") }, root);
    svg("line", { class: "grid", x1: box.left, x2: box.right, y1: base, y2: base }, root);
  }

  // Shows the values of one generation; `chosen` draws the crosshair as well.
  pick(index, chosen, wanted) {
    const row = this.rows[Math.min(Math.max(index, 0), this.rows.length - 1)];
    this.wanted = wanted ?? row.generation;
    this.picked = chosen ? this.rows.indexOf(row) : null;
    this.cross.replaceChildren();
    if (chosen) {
      const px = this.x(row.generation);
      svg("line", { x1: px, x2: px, y1: this.box.top - 6, y2: this.box.bottom }, this.cross);
      for (const series of this.series) {
        if (!series.value || !this.usable(series.value(row))) continue;
        const py = this.y(series.value(row));
        if (py <= this.box.bottom + 1) svg("circle", { class: `dot dot-${series.kind}`, cx: px, cy: py, r: 3.5 }, this.cross);
      }
    }
    this.generationLabel.textContent = `generation ${fixed(row.generation, 0)}`;
    for (const { series, value } of this.values) {
      value.textContent = series.kind === "failed" ? `${row.failures || 0}${row.evaluations ? ` of ${row.evaluations}` : ""}`
        : series.low ? `${tidy(series.low(row) ?? NaN)} to ${tidy(series.high(row) ?? NaN)}` : tidy(series.value(row) ?? NaN);
    }
    this.place.setAttribute("aria-valuenow", row.generation);
    this.place.setAttribute("aria-valuetext", `generation ${row.generation}: best ${withUnit(row.best ?? NaN, this.unit)}, `
      + `median ${withUnit(row.median ?? NaN, this.unit)}`);
  }

  listen() {
    this.listening = new AbortController();
    const { signal } = this.listening;
    const nearest = event => {
      this.pick(nearestRow(this.rows, this.x, event.clientX - this.place.getBoundingClientRect().left), true);
    };
    this.place.addEventListener("pointermove", nearest, { signal });
    this.place.addEventListener("pointerdown", nearest, { signal });
    this.place.addEventListener("pointerleave", event => {
      if (event.pointerType === "mouse") this.pick(this.rows.length - 1, false);
    }, { signal });
    this.place.addEventListener("keydown", event => {
      const to = rowForKey(event.key, this.picked ?? this.rows.length - 1, this.rows);
      if (to === undefined) return;
      event.preventDefault();
      this.pick(to, true);
    }, { signal });
  }
}
