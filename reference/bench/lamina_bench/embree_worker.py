"""Renders with the bare tracer on Embree: plain random numbers, no choices that cost anything.

It stands for what a plain native renderer reaches on this machine; its source is in `embree/`.
"""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np

from .job import Job, Picture, Renderer, serve


def prepare(job: Job) -> tuple[str, Renderer]:
    """Takes the program that the job names."""
    program = job.options["program"]
    out = Path(job.options["scratch"], "embree.f32")
    width, height = job.scene["size"]

    def render(spp: int, seed: int) -> Picture:
        done = subprocess.run(
            [program, "render", str(job.folder), str(spp), str(seed), str(os.cpu_count()),
             str(out)],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        facts = json.loads(done.stdout)
        rgb = np.fromfile(out, dtype="<f4").reshape(height, width, 3)
        more = {"rays": facts["rays"], "start_s": facts["start_s"]}
        return Picture(rgb, facts["wall_s"], facts["cpu_s"], more=more)

    return job.options["version"], render


if __name__ == "__main__":
    serve(prepare)
