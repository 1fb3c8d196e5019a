"""Makes each peer's own environment below `.venv-bench`, which git ignores, and keeps it.

Mitsuba 3.9.1 is part of the reference environment (`reference/setup`) and needs nothing here. The
other peers get a virtual environment of Python 3.11 each, from pinned and hashed requirements; the
bare Embree tracer is compiled against the library in the wheel `embreex`. Nothing is installed
outside. What cannot be had is [`Unavailable`], with the reason for the table.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
ROOT = HERE.parents[1]
FOLDER = ROOT / ".venv-bench"
PYTHON = "python3.11"
TRACER = HERE / "embree"
COMPILE = ("-std=c++20", "-O3", "-march=native", "-Wall", "-Wextra", "-pthread")


class Unavailable(Exception):
    """A program that cannot be had here; the message says why and what would help."""


def _run(command: list[str], what: str) -> None:
    """Runs a command; its last words are the reason if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines() or ["no message"]
        raise Unavailable(f"{what}: {lines[-1].strip()}")


def python_of(name: str) -> Path:
    """The Python of a peer's environment, made if need be."""
    requirements = HERE / "requirements" / f"{name}.txt"
    folder = FOLDER / name
    stamp = folder / "requirements.sha256"
    wanted = hashlib.sha256(requirements.read_bytes()).hexdigest()
    python = folder / "bin" / "python"
    if python.exists() and stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return python
    if shutil.which(PYTHON) is None:
        raise Unavailable(
            f"needs {PYTHON}: sudo apt-get install python3.11 python3.11-venv (Debian 12)"
        )
    print(f"making the environment of {name} in .venv-bench, once", file=sys.stderr)
    shutil.rmtree(folder, ignore_errors=True)
    _run([PYTHON, "-m", "venv", str(folder)], f"{PYTHON} makes no environment")
    _run(
        [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
         "--only-binary=:all:", "--require-hashes", "-r", str(requirements)],
        "pip cannot install it",
    )  # fmt: skip
    stamp.write_text(wanted, encoding="utf-8")
    return python


def tracer() -> Path:
    """The bare Embree tracer, compiled if its source is newer."""
    python = python_of("embree")
    program = python.parent / "peer"
    sources = sorted(TRACER.glob("*.cpp"))
    newest = max(file.stat().st_mtime for file in TRACER.iterdir())
    if program.exists() and program.stat().st_mtime > newest:
        return program
    if shutil.which("g++") is None:
        raise Unavailable("needs a C++ compiler: sudo apt-get install g++")
    folders = list((python.parents[1] / "lib").glob("python*/site-packages/embreex.libs"))
    libraries = [str(file) for folder in folders for file in sorted(folder.glob("lib*.so*"))]
    if not libraries:
        raise Unavailable("the wheel `embreex` brought no library")
    _run(
        ["g++", *COMPILE, "-o", str(program), *map(str, sources), *libraries,
         f"-Wl,-rpath,{folders[0]}"],
        "g++ cannot compile the bare tracer",
    )  # fmt: skip
    return program


def own_python() -> Path:
    """The reference environment, which this runs in: it has Mitsuba."""
    return Path(sys.executable)
