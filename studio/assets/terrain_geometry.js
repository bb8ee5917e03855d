// What the terrain editor does to a drawn terrain: plain functions on its obstacles, which they change in place. Places are
// in metres ahead of the front of the creature, heights above the ground it stands on. Nothing done here makes obstacles
// overlap or leave their ranges.

// Ranges as the check has them (creatures/src/bounds.rs).
const TERRAIN_BOUNDS = {
  box: { width: [0.05, 100], height: [0.01, 5] }, gap: { width: [0.01, 20] }, slope: { width: [0.3, 100], rise: [-20, 20] },
};
const TERRAIN_END = 1000;
const TERRAIN_MOST = 200;
const TERRAIN_STEEPEST = Math.tan(Math.PI / 3);
const TERRAIN_SNAP = 0.05;
const TERRAIN_NAMES = { box: "Box", gap: "Gap", slope: "Slope" };
// Of those that are made without a pointer.
const TERRAIN_SIZES = { box: { width: 0.3, height: 0.15 }, gap: { width: 0.3 }, slope: { width: 2, rise: 0.4 } };

function obstacleKind(obstacle) { return Object.keys(obstacle)[0]; }

function obstacleSizes(obstacle) { return obstacle[obstacleKind(obstacle)]; }

// How high the obstacle is, or rises; a gap does neither.
function obstacleHeight(obstacle) { return obstacle.box?.height ?? obstacle.slope?.rise ?? 0; }

// Where an obstacle ends, in the numbers that the check counts in: they are half as long as those of the page.
function obstacleEnd(obstacle) {
  const { from, width } = obstacleSizes(obstacle);
  return Math.fround(Math.fround(from) + Math.fround(width));
}

// In degrees.
function steepness({ slope }) { return editorRounded(Math.atan2(slope.rise, slope.width) / EDITOR_DEGREE, 1); }

// In numbers.
function measureObstacle(obstacle) {
  const wide = fixed(obstacleSizes(obstacle).width, 2);
  if (obstacle.gap) return `${wide} m`;
  const tall = fixed(obstacleHeight(obstacle), 2);
  return `${wide} × ${tall} m`;
}

// In words.
function describeObstacle(obstacle) {
  const { from, width, height, rise } = obstacleSizes(obstacle);
  const up = rise ? `, ${fixed(Math.abs(rise), 2)} m ${rise > 0 ? "up" : "down"}` : "";
  const size = obstacle.box ? `, ${fixed(height, 2)} m high` : up;
  return `${TERRAIN_NAMES[obstacleKind(obstacle)]} at ${fixed(from, 2)} m: ${fixed(width, 2)} m wide${size}`;
}

// A copy of obstacles with all that editing relies on; those of which nothing can be made are left out.
function readableObstacles(file) {
  const found = [];
  for (const obstacle of Array.isArray(file) ? file.slice(0, TERRAIN_MOST) : []) {
    const kind = Object.keys(TERRAIN_BOUNDS).find(kind => obstacle?.[kind]);
    const from = editorBounded(Number(obstacle?.[kind]?.from), [0, TERRAIN_END], NaN);
    if (Number.isNaN(from)) continue;
    const sizes = { from };
    for (const [name, bounds] of Object.entries(TERRAIN_BOUNDS[kind])) {
      sizes[name] = editorBounded(Number(obstacle[kind][name]), bounds, TERRAIN_SIZES[kind][name]);
    }
    found.push({ [kind]: sizes });
  }
  const place = obstacle => obstacleSizes(obstacle).from;
  return found.sort((a, b) => place(a) - place(b));
}

// How high the ground is where each obstacle begins, and behind the last.
function terrainLevels(drawn) {
  const levels = [0];
  for (const obstacle of drawn) levels.push(levels[levels.length - 1] + (obstacle.slope?.rise ?? 0));
  return levels;
}

// From where to where an obstacle may be: between its neighbours.
function obstacleRoom(drawn, index) {
  const start = index > 0 ? obstacleEnd(drawn[index - 1]) : 0;
  return [start, index + 1 < drawn.length ? Math.fround(obstacleSizes(drawn[index + 1]).from) : TERRAIN_END];
}

// How far up and down a slope of this width may go.
function riseBounds(width) {
  const most = Math.floor(Math.min(TERRAIN_BOUNDS.slope.rise[1], width * TERRAIN_STEEPEST) * 1e4) / 1e4;
  return [-most, most];
}

function heightBounds(obstacle) {
  return obstacle.box ? TERRAIN_BOUNDS.box.height : obstacle.slope ? riseBounds(obstacle.slope.width) : [0, 0];
}

