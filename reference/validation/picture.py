"""A spectral picture with the variance of its mean, and how ours is read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lamina.exr import Array, read_channels
from lamina.rendered import BAND


@dataclass
class Picture:
    """Mean radiance and the variance of that mean, `[height, width, bands]`."""

    mean: Array
    variance: Array
    seconds: float = 0.0
    spp: int = 0
    # Independent passes that the variance was estimated from; 0: from very many samples.
    passes: int = 0


def read_lamina(file: Path) -> tuple[Picture, list[float]]:
    """Reads a spectral film of the renderer; gives the bands' centres (nm), ascending."""
    means: dict[float, Array] = {}
    variances: dict[float, Array] = {}
    for name, values in read_channels(file).items():
        found = BAND.match(name)
        if found and found["layer"] in (None, "variance."):
            target = variances if found["layer"] else means
            target[float(f"{found['whole']}.{found['part']}")] = values
    bands = sorted(means)
    if not bands or sorted(variances) != bands:
        raise RuntimeError(f"{file}: bands {bands} with variances for {sorted(variances)}")
    picture = Picture(
        np.stack([means[band] for band in bands], axis=2),
        np.stack([variances[band] for band in bands], axis=2),
    )
    return picture, bands


def mean_of(pictures: list[Array], seconds: float, spp: int) -> Picture:
    """The mean of independent pictures, with the variance of that mean."""
    stack = np.stack(pictures)
    count = len(pictures)
    # One picture says nothing about its own variance.
    variance = stack.var(axis=0, ddof=1) / count if count > 1 else np.full_like(stack[0], np.nan)
    return Picture(stack.mean(axis=0), variance, seconds, spp, count)
