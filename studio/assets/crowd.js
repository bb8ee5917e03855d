// A crowd: half-transparent creatures. Of a small one each part is painted once, and then only placed, on a picture of their
// own; of a large one each part is an outline of a few corners in one colour. Sixty pictures a second of a hundred creatures
// are too many to paint in another way.

// How much of one of a crowd is seen.
const FAINT = 0.2;

// The same where its colour is to be told.
const CLEAR = 0.34;

// The same of a few.
const HALF = 0.5;

// A crowd of more than so many is a large one.
const LARGE_CROWD = 24;

// Corners that a half circle is drawn with.
const ROUND = 5;

// So many colours tell groups apart; more could not be told from each other.
const TINTS = 12;

// The colour of a group; neighbours among the numbers are far apart among the colours.
function tintOf(group) { return group * 5 % TINTS; }

function tintColour(tint) { return `hsl(${tint * 360 / TINTS} 62% ${tint % 2 ? 46 : 58}%)`; }

class Crowd {
  constructor(model, creature) {
    this.model = model;
    // What each part takes, shape and decorations: left, bottom, right, top.
    this.boxes = creature.parts.map(part => {
      const [x, y] = [0, 1].map(axis => corners(part).map(corner => corner[axis]));
      return [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)];
    });
    this.outlines = model.order.map(({ index, shape, colour, opacity }) => ({ at: index * 3, path: outline(shape), colour, opacity }));
    this.scale = 0;
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d");
  }

  // An empty picture for so many. Parts are painted anew where they would be seen much larger or smaller than they are.
  begin(stage, count) {
    this.isLarge = count > LARGE_CROWD;
    if (this.isLarge) return;
    this.share = stage.ratio;
    const [width, height] = [Math.ceil(stage.width * this.share), Math.ceil(stage.height * this.share)];
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, width, height);
    const wanted = stage.scale * this.share;
    if (wanted < this.scale * 1.2 && wanted > this.scale * 0.6) return;
    this.scale = wanted;
    this.painted = new Map();
  }

  // The parts in one colour, or in their own.
  pictures(tint) {
    if (!this.painted.has(tint)) this.painted.set(tint, this.model.order.map(part => this.paint(part, tint)));
    return this.painted.get(tint);
  }

  paint(part, tint) {
    const canvas = document.createElement("canvas");
    const [left, bottom, right, top] = this.boxes[part.index];
    canvas.width = Math.ceil((right - left) * this.scale) + 4;
    canvas.height = Math.ceil((top - bottom) * this.scale) + 4;
    const [x, y] = [2 - left * this.scale, 2 + top * this.scale];
    const c = canvas.getContext("2d");
    c.setTransform(this.scale, 0, 0, -this.scale, x, y);
    c.lineJoin = c.lineCap = "round";
    c.globalAlpha = part.opacity;
    c.fillStyle = tint === undefined ? part.colour : tintColour(tint);
    c.fill(part.path);
    // A colour says more than a face.
    if (tint === undefined) for (const { path, fill, stroke, width } of part.decorations) {
      if (fill) { c.fillStyle = fill; c.fill(path); }
      if (stroke) { c.lineWidth = width; c.strokeStyle = stroke; c.stroke(path); }
    }
    return { canvas, x, y, at: part.index * 3 };
  }

  draw(stage, pose, tint, few = false) {
    if (this.isLarge) return this.drawOutlines(stage, pose, tint);
    const c = this.context;
    const size = stage.scale * this.share / this.scale;
    c.globalAlpha = few ? HALF : tint === undefined ? FAINT : CLEAR;
    for (const { canvas, x, y, at } of this.pictures(tint)) {
      const cos = Math.cos(pose[at + 2]) * size;
      const sin = Math.sin(pose[at + 2]) * size;
      c.setTransform(cos, -sin, sin, cos, stage.screenX(pose[at]) * this.share, stage.screenY(pose[at + 1]) * this.share);
      c.drawImage(canvas, -x, -y);
    }
    c.globalAlpha = 1;
    return undefined;
  }

  drawOutlines(stage, pose, tint) {
    const c = stage.context;
    if (tint !== undefined) c.fillStyle = tintColour(tint);
    for (const { at, path, colour, opacity } of this.outlines) {
      stage.partTransform(pose[at], pose[at + 1], pose[at + 2]);
      c.globalAlpha = (tint === undefined ? FAINT : CLEAR) * opacity;
      if (tint === undefined) c.fillStyle = colour;
      c.fill(path);
    }
    c.globalAlpha = 1;
  }

  end(stage) {
    if (this.isLarge) return;
    stage.resetTransform();
    stage.context.drawImage(this.canvas, 0, 0, this.canvas.width / this.share, this.canvas.height / this.share);
  }
}

// A shape with corners only: to fill it takes half of the time.
function outline(shape) {
  const path = new Path2D();
  const arc = (y, radius, from) => {
    for (let i = 0; i <= ROUND; i++) {
      const angle = from + Math.PI * i / ROUND;
      path.lineTo(radius * Math.cos(angle), y + radius * Math.sin(angle));
    }
  };
  const [right, top] = halfExtent(shape);
  if (shape.box) path.rect(-right, -top, 2 * right, 2 * top);
  else {
    arc(top - right, right, 0);
    arc(right - top, right, Math.PI);
    path.closePath();
  }
  return path;
}
