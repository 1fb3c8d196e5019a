"""Draws error against seconds as SVG, both axes logarithmic."""

from __future__ import annotations

import math
from html import escape

WIDTH, HEIGHT = 840, 480
LEFT, RIGHT, TOP, BOTTOM = 78, 300, 44, 58
# Colours that are told apart by people with any of the common kinds of colour blindness (Okabe and
# Ito), and a mark of its own for each line.
COLOURS = ("#000000", "#d55e00", "#56b4e9", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#7f7f7f",
           "#8c510a")  # fmt: skip
Point = tuple[float, float]


def marker(kind: int, x: float, y: float, colour: str) -> str:
    """One of nine marks."""
    shapes = (
        [(0, -5), (5, 0), (0, 5), (-5, 0)],
        [(-4, -4), (4, -4), (4, 4), (-4, 4)],
        [(0, -5), (5, 4), (-5, 4)],
        [(0, 5), (5, -4), (-5, -4)],
        [(-5, 0), (-1.5, -1.5), (0, -5), (1.5, -1.5), (5, 0), (1.5, 1.5), (0, 5), (-1.5, 1.5)],
        [(-4, -5), (4, 5), (4, -5), (-4, 5)],
        [(-6, -2), (6, -2), (6, 2), (-6, 2)],
        [(-2, -6), (2, -6), (2, 6), (-2, 6)],
    )
    kind %= len(shapes) + 1
    if kind == len(shapes):
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{colour}"/>'
    corners = " ".join(f"{x + dx:.1f},{y + dy:.1f}" for dx, dy in shapes[kind])
    return f'<polygon points="{corners}" fill="{colour}"/>'


def ticks(low: float, high: float) -> list[float]:
    """1, 2 and 5 of every decade within the range; powers of ten alone if that is too many."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for steps in ((1.0, 2.0, 5.0), (1.0,)):
        found = [step * 10.0**decade for decade in decades for step in steps]
        found = [value for value in found if low * 0.999 <= value <= high * 1.001]
        if len(found) <= 9:
            break
    return found


def span(values: list[float]) -> tuple[float, float]:
    """A range with room at both ends."""
    low, high = min(values), max(values)
    return low / 1.4, high * 1.4


def plot(title: str, lines: list[tuple[str, list[Point]]], time: str) -> str:
    """A chart of `(name, [(seconds, error), …])`; lines without points are left out."""
    lines = [(name, sorted(points)) for name, points in lines if points]
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="13" '
        'fill="#222">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
        f'<text x="{LEFT}" y="26" font-size="16">{escape(title)}</text>',
    ]
    if not lines:
        return "\n".join([*out, f'<text x="{LEFT}" y="80">nothing was measured</text>', "</svg>"])
    points = [point for _, of_line in lines for point in of_line]
    (x0, x1), (y0, y1) = span([x for x, _ in points]), span([y for _, y in points])
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM

    def at_x(value: float) -> float:
        return LEFT + (right - LEFT) * math.log(value / x0) / math.log(x1 / x0)

    def at_y(value: float) -> float:
        return bottom - (bottom - TOP) * math.log(value / y0) / math.log(y1 / y0)

    for value in ticks(x0, x1):
        x = at_x(value)
        out.append(f'<path d="M{x:.1f} {TOP}V{bottom}" stroke="#ddd"/>')
        out.append(f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{value:g}</text>')
    for value in ticks(y0, y1):
        y = at_y(value)
        out.append(f'<path d="M{LEFT} {y:.1f}H{right}" stroke="#ddd"/>')
        out.append(f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>')
    out.append(
        f'<rect x="{LEFT}" y="{TOP}" width="{right - LEFT}" height="{bottom - TOP}" '
        'fill="none" stroke="#444"/>'
    )
    out.append(
        f'<text x="{(LEFT + right) / 2}" y="{HEIGHT - 16}" text-anchor="middle">'
        f"{escape(time)}</text>"
    )
    middle = (TOP + bottom) / 2
    out.append(
        f'<text transform="translate(18 {middle}) rotate(-90)" text-anchor="middle">'
        "error (relMSE)</text>"
    )
    for number, (name, of_line) in enumerate(lines):
        colour = COLOURS[number % len(COLOURS)]
        places = [(at_x(x), at_y(y)) for x, y in of_line]
        way = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        wide = 2.6 if number == 0 else 1.6
        out.append(
            f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="{wide}"/>'
        )
        out.extend(marker(number, x, y, colour) for x, y in places)
        y = TOP + 14 + 22 * number
        out.append(marker(number, right + 18, y - 4, colour))
        out.append(f'<text x="{right + 30}" y="{y}">{escape(name)}</text>')
    return "\n".join([*out, "</svg>"]) + "\n"
