// Where the nodes of a net go and how its connections run: inputs left, outputs right, between them a column for each
// depth; in a column the order and heights that keep connections short, so that few of them cross.

// Depth: the longest way from the inputs over connections that carry what was put out in the same step. There is a column
// for each depth of a hidden neuron; the outputs have the last, whatever their depth.
function networkColumns(network) {
  const isOutput = new Set(network.outputs);
  const depth = network.nodes.map((_, node) => node < network.inputs ? 0 : 1);
  // Connections come target by target, in the order in which the targets are computed.
  for (const [source, target] of network.connections) {
    if (source < target) depth[target] = Math.max(depth[target], depth[source] + 1);
  }
  const hidden = network.nodes.map((_, node) => node).filter(node => node >= network.inputs && !isOutput.has(node));
  const depths = [...new Set(hidden.map(node => depth[node]))].sort((a, b) => a - b);
  const inputs = Array.from({ length: network.inputs }, (_, node) => node);
  return [inputs, ...depths.map(d => hidden.filter(node => depth[node] === d)), network.outputs];
}

// Each node's column, place and radius, and each connection's curve.
function layOutNetwork(network, width) {
  const narrow = width < 560;
  const columns = networkColumns(network);
  const last = columns.length - 1;
  const named = Math.max(columns[0].length, columns[last].length);
  const crowd = Math.max(...columns.map(column => column.length));
  const gap = narrow ? 29 : Math.max(25, Math.min(40, 400 / named));
  const hidden = columns.slice(1, -1).reduce((sum, column) => sum + column.length, 0);
  const height = Math.max(named * gap + 12, crowd * Math.min(gap, 25) + 12, Math.min(180 + 6 * hidden, 380));
  const gutter = narrow ? Math.round(width * (last > 3 ? 0.25 : 0.30)) : Math.min(220, Math.round(width * 0.22));
  const rim = narrow ? 7 : Math.min(11, gap * 0.32);
  const step = (width - 2 * (gutter + rim)) / last;
  const apart = columns.map((column, c) => c === 0 || c === last
    ? Math.min(Math.max(gap * 1.5, height * 0.2), height / (column.length + 0.2)) : Math.min(gap * 1.9, height / (column.length + 0.5)));
  const radius = Math.min(rim, step * 0.4, ...apart.map(distance => distance * 0.42));
  const nodes = [];
  columns.forEach((column, c) => column.forEach((node, i) => {
    nodes[node] = { column: c, x: gutter + rim + step * c, y: height / 2 + (i - (column.length - 1) / 2) * apart[c] };
  }));
  const range = [radius + 4, height - radius - 4];
  settle(network, columns.slice(1, -1), nodes, gap * 1.9, range);
  stepAside(network, columns.slice(1, -1), nodes, radius, range);
  const frame = { last, step, radius, middle: height / 2, bottom: height - 3 };
  const curves = network.connections.map(([source, target]) => curveBetween(nodes[source], nodes[target], frame));
  return { narrow, height, gutter, radius, columns, nodes, curves };
}

// Moves hidden neurons towards the middle of their neighbours, column by column, there and back.
function settle(network, columns, nodes, apart, range) {
  const neighbours = nodes.map(() => []);
  for (const [source, target] of network.connections) {
    if (source === target) continue;
    neighbours[source].push(nodes[target]);
    neighbours[target].push(nodes[source]);
  }
  const mean = node => neighbours[node].reduce((sum, other) => sum + other.y, 0) / neighbours[node].length;
  for (let sweep = 0; sweep < 24; sweep++) {
    for (const column of sweep % 2 ? [...columns].reverse() : columns) {
      const wanted = column.map(node => neighbours[node].length ? mean(node) : nodes[node].y);
      spread(wanted, Math.min(apart, (range[1] - range[0]) / Math.max(column.length - 1, 1)), range)
        .forEach((y, i) => { nodes[column[i]].y = y; });
    }
  }
}

