// The creature editor: one creature, its history, what is selected, and the keys. EditorHand is the pointer's part in it,
// EditorCanvas draws it.

const EDITOR_KEYS = {
  s: "select", p: "part", j: "joint", r: "turn", c: "scale", l: "more", m: "mirror", x: "remove", Delete: "remove",
  Backspace: "remove", k: "play", g: "ground", 0: "fit", "+": "in", "=": "in", "-": "out", _: "out",
};
const EDITOR_ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const EDITOR_CHECK_DELAY = 150;

class Editor {
  constructor(root, hooks = {}) {
    Object.assign(this, { root, hooks, tool: "select", shape: "capsule", selection: null, problems: [], past: [], future: [] });
    this.checks = 0;
    this.toolbar = new EditorToolbar(this);
    this.panel = new EditorPanel(this);
    this.list = new EditorProblems(this);
    this.buildFrame();
    readTheme();
    this.canvas = new EditorCanvas(this, this.surface);
    this.hand = new EditorHand(this, this.canvas);
    document.addEventListener("keydown", event => this.keyDown(event));
    document.addEventListener("keyup", event => { if (event.key === " ") this.hand.isPanning = false; });
    this.load(emptyCreature());
  }

  buildFrame() {
    this.surface = editorElement("canvas", "editor-canvas");
    this.surface.tabIndex = 0;
    this.surface.setAttribute("role", "application");
    this.surface.setAttribute("aria-label", "The creature. Tab goes from part to part, arrows move it, Enter goes to its fields "
      + "and Escape back.");
    this.hint = editorElement("p", "editor-hint");
    this.hint.setAttribute("role", "status");
    const scene = editorElement("div", "editor-scene");
    scene.append(this.surface, this.hint, this.toolbar.zooms.root);
    const frame = editorElement("div", "editor-frame");
    frame.append(this.toolbar.root, scene, this.list.root, this.panel.root);
    this.root.classList.add("editor");
    this.root.replaceChildren(frame);
  }

  get creature() { return structuredClone(this.present); }

  load(creature) {
    const present = readableCreature(creature);
    Object.assign(this, { present, past: [], future: [], base: null, selection: null, problems: [] });
    this.hand.drop();
    this.setTool("select");
    this.canvas.fit();
    this.checkSoon();
  }

  // Changes the creature: `change` is given a copy, and may select something in it.
  edit(change) {
    this.preview(change);
    this.commit();
  }

  // Shows a change of the creature as it was before the first preview; `commit` keeps it, `cancel` drops it.
  preview(change) {
    this.base ||= { json: JSON.stringify(this.present), selection: this.selection };
    const next = JSON.parse(this.base.json);
    this.selection = this.base.selection;
    change(next);
    this.present = next;
    this.refresh();
  }

  cancel() {
    if (!this.base) return;
    Object.assign(this, { present: JSON.parse(this.base.json), selection: this.base.selection, base: null });
    this.refresh();
  }

  commit() {
    const { base, present, selection } = this;
    if (!base) return;
    this.base = null;
    const list = selection?.kind === "joint" ? "joints" : "parts";
    const selected = selection && present[list][selection.index];
    orderParts(present);
    groundCreature(present);
    if (selected) this.selection = { kind: selection.kind, index: present[list].indexOf(selected) };
    if (JSON.stringify(present) !== base.json) {
      this.past.push(base);
      this.future = [];
      this.changed();
    }
    this.refresh();
  }

  // Goes a step through the history, from one pile to the other.
  step(from, to) {
    this.cancel();
    const entry = from.pop();
    if (!entry) return;
    to.push({ json: JSON.stringify(this.present), selection: this.selection });
    this.present = JSON.parse(entry.json);
    this.selection = entry.selection;
    this.changed();
    this.refresh();
  }

  changed() {
    this.checkSoon();
    this.hooks.changed?.(this.creature);
  }

  // Asks for the problems once the creature has been left alone for a moment; an answer that is overtaken is dropped.
  checkSoon() {
    const turn = ++this.checks;
    clearTimeout(this.timer);
    this.timer = setTimeout(async () => {
      const creature = this.creature;
      const problems = await this.askForProblems(creature);
      if (turn !== this.checks) return;
      this.problems = problems;
      this.list.show(problems, creature);
      this.canvas.redraw();
    }, EDITOR_CHECK_DELAY);
  }

