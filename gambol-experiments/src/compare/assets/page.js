// The page: what it says at the top, its sections, and the start of it all.

const AXES = { evaluations: "evaluations", steps: "physics steps", seconds: "seconds" };

function standingsOf(run, axis) { return axis === "steps" ? run.at_equal_steps : run.at_equal_evaluations; }

function pairName(run, pair) { return `${run.methods[pair.first].name} – ${run.methods[pair.second].name}`; }

function buildHeading(run) {
  const names = run.methods.map(method => method.name);
  const heading = names.length > 4 ? `${names.length} methods compared` : names.length > 1 ? `${listed(names)} compared` : names.join("");
  document.getElementById("heading").textContent = heading.replaceAll("-", "\u2011");
  document.title = `${heading} · Gambol`;
  const budget = [["evaluations", run.budget.evaluations], ["physics steps", run.budget.steps]]
    .filter(([, value]) => value).map(([name, value]) => `${large(value)} ${name}`);
  const facts = [count(run.methods.length, "method", "methods"), count(run.scenarios.length, "scenario", "scenarios"),
    count(run.seeds.length, "seed", "seeds")];
  if (budget.length) facts.push(`${budget.join(" or ")} a run`);
  document.getElementById("lead").textContent = facts.join(" · ");
  document.getElementById("headline").append(...run.headline.map(sentence => element("p", sentence)));
  const caveats = document.getElementById("caveats");
  caveats.hidden = run.caveats.length === 0;
  caveats.querySelector("ul").append(...run.caveats.map(sentence => element("li", sentence)));
}

// All scenarios together, at equal evaluations or at equal steps.
function overallFigures(run, overall) {
  const scenarios = count(overall.scenarios.length, "scenario", "scenarios");
  const bars = run.seeds.length > 1 ? " Bars are 95 % intervals." : "";
  const means = overall.methods.map((mean, method) => ({
    name: run.methods[method].name, method, value: mean.value, interval: mean.interval,
    text: mean.interval ? `${fixed(mean.value, 2)}  (${intervalText(mean.interval, 2)})` : fixed(mean.value, 2),
  }));
  const made = [figure("h3", "Interquartile mean", `Of all runs on ${scenarios}: the higher, the better.${bars}`,
    new RowChart(means, { label: "Interquartile mean of each method; the numbers are in the table", low: 0, high: 1,
      axis: "normalised score" }).root,
    folded("Numbers of this figure", table("", ["Method", "Interquartile mean", "95 % interval"],
      means.map(row => [{ text: row.name, method: row.method }, fixed(row.value, 3), intervalText(row.interval, 3)]))))];
  if (overall.pairs.length) {
    const pairs = overall.pairs.map(pair => {
      const { value, interval } = pair.probability;
      const text = interval ? `${fixed(value, 2)}  (${intervalText(interval, 2)})` : fixed(value, 2);
      return { pair, name: pairName(run, pair), method: pair.better, value, interval, text };
    });
    made.push(figure("h3", "Probability of improvement", "How probably a run of the first method scores more than one of the second "
      + `on a scenario drawn at random.${bars} In a method's colour where a difference is claimed.`,
      new RowChart(pairs, { label: "Probability of improvement of each pair; the numbers are in the table", low: 0, high: 1,
        reference: 0.5, ends: ["second better", "first better"], axis: "probability" }).root,
      folded("Numbers of this figure", table("", ["Pair", "Probability", "95 % interval", "p", `p corrected (${overall.pairs.length})`, "Claimed"],
        pairs.map(({ pair, name, value, interval }) => [name, fixed(value, 3), intervalText(interval, 3), pValue(pair.p), pValue(pair.p_corrected),
          pair.better === null ? "no difference" : { strong: `${run.methods[pair.better].name} better` }]), [5]))));
  }
  made.push(profileFigure(run, overall));
  return made;
}

function profileFigure(run, overall) {
  const chart = new LineChart("Performance profiles", { height: 320, low: 0, high: 1, rest: 0.5 });
  const end = (profile, side) => profile.map(point => point.interval ? point.interval[side] : null);
  chart.show({
    x: overall.thresholds, xName: "normalised score", xFactor: 1, yName: "share of runs above", mark: null,
    series: overall.profiles.map((profile, method) => ({ name: run.methods[method].name, method,
      middle: profile.map(point => point.value), lower: end(profile, 0), upper: end(profile, 1) })),
  });
  const rows = overall.thresholds.map((threshold, place) => ({ threshold, place })).filter(({ place }) => place % 5 === 0);
  const text = ({ value, interval }) => interval ? `${fixed(value, 2)} (${intervalText(interval, 2)})` : fixed(value, 2);
  const bands = run.seeds.length > 1 ? " Bands are 95 % intervals, point by point." : "";
  return figure("h3", "Performance profiles", `The share of runs above each normalised score: the higher, the better.${bands}`,
    chart.root, folded("Numbers of this figure", table("", ["Score above", ...run.methods.map(method => method.name)],
      rows.map(({ threshold, place }) => [fixed(threshold, 1), ...overall.profiles.map(profile => text(profile[place]))]))));
}

