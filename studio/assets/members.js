// The one of a generation that is followed: its rank, its species or family, its parents.

class Members {
  // `show`: shows the generation or the champion again.
  constructor(connection, arena, show) {
    Object.assign(this, { connection, arena, show });
    connection.on("opened", ({ unit }) => {
      this.unit = unit;
      this.pin(false);
    });
    const get = name => document.getElementById(name);
    this.panel = get("member");
    this.pinned = false;
    get("member-pin").addEventListener("click", () => this.pin(!this.pinned));
    get("member-parents").addEventListener("click", () => this.showParents());
    get("member-before").addEventListener("click", () => this.step(-1));
    get("member-after").addEventListener("click", () => this.step(1));
    get("show-colours").addEventListener("click", () => this.colour(!arena.coloured));
  }

  // Another generation is shown, or a champion.
  enter({ who, members, generation }) {
    Object.assign(this, { who, members, generation });
    document.getElementById("show-colours").hidden = who !== "population" || !members.some(({ group }) => group);
    this.tell();
  }

  // Nothing is shown any more.
  leave() {
    this.members = null;
    document.getElementById("show-colours").hidden = true;
    this.tell();
  }

  colour(on) {
    this.arena.coloured = on;
    document.getElementById("show-colours").setAttribute("aria-pressed", on);
  }

  // While one is pinned, its generation stays.
  pin(on) {
    this.pinned = on;
    document.getElementById("member-pin").setAttribute("aria-pressed", on);
  }

  step(by) {
    const count = this.members?.length || 0;
    if (count < 2) return;
    this.arena.followed = (this.arena.followed + by + count) % count;
    this.tell();
  }

  // The whole generation comes back by the same button.
  showParents() {
    if (this.who === "family") return this.show();
    this.pin(true);
    return this.connection.ask({ do: "show", who: "population", family_of: this.arena.followed });
  }

  tell() {
    const { who, members } = this;
    this.panel.hidden = who === "champion" || !members;
    if (this.panel.hidden) return;
    const place = Math.min(this.arena.followed, members.length - 1);
    document.getElementById("member-text").textContent = who === "family" ? this.familyText(place) : this.text(place);
    const parents = document.getElementById("member-parents");
    parents.textContent = who === "family" ? "Back to the generation" : "Show its parents";
    parents.disabled = who !== "family" && !members[place].descent?.parents.length;
    document.getElementById("member-pin").hidden = who === "family";
  }

  text(place) {
    const { fitness, group, descent } = this.members[place];
    const about = [`№ ${place + 1} of ${this.members.length}`, this.worth(fitness)];
    if (group?.species !== undefined) about.push(`species ${group.species}`);
    if (group?.family !== undefined) about.push(`family ${group.family}`);
    if (descent) about.push(this.descentText(descent));
    return about.join(" · ");
  }

  descentText({ how, parents }) {
    if (how === "new") return "new";
    if (!parents.length) return how === "copy" ? "kept unchanged" : "bred";
    const named = parents.map(({ rank, fitness }) => `№ ${rank} (${this.worth(fitness)})`).join(" and ");
    return how === "copy" ? `kept unchanged, № ${parents[0].rank} before` : `bred from ${named} of generation ${this.generation - 1}`;
  }

  familyText(place) {
    const name = place === 0 ? "The child, in its own colours" : this.members.length > 2 ? `Parent ${place}` : "Its parent";
    return `${name} · ${this.worth(this.members[place].fitness)}`;
  }

  worth(fitness) { return fitness === null ? "failed" : `fitness ${withUnit(fitness, this.unit)}`; }
}
