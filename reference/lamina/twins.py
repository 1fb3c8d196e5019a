"""What is wrong with the mean of denoised twins: renders of one scene that share no random number.

How the denoised pictures differ tells what is left of the noise. What all of them share, the bias,
shows against the pictures as they were traced, which have none: E_i, denoised less traced, has the
bias for its mean, and of two seeds the noise in E_i and that in E_j are independent. So the mean of
E_i E_j is the square of the bias, whatever the noise.

- In: two or more pictures, `[height, width, channels]`, each alone.
- Always true: no value is told that the pictures do not show; what is not known is told by a bound.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from lamina.exr import Array
from lamina.noise import PERCENT, weights

Pixels = NDArray[np.float32]
# One picture does not differ from itself.
LEAST = 2
# A pixel's own difference is one number, too few to tell an error by: squares are averaged over
# this many pixels across and down.
NEAR = 5
# Luminance of the darkest pixels there are, as a share of the picture's mean: black has no relative
# error.
DARKEST = 1e-3
# Added to the square of luminance, as a share of the square of the picture's mean, so that what is
# black does not rule what is relative.
DARK = 0.01
# A picture without any light has no relative error either: 0 over this is 0.
TINY = 1e-30


def luminance(light: Pixels, names: tuple[str, ...]) -> Pixels:
    """That of channels of radiance, `[height, width]`."""
    shares = weights(names)
    made: Pixels = light @ np.array([shares[name] for name in names], np.float32)
    return made


def left_noise(
    clean: list[Pixels], shares: NDArray[np.float64], names: tuple[str, ...]
) -> dict[str, Pixels]:
    """Variances of the mean of denoised pictures, of each channel and of luminance.

    `shares` are those of the pictures in the mean, as of samples: the square of an error is taken
    to fall as they rise.
    What is averaged over near pixels is relative to luminance: where a noisy leaf ends before a
    bright sky, each would else get the other's noise.
    """
    pixels = dict(
        zip((f"variance.{name}" for name in names), np.moveaxis(np.stack(clean), 3, 0), strict=True)
    )
    pixels["variance.Y"] = np.stack([luminance(light, names) for light in clean])
    bright = luminance(np.average(clean, axis=0, weights=shares), names)
    scale = scale_of(bright)
    return {name: variance(values, shares, scale) for name, values in pixels.items()}


def noise_told_by_others(
    clean: list[Pixels], shares: NDArray[np.float64], names: tuple[str, ...]
) -> list[Array]:
    """The relative standard error of luminance of the mean of all, for each as the others tell it.

    Who gives a picture more samples where its own difference from the others is large leaves it
    alone where it is near to them by chance, and the noise that is told afterwards is too small.
    What the others tell knows nothing of its own. Of two pictures both tell it together.
    What is black has no error.
    """
    pixels = np.stack([luminance(light, names) for light in clean])
    bright = np.average(pixels, axis=0, weights=shares)
    scale = scale_of(bright)
    made = []
    for left_out in range(len(clean)):
        told_by = np.arange(len(clean)) != left_out
        if told_by.sum() < LEAST:
            told_by[:] = True
        square = variance(pixels[told_by], shares[told_by], scale) * shares[told_by].sum()
        error = np.sqrt(square)
        made.append(np.divide(error, bright, out=np.zeros_like(error), where=bright > 0))
    return made


def scale_of(bright: Pixels) -> Pixels:
    """What errors are relative to while they are averaged: luminance, if it is not black."""
    return np.maximum(bright, max(DARKEST * bright.mean(), TINY))


def variance(pixels: Pixels, shares: NDArray[np.float64], scale: Pixels) -> Pixels:
    """That of the mean of pictures `[picture, height, width]`, averaged over near pixels."""
    mean = np.average(pixels, axis=0, weights=shares)
    squares = np.average((pixels - mean) ** 2, axis=0, weights=shares) / (len(pixels) - 1)
    from scipy.ndimage import uniform_filter

    made: Pixels = uniform_filter(squares / scale**2, NEAR, mode="nearest") * scale**2
    return made


@dataclass
class Bias:
    """Square of the relative bias of luminance, the mean over all pixels, and its standard error.

    The error is that of a mean over pixels, so that it also has how the bias differs among them: it
    is too large rather than too small.
    """

    square: float
    error: float

    def __str__(self) -> str:
        at_most = np.sqrt(max(self.square, 0.0) + 2 * self.error) / PERCENT
        if self.square < 2 * self.error:
            return f"below {at_most:.2g} %"
        return f"{np.sqrt(self.square) / PERCENT:.2g} %"


def bias(clean: list[Pixels], traced: list[Pixels], names: tuple[str, ...]) -> Bias:
    """The bias of denoised pictures against the same as they were traced."""
    bright = luminance(np.mean(clean, axis=0), names)
    scale = np.maximum(np.sqrt(bright**2 + DARK * bright.mean() ** 2), TINY)
    errors = [
        (luminance(after, names) - luminance(before, names)) / scale
        for after, before in zip(clean, traced, strict=True)
    ]
    pairs = [one * other for one, other in combinations(errors, 2)]
    square = np.mean(pairs, axis=0, dtype=np.float64)
    return Bias(float(square.mean()), float(square.std() / np.sqrt(square.size)))
