// The creature editor: one creature, what is selected in it, and what buttons and keys do. EditorHand is the pointer's part
// in it, EditorCanvas draws it, EditorHistory goes back and forth.

const EDITOR_KEYS = {
  s: "select", p: "part", j: "joint", r: "turn", c: "scale", l: "more", m: "mirror", x: "remove", Delete: "remove",
  Backspace: "remove", k: "play", g: "ground", 0: "fit", "+": "in", "=": "in", "-": "out", _: "out",
};
const EDITOR_ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

class Editor extends EditorHistory {
  constructor(root, hooks = {}) {
    super(root, hooks);
    Object.assign(this, { tool: "select", shape: "capsule", selection: null });
    this.toolbar = new EditorToolbar(this);
    this.panel = new EditorPanel(this);
    this.list = new EditorProblems(this);
    buildFrame(this, "The creature. Tab goes from part to part, arrows move it, Enter goes to its fields "
      + "and Escape back.");
    readTheme();
    this.canvas = new EditorCanvas(this, this.surface);
    this.hand = new EditorHand(this, this.canvas);
    document.addEventListener("keydown", event => this.keyDown(event));
    document.addEventListener("keyup", event => { if (event.key === " ") this.hand.isPanning = false; });
    this.load(emptyCreature());
  }

  get creature() { return structuredClone(this.present); }

  get toCheck() { return this.present; }

  get mark() { return this.selection; }
  set mark(selection) { this.selection = selection; }

  load(creature) {
    this.cancel();
    // What was drawn before can be had back.
    if (this.past.length) Object.assign(this, { past: [...this.past, this.entry()], future: [] });
    Object.assign(this, { present: readableCreature(creature), selection: null, problems: [] });
    this.hand.drop();
    this.setTool("select");
    this.canvas.fit();
    this.checkSoon();
  }

  // Draws another in its place, which is a step back as any other.
  become(creature) {
    this.edit(drawn => {
      for (const key of Object.keys(drawn)) delete drawn[key];
      Object.assign(drawn, readableCreature(creature));
      this.selection = null;
    });
    this.canvas.fit();
  }

  // Parts from the torso outwards, and on the ground; what is selected stays so, wherever it is listed now.
  tidy() {
    const { present, selection } = this;
    const list = selection?.kind === "joint" ? "joints" : "parts";
    const selected = selection && present[list][selection.index];
    orderParts(present);
    groundCreature(present);
    if (selected) this.selection = { ...selection, index: present[list].indexOf(selected) };
  }

  changed() {
    this.checkSoon();
    this.hooks.changed?.(this.creature);
  }

  found(creature) {
    this.list.show(this.problems, creature);
    this.canvas.redraw();
  }

  select(selection) {
    this.selection = selection;
    this.refresh();
  }

  chooseDecoration(index, decoration) {
    this.select({ kind: "part", index, decoration });
    if (this.decoration) this.say(`${decorationWord(this.decoration)}. Drag it, or its handles.`);
  }

  setTool(tool) {
    this.tool = tool;
    this.surface.dataset.tool = tool;
    this.say(EDITOR_TOOLS.find(([name]) => name === tool)[4]);
    this.refresh();
  }

  setShape(shape) {
    this.shape = shape;
    this.setTool("part");
  }

  say(text) { this.hint.textContent = text; }

  refresh() {
    this.toolbar.refresh();
    this.panel.refresh();
    this.canvas.forget();
  }

  // The selected part, or the part that hangs on the selected joint; -1 if there is none.
  get part() {
    if (this.selection?.kind === "part") return this.selection.index;
    return this.selection ? hangingTree(this.present).joint.indexOf(this.selection.index) : -1;
  }

  // The selected joint, or the one on which the selected part hangs; -1 if there is none.
  get joint() {
    if (this.selection?.kind === "joint") return this.selection.index;
    return this.selection ? hangingTree(this.present).joint[this.selection.index] : -1;
  }

