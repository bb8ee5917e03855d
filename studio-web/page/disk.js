// A disk in memory: what a WebAssembly module sees as its files, and what the page reads and writes beside it. It
// remembers which paths are no longer what they were, so that a store can keep it.

// What a disk refuses, with the name that C gives the error.
class DiskError extends Error {
  constructor(code, path) {
    super(`${code}: ${path}`);
    this.code = code;
  }
}

// What a path can lead to. One that was removed while it was open is in no folder, and so has no path.
class DiskNode {
  constructor(disk) {
    this.disk = disk;
    this.number = ++disk.nodes;
    this.changed = disk.now();
    this.parent = null;
    this.name = "";
  }

  get path() {
    const names = [];
    let node = this;
    for (; node.parent; node = node.parent) names.unshift(node.name);
    return node === this.disk.root ? `/${names.join("/")}` : null;
  }
}

class DiskFile extends DiskNode {
  constructor(disk) {
    super(disk);
    this.length = 0;
    // As long as the file or longer, so that to append does not copy all of it each time.
    this.bytes = new Uint8Array(0);
  }

  get isFolder() { return false; }

  // The bytes from there on, no more than so many. They are the file's own: to keep them is to copy them.
  readAt(at, length) {
    const start = Math.min(at, this.length);
    return this.bytes.subarray(start, Math.min(start + length, this.length));
  }

  writeAt(at, bytes) {
    if (bytes.length === 0) return;
    this.stretch(at + bytes.length);
    this.bytes.set(bytes, at);
    this.disk.touch(this);
  }

  resize(length) {
    this.stretch(length);
    this.length = length;
    if (length === 0) this.bytes = new Uint8Array(0);
    this.disk.touch(this);
  }

  // Makes it at least so long; what is new is zero, also where a longer file was cut before.
  stretch(length) {
    if (length <= this.length) return;
    if (length > this.bytes.length) {
      const bytes = this.allocate(Math.max(length, Math.min(this.bytes.length * 2, this.bytes.length + Disk.LARGEST_SPARE)));
      bytes.set(this.readAt(0, this.length));
      this.bytes = bytes;
    } else {
      this.bytes.fill(0, this.length, length);
    }
    this.length = length;
  }

  allocate(length) {
    try {
      return new Uint8Array(length);
    } catch {
      throw new DiskError("ENOSPC", this.path);
    }
  }

  copy() { return this.bytes.slice(0, this.length); }
}

class DiskFolder extends DiskNode {
  constructor(disk) {
    super(disk);
    this.entries = new Map();
    this.sorted = null;
  }

  get isFolder() { return true; }

  get names() { return this.sorted ??= [...this.entries.keys()].sort(); }

  put(name, node) {
    this.entries.set(name, node);
    node.parent = this;
    node.name = name;
    this.alter();
  }

  take(node) {
    this.entries.delete(node.name);
    node.parent = null;
    this.alter();
  }

  alter() {
    this.sorted = null;
    this.changed = this.disk.now();
  }
}

class Disk {
  // The smallest step of its clock, in milliseconds: a power of two, so that a sum of a time and steps is exact.
  static STEP = 1 / 1024;

  // A file has no more than so many bytes to spare.
  static LARGEST_SPARE = 1 << 26;

  constructor() {
    this.nodes = 0;
    this.clock = 0;
    this.touched = new Set();
    this.root = new DiskFolder(this);
  }

  // The time in milliseconds, but later at each call, so that no two writes have the same.
  now() {
    return this.clock = Math.max(Date.now(), this.clock + Disk.STEP);
  }

  // The names on the way from the root. `..` of the root is the root.
  static parts(path) {
    const parts = [];
    for (const part of path.split("/")) {
      if (part === "..") parts.pop(); else if (part !== "" && part !== ".") parts.push(part);
    }
    return parts;
  }

  // The file or folder there, or null.
  lookup(path) {
    let node = this.root;
    for (const part of Disk.parts(path)) {
      node = node.entries?.get(part);
      if (!node) return null;
    }
    return node;
  }

  // The folder that a path is in, the name in it, and what has that name, if anything has. The root is in no folder.
  place(path) {
    const parts = Disk.parts(path);
    if (parts.length === 0) return { folder: null, name: "", node: this.root };
    const name = parts.pop();
    let folder = this.root;
    for (const part of parts) {
      folder = folder.entries.get(part);
      if (!folder) throw new DiskError("ENOENT", path);
      if (!folder.isFolder) throw new DiskError("ENOTDIR", path);
    }
    return { folder, name, node: folder.entries.get(name) ?? null };
  }

  // What is at a path, which has to be there.
  found(path) {
    const { node } = this.place(path);
    if (!node) throw new DiskError("ENOENT", path);
    return node;
  }