function buildOverall(run) {
  const other = run.primary === "steps" ? "evaluations" : "steps";
  const [primary, secondary] = [run.primary, other].map(axis => standingsOf(run, axis).overall);
  if (!primary) return;
  document.getElementById("overall").hidden = false;
  if (run.scenarios.length === 1) document.getElementById("overall-heading").textContent = "Scores from 0 to 1";
  document.getElementById("overall-intro").textContent = `Scores at equal ${AXES[run.primary]}, brought to 0 for the worst and 1 for the `
    + "best run of each scenario, so that metres and seconds can be put together.";
  document.getElementById("overall-primary").append(...overallFigures(run, primary));
  const details = document.getElementById("overall-other");
  details.hidden = !secondary;
  if (!secondary) return;
  details.querySelector("summary").textContent = `The same at equal ${AXES[other]}`;
  details.querySelector("div").append(...overallFigures(run, secondary));
}

// Scores and tests of a scenario, at equal evaluations or at equal steps.
function scoreFigures(run, facts, place, axis) {
  const standings = standingsOf(run, axis);
  const scenario = standings.scenarios[place];
  const at = scenario.limit === null ? "" : ` at ${facts.shaped ? "the end of runs of " : ""}${fixed(scenario.limit, 0)} ${AXES[axis]}`;
  if (scenario.worst === null) return [element("p", `No run has a score${at}.`, "quiet")];
  const decimals = decimalsOf([scenario.worst, scenario.best]);
  const show = value => fixed(value, decimals);
  const margin = (scenario.best - scenario.worst) * 0.03 || 0.5;
  const rows = run.methods.map((method, index) => {
    const { scores, summary } = scenario.methods[index];
    return { name: method.name, method: index, value: summary.median, interval: [summary.lower, summary.upper],
      text: show(summary.median), runs: scores };
  });
  const summaries = table("", ["Method", "Median", "Quartiles", "Mean", "Best", "Worst", "Without score", ...(facts.shaped ? ["Median with terms"] : [])],
    run.methods.map((method, index) => {
      const { summary, unscored } = scenario.methods[index];
      return [{ text: method.name, method: index }, { strong: show(summary.median) }, `${show(summary.lower)} to ${show(summary.upper)}`,
        show(summary.mean), show(summary.best), show(summary.worst), String(unscored.length),
        ...(facts.shaped ? [scenario.methods[index].with_terms === null ? "–" : fixed(scenario.methods[index].with_terms, 2)] : [])];
    }));
  const seeds = table("", ["Seed", ...run.methods.map(method => method.name)], run.seeds.map((seed, index) =>
    [String(seed), ...scenario.methods.map(({ scores, unscored }) => show(scores[index]) + (unscored.includes(index) ? " *" : ""))]));
  const made = [figure("h4", `Scores${at}`, `A dot for each run, a line at the median, a bar from quartile to quartile; ${facts.unit || "fitness"}${facts.shaped ? ", without terms" : ""}.`,
    new RowChart(rows, { label: `Scores on ${facts.name}; the numbers are in the table`, low: scenario.worst - margin,
      high: scenario.best + margin, axis: facts.unit ? `score, ${facts.unit}` : "score" }).root,
    summaries, folded("Scores of every run", seeds,
      ...(scenario.methods.some(method => method.unscored.length) ? [element("p", "* has no score of its own and counts with the worst", "hint")] : [])))];
  if (scenario.pairs.length) made.push(element("h4", "Differences"), element("p", facts.test, "hint"), pairTable(run, facts, scenario, standings, show));
  return made;
}

function pairTable(run, facts, scenario, standings, show) {
  const made = table("", ["Pair", facts.unit ? `Shift, ${facts.unit}` : "Shift", "p", `p corrected (${standings.tests})`, "A₁₂", "Rank-biserial",
    "Effect", "Seeds differing", "Claimed"], scenario.pairs.map(pair => [pairName(run, pair), show(pair.shift), pValue(pair.p),
    pValue(pair.p_corrected), fixed(pair.superiority, 2), fixed(pair.rank_biserial, 2), pair.effect, pair.differing === null ? "–" : String(pair.differing),
    pair.better === null ? "no difference" : { strong: `${run.methods[pair.better].name} scores more` }]), [6, 8]);
  return made;
}

function thresholdTable(run, facts) {
  if (!facts.thresholds.length) return [];
  const rows = facts.thresholds.flatMap(threshold => threshold.methods.map((time, method) => {
    const whole = value => value === null ? "–" : fixed(value, 0);
    const goal = `${withUnit(threshold.score, facts.unit)} (${fixed(threshold.share * 100, 0)} %)`;
    return [{ text: run.methods[method].name, method }, goal, `${time.reached} of ${run.seeds.length}`, whole(time.evaluations),
      whole(time.steps), duration(time.seconds)];
  }));
  return [element("h4", "Time to a score: half and nine tenths of the best median"),
    table("", ["Method", "Score", "Runs that got there", "Evaluations", "Physics steps", "Time"], rows)];
}

