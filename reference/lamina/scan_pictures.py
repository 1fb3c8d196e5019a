"""Scans as they are read: from values of pixels to reflectances and transmittances.

- In: a picture of 8 or 16 bits in sRGB, and what is white in it.
- Out: the linear reflectance, or transmittance, of each pixel in red, green and blue.
- Left out: colour profiles other than sRGB.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray

from lamina.program import LaminaError

Array = NDArray[np.float64]
White = float | Sequence[float]

# Pixels of one scan at most, and values that count as clipped.
MOST_PIXELS = 100_000_000
CLIPPED = 254.5 / 255
MOST_CLIPPED = 0.01


def read(path: Path) -> Array:
    """A scan's values, from 0 to 1 as written."""
    image = oiio.ImageInput.open(str(path)) if path.is_file() else None
    if image is None:
        why = oiio.geterror() if path.is_file() else "there is no such file"
        raise LaminaError(f"{path}: {why}", 2)
    spec = image.spec()
    if spec.width * spec.height > MOST_PIXELS:
        raise LaminaError(
            f"{path}: {spec.width} × {spec.height} pixels; at most {MOST_PIXELS // 10**6} million "
            "are read: cut it to the leaf or scan at a lower resolution",
            2,
        )
    if spec.format.basetype not in (oiio.UINT8, oiio.UINT16):
        raise LaminaError(f"{path}: scans have 8 or 16 bits, such as PNG, TIFF and JPEG", 2)
    pixels = image.read_image(oiio.FLOAT)
    problem = image.geterror()
    image.close()
    if pixels is None or problem:
        raise LaminaError(f"{path}: the picture is damaged: {problem}", 2)
    values = np.asarray(pixels, float).reshape(spec.height, spec.width, -1)
    if values.shape[2] not in (3, 4):
        raise LaminaError(
            f"{path}: {values.shape[2]} channels; contents need the colours red, green and blue", 2
        )
    if values.shape[2] == 4 and values[:, :, 3].min() < 1:
        raise LaminaError(
            f"{path}: parts are transparent: lay it on its background, and save it without alpha", 2
        )
    if min(values.shape[:2]) < 16:
        raise LaminaError(f"{path}: {spec.width} × {spec.height} pixels are too few", 2)
    return values[:, :, :3]


def linear_of(scan: Array) -> Array:
    """Linear values of sRGB."""
    linear: Array = np.where(scan <= 0.04045, scan / 12.92, ((scan + 0.055) / 1.055) ** 2.4)
    return linear


def reflected(scan: Array, leaf: NDArray[np.bool_], white: White | None, named: str) -> Array:
    """Linear reflectances, or transmittances, of a scan's channels."""
    if (scan[leaf].max(axis=1) >= CLIPPED).mean() > MOST_CLIPPED:
        raise LaminaError(f"{named}: the leaf is overexposed: scan it darker", 2)
    linear = linear_of(scan)
    if white is None:
        far = np.concatenate([linear[0], linear[-1], linear[:, 0], linear[:, -1]])
        patch, value = far, 1.0
        what = "the bare background, which is transmittance 1,"
    elif isinstance(white, Sequence | np.ndarray):
        if len(white) != 5:
            raise LaminaError(f"white has {len(white)} numbers: one, or five for a patch", 2)
        column, row, width, height = (int(number) for number in white[:4])
        value = float(white[4])
        rows, columns = scan.shape[:2]
        within = column >= 0 <= row and column + width <= columns and row + height <= rows
        if not within or width < 1 or height < 1:
            raise LaminaError(
                f"{named}: the white patch {list(white[:4])} is not within the picture's "
                f"{columns} × {rows} pixels",
                2,
            )
        if leaf[row : row + height, column : column + width].any():
            raise LaminaError(f"{named}: the white patch lies on the leaf", 2)
        patch = linear[row : row + height, column : column + width].reshape(-1, 3)
        what = "the white patch"
    else:
        patch, value, what = np.ones((1, 3)), float(white), ""
    if not 0 < value <= 1.5:
        raise LaminaError(f"the value of white is {value}: it may be above 0 and up to 1.5", 2)
    if what and (patch.max(axis=1) >= CLIPPED).mean() > MOST_CLIPPED:
        raise LaminaError(f"{named}: {what} is overexposed: scan it darker", 2)
    level = np.median(patch, axis=0)
    if level.min() < 0.05:
        raise LaminaError(f"{named}: {what} is too dark to be white: its value is {level.min()}", 2)
    found: Array = linear / level * value
    return found
