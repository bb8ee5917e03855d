// A worker with a studio in it: the module, its disk, the pages that talk to it, and its work between their messages.

// How often pages are told what is new, and how often the disk is kept, ms.
const NEWS = 50;
const KEEPING = 1000;

// Where the module has its runs.
const RUNS = "/runs";

class Host {
  // `compiling`: a promise of the module. `keeps`: whether there are runs, which are kept.
  constructor(compiling, { keeps }) {
    this.compiling = compiling;
    this.keeps = keeps;
    this.pages = new Map();
    // Workers that help with evaluations, and the page that each came with.
    this.helpers = new Map();
    this.number = 0;
    this.early = [];
    this.told = 0;
    this.kept = 0;
    this.turns = new MessageChannel();
    this.turns.port1.onmessage = () => this.work();
    this.start().catch(error => this.break(error));
  }

  async start() {
    const [module] = await Promise.all([this.compiling, this.load()]);
    this.module = await begun(module, this.disk, (...of) => this.send(...of));
    for (const [page, message] of this.early.splice(0)) this.hear(page, message);
  }

  async load() {
    this.disk = new Disk();
    if (!this.keeps) return;
    try {
      if (!await isOnlyWriter()) throw new Error("another tab keeps the runs");
      this.store = await Store.open("gambol studio");
      await this.store.load(this.disk);
    } catch (error) {
      this.store = null;
      this.complain(`This browser keeps nothing (${error.message}): what is trained here is gone with the page.`);
    }
  }

  join(port) {
    this.number += 1;
    const page = this.number;
    this.pages.set(page, port);
    port.addEventListener("message", ({ data }) => { if (this.module) this.hear(page, data); else this.early.push([page, data]); });
    port.start?.();
    const joins = { join: true };
    if (this.module) this.hear(page, joins); else this.early.push([page, joins]);
    if (this.complaint) port.postMessage(this.complaint);
  }

  hear(page, { join, leave, ask, get, address, helper, pack, unpack }) {
    if (pack) this.pack(page, pack);
    else if (unpack) this.unpack(page, unpack);
    else this.guarded(() => {
      if (join) this.module.join(page, this.keeps ? 1 : 0);
      else if (leave) this.leave(page);
      else if (helper) this.welcome(page, helper);
      else if (ask) {
        say(this.module, ask);
        this.module.ask(page);
      } else if (get) {
        this.got = get;
        say(this.module, address);
        this.module.get(page);
      }
    });
    this.turn(0);
  }

  // A whole run as a file, and back.
  pack(page, { number, run }) {
    const name = `${run}.tar`;
    try {
      const bytes = packed(run, filesBelow(this.disk, `${RUNS}/${run}`));
      this.pages.get(page)?.postMessage({ got: { number, name, media: "application/x-tar", bytes } }, [bytes.buffer]);
    } catch (error) {
      this.pages.get(page)?.postMessage({ got: { number, failed: `${name}: ${error.message}` } });
    }
  }

  unpack(page, { name, bytes }) {
    try {
      this.hear(page, { ask: JSON.stringify({ do: "open", run: addRun(this.disk, RUNS, new Uint8Array(bytes)) }) });
    } catch (error) {
      const event = { is: "refused", request: "open", reason: `${name}: ${error.message}` };
      this.pages.get(page)?.postMessage({ event: JSON.stringify(event) });
    }
  }

  leave(page) {
    this.module.leave(page);
    this.pages.delete(page);
    for (const [number, helper] of this.helpers) {
      if (helper.page !== page) continue;
      this.module.helper_goes(number);
      this.helpers.delete(number);
    }
  }

  welcome(page, port) {
    this.number += 1;
    const number = this.number;
    this.helpers.set(number, { page, port });
    port.onmessage = ({ data: { ready, found } }) => {
      this.guarded(() => {
        if (ready) return this.module.helper_comes(number);
        say(this.module, new Uint8Array(found));
        return this.module.helper_brings(number);
      });
      this.turn(0);
    };
  }

  // The module says something to a page.
  send(page, kind, at, length) {
    const bytes = new Uint8Array(this.module.memory.buffer, at, length);
    const port = this.pages.get(page);
    if (kind === 4) {
      const { buffer } = bytes.slice();
      this.helpers.get(page)?.port.postMessage({ errand: buffer }, [buffer]);
    } else if (kind === 0) port?.postMessage({ event: new TextDecoder().decode(bytes) });
    else if (kind === 2) this.about = JSON.parse(new TextDecoder().decode(bytes));
    else {
      const { buffer } = bytes.slice();
      const message = kind === 1 ? { frame: buffer } : { got: { number: this.got, ...this.about, bytes: buffer } };
      port?.postMessage(message, [buffer]);
    }
  }

