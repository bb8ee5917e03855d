// WASI, preview 1, on a disk in memory: what a module built for wasm32-wasip1 asks of the world. There is no network, no
// second thread and no link; the whole disk is the one folder that is open from the start.

// How a module ends that calls for its end.
class WasiExit extends Error {
  constructor(code) {
    super(`the module exited with ${code}`);
    this.code = code;
  }
}

// What of bytes are whole lines goes to a function; the rest waits for its end.
class LineWriter {
  constructor(log) {
    this.log = log;
    this.decoder = new TextDecoder("utf-8");
    this.rest = "";
  }

  write(bytes) {
    const lines = (this.rest + this.decoder.decode(bytes.slice(), { stream: true })).split("\n");
    this.rest = lines.pop();
    for (const line of lines) this.log(line);
  }

  end() {
    if (this.rest) this.log(this.rest);
    this.rest = "";
  }
}

// `memory` gives the memory of the module, which is there only after its imports are. `log` gets what the module prints.
function wasiImports(disk, memory, { log = line => console.log(line) } = {}) {
  const errors = {
    EBADF: 8, EBUSY: 10, EEXIST: 20, EFAULT: 21, EFBIG: 22, EINVAL: 28, EISDIR: 31, ENOENT: 44, ENOSPC: 51, ENOSYS: 52, ENOTDIR: 54,
    ENOTEMPTY: 55, ENOTSUP: 58, ESPIPE: 70,
  };
  const CHARACTERS = 2;
  const FOLDER = 3;
  const FILE = 4;
  const FIRST_FREE = 4;
  const APPEND = 1;
  const ALL_RIGHTS = (1n << 30n) - 1n;
  const RIGHT_TO_READ = 1n << 1n;
  const RIGHT_TO_WRITE = 1n << 6n;
  const LARGEST_FILE = 2 ** 32;

  const decoder = new TextDecoder("utf-8", { ignoreBOM: true });
  const encoder = new TextEncoder();

  const open = (node, rights, flags = 0) => ({ node, rights, flags, at: 0, listing: null });
  const handles = new Map([
    [0, { input: true, rights: RIGHT_TO_READ, flags: 0 }],
    [1, { lines: new LineWriter(log), rights: RIGHT_TO_WRITE, flags: APPEND }],
    [2, { lines: new LineWriter(log), rights: RIGHT_TO_WRITE, flags: APPEND }],
    [3, open(disk.root, ALL_RIGHTS)],
  ]);

  const refuse = (code, path = "") => { throw new DiskError(code, path); };

  // Memory that has grown is another buffer, so no view of it is kept. Addresses come in as signed numbers.
  const bytesAt = (at, length) => new Uint8Array(memory().buffer, at >>> 0, length >>> 0);
  const view = () => new DataView(memory().buffer);
  const put32 = (at, value) => view().setUint32(at >>> 0, value, true);
  const put64 = (at, value) => view().setBigUint64(at >>> 0, BigInt(value), true);
  // To take a piece of a vector of pieces, one after the other, until one says that there is no more.
  const eachPiece = (at, count, take) => {
    let total = 0;
    for (let i = 0; i < count; i++) {
      const [start, length] = [0, 4].map(place => view().getUint32((at >>> 0) + i * 8 + place, true));
      const done = take(bytesAt(start, length));
      total += done;
      if (done < length) break;
    }
    return total;
  };

  const handle = fd => handles.get(fd) ?? refuse("EBADF");
  const folder = fd => {
    const { node } = handle(fd);
    return node?.isFolder ? node : refuse("ENOTDIR");
  };
  const file = (fd, right = 0n) => {
    const of = handle(fd);
    if (!of.node) refuse("ESPIPE");
    if (of.node.isFolder) refuse("EISDIR");
    if (right && !(of.rights & right)) refuse("EBADF");
    return of;
  };

  // The path that a module means by one in a folder that it has open.
  const pathAt = (fd, at, length) => {
    const base = folder(fd).path ?? refuse("ENOENT");
    return `${base}/${decoder.decode(bytesAt(at, length).slice())}`;
  };
  const found = path => {
    const node = disk.found(path);
    return path.endsWith("/") && !node.isFolder ? refuse("ENOTDIR", path) : node;
  };

  const sizeFrom = number => {
    if (number < 0n) refuse("EINVAL");
    return number > LARGEST_FILE ? refuse("EFBIG") : Number(number);
  };

  const readFrom = (of, at, count, position) => eachPiece(at, count, piece => {
    const bytes = of.node.readAt(position, piece.length);
    piece.set(bytes);
    position += bytes.length;
    return bytes.length;
  });
  const writeTo = (of, at, count, position) => eachPiece(at, count, piece => {
    sizeFrom(BigInt(position + piece.length));
    of.node.writeAt(position, piece);
    position += piece.length;
    return piece.length;
  });

  // Nanoseconds of a time of the disk, exact: its clock steps by a part of a millisecond that is a power of two.
  const STEPS = BigInt(1 / Disk.STEP);
  const nanoseconds = milliseconds => BigInt(Math.floor(milliseconds / Disk.STEP)) * 1000000n / STEPS;
  const milliseconds = nanoseconds => Number((nanoseconds * STEPS + 500000n) / 1000000n) * Disk.STEP;
  const clock = id => {
    // The clock of the disk can be ahead by a bit, and nothing was written later than now.
    if (id === 0) return nanoseconds(Math.max(Date.now(), disk.clock));
    return id === 1 ? BigInt(Math.round(performance.now() * 1e6)) : refuse("EINVAL");
  };

  const typeOf = of => !of.node ? CHARACTERS : of.node.isFolder ? FOLDER : FILE;
  const putStat = (at, of) => {
    const { node } = of;
    const time = node ? nanoseconds(node.changed) : 0n;
    bytesAt(at, 64).fill(0);
    put64(at, 1);
    put64(at + 8, node ? node.number : 0);
    view().setUint8((at >>> 0) + 16, typeOf(of));
    put64(at + 24, node && node.path === null ? 0 : 1);
    put64(at + 32, node?.length ?? 0);
    for (const place of [40, 48, 56]) put64(at + place, time);
  };
  // The disk keeps one time, that of the change.
  const setTimes = (node, changed, flags) => {
    const [given, now] = [flags & 4, flags & 8];
    if (given && now) refuse("EINVAL");
    if (given || now) disk.touch(node);
    if (given) node.changed = milliseconds(changed);
  };

  const functions = {
    args_get: () => 0,
    args_sizes_get: (count, size) => { put32(count, 0); put32(size, 0); },
    environ_get: () => 0,
    environ_sizes_get: (count, size) => { put32(count, 0); put32(size, 0); },
    clock_res_get: (id, at) => { clock(id); put64(at, id === 0 ? 1000000 : 5000); },
    clock_time_get: (id, precision, at) => put64(at, clock(id)),
    random_get: (at, length) => {
      // No more than so many bytes come at a time.
      for (let done = 0; done < length; done += 65536) {
        const bytes = crypto.getRandomValues(new Uint8Array(Math.min(length - done, 65536)));
        bytesAt(at + done, bytes.length).set(bytes);
      }
    },
    sched_yield: () => 0,
    poll_oneoff: () => refuse("ENOTSUP"),
    proc_exit: code => {
      for (const { lines } of handles.values()) lines?.end();
      throw new WasiExit(code);
    },
    proc_raise: () => refuse("ENOTSUP"),

    fd_prestat_get: (fd, at) => {
      if (fd !== 3 || handle(fd).node !== disk.root) refuse("EBADF");
      put32(at, 0);
      put32(at + 4, 1);
    },
    fd_prestat_dir_name: (fd, at, length) => {
      if (fd !== 3) refuse("EBADF");
      if (length < 1) refuse("EINVAL");
      bytesAt(at, 1).set(encoder.encode("/"));
    },
    fd_fdstat_get: (fd, at) => {
      const of = handle(fd);
      bytesAt(at, 24).fill(0);
      view().setUint8(at >>> 0, typeOf(of));
      view().setUint16((at >>> 0) + 2, of.flags, true);
      put64(at + 8, of.rights);
      put64(at + 16, of.node?.isFolder ? ALL_RIGHTS : 0n);
    },
    fd_fdstat_set_flags: (fd, flags) => { handle(fd).flags = flags; },
    fd_fdstat_set_rights: fd => { handle(fd); },
    fd_filestat_get: (fd, at) => putStat(at, handle(fd)),
    fd_filestat_set_size: (fd, size) => file(fd, RIGHT_TO_WRITE).node.resize(sizeFrom(size)),
    fd_filestat_set_times: (fd, accessed, changed, flags) => setTimes(handle(fd).node ?? refuse("EINVAL"), changed, flags),
    fd_allocate: (fd, at, length) => {
      const { node } = file(fd, RIGHT_TO_WRITE);
      const end = sizeFrom(at + length);
      if (end > node.length) node.resize(end);
    },
    fd_advise: fd => { handle(fd); },
    fd_sync: fd => { handle(fd); },
    fd_datasync: fd => { handle(fd); },
    fd_close: fd => { handle(fd); handles.delete(fd); },
    fd_renumber: (from, to) => {
      const of = handle(from);
      handle(to);
      handles.delete(from);
      handles.set(to, of);
    },

    fd_read: (fd, at, count, done) => {
      if (handle(fd).input) return put32(done, 0);
      const of = file(fd, RIGHT_TO_READ);
      const length = readFrom(of, at, count, of.at);
      of.at += length;
      put32(done, length);
    },
    fd_pread: (fd, at, count, position, done) => put32(done, readFrom(file(fd, RIGHT_TO_READ), at, count, sizeFrom(position))),
    fd_write: (fd, at, count, done) => {
      const { lines } = handle(fd);
      if (lines) {
        return put32(done, eachPiece(at, count, piece => { lines.write(piece); return piece.length; }));
      }
      const of = file(fd, RIGHT_TO_WRITE);
      if (of.flags & APPEND) of.at = of.node.length;
      const length = writeTo(of, at, count, of.at);
      of.at += length;
      put32(done, length);
    },
    fd_pwrite: (fd, at, count, position, done) => put32(done, writeTo(file(fd, RIGHT_TO_WRITE), at, count, sizeFrom(position))),
    fd_seek: (fd, offset, whence, out) => {
      const of = file(fd);
      if (whence < 0 || whence > 2) refuse("EINVAL");
      of.at = sizeFrom(BigInt([0, of.at, of.node.length][whence]) + offset);
      put64(out, of.at);
    },
    fd_tell: (fd, out) => put64(out, file(fd).at),

    // The names are those of when it was begun, so that a module can remove what it has seen and go on from its place.
    fd_readdir: (fd, at, length, cookie, used) => {
      const node = folder(fd);
      const of = handle(fd);
      if (cookie === 0n || !of.listing) of.listing = node.names;
      const out = bytesAt(at, length);
      let filled = 0;
      // What does not fit is cut, which tells the module that there is more.
      const put = bytes => {
        out.set(bytes.subarray(0, out.length - filled), filled);
        filled = Math.min(filled + bytes.length, out.length);
      };
      for (let i = Number(cookie); i < of.listing.length && filled < out.length; i++) {
        const entry = node.entries.get(of.listing[i]);
        if (!entry) continue;
        const name = encoder.encode(entry.name);
        const head = new DataView(new ArrayBuffer(24));
        head.setBigUint64(0, BigInt(i + 1), true);
        head.setBigUint64(8, BigInt(entry.number), true);
        head.setUint32(16, name.length, true);
        head.setUint8(20, entry.isFolder ? FOLDER : FILE);
        put(new Uint8Array(head.buffer));
        put(name);
      }
      put32(used, filled);
    },

    path_open: (fd, lookup, at, length, how, rights, inherited, flags, out) => {
      const path = pathAt(fd, at, length);
      const [create, asFolder, exclusive, truncate] = [1, 2, 4, 8].map(bit => (how & bit) !== 0);
      let { node } = disk.place(path);
      if (node) {
        if (create && exclusive) refuse("EEXIST", path);
        if (!node.isFolder && (asFolder || path.endsWith("/"))) refuse("ENOTDIR", path);
        if (node.isFolder && (create || truncate || rights & RIGHT_TO_WRITE)) refuse("EISDIR", path);
        if (truncate) node.resize(0);
      } else {
        if (!create) refuse("ENOENT", path);
        if (asFolder || path.endsWith("/")) refuse(asFolder ? "EINVAL" : "EISDIR", path);
        node = disk.createFile(path);
      }
      let free = FIRST_FREE;
      while (handles.has(free)) free++;
      handles.set(free, open(node, rights & ALL_RIGHTS, flags));
      put32(out, free);
    },
    path_filestat_get: (fd, lookup, at, length, out) => putStat(out, { node: found(pathAt(fd, at, length)) }),
    path_filestat_set_times: (fd, lookup, at, length, accessed, changed, flags) => {
      setTimes(found(pathAt(fd, at, length)), changed, flags);
    },
    path_create_directory: (fd, at, length) => { disk.createFolder(pathAt(fd, at, length)); },
    path_remove_directory: (fd, at, length) => disk.removeFolder(pathAt(fd, at, length)),
    path_unlink_file: (fd, at, length) => {
      const path = pathAt(fd, at, length);
      found(path);
      disk.removeFile(path);
    },
    path_rename: (fd, at, length, toFd, toAt, toLength) => {
      const [from, to] = [pathAt(fd, at, length), pathAt(toFd, toAt, toLength)];
      if ((from.endsWith("/") || to.endsWith("/")) && !found(from).isFolder) refuse("ENOTDIR", from);
      disk.rename(from, to);
    },
    // Whoever follows a path link by link is told of each part that it is none.
    path_readlink: (fd, at, length) => { found(pathAt(fd, at, length)); refuse("EINVAL"); },
    path_symlink: () => refuse("ENOTSUP"),
    path_link: () => refuse("ENOTSUP"),
  };

  // What the disk refuses is a number to the module; an address that is not in its memory as well.
  const numbered = call => (...inputs) => {
    try {
      call(...inputs);
      return 0;
    } catch (error) {
      if (error instanceof DiskError) return errors[error.code];
      if (error instanceof RangeError) return errors.EFAULT;
      throw error;
    }
  };
  return { wasi_snapshot_preview1: Object.fromEntries(Object.entries(functions).map(([name, call]) => [name, numbered(call)])) };
}

// Imports with a function for all that a module asks for and has not got. It says that it is not supported, but for what
// is done before threads are asked for, and for what gives an address: there, nothing is the answer that does no harm.
function missingImports(module, imports) {
  const all = Object.fromEntries(Object.entries(imports).map(([name, functions]) => [name, { ...functions }]));
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    if (kind !== "function") continue;
    const answer = /^(pthread_attr_|pthread_mutex|realpath$|__errno_location$)/.test(name) ? 0 : 58;
    (all[from] ??= {})[name] ??= () => answer;
  }
  return all;
}
