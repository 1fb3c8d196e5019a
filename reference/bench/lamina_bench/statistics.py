"""What is measured: noise relative to brightness, efficiency, and whether means agree.

- **In**: independent pictures of one scene, `[seeds, height, width, 3]`, linear.
- **Out**: their relative mean squared error, efficiency, and means with standard errors.
- **Left out**: bias. Error here is the variance over seeds; that the means agree is a check of its
  own, made before errors are compared.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# ε of the relative error is this share of the picture's mean, squared: pixels darker than a tenth
# of the mean count as if they were as bright as that.
FLOOR = 0.1
LEAST_SEEDS = 3


def rel_mse(pictures: Array, reference: Array, floor: float = FLOOR) -> float:
    """Mean over pixels and channels of var / (reference² + ε), ε = (floor × mean(reference))².

    `var` is the unbiased variance over the pictures, so that the figure is the error of one of
    them; `reference` is what the scene really looks like, as far as is known.
    """
    if len(pictures) < LEAST_SEEDS:
        raise ValueError(f"{len(pictures)} seeds; at least {LEAST_SEEDS} are needed")
    if not np.all(np.isfinite(pictures)):
        raise ValueError("a picture has values that are not finite")
    epsilon = (floor * float(reference.mean())) ** 2
    if not epsilon > 0.0:
        raise ValueError("the reference is black")
    return float((pictures.var(axis=0, ddof=1) / (reference**2 + epsilon)).mean())


def efficiency(error: float, seconds: float) -> float:
    """1 / (error × seconds): does not change with the number of independent samples."""
    if not (error > 0.0 and seconds > 0.0):
        raise ValueError(f"error {error} and seconds {seconds} must be above 0")
    return 1.0 / (error * seconds)


@dataclass(frozen=True)
class Mean:
    """Mean of R, G and B over a region, with the standard error of each."""

    value: Array
    error: Array


def region_mean(pictures: Array, region: NDArray[np.bool_]) -> Mean:
    """Means over the region's pixels; the standard error comes from the spread over pictures.

    Noise of pixels is taken as independent within a picture, so that few pictures suffice: the
    variance of the mean is that of the pixels, summed, over their number squared.
    """
    inside = pictures[:, region, :]
    count, pixels, _ = inside.shape
    if pixels == 0:
        raise ValueError("the region has no pixels")
    variance = inside.var(axis=0, ddof=1).sum(axis=0) / pixels**2 / count
    return Mean(inside.mean(axis=(0, 1)), np.sqrt(variance))


def disagreement(ours: Mean, theirs: Mean) -> tuple[Array, Array]:
    """Relative difference of two means by channel, ours over theirs, with its standard error."""
    ratio = ours.value / theirs.value
    error = ratio * np.hypot(ours.error / ours.value, theirs.error / theirs.value)
    return ratio - 1.0, error


def agrees(ours: Mean, theirs: Mean, bound: float, errors: float = 3.0) -> bool:
    """Whether every channel is within the bound, or off by more only within its standard errors.

    A difference that is beyond the bound by more than `errors` standard errors is a disagreement.
    """
    off, error = disagreement(ours, theirs)
    return bool(np.all(np.abs(off) <= bound + errors * error))
