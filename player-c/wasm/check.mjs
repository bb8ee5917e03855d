// Replays a golden trace with the WebAssembly module, to the bit:
//
//     node check.mjs gambol_player.wasm all-senses.player all-senses.trace.csv
//
// In a browser check.html does the same.

import { load } from "./gambol-player-wasm.js";

const PART_FIELDS = ["x", "y", "cos", "sin", "vx", "vy", "spin", "touching"];

/** Returns how many rows there were; throws where something is wrong. */
export async function check(module, file, trace) {
  const { Character, Player } = await load(module);
  const character = Character.fromBytes(file);
  const player = new Player(character);
  let rows = 0;
  for (const line of trace.trim().split("\n").slice(1)) {
    const numbers = line.split(",").map(Number);
    const parts = character.parts.map((_, part) =>
      Object.fromEntries(PART_FIELDS.map((field, index) => [field, numbers[4 + 8 * part + index]])),
    );
    const measured = 4 + 8 * parts.length;
    const expected = measured + character.outside().length;
    const outside = numbers.slice(measured, expected);
    player.tick(parts, outside, { speed: numbers[2], jump: numbers[3] }, character.world.timeStep);
    const found = [...player.inputs, ...player.outputs, ...player.speeds];
    if (found.length !== numbers.length - expected) throw new Error("the trace is of another character");
    found.forEach((number, index) => {
      const wanted = Math.fround(numbers[expected + index]);
      if (number !== wanted) throw new Error(`row ${rows}, number ${index}: ${number}, not ${wanted}`);
    });
    rows += 1;
  }
  refuses(Character, Player, character, file);
  return rows;
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
  console.log(`${await check(module, new Uint8Array(file), trace.toString())} rows to the bit`);
}
