// What is painted on parts: how the editor makes decorations, and places, stretches and pulls them about. Their points are in
// the frame of their part, in metres from its centre; angles are in degrees, counter-clockwise, as in the file.

// Forms: name, key (none has one), word, icon.
const EDITOR_FORMS = [
  ["ellipse", "", "Ellipse", "M3 12a9 6 0 1 0 18 0a9 6 0 1 0-18 0"], ["rectangle", "", "Rectangle", "M4 7h16v10H4z"],
  ["polygon", "", "Polygon", "M12 4l8.5 6.2-3.2 9.8H6.7L3.5 10.2z"], ["line", "", "Line", "M3.5 18l6-10 5 8 6-9"],
];
const EDITOR_MOST_DECORATIONS = 256;
const EDITOR_MOST_POINTS = 256;
const EDITOR_FEWEST_POINTS = { polygon: 3, line: 2 };
// Paint that is seen on dark and on light parts.
const EDITOR_PAINTS = ["#fdf6e3", "#2b2d42"];

function decorationsOf(part) { return part?.look?.decorations || []; }

// A form that the editor does not know has no kind, and nothing in it.
function formKind({ form }) { return EDITOR_FORMS.map(([kind]) => kind).find(kind => form?.[kind]); }
function formOf(decoration) { return decoration.form?.[formKind(decoration)] || {}; }

function decorationWord(decoration) {
  const word = EDITOR_FORMS.find(([kind]) => kind === formKind(decoration))?.[2] ?? "Unknown form";
  const { points } = formOf(decoration);
  return points ? `${word}, ${count(points.length, "point", "points")}` : word;
}

