// What the creature editor does to a creature: plain functions on a parsed creature file, which they change in place.
// Points are in the world, in metres with y up; angles are in degrees, counter-clockwise, as in the file.

// Ranges as `check` has them (creatures/src/bounds.rs), with their units.
const EDITOR_BOUNDS = {
  size: [0.005, 50, "m"], density: [0.1, 10000, "kg/m²"], friction: [0, 10, ""], position: [-100, 100, "m"],
  angle: [-360, 360, "°"], limit: [-180, 180, "°"], top_speed: [0.01, 100, "rad/s"], top_torque: [0.01, 100000, "N·m"],
  layer: [-100, 100, ""], corner_radius: [0, 50, "m"], opacity: [0, 1, ""], place: [-50, 50, "m"], extent: [0.0001, 50, "m"],
  line_width: [0.0001, 10, "m"], period: [0.02, 100, "s"], length: [0.01, 100, "m"],
  top: [0.1, 20, "body lengths/s"],
};
const EDITOR_WIDEST_RANGE = 340;
const EDITOR_MOST_PARTS = 256;
const EDITOR_LONGEST_NAME = 64;
// Half the thickness of a limb when it is new, as a share of its length.
const EDITOR_LIMB_HALF = 0.08;
const EDITOR_LIMB_COLOURS = ["#3d405b", "#81b29a", "#f2cc8f", "#6d8fb3", "#b5838d"];
const EDITOR_DEGREE = Math.PI / 180;

// A number as the file keeps it: to a hundredth of a millimetre, which is what `symmetric` is proved to; never -0.
function editorRounded(value, decimals = 5) {
  return Math.round(value * 10 ** decimals) / 10 ** decimals + 0;
}

function editorBounded(value, [least, most], otherwise) {
  return Number.isFinite(value) ? Math.min(Math.max(value, least), most) : otherwise;
}

function emptyCreature() {
  const torso = {
    name: "body", tag: "torso", shape: { box: { width: 0.9, height: 0.2 } }, density: 30, friction: 1, position: [0, 0.6],
    look: { colour: "#e07a5f", layer: 0, corner_radius: 0.08 },
  };
  return { format: "gambol creature", version: 1, name: "my-creature", parts: [torso], joints: [] };
}

// A deep copy of a file with all that drawing and editing rely on; a file that `check` can read comes out as it was.
function readableCreature(file) {
  const isObject = value => typeof value === "object" && value !== null && !Array.isArray(value);
  const objects = value => Array.isArray(value) ? value.filter(isObject) : [];
  const pair = (value, otherwise, bounds) => [0, 1].map(i => editorBounded(value?.[i], bounds, otherwise[i]));
  let creature = JSON.parse(JSON.stringify(file ?? null));
  if (!isObject(creature)) creature = emptyCreature();
  creature.parts = objects(creature.parts).slice(0, EDITOR_MOST_PARTS);
  creature.joints = objects(creature.joints);
  for (const list of ["sensors", "actuated_tags"]) if (!Array.isArray(creature[list])) delete creature[list];
  creature.actuated_tags &&= creature.actuated_tags.filter(tag => typeof tag === "string");
  creature.parts.forEach((part, i) => {
    part.name = String(part.name ?? `part ${i + 1}`);
    part.tag = String(part.tag ?? (i ? "leg" : "torso"));
    part.shape = readableShape(part.shape);
    part.density = editorBounded(part.density, EDITOR_BOUNDS.density, 30);
    part.position = pair(part.position, [0, 0.5], EDITOR_BOUNDS.position);
    if ("angle" in part) part.angle = editorBounded(part.angle, EDITOR_BOUNDS.angle, 0);
    if (!isObject(part.look)) delete part.look;
    else if ("decorations" in part.look) part.look.decorations = objects(part.look.decorations);
    decorationsOf(part).forEach(repairDecoration);
  });
  for (const joint of creature.joints) {
    joint.parent = String(joint.parent);
    joint.child = String(joint.child);
    joint.anchor = pair(joint.anchor, [0, 0], EDITOR_BOUNDS.position);
    joint.limits = pair(joint.limits, [-60, 60], EDITOR_BOUNDS.angle);
    if ("motor" in joint && !isObject(joint.motor)) delete joint.motor;
  }
  return creature;
}

