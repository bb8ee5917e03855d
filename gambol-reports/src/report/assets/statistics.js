// What the strategy says of itself: a small curve for each of its numbers, all over the same generations.

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

// A number of any size with three significant digits.
function significant(value) {
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e6) return fixed(value, 0);
  if (size >= 1e6 || size < 1e-3) {
    const [digits, exponent] = value.toExponential(2).split("e");
    const raised = exponent.replace("+", "").replace("-", "⁻").replace(/\d/g, digit => SUPERSCRIPTS[digit]);
    return `${fixed(Number(digits), 2)} × 10${raised}`;
  }
  return fixed(value, Math.max(0, 2 - Math.floor(Math.log10(size))));
}

class StatisticsChart {
  constructor(run) {
    this.rows = run.history;
    this.place = document.getElementById("statistics-list");
    this.caption = document.getElementById("statistics-generation");
    this.tiles = run.statistics.map(statistic => this.buildTile(statistic));
    makeSlider(this.place, this.rows, "The strategy's numbers over generations; arrow keys choose a generation");
    this.listen();
    this.pick(null);
  }

  // Drawn in a box of 100 by 40 that is stretched to the tile.
  buildTile({ name, values }) {
    const known = values.filter(value => value !== null);
    const [low, high] = extremes(known);
    const x = row => this.rows.length > 1 ? row / (this.rows.length - 1) * 100 : 50;
    const y = value => high > low ? 38 - (value - low) / (high - low) * 36 : 20;
    const tile = element("div", undefined, "statistic");
    const heading = element("div", undefined, "statistic-heading");
    const value = element("b");
    heading.append(element("span", name.replaceAll("_", " ")), value);
    const root = svg("svg", { viewBox: "0 0 100 40", preserveAspectRatio: "none", "aria-hidden": "true" });
    let path = "";
    values.forEach((now, row) => {
      if (now === null) return;
      const begins = row === 0 || values[row - 1] === null;
      path += `${begins ? "M" : "L"}${x(row).toFixed(1)} ${y(now).toFixed(1)}`;
      // A line of no length is a dot, for a value without neighbours.
      if (begins && (values[row + 1] ?? null) === null) path += "h0";
    });
    svg("path", { class: "statistic-curve", d: path }, root);
    const line = svg("line", { class: "statistic-line", y1: 0, y2: 40 }, root);
    const range = high > low ? `from ${significant(low)} to ${significant(high)}` : "always the same";
    tile.append(heading, root, element("div", range, "statistic-range"));
    this.place.append(tile);
    return { values, value, line, x };
  }

  pick(row) {
    this.picked = row;
    const shown = row ?? this.rows.length - 1;
    const generation = fixed(this.rows[shown].generation, 0);
    this.caption.textContent = `generation ${generation}`;
    this.place.setAttribute("aria-valuenow", this.rows[shown].generation);
    this.place.setAttribute("aria-valuetext", `generation ${generation}`);
    for (const { values, value, line, x } of this.tiles) {
      value.textContent = values[shown] === null ? "–" : significant(values[shown]);
      line.setAttribute("x1", x(shown));
      line.setAttribute("x2", x(shown));
      line.setAttribute("visibility", row === null ? "hidden" : "visible");
    }
  }

  listen() {
    const point = event => {
      const tile = event.target.closest(".statistic");
      if (!tile) return;
      const box = tile.querySelector("svg").getBoundingClientRect();
      const share = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
      this.pick(Math.round(share * (this.rows.length - 1)));
    };
    this.place.addEventListener("pointermove", point);
    this.place.addEventListener("pointerdown", point);
    this.place.addEventListener("pointerleave", event => { if (event.pointerType === "mouse") this.pick(null); });
    this.place.addEventListener("keydown", event => {
      const to = rowForKey(event.key, this.picked ?? this.rows.length - 1, this.rows);
      if (to === undefined) return;
      event.preventDefault();
      this.pick(Math.min(Math.max(to, 0), this.rows.length - 1));
    });
  }
}

function buildStatistics(run) {
  if (!run.statistics || !run.statistics.length) return;
  document.getElementById("statistics").hidden = false;
  new StatisticsChart(run);
}
