// Plays a trained character of Gambol: from the state of its body to the speeds of its motors, once a frame.
//
// Copy this file into a game; it is an ES module for Node and browsers, and needs nothing else. docs/player.md is the
// specification of the file format and of everything that is computed. MIT OR Apache-2.0. For Node without a package.json
// that says `"type": "module"`, name it `.mjs`.
//
//     import { Character, Player } from "./gambol-player.js";
//     const file = await fetch("biped.player");
//     const character = Character.fromBytes(new Uint8Array(await file.arrayBuffer()));
//     const player = new Player(character); // after a body is built from character.parts and character.hinges
//     const speeds = player.tick(parts, outside, { speed: 1, jump: false }, 1 / 60);
//
// Units: metres, kilograms, seconds, radians; x points forward, y up; angles count counter-clockwise. Numbers are rounded
// to 32 bits where the original rounds them; only exp, tanh, sin, cos and atan2 are the language's own.

/** The version of the format that this file reads. */
export const VERSION = 2;

/** Why bytes are not a character. */
export class FileError extends Error {
  name = "FileError";
}

/** Why a frame could not be played. Its motors hold still. */
export class TickError extends Error {
  name = "TickError";
}

/** Why a body does not look the same from both sides. */
export class Asymmetry extends Error {
  name = "Asymmetry";
}

const MAGIC = "GAMBOLPL";
const HEADER = 24;
const MOST_NODES = 65536;
// The shortest records, in bytes: a count that promises more than the file holds is not believed.
const NUMBER = 4;
const [SHORTEST_PART, SHORTEST_HINGE, SHORTEST_OUTPUT] = [10, 9, 2];
const [SHORTEST_INPUT, SHORTEST_NEURON, SHORTEST_SOURCE] = [6, 4, 2];
const SHAPES = ["box", "circle", "capsule"];
const ACTIVATIONS = [
  "logistic", "tanh", "rationalTanh", "relu", "linear", "sine", "gaussian", "steepLogistic", "steepTanh",
];
const SOURCES = [
  "torsoRotation", "torsoSpin", "jointAngle", "jointSpeed", "velocityForward", "velocityUp", "torsoHeight", "contact",
  "ray", "slip", "gapDistance", "gapWidth", "clockSine", "clockCosine", "landingSine", "landingCosine",
  "commandedSpeed", "jumpCommand", "strideSine", "strideCosine", "jumpSine", "jumpSwell",
];
const OUTSIDE = ["ray", "gapDistance", "gapWidth"];
const HAS_PERIOD = /^(clock|landing|stride|jump)(Sine|Cosine|Swell)$/;

const f32 = Math.fround;
// NaN stays NaN.
const clamp = (number, low, high) => (number < low ? low : number > high ? high : number);

/** Fails unless something holds of the numbers of a field. */
function check(holds, field, index, allowed) {
  if (!holds) throw new FileError(`${field}, number ${index}: must be ${allowed}`);
}

// Limits have 32 bits, as the numbers of a file.
function within(number, low, high, field, index, allowed) {
  check(number >= f32(low) && number <= f32(high), field, index, allowed);
  return number;
}

function finite(numbers, field, index) {
  check(numbers.every(Number.isFinite), field, index, "of finite numbers");
  return numbers;
}

/** FNV-1a, 64 bits, in two halves: doubles hold the products. The digest as 16 hexadecimal digits. */
function digest(bytes) {
  let [high, low] = [0xcbf29ce4, 0x84222325];
  for (const byte of bytes) {
    low = (low ^ byte) >>> 0;
    const product = low * 0x1b3;
    high = (high * 0x1b3 + low * 256 + Math.floor(product / 2 ** 32)) % 2 ** 32;
    low = product % 2 ** 32;
  }
  return hexadecimal(high) + hexadecimal(low);
}

const hexadecimal = (number) => number.toString(16).padStart(8, "0");

