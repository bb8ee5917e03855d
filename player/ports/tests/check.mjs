// Replays a golden trace with gambol-player.js:
//
//     node check.mjs all-senses.player all-senses.trace.csv
//
// Prints the greatest difference, and fails where something is wrong. A last column `faces_left` of the trace says when the body
// turns round. Without a trace, prints of each file whether its body looks the same from both sides.

import { readFileSync } from "node:fs";
import { Asymmetry, Character, FileError, Player, TickError } from "../gambol-player.js";

const MOST = 1e-5;
const PART_FIELDS = ["x", "y", "cos", "sin", "vx", "vy", "spin", "touching"];
const paths = process.argv.slice(2);
const [filePath, tracePath] = paths;
const bytes = new Uint8Array(readFileSync(filePath));
const hasTrace = tracePath?.endsWith(".csv") ?? false;
const [header, ...lines] = hasTrace ? readFileSync(tracePath, "utf8").trim().split("\n") : [""];
const columns = header.split(",");
const turns = columns[columns.length - 1] === "faces_left";
if (turns) columns.pop();

function assert(holds, what) {
  if (holds) return;
  console.error(`wrong: ${what}`);
  process.exit(1);
}

/** What a row tells a player, and what it must give: seconds, inputs, outputs, speeds. */
function rowOf(line, character) {
  const numbers = line.split(",").map(Number);
  const facing = turns && numbers.pop() === 1 ? "left" : "right";
  const [partCount, outsideCount] = [character.parts.length, character.outside().length];
  const parts = character.parts.map((_, part) => {
    return Object.fromEntries(PART_FIELDS.map((field, index) => [field, numbers[4 + 8 * part + index]]));
  });
  const measured = 4 + 8 * partCount;
  const [outside, rest] = [numbers.slice(measured, measured + outsideCount), numbers.slice(measured + outsideCount)];
  const expected = [numbers[1], ...rest];
  return { facing, parts, outside, command: { speed: numbers[2], jump: numbers[3] }, expected };
}

function replay(character) {
  const player = new Player(character);
  let greatest = { difference: 0, where: "anywhere" };
  lines.forEach((line, step) => {
    const { facing, parts, outside, command, expected } = rowOf(line, character);
    const seconds = Math.fround(player.seconds);
    player.face(facing);
    player.tick(parts, outside, command, character.world.timeStep);
    const found = [seconds, ...player.inputs, ...player.outputs, ...player.speeds];
    assert(found.length === expected.length, "the trace has other columns than the player has numbers");
    found.forEach((number, index) => {
      const difference = Math.abs(number - expected[index]) / Math.max(1, Math.abs(expected[index]));
      assert(Number.isFinite(difference), `${number} in step ${step}`);
      if (difference <= greatest.difference) return;
      const column = index === 0 ? "seconds" : columns[columns.length - found.length + index];
      greatest = { difference, where: `${column}, step ${step}` };
    });
  });
  return greatest;
}

/** Asserts that bytes are refused, and why. */
function assertRefused(damaged, why) {
  try {
    Character.fromBytes(damaged);
  } catch (error) {
    assert(error instanceof FileError && error.message.includes(why), `refused with "${error.message}", not "${why}"`);
    return;
  }
  assert(false, "a damaged file is played");
}

function checkDamage() {
  for (let place = 0; place < bytes.length; place += 1) {
    const flipped = bytes.slice();
    flipped[place] ^= 4;
    assertRefused(flipped, place < 8 ? "not a character" : place < 12 ? "version" : place < 16 ? "cut or" : "digest");
  }
  assertRefused(bytes.subarray(0, bytes.length - 1), "the file was cut or added to");
  assertRefused(bytes.subarray(0, 20), "not a character of Gambol");
  const newer = bytes.slice();
  newer[8] = 3;
  assertRefused(newer, "version 3 of the format; this player reads version 2");
}

/** The mirror image does the same the other way. */
function checkMirrored(character) {
  const [right, left] = [new Player(character), new Player(character.mirrored())];
  lines.forEach((line) => {
    const { facing, parts, outside, command } = rowOf(line, character);
    right.face(facing);
    left.face(facing === "right" ? "left" : "right");
    const mirrored = parts.map((part) => ({ ...part, x: -part.x, sin: -part.sin, vx: -part.vx, spin: -part.spin }));
    right.tick(parts, outside, command, 0.02);
    left.tick(mirrored, outside, command, 0.02);
    assert(right.speeds.every((speed, index) => speed === -left.speeds[index]), "the mirror image moves otherwise");
    const [torques, others] = [right.torques(parts), left.torques(mirrored)];
    assert(torques.every((torque, index) => torque === -others[index]), "the mirror image pushes otherwise");
  });
}

