// The net with live activations, in time with the replay: edges on a canvas, nodes and names in SVG above it.

class NetworkView {
  constructor(network, activations, replay, clock) {
    Object.assign(this, { network, activations, replay, clock });
    this.total = network.nodes.length;
    this.kinds = this.findKinds();
    this.peaks = this.findPeaks();
    this.heaviest = network.connections.reduce((most, [, , weight]) => Math.max(most, Math.abs(weight)), 1e-6);
    // The heaviest last, so that they lie on top.
    const size = index => Math.abs(network.connections[index][2]);
    this.order = network.connections.map((_, index) => index).sort((a, b) => size(a) - size(b));
    this.place = document.getElementById("network-net");
    this.note = document.getElementById("network-note");
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("aria-hidden", "true");
    this.hovered = null;
    this.visible = true;
    this.stale = true;
    this.frame = 0;
    this.place.append(this.canvas);
    this.observers = [
      new ResizeObserver(() => this.layout()),
      new IntersectionObserver(entries => { this.visible = entries[entries.length - 1].isIntersecting; }),
    ];
    this.observers.forEach(observer => observer.observe(this.place));
    this.layout();
    this.buildLegend();
  }

  // Another net takes its place.
  close() {
    this.observers.forEach(observer => observer.disconnect());
  }

  findKinds() {
    const kinds = this.network.nodes.map((_, node) => node < this.network.inputs ? "input" : "hidden");
    for (const node of this.network.outputs) kinds[node] = "output";
    return kinds;
  }

  // The largest activation of all inputs, hidden neurons and outputs: what full colour stands for.
  findPeaks() {
    const peaks = { input: 0.1, hidden: 0.1, output: 0.1 };
    this.activations?.values.forEach((value, i) => {
      const kind = this.kinds[i % this.total];
      peaks[kind] = Math.max(peaks[kind], Math.abs(value));
    });
    return peaks;
  }

  // What a node put out, in this step or some steps before; before the first step nothing.
  value(node, before = 0) {
    const frame = this.frame - before;
    return this.activations && frame >= 0 ? this.activations.values[frame * this.total + node] : 0;
  }

  layout() {
    const width = Math.round(this.place.clientWidth);
    if (width < 40 || width === this.width) return;
    this.width = width;
    this.plan = layOutNetwork(this.network, width);
    const { height } = this.plan;
    this.ratio = Math.min(window.devicePixelRatio || 1, 3);
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
    this.canvas.style.height = this.place.style.height = `${height}px`;
    this.drawNodes(width);
    this.stale = true;
  }

  drawNodes(width) {
    const { narrow, height, gutter, radius, nodes } = this.plan;
    this.root?.remove();
    this.root = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "The net, neuron by neuron" });
    this.place.append(this.root);
    const size = narrow ? 11 : 13;
    const ruler = document.createElement("canvas").getContext("2d");
    ruler.font = `${size}px ${theme.font}`;
    const room = gutter - 10;
    const joined = new Set(this.network.connections.flatMap(([source, target]) => [source, target]));
    this.circles = this.network.nodes.map((neuron, node) => {
      const { x, y } = nodes[node];
      const kind = this.kinds[node];
      const group = svg("g", { class: joined.has(node) ? "node" : "node loose", tabindex: "0", role: "img", "aria-label": neuron.name }, this.root);
      const reach = radius + 5;
      const area = kind === "input" ? [0, x + reach] : kind === "output" ? [x - reach, width] : [x - reach, x + reach];
      svg("rect", { x: area[0], width: area[1] - area[0], y: y - reach, height: 2 * reach, fill: "transparent" }, group);
      const circle = svg("circle", { cx: x, cy: y, r: radius }, group);
      if (kind !== "hidden") {
        const textX = kind === "input" ? x - radius - 7 : x + radius + 7;
        const lines = wrapWords(ruler, neuron.name, room, 2);
        const text = svg("text", { "text-anchor": kind === "input" ? "end" : "start", "font-size": size }, group);
        lines.forEach((line, k) => {
          const span = svg("tspan", { x: textX, y: y + size * 0.35 + (k - (lines.length - 1) / 2) * (size + 1) }, text);
          span.textContent = line;
        });
        const unit = neuron.unit && ` ${neuron.unit}`;
        if (unit && ruler.measureText(lines[lines.length - 1] + unit).width < room) {
          svg("tspan", { class: "unit" }, text).textContent = unit;
        }
      }
      const enter = () => { this.hovered = node; this.stale = true; };
      const leave = () => { this.hovered = null; this.stale = true; };
      group.addEventListener("pointerenter", enter);
      group.addEventListener("pointerleave", leave);
      group.addEventListener("focus", enter);
      group.addEventListener("blur", leave);
      return circle;
    });
  }

  draw() {
    if (this.activations) {
      const { frames } = this.activations;
      const share = this.replay.frames > 1 ? frameAt(this.replay, this.clock.now) / (this.replay.frames - 1) : 0;
      this.frame = frames === this.replay.frames ? frameAt(this.replay, this.clock.now) : Math.round(share * (frames - 1));
    }
    this.drawEdges();
    this.circles.forEach((circle, node) => {
      circle.setAttribute("fill", this.activations ? diverging(this.value(node) / this.peaks[this.kinds[node]]) : theme.zero);
      circle.classList.toggle("lit", this.hovered === node);
    });
    this.describe();
  }

  // Width shows the weight; the edge brightens with the signal it carries, which on a way back is one step old.
  drawEdges() {
    const c = this.canvas.getContext("2d");
    const { connections } = this.network;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.plan.height);
    const crowd = Math.min(1, Math.sqrt(120 / Math.max(connections.length / (this.plan.columns.length - 1), 1)));
    const faintest = 0.06 + 0.1 * Math.max(0, 1 - connections.length / 100);
    for (const index of this.order) {
      const [source, target, weight] = connections[index];
      const back = source >= target;
      const size = Math.abs(weight) / this.heaviest;
      const signal = this.activations ? Math.min(1, Math.abs(this.value(source, back ? 1 : 0)) / this.peaks[this.kinds[source]]) : 0.6;
      // A way back is always in sight: it is what makes the net remember.
      let alpha = ((back ? 0.25 : faintest) + 0.74 * size * (0.25 + 0.75 * signal)) * (0.5 + 0.5 * crowd);
      if (this.hovered !== null) alpha = source === this.hovered || target === this.hovered ? 0.35 + 0.65 * size : 0.03;
      c.globalAlpha = Math.min(alpha, 1);
      c.strokeStyle = c.fillStyle = weight < 0 ? theme.minus : theme.plus;
      c.lineWidth = (back ? 1 : 0.5) + 3.2 * size;
      c.setLineDash(back ? [5, 4] : []);
      const { points, arrow } = this.plan.curves[index];
      c.beginPath();
      c.moveTo(points[0], points[1]);
      c.bezierCurveTo(...points.slice(2));
      c.stroke();
      if (arrow) drawArrow(c, points, 4 + 1.6 * c.lineWidth);
    }
    c.setLineDash([]);
    c.globalAlpha = 1;
  }

  // One line about the neuron pointed at: its value, what makes it, and what weighs most.
  describe() {
    let text = "Point at a neuron to see its value and its connections.";
    if (this.hovered !== null) {
      const { nodes, connections } = this.network;
      const node = this.hovered;
      const { name, activation, bias } = nodes[node];
      const far = (other, back) => (other === node ? "itself" : nodes[other].name) + (back ? " a step before" : "");
      const into = connections.filter(([, target]) => target === node).map(([source, target, weight]) => [far(source, source >= target), weight]);
      const out = connections.filter(([source, target]) => source === node && target !== node)
        .map(([source, target, weight]) => [nodes[target].name + (source >= target ? " a step later" : ""), weight]);
      const parts = [this.activations ? `${name}: ${fixed(this.value(node), 2)}` : name];
      if (activation) parts.push(activation);
      if (into.length) parts.push(`in: ${strongest(into)}`);
      if (bias !== undefined) parts.push(`bias ${fixed(bias, 2)}`);
      if (out.length) parts.push(`out: ${strongest(out)}`);
      if (!into.length && !out.length) parts.push("not connected");
      text = parts.join(" · ");
    }
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  buildLegend() {
    const legend = document.getElementById("network-legend");
    const back = this.network.connections.some(([source, target]) => source >= target);
    legend.innerHTML = (this.activations
      ? `<span>activation: negative <i class="ramp"></i> positive</span>` : "")
      + `<span><i class="edge edge-minus"></i> negative weight</span><span><i class="edge edge-plus"></i> positive weight</span>`
      + (back ? `<span><i class="edge edge-back"></i> from the step before</span>` : "");
  }
}

