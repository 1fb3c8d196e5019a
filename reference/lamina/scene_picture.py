"""The picture of a scene that `lamina-denoise` renders itself.

- In: a scene file, with the options of `lamina render`.
- Out: an EXR in a folder that the caller takes away.
"""

from __future__ import annotations

import argparse
import subprocess
import tomllib
from pathlib import Path

from lamina.film import Refused
from lamina.program import allowing, program


def check_size(scene: Path, overrides: list[str], least: int) -> None:
    """Refuses a film that is too small; all other errors are for the program to report."""
    size = None
    try:
        for text in (scene.read_text(encoding="utf-8"), *overrides):
            for film in tomllib.loads(text).get("film", {}).values():
                size = film.get("size", size)
        is_small = size is not None and min(size) < least
    except (AttributeError, OSError, TypeError, ValueError):
        return
    if is_small:
        raise Refused(f"{scene}: film.size = {size}: at least {least} pixels across and down")


def rendered(options: argparse.Namespace, folder: Path) -> Path:
    """The picture of a scene. If the program fails, this ends with its status."""
    try:
        line = [str(program()), "render", str(options.picture), "--out", str(folder / "render")]
    except FileNotFoundError as error:
        raise Refused(f"{options.picture}: lamina renders it, and {error}") from error
    line += ["--spp", str(options.spp)] if options.spp else []
    line += [word for key in options.overrides or () for word in ("-D", key)]
    line += allowing(options.allow or ())
    status = subprocess.run(line, check=False, stdout=subprocess.DEVNULL).returncode
    if status != 0:
        raise SystemExit(status)
    return folder / "render.exr"