  async askForProblems(creature) {
    try {
      const found = await this.hooks.check?.(structuredClone(creature));
      return (Array.isArray(found) ? found : []).map(problem => ({
        where: String(problem?.where ?? ""), message: String(problem?.message ?? problem),
      }));
    } catch (error) {
      return [{ where: "", message: `could not be checked: ${error?.message ?? error}` }];
    }
  }

  select(selection) {
    this.selection = selection;
    this.refresh();
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
      this.selection = null;
    });
    this.canvas.fit();
    this.setTool("part");
  }

  copy(make) {
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

  remove() {
    const { selection } = this;
    if (!selection) {
      this.say("Select a part first.");
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
    const { part, joint } = this;
    if (this.selection?.kind === "joint") {
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

  // Keys work wherever the focus is in the editor, or nowhere, as long as no control wants the key.
  keyDown(event) {
    const { target, key } = event;
    const isNowhere = target === document.body;
    if (event.defaultPrevented || !this.root.getClientRects().length || !(isNowhere || this.root.contains(target))) return;
    const field = target.closest("input, select, textarea");
    const isTyping = field && field.dataset.shown !== undefined && field.value !== field.dataset.shown;
    let isDone;
    if (event.ctrlKey || event.metaKey) isDone = !isTyping && this.historyKey(event);
    else if (key === "Escape") isDone = this.escape(isNowhere || target === this.surface);
    else isDone = !field && !event.altKey && this.plainKey(event, target === this.surface, isNowhere);
    if (isDone) event.preventDefault();
  }

  historyKey({ key, shiftKey }) {
    const letter = key.toLowerCase();
    if (letter !== "z" && letter !== "y") return false;
    this.act(letter === "y" || shiftKey ? "redo" : "undo");
    return true;
  }

  // Out of a drag, else out of the fields, else out of the selection.
  escape(isOutside) {
    if (this.hand.gesture) this.hand.drop();
    else if (isOutside) this.select(null);
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

// The pointers on the canvas, one or more, and the gesture that they are making. A gesture says what to do as it moves, and
// what if it has not moved when it ends.
class EditorHand {
  constructor(editor, canvas) {
    Object.assign(this, { editor, canvas, pointers: new Map(), gesture: null, isPanning: false });
    const surface = canvas.stage.canvas;
    surface.addEventListener("pointerdown", event => this.down(event));
    surface.addEventListener("pointermove", event => this.move(event));
    surface.addEventListener("pointerup", event => this.up(event));
    surface.addEventListener("pointercancel", event => {
      this.pointers.delete(event.pointerId);
      this.drop();
    });
    surface.addEventListener("wheel", event => {
      event.preventDefault();
      // Pinched touchpads report small steps with Ctrl held, some browsers report lines.
      const step = event.deltaY * (event.ctrlKey ? 5 : 1) * (event.deltaMode ? 30 : 1);
      canvas.zoomBy(Math.exp(-0.002 * editorBounded(step, [-300, 300], 0)), canvas.pixel(event));
    }, { passive: false });
  }

  get present() { return this.editor.present; }
  // How far things snap, in the world.
  get reach() { return 10 / this.canvas.stage.scale; }

  down(event) {
    if (event.button > 1) return;
    const surface = this.canvas.stage.canvas;
    surface.focus({ preventScroll: true });
    // Only pointers that exist can be captured: those of scripts do not.
    if (event.isTrusted) surface.setPointerCapture(event.pointerId);
    const pixel = this.canvas.pixel(event);
    this.pointers.set(event.pointerId, pixel);
    if (this.pointers.size > 2) return;
    this.drop();
    const gesture = this.pointers.size === 2 ? this.pinching() : this.begin(pixel, event);
    this.gesture = { ...gesture, start: pixel };
  }

  move(event) {
    if (!this.pointers.has(event.pointerId)) return;
    const pixel = this.canvas.pixel(event);
    this.pointers.set(event.pointerId, pixel);
    const { gesture } = this;
    if (!gesture) return;
    const slack = event.pointerType === "touch" ? 8 : 4;
    gesture.hasMoved ||= Math.hypot(pixel[0] - gesture.start[0], pixel[1] - gesture.start[1]) >= slack;
    if (gesture.hasMoved) gesture.move?.(this.canvas.world(pixel), event.altKey, pixel);
  }

  up(event) {
    const { gesture } = this;
    if (!this.pointers.delete(event.pointerId) || !gesture) return;
    this.gesture = null;
    if (!gesture.hasMoved) gesture.click?.();
    this.editor.commit();
  }

  drop() {
    this.gesture = null;
    this.editor.cancel();
  }

  // What a pointer that goes down here is about to do.
  begin(pixel, { button, pointerType, altKey }) {
    const { editor, canvas } = this;
    const world = canvas.world(pixel);
    const reach = pointerType === "touch" ? 22 : 9;
    const pan = { move: this.panning(pixel), click: () => editor.select(null) };
    if (button === 1 || this.isPanning) return { move: pan.move };
    if (editor.tool === "part") {
      const [index] = partsAt(this.present, world);
      const click = () => editor.select(index === undefined ? null : { kind: "part", index });
      return { click, move: this.drawing(world, altKey) };
    }
    if (editor.tool === "joint") return { move: pan.move, click: () => editor.joinAt(this.snapped(world, altKey), editor.part) };
    const handle = canvas.handles().find(({ at }) => Math.hypot(at[0] - pixel[0], at[1] - pixel[1]) <= reach);
    if (handle) return { move: this.pulling(handle) };
    const joints = editor.tool === "select" ? canvas.jointsAt(pixel, reach) : [];
    if (joints.length) return this.picking("joint", joints, world);
    const parts = canvas.partsAt(world, pixel, reach);
    return parts.length ? this.picking("part", parts, world) : pan;
  }

  // Selects what lies on top, or keeps what is selected already; a second click goes to what lies below.
  picking(kind, found, world) {
    const { editor } = this;
    const isAgain = editor.selection?.kind === kind && found.includes(editor.selection.index);
    const index = isAgain ? editor.selection.index : found[0];
    if (!isAgain) editor.select({ kind, index });
    const below = found[(found.indexOf(index) + 1) % found.length];
    const click = isAgain ? () => editor.select({ kind, index: below }) : undefined;
    if (kind === "joint") return { click, move: this.movingJoint(index) };
    const move = { select: this.moving, turn: this.turning, scale: this.scaling }[editor.tool];
    return { click, move: move.call(this, index, world) };
  }

  snapped(point, isFree) {
    return isFree ? point : nearestEnd(this.present, [], point, this.reach) || point.map(value => editorRounded(value, 2));
  }

  panning(start) {
    const { stage } = this.canvas;
    const { centreX, raise } = stage;
    return (_, isFree, pixel) => {
      this.canvas.lookAt(centreX - (pixel[0] - start[0]) / stage.scale, raise + (pixel[1] - start[1]) / stage.scale);
    };
  }

  pinching() {
    const fingers = () => {
      const [[x1, y1], [x2, y2]] = this.pointers.values();
      return { middle: [(x1 + x2) / 2, (y1 + y2) / 2], spread: Math.max(Math.hypot(x2 - x1, y2 - y1), 1) };
    };
    let before = fingers();
    return { move: () => {
      if (this.pointers.size < 2) return;
      const now = fingers();
      this.panning(before.middle)(null, false, now.middle);
      this.canvas.zoomBy(now.spread / before.spread, now.middle);
      before = now;
    } };
  }

  moving(index, [x, y]) {
    return (world, isFree) => this.editor.preview(c => {
      moveSubtree(c, index, snappedShift(c, index, [world[0] - x, world[1] - y], isFree ? null : this.reach));
    });
  }

  movingJoint(index) {
    return (world, isFree) => this.editor.preview(c => { c.joints[index].anchor = roundedPoint(this.snapped(world, isFree)); });
  }

  turning(index, start) {
    const [x, y] = pivotOf(this.present, index);
    const direction = point => Math.atan2(point[1] - y, point[0] - x) / EDITOR_DEGREE;
    const before = this.present.parts[index].angle || 0;
    return (world, isFree) => {
      const turn = direction(world) - direction(start);
      this.editor.preview(c => turnSubtree(c, index, isFree ? turn : Math.round((before + turn) / 5) * 5 - before));
    };
  }

  scaling(index, start) {
    const [x, y] = pivotOf(this.present, index);
    const far = point => Math.max(Math.hypot(point[0] - x, point[1] - y), 0.01);
    return (world, isFree) => {
      const factor = far(world) / far(start);
      this.editor.preview(c => scaleSubtree(c, index, isFree ? factor : Math.max(Math.round(factor * 20) / 20, 0.05)));
    };
  }

  // Drags a handle of what is selected.
  pulling({ kind, at, axis, sign, which }) {
    const { editor } = this;
    const { part, joint } = editor;
    if (kind === "turn") return this.turning(part, this.canvas.world(at));
    if (kind === "size") return (world, isFree) => editor.preview(c => pullSide(c, part, axis, sign, world, isFree));
    return (world, isFree) => editor.preview(c => pullLimit(c.joints[joint], c.parts[part], which, world, isFree));
  }

  // Draws a part, hung on what lies below its beginning; on the selected part, if that does.
  drawing(start, isFreeStart) {
    const { editor } = this;
    const from = this.snapped(start, isFreeStart);
    const below = partsAt(this.present, start);
    const parent = below.includes(editor.part) ? editor.part : below[0] ?? -1;
    const isLimb = parent >= 0 || editor.shape === "capsule";
    return (world, isFree) => editor.preview(c => {
      const to = isFree ? world : isLimb ? snappedTip(c, editor.shape, from, world, this.reach) : this.snapped(world, false);
      const isTooSmall = Math.hypot(to[0] - from[0], to[1] - from[1]) < 0.02;
      if (isTooSmall || c.parts.length >= EDITOR_MOST_PARTS) return;
      editor.selection = { kind: "part", index: addDrawnPart(c, editor.shape, from, to, parent) };
    });
  }
}

// The canvas: where things are on it, and how they are drawn.

// How large the arc of the selected joint is, in pixels.
const EDITOR_ARC = 54;
const EDITOR_TURN_ICON = new Path2D(EDITOR_TOOLS.find(([name]) => name === "turn")[3]);

class EditorCanvas {
  constructor(editor, canvas) {
    this.editor = editor;
    this.stage = new Stage(canvas, 0.8);
    new ResizeObserver(() => {
      if (!this.isFitted) this.fit();
      this.draw();
    }).observe(canvas);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      readTheme();
      this.redraw();
    });
  }

  pixel({ clientX, clientY }) {
    const box = this.stage.canvas.getBoundingClientRect();
    return [clientX - box.left, clientY - box.top];
  }

  world([x, y]) { return [this.stage.worldX(x), (this.stage.groundY - y) / this.stage.scale]; }
  screen([x, y]) { return [this.stage.screenX(x), this.stage.screenY(y)]; }

  lookAt(x, raise) {
    this.stage.centreX = editorBounded(x, [-150, 150], 0);
    this.stage.raise = editorBounded(raise, [-150, 150], 0);
    this.redraw();
  }

  // The point `at` stays where it is.
  zoomBy(factor, at = [this.stage.width / 2, this.stage.height / 2]) {
    const { stage } = this;
    const [x, y] = this.world(at);
    stage.scale = editorBounded(stage.scale * factor, [4, 8000], 100);
    const [u, v] = this.world(at);
    this.lookAt(stage.centreX + x - u, stage.raise + y - v);
  }

  // Shows the whole creature, with room for legs around a small one.
  fit() {
    const { stage } = this;
    this.isFitted = stage.width > 1;
    const { parts } = drawableCreature(this.editor.present);
    const points = parts.flatMap(part => corners(part).map(point => partToWorld(part, point)));
    const [xs, ys] = [0, 1].map(axis => points.map(point => point[axis]).filter(Number.isFinite));
    const [left, right, top] = xs.length ? [Math.min(...xs), Math.max(...xs), Math.max(...ys, 0.9)] : [0, 0, 0.9];
    const room = [(stage.width - 60) / Math.max(right - left, 1.4), (stage.height * stage.groundShare - 80) / top];
    stage.scale = editorBounded(Math.min(...room), [4, 2000], 100);
    this.lookAt((left + right) / 2, 0);
  }

  // Parts under a pointer: by their shapes, else by what is painted on them, else those that are nearly hit.
  partsAt(world, pixel, reach) {
    const exact = partsAt(this.editor.present, world);
    if (exact.length) return exact;
    const painted = this.paintedAt(pixel);
    return painted.length ? painted : partsAt(this.editor.present, world, reach / 2 / this.stage.scale);
  }

  paintedAt([x, y]) {
    const { stage } = this;
    const { ratio } = stage;
    const { model, pose } = this.models();
    const found = [...model.order].reverse().filter(({ index, decorations }) => {
      stage.partTransform(...pose.subarray(3 * index, 3 * index + 3));
      return decorations.some(({ path, fill }) => fill && stage.context.isPointInPath(path, x * ratio, y * ratio));
    });
    stage.resetTransform();
    return found.map(part => part.index);
  }

  jointsAt(pixel, reach) {
    const { joints } = this.editor.present;
    const isNear = ({ anchor }) => {
      const [x, y] = this.screen(anchor);
      return Math.hypot(x - pixel[0], y - pixel[1]) <= reach;
    };
    return joints.map((_, index) => index).filter(index => isNear(joints[index]));
  }

  // A point at which a part overlaps another it is not joined to; undefined if there is none.
  overlap(part) {
    const { present } = this.editor;
    const tree = hangingTree(present);
    const points = [...partEnds(present.parts[part]), present.parts[part].position, ...present.parts.flatMap(partEnds)];
    const isApart = other => other !== part && tree.parent[other] !== part && tree.parent[part] !== other;
    return points.find(point => {
      const found = partsAt(present, point);
      return found.includes(part) && found.some(isApart);
    });
  }

  // What can be dragged of what is selected, and where it is on the canvas.
  handles() {
    const { editor } = this;
    const { present, part, joint, tool } = editor;
    const found = [];
    const hinge = present.joints[joint];
    if (hinge && part >= 0 && tool === "select") {
      const [x, y] = this.screen(hinge.anchor);
      for (const which of [0, 1]) {
        const angle = (limitDirection(present.parts[part], hinge.anchor) + hinge.limits[which]) * EDITOR_DEGREE;
        found.push({ kind: "limit", which, at: [x + EDITOR_ARC * Math.cos(angle), y - EDITOR_ARC * Math.sin(angle)] });
      }
    }
    if (editor.selection?.kind !== "part" || tool === "part" || tool === "joint") return found;
    const body = present.parts[part];
    const place = point => this.screen(partToWorld(body, point));
    if (tool !== "scale") found.push({ kind: "turn", at: place(this.turnHandle(body, hinge)) });
    if (tool === "select") {
      const half = halfExtent(body.shape);
      for (const [axis, sign] of [[0, -1], [0, 1], [1, -1], [1, 1]]) {
        found.push({ kind: "size", axis, sign, at: place(axis ? [0, sign * half[1]] : [sign * half[0], 0]) });
      }
    }
    return found;
  }

  // Beyond the end that is free, in the part's own frame.
  turnHandle(part, hinge) {
    const [x, y] = hinge ? worldToPart(part, hinge.anchor) : [0, 0];
    const [w, h] = halfExtent(part.shape);
    const beyond = 28 / this.stage.scale;
    return Math.abs(x) > Math.abs(y) ? [-Math.sign(x) * (w + beyond), 0] : [0, (y > 1e-6 ? -1 : 1) * (h + beyond)];
  }

  forget() {
    this.drawn = null;
    this.redraw();
  }

  redraw() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.draw();
    });
  }

  // The creature as it is drawn, and its start pose.
  models() {
    const { present } = this.editor;
    this.drawn ||= {
      model: makeModel(drawableCreature(present)),
      pose: Float32Array.from(present.parts.flatMap(({ position, angle = 0 }) => [...position, angle * EDITOR_DEGREE])),
    };
    return this.drawn;
  }

  draw() {
    const { stage } = this;
    if (stage.width <= 1) return;
    const { model, pose } = this.models();
    stage.drawScenery(0, { small: stage.width < 600 });
    this.drawGrid();
    if (pose.length) drawShadow(stage, model, pose);
    drawCreature(stage, model, pose);
    this.drawProblems();
    this.drawJoints();
    this.drawSelection();
  }

  // A line every 10 cm, where that can be told apart.
  drawGrid() {
    const { stage } = this;
    const c = stage.context;
    const step = 0.1 * stage.scale;
    if (step < 12) return;
    const bottom = Math.min(stage.groundY, stage.height);
    c.fillStyle = theme.mark;
    c.globalAlpha = 0.1;
    for (let x = stage.screenX(Math.ceil(stage.worldX(0) * 10) / 10); x < stage.width; x += step) c.fillRect(x, 0, 1, bottom);
    for (let y = stage.groundY - step; y > 0; y -= step) if (y < stage.height) c.fillRect(0, y, stage.width, 1);
    c.globalAlpha = 1;
  }

  outline(index, colour, width, dash = []) {
    const { stage } = this;
    const { model, pose } = this.models();
    const c = stage.context;
    c.save();
    stage.partTransform(...pose.subarray(3 * index, 3 * index + 3));
    c.strokeStyle = colour;
    c.lineWidth = width / stage.scale;
    c.setLineDash(dash.map(length => length / stage.scale));
    c.stroke(model.parts[index].path);
    c.restore();
  }

  drawProblems() {
    const { present, problems } = this.editor;
    const colour = getComputedStyle(document.documentElement).getPropertyValue("--failed").trim();
    for (const { where } of problems) {
      const place = problemPlace(where, present);
      const part = place?.kind === "joint" ? hangingTree(present).joint.indexOf(place.index) : place?.index ?? -1;
      if (part >= 0) this.outline(part, colour, 6);
    }
  }

  drawJoints() {
    const { present, joint: active } = this.editor;
    const tree = hangingTree(present);
    present.joints.forEach((joint, index) => {
      const child = tree.joint.indexOf(index);
      const ends = [present.parts[child], present.parts[tree.parent[child]]].filter(Boolean);
      const isApart = part => shapeDistance(part.shape, worldToPart(part, joint.anchor)) > 0;
      for (const part of ends.filter(isApart)) this.drawTether(joint.anchor, part.position);
      if (child >= 0) this.drawArc(joint, limitDirection(present.parts[child], joint.anchor), index === active);
    });
    present.joints.forEach(({ anchor }, index) => this.drawDot(this.screen(anchor), index === active ? 6 : 4.5, index === active));
  }

  // Shows that a hinge away from its part belongs to it.
  drawTether(from, to) {
    const c = this.stage.context;
    c.save();
    c.strokeStyle = theme.accent;
    c.lineWidth = 1.5;
    c.setLineDash([4, 4]);
    c.beginPath();
    c.moveTo(...this.screen(from));
    c.lineTo(...this.screen(to));
    c.stroke();
    c.restore();
  }

  drawArc({ anchor, limits }, direction, isActive) {
    const c = this.stage.context;
    const [x, y] = this.screen(anchor);
    const [from, to] = limits.map(limit => -(direction + limit) * EDITOR_DEGREE);
    const radius = isActive ? EDITOR_ARC : 15;
    c.beginPath();
    c.moveTo(x, y);
    c.arc(x, y, radius, to, from);
    c.closePath();
    c.fillStyle = theme.accent;
    c.globalAlpha = isActive ? 0.22 : 0.3;
    c.fill();
    c.globalAlpha = 1;
    if (!isActive) return;
    c.beginPath();
    c.arc(x, y, radius, to, from);
    c.strokeStyle = theme.accent;
    c.lineWidth = 2;
    c.stroke();
  }

  drawDot([x, y], radius, isFilled) {
    const c = this.stage.context;
    c.beginPath();
    c.arc(x, y, radius, 0, 2 * Math.PI);
    c.fillStyle = isFilled ? theme.accent : theme.paper;
    c.fill();
    c.lineWidth = 2;
    c.strokeStyle = isFilled ? theme.paper : theme.ink;
    c.stroke();
  }

  drawSelection() {
    const { editor } = this;
    const { part, present } = editor;
    if (part >= 0 && editor.selection.kind === "part") {
      for (const other of subtreeOf(hangingTree(present), part).slice(1)) this.outline(other, theme.accent, 1.5, [5, 4]);
      this.outline(part, theme.paper, 4.5);
      this.outline(part, theme.accent, 2.5);
    }
    for (const handle of this.handles()) this.drawHandle(handle);
  }

  drawHandle({ kind, at: [x, y], which }) {
    const c = this.stage.context;
    if (kind === "size") {
      c.fillStyle = theme.paper;
      c.strokeStyle = theme.accent;
      c.lineWidth = 2;
      c.beginPath();
      c.roundRect(x - 4.5, y - 4.5, 9, 9, 2);
      c.fill();
      c.stroke();
      return;
    }
    if (kind === "limit") {
      const { limits } = this.editor.present.joints[this.editor.joint];
      this.drawDot([x, y], 7, true);
      this.drawLabel(`${fixed(limits[which], 0)}°`, x, y - 12);
      return;
    }
    this.drawDot([x, y], 10, false);
    c.save();
    c.translate(x - 6.5, y - 6.5);
    c.scale(0.54, 0.54);
    c.lineWidth = 3.2;
    c.stroke(EDITOR_TURN_ICON);
    c.restore();
  }

  drawLabel(text, x, y) {
    const c = this.stage.context;
    c.font = `600 12px ${theme.font}`;
    c.textAlign = "center";
    c.textBaseline = "alphabetic";
    c.lineWidth = 3;
    c.strokeStyle = theme.paper;
    c.strokeText(text, x, y);
    c.fillStyle = theme.ink;
    c.fillText(text, x, y);
  }
}
