"""Holds a leaf in Babylon.js, which implements diffuse transmission, against Lamina's picture."""

from __future__ import annotations

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lamina.exr import Array, read_channels
from validation.program import ROOT, program

colour = pytest.importorskip("colour")

MODULES = ["puppeteer-core@25.16.0", "@babylonjs/core@9.35.0", "@babylonjs/loaders@9.28.0"]
WIDTH, HEIGHT, HEIGHT_M = 300, 200, 0.1
# A flat leaf, white beside it, and a grown leaf between.
SCENE = f"""
format = 1
[film.rgb]
size = [{WIDTH}, {HEIGHT}]
spp = 64
[camera.orthographic]
position_m = [0, 0, 0.3]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
height_m = {HEIGHT_M}
[materials.leaf.leaf]
adaxial = {{ eta = 1.45, alpha_across = 0.25, alpha_along = 0.15 }}
abaxial = {{ eta = 1.4, alpha = 0.5 }}
[materials.leaf.leaf.contents]
structure = 1.6
chlorophyll_ug_per_cm2 = 45
carotenoids_ug_per_cm2 = 10
anthocyanins_ug_per_cm2 = 0.5
water_cm = 0.011
dry_matter_g_per_cm2 = 0.006
[materials.white.diffuse]
reflectance = 1.0
[meshes.card.rectangle]
width_m = 0.04
height_m = 0.08
[objects.known]
mesh = "card"
material = "leaf"
position_m = [-0.05, 0, 0]
[objects.white]
mesh = "card"
material = "white"
position_m = [0.05, 0, 0]
[leaves.birch]
preset = "birch-autumn"
length_mm = 70
[objects.birch]
leaf = "birch"
position_m = [0, -0.03, 0]
"""


def suns(side: int) -> str:
    """Six suns, each for as much of the irradiance by a hemisphere of even light."""
    blocks = ""
    for number, part in enumerate((1 / 6, 3 / 6, 5 / 6)):
        polar = math.asin(math.sqrt(part))
        for turn in (0.5 + number, 0.5 + number + math.pi):
            x, y = math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn)
            blocks += f"""
[lights.sun-{number}-{turn > 3}.distant]
irradiance_w_m2_nm = {{ d65 = {1 / math.cos(polar)} }}
towards = [{x}, {y}, {side * math.cos(polar)}]
angular_diameter_deg = 1
""".replace("True", "b").replace("False", "a")
    return blocks


def across(first_m: float, last_m: float) -> tuple[slice, slice]:
    """The pixels of a card between two places in x."""
    columns = [int(WIDTH / 2 + x * HEIGHT / HEIGHT_M) for x in (first_m, last_m)]
    return slice(60, 140), slice(*columns)


def linear(file: Path) -> Array:
    stored = np.asarray(Image.open(file).convert("RGB"), float) / 255
    low = stored <= 0.04045
    return np.where(low, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def lab(rgb: Array) -> Array:
    xyz = colour.RGB_to_XYZ(rgb, "sRGB", apply_cctf_decoding=False)
    white = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["D65"]
    return np.asarray(colour.XYZ_to_Lab(xyz, white))


@pytest.mark.deep
@pytest.mark.needs("PIL", "colour")
def test_mean_colours_in_reflection_and_transmission_are_those_of_lamina(tmp_path: Path) -> None:
    tools = {name: shutil.which(name) for name in ("node", "npm", "chromium")}
    if missing := [name for name, place in tools.items() if place is None]:
        pytest.skip(f"needs {', '.join(missing)}")
    words = ["npm", "install", "--no-audit", "--no-fund", "--prefix", str(tmp_path), *MODULES]
    if subprocess.run(words, capture_output=True, check=False).returncode != 0:
        pytest.skip(f"npm does not install {', '.join(MODULES)}")
    whites, found = [], {}
    for name, side in (("reflection", 1), ("transmission", -1)):
        scene = tmp_path / f"{name}.toml"
        scene.write_text(SCENE + suns(side), encoding="utf-8")
        stem, glb = tmp_path / name, tmp_path / f"{name}.glb"
        picture = tmp_path / f"{name}-viewer.png"
        lamina = str(program())
        subprocess.run([lamina, "render", str(scene), "--out", str(stem)], check=True)
        subprocess.run([lamina, "export", "gltf", str(scene), "--out", str(glb)], check=True)
        viewer = ["node", str(ROOT / "reference/validation/gltf_viewer.mjs"), str(tmp_path)]
        numbers = [str(number) for number in (WIDTH, HEIGHT, HEIGHT_M, side)]
        shown = [str(glb), str(picture), str(tools["chromium"]), *numbers]
        subprocess.run([*viewer, *shown], check=True, timeout=600)
        channels = read_channels(stem.with_suffix(".exr"))
        pictures = [np.stack([channels[c] for c in "RGB"], -1), linear(picture)]
        if side == 1:
            # What is behind white is dark, so that transmission is relative to it in reflection.
            whites = [p[across(0.035, 0.065)].mean((0, 1)) for p in pictures]
            middle = np.zeros((HEIGHT, WIDTH), bool)
            middle[40:150, 120:180] = True
            birch = middle & (pictures[1].sum(-1) > 0.02) & (channels["A"] > 0.99)
        for leaf, pixels in (("green", across(-0.065, -0.035)), ("birch", birch)):
            means = [p[pixels].reshape(-1, 3).mean(0) for p in pictures]
            one, other = (lab(mean / white) for mean, white in zip(means, whites, strict=True))
            found[leaf, name] = float(colour.delta_E(one, other, method="CIE 2000"))
    print(found)
    assert max(found.values()) < 5, found
