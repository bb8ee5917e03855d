// The net with live activations, in time with the replay: edges on a canvas, nodes and names in SVG above it.

class NetworkView {
  constructor(network, activations, replay, clock) {
    Object.assign(this, { replay, clock });
    this.layers = network.layers.map(layer => layer.map(neuron => typeof neuron === "string" ? { name: neuron } : neuron));
    this.weights = network.weights;
    this.activations = activations;
    this.starts = [];
    this.total = 0;
    for (const layer of this.layers) { this.starts.push(this.total); this.total += layer.length; }
    this.peaks = this.findPeaks();
    this.heaviest = Math.max(1e-6, ...this.weights.map(matrix => Math.max(...matrix.map(row => Math.max(...row.map(Math.abs))))));
    this.place = document.getElementById("network-net");
    this.note = document.getElementById("network-note");
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("aria-hidden", "true");
    this.hovered = null;
    this.visible = true;
    this.stale = true;
    this.place.append(this.canvas);
    new ResizeObserver(() => this.layout()).observe(this.place);
    new IntersectionObserver(entries => { this.visible = entries[entries.length - 1].isIntersecting; }).observe(this.place);
    this.layout();
    this.buildLegend();
  }

  // The largest activation of each layer: what full colour stands for.
  findPeaks() {
    return this.layers.map((layer, l) => {
      let peak = 0.1;
      if (!this.activations) return 1;
      const { values, frames } = this.activations;
      for (let frame = 0; frame < frames; frame++) {
        const from = frame * this.total + this.starts[l];
        for (let i = from; i < from + layer.length; i++) peak = Math.max(peak, Math.abs(values[i]));
      }
      return peak;
    });
  }

  value(layer, index) {
    return this.activations ? this.activations.values[this.frameStart + this.starts[layer] + index] : 0;
  }

  layout() {
    const width = Math.round(this.place.clientWidth);
    if (width < 40 || width === this.width) return;
    this.width = width;
    const narrow = width < 560;
    const most = Math.max(...this.layers.map(layer => layer.length));
    const gap = narrow ? 29 : Math.max(25, Math.min(40, 400 / most));
    const height = Math.max(most * gap + 12, 180);
    const gutter = narrow ? Math.round(width * 0.30) : Math.min(220, Math.round(width * 0.22));
    this.radius = narrow ? 7 : Math.min(11, gap * 0.32);
    const left = gutter + this.radius;
    const right = width - gutter - this.radius;
    this.nodes = this.layers.map((layer, l) => layer.map((neuron, i) => ({
      x: left + (right - left) * l / Math.max(this.layers.length - 1, 1),
      y: height / 2 + (i - (layer.length - 1) / 2) * (l > 0 && l < this.layers.length - 1 ? Math.min(gap * 1.9, height / (layer.length + 0.5))
        : Math.min(gap * 1.5, height / (layer.length + 0.2))),
    })));
    this.ratio = Math.min(window.devicePixelRatio || 1, 3);
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
    this.canvas.style.height = this.place.style.height = `${height}px`;
    this.drawNodes(width, height, gutter, narrow);
    this.stale = true;
  }

