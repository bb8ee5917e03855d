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
    surface.addEventListener("dblclick", event => this.twice(event));
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
    const handle = canvas.handleAt(pixel, reach);
    if (handle && handle.kind !== "paint") return { move: this.pulling(handle) };
    if (editor.decoration) {
      const { decoration } = editor.selection;
      const painted = canvas.decorationsAt(pixel, reach);
      if (handle && !painted.includes(decoration)) painted.unshift(decoration);
      if (painted.length) return this.pickingDecoration(painted, world);
    }
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

  // Like `picking`, among the decorations of the selected part.
  pickingDecoration(found, world) {
    const { editor } = this;
    const { selection } = editor;
    const choose = decoration => editor.chooseDecoration(selection.index, decoration);
    const isAgain = found.includes(selection.decoration);
    if (!isAgain) choose(found[0]);
    const below = found[(found.indexOf(selection.decoration) + 1) % found.length];
    const move = { select: this.shifting, turn: this.spinning, scale: this.growing }[editor.tool];
    return { click: isAgain ? () => choose(below) : undefined, move: move.call(this, world) };
  }

  // A second click soon after the first goes from a part to what is painted there, or takes a point out of a decoration.
  twice(event) {
    const { editor, canvas } = this;
    if (editor.tool === "part" || editor.tool === "joint") return;
    const pixel = canvas.pixel(event);
    const handle = canvas.handleAt(pixel, 9);
    if (editor.decoration) {
      const fewest = EDITOR_FEWEST_POINTS[formKind(editor.decoration)];
      if (handle?.kind !== "point" || formOf(editor.decoration).points.length <= fewest) return;
      editor.previewDecoration(decoration => formOf(decoration).points.splice(handle.which, 1));
      editor.commit();
      return;
    }
    const [index] = canvas.partsAt(canvas.world(pixel), pixel, 9);
    if (index === undefined || handle || canvas.jointsAt(pixel, 9).length) return;
    editor.select({ kind: "part", index });
    const [decoration] = canvas.decorationsAt(pixel, 9);
    if (decoration !== undefined) editor.chooseDecoration(index, decoration);
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

  // Whole centimetres, or millimetres where they can be told apart.
  get paintStep() { return this.canvas.stage.scale < 2500 ? 0.01 : 0.001; }

  // A point in the frame of the selected part: the part's middle or an end within reach, else a whole number of steps. What
  // hardly moves along an axis stays where it is on it.
  paintPlace(world, isFree, before = [NaN, NaN]) {
    const part = this.present.parts[this.editor.part];
    const step = this.paintStep;
    const own = worldToPart(part, world);
    if (isFree) return own;
    const near = [part.position, ...partEnds(part)].find(([x, y]) => Math.hypot(x - world[0], y - world[1]) <= this.reach);
    if (near) return worldToPart(part, near);
    return own.map((value, axis) => Math.abs(value - before[axis]) < step / 2 ? before[axis] : Math.round(value / step) * step);
  }

  // Drags the chosen decoration by its middle, a polygon or a line by its first point.
  shifting(start) {
    const { editor } = this;
    const { centre, points } = formOf(editor.decoration);
    const own = centre || points?.[0] || [0, 0];
    const [x, y] = partToWorld(this.present.parts[editor.part], own);
    return (world, isFree) => {
      const place = this.paintPlace([x + world[0] - start[0], y + world[1] - start[1]], isFree, own);
      editor.previewDecoration(decoration => shiftDecoration(decoration, [place[0] - own[0], place[1] - own[1]]));
    };
  }

  spinning(start) {
    const { editor } = this;
    const part = this.present.parts[editor.part];
    const [x, y] = partToWorld(part, decorationBox(editor.decoration).centre);
    const direction = point => Math.atan2(point[1] - y, point[0] - x) / EDITOR_DEGREE;
    const before = formOf(editor.decoration).angle || 0;
    return (world, isFree) => {
      const turn = direction(world) - direction(start);
      const whole = Math.round((before + turn) / 5) * 5 - before;
      editor.previewDecoration(decoration => turnDecoration(decoration, isFree ? turn : whole));
    };
  }

  growing(start) {
    const { editor } = this;
    const [x, y] = partToWorld(this.present.parts[editor.part], decorationBox(editor.decoration).centre);
    const far = point => Math.max(Math.hypot(point[0] - x, point[1] - y), 0.001);
    return (world, isFree) => {
      const factor = far(world) / far(start);
      const whole = Math.max(Math.round(factor * 20) / 20, 0.05);
      editor.previewDecoration(decoration => scaleDecoration(decoration, isFree ? factor : whole));
    };
  }

  // Drags a handle of the chosen decoration.
  pullingDecoration(handle) {
    const { editor } = this;
    const { kind, which, at } = handle;
    if (kind === "spin") return this.spinning(this.canvas.world(at));
    if (kind === "side") {
      return (world, isFree) => editor.previewDecoration(decoration => {
        const snap = size => isFree ? size : Math.max(Math.round(size / this.paintStep), 1) * this.paintStep;
        pullDecorationSide(decoration, handle, worldToPart(this.present.parts[editor.part], world), snap);
      });
    }
    const replaced = kind === "point" ? 1 : 0;
    return (world, isFree) => {
      const place = roundedPlace(this.paintPlace(world, isFree));
      editor.previewDecoration(decoration => formOf(decoration).points.splice(which, replaced, place));
    };
  }

  // Drags a handle of what is selected.
  pulling(handle) {
    const { editor } = this;
    const { part, joint } = editor;
    const { kind, at, axis, sign, which } = handle;
    if (editor.decoration) return this.pullingDecoration(handle);
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