// The curves of a scenario, and a function that draws them over another axis.
function curveFigure(run, facts) {
  const chart = new LineChart(`Best score so far on ${facts.name}`, { height: 340, stepped: true, named: true });
  const numbers = folded("Numbers of this figure");
  const show = axis => {
    const curves = facts.curves.find(curves => curves.axis === axis);
    const [factor, name] = axisScale(axis, curves.grid[curves.grid.length - 1]);
    const series = curves.methods.map((curve, method) => ({ name: run.methods[method].name, method, middle: curve.median,
      lower: curve.lower, upper: curve.upper }));
    chart.show({ x: curves.grid, xName: name, xFactor: factor, yName: facts.shaped ? "best fitness so far, with terms" : facts.unit ? `best so far, ${facts.unit}` : "best so far",
      mark: curves.limit, series });
    const places = curves.grid.map((_, place) => place).filter(place => place % 12 === 0 && place > 0);
    const text = ({ middle, lower, upper }, place) => middle[place] === null ? "–"
      : `${fixed(middle[place], chart.decimals)} (${fixed(lower[place], chart.decimals)} to ${fixed(upper[place], chart.decimals)})`;
    numbers.replaceChildren(numbers.firstChild, table("", [name[0].toUpperCase() + name.slice(1), ...run.methods.map(method => method.name)],
      places.map(place => [fixed(curves.grid[place] / factor, factor === 1 && curves.grid[place] >= 100 ? 0 : 2),
        ...series.map(series => text(series, place))])));
  };
  return { show, made: figure("h4", "Best score so far", `The median of the runs, with a band from quartile to quartile.${facts.shaped ? " What evolution sees: the movement and the terms." : ""}`, chart.root, numbers) };
}

function buildScenarios(run) {
  document.getElementById("scenarios").hidden = false;
  document.getElementById("scenarios-intro").textContent = "Scores in their own units. Draw the curves over:";
  const list = document.getElementById("scenario-list");
  const other = run.primary === "steps" ? "evaluations" : "steps";
  const curves = run.scenarios.map((facts, place) => {
    const article = element("article", undefined, "scenario");
    const { show, made } = curveFigure(run, facts);
    article.append(element("h3", facts.name), made, ...scoreFigures(run, facts, place, run.primary), ...thresholdTable(run, facts));
    // Ends of runs are equal in the budget alone.
    if (standingsOf(run, other).scenarios[place].limit !== null) {
      const details = element("details", undefined, "other");
      const inner = element("div");
      inner.append(...scoreFigures(run, facts, place, other));
      details.append(element("summary", `The same at equal ${AXES[other]}`), inner);
      article.append(details);
    }
    list.append(article);
    return show;
  });
  const picker = document.getElementById("axis-picker");
  for (const [axis, name] of Object.entries(AXES)) {
    const label = element("label");
    const input = element("input");
    Object.assign(input, { type: "radio", name: "axis", value: axis, checked: axis === run.primary });
    input.addEventListener("change", () => curves.forEach(show => show(axis)));
    label.append(input, element("span", name));
    picker.append(label);
  }
  curves.forEach(show => show(run.primary));
}

function seedText(seeds) {
  const last = seeds.length - 1;
  const inRow = last > 1 && seeds.every((seed, place) => seed === seeds[0] + place);
  return inRow ? `${seeds[0]} to ${seeds[last]}` : listed(seeds.map(String));
}

function buildMethods(run) {
  const place = document.getElementById("methods");
  place.append(element("h3", "What each strategy had, and from where"));
  const row = (first, { field, value, from }) => [first, field, value === null ? "–" : JSON.stringify(value), from];
  for (const facts of run.scenarios) {
    const details = element("details");
    const own = [...new Set(facts.own.flat().map(({ field }) => field.split(".")[0]))];
    details.append(element("summary", `${facts.name}: the methods differ in ${own.length ? listed(own) : "nothing"}`));
    const rows = [...facts.alike.map(had => row("all alike", had)),
      ...facts.own.flatMap((had, method) => had.map(had => row({ text: run.methods[method].name, method }, had)))];
    details.append(table("", ["Who", "What", "Value", "From"], rows, [1, 2, 3]));
    place.append(details);
  }
  place.append(element("p", `Seeds: ${seedText(run.seeds)}.`, "hint"));
}

function startPage() {
  const run = readRun();
  if (!run || !run.methods) {
    document.getElementById("lead").textContent = "This page holds no comparison.";
    return;
  }
  buildHeading(run);
  buildOverall(run);
  buildScenarios(run);
  buildMethods(run);
}

startPage();
