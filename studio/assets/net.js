// The net of the first creature, at work: the drawing of reports, fed with what it does now.

class LiveNet {
  constructor(arena) {
    this.arena = arena;
    this.details = document.getElementById("network");
    this.details.addEventListener("toggle", () => this.build());
  }

  enter({ network }) {
    this.network = network;
    this.view?.close();
    this.view = null;
    this.build();
  }

  // Only where it is looked at.
  build() {
    if (!this.details.open || !this.network || this.view) return;
    const { network } = this;
    document.getElementById("network-net").replaceChildren();
    // Two moments, now and the step before: what goes back carries what was before.
    this.values = new Float32Array(2 * network.nodes.length);
    const moments = { frames: 2, timeStep: 1 };
    this.view = new NetworkView(network, { frames: 2, values: this.values }, moments, { now: 1 });
    this.step = null;
  }

  draw() {
    const { view, values } = this;
    const frame = this.arena.now;
    const nodes = values ? values.length / 2 : 0;
    if (!view || !view.visible || !frame || frame.activations.length !== nodes || frame.step === this.step) return;
    this.step = frame.step;
    values.copyWithin(0, nodes);
    values.set(frame.activations, nodes);
    frame.activations.forEach((value, node) => {
      const kind = view.kinds[node];
      view.peaks[kind] = Math.max(view.peaks[kind], Math.abs(value));
    });
    view.draw();
  }
}
