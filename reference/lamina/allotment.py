"""How many samples go where in a print: by how single renders err, then by how what is shown does.

A block of pixels that is even needs fewer samples than a noisy one, and of two that are as noisy
one may come out of the denoiser clean and the other not. The first is known of a single render,
the second only of denoised twins.

- In: a render, or the mean of denoised twins, with `variance.Y`; samples that there is time for.
- Out: a target noise; or a map of samples for `lamina render --samples-map`.
- Always true: no part gets fewer samples than it has, and no more are given than there is time for.
- Left out: that samples of noisy parts take longer than those of even ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from lamina.exr import Array, read_channels, write_channels
from lamina.noise import PERCENT, luminance_and_error

# How the program judges where there is enough (the book, Adaptive sampling): not before so many
# samples, in steps of so many, by blocks of so many pixels across, of which dark ones are relative
# to a share of the picture's mean too.
FIRST = 32
STEP = 16
BLOCK = 8
FLOOR = 0.1
# A target that every part meets at once; the greatest that the program takes.
LARGEST_AIM = 1.0
# What is shown of a block errs by what this share of its pixels does not exceed: all of them would
# be led by the one that errs most.
MOST_PIXELS = 0.75
# Most by which the samples of a block grow at a time: how twins differ is not known that well.
MOST_GROWTH = 4.0


def blocks_of(values: Array) -> Array:
    """Pixels by block, `[rows, columns, pixels]`; those that a block at the rim lacks are nan."""
    rows, columns = (-(-length // BLOCK) for length in values.shape)
    missing = [(0, -length % BLOCK) for length in values.shape]
    padded = np.pad(values.astype(float), missing, constant_values=np.nan)
    parts = padded.reshape(rows, BLOCK, columns, BLOCK)
    return np.asarray(parts.swapaxes(1, 2).reshape(rows, columns, BLOCK**2))


def traced_errors(picture: Path) -> Array:
    """The relative error of each block of a render, as the program judges it."""
    bright, error, _ = luminance_and_error(str(picture))
    scale = np.nanmean(blocks_of(bright), axis=2) + FLOOR * bright.mean()
    square = np.nanmean(blocks_of(error**2), axis=2)
    return np.asarray(np.sqrt(square) / np.maximum(scale, np.finfo(float).tiny))


def shown_errors(errors: Array) -> Array:
    """The relative error of each block of what is shown, by those of its pixels."""
    return np.asarray(np.nanquantile(blocks_of(errors), MOST_PIXELS, axis=2))


def samples_of(picture: Path) -> Array:
    """Samples of each block."""
    return np.asarray(np.nanmax(blocks_of(read_channels(str(picture))["samples.Y"]), axis=2))


def lowest(samples: Callable[[float], float], affordable: float, least: float) -> float:
    """The lowest target from `least` to `LARGEST_AIM` that needs no more samples than these.

    Found to a hundredth, from above. `samples` are those that a target needs.
    """
    low, high = least, LARGEST_AIM
    if samples(low) <= affordable:
        return low
    while high / low > 1 + PERCENT:
        middle = float(np.sqrt(low * high))
        low, high = (low, middle) if samples(middle) <= affordable else (middle, high)
    return high


def aim(errors: Array, affordable: float, most: int, least: float) -> float:
    """The lowest target noise from `least` on that `affordable` samples a pixel are enough for.

    `affordable` is a mean over blocks, `errors` are the blocks' own at `FIRST` samples and fall
    with the root of their number; no block gets more samples than `most`.
    """

    def samples(noise: float) -> float:
        needed = STEP * np.ceil(FIRST * (errors / noise) ** 2 / STEP)
        return float(np.clip(needed, FIRST, most).mean())

    return lowest(samples, affordable, least)


def grown(samples: Array, errors: Array, target: float, most: int) -> Array:
    """Samples of each block of a twin, if of all alike, by which what is shown comes to a target.

    `samples` are those that it has; the square of `errors` falls as they grow.
    """
    growth = np.clip((errors / target) ** 2, 1, MOST_GROWTH)
    needed = np.minimum(STEP * np.ceil(samples * growth / STEP), most)
    return np.where(growth > 1, np.maximum(needed, samples), samples)


def shown_aim(
    samples: Sequence[Array], errors: Sequence[Array], affordable: float, most: int, least: float
) -> float:
    """The lowest target error of what is shown, from `least` on, that there is time for.

    `samples` are those that each twin has, `errors` those by which it gets more; `affordable` can
    be added a pixel, the mean over blocks and twins.
    """

    def added(target: float) -> float:
        twins = zip(samples, errors, strict=True)
        return float(
            np.mean([(grown(had, error, target, most) - had).mean() for had, error in twins])
        )

    return lowest(added, affordable, least)


def write_map(file: Path, samples: Array, shape: tuple[int, int]) -> None:
    """Writes samples by block as a map of a picture of this height and width."""
    pixels = samples.repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)
    write_channels(file, {"samples.Y": pixels[: shape[0], : shape[1]]})
