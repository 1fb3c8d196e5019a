"""Leaves from scans, against spectra and outlines that are known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from numpy.typing import NDArray

import lamina
from lamina.exr import read_channels
from lamina.scan_fit import colours_of, contents_of, fit
from lamina.scan_outline import leaf_of, registered

pytest.importorskip("scipy")

Array = NDArray[np.float64]
MM_PER_PIXEL = 0.25
SIZE = 160
# On the scale of the fit: a green leaf.
GREEN = np.array([[1.5, 6.0, 2.9, 0.3, 0.05]])


def blade(x: Array, y: Array) -> NDArray[np.bool_]:
    """A leaf like an egg with one bulge, so that no turn and no mirror lays it onto itself."""
    is_blade: NDArray[np.bool_] = (x / (0.6 - 0.25 * y)) ** 2 + y**2 < 1
    return is_blade | ((x - 0.6) ** 2 + (y + 0.3) ** 2 < 0.3**2)


def scan(
    path: Path, colour: Array, background: float, turn_deg: float = 0.0, mirrored: bool = False
) -> Path:
    """A picture of the blade in a linear colour, smoothed over each pixel."""
    fine = (np.arange(SIZE * 4) + 0.5) / SIZE / 2 - 1
    x, y = np.meshgrid(fine * 1.4, -fine * 1.4)
    turn = np.radians(turn_deg)
    x, y = np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x
    midrib = ((np.abs(x) < 0.04) & (y < 0.7)).reshape(SIZE, 4, SIZE, 4).mean((1, 3))[:, :, None]
    colour = colour * (1 - 0.5 * midrib)
    share = blade(-x if mirrored else x, y).reshape(SIZE, 4, SIZE, 4).mean((1, 3))[:, :, None]
    return save(path, share * colour + (1 - share) * background)


def save(path: Path, linear: Array) -> Path:
    coded = np.where(linear < 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    height, width, channels = linear.shape
    output = oiio.ImageOutput.create(str(path))
    assert output.open(str(path), oiio.ImageSpec(width, height, channels, oiio.UINT8))
    assert output.write_image(coded.astype(np.float32))
    assert output.close()
    return path


def scans(folder: Path) -> dict[str, Path]:
    colour = colours_of(GREEN)[0]
    return {
        "adaxial": scan(folder / "one leaf.png", colour[:3], 0.0),
        "transmitted": scan(folder / "t.png", 0.9 * colour[3:], 0.9, turn_deg=70),
        "abaxial": scan(folder / "b.png", 1.2 * colour[:3], 0.0, turn_deg=-25, mirrored=True),
    }


def make(folder: Path, **others: object) -> dict[str, object]:
    middle = (SIZE - 1) / 2
    ends = {"base": (middle, middle + SIZE / 2.8), "apex": (middle, middle - SIZE / 2.8)}
    known = scans(folder) | {"mm_per_pixel": MM_PER_PIXEL, "map_size": 16} | ends
    return lamina.from_scans(folder / "leaf", **(known | others))  # type: ignore[arg-type]


def test_colours_of_known_leaves_give_their_pigments_back() -> None:
    known = np.array([[1.5, 6.0, 2.9, 0.5, 0.1], [1.7, 4.0, 2.5, 0.5, 0.1]])
    found = fit(colours_of(known)).contents
    truth = contents_of(known)
    assert found["chlorophyll"] == pytest.approx(truth["chlorophyll"], rel=0.05)
    assert found["structure"] == pytest.approx(truth["structure"], rel=0.03)


def test_scans_of_a_known_leaf_give_its_contents_and_a_scene_that_the_program_accepts(
    tmp_path: Path,
) -> None:
    report = make(tmp_path)
    channels = read_channels(tmp_path / "leaf" / "contents.exr")
    truth = contents_of(GREEN)
    assert np.median(channels["chlorophyll"]) == pytest.approx(truth["chlorophyll"][0], rel=0.1)
    assert any("vein" in note for note in report["notes_on_tracing"])  # type: ignore[attr-defined]
    assert report["abaxial_ratio"] == pytest.approx(1.2, rel=0.02)
    for place in report["registration"].values():  # type: ignore[attr-defined]
        assert place["residual_mm"] < 0.5 * MM_PER_PIXEL
    assert lamina.check(tmp_path / "leaf" / "scene.toml") == []


def test_a_turned_and_mirrored_outline_is_laid_onto_the_other(tmp_path: Path) -> None:
    bright = np.full(3, 0.5)
    outlines = []
    for turn, mirrored in ((0.0, False), (130.0, True)):
        picture = scan(tmp_path / "s.png", bright, 0.0, turn, mirrored)
        image = oiio.ImageInput.open(str(picture))
        outlines.append(leaf_of(image.read_image(oiio.FLOAT) ** 2.2, "s")[1])
    here = outlines[0] * [1, -1] * MM_PER_PIXEL
    assert registered(here, outlines[1], MM_PER_PIXEL, True).residual_mm < 0.3 * MM_PER_PIXEL
    # The other face is another outline.
    assert registered(here, outlines[1], MM_PER_PIXEL, False).residual_mm > 2 * MM_PER_PIXEL


def test_what_is_no_scan_of_one_leaf_is_refused(tmp_path: Path) -> None:
    bright = np.full(3, 0.3)
    plain = np.zeros((SIZE, SIZE, 3))
    touching, two, clear = plain.copy(), plain.copy(), np.ones((SIZE, SIZE, 4))
    touching[:80, 20:90] = two[20:60, 20:60] = two[90:130, 90:130] = bright
    clear[:20, :20, 3] = 0
    broken = tmp_path / "broken.png"
    broken.write_bytes((scan(tmp_path / "whole.png", bright, 0.0)).read_bytes()[:300])
    adaxial: dict[str, Path] = {
        "there is no leaf": save(tmp_path / "none.png", plain),
        "touches the picture's edge": save(tmp_path / "touching.png", touching),
        "more than one leaf": save(tmp_path / "two.png", two),
        "1 channels": save(tmp_path / "grey.png", plain[:, :, :1]),
        "transparent": save(tmp_path / "clear.png", clear),
        "overexposed": scan(tmp_path / "over.png", np.ones(3), 0.0),
        "no such file": tmp_path / "missing.png",
        "broken.png": broken,
    }
    for message, path in adaxial.items():
        with pytest.raises(lamina.LaminaError, match=message):
            make(tmp_path, adaxial=path)
    others: dict[str, dict[str, object]] = {
        "mm_per_pixel is 0": {"mm_per_pixel": 0.0},
        "not within": {"white": (150, 0, 20, 20, 0.9)},
        "lies on the leaf": {"white": (70, 70, 10, 10, 0.9)},
        "shows the other face": {"transmitted_face": "abaxial"},
    }
    for message, given in others.items():
        with pytest.raises(lamina.LaminaError, match=message):
            make(tmp_path, **given)
    assert not (tmp_path / "leaf").exists()
