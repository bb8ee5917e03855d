// Choosing: creature, movement, preset, strategy, terrain, and every setting of the configuration that follows. What is
// wrong is said in the library's own words, beside its field; the command line that does the same stands below.

const FIELDS = [
  { name: "preset", label: "Preset", list: "presets", none: "the default" },
  { name: "strategy", label: "Strategy", list: "strategies", none: "the preset's" },
  { name: "terrain", label: "Terrain", list: "terrains", none: "flat" },
  { name: "from", label: "Go on from", list: "runs", none: "nothing" },
  { name: "variation", label: "Variation of the world", list: "variations", none: "the preset's" },
  { name: "seed", label: "Seed", number: true, none: "the preset's" },
  { name: "generations", label: "Generations", number: true, none: "the preset's" },
];

class Choose {
  // `onTrain`: a training has begun.
  constructor(connection, onTrain) {
    this.connection = connection;
    this.choice = { movement: "running", creature: "biped-1" };
    this.set = new Map();
    // What is wrong with numbers that are typed, by field.
    this.wrong = new Map();
    this.past = [];
    this.settings = new Settings(set => this.change(() => set(this.set)));
    this.onTrain = onTrain;
    connection.on("catalogue", catalogue => this.fill(catalogue));
    connection.on("schema", ({ schema }) => { this.settings.schema = schema; this.ask(); });
    connection.on("described", described => this.describe(described));
    connection.on("opened", () => {
      if (this.isAsked) this.onTrain();
      this.isAsked = false;
    });
    connection.on("refused", ({ request }) => { if (request === "train") this.isAsked = false; });
    const get = name => document.getElementById(name);
    get("choose-train").addEventListener("click", () => this.train());
    get("settings-undo").addEventListener("click", () => this.undo());
    get("settings-reset").addEventListener("click", () => this.change(() => this.set.clear()));
  }

  get request() {
    const set = [...this.set].map(([key, value]) => `${key}=${value}`);
    return { ...this.choice, set };
  }

  // The creature that is chosen, as in a file.
  get creature() {
    return this.choice.drawn || this.catalogue?.creatures.find(({ name }) => name === this.choice.creature);
  }

  // Asks a moment after the last change.
  ask() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.connection.ask({ do: "describe", choice: this.request }), 120);
  }

  train() {
    this.isAsked = true;
    this.connection.ask({ do: "train", choice: this.request });
  }

  // A creature that is being drawn, in place of one by name.
  setDrawn(creature) {
    this.choice = { ...this.choice, drawn: creature };
    delete this.choice.creature;
    this.ask();
  }

  setTerrain(name) {
    this.choice.terrain = name;
    document.getElementById("choose-terrain").value = name;
    this.ask();
  }

  fill(catalogue) {
    const isGone = (list, name) => {
      const has = of => of?.[list].some(thing => thing.name === name);
      return has(this.catalogue) && !has(catalogue);
    };
    if (isGone("creatures", this.creature?.name)) {
      delete this.choice.drawn;
      this.choice.creature = catalogue.creatures[0]?.name;
    }
    if (isGone("terrains", this.choice.terrain)) delete this.choice.terrain;
    this.catalogue = catalogue;
    if (!catalogue.runs.some(({ run }) => run === this.choice.from)) delete this.choice.from;
    const creatures = document.getElementById("choose-creature");
    const chosen = this.creature?.name;
    const cards = catalogue.creatures.map(creature => creatureCard(creature, creature.name === chosen, () => {
      this.change(() => {
        this.choice.creature = creature.name;
        delete this.choice.drawn;
        this.set.clear();
      });
    }));
    creatures.replaceChildren(creatures.querySelector("legend"), ...cards);
    const movements = document.getElementById("choose-movement");
    movements.replaceChildren(movements.querySelector("legend"), ...catalogue.movements.map(movement => this.movementChoice(movement)));
    this.wrong.clear();
    document.getElementById("choose-fields").replaceChildren(...FIELDS.map(field => this.field(field)));
    this.ask();
  }

  // What a field offers. A run that has no champion yet has learned nothing.
  options(list) {
    if (list !== "runs") return this.catalogue[list];
    const learned = this.catalogue.runs.filter(({ fitness }) => fitness !== null);
    return learned.map(({ run, creature, movement }) => ({ name: run, description: `${creature.title || creature.name}, ${movement}` }));
  }

  movementChoice({ name, description }) {
    const label = element("label");
    const input = element("input");
    Object.assign(input, { type: "radio", name: "movement", value: name, checked: this.choice.movement === name });
    input.addEventListener("change", () => this.change(() => { this.choice.movement = name; this.set.clear(); }));
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
      typeOver(input);
    } else {
      const options = this.options(list).map(thing => { const option = element("option", thing.name); option.value = thing.name; option.title = thing.description; return option; });
      const first = element("option", none);
      first.value = "";
      input.append(first, ...options);
      input.value = this.choice[name] ?? "";
    }
    input.addEventListener("change", () => {
      const value = number && input.value !== "" ? Number(input.value) : input.value;
      const isWrong = (number && input.value !== "" && (!Number.isSafeInteger(value) || value < 0)) || input.validity.badInput;
      input.setCustomValidity(isWrong ? `A whole number from 0 to ${Number.MAX_SAFE_INTEGER}.` : "");
      input.setAttribute("aria-invalid", String(isWrong));
      if (isWrong) this.wrong.set(name, `${text}: ${input.validationMessage}`); else this.wrong.delete(name);
      if (isWrong) return this.tellProblem();
      return this.change(() => { if (value === "") delete this.choice[name]; else this.choice[name] = value; });
    });
    label.append(input);
    return label;
  }

  describe({ config, preset, problem, command }) {
    document.getElementById("choose-command").textContent = command;
    this.problem = problem;
    this.tellProblem();
    if (preset) this.settings.show(preset, config, this.set, problem);
    document.getElementById("settings-undo").disabled = !this.past.length;
    document.getElementById("settings-reset").disabled = !this.set.size;
  }

  // What is typed wrong comes first: it is not in the choice.
  tellProblem() {
    const problem = [...this.wrong.values()][0] || this.problem;
    document.getElementById("choose-train").disabled = Boolean(problem);
    document.getElementById("choose-problem").textContent = problem || "";
  }

  change(act) {
    this.past.push({ choice: { ...this.choice }, set: new Map(this.set) });
    act();
    this.ask();
  }

  undo() {
    const before = this.past.pop();
    if (!before) return;
    Object.assign(this, before);
    this.fill(this.catalogue);
  }
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
