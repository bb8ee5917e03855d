// The fields of the creature editor: what can be set of a creature, a part and a joint, and how.

// Sensors: name, what they tell, and their settings when they are new.
const EDITOR_SENSORS = [
  ["torso-rotation", "how far the torso leans"], ["joint-angles", "how far each joint is bent"],
  ["joint-speeds", "how fast each joint turns"], ["torso-velocity", "how fast the torso moves, forward and up"],
  ["torso-spin", "how fast the torso tumbles"], ["torso-height", "how far the torso is above its start height"],
  ["height-above-ground", "how far the torso is above what is below it"], ["foot-contacts", "which feet touch the ground"],
  ["foot-slip", "how fast each foot slides"], ["rangefinder", "how far away things ahead are", { angles: [-30], length: 3 }],
  ["next-gap", "how far the next gap is, and how wide", { length: 4 }], ["clock", "a steady beat", { period: 1 }],
  ["landing-clock", "a beat that begins anew at each landing", { period: 1 }],
  ["commanded-speed", "how fast it is told to go", { top: 3 }],
  ["stride-clock", "a beat, the stronger the faster it is told to go", { period: 0.5, top: 3 }],
  ["jump-command", "whether it is told to jump"], ["jump-clock", "one turn of a clock from the jump on", { period: 0.5 }],
];
const EDITOR_MOST_RAYS = 64;
const EDITOR_SETTINGS = { period: "Time of one turn", length: "Reach", top: "Top speed" };

// The fields of what is selected. A field says how it gets its value from a creature and sets it in one.
function editorFields(creature, selection) {
  if (!selection) return creatureFields(creature);
  if (selection.kind === "joint") return jointFields(creature, selection.index);
  const joint = hangingTree(creature).joint[selection.index];
  return [...partFields(creature, selection.index), ...(joint === -1 ? [] : jointFields(creature, joint))];
}

function numberField(key, label, bounds, get, set, step = 0.01, help = `${bounds[0]} to ${bounds[1]}`) {
  return { key, kind: "number", label, bounds, get, set, step, help: help.replace("-", "−") };
}

function creatureFields(creature) {
  const text = (key, label, kind, help) => ({
    key, label, kind, help, get: c => c[key] ?? "",
    set: (c, value) => { if (value || key === "name") c[key] = value; else delete c[key]; },
  });
  const flag = (key, label, help) => ({
    key, kind: "check", label, help, get: c => Boolean(c[key]), set: (c, on) => { c[key] = on; },
  });
  const { parts } = creature;
  const mass = parts.reduce((sum, part) => sum + part.density * shapeArea(part.shape), 0);
  return [
    { key: "creature", kind: "heading", label: "Creature" },
    text("name", "Name", "text", "of files and folders: letters, digits, spaces, - _ ."),
    text("title", "Title", "text", "what people call it"), text("description", "Description", "long"),
    { key: "facts", kind: "note", label: `${count(parts.length, "part", "parts")}, ${tidy(mass)} kg. Click one to change it.` },
    flag("self_collision", "Parts bump into each other", "otherwise they pass through"),
    flag("symmetric", "Same from both sides", "then it can run both ways"),
    { key: "sensors", kind: "heading", label: "What it senses" },
    ...sensorFields(creature),
  ];
}

function sensorName(sensor) { return typeof sensor === "string" ? sensor : Object.keys(sensor || {})[0] ?? "unknown"; }

function sensorFields(creature) {
  const list = c => c.sensors || ["torso-rotation", "joint-angles"];
  const find = (c, name) => list(c).find(sensor => sensorName(sensor) === name);
  const words = name => (name[0]?.toUpperCase() ?? "") + name.slice(1).replace(/-/g, " ");
  const known = new Set(EDITOR_SENSORS.map(([name]) => name));
  const others = [...new Set(list(creature).map(sensorName))].filter(name => !known.has(name));
  return [...EDITOR_SENSORS, ...others.map(name => [name, "of another program"])].flatMap(([name, help, settings]) => [{
    key: `sensors.${name}`, kind: "check", label: words(name), help, get: c => find(c, name) !== undefined,
    set: (c, on) => {
      const rest = list(c).filter(sensor => sensorName(sensor) !== name);
      c.sensors = on ? [...rest, settings ? { [name]: structuredClone(settings) } : name] : rest;
    },
  }, ...(find(creature, name)?.[name] ? settingFields(name, settings, c => find(c, name)[name]) : [])]);
}

