// The champion of another run, beside what is shown of the open one: on a ground of its own, at the same pace.

class Beside {
  // `showAgain`: shows what is beside it from the start.
  constructor(connection, arena, showAgain) {
    Object.assign(this, { connection, beside: arena, showAgain, against: document.getElementById("beside-against") });
    this.select = document.getElementById("show-beside");
    this.stage = document.getElementById("beside-stage");
    this.arena = new Arena(document.getElementById("beside-canvas"), connection, 1);
    this.readouts = new Readouts(document.getElementById("beside-readouts"));
    this.select.addEventListener("change", () => this.choose());
    // A run that is being trained may have a champion by now.
    for (const kind of ["focus", "pointerenter"]) this.select.addEventListener(kind, () => this.look());
    connection.on("catalogue", ({ runs }) => this.fill(runs));
    connection.on("beside", event => this.tell(event));
    connection.on("opened", () => this.end());
  }

  get run() { return this.select.value; }

  // All runs are read for it, so not again and again.
  look() {
    const now = performance.now();
    if (now - (this.lookedAt ?? -Infinity) < 5000) return;
    this.lookedAt = now;
    this.connection.ask({ do: "look" });
  }

  fill(runs) {
    const chosen = this.run;
    const names = runs.filter(({ fitness }) => fitness !== null).map(({ run }) => run);
    const shown = [...this.select.options].slice(1).map(option => option.value);
    if (names.join("/") === shown.join("/")) return;
    const options = names.map(run => { const option = element("option", run); option.value = run; return option; });
    this.select.replaceChildren(this.select.options[0], ...options);
    this.select.value = names.includes(chosen) ? chosen : "";
    if (chosen && !this.run) this.end();
  }

  choose() {
    this.stage.hidden = !this.run;
    if (this.run) this.showAgain(); else this.end();
  }

  // From the start, together with the other.
  show() {
    if (this.run && !this.stage.hidden) this.connection.ask({ do: "show", who: "champion", run: this.run, arena: 1 });
  }

  end() {
    if (!this.stage.hidden) this.connection.ask({ do: "leave", arena: 1 });
    this.stage.hidden = this.against.hidden = true;
    this.select.value = "";
    this.arena.leave();
  }

  // In other chapters it is not there.
  setVisible(on) {
    this.stage.hidden = !on || !this.run;
    this.against.hidden = this.stage.hidden || !this.against.children.length;
    this.select.closest("label").hidden = !on;
  }

  tell({ creature, movement, verdict }) {
    document.getElementById("beside-caption").textContent = `${creature} · ${movement}`;
    const known = verdict && verdict.usable !== null;
    const text = document.getElementById("beside-verdict");
    text.textContent = !known ? "Not judged yet" : verdict.usable ? "Usable" : "Not usable yet";
    // Below: they would hide the creature.
    this.against.replaceChildren(...(known ? verdict.against : []).map(reason => element("li", reason)));
    this.against.hidden = this.stage.hidden || !this.against.children.length;
    text.className = `verdict ${!known ? "verdict-none" : verdict.usable ? "verdict-good" : "verdict-bad"}`;
  }

  draw(seconds) {
    const { arena, beside } = this;
    if (this.stage.hidden || !arena.visible) return;
    Object.assign(arena, { playing: beside.playing, speed: beside.speed, zoom: beside.zoom });
    arena.tick(seconds);
    arena.draw();
    this.readouts.show(arena);
  }
}

// How far the followed creature has come, and what it is told, if it does what it is told.
class Readouts {
  constructor(list) {
    this.numbers = {};
    for (const [name, unit] of [["time", "s"], ["distance", "m"], ["height", "m"], ["told", "lengths/s"]]) {
      const group = element("div");
      const value = element("dd");
      this.numbers[name] = element("span");
      value.append(this.numbers[name], `\u00a0${unit}`);
      group.append(element("dt", name), value);
      list.append(group);
    }
    this.told = list.lastElementChild;
    this.clear();
  }

  clear() {
    for (const number of Object.values(this.numbers)) number.textContent = "–";
    this.told.hidden = true;
    this.arenaNumber = null;
  }

  // Ten times a second: nobody reads faster, and text takes longer to draw than a creature.
  show(arena) {
    const tenth = Math.floor(arena.seconds * 10 / Math.max(arena.speed, 1));
    if (!arena.now || (this.arenaNumber === arena.event.number && this.tenth === tenth)) return;
    Object.assign(this, { arenaNumber: arena.event.number, tenth });
    const at = Math.min(arena.followed, arena.now.actors - 1) * arena.now.size;
    this.numbers.time.textContent = fixed(arena.seconds, 1);
    this.numbers.distance.textContent = fixed(arena.now.poses[at] - arena.origin, 2);
    this.numbers.height.textContent = fixed(arena.now.poses[at + 1], 2);
    this.told.hidden = !arena.event.follows_commands;
    this.numbers.told.textContent = `${arena.now.jump ? "↑ " : ""}${fixed(arena.now.speed, 1)}`;
  }
}
