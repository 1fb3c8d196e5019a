"""What a peer's worker is asked for and what it answers, as files.

A worker runs in its program's own environment: `python -m lamina_bench.NAME_worker JOB.json`. It
loads one scene, then renders every request in turn. Each answer goes to `answers.jsonl` beside the
job as soon as it is known, so that a program that is stopped for its slowness has told the rest.

- **In**: `JOB.json` with `scene` (a `scene.json`), `requests` (`spp`, `seed`, `rgb`: the file to
  write), and what the worker alone understands under `options`.
- **Out**: `rgb` files, `float32` pictures `[height, width, 3]` as NumPy writes them, and answers.
- **Left out**: anything but the standard library and NumPy, which every environment has.
"""

from __future__ import annotations

import json
import resource
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

ANSWERS = "answers.jsonl"


@dataclass(frozen=True)
class Request:
    """One picture that is wanted."""

    spp: int
    seed: int
    rgb: str


@dataclass(frozen=True)
class Answer:
    """One picture that is done: the time of the render alone, without start-up."""

    spp: float
    seed: int
    rgb: str
    wall_s: float
    cpu_s: float
    # Whatever else the program tells.
    more: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Job:
    """A scene and the pictures wanted of it."""

    folder: Path
    scene: dict
    requests: list[Request]
    options: dict


@dataclass(frozen=True)
class Picture:
    """What a program renders for one request; times are measured by `serve` if `None`."""

    rgb: NDArray[np.float32]
    wall_s: float | None = None
    cpu_s: float | None = None
    spp: float | None = None
    more: dict = field(default_factory=dict)


Renderer = Callable[[int, int], Picture]


def read(file: Path) -> Job:
    """Reads a job and the scene that it names."""
    facts = json.loads(file.read_text(encoding="utf-8"))
    scene = Path(facts["scene"])
    return Job(
        scene.parent,
        json.loads(scene.read_text(encoding="utf-8")),
        [Request(**request) for request in facts["requests"]],
        facts["options"],
    )


def write(file: Path, scene: Path, requests: list[Request], options: dict) -> None:
    """Writes a job."""
    facts = {
        "scene": str(scene),
        "requests": [asdict(request) for request in requests],
        "options": options,
    }
    file.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def answers(file: Path) -> tuple[dict, list[Answer]]:
    """What a worker has told so far of the job in `file`: facts of its start, and answers."""
    told = file.parent / ANSWERS
    if not told.exists():
        return {}, []
    lines = [json.loads(line) for line in told.read_text(encoding="utf-8").splitlines()]
    starts = [line["start"] for line in lines if "start" in line]
    return starts[0] if starts else {}, [Answer(**line) for line in lines if "start" not in line]


def cpu_seconds() -> float:
    """Processor time of this process so far, all threads, system included."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def serve(prepare: Callable[[Job], tuple[str, Renderer]]) -> None:
    """Does the job named on the command line.

    `prepare` loads the scene and gives the program's version and a function of (spp, seed).
    """
    file = Path(sys.argv[1])
    job = read(file)
    began = perf_counter()
    version, render = prepare(job)
    with (file.parent / ANSWERS).open("w", encoding="utf-8") as told:

        def tell(facts: dict) -> None:
            print(json.dumps(facts), file=told, flush=True)

        tell({"start": {"version": version, "start_s": perf_counter() - began}})
        for request in job.requests:
            wall, cpu = perf_counter(), cpu_seconds()
            picture = render(request.spp, request.seed)
            cpu, wall = cpu_seconds() - cpu, perf_counter() - wall
            width, height = job.scene["size"]
            if picture.rgb.shape != (height, width, 3):
                raise RuntimeError(f"the picture's shape is {picture.rgb.shape}")
            np.save(request.rgb, np.asarray(picture.rgb, dtype=np.float32))
            answer = Answer(
                spp=picture.spp or request.spp,
                seed=request.seed,
                rgb=request.rgb,
                wall_s=wall if picture.wall_s is None else picture.wall_s,
                cpu_s=cpu if picture.cpu_s is None else picture.cpu_s,
                more={**picture.more, "call_s": wall},
            )
            tell(asdict(answer))
