"""Tells how noisy pictures are, from their own variance.

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

from .exr import Array, read_channels

LUMINANCE = {"R": 0.2126, "G": 0.7152, "B": 0.0722}
PERCENT = 0.01
LEAST_SAMPLES = 2


def weights(names: Iterable[str]) -> dict[str, float]:
    """The share in luminance of each channel of radiance among these: `R`, `G`, `B`, or bands."""
    bands = [name for name in names if name.startswith("S0.")]
    return {name: 1.0 / len(bands) for name in bands} or LUMINANCE


def luminance_and_error(file: str) -> tuple[Array, Array, bool]:
    """Luminance of each pixel and its standard error, `[height, width]` each.

    Also whether the error is only an upper bound. Raises SystemExit for a file without a variance,
    or of so few samples that its variance is none.
    """
    try:
        channels = read_channels(file)
    except RuntimeError as error:
        raise SystemExit(str(error)) from error
    shares = weights(channels)
    missing = [name for name in shares if {name, f"variance.{name}"} - set(channels)]
    if missing:
        raise SystemExit(f"{file}: has no layer variance of {', '.join(missing)}")
    if "samples.Y" in channels and channels["samples.Y"].max() < LEAST_SAMPLES:
        raise SystemExit(f"{file}: one sample a pixel does not tell how noisy it is")
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

    Also whether it is only an upper bound. Raises SystemExit for a file without a variance.
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


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="reference/noise",
        description="Relative standard error of luminance, from a picture's own variance",
    )
    parser.add_argument("pictures", nargs="+", metavar="PICTURE.exr")
    for file in parser.parse_args().pictures:
        error, bounded = relative_error(file)
        if not error.size:
            sys.stdout.write(f"{file}: black\n")
            continue
        within, middle, most = summary(error)
        sys.stdout.write(
            f"{file}: {within:.1f} % of pixels within 1 %; "
            f"median {middle:.2f} %, 95 % within {most:.2f} %"
            f"{' (upper bound)' if bounded else ''}\n"
        )


if __name__ == "__main__":
    main()
