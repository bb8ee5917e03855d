// What stands around the canvas of the terrain editor: its buttons, the numbers of what is selected, all obstacles, and what
// is kept. Rows and buttons are those of the creature editor.

const TERRAIN_TOOLS = [
  ["select", "S", "Move", EDITOR_TOOLS[0][3],
    "Drag an obstacle or its handles; with Shift, all behind it comes along. Drag the sky to look around."],
  ["box", "B", "Box", "M3 19h18M8 19v-8h8v8", "Drag from the near foot of the box to its far top."],
  ["gap", "G", "Gap", "M2 9h6v11M22 9h-6v11", "Drag along the ground, from edge to edge."],
  ["slope", "L", "Slope", "M2 19h4l12-11h4",
    "Drag from the foot of the slope to its end, up or down. All behind it goes along."],
];
const TERRAIN_ACTIONS = [
  ...EDITOR_ACTIONS.filter(([name]) => ["remove", "undo", "redo", "empty"].includes(name)),
  ["keep", "Ctrl S", "Keep", "M12 3v11M7.5 9.5L12 14l4.5-4.5M4 15v5h16v-5"],
];
const TERRAIN_STARTS = [
  ["play", "P", "Play on it", "M6 12h4M8 10v4M15 11h.1M18 13h.1M6.5 7h11a4.5 4.5 0 0 1 4.4 5.4l-.6 3a2.6 2.6 0 0 1-4.5 1.2L15.5 "
    + "15h-7l-1.3 1.6a2.6 2.6 0 0 1-4.5-1.2l-.6-3A4.5 4.5 0 0 1 6.5 7z"],
  ["train", "K", "Train on it", "M7 4.5v15l12.5-7.5z"],
];

class TerrainToolbar extends ButtonGroups {
  constructor(editor) {
    super(editor);
    this.tools = this.group("Tools", TERRAIN_TOOLS, name => editor.setTool(name));
    this.actions = this.group("Actions", TERRAIN_ACTIONS, name => editor.act(name));
    this.starts = this.group("What to do on this ground", TERRAIN_STARTS, name => editor.act(name));
    this.starts.root.className = "terrain-starts";
    this.starts.buttons.forEach(button => button.classList.add("editor-play"));
    this.starts.buttons.get("play").classList.add("terrain-second");
    this.zooms = this.group("View", EDITOR_ZOOMS, name => editor.act(name));
    this.zooms.root.classList.add("editor-zooms");
  }

  refresh() {
    const { tool, selected, present, past, future } = this.editor;
    this.tools.buttons.forEach((button, name) => button.setAttribute("aria-pressed", String(name === tool)));
    const isEmpty = !present.drawn.length;
    const isIdle = { remove: selected < 0, undo: !past.length, redo: !future.length, empty: isEmpty, keep: isEmpty };
    this.actions.buttons.forEach((button, name) => { button.disabled = Boolean(isIdle[name]); });
    this.starts.buttons.forEach(button => { button.disabled = isEmpty; });
  }
}

// The fields of what is selected, or of the terrain as a whole.
function terrainFields({ drawn }, index, nameHelp) {
  const facts = drawn.length
    ? `${count(drawn.length, "obstacle", "obstacles")} on ${fixed(terrainEnd(drawn), 2)} m; level ground behind.`
    : "Level ground. Draw a box, a gap or a slope.";
  const fields = [
    { key: "ground", kind: "heading", label: "Ground" },
    {
      key: "name", kind: "text", label: "Name", get: terrain => terrain.name, set: (terrain, value) => { terrain.name = value; },
      help: nameHelp,
    },
    { key: "facts", kind: "note", label: facts },
  ];
  return index < 0 ? fields : [...fields, ...obstacleFields(drawn, index)];
}

