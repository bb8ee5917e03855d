// Drawing creatures: a creature file becomes a model (paths in part coordinates, layers, colours), and a model is
// drawn in a pose on a stage, by the rules of drawing that the creature format states.

const PLAIN_COLOUR = "#8d99ae";

// The outline of a part's shape, in metres around the part's centre.
function shapePath(shape, cornerRadius) {
  const path = new Path2D();
  if (shape.circle) {
    path.arc(0, 0, shape.circle.radius, 0, 2 * Math.PI);
  } else if (shape.capsule) {
    const { length, radius } = shape.capsule;
    path.roundRect(-radius, -length / 2 - radius, 2 * radius, length + 2 * radius, radius);
  } else if (shape.box) {
    const { width, height } = shape.box;
    const corner = Math.min(cornerRadius || 0, width / 2, height / 2);
    path.roundRect(-width / 2, -height / 2, width, height, corner);
  }
  return path;
}

// Half the extent of a shape along its own x and y.
function halfExtent(shape) {
  if (shape.circle) return [shape.circle.radius, shape.circle.radius];
  if (shape.capsule) return [shape.capsule.radius, shape.capsule.length / 2 + shape.capsule.radius];
  if (shape.box) return [shape.box.width / 2, shape.box.height / 2];
  return [0.1, 0.1];
}

// The lowest point of a shape turned by an angle, relative to its centre.
function lowestPoint(shape, angle) {
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  if (shape.circle) return [0, -shape.circle.radius];
  if (shape.capsule) {
    const end = (cos > 0 ? -1 : 1) * shape.capsule.length / 2;
    return [-sin * end, cos * end - shape.capsule.radius];
  }
  const [w, h] = halfExtent(shape);
  let lowest = [0, Infinity];
  for (const [x, y] of [[-w, -h], [w, -h], [w, h], [-w, h]]) {
    const turned = x * sin + y * cos;
    if (turned < lowest[1] - 1e-3) lowest = [x * cos - y * sin, turned];
    else if (turned < lowest[1] + 1e-3) lowest = [(lowest[0] + x * cos - y * sin) / 2, turned];
  }
  return lowest;
}

// A decoration as a path with fill and stroke; null when it is of a form this page does not know.
function decorationPath({ form = {}, fill, stroke, width = 0.01 }) {
  const path = new Path2D();
  if (form.ellipse) {
    const { centre, radii, angle = 0 } = form.ellipse;
    path.ellipse(centre[0], centre[1], radii[0], radii[1], angle * Math.PI / 180, 0, 2 * Math.PI);
  } else if (form.rectangle) {
    const { centre, size, corner_radius = 0, angle = 0 } = form.rectangle;
    const upright = new Path2D();
    upright.roundRect(-size[0] / 2, -size[1] / 2, size[0], size[1], Math.min(corner_radius, size[0] / 2, size[1] / 2));
    path.addPath(upright, new DOMMatrix().translate(centre[0], centre[1]).rotate(angle));
  } else if (form.polygon || form.line) {
    const { points } = form.polygon || form.line;
    points.forEach((point, i) => i ? path.lineTo(point[0], point[1]) : path.moveTo(point[0], point[1]));
    if (form.polygon) path.closePath();
  } else {
    return null;
  }
  return { path, fill: form.line ? null : fill, stroke, width };
}

// Points that enclose a part as it is drawn, shape and decorations, in part coordinates.
function corners(part) {
  const around = ([x, y], w, h) => [[x - w, y - h], [x + w, y - h], [x + w, y + h], [x - w, y + h]];
  const found = around([0, 0], ...halfExtent(part.shape || {}));
  for (const { form = {} } of part.look?.decorations || []) {
    if (form.ellipse) found.push(...around(form.ellipse.centre, ...form.ellipse.radii));
    else if (form.rectangle) found.push(...around(form.rectangle.centre, form.rectangle.size[0] / 2, form.rectangle.size[1] / 2));
    else found.push(...(form.polygon || form.line || { points: [] }).points);
  }
  return found;
}

