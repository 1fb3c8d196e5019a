"""Reads channels of Lamina's EXR."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray


def read_channels(file: Path, names: tuple[str, ...]) -> NDArray[np.float64]:
    """The named channels, `[height, width, names]`."""
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise RuntimeError(f"{file}: {oiio.geterror()}")
    present = image.spec().channelnames
    missing = [name for name in names if name not in present]
    if missing:
        raise RuntimeError(f"{file}: has no channels {missing}, only {list(present)}")
    pixels = np.asarray(image.read_image(oiio.FLOAT), dtype=np.float64)
    image.close()
    return pixels[:, :, [present.index(name) for name in names]]
