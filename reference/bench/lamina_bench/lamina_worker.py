"""Renders with Lamina: the program of this project, under the same regime as its peers.

Wall time is the program's own (`trace_seconds` of `--stats`): rays, film and layers, without
reading, building and writing. Processor time of the render alone is `trace_cpu_seconds`, where the
program tells it; else it is worked out from a picture of one sample a pixel (see `lamina`).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import lamina
from .job import Job, Picture, Renderer, serve


def prepare(job: Job) -> tuple[str, Renderer]:
    """Finds the program, and what it takes to start."""
    program = Path(job.options["program"])
    scene = job.folder / "scene.toml"
    start = lamina.render(program, scene, 1, 0)

    def render(spp: int, seed: int) -> Picture:
        run = lamina.render(program, scene, spp, seed)
        cpu = run.stats.get("trace_cpu_seconds")
        if cpu is None:
            cpu = lamina.cpu_of_render(run.cpu_s, start.cpu_s, spp)
        more = {
            "start_s": run.stats["build_seconds"],
            "with_files_s": run.stats["seconds"] - run.stats["build_seconds"],
        }
        return Picture(run.rgb.astype(np.float32), run.wall_s, cpu, more=more)

    return lamina.version(program), render


if __name__ == "__main__":
    serve(prepare)
