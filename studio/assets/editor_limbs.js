// How the limbs of a creature are made and joined in the editor: drawn, mirrored, copied, hung on each other.

// A motor strong enough to lift the body on a limb that reaches so far, and not so strong that a light limb rattles.
function fittingMotor(creature, reach) {
  const { density, shape } = creature.parts[0];
  const torque = 1.5 * 9.81 * density * shapeArea(shape) * reach;
  return { top_speed: 12, top_torque: editorBounded(Math.round(torque / 5) * 5, [5, EDITOR_BOUNDS.top_torque[1]], 5) };
}

function drivenTags(creature) { return creature.actuated_tags || ["leg"]; }

// Adds a part as it is drawn, from its hinge on a parent to its tip; -1 for no parent. Returns its index.
function addDrawnPart(creature, kind, from, to, parent) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  const part = { name: "", tag: "torso", shape: null, density: 30, friction: 1, position: from, angle: 0 };
  const along = distance => [from[0] + dx / length * distance, from[1] + dy / length * distance];
  if (kind === "circle") {
    part.shape = shapeOfKind(kind, parent < 0 ? [length, length] : [length / 2, length / 2]);
    if (parent >= 0) part.position = along(length / 2);
  } else if (kind === "box" && parent < 0) {
    part.shape = shapeOfKind(kind, [Math.abs(dx) / 2, Math.abs(dy) / 2]);
    part.position = [from[0] + dx / 2, from[1] + dy / 2];
  } else {
    // The hinge lies as far inside as the limb is thick, so that it bends like a knee.
    const half = Math.max(length * EDITOR_LIMB_HALF, 0.01);
    part.shape = shapeOfKind(kind, [half, (length + half) / 2]);
    part.position = along((length - half) / 2);
    setAngle(part, Math.atan2(dy, dx) / EDITOR_DEGREE + 90);
  }
  part.position = roundedPoint(part.position);
  if (!part.angle) delete part.angle;
  const isTorso = creature.parts.length === 0;
  const count = creature.parts.length;
  const above = creature.parts[Math.max(parent, 0)];
  const isLeg = dy <= 0 || parent > 0;
  part.name = uniqueName(creature, isTorso ? "body" : isLeg ? "leg" : kind === "circle" ? "head" : "arm");
  if (!isTorso) part.tag = drivenTags(creature)[0] ?? "leg";
  if (!isTorso && !isLeg) part.leg = false;
  const colours = isTorso ? ["#e07a5f"] : parent > 0 ? [above.look?.colour] : EDITOR_LIMB_COLOURS;
  const layer = isTorso ? 0 : Math.max((above.look?.layer || 0) - 1, EDITOR_BOUNDS.layer[0]);
  part.look = { colour: colours[Math.max(count - 1, 0) % colours.length] || PLAIN_COLOUR, layer };
  if (part.shape.box) part.look.corner_radius = editorRounded(Math.min(...halfExtent(part.shape)) * 0.7, 3);
  creature.parts.push(part);
  if (parent >= 0) hangPart(creature, parent, count, from);
  return count;
}

function hangPart(creature, parent, child, anchor, before = {}) {
  const reach = Math.hypot(...halfExtent(creature.parts[child].shape)) * 2;
  const { limits = [-60, 60], motor = fittingMotor(creature, reach) } = before;
  const [above, below] = [creature.parts[parent].name, creature.parts[child].name];
  creature.joints.push({ parent: above, child: below, anchor: roundedPoint(anchor), limits, motor });
}

// Joins two parts. What is not part of the body yet hangs on what is; of two that are, the later on the earlier. Returns
// the index of the part that hangs now.
function joinParts(creature, a, b, anchor) {
  const tree = hangingTree(creature);
  for (const [parent, child] of [[a, b], [b, a]]) {
    if (tree.parent[child] !== parent) continue;
    creature.joints[tree.joint[child]].anchor = roundedPoint(anchor);
    return child;
  }
  const chain = index => {
    const parts = [index];
    for (const part of parts) if (tree.parent[part] !== -1 && !parts.includes(tree.parent[part])) parts.push(tree.parent[part]);
    return parts;
  };
  const [rootA, rootB] = [chain(a).at(-1), chain(b).at(-1)];
  const isBLoose = rootA === 0 && rootB !== 0;
  const isALoose = rootB === 0 && rootA !== 0;
  let [parent, child] = isBLoose || (!isALoose && a < b) ? [a, b] : [b, a];
  if (subtreeOf(tree, child).includes(parent)) [parent, child] = [child, parent];
  const before = creature.joints[tree.joint[child]];
  if (rootA !== rootB && chain(child).at(-1) !== 0) chain(child).forEach(i => turnJointRound(creature.joints[tree.joint[i]]));
  else creature.joints = creature.joints.filter(joint => joint !== before);
  hangPart(creature, parent, child, anchor, rootA === rootB ? before : {});
  return child;
}

// Hangs a part on another, wherever they are: its hinge stays; a new one is at the end nearest to the other part.
function hangOn(creature, child, parent) {
  const { name } = creature.parts[child];
  const joint = creature.joints[hangingTree(creature).joint[child]];
  if (joint) { joint.parent = creature.parts[parent].name; return; }
  const [x, y] = creature.parts[parent].position;
  const far = end => Math.hypot(end[0] - x, end[1] - y);
  const anchor = partEnds(creature.parts[child]).reduce((a, b) => far(a) <= far(b) ? a : b);
  const before = creature.joints.find(other => other.child === name);
  creature.joints = creature.joints.filter(other => other !== before);
  hangPart(creature, parent, child, anchor, before);
}

