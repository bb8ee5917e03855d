// Keeping: the gallery of runs, what the open one can be made into, and files that are dropped on the page.

// No message to the studio may be longer, bytes.
const LARGEST_FILE = 15e6;
// So many runs are seen at a glance.
const FEW_RUNS = 4;

class Keep {
  constructor(connection, watch, { open, draw, close }) {
    Object.assign(this, { connection, watch, open, draw, close });
    this.films = new Films(connection);
    connection.on("robustness", state => this.showRobustness(state));
    connection.on("catalogue", catalogue => this.fill(catalogue));
    connection.on("opened", event => this.show(event));
    // It may be gone already.
    connection.on("refused", ({ request }) => { if (request === "remove") connection.ask({ do: "look" }); });
    connection.on("saved", ({ name }) => this.say(`${name} is saved.`));
    const get = name => document.getElementById(name);
    get("keep-verify").addEventListener("click", () => this.verify());
    get("keep-link").addEventListener("click", () => this.link());
    get("keep-robust").addEventListener("click", () => connection.ask({ do: "robustness" }));
    get("keep-remove").addEventListener("click", () => {
      const { run } = this.watch;
      this.askToRemove(run, "Its folder, with champion, log and report, is deleted for good.", { do: "remove", run });
    });
    get("remove-no").addEventListener("click", () => get("remove-dialog").close());
    get("remove-yes").addEventListener("click", () => this.remove());
    // An address that is served has a secret in it, and leads to this machine.
    for (const id of ["keep-pack", "keep-link"]) get(id).hidden = !connection.isAlone;
    get("keep-pack").addEventListener("click", () => this.pack());
    get("keep-draw").addEventListener("click", () => draw(this.watch.config.creature));
    get("keep-search").addEventListener("input", () => this.sift());
    get("keep-file").addEventListener("change", event => {
      this.read(event.target.files[0]);
      // The same file may be chosen again.
      event.target.value = "";
    });
    document.addEventListener("dragover", event => { event.preventDefault(); get("keep-drop").classList.add("over"); });
    document.addEventListener("dragleave", () => get("keep-drop").classList.remove("over"));
    document.addEventListener("drop", event => {
      event.preventDefault();
      get("keep-drop").classList.remove("over");
      if (event.dataTransfer.files.length) this.read(event.dataTransfer.files[0]);
    });
  }

  fill({ runs, more_runs: more, formats, creatures, terrains, drawn }) {
    if (!document.querySelector("#keep-exports button")) this.offerExports(formats);
    const bodies = creatures.filter(({ name }) => drawn.includes(name));
    const grounds = terrains.filter(terrain => terrain.drawn);
    document.getElementById("keep-drawn").hidden = bodies.length + grounds.length === 0;
    document.querySelector("#keep-drawn ul").replaceChildren(...bodies.map(body => this.bodyLine(body)), ...grounds.map(({ name }) => this.groundLine(name)));
    document.getElementById("keep-empty").hidden = runs.length > 0;
    document.getElementById("keep-runs").replaceChildren(...runs.map(run => this.card(run)));
    document.getElementById("keep-search").closest("label").hidden = runs.length <= FEW_RUNS;
    this.sift();
    document.getElementById("keep-more").hidden = !more;
    document.getElementById("keep-more").textContent = `${count(more, "older run is", "older runs are")} not shown.`;
    if (this.removed && !runs.some(({ run }) => run === this.removed)) {
      if (this.watch.run === this.removed) this.close(runs);
      this.removed = null;
    }
    if (this.watch.run) this.show(this.watch);
  }

