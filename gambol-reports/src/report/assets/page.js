// The page: what it says at the top, which sections there are, settings and versions, and the start of it all. A
// section whose data is missing stays hidden.

function terms(list, pairs) {
  for (const [term, value] of pairs) {
    const group = element("div");
    group.append(element("dt", term), element("dd", value));
    list.append(group);
  }
}

function buildHeading(run) {
  const movement = run.movement?.name;
  const name = run.creature?.title || run.creatureName;
  document.getElementById("heading").textContent = movement ? `${name} · ${movement}` : run.title || name;
  const lead = document.getElementById("lead");
  const facts = [];
  const summary = run.summary || {};
  const fitness = summary.fitness ?? run.champion?.fitness;
  const number = value => value !== null && value !== undefined;
  const trained = summary.fitness_in_training;
  if (number(fitness)) facts.push(`best ${withUnit(fitness, run.unit)}${number(trained) ? " in rapier" : ""}`);
  if (number(trained)) facts.push(`${withUnit(trained, run.unit)} in training`);
  if (number(summary.generations)) facts.push(count(summary.generations, "generation", "generations"));
  if (number(summary.body_lengths_per_second)) facts.push(`${fixed(summary.body_lengths_per_second, 2)} body lengths per second`);
  facts.forEach((fact, i) => {
    if (i) lead.append(" · ");
    lead.append(element(i ? "span" : "strong", fact));
  });
  if (summary.warning) {
    const warning = document.getElementById("warning");
    warning.hidden = false;
    warning.textContent = summary.warning;
  }
  if (run.movement?.description) {
    const text = run.movement.description.trim();
    lead.after(element("p", text[0].toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : "."), "described"));
  }
}

function buildChampion(run, model) {
  const replay = decodeReplay(run.champion?.replay, run.ground);
  if (!replay) return;
  const contacts = readContacts(run.champion.contacts, replay.frames);
  const clock = loop.addClock(new Clock(replay.duration));
  document.getElementById("replay").hidden = false;
  loop.addView(new ReplayView(run, model, replay, contacts, clock));
  const touches = part => contacts.some(mask => inMask(mask, part.index));
  if (contacts && replay.duration > 0 && model.parts.some(touches)) {
    document.getElementById("footfalls").hidden = false;
    loop.addView(new FootfallView(model, replay, contacts, clock));
  }
  buildNetwork(run, model, replay, contacts, clock);
}

function buildNetwork(run, model, replay, contacts, clock) {
  const network = run.champion.network;
  if (!network || !network.outputs.length) return;
  const activations = readActivations(network.activations, network.nodes.length);
  document.getElementById("network").hidden = false;
  document.getElementById("network-intro").textContent = `${describeNetwork(network)} Sensors on the left, motors on the right`
    + (activations ? "; an edge brightens with the signal it carries." : ".");
  playButton(document.getElementById("network-play"), clock);
  loop.addView(new NetworkStage(model, replay, contacts, clock));
  loop.addView(new NetworkView(network, activations, replay, clock));
}

// `9 inputs, 3 hidden neurons, 8 outputs; 78 connections and 11 biases.`
function describeNetwork({ nodes, inputs, outputs, connections }) {
  const hidden = nodes.length - inputs - outputs.length;
  const biases = nodes.filter(node => node.bias !== undefined).length;
  const back = connections.filter(([source, target]) => source >= target).length;
  const words = [count(inputs, "input", "inputs")];
  if (hidden) words.push(count(hidden, "hidden neuron", "hidden neurons"));
  words.push(count(outputs.length, "output", "outputs"));
  const weights = [count(connections.length, "connection", "connections")];
  if (biases) weights.push(count(biases, "bias", "biases"));
  const memory = !back ? "" : back === 1 ? " One connection carries what its source put out a step before."
    : ` ${fixed(back, 0)} of the connections carry what their source put out a step before.`;
  return `${words.join(", ")}; ${weights.join(" and ")}.${memory}`;
}

function buildFitness(run) {
  if (!run.history || !run.history.length) return;
  document.getElementById("fitness").hidden = false;
  const rows = run.history;
  const sizes = rows.map(row => row.evaluations || 0);
  // With a champion selection there is no champion before its first re-evaluation.
  const bests = rows.map(row => row.best_so_far).filter(best => best !== null && best !== undefined);
  const generations = count(rows.length, "generation", "generations");
  const text = rows.length === 1 ? ["One generation"] : !bests.length ? [generations[0].toUpperCase() + generations.slice(1)]
    : [`From ${withUnit(bests[0], run.unit)} to ${withUnit(bests[bests.length - 1], run.unit)} in ${generations}`];
  // A strategy may change the size of its generations.
  const size = sizes.every(size => size === sizes[0]) ? `${count(sizes[0], "evaluation", "evaluations")} each`
    : `${extremes(sizes).map(size => fixed(size, 0)).join(" to ")} evaluations`;
  if (sizes[0]) text.push(` of ${size}`);
  const judged = run.summary?.judged ? " The champion is chosen by a champion selection: in a whole episode without variation, in rapier." : "";
  document.getElementById("fitness-intro").textContent = text.join("") + "." + judged;
  new FitnessChart(run);
}

// A command line with a button that copies it.
function commandLine({ what, command }) {
  const box = element("div", undefined, "command");
  const code = element("code", command);
  const button = element("button", "Copy", "small");
  button.type = "button";
  button.setAttribute("aria-label", `Copy the command: ${what}`);
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(command);
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    } catch {
      getSelection().selectAllChildren(code);
    }
  });
  const line = element("div", undefined, "command-line");
  line.append(code, button);
  box.append(element("p", what), line);
  return box;
}

function buildSettings(run) {
  const summary = run.summary || {};
  const pairs = (run.settings || []).map(({ label, value }) => [label, String(value)]);
  if (summary.evaluations) pairs.push(["Evaluations", fixed(summary.evaluations, 0)]);
  if (summary.physics_steps) pairs.push(["Physics steps", large(summary.physics_steps)]);
  if (summary.stopped_because) pairs.push(["Stopped because", summary.stopped_because]);
  const commands = run.commands || [];
  const versions = run.versions || [];
  const config = run.config && Object.keys(run.config).length ? run.config : null;
  if (!pairs.length && !commands.length && !versions.length && !config) return;
  document.getElementById("settings").hidden = false;
  terms(document.getElementById("settings-list"), pairs);
  if (commands.length) {
    const place = document.getElementById("settings-commands");
    place.hidden = false;
    place.append(...commands.map(commandLine));
  }
  if (versions.length) {
    document.getElementById("settings-versions").hidden = false;
    terms(document.getElementById("versions-list"), versions.map(({ name, version }) => [name, version]));
  }
  if (config) {
    const details = document.getElementById("settings-config");
    details.hidden = false;
    details.querySelector("pre").textContent = JSON.stringify(config, null, 2);
  }
}

function startPage() {
  const run = readRun();
  if (!run || !run.creature) {
    document.getElementById("lead").textContent = "This page holds no run.";
    return;
  }
  readTheme();
  run.creatureName = run.creature.name || "creature";
  run.unit = run.movement?.unit ?? "";
  run.ground = decodeGround(run.ground);
  const model = makeModel(run.creature);
  buildHeading(run);
  buildChampion(run, model);
  buildStages(run, model);
  buildGait(run);
  buildFront(run, model);
  buildFitness(run);
  buildStatistics(run);
  buildSpecies(run);
  buildStrip(run, model);
  buildPopulations(run, model);
  buildSettings(run);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    readTheme();
    loop.redrawAll();
  });
  loop.start();
}

startPage();
