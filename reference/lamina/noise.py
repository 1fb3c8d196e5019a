"""Shows how noisy pictures are, from their own variance: `lamina-noise PICTURE.exr`.

Relative standard error of luminance by pixel: the root of the variance of the mean over the mean.
The layer `variance.Y` has that variance. Pictures of older versions hold variances of R, G and B
only, as if samples were independent, and not how they go together: taken to go wholly together they
give an upper bound. Bands are added with equal weights, likewise.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

import numpy as np

from lamina.exr import Array, read_channels
from lamina.program import LaminaError

LUMINANCE = {"R": 0.2126, "G": 0.7152, "B": 0.0722}
PERCENT = 0.01
LEAST_SAMPLES = 2


def weights(names: Iterable[str]) -> dict[str, float]:
    """The share in luminance of each channel of radiance among these: `R`, `G`, `B`, or bands."""
    bands = [name for name in names if name.startswith("S0.")]
    return {name: 1.0 / len(bands) for name in bands} or LUMINANCE


def luminance_and_error(file: str) -> tuple[Array, Array, bool]:
    """Luminance of each pixel and its standard error, `[height, width]` each.

    Also whether the error is only an upper bound. Raises LaminaError for a file without a variance,
    or of so few samples that its variance is none.
    """
    try:
        channels = read_channels(file)
    except RuntimeError as failure:
        raise LaminaError(str(failure), 2) from failure
    shares = weights(channels)
    missing = [name for name in shares if {name, f"variance.{name}"} - set(channels)]
    if missing:
        raise LaminaError(f"{file}: has no layer variance of {', '.join(missing)}", 2)
    if "samples.Y" in channels and channels["samples.Y"].max() < LEAST_SAMPLES:
        raise LaminaError(f"{file}: one sample per pixel does not show how noisy it is", 2)
    shape = next(iter(channels.values())).shape
    mean, error = np.zeros(shape), np.zeros(shape)
    for name, weight in shares.items():
        mean += weight * channels[name]
        error += weight * np.sqrt(np.maximum(channels[f"variance.{name}"], 0.0))
    bounded = "variance.Y" not in channels
    if not bounded:
        error = np.sqrt(channels["variance.Y"])
    return mean, error, bounded


def relative_error(file: str) -> tuple[Array, bool]:
    """The relative standard error of luminance of each pixel that is not black.

    Also whether it is only an upper bound. Raises LaminaError for a file without a variance.
    """
    mean, error, bounded = luminance_and_error(file)
    lit = mean > 0.0
    return np.asarray(error[lit] / mean[lit]), bounded


def summary(error: Array) -> tuple[float, float, float]:
    """Percent of pixels within 1 %; percent that half of them, and that 95 %, do not exceed.

    Of a picture without light, in which no pixel errs: 100, 0, 0.
    """
    if not error.size:
        return 100.0, 0.0, 0.0
    middle, most = 100 * np.quantile(error, [0.5, 0.95])
    return 100 * float((error <= PERCENT).mean()), float(middle), float(most)


def main(words: list[str] | None = None) -> int:
    """Prints a line per picture; the exit codes of `lamina`."""
    parser = argparse.ArgumentParser(
        prog="lamina-noise",
        description="Relative standard error of luminance, from a picture's own variance",
    )
    parser.add_argument("pictures", nargs="+", metavar="PICTURE.exr")
    for file in parser.parse_args(words).pictures:
        try:
            error, bounded = relative_error(file)
        except LaminaError as refused:
            print(f"lamina-noise: {refused}", file=sys.stderr)
            return refused.code
        if not error.size:
            print(f"{file}: black")
            continue
        within, middle, most = summary(error)
        print(
            f"{file}: {within:.1f} % of pixels within 1 %; "
            f"median {middle:.2f} %, 95 % within {most:.2f} %"
            f"{' (upper bound)' if bounded else ''}"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
