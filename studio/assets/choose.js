// Choosing: creature, movement, preset, strategy, terrain, and every setting of the configuration that follows. What is
// wrong is said in the library's own words, beside its field; the command line that does the same stands below.

const FIELDS = [
  { name: "preset", label: "Preset", list: "presets", none: "the default" },
  { name: "strategy", label: "Strategy", list: "strategies", none: "the preset's" },
  { name: "terrain", label: "Terrain", list: "terrains", none: "flat" },
  { name: "variation", label: "Variation of the world", list: "variations", none: "the preset's" },
  { name: "seed", label: "Seed", number: true, none: "the preset's" },
  { name: "generations", label: "Generations", number: true, none: "the preset's" },
];
// A part of a configuration that is chosen above, or is not chosen at all.
const HIDDEN = new Set(["preset", "seed", "creature", "further_bodies", "origin", "topology", "sensors", "stages", "movement.name"]);

class Choose {
  constructor(connection, onTrain) {
    this.connection = connection;
    this.choice = { movement: "running", creature: "biped-1" };
    this.set = new Map();
    this.past = [];
    this.settings = new Map();
    this.onTrain = onTrain;
    connection.on("catalogue", catalogue => this.fill(catalogue));
    connection.on("described", described => this.describe(described));
    const get = name => document.getElementById(name);
    get("choose-train").addEventListener("click", () => this.train());
    get("settings-undo").addEventListener("click", () => this.undo());
    get("settings-reset").addEventListener("click", () => this.change(() => this.set.clear()));
    get("settings-search").addEventListener("input", () => this.filter());
  }

  get request() {
    const set = [...this.set].map(([key, value]) => `${key}=${value}`);
    return { ...this.choice, set };
  }

  // Asks a moment after the last change.
  ask() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.connection.ask({ do: "describe", choice: this.request }), 120);
  }

  train() {
    this.connection.ask({ do: "train", choice: this.request });
    this.onTrain();
  }

  // A creature that is being drawn, in place of one by name.
  setDrawn(creature) {
    this.choice = { ...this.choice, drawn: creature };
    delete this.choice.creature;
    this.ask();
  }

  fill(catalogue) {
    this.catalogue = catalogue;
    const creatures = document.getElementById("choose-creature");
    const cards = catalogue.creatures.map(creature => creatureCard(creature, this.choice.creature === creature.name, () => {
      this.choice.creature = creature.name;
      delete this.choice.drawn;
      this.set.clear();
      this.ask();
    }));
    creatures.replaceChildren(creatures.querySelector("legend"), ...cards);
    const movements = document.getElementById("choose-movement");
    movements.replaceChildren(movements.querySelector("legend"), ...catalogue.movements.map(movement => this.movementChoice(movement)));
    document.getElementById("choose-fields").replaceChildren(...FIELDS.map(field => this.field(field)));
    this.ask();
  }

  movementChoice({ name, description }) {
    const label = element("label");
    const input = element("input");
    Object.assign(input, { type: "radio", name: "movement", value: name, checked: this.choice.movement === name });
    input.addEventListener("change", () => { this.choice.movement = name; this.set.clear(); this.ask(); });
    label.title = description;
    label.append(input, element("span", name));
    return label;
  }

  field({ name, label: text, list, number, none }) {
    const label = element("label", text);
    const input = element(number ? "input" : "select");
    input.id = `choose-${name}`;
    if (number) {
      Object.assign(input, { type: "number", min: 0, placeholder: none, value: this.choice[name] ?? "" });
    } else {
      const options = this.catalogue[list].map(thing => { const option = element("option", thing.name); option.value = thing.name; option.title = thing.description; return option; });
      const first = element("option", none);
      first.value = "";
      input.append(first, ...options);
      input.value = this.choice[name] ?? "";
    }
    input.addEventListener("change", () => {
      if (input.value === "") delete this.choice[name];
      else this.choice[name] = number ? Math.max(0, Math.round(Number(input.value))) : input.value;
      this.ask();
    });
    label.append(input);
    return label;
  }

  describe({ config, preset, problem, command }) {
    document.getElementById("choose-command").textContent = command;
    document.getElementById("choose-train").disabled = Boolean(problem);
    const wrong = problem ? [...this.settings.keys()].filter(key => this.set.has(key) && problem.includes(key.split(".").pop())) : [];
    document.getElementById("choose-problem").textContent = problem || "";
    if (preset) this.buildSettings(preset, config);
    for (const [key, { box, note }] of this.settings) {
      box.classList.toggle("wrong", wrong.includes(key));
      note.textContent = wrong.includes(key) ? problem : "";
    }
  }

  // A field for each number, switch and text of the configuration, in groups as it has them.
  buildSettings(preset, config) {
    const leaves = leavesOf(preset).filter(([key]) => !HIDDEN.has(key) && !HIDDEN.has(key.split(".")[0]));
    const values = new Map(leavesOf(config || preset));
    const shape = JSON.stringify(leaves.map(([key, value]) => [key, typeof value]));
    if (shape !== this.shape) {
      this.shape = shape;
      this.settings.clear();
      const groups = new Map();
      for (const [key, value] of leaves) {
        const group = key.includes(".") ? key.split(".")[0] : "run";
        if (!groups.has(group)) groups.set(group, []);
        groups.get(group).push(this.setting(key, value));
      }
      const tree = [...groups].map(([group, boxes]) => {
        const details = element("details");
        const inside = element("div", undefined, "settings-group");
        inside.append(...boxes);
        details.append(element("summary", group), inside);
        return details;
      });
      document.getElementById("settings-tree").replaceChildren(...tree);
    }
    for (const [key, value] of leaves) {
      const setting = this.settings.get(key);
      setting.preset = value;
      const changed = this.set.has(key);
      setting.box.classList.toggle("changed", changed);
      const now = changed ? this.set.get(key) : values.get(key) ?? value;
      if (document.activeElement === setting.input) continue;
      if (setting.input.type === "checkbox") setting.input.checked = String(now) === "true"; else setting.input.value = String(now);
    }
    this.filter();
    document.getElementById("settings-undo").disabled = !this.past.length;
    document.getElementById("settings-reset").disabled = !this.set.size;
  }

  setting(key, value) {
    const box = element("div", undefined, "setting");
    const label = element("label", key.split(".").slice(key.includes(".") ? 1 : 0).join(" › ").replace(/_/g, " "));
    const input = element("input");
    input.type = typeof value === "boolean" ? "checkbox" : typeof value === "number" ? "number" : "text";
    if (input.type === "number") input.step = "any";
    input.dataset.key = key;
    const note = element("p", "", "problem");
    input.addEventListener("change", () => this.change(() => {
      const now = input.type === "checkbox" ? String(input.checked) : input.value.trim();
      if (now === "" || now === String(this.settings.get(key).preset)) this.set.delete(key); else this.set.set(key, now);
    }));
    label.append(input);
    label.title = key;
    box.append(label, note);
    this.settings.set(key, { box, input, note, preset: value });
    return box;
  }

  change(act) {
    this.past.push(new Map(this.set));
    act();
    this.ask();
  }

  undo() {
    const before = this.past.pop();
    if (before) { this.set = before; this.ask(); }
  }

  filter() {
    const words = document.getElementById("settings-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const [key, { box }] of this.settings) {
      const fits = words.every(word => key.toLowerCase().replace(/_/g, " ").includes(word));
      box.hidden = !fits;
      shown += fits ? 1 : 0;
    }
    for (const details of document.querySelectorAll("#settings-tree details")) {
      const any = [...details.querySelectorAll(".setting")].some(box => !box.hidden);
      details.hidden = !any;
      if (words.length) details.open = any;
    }
    const changed = this.set.size ? `, ${count(this.set.size, "is", "are")} not as the preset has it` : "";
    document.getElementById("settings-count").textContent = `${count(shown, "setting", "settings")}${changed}`;
  }
}