  drawNodes(width, height, gutter, narrow) {
    this.root?.remove();
    this.root = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "The net, neuron by neuron" });
    this.place.append(this.root);
    const size = narrow ? 11 : 13;
    const ruler = document.createElement("canvas").getContext("2d");
    ruler.font = `${size}px ${theme.font}`;
    const room = gutter - 10;
    this.circles = this.layers.map((layer, l) => layer.map((neuron, i) => {
      const node = this.nodes[l][i];
      const group = svg("g", { class: "node", tabindex: "0", role: "img", "aria-label": neuron.name }, this.root);
      const first = l === 0;
      const last = l === this.layers.length - 1;
      const area = first ? [0, node.x + 14] : last ? [node.x - 14, width] : [node.x - 16, node.x + 16];
      svg("rect", { x: area[0], width: area[1] - area[0], y: node.y - 12, height: 24, fill: "transparent" }, group);
      const circle = svg("circle", { cx: node.x, cy: node.y, r: this.radius }, group);
      if (first || last) {
        const x = first ? node.x - this.radius - 7 : node.x + this.radius + 7;
        const lines = wrapWords(ruler, neuron.name, room, 2);
        const text = svg("text", { "text-anchor": first ? "end" : "start", "font-size": size }, group);
        lines.forEach((line, k) => {
          const span = svg("tspan", { x, y: node.y + size * 0.35 + (k - (lines.length - 1) / 2) * (size + 1) }, text);
          span.textContent = line;
        });
        const unit = neuron.unit && ` ${neuron.unit}`;
        if (unit && ruler.measureText(lines[lines.length - 1] + unit).width < room) {
          svg("tspan", { class: "unit" }, text).textContent = unit;
        }
      }
      const enter = () => { this.hovered = [l, i]; this.stale = true; };
      const leave = () => { this.hovered = null; this.stale = true; };
      group.addEventListener("pointerenter", enter);
      group.addEventListener("pointerleave", leave);
      group.addEventListener("focus", enter);
      group.addEventListener("blur", leave);
      return circle;
    }));
  }

  draw() {
    if (this.activations) {
      const { frames } = this.activations;
      const share = this.replay.frames > 1 ? frameAt(this.replay, this.clock.now) / (this.replay.frames - 1) : 0;
      const frame = frames === this.replay.frames ? frameAt(this.replay, this.clock.now) : Math.round(share * (frames - 1));
      this.frameStart = frame * this.total;
    }
    this.drawEdges();
    this.layers.forEach((layer, l) => layer.forEach((_, i) => {
      const circle = this.circles[l][i];
      circle.setAttribute("fill", this.activations ? diverging(this.value(l, i) / this.peaks[l]) : theme.zero);
      circle.classList.toggle("lit", this.hovered !== null && this.hovered[0] === l && this.hovered[1] === i);
    }));
    this.describe();
  }

  // Width shows the weight; the edge brightens with the signal it carries.
  drawEdges() {
    const c = this.canvas.getContext("2d");
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.canvas.height);
    const crowd = Math.min(1, Math.sqrt(120 / Math.max(...this.weights.map(m => m.length * (m[0]?.length || 1)))));
    this.weights.forEach((matrix, l) => matrix.forEach((row, target) => {
      for (let source = 0; source < this.layers[l].length; source++) {
        const weight = row[source] / this.heaviest;
        const size = Math.abs(weight);
        const signal = this.activations ? Math.min(1, Math.abs(this.value(l, source)) / this.peaks[l]) : 0.6;
        let alpha = (0.06 + 0.74 * size * (0.25 + 0.75 * signal)) * (0.5 + 0.5 * crowd);
        if (this.hovered) {
          const [hl, hi] = this.hovered;
          const joined = (hl === l && hi === source) || (hl === l + 1 && hi === target);
          alpha = joined ? 0.35 + 0.65 * size : 0.03;
        }
        const a = this.nodes[l][source];
        const b = this.nodes[l + 1][target];
        c.globalAlpha = alpha;
        c.strokeStyle = weight < 0 ? theme.minus : theme.plus;
        c.lineWidth = 0.5 + 3.2 * size;
        c.beginPath();
        c.moveTo(a.x, a.y);
        const bend = (b.x - a.x) * 0.4;
        c.bezierCurveTo(a.x + bend, a.y, b.x - bend, b.y, b.x, b.y);
        c.stroke();
      }
    }));
    c.globalAlpha = 1;
  }

  // One line about the neuron pointed at: its value and what weighs most.
  describe() {
    let text = "Point at a neuron to see its value and its connections.";
    if (this.hovered) {
      const [l, i] = this.hovered;
      const neuron = this.layers[l][i];
      text = this.activations ? `${neuron.name}: ${fixed(this.value(l, i), 2)}` : neuron.name;
      if (l > 0) {
        const row = this.weights[l - 1][i];
        const sources = this.layers[l - 1].map((source, k) => [source.name, row[k]]);
        text += ` · in: ${strongest(sources)}`;
        if (row.length > sources.length) text += ` · bias ${fixed(row[row.length - 1], 2)}`;
      }
      if (l < this.layers.length - 1) {
        text += ` · out: ${strongest(this.layers[l + 1].map((target, k) => [target.name, this.weights[l][k][i]]))}`;
      }
    }
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  buildLegend() {
    const legend = document.getElementById("network-legend");
    legend.innerHTML = (this.activations
      ? `<span>activation: negative <i class="ramp"></i> positive</span>` : "")
      + `<span><i class="edge edge-minus"></i> negative weight</span><span><i class="edge edge-plus"></i> positive weight</span>`;
  }
}

function diverging(share) {
  const size = Math.min(Math.abs(share), 1) ** 0.8;
  return mix(theme.zero, share < 0 ? theme.minus : theme.plus, size);
}

function strongest(pairs) {
  return pairs.sort((a, b) => Math.abs(b[1]) - Math.abs(a[1])).slice(0, 3)
    .map(([name, weight]) => `${name} ${weight > 0 ? "+" : ""}${fixed(weight, 2)}`).join(", ");
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
    stage.scale = fittingScale(stage, model, this.top, 0.66);
    stage.centreX = middleX(model, this.pose);
    stage.raise = raiseFor(stage, model, this.pose);
    stage.drawScenery(replay.startX, { small: true });
    drawShadow(stage, model, this.pose);
    if (this.contacts) drawContacts(stage, model, this.pose, this.contacts[frameAt(replay, this.clock.now)]);
    drawCreature(stage, model, this.pose);
  }
}
