"""Tests of `lamina-noise`, of lost channels, and of twins."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
from noisy_films import (
    BANDS,
    LEAF,
    PAPER,
    STEM,
    attributes,
    call,
    colour_film,
    noisy,
    scratch,
    spectral_film,
    stacked,
    truth,
    write,
)
from scipy.ndimage import gaussian_filter

from lamina.denoise import NOTE, traced_scene
from lamina.exr import Array, read_channels, write_channels
from lamina.noise import relative_error
from lamina.program import LaminaError
from lamina.twins import Bias, bias, left_noise
from lamina.twins import luminance as luminance_of
from validation.channels import colours

GREY = np.full((4, 6), 0.5)
# One pixel is black: it has no relative error.
GREY[0, 0] = 0.0


def film(names: tuple[str, ...]) -> dict[str, Array]:
    """Channels of which each errs by 2 %."""
    return {name: GREY for name in names} | {
        f"variance.{name}": np.full((4, 6), 1e-4) for name in names
    }


def test_noise_is_that_of_luminance_or_a_bound() -> None:
    # Luminance errs by 1 %.
    told = {"variance.Y": np.full((4, 6), 2.5e-5)}
    bands = tuple(f"S0.{nm},000000nm" for nm in (450, 550, 650, 750))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "noise.exr")
        for names in (("R", "G", "B"), bands):
            for layers, expected, is_bound in (
                (film(names), 0.02, True),
                (film(names) | told, 0.01, False),
            ):
                write_channels(file, layers)
                error, bounded = relative_error(str(file))
                assert error.shape == (23,) and bounded == is_bound
                np.testing.assert_allclose(error, expected, rtol=1e-6)


def test_a_picture_that_does_not_tell_its_noise_is_refused() -> None:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "colours.exr")
        write_channels(file, {name: GREY for name in "RGB"})
        for name, problem in (
            (file, "no layer variance of R, G, B"),
            (Path(folder, "no.exr"), "no.exr"),
        ):
            with pytest.raises(LaminaError, match=re.escape(problem)):
                relative_error(str(name))


def denoised(folder: Path, *films: dict[str, Array]) -> dict[str, Array]:
    """Layers of a denoised picture, or of the mean of twins."""
    files = [
        write(folder / f"{seed}.exr", film, {"lamina:seed": str(seed)})
        for seed, film in enumerate(films, 1)
    ]
    twins = [word for file in files[1:] for word in ("--twin", file)]
    status, _, warned = call(files[0], *twins, "--out", folder / "out.exr")
    assert status == 0, warned
    return read_channels(folder / "out.exr")


def luminance(layers: dict[str, Array], names: tuple[str, ...] = ("R", "G", "B")) -> Array:
    """That of a film, `[height, width]`."""
    return luminance_of(stacked(layers, names), names)


def film_of(light: Array, seed: int = 1) -> dict[str, Array]:
    """Layers of a colour film with an error of luminance, whatever it be."""
    return colour_film(light, seed) | {"variance.Y": np.ones(light.shape[:2])}


def test_one_sample_a_pixel_does_not_tell_its_noise() -> None:
    with scratch() as folder:
        file = folder / "one.exr"
        write_channels(file, film(("R", "G", "B")) | {"samples.Y": np.ones_like(GREY)})
        with pytest.raises(LaminaError, match="one.exr: one sample per pixel does not show"):
            relative_error(str(file))


def test_channels_of_a_spectral_film_are_counted_in_its_grey() -> None:
    with scratch() as folder:
        file = folder / "bands.exr"
        write_channels(file, {"A": GREY, BANDS[0]: GREY, BANDS[1]: 3 * GREY})
        assert np.allclose(colours(file)[0], 2 * GREY[:, :, None].repeat(3, axis=2))
        write_channels(file, {"A": GREY})
        try:
            colours(file)
        except RuntimeError as error:
            assert "bands.exr: it has neither channels R, G, B nor bands" in str(error), error
        else:
            raise AssertionError("a film without light was taken")


@pytest.mark.needs("mitsuba_oidn")
def test_twins_tell_the_noise_that_is_left() -> None:
    light = truth((LEAF, PAPER, STEM))
    with scratch() as folder:
        alone = [luminance(denoised(folder, film_of(light, seed))) for seed in range(1, 13)]
        twins = [
            denoised(folder, film_of(light, seed), film_of(light, seed + 1))
            for seed in (1, 3, 5, 7)
        ]
        three = denoised(folder, *(film_of(light, seed) for seed in (1, 2, 3)))
    # The truth is how twelve pictures scatter, each denoised alone; the mean of two has half of
    # that variance.
    right = np.var(alone, axis=0, ddof=1).mean() / 2
    # One pair is off by up to 29 % here: few pixels, whose errors go together after the denoiser.
    told = [layers["variance.Y"].mean() / right for layers in twins]
    assert 0.8 < np.mean(told) < 1.25, told
    assert abs(three["variance.Y"].mean() / right / (2 / 3) - 1) < 0.3, three["variance.Y"].mean()
    np.testing.assert_allclose(luminance(three), np.mean(alone[:3], axis=0), rtol=1e-4, atol=1e-6)
    # And before it was many times as much.
    before = [luminance(film_of(light, seed)) for seed in range(1, 13)]
    assert np.var(before, axis=0, ddof=1).mean() / 2 > 10 * right
    for pair, layers in zip((0, 2, 4, 6), twins, strict=True):
        np.testing.assert_allclose(
            luminance(layers), (alone[pair] + alone[pair + 1]) / 2, rtol=1e-4, atol=1e-6
        )


def test_bias_is_told_whatever_the_noise() -> None:
    # A blur is a denoiser whose bias is known: that of the light without noise.
    light = np.tile(truth((LEAF, PAPER, STEM)), (8, 8, 1))
    blurred = gaussian_filter(light, (1, 1, 0))
    names = ("R", "G", "B")
    bright = luminance_of(blurred, names)
    off = luminance_of(blurred - light, names) / np.sqrt(bright**2 + 0.01 * bright.mean() ** 2)
    right = np.mean(off**2)
    for count in (2, 4):
        traced = [noisy(light, seed).astype(np.float32) for seed in range(count)]
        told = bias([gaussian_filter(film, (1, 1, 0)) for film in traced], traced, names)
        assert 0 < told.error < 0.05 * right, (told.square, told.error, right)
        # What is relative is so to light that is noisy too.
        assert abs(told.square - right) < 0.05 * right, (told.square, told.error, right)
        # The light itself has none.
        none = bias([light.astype(np.float32)] * count, traced, names)
        assert abs(none.square) < 2.5 * none.error < right, (none.square, none.error)
        assert str(none).startswith("below")
    assert str(Bias(4e-4, 1e-5)) == "2 %"
    assert str(Bias(1e-4, 1e-4)) == "below 1.7 %" and str(Bias(-1e-4, 5e-5)) == "below 1 %"


def test_of_unequal_twins_the_one_of_more_samples_counts_more() -> None:
    rng = np.random.default_rng(1)
    names = ("R", "G", "B")
    light = np.ones((200, 200, 1), np.float32)
    # Errors of one and of four samples: of the mean by samples they are those of five.
    clean = [light + spread * rng.standard_normal((200, 200, 1)) for spread in (0.02, 0.01)]
    shares = np.array([0.2, 0.8])
    right = np.var(np.average(clean, axis=0, weights=shares))
    grey = [np.repeat(values, 3, axis=2).astype(np.float32) for values in clean]
    told = left_noise(grey, shares, names)
    # Three standard errors of the variance of 40,000 numbers are 2.1 %, of a ratio of two 3 %.
    for layer in ("variance.R", "variance.Y"):
        assert abs(told[layer].mean() / right - 1) < 0.03, (told[layer].mean(), right)
    assert abs(right / (0.0004 / 5) - 1) < 0.021


@pytest.mark.needs("mitsuba_oidn")
def test_twins_add_up_their_samples_and_leave_all_else_as_it_was() -> None:
    light = truth((LEAF, PAPER, STEM))
    _, bands = spectral_film()
    bands |= {"variance.Y": np.ones(bands["A"].shape)}
    for film, names in ((film_of(light), ("R", "G", "B")), (bands, BANDS)):
        other = film | {name: 1.1 * film[name] for name in names}
        with scratch() as folder:
            made = denoised(folder, film, other)
            before = read_channels(folder / "1.exr")
            note = attributes(folder / "out.exr")[NOTE][1].decode()
        assert "mean of seeds 1 and 2; variance is that of the noise left" in note, note
        changed = {*names, "variance.Y", "samples.Y"} | {f"variance.{name}" for name in names}
        for name, values in before.items():
            assert np.array_equal(values, made[name]) == (name not in changed), name
        if "samples.Y" in made:
            assert (made["samples.Y"] == 32).all()
        # The second is a tenth brighter: half of that is what the mean may err by.
        error = np.sqrt(made["variance.Y"]) / luminance(made, names)
        assert abs(np.median(error) / (0.05 / 1.05) - 1) < 0.05, np.median(error)


@pytest.mark.needs("mitsuba_oidn")
def test_twins_without_light_have_no_noise_and_no_bias() -> None:
    with scratch() as folder:
        black = film_of(np.zeros(truth((LEAF, PAPER, STEM)).shape))
        made = denoised(folder, black, black)
        note = attributes(folder / "out.exr")[NOTE][1].decode()
    assert (made["variance.Y"] == 0).all() and (made["R"] == 0).all()
    assert "bias of luminance 0 %" in note, note


def test_twins_may_be_developed_otherwise_and_have_other_numbers_of_samples() -> None:
    film = "[film.rgb]\nsize = [64, 48]\n"
    first = f"format = 1\n{film}spp = 16\n[picture]\nexposure_ev = 1\n"
    for same in (
        f"format = 1\n{film}spp = 16\n",
        f"# Later.\nformat = 1\n{film}spp = 64\nnoise = 0.01\nseed = 3\n[picture]\ncontrast = 2\n",
    ):
        assert traced_scene(same) == traced_scene(first), same
    for other in (
        first.replace("48", "32"),
        f"{first}[integrator]\nmax_depth = 4\n",
        "format = ",
        "",
    ):
        assert traced_scene(other) != traced_scene(first), other
    assert traced_scene("no scene") == "no scene"


@pytest.mark.needs("mitsuba_oidn")
def test_what_is_no_twin_is_refused() -> None:
    film = colour_film(truth((LEAF, PAPER, STEM)))
    with scratch() as folder:
        first = write(folder / "first.exr", film)
        small = write(
            folder / "small.exr",
            {name: values[:, :40] for name, values in film.items()},
            {"lamina:seed": "2"},
        )
        poor = write(
            folder / "poor.exr",
            {name: film[name] for name in film if name != "A"},
            {"lamina:seed": "2"},
        )
        scene = write(
            folder / "scene.exr", film, {"lamina:seed": "2", "lamina:scene": "format = 2\n"}
        )
        for twin, problem in (
            (first, "first.exr is of seed 18446744073709551615 too; render with another"),
            (small, "small.exr: it is no twin: it has another size or other layers"),
            (poor, "poor.exr: it is no twin: it has another size or other layers"),
            (scene, "scene.exr: it is no twin: it is of another scene"),
            (folder / "none.exr", "none.exr: No such file"),
        ):
            status, said, warned = call(first, "--twin", twin, "--out", folder / "out.exr")
            assert (status, said) == (2, "") and problem in warned, warned
        # The twin is kept like the first.
        status, _, warned = call(first, "--twin", scene, "--out", scene)
        assert status == 2 and "scene.exr: it is the input, which is kept" in warned, warned
        assert not (folder / "out.exr").exists()