function obstacleFields(drawn, index) {
  const obstacle = drawn[index];
  const [start, end] = placeBounds(drawn, index);
  const slack = TERRAIN_END - terrainEnd(drawn);
  const number = (key, label, bounds, get, set, help) => {
    const [least, most] = bounds.map(bound => editorRounded(bound, 4));
    return numberField(key, label, [least, most, "m"], terrain => get(terrain.drawn), (terrain, value) => set(terrain.drawn, value),
      TERRAIN_SNAP, help ?? `${editorRounded(least, 2)} to ${editorRounded(most, 2)}`);
  };
  const from = list => obstacleSizes(list[index]).from;
  const ahead = list => from(list) - obstacleRoom(list, index)[0];
  return [
    { key: "obstacle", kind: "heading", label: `${TERRAIN_NAMES[obstacleKind(obstacle)]} ${index + 1} of ${drawn.length}` },
    number("from", "Begins at", [start, end], from, (list, value) => placeObstacle(list, index, value)),
    number("ahead", "Level before it", [0, ahead(drawn) + slack], ahead,
      (list, value) => shiftObstacles(list, index, obstacleRoom(list, index)[0] + value), "moves all behind"),
    number("width", "Width", widthBounds(drawn, index), list => obstacleSizes(list[index]).width,
      (list, value) => widenObstacle(list, index, value)),
    ...(obstacle.gap ? [] : [number("height", obstacle.box ? "Height" : "Rise", heightBounds(obstacle),
      list => obstacleHeight(list[index]), (list, value) => raiseObstacle(list[index], value))]),
    ...(obstacle.slope ? [
      numberField("steepness", "Steepness", [-60, 60, "°"], terrain => steepness(terrain.drawn[index]),
        ({ drawn: list }, value) => raiseObstacle(list[index], Math.tan(value * EDITOR_DEGREE) * list[index].slope.width), 1),
    ] : []),
  ];
}

class TerrainPanel {
  constructor(editor) {
    this.editor = editor;
    this.root = editorElement("section", "editor-panel");
    this.root.setAttribute("aria-label", "This ground and what is on it");
    this.fields = editorElement("div", "terrain-fields");
    this.obstacles = new TerrainList("On it, from left to right", "Nothing yet.", describeObstacle, index => editor.pick(index));
    const nothing = "Nothing yet. What is kept can be trained and played on.";
    this.kept = new TerrainList("Kept here", nothing, ({ name }) => `Open ${name}`, index => editor.open(index));
    this.root.append(this.fields, this.obstacles.root, this.kept.root);
    this.rows = [];
  }

  refresh() {
    const { present, selected, kept, problems } = this.editor;
    const same = kept.find(({ name }) => name === present.name);
    const nameHelp = !same ? "letters, digits, spaces, - _ ." : isSameGround(same, present) ? "kept as it is here"
      : "one of this name is kept; Keep replaces it";
    const fields = terrainFields(present, selected, nameHelp);
    const signature = fields.map(field => field.key).join();
    if (signature !== this.signature) this.rebuild(fields, signature);
    fields.forEach((field, i) => this.show(this.rows[i], field));
    const wrong = new Set(problems.map(({ where }) => obstacleAt(where, present.drawn)));
    this.obstacles.show(present.drawn, index => index === selected, index => wrong.has(index));
    this.kept.show(kept, index => isSameGround(kept[index], present));
  }

  // What a number may be depends on its neighbours. Browsers would step from the least one on.
  show(row, field) {
    row.show(field);
    if (!field.bounds) return;
    const [least, most] = field.bounds;
    Object.assign(row.control, { min: Number.isInteger(least) ? least : "", max: most });
    row.control.setAttribute("aria-valuemin", least);
  }

  // Whoever is in a field stays in it.
  rebuild(fields, signature) {
    const focused = this.rows.find(row => row.root.contains(document.activeElement))?.field.key;
    this.signature = signature;
    this.rows = fields.map(field => new EditorRow(this.editor, field));
    this.fields.replaceChildren(...this.rows.map(row => row.root));
    if (focused) this.row(focused)?.control.focus();
  }

  focusFirst() { (this.row("from") || this.row("name")).control.focus(); }

  row(key) { return this.rows.find(row => row.field.key === key && row.control); }
}

