// The studio: its chapters, its keys, its one loop, and how it begins.

const CHAPTERS = ["watch", "choose", "draw", "play", "keep"];
const TOUR = [
  ["watch", "Watch", "A whole generation runs at once: the best is solid, the others are half transparent. Each generation begins where the last one ended."],
  ["choose", "Choose", "Pick a creature and a movement, and press Train. Everything else has a default that works."],
  ["draw", "Draw", "Draw a body of your own: drag parts, join them, give them motors, and press K to see it learn. Under Ground you draw what it moves on."],
  ["play", "Play", "Push the champion, tilt the world, put a box in its way. One that was trained for “playing” obeys the arrow keys."],
  ["keep", "Keep", "All runs stay. Open one, verify it, make a GIF or a character for your game of it."],
];

class Studio {
  constructor() {
    this.connection = connect();
    this.arena = new Arena(document.getElementById("arena-canvas"), this.connection);
    this.watch = new Watch(this.connection, this.arena);
    this.watch.refuse = text => this.refuse(text);
    this.net = new LiveNet(this.arena);
    this.members = new Members(this.connection, this.arena, () => this.showNow());
    this.beside = new Beside(this.connection, this.arena, () => this.showNow());
    this.readouts = new Readouts(document.getElementById("arena-readouts"));
    this.play = new Play(this.connection, this.arena);
    this.choose = new Choose(this.connection, () => this.go("watch"));
    this.keep = new Keep(this.connection, this.watch, {
      open: run => { this.connection.ask({ do: "open", run }); this.go("watch"); },
      draw: creature => {
        this.go("draw");
        this.draw(creature);
        remembered.set("drawn creature", this.editor.creature);
      },
      close: runs => this.close(runs),
    });
    this.who = "population";
    this.listen();
    this.buildControls();
    // Before the address is that of a chapter.
    const linked = linkedIn(location.hash);
    const chapter = location.hash.slice(2);
    this.go(CHAPTERS.includes(chapter) ? chapter : "watch");
    this.begin(linked);
  }

