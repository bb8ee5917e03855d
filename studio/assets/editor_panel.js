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
  ["empty", "", "New", "M6 3h8l4 4v14H6zM14 3v4h4"],
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

// Groups of buttons, for the toolbar of an editor.
class ButtonGroups {
  constructor(editor) {
    this.editor = editor;
    this.root = editorElement("div", "editor-toolbar");
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
}

// Puts the pieces of an editor into its root: toolbar, canvas with hint and zoom, list, panel.
function buildFrame(editor, label, ...classes) {
  const { root, toolbar, list, panel } = editor;
  editor.surface = editorElement("canvas", "editor-canvas");
  editor.surface.tabIndex = 0;
  editor.surface.setAttribute("role", "application");
  editor.surface.setAttribute("aria-label", label);
  editor.hint = editorElement("p", "editor-hint");
  editor.hint.setAttribute("role", "status");
  const scene = editorElement("div", "editor-scene");
  scene.append(editor.surface, editor.hint, toolbar.zooms.root);
  const frame = editorElement("div", "editor-frame");
  frame.append(toolbar.root, scene, list.root, panel.root);
  root.classList.add("editor", ...classes);
  root.replaceChildren(frame);
}

class EditorToolbar extends ButtonGroups {
  constructor(editor) {
    super(editor);
    this.tools = this.group("Tools", EDITOR_TOOLS, name => editor.setTool(name));
    this.shapes = this.group("Shape of new parts", EDITOR_SHAPES, name => editor.setShape(name));
    this.actions = this.group("Actions", EDITOR_ACTIONS, name => editor.act(name));
    const play = editorButton(["play", "K", "Train it", "M7 4.5v15l12.5-7.5z"], () => editor.act("play"));
    play.classList.add("editor-play");
    this.root.append(play);
    this.zooms = this.group("View", EDITOR_ZOOMS, name => editor.act(name));
    this.zooms.root.classList.add("editor-zooms");
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
    this.decorations = new EditorDecorations(editor);
  }

  refresh() {
    const { present, selection } = this.editor;
    const fields = editorFields(present, selection);
    const signature = fields.map(({ key, options }) => key + JSON.stringify(options ?? "")).join();
    if (signature !== this.signature) this.rebuild(fields, signature);
    else fields.forEach((field, i) => this.rows[i].show(field));
  }

  // Whoever has just used a field that brought others along, or went with them, stays in it or in the one at its place.
  rebuild(fields, signature) {
    const { activeElement } = document;
    const row = this.rows.find(({ root }) => root.contains(activeElement));
    const place = this.rows.indexOf(row);
    const isOther = this.rows[0]?.field.key !== fields[0].key;
    const { list } = this.decorations;
    const [at, scrolled] = [list.getBoundingClientRect(), list.scrollTop];
    this.signature = signature;
    this.rows = fields.map(field => field.kind === "decorations" ? this.decorations : new EditorRow(this.editor, field));
    this.root.replaceChildren(...this.rows.map(({ root }) => root));
    list.scrollTop = scrolled;
    fields.forEach((field, i) => this.rows[i].show(field));
    if (!row && isOther) this.root.scrollTop = 0;
    if (!row) return;
    if (at.height && list.isConnected) this.keepInPlace(at.top);
    const same = row === this.decorations ? row : this.rows.find(({ field }) => field.key === row.field.key);
    const near = same || this.rows.slice(0, place + 1).findLast(({ control }) => control);
    const isThere = this.root.contains(activeElement) && !activeElement.closest("[hidden]");
    (isThere ? activeElement : near?.control)?.focus({ preventScroll: true });
  }

  // The list of decorations stays under the pointer as far as the panel, or else the page, can be scrolled.
  keepInPlace(top) {
    const shift = this.decorations.list.getBoundingClientRect().top - top;
    const isAlone = getComputedStyle(this.root).overflowY === "auto";
    if (isAlone) this.root.scrollTop += shift;
    else window.scrollBy({ top: shift, behavior: "instant" });
  }