// From the first to the last place where the obstacle can begin as it is.
function placeBounds(drawn, index) {
  const [start, end] = obstacleRoom(drawn, index);
  return [start, Math.max(end - obstacleSizes(drawn[index]).width, start)];
}

// From the narrowest to the widest the obstacle can be from where it begins.
function widthBounds(drawn, index) {
  const [least, most] = TERRAIN_BOUNDS[obstacleKind(drawn[index])].width;
  return [least, Math.min(most, obstacleRoom(drawn, index)[1] - obstacleSizes(drawn[index]).from)];
}

// Changes the sizes of an obstacle, unless it would no longer be in its room: beside a neighbour a last digit may be too much.
function changeObstacle(drawn, index, change) {
  const sizes = obstacleSizes(drawn[index]);
  const before = { ...sizes };
  const [start, end] = obstacleRoom(drawn, index);
  change(sizes, start, end);
  while (obstacleEnd(drawn[index]) > end) sizes.width -= end * 2 ** -24;
  raiseObstacle(drawn[index], obstacleHeight(drawn[index]));
  if (sizes.from < start || sizes.width < TERRAIN_BOUNDS[obstacleKind(drawn[index])].width[0]) Object.assign(sizes, before);
}

function placeObstacle(drawn, index, from) {
  changeObstacle(drawn, index, (sizes, start, end) => {
    sizes.from = Math.max(editorRounded(Math.min(from, end - sizes.width)), start);
    while (obstacleEnd(drawn[index]) > end && sizes.from > start) sizes.from = Math.max(sizes.from - end * 2 ** -24, start);
  });
}

// Puts an obstacle somewhere, and all that is behind it just as much further.
function shiftObstacles(drawn, index, from) {
  const [start] = obstacleRoom(drawn, index);
  const shift = editorBounded(from, [start, Infinity], start) - obstacleSizes(drawn[index]).from;
  const step = Math.min(shift, TERRAIN_END - terrainEnd(drawn));
  const order = drawn.map((_, other) => other).slice(index);
  // The one in front first, so that there is always room.
  if (step > 0) order.reverse();
  for (const other of order) placeObstacle(drawn, other, obstacleSizes(drawn[other]).from + step);
}

function widenObstacle(drawn, index, width) {
  changeObstacle(drawn, index, sizes => {
    sizes.width = editorRounded(editorBounded(width, widthBounds(drawn, index), sizes.width));
  });
}

// Moves where an obstacle begins, or where it ends; the other end stays.
function pullObstacle(drawn, index, isEnd, x) {
  const { from, width } = obstacleSizes(drawn[index]);
  if (isEnd) { widenObstacle(drawn, index, x - from); return; }
  const [least, most] = TERRAIN_BOUNDS[obstacleKind(drawn[index])].width;
  const end = from + width;
  changeObstacle(drawn, index, (sizes, start) => {
    sizes.from = Math.max(editorRounded(editorBounded(x, [Math.max(start, end - most), end - least], from)), start);
    sizes.width = editorRounded(editorBounded(end - sizes.from, [least, most], width));
  });
}

function raiseObstacle(obstacle, height) {
  const value = editorRounded(editorBounded(height, heightBounds(obstacle), obstacleHeight(obstacle)));
  if (obstacle.box) obstacle.box.height = value;
  else if (obstacle.slope) obstacle.slope.rise = value;
}

// Where there is room for a new obstacle at a place, towards a side if there is none right there: which it would be among
// the others, from where to where.
function roomAt(drawn, x, side) {
  const isBehind = obstacle => obstacleSizes(obstacle).from > x || (side < 0 && obstacleEnd(obstacle) > x);
  const next = drawn.findIndex(isBehind);
  const index = next < 0 ? drawn.length : next;
  const start = index > 0 ? obstacleEnd(drawn[index - 1]) : 0;
  return { index, start, end: index < drawn.length ? obstacleSizes(drawn[index]).from : TERRAIN_END };
}

// Adds an obstacle of a kind from one place to another, whichever is further ahead; tells which it is, or -1 if there is no
// room.
function addObstacle(drawn, kind, from, to, height) {
  if (drawn.length >= TERRAIN_MOST) return -1;
  const { index, start, end } = roomAt(drawn, from, to - from);
  const [least, most] = TERRAIN_BOUNDS[kind].width;
  if (end - start < least + 1e-3) return -1;
  const [near, far] = [from, to].map(x => editorBounded(x, [start, end], start));
  const width = Math.min(Math.max(Math.abs(far - near), least), most);
  // Where it was begun it stays.
  const left = far < near ? near - width : near;
  drawn.splice(index, 0, { [kind]: { from: start, ...TERRAIN_SIZES[kind], width: least } });
  placeObstacle(drawn, index, left);
  widenObstacle(drawn, index, width);
  raiseObstacle(drawn[index], far < near && kind === "slope" ? -height : height);
  return index;
}

