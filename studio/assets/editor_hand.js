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
