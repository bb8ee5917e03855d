// Replays a golden trace with the WebAssembly module, to the bit, and its mirror image with a body that has turned round:
//
//     node check.mjs gambol_player.wasm all-senses.player all-senses.trace.csv
//
// A test makes a page of it that does the same in a browser.

import { load } from "./gambol-player-wasm.js";

const PART_FIELDS = ["x", "y", "cos", "sin", "vx", "vy", "spin", "touching"];

/** Says how many rows there were, and whether the body plays them both ways; throws where something is wrong. */
export async function check(module, file, trace) {
  const { Character, Player } = await load(module);
  const character = Character.fromBytes(file);
  const player = new Player(character);
  const turned = turnedLeft(character, Player);
  let rows = 0;
  for (const line of trace.trim().split("\n").slice(1)) {
    const numbers = line.split(",").map(Number);
    const parts = character.parts.map((_, part) =>
      Object.fromEntries(PART_FIELDS.map((field, index) => [field, numbers[4 + 8 * part + index]])),
    );
    const measured = 4 + 8 * parts.length;
    const expected = measured + character.outside().length;
    const outside = numbers.slice(measured, expected);
    const frame = [outside, { speed: numbers[2], jump: numbers[3] }, character.world.timeStep];
    // One that turns back at once, or cannot turn, goes on as it was.
    if (turned !== null) player.face("left");
    player.face("right");
    player.tick(parts, ...frame);
    const found = [...player.inputs, ...player.outputs, ...player.speeds];
    if (found.length !== numbers.length - expected) throw new Error("the trace is of another character");
    found.forEach((number, index) => {
      const wanted = Math.fround(numbers[expected + index]);
      if (number !== wanted) throw new Error(`row ${rows}, number ${index}: ${number}, not ${wanted}`);
    });
    if (turned !== null) checkTurned(character, turned, parts, frame, player);
    rows += 1;
  }
  refuses(Character, Player, character, file);
  return `${rows} rows to the bit, ${turned === null ? "one way" : "both ways"}`;
}

/** A player that has turned to the left, or null if the body does not look the same from both sides. */
function turnedLeft(character, Player) {
  const player = new Player(character);
  const asymmetric = (call) => {
    try {
      call();
    } catch (error) {
      if (error.status === 12 && error.message.includes("does not look the same from both sides")) return true;
      throw error;
    }
    return false;
  };
  const cannot = asymmetric(() => player.face("left"));
  if (asymmetric(() => character.symmetry()) !== cannot) throw new Error("symmetry and face do not agree");
  if (player.facing !== (cannot ? "right" : "left")) throw new Error(`it faces ${player.facing}`);
  if (cannot) return null;
  if (JSON.stringify(player.outside()) !== JSON.stringify(character.mirrored().outside())) {
    throw new Error("it does not look the other way");
  }
  player.reset();
  if (player.facing !== "right") throw new Error("it begins anew as it was turned");
  player.face("left");
  return player;
}

/** The mirror images of four legs, near and far, in front and behind; a leg in the middle is its own. */
const FOUR_LEGS = [0, 3, 4, 1, 2, 7, 8, 5, 6];

/** Told the mirror image of what another is told that faces right, its net knows the same, and the speeds are those of the twins, the
 * other way. */
function checkTurned(character, turned, parts, frame, player) {
  const twin = (part) => (parts.length === FOUR_LEGS.length ? FOUR_LEGS[part] : part);
  const mirrored = parts.map((_, index) => {
    const part = parts[twin(index)];
    return { ...part, x: -part.x, sin: -part.sin, vx: -part.vx, spin: -part.spin };
  });
  turned.tick(mirrored, ...frame);
  if (turned.inputs.some((input, index) => input !== player.inputs[index])) throw new Error("its net senses something else");
  const children = character.outputs.map((hinge) => character.hinges[hinge].child);
  player.speeds.forEach((speed, output) => {
    const found = turned.speeds[children.indexOf(twin(children[output]))];
    if (found !== -speed) throw new Error(`one that has turned moves otherwise: output ${output}, ${found}, not ${-speed}`);
  });
}

/** Damage and wrong calls are refused, and the mirror image faces the other way. */
function refuses(Character, Player, character, file) {
  const throws = (what, call) => {
    try {
      call();
    } catch (error) {
      if (error.message.includes(what)) return;
      throw new Error(`"${error.message}", not "${what}"`);
    }
    throw new Error(`nothing says "${what}"`);
  };
  const flipped = file.slice();
  flipped[file.length - 1] ^= 1;
  throws("digest", () => Character.fromBytes(flipped));
  throws("not as long as it says", () => Character.fromBytes(file.subarray(0, file.length - 1)));
  throws("not a character", () => Character.fromBytes(new Uint8Array(10)));
  const player = new Player(character.mirrored());
  const outside = character.outside().map(() => 1);
  const parts = player.character.startPose();
  if (player.character.facing !== "left" || player.character.parts[1].x !== -character.parts[1].x) {
    throw new Error("the mirror image does not face left");
  }
  player.tick(parts, outside, { speed: 1, jump: true }, 0.02);
  throws("not as long", () => player.tick(parts.slice(1), outside, { speed: 1, jump: false }, 0.02));
  throws("not finite", () => player.tick(parts, outside, { speed: NaN, jump: false }, 0.02));
  if (player.speeds.some((speed) => speed !== 0)) throw new Error("the motors do not hold still");
}

if (typeof process !== "undefined" && process.argv?.length === 5) {
  const { readFileSync } = await import("node:fs");
  const [module, file, trace] = process.argv.slice(2).map((path) => readFileSync(path));
  console.log(await check(module, new Uint8Array(file), trace.toString()));
}