// Moves hidden neurons a little, between their neighbours in the column, off the connections that only pass by. In a
// large net there is no free place to find.
function stepAside(network, columns, nodes, radius, [top, bottom]) {
  if (network.connections.length > 1000) return;
  for (const column of columns) {
    const order = [...column].sort((a, b) => nodes[a].y - nodes[b].y);
    order.forEach((node, i) => {
      const { x, y } = nodes[node];
      const low = i ? nodes[order[i - 1]].y + 2.4 * radius : top;
      const high = i < order.length - 1 ? nodes[order[i + 1]].y - 2.4 * radius : bottom;
      const passing = network.connections.filter(([source, target]) => source !== node && target !== node)
        .map(([source, target]) => heightAt(nodes[source], nodes[target], x)).filter(height => height !== null);
      const cost = at => passing.reduce((sum, height) => sum + Math.max(0, 1 - Math.abs(at - height) / (radius + 4)), 0);
      let best = { at: y, cost: cost(y) };
      for (let away = 2; away <= 4 * radius; away += 2) {
        for (const at of [y - away, y + away]) {
          if (at < low || at > high) continue;
          const here = cost(at) + away * 0.01;
          if (here < best.cost) best = { at, cost: here };
        }
      }
      nodes[node].y = best.at;
    });
  }
}

// About where the curve from `a` to `b` passes a place between them; null if it does not.
function heightAt(a, b, x) {
  if (x <= a.x + 1 || x >= b.x - 1) return null;
  const share = (x - a.x) / (b.x - a.x);
  return a.y + (b.y - a.y) * share * share * (3 - 2 * share);
}

// The heights closest to those wanted (least squares) that keep their order, a distance and a range.
function spread(wanted, apart, [top, bottom]) {
  const order = wanted.map((_, i) => i).sort((a, b) => wanted[a] - wanted[b] || a - b);
  // Without the distances: values that must not fall. Neighbours that would are merged to their mean.
  const blocks = [];
  order.forEach((i, place) => {
    let block = { sum: wanted[i] - place * apart, size: 1 };
    while (blocks.length && blocks[blocks.length - 1].sum / blocks[blocks.length - 1].size > block.sum / block.size) {
      const before = blocks.pop();
      block = { sum: before.sum + block.sum, size: before.size + block.size };
    }
    blocks.push(block);
  });
  const heights = [];
  const highest = Math.max(top, bottom - (wanted.length - 1) * apart);
  for (const { sum, size } of blocks) {
    for (let k = 0; k < size; k++) {
      const place = heights.length;
      heights.push(Math.min(Math.max(sum / size, top), highest) + place * apart);
    }
  }
  return order.reduce((result, i, place) => { result[i] = heights[place]; return result; }, []);
}

// A curve as the eight numbers of a Bézier; to the right an S, else an arc that ends in an arrow.
function curveBetween(a, b, { last, step, radius, middle, bottom }) {
  const inside = y => Math.min(Math.max(y, 3), bottom);
  if (a === b) {
    // A loop above, or below the topmost; outputs have their names to the right, so theirs leans to the left.
    const up = a.y < 4 * radius ? 1 : -1;
    const [ux, uy] = a.column === last ? [-0.6, 0.8 * up] : [0, up];
    const at = (out, side) => [a.x + radius * (ux * out - uy * side), a.y + radius * (uy * out + ux * side)];
    return { points: [...at(0.75, -0.66), ...at(3.4, -2.2), ...at(3.4, 2.2), ...at(0.75, 0.66)], arrow: true };
  }
  const dx = b.x - a.x;
  if (dx > 1) return { points: [a.x, a.y, a.x + dx * 0.4, a.y, b.x - dx * 0.4, b.y, b.x, b.y], arrow: false };
  if (dx > -1) {
    const bow = Math.min(radius + 6 + Math.abs(b.y - a.y) * 0.25, step * 0.8);
    const from = a.x - radius;
    return { points: [from, a.y, from - bow, a.y, from - bow, b.y, from, b.y], arrow: true };
  }
  const side = (a.y + b.y) / 2 <= middle ? -1 : 1;
  const lift = side * (radius + 14 + Math.abs(dx) * 0.22);
  return {
    points: [a.x, a.y + side * radius, a.x + dx * 0.2, inside(a.y + lift), b.x - dx * 0.2, inside(b.y + lift), b.x, b.y + side * radius],
    arrow: true,
  };
}