function turnJointRound(joint) {
  if (!joint) return;
  [joint.parent, joint.child] = [joint.child, joint.parent];
  joint.limits = joint.limits.map(limit => editorRounded(-limit, 3)).reverse();
}

// Copies a part and all that hangs on it, hung on `parent` at places given by a map of the world. Returns the copy's index.
function copySubtree(creature, index, parent, place, isMirror = false) {
  const tree = hangingTree(creature);
  const first = creature.parts.length;
  const names = new Map();
  for (const i of subtreeOf(tree, index)) {
    const part = structuredClone(creature.parts[i]);
    part.name = uniqueName(creature, isMirror ? otherSideName(part.name) : part.name);
    names.set(creature.parts[i].name, part.name);
    part.position = roundedPoint(place(part.position));
    if (isMirror) mirrorPart(part);
    creature.parts.push(part);
    const joint = structuredClone(creature.joints[tree.joint[i]]);
    if (!joint) continue;
    joint.parent = i === index ? creature.parts[parent].name : names.get(joint.parent);
    joint.child = part.name;
    joint.anchor = roundedPoint(place(joint.anchor));
    if (isMirror) joint.limits = joint.limits.map(limit => editorRounded(-limit, 3)).reverse();
    creature.joints.push(joint);
  }
  return first;
}

function mirrorPart(part) {
  if (part.angle) setAngle(part, -part.angle);
  stretchLook(part.look, -1, 1);
}

function otherSideName(name) {
  const others = { left: "right", right: "left", front: "back", back: "front" };
  return name.replace(/\b(left|right|front|back)\b/, word => others[word]);
}

// Mirrors a part and all that hangs on it across the upright line through the torso, or through its parent if the parent has
// no twin on the other side. The torso is no copy: with it, the whole creature turns round. Returns the index of the copy.
function mirrorSubtree(creature, index) {
  const tree = hangingTree(creature);
  const across = x0 => ([x, y]) => [2 * x0 - x, y];
  const x0 = creature.parts[0].position[0];
  if (index === 0) {
    for (const part of creature.parts) { part.position = roundedPoint(across(x0)(part.position)); mirrorPart(part); }
    for (const joint of creature.joints) {
      joint.anchor = roundedPoint(across(x0)(joint.anchor));
      joint.limits = joint.limits.map(limit => editorRounded(-limit, 3)).reverse();
    }
    return 0;
  }
  const parent = tree.parent[index];
  const above = creature.parts[parent];
  const isTwin = ({ shape, position: [x, y] }) => above && shapeKind(shape) === shapeKind(above.shape)
    && Math.hypot(2 * x0 - x - above.position[0], y - above.position[1]) < 0.01;
  const twin = parent <= 0 ? parent : creature.parts.findIndex((part, i) => i !== parent && isTwin(part));
  return parent <= 0 || twin > 0 ? copySubtree(creature, index, twin, across(x0), true)
    : copySubtree(creature, index, parent, across(above.position[0]), true);
}

// One more limb like this: a copy at the next free place along its parent, towards the further end first.
function addOneMore(creature, index) {
  const tree = hangingTree(creature);
  const parent = creature.parts[tree.parent[index]];
  const extent = halfExtent(parent.shape);
  const axis = extent[0] >= extent[1] ? 0 : 1;
  const place = child => worldToPart(parent, creature.joints[tree.joint[child]].anchor)[axis];
  const here = place(index);
  const taken = tree.children[tree.parent[index]].map(place);
  const step = Math.max(4 * Math.min(...halfExtent(creature.parts[index].shape)), 0.05);
  const direction = here >= 0 ? -step : step;
  const places = [direction, -direction].flatMap(d => Array.from({ length: 64 }, (_, k) => here + d * (k + 1)));
  const isFree = at => Math.abs(at) <= extent[axis] && taken.every(other => Math.abs(other - at) > step * 0.6);
  const shift = (places.find(isFree) ?? here + direction / 2) - here;
  const [dx, dy] = turnedPoint(axis ? [0, shift] : [shift, 0], parent.angle || 0);
  return copySubtree(creature, index, tree.parent[index], ([x, y]) => [x + dx, y + dy]);
}

// The direction from a hinge to its part, from which its limits are counted: degrees in the world.
function limitDirection({ position, angle = 0 }, [x, y]) {
  const [dx, dy] = [position[0] - x, position[1] - y];
  return Math.hypot(dx, dy) < 1e-3 ? angle - 90 : Math.atan2(dy, dx) / EDITOR_DEGREE;
}

// Sets the smaller (0) or the larger (1) limit, as near to the angle as the format allows.
function setLimit(joint, which, degrees) {
  const other = joint.limits[1 - which];
  const room = joint.motor ? 1 : 0;
  const range = which ? [Math.max(0, other + room), Math.min(180, other + EDITOR_WIDEST_RANGE)]
    : [Math.max(-180, other - EDITOR_WIDEST_RANGE), Math.min(0, other - room)];
  joint.limits[which] = editorRounded(editorBounded(degrees, range, joint.limits[which]), 2);
}

// Turns a limit of the joint between `joint.parent` and a part to where the pointer is.
function pullLimit(joint, part, which, point, isFree) {
  const direction = Math.atan2(point[1] - joint.anchor[1], point[0] - joint.anchor[0]) / EDITOR_DEGREE;
  let angle = ((direction - limitDirection(part, joint.anchor)) % 360 + 540) % 360 - 180;
  // Past half a turn it is the other way round: a limit does not change sides.
  if (Math.abs(angle) > 90 && angle > 0 !== which > 0) angle = which ? 180 : -180;
  setLimit(joint, which, isFree ? angle : Math.round(angle / 5) * 5);
}
