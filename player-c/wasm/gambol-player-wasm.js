// Plays a trained character of Gambol with the player of the crate `player`, compiled to WebAssembly: the same bits as in
// training, on every machine. gambol-player.js, in player/ports, has the same classes without WebAssembly.
//
//     import { load } from "./gambol-player-wasm.js";
//     const { Character, Player } = await load(fetch("gambol_player.wasm"));
//     const character = Character.fromBytes(new Uint8Array(await (await fetch("biped.player")).arrayBuffer()));
//     const player = new Player(character); // after a body is built from character.parts and character.hinges
//     const speeds = player.tick(parts, outside, { speed: 1, jump: false }, 1 / 60);
//
// docs/player.md is the specification, and says how the module is built. MIT OR Apache-2.0.

/** Why bytes are not a character, or a frame could not be played. `status`: a number of the C library. */
export class GambolError extends Error {
  name = "GambolError";

  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

const SHAPES = ["box", "circle", "capsule"];
const OUTSIDE = ["ray", "gapDistance", "gapWidth"];
/** 32-bit numbers of each record of C. */
const [PART, HINGE, WORLD, OUTSIDE_RECORD, PART_STATE] = [9, 11, 11, 3, 8];

/** Compiles the module: its bytes, a Response, or a promise of either. Gives the classes `Character` and `Player`. */
export async function load(source) {
  const given = await source;
  const bytes = typeof Response !== "undefined" && given instanceof Response ? await given.arrayBuffer() : given;
  const { instance } = await WebAssembly.instantiate(bytes, {});
  return classes(instance.exports);
}

function classes(library) {
  // A memory that grows has another buffer.
  const views = () => ({ floats: new Float32Array(library.memory.buffer), words: new Uint32Array(library.memory.buffer) });

  const allocate = (count) => {
    const place = library.gambol_memory_new(Math.max(1, count));
    if (place === 0) throw new RangeError("too much memory is asked for");
    return place;
  };

  /** Lends memory for `count` numbers of 32 bits to a function. */
  const lend = (count, use) => {
    const place = allocate(count);
    try {
      return use(place);
    } finally {
      library.gambol_memory_free(place, Math.max(1, count));
    }
  };

  const textAt = (place) => {
    const memory = new Uint8Array(library.memory.buffer);
    return new TextDecoder().decode(memory.subarray(place, memory.indexOf(0, place)));
  };

  const check = (status) => {
    if (status !== 0) throw new GambolError(status, textAt(library.gambol_status_text(status)));
  };

  /** A record of C, as numbers: those that are whole first looked at as such. */
  const record = (size, read, make) =>
    lend(size, (place) => {
      check(read(place));
      const { floats, words } = views();
      const [at, end] = [place / 4, place / 4 + size];
      return make([...floats.subarray(at, end)], [...words.subarray(at, end)]);
    });

  const nameOf = (read) =>
    lend(64, (place) => {
      read(place, 256);
      return textAt(place);
    });

  const owned = new FinalizationRegistry(([free, place]) => free(place));

  /** A body and the controller that moves it; fields as in gambol-player.js, without those of the net. */
  class Character {
    #place;

    constructor(place, facing) {
      this.#place = place;
      owned.register(this, [library.gambol_character_free, place]);
      const list = (count, item) => Array.from({ length: count(place) }, (_, index) => item(index));
      this.name = nameOf((to, size) => library.gambol_character_name(place, to, size));
      this.facing = facing;
      this.world = record(WORLD, (to) => library.gambol_character_world(place, to), worldOf);
      this.parts = list(library.gambol_character_part_count, (index) => ({
        name: nameOf((to, size) => library.gambol_character_part_name(place, index, to, size)),
        ...record(PART, (to) => library.gambol_character_part(place, index, to), partOf),
      }));
      this.hinges = list(library.gambol_character_hinge_count, (index) =>
        record(HINGE, (to) => library.gambol_character_hinge(place, index, to), hingeOf),
      );
      this.outputs = list(library.gambol_character_output_count, (index) =>
        record(1, (to) => library.gambol_character_output(place, index, to), (_, [hinge]) => hinge),
      );
      const outside = list(library.gambol_character_outside_count, (index) =>
        record(OUTSIDE_RECORD, (to) => library.gambol_character_outside(place, index, to), outsideOf),
      );
      /** What the game has to measure every frame. */
      this.outside = () => outside;
      Object.freeze(this);
    }

    /** Reads the bytes of a `.player` file, a Uint8Array. Throws a GambolError if they are cut, changed, or out of range. */
    static fromBytes(bytes) {
      return lend(Math.ceil(bytes.length / 4), (place) => {
        new Uint8Array(library.memory.buffer, place, bytes.length).set(bytes);
        return lend(1, (to) => {
          check(library.gambol_character_load(place, bytes.length, to));
          return new Character(views().words[to / 4], "right");
        });
      });
    }

    /** The same character, facing the other way: its parts and hinges are those to build, and its player takes and gives what
     * belongs to that body. */
    mirrored() {
      return new Character(library.gambol_character_mirrored(this.#place), this.facing === "right" ? "left" : "right");
    }

    /** Whether its body looks the same from both sides, so that its player can turn round: `Player.face`. Throws a GambolError if
     * not. */
    symmetry() {
      const player = library.gambol_player_new(this.#place);
      const status = library.gambol_player_face(player, this.facing === "right" ? 1 : 0);
      library.gambol_player_free(player);
      check(status);
    }

    /** The parts as they start, at rest, as `Player.tick` takes them. */
    startPose() {
      return this.parts.map(({ x, y, angle }) => {
        return { x, y, cos: Math.cos(angle), sin: Math.sin(angle), vx: 0, vy: 0, spin: 0, touching: false };
      });
    }

    /** For a Player. */
    static newPlayer(character) {
      return library.gambol_player_new(character.#place);
    }
  }

  /** One body that is played; used as in gambol-player.js. */
  class Player {
    #place;
    #memory;
    #counts;
    #seconds = 0;
    #facing;
    // What is handed out: memory of the library moves as it grows.
    #own;

    constructor(character) {
      this.character = character;
      this.#facing = character.facing;
      this.#place = Character.newPlayer(character);
      const [parts, outside] = [character.parts.length, character.outside().length];
      const [inputs, outputs] = [library.gambol_player_inputs(this.#place, 0, 0), character.outputs.length];
      this.#counts = { parts, outside, inputs, outputs };
      const numbers = (count) => new Float32Array(count);
      this.#own = { inputs: numbers(inputs), outputs: numbers(outputs), speeds: numbers(outputs), torques: numbers(outputs) };
      const count = PART_STATE * parts + outside + inputs + 2 * outputs;
      this.#memory = allocate(count);
      owned.register(this, [library.gambol_player_free, this.#place]);
      owned.register(this, [(place) => library.gambol_memory_free(place, count), this.#memory]);
    }

    /** Begins anew, facing as it was built: call it when the body was put back into its start pose. */
    reset() {
      check(library.gambol_player_reset(this.#place));
      this.#facing = this.character.facing;
      this.#seconds = 0;
    }

    /** Turns round, from the next frame on: "left" or "right". A body that stands turns best; one that does not look the same from
     * both sides throws, and goes on as it was. */
    face(facing) {
      if (facing !== "left" && facing !== "right") throw new RangeError(`"${facing}": must be "left" or "right"`);
      check(library.gambol_player_face(this.#place, facing === "left" ? 1 : 0));
      this.#facing = facing;
    }

    /** Which way it faces: "left" or "right". */
    get facing() {
      return this.#facing;
    }

    /** What the game has to measure every frame, as `character.outside()`, the way it faces now. */
    outside() {
      const [turned, pi] = [this.#facing !== this.character.facing, Math.fround(Math.PI)];
      return this.character.outside().map((outside) => {
        return turned && outside.kind === "ray" ? { ...outside, angle: Math.fround(pi - outside.angle) } : outside;
      });
    }

    /** How high the ground is where the body stands, m; 0 until it is said. */
    setGround(height) {
      // What is not finite changes nothing, as in gambol-player.js.
      library.gambol_player_set_ground(this.#place, height);
    }

    /** Since the start, s. */
    get seconds() {
      return this.#seconds;
    }

    /** The inputs of the net in the last frame. */
    get inputs() {
      const { inputs } = this.#counts;
      library.gambol_player_inputs(this.#place, this.#at("inputs"), inputs);
      return this.#copied("inputs");
    }

    /** What the net put out in the last frame. */
    get outputs() {
      const { outputs } = this.#counts;
      library.gambol_player_outputs(this.#place, this.#at("outputs"), outputs);
      return this.#copied("outputs");
    }

    /** The speed that the motor of each output was last asked for, rad/s. */
    get speeds() {
      return this.#own.speeds;
    }

    /** A frame; see gambol-player.js. The next call writes over what is returned. */
    tick(parts, outside, command, seconds) {
      this.#put(parts, outside);
      const [states, measured, speeds] = [this.#at("parts"), this.#at("outside"), this.#at("speeds")];
      const status = library.gambol_player_tick(
        this.#place, states, parts.length, measured, outside.length, command.speed, command.jump ? 1 : 0, seconds, speeds,
        this.#counts.outputs,
      );
      this.#copied("speeds");
      check(status);
      this.#seconds += Math.fround(seconds);
      return this.#own.speeds;
    }

    /** The torque of the motor of each output, N·m; see gambol-player.js. The next call writes over it. */
    torques(parts) {
      this.#put(parts, []);
      const { outputs } = this.#counts;
      const to = this.#at("outputs");
      check(library.gambol_player_torques(this.#place, this.#at("parts"), parts.length, to, outputs));
      return this.#copied("outputs", "torques");
    }

    #put(parts, outside) {
      const { floats, words } = views();
      const room = this.#counts;
      let at = this.#at("parts") / 4;
      for (const { x, y, cos, sin, vx, vy, spin, touching } of parts.slice(0, room.parts)) {
        floats.set([x, y, cos, sin, vx, vy, spin], at);
        words[at + 7] = touching ? 1 : 0;
        at += PART_STATE;
      }
      floats.set(outside.slice(0, room.outside), this.#at("outside") / 4);
    }

    /** Where an array begins in the memory of the library. */
    #at(array) {
      const { parts, outside, inputs, outputs } = this.#counts;
      const before = { parts: 0, outside: PART_STATE * parts };
      before.inputs = before.outside + outside;
      before.outputs = before.inputs + inputs;
      before.speeds = before.outputs + outputs;
      return this.#memory + 4 * before[array];
    }

    #copied(array, to = array) {
      const own = this.#own[to];
      own.set(new Float32Array(library.memory.buffer, this.#at(array), own.length));
      return own;
    }
  }

  return { Character, Player };
}

function partOf([, first, second, x, y, angle, density, friction], [shape, ...words]) {
  const kind = SHAPES[shape];
  const sizes = { box: { width: first, height: second }, circle: { radius: first } }[kind];
  return {
    shape: { kind, ...(sizes ?? { length: first, radius: second }) },
    x, y, angle, density, friction,
    foot: words[PART - 2] === 1,
  };
}

function hingeOf(numbers, [parent, child, ...words]) {
  const [, , px, py, cx, cy, low, high, , topSpeed, topTorque] = numbers;
  const motor = words[6] === 1 ? { topSpeed, topTorque } : null;
  return { parent, child, parentAnchor: [px, py], childAnchor: [cx, cy], limits: [low, high], motor };
}

function worldOf(numbers, words) {
  const [timeStep, gravity, groundFriction, motorGain, bodyLength, restHeight, , , density, drag, slip] = numbers;
  const water = words[7] === 1 ? { density, drag, slip } : null;
  const selfCollision = words[6] === 1;
  return { timeStep, gravity, groundFriction, motorGain, bodyLength, restHeight, water, selfCollision };
}

function outsideOf([, angle, length], [kind]) {
  return kind === 0 ? { kind: OUTSIDE[0], angle, length } : { kind: OUTSIDE[kind], length };
}
