// Playing: arrow keys and jump for a champion that follows commands, pushes, another gravity, ground and friction.

const FASTEST = 1.5;

class Play {
  constructor(connection, arena) {
    Object.assign(this, { connection, arena });
    this.held = new Set();
    this.active = false;
    const get = name => document.getElementById(name);
    this.inputs = { gravity: get("play-gravity"), tilt: get("play-tilt"), friction: get("play-friction"), terrain: get("play-terrain") };
    for (const name of ["gravity", "tilt"]) this.inputs[name].addEventListener("input", () => this.tilt());
    for (const name of ["gravity", "tilt", "friction"]) this.inputs[name].addEventListener("input", () => this.tellWorld());
    this.tellWorld();
    for (const name of ["friction", "terrain"]) this.inputs[name].addEventListener("change", () => this.begin());
    get("play-box").addEventListener("click", () => this.putBox());
    // From the front: one along its way would hardly be seen.
    get("play-push").addEventListener("click", () => connection.ask({ do: "push", part: 0, velocity: [-2, 1] }));
    get("play-reset").addEventListener("click", () => this.begin());
    get("play-learned").addEventListener("click", () => { this.asLearned(); this.begin(); });
    // The keys are the champion's again, once a control was clicked or let go of.
    const giveBack = () => get("arena-canvas").focus({ preventScroll: true });
    get("play").addEventListener("click", ({ detail, target }) => { if (detail && target.matches("button")) giveBack(); });
    get("play").addEventListener("pointerup", ({ target }) => { if (target.matches("input")) giveBack(); });
    // Who goes through a list by keys is not done with its first change.
    let isByPointer = false;
    this.inputs.terrain.addEventListener("pointerdown", () => { isByPointer = true; });
    this.inputs.terrain.addEventListener("keydown", () => { isByPointer = false; });
    this.inputs.terrain.addEventListener("change", () => { if (isByPointer) giveBack(); });
    connection.on("opened", () => this.asLearned());
    document.addEventListener("keydown", event => this.key(event, true));
    document.addEventListener("keyup", event => this.key(event, false));
    // Nothing is told of what is let go of elsewhere.
    window.addEventListener("blur", () => [...this.held].forEach(key => this.hold(key, false)));
    for (const button of document.querySelectorAll("#touch button")) {
      const hold = on => event => { event.preventDefault(); this.hold(button.dataset.key, on); };
      button.addEventListener("pointerdown", hold(true));
      for (const end of ["pointerup", "pointercancel", "pointerleave"]) button.addEventListener(end, hold(false));
    }
    connection.on("catalogue", ({ terrains }) => {
      const options = terrains.map(({ name }) => { const option = element("option", name); option.value = name; return option; });
      const { terrain } = this.inputs;
      const chosen = terrain.value;
      terrain.replaceChildren(terrain.options[0], ...options);
      this.setTerrain(terrains.some(({ name }) => name === chosen) ? chosen : "");
    });
  }

  setTerrain(name) { this.inputs.terrain.value = name; }

  // The world as the champion has learned in it.
  asLearned() {
    const { gravity, tilt, friction } = this.inputs;
    [gravity.value, tilt.value, friction.value] = [1, 0, 1];
    this.setTerrain("");
    this.tellWorld();
  }

  tellWorld() {
    const { gravity, tilt, friction } = this.inputs;
    document.getElementById("play-gravity-value").textContent = `${fixed(Number(gravity.value), 2)} ×`;
    document.getElementById("play-tilt-value").textContent = `${fixed(Number(tilt.value), 0)}°`;
    document.getElementById("play-friction-value").textContent = `${fixed(Number(friction.value), 2)} ×`;
  }

  // The champion from the start, in the world that is set.
  begin() {
    this.held.clear();
    const { terrain, friction } = this.inputs;
    const request = { do: "show", who: "champion" };
    if (terrain.value) request.terrain = terrain.value;
    if (Number(friction.value) !== 1) request.friction = Number(friction.value);
    this.connection.ask(request);
  }

  enter(event) {
    if (!this.active) return;
    this.follows = event.follows_commands;
    document.getElementById("touch").hidden = !this.follows;
    document.getElementById("play-hint").textContent = (this.follows
      ? "Hold → to run, Shift to run faster, ↑ or the space bar to jump; let go to stand. "
      : "This champion runs by itself; one that was trained for “playing” does what you tell it. ")
      + "Click a part to push it.";
    if (this.follows) this.tell();
    if (Number(this.inputs.gravity.value) !== 1 || Number(this.inputs.tilt.value) !== 0) this.tilt();
  }

  key(event, down) {
    const key = event.key === "ArrowUp" ? " " : event.key;
    // What was held is let go of, whatever else is held by then.
    if (!down && this.held.has(key)) return this.hold(key, false);
    if (!this.active || event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea, dialog")) return;
    if (!["ArrowLeft", "ArrowRight", " ", "Shift"].includes(key)) return;
    if (key === " " && event.target.closest("button")) return;
    if (key !== "Shift") event.preventDefault();
    this.hold(key, down);
  }

  hold(key, down) {
    if (down) this.held.add(key); else this.held.delete(key);
    if (this.follows) this.tell();
  }

  tell() {
    const way = (this.held.has("ArrowRight") ? 1 : 0) - (this.held.has("ArrowLeft") ? 1 : 0);
    const speed = way * (this.held.has("Shift") ? FASTEST : 1);
    this.connection.ask({ do: "tell", speed, jump: this.held.has(" ") });
  }

  tilt() {
    this.connection.ask({ do: "tilt", angle: Number(this.inputs.tilt.value) * Math.PI / 180, factor: Number(this.inputs.gravity.value) });
  }

  putBox() {
    const { arena } = this;
    if (!arena.now) return;
    const size = arena.model.height * 0.12;
    this.connection.ask({ do: "put-box", x: arena.now.poses[0] + arena.model.width + 1, width: size * 3, height: size });
  }

  // A part that was clicked is pushed away from the pointer.
  push({ actor, part, side }) {
    if (!this.active || actor !== 0) return false;
    this.connection.ask({ do: "push", part, velocity: [side < 0 ? 2 : -2, 1] });
    return true;
  }
}
