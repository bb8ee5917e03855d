// The stage: a canvas that is sharp on any screen, its camera, and the scenery (sky, hills, ground with a mark every
// metre, start line). Also the colours of the page, for everything that is drawn rather than laid out.

const theme = {};

// Reads the colours from the style sheet; called again when the colour scheme changes.
function readTheme() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "quiet", "line", "paper", "accent", "sky", "sky-low", "hill", "hill-near", "ground",
    "ground-deep", "ground-line", "mark", "shadow", "rim", "glow", "plus", "minus", "zero"]) {
    theme[name] = style.getPropertyValue("--" + name).trim();
  }
  theme.dark = style.getPropertyValue("--dark").trim() === "1";
  theme.font = style.getPropertyValue("font-family");
}

function parseColour(text) {
  const hex = /^#([0-9a-f]{3}|[0-9a-f]{6})$/i.exec(text || "");
  if (!hex) return [128, 128, 128];
  const digits = hex[1].length === 3 ? hex[1].replace(/./g, "$&$&") : hex[1];
  return [0, 2, 4].map(i => parseInt(digits.slice(i, i + 2), 16));
}

// A blend of two colours: 0 is all `a`, 1 all `b`.
function mix(a, b, share) {
  const from = parseColour(a);
  const to = parseColour(b);
  return "#" + from.map((v, i) => Math.round(v + (to[i] - v) * share).toString(16).padStart(2, "0")).join("");
}

