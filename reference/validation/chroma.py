"""How saturated green leaves look in pictures, and why: `reference/run chroma`.

A flat leaf beside a perfect white diffuser, seen from above under several lights. Lightness L* and
chroma C* (CIELAB, D65) of the leaf relative to the diffuser's light come from the linear EXR; those
of the PNG with `tone = "filmic"` from its pixels, at the exposure that makes the diffuser 1 before
the curve.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from lamina.exr import read_channels
from validation import colour
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
LEAVES = ("sun-green", "shade-thin", "dark-evergreen")

SKY = "[lights.sky.constant]\nradiance_w_m2_sr_nm = { d65 = 1 }\n"
SUN = """[lights.sun.distant]
irradiance_w_m2_nm = {{ d65 = 3.14159 }}
towards = {}
angular_diameter_deg = 0.5
"""
BLACK = """[objects.ground]
mesh = "ground"
material = "black"
position_m = [0, 0, -0.0005]
"""
# What lights the leaf, whether black ground keeps light from its underside, where it is seen from.
ABOVE = "[0, -0.001, 0.3]"
CASES = {
    "sky, black ground": (SKY, BLACK, ABOVE),
    "sky above and below": (SKY, "", ABOVE),
    "sun at 44°, black ground": (SUN.format("[0, 0.7, 0.714]"), BLACK, ABOVE),
    "sun, seen in its glint": (SUN.format("[0, 0.5, 0.866]"), BLACK, "[0, -0.15, 0.26]"),
}

SCENE = """format = 1
[film.rgb]
size = [48, 24]
spp = 256
[picture]
tone = "filmic"
[camera.perspective]
position_m = {eye}
look_at_m = [0, 0, 0]
up = [0, 1, 0]
vertical_fov_deg = 8
[materials.leaf.leaf]
preset = "{leaf}"
[materials.white.diffuse]
reflectance = 1
[materials.black.diffuse]
reflectance = 0
[meshes.blade.rectangle]
width_m = 0.04
height_m = 0.1
[meshes.ground.rectangle]
width_m = 2
height_m = 2
[objects.leaf]
mesh = "blade"
material = "leaf"
position_m = [-0.025, 0, 0]
[objects.card]
mesh = "blade"
material = "white"
position_m = [0.025, 0, 0]
{ground}{light}"""


def pixels(file: Path) -> np.ndarray:
    """A picture's red, green and blue, `[height, width, 3]`."""
    channels = read_channels(file)
    return np.stack([channels[name] for name in "RGB"], axis=2)


def seen(binary: Path, scene: str) -> tuple[tuple[float, float], tuple[float, float]]:
    """L* and C* of the leaf in the linear picture and in the filmic PNG."""
    with tempfile.TemporaryDirectory() as folder:
        file, out = Path(folder) / "scene.toml", Path(folder) / "picture"
        file.write_text(scene, encoding="utf-8")
        done = subprocess.run(
            [str(binary), "render", str(file), "--out", str(out)],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            raise RuntimeError(f"lamina render failed ({done.returncode}):\n{done.stderr}")
        linear = pixels(out.with_suffix(".exr"))
        toned = pixels(out.with_suffix(".png"))
    leaf, white = (np.s_[8:16, 8:16], np.s_[8:16, 32:40])
    share = linear[leaf].mean((0, 1)) / linear[white].mean()
    return colour.lightness_chroma(share), colour.lightness_chroma_of_srgb(toned[leaf].mean((0, 1)))


def markdown(binary: Path) -> str:
    """The table that is recorded."""
    lines = [
        "## How saturated green leaves look",
        "",
        "L* / C* (CIELAB, D65, the white diffuser beside it is L* 100) of flat leaves with the "
        "contents of three presets. *Reflectance*: of the leaf's R alone, as an integrating sphere "
        "sees it. *Filmic*: of the PNG.",
        "",
        "| leaf | reflectance | " + " | ".join(f"{case} | filmic" for case in CASES) + " |",
        "| --- | --- |" + " --- | --- |" * len(CASES),
    ]
    for leaf in LEAVES:
        cells = ["{:.0f} / {:.0f}".format(*reflectance(binary, leaf))]
        for light, ground, eye in CASES.values():
            scene = SCENE.format(leaf=leaf, light=light, ground=ground, eye=eye)
            cells += ["{:.0f} / {:.0f}".format(*pair) for pair in seen(binary, scene)]
        lines.append(f"| {leaf} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def reflectance(binary: Path, leaf: str) -> tuple[float, float]:
    """L* and C* of the preset's R under D65."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "leaf.csv"
        subprocess.run(
            [str(binary), "optics", "--preset", leaf, "--out", str(file)],
            capture_output=True,
            check=True,
        )
        nm, r, _ = np.loadtxt(file, delimiter=",", skiprows=3).T
    return colour.lightness_chroma_of_xyz(colour.xyz_under_d65(nm, r))


def main() -> int:
    """Measures and prints the table."""
    parser = argparse.ArgumentParser(prog="reference/run chroma", description=__doc__)
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument("--results", type=Path, default=ROOT / "out" / "reference")
    parser.add_argument(
        "--record", action="store_true", help="write to reference/results, which is committed"
    )
    options = parser.parse_args()
    if not options.lamina.is_file():
        print(f"{options.lamina} is missing: run cargo build --release", file=sys.stderr)
        return 1
    text = markdown(options.lamina)
    folder = ROOT / "reference" / "results" if options.record else options.results
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "chroma.md").write_text(text + "\n", encoding="utf-8")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