function isColour(text) { return /^#[0-9a-f]{6}$/i.test(text); }

// Gives a decoration from a file what drawing and editing rely on.
function repairDecoration(decoration) {
  const kind = formKind(decoration);
  if (!kind) return;
  const form = decoration.form[kind] = { ...decoration.form[kind] };
  const pair = (value, bounds, otherwise) => [0, 1].map(i => editorBounded(value?.[i], bounds, otherwise));
  if (kind in EDITOR_FEWEST_POINTS) {
    const points = Array.isArray(form.points) ? form.points : [];
    form.points = points.slice(0, EDITOR_MOST_POINTS).map(point => pair(point, EDITOR_BOUNDS.place, 0));
  } else {
    const size = kind === "ellipse" ? "radii" : "size";
    form.centre = pair(form.centre, EDITOR_BOUNDS.place, 0);
    form[size] = pair(form[size], EDITOR_BOUNDS.extent, 0.05);
    for (const name of ["angle", "corner_radius"]) {
      if (name in form) form[name] = editorBounded(form[name], EDITOR_BOUNDS[name], 0);
    }
  }
  for (const name of ["fill", "stroke"]) if (decoration[name] === null) delete decoration[name];
  if ("width" in decoration) decoration.width = editorBounded(decoration.width, EDITOR_BOUNDS.line_width, 0.01);
}

function roundedPlace(point) {
  return point.map(value => editorRounded(editorBounded(value, EDITOR_BOUNDS.place, 0)));
}

// Places all that a decoration is made of by a map of the plane that turns by so many degrees.
function placeDecoration(decoration, place, turn = 0) {
  const form = formOf(decoration);
  if (form.points) form.points = form.points.map(point => roundedPlace(place(point)));
  if (!form.centre) return;
  form.centre = roundedPlace(place(form.centre));
  if (turn) setAngle(form, (form.angle || 0) + turn);
}

function shiftDecoration(decoration, [dx, dy]) { placeDecoration(decoration, ([x, y]) => [x + dx, y + dy]); }

// Stretches a decoration along the axes of its part; a negative factor mirrors it. What is turned is stretched along its own
// axes, which is exact unless the factors differ.
function stretchDecoration(decoration, sx, sy) {
  const form = formOf(decoration);
  const size = Math.sqrt(Math.abs(sx * sy));
  const [cos, sin] = turnedPoint([1, 0], form.angle || 0);
  const axes = [Math.hypot(cos * sx, sin * sy), Math.hypot(sin * sx, cos * sy)];
  const stretched = (value, factor, bounds) => editorRounded(editorBounded(value * factor, bounds, value));
  for (const name of ["radii", "size"]) {
    if (form[name]) form[name] = form[name].map((value, i) => stretched(value, axes[i], EDITOR_BOUNDS.extent));
  }
  if (form.angle) form.angle = editorRounded(Math.atan(sin * sy / (cos * sx || 1e-9)) / EDITOR_DEGREE, 3);
  if (form.corner_radius) form.corner_radius = stretched(form.corner_radius, size, EDITOR_BOUNDS.corner_radius);
  placeDecoration(decoration, ([x, y]) => [x * sx, y * sy]);
  if (size !== 1 && decoration.width) decoration.width = stretched(decoration.width, size, EDITOR_BOUNDS.line_width);
}

// Points on the edge of a decoration: enough to say where it is, and to make a polygon of it.
function decorationOutline(decoration) {
  const { points, centre, radii, size, angle = 0 } = formOf(decoration);
  if (points || !centre) return points || [];
  const turns = Array.from({ length: 24 }, (_, i) => turnedPoint([1, 0], i * 15));
  const around = radii ? turns.map(([x, y]) => [x * radii[0], y * radii[1]])
    : [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => [x * size[0] / 2, y * size[1] / 2]);
  return around.map(point => {
    const [x, y] = turnedPoint(point, angle);
    return [centre[0] + x, centre[1] + y];
  });
}

// The middle of what a decoration covers, and half its extent.
function decorationBox(decoration) {
  const points = decorationOutline(decoration);
  if (!points.length) return { centre: [0, 0], half: [0, 0] };
  const ends = [0, 1].map(axis => [Math.min, Math.max].map(most => most(...points.map(point => point[axis]))));
  return { centre: ends.map(([from, to]) => (from + to) / 2), half: ends.map(([from, to]) => (to - from) / 2) };
}

function turnDecoration(decoration, degrees) {
  const [x, y] = decorationBox(decoration).centre;
  placeDecoration(decoration, point => {
    const [u, v] = turnedPoint([point[0] - x, point[1] - y], degrees);
    return [x + u, y + v];
  }, degrees);
}

function scaleDecoration(decoration, factor) {
  const [x, y] = decorationBox(decoration).centre;
  shiftDecoration(decoration, [-x, -y]);
  stretchDecoration(decoration, factor, factor);
  shiftDecoration(decoration, [x, y]);
}

// Gives a decoration another form that covers about the same.
function reformDecoration(decoration, kind) {
  const { angle, radii, size } = formOf(decoration);
  const box = decorationBox(decoration);
  const half = radii || size?.map(value => value / 2) || box.half;
  const bounded = value => editorRounded(editorBounded(value, EDITOR_BOUNDS.extent, 0.05));
  const centre = roundedPlace(box.centre);
  const turned = angle ? { angle } : {};
  const points = decorationOutline(decoration).map(roundedPlace);
  // Two points are no area: a third makes one.
  if (kind === "polygon" && points.length === 2) {
    const [dx, dy] = [0, 1].map(axis => (points[1][axis] - points[0][axis]) / 2);
    points.push(roundedPlace([centre[0] - dy, centre[1] + dx]));
  }
  decoration.form = { [kind]: {
    ellipse: { centre, radii: half.map(bounded), ...turned },
    rectangle: { centre, size: half.map(value => bounded(2 * value)), ...turned },
    polygon: { points }, line: { points },
  }[kind] };
  if (kind !== "line") return;
  decoration.stroke ||= decoration.fill || EDITOR_PAINTS[1];
  delete decoration.fill;
}

// A colour that is seen on another.
function paintOn(colour) {
  const [red, green, blue] = parseColour(colour || PLAIN_COLOUR);
  return EDITOR_PAINTS[0.3 * red + 0.59 * green + 0.11 * blue < 128 ? 0 : 1];
}

// Paints something on the middle of a part, on top of all else. Returns its place in the list.
function addDecoration(part, kind) {
  const [w, h] = halfExtent(part.shape);
  const size = editorRounded(editorBounded(Math.min(w, h) / 2, EDITOR_BOUNDS.extent, 0.05), 3) || 0.001;
  const end = editorRounded(Math.max(w, h) / 2, 3);
  const form = {
    ellipse: { centre: [0, 0], radii: [size, size] }, rectangle: { centre: [0, 0], size: [2 * size, size] },
    polygon: { points: [[-size, -size], [size, -size], [0, size]] },
    line: { points: w > h ? [[-end, 0], [end, 0]] : [[0, -end], [0, end]] },
  }[kind];
  const paint = paintOn(part.look?.colour);
  const decoration = { form: { [kind]: form }, ...(kind === "line" ? { stroke: paint, width: 0.01 } : { fill: paint }) };
  part.look ||= {};
  part.look.decorations = [...decorationsOf(part), decoration];
  return part.look.decorations.length - 1;
}

// One more decoration like this, beside it towards the middle, or its mirror image across the part. Returns its place in the
// list, just above the first; -1 if it is its own mirror image.
function copyDecoration(part, index, isMirror) {
  const decoration = structuredClone(part.look.decorations[index]);
  if (isMirror) {
    const before = decorationOutline(decoration);
    stretchDecoration(decoration, -1, 1);
    const isThere = ([x, y]) => before.some(point => Math.hypot(point[0] - x, point[1] - y) < 1e-4);
    if (decorationOutline(decoration).every(isThere)) return -1;
  } else {
    const { centre, half } = decorationBox(decoration);
    const step = Math.max(editorRounded(2.4 * half[0], 2), 0.01);
    shiftDecoration(decoration, [centre[0] > 0 ? -step : step, 0]);
  }
  part.look.decorations.splice(index + 1, 0, decoration);
  return index + 1;
}

function removeDecoration(part, index) {
  part.look.decorations.splice(index, 1);
  if (!part.look.decorations.length) delete part.look.decorations;
}

// What can be dragged of a decoration when a pixel is so large: its middle, its sides or points, and the points that can be
// put between them. Things too small to be told apart from the middle are left out.
function decorationHandles(decoration, pixel) {
  const { radii, size, points, angle = 0 } = formOf(decoration);
  const { centre, half } = decorationBox(decoration);
  const place = point => {
    const [x, y] = turnedPoint(point, angle);
    return [centre[0] + x, centre[1] + y];
  };
  const found = [{ kind: "paint", at: centre }];
  if (points) {
    if (Math.max(...half) < 9 * pixel) return found;
    found.push(...points.map((at, point) => ({ kind: "point", which: point, at })));
    const isOpen = formKind(decoration) === "line";
    points.forEach((from, i) => {
      const to = points[(i + 1) % points.length];
      const isLast = isOpen && i === points.length - 1;
      if (isLast || points.length >= EDITOR_MOST_POINTS || Math.hypot(to[0] - from[0], to[1] - from[1]) < 40 * pixel) return;
      found.push({ kind: "between", which: i + 1, at: [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2] });
    });
    return found;
  }
  if (!radii && !size) return found;
  const [w, h] = radii || size.map(value => value / 2);
  if (w >= 11 * pixel) for (const sign of [-1, 1]) found.push({ kind: "side", axis: 0, sign, at: place([sign * w, 0]) });
  if (h >= 11 * pixel) for (const sign of [-1, 1]) found.push({ kind: "side", axis: 1, sign, at: place([0, sign * h]) });
  found.push({ kind: "spin", at: place([0, h + 26 * pixel]) });
  return found;
}

// Pulls a side to a point; the opposite one stays.
function pullDecorationSide(decoration, { axis, sign }, point, snap) {
  const form = formOf(decoration);
  const { centre, radii, angle = 0 } = form;
  const sizes = radii || form.size;
  const share = radii ? 1 : 2;
  const half = sizes[axis] / share;
  const away = turnedPoint([point[0] - centre[0], point[1] - centre[1]], -angle)[axis] * sign;
  const size = snap(Math.max(away + half, 0));
  sizes[axis] = editorRounded(editorBounded(size / 2 * share, EDITOR_BOUNDS.extent, sizes[axis]));
  const shift = (sizes[axis] / share - half) * sign;
  const [dx, dy] = turnedPoint(axis ? [0, shift] : [shift, 0], angle);
  form.centre = roundedPlace([centre[0] + dx, centre[1] + dy]);
}

// Reads points that are written as “x, y” in lines; says what is wrong with them if they are none.
function readPoints(text, kind) {
  const numbers = text.split(/[\s,;]+/).filter(Boolean).map(word => Number(word.replace("−", "-")));
  const fewest = EDITOR_FEWEST_POINTS[kind];
  if (!numbers.every(Number.isFinite) || numbers.length % 2) return "Two numbers a line are wanted.";
  const length = numbers.length / 2;
  if (length < fewest || length > EDITOR_MOST_POINTS) return `${fewest} to ${EDITOR_MOST_POINTS} points are wanted.`;
  return Array.from({ length }, (_, i) => roundedPlace(numbers.slice(2 * i, 2 * i + 2)));
}
