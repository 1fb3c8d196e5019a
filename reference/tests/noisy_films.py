"""Films of light that is known with noise of a fixed seed, and the command that denoises them."""

from __future__ import annotations

import contextlib
import io
import struct
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lamina.denoise import NORMAL, REC2020, main
from lamina.exr import Array, read_channels, write_channels
from lamina.film import ALBEDO

HEIGHT, WIDTH = 64, 96
BANDS = tuple(f"S0.{nm},000000nm" for nm in (450, 550, 650, 750))
# A green that no mixture of the primaries of Rec. 709 gives, a grey, a dark red: Rec. 2020.
LEAF, PAPER, STEM = (0.06, 0.3, 0.004), (0.5, 0.5, 0.5), (0.08, 0.03, 0.01)
TOLD = {
    "lamina:scene": 'format = 1\n[picture]\nexposure_ev = 1\ntone = "standard"\n',
    "lamina:seed": "18446744073709551615",
    "software": "Lamina 0.1.0",
}
SCENE = """
format = 1
[film.rgb]
size = [48, 32]
spp = 8
[picture]
exposure_ev = 2
tone = "filmic"
[camera.perspective]
position_m = [0, 0, 1]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
vertical_fov_deg = 60
[lights.sky.constant]
radiance_w_m2_sr_nm = 0.1
[lights.lamp.distant]
irradiance_w_m2_nm = 0.3
towards = [0.3, 0.2, -1]
angular_diameter_deg = 20
[materials.paper.diffuse]
reflectance = 0.5
[meshes.sheet.rectangle]
width_m = 0.6
height_m = 0.6
[objects.sheet]
mesh = "sheet"
material = "paper"
"""


def truth(colours: tuple[tuple[float, ...], ...]) -> Array:
    """A ramp of the first, with a disc of the second and a bar of the third."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    field: Array = np.array(colours[0]) * (0.5 + x / WIDTH)[:, :, None]
    field[np.hypot(x - 30, y - 30) < 16] = colours[1]
    field[:, 70:76] = colours[2]
    return field


def noisy(light: Array, seed: int = 1, strength: float = 0.6) -> Array:
    """Light with noise of mean 1 that is independent in all pixels and never below 0."""
    shape = 1 / strength**2
    return light * np.random.default_rng(seed).gamma(shape, 1 / shape, light.shape)


def to_709(light: Array) -> Array:
    """Linear Rec. 2020 to linear Rec. 709."""
    made: Array = light @ np.linalg.inv(REC2020).T
    return made


def write(file: Path, layers: dict[str, Array], told: dict[str, str] | None = None) -> Path:
    """An EXR as Lamina writes it, with 16 samples and some camera."""
    camera = np.arange(16, dtype=np.float32)
    write_channels(file, layers, TOLD | (told or {}) | {"lamina:spp": 16, "worldToCamera": camera})
    return file


def named(names: tuple[str, ...], values: Array) -> dict[str, Array]:
    """Channels of an array as layers."""
    return {name: values[:, :, number] for number, name in enumerate(names)}


def stacked(layers: dict[str, Array], names: tuple[str, ...]) -> Array:
    """Layers as the channels of an array."""
    return np.stack([layers[name] for name in names], axis=2)


def colour_film(light: Array, seed: int = 1) -> dict[str, Array]:
    """Layers of a colour film of this light, in Rec. 2020, with guides."""
    facing = np.broadcast_to([0.0, 0.0, 1.0], light.shape)
    share = np.ones((HEIGHT, WIDTH))
    return {
        **named(("R", "G", "B"), to_709(noisy(light, seed))),
        "A": share,
        **named(ALBEDO, np.clip(to_709(light), 0, 1)),
        **named(NORMAL, facing),
        "samples.Y": 16 * share,
        **named(("variance.R", "variance.G", "variance.B"), 0.36 * light**2),
    }


def spectral_film() -> tuple[Array, dict[str, Array]]:
    """Light in four bands, and the layers of a spectral film of it."""
    light = truth(((0.05, 0.2, 0.06, 3.0), (0.5, 0.5, 0.5, 0.6), (0.01, 0.02, 0.1, 1.0)))
    facing = np.broadcast_to([0.0, 0.0, 1.0], (HEIGHT, WIDTH, 3))
    variances = tuple(f"variance.{band}" for band in BANDS)
    return light, {
        **named(BANDS, noisy(light)),
        "A": np.ones((HEIGHT, WIDTH)),
        **named(NORMAL, facing),
        **named(variances, 0.36 * light**2),
    }


def attributes(file: Path) -> dict[str, tuple[str, bytes]]:
    """Type and bytes of each attribute in a file's header, but for those of its structure."""
    data, at, found = file.read_bytes(), 8, {}
    while data[at]:
        name, kind = data.index(0, at), data.index(0, data.index(0, at) + 1)
        start = kind + 5
        end = start + struct.unpack("<i", data[kind + 1 : start])[0]
        found[data[at:name].decode()] = (data[name + 1 : kind].decode(), data[start:end])
        at = end
    return {name: value for name, value in found.items() if name not in ("chunkCount", "type")}


def call(*words: object) -> tuple[int, str, str]:
    """Exit status, output and messages of the command."""
    said, warned = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(warned):
        try:
            status = main([str(word) for word in words])
        except SystemExit as end:
            status = int(end.code or 0)
    return status, said.getvalue(), warned.getvalue()


def denoised(folder: Path, layers: dict[str, Array], *flags: str) -> tuple[dict[str, Array], str]:
    """Layers of the denoised picture and what the command said."""
    source, out = write(folder / "in.exr", layers), folder / "out.exr"
    status, said, warned = call(source, "--out", out, *flags)
    assert status == 0 and said == f"{out}\n", warned
    return read_channels(out), warned


def error(light: Array, right: Array) -> float:
    """Relative root mean square error, each channel by its mean."""
    return float(np.sqrt((((light - right) / right.mean((0, 1))) ** 2).mean()))


@contextlib.contextmanager
def scratch() -> Iterator[Path]:
    """A folder that must hold no temporary file at the end."""
    with tempfile.TemporaryDirectory() as name:
        yield Path(name)
        left = [file.name for file in Path(name).iterdir() if file.name.startswith(".")]
        assert not left, left