  // Shows the runs that have each word that is looked for in their name, creature or movement.
  sift() {
    const words = document.getElementById("keep-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    const items = [...document.querySelectorAll("#keep-runs > li")];
    for (const item of items) item.hidden = !words.every(word => item.dataset.words.includes(word));
    document.getElementById("keep-none").hidden = !items.length || items.some(item => !item.hidden);
  }

  card({ run, creature, movement, fitness, is_running: running }) {
    const item = element("li");
    const button = element("button");
    button.type = "button";
    button.dataset.run = run;
    const canvas = element("canvas");
    const line = element("p");
    const worth = running ? "training" : fitness === null ? "" : tidy(fitness);
    line.append(element("b", run), element("span", worth));
    line.title = `${run}: ${creature.title || creature.name}, ${movement}`;
    item.dataset.words = `${line.title} ${creature.name}`.toLowerCase();
    button.append(canvas, line);
    button.addEventListener("click", () => this.open(run));
    item.append(button);
    drawPortrait(canvas, creature, () => this.films.of(run, running ? null : fitness));
    return item;
  }

  bodyLine(creature) {
    const { name } = creature;
    return drawnLine(name, `creature, ${count(creature.parts.length, "part", "parts")}`, [
      ["Change", () => this.draw(creature)],
      ["Remove", () => this.askToRemove(name, "Its file is deleted for good. Runs of it stay.", { do: "remove-creature", name })],
    ]);
  }

  groundLine(name) {
    return drawnLine(name, "ground", [
      ["Remove", () => this.askToRemove(name, "Its file is deleted for good. Runs on it stay.", { do: "remove-terrain", name })],
    ]);
  }

  show({ run }) {
    const panel = document.getElementById("keep-open");
    panel.hidden = !run;
    if (!run) return;
    // What is said of this run stays.
    if (document.getElementById("keep-title").textContent === run) return;
    document.getElementById("keep-title").textContent = run;
    document.getElementById("keep-result").textContent = "";
    document.getElementById("keep-robustness").hidden = true;
    const address = `runs/${encodeURIComponent(run)}`;
    this.connection.link(document.getElementById("keep-report"), `${address}/report`, `${run}.html`);
    this.connection.link(document.getElementById("keep-champion"), `${address}/champion.json`, `${run}.champion.json`);
  }

  // The open run can be had in each format there is.
  offerExports(formats) {
    const buttons = formats.flatMap(({ name, endings }) => endings.map((ending, file) => {
      const button = element("button", endings.length > 1 ? `${name} ${ending}` : name, "small");
      button.type = "button";
      button.addEventListener("click", async () => {
        button.disabled = true;
        await this.export(this.watch.run, name, file);
        button.disabled = false;
      });
      return button;
    }));
    document.getElementById("keep-exports").replaceChildren("Export:", ...buttons);
  }

  say(text) { document.getElementById("keep-result").textContent = text; }

  // An answer, also where there is none: then without `ok`, and its text says so.
  async get(address) {
    try { return await this.connection.get(address); } catch (error) { return { ok: false, blob: new Blob([`The studio does not answer: ${error.message}`]) }; }
  }

  // Fetched first, so that what is wrong can be said.
  async export(run, format, file) {
    this.say(`${format} is being made …`);
    const { ok, name, blob } = await this.get(`runs/${encodeURIComponent(run)}/export/${format}/${file}`);
    if (ok) saveAs(blob, name);
    const said = ok ? `${name} is saved.` : await blob.text();
    // Another run may be open by now.
    if (document.getElementById("keep-title").textContent === run) this.say(said);
  }

  async verify() {
    this.say("The champion is played again …");
    const { ok, blob } = await this.get(`runs/${encodeURIComponent(this.watch.run)}/verify`);
    const text = await blob.text();
    if (!ok) return this.say(text);
    const { identical, diverges_at_step: step } = JSON.parse(text);
    return this.say(identical ? "Identical: the champion does to the bit what its file says." : `Not identical: it differs from step ${step} on.`);
  }

  // How far its champion was replayed in other worlds, and what came out.
  showRobustness({ worlds: [done, of], result, problem }) {
    const place = document.getElementById("keep-robustness");
    place.hidden = !result;
    if (problem) return this.say(problem);
    if (!result) return this.say(of ? `Replayed in ${done} of ${of} worlds …` : "The champion is replayed …");
    const percent = share => `${Math.round(share * 100)}\u00a0%`;
    const kept = result.fitness_kept === null ? "" : `; it keeps ${percent(result.fitness_kept)} of its way`;
    this.say(`Usable in ${percent(result.usable_share)} of ${of} worlds that are not quite the one it learned in${kept}.`);
    const table = element("table");
    const row = (kind, cells) => { const line = element("tr"); line.append(...cells.map(cell => element(kind, cell))); return line; };
    table.append(row("th", ["What is changed", "Worlds", "Usable"]));
    for (const { cause, worlds, usable_share: share } of result.causes) table.append(row("td", [cause.replaceAll("-", " "), String(worlds), percent(share)]));
    place.replaceChildren(table);
    return undefined;
  }

  askToRemove(name, what, request) {
    this.removal = request;
    document.getElementById("remove-title").textContent = `Remove ${name}?`;
    document.getElementById("remove-text").textContent = what;
    document.getElementById("remove-dialog").showModal();
  }

  remove() {
    document.getElementById("remove-dialog").close();
    this.removed = this.removal.run;
    this.connection.ask(this.removal);
  }

  async link() {
    const { ok, blob } = await this.get(`runs/${encodeURIComponent(this.watch.run)}/champion.json`);
    const text = await blob.text();
    if (!ok) return this.say(text);
    const address = await linkTo(text);
    try {
      await navigator.clipboard.writeText(address);
      this.say(`A link of ${count(address.length, "character", "characters")} is copied; it opens this champion.`);
    } catch {
      // The browser lets nothing be copied. The address is longer than the page is wide.
      const anchor = element("a", "This is the link.");
      anchor.href = address;
      document.getElementById("keep-result").replaceChildren(anchor);
    }
    return undefined;
  }

  async pack() {
    const { ok, name, blob } = await this.connection.pack(this.watch.run);
    if (!ok) return this.say(await blob.text());
    saveAs(blob, name);
    return this.say(`${name} is saved. Unpacked, it is a run of the program; dropped here, it is this run again.`);
  }

  async read(file) {
    if (!file) return;
    if (file.name.endsWith(".tar") && this.connection.isAlone) return this.connection.unpack(file.name, await file.arrayBuffer());
    if (file.size > LARGEST_FILE) return this.watch.refuse(`${file.name}: ${large(file.size)} bytes, and at most ${large(LARGEST_FILE)} can be read`);
    let text, parsed;
    try { text = await file.text(); parsed = JSON.parse(text); } catch (error) { return this.watch.refuse(`${file.name}: ${error.message}`); }
    if (parsed?.format === "gambol creature") this.draw(parsed);
    else {
      // Asked for again where the studio was away.
      this.champion = { do: "open-champion", name: file.name, text };
      this.connection.ask(this.champion);
    }
    return undefined;
  }
}

// Something that was drawn here, and what can be done with it.
function drawnLine(name, what, actions) {
  const item = element("li");
  const buttons = actions.map(([word, act]) => {
    const button = element("button", word, "small");
    button.type = "button";
    button.setAttribute("aria-label", `${word} ${name}`);
    button.addEventListener("click", act);
    return button;
  });
  item.append(element("b", name), element("span", what), ...buttons);
  return item;
}
