// The decorations of the selected part in the panel: their list, the one in front on top, and the fields of the chosen one.

// What is done to the chosen decoration: name, key, word, icon.
const EDITOR_DECORATION_ACTS = [
  ["up", "Alt+ArrowUp", "Up", "M12 19V5M6 11l6-6 6 6"], ["down", "Alt+ArrowDown", "Down", "M12 5v14M6 13l6 6 6-6"],
  ...EDITOR_ACTIONS.filter(([name]) => ["more", "mirror", "remove"].includes(name)),
];

function decorationFields(creature, { index, decoration: which }) {
  const of = c => c.parts[index].look.decorations[which];
  const form = c => formOf(of(c));
  const decoration = of(creature);
  const kind = formKind(decoration);
  const pair = (name, i, label, bounds, step) => numberField(`${kind}.${name}[${i}]`, label, bounds, c => form(c)[name][i],
    (c, value) => { form(c)[name][i] = value; }, step);
  const single = (name, label, step) => numberField(`${kind}.${name}`, label, EDITOR_BOUNDS[name], c => form(c)[name] ?? 0,
    (c, value) => { if (value) form(c)[name] = value; else delete form(c)[name]; }, step);
  const turned = single("angle", "Turned", 5);
  const place = [pair("centre", 0, "Right", EDITOR_BOUNDS.place), pair("centre", 1, "Up", EDITOR_BOUNDS.place)];
  const sizes = (name, words) => words.map((word, i) => pair(name, i, word, EDITOR_BOUNDS.extent));
  return [
    { key: "decoration", kind: "heading", label: `Decorations of ${creature.parts[index].name}` },
    { key: "back", kind: "action", label: "Back to the part", press: editor => editor.select({ kind: "part", index }) },
    { key: "decorations", kind: "decorations" },
    ...(kind ? [{
      key: "form", kind: "choice", label: "Form", options: Object.fromEntries(EDITOR_FORMS.map(([name, , word]) => [name, word])),
      get: c => formKind(of(c)), set: (c, value) => reformDecoration(of(c), value),
    }] : []),
    ...{
      ellipse: () => [...place, ...sizes("radii", ["Half width", "Half height"]), turned],
      rectangle: () => [...place, ...sizes("size", ["Width", "Height"]), turned, single("corner_radius", "Corner radius")],
      polygon: () => [pointsField(kind, form)], line: () => [pointsField(kind, form)],
    }[kind]?.() ?? [],
    ...(kind === "line" ? [] : paintFields(of, decoration, "fill", "Filled", "Colour inside")),
    ...paintFields(of, decoration, "stroke", kind === "line" ? "Drawn" : "Outlined", "Colour of the line"),
    ...(decoration.stroke === undefined ? [] : [numberField("width", "Line width", EDITOR_BOUNDS.line_width,
      c => of(c).width ?? 0.01, (c, value) => { of(c).width = value; }, 0.001)]),
    { key: "frame", kind: "note", label: "Places are counted from the middle of the part, and turn with it." },
  ];
}

function pointsField(kind, form) {
  const [least, most] = EDITOR_BOUNDS.place;
  const lines = `${EDITOR_FEWEST_POINTS[kind]} to ${EDITOR_MOST_POINTS} lines`;
  return {
    key: `${kind}.points`, kind: "long", label: "Points", rows: 6,
    help: `${lines}, each right and up, m, ${least} to ${most}`.replace("-", "−"),
    get: c => form(c).points.map(point => point.join(", ")).join("\n"),
    problem: value => { const read = readPoints(value, kind); return Array.isArray(read) ? "" : read; },
    set: (c, value) => { form(c).points = readPoints(value, kind); },
  };
}

// Whether a decoration is filled or outlined, and in which colour.
function paintFields(of, decoration, name, label, colour) {
  return [{
    key: `${name}.on`, kind: "check", label, get: c => of(c)[name] !== undefined,
    set: (c, on) => {
      const { fill, stroke } = of(c);
      if (on) of(c)[name] = paintOn(fill || stroke);
      else delete of(c)[name];
    },
  }, ...(decoration[name] === undefined ? [] : [{
    key: name, kind: "colour", label: colour, get: c => of(c)[name] ?? PLAIN_COLOUR, set: (c, value) => { of(c)[name] = value; },
  }])];
}

// A small picture of a decoration, on a ground on which it is seen.
function decorationPicture(decoration) {
  const make = (name, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    return made;
  };
  const { centre, half } = decorationBox(decoration);
  const paints = ["fill", "stroke"].map(name => isColour(decoration[name]) ? decoration[name] : "none");
  const width = paints[1] === "none" ? 0 : decoration.width ?? 0.01;
  const size = 1.15 * (2 * Math.max(...half) + width) || 1;
  const svg = make("svg", { viewBox: `${centre[0] - size / 2} ${-centre[1] - size / 2} ${size} ${size}`, "aria-hidden": "true" });
  const outline = decorationOutline(decoration).map(point => point.join()).join(" ");
  const isLine = formKind(decoration) === "line";
  svg.append(make(isLine ? "polyline" : "polygon", {
    points: outline, fill: isLine ? "none" : paints[0], stroke: paints[1], transform: "scale(1 -1)",
    "stroke-width": Math.max(width, size / 24), "stroke-linejoin": "round", "stroke-linecap": "round",
  }));
  svg.style.background = paintOn(paints.find(isColour));
  return svg;
}

