"""Leaves in scans: which pixels are leaf, and how scans lie on one another.

- In: a scan, `[height, width, 3]`, as linear values, so that half a pixel of leaf is half as
  bright; a margin in millimetres.
- Out: the leaf's pixels, its contour, and the similarity that lays it onto the margin.
- Always true: a place in a picture is (column, row) of a pixel's centre; millimetres go upwards.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lamina.program import LaminaError

Array = NDArray[np.float64]

# Directions from which the registration starts, its rounds, and when it has converged, mm.
DIRECTIONS = 24
ROUNDS = 60
CONVERGED_MM = 1e-5
# Leaf and background differ by this much of white at least, and in so much of the frame at most.
LEAST_CONTRAST = 0.03
MOST_OF_FRAME = 0.02
# A second leaf is a part this large against the first; a leaf has so many pixels.
SECOND_LEAF = 0.05
LEAST_PIXELS = 400


def leaf_of(scan: Array, named: str) -> tuple[NDArray[np.bool_], Array]:
    """The leaf's pixels, and places on its contour between pixels, `[places, 2]`."""
    from scipy import ndimage

    # The frame of the picture shows the background.
    frame = np.concatenate([scan[0], scan[-1], scan[:, 0], scan[:, -1]])
    difference = np.abs(scan - np.median(frame, axis=0)).max(axis=2)
    level = max(otsu(difference), LEAST_CONTRAST)
    is_leaf = difference > level
    parts, count = ndimage.label(is_leaf)
    if count == 0:
        raise LaminaError(
            f"{named}: there is no leaf: nothing differs from the picture's frame by more than "
            f"{LEAST_CONTRAST:.0%} of white; scan it on a background of another brightness",
            2,
        )
    sizes = np.bincount(parts.ravel())[1:]
    order = np.argsort(sizes)[::-1]
    leaf = parts == order[0] + 1
    border = np.concatenate([leaf[0], leaf[-1], leaf[:, 0], leaf[:, -1]])
    if border.mean() > MOST_OF_FRAME or border.any():
        raise LaminaError(
            f"{named}: the leaf touches the picture's edge: leave background all around it", 2
        )
    if sizes[order[0]] < LEAST_PIXELS:
        raise LaminaError(
            f"{named}: the leaf has {sizes[order[0]]} pixels; it needs {LEAST_PIXELS}: scan it "
            "at a higher resolution",
            2,
        )
    if count > 1 and sizes[order[1]] > SECOND_LEAF * sizes[order[0]]:
        row, column = ndimage.center_of_mass(parts == order[1] + 1)
        raise LaminaError(
            f"{named}: there is more than one leaf: a second part lies about pixel "
            f"({column:.0f}, {row:.0f}) (column, row); cut the picture to one leaf",
            2,
        )
    return leaf, contour(np.where(leaf | ~is_leaf, difference, 0.0), leaf, level)


def otsu(values: Array) -> float:
    """The level that parts values into two classes with the least variance within them."""
    counts, edges = np.histogram(values, bins=256, range=(0.0, 1.0))
    middles = (edges[:-1] + edges[1:]) / 2
    below = np.cumsum(counts)
    above = below[-1] - below
    moment = np.cumsum(counts * middles)
    with np.errstate(invalid="ignore", divide="ignore"):
        between = below * above * (moment / below - (moment[-1] - moment) / above) ** 2
    return float(middles[np.nan_to_num(between).argmax()] + (middles[1] - middles[0]) / 2)


def contour(values: Array, leaf: NDArray[np.bool_], level: float) -> Array:
    """Where values cross the level between a pixel of the leaf and its neighbour."""
    places = []
    for axis in (0, 1):
        here = np.moveaxis(values, axis, 0)
        inside = np.moveaxis(leaf, axis, 0)
        crossed = np.nonzero(inside[:-1] != inside[1:])
        low, high = here[:-1][crossed], here[1:][crossed]
        way = crossed[0] + (level - low) / (high - low)
        places.append(np.stack([crossed[1], way] if axis == 0 else [way, crossed[1]], axis=1))
    return np.concatenate(places)


@dataclass(frozen=True)
class Similarity:
    """Millimetres on the leaf to pixels: turned, scaled, mirrored where the other face is seen."""

    matrix: Array
    offset: Array
    scale: float
    """Size in the scan, at its stated millimetres per pixel, over that of the margin."""
    residual_mm: float
    """Root of the mean square distance of the margin from the contour."""

    def pixels(self, places_mm: Array) -> Array:
        """Places in the picture, (column, row)."""
        placed: Array = places_mm @ self.matrix.T + self.offset
        return placed


def registered(
    margin_mm: Array, contour_px: Array, mm_per_pixel: float, mirrored: bool
) -> Similarity:
    """The similarity that lays a margin onto a contour: iterated closest points.

    A petiole may be part of the contour alone, so each place of the margin looks for its nearest
    place of the contour, and not the other way round. Starts lie all around the circle.
    """
    from scipy.spatial import cKDTree

    flip = np.array([-1.0 if mirrored else 1.0, -1.0]) * mm_per_pixel
    there = contour_px * flip
    tree = cKDTree(there)
    # The box's middle: a petiole of many contour places would pull the mean.
    start = (there.min(0) + there.max(0)) / 2
    middle = margin_mm.mean(0)
    best: tuple[float, Array, Array] | None = None
    for turn in np.arange(DIRECTIONS) * (2 * np.pi / DIRECTIONS):
        cosine, sine = np.cos(turn), np.sin(turn)
        matrix = np.array([[cosine, -sine], [sine, cosine]])
        offset = start - matrix @ middle
        before = np.inf
        for _ in range(ROUNDS):
            moved = margin_mm @ matrix.T + offset
            distances, nearest = tree.query(moved)
            error = float(np.sqrt((distances**2).mean()))
            if before - error < CONVERGED_MM:
                break
            before = error
            matrix, offset = least_squares(margin_mm, there[nearest])
        if best is None or error < best[0]:
            best = error, matrix, offset
    assert best is not None
    error, matrix, offset = best
    scale = float(np.sqrt(np.linalg.det(matrix)))
    return Similarity(matrix / flip[:, None], offset / flip, scale, error)


def least_squares(here: Array, there: Array) -> tuple[Array, Array]:
    """The similarity without a mirror that brings places nearest to others."""
    a, b = here - here.mean(0), there - there.mean(0)
    left, values, right = np.linalg.svd(b.T @ a)
    sign = np.array([1.0, np.sign(np.linalg.det(left @ right))])
    matrix = (left * sign) @ right * float((values * sign).sum() / (a**2).sum())
    return matrix, there.mean(0) - matrix @ here.mean(0)
