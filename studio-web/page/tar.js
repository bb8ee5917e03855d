// A folder as one file, and back: ustar, which every system unpacks.

const BLOCK = 512;

const padded = length => Math.ceil(length / BLOCK) * BLOCK;

// All files below a folder of a disk, with their paths from there.
function filesBelow(disk, folder, from = folder) {
  return disk.list(folder).flatMap(entry => {
    const path = `${folder}/${entry.name ?? entry}`;
    const bytes = disk.lookup(path)?.isFolder ? null : disk.read(path);
    return bytes ? [{ name: path.slice(from.length + 1), bytes }] : filesBelow(disk, path, from);
  });
}

// `top`: the folder that they are unpacked into.
function packed(top, files) {
  const heads = files.map(({ name, bytes }) => {
    const head = new Uint8Array(BLOCK);
    const encoder = new TextEncoder();
    const put = (at, text) => head.set(encoder.encode(text), at);
    const octal = (at, length, number) => put(at, number.toString(8).padStart(length - 1, "0"));
    const path = `${top}/${name}`;
    // A long path is divided at a folder.
    const split = encoder.encode(path).length <= 100 ? -1 : path.indexOf("/", Math.max(path.length - 100, 0));
    put(0, path.slice(split + 1));
    octal(100, 8, 0o644);
    octal(108, 8, 0);
    octal(116, 8, 0);
    octal(124, 12, bytes.length);
    octal(136, 12, 0);
    put(148, "        ");
    put(156, "0");
    put(257, "ustar\0" + "00");
    if (split > 0) put(345, path.slice(0, split));
    octal(148, 7, head.reduce((sum, byte) => sum + byte, 0));
    return head;
  });
  const whole = new Uint8Array(files.reduce((sum, { bytes }) => sum + BLOCK + padded(bytes.length), 2 * BLOCK));
  let at = 0;
  files.forEach(({ bytes }, index) => {
    whole.set(heads[index], at);
    whole.set(bytes, at + BLOCK);
    at += BLOCK + padded(bytes.length);
  });
  return whole;
}

// The files in it. What is neither a file nor a folder is left out.
function unpacked(whole) {
  const decoder = new TextDecoder();
  const files = [];
  for (let at = 0; at + BLOCK <= whole.length && whole[at] !== 0;) {
    const text = (from, length) => decoder.decode(whole.subarray(at + from, at + from + length)).split("\0")[0];
    const size = parseInt(text(124, 12).trim(), 8);
    const sum = parseInt(text(148, 8).trim(), 8);
    const found = whole.subarray(at, at + BLOCK).reduce((sum, byte, index) => sum + (index >= 148 && index < 156 ? 32 : byte), 0);
    if (!(size >= 0) || sum !== found || at + BLOCK + size > whole.length) throw new Error("it is no tar file, or a damaged one");
    const kind = text(156, 1);
    if (kind === "0" || kind === "") {
      const name = [text(345, 155), text(0, 100)].filter(Boolean).join("/");
      files.push({ name, bytes: whole.slice(at + BLOCK, at + BLOCK + size) });
    }
    at += BLOCK + padded(size);
  }
  return files;
}

// Puts a packed run into a folder of a disk, and gives the name that it has there: its own, or with a number behind it.
function addRun(disk, runs, whole) {
  const files = unpacked(whole).map(({ name, bytes }) => ({ parts: name.split("/").filter(part => part && part !== "."), bytes }));
  if (files.some(({ parts }) => parts.includes(".."))) throw new Error("it leads out of its folder");
  const config = files.find(({ parts }) => parts.at(-1) === "config.json" && parts.length <= 2);
  if (!config) throw new Error("there is no run in it: config.json is missing");
  // The files of a run are in a folder, or are all there is.
  const depth = config.parts.length - 1;
  const wanted = depth ? config.parts[0] : "run";
  let name = wanted;
  for (let number = 2; disk.lookup(`${runs}/${name}`); number += 1) name = `${wanted}-${number}`;
  for (const { parts, bytes } of files) {
    if (depth && parts[0] !== wanted) continue;
    disk.write(`${runs}/${name}/${parts.slice(depth).join("/")}`, bytes);
  }
  return name;
}
