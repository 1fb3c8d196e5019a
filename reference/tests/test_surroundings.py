"""Holds pictures of the surroundings against Mitsuba's own `envmap`.

`lamina export` writes such a light as spectra on a sphere, which `reference/` reads, so that a
picture seen in a mirror would be seen in it on both sides. Here Mitsuba reads the picture itself.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

mi = pytest.importorskip("mitsuba")

from lamina.exr import Array, read_channels, write_channels
from validation.program import program

WIDTH, HEIGHT = 72, 48
FIELD_DEG = 80
SAMPLES = 576
EYE, TARGET, RADIUS_M = (0.0, 0.0, 0.5), (1.0, 0.3, 0.6), 0.4
# Luminance of D65 with the radiance 1 at 560 nm, over that of equal energy: what RGB 1 1 1 of the
# picture stands for. An RGB of Mitsuba's is what its picture says.
D65_LUMINANCE = 0.9889
# Mitsuba's map has y upwards and its middle at -z; here z is up, and the middle lies at +x.
MIDDLE_DEG = 270.0
# Wavelengths are all that the eye sees: without those below 400 nm, blue is 0.4 % darker.
SCENE = """
format = 1
[film.rgb]
size = [{width}, {height}]
spp = 1
range_nm = [360, 830]
filter_radius_px = 0
[camera.perspective]
position_m = {eye}
look_at_m = {target}
vertical_fov_deg = {field}
[meshes.ball.sphere]
radius_m = {radius}
[materials.grey.diffuse]
reflectance = 0.5
[objects.ball]
mesh = "ball"
material = "grey"
position_m = {target}
[lights.sky.environment]
path = "sky.exr"
rotation_deg = {turn}
"""


def picture() -> dict[str, Array]:
    """A smooth picture, other in every direction, and in no mirror the same."""
    height, width = 512, 1024
    across = 2 * np.pi * (np.arange(width) + 0.5) / width
    down = np.pi * (np.arange(height)[:, None] + 0.5) / height
    level = np.sin(down) ** 2
    return {
        "R": (1 + 0.8 * level * np.sin(across)).astype(np.float32),
        "G": (1 + 0.5 * np.cos(down) + 0.4 * level * np.cos(2 * across)).astype(np.float32),
        "B": (1 + 0.6 * level * np.cos(across + 0.7)).astype(np.float32),
    }


def by_lamina(folder: Path, turn: float) -> Array:
    """The scene below the picture, `[height, width, 3]`."""
    scene, made = folder / "scene.toml", folder / "made.exr"
    text = SCENE.format(
        width=WIDTH,
        height=HEIGHT,
        field=FIELD_DEG,
        radius=RADIUS_M,
        turn=turn,
        eye=list(EYE),
        target=list(TARGET),
    )
    scene.write_text(text, encoding="utf-8")
    line = [str(program()), "render", str(scene), "--spp", str(SAMPLES), "--out", str(made)]
    done = subprocess.run(line, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    channels = read_channels(made)
    return np.stack([channels[name] for name in "RGB"], axis=-1)


def by_mitsuba(folder: Path, turn: float) -> Array:
    """The same by Mitsuba's own reading of the picture."""
    matrix = mi.ScalarTransform4f
    scene = {
        "type": "scene",
        "integrator": {"type": "path"},
        "sensor": {
            "type": "perspective",
            "fov": FIELD_DEG,
            "fov_axis": "y",
            "to_world": matrix().look_at(origin=EYE, target=TARGET, up=[0, 0, 1]),
            "film": {
                "type": "hdrfilm",
                "width": WIDTH,
                "height": HEIGHT,
                "rfilter": {"type": "box"},
                "pixel_format": "rgb",
            },
            "sampler": {"type": "multijitter", "sample_count": SAMPLES},
        },
        "ball": {
            "type": "sphere",
            "center": TARGET,
            "radius": RADIUS_M,
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}},
        },
        "sky": {
            "type": "envmap",
            "filename": str(folder / "sky.exr"),
            "to_world": matrix().rotate([0, 0, 1], MIDDLE_DEG + turn).rotate([1, 0, 0], 90),
        },
    }
    return np.array(mi.render(mi.load_dict(scene)), dtype=np.float64)


@pytest.fixture
def in_rgb() -> Iterator[None]:
    """Mitsuba in RGB; other tests in this process are bound to the variant before."""
    before = mi.variant()
    mi.set_variant("scalar_rgb")
    yield
    if before is not None:
        mi.set_variant(before)


@pytest.mark.usefixtures("in_rgb")
def test_a_picture_of_the_surroundings_is_seen_as_mitsuba_sees_it() -> None:
    for turn in (0.0, 110.0):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            write_channels(folder / "sky.exr", picture())
            ours = by_lamina(folder, turn)
            theirs = by_mitsuba(folder, turn)
        ratio = ours / (D65_LUMINANCE * theirs)
        middle_y, middle_x, near = HEIGHT // 2, WIDTH // 2, 7
        ball = ratio[middle_y - near : middle_y + near, middle_x - near : middle_x + near]
        # The sky differs by 0.0007, by twice that if the picture has half as many texels across;
        # the ball, which has noise, by 0.0012.
        for what, seen, most in (
            ("sky", ratio[[0, 1, 2, -3, -2, -1]], 0.001),
            ("ball", ball, 0.003),
        ):
            mean = seen.mean(axis=(0, 1))
            assert np.abs(mean - 1).max() < most, (turn, what, mean)
        # What is seen tells left from right.
        mirrored = ours / (D65_LUMINANCE * theirs[:, ::-1])
        assert np.abs(mirrored - 1).mean() > 0.1, turn
