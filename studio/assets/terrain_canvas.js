// The canvas of the terrain editor: where things are on it, and how they are drawn. The ground is drawn as in an arena.

const TERRAIN_GRID = [0.1, 0.5, 1, 5, 10, 50, 100];
const TERRAIN_RULERS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200];

class TerrainCanvas extends EditorCanvas {
  constructor(editor, canvas) {
    super(editor, canvas);
    Object.assign(this, { place: null, hovered: -1 });
  }

  lookAt(x, raise) {
    this.stage.centreX = editorBounded(x, [-100, TERRAIN_END + 300], 0);
    this.stage.raise = editorBounded(raise, [-5000, 5000], 0);
    this.redraw();
  }

  // By shares of what can be seen.
  pan(x, y) {
    const { stage } = this;
    this.lookAt(stage.centreX + x * stage.width / stage.scale, stage.raise + y * stage.height / stage.scale);
  }

  zoomBy(factor, at = [this.stage.width / 2, this.stage.height / 2]) {
    const { stage } = this;
    const [x, y] = this.world(at);
    stage.scale = editorBounded(stage.scale * factor, [0.2, 4000], 100);
    const [u, v] = this.world(at);
    this.lookAt(stage.centreX + x - u, stage.raise + y - v);
  }

  // Shows everything: from behind the creature to beyond the last obstacle, all heights.
  fit() {
    const { stage } = this;
    this.isFitted = stage.width > 1;
    const { drawn } = this.editor.present;
    const { back, front, top, length } = this.models().body;
    const levels = terrainLevels(drawn);
    const [left, right] = [back - front - 0.4 * length, Math.max(terrainEnd(drawn) + length, 5 * length)];
    const tops = drawn.map((obstacle, index) => levels[index] + (obstacle.box?.height ?? 0));
    const [lowest, highest] = [Math.min(...levels), Math.max(top * 1.4, ...levels, ...tops)];
    const room = [(stage.width - 40) / (right - left), (stage.height * stage.groundShare - 70) / (highest - lowest)];
    stage.scale = editorBounded(Math.min(...room), [0.2, 600], 100);
    this.lookAt((left + right) / 2, lowest);
  }

  // Brings an obstacle into view, if it is not there.
  show(index) {
    const { stage } = this;
    const { drawn } = this.editor.present;
    const { from } = obstacleSizes(drawn[index]);
    const [left, right] = [stage.screenX(from), stage.screenX(obstacleEnd(drawn[index]))];
    const y = stage.screenY(this.models().levels[index]);
    const isWide = right - left > stage.width - 80;
    const isSeen = isWide ? right > 80 && left < stage.width - 80 : left > 40 && right < stage.width - 40;
    const x = isSeen ? stage.centreX : (from + obstacleEnd(drawn[index])) / 2;
    const lift = y > 60 && y < stage.height - 40 ? 0 : stage.height * stage.groundShare - y;
    this.lookAt(x, stage.raise + lift / stage.scale);
  }

  // The ground as it is drawn, and who stands at the start.
  models() {
    this.drawn ||= this.makeModels();
    return this.drawn;
  }

  makeModels() {
    const { drawn } = this.editor.present;
    const creature = this.editor.hooks.creature?.();
    if (!this.guest || this.guest.creature !== creature) {
      const { parts } = drawableCreature(readableCreature(creature));
      const body = bodyReach(parts);
      const pose = parts.flatMap(({ position: [x, y], angle = 0 }) => [x - body.front, y, angle * EDITOR_DEGREE]);
      this.guest = { creature, body, pose: Float32Array.from(pose), model: makeModel({ parts }) };
    }
    return { ...this.guest, levels: terrainLevels(drawn), ground: drawnGround(drawn, this.guest.body) };
  }