// The list stays the same through all that the panel shows: whoever walks through it with the arrows stays in it.
class EditorDecorations {
  constructor(editor) {
    this.editor = editor;
    this.root = editorElement("div", "editor-decorations");
    this.list = editorElement("ul", "editor-decoration-list");
    this.list.setAttribute("role", "listbox");
    this.list.setAttribute("aria-label", "Decorations, those in front first");
    this.list.tabIndex = 0;
    this.list.addEventListener("keydown", event => this.keyDown(event));
    this.options = [];
    this.none = editorElement("p", "editor-note", "Nothing is painted on this part yet.");
    const adds = this.buttons("Add", EDITOR_FORMS, kind => this.add(kind));
    this.firstAdd = adds.buttons.values().next().value;
    for (const [kind, button] of adds.buttons) button.setAttribute("aria-label", `Add: ${kind}`);
    this.acts = this.buttons("The chosen decoration", EDITOR_DECORATION_ACTS, name => this.act(name));
    const hint = editorElement("p", "editor-note", "Add one, in front of the others:");
    this.root.append(hint, adds.root, this.none, this.list, this.acts.root);
  }

  // Where the focus goes.
  get control() { return this.list.hidden ? this.firstAdd : this.list; }

  buttons(label, entries, press) {
    const root = editorElement("div", "editor-strip");
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", label);
    const buttons = new Map(entries.map(([name, key, word, icon]) => {
      const button = editorElement("button", "editor-strip-button");
      button.type = "button";
      button.title = word;
      button.append(editorIcon(icon), editorElement("span", "editor-word", word));
      if (key) button.setAttribute("aria-keyshortcuts", key);
      button.addEventListener("click", () => { if (button.getAttribute("aria-disabled") !== "true") press(name); });
      return [name, button];
    }));
    root.append(...buttons.values());
    return { root, buttons };
  }

  show(field) {
    this.field = field;
    const { present, selection } = this.editor;
    const part = present.parts[selection.index];
    const decorations = decorationsOf(part);
    const chosen = decorations[selection.decoration] ? selection.decoration : -1;
    while (this.options.length > decorations.length) this.options.pop().remove();
    // The last of the file is the first of the list.
    while (this.options.length < decorations.length) {
      const option = this.option(this.options.length);
      this.options.push(option);
      this.list.prepend(option);
    }
    decorations.forEach((decoration, i) => this.showOption(this.options[i], decoration, i === chosen));
    this.list.hidden = this.acts.root.hidden = !decorations.length;
    this.none.hidden = decorations.length > 0;
    if (document.activeElement?.closest(".editor-decorations [hidden]")) this.control.focus({ preventScroll: true });
    this.mark(chosen);
    const isIdle = { up: chosen < 0 || chosen === decorations.length - 1, down: chosen <= 0 };
    for (const [name, button] of this.acts.buttons) button.setAttribute("aria-disabled", String(isIdle[name] ?? chosen < 0));
  }

  option(index) {
    const option = editorElement("li", "editor-decoration");
    option.setAttribute("role", "option");
    option.id = `editor-decoration-${index}`;
    option.addEventListener("click", () => this.choose(index));
    return option;
  }

  showOption(option, decoration, isChosen) {
    option.setAttribute("aria-selected", String(isChosen));
    const shown = JSON.stringify(decoration);
    if (option.shown === shown) return;
    option.shown = shown;
    const { fill, stroke } = decoration;
    const paints = [fill && `filled ${fill}`, stroke && `line ${stroke}`].filter(Boolean).join(", ");
    option.setAttribute("aria-label", `${decorationWord(decoration)}, ${paints || "invisible"}`);
    option.replaceChildren(decorationPicture(decoration), editorElement("span", "", decorationWord(decoration)));
    if (!paints) option.append(editorElement("small", "", "invisible"));
  }

  // Shows which is chosen, and scrolls the list alone: the page stays where it is.
  mark(chosen) {
    const { list } = this;
    const option = this.options[chosen];
    if (!option) { list.removeAttribute("aria-activedescendant"); return; }
    list.setAttribute("aria-activedescendant", option.id);
    const top = option.offsetTop;
    const room = list.clientHeight - option.offsetHeight;
    list.scrollTop = Math.min(Math.max(list.scrollTop, top - room), top);
  }

  choose(decoration) {
    if (this.options[decoration]) this.editor.chooseDecoration(this.editor.selection.index, decoration);
  }

  add(kind) {
    const { editor } = this;
    const { index } = editor.selection;
    if (decorationsOf(editor.present.parts[index]).length >= EDITOR_MOST_DECORATIONS) {
      editor.say(`At most ${EDITOR_MOST_DECORATIONS} decorations of a part.`);
      return;
    }
    editor.setTool("select");
    editor.edit(c => { editor.selection = { kind: "part", index, decoration: addDecoration(c.parts[index], kind) }; });
    editor.say("Painted. Drag it, or its handles.");
  }

  act(name) {
    if (name === "up" || name === "down") this.reorder(name === "up" ? 1 : -1);
    else this.editor.act(name);
  }

  reorder(step) {
    const { editor } = this;
    const { index, decoration } = editor.selection;
    const to = decoration + step;
    const all = decorationsOf(editor.present.parts[index]);
    if (!all[decoration] || !all[to]) return;
    editor.edit(c => {
      const { decorations } = c.parts[index].look;
      [decorations[decoration], decorations[to]] = [decorations[to], decorations[decoration]];
      editor.selection = { ...editor.selection, decoration: to };
    });
    editor.say(`${all.length - to} of ${all.length} from the front.`);
  }

  keyDown(event) {
    const { selection } = this.editor;
    const last = this.options.length - 1;
    const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const chosen = this.options[selection.decoration] ? selection.decoration : null;
    if (step && event.altKey) this.reorder(step);
    else if (step) this.choose(chosen === null ? (step > 0 ? 0 : last) : Math.min(Math.max(chosen + step, 0), last));
    else if (event.key === "Home") this.choose(last);
    else if (event.key === "End") this.choose(0);
    else return;
    event.preventDefault();
  }
}