  // The chosen decoration of the selected part, if there is one.
  get decoration() {
    const { kind, index, decoration } = this.selection || {};
    return kind === "part" ? decorationsOf(this.present.parts[index])[decoration] : undefined;
  }

  // Shows a change of the chosen decoration.
  previewDecoration(change) {
    const { index, decoration } = this.selection;
    this.preview(c => change(c.parts[index].look.decorations[decoration]));
  }

  // Does what a button or a key other than a tool's stands for; not while a drag is under way.
  act(action) {
    if (this.hand.gesture) return;
    const acts = {
      more: () => this.copy(addOneMore), mirror: () => this.copy(mirrorSubtree), remove: () => this.remove(),
      undo: () => this.step(this.past, this.future), redo: () => this.step(this.future, this.past),
      ground: () => this.edit(c => { groundCreature(c, true); }), empty: () => this.clear(),
      out: () => this.canvas.zoomBy(0.8), in: () => this.canvas.zoomBy(1.25), fit: () => this.canvas.fit(),
      play: () => this.hooks.play?.(this.creature),
    };
    acts[action]?.();
  }

  clear() {
    this.edit(c => {
      for (const key of Object.keys(c)) delete c[key];
      Object.assign(c, emptyCreature());
      c.name = this.hooks.freeName?.(c.name) ?? c.name;
      this.selection = null;
    });
    this.canvas.fit();
    this.setTool("part");
    this.say("This is its body. Drag from the body down to the ground: that is a leg, with a hinge and a motor.");
  }

  copy(make) {
    if (this.decoration) { this.copyDecoration(make === mirrorSubtree); return; }
    const { part } = this;
    const tree = hangingTree(this.present);
    const size = part < 0 ? 0 : subtreeOf(tree, part).length;
    const isLoose = tree.parent[part] === -1;
    if (part < 0) this.say("Select a part first.");
    else if (isLoose && make === addOneMore) this.say("Only a part that hangs on another can have one more like it.");
    else if (part && this.present.parts.length + size > EDITOR_MOST_PARTS) this.say(`At most ${EDITOR_MOST_PARTS} parts.`);
    else {
      this.edit(c => { this.selection = { kind: "part", index: make(c, part) }; });
      this.say(part ? `${count(size, "part", "parts")} added.` : "Turned round.");
    }
  }

  copyDecoration(isMirror) {
    const { index, decoration } = this.selection;
    if (decorationsOf(this.present.parts[index]).length >= EDITOR_MOST_DECORATIONS) {
      this.say(`At most ${EDITOR_MOST_DECORATIONS} decorations of a part.`);
      return;
    }
    this.edit(c => {
      const copy = copyDecoration(c.parts[index], decoration, isMirror);
      if (copy >= 0) this.selection = { kind: "part", index, decoration: copy };
    });
    const isNew = this.selection.decoration !== decoration;
    this.say(isNew ? "One decoration added, just in front." : "It is its own mirror image.");
  }

  removeDecoration() {
    const { index, decoration } = this.selection;
    this.edit(c => {
      removeDecoration(c.parts[index], decoration);
      const { length } = decorationsOf(c.parts[index]);
      this.selection = { kind: "part", index, ...(length ? { decoration: Math.min(decoration, length - 1) } : {}) };
    });
    this.say("The decoration is gone.");
  }

  remove() {
    const { selection } = this;
    if (!selection) {
      this.say("Select a part first.");
    } else if (this.decoration) {
      this.removeDecoration();
    } else if (selection.kind === "joint") {
      this.edit(c => {
        c.joints.splice(selection.index, 1);
        this.selection = null;
      });
      this.say("The hinge is gone; J joins the part again.");
    } else if (selection.index === 0) {
      this.say("The torso cannot go: everything hangs on it.");
    } else {
      const parent = hangingTree(this.present).parent[selection.index];
      this.edit(c => {
        const above = c.parts[parent];
        deleteSubtree(c, selection.index);
        this.selection = above ? { kind: "part", index: c.parts.indexOf(above) } : null;
      });
    }
  }

