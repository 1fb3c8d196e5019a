"""Tells how noisy pictures are, from their own variance.

Relative standard error of luminance by pixel: the root of the variance of the mean over the mean.
The film holds variances of R, G and B but not how they go together, so they are taken to go wholly
together: the true error is at most that. Bands are added with equal weights, likewise.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray

LUMINANCE = {"R": 0.2126, "G": 0.7152, "B": 0.0722}
PERCENT = 0.01


def relative_error(file: str) -> NDArray[np.float64]:
    """The bound on the relative standard error of luminance of each pixel that is not black."""
    image = oiio.ImageInput.open(file)
    if image is None:
        raise SystemExit(f"{file}: {oiio.geterror()}")
    names = list(image.spec().channelnames)
    pixels = np.asarray(image.read_image(oiio.FLOAT), dtype=np.float64)
    image.close()
    bands = {name: 1.0 for name in names if name.startswith("S0.")}
    weights = bands or LUMINANCE
    mean = np.zeros(pixels.shape[:2])
    error = np.zeros(pixels.shape[:2])
    for name, weight in weights.items():
        mean += weight * pixels[:, :, names.index(name)]
        variance = pixels[:, :, names.index(f"variance.{name}")]
        error += weight * np.sqrt(np.maximum(variance, 0.0))
    lit = mean > 0.0
    return np.asarray(error[lit] / mean[lit])


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="reference/noise",
        description="Relative standard error of luminance, from a picture's own variance",
    )
    parser.add_argument("pictures", nargs="+", metavar="PICTURE.exr")
    for file in parser.parse_args().pictures:
        error = relative_error(file)
        within = float((error <= PERCENT).mean())
        middle, most = 100 * np.quantile(error, [0.5, 0.95])
        sys.stdout.write(
            f"{file}: {100 * within:.1f} % of pixels within 1 %; "
            f"median {middle:.2f} %, 95 % within {most:.2f} %\n"
        )


if __name__ == "__main__":
    main()
