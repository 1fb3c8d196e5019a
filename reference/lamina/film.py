"""Pictures of Lamina's as one array, whole with all layers and attributes.

- In: an EXR of one flat part.
- Out: the same, whole or not at all.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray

from lamina.program import LaminaError
from lamina.rendered import BAND

Pixels = NDArray[np.float32]
ALBEDO = ("albedo.R", "albedo.G", "albedo.B")
# Of a spectral film the mean over its bands, three times.
MEAN_ALBEDO = ("albedo.Y",) * 3
MAGIC = b"\x76\x2f\x31\x01"


class Refused(LaminaError):
    """Input that the user can correct."""

    def __init__(self, text: str) -> None:
        super().__init__(text, 2)


class Failed(LaminaError):
    """The system or another program failed."""

    def __init__(self, text: str) -> None:
        super().__init__(text, 1)


@dataclass
class Film:
    """An EXR as it was read: `[height, width, channels]` in the order of the names."""

    spec: oiio.ImageSpec
    pixels: Pixels

    def has(self, names: tuple[str, ...]) -> bool:
        """Whether all these channels are there."""
        return all(name in self.spec.channelnames for name in names)

    def places(self, names: tuple[str, ...]) -> list[int]:
        """Numbers of channels."""
        return [self.spec.channelnames.index(name) for name in names]

    def layer(self, names: tuple[str, ...]) -> Pixels:
        """Channels by name, `[height, width, names]`."""
        return np.ascontiguousarray(self.pixels[:, :, self.places(names)])

    def albedo(self) -> tuple[str, ...]:
        """Names of the three channels of albedo; empty if there is none."""
        return next((names for names in (ALBEDO, MEAN_ALBEDO) if self.has(names)), ())

    def light(self) -> tuple[str, ...]:
        """Names of the channels of radiance: `R`, `G`, `B`, or bands; empty if there are none."""
        if self.has(("R", "G", "B")):
            return ("R", "G", "B")
        found = (BAND.match(name) for name in self.spec.channelnames)
        return tuple(band[0] for band in found if band and not band["layer"])


def read(file: Path) -> Film:
    """Reads an EXR."""
    try:
        with file.open("rb") as start:
            magic = start.read(len(MAGIC))
    except OSError as error:
        raise Refused(f"{file}: {error.strerror}") from error
    if magic != MAGIC:
        raise Refused(f"{file}: it is no EXR file")
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise Refused(f"{file}: {told(oiio.geterror())}")
    spec = image.spec()
    pixels = None if spec.deep else image.read_image(oiio.FLOAT)
    broken, parts = image.geterror(), spec.get_int_attribute("oiio:subimages", 1)
    image.close()
    if spec.deep or parts > 1:
        raise Refused(f"{file}: it is no picture of Lamina's, which has one flat part")
    if pixels is None:
        raise Refused(f"{file}: it is damaged: {told(broken)}")
    return Film(oiio.ImageSpec(spec), pixels)


def told(message: str) -> str:
    """The first line of what OpenImageIO says, without the file's name."""
    return (message.splitlines() or ["it cannot be read"])[0].split('": ')[-1]


def write(film: Film, out: Path) -> None:
    """Writes an EXR beside `out`, then puts it in its place: whole or not at all."""
    # A link stays, and what it leads to is replaced.
    target = out.resolve()
    half = target.with_name(f".lamina-{os.getpid()}-{target.name}.part")
    spec = oiio.ImageSpec(film.spec)
    # Both would be written as attributes that were not there; an empty date is left out.
    spec.erase_attribute("openexr:chunkCount")
    if not spec.get_string_attribute("DateTime"):
        spec.attribute("DateTime", "")
    try:
        output = oiio.ImageOutput.create("openexr")
        if output is None:
            raise Failed(f"{out}: {told(oiio.geterror())}")
        done = output.open(str(half), spec) and output.write_image(film.pixels)
        error = output.geterror()
        if not (output.close() and done):
            raise Failed(f"{out}: {told(error or output.geterror())}")
        with half.open("rb") as file:
            os.fsync(file.fileno())
        half.replace(target)
    except OSError as error:
        raise Failed(f"{out}: {error.strerror}") from error
    finally:
        half.unlink(missing_ok=True)
