// The terrain editor: one drawn terrain, what is selected in it, and what buttons and keys do. TerrainHand is the pointer's
// part in it, TerrainCanvas draws it, EditorHistory goes back and forth.

const TERRAIN_KEYS = {
  s: "select", b: "box", g: "gap", l: "slope", x: "remove", Delete: "remove", Backspace: "remove", k: "train", p: "play",
  0: "fit", "+": "in", "=": "in", "-": "out", _: "out",
};
const TERRAIN_PAGES = { PageUp: -0.8, PageDown: 0.8 };

class TerrainEditor extends EditorHistory {
  // Hooks: `creature` gives who stands at the start, `check` the problems of a terrain, `keep` keeps one under a name,
  // `train` and `play` go there with one that is kept.
  constructor(root, hooks = {}) {
    super(root, hooks);
    Object.assign(this, { tool: "select", selected: -1, kept: [] });
    this.present = { name: "my ground", drawn: [] };
    this.toolbar = new TerrainToolbar(this);
    this.panel = new TerrainPanel(this);
    this.list = new TerrainProblems(this);
    buildFrame(this, "The ground. Tab goes from obstacle to obstacle, arrows move one, with Shift they "
      + "make it wider or higher. With a tool, Enter makes an obstacle; else it goes to the numbers, and Escape back.", "terrain-editor");
    readTheme();
    this.canvas = new TerrainCanvas(this, this.surface);
    this.hand = new TerrainHand(this, this.canvas);
    document.addEventListener("keydown", event => this.keyDown(event));
    document.addEventListener("keyup", event => { if (event.key === " ") this.hand.isPanning = false; });
    this.setTool("box");
    this.canvas.fit();
    this.checkSoon();
  }

  get toCheck() { return { drawn: this.present.drawn }; }

  get mark() { return this.selected; }
  set mark(selected) { this.selected = selected; }

  changed() {
    this.checkSoon();
    this.tell();
    this.hooks.changed?.(structuredClone(this.present));
  }

  found({ drawn }) {
    this.list.show(this.problems, drawn);
    this.refresh();
  }

  // What was drawn and kept, to be opened again.
  setKept(terrains) {
    this.kept = terrains.filter(({ drawn }) => drawn).map(({ name, drawn }) => ({ name, drawn: readableObstacles(drawn) }));
    this.refresh();
  }

  open(index) { this.become(this.kept[index]); }

  // What was there before is a step back.
  become({ name, drawn }) {
    this.edit(terrain => {
      Object.assign(terrain, { name, drawn: readableObstacles(drawn) });
      this.selected = -1;
    });
    this.setTool("select");
    this.canvas.fit();
  }

  empty() {
    this.edit(terrain => {
      Object.assign(terrain, { name: this.freeName(), drawn: [] });
      this.selected = -1;
    });
    this.setTool("box");
    this.canvas.fit();
  }

  freeName() {
    const isTaken = name => this.kept.some(kept => kept.name === name);
    let name = "my ground";
    for (let number = 2; isTaken(name); number++) name = `my ground ${number}`;
    return name;
  }

  // Tells the name it is kept under, and nothing if it could not be.
  async keep() {
    const { name, drawn } = structuredClone(this.present);
    if (!drawn.length) { this.say("There is nothing to keep yet: draw something."); return ""; }
    if (!this.kept.some(kept => isSameGround(kept, { name, drawn }))) {
      this.say(`“${name}” is being kept …`);
      try {
        await this.hooks.keep?.(name, { drawn });
      } catch (error) {
        this.say(`Not kept: ${error?.message ?? error}`);
        if (!this.problems.length) this.panel.row("name").control.focus();
        return "";
      }
    }
    this.say(`“${name}” is kept.`);
    return name;
  }

  async keepFor(hook) {
    const name = await this.keep();
    if (name) hook?.(name);
  }

  select(index) {
    this.selected = index;
    this.refresh();
  }

  // Selects an obstacle that may be out of sight, and tells what it is.
  pick(index) {
    this.select(index);
    if (index < 0) return;
    this.canvas.show(index);
    this.tell();
  }

  setTool(tool) {
    this.tool = tool;
    this.surface.dataset.tool = tool;
    this.say(TERRAIN_TOOLS.find(([name]) => name === tool)[4]);
    this.refresh();
  }

  say(text) { this.hint.textContent = text; }

  tell() {
    const obstacle = this.present.drawn[this.selected];
    if (obstacle) this.say(describeObstacle(obstacle));
  }