function readableShape(shape) {
  const sizes = { box: ["width", "height"], capsule: ["length", "radius"], circle: ["radius"] };
  const kind = Object.keys(sizes).find(kind => shape?.[kind]) || "circle";
  const numbers = sizes[kind].map(name => [name, editorBounded(shape?.[kind]?.[name], EDITOR_BOUNDS.size, 0.1)]);
  return { [kind]: Object.fromEntries(numbers) };
}

function shapeKind(shape) { return Object.keys(shape)[0]; }

function shapeArea({ box, capsule, circle }) {
  if (box) return box.width * box.height;
  if (capsule) return 2 * capsule.radius * capsule.length + Math.PI * capsule.radius ** 2;
  return Math.PI * circle.radius ** 2;
}

// The shape of a kind that fills about the same room; a capsule is never wider than long.
function shapeOfKind(kind, [halfWidth, halfHeight]) {
  const size = value => editorRounded(editorBounded(value, EDITOR_BOUNDS.size, 0.1));
  if (kind === "box") return { box: { width: size(2 * halfWidth), height: size(2 * halfHeight) } };
  if (kind === "circle") return { circle: { radius: size(Math.max(halfWidth, halfHeight)) } };
  const radius = Math.min(halfWidth, halfHeight);
  return { capsule: { length: size(2 * (halfHeight - radius)), radius: size(radius) } };
}

// Distance from a point in the part's own frame to its shape; 0 inside.
function shapeDistance(shape, [x, y]) {
  const [u, v] = [Math.abs(x), Math.abs(y)];
  if (shape.box) return Math.hypot(Math.max(u - shape.box.width / 2, 0), Math.max(v - shape.box.height / 2, 0));
  const { radius, length = 0 } = shape.capsule || shape.circle;
  return Math.max(Math.hypot(u, Math.max(v - length / 2, 0)) - radius, 0);
}

function turnedPoint([x, y], degrees) {
  const [cos, sin] = [Math.cos(degrees * EDITOR_DEGREE), Math.sin(degrees * EDITOR_DEGREE)];
  return [x * cos - y * sin, x * sin + y * cos];
}

function partToWorld({ position: [x, y], angle = 0 }, point) {
  const [u, v] = turnedPoint(point, angle);
  return [x + u, y + v];
}

function worldToPart({ position, angle = 0 }, [x, y]) { return turnedPoint([x - position[0], y - position[1]], -angle); }

// Indices of the parts at a point, the topmost first.
function partsAt(creature, point, tolerance = 0) {
  const layer = i => creature.parts[i].look?.layer || 0;
  return creature.parts.map((_, i) => i)
    .filter(i => shapeDistance(creature.parts[i].shape, worldToPart(creature.parts[i], point)) <= tolerance)
    .sort((a, b) => layer(b) - layer(a) || b - a);
}

// Where limbs begin and end: the middles of a capsule's half discs, or as far inside a box.
function partEnds(part) {
  const [w, h] = halfExtent(part.shape);
  const inset = Math.min(w, h);
  if (part.shape.circle || w === h) return [[...part.position]];
  const end = w > h ? [w - inset, 0] : [0, h - inset];
  return [partToWorld(part, end), partToWorld(part, [-end[0], -end[1]])];
}

// The end nearest to a point, of all parts but some; null when none is within reach.
function nearestEnd(creature, without, point, reach) {
  const ends = creature.parts.flatMap((part, i) => without.includes(i) ? [] : partEnds(part));
  const far = end => Math.hypot(end[0] - point[0], end[1] - point[1]);
  const nearest = ends.reduce((best, end) => !best || far(end) < far(best) ? end : best, null);
  return nearest && far(nearest) <= reach ? nearest : null;
}

