"""Runs the programs in turn on a scene and works out what the table says.

In every round each program renders the same ladder of samples a pixel with a seed of its own, one
program after the other, so that a drift of the machine hits all alike. From the first ladder comes
how many samples each program can afford in the time that Lamina takes at the ladder's top; a
second series of rounds renders those, Lamina's top among them.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from . import lamina, statistics
from .job import Request
from .programs import Outcome, Program, run
from .statistics import Mean

MOST_SPP = 4096
CLOCKS = {
    "wall": "seconds of the render alone",
    "cpu": "processor seconds of the render alone, over the number of processors",
}
# Means of regions may differ by this share, beyond three standard errors. Programs that multiply
# RGB differ from spectral ones from the third scattering on, and Lamina renders from 400 nm, where
# the blue of the others has 0.4 to 1.6 % more light.
BOUND = 0.02
# Shorter times cannot be told apart, s.
SHORTEST_S = 1e-3


@dataclass(frozen=True)
class Plan:
    """How much is rendered."""

    ladder: tuple[int, ...]
    seeds: int
    limit_s: float
    # What seconds are: "wall", or "cpu": processor seconds over the number of processors, which a
    # machine that others use leaves nearly alone.
    clock: str = "wall"


@dataclass
class Series:
    """All pictures of one program at one number of samples."""

    spp: list[float] = field(default_factory=list)
    wall_s: list[float] = field(default_factory=list)
    cpu_s: list[float] = field(default_factory=list)
    pictures: list[Path] = field(default_factory=list)

    def seconds(self, clock: str) -> float:
        """Median time of a picture by this clock."""
        if clock == "cpu":
            return float(np.median(self.cpu_s)) / (os.cpu_count() or 1)
        return float(np.median(self.wall_s))

    def stack(self) -> NDArray[np.float64]:
        """`[seeds, height, width, 3]`."""
        return np.stack([np.load(file).astype(np.float64) for file in self.pictures])


@dataclass
class Measured:
    """What is known of a program on a scene."""

    program: Program
    version: str = ""
    start_s: list[float] = field(default_factory=list)
    # By the samples asked for; equal time apart.
    series: dict[int, Series] = field(default_factory=dict)
    equal: Series = field(default_factory=Series)
    # Why there is no more.
    reason: str | None = None
    # Relative differences of means, by region, with their standard errors: `[3]` each.
    off: dict[str, tuple[list[float], list[float]]] = field(default_factory=dict)
    agrees: bool = False


def measure(
    scene: Path, chosen: list[Program], plan: Plan, folder: Path, objects: Path
) -> list[Measured]:
    """All programs on one scene; `objects` is a Lamina that tells which pixel shows what."""
    folder.mkdir(parents=True, exist_ok=True)
    found = [Measured(program) for program in chosen]
    for seed in range(1, plan.seeds + 1):
        for one in found:
            ask(one, scene, list(plan.ladder), seed, "ladder", plan, folder)
    budget = top_seconds(found[0], plan) if found[0].program.name == "lamina" else None
    if budget is not None:
        for seed in range(1, plan.seeds + 1):
            for one in found:
                spp = affordable(one, plan, budget)
                if spp is not None:
                    # Other seeds than the ladder's: the two are independent.
                    ask(one, scene, [spp], 1000 + seed, "equal", plan, folder)
    regions = read_regions(objects, scene / "scene.toml")
    compare_means(found, plan, regions)
    return found


def ask(
    one: Measured, scene: Path, ladder: list[int], seed: int, kind: str, plan: Plan, folder: Path
) -> None:
    """One start of one program; a program that failed is not started again."""
    if one.reason is not None:
        return
    name = one.program.name
    print(f"  {scene.name}: {name}, {kind} {ladder} spp, seed {seed}", file=sys.stderr, flush=True)
    requests = [
        Request(spp, seed, str(folder / f"{name}-{kind}-{spp}-{seed}.npy")) for spp in ladder
    ]
    outcome: Outcome = run(one.program, scene / "scene.json", requests, folder, plan.limit_s)
    one.reason = outcome.reason
    if outcome.start:
        one.version = outcome.start["version"]
        # Programs that start anew for every picture tell it with the picture.
        starts = [answer.more["start_s"] for answer in outcome.answers if "start_s" in answer.more]
        one.start_s += starts or [outcome.start["start_s"]]
    for asked, answer in zip(requests, outcome.answers, strict=False):
        series = one.equal if kind == "equal" else one.series.setdefault(asked.spp, Series())
        series.spp.append(answer.spp)
        series.wall_s.append(answer.wall_s)
        series.cpu_s.append(answer.cpu_s)
        series.pictures.append(Path(answer.rgb))


def top_seconds(one: Measured, plan: Plan) -> float | None:
    """Median seconds at the ladder's top, if it was reached with every seed."""
    top = one.series.get(plan.ladder[-1])
    if top is None or len(top.wall_s) < plan.seeds:
        return None
    return top.seconds(plan.clock)