  // The corners of an obstacle on the canvas, from left to right; a gap's reach as deep as it is.
  corners(index) {
    const { levels, ground } = this.models();
    const obstacle = this.editor.present.drawn[index];
    const { from, width } = obstacleSizes(obstacle);
    const level = levels[index];
    const place = points => points.map(point => this.screen(point));
    if (obstacle.slope) return place([[from, level], [from + width, levels[index + 1]]]);
    const inside = obstacle.box ? level + obstacle.box.height : ground.floor;
    return place([[from, level], [from, inside], [from + width, inside], [from + width, level]]);
  }

  // The obstacle under a pointer, or nearly there; -1 if there is none.
  obstacleAt(pixel, reach) {
    const { drawn } = this.editor.present;
    const isHit = slack => (_, index) => this.isOn(index, pixel, slack);
    const exact = drawn.findIndex(isHit(0));
    return exact >= 0 ? exact : drawn.findIndex(isHit(reach));
  }

  isOn(index, [x, y], slack) {
    const obstacle = this.editor.present.drawn[index];
    const corners = this.corners(index);
    const [left, right] = [corners[0], corners[corners.length - 1]];
    if (x < left[0] - slack || x > right[0] + slack) return false;
    if (obstacle.box) return y >= corners[1][1] - slack && y <= left[1] + slack;
    if (obstacle.gap) return y >= left[1] - 6 - slack;
    const share = editorBounded((x - left[0]) / (right[0] - left[0]), [0, 1], 0);
    const surface = left[1] + share * (right[1] - left[1]);
    return y >= surface - 6 - slack && y <= surface + 40;
  }

  // What can be dragged of what is selected, and where it is on the canvas. What is small has its handles further apart;
  // `offset` is how far, in the world.
  handles() {
    const { selected, tool, present } = this.editor;
    const obstacle = present.drawn[selected];
    if (!obstacle || tool !== "select") return [];
    const corners = this.corners(selected);
    const [first, last] = [corners[0], corners[corners.length - 1]];
    const apart = Math.max(15 - (last[0] - first[0]) / 2, 0);
    const middle = (first[0] + last[0]) / 2;
    const handle = (kind, [x, y], shift, lift = 0) => ({
      kind, at: [x + shift, y - lift], offset: [shift / this.stage.scale, lift / this.stage.scale],
    });
    if (obstacle.slope) return [handle("start", first, -apart), handle("end-top", last, apart)];
    if (obstacle.gap) return [handle("start", first, -apart), handle("end", last, apart)];
    const tall = first[1] - corners[1][1];
    const half = first[1] - tall / 2;
    return [
      handle("start", [first[0], half], -apart), handle("end", [last[0], half], apart),
      handle("top", [middle, corners[1][1]], 0, Math.max(15 - tall / 2, 0)),
    ];
  }

  // Where the pointer is, and what it is on, when it is not down.
  hover(place, index) {
    if (place === null && this.place === null) return;
    Object.assign(this, { place, hovered: index });
    this.redraw();
  }

  draw() {
    const { stage, editor } = this;
    if (stage.width <= 1) return;
    this.drawn = null;
    const { model, pose, ground } = this.models();
    stage.ground = ground;
    stage.drawScenery(0, { small: stage.width < 600 });
    this.drawGrid();
    if (pose.length) drawShadow(stage, model, pose);
    drawCreature(stage, model, pose);
    const failed = getComputedStyle(document.documentElement).getPropertyValue("--failed").trim();
    for (const { where } of editor.problems) this.outline(obstacleAt(where, editor.present.drawn), failed, 6);
    if (editor.tool === "select" && this.hovered !== editor.selected) this.outline(this.hovered, theme.accent, 1.5);
    this.drawSelection();
    this.drawAim();
    this.drawRuler();
  }

