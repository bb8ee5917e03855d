// The connection to a studio in workers of this browser: one for the runs, which all tabs share where they can, and one for
// what moves on this page.

const OF_THE_ARENA = new Set(["enter", "leave", "advance", "tell", "push", "tilt", "put-box"]);
// What is done to a world. One that was asked for may not be there yet.
const DONE_TO_A_WORLD = new Set(["tell", "push", "tilt", "put-box"]);

class WorkerConnection extends Connection {
  constructor() {
    super();
    this.wanted = new Map();
    this.number = 0;
    this.helpers = [];
    // How many worlds are asked for that have not come, and what is to be done to the last of them.
    this.coming = 0;
    this.held = [];
    // Compiled once for all workers that can be handed it; one that is shared between tabs cannot.
    this.module = compiled("studio.wasm");
    this.module.catch(error => this.onState(false, `The studio cannot be loaded: ${error.message}`));
    this.runs = WorkerConnection.sharedWorker() || this.worker("runs");
    this.arena = this.worker("arena");
    this.runs.onmessage = ({ data }) => this.hear(data);
    this.arena.onmessage = ({ data }) => this.hear(data);
    this.runs.start?.();
    addEventListener("pagehide", () => this.runs.postMessage({ leave: true }));
    // A page that the browser had put away has left.
    addEventListener("pageshow", ({ persisted }) => { if (persisted) location.reload(); });
  }

  worker(name) {
    const worker = new Worker("worker.js", { name });
    this.module.then(module => worker.postMessage({ module }), () => {});
    return worker;
  }

  static sharedWorker() {
    try { return new SharedWorker("worker.js", { name: "runs" }).port; } catch { return null; }
  }

  // One core is for the runs and one for the page; but one helper there is, which judges. More than a few have little to do.
  static mostHelpers() {
    const asked = new URLSearchParams(location.search).get("helpers");
    const count = asked === null ? (navigator.hardwareConcurrency || 2) - 2 : Number(asked) || 0;
    return Math.min(Math.max(count, asked === null ? 1 : 0), 6);
  }

  // It talks to the worker of runs itself.
  addHelper() {
    const { port1, port2 } = new MessageChannel();
    const helper = this.worker("helper");
    helper.postMessage({ serve: port1 }, [port1]);
    this.runs.postMessage({ helper: port2 }, [port2]);
    this.helpers.push(helper);
  }

  hear({ event, frame, got, problem, isOver }) {
    if (frame) this.takeFrame(frame);
    else if (got) this.receive(got);
    else if (problem && isOver) this.onState(false, problem);
    else if (problem) this.tell({ is: "refused", request: "keep", reason: problem });
    else if (event) {
      const told = JSON.parse(event);
      if (told.is === "scene") this.ask({ do: "enter", scene: told.scene, arena: told.arena }); else this.tell(told);
      const isRefused = told.is === "refused" && ["show", "enter"].includes(told.request);
      if (isRefused || (told.is === "arena" && told.arena === 0)) this.worldCame();
      // Not before there is something to see.
      if (told.is === "arena") while (this.helpers.length < WorkerConnection.mostHelpers()) this.addHelper();
    }
  }

  // All that can be set is a file beside the page: the code that finds it out would be a twentieth of the module.
  async tellSchema() {
    try { this.tell({ is: "schema", schema: await (await fetch("schema.json")).json() }); } catch (error) {
      this.tell({ is: "refused", request: "schema", reason: `The settings cannot be loaded: ${error.message}` });
    }
  }

  // A world has come, or never will.
  worldCame() {
    this.coming = Math.max(this.coming - 1, 0);
    if (!this.coming) for (const request of this.held.splice(0)) this.ask(request);
  }

  ask(request) {
    if (request.do === "schema") return void this.tellSchema();
    // One worker is asked for a world, and the other knows nothing of it yet.
    if (request.do === "show" && !request.arena) this.coming += 1;
    if (this.coming && DONE_TO_A_WORLD.has(request.do)) return void this.held.push(request);
    const worker = OF_THE_ARENA.has(request.do) ? this.arena : this.runs;
    worker.postMessage({ ask: JSON.stringify(request) });
  }

  get(address) {
    this.number += 1;
    this.runs.postMessage({ get: this.number, address });
    return new Promise(resolve => this.wanted.set(this.number, resolve));
  }

  // There is no program beside the page, and no folder to copy.
  get isAlone() { return true; }

  pack(run) {
    this.number += 1;
    this.runs.postMessage({ pack: { number: this.number, run } });
    return new Promise(resolve => this.wanted.set(this.number, resolve));
  }

  unpack(name, bytes) { this.runs.postMessage({ unpack: { name, bytes } }, [bytes]); }

  receive({ number, name, media, missing, failed, bytes }) {
    const wrong = missing || failed;
    this.wanted.get(number)?.(wrong ? { ok: false, blob: new Blob([wrong]) } : { ok: true, name, blob: new Blob([bytes], { type: media }) });
    this.wanted.delete(number);
  }

  // What a report does is not allowed to this page, so it is saved.
  link(anchor, address, name) {
    anchor.href = "#/keep";
    anchor.onclick = async event => {
      event.preventDefault();
      const { ok, name: named, blob } = await this.get(address);
      if (ok) {
        saveAs(blob, named || name);
        this.tell({ is: "saved", name: named || name });
      } else this.tell({ is: "refused", request: "get", reason: await blob.text() });
    };
  }
}

function connect() { return new WorkerConnection(); }