  listen() {
    const { connection } = this;
    connection.on("refused", ({ request, reason }) => {
      if (request === "show" || request === "enter") this.isShowAsked = false;
      // Before there is anything to show, nothing is wrong.
      if (request !== "show" && request !== "advance") this.refuse(reason);
      // What the address has is not there: what else there is takes its place.
      if (request.startsWith("open") && this.isBeginning) {
        this.isBeginning = request !== "open-latest";
        connection.ask({ do: this.isBeginning ? "open-latest" : "look" });
      }
    });
    connection.on("catalogue", () => this.know());
    connection.on("opened", event => {
      this.opened = event;
      this.isBeginning = false;
      this.shown = null;
      this.setAddress(event.run);
      this.showAgain();
      this.connection.ask({ do: "look" });
    });
    // Asked once, and again where there was nothing to show yet.
    connection.on("generations", () => { if (!this.shown && !this.isShowAsked && !this.members.pinned) this.showAgain(); });
    connection.onState = (on, problem) => {
      document.body.classList.toggle("offline", !on);
      if (on && this.wasOff) {
        this.refuse("");
        if (this.opened?.run) connection.ask({ do: "open", run: this.opened.run });
        else if (this.keep.champion) connection.ask(this.keep.champion);
      } else if (!on) this.refuse(problem);
      this.wasOff = !on;
    };
    this.arena.onEnter = event => {
      this.shown = event;
      this.isShowAsked = false;
      this.play.enter(event);
      this.net.enter(event);
      this.members.enter(event);
      const generation = fixed(event.generation, 0);
      const captions = {
        population: `generation ${generation}, ${count(event.actors, "creature", "creatures")}`,
        family: `one of generation ${generation} and where it comes from`,
        champion: `the champion, of generation ${generation}`,
      };
      document.getElementById("arena-caption").textContent = captions[event.who];
    };
    this.arena.onHit = hit => this.chapter === "play" && this.play.push(hit);
    document.addEventListener("keydown", event => this.key(event));
    window.addEventListener("hashchange", () => {
      const chapter = location.hash.slice(2);
      if (CHAPTERS.includes(chapter) && chapter !== this.chapter) this.go(chapter);
    });
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { readTheme(); loop.redrawAll(); });
  }

  // The open run was removed: the latest that there is takes its place.
  close(runs) {
    this.opened = this.shown = null;
    this.setAddress(null);
    if (runs.length) return this.connection.ask({ do: "open", run: runs[0].run });
    const { stage } = this.arena;
    this.arena.leave();
    stage.blank();
    this.readouts.clear();
    this.members.leave();
    document.getElementById("arena-caption").textContent = "";
    return this.watch.close();
  }

  // The page opens the same run when it is loaded anew.
  setAddress(run) {
    const address = new URL(location.href);
    address.searchParams.delete("creature");
    if (run) address.searchParams.set("run", run); else address.searchParams.delete("run");
    history.replaceState(null, "", address);
  }

  // The first time: the champion in the address, what was asked for on the command line, else the latest run, else a biped that learns to
  // run. What there is to choose from is long, and comes after what there is to see.
  async begin(linked) {
    const asked = new URLSearchParams(location.search);
    this.isBeginning = !asked.get("creature");
    let text = null;
    try { text = await linked; } catch (error) { this.refuse(`The link is damaged: ${error.message}`); }
    if (text) this.connection.ask({ do: "open-champion", name: "the link", text });
    else if (asked.get("run")) this.connection.ask({ do: "open", run: asked.get("run") });
    else if (!asked.get("creature")) this.connection.ask({ do: "open-latest" });
    else this.connection.ask({ do: "look" });
    this.connection.ask({ do: "schema" });
  }

  // Once it is known what there is to choose from.
  know() {
    if (this.isKnown) return;
    this.isKnown = true;
    if (this.chapter === "draw") this.buildEditor();
    const creature = new URLSearchParams(location.search).get("creature");
    if (!creature || this.opened) return;
    this.choose.choice.creature = creature;
    // Unless somebody has been faster.
    if (this.chapter === "watch") this.go("choose");
    this.choose.fill(this.choose.catalogue);
  }

  go(chapter) {
    const before = this.chapter;
    this.chapter = chapter;
    if (before && before !== chapter) window.scrollTo(0, 0);
    for (const section of document.querySelectorAll("main > section")) section.hidden = !section.dataset.chapters.split(" ").includes(chapter);
    for (const button of document.querySelectorAll("nav button")) {
      if (button.dataset.chapter === chapter) button.setAttribute("aria-current", "page"); else button.removeAttribute("aria-current");
    }
    history.replaceState(null, "", `#/${chapter}`);
    this.play.active = chapter === "play";
    // It is the champion that is played with.
    document.getElementById("show-who").closest("label").hidden = chapter === "play";
    this.beside.setVisible(chapter !== "play");
    if (chapter === "draw") this.buildEditor();
    if ((chapter === "keep" || chapter === "choose") && before !== chapter) this.connection.ask({ do: "look" });
    if (before && before !== chapter && (chapter === "play" || before === "play")) this.showNow();
    if (chapter === "play") document.getElementById("arena-canvas").focus();
  }

  // Once there are creatures.
  buildEditor() {
    const creatures = this.choose.catalogue?.creatures;
    if (this.editor || !creatures) return;
    this.checked = new Map();
    this.checks = 0;
    this.connection.on("checked", ({ number, problems }) => { this.checked.get(number)?.(problems); this.checked.delete(number); });
    this.editor = new Editor(document.getElementById("draw-editor"), {
      check: creature => this.check({ do: "check", creature }),
      freeName: name => this.freeName(name),
      changed: creature => remembered.set("drawn creature", creature),
      play: creature => {
        this.choose.setDrawn(creature);
        this.choose.train();
      },
    });
    const chosen = creatures.find(({ name }) => name === this.choose.choice.creature);
    this.draw(this.watch.config?.creature || chosen || creatures[0]);
    const draft = remembered.get("drawn creature");
    if (draft) this.editor.become(draft);
  }

  // Asks what is wrong with what is drawn.
  check(request) {
    this.checks += 1;
    return new Promise(resolve => {
      this.checked.set(this.checks, resolve);
      this.connection.ask({ ...request, number: this.checks });
    });
  }

  // The one editor or the other.
  showEditor(what) {
    for (const radio of document.getElementsByName("draw-what")) radio.checked = radio.value === what;
    document.getElementById("draw-editor").hidden = what !== "creature";
    document.getElementById("draw-ground").hidden = what !== "ground";
    if (what === "ground") this.buildTerrainEditor();
  }

  buildTerrainEditor() {
    if (this.terrainEditor || !this.choose.catalogue) return;
    this.terrainEditor = new TerrainEditor(document.getElementById("draw-ground"), {
      creature: () => this.choose.creature,
      check: terrain => this.check({ do: "check-terrain", terrain }),
      changed: terrain => remembered.set("drawn ground", terrain),
      keep: (name, terrain) => new Promise((resolve, reject) => {
        this.keeping = { name, resolve, reject };
        this.connection.ask({ do: "keep-terrain", name, terrain });
      }),
      train: name => {
        this.choose.setTerrain(name);
        this.choose.train();
      },
      play: name => {
        this.play.setTerrain(name);
        this.go("play");
        if (!this.opened) this.refuse("There is no champion yet that could play on it: train one first.");
      },
    });
    this.terrainEditor.setKept(this.choose.catalogue.terrains);
    const draft = remembered.get("drawn ground");
    if (draft) this.terrainEditor.become(draft);
    this.connection.on("catalogue", ({ terrains }) => {
      this.terrainEditor.setKept(terrains);
      if (terrains.some(({ name }) => name === this.keeping?.name)) this.keeping.resolve();
    });
    this.connection.on("refused", ({ request, reason }) => { if (request === "keep-terrain") this.keeping?.reject(new Error(reason)); });
  }

  // Changes a creature; one that has the name of a shipped one gets a name of its own.
  draw(creature) {
    const { creatures, drawn } = this.choose.catalogue;
    this.showEditor("creature");
    const isShipped = creatures.some(({ name }) => name === creature.name) && !drawn.includes(creature.name);
    this.editor.load(isShipped ? { ...creature, name: this.freeName(`my ${creature.name}`) } : creature);
  }

  // A name for a creature that none has.
  freeName(name) {
    const taken = new Set(this.choose.catalogue?.creatures.map(creature => creature.name));
    let free = name;
    for (let number = 2; taken.has(free); number += 1) free = `${name} ${number}`;
    return free;
  }

  // What is shown at somebody's wish is the latest there is, whatever was pinned.
  showNow() {
    this.members.pin(false);
    this.showAgain();
  }

  showAgain() {
    if (!this.opened) return;
    this.isShowAsked = true;
    if (this.chapter === "play") return this.play.begin();
    this.connection.ask({ do: "show", who: this.who });
    return this.beside.show();
  }

  buildControls() {
    const get = name => document.getElementById(name);
    const { arena } = this;
    const play = get("show-play");
    const label = () => {
      play.textContent = arena.playing ? "❚❚" : "▶";
      play.setAttribute("aria-label", arena.playing ? "Pause the picture" : "Let the picture go on");
      get("show-follow").setAttribute("aria-pressed", String(arena.follow));
    };
    this.toggle = () => { arena.playing = !arena.playing; label(); };
    arena.onFollow = () => { label(); this.members.tell(); };
    get("show-again").textContent = "⟲";
    play.addEventListener("click", this.toggle);
    get("show-again").addEventListener("click", () => this.showNow());
    get("show-speed").addEventListener("change", event => { arena.speed = Number(event.target.value); });
    get("show-who").addEventListener("change", event => { this.who = event.target.value; this.showNow(); });
    get("show-follow").addEventListener("click", () => { arena.follow = !arena.follow; label(); });
    get("show-in").addEventListener("click", () => arena.zoomBy(1.25));
    get("show-out").addEventListener("click", () => arena.zoomBy(0.8));
    label();
    for (const button of document.querySelectorAll("nav button")) button.addEventListener("click", () => this.go(button.dataset.chapter));
    for (const radio of document.getElementsByName("draw-what")) radio.addEventListener("change", () => this.showEditor(radio.value));
    for (const button of document.querySelectorAll("[data-copy]")) {
      button.addEventListener("click", () => navigator.clipboard?.writeText(get(button.dataset.copy).textContent));
    }
    get("notice").querySelector("button").addEventListener("click", () => this.refuse(""));
    get("tour").addEventListener("click", () => this.tour(0));
    get("tour-next").addEventListener("click", () => this.tour(this.tourStep + 1));
    get("tour-back").addEventListener("click", () => this.tour(this.tourStep - 1));
    get("tour-close").addEventListener("click", () => get("tour-dialog").close());
  }

  tour(step) {
    const dialog = document.getElementById("tour-dialog");
    if (step >= TOUR.length) return dialog.close();
    this.tourStep = Math.max(step, 0);
    const [chapter, title, text] = TOUR[this.tourStep];
    this.go(chapter);
    document.getElementById("tour-title").textContent = `${this.tourStep + 1} of ${TOUR.length}: ${title}`;
    document.getElementById("tour-text").textContent = text;
    document.getElementById("tour-back").disabled = this.tourStep === 0;
    if (!dialog.open) dialog.showModal();
    return undefined;
  }

  refuse(text) {
    const notice = document.getElementById("notice");
    notice.hidden = !text;
    notice.querySelector("p").textContent = text;
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea, dialog, .editor")) return;
    const chapter = CHAPTERS[Number(event.key) - 1];
    if (chapter && this.chapter !== "draw") return void this.go(chapter);
    if (this.chapter !== "watch" && this.chapter !== "play") return;
    if (event.key === "f" || event.key === "F") document.getElementById("show-follow").click();
    else if (event.key === "+" || event.key === "=") this.arena.zoomBy(1.25);
    else if (event.key === "-" || event.key === "−") this.arena.zoomBy(0.8);
    else if (event.key === "r" || event.key === "R") this.showNow();
    else if (event.key === "[") this.members.step(-1);
    else if (event.key === "]") this.members.step(1);
    else if (event.key === " " && this.chapter === "watch" && !event.target.closest("button")) { event.preventDefault(); this.toggle(); }
  }

  // A generation is shown for a while; then the next is, if there is one.
  next() {
    const shown = this.shown;
    if (!shown || this.chapter !== "watch" || !this.arena.playing || this.members.pinned) return;
    const seconds = this.arena.seconds;
    const newer = this.watch.last && this.watch.last.generation !== shown.generation;
    // The very first falls at once.
    const lasts = shown.who !== "population" ? 10 : shown.number === 1 ? 3 : 5;
    if (seconds < lasts) return;
    if (!newer && this.watch.state === "paused" && document.getElementById("run-pace").value === "shown") this.connection.ask({ do: "step" });
    if (!newer && seconds < 4 * lasts) return;
    this.shown = null;
    this.showAgain();
  }

  start() {
    readTheme();
    loop.start();
    let last = performance.now();
    let counted = 0, since = last;
    const frame = stamp => {
      const seconds = Math.min((stamp - last) / 1000, 0.1);
      last = stamp;
      if (this.arena.visible) {
        this.arena.tick(Math.max(seconds, 0));
        this.arena.draw();
        this.net.draw();
        this.beside.draw(Math.max(seconds, 0));
        this.readouts.show(this.arena);
        this.next();
        counted += 1;
      }
      if (stamp - since > 1000) {
        document.body.dataset.frames = Math.round(counted * 1000 / (stamp - since));
        [counted, since] = [0, stamp];
      }
      this.watch.draw(stamp);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

new Studio().start();
