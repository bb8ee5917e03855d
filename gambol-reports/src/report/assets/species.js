// The species of a run, stacked: how many members each had in each generation. The oldest lie at the bottom.

// How many colours the style sheet has for species.
const SPECIES_COLOURS = 8;

// A colour for each species, from what was there at its birth alone, so that a longer run keeps them: one that no living
// species has, if there is one, and of those the one given away longest ago.
function speciesColours(species) {
  const given = new Array(SPECIES_COLOURS).fill(-1);
  const colours = [];
  species.forEach((born, i) => {
    const taken = new Set(species.slice(0, i).map((other, k) => [other, colours[k]])
      .filter(([other]) => other.start + other.sizes.length >= born.start).map(([, colour]) => colour));
    const all = given.map((_, colour) => colour);
    const free = taken.size < SPECIES_COLOURS ? all.filter(colour => !taken.has(colour)) : all;
    const colour = free.reduce((best, other) => given[other] < given[best] ? other : best);
    given[colour] = i;
    colours.push(colour);
  });
  return colours;
}

class SpeciesChart {
  constructor(run) {
    this.rows = run.history;
    this.unit = run.unit;
    this.species = run.species;
    this.colours = speciesColours(this.species);
    this.stackUp();
    this.picked = null;
    this.place = document.getElementById("species-chart");
    this.tip = element("div", undefined, "tip");
    this.tip.hidden = true;
    this.tip.setAttribute("aria-hidden", "true");
    makeSlider(this.place, this.rows, "Species over generations; left and right choose a generation, up and down a species");
    this.listen();
    new ResizeObserver(() => this.build()).observe(this.place);
    this.build();
  }

  size(k, row) { return this.species[k].sizes[row - this.species[k].start] ?? 0; }

  // For each row, where the layer of each species begins and where the whole stack ends.
  stackUp() {
    this.below = this.rows.map((_, row) => {
      const below = [0];
      this.species.forEach((_, k) => below.push(below[k] + this.size(k, row)));
      return below;
    });
    this.total = row => this.below[row][this.species.length];
    this.most = extremes(this.rows.map((_, row) => this.total(row)))[1];
  }