  sayFull() {
    this.say(this.present.drawn.length < TERRAIN_MOST ? "There is no room for it here." : `At most ${TERRAIN_MOST} obstacles.`);
  }

  refresh() {
    this.toolbar.refresh();
    this.panel.refresh();
    this.canvas?.forget();
  }

  // Does what a button or a key other than a tool's stands for; not while a drag is under way.
  act(action) {
    if (this.hand.gesture) return;
    const acts = {
      remove: () => this.remove(), undo: () => this.step(this.past, this.future), redo: () => this.step(this.future, this.past),
      empty: () => this.empty(), keep: () => this.keep(), train: () => this.keepFor(this.hooks.train),
      play: () => this.keepFor(this.hooks.play), out: () => this.zoom(0.8), in: () => this.zoom(1.25),
      fit: () => this.canvas.fit(),
    };
    acts[action]?.();
  }

  // About what is selected, if it can be seen.
  zoom(factor) {
    const { canvas, selected } = this;
    const [x, y] = selected < 0 ? [-1, -1] : canvas.corners(selected)[0];
    const isSeen = x > 0 && x < canvas.stage.width && y > 0 && y < canvas.stage.height;
    canvas.zoomBy(factor, isSeen ? [x, y] : undefined);
  }

  remove() {
    const { selected } = this;
    if (selected < 0) { this.say("Select an obstacle first."); return; }
    const text = describeObstacle(this.present.drawn[selected]);
    this.edit(({ drawn }) => {
      drawn.splice(selected, 1);
      this.selected = Math.min(selected, drawn.length - 1);
    });
    this.say(`Gone: ${text}`);
  }

  // Arrows move what is selected, else the view; with Shift they make it wider, and up and down always higher or lower.
  nudge([x, y], isSize) {
    const { selected } = this;
    if (selected < 0) { this.canvas.pan(x * 0.1, y * 0.1); return; }
    const obstacle = this.present.drawn[selected];
    const { from, width } = obstacleSizes(obstacle);
    this.edit(({ drawn }) => {
      if (y) raiseObstacle(drawn[selected], obstacleHeight(obstacle) + y * TERRAIN_SNAP);
      else if (isSize) widenObstacle(drawn, selected, width + x * TERRAIN_SNAP);
      else placeObstacle(drawn, selected, from + x * TERRAIN_SNAP);
    });
    this.canvas.show(selected);
  }

  // Goes to the next obstacle or back; false past the ends, where the focus leaves the canvas.
  cycle(step) {
    const { length } = this.present.drawn;
    const next = this.selected >= 0 ? this.selected + step : step > 0 ? 0 : length - 1;
    if (next < 0 || next >= length) return false;
    this.pick(next);
    return true;
  }

  // Makes an obstacle behind the selected one, for those who have no pointer.
  enter() {
    if (this.tool === "select") { this.panel.focusFirst(); return; }
    let added = -1;
    this.edit(({ drawn }) => {
      added = addBehind(drawn, this.tool, this.selected >= 0 ? this.selected : drawn.length - 1);
      if (added >= 0) this.selected = added;
    });
    if (added >= 0) this.pick(added);
    else this.sayFull();
  }

  controlKey(event, isTyping) {
    if (event.key.toLowerCase() !== "s") return super.controlKey(event, isTyping);
    this.act("keep");
    return true;
  }

  // Out of a drag, else out of the fields, else out of the selection.
  escape(isOutside) {
    if (this.hand.gesture) {
      this.hand.drop();
      this.setTool(this.tool);
    } else if (isOutside) this.select(-1);
    else this.surface.focus();
    return true;
  }

  // Keys that buttons and pages use themselves only work on the canvas.
  plainKey({ key, shiftKey }, onCanvas, isNowhere) {
    const arrow = EDITOR_ARROWS[key];
    const name = TERRAIN_KEYS[key.length === 1 ? key.toLowerCase() : key];
    if (key === "Tab") return onCanvas && this.cycle(shiftKey ? -1 : 1);
    if (key === " " && onCanvas) this.hand.isPanning = true;
    else if (key === "Enter" && onCanvas) this.enter();
    else if (arrow && (onCanvas || (isNowhere && this.selected >= 0))) this.nudge(arrow, shiftKey);
    else if (TERRAIN_PAGES[key] && onCanvas) this.canvas.pan(TERRAIN_PAGES[key], 0);
    else if (TERRAIN_TOOLS.some(([tool]) => tool === name)) this.setTool(name);
    else if (name) this.act(name);
    else return false;
    return true;
  }
}