/** A body turns round, and back; rays turn with it. One that does not look the same from both sides goes on as it was. */
function checkFacing(character) {
  const rows = lines.slice(0, 3).map((line) => rowOf(line, character));
  const tick = (player, { parts, outside, command }) => [...player.tick(parts, outside, command, 0.02)];
  const assertSame = (one, other, what) => rows.forEach((row) => assert(`${tick(one, row)}` === `${tick(other, row)}`, what));
  const seen = (looker) => JSON.stringify(looker.outside());
  const player = new Player(character);
  assert(player.facing === "right" && seen(player) === seen(character), "it does not begin as it was built");
  player.face("left");
  assert(player.facing === "left" && seen(player) === seen(character.mirrored()), "it does not look to the left");
  const hasRays = character.outside().some(({ kind }) => kind === "ray");
  assert((seen(player) !== seen(character)) === hasRays, "rays do not turn");
  player.face("right");
  assertSame(player, new Player(character), "it does not turn back");
  player.face("left");
  player.reset();
  assert(player.facing === "right", "it begins anew as it was turned");
  assertSame(player, new Player(character), "it begins anew as it was turned");
  const built = new Player(character.mirrored());
  built.face("right");
  built.reset();
  assert(built.facing === "left", "the mirror image begins anew as it was turned");
  try {
    player.face("Left");
    assert(false, "it faces what is no way");
  } catch (error) {
    assert(error instanceof RangeError, `${error}`);
  }
  checkLopsided(character, assertSame);
}

function checkLopsided(character, assertSame) {
  const last = character.parts.length - 1;
  const parts = character.parts.map((part, index) => ({ ...part, x: part.x + (index === last ? 0.1 : 0) }));
  const [player, other] = [new Player(new Character({ ...character, parts })), new Player(character)];
  assertSame(player, other, "a part in another place changes what the net does");
  let error = null;
  try {
    player.face("left");
  } catch (thrown) {
    error = thrown;
  }
  const why = "has no mirror image on the other side";
  assert(error instanceof Asymmetry && error.message.includes(why), `"${error?.message}", not "${why}"`);
  assert(player.facing === "right", "a body that is not symmetric turns round");
  assertSame(player, other, "a body that cannot turn does not go on as it was");
  player.face("right");
}

/** What a game tells wrongly leaves the motors still. */
function checkErrors(character) {
  const player = new Player(character);
  const { parts, outside, command } = rowOf(lines[0], character);
  const wrong = (change) => parts.map((part, index) => (index === 1 ? { ...part, ...change } : part));
  const cases = [
    [parts.slice(1), outside, command, 0.02, "parts, and the character has"],
    [parts, [...outside, 1], command, 0.02, "measurements of what is outside"],
    [parts, outside, command, -0.1, "the time of a frame"],
    [parts, outside, command, NaN, "the time of a frame"],
    [wrong({ vx: NaN }), outside, command, 0.02, "not finite"],
    [wrong({ sin: Infinity }), outside, command, 0.02, "not finite"],
    [parts, outside, { speed: NaN, jump: 0 }, 0.02, "not finite"],
  ];
  const first = [...player.tick(parts, outside, command, 0.02)];
  for (const [parts_, outside_, command_, seconds, why] of cases) {
    assert(player.tick(parts, outside, command, 0.02).some((speed) => speed !== 0), "the motors hold still");
    let message = "";
    try {
      player.tick(parts_, outside_, command_, seconds);
    } catch (error) {
      message = error instanceof TickError ? error.message : `${error}`;
    }
    assert(message.includes(why), `"${message}", not "${why}"`);
    assert(player.speeds.every((speed) => speed === 0), "the motors do not hold still");
    const forgets = why !== "not finite" || player.outputs.every((output) => output === 0);
    assert(forgets, "the net does not begin anew");
  }
  player.reset();
  assert(player.tick(parts, outside, command, 0.02).every((speed, index) => speed === first[index]), "no new start");
}

/** Whether a body looks the same from both sides, or why not. */
function symmetryOf(path) {
  try {
    Character.fromBytes(new Uint8Array(readFileSync(path))).symmetry();
  } catch (error) {
    assert(error instanceof Asymmetry, `${error}`);
    return error.message;
  }
  return "symmetric";
}

if (!hasTrace) {
  paths.forEach((path) => console.log(symmetryOf(path)));
  process.exit(0);
}
const character = Character.fromBytes(bytes);
const { difference, where } = replay(character);
console.log(`greatest difference ${difference.toExponential(2)} (${where})`);
assert(difference <= MOST, `a difference above ${MOST}`);
checkDamage();
checkMirrored(character);
checkFacing(character);
checkErrors(character);
console.log("checked");
