// A row for each method or pair: a point with its interval, or every run with its quartiles and median, on a common axis.

class RowChart {
  // `rows` of { name, method, value, interval, text, runs }: with `runs`, `interval` holds the quartiles and `value` the
  // median. `options`: label (for a screen reader), low, high, axis (the name below), ends (what the two sides mean),
  // reference (an x with a line through it).
  constructor(rows, options) {
    Object.assign(this, { rows, options });
    this.root = element("div", undefined, "chart rows");
    this.root.setAttribute("role", "img");
    this.root.setAttribute("aria-label", options.label);
    new ResizeObserver(() => this.build()).observe(this.root);
  }

  build() {
    const width = Math.round(this.root.clientWidth);
    if (width < 40 || width === this.width) return;
    this.width = width;
    const { rows, options } = this;
    const narrow = width < 560;
    const longest = of => Math.max(...rows.map(row => of(row).length));
    const tall = (rows[0].runs ? 34 : 30) + (narrow ? 16 : 0);
    const left = narrow ? 12 : Math.min(280, 20 + longest(row => row.name) * 7.4);
    const right = width - (narrow ? 12 : Math.min(220, 20 + longest(row => row.text) * 7));
    const top = options.ends ? 24 : 6;
    const bottom = top + rows.length * tall + 4;
    const height = bottom + 40;
    const x = value => left + (value - options.low) / (options.high - options.low) * (right - left);
    this.root.replaceChildren();
    const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, "aria-hidden": "true" }, this.root);
    const { ticks, step } = niceTicks(options.low, options.high, narrow ? 4 : 8);
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    for (const tick of ticks) {
      svg("line", { class: "grid", x1: x(tick), x2: x(tick), y1: top, y2: bottom }, root);
      svg("text", { x: x(tick), y: bottom + 17, "text-anchor": "middle" }, root).textContent = fixed(tick, decimals);
    }
    svg("text", { x: right, y: bottom + 35, "text-anchor": "end" }, root).textContent = options.axis;
    if (options.ends) {
      svg("text", { x: x(options.reference) - 10, y: 12, "text-anchor": "end" }, root).textContent = `← ${options.ends[0]}`;
      svg("text", { x: x(options.reference) + 10, y: 12 }, root).textContent = `${options.ends[1]} →`;
    }
    if (options.reference !== undefined) {
      svg("line", { class: "mark", x1: x(options.reference), x2: x(options.reference), y1: top - 4, y2: bottom }, root);
    }
    rows.forEach((row, i) => {
      const middle = top + (i + 0.5) * tall + (narrow ? 9 : 0);
      const words = narrow ? middle - tall / 2 + 6 : middle + 4.5;
      const group = svg("g", { class: methodClass(row.method) }, root);
      svg("text", { class: "name", x: 0, y: words }, group).textContent = row.name;
      svg("text", { class: "value", x: width, y: words, "text-anchor": "end" }, group).textContent = row.text;
      this.drawRow(group, row, x, middle);
    });
  }

  drawRow(group, row, x, middle) {
    if (row.value === null) return;
    if (row.interval) {
      svg("line", { class: "interval", x1: x(row.interval[0]), x2: x(row.interval[1]), y1: middle, y2: middle }, group);
    }
    if (!row.runs) {
      svg("circle", { class: "point", cx: x(row.value), cy: middle, r: 5.5 }, group);
      return;
    }
    // Neighbours a little above and below each other, so that equal runs are seen.
    row.runs.forEach((run, i) => {
      svg("circle", { class: "run", cx: x(run), cy: middle + (i % 3 - 1) * 4.5, r: 3.6 }, group);
    });
    svg("line", { class: "median", x1: x(row.value), x2: x(row.value), y1: middle - 10, y2: middle + 10 }, group);
  }
}