// A list under a heading, of obstacles or of terrains, each a button.
class TerrainList {
  constructor(title, empty, describe, press) {
    Object.assign(this, { describe, press, shown: [] });
    this.root = editorElement("div", "terrain-list");
    this.list = editorElement("ol");
    this.empty = editorElement("p", "editor-note", empty);
    this.root.append(editorElement("h3", "editor-heading", title), this.empty, this.list);
  }

  // Only what has changed is written anew: there may be many, and this is called as things are dragged.
  show(things, isOn, isWrong) {
    this.empty.hidden = things.length > 0;
    while (this.shown.length > things.length) this.shown.pop().item.remove();
    things.forEach((thing, index) => {
      const row = this.shown[index] ??= this.add(index);
      const json = JSON.stringify(thing);
      if (row.json !== json) this.write(row, thing);
      row.json = json;
      row.button.setAttribute("aria-pressed", String(isOn(index)));
      row.button.classList.toggle("terrain-wrong", Boolean(isWrong?.(index)));
    });
  }

  write({ button, text, side }, thing) {
    button.title = this.describe(thing);
    button.setAttribute("aria-label", button.title);
    text.textContent = thing.name ?? `${TERRAIN_NAMES[obstacleKind(thing)]} ${measureObstacle(thing)}`;
    side.replaceChildren(thing.drawn ? terrainPicture(thing.drawn) : `${fixed(obstacleSizes(thing).from, 2)} m`);
  }

  add(index) {
    const item = editorElement("li");
    const button = editorElement("button", "terrain-item");
    button.type = "button";
    const [text, side] = [editorElement("span"), editorElement("span", "terrain-side")];
    button.append(text, side);
    button.addEventListener("click", () => this.press(index));
    item.append(button);
    this.list.append(item);
    return { item, button, text, side };
  }
}

// A terrain as a small silhouette.
function terrainPicture(drawn) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  const margin = Math.max(terrainEnd(drawn) * 0.06, 0.5);
  const points = terrainOutline(drawn, margin, Math.min(...terrainLevels(drawn)) - margin);
  const [xs, ys] = [0, 1].map(axis => points.map(point => point[axis]));
  const [left, right, bottom, top] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  // Low things are shown lower rather than as high as all others.
  const tall = Math.max(top - bottom, (right - left) / 16);
  const place = ([x, y]) => `${((x - left) / (right - left) * 160).toFixed(1)} ${(22 - (y - bottom) / tall * 18).toFixed(1)}`;
  path.setAttribute("d", `M0 28L${points.map(place).join("L")}L160 28z`);
  svg.setAttribute("viewBox", "0 0 160 26");
  svg.setAttribute("preserveAspectRatio", "none");
  svg.setAttribute("aria-hidden", "true");
  svg.append(path);
  return svg;
}

class TerrainProblems extends EditorProblems {
  show(problems, drawn) {
    const list = editorElement("ul");
    for (const { where, message } of problems) {
      const index = obstacleAt(where, drawn);
      const button = editorElement("button", "editor-problem");
      button.type = "button";
      // Of the path only the field: the rest is in its name.
      const text = where && message.startsWith(where) ? where.split(".").pop() + message.slice(where.length) : message;
      const about = index < 0 ? where || "ground" : `${TERRAIN_NAMES[obstacleKind(drawn[index])]} ${index + 1}`;
      button.append(editorElement("strong", "", about), ` ${text}`);
      button.addEventListener("click", () => this.editor.pick(index));
      const item = editorElement("li");
      item.append(button);
      list.append(item);
    }
    const verdict = problems.length ? editorElement("p", "editor-bad", count(problems.length, "problem", "problems"))
      : editorElement("p", "editor-fine", "No problem.");
    this.root.replaceChildren(verdict, ...(problems.length ? [list] : []));
  }
}

// Which obstacle a path such as `drawn[2].box.from` is about; -1 for the terrain as a whole.
function obstacleAt(where, drawn) {
  const index = Number(/^drawn\[(\d+)\]/.exec(where)?.[1] ?? -1);
  return index < drawn.length ? index : -1;
}