function settingFields(sensor, settings, of) {
  return Object.keys(settings || {}).map(name => {
    const key = `${sensor}.${name}`;
    if (name === "angles") return raysField(key, of);
    const set = (c, value) => { of(c)[name] = value; };
    return numberField(key, EDITOR_SETTINGS[name], EDITOR_BOUNDS[name], c => of(c)[name], set, 0.1);
  });
}

function raysField(key, of) {
  return {
    key, kind: "text", label: "Rays", help: "degrees, 0 is ahead, negative down: -30, 0",
    get: c => [of(c).angles].flat().join(", "),
    set: (c, value) => {
      const angles = value.split(/[,;\s]+/).filter(Boolean).map(Number).filter(Number.isFinite).slice(0, EDITOR_MOST_RAYS);
      if (angles.length) of(c).angles = angles.map(angle => editorBounded(angle, EDITOR_BOUNDS.limit, 0));
    },
  };
}

function partFields(creature, index) {
  const of = c => c.parts[index];
  const part = of(creature);
  const driven = drivenTags(creature).join("”, “");
  const number = (key, label, otherwise, step, help) => numberField(key, label, EDITOR_BOUNDS[key], c => of(c)[key] ?? otherwise,
    (c, value) => { of(c)[key] = value; }, step, help);
  const position = (axis, label) => numberField(`position[${axis}]`, label, EDITOR_BOUNDS.position, c => of(c).position[axis],
    (c, value) => moveSubtree(c, index, [0, 1].map(i => i === axis ? value - of(c).position[i] : 0)));
  return [
    { key: "part", kind: "heading", label: part.name },
    { key: "name", kind: "text", label: "Name", get: c => of(c).name, set: (c, value) => renamePart(c, index, value) },
    {
      key: "tag", kind: "text", label: "Kind", help: `parts of the kind “${driven}” are moved by the controller`,
      get: c => of(c).tag, set: (c, value) => { of(c).tag = value.slice(0, EDITOR_LONGEST_NAME) || of(c).tag; },
    },
    ...shapeFields(part, index),
    ...lookFields(part, index),
    number("density", "Density", 30, 1),
    number("friction", "Friction", 1, 0.1, "0 (ice) to 10"),
    position(0, "Forward"), position(1, "Up"),
    numberField("angle", "Turned", EDITOR_BOUNDS.angle, c => of(c).angle ?? 0,
      (c, value) => turnSubtree(c, index, value - (of(c).angle ?? 0)), 5),
    ...(index ? [{
      key: "leg", kind: "check", label: "May be a leg", help: "not for arms and tails", get: c => of(c).leg !== false,
      set: (c, on) => { if (on) delete of(c).leg; else of(c).leg = false; },
    }] : []),
    { key: "mass", kind: "note", label: `It weighs ${tidy(part.density * shapeArea(part.shape))} kg.` },
  ];
}

function shapeFields(part, index) {
  const of = c => c.parts[index].shape;
  const kind = shapeKind(part.shape);
  const names = { width: "Width", height: "Height", radius: "Radius", length: "Straight length" };
  const sizes = Object.keys(part.shape[kind]).map(name => numberField(`shape.${kind}.${name}`, names[name], EDITOR_BOUNDS.size,
    c => of(c)[kind]?.[name], (c, value) => reshapePart(c, index, { [kind]: { ...of(c)[kind], [name]: value } })));
  return [{
    key: "shape", kind: "choice", label: "Shape", options: { box: "Box", capsule: "Capsule", circle: "Circle" },
    get: c => shapeKind(of(c)),
    set: (c, value) => {
      const { box } = of(c);
      if (value === "capsule" && box?.width > box?.height) standOnEnd(c.parts[index]);
      reshapePart(c, index, shapeOfKind(value, halfExtent(of(c))));
    },
  }, ...sizes];
}

function lookFields(part, index) {
  const get = (key, otherwise) => c => c.parts[index].look?.[key] ?? otherwise;
  const set = key => (c, value) => { (c.parts[index].look ||= {})[key] = value; };
  const number = (key, label, ...rest) => numberField(`look.${key}`, label, EDITOR_BOUNDS[key], get(key, 0), ...rest);
  return [
    ...(part.shape.box ? [number("corner_radius", "Corner radius", set("corner_radius"))] : []),
    { key: "look.colour", kind: "colour", label: "Colour", get: get("colour", PLAIN_COLOUR), set: set("colour") },
    number("layer", "Layer", (c, value) => set("layer")(c, Math.round(value)), 1, "-100 back to 100 front"),
  ];
}