  focusFirst() { this.rows.find(row => row.control && row.field.kind !== "action")?.control.focus(); }
}

class EditorRow {
  constructor(editor, field) {
    Object.assign(this, { editor, field });
    if (field.kind === "heading" || field.kind === "note") {
      this.root = editorElement(field.kind === "heading" ? "h3" : "p", `editor-${field.kind}`);
      return;
    }
    this.root = editorElement("div", `editor-field editor-field-${field.kind}`);
    if (field.kind === "action") {
      this.control = editorElement("button", "small", field.label);
      this.control.type = "button";
      this.control.addEventListener("click", () => this.field.press(editor));
      this.root.append(this.control);
      return;
    }
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

  makeControl({ kind, bounds, step, options, problem, rows = 3 }) {
    if (kind === "choice") {
      const select = editorElement("select", "editor-control");
      for (const value in options) select.append(new Option(options[value], value));
      return select;
    }
    const control = editorElement(kind === "long" ? "textarea" : "input", "editor-control");
    if (kind === "long") Object.assign(control, { rows, spellcheck: !problem });
    else control.type = { check: "checkbox", number: "number", colour: "color" }[kind] || "text";
    if (kind === "number") {
      typeOver(control);
      Object.assign(control, { max: bounds[1], step, inputMode: "decimal" });
      // Browsers step from the least value on: from 0.005 they would go to 0.015.
      if (Number.isInteger(bounds[0])) control.min = bounds[0];
      else control.setAttribute("aria-valuemin", bounds[0]);
    }
    if (kind === "text") Object.assign(control, { maxLength: 200, autocomplete: "off", spellcheck: false });
    return control;
  }

  show(field) {
    this.field = field;
    if (!this.control) { this.root.textContent = field.label; return; }
    if (field.kind === "action") return;
    const { present } = this.editor;
    const value = field.get(present);
    // What could not be read is left to be put right, until the field is of something else.
    if (this.isWrong && String(value) === this.shown) return;
    this.judge("");
    if (field.kind === "check") { this.control.checked = value; return; }
    const text = field.kind === "number" ? String(editorRounded(Number(value), 4)) : String(value);
    // A half-typed value is left alone.
    if (document.activeElement === this.control && this.control.value !== this.shown && this.shown === text) return;
    this.shown = this.control.dataset.shown = text;
    this.control.value = field.kind === "colour" && !isColour(text) ? PLAIN_COLOUR : text;
    if (this.swatches) this.showSwatches(present);
  }

  // Says what is wrong with what is typed, or else what helps to type it.
  judge(problem) {
    this.isWrong = Boolean(problem);
    this.help.textContent = problem || (this.field.help ?? "");
    this.control.setAttribute("aria-invalid", String(this.isWrong));
  }

  // The colours the creature has already, to be used again: those of its parts, then what is painted on this one.
  showSwatches(creature) {
    const painted = decorationsOf(creature.parts[this.editor.part]).flatMap(({ fill, stroke }) => [fill, stroke]);
    const colours = [...new Set([...creature.parts.map(part => part.look?.colour), ...painted])].filter(isColour).slice(0, 16);
    if (colours.join() === this.colours) return;
    this.colours = colours.join();
    const hadFocus = this.swatches.contains(document.activeElement);
    this.swatches.replaceChildren(...colours.map(colour => {
      const button = editorElement("button", "editor-swatch");
      button.type = "button";
      button.style.background = colour;
      button.setAttribute("aria-label", `Colour ${colour}`);
      button.addEventListener("click", () => this.editor.edit(c => this.field.set(c, colour)));
      return button;
    }));
    if (hadFocus) this.control.focus({ preventScroll: true });
  }

  change() {
    const { field, control, editor } = this;
    let value = field.kind === "check" ? control.checked : control.value.trim();
    if (field.kind === "number") {
      value = value === "" ? NaN : editorBounded(Number(value), field.bounds, NaN);
      if (Number.isNaN(value)) { this.shown = null; this.show(field); return; }
    }
    const problem = field.problem?.(value);
    if (problem) { this.judge(problem); return; }
    this.isWrong = false;
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
    if (!problems.length) {
      const { parts, joints } = creature;
      const facts = `${count(parts.length, "part", "parts")}, ${count(joints.length, "hinge", "hinges")}.`;
      this.root.replaceChildren(editorElement("p", "editor-fine", `No problem. ${facts}`));
      return;
    }
    const list = editorElement("ul");
    for (const { where = "", message = "" } of problems) {
      const button = editorElement("button", "editor-problem");
      button.type = "button";
      // What cannot be read at all has its place in its message.
      const about = problemPlace(where || message, creature);
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
  const [, list, digits, painted] = /^(parts|joints)\[(\d+)\](?:\.look\.decorations\[(\d+)\])?/.exec(where) || [];
  const index = Number(digits);
  if (!list || index >= creature[list].length) return null;
  const decoration = decorationsOf(creature[list][index])[painted] ? { decoration: Number(painted) } : {};
  return { kind: list === "parts" ? "part" : "joint", index, ...decoration };
}
