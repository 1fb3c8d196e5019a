"""Plots of a report: points with error bars, as numbers for the page's template."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

# The frame in the template's drawing, from left to right and from the bottom up.
LEFT, RIGHT = 50.0, 350.0
BOTTOM, TOP = 200.0, 10.0


def plot(
    points: Sequence[tuple[str, str, str]], x: str, y: str, has_error: bool
) -> list[dict[str, Any]]:
    """A plot of texts that are numbers: x, y and the standard error of y; none if they are not."""
    try:
        known = [
            (float(first), float(second), float(error) if has_error and error else 0.0)
            for first, second, error in points
        ]
    except ValueError:
        return []
    if len({first for first, *_ in known}) < 2:
        return []
    across = ticks(min(first for first, *_ in known), max(first for first, *_ in known))
    up = ticks(
        min(second - error for _, second, error in known),
        max(second + error for _, second, error in known),
    )

    def at(value: float, marks: list[float], start: float, end: float) -> float:
        share = (value - marks[0]) / (marks[-1] - marks[0])
        return round(start + share * (end - start), 2)

    return [
        {
            "title": f"{y} over {x}",
            "x": x,
            "x_ticks": [
                {"at": at(mark, across, LEFT, RIGHT), "label": f"{mark:.4g}"} for mark in across
            ],
            "y_ticks": [{"at": at(mark, up, BOTTOM, TOP), "label": f"{mark:.4g}"} for mark in up],
            "points": [
                {
                    "x": at(first, across, LEFT, RIGHT),
                    "y": at(second, up, BOTTOM, TOP),
                    "low": at(second - error, up, BOTTOM, TOP),
                    "high": at(second + error, up, BOTTOM, TOP),
                    "told": f"{first:.6g}: {second:.6g}" + (f" ± {error:.2g}" if error else ""),
                }
                for first, second, error in known
            ],
        }
    ]


def ticks(low: float, high: float) -> list[float]:
    """Round numbers at equal steps that reach from `low` or below to `high` or above."""
    if high <= low:
        high = low + max(abs(low), 1e-9)
    raw = (high - low) / 4
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= raw * 0.999)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return [number * step for number in range(first, last + 1)]