def affordable(one: Measured, plan: Plan, budget_s: float) -> int | None:
    """Samples a pixel that take a program about the budget."""
    seconds = top_seconds(one, plan)
    if seconds is None or not seconds > 0.0:
        return None
    if one.program.name == "lamina":
        return plan.ladder[-1]
    return max(1, min(MOST_SPP, round(plan.ladder[-1] * budget_s / seconds)))


def read_regions(program: Path, scene: Path) -> dict[str, NDArray[np.bool_]]:
    """Picture, leaf and ground; the latter two without pixels at the border of both."""
    # Objects are numbered from 1 in the order of their names: the ground comes first.
    ground = lamina.render(program, scene, 1, 0).objects == 1
    height, width = ground.shape
    inner = np.zeros_like(ground)
    inner[1:-1, 1:-1] = np.all(
        [
            ground[1 + dy : height - 1 + dy, 1 + dx : width - 1 + dx] == ground[1:-1, 1:-1]
            for dy in (-1, 0, 1)
            for dx in (-1, 0, 1)
        ],
        axis=0,
    )
    regions = {"picture": np.ones_like(ground), "leaf": inner & ~ground, "ground": inner & ground}
    return {name: region for name, region in regions.items() if region.any()}


def compare_means(found: list[Measured], plan: Plan, regions: dict[str, NDArray[np.bool_]]) -> None:
    """Sets `off` and `agrees`: every program against the median of all, region by region.

    All samples of a program's ladder go into its means. The median takes no program for the judge.
    """
    means: dict[str, dict[str, Mean]] = {}
    for one in found:
        top = one.series.get(plan.ladder[-1])
        if top is not None and len(top.pictures) >= statistics.LEAST_SEEDS:
            stack = top.stack()
            means[one.program.name] = {
                name: statistics.region_mean(stack, region) for name, region in regions.items()
            }
    for one in found:
        ours = means.get(one.program.name)
        if ours is None:
            continue
        one.agrees = True
        for name, mean in ours.items():
            others = [theirs[name] for theirs in means.values()]
            consensus = Mean(
                np.median([other.value for other in others], axis=0),
                np.median([other.error for other in others], axis=0),
            )
            off, error = statistics.disagreement(mean, consensus)
            one.off[name] = (off.tolist(), error.tolist())
            one.agrees &= statistics.agrees(mean, consensus, BOUND)


def reference(found: list[Measured]) -> NDArray[np.float64]:
    """The best picture of a scene: every agreeing program's mean over all samples, averaged."""
    pictures = []
    for one in found:
        if not one.agrees:
            continue
        parts = [*one.series.values(), *([one.equal] if one.equal.pictures else [])]
        weights = [sum(part.spp) for part in parts]
        means = [part.stack().mean(axis=0) for part in parts]
        pictures.append(np.average(means, axis=0, weights=weights))
    if not pictures:
        raise RuntimeError("no program has pictures whose means agree with the others'")
    return np.mean(pictures, axis=0)


def facts(found: list[Measured], plan: Plan, progress: Callable[[str], None] = print) -> list[dict]:
    """Everything that the table needs, program by program, as plain data."""
    try:
        truth = reference(found)
    except RuntimeError as reason:
        progress(str(reason))
        truth = None
    rows = []
    for one in found:
        row: dict = {
            "program": one.program.name,
            "title": one.program.title,
            "version": one.version,
            "spectral": one.program.spectral,
            "start_s": float(np.median(one.start_s)) if one.start_s else None,
            "reason": one.reason,
            "off": one.off,
            "agrees": one.agrees,
            "points": [],
            "equal_time": None,
        }
        if truth is not None:
            row["points"] = [
                point(series, truth, one.agrees, plan.clock)
                for _, series in sorted(one.series.items())
                if len(series.pictures) >= plan.seeds
            ]
            if len(one.equal.pictures) >= plan.seeds:
                row["equal_time"] = point(one.equal, truth, one.agrees, plan.clock)
        rows.append(row)
    return rows


def point(series: Series, truth: NDArray[np.float64], agrees: bool, clock: str) -> dict:
    """One number of samples: times, error, and efficiency unless the means disagree."""
    error = statistics.rel_mse(series.stack(), truth)
    spp = float(np.median(series.spp))
    # Cycles tells whole hundredths: a picture of a few pixels takes none.
    seconds = max(series.seconds(clock), SHORTEST_S)
    return {
        "spp": spp,
        "seconds": seconds,
        "wall_s": series.seconds("wall"),
        "cpu_s": float(np.median(series.cpu_s)),
        "all_wall_s": series.wall_s,
        "all_cpu_s": series.cpu_s,
        "rel_mse": error,
        "mpaths_per_s": 1e-6 * spp * truth.shape[0] * truth.shape[1] / seconds,
        "efficiency": statistics.efficiency(error, seconds) if agrees else None,
    }