  build() {
    const width = Math.round(this.place.clientWidth);
    if (width < 40 || width === this.width) return;
    this.width = width;
    const narrow = width < 560;
    const height = narrow ? 230 : 300;
    const box = { left: narrow ? 38 : 52, right: width - 16, top: 22, bottom: height - 42 };
    const [first, last] = [this.rows[0].generation, this.rows[this.rows.length - 1].generation];
    const x = generation => last === first ? (box.left + box.right) / 2
      : box.left + (generation - first) / (last - first) * (box.right - box.left);
    const y = members => box.bottom - members / this.most * (box.bottom - box.top);
    Object.assign(this, { height, box, x, y });
    this.place.replaceChildren();
    const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, "aria-hidden": "true" }, this.place);
    this.place.append(this.tip);
    svg("text", { class: "axis", x: 0, y: 11 }, root).textContent = "members of each species";
    for (const tick of niceTicks(0, this.most, narrow ? 3 : 5).ticks.filter(Number.isInteger)) {
      svg("line", { class: "grid", x1: box.left, x2: box.right, y1: y(tick), y2: y(tick) }, root);
      svg("text", { class: "tick", x: box.left - 8, y: y(tick) + 4, "text-anchor": "end" }, root).textContent = fixed(tick, 0);
    }
    const plot = svg("g", {}, root);
    this.layers = this.species.map((_, k) => this.drawLayer(plot, k));
    this.species.forEach((_, k) => this.drawName(plot, k));
    drawGenerations(root, this.rows, box, x, narrow);
    this.cross = svg("g", { class: "cross" }, root);
    this.pick(this.picked);
  }

  // A species grows out of nothing in the generation before its first, and shrinks to nothing after its last.
  drawLayer(plot, k) {
    const { start, sizes } = this.species[k];
    const { x, y, rows, box } = this;
    const edge = layer => {
      if (rows.length === 1) return [box.left, box.right].map(px => `${px},${y(this.below[0][layer]).toFixed(1)}`);
      const points = [];
      for (let row = Math.max(start - 1, 0); row <= Math.min(start + sizes.length, rows.length - 1); row++) {
        points.push(`${x(rows[row].generation).toFixed(1)},${y(this.below[row][layer]).toFixed(1)}`);
      }
      return points;
    };
    const points = [...edge(k), ...edge(k + 1).reverse()].join(" ");
    return svg("polygon", { class: `species species-${this.colours[k]}`, points }, plot);
  }

  // The species' number where its layer is thick and long enough.
  drawName(plot, k) {
    const { id, start, sizes } = this.species[k];
    const { x, y, rows, below } = this;
    const text = String(id);
    const reach = rows.length === 1 ? 0 : Math.ceil((5 + 4 * text.length) / (x(rows[1].generation) - x(rows[0].generation)));
    let best = null;
    for (let row = start + reach; row + reach < start + sizes.length; row++) {
      // The band that is free of other species from the name's left end to its right.
      const rowsCovered = Array.from({ length: 2 * reach + 1 }, (_, i) => row - reach + i);
      const floor = Math.min(...rowsCovered.map(r => y(below[r][k])));
      const ceiling = Math.max(...rowsCovered.map(r => y(below[r][k + 1])));
      if (floor - ceiling >= 15 && (!best || floor - ceiling > best.room)) best = { row, room: floor - ceiling, y: (floor + ceiling) / 2 };
    }
    if (best) svg("text", { class: "species-name", x: x(rows[best.row].generation), y: best.y + 4, "text-anchor": "middle" }, plot).textContent = text;
  }

  // Shows a species in a generation, as `{ row, k }`; null shows none.
  pick(picked) {
    this.picked = picked;
    this.cross.replaceChildren();
    this.layers.forEach((layer, k) => layer.classList.toggle("faded", picked !== null && picked.k !== k));
    this.tip.hidden = picked === null;
    const row = picked?.row ?? this.rows.length - 1;
    const alive = this.species.filter((_, k) => this.size(k, row) > 0).length;
    this.place.setAttribute("aria-valuenow", this.rows[row].generation);
    this.place.setAttribute("aria-valuetext", `generation ${this.rows[row].generation}: ${count(alive, "species", "species")}`);
    if (!picked) return;
    const { k } = picked;
    const px = this.x(this.rows[row].generation);
    svg("line", { x1: px, x2: px, y1: this.box.top - 6, y2: this.box.bottom }, this.cross);
    const { id, start, sizes, best } = this.species[k];
    const fitness = best[row - start];
    const [from, to] = [start, start + sizes.length - 1].map(at => fixed(this.rows[at].generation, 0));
    const lines = [
      `${fixed(this.size(k, row), 0)} of ${count(this.total(row), "member", "members")} in generation ${fixed(this.rows[row].generation, 0)}`,
      fitness === null || fitness === undefined ? "all its evaluations failed" : `best ${withUnit(fitness, this.unit)}`,
      from === to ? `lived in generation ${from} alone` : `lived in generations ${from} to ${to}`,
    ];
    const title = element("b", `species ${id}`);
    title.prepend(element("i", undefined, `species-swatch species-${this.colours[k]}`));
    this.tip.replaceChildren(title, ...lines.map(line => element("div", line)));
    this.place.setAttribute("aria-valuetext", `species ${id}: ${lines.join(", ")}`);
    // Beside the line, on the side with more room, and away from the layer. On narrow screens the style sheet puts it
    // below the chart.
    const onLeft = px > this.width / 2;
    const isHigh = this.below[row][k] + this.size(k, row) / 2 > this.most / 2;
    Object.assign(this.tip.style, {
      left: onLeft ? "" : `${px + 12}px`, right: onLeft ? `${this.width - px + 12}px` : "",
      top: isHigh ? "" : `${this.box.top + 6}px`, bottom: isHigh ? `${this.height - this.box.bottom + 6}px` : "",
    });
  }

  // The species whose layer lies at a height; the closest if none does.
  speciesAt(row, py) {
    let found = null;
    this.species.forEach((_, k) => {
      if (!this.size(k, row)) return;
      const away = Math.max(this.y(this.below[row][k + 1]) - py, py - this.y(this.below[row][k]), 0);
      if (!found || away < found.away) found = { k, away };
    });
    return found && found.k;
  }

  listen() {
    const point = event => {
      const at = this.place.getBoundingClientRect();
      const row = nearestRow(this.rows, this.x, event.clientX - at.left);
      const k = this.speciesAt(row, event.clientY - at.top);
      this.pick(k === null ? null : { row, k });
    };
    this.place.addEventListener("pointermove", point);
    this.place.addEventListener("pointerdown", point);
    this.place.addEventListener("pointerleave", event => { if (event.pointerType === "mouse") this.pick(null); });
    this.place.addEventListener("blur", () => this.pick(null));
    this.place.addEventListener("keydown", event => {
      const vertical = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      let { row, k } = this.picked ?? { row: this.rows.length - 1, k: null };
      if (vertical && k !== null) {
        let next = k + vertical;
        while (this.species[next] && !this.size(next, row)) next += vertical;
        if (this.species[next]) k = next;
      } else {
        const to = vertical ? row : rowForKey(event.key, row, this.rows);
        if (to === undefined) return;
        row = Math.min(Math.max(to, 0), this.rows.length - 1);
        if (k === null || !this.size(k, row)) k = this.speciesAt(row, this.box.bottom);
      }
      event.preventDefault();
      this.pick(k === null ? null : { row, k });
    });
  }
}

function buildSpecies(run) {
  if (!run.species || !run.species.length) return;
  document.getElementById("species").hidden = false;
  const last = run.history.length - 1;
  const alive = run.species.filter(({ start, sizes }) => start + sizes.length - 1 === last).length;
  document.getElementById("species-intro").textContent = `${count(run.species.length, "species has", "species have")} lived, `
    + `${fixed(alive, 0)} of them in the last generation. Older ones lie lower; point at one to see its size and its best.`;
  new SpeciesChart(run);
}