class Stage {
  // `groundShare`: how far down the canvas the ground lies. `scenery`: whether all of the canvas is painted, which makes it opaque: a
  // browser without a graphics card draws and shows that in half of the time.
  constructor(canvas, groundShare = 0.78, { scenery = true } = {}) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: !scenery });
    this.groundShare = groundShare;
    this.width = this.height = 0;
    // The observer says when it is.
    this.visible = false;
    this.stale = true;
    this.centreX = 0;
    this.raise = 0;
    this.ground = null;
    this.scale = 100;
    const fit = () => {
      const box = canvas.getBoundingClientRect();
      const ratio = Math.min(window.devicePixelRatio || 1, 3);
      this.width = Math.max(box.width, 1);
      this.height = Math.max(box.height, 1);
      this.ratio = ratio;
      const w = Math.round(this.width * ratio);
      const h = Math.round(this.height * ratio);
      if (canvas.width !== w || canvas.height !== h) {
        canvas.width = w;
        canvas.height = h;
        this.blank();
      }
      this.stale = true;
    };
    new ResizeObserver(fit).observe(canvas);
    new IntersectionObserver(entries => {
      this.visible = entries[entries.length - 1].isIntersecting;
    }, { rootMargin: "80px" }).observe(canvas);
    fit();
  }

  // Nothing is shown: of an opaque canvas that would be black.
  blank() {
    this.context.resetTransform();
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (this.context.getContextAttributes().alpha) return;
    this.context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--sky").trim();
    this.context.fillRect(0, 0, this.canvas.width, this.canvas.height);
  }

  // Where ground at height 0 is.
  get groundY() { return this.height * this.groundShare + this.raise * this.scale; }
  screenX(x) { return this.width / 2 + (x - this.centreX) * this.scale; }
  screenY(y) { return this.groundY - y * this.scale; }
  worldX(pixel) { return this.centreX + (pixel - this.width / 2) / this.scale; }

  // Drawing in page pixels.
  resetTransform() { this.context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0); }

  // Drawing in a part's own coordinates, in metres.
  partTransform(x, y, angle) {
    const s = this.scale * this.ratio;
    const cos = Math.cos(angle) * s;
    const sin = Math.sin(angle) * s;
    this.context.setTransform(cos, -sin, -sin, -cos, this.screenX(x) * this.ratio, this.screenY(y) * this.ratio);
  }

  // Sky, hills and ground. Distances are counted from `origin`, where the torso stood at the start; `plain`: without hills,
  // `bare`: without marks either.
  drawScenery(origin, options = {}) {
    const c = this.context;
    const { width, groundY } = this;
    this.resetTransform();
    this.drawBackdrop();
    if (this.ground?.water) {
      this.drawWater(origin, options.small);
      return;
    }
    if (!options.plain) {
      this.drawHills(origin, 0.12, 0.30, 9, theme.hill);
      this.drawHills(origin, 0.30, 0.15, 5, theme["hill-near"]);
    }
    if (this.ground) {
      drawGround(this, this.ground, this.groundGradient(c, this.height * this.groundShare));
      if (!options.bare) this.drawMarks(origin, options.small);
    } else {
      if (!options.bare) this.drawMarks(origin, options.small);
      c.fillStyle = theme["ground-line"];
      c.fillRect(0, groundY - 0.5, width, 1.5);
    }
    if (!options.bare) this.drawStart(origin, options.small);
  }

  // Sky and level ground. To copy them takes less than a gradient does: while the ground stays where it is, they are painted once.
  drawBackdrop() {
    const key = [this.canvas.width, this.canvas.height, this.ground ? "uneven" : this.groundY, theme.sky, theme["sky-low"], theme.ground].join();
    if (key !== this.backdropKey || !window.OffscreenCanvas) {
      this.backdropKey = key;
      this.backdrop?.close();
      this.backdrop = null;
      return this.paintBackdrop(this.context);
    }
    this.backdrop ??= this.pictureOfBackdrop();
    return this.context.drawImage(this.backdrop, 0, 0, this.backdrop.width / this.ratio, this.backdrop.height / this.ratio);
  }

  pictureOfBackdrop() {
    const canvas = new OffscreenCanvas(this.canvas.width, this.canvas.height);
    const context = canvas.getContext("2d", { alpha: false });
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.paintBackdrop(context);
    return canvas.transferToImageBitmap();
  }

  paintBackdrop(c) {
    const { width, height, groundY } = this;
    const sky = c.createLinearGradient(0, 0, 0, Math.max(this.ground ? height : groundY, 1));
    sky.addColorStop(0, theme.sky);
    sky.addColorStop(1, theme["sky-low"]);
    c.fillStyle = sky;
    c.fillRect(0, 0, width, height);
    if (this.ground) return;
    c.fillStyle = this.groundGradient(c, groundY);
    c.fillRect(0, groundY, width, Math.max(height - groundY, 0));
  }

  groundGradient(c, top) {
    const gradient = c.createLinearGradient(0, top, 0, Math.max(this.height, top + 1));
    gradient.addColorStop(0, theme.ground);
    gradient.addColorStop(1, theme["ground-deep"]);
    return gradient;
  }

  // Water: a tint, and the marks along the bottom.
  drawWater(origin, small) {
    const c = this.context;
    c.globalAlpha = 0.22;
    c.fillStyle = theme.minus;
    c.fillRect(0, 0, this.width, this.height);
    c.globalAlpha = 1;
    this.drawMarks(origin, small);
  }

  // A soft line of hills that moves slower than the ground.
  drawHills(origin, pace, rise, seed, colour) {
    const c = this.context;
    const groundY = this.ground ? this.height * this.groundShare : this.groundY;
    const shift = (this.centreX - origin) * this.scale * pace;
    const unit = Math.max(this.height, 160);
    // Behind uneven ground they reach down as far as can be seen.
    const foot = this.ground ? this.height : groundY;
    c.beginPath();
    c.moveTo(0, foot);
    for (let x = 0; x <= this.width + 12; x += 12) {
      const u = (x + shift) / unit;
      const wave = Math.sin(u * 1.7 + seed) + 0.55 * Math.sin(u * 3.1 + seed * 2) + 0.25 * Math.sin(u * 6.7 + seed * 3);
      c.lineTo(x, groundY - this.height * rise * (0.55 + 0.25 * wave));
    }
    c.lineTo(this.width, foot);
    c.closePath();
    c.fillStyle = colour;
    c.fill();
  }

  // A tick every metre, a longer one with its number every five; further apart when seen from afar, and every
  // metre numbered when fewer than six are in view.
  drawMarks(origin, small) {
    const c = this.context;
    const each = [1, 5, 10, 50, 100].find(step => step * this.scale >= 11) || 500;
    const closeUp = this.width / this.scale < 6;
    const numbered = closeUp ? 1 : [5, 10, 50, 100, 500].find(step => step >= each && step * this.scale >= 46) || 500;
    const first = Math.floor((this.worldX(0) - origin) / each);
    const last = Math.ceil((this.worldX(this.width) - origin) / each);
    c.font = `${small ? 10 : 12}px ${theme.font}`;
    c.textAlign = "center";
    c.textBaseline = "top";
    for (let i = first; i <= last; i++) {
      const metre = i * each;
      const x = this.screenX(origin + metre);
      const main = metre % numbered === 0;
      const height = surfaceAt(this.ground, origin + metre);
      if (this.ground && height <= this.ground.floor) continue;
      const groundY = this.ground?.water ? this.height - (small ? 26 : 34) : this.screenY(height);
      c.fillStyle = theme.mark;
      c.globalAlpha = main ? 0.9 : 0.45;
      c.fillRect(x - (main ? 0.75 : 0.5), groundY + 1, main ? 1.5 : 1, main ? (small ? 7 : 11) : (small ? 4 : 6));
      if (main) c.fillText(metre === 0 ? "0" : `${fixed(metre, 0)} m`, x, groundY + (small ? 10 : 16));
    }
    c.globalAlpha = 1;
  }

  drawStart(origin, small) {
    const x = this.screenX(origin);
    if (x < -60 || x > this.width + 60) return;
    const c = this.context;
    const top = Math.max(this.groundY - this.height * (small ? 0.45 : 0.4), 0);
    c.save();
    c.strokeStyle = theme.mark;
    c.lineWidth = 1.5;
    c.globalAlpha = 0.55;
    c.setLineDash([2, 4]);
    c.beginPath();
    c.moveTo(x, top);
    c.lineTo(x, this.groundY);
    c.stroke();
    if (!small) {
      c.fillStyle = theme.mark;
      c.globalAlpha = 0.9;
      c.font = `12px ${theme.font}`;
      c.textAlign = "center";
      c.textBaseline = "bottom";
      c.fillText("start", x, top - 4);
    }
    c.restore();
  }
}
