"""Runs the notebooks that use the program's files: `reference/run notebooks [--write] [WORD...]`.

A notebook runs from top to bottom in a kernel of its own, in its own folder, where it finds
`lamina` on the path and writes to `made`. Its cells assert what the program's measures say; an
error of a cell fails the notebook. So do printed text that is not what the notebook holds, and a
picture that is missing or empty. `--write` puts in what came out, pictures with 64 colours.
"""

from __future__ import annotations

import argparse
import base64
import difflib
import io
import os
import shutil
import sys
import tempfile
from pathlib import Path
from time import perf_counter

import nbformat
from jupyter_client import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError
from PIL import Image

from validation.program import ROOT, program

FOLDERS = [ROOT / "docs" / "notebooks" / name for name in ("veins", "trust")]
# A cell of the sweep grows 20 leaves, which takes 5 s on 2 processors.
CELL_SECONDS = 300
COLOURS = 64
# Bytes of a PNG of this size that shows nothing but paper.
EMPTY_PICTURE = 2000


class Differs(Exception):
    """What came out is not what the notebook holds."""


def reduced(png: str) -> str:
    """The picture in base64, with few colours, so that notebooks stay small."""
    with Image.open(io.BytesIO(base64.b64decode(png))) as picture:
        small = picture.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    out = io.BytesIO()
    small.save(out, "PNG", optimize=True)
    return base64.b64encode(out.getvalue()).decode()


def ran(notebook: nbformat.NotebookNode, folder: Path, sockets: Path) -> nbformat.NotebookNode:
    """The notebook with fresh outputs, without times, and with small pictures.

    Kernels are spoken to through files in the folder `sockets`, not through ports, so that nobody
    else on the machine can.
    """
    fresh = nbformat.from_dict(notebook)
    kernel = AsyncKernelManager(kernel_name="python3", transport="ipc", ip=str(sockets / "kernel"))
    client = NotebookClient(
        fresh,
        km=kernel,
        timeout=CELL_SECONDS,
        record_timing=False,
        resources={"metadata": {"path": str(folder)}},
    )
    # The client ends the kernel when it is done, as it does with kernels that it made itself.
    client.owns_km = True
    client.execute()
    fresh.metadata = notebook.metadata
    for cell in fresh.cells:
        for output in cell.get("outputs", []):
            if "data" in output and "image/png" in output.data:
                output.data["image/png"] = reduced(output.data["image/png"])
    return fresh


def told(notebook: nbformat.NotebookNode) -> list[str]:
    """Lines of text that all cells print, and a line for each picture."""
    lines = []
    for number, cell in enumerate(notebook.cells):
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if "image/png" in data:
                lines.append(f"cell {number}: a picture")
                continue
            text = output.get("text") or data.get("text/plain", "")
            lines += [f"cell {number}: {line}" for line in text.splitlines()]
    return lines


def check_pictures(notebook: nbformat.NotebookNode) -> None:
    """Every notebook shows something, and no picture is empty."""
    sizes = [
        len(base64.b64decode(output.data["image/png"]))
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "data" in output and "image/png" in output.data
    ]
    if not sizes or min(sizes) < EMPTY_PICTURE:
        raise Differs(f"pictures of {sizes} bytes: none, or an empty one")


def run(file: Path, sockets: Path, write: bool) -> None:
    """Runs one notebook.

    Raises `CellExecutionError` for a cell that fails, and `Differs` for outputs that are not those
    that the file holds.
    """
    notebook = nbformat.read(file, as_version=4)
    fresh = ran(notebook, file.parent, sockets)
    check_pictures(fresh)
    if write:
        nbformat.write(fresh, file)
        return
    difference = list(
        difflib.unified_diff(told(notebook), told(fresh), "the notebook", "this run", lineterm="")
    )
    if difference:
        raise Differs("\n".join(difference) + "\n--write keeps what came out")


def main() -> int:
    """Runs all notebooks, or those whose names hold one of the words."""
    parser = argparse.ArgumentParser(prog="reference/run notebooks", description=__doc__)
    parser.add_argument("--write", action="store_true", help="keep what comes out")
    parser.add_argument("words", nargs="*", metavar="WORD", help="part of a notebook's name")
    arguments = parser.parse_args()

    lamina = program().resolve()
    if not lamina.is_file():
        print(
            f"reference/run notebooks: there is no program {lamina}: "
            "build it with cargo build --release, or name it in LAMINA",
            file=sys.stderr,
        )
        return 1
    files = [
        file
        for folder in FOLDERS
        for file in sorted(folder.glob("*.ipynb"))
        if not arguments.words or any(word in file.stem for word in arguments.words)
    ]
    if not files:
        print(f"reference/run notebooks: no notebook is called {arguments.words}", file=sys.stderr)
        return 1

    # What an earlier program made must not be read.
    for folder in FOLDERS:
        shutil.rmtree(folder / "made", ignore_errors=True)
    passed, failed = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "lamina").symlink_to(lamina)
        os.environ["PATH"] = folder + os.pathsep + os.environ["PATH"]
        for file in files:
            began = perf_counter()
            try:
                run(file, Path(folder), arguments.write)
                passed += 1
                print(f"ok    {file.stem} ({perf_counter() - began:.1f} s)", file=sys.stderr)
            except (CellExecutionError, Differs) as failure:
                failed += 1
                print(f"FAIL  {file.stem}\n{failure}", file=sys.stderr)
    print(f"notebooks: {passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