function jointFields(creature, index) {
  const of = c => c.joints[index];
  const joint = of(creature);
  const motor = (name, label) => numberField(`motor.${name}`, label, EDITOR_BOUNDS[name], c => of(c).motor?.[name],
    (c, value) => { of(c).motor[name] = value; }, 1);
  const limit = (which, label, bounds) => numberField(`limits[${which}]`, label, bounds, c => of(c).limits[which],
    (c, value) => setLimit(of(c), which, value), 5);
  const anchor = (axis, label) => numberField(`anchor[${axis}]`, label, EDITOR_BOUNDS.position, c => of(c).anchor[axis],
    (c, value) => { of(c).anchor[axis] = value; });
  return [
    { key: "joint", kind: "heading", label: `Hinge: ${joint.child} on ${joint.parent}` },
    {
      key: "drive", kind: "choice", label: "Moved by",
      options: { driven: "the controller", held: "nothing: a motor holds it", limp: "nothing: it is limp" },
      get: c => jointDrive(c, of(c)), set: (c, value) => setJointDrive(c, of(c), value),
    },
    limit(0, "Limit clockwise", [-180, 0, "°"]), limit(1, "Limit anticlockwise", [0, 180, "°"]),
    ...(joint.motor ? [motor("top_torque", "Top torque"), motor("top_speed", "Top speed")] : []),
    anchor(0, "Hinge forward"), anchor(1, "Hinge up"),
  ];
}

function jointDrive(creature, joint) {
  if (!joint.motor) return "limp";
  const child = creature.parts.find(part => part.name === joint.child);
  return child && drivenTags(creature).includes(child.tag) ? "driven" : "held";
}

// Which joints the controller moves is a matter of the child's tag, whether anything does one of the motor.
function setJointDrive(creature, joint, drive) {
  const child = creature.parts.find(part => part.name === joint.child);
  if (!child) return;
  if (drive === "limp") delete joint.motor;
  else joint.motor ||= fittingMotor(creature, Math.hypot(...halfExtent(child.shape)) * 2);
  if (drive === "driven" && jointDrive(creature, joint) !== "driven") {
    if (!drivenTags(creature).length) creature.actuated_tags = ["leg"];
    child.tag = drivenTags(creature)[0];
  }
  if (drive === "held" && jointDrive(creature, joint) !== "held") child.tag = "held";
  if (drive !== "limp") joint.limits.forEach((limit, which) => setLimit(joint, which, limit));
}

// What stands around the canvas of the creature editor: its buttons, the fields of what is selected, and the problems.

// Tools and actions: name, key, word on the button, icon, and what the tool is for.
const EDITOR_TOOLS = [
  ["select", "S", "Move", "M6 3l13 9-6 1.2L9.5 19z",
    "Drag a part: what hangs on it comes along. Drag empty ground to look around."],
  ["part", "P", "Part", "M4 9h11v9H4zM18 3v7M14.5 6.5h7", "Drag to draw. A part that begins on another hangs on it there."],
  ["joint", "J", "Joint", "M9.5 12a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0M4 4l6 6M20 4l-6 6M12 14.5V21",
    "Click where two parts overlap: a hinge will hold them."],
  ["turn", "R", "Turn", "M19 13a7 7 0 1 1-2.2-5.2M18 3v5h-5", "Drag a part to turn it about its hinge."],
  ["scale", "C", "Scale", "M4 20v-7h7v7zM12 12l8-8M14 4h6v6",
    "Drag a part to make it larger or smaller, with all that hangs on it."],
];
const EDITOR_SHAPES = [
  ["box", "1", "Box", "M4 7h16v10H4z"], ["capsule", "2", "Capsule", "M8 7a4 4 0 0 1 8 0v10a4 4 0 0 1-8 0z"],
  ["circle", "3", "Circle", "M4.5 12a7.5 7.5 0 1 0 15 0a7.5 7.5 0 1 0-15 0"],
];
const EDITOR_ACTIONS = [
  ["more", "L", "One more", "M5 5v14M10.5 5v14M18 9v6M15 12h6"],
  ["mirror", "M", "Mirror", "M12 3v18M8.5 8v9H3.5zM15.5 8v9h5z"],
  ["remove", "X", "Delete", "M5 7h14M9.5 7V4h5v3M7 7l1 13h8l1-13"],
  ["undo", "Ctrl Z", "Undo", "M8 4L4 8l4 4M4 8h10a5.5 5.5 0 0 1 0 11h-4"],
  ["redo", "Ctrl Y", "Redo", "M16 4l4 4-4 4M20 8H10a5.5 5.5 0 0 0 0 11h4"],
  ["ground", "G", "Ground", "M12 3v11M7.5 10l4.5 4.5 4.5-4.5M4 19.5h16"],
  ["empty", "", "Empty", "M6 3h8l4 4v14H6zM14 3v4h4"],
];
const EDITOR_ZOOMS = [
  ["out", "−", "Zoom out", "M5 12h14"], ["fit", "0", "Show all", "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5"],
  ["in", "+", "Zoom in", "M12 5v14M5 12h14"],
];

