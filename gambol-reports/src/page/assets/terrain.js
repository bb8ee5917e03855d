// Ground that is not flat: convex shapes above a floor; or water, where there is none. Places in metres, y up.

// The ground as stored (whole millimetres), or null for flat ground.
function decodeGround(stored) {
  if (!stored || !stored.shapes) return null;
  const shapes = stored.shapes.map(numbers => {
    const corners = [];
    for (let i = 0; i + 1 < numbers.length; i += 2) corners.push([numbers[i] / 1000, numbers[i + 1] / 1000]);
    const places = corners.map(corner => corner[0]);
    return { corners, left: Math.min(...places), right: Math.max(...places) };
  });
  return { shapes, floor: stored.floor === null ? -1000 : stored.floor / 1000, water: Boolean(stored.water) };
}

// The height of the ground at x.
function surfaceAt(ground, x) {
  if (!ground || ground.water) return 0;
  let top = ground.floor;
  for (const { corners, left, right } of ground.shapes) {
    if (x < left || x > right) continue;
    corners.forEach(([x1, y1], i) => {
      const [x2, y2] = corners[(i + 1) % corners.length];
      if (Math.min(x1, x2) > x || Math.max(x1, x2) < x) return;
      top = Math.max(top, x1 === x2 ? Math.max(y1, y2) : y1 + (y2 - y1) * (x - x1) / (x2 - x1));
    });
  }
  return top;
}

// How high the ground around x is, pits left out: where the camera looks.
function levelAround(ground, x, reach) {
  if (!ground || ground.water) return 0;
  let sum = 0, count = 0;
  for (let i = -12; i <= 12; i++) {
    const height = surfaceAt(ground, x + reach * i / 12);
    if (height <= ground.floor) continue;
    sum += height;
    count++;
  }
  return count ? sum / count : 0;
}

// Draws all shapes as one: outlines first, so that what lies inside another shape is covered.
function drawGround(stage, ground, colour) {
  const c = stage.context;
  const path = new Path2D();
  for (const { corners, left, right } of ground.shapes) {
    if (stage.screenX(right) < -5 || stage.screenX(left) > stage.width + 5) continue;
    corners.forEach(([x, y], i) => {
      const [px, py] = [stage.screenX(x), stage.screenY(y)];
      if (i === 0) path.moveTo(px, py); else path.lineTo(px, py);
    });
    path.closePath();
  }
  const floor = stage.screenY(ground.floor);
  path.rect(-50, floor, stage.width + 100, Math.max(stage.height - floor + 50, 0));
  c.strokeStyle = theme["ground-line"];
  c.lineWidth = 3;
  c.lineJoin = "round";
  c.stroke(path);
  c.fillStyle = colour;
  c.fill(path);
}