/** Reads fields one after the other, the lowest byte first. */
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
    /** What is read, for errors. */
    this.field = "numbers";
    /** The numbers that the rest of the file points at. */
    this.numbers = [];
  }

  /** Where the next bytes are. */
  take(count) {
    this.need(count);
    this.at += count;
    return this.at - count;
  }

  need(count) {
    if (count > this.bytes.length - this.at) {
      throw new FileError(`the file does not end with its last field: ${this.field}`);
    }
  }

  u8() {
    return this.bytes[this.take(1)];
  }

  /** Seven bits a byte, the lowest first; the eighth says that another byte follows. */
  u16() {
    let whole = 0;
    for (let place = 0; place < 3; place += 1) {
      const byte = this.u8();
      whole |= (byte & 0x7f) << (7 * place);
      if (byte < 0x80 && whole < 65536) return whole;
    }
    return check(false, this.field, 0, "of whole numbers from 0 to 65535, in at most three bytes");
  }

  /** One of the numbers at the beginning. */
  f32() {
    const index = this.u16();
    check(index < this.numbers.length, this.field, 0, "of numbers that are listed");
    return this.numbers[index];
  }

  f32s(count) {
    return Array.from({ length: count }, () => this.f32());
  }

  code(index, count, allowed) {
    const code = this.u8();
    check(code < count, this.field, index, allowed);
    return code;
  }

  flag(index) {
    return this.code(index, 2, "0 or 1 where it says yes or no") === 1;
  }

  text(index) {
    const length = this.u8();
    const start = this.take(length);
    try {
      const decoder = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });
      return decoder.decode(this.bytes.subarray(start, start + length));
    } catch {
      return check(false, this.field, index, "named in UTF-8");
    }
  }

  /** The number of records, each at least `shortest` bytes long. */
  count(field, shortest) {
    this.field = field;
    const count = this.u16();
    this.need(count * shortest);
    return count;
  }

  list(field, shortest, record) {
    const count = this.count(field, shortest);
    check(count > 0, field, 0, "from 1 to 65535 of them");
    return Array.from({ length: count }, (_, index) => record(index));
  }

  world() {
    this.field = "world";
    const [timeStep, gravity, groundFriction, motorGain, bodyLength, restHeight] = this.f32s(6);
    const selfCollision = this.flag(0);
    const [density, drag, slip] = this.flag(0) ? this.f32s(3) : [];
    within(timeStep, 0.001, 0.05, "time step", 0, "from 0.001 to 0.05 s");
    within(gravity, 0, 100, "gravity", 0, "from 0 to 100 m/s²");
    within(groundFriction, 0, 10, "ground friction", 0, "from 0 to 10");
    within(motorGain, 0.01, 1e6, "motor gain", 0, "from 0.01 to 1e6");
    within(bodyLength, 0.001, 1e4, "body length", 0, "from 0.001 to 10000 m");
    finite([restHeight], "rest height", 0);
    const water = density === undefined ? null : { density, drag, slip };
    if (water) {
      within(density, 0.01, 1e5, "water density", 0, "from 0.01 to 1e5 kg/m²");
      within(drag, 0, 10, "water drag", 0, "from 0 to 10");
      within(slip, 0, drag, "water slip", 0, "from 0 to the drag");
    }
    return { timeStep, gravity, groundFriction, motorGain, bodyLength, restHeight, water, selfCollision };
  }

  part(index) {
    const name = this.text(index);
    const kind = SHAPES[this.code(index, SHAPES.length, "a box (0), a circle (1) or a capsule (2)")];
    const [first, second] = this.f32s(2);
    const [x, y, angle, density, friction] = this.f32s(5);
    const foot = this.flag(index);
    finite([x, y, angle], "parts", index);
    within(density, 0.1, 1e4, "parts", index, "as dense as 0.1 to 10000 kg/m²");
    within(friction, 0, 10, "parts", index, "with a friction from 0 to 10");
    for (const size of kind === "circle" ? [first] : [first, second]) {
      within(size, 0.005, 50, "parts", index, "of sizes from 0.005 to 50 m");
    }
    const sizes = { box: { width: first, height: second }, circle: { radius: first } }[kind];
    const shape = Object.freeze({ kind, ...(sizes ?? { length: first, radius: second }) });
    return { name, shape, x, y, angle, density, friction, foot };
  }

  /** `hangs`: the parts that hang on an earlier hinge. */
  hinge(index, parts, hangs) {
    const [parent, child] = [this.u16(), this.u16()];
    const [parentAnchor, childAnchor, limits] = [this.f32s(2), this.f32s(2), this.f32s(2)];
    const [topSpeed, topTorque] = this.flag(index) ? this.f32s(2) : [];
    const fits = parent < child && child < parts && !hangs.has(child);
    check(fits, "hinges", index, "between a part and a later one that hangs on no other");
    hangs.add(child);
    finite([...parentAnchor, ...childAnchor], "hinges", index);
    const limited = limits[0] >= -10 && limits[0] <= 0 && limits[1] >= 0 && limits[1] <= 10;
    check(limited, "hinges", index, "limited from at most 0 to at least 0, within ± 10 rad");
    const motor = topSpeed === undefined ? null : { topSpeed, topTorque };
    if (motor) {
      within(topSpeed, 0.01, 100, "hinges", index, "with a top speed from 0.01 to 100 rad/s");
      within(topTorque, 0.01, 1e5, "hinges", index, "with a top torque from 0.01 to 1e5 N·m");
    }
    return { parent, child, parentAnchor, childAnchor, limits, motor };
  }

  input(index, parts, hinges) {
    const code = this.u8();
    const of = this.u16();
    const [first, second, middle, factor] = this.f32s(4);
    const wants = (holds, allowed) => check(holds, "inputs", index, allowed);
    wants(code < SOURCES.length, "a sensor that this player knows");
    const source = SOURCES[code];
    finite([middle, factor], "inputs", index);
    if (source.startsWith("joint")) wants(of < hinges, "of a hinge that is there");
    if (source === "contact" || source === "slip") wants(of < parts, "of a part that is there");
    if (source === "ray") finite([first], "inputs", index);
    if (OUTSIDE.includes(source)) {
      const length = source === "ray" ? second : first;
      within(length, 0, 1000, "inputs", index, "with a reach of at most 1000 m");
    }
    if (HAS_PERIOD.test(source)) within(first, 0.02, 100, "inputs", index, "with a period from 0.02 to 100 s");
    if (source.startsWith("stride")) {
      within(second, 0.1, 20, "inputs", index, "with a top speed from 0.1 to 20 body lengths/s");
    }
    return { source, of, first, second, middle, factor };
  }

  neuron(index) {
    const activation = ACTIVATIONS[this.code(index, ACTIVATIONS.length, "an activation that this player knows")];
    const [scale, bias] = finite(this.f32s(2), "neurons", index);
    const count = this.count("neurons", SHORTEST_SOURCE);
    const [sources, weights] = [new Uint16Array(count), new Float32Array(count)];
    for (let source = 0; source < count; source += 1) {
      [sources[source], weights[source]] = [this.u16(), this.f32()];
    }
    finite(weights, "neurons", index);
    return { activation, scale, bias, sources, weights };
  }
}