// Everything about a creature that does not change from frame to frame.
function makeModel(creature) {
  const parts = creature.parts.map((part, index) => {
    const look = part.look || {};
    const shape = part.shape || {};
    return {
      index, shape,
      name: (part.name || `part ${index + 1}`).replace(/[_-]/g, " "),
      path: shapePath(shape, look.corner_radius),
      colour: look.colour || PLAIN_COLOUR,
      layer: look.layer || 0,
      opacity: look.opacity ?? 1,
      decorations: (look.decorations || []).map(decorationPath).filter(Boolean),
      reach: Math.hypot(...halfExtent(shape)),
      area: 4 * halfExtent(shape)[0] * halfExtent(shape)[1],
    };
  });
  let left = Infinity, right = -Infinity, bottom = Infinity, top = -Infinity;
  creature.parts.forEach((part, i) => {
    const [x, y] = part.position || [0, 0];
    const cos = Math.cos((part.angle || 0) * Math.PI / 180);
    const sin = Math.sin((part.angle || 0) * Math.PI / 180);
    for (const [u, v] of corners(part)) {
      parts[i].drawnReach = Math.max(parts[i].drawnReach || 0, Math.hypot(u, v));
      left = Math.min(left, x + u * cos - v * sin);
      right = Math.max(right, x + u * cos - v * sin);
      bottom = Math.min(bottom, y + u * sin + v * cos);
      top = Math.max(top, y + u * sin + v * cos);
    }
  });
  return {
    parts,
    order: [...parts].sort((a, b) => a.layer - b.layer || a.index - b.index),
    width: Math.max(right - left, 0.1), height: Math.max(top - bottom, 0.1),
  };
}

// Draws a model in a pose: part by part, the shape and then what is painted on it, each with the part's opacity.
// `alpha` makes the whole creature see-through; `plain` leaves the decorations out. On a dark stage a rim of light is
// laid behind the whole creature, so that dark parts stand out.
function drawCreature(stage, model, pose, { alpha = 1, plain = false } = {}) {
  const c = stage.context;
  c.lineJoin = c.lineCap = "round";
  if (theme.dark && alpha === 1) drawRim(stage, model, pose);
  for (const part of model.order) {
    const at = part.index * 3;
    if (at + 2 >= pose.length) continue;
    stage.partTransform(pose[at], pose[at + 1], pose[at + 2]);
    c.globalAlpha = alpha * part.opacity;
    c.fillStyle = part.colour;
    c.fill(part.path);
    for (const decoration of plain ? [] : part.decorations) {
      if (decoration.fill) { c.fillStyle = decoration.fill; c.fill(decoration.path); }
      if (decoration.stroke) {
        c.lineWidth = decoration.width;
        c.strokeStyle = decoration.stroke;
        c.stroke(decoration.path);
      }
    }
  }
  c.globalAlpha = 1;
  stage.resetTransform();
}

function drawRim(stage, model, pose) {
  const c = stage.context;
  c.strokeStyle = mix(theme["sky-low"], theme.rim, 0.55);
  c.lineWidth = 2.4 / stage.scale;
  for (const part of model.order) {
    const at = part.index * 3;
    if (at + 2 >= pose.length || part.opacity < 0.9) continue;
    stage.partTransform(pose[at], pose[at + 1], pose[at + 2]);
    c.stroke(part.path);
    for (const decoration of part.decorations) if (decoration.fill) c.stroke(decoration.path);
  }
}