// Which part hangs on which. Names that are of no part, and second joints of a part, are left out: they are problems.
function hangingTree({ parts, joints }) {
  const index = new Map();
  parts.forEach(({ name }, i) => { if (!index.has(name)) index.set(name, i); });
  const tree = { index, joint: parts.map(() => -1), parent: parts.map(() => -1), children: parts.map(() => []) };
  joints.forEach((joint, j) => {
    const [parent, child] = [index.get(joint.parent), index.get(joint.child)];
    if (parent === undefined || child === undefined || parent === child || tree.joint[child] !== -1) return;
    tree.joint[child] = j;
    tree.parent[child] = parent;
    tree.children[parent].push(child);
  });
  return tree;
}

// A part and all that hangs on it, parents first.
function subtreeOf(tree, index) {
  const found = [index];
  for (const part of found) found.push(...tree.children[part].filter(child => !found.includes(child)));
  return found;
}

function setAngle(part, degrees) {
  const angle = editorRounded(Math.abs(degrees) > 360 ? degrees % 360 : degrees, 3);
  if (angle !== 0 || "angle" in part) part.angle = angle;
}

function roundedPoint(point) {
  return point.map(value => editorRounded(editorBounded(value, EDITOR_BOUNDS.position, 0)));
}

// Moves a part with all that hangs on it, and their joints, by a map of the world that may turn.
function placeSubtree(creature, index, place, turn = 0) {
  const tree = hangingTree(creature);
  for (const i of subtreeOf(tree, index)) {
    const part = creature.parts[i];
    part.position = roundedPoint(place(part.position));
    if (turn) setAngle(part, (part.angle || 0) + turn);
    const joint = creature.joints[tree.joint[i]];
    if (joint) joint.anchor = roundedPoint(place(joint.anchor));
  }
}

function moveSubtree(creature, index, [dx, dy]) { placeSubtree(creature, index, ([x, y]) => [x + dx, y + dy]); }

// What a part turns about: its joint, the torso its centre.
function pivotOf(creature, index) {
  return creature.joints[hangingTree(creature).joint[index]]?.anchor || creature.parts[index].position;
}

function turnSubtree(creature, index, degrees) {
  const [x, y] = pivotOf(creature, index);
  const place = point => {
    const [u, v] = turnedPoint([point[0] - x, point[1] - y], degrees);
    return [x + u, y + v];
  };
  placeSubtree(creature, index, place, degrees);
}

function scaleSubtree(creature, index, factor) {
  const [x, y] = [...pivotOf(creature, index)];
  const parts = subtreeOf(hangingTree(creature), index).map(i => creature.parts[i]);
  const sizes = parts.flatMap(({ shape }) => Object.values(shape[shapeKind(shape)]));
  const [least, most] = EDITOR_BOUNDS.size;
  const share = editorBounded(factor, [least / Math.min(...sizes), most / Math.max(...sizes)], 1);
  for (const part of parts) {
    const numbers = part.shape[shapeKind(part.shape)];
    for (const name in numbers) numbers[name] = editorRounded(editorBounded(numbers[name] * share, [least, most], least));
    stretchLook(part.look, share, share);
  }
  placeSubtree(creature, index, point => [x + (point[0] - x) * share, y + (point[1] - y) * share]);
}

// Stretches how a part looks along the part's axes; a negative factor mirrors what is painted on it.
function stretchLook(look, sx, sy) {
  const radius = (look?.corner_radius || 0) * Math.sqrt(Math.abs(sx * sy));
  if (radius) look.corner_radius = editorRounded(editorBounded(radius, EDITOR_BOUNDS.corner_radius, 0));
  for (const decoration of look?.decorations || []) stretchDecoration(decoration, sx, sy);
}

// Stands a lying box on end in its own frame, which is turned instead: nothing is seen of it, but a capsule can take its place.
function standOnEnd(part) {
  const { box } = part.shape;
  [box.width, box.height] = [box.height, box.width];
  setAngle(part, (part.angle || 0) + 90);
  for (const decoration of decorationsOf(part)) placeDecoration(decoration, ([x, y]) => [y, -x], -90);
}

