"""Channels of pictures by name."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray

Array = NDArray[np.float64]


def read_channels(file: str | Path) -> dict[str, Array]:
    """Every channel, `[height, width]`, in the file's order."""
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise RuntimeError(f"{file}: {oiio.geterror()}")
    names = image.spec().channelnames
    pixels = np.asarray(image.read_image(oiio.FLOAT), dtype=np.float64)
    image.close()
    return {name: pixels[:, :, number] for number, name in enumerate(names)}


def spec_of(file: Path) -> oiio.ImageSpec:
    """Size and attributes."""
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise RuntimeError(f"{file}: {oiio.geterror()}")
    spec = image.spec()
    image.close()
    return spec


def write_channels(
    file: str | Path, channels: Mapping[str, Array], told: Mapping[str, object] | None = None
) -> None:
    """Writes channels as 32-bit floats; `told` are attributes: text, integers, 4 × 4 matrices."""
    height, width = next(iter(channels.values())).shape
    spec = oiio.ImageSpec(width, height, len(channels), oiio.FLOAT)
    spec.channelnames = tuple(channels)
    # Lamina writes no date, and OpenImageIO one of its own unless this is empty.
    for name, value in ({"DateTime": ""} | dict(told or {})).items():
        if isinstance(value, np.ndarray):
            spec.attribute(name, oiio.TypeMatrix, value.astype(np.float32).ravel())
        else:
            spec.attribute(name, value)
    output = oiio.ImageOutput.create("openexr")
    pixels = np.stack(list(channels.values()), axis=2).astype(np.float32)
    if not output:
        raise RuntimeError(f"{file}: {oiio.geterror()}")
    if not (output.open(str(file), spec) and output.write_image(pixels) and output.close()):
        raise RuntimeError(f"{file}: {output.geterror()}")
