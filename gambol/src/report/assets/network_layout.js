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
  const height = Math.max(named * gap + 12, crowd * Math.min(gap, 25) + 12, 180);
  const gutter = narrow ? Math.round(width * 0.30) : Math.min(220, Math.round(width * 0.22));
  const rim = narrow ? 7 : Math.min(11, gap * 0.32);
  const step = (width - 2 * (gutter + rim)) / last;
  const apart = columns.map((column, c) => c === 0 || c === last
    ? Math.min(gap * 1.5, height / (column.length + 0.2)) : Math.min(gap * 1.9, height / (column.length + 0.5)));
  const radius = Math.min(rim, step * 0.4, ...apart.map(distance => distance * 0.42));
  const nodes = [];
  columns.forEach((column, c) => column.forEach((node, i) => {
    nodes[node] = { column: c, x: gutter + rim + step * c, y: height / 2 + (i - (column.length - 1) / 2) * apart[c] };
  }));
  settle(network, columns.slice(1, -1), nodes, apart[1], [radius + 4, height - radius - 4]);
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
    // A loop above; outputs have their names beside them, so theirs is to the left.
    const [ux, uy] = a.column === last ? [-1, 0] : [0, a.y < 4 * radius ? 1 : -1];
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
