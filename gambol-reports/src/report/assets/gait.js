// The gait of the champion: whether it is usable and why not, what was measured, and a footfall diagram after
// Hildebrand: a row a leg, a bar while its foot stands.

const percent = share => `${fixed(100 * share, 0)}\u00a0%`;

function buildGait(run) {
  const gait = run.gait;
  if (!gait) return;
  document.getElementById("gait").hidden = false;
  document.getElementById("gait-intro").textContent = `Measured in rapier over ${tidy(gait.duration_s)} s from the settled start pose, without variation.`;
  buildVerdict(gait);
  terms(document.getElementById("gait-facts"), gaitFacts(gait));
  buildSheet(gait.sheet);
  // A swimmer has no ground to stand on.
  const legs = gait.legs.some(leg => leg.footfalls > 0 || leg.duty_factor > 0) ? gait.legs : [];
  if (legs.length) buildTable("gait-legs", ["Leg", "Footfalls", "Stands", "Slip", "Longest pause"], legs.map(leg => [
    leg.foot, fixed(leg.footfalls, 0), percent(leg.duty_factor), slipOf(leg),
    withUnit(Math.max(leg.longest_without_touchdown_s, leg.longest_without_liftoff_s), "s")]));
  buildTable("gait-joints", ["Joint", "Range", "Swings at", "By", "Turns back"], gait.joints.map(joint => [
    joint.actuated ? joint.name : `${joint.name} (passive)`, `${fixed(joint.range_deg, 0)}°`,
    withUnit(joint.dominant_frequency_hz, "Hz"), `±\u00a0${fixed(joint.dominant_amplitude_deg, 0)}°`,
    withUnit(joint.reversals_per_s, "/s")]));
  if (legs.length) new FootfallDiagram(gait, document.getElementById("gait-footfalls"));
}

// The contact sheet fits the page; a click shows it in full size, and the next one fits it again.
function buildSheet(sheet) {
  if (!sheet) return;
  const figure = document.getElementById("gait-sheet");
  figure.hidden = false;
  figure.querySelector("img").src = sheet;
  const button = figure.querySelector("button");
  button.addEventListener("click", () => button.setAttribute("aria-pressed", String(figure.classList.toggle("full"))));
}

function buildVerdict(gait) {
  const verdict = document.getElementById("gait-verdict");
  const usable = gait.verdict?.usable;
  verdict.textContent = usable === undefined ? "Not judged" : usable ? "Usable" : "Not usable";
  verdict.classList.add(usable === undefined ? "verdict-none" : usable ? "verdict-good" : "verdict-bad");
  const note = usable === undefined ? "Gaits of this movement are not judged." : usable ? "Nothing speaks against it, and no cheat was flagged." : "";
  document.getElementById("gait-note").textContent = note;
  const against = usable === undefined ? gait.flagged : gait.against;
  const list = document.getElementById("gait-against");
  list.hidden = !against.length;
  list.append(...against.map(text => element("li", text)));
}

function gaitFacts({ obstacles, travel, torso, aloft, rhythm, duration_s, cheats, aloft: { flights }, verdict }) {
  const known = value => value !== null && value !== undefined;
  const facts = [
    ["Distance", `${withUnit(travel.distance_m, "m")} in ${withUnit(duration_s, "s")}`],
    ["Speed", withUnit(travel.speed_m_per_s, "m/s")],
    ["Speed, second half", `${withUnit(travel.second_half_speed_body_lengths_per_s, "body lengths/s")}`],
    ["Cost of transport", known(travel.cost_of_transport) ? tidy(travel.cost_of_transport) : "–"],
    ["Largest tilt of the torso", `${fixed(torso.largest_tilt_deg, 0)}° at ${withUnit(torso.largest_tilt_at_s, "s")}`],
    ["Rollovers", fixed(torso.rollovers, 0)],
    ["Off the ground", `${percent(aloft.share)} of the time`],
    ["Longest flight", withUnit(aloft.longest_s, "s")],
    ["Stride", known(rhythm.stride_time_s) ? `${withUnit(rhythm.stride_time_s, "s")}, ${withUnit(rhythm.progress_per_stride_m, "m")}` : "–"],
    ["Regularity", percent(rhythm.strength)],
    ["Cheats flagged", cheats.length ? fixed(cheats.length, 0) : "none"],
  ];
  const best = flights[verdict?.best_flight];
  for (const [what, share] of obstacles) facts.push([what[0].toUpperCase() + what.slice(1), share]);
  if (best) facts.unshift(["Best jump", `${withUnit(best.rise_m, "m")} high, ${withUnit(best.to_s - best.from_s, "s")} in the air`]);
  return facts;
}

