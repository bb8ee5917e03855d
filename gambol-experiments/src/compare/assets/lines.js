// Lines with bands over a common x axis, and a crosshair that mouse, finger and arrow keys can move. The legend above the
// chart doubles as the readout.

// What the x axis is written in, by its largest value: [factor, name].
function axisScale(axis, most) {
  if (axis === "seconds") return most >= 7200 ? [3600, "hours"] : most >= 300 ? [60, "minutes"] : [1, "seconds"];
  const name = axis === "steps" ? "physics steps" : axis;
  return most >= 2e6 ? [1e6, `million ${name}`] : [1, name];
}

class LineChart {
  // `label`: what a screen reader says. `options`: height, stepped (the line holds its value until the next point), low
  // and high of the y axis if they are fixed, named (names at the ends of the lines), rest (the share of the x axis that
  // the readout is of while the user points at no other; otherwise where scores are compared).
  constructor(label, options) {
    this.options = options;
    this.root = element("div");
    this.legend = element("div", undefined, "legend");
    this.place = element("div", undefined, "chart");
    this.root.append(this.legend, this.place);
    this.place.tabIndex = 0;
    this.place.setAttribute("role", "slider");
    this.place.setAttribute("aria-label", `${label}; arrow keys choose a place`);
    this.listen();
    new ResizeObserver(() => this.build()).observe(this.place);
  }

  // `data`: x, xName, xFactor, yName, mark (an x with a line through it) and series of { name, method, middle, lower,
  // upper }, an array each with null where there is nothing.
  show(data) {
    this.data = data;
    this.width = null;
    this.picked = null;
    this.rest = this.options.rest === undefined ? this.lastCompared() : Math.round(this.options.rest * (data.x.length - 1));
    const all = data.series.flatMap(series => [...series.middle, ...series.lower, ...series.upper]).filter(v => v !== null);
    this.decimals = decimalsOf(all);
    this.place.setAttribute("aria-valuemin", 0);
    this.place.setAttribute("aria-valuemax", data.x.length - 1);
    this.buildLegend();
    this.range(all);
    this.build();
  }

  range(values) {
    let { low, high } = this.options;
    if (low === undefined) {
      low = Math.min(...values, Infinity);
      high = Math.max(...values, -Infinity);
      if (!Number.isFinite(low)) [low, high] = [0, 1];
      if (low > 0 && low < high * 0.5) low = 0;
      if (high - low < 1e-9) { low -= 0.5; high += 0.5; }
      const margin = (high - low) * 0.04;
      [low, high] = [low === 0 ? 0 : low - margin, high + margin];
    }
    Object.assign(this, { low, high });
  }

  // Where the readout rests: the last place at which scores are compared and every series that has values has one.
  lastCompared() {
    const { x, mark, series } = this.data;
    const drawn = series.filter(({ middle }) => middle.some(value => value !== null));
    for (let place = x.length - 1; place > 0; place--) {
      if ((mark === null || x[place] <= mark) && drawn.every(({ middle }) => middle[place] !== null)) return place;
    }
    return x.length - 1;
  }

  buildLegend() {
    this.legend.replaceChildren();
    this.where = element("div", "", "legend-generation");
    this.legend.append(this.where);
    this.values = this.data.series.map(series => {
      const entry = element("div", undefined, `legend-entry ${methodClass(series.method)}`);
      const value = element("b");
      entry.append(element("i", undefined, "swatch"), element("span", series.name), value);
      this.legend.append(entry);
      return value;
    });
  }

