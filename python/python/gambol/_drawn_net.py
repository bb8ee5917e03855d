"""A drawing of a net, for notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

#: Of the drawing and of a node, px.
WIDTH, ROW, MARGIN, RADIUS = 480, 34, 24, 9


def drawn(
    inputs: Sequence[int], outputs: Sequence[int], neurons: Iterable[int], edges: Sequence[tuple[int, int, float]]
) -> str:
    """An SVG image: inputs on the left, outputs on the right, between them each neuron behind those it reads.

    ``edges``: source, target and weight; orange is positive, blue negative, thick is large, and dashed leads backwards.
    """
    columns = _columns(inputs, outputs, neurons, edges)
    height = 2 * MARGIN + ROW * max(len(column) for column in columns)
    places = {}
    for index, column in enumerate(columns):
        x = MARGIN + index * (WIDTH - 2 * MARGIN) / max(1, len(columns) - 1)
        for row, node in enumerate(column):
            places[node] = x, height / 2 + ROW * (row - (len(column) - 1) / 2)
    largest = max((abs(weight) for _, _, weight in edges), default=1.0) or 1.0
    lines = [_edge(places[source], places[target], weight / largest) for source, target, weight in edges]
    circles = [
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS}" fill="#faf8f4" stroke="#23272e"><title>{node}</title></circle>'
        for node, (x, y) in places.items()
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}">'
        f"{''.join(lines)}{''.join(circles)}</svg>"
    )


def _columns(
    inputs: Sequence[int], outputs: Sequence[int], neurons: Iterable[int], edges: Sequence[tuple[int, int, float]]
) -> list[list[int]]:
    """Nodes by how many neurons are before them, as far as there is no cycle."""
    hidden = [node for node in neurons if node not in outputs]
    depth = dict.fromkeys(hidden, 1)
    # A longest path without a cycle has no more neurons than there are.
    for _ in hidden:
        before = dict(depth)
        for source, target, _weight in edges:
            if source in depth and target in depth and source != target and depth[source] < len(hidden):
                depth[target] = max(depth[target], depth[source] + 1)
        if depth == before:
            break
    levels = sorted(set(depth.values()))
    return [list(inputs), *([node for node in hidden if depth[node] == level] for level in levels), list(outputs)]


def _edge(start: tuple[float, float], end: tuple[float, float], weight: float) -> str:
    (x1, y1), (x2, y2) = start, end
    colour = "#d2622a" if weight > 0 else "#2f6f9e"
    width = 0.5 + 3.5 * abs(weight)
    if x2 > x1:
        path, dashes = f"M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}", ""
    else:
        # Backwards, or to itself: an arc below.
        low = max(y1, y2) + ROW
        path = f"M{x1:.1f} {y1:.1f}C{x1 + ROW:.1f} {low:.1f} {x2 - ROW:.1f} {low:.1f} {x2:.1f} {y2:.1f}"
        dashes = ' stroke-dasharray="4 3"'
    return f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width:.2f}"{dashes}/>'
