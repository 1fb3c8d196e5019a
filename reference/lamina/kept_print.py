"""What a print keeps so that it can go on: `lamina-print --keep`, then `--resume`.

- In: a finished print, or the folder of one that was kept.
- Out, in that folder: NAME.twins.json (what each twin took) and NAME.errors.npz (how the mean errs,
  and of which pictures it is the mean); a twin's own checkpoint is the program's.
- Always true: a mean is remembered only if its pictures are those of which it was made.
"""

from __future__ import annotations

import argparse
import json
import zipfile
import zlib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from lamina.exr import Array
from lamina.film import Refused

LEAST_TWINS = 2
# The member of the file of errors that tells of which pictures they are.
WRITTEN = "written"


@dataclass
class Twin:
    """One render: its picture, and what it took until now."""

    seed: int
    # An EXR.
    picture: Path
    samples: float
    # Of all its runs.
    seconds: float
    mebibytes: float
    # Of the last one: until it could begin to trace, and in all, as `samples` count.
    building: float
    tracing: float

    @property
    def checkpoint(self) -> Path:
        """From where it goes on."""
        return self.picture.with_suffix(".checkpoint")


@dataclass
class Shown:
    """The mean of denoised twins."""

    # An EXR.
    picture: Path
    # How each of its blocks errs, for each twin as the others tell it, and by which it gets more
    # samples.
    errors: list[Array]


def memory_of(options: argparse.Namespace) -> Path:
    """The file from which a print goes on later."""
    file: Path = options.out / f"{name_of(options.scene)}.twins.json"
    return file


def errors_of(options: argparse.Namespace) -> Path:
    """The file with how blocks of the mean err, for each twin."""
    file: Path = options.out / f"{name_of(options.scene)}.errors.npz"
    return file


def remember(options: argparse.Namespace, twins: Sequence[Twin]) -> None:
    """Writes what twins took."""
    told = [asdict(twin) | {"picture": twin.picture.name} for twin in twins]
    memory_of(options).write_text(json.dumps(told, indent=2) + "\n", encoding="utf-8")


def remembered_mean(options: argparse.Namespace, twins: Sequence[Twin]) -> Shown | None:
    """The mean of an earlier print, unless one of its twins has gone on since."""
    picture = options.out / f"{name_of(options.scene)}.exr"
    try:
        with np.load(errors_of(options)) as told:
            as_written = np.array_equal(told[WRITTEN], written(twins))
            errors = [told[name] for name in told.files if name != WRITTEN]
    except (OSError, KeyError, ValueError, EOFError, zipfile.BadZipFile, zlib.error):
        return None
    if not as_written or not picture.exists() or len(errors) != len(twins):
        return None
    return Shown(picture, errors)


def remember_mean(options: argparse.Namespace, twins: Sequence[Twin], shown: Shown) -> None:
    """Writes how the mean errs, and of which pictures it is the mean."""
    # Without the last, NumPy's types take the array by name for a flag.
    named = {WRITTEN: written(twins)}
    np.savez_compressed(errors_of(options), *shown.errors, allow_pickle=False, **named)


def written(twins: Sequence[Twin]) -> Array:
    """When the picture of each twin was last written, in nanoseconds."""
    # Compared as equal, never as earlier: a clock may stand still for some milliseconds.
    return np.array([twin.picture.stat().st_mtime_ns for twin in twins])


def remembered(options: argparse.Namespace) -> list[Twin]:
    """The twins of an earlier print that can go on."""
    file = memory_of(options)
    try:
        told = json.loads(file.read_text(encoding="utf-8"))
        twins = [Twin(**twin | {"picture": options.out / twin["picture"]}) for twin in told]
        if len(twins) < LEAST_TWINS:
            raise ValueError(f"it names {len(twins)} renders")
    except OSError as error:
        raise Refused(
            f"{file}: {error.strerror}: a print with --keep writes it, and --resume goes on from it"
        ) from error
    except (ValueError, TypeError, KeyError) as error:
        raise Refused(f"{file}: it was not written by lamina-print: {error}") from error
    for twin in twins:
        for part in (twin.picture, twin.checkpoint):
            if not part.exists():
                raise Refused(f"{part}: it is missing, and without it no print goes on")
    return twins


def name_of(scene: Path) -> str:
    """What a scene is called: by its folder if the file is `scene.toml`."""
    return scene.resolve().parent.name if scene.stem == "scene" else scene.stem
