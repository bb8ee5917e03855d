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

  // Decorations of the selected part under a pointer, the topmost first: inside what is filled, or near an edge.
  decorationsAt([x, y], reach) {
    const { stage, editor } = this;
    const c = stage.context;
    const at = [x * stage.ratio, y * stage.ratio];
    const { position, angle = 0, look } = editor.present.parts[editor.part];
    stage.partTransform(...position, angle * EDITOR_DEGREE);
    const isHit = decoration => {
      if (!canDraw(decoration)) return false;
      const { path, fill, width } = decorationPath(decoration);
      c.lineWidth = Math.max(width, reach / stage.scale);
      return (fill && c.isPointInPath(path, ...at)) || c.isPointInStroke(path, ...at);
    };
    const found = decorationsOf({ look }).map((_, i) => i).filter(i => isHit(look.decorations[i])).reverse();
    stage.resetTransform();
    return found;
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
    if (editor.decoration) return tool === "select" ? this.decorationHandles() : found;
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

  decorationHandles() {
    const { part, present, decoration } = this.editor;
    const place = point => this.screen(partToWorld(present.parts[part], point));
    return decorationHandles(decoration, 1 / this.stage.scale).map(handle => ({ ...handle, at: place(handle.at) }));
  }

  handleAt([x, y], reach) {
    const far = ({ at }) => Math.hypot(at[0] - x, at[1] - y);
    return this.handles().filter(handle => far(handle) <= reach).sort((a, b) => far(a) - far(b))[0];
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
    const { present, decoration } = this.editor;
    const active = decoration ? -1 : this.editor.joint;
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
    const { part, present, decoration } = editor;
    if (decoration) {
      this.outline(part, theme.accent, 1.5, [5, 4]);
      this.outlineDecoration(decoration);
    } else if (part >= 0 && editor.selection.kind === "part") {
      for (const other of subtreeOf(hangingTree(present), part).slice(1)) this.outline(other, theme.accent, 1.5, [5, 4]);
      this.outline(part, theme.paper, 4.5);
      this.outline(part, theme.accent, 2.5);
    }
    for (const handle of this.handles()) this.drawHandle(handle);
  }

  outlineDecoration(decoration) {
    const { stage, editor } = this;
    if (!canDraw(decoration)) return;
    const c = stage.context;
    const { position, angle = 0 } = editor.present.parts[editor.part];
    c.save();
    stage.partTransform(...position, angle * EDITOR_DEGREE);
    for (const [colour, width] of [[theme.paper, 4], [theme.accent, 2]]) {
      c.strokeStyle = colour;
      c.lineWidth = width / stage.scale;
      c.stroke(decorationPath(decoration).path);
    }
    c.restore();
    this.drawFinder(decoration, position, angle);
  }

  // A ring around what is hardly seen.
  drawFinder(decoration, position, angle) {
    const { centre, half } = decorationBox(decoration);
    if (Math.max(...half) * this.stage.scale > 9) return;
    const c = this.stage.context;
    c.beginPath();
    c.arc(...this.screen(partToWorld({ position, angle }, centre)), 13, 0, 2 * Math.PI);
    for (const [colour, width] of [[theme.paper, 3.5], [theme.accent, 1.5]]) {
      c.strokeStyle = colour;
      c.lineWidth = width;
      c.stroke();
    }
  }

  drawHandle({ kind, at: [x, y], which }) {
    const c = this.stage.context;
    if (kind === "paint") return;
    if (kind === "between") { this.drawDot([x, y], 3, false); return; }
    if (kind === "size" || kind === "side" || kind === "point") {
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