// Gives a part another shape. What hangs on it moves along with the place it hangs at; the point `from` of the part's own
// frame stays where it is, as the point `to` of the new shape. Without them that is the part's joint, or its centre.
function reshapePart(creature, index, shape, from, to) {
  const tree = hangingTree(creature);
  const part = creature.parts[index];
  const before = structuredClone(part);
  const extent = ({ capsule, ...other }) => capsule ? [capsule.radius, capsule.length / 2] : halfExtent({ ...other });
  const sameKind = shapeKind(shape) === shapeKind(part.shape);
  const [oldSize, newSize] = sameKind ? [extent(part.shape), extent(shape)] : [halfExtent(part.shape), halfExtent(shape)];
  const stretch = [0, 1].map(i => newSize[i] / oldSize[i]);
  const stretched = point => [point[0] * stretch[0], point[1] * stretch[1]];
  const fixedPoint = from || worldToPart(before, pivotOf(creature, index));
  part.shape = shape;
  const [x, y] = partToWorld(before, fixedPoint);
  const [u, v] = turnedPoint(to || stretched(fixedPoint), part.angle || 0);
  part.position = roundedPoint([x - u, y - v]);
  const corner = part.look?.corner_radius;
  stretchLook(part.look, ...stretch);
  if (corner !== undefined) part.look.corner_radius = corner;
  for (const child of tree.children[index]) {
    const { anchor } = creature.joints[tree.joint[child]];
    const moved = partToWorld(part, stretched(worldToPart(before, anchor)));
    moveSubtree(creature, child, [moved[0] - anchor[0], moved[1] - anchor[1]]);
  }
}

// Heights are counted from the ground: lifts a creature that reaches below it; `settle` also lowers one that floats.
function groundCreature(creature, settle = false) {
  const bottom = ({ shape, position, angle = 0 }) => position[1] + lowestPoint(shape, angle * EDITOR_DEGREE)[1];
  const lowest = Math.min(...creature.parts.map(bottom));
  if (!Number.isFinite(lowest) || Math.abs(lowest) < 5e-5 || (lowest > 0 && !settle)) return false;
  for (const part of creature.parts) part.position = roundedPoint([part.position[0], part.position[1] - lowest]);
  for (const joint of creature.joints) joint.anchor = roundedPoint([joint.anchor[0], joint.anchor[1] - lowest]);
  return true;
}

// Puts parents before their children, as the format wants it, and leaves the order alone otherwise.
function orderParts(creature) {
  const { parent } = hangingTree(creature);
  const placed = new Set();
  for (let waiting = creature.parts.map((_, i) => i), before = -1; waiting.length && waiting.length !== before;) {
    before = waiting.length;
    for (const i of waiting) if (parent[i] === -1 || i === 0 || placed.has(parent[i])) placed.add(i);
    waiting = waiting.filter(i => !placed.has(i));
  }
  if (placed.size === creature.parts.length) creature.parts = [...placed].map(i => creature.parts[i]);
}

function uniqueName(creature, wanted) {
  const names = new Set(creature.parts.map(part => part.name));
  if (!names.has(wanted)) return wanted;
  const stem = wanted.replace(/ \d+$/, "").slice(0, EDITOR_LONGEST_NAME - 4);
  let number = 2;
  while (names.has(`${stem} ${number}`)) number++;
  return `${stem} ${number}`;
}

function renamePart(creature, index, wanted) {
  const part = creature.parts[index];
  const before = part.name;
  const text = String(wanted).trim().slice(0, EDITOR_LONGEST_NAME);
  if (!text || text === before) return;
  const isFirst = hangingTree(creature).index.get(before) === index;
  part.name = uniqueName(creature, text);
  if (!isFirst) return;
  for (const joint of creature.joints) {
    for (const end of ["parent", "child"]) if (joint[end] === before) joint[end] = part.name;
  }
}

function deleteSubtree(creature, index) {
  const gone = new Set(subtreeOf(hangingTree(creature), index));
  creature.parts = creature.parts.filter((_, i) => !gone.has(i));
  const names = new Set(creature.parts.map(part => part.name));
  creature.joints = creature.joints.filter(joint => names.has(joint.parent) && names.has(joint.child));
}