/**
 * A body and the controller that moves it, to be shared by all that play it. What to build in the engine:
 * - `parts`: bodies in the pose in which the character starts; the first is the torso. Each has a `name`, a `shape` centred on
 *   its place (`kind` is "box" with `width` and `height`, "circle" with `radius`, or "capsule" with `length` between the
 *   centres of its half discs along y, and `radius`; m), `x`, `y` (m; the ground is at 0), `angle` (rad), `density` (kg/m²),
 *   `friction` (that of a contact is the product with the ground's) and `foot` (whether it is the last part of a leg);
 * - `hinges`: `parent` and `child` (parts), `parentAnchor` and `childAnchor` ([x, y] in the part's own frame, m), `limits`
 *   (smallest and largest angle of the child against the parent, rad, against that of the start pose) and `motor`: null, or
 *   `topSpeed` (rad/s) and `topTorque` (N·m). A motor that is no output is asked for speed 0 for ever;
 * - `world` it has learned in: `timeStep` (s), `gravity` (m/s², downwards), `groundFriction`, `motorGain` (N·m per rad/s),
 *   `bodyLength` (m, in which speeds are commanded), `restHeight` (of the torso's centre, m), `selfCollision` (two parts that
 *   share a hinge never collide) and `water`: null, or `density` (kg/m²), `drag` and `slip`;
 * - `outputs`: the hinge that each output moves.
 *
 * And: `name` of the creature, `movement` it has learned, `facing` ("right" or "left"), `actuation` (`gain` in 1/s, or null
 * where outputs ask for speeds), `inputRange`, `inputs`, `neurons`, and `outputNodes`.
 */
export class Character {
  /** From an object with all fields; for a file there is `fromBytes`. */
  constructor(fields) {
    Object.assign(this, fields);
    Object.freeze(this);
  }