  // A turn of work comes after so many ms, or before.
  turn(wait) {
    clearTimeout(this.timer);
    if (wait < 1) {
      if (!this.isDue) this.turns.port2.postMessage(null);
      this.isDue = true;
    } else if (!this.isDue) this.timer = setTimeout(() => this.work(), wait);
  }

  work() {
    this.isDue = false;
    if (!this.module) return;
    const wait = this.guarded(() => this.module.work());
    const now = performance.now();
    if (now - this.told >= NEWS || wait !== 0) {
      this.told = now;
      this.guarded(() => { for (const page of this.pages.keys()) this.module.news(page); });
    }
    // At once if there is nothing else to do.
    if (wait !== 0 || now - this.kept >= KEEPING) this.keep(now);
    if (wait >= 0) this.turn(wait);
  }

  // Keeps the disk as it is between two turns. What changes meanwhile is kept afterwards.
  keep(now) {
    if (!this.store) return;
    this.isStale = this.isKeeping;
    if (this.isKeeping) return;
    this.kept = now;
    this.isKeeping = true;
    this.store.save(this.disk)
      .catch(error => this.complain(`The browser cannot keep what is trained: ${error.message}`))
      .finally(() => {
        this.isKeeping = false;
        if (this.isStale) this.keep(performance.now());
      });
  }

  guarded(act) {
    if (!this.module) return -1;
    try { return act(); } catch (error) {
      this.break(error);
      return -1;
    }
  }

  // The module is not whole any more. The next worker begins with what is kept.
  break(error) {
    this.module = null;
    console.error(error);
    this.complain(`The studio broke off: ${error.message}. What was kept is there when the page is loaded again.`, true);
    setTimeout(() => close(), 100);
  }

  complain(problem, isOver = false) {
    this.complaint = { problem, isOver };
    for (const port of this.pages.values()) port.postMessage(this.complaint);
  }
}

// A worker that evaluates for another.
class HelpingHand {
  constructor(compiling, port) {
    this.compiling = compiling;
    this.port = port;
    port.onmessage = ({ data: { errand } }) => {
      say(this.module, new Uint8Array(errand));
      this.module.help();
    };
    this.start();
  }

  async start() {
    this.module = await begun(await this.compiling, new Disk(), (...of) => this.send(...of));
    this.port.postMessage({ ready: true });
  }

  send(_, __, at, length) {
    const { buffer } = new Uint8Array(this.module.memory.buffer, at, length).slice();
    this.port.postMessage({ found: buffer }, [buffer]);
  }
}

// A module at work, on a disk; `send` is what it says things with.
async function begun(module, disk, send) {
  let exports = null;
  const imports = { ...wasiImports(disk, () => exports.memory), page: { send } };
  const instance = await WebAssembly.instantiate(module, missingImports(module, imports));
  exports = instance.exports;
  exports._initialize?.();
  return exports;
}

// Puts text or bytes where a module reads them.
function say(module, what) {
  const bytes = typeof what === "string" ? new TextEncoder().encode(what) : what;
  const at = module.room(bytes.length);
  new Uint8Array(module.memory.buffer, at, bytes.length).set(bytes);
}

// Whether no other worker writes the store, nor will for as long as this one lives. Where tabs share no worker each has its
// own; that of a tab which is loaded anew may take a moment to end.
function isOnlyWriter() {
  if (!navigator.locks) return Promise.resolve(true);
  return new Promise(resolve => {
    const held = () => { resolve(true); return new Promise(() => {}); };
    navigator.locks.request("gambol studio", { signal: AbortSignal.timeout(3000) }, held).catch(() => resolve(false));
  });
}

// A module that a page has compiled.
const handed = () => new Promise(resolve => addEventListener("message", ({ data: { module } }) => { if (module) resolve(module); }));

if (typeof SharedWorkerGlobalScope === "function") {
  const host = new Host(compiled("studio.wasm"), { keeps: true });
  onconnect = ({ ports: [port] }) => host.join(port);
} else if (self.name === "helper") {
  const compiling = handed();
  addEventListener("message", ({ data: { serve } }) => { if (serve) self.hand = new HelpingHand(compiling, serve); });
} else new Host(handed(), { keeps: self.name !== "arena" }).join(self);
