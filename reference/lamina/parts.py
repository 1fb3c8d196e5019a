"""One render cut into ranges of samples, on a cluster."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import xarray as xr

from lamina.extras import require
from lamina.listing import list_tasks
from lamina.program import Folders, LaminaError, Value, allowing, overrides, program, run
from lamina.progress import bar
from lamina.rendered import read

if TYPE_CHECKING:
    from distributed import Client


def render_in_parts(
    scene: str | Path,
    values: Mapping[str, Value] | None = None,
    *,
    client: Client,
    out: str | Path,
    spp: int,
    parts: int,
    seed: int | None = None,
    threads: int = 1,
    allow: Folders = (),
    progress: bool | None = None,
) -> xr.Dataset:
    """Renders a scene in `parts` ranges of its `spp` samples on the workers of a client of Dask
    distributed, adds them up with `lamina merge`, and gives the picture.

    `out` is the stem of the EXR and the PNG, which have the bytes of a render in one go. Workers
    need the folder of `out`: parts go into `OUT.parts` and stay there until the picture is whole,
    so that a call after a failure does only what is not done. Each part grows the scene's leaves
    again. `allow` is as in `render`; workers need those folders too. `progress` shows a bar of the
    parts that are done, or none; by default it is shown in terminals and notebooks. Raises
    LaminaError, and ValueError for more parts than samples.
    """
    require("sweep", "lamina.render_in_parts")
    from distributed import as_completed

    if not 1 <= parts <= spp:
        raise ValueError(f"{parts} parts of {spp} samples: take 1 to {spp}")
    stem = Path(out).resolve()
    stem = stem.with_suffix("") if stem.suffix in (".exr", ".png") else stem
    folder = stem.with_name(stem.name + ".parts")
    folder.mkdir(parents=True, exist_ok=True)
    words = [*overrides("-D", values), *allowing(allow)]
    # The identity tells scenes apart; the seed is that of the listing, not of the render.
    listing = list_tasks(scene, [*words, "--seeds", "1"], folder / "scene")
    name = f"{listing.ids[0]:016x}-{'scene' if seed is None else seed}"
    whole = [str(Path(scene).resolve()), *words, "--spp", str(spp), "--noise", "0"]
    if seed is not None:
        whole += ["--seed", str(seed)]
    borders = [spp * number // parts for number in range(parts + 1)]
    ranges = list(zip(borders, borders[1:], strict=False))
    files = [folder / f"{name}-{spp}-{first}-{end}.part" for first, end in ranges]
    command = str(program())
    futures = [
        client.submit(part, whole, first, end, str(file), command, threads, pure=False, retries=2)
        for (first, end), file in zip(ranges, files, strict=True)
        if not file.exists()
    ]
    with bar(parts, "parts", parts - len(futures), progress) as shown:
        for future in as_completed(futures):  # type: ignore[no-untyped-call]
            try:
                future.result()
            except LaminaError:
                raise
            except Exception as failure:
                raise LaminaError(f"a part was not rendered: {failure!r}", 1) from failure
            shown.update()
    run(["merge", *files, "--out", stem])
    shutil.rmtree(folder)
    return read(stem.with_name(stem.name + ".exr"))


def part(whole: list[str], first: int, end: int, file: str, command: str, threads: int) -> None:
    """Renders a range of samples into a file, which is there whole or not at all."""
    place = Path(file)
    if place.exists():
        return
    # Beside it, so that it can be renamed; each attempt has a folder of its own.
    with tempfile.TemporaryDirectory(dir=place.parent, prefix=".part-") as scratch:
        stem = Path(scratch, "part")
        run(
            ["render", *whole, "--samples", f"{first}..{end}", "--threads", str(threads)]
            + ["--out", str(stem)],
            command,
        )
        stem.with_suffix(".part").replace(place)