  /** Reads the bytes of a `.player` file, a Uint8Array. Throws a FileError if they are cut, changed, or out of range. */
  static fromBytes(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < HEADER || String.fromCharCode(...bytes.subarray(0, 8)) !== MAGIC) {
      throw new FileError("not a character of Gambol: write one with `gambol export --to player`");
    }
    const [version, expected, found] = [view.getUint32(8, true), view.getUint32(12, true), bytes.length - HEADER];
    if (version !== VERSION) {
      throw new FileError(`version ${version} of the format; this player reads version ${VERSION}`);
    }
    if (expected !== found) {
      throw new FileError(`${found} bytes after the header, which says ${expected}: the file was cut or added to`);
    }
    const content = bytes.subarray(HEADER);
    if (hexadecimal(view.getUint32(20, true)) + hexadecimal(view.getUint32(16, true)) !== digest(content)) {
      throw new FileError("the digest does not fit: the file was changed after it was written");
    }
    return Character.#fromContent(new Reader(content));
  }

  static #fromContent(file) {
    const numbers = file.count("numbers", NUMBER);
    file.numbers = Array.from({ length: numbers }, () => file.view.getFloat32(file.take(4), true));
    file.field = "name";
    const name = file.text(0);
    file.field = "movement";
    const movement = file.text(0);
    const world = file.world();
    const parts = file.list("parts", SHORTEST_PART, (index) => file.part(index));
    const hangs = new Set();
    const hingeCount = file.count("hinges", SHORTEST_HINGE);
    // A body of one part has none.
    check(hingeCount + 1 === parts.length, "hinges", 0, "one for each part but the torso");
    const hinges = Array.from({ length: hingeCount }, (_, index) => file.hinge(index, parts.length, hangs));
    file.field = "actuation";
    const isAngle = file.code(0, 2, "0 (speed) or 1 (angle)") === 1;
    const gain = file.f32();
    const actuation = isAngle ? { gain: within(gain, 0.1, 50, "actuation", 0, "with a gain from 0.1 to 50") } : null;
    const records = file.list("outputs", SHORTEST_OUTPUT, () => [file.u16(), file.u16()]);
    const [outputs, outputNodes] = [records.map(([hinge]) => hinge), records.map(([, node]) => node)];
    outputs.forEach((hinge, index) => {
      const free = hinge < hinges.length && hinges[hinge].motor !== null && outputs.indexOf(hinge) === index;
      check(free, "outputs", index, "a hinge with a motor, listed once");
    });
    file.field = "input range";
    const inputRange = within(file.f32(), 0.001, 1000, "input range", 0, "from 0.001 to 1000");
    const inputs = file.list("inputs", SHORTEST_INPUT, (index) => file.input(index, parts.length, hinges.length));
    const neuronCount = file.count("neurons", SHORTEST_NEURON);
    const neurons = Array.from({ length: neuronCount }, (_, index) => file.neuron(index));
    const nodes = inputs.length + neurons.length;
    const known = [outputNodes, ...neurons.map(({ sources }) => sources)].every((list) => list.every((n) => n < nodes));
    check(known && nodes <= MOST_NODES, "neurons", 0, "connected with nodes that are there");
    if (file.at !== file.bytes.length) throw new FileError("the file does not end with its last field: neurons");
    const facing = "right";
    const body = { name, movement, facing, world, parts, hinges };
    return new Character({ ...body, actuation, outputs, inputRange, inputs, neurons, outputNodes });
  }

  /** The same character, facing the other way: its parts and hinges are those to build, and its player takes and gives what
   * belongs to that body. */
  mirrored() {
    const parts = this.parts.map((part) => ({ ...part, x: -part.x, angle: -part.angle }));
    const anchor = ([x, y]) => [-x, y];
    const hinges = this.hinges.map((hinge) => ({
      ...hinge,
      parentAnchor: anchor(hinge.parentAnchor),
      childAnchor: anchor(hinge.childAnchor),
      limits: mirroredLimits(hinge.limits),
    }));
    return new Character({ ...this, facing: this.facing === "right" ? "left" : "right", parts, hinges });
  }

  /**
   * What the game has to measure every frame, in the order in which `Player.tick` takes it; nothing for most characters:
   * - `kind` "ray": the distance from the torso's centre to the first thing that is not the character, along `angle` (in the
   *   world, rad; 0 looks towards greater x); `length` (m) if there is none;
   * - "gapDistance": the distance from the torso's centre to the near edge of the next gap ahead, at least 0; `length` if there
   *   is none;
   * - "gapWidth": the width of that gap, m; 0 if there is none.
   */
  outside() {
    return outsideFacing(this.inputs, this.facing);
  }

  /** Whether its body looks the same from both sides, so that its player can turn round: `Player.face`. Throws an Asymmetry
   * that names the first part that has no mirror image, or whose hinge is not that of its mirror image. */
  symmetry() {
    twinsOf(this);
  }

  /** The parts as they start, at rest, as `Player.tick` takes them. */
  startPose() {
    return this.parts.map(({ x, y, angle }) => {
      return { x, y, cos: Math.cos(angle), sin: Math.sin(angle), vx: 0, vy: 0, spin: 0, touching: false };
    });
  }
}

const mirroredLimits = ([low, high]) => [-high, -low];

function outsideFacing(inputs, facing) {
  return inputs.filter(({ source }) => OUTSIDE.includes(source)).map(({ source, first, second }) => {
    if (source !== "ray") return { kind: source, length: first };
    return { kind: source, angle: facing === "left" ? f32(f32(Math.PI) - first) : first, length: second };
  });
}

/** Lengths may differ by so much, m, and angles, rad: files hold decimals. */
const TOLERANCE = f32(1e-4);

/** For each part, and each output, the one that is its mirror image, across the upright line through the torso: a part in the
 * middle is its own. Throws an Asymmetry where there is none. */
