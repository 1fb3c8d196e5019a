"""The programs that are compared, and how each is started."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from . import environments, job
from .environments import Unavailable

# Version of Embree in the wheel; the wheel's own number has a suffix.
EMBREE = "Embree 4.4.0"
# Ends the names of programs whose sampler is not their default, but a better one of theirs.
TUNED = "-jitter"


@dataclass(frozen=True)
class Program:
    """One way to render."""

    name: str
    title: str
    # Module of the worker.
    worker: str
    spectral: bool
    # The worker's Python and its options; raises `Unavailable`.
    make: Callable[[], tuple[Path, dict]]


def programs(lamina: Path) -> list[Program]:
    """All of them, Lamina first."""

    def of_lamina() -> tuple[Path, dict]:
        if not lamina.exists():
            raise Unavailable(f"{lamina} is missing: cargo build --release")
        return environments.own_python(), {"program": str(lamina.resolve())}

    def of_mitsuba(variant: str, sampler: str) -> Callable[[], tuple[Path, dict]]:
        return lambda: (environments.own_python(), {"variant": variant, "sampler": sampler})

    def of_tracer() -> tuple[Path, dict]:
        return environments.own_python(), {
            "program": str(environments.tracer()),
            "version": EMBREE,
        }

    return [
        Program("lamina", "Lamina", "lamina_worker", True, of_lamina),
        Program("cycles", "Cycles", "cycles_worker", False,
                lambda: (environments.python_of("cycles"), {})),
        Program("mitsuba-rgb", "Mitsuba llvm_ad_rgb", "mitsuba_worker", False,
                of_mitsuba("llvm_ad_rgb", "independent")),
        Program("mitsuba-spectral", "Mitsuba llvm_ad_spectral", "mitsuba_worker", True,
                of_mitsuba("llvm_ad_spectral", "independent")),
        Program(f"mitsuba-rgb{TUNED}", "Mitsuba llvm_ad_rgb, multijitter", "mitsuba_worker", False,
                of_mitsuba("llvm_ad_rgb", "multijitter")),
        Program(f"mitsuba-spectral{TUNED}", "Mitsuba llvm_ad_spectral, multijitter",
                "mitsuba_worker", True, of_mitsuba("llvm_ad_spectral", "multijitter")),
        Program("mitsuba-scalar", "Mitsuba scalar_spectral (Eradiate's build)", "mitsuba_worker",
                True, lambda: (environments.python_of("mitsuba-eradiate"),
                               {"variant": "scalar_spectral"})),
        Program("luxcore", "LuxCore PATHCPU", "luxcore_worker", False,
                lambda: (environments.python_of("luxcore"), {})),
        Program("embree", "bare Embree tracer", "embree_worker", False, of_tracer),
    ]  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """What came of one start of a program: answers, and why there are not more of them."""

    start: dict
    answers: list[job.Answer]
    reason: str | None


def run(
    program: Program, scene: Path, requests: list[job.Request], folder: Path, limit_s: float
) -> Outcome:
    """Starts a program's worker on a scene and waits, at most `limit_s`."""
    try:
        python, options = program.make()
    except Unavailable as reason:
        return Outcome({}, [], str(reason))
    file = folder / "job.json"
    with tempfile.TemporaryDirectory(prefix="lamina-bench-") as scratch:
        job.write(file, scene, requests, {**options, "scratch": scratch})
        (folder / job.ANSWERS).unlink(missing_ok=True)
        path = str(environments.HERE)
        command = [str(python), "-m", f"lamina_bench.{program.worker}", str(file)]
        environment = {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"}
        with (folder / f"{program.name}.log").open("w", encoding="utf-8") as log:
            reason = None
            try:
                done = subprocess.run(command, env=environment, stdout=log, stderr=log,
                                      timeout=limit_s, check=False)  # fmt: skip
                if done.returncode != 0:
                    reason = f"ended with {done.returncode}: {last_words(Path(log.name))}"
            except subprocess.TimeoutExpired:
                reason = f"had not finished after {limit_s:.0f} s"
    start, answers = job.answers(file)
    if reason is None and len(answers) < len(requests):
        reason = f"gave {len(answers)} of {len(requests)} pictures"
    return Outcome(start, answers, reason)


def last_words(log: Path) -> str:
    """The last line that says something."""
    lines = [line.strip() for line in log.read_text("utf-8", "replace").splitlines()]
    return next((line for line in reversed(lines) if line), "no message")[:200]
