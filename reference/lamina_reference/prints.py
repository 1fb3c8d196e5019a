"""Renders a scene for print: `reference/print SCENE.toml --out FOLDER`.

Several renders of other seeds, the twins, are denoised each alone; their mean is the picture, and
`twins` tells what is left of its noise, and the bias. What was done is told as a line of a table.

The first twin begins with a few samples everywhere. They tell by which target noise the time for a
twin goes where it is needed: what is even has enough of them, what is noisy gets the rest.

- In: a scene file; seconds for each twin.
- Out, in FOLDER: NAME-1.exr, NAME-1.json (times, memory) and so on of each twin; NAME.exr, and
  NAME.jpg to look at; `cache` with grown leaves.
- Always true: what one twin has rendered stays if another fails.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio

from . import denoise
from .exr import Array
from .noise import LEAST_SAMPLES, PERCENT, luminance_and_error, relative_error, summary
from .program import program

LEAST_TWINS = 2
# How the program judges where there is enough (the book, Adaptive sampling): not before so many
# samples, in steps of so many, by blocks of so many pixels across, of which dark ones are relative
# to a share of the picture's mean too.
FIRST = 32
STEP = 16
BLOCK = 8
FLOOR = 0.1
# A target that every part meets at once; the greatest that the program takes.
LARGEST_AIM = 1.0
HEADER = (
    "| scene | size | samples | seconds | memory, GB | as traced: within 1 %, 95 % within | "
    "as shown: within 1 %, 95 % within | bias |\n|---|---|---|---|---|---|---|---|"
)


@dataclass
class Twin:
    """One render: its picture, and what it took."""

    picture: Path
    samples: float
    seconds: float
    mebibytes: float


def name_of(scene: Path) -> str:
    """What a scene is called: by its folder if the file is `scene.toml`."""
    return scene.resolve().parent.name if scene.stem == "scene" else scene.stem


class Stopped(Exception):
    """A render ended with this exit status, and said why itself."""

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


def trace(options: argparse.Namespace, seed: int, *words: object) -> dict[str, Any]:
    """Runs the program with these words too, and returns what it tells of its run.

    What it says meanwhile is passed on.
    """
    stem = options.out / f"{name_of(options.scene)}-{seed}"
    stats = stem.with_name(f"{stem.name}.json")
    line = [str(program()), "render", str(options.scene), "--seed", str(seed)]
    line += ["--cache", str(options.out / "cache"), "--out", f"{stem}.jpg", "--stats", str(stats)]
    line += [str(word) for word in words]
    line += [word for key in options.overrides for word in ("-D", key)]
    try:
        status = subprocess.run(line, check=False, stdout=subprocess.DEVNULL).returncode
    except OSError as error:
        raise denoise.Failed(f"{line[0]}: {error.strerror}: cargo build --release") from error
    if status != 0:
        raise Stopped(status)
    told: dict[str, Any] = json.loads(stats.read_text(encoding="utf-8"))
    return told


def render(options: argparse.Namespace, seed: int, noise: float) -> Twin:
    """One twin, in one go."""
    limits = ("--spp", options.spp, "--noise", noise, "--time", options.seconds)
    told = trace(options, seed, *limits)
    picture = options.out / f"{name_of(options.scene)}-{seed}.exr"
    return Twin(picture, told["spp"], told["seconds"], told["peak_mib"])


def render_first(options: argparse.Namespace, seed: int) -> tuple[Twin, float]:
    """The first twin, and the target noise for which the time of a twin is about enough."""
    if options.noise == 0 or options.spp <= FIRST:
        return render(options, seed, options.noise), options.noise
    picture = options.out / f"{name_of(options.scene)}-{seed}.exr"
    checkpoint = picture.with_suffix(".checkpoint")
    kept = ("--checkpoint", checkpoint)
    limits = ("--spp", FIRST, "--noise", LARGEST_AIM, "--time", options.seconds)
    told = trace(options, seed, *limits, *kept)
    twin = Twin(picture, told["spp"], told["seconds"], told["peak_mib"])
    left = options.seconds - twin.seconds
    if twin.samples < FIRST or left < 1:
        return twin, options.noise
    affordable = FIRST * (1 + left / told["trace_seconds"])
    noise = aim(errors_of_blocks(picture), affordable, options.spp, options.noise)
    print(
        f"{FIRST} samples everywhere took {twin.seconds:.0f} s; in {left:.0f} s more, noisy parts "
        f"can reach {noise / PERCENT:.2g} %",
        file=sys.stderr,
    )
    limits = ("--spp", options.spp, "--noise", noise, "--time", left)
    told = trace(options, seed, *limits, *kept, "--resume")
    checkpoint.unlink(missing_ok=True)
    seconds, mebibytes = twin.seconds + told["seconds"], max(twin.mebibytes, told["peak_mib"])
    return Twin(picture, told["spp"], seconds, mebibytes), noise


def errors_of_blocks(picture: Path) -> Array:
    """The relative error of each block of pixels, as the program judges it."""
    bright, error, _ = luminance_and_error(str(picture))
    rows, columns = (np.arange(0, length, BLOCK) for length in bright.shape)

    def total(values: Array) -> Array:
        return np.asarray(np.add.reduceat(np.add.reduceat(values, rows, 0), columns, 1))

    pixels = total(np.ones_like(bright))
    scale = total(bright) / pixels + FLOOR * bright.mean()
    return np.asarray(np.sqrt(total(error**2) / pixels) / np.maximum(scale, np.finfo(float).tiny))


def aim(errors: Array, affordable: float, most: int, least: float) -> float:
    """The lowest target noise from `least` on that `affordable` samples a pixel are enough for.

    `affordable` is a mean over blocks, `errors` are the blocks' own at `FIRST` samples and fall
    with the root of their number; no block gets more samples than `most`. Noisy parts take longer
    a sample than even ones, of which this knows nothing: the limit of time holds all the same.
    """

    def samples(noise: float) -> float:
        needed = STEP * np.ceil(FIRST * (errors / noise) ** 2 / STEP)
        return float(np.clip(needed, FIRST, most).mean())

    low, high = least, LARGEST_AIM
    if samples(low) <= affordable:
        return low
    while high / low > 1 + PERCENT:
        middle = float(np.sqrt(low * high))
        low, high = (low, middle) if samples(middle) <= affordable else (middle, high)
    return high


def noise(picture: Path) -> tuple[float, float]:
    """Percent of pixels within 1 %, and the error in percent that 95 % do not exceed."""
    within, _, most = summary(relative_error(str(picture))[0])
    return within, most


def row(name: str, twins: Sequence[Twin], shown: Path) -> str:
    """What was done, as a line below `HEADER`."""
    image = oiio.ImageInput.open(str(shown))
    spec = image.spec()
    image.close()
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
        prog="reference/print",
        description="Renders a scene for print: the mean of several renders, each denoised, with "
        "what is left of the noise and the bias.",
        allow_abbrev=False,
    )
    parser.add_argument("scene", type=Path, metavar="SCENE.toml")
    parser.add_argument("--out", type=Path, default=Path(), metavar="FOLDER")
    parser.add_argument(
        "--twins", type=int, default=4, metavar="N", help="number of renders (default: 4)"
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
        "-D",
        dest="overrides",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="override a value of the scene, as `lamina render` does",
    )
    options = parser.parse_args(words)
    if options.twins < LEAST_TWINS:
        parser.error(f"--twins {options.twins}: one picture does not tell its noise; 2 or more")
    if not 0 <= options.noise <= LARGEST_AIM:
        parser.error(f"--noise {options.noise}: from 0 to 1")
    if not options.out.is_dir():
        parser.error(f"--out {options.out}: there is no such folder")
    return options


def run(options: argparse.Namespace) -> None:
    """Renders, denoises, and tells what was done."""
    # Whether it is there is known before the renders, which take many minutes.
    denoise.Denoiser()
    twin, target = render_first(options, 1)
    twins = [twin, *(render(options, seed, target) for seed in range(2, options.twins + 1))]
    name = name_of(options.scene)
    first, *others = (twin.picture for twin in twins)
    shown = options.out / f"{name}.exr"
    denoise.run(
        argparse.Namespace(
            picture=first,
            twin=others,
            out=shown,
            png=options.out / f"{name}.jpg",
            no_guides=False,
        )
    )
    print(f"\n{HEADER}\n{row(name, twins, shown)}")


def main(words: list[str] | None = None) -> int:
    """Renders a scene for print; the exit codes of `lamina`."""
    try:
        run(arguments(words))
    except Stopped as stopped:
        return stopped.status
    except (denoise.Refused, denoise.Failed) as error:
        print(f"reference/print: {error}", file=sys.stderr)
        return 2 if isinstance(error, denoise.Refused) else 1
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