function editorElement(name, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

function editorIcon(path) {
  const [svg, line] = ["svg", "path"].map(name => document.createElementNS("http://www.w3.org/2000/svg", name));
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("class", "editor-icon");
  svg.setAttribute("aria-hidden", "true");
  line.setAttribute("d", path);
  svg.append(line);
  return svg;
}

function editorButton([, key, word, icon], press) {
  const button = editorElement("button", "editor-button");
  button.type = "button";
  button.append(editorIcon(icon), editorElement("span", "editor-word", word));
  if (key) {
    if (key.length > 1) button.classList.add("editor-button-wide");
    const hint = editorElement("kbd", "", key);
    hint.setAttribute("aria-hidden", "true");
    button.append(hint);
    button.setAttribute("aria-keyshortcuts", key.replace("Ctrl ", "Control+"));
  }
  button.title = key ? `${word} (${key})` : word;
  button.addEventListener("click", press);
  return button;
}

class EditorToolbar {
  constructor(editor) {
    this.editor = editor;
    this.root = editorElement("div", "editor-toolbar");
    this.tools = this.group("Tools", EDITOR_TOOLS, name => editor.setTool(name));
    this.shapes = this.group("Shape of new parts", EDITOR_SHAPES, name => editor.setShape(name));
    this.actions = this.group("Actions", EDITOR_ACTIONS, name => editor.act(name));
    const play = editorButton(["play", "K", "Train it", "M7 4.5v15l12.5-7.5z"], () => editor.act("play"));
    play.classList.add("editor-play");
    this.root.append(play);
    this.zooms = this.group("View", EDITOR_ZOOMS, name => editor.act(name));
    this.zooms.root.classList.add("editor-zooms");
  }

  group(label, entries, press) {
    const root = editorElement("div", "editor-group");
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", label);
    const buttons = new Map(entries.map(entry => [entry[0], editorButton(entry, () => press(entry[0]))]));
    root.append(...buttons.values());
    this.root.append(root);
    return { root, buttons };
  }

  refresh() {
    const { tool, shape, selection, present, past, future } = this.editor;
    this.tools.buttons.forEach((button, name) => button.setAttribute("aria-pressed", String(name === tool)));
    this.shapes.buttons.forEach((button, name) => button.setAttribute("aria-pressed", String(name === shape)));
    this.shapes.root.hidden = tool !== "part";
    const isIdle = {
      more: !selection, mirror: !selection, remove: !selection, undo: !past.length, redo: !future.length,
      ground: !present.parts.length,
    };
    this.actions.buttons.forEach((button, name) => { button.disabled = Boolean(isIdle[name]); });
  }
}

class EditorPanel {
  constructor(editor) {
    this.editor = editor;
    this.root = editorElement("section", "editor-panel");
    this.root.setAttribute("aria-label", "What is selected");
    this.rows = [];
  }

  refresh() {
    const { present, selection } = this.editor;
    const fields = editorFields(present, selection);
    const signature = fields.map(field => field.key).join();
    if (signature !== this.signature) this.rebuild(fields, signature);
    fields.forEach((field, i) => this.rows[i].show(field));
  }

  // Whoever has just used a field that brought others along stays in it.
  rebuild(fields, signature) {
    const focused = this.rows.find(row => row.root.contains(document.activeElement))?.field.key;
    this.signature = signature;
    this.rows = fields.map(field => new EditorRow(this.editor, field));
    this.root.replaceChildren(...this.rows.map(row => row.root));
    if (focused) this.rows.find(row => row.field.key === focused)?.control?.focus();
  }

  focusFirst() { this.rows.find(row => row.control)?.control.focus(); }
}

class EditorRow {
  constructor(editor, field) {
    Object.assign(this, { editor, field });
    if (field.kind === "heading" || field.kind === "note") {
      this.root = editorElement(field.kind === "heading" ? "h3" : "p", `editor-${field.kind}`);
      return;
    }
    this.root = editorElement("div", `editor-field editor-field-${field.kind}`);
    const label = editorElement("label", "editor-label", field.label);
    this.control = this.makeControl(field);
    this.control.id = label.htmlFor = `editor-field-${EditorRow.number = (EditorRow.number || 0) + 1}`;
    this.help = editorElement("small", "editor-help");
    this.help.id = `${this.control.id}-help`;
    this.control.setAttribute("aria-describedby", this.help.id);
    this.root.append(label, this.control);
    if (field.bounds?.[2]) this.root.append(editorElement("span", "editor-unit", field.bounds[2]));
    this.root.append(this.help);
    if (field.kind === "colour") this.root.append(this.swatches = editorElement("div", "editor-swatches"));
    this.control.addEventListener("change", () => this.change());
    // A colour is seen on the creature while it is being chosen.
    if (field.kind !== "colour") return;
    this.control.addEventListener("input", () => editor.preview(c => this.field.set(c, this.control.value)));
  }

  makeControl({ kind, bounds, step, options }) {
    if (kind === "choice") {
      const select = editorElement("select", "editor-control");
      for (const value in options) select.append(new Option(options[value], value));
      return select;
    }
    const control = editorElement(kind === "long" ? "textarea" : "input", "editor-control");
    if (kind === "long") control.rows = 3;
    else control.type = { check: "checkbox", number: "number", colour: "color" }[kind] || "text";
    if (kind === "number") Object.assign(control, { min: bounds[0], max: bounds[1], step, inputMode: "decimal" });
    if (kind === "text") Object.assign(control, { maxLength: 200, autocomplete: "off", spellcheck: false });
    return control;
  }

  show(field) {
    this.field = field;
    if (!this.control) { this.root.textContent = field.label; return; }
    const { present } = this.editor;
    const value = field.get(present);
    this.help.textContent = field.help ?? "";
    if (field.kind === "check") { this.control.checked = value; return; }
    const text = field.kind === "number" ? String(editorRounded(Number(value), 4)) : String(value);
    // A half-typed value is left alone.
    if (document.activeElement === this.control && this.control.value !== this.shown && this.shown === text) return;
    this.shown = this.control.dataset.shown = text;
    this.control.value = field.kind === "colour" && !/^#[0-9a-f]{6}$/i.test(text) ? PLAIN_COLOUR : text;
    if (this.swatches) this.showSwatches(present);
  }

  // The colours the creature has already, to be used again.
  showSwatches(creature) {
    const isColour = colour => /^#[0-9a-f]{6}$/i.test(colour);
    const colours = [...new Set(creature.parts.map(part => part.look?.colour))].filter(isColour).slice(0, 8);
    this.swatches.replaceChildren(...colours.map(colour => {
      const button = editorElement("button", "editor-swatch");
      button.type = "button";
      button.style.background = colour;
      button.setAttribute("aria-label", `Colour ${colour}`);
      button.addEventListener("click", () => this.editor.edit(c => this.field.set(c, colour)));
      return button;
    }));
  }

  change() {
    const { field, control, editor } = this;
    let value = field.kind === "check" ? control.checked : control.value.trim();
    if (field.kind === "number") {
      value = value === "" ? NaN : editorBounded(Number(value), field.bounds, NaN);
      if (Number.isNaN(value)) { this.shown = null; this.show(field); return; }
    }
    this.shown = null;
    editor.edit(c => field.set(c, value));
  }
}

// What `check` says, each problem a button that selects what it is about.
class EditorProblems {
  constructor(editor) {
    this.editor = editor;
    this.root = editorElement("div", "editor-problems");
    this.root.setAttribute("aria-live", "polite");
  }

  show(problems, creature) {
    if (!problems.length) { this.root.replaceChildren(editorElement("p", "editor-fine", "No problem.")); return; }
    const list = editorElement("ul");
    for (const { where = "", message = "" } of problems) {
      const button = editorElement("button", "editor-problem");
      button.type = "button";
      const about = problemPlace(where, creature);
      const part = about?.kind === "part" ? creature.parts[about.index].name : about ? creature.joints[about.index].child : "";
      const text = String(message).startsWith(`${where}:`) ? String(message).slice(where.length + 1).trim() : String(message);
      button.append(editorElement("strong", "", part || where || "creature"), ` ${text}`);
      button.addEventListener("click", () => this.editor.select(about));
      const item = editorElement("li");
      item.append(button);
      list.append(item);
    }
    this.root.replaceChildren(editorElement("p", "editor-bad", count(problems.length, "problem", "problems")), list);
  }
}

// What a path such as `parts[2].shape` is about; null for the creature as a whole.
function problemPlace(where, creature) {
  const [, list, digits] = /^(parts|joints)\[(\d+)\]/.exec(where) || [];
  const index = Number(digits);
  if (!list || index >= creature[list].length) return null;
  return { kind: list === "parts" ? "part" : "joint", index };
}