function twinsOf({ parts, hinges, outputs }) {
  // The hinge that each part hangs on.
  const hangs = parts.map(() => null);
  hinges.forEach((hinge, index) => (hangs[hinge.child] = { ...hinge, actuated: outputs.includes(index) }));
  const twins = parts.map(() => null);
  parts.forEach((part, index) => {
    if (twins[index] !== null) return;
    const hinge = hangs[index];
    const above = hinge && twins[hinge.parent];
    const isTwin = (other, at) => {
      const free = at >= index && twins[at] === null && (hangs[at]?.parent ?? null) === above;
      return free && areMirrored(part, other, parts[0].x);
    };
    const candidates = [...parts.keys()].filter((at) => isTwin(parts[at], at));
    if (candidates.length === 0) throw new Asymmetry(`part ${index} has no mirror image on the other side`);
    const twin = candidates.find((at) => hinge === null || hingesAreMirrored(hinge, hangs[at]));
    if (twin === undefined) {
      throw new Asymmetry(`the hinge of part ${index} is not the mirror image of that of its twin`);
    }
    [twins[index], twins[twin]] = [twin, index];
  });
  const children = outputs.map((hinge) => hinges[hinge].child);
  return { parts: twins, outputs: children.map((child) => children.indexOf(twins[child])) };
}

// With 32 bits, as the original: what it takes for a mirror image is one here.
const near = (one, other) => Math.abs(f32(one - other)) <= TOLERANCE;

function areMirrored(one, other, middle) {
  // After half a turn a part looks the same, but its angle, which is sensed, is not.
  const turns = f32(f32(one.angle + other.angle) / TURN);
  const turned = near(f32(f32(turns - Math.round(turns)) * TURN), 0);
  const sameShape = ["kind", "width", "height", "length", "radius"].every((size) => one.shape[size] === other.shape[size]);
  const inPlace = near(f32(one.x - middle), f32(middle - other.x)) && near(one.y, other.y) && turned;
  return sameShape && inPlace && near(f32(one.density / other.density), 1) && near(one.friction, other.friction);
}

function hingesAreMirrored(one, other) {
  const anchors = ([x, y], [otherX, otherY]) => near(x, -otherX) && near(y, otherY);
  const limits = near(one.limits[0], -other.limits[1]) && near(one.limits[1], -other.limits[0]);
  const inPlace = anchors(one.parentAnchor, other.parentAnchor) && anchors(one.childAnchor, other.childAnchor);
  return inPlace && limits && motorsAreAlike(one.motor, other.motor) && one.actuated === other.actuated;
}

function motorsAreAlike(one, other) {
  if (one === null || other === null) return one === other;
  return near(f32(one.topSpeed / other.topSpeed), 1) && near(f32(one.topTorque / other.topTorque), 1);
}

const TURN = f32(2 * Math.PI);
/** The longest a frame may last, s. */
const LONGEST_FRAME = 1;
/** What touches within this time of a landing belongs to it, s: feet come down one after the other, and bounce. */
const ONE_LANDING = f32(0.2);
const NOT_FINITE = "a number is not finite; the motors hold still and the net begins anew";

/** One body that is played: clocks, and memory of the net. Allocates while it is made and when it turns round, not in frames. */
export class Player {
  #restTorso;
  #hinges;
  #drives;
  #outside;
  /** Whether it faces left now. */
  #left;
  /** Which part and which output takes the place of which, or null if the body was built to face as it does. */
  #twins;
  #ground = 0;
  /** Inputs, and what each neuron put out last. */
  #nodes;
  #inputs;
  #outputs;
  /** The parts as the net knows them: facing right. */
  #parts;
  #jointAngles;
  #speeds;
  #torques;
  #seconds;
  #landed;
  #touched;
  #commandedSpeed;
  #jump;
  #sincePress;
  #strideBegan;
  #step;