// An arrow's head at the end of a curve.
function drawArrow(c, points, length) {
  const [x, y] = points.slice(6);
  const angle = Math.atan2(y - points[5], x - points[4]);
  c.beginPath();
  c.moveTo(x, y);
  for (const turn of [0.42, -0.42]) c.lineTo(x - length * Math.cos(angle + turn), y - length * Math.sin(angle + turn));
  c.fill();
}

function diverging(share) {
  const size = Math.min(Math.abs(share), 1) ** 0.8;
  return mix(theme.zero, share < 0 ? theme.minus : theme.plus, size);
}

function strongest(pairs) {
  const named = pairs.sort((a, b) => Math.abs(b[1]) - Math.abs(a[1])).slice(0, 3)
    .map(([name, weight]) => `${name} ${weight > 0 ? "+" : ""}${fixed(weight, 2)}`).join(", ");
  return pairs.length > 3 ? `${named} and ${count(pairs.length - 3, "other", "others")}` : named;
}

// Breaks a name into at most `most` lines that fit, the last one cut short if need be.
function wrapWords(ruler, text, room, most) {
  const lines = [""];
  for (const word of text.split(" ")) {
    const tried = lines[lines.length - 1] ? `${lines[lines.length - 1]} ${word}` : word;
    if (ruler.measureText(tried).width <= room || !lines[lines.length - 1] || lines.length === most) lines[lines.length - 1] = tried;
    else lines.push(word);
  }
  return lines.map(line => {
    if (ruler.measureText(line).width <= room) return line;
    while (line.length > 2 && ruler.measureText(line + "…").width > room) line = line.slice(0, -1);
    return line.trimEnd() + "…";
  });
}

// The champion once more, on a low stage beside its net.
class NetworkStage {
  constructor(model, replay, contacts, clock) {
    Object.assign(this, { model, replay, contacts, clock });
    this.stage = new Stage(document.getElementById("network-canvas"), 0.82);
    this.pose = new Float32Array(replay.size);
    this.top = highestCentre(replay);
  }

  get visible() { return this.stage.visible; }
  get stale() { return this.stage.stale; }
  set stale(value) { this.stage.stale = value; }

  draw() {
    const { stage, replay, model } = this;
    poseAt(replay, this.clock.now, this.pose);
    stage.ground = replay.ground;
    stage.scale = fittingScale(stage, model, this.top, 0.66);
    stage.centreX = middleX(model, this.pose);
    stage.raise = raiseFor(stage, model, this.pose);
    stage.drawScenery(replay.startX, { small: true });
    drawShadow(stage, model, this.pose);
    if (this.contacts) drawContacts(stage, model, this.pose, this.contacts[frameAt(replay, this.clock.now)]);
    drawCreature(stage, model, this.pose);
  }
}