  // A copy of the bytes of a file, or null where there is none.
  read(path) {
    const node = this.lookup(path);
    return node && !node.isFolder ? node.copy() : null;
  }

  // A file of these bytes, in folders that are made if need be.
  write(path, bytes) {
    const parts = Disk.parts(path);
    const name = parts.pop();
    if (name === undefined || this.lookup(path)?.isFolder) throw new DiskError("EISDIR", path);
    const file = this.makeFolder(parts.join("/")).entries.get(name) ?? this.createFile(path);
    file.bytes = bytes.slice();
    file.length = bytes.length;
    this.touch(file);
  }

  // An empty file, where there is nothing, in a folder that is there.
  createFile(path) {
    return this.create(path, new DiskFile(this));
  }

  // A folder where there is nothing, in one that is there.
  createFolder(path) {
    return this.create(path, new DiskFolder(this));
  }

  create(path, made) {
    const { folder, name, node } = this.place(path);
    if (node) throw new DiskError("EEXIST", path);
    this.attach(folder, name, made);
    return made;
  }

  // The folder at a path, made if need be with those that it is in.
  makeFolder(path) {
    let folder = this.root;
    for (const part of Disk.parts(path)) {
      let next = folder.entries.get(part);
      if (!next) this.attach(folder, part, next = new DiskFolder(this));
      if (!next.isFolder) throw new DiskError("ENOTDIR", path);
      folder = next;
    }
    return folder;
  }

  // The sorted names in a folder, or null where there is none.
  list(path) {
    const node = this.lookup(path);
    return node?.isFolder ? [...node.names] : null;
  }

  // Removes what is there, if anything is: of a folder, all in it as well.
  remove(path) {
    const node = this.lookup(path);
    if (node) this.detach(node);
  }

  removeFile(path) {
    const node = this.found(path);
    if (node.isFolder) throw new DiskError("EISDIR", path);
    this.detach(node);
  }

  removeFolder(path) {
    const node = this.found(path);
    if (!node.isFolder) throw new DiskError("ENOTDIR", path);
    if (node.entries.size > 0) throw new DiskError("ENOTEMPTY", path);
    this.detach(node);
  }

  // Takes the place of a file, or of an empty folder if it is a folder.
  rename(from, to) {
    const node = this.found(from);
    const { folder, name, node: old } = this.place(to);
    if (node === old) return;
    if (node === this.root || old === this.root) throw new DiskError("EBUSY", from);
    for (let above = folder; above; above = above.parent) {
      if (above === node) throw new DiskError("EINVAL", to);
    }
    if (old) {
      if (old.isFolder && !node.isFolder) throw new DiskError("EISDIR", to);
      if (!old.isFolder && node.isFolder) throw new DiskError("ENOTDIR", to);
      if (old.isFolder && old.entries.size > 0) throw new DiskError("ENOTEMPTY", to);
      this.detach(old);
    }
    this.detach(node);
    this.attach(folder, name, node);
  }

  attach(folder, name, node) {
    folder.put(name, node);
    this.mark(node);
  }

  detach(node) {
    if (node === this.root) throw new DiskError("EBUSY", "/");
    this.mark(node);
    node.parent.take(node);
  }

  // Takes down that a file is not what it was.
  touch(file) {
    file.changed = this.now();
    this.mark(file);
  }

  // Takes down that the paths of a node and of all in it do not lead to what they led to.
  mark(node) {
    const path = node.path;
    if (path === null) return;
    this.touched.add(path);
    if (node.isFolder) for (const inner of node.entries.values()) this.mark(inner);
  }

  // What has changed since the last time: the files written, the paths where nothing is any more, and the folders made.
  takeChanges() {
    const changes = { written: [], removed: [], folders: [] };
    for (const path of this.touched) {
      const node = this.lookup(path);
      if (!node) changes.removed.push(path);
      else if (node.isFolder) changes.folders.push(path);
      else changes.written.push([path, node.copy(), node.changed]);
    }
    this.touched.clear();
    return changes;
  }

  // Changes that could not be kept are taken again next time, as these paths are by then.
  putBack({ written, removed, folders }) {
    for (const path of [...written.map(([path]) => path), ...removed, ...folders]) this.touched.add(path);
  }

  // A file as it was kept, or a folder where there are no bytes. That is no change.
  restore(path, bytes, changed) {
    const touched = this.touched;
    this.touched = new Set();
    try {
      if (!bytes) {
        this.makeFolder(path);
        return;
      }
      this.write(path, bytes);
      this.lookup(path).changed = changed;
      this.clock = Math.max(this.clock, changed);
    } finally {
      this.touched = touched;
    }
  }
}
