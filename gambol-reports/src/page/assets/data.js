// The run's data: reading it from the page, decoding replays, looking poses up by time, and writing numbers as text.
// A pose is a flat array of (x, y, angle) per part, in metres and radians, y up.

function readRun() {
  const element = document.getElementById("run");
  return element ? JSON.parse(element.textContent) : null;
}

// Turns a replay as stored (whole millimetres and milliradians, each frame as the difference to the one before) into
// poses. Angles come out continuous, whatever turn the recording wrapped at.
function decodeReplay(stored, ground = null) {
  if (!stored || !stored.frames || !stored.parts || !stored.data) return null;
  const parts = stored.parts;
  const size = parts * 3;
  const frames = Math.min(stored.frames, Math.floor(stored.data.length / size));
  if (frames < 1) return null;
  const poses = new Float32Array(frames * size);
  const sum = new Float64Array(size);
  const turn = 2000 * Math.PI;
  for (let frame = 0, at = 0; frame < frames; frame++) {
    for (let i = 0; i < size; i++, at++) {
      let step = stored.data[at];
      if (i % 3 === 2 && frame > 0) step -= turn * Math.round(step / turn);
      sum[i] += step;
      poses[at] = sum[i] / 1000;
    }
  }
  const timeStep = stored.time_step > 0 ? stored.time_step : 0.02;
  return { poses, parts, size, frames, timeStep, duration: (frames - 1) * timeStep, startX: poses[0], ground };
}

// The pose at a time, between frames a linear blend; `out` is filled and returned.
function poseAt(replay, time, out) {
  const position = Math.min(Math.max(time / replay.timeStep, 0), replay.frames - 1);
  const frame = Math.min(Math.floor(position), Math.max(replay.frames - 2, 0));
  const blend = position - frame;
  const from = frame * replay.size;
  const to = Math.min(frame + 1, replay.frames - 1) * replay.size;
  for (let i = 0; i < replay.size; i++) {
    const a = replay.poses[from + i];
    out[i] = a + (replay.poses[to + i] - a) * blend;
  }
  return out;
}

function frameAt(replay, time) {
  return Math.min(Math.max(Math.round(time / replay.timeStep), 0), replay.frames - 1);
}

// Position of the torso (the first part) at a frame.
function torsoX(replay, frame) { return replay.poses[frame * replay.size]; }
function torsoY(replay, frame) { return replay.poses[frame * replay.size + 1]; }

// Horizontal speed of the torso, averaged over a quarter of a second around the frame.
function speedAt(replay, frame) {
  const reach = Math.max(1, Math.round(0.125 / replay.timeStep));
  const from = Math.max(0, frame - reach);
  const to = Math.min(replay.frames - 1, frame + reach);
  return to > from ? (torsoX(replay, to) - torsoX(replay, from)) / ((to - from) * replay.timeStep) : 0;
}

// The highest point above the ground that a part's centre reaches, over all frames.
function highestCentre(replay) {
  // In water the camera follows.
  if (replay.ground?.water) return 0;
  let top = 0;
  for (let at = 1; at < replay.poses.length; at += 3) {
    if (replay.poses[at] <= top) continue;
    top = Math.max(top, replay.poses[at] - surfaceAt(replay.ground, replay.poses[at - 1]));
  }
  return top;
}

// Whether a part's bit is set in a mask written as hexadecimal digits.
function inMask(mask, part) {
  if (!mask) return false;
  const digit = mask.length - 1 - (part >> 2);
  return digit >= 0 && ((parseInt(mask[digit], 16) >> (part & 3)) & 1) === 1;
}

// Contact masks for every frame, or null when none were recorded.
function readContacts(stored, frames) {
  if (!Array.isArray(stored) || !stored.some(mask => mask !== null)) return null;
  return Array.from({ length: frames }, (_, i) => stored[Math.min(i, stored.length - 1)] || null);
}

// Activations as one flat array, frame after frame; stored nested or flat, in hundredths.
function readActivations(stored, neurons) {
  if (!Array.isArray(stored) || stored.length === 0 || neurons === 0) return null;
  const flat = Array.isArray(stored[0]) ? stored.flat() : stored;
  const frames = Math.floor(flat.length / neurons);
  if (frames < 1) return null;
  const values = new Float32Array(frames * neurons);
  for (let i = 0; i < values.length; i++) values[i] = flat[i] / 100;
  return { frames, values };
}

// By the number of decimals; to make one takes longer than to write a hundred numbers.
const NUMBER_FORMATS = [];

// A number with a fixed number of decimals and a true minus sign.
function fixed(value, decimals) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  NUMBER_FORMATS[decimals] ??= new Intl.NumberFormat("en-GB", { minimumFractionDigits: decimals, maximumFractionDigits: decimals });
  const text = NUMBER_FORMATS[decimals].format(Math.abs(value));
  return value < 0 && /[1-9]/.test(text) ? "−" + text : text;
}

// A number with as many decimals as its size deserves.
function tidy(value) {
  const size = Math.abs(value);
  return fixed(value, size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

function withUnit(value, unit) { return unit ? `${tidy(value)}\u00a0${unit}` : tidy(value); }

function count(value, one, many) { return `${fixed(value, 0)} ${value === 1 ? one : many}`; }

// Large counts in words: 30 000 000 becomes "30 million".
function large(value) {
  return value >= 1e9 ? `${tidy(value / 1e9)} billion` : value >= 1e6 ? `${tidy(value / 1e6)} million` : fixed(value, 0);
}

// An element with a text and a class.
function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}