  /** A body that stands in its start pose, its clocks at 0. */
  constructor(character) {
    /** What is played. */
    this.character = character;
    const left = character.facing === "left";
    // The net knows the body as it was trained: facing right.
    const { parts } = left ? character.mirrored() : character;
    const direction = (angle) => ({ cos: f32(Math.cos(angle)), sin: f32(Math.sin(angle)) });
    this.#restTorso = direction(parts[0].angle);
    this.#hinges = character.hinges.map(({ parent, child }) => {
      return { parent, child, rest: direction(f32(parts[child].angle - parts[parent].angle)) };
    });
    this.#drives = character.outputs.map((hinge) => {
      const { limits, motor } = character.hinges[hinge];
      const [low, high] = left ? mirroredLimits(limits) : limits;
      return { hinge, low, high, reach: Math.max(Math.abs(low), Math.abs(high)), topSpeed: motor.topSpeed };
    });
    this.#outside = character.outside().length;
    this.#nodes = new Float32Array(character.inputs.length + character.neurons.length);
    this.#inputs = this.#nodes.subarray(0, character.inputs.length);
    this.#outputs = new Float32Array(character.outputs.length);
    this.#parts = character.startPose();
    this.#jointAngles = new Float32Array(character.hinges.length);
    this.#speeds = new Float32Array(character.outputs.length);
    this.#torques = new Float32Array(character.outputs.length);
    this.reset();
  }

  /** Begins anew: clocks at 0, the net without memory, facing as it was built. Call it when the body was put back into its
   * start pose. */
  reset() {
    [this.#left, this.#twins] = [this.character.facing === "left", null];
    this.#nodes.fill(0);
    this.#speeds.fill(0);
    // A body that stands as its clock starts.
    [this.#seconds, this.#landed, this.#touched] = [0, 0, true];
    [this.#commandedSpeed, this.#jump, this.#step] = [0, false, 0];
    [this.#sincePress, this.#strideBegan] = [Infinity, 0];
  }

  /** How high the ground is where the body stands, m; 0 until it is said, and unchanged by what is not finite. Only a character that
   * senses the height of its torso goes by it. One that was trained on a terrain that rises or falls heard its height above the
   * ground it started on: tell it the height of that. */
  setGround(height) {
    if (Number.isFinite(f32(height))) this.#ground = f32(height);
  }

  /** Turns round, from the next frame on: "left" or "right". A body that looks the same from both sides (`character.symmetry`)
   * runs the other way with the same net, and what it is told is meant the way it faces. A body that stands turns best; one that
   * runs is told to stand first. Throws an Asymmetry if the body does not look the same from both sides; it goes on as it was. */
  face(facing) {
    if (facing !== "left" && facing !== "right") throw new RangeError(`"${facing}": must be "left" or "right"`);
    if (facing === this.facing) return;
    this.#twins = facing === this.character.facing ? null : twinsOf(this.character);
    this.#left = facing === "left";
  }

  /** Which way it faces: "left" or "right". */
  get facing() {
    return this.#left ? "left" : "right";
  }

  /** What the game has to measure every frame, as `character.outside()`, the way it faces now. */
  outside() {
    return outsideFacing(this.character.inputs, this.facing);
  }

  /** Since the start, s. */
  get seconds() {
    return this.#seconds;
  }

  /** The inputs of the net in the last frame. The next frame writes over them. */
  get inputs() {
    return this.#inputs;
  }

  /** What the net put out in the last frame. The next call writes over it. */
  get outputs() {
    for (let index = 0; index < this.#outputs.length; index += 1) {
      this.#outputs[index] = this.#nodes[this.character.outputNodes[index]];
    }
    return this.#outputs;
  }

  /** The speed that the motor of each output was last asked for, rad/s: of the child against the parent, counter-clockwise.
   * The next frame writes over it. */
  get speeds() {
    return this.#speeds;
  }

  /**
   * A frame: what the body does now, what is outside of it, and what it is told; the speeds that its motors are asked for until
   * the next, rad/s, in the order of `character.outputs`. The next frame writes over them.
   * - `parts`: an object for each part, in the order of `character.parts`: `x`, `y` of its centre (m), `cos` and `sin` of its
   *   angle against the world, `vx`, `vy` (m/s), `spin` (rad/s), `touching` (whether it touches the ground);
   * - `outside`: what the game measures, in the order of `outside()`;
   * - `command`: `speed` (body lengths/s the way the character faces, backwards below 0; values beyond what it was trained for
   *   count as the fastest) and `jump` (whether the button that means jump is held);
   * - `seconds`: how long this frame lasts, from 0 to 1 s.
   *
   * Throws a TickError if there are too few or too many parts or measurements, or a number is not finite. The motors are then
   * asked for speed 0, and what was told is not heard: clocks stand still, and after a number that is not finite the net begins
   * anew. A net whose own numbers grow beyond all bounds fails in the same way, but its frame has passed.
   */
  tick(parts, outside, command, seconds) {
    const error = this.#control(parts, outside, command, f32(seconds));
    if (error === null) return this.#speeds;
    this.#speeds.fill(0);
    if (error === NOT_FINITE) this.#nodes.fill(0);
    throw new TickError(error);
  }

  /** The torque of the motor of each output, N·m, counter-clockwise on the child and as much the other way on the parent, for
   * engines whose hinges have no motors: in proportion to the speed that is lacking, up to the motor's top torque. May be asked
   * for at every step of the engine, several times a frame. The next call writes over it. 0 where a spin is not finite. A motor
   * that is no output gets none here: the game holds it still by the same law, asked for speed 0. */
  torques(parts) {
    const { hinges, outputs, world } = this.character;
    for (let index = 0; index < outputs.length; index += 1) {
      const { parent, child, motor } = hinges[outputs[index]];
      const lacking = this.#speeds[index] - ((parts[child]?.spin ?? 0) - (parts[parent]?.spin ?? 0));
      const wanted = Number.isFinite(lacking) ? lacking * world.motorGain : 0;
      this.#torques[index] = clamp(wanted, -motor.topTorque, motor.topTorque);
    }
    return this.#torques;
  }

  /** Why the frame could not be played, or null. */
  #control(parts, outside, command, step) {
    const { character } = this;
    const partCount = character.parts.length;
    if (parts.length !== partCount) return `${parts.length} parts, and the character has ${partCount}`;
    if (outside.length !== this.#outside) {
      return `${outside.length} measurements of what is outside, and the character wants ${this.#outside}`;
    }
    if (!(step >= 0 && step <= LONGEST_FRAME)) return "the time of a frame must be from 0 to 1 s";
    const side = this.#left ? -1 : 1;
    let finite = Number.isFinite(f32(command.speed));
    for (let index = 0; index < parts.length; index += 1) {
      const from = this.#twins === null ? index : this.#twins.parts[index];
      finite = take(this.#parts[index], parts[from], side) && finite;
    }
    for (let index = 0; index < outside.length; index += 1) finite = Number.isFinite(f32(outside[index])) && finite;
    if (!finite) return NOT_FINITE;
    this.#senseJoints();
    const time = f32(this.#seconds);
    this.#observeLanding(time);
    const jump = Boolean(command.jump);
    const pressed = jump && !this.#jump;
    const speed = f32(command.speed);
    this.#sincePress = pressed ? 0 : f32(this.#sincePress + this.#step);
    if (pressed || (speed !== 0 && this.#commandedSpeed === 0)) this.#strideBegan = time;
    this.#commandedSpeed = speed;
    this.#jump = jump;
    this.#step = step;
    this.#seconds += step;
    this.#sense(outside, time);
    this.#activate();
    for (let index = 0; index < this.#drives.length; index += 1) {
      const asked = f32(this.#asked(this.#drives[index], this.#nodes[character.outputNodes[index]]));
      if (!Number.isFinite(asked)) return NOT_FINITE;
      const place = this.#twins === null ? index : this.#twins.outputs[index];
      this.#speeds[place] = side * asked;
    }
    return null;
  }

  #senseJoints() {
    for (let index = 0; index < this.#hinges.length; index += 1) {
      const { parent, child, rest } = this.#hinges[index];
      const from = this.#parts[parent];
      const to = this.#parts[child];
      const cos = turnedBackCos(from.cos, from.sin, to.cos, to.sin);
      const sin = turnedBackSin(from.cos, from.sin, to.cos, to.sin);
      this.#jointAngles[index] = angleFrom(rest, cos, sin);
    }
  }

  #observeLanding(time) {
    let touches = false;
    for (let index = 0; index < this.#parts.length; index += 1) touches = this.#parts[index].touching || touches;
    if (touches && !this.#touched && f32(time - this.#landed) >= ONE_LANDING) this.#landed = time;
    this.#touched = touches;
  }

  #sense(outside, time) {
    const { inputs, inputRange } = this.character;
    let measured = 0;
    for (let index = 0; index < inputs.length; index += 1) {
      const { source, middle, factor } = inputs[index];
      let value;
      if (source === "ray" || source === "gapDistance" || source === "gapWidth") {
        value = f32(outside[measured]);
        measured += 1;
      } else {
        value = f32(this.#read(inputs[index], time));
      }
      this.#nodes[index] = clamp(f32(f32(value - middle) * factor), -inputRange, inputRange);
    }
  }

  #read({ source, of, first, second }, time) {
    const torso = this.#parts[0];
    switch (source) {
      case "torsoRotation": return angleFrom(this.#restTorso, torso.cos, torso.sin);
      case "torsoSpin": return torso.spin;
      case "jointAngle": return this.#jointAngles[of];
      case "jointSpeed": return this.#parts[this.#hinges[of].child].spin - this.#parts[this.#hinges[of].parent].spin;
      case "velocityForward": return torso.vx;
      case "velocityUp": return torso.vy;
      case "torsoHeight": return torso.y - f32(this.#ground + this.character.world.restHeight);
      case "contact": return this.#parts[of].touching ? 1 : 0;
      case "slip": return slip(this.#parts[of], this.character.parts[of].shape);
      case "clockSine": return Math.sin(clockPhase(time, first));
      case "clockCosine": return Math.cos(clockPhase(time, first));
      case "landingSine": return Math.sin(clockPhase(f32(time - this.#landed), first));
      case "landingCosine": return Math.cos(clockPhase(f32(time - this.#landed), first));
      case "commandedSpeed": return this.#commandedSpeed;
      case "jumpCommand": return this.#jump ? 1 : 0;
      case "strideSine": return this.#strideSwing(second) * Math.sin(clockPhase(f32(time - this.#strideBegan), first));
      case "strideCosine": return this.#strideSwing(second) * Math.cos(clockPhase(f32(time - this.#strideBegan), first));
      case "jumpSine": return Math.sin(this.#jumpPhase(first));
      case "jumpSwell": return 0.5 * (1 - Math.cos(this.#jumpPhase(first)));
      default: return NaN;
    }
  }

  #strideSwing(top) {
    return clamp(this.#commandedSpeed / top, -1, 1);
  }

  // 0 once the turn is over.
  #jumpPhase(period) {
    return this.#sincePress < period ? f32(f32(this.#sincePress / period) * TURN) : 0;
  }

  #activate() {
    const { inputs, neurons } = this.character;
    const nodes = this.#nodes;
    for (let index = 0; index < neurons.length; index += 1) {
      const { activation, scale, bias, sources, weights } = neurons[index];
      let sum = bias;
      for (let source = 0; source < sources.length; source += 1) {
        sum = f32(sum + f32(weights[source] * nodes[sources[source]]));
      }
      nodes[inputs.length + index] = f32(activated(activation, sum)) * scale;
    }
  }

  #asked({ hinge, low, high, reach, topSpeed }, output) {
    const wanted = clamp(output, -1, 1);
    const { actuation } = this.character;
    if (actuation === null) return wanted * topSpeed;
    const target = clamp(f32(wanted * reach), low, high);
    return clamp(f32(target - this.#jointAngles[hinge]) * actuation.gain, -topSpeed, topSpeed);
  }
}

/** Copies a part as the net knows it; whether all its numbers are finite. */
function take(own, part, side) {
  own.x = f32(side * part.x);
  own.y = f32(part.y);
  own.cos = f32(part.cos);
  own.sin = f32(side * part.sin);
  own.vx = f32(side * part.vx);
  own.vy = f32(part.vy);
  own.spin = f32(side * part.spin);
  own.touching = Boolean(part.touching);
  // Differences of what is not finite are not 0.
  const { x, y, cos, sin, vx, vy, spin } = own;
  return x - x + (y - y) + (cos - cos) + (sin - sin) + (vx - vx) + (vy - vy) + (spin - spin) === 0;
}

// A direction turned back by another, both as cosine and sine.
const turnedBackCos = (c, s, cos, sin) => f32(f32(c * cos) + f32(s * sin));
const turnedBackSin = (c, s, cos, sin) => f32(f32(c * sin) - f32(s * cos));

/** The angle of a direction seen from a reference, rad, in (-π, π]. */
function angleFrom(reference, cos, sin) {
  const { cos: c, sin: s } = reference;
  return Math.atan2(turnedBackSin(c, s, cos, sin), turnedBackCos(c, s, cos, sin));
}

/** Forward velocity of the point below the centre, m/s; 0 where nothing touches. */
function slip({ touching, vx, spin, cos, sin }, shape) {
  return touching ? vx + spin * halfHeight(shape, Math.abs(cos), Math.abs(sin)) : 0;
}

/** Half the height of the upright box around a shape, m. */
function halfHeight({ kind, width, height, length, radius }, cos, sin) {
  if (kind === "box") return 0.5 * (sin * width + cos * height);
  return kind === "circle" ? radius : 0.5 * cos * length + radius;
}

/** Phase of a clock, both s; rad, 0 to 2π. Whole turns are dropped first: they would cost precision. */
function clockPhase(time, period) {
  const turns = f32(time / period);
  return f32(f32(turns - Math.floor(turns)) * TURN);
}

// Limited as the original, which keeps it finite.
const exponential = (x) => Math.exp(clamp(x, -87, 87));

/** The output of a neuron for the weighted sum of its sources. */
function activated(activation, a) {
  switch (activation) {
    case "logistic": return 1 / (1 + exponential(-a));
    case "tanh": return Math.tanh(a);
    case "rationalTanh": return rationalTanh(clamp(a, -3, 3));
    case "relu": return a < 0 ? 0 : a;
    case "linear": return a;
    // Limited as the original; NaN for infinities.
    case "sine": return Math.sin(clamp(a, -4294967296, 4294967296)) + a * 0;
    case "gaussian": return exponential(-(a * a));
    case "steepLogistic": return 1 / (1 + exponential(-4.9 * a));
    default: return Math.tanh(2.45 * a);
  }
}

function rationalTanh(a) {
  return clamp((a * (27 + a * a)) / (27 + 9 * a * a), -1, 1);
}