function slipOf(leg) {
  return leg.slip_per_distance === null ? withUnit(leg.slip_m, "m") : withUnit(leg.slip_per_distance, "m/m");
}

function buildTable(id, header, rows) {
  const table = document.getElementById(id);
  if (!rows.length) return;
  table.parentElement.hidden = false;
  const head = element("tr");
  head.append(...header.map(text => element("th", text)));
  for (const cell of head.children) cell.scope = "col";
  const body = rows.map(([name, ...values]) => {
    const row = element("tr");
    const heading = element("th", name);
    heading.scope = "row";
    row.append(heading, ...values.map(value => element("td", value)));
    return row;
  });
  const top = element("thead");
  top.append(head);
  const rest = element("tbody");
  rest.append(...body);
  table.append(top, rest);
}

const FOOTFALL_ROW = 22;

class FootfallDiagram {
  constructor(gait, figure) {
    this.gait = gait;
    this.rows = gait.legs.map(leg => ({ name: leg.foot, spans: leg.stances, kind: "stance" }));
    this.rows.push({ name: "in the air", spans: gait.aloft.flights, kind: "flight", best: gait.verdict?.best_flight });
    figure.hidden = false;
    this.place = figure.querySelector("div");
    const { from_s: from, to_s: to } = gait.window;
    figure.querySelector(".quiet").textContent = from > 0
      ? `a bar while the foot stands; shaded: ${tidy(from)} to ${tidy(to)} s, where speed and rhythm are judged`
      : "a bar while the foot stands; all of it is judged, the best flight is drawn strong";
    new ResizeObserver(() => this.draw()).observe(this.place);
  }

  // Where there is little room, time goes on in a second band below the first, and if need be in a third and fourth.
  draw() {
    const width = Math.max(this.place.clientWidth, 120);
    if (width === this.width) return;
    this.width = width;
    const left = width < 560 ? 84 : 130;
    const room = width - 14 - left;
    const duration = this.gait.duration_s;
    const bands = [1, 2, 4].find(bands => room * bands / duration >= 22) ?? 4;
    const height = this.rows.length * FOOTFALL_ROW + 30;
    const root = svg("svg", { width, height: height * bands, viewBox: `0 0 ${width} ${height * bands}`, role: "img" });
    root.setAttribute("aria-label", "Footfall diagram: a row a leg, a bar while its foot stands, and a row for flights");
    for (let band = 0; band < bands; band++) {
      const group = svg("g", { transform: `translate(0 ${band * height})` }, root);
      this.drawBand(group, left, room, band * duration / bands, (band + 1) * duration / bands);
    }
    this.place.replaceChildren(root);
  }

  drawBand(root, left, room, first, last) {
    const bottom = this.rows.length * FOOTFALL_ROW + 4;
    const x = time => left + (Math.min(Math.max(time, first), last) - first) / (last - first) * room;
    const { from_s: from, to_s: to } = this.gait.window;
    if (from < last) svg("rect", { class: "judged", x: x(from), y: 0, width: x(to) - x(from), height: bottom }, root);
    this.rows.forEach((row, i) => {
      const y = i * FOOTFALL_ROW + 13;
      this.drawName(root, row.name, left - 10, y);
      svg("line", { class: "grid", x1: left, x2: left + room, y1: y, y2: y }, root);
      row.spans.forEach((span, index) => {
        if (span.to_s <= first || span.from_s >= last) return;
        const strong = row.kind === "stance" || index === row.best;
        svg("rect", { class: row.kind + (strong ? "" : " pale"), x: x(span.from_s), y: y - 6, height: 12, rx: 1.5,
          width: Math.max(x(span.to_s) - x(span.from_s), 0.8) }, root);
      });
    });
    for (const tick of niceTicks(first, last, room / 70).ticks) {
      svg("line", { class: "mark", x1: x(tick), x2: x(tick), y1: bottom, y2: bottom + 5 }, root);
      svg("text", { x: x(tick), y: bottom + 19, "text-anchor": "middle" }, root).textContent = `${+tick.toFixed(2)} s`;
    }
  }

  // A long name is pressed together rather than cut.
  drawName(root, name, room, y) {
    const text = svg("text", { x: 0, y: y + 4 }, root);
    text.textContent = name;
    if (name.length * 6.5 > room) {
      text.setAttribute("textLength", room);
      text.setAttribute("lengthAdjust", "spacingAndGlyphs");
    }
  }
}