// How far a part goes when it is pulled so far: its ends to other parts' ends within reach, else its centre to the next
// whole centimetre. Without a reach it goes where it is pulled.
function snappedShift(creature, index, shift, reach) {
  if (reach === null) return shift;
  const part = creature.parts[index];
  const own = subtreeOf(hangingTree(creature), index);
  for (const [x, y] of partEnds(part)) {
    const near = nearestEnd(creature, own, [x + shift[0], y + shift[1]], reach);
    if (near) return [near[0] - x, near[1] - y];
  }
  return shift.map((way, axis) => Math.abs(way) < 0.005 ? 0 : editorRounded(part.position[axis] + way, 2) - part.position[axis]);
}

// Where a limb ends that is drawn from a point: at another part's end or on the ground within reach, at an angle of whole
// five degrees, a whole number of centimetres long.
function snappedTip(creature, kind, from, to, reach) {
  const end = nearestEnd(creature, [], to, reach);
  if (end && Math.hypot(end[0] - from[0], end[1] - from[1]) > 2 * reach) return end;
  const direction = Math.round(Math.atan2(to[1] - from[1], to[0] - from[0]) / EDITOR_DEGREE / 5) * 5 * EDITOR_DEGREE;
  const [dx, dy] = [Math.cos(direction), Math.sin(direction)];
  const isOnGround = Math.abs(to[1]) <= reach && dy < -0.2 && from[1] > reach;
  // What touches the ground of a turned limb is its round end, or the corner of a box.
  const half = kind === "circle" ? 0.5 : EDITOR_LIMB_HALF;
  const drop = kind === "box" ? half * Math.abs(dx) - dy : half - dy * (1 - half);
  const length = isOnGround ? from[1] / drop : editorRounded(Math.hypot(to[0] - from[0], to[1] - from[1]), 2);
  return [from[0] + dx * length, from[1] + dy * length];
}

// Pulls a side of a part to a point; the opposite side stays. A capsule's flanks move alike.
function pullSide(creature, index, axis, sign, point, isFree) {
  const part = creature.parts[index];
  const half = halfExtent(part.shape);
  const opposite = -sign * half[axis];
  const place = worldToPart(part, point)[axis];
  const snap = size => editorBounded(isFree ? size : editorRounded(size, 2), EDITOR_BOUNDS.size, half[axis] * 2);
  const { capsule } = part.shape;
  if (capsule && axis === 0) {
    const radius = Math.max(snap(2 * Math.abs(place)) / 2, EDITOR_BOUNDS.size[0]);
    reshapePart(creature, index, { capsule: { ...capsule, radius } }, [0, 0], [0, 0]);
    return;
  }
  const size = snap(Math.max((place - opposite) * sign, 0));
  const shape = structuredClone(part.shape);
  if (shape.box) shape.box[axis ? "height" : "width"] = size;
  else if (capsule) shape.capsule.length = Math.max(editorRounded(size - 2 * capsule.radius), EDITOR_BOUNDS.size[0]);
  else shape.circle.radius = Math.max(size / 2, EDITOR_BOUNDS.size[0]);
  const to = -sign * halfExtent(shape)[axis];
  reshapePart(creature, index, shape, axis ? [0, opposite] : [opposite, 0], axis ? [0, to] : [to, 0]);
}

// Whether the canvas can draw a decoration.
function canDraw(decoration) {
  try {
    const isPlace = point => point.length === 2 && point.every(Number.isFinite);
    return corners({ look: { decorations: [decoration] } }).every(isPlace) && decorationPath(decoration) !== null;
  } catch {
    return false;
  }
}

// The creature as it can be drawn: what is painted on it in a way the canvas refuses is left out.
function drawableCreature(creature) {
  const drawable = part => ({ ...part, look: {
    ...part.look, corner_radius: editorBounded(part.look?.corner_radius, EDITOR_BOUNDS.corner_radius, 0),
    decorations: decorationsOf(part).filter(canDraw),
  } });
  return { ...creature, parts: creature.parts.map(drawable) };
}
