"""Channels that are lost, before and after the tone: `reference/run channels`.

For each picture the share of pixels in which a channel is exactly 0 or below though the pixel has
light, and in which one is at the top of the scale. An EXR is counted twice: as it is (linear sRGB,
of which a display has 0 to 1, times the exposure of its scene), and as `lamina tonemap` makes a
picture of 16 bits of it. A PNG or JPEG is counted as it is.

With `--scenes` the scenes below are rendered small. In those with a rig, paper that reflects 0.8
must come out at 0.8 ± 0.05 of the sRGB scale with the tone `"standard"` and the exposure of the
rig.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.program import program
from validation.tones import read

Array = NDArray[np.float64]
ROOT = Path(__file__).resolve().parents[2]
SCENES = (
    "autumn-leaf",
    "compound-leaf",
    "croton",
    "cupped-leaf",
    "daylight",
    "first-leaf",
    "fly-agaric",
    "forest-maple",
    "melons",
    "pigments",
)
RIGS = ("studio", "tent", "lightbox", "overcast", "golden-hour", "forest-edge")
# Rigs of soft boxes and of an even sky, in which a level sheet without anything on it is to be at
# 0.8.
PAPER = (0.8, 0.05)
# Pixels whose strongest channel is weaker than this have no light that counts: half of the first
# step of 8 bits, linear.
DARK = 0.5 / 255 / 12.92


@dataclass
class Counts:
    """Shares of the pixels with light."""

    zero: Array
    """Red, green and blue at 0 or below."""
    top: Array
    """Red, green and blue at the top."""
    any_zero: float
    any_top: float

    @classmethod
    def of(cls, values: Array, has_light: Array) -> Counts:
        """Of values of which 0 is nothing and 1 the top."""
        lit = values[has_light]
        if lit.size == 0:
            return cls(np.zeros(3), np.zeros(3), 0.0, 0.0)
        zero, top = lit <= 0, lit >= 1
        return cls(zero.mean(0), top.mean(0), zero.any(-1).mean(), top.any(-1).mean())

    def cells(self) -> str:
        """Four cells of the table."""
        each = [" ".join(f"{share:.2%}" for share in of) for of in (self.zero, self.top)]
        return f"{self.any_zero:.2%} ({each[0]}) | {self.any_top:.2%} ({each[1]})"


def run(binary: Path, *words: str) -> None:
    """Runs the program."""
    done = subprocess.run([str(binary), *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"lamina {' '.join(words)} failed:\n{done.stderr}")


def colours(file: Path) -> tuple[Array, Array | None, dict[str, str]]:
    """Colours of a picture, the numbers of objects if it tells them, and its attributes of text.

    Of a spectral film the mean over its bands thrice, as it is shown in grey.
    """
    pixels, spec = read(file)
    names = list(spec.channelnames)
    if {"R", "G", "B"} <= set(names):
        light = pixels[:, :, [names.index(name) for name in "RGB"]]
    elif bands := [place for place, name in enumerate(names) if name.startswith("S0.")]:
        light = pixels[:, :, bands].mean(-1, keepdims=True).repeat(3, axis=-1)
    else:
        raise RuntimeError(f"{file}: it has neither channels R, G, B nor bands S0.…nm")
    objects = pixels[:, :, names.index("id.object")] if "id.object" in names else None
    attributes = {entry.name: str(entry.value) for entry in spec.extra_attribs}
    return light, objects, attributes


def row(binary: Path, folder: Path, file: Path, name: str, *words: str) -> tuple[str, float]:
    """A line of the table, and the share of pixels that lose a channel by the tone."""
    if file.suffix != ".exr":
        shown, _, _ = colours(file)
        counts = Counts.of(shown, np.ones(shown.shape[:2], bool))
        return f"| {name} | – | – | {counts.cells()} |", counts.any_zero
    light, _, _ = colours(file)
    out = folder / "shown.png"
    run(binary, "tonemap", str(file), "--out", str(out), "--sixteen-bits", *words)
    shown, _, _ = colours(out)
    has_light = light.max(-1) > DARK
    before, after = Counts.of(light, has_light), Counts.of(shown, has_light)
    return f"| {name} | {before.cells()} | {after.cells()} |", after.any_zero


def paper(binary: Path, folder: Path, file: Path) -> float:
    """The median sRGB value of the object `paper`, of the mean of its channels."""
    out = folder / "paper.png"
    words = ("--tone", "standard", "--exposure-ev", "0", "--sixteen-bits")
    run(binary, "tonemap", str(file), "--out", str(out), *words)
    shown, _, _ = colours(out)
    _, objects, attributes = colours(file)
    named = (line.split(" ", 1) for line in attributes["lamina:objects"].splitlines())
    number = next(int(number) for number, name in named if name == "paper")
    return float(np.median(shown[objects == number].mean(-1)))


def render(binary: Path, folder: Path, scene: str, name: str, *words: str) -> Path:
    """The EXR of a scene, 160 pixels across."""
    out = folder / name
    file = ROOT / "scenes" / scene / "scene.toml"
    line = ["render", str(file), "--spp", "64", "--noise", "0", "--out", str(out)]
    # A leaf that stands in several pictures grows once.
    line += ["--cache", str(folder / "grown"), "-D", "film.rgb.size=[160,120]"]
    run(binary, *line, *words)
    return out.with_suffix(".exr")


def tone_of(scene: str) -> str:
    """The tone that a scene names, or the usual one."""
    text = (ROOT / "scenes" / scene / "scene.toml").read_text(encoding="utf-8")
    return str(tomllib.loads(text).get("picture", {}).get("tone", "standard"))


HEAD = [
    "| picture | before: 0 or below (R G B) | before: 1 or above (R G B) | after: 0 (R G B) | "
    "after: at the top (R G B) |",
    "| --- | --- | --- | --- | --- |",
]


def of_scenes(binary: Path, folder: Path) -> tuple[list[str], list[str]]:
    """Lines of the report, and what is wrong."""
    lines = [
        "Share of the pixels with light of which one channel is 0 or less, and of which one is at "
        "the top; in brackets red, green and "
        "blue by themselves. Before: linear sRGB of the EXR. After: the picture of 16 bits that "
        "`lamina tonemap` makes with the "
        "scene's own tone and exposure, or with the tone that is named. 160 × 120 pixels, 64 "
        "samples a pixel.",
        "",
        *HEAD,
    ]
    wrong = []

    def count(file: Path, name: str, tone: str, *words: str) -> None:
        line, lost = row(binary, folder, file, f"{name}, `{tone}`", *words)
        lines.append(line)
        print(line, file=sys.stderr)
        if tone in ("standard", "agx") and lost > 0:
            wrong.append(f"{name}: {lost:.2%} of its pixels lose a channel by {tone}")

    for scene in SCENES:
        file = render(binary, folder, scene, scene)
        tone = tone_of(scene)
        count(file, scene, tone)
        # The older tones lose channels; what `standard` would make of the same light.
        if tone not in ("standard", "agx"):
            count(file, scene, "standard", "--tone", "standard")
    on_paper = []
    for rig in RIGS:
        words = ("-D", f'lights.set.rig.preset="{rig}"')
        file = render(binary, folder, "rigs", f"rigs-{rig}", *words)
        count(file, f"rigs ({rig})", tone_of("rigs"))
        away = [f"objects.{name}.position_m=[0,0,-9]" for name in ("leaf", "ball")]
        words = (*words, "-D", away[0], "-D", away[1])
        alone = render(binary, folder, "rigs", f"paper-{rig}", *words)
        on_paper.append((rig, paper(binary, folder, file), paper(binary, folder, alone)))
    lines += [
        "",
        "Median of paper that reflects 0.8, in values of the sRGB scale, tone `standard`, "
        "exposure 0; with leaf and ball on it, and alone.",
        "",
        "| rig | with leaf and ball | alone |",
        "| --- | --- | --- |",
    ]
    middle, slack = PAPER
    for rig, among, alone in on_paper:
        lines.append(f"| {rig} | {among:.3f} | {alone:.3f} |")
        if rig in ("studio", "tent", "lightbox") and abs(among - middle) > slack:
            wrong.append(f"{rig}: paper is at {among:.3f}")
    return lines, wrong


def main() -> int:
    """Counts, prints the table and says with its exit code whether all is as it should be."""
    parser = argparse.ArgumentParser(prog="reference/run channels", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help="EXR, PNG or JPEG")
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument("--scenes", action="store_true", help="count in scenes too, and the paper")
    parser.add_argument(
        "--record", action="store_true", help="write to reference/results, which is committed"
    )
    options = parser.parse_args()
    if not options.files and not options.scenes:
        parser.error("name pictures, or --scenes")
    lines, wrong = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        try:
            if options.files:
                lines += HEAD
                lines += [row(options.lamina, folder, file, file.name)[0] for file in options.files]
            if options.scenes:
                found, wrong = of_scenes(options.lamina, folder)
                lines += found
        except (RuntimeError, OSError) as error:
            print(f"reference/run channels: {error}", file=sys.stderr)
            return 2
    text = "\n".join(["## Channels", "", *lines])
    print(text)
    if options.record:
        file = ROOT / "reference" / "results" / "channels.md"
        file.write_text(text + "\n", encoding="utf-8")
    print("\n".join(["wrong:", *wrong]) if wrong else "all as it should be", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
