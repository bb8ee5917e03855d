// The arena: creatures on the ground at once, the first solid, the others half transparent. The page asks for every
// step that it shows, so its own clock makes pause, slow motion and time lapse.

const HEADER = 5;

class Arena {
  // `place`: which of the studio's two arenas it shows.
  constructor(canvas, connection, place = 0) {
    this.connection = connection;
    this.place = place;
    this.stage = new Stage(canvas, 0.8);
    this.speed = 1;
    this.playing = !reducedMotion.matches;
    this.follow = true;
    this.zoom = 1;
    this.followed = 0;
    this.coloured = true;
    this.onEnter = () => {};
    this.onStep = () => {};
    connection.on("arena", event => { if (event.arena === this.place) this.enter(event); });
    if (this.place === 0) connection.on("ground", event => { this.stage.ground = decodeGround(event.ground); });
    connection.onFrame(buffer => this.take(buffer));
    this.listenToPointer();
  }

  get visible() { return this.stage.visible && this.model !== undefined; }

  // Nothing is shown any more.
  leave() { this.event = this.model = this.now = undefined; this.key = null; }

  enter(event) {
    const key = JSON.stringify(event.creature);
    if (key !== this.key) {
      this.model = makeModel(event.creature);
      this.crowd = new Crowd(this.model, event.creature);
      this.top = 0;
      this.key = key;
    }
    this.event = event;
    this.tints = event.members.map(({ group }) => group ? tintOf(group.species ?? group.family) : undefined);
    this.stage.ground = decodeGround(event.ground);
    this.time = 0;
    this.asked = 0;
    this.before = this.now = null;
    this.followed = 0;
    this.origin = null;
    this.pending = true;
    this.connection.ask({ do: "advance", steps: 0, arena: this.place, number: event.number });
    this.onEnter(event);
  }

  // A frame, as the studio writes it: see `Arena::frame`.
  take(buffer) {
    const [number, step, actors, parts, nodes] = new Uint32Array(buffer, 0, HEADER);
    if (!this.event || number !== this.event.number) return;
    const numbers = new Float32Array(buffer, HEADER * 4);
    const size = parts * 3;
    const rest = numbers.subarray(actors * size);
    const frame = {
      step, actors, parts, size, poses: numbers.subarray(0, actors * size),
      activations: rest.subarray(0, nodes), speed: rest[nodes], jump: rest[nodes + 1] > 0, contacts: rest.subarray(nodes + 2),
    };
    this.before = this.now && step > this.now.step ? this.now : frame;
    this.now = frame;
    this.pending = false;
    this.origin ??= frame.poses[0];
    // Angles come out continuous, whatever turn they wrapped at.
    const turn = 2 * Math.PI;
    for (let i = 2; i < frame.poses.length; i += 3) {
      frame.poses[i] -= turn * Math.round((frame.poses[i] - this.before.poses[i]) / turn);
    }
    for (let i = 1; i < size; i += 3) this.top = Math.max(this.top, frame.poses[i] - surfaceAt(this.stage.ground, frame.poses[i - 1]));
    this.onStep(frame);
  }

  get seconds() { return this.time ?? 0; }

  tick(seconds) {
    if (!this.event || !this.now) return;
    if (this.playing) this.time += seconds * this.speed;
    if (this.pending) return;
    const wanted = Math.floor(this.time / this.event.time_step) + 1;
    const steps = Math.min(wanted - this.asked, 60);
    if (steps <= 0) return;
    this.asked += steps;
    // What cannot be kept up with is let go.
    this.time = Math.min(this.time, this.asked * this.event.time_step);
    this.pending = true;
    this.connection.ask({ do: "advance", steps, arena: this.place, number: this.event.number });
  }

  // The pose of a creature between the last two frames.
  pose(index) {
    const { before, now } = this;
    const span = now.step - before.step;
    const share = span > 0 ? Math.min(Math.max((this.time / this.event.time_step - before.step) / span, 0), 1) : 1;
    const from = index * now.size;
    this.blend ??= new Float32Array(now.size);
    if (this.blend.length !== now.size) this.blend = new Float32Array(now.size);
    for (let i = 0; i < now.size; i++) {
      this.blend[i] = before.poses[from + i] + (now.poses[from + i] - before.poses[from + i]) * share;
    }
    return this.blend;
  }

  draw() {
    const { stage, model, now } = this;
    if (!now) return;
    const first = Math.min(this.followed, now.actors - 1);
    stage.scale = fittingScale(stage, model, this.top, 0.6, 40) * this.zoom;
    const lead = this.pose(first);
    if (this.follow) stage.centreX = middleX(model, lead) + stage.width * 0.06 / stage.scale;
    stage.raise = raiseFor(stage, model, lead);
    stage.drawScenery(this.origin, { small: stage.width < 560 });
    this.crowd.begin(stage, now.actors);
    for (let index = now.actors - 1; index >= 0; index--) {
      if (index === first) continue;
      const from = index * now.size;
      const x = stage.screenX(now.poses[from]);
      if (x < -200 || x > stage.width + 200) continue;
      this.crowd.draw(stage, this.pose(index), this.coloured ? this.tints[index] : undefined, now.actors <= 3);
    }
    this.crowd.end(stage);
    const pose = this.pose(first);
    drawShadow(stage, model, pose);
    drawCreature(stage, model, pose);
  }

  listenToPointer() {
    const canvas = this.stage.canvas;
    let from = null;
    canvas.addEventListener("pointerdown", event => {
      from = { x: event.clientX, centre: this.stage.centreX, moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!from) return;
      const shift = event.clientX - from.x;
      if (!from.moved && Math.abs(shift) < 5) return;
      from.moved = true;
      this.follow = false;
      this.onFollow?.();
      this.stage.centreX = from.centre - shift / this.stage.scale;
    });
    canvas.addEventListener("pointerup", event => {
      if (from && !from.moved) this.click(event.offsetX, event.offsetY);
      from = null;
    });
    canvas.addEventListener("pointercancel", () => { from = null; });
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY * 0.002));
    }, { passive: false });
  }

  zoomBy(factor) { this.zoom = Math.min(Math.max(this.zoom * factor, 0.1), 6); }

  // A click on a creature follows it; in play it pushes the part that was hit.
  click(x, y) {
    const hit = this.hit(x, y);
    if (!hit) return;
    if (this.onHit?.(hit)) return;
    this.followed = hit.actor;
    this.follow = true;
    this.onFollow?.();
  }

  hit(x, y) {
    const { stage, model, now } = this;
    if (!now) return null;
    let found = null;
    for (let actor = 0; actor < now.actors; actor++) {
      for (const part of model.parts) {
        const at = actor * now.size + part.index * 3;
        const [px, py] = [stage.screenX(now.poses[at]), stage.screenY(now.poses[at + 1])];
        const distance = Math.hypot(px - x, py - y) - part.reach * stage.scale;
        if (distance < 10 && (!found || distance < found.distance)) found = { actor, part: part.index, distance, side: x - px };
      }
    }
    return found;
  }
}