// The numbers, switches and texts of a value, each with its way there; lists of plain things are one text.
function leavesOf(value, way = "") {
  if (value === null) return [];
  if (Array.isArray(value)) return value.every(item => typeof item !== "object") ? [[way, JSON.stringify(value)]] : [];
  if (typeof value !== "object") return [[way, value]];
  return Object.entries(value).flatMap(([name, inner]) => leavesOf(inner, way ? `${way}.${name}` : name));
}

// A picture of a creature with its name, to be chosen.
function creatureCard(creature, checked, onChoose) {
  const label = element("label");
  const input = element("input");
  Object.assign(input, { type: "radio", name: "creature", value: creature.name, checked });
  input.addEventListener("change", onChoose);
  const card = element("span", undefined, "card");
  const canvas = element("canvas");
  card.append(canvas, element("span", creature.title || creature.name));
  label.append(input, card);
  drawPortrait(canvas, creature);
  return label;
}

// A creature in its start pose, drawn once it can be seen.
function drawPortrait(canvas, creature) {
  const model = makeModel(creature);
  const stage = new Stage(canvas, 0.82);
  const pose = new Float32Array(creature.parts.flatMap(({ position, angle }) => [position[0], position[1], (angle || 0) * Math.PI / 180]));
  loop.addView({
    clock: { time: 0 }, get visible() { return stage.visible && canvas.isConnected; },
    get stale() { return stage.stale; }, set stale(value) { stage.stale = value; },
    draw() {
      stage.scale = fittingScale(stage, model, model.height, 0.78, 6);
      stage.centreX = middleX(model, pose);
      stage.drawScenery(0, { plain: true, bare: true });
      drawShadow(stage, model, pose);
      drawCreature(stage, model, pose);
    },
  });
}