// Adds an obstacle behind another, with level ground before it, or in the next place where there is room.
function addBehind(drawn, kind, index) {
  const { width, height, rise } = TERRAIN_SIZES[kind];
  const ends = [index < 0 ? 0 : obstacleEnd(drawn[index]), ...drawn.slice(Math.max(index + 1, 0)).map(obstacleEnd)];
  for (const before of [1, 0]) {
    for (const end of ends) {
      const { end: limit } = roomAt(drawn, end, 1);
      if (limit - end < before + width + 1e-3) continue;
      return addObstacle(drawn, kind, end + before, end + before + width, height ?? rise ?? 0);
    }
  }
  return -1;
}

// What a creature is to a terrain: how far it reaches back and forward, how high, and how long it counts as.
function bodyReach(parts) {
  const angle = ({ angle = 0 }) => angle * EDITOR_DEGREE;
  // Turned so that the wanted side is below.
  const far = (axis, sign, turn) => Math.max(...parts.map(part => (
    sign * part.position[axis] - lowestPoint(part.shape, angle(part) + turn)[1]
  )));
  if (!parts.length) return { back: 0, front: 0, top: 1, length: 1 };
  const [front, back] = [far(0, 1, -Math.PI / 2), -far(0, -1, Math.PI / 2)];
  const [top, bottom] = [far(1, 1, Math.PI), -far(1, -1, 0)];
  return { back, front, top, length: Math.max(front - back, top - bottom) };
}

// The ground as an arena has it: blocks from the floor up, slanted ones for slopes, with a low mound on their upper ends.
function drawnGround(drawn, { back, front, length }) {
  if (!drawn.length) return null;
  const levels = terrainLevels(drawn);
  const floor = Math.min(...levels) - Math.max(1.5 * length, 1);
  const shapes = [];
  let x = back - front - 50;
  const block = (to, left, right = left) => {
    if (to > x) shapes.push([x, floor, to, floor, to, right, x, left]);
    x = to;
  };
  drawn.forEach((obstacle, index) => {
    const { from, width } = obstacleSizes(obstacle);
    const level = levels[index];
    block(from, level);
    if (obstacle.box) block(from + width, level + obstacle.box.height);
    else if (obstacle.slope) {
      const start = [x, level];
      block(from + width, level, levels[index + 1]);
      shapes.push(brow(start, [x, levels[index + 1]]));
    } else x = from + width;
  });
  block(x + 500, levels[levels.length - 1]);
  return decodeGround({ floor: floor * 1000, shapes: shapes.map(corners => corners.map(place => place * 1000)) });
}

function terrainEnd(drawn) { return drawn.length ? obstacleEnd(drawn[drawn.length - 1]) : 0; }

// The line of the surface, with some level ground at both ends and gaps down to a floor.
function terrainOutline(drawn, margin, floor) {
  const levels = terrainLevels(drawn);
  const inner = drawn.flatMap((obstacle, index) => {
    const { from, width } = obstacleSizes(obstacle);
    const level = levels[index];
    const inside = obstacle.gap ? floor : level + (obstacle.box?.height ?? 0);
    const corners = obstacle.slope ? [] : [[from, inside], [from + width, inside]];
    return [[from, level], ...corners, [from + width, levels[index + 1]]];
  });
  return [[-margin, 0], ...inner, [terrainEnd(drawn) + margin, levels[levels.length - 1]]];
}

// Whether two terrains are the same to a tenth of a millimetre, names and all.
function isSameGround(one, other) {
  const short = (_, value) => typeof value === "number" ? editorRounded(value, 4) : value;
  const text = ({ name, drawn }) => JSON.stringify([name, drawn], short);
  return text(one) === text(other);
}

// The mound: a disc of 0.25 m that stands 2 cm out of the corner, between the directions that slope and level ground face.
function brow(from, to) {
  const [x, y] = to[1] > from[1] ? to : from;
  const half = Math.atan2(to[1] - from[1], to[0] - from[0]) / 2;
  const [radius, depth] = [0.25, 0.23];
  return Array.from({ length: 32 }, (_, i) => i * Math.PI / 16).flatMap(turn => [
    x + depth * Math.sin(half) + radius * Math.cos(turn), y - depth * Math.cos(half) + radius * Math.sin(turn),
  ]);
}