  build() {
    const width = Math.round(this.place.clientWidth);
    if (!this.data || width < 40 || width === this.width) return;
    this.width = width;
    const { data } = this;
    const narrow = width < 560;
    const height = narrow ? 250 : this.options.height;
    const longest = Math.max(...data.series.map(series => series.name.length));
    const named = this.options.named && !narrow;
    const names = named ? Math.min(140, 22 + longest * 7) : 26;
    const ticks = niceTicks(this.low, this.high, narrow ? 5 : 6);
    const decimals = Math.max(0, -Math.floor(Math.log10(ticks.step) + 1e-9));
    const widest = Math.max(...ticks.ticks.map(tick => fixed(tick, decimals).length));
    const box = { left: 14 + widest * 7, right: width - names, top: 24, bottom: height - 42 };
    const last = data.x[data.x.length - 1] || 1;
    this.x = value => box.left + value / last * (box.right - box.left);
    this.y = value => box.bottom - (value - this.low) / (this.high - this.low) * (box.bottom - box.top);
    this.box = box;
    this.place.replaceChildren();
    const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, "aria-hidden": "true" }, this.place);
    for (const tick of ticks.ticks) {
      svg("line", { class: Math.abs(tick) < 1e-9 ? "zero" : "grid", x1: box.left, x2: box.right, y1: this.y(tick), y2: this.y(tick) }, root);
      svg("text", { x: box.left - 8, y: this.y(tick) + 4, "text-anchor": "end" }, root).textContent = fixed(tick, decimals);
    }
    svg("text", { x: 0, y: 11 }, root).textContent = data.yName;
    this.drawX(root, last, narrow);
    for (const series of data.series) this.drawBand(root, series);
    for (const series of data.series) this.drawLine(root, series);
    if (named) this.drawNames(root);
    this.cross = svg("g", { class: "cross" }, root);
    this.pick(this.picked ?? this.rest, this.picked !== null);
  }

  drawX(root, last, narrow) {
    const { box, data } = this;
    const { ticks, step } = niceTicks(0, last / data.xFactor, narrow ? 4 : 8);
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    for (const tick of ticks) {
      const px = this.x(tick * data.xFactor);
      svg("line", { class: "mark", x1: px, x2: px, y1: box.bottom, y2: box.bottom + 5 }, root);
      svg("text", { x: px, y: box.bottom + 19, "text-anchor": "middle" }, root).textContent = fixed(tick, decimals);
    }
    svg("text", { x: box.right, y: box.bottom + 37, "text-anchor": "end" }, root).textContent = data.xName;
    if (data.mark !== null) {
      const px = this.x(data.mark);
      svg("line", { class: "limit", x1: px, x2: px, y1: box.top - 8, y2: box.bottom }, root);
      svg("text", { x: Math.min(px + 4, box.right), y: 11, "text-anchor": "end" }, root).textContent = "compared here";
    }
  }

  // Runs of neighbouring points at which all of `columns` have a value, as lists of places.
  pieces(columns) {
    const pieces = [[]];
    this.data.x.forEach((_, place) => {
      if (columns.every(column => column[place] !== null)) pieces[pieces.length - 1].push(place);
      else if (pieces[pieces.length - 1].length) pieces.push([]);
    });
    return pieces.filter(piece => piece.length);
  }

  // The points of a line, with its corners if it is stepped.
  corners(piece, column) {
    const points = [];
    piece.forEach((place, i) => {
      const [px, py] = [this.x(this.data.x[place]), this.y(column[place])];
      if (i && this.options.stepped) points.push([px, points[points.length - 1][1]]);
      points.push([px, py]);
    });
    return points.map(([px, py]) => `${px.toFixed(1)},${py.toFixed(1)}`);
  }

  drawBand(root, { method, lower, upper }) {
    for (const piece of this.pieces([lower, upper])) {
      const points = [...this.corners(piece, upper), ...this.corners(piece, lower).reverse()];
      svg("polygon", { class: `band ${methodClass(method)}`, points: points.join(" ") }, root);
    }
  }

  drawLine(root, { method, middle }) {
    for (const piece of this.pieces([middle])) {
      svg("path", { class: `line ${methodClass(method)}`, d: `M${this.corners(piece, middle).join("L")}` }, root);
    }
  }

  // Names at the ends of the lines, moved apart where they would lie on each other.
  drawNames(root) {
    const { data, box } = this;
    const names = data.series.map(series => {
      const place = this.pieces([series.middle]).flat().pop();
      return place === undefined ? null : { series, y: this.y(series.middle[place]) + 4 };
    }).filter(Boolean).sort((a, b) => a.y - b.y);
    names.forEach((name, i) => { if (i) name.y = Math.max(name.y, names[i - 1].y + 15); });
    for (let i = names.length - 1, most = box.bottom + 4; i >= 0; i--, most -= 15) names[i].y = Math.min(names[i].y, most);
    for (const { series, y } of names) {
      svg("text", { class: `label ${methodClass(series.method)}`, x: box.right + 8, y }, root).textContent = series.name;
    }
  }

  pick(place, chosen) {
    const { data, box } = this;
    const at = Math.min(Math.max(place, 0), data.x.length - 1);
    this.picked = chosen ? at : null;
    this.cross.replaceChildren();
    if (chosen) {
      const px = this.x(data.x[at]);
      svg("line", { x1: px, x2: px, y1: box.top - 6, y2: box.bottom }, this.cross);
      for (const series of data.series) {
        if (series.middle[at] === null) continue;
        svg("circle", { class: `point ${methodClass(series.method)}`, cx: px, cy: this.y(series.middle[at]), r: 4 }, this.cross);
      }
    }
    const x = data.x[at] / data.xFactor;
    this.where.textContent = `${data.xName} ${data.xFactor === 1 && x >= 100 ? fixed(x, 0) : fixed(x, 2)}`;
    const texts = data.series.map(({ middle, lower, upper }) => middle[at] === null ? "–" : fixed(middle[at], this.decimals)
      + (lower[at] === null ? "" : ` (${fixed(lower[at], this.decimals)} to ${fixed(upper[at], this.decimals)})`));
    texts.forEach((text, i) => { this.values[i].textContent = text; });
    this.place.setAttribute("aria-valuenow", at);
    this.place.setAttribute("aria-valuetext",
      `${this.where.textContent}: ${data.series.map((series, i) => `${series.name} ${texts[i]}`).join(", ")}`);
  }

  listen() {
    const nearest = event => {
      if (!this.data) return;
      const px = event.clientX - this.place.getBoundingClientRect().left;
      const share = (px - this.box.left) / (this.box.right - this.box.left);
      this.pick(Math.round(share * (this.data.x.length - 1)), true);
    };
    this.place.addEventListener("pointermove", nearest);
    this.place.addEventListener("pointerdown", nearest);
    this.place.addEventListener("pointerleave", event => {
      if (event.pointerType === "mouse") this.pick(this.rest, false);
    });
    this.place.addEventListener("keydown", event => {
      const end = this.data.x.length - 1;
      const now = this.picked ?? this.rest;
      const to = { ArrowLeft: now - 1, ArrowDown: now - 1, ArrowRight: now + 1, ArrowUp: now + 1,
        PageUp: now + 10, PageDown: now - 10, Home: 0, End: end }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      this.pick(to, true);
    });
  }
}
