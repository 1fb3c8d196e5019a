"""Runs Lamina itself: one picture, with the time and processor time of the render alone.

Wall time is the program's own (`trace_seconds` of `--stats`): rays, film and layers, without
reading, building and writing. Processor time is that of the whole process; what a picture of one
sample a pixel takes is start-up and files, so that the render's own is
(cpu(N) − cpu(1)) N / (N − 1).
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .picture import read_channels


@dataclass(frozen=True)
class Run:
    """One picture and what it took."""

    rgb: NDArray[np.float64]
    # Number of the object at the middle of each pixel; the ground is the first by name.
    objects: NDArray[np.float64]
    wall_s: float
    # Of the whole process, start-up included.
    cpu_s: float
    stats: dict


def render(program: Path, scene: Path, spp: int, seed: int, overrides: tuple[str, ...] = ()) -> Run:
    """Renders one picture; raises with the program's own words if it fails."""
    with tempfile.TemporaryDirectory(prefix="lamina-bench-") as folder:
        stem, stats = Path(folder, "picture"), Path(folder, "stats.json")
        command = [str(program), "render", str(scene), "--spp", str(spp), "--seed", str(seed),
                   "--out", str(stem), "--stats", str(stats)]  # fmt: skip
        for override in overrides:
            command += ["-D", override]
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        assert process.stderr is not None
        said = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError(f"lamina failed ({process.returncode}):\n{said}")
        pixels = read_channels(Path(f"{stem}.exr"), ("R", "G", "B", "id.object"))
        facts = json.loads(stats.read_text(encoding="utf-8"))
    return Run(
        pixels[:, :, :3],
        pixels[:, :, 3],
        float(facts["trace_seconds"]),
        usage.ru_utime + usage.ru_stime,
        facts,
    )


def version(program: Path) -> str:
    """What the program says of itself."""
    done = subprocess.run([str(program), "--version"], capture_output=True, text=True, check=True)
    return done.stdout.strip().removeprefix("lamina ")


def cpu_of_render(cpu: float, cpu_at_one: float, spp: int) -> float:
    """Processor time of the render alone, from the whole process and one of 1 sample a pixel."""
    return (cpu - cpu_at_one) * spp / (spp - 1) if spp > 1 else cpu_at_one