  nudge(step) {
    const { part, joint, present } = this;
    if (this.decoration) {
      const own = turnedPoint(step, -(present.parts[part].angle || 0));
      this.previewDecoration(decoration => shiftDecoration(decoration, own));
      this.commit();
    } else if (this.selection?.kind === "joint") {
      this.edit(c => { c.joints[joint].anchor = roundedPoint(c.joints[joint].anchor.map((value, axis) => value + step[axis])); });
    } else if (part >= 0) {
      this.edit(c => moveSubtree(c, part, step));
    }
  }

  // Goes to the next part or back; false past the ends, where the focus leaves the canvas.
  cycle(step) {
    const next = this.selection ? this.part + step : step > 0 ? 0 : this.present.parts.length - 1;
    const part = this.present.parts[next];
    if (!part) return false;
    this.select({ kind: "part", index: next });
    this.say(part.name);
    return true;
  }

  // What the tool does at the selected part, for those who have no pointer.
  enter() {
    const { part } = this;
    if (this.tool === "part" && part >= 0) this.drawBelow(part);
    else if (this.tool === "joint" && part >= 0) this.joinAt(this.canvas.overlap(part), part);
    else this.panel.focusFirst();
  }

  // Draws a part from the free end of another straight down, to the ground if there is room.
  drawBelow(part) {
    const above = this.present.parts[part];
    const [x, y] = part ? pivotOf(this.present, part) : above.position;
    const far = point => Math.hypot(point[0] - x, point[1] - y);
    const from = part ? partEnds(above).reduce((a, b) => far(a) > far(b) ? a : b) : above.position;
    const tip = [from[0], from[1] > 0.1 ? 0 : from[1] - 0.3];
    this.edit(c => { this.selection = { kind: "part", index: addDrawnPart(c, this.shape, from, tip, part) }; });
  }

  // Joins the selected part, else the topmost one, with the next one at a point, or nearly there.
  joinAt(point, selected) {
    const around = point ? [0, this.hand.reach].map(reach => partsAt(this.present, point, reach)) : [[]];
    const found = around.find(parts => parts.length > 1) || [];
    const [a, b] = found.includes(selected) ? [selected, ...found.filter(part => part !== selected)] : found;
    if (b === undefined) { this.say("No two parts overlap here."); return; }
    this.edit(c => {
      const child = joinParts(c, a, b, point);
      this.selection = { kind: "joint", index: hangingTree(c).joint[child] };
    });
    this.say("Joined. Drag the ends of the arc to say how far it bends.");
  }

  // Out of a drag, else out of the fields, else out of a decoration, else out of the selection.
  escape(isOutside) {
    if (this.hand.gesture) this.hand.drop();
    else if (isOutside) this.select(this.decoration ? { kind: "part", index: this.part } : null);
    else this.surface.focus();
    return true;
  }

  // Keys that buttons and pages use themselves only work on the canvas.
  plainKey({ key, shiftKey }, onCanvas, isNowhere) {
    const arrow = EDITOR_ARROWS[key];
    const shape = EDITOR_SHAPES.find(([, digit]) => digit === key);
    const name = EDITOR_KEYS[key.length === 1 ? key.toLowerCase() : key];
    if (key === "Tab") return onCanvas && this.cycle(shiftKey ? -1 : 1);
    if (key === " " && onCanvas) this.hand.isPanning = true;
    else if (key === "Enter" && onCanvas) this.enter();
    else if (arrow && (onCanvas || (isNowhere && this.selection))) this.nudge(arrow.map(step => step * (shiftKey ? 0.05 : 0.01)));
    else if (shape) this.setShape(shape[0]);
    else if (EDITOR_TOOLS.some(([tool]) => tool === name)) this.setTool(name);
    else if (name) this.act(name);
    else return false;
    return true;
  }
}
