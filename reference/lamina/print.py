"""Renders a scene for print: `lamina-print SCENE.toml --out FOLDER`.

Several renders of other seeds, the twins, are denoised each alone; their mean is the picture, and
`lamina.twins` estimates what is left of its noise, and the bias. What was done is printed as a line
of a table.

Half of the time goes where single renders are noisy: the first twin begins with a few samples
everywhere, by which its target noise is set. The rest goes where what is shown still errs, which
only the differences of denoised twins show.

- In: a scene file; seconds for each twin.
- Out, in FOLDER: NAME-1.exr, NAME-1.json (times, memory) and so on of each twin; NAME.exr, and
  NAME.jpg to look at; `cache` with grown leaves. If it is to go on later, what each twin needs for
  that: NAME-1.checkpoint and so on, NAME.twins.json, and NAME.errors.npz: how the mean errs.
- Always true: what one twin has rendered stays if another fails.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lamina import denoise
from lamina.allotment import (
    FIRST,
    LARGEST_AIM,
    STEP,
    aim,
    grown,
    samples_of,
    shown_aim,
    shown_errors,
    traced_errors,
    write_map,
)
from lamina.exr import spec_of
from lamina.extras import require
from lamina.film import Failed, Refused
from lamina.kept_print import (
    LEAST_TWINS,
    Shown,
    Twin,
    name_of,
    remember,
    remember_mean,
    remembered,
    remembered_mean,
)
from lamina.noise import LEAST_SAMPLES, PERCENT, relative_error, summary
from lamina.program import LaminaError, allowing, program
from lamina.twins import noise_told_by_others

USUAL_TWINS = 4
# Share of the time that goes where single renders are noisy, before anything is denoised.
BEFORE = 0.5
# Errors of blocks are known from few twins, so that some are larger than they seem: what is aimed
# at is this share of the error that is asked for.
MARGIN = 0.85
HEADER = (
    "| scene | size | samples | seconds | memory, GB | as traced: within 1 %, 95 % within | "
    "as shown: within 1 %, 95 % within | bias |\n|---|---|---|---|---|---|---|---|"
)


class Stopped(Exception):
    """A render ended with this exit status, and said why itself."""

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


def run_program(options: argparse.Namespace, seed: int, *words: object) -> dict[str, Any]:
    """Runs the program with these words too, and returns what it tells of its run.

    What it says meanwhile is passed on.
    """
    stem = options.out / f"{name_of(options.scene)}-{seed}"
    stats = stem.with_name(f"{stem.name}.json")
    line = [str(program()), "render", str(options.scene), "--seed", str(seed)]
    line += ["--cache", str(options.out / "cache"), "--out", f"{stem}.jpg", "--stats", str(stats)]
    line += [str(word) for word in words]
    line += [word for key in options.overrides for word in ("-D", key)]
    line += allowing(options.allow)
    try:
        status = subprocess.run(line, check=False, stdout=subprocess.DEVNULL).returncode
    except OSError as error:
        raise Failed(f"{line[0]}: {error.strerror}: cargo build --release") from error
    if status != 0:
        raise Stopped(status)
    told: dict[str, Any] = json.loads(stats.read_text(encoding="utf-8"))
    return told


def trace(
    options: argparse.Namespace, seed: int, time: float, *words: object, before: Twin | None = None
) -> Twin:
    """A twin, from its first sample or from where it came before; it can go on."""
    picture = options.out / f"{name_of(options.scene)}-{seed}.exr"
    limits = ("--time", time, "--checkpoint", picture.with_suffix(".checkpoint"))
    resumed = ("--resume",) if before else ()
    told = run_program(options, seed, *words, *limits, *resumed)
    return Twin(
        seed=seed,
        picture=picture,
        samples=told["spp"],
        seconds=told["seconds"] + (before.seconds if before else 0.0),
        mebibytes=max(told["peak_mib"], before.mebibytes if before else 0.0),
        building=told["build_seconds"],
        tracing=told["trace_seconds"] + (before.tracing if before else 0.0),
    )


def first_twin(options: argparse.Namespace, time: float) -> tuple[Twin, float]:
    """The first twin, and the target noise for which this time is about enough."""
    twin = trace(options, 1, time, "--spp", FIRST, "--noise", LARGEST_AIM)
    left = time - twin.seconds
    if twin.samples < FIRST or left < 1:
        return twin, options.noise
    affordable = FIRST * (1 + left / twin.tracing)
    noise = aim(traced_errors(twin.picture), affordable, options.spp, options.noise)
    print(
        f"{FIRST} samples everywhere took {twin.seconds:.0f} s; in {left:.0f} s more, noisy parts "
        f"can reach {noise / PERCENT:.2g} %",
        file=sys.stderr,
    )
    limits = ("--spp", options.spp, "--noise", noise)
    return trace(options, 1, left, *limits, before=twin), noise


def improved(
    options: argparse.Namespace, twins: list[Twin], shown: Shown, left: float
) -> list[Twin]:
    """The twins with more samples where what is shown of them errs; as they are if it does not.

    Each has so many seconds left for it.
    """
    if left < 1:
        return twins
    samples = [samples_of(twin.picture) for twin in twins]
    affordable = float(np.mean([twin.samples * left / twin.tracing for twin in twins]))
    least = MARGIN * options.error
    target = shown_aim(samples, shown.errors, affordable, options.spp, least)
    wanted = [
        grown(had, errors, target, options.spp)
        for had, errors in zip(samples, shown.errors, strict=True)
    ]
    if all((more == had).all() for more, had in zip(wanted, samples, strict=True)):
        return twins
    print(
        f"of what is shown, 95 % of the pixels are within {noise(shown.picture)[1]:.2g} %; in "
        f"{left:.0f} s more for each render, what errs most can come to {target / PERCENT:.2g} %",
        file=sys.stderr,
    )
    spec = spec_of(shown.picture)
    shape = spec.height, spec.width
    made = []
    for twin, more in zip(twins, wanted, strict=True):
        file = twin.picture.with_suffix(".map.exr")
        write_map(file, more, shape)
        words = ("--spp", options.spp, "--samples-map", file)
        made.append(trace(options, twin.seed, left, *words, before=twin))
        file.unlink()
    return made


def added(options: argparse.Namespace, twins: Sequence[Twin]) -> list[Twin]:
    """More twins, with their samples where the others have theirs; each has its seconds."""
    samples = np.mean([samples_of(twin.picture) for twin in twins], axis=0)
    left = options.seconds - max(twin.building for twin in twins)
    affordable = max(left, 0.0) * np.mean([twin.samples / twin.tracing for twin in twins])
    share = min(1.0, float(affordable / samples.mean()))
    wanted = np.maximum(STEP * np.round(share * samples / STEP), STEP)
    spec = spec_of(twins[0].picture)
    shape = spec.height, spec.width
    file = options.out / f"{name_of(options.scene)}.map.exr"
    write_map(file, wanted, shape)
    words = ("--spp", options.spp, "--samples-map", file)
    first = 1 + max(twin.seed for twin in twins)
    seeds = range(first, first + options.twins - len(twins))
    made: list[Twin] = []
    try:
        for seed in seeds:
            made.append(trace(options, seed, options.seconds, *words))
            remember(options, [*twins, *made])
    finally:
        file.unlink()
    return made


def noise(picture: Path) -> tuple[float, float]:
    """Percent of pixels within 1 %, and the error in percent that 95 % do not exceed."""
    within, _, most = summary(relative_error(str(picture))[0])
    return within, most


def row(name: str, twins: Sequence[Twin], shown: Path) -> str:
    """What was done, as a line below `HEADER`."""
    spec = spec_of(shown)
    bias = spec.get_string_attribute(denoise.NOTE).rpartition("bias of luminance ")[2]
    # One sample a pixel does not tell its noise.
    known = [noise(twin.picture) for twin in twins if twin.samples >= LEAST_SAMPLES]
    shares, errors = zip(*known, strict=True) if known else ((), ())
    within, error = noise(shown)
    cells = (
        name,
        f"{spec.width} × {spec.height}",
        " + ".join(f"{twin.samples:.0f}" for twin in twins),
        f"{sum(twin.seconds for twin in twins):.0f}",
        f"{max(twin.mebibytes for twin in twins) * 2**20 / 1e9:.1f}",
        f"{between(shares, '.0f')}, {between(errors, '.2g')}" if known else "–",
        f"{within:.1f} %, {error:.2f} %",
        bias,
    )
    return f"| {' | '.join(cells)} |"


def between(values: Sequence[float], digits: str) -> str:
    """The least and the greatest, in percent, as they are told."""
    least, most = (format(value, digits) for value in (min(values), max(values)))
    return f"{least} %" if least == most else f"{least} to {most} %"


def arguments(words: list[str] | None) -> argparse.Namespace:
    """What is to be done."""
    parser = argparse.ArgumentParser(
        prog="lamina-print",
        description="Renders a scene for print: the mean of several renders, each denoised, with "
        "what is left of the noise and the bias.",
        allow_abbrev=False,
    )
    parser.add_argument("scene", type=Path, metavar="SCENE.toml")
    parser.add_argument("--out", type=Path, default=Path(), metavar="FOLDER")
    parser.add_argument(
        "--twins",
        type=int,
        metavar="N",
        help=f"number of renders (default: {USUAL_TWINS}); of two the error is told too small; "
        "more than there are with --resume: those that lack are rendered, the others stay",
    )
    parser.add_argument(
        "--seconds", type=float, default=300.0, help="time for each of them (default: 300)"
    )
    parser.add_argument(
        "--spp", type=int, default=2048, help="most samples a pixel of each (default: 2048)"
    )
    parser.add_argument(
        "--noise",
        type=float,
        default=0.02,
        help="error, before denoising, at which a part of a picture has enough; a greater one if "
        "there is no time for it (default: 0.02; 0: samples are the same everywhere)",
    )
    parser.add_argument(
        "--error",
        type=float,
        default=0.01,
        help="error of what is shown at which a part of it has enough (default: 0.01)",
    )
    parser.add_argument(
        "--keep",
        action="store_true",
        help="keep what it takes to go on later: 60 to 110 bytes a pixel of each render",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="go on from an earlier print that was kept, where what is shown of it errs, for "
        "--seconds more for each render; it is kept again",
    )
    parser.add_argument(
        "-D",
        dest="overrides",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="override a value of the scene, as `lamina render` does",
    )
    parser.add_argument(
        "--allow",
        action="append",
        default=[],
        metavar="DIR",
        help="a folder outside of the scene's own whose files it may name, as in `lamina render`",
    )
    options = parser.parse_args(words)
    if options.twins is not None and options.twins < LEAST_TWINS:
        parser.error(f"--twins {options.twins}: one picture does not tell its noise; 2 or more")
    if not 0 <= options.noise <= LARGEST_AIM:
        parser.error(f"--noise {options.noise}: from 0 to 1")
    if not 0 < options.error <= LARGEST_AIM:
        parser.error(f"--error {options.error}: above 0, at most 1")
    if not options.out.is_dir():
        parser.error(f"--out {options.out}: there is no such folder")
    return options


def mean_of(options: argparse.Namespace, twins: Sequence[Twin]) -> Shown:
    """The mean of denoised twins, as an EXR and a JPEG, and how it errs."""
    name = name_of(options.scene)
    first, *others = (twin.picture for twin in twins)
    picture: Path = options.out / f"{name}.exr"
    mean = denoise.denoise_files(
        argparse.Namespace(
            picture=first,
            twin=others,
            out=picture,
            png=options.out / f"{name}.jpg",
            no_guides=False,
        )
    )
    errors = noise_told_by_others(mean.clean, mean.shares, mean.film.light())
    return Shown(picture, [shown_errors(error) for error in errors])


def run(options: argparse.Namespace) -> None:
    """Renders, denoises, and tells what was done."""
    # Before the renders, which take many minutes.
    require("print", "a print")
    twins, shown, left = remembered_or_first(options)
    more = improved(options, twins, shown, left)
    if more is not twins:
        twins = more
        shown = mean_of(options, twins)
    if options.keep or options.resume:
        remember(options, twins)
        remember_mean(options, twins, shown)
    else:
        for twin in twins:
            twin.checkpoint.unlink(missing_ok=True)
    print(f"\n{HEADER}\n{row(name_of(options.scene), twins, shown.picture)}")


def remembered_or_first(options: argparse.Namespace) -> tuple[list[Twin], Shown, float]:
    """Twins as they are before what is shown tells more; their mean; seconds left for each."""
    if options.resume:
        twins = remembered(options)
        if options.twins is not None and options.twins < len(twins):
            raise Refused(
                f"--twins {options.twins}: there are {len(twins)}, and none is taken away"
            )
        if options.twins is not None and options.twins > len(twins):
            twins += added(options, twins)
            return twins, mean_of(options, twins), 0.0
        shown = remembered_mean(options, twins) or mean_of(options, twins)
        return twins, shown, options.seconds
    seeds = range(1, (options.twins or USUAL_TWINS) + 1)
    if options.noise == 0 or options.spp <= FIRST:
        alike = ("--spp", options.spp, "--noise", 0)
        twins = [trace(options, seed, options.seconds, *alike) for seed in seeds]
        return twins, mean_of(options, twins), 0.0
    time = BEFORE * options.seconds
    twin, target = first_twin(options, time)
    limits = ("--spp", options.spp, "--noise", target)
    twins = [twin, *(trace(options, seed, time, *limits) for seed in seeds[1:])]
    left = min(options.seconds - twin.seconds - twin.building for twin in twins)
    return twins, mean_of(options, twins), left


def main(words: list[str] | None = None) -> int:
    """Renders a scene for print; the exit codes of `lamina`."""
    try:
        run(arguments(words))
    except Stopped as stopped:
        return stopped.status
    except LaminaError as error:
        print(f"lamina-print: {error}", file=sys.stderr)
        return error.code
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