// A soft shadow that widens and fades as the creature leaves the ground.
function drawShadow(stage, model, pose) {
  if (stage.ground?.water) return;
  let left = Infinity, right = -Infinity, lowest = Infinity;
  for (const part of model.parts) {
    const at = part.index * 3;
    if (at + 2 >= pose.length) continue;
    left = Math.min(left, pose[at] - part.reach * 0.6);
    right = Math.max(right, pose[at] + part.reach * 0.6);
    lowest = Math.min(lowest, pose[at + 1] + lowestPoint(part.shape, pose[at + 2])[1]);
  }
  const surface = surfaceAt(stage.ground, (left + right) / 2);
  // A shadow is level: where the ground is not, there is none.
  if ([left, right].some(x => Math.abs(surfaceAt(stage.ground, x) - surface) > 0.01)) return;
  const rise = Math.max(lowest - surface, 0) / model.height;
  const c = stage.context;
  stage.resetTransform();
  c.globalAlpha = 0.5 / (1 + 4 * rise);
  c.fillStyle = theme.shadow;
  c.beginPath();
  const wide = (right - left) / 2 * stage.scale * (1 + 0.3 * rise);
  c.ellipse(stage.screenX((left + right) / 2), stage.screenY(surface) + 3, wide, Math.min(5, 1.5 + wide * 0.05), 0, 0, 2 * Math.PI);
  c.fill();
  c.globalAlpha = 1;
}

// A glow and a short underline where parts touch the ground.
function drawContacts(stage, model, pose, mask) {
  if (!mask) return;
  const c = stage.context;
  for (const part of model.parts) {
    const at = part.index * 3;
    if (!inMask(mask, part.index) || at + 2 >= pose.length) continue;
    const [dx, dy] = lowestPoint(part.shape, pose[at + 2]);
    const x = stage.screenX(pose[at] + dx);
    const y = stage.screenY(pose[at + 1] + dy);
    const size = Math.max(7, Math.min(26, part.reach * stage.scale * 0.55));
    const glow = c.createRadialGradient(x, y, 0, x, y, size * 1.5);
    glow.addColorStop(0, theme.glow + "90");
    glow.addColorStop(1, theme.glow + "00");
    c.fillStyle = glow;
    c.fillRect(x - size * 1.5, y - size * 1.5, size * 3, size * 3);
    c.fillStyle = theme.glow;
    c.beginPath();
    c.roundRect(x - size * 0.6, y, size * 1.2, 3, 1.5);
    c.fill();
  }
}

// Pixels per metre at which a creature sits well on a stage: it fills a share of the sky, and the highest point of its
// replays stays `headroom` pixels below the top.
function fittingScale(stage, model, top, share = 0.6, headroom = 8) {
  const sky = stage.height * stage.groundShare;
  const highest = Math.min(top + 0.4 * model.height, 4 * Math.max(model.height, model.width));
  return Math.max(Math.min(sky * share / model.height, (sky - headroom) / highest, stage.width * 0.62 / model.width), 4);
}

// Where the middle of a creature is in a pose: the mean of its parts, by area, which hardly wavers as legs swing.
function middleX(model, pose) {
  let sum = 0, area = 0;
  for (const part of model.parts) {
    const at = part.index * 3;
    if (at + 2 >= pose.length) continue;
    sum += pose[at] * part.area;
    area += part.area;
  }
  return area > 0 ? sum / area : pose[0];
}

// Lifts the camera when the creature would leave the stage at the top.
function raiseFor(stage, model, pose) {
  let top = stage.ground ? -Infinity : 0;
  for (const part of model.parts) {
    const at = part.index * 3;
    if (at + 2 < pose.length) top = Math.max(top, pose[at + 1] + part.drawnReach * 0.8);
  }
  const visible = stage.height * stage.groundShare / stage.scale;
  // In water the camera follows up and down, and has the swimmer halfway up the stage.
  if (stage.ground?.water) return pose[1] - stage.height * (stage.groundShare - 0.5) / stage.scale;
  if (stage.ground) {
    // On uneven ground the camera follows the ground, and a creature that falls into a pit.
    const level = Math.min(levelAround(stage.ground, middleX(model, pose), 2 * model.width), pose[1]);
    return level + Math.max(0, top - level - visible);
  }
  return Math.max(0, top - visible);
}