  // On the sky only.
  drawGrid() {
    const { stage } = this;
    const c = stage.context;
    const step = TERRAIN_GRID.find(step => step * stage.scale >= 14);
    if (!step) return;
    const pixels = step * stage.scale;
    const line = terrainOutline(this.editor.present.drawn, 2000, this.models().ground?.floor).map(point => this.screen(point));
    c.save();
    c.beginPath();
    c.moveTo(line[0][0], 0);
    for (const point of line) c.lineTo(...point);
    c.lineTo(line[line.length - 1][0], 0);
    c.clip();
    c.fillStyle = theme.mark;
    c.globalAlpha = 0.08;
    const first = stage.screenX(Math.ceil(stage.worldX(0) / step) * step);
    for (let x = first; x < stage.width; x += pixels) c.fillRect(x, 0, 1, stage.height);
    for (let y = stage.groundY % pixels; y < stage.height; y += pixels) if (y > 0) c.fillRect(0, y, stage.width, 1);
    c.restore();
  }

  outline(index, colour, width) {
    if (!this.editor.present.drawn[index]) return;
    const c = this.stage.context;
    c.beginPath();
    for (const point of this.corners(index)) c.lineTo(...point);
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.lineJoin = c.lineCap = "round";
    c.stroke();
  }

  drawSelection() {
    const { selected, present } = this.editor;
    const obstacle = present.drawn[selected];
    if (!obstacle) return;
    const c = this.stage.context;
    const corners = this.corners(selected);
    const [first, last] = [corners[0], corners[corners.length - 1]];
    c.beginPath();
    for (const point of corners) c.lineTo(...point);
    if (obstacle.slope) c.lineTo(last[0], first[1]);
    c.fillStyle = theme.accent;
    c.globalAlpha = 0.16;
    c.fill();
    c.globalAlpha = 1;
    // Where the ground would be.
    c.beginPath();
    c.moveTo(...first);
    c.lineTo(last[0], first[1]);
    c.lineTo(...last);
    c.strokeStyle = theme.accent;
    c.lineWidth = 1.5;
    c.setLineDash([4, 4]);
    c.stroke();
    c.setLineDash([]);
    this.outline(selected, theme.paper, 5);
    this.outline(selected, theme.accent, 3);
    for (const handle of this.handles()) this.drawHandle({ ...handle, kind: "size" });
    const top = Math.min(...corners.map(([, y]) => y), ...this.handles().map(({ at }) => at[1]));
    const angle = obstacle.slope ? `, ${fixed(steepness(obstacle), 0)}°` : "";
    this.drawLabel(measureObstacle(obstacle) + angle, (first[0] + last[0]) / 2, top - 13);
  }

  // Where a tool would begin.
  drawAim() {
    const { editor, place, stage } = this;
    if (place === null || editor.tool === "select" || this.hovered >= 0 || editor.hand.gesture) return;
    const x = Math.max(place, 0);
    const level = this.models().levels[roomAt(editor.present.drawn, x, 1).index];
    const [px, py] = this.screen([x, level]);
    const c = stage.context;
    c.fillStyle = theme.accent;
    c.globalAlpha = 0.5;
    c.fillRect(px - 0.5, 0, 1, py);
    c.globalAlpha = 1;
    this.drawDot([px, py], 5, true);
    this.drawLabel(`${fixed(x, 2)} m`, px, py - 12);
  }

  // How long a metre is, or more of them.
  drawRuler() {
    const { stage } = this;
    const c = stage.context;
    const length = TERRAIN_RULERS.find(length => length * stage.scale >= 56) || 500;
    const [left, y, wide] = [16, stage.height - 16, length * stage.scale];
    for (const [colour, extra] of [[theme.paper, 3], [theme.ink, 0]]) {
      c.fillStyle = colour;
      c.fillRect(left - extra / 2, y - extra / 2, wide + extra, 2 + extra);
      for (const x of [left, left + wide - 2]) c.fillRect(x - extra / 2, y - 7 - extra / 2, 2 + extra, 9 + extra);
    }
    this.drawLabel(`${length} m`, left + wide / 2, y - 6);
  }
}
