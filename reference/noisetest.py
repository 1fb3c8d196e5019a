#!/usr/bin/env python3
"""Tests of `reference/noise`, `reference/channels`, `reference/print`, and of twins.

Run by `reference/self-test`.
Where Open Image Denoise is missing, what needs it is skipped and told.
"""

from __future__ import annotations

import contextlib
import importlib.util
import io
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np
from scipy.ndimage import gaussian_filter

from denoisetest import (
    BANDS,
    LEAF,
    PAPER,
    SCENE,
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
from lamina_reference.allotment import (
    aim,
    grown,
    samples_of,
    shown_aim,
    shown_errors,
    traced_errors,
    write_map,
)
from lamina_reference.channels import colours
from lamina_reference.denoise import NOTE
from lamina_reference.exr import Array, read_channels, write_channels
from lamina_reference.noise import relative_error
from lamina_reference.prints import between, noise
from lamina_reference.prints import main as print_scene
from lamina_reference.testing import run_tests
from lamina_reference.twins import Bias, bias, left_noise
from lamina_reference.twins import luminance as luminance_of

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
            try:
                relative_error(str(name))
            except SystemExit as refusal:
                assert problem in str(refusal)
            else:
                raise AssertionError(f"{name} has no noise to tell")


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
        try:
            relative_error(str(file))
        except SystemExit as stop:
            assert "one.exr: one sample a pixel does not tell" in str(stop), stop
        else:
            raise AssertionError("its noise was told")


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


def test_twins_without_light_have_no_noise_and_no_bias() -> None:
    with scratch() as folder:
        black = film_of(np.zeros(truth((LEAF, PAPER, STEM)).shape))
        made = denoised(folder, black, black)
        note = attributes(folder / "out.exr")[NOTE][1].decode()
    assert (made["variance.Y"] == 0).all() and (made["R"] == 0).all()
    assert "bias of luminance 0 %" in note, note


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
            folder / "scene.exr", film, {"lamina:seed": "2", "lamina:scene": "format = 1\n"}
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


def test_a_print_is_the_mean_of_denoised_renders_and_tells_what_it_took() -> None:
    with scratch() as folder:
        scene, said = folder / "leaf.toml", io.StringIO()
        scene.write_text(SCENE, encoding="utf-8")
        words = [str(scene), "--out", str(folder), "--twins", "2", "--spp", "8", "--noise", "0"]
        assert print_scene([*words, "-D", "film.rgb.sizes=[9, 9]"]) == 2
        assert not (folder / "leaf.exr").exists()
        with contextlib.redirect_stdout(said):
            assert print_scene(words) == 0
        cells = said.getvalue().splitlines()[-1].strip("| ").split(" | ")
        shown, traced = folder / "leaf.exr", [folder / f"leaf-{seed}.exr" for seed in (1, 2)]
        within, error = noise(shown)
        assert cells[0] == "leaf" and cells[2] == "8 + 8", cells
        assert cells[6] == f"{within:.1f} %, {error:.2f} %", cells
        errors = [noise(file)[1] for file in traced]
        assert cells[5].endswith(f", {between(errors, '.2g')}"), cells
        assert error > 0 and (folder / "leaf.jpg").exists()
        note = attributes(shown)[NOTE][1].decode()
        assert "mean of seeds 1 and 2" in note and note.endswith(f"luminance {cells[7]}"), note


def test_the_time_of_a_print_goes_where_the_noise_is() -> None:
    # Half of the blocks err by 0.2 at 32 samples, half not at all: the mean of 80 is 128 and 32.
    # The target is found to 1 %, from above.
    errors = np.array([0.2, 0.0])
    target = aim(errors, 80.0, 4096, 0.001)
    assert 0.1 <= target < 0.1 * 1.011, target
    # All alike have the same number each; what is affordable beyond the most is left.
    target = aim(np.full(5, 0.2), 512.0, 4096, 0.001)
    assert 0.05 <= target < 0.05 * 1.011, target
    assert aim(errors, 80.0, 64, 0.001) == 0.001
    # Nothing is aimed at below what was asked for, nor can less than the first samples be had.
    assert aim(errors, 80.0, 4096, 0.15) == 0.15
    assert 0.99 < aim(errors, 31.0, 4096, 0.001) <= 1.0


def test_blocks_err_as_the_program_judges_them() -> None:
    # 8 × 8 pixels and a rest of 8 × 2: root of the mean square over a tenth of the picture's mean
    # and their own.
    bright, error = np.full((8, 10), 2.0), np.zeros((8, 10))
    bright[:, 8:], error[:, 8:], error[:4, :8] = 0.0, 0.01, 0.02
    names = dict.fromkeys(("R", "G", "B"), bright)
    variance = {f"variance.{name}": error**2 for name in "RGBY"}
    with scratch() as folder:
        write_channels(folder / "blocks.exr", names | variance)
        found = traced_errors(folder / "blocks.exr")
    expected = [[0.02 * np.sqrt(0.5) / (2 + 0.16), 0.01 / 0.16]]
    assert np.allclose(found, expected, rtol=1e-5), found


def test_what_is_shown_of_a_block_errs_as_most_of_its_pixels_do() -> None:
    # A block of 8 × 8 and one of 8 × 2, whose pixels err by 1, 2, … 16 %; of the first one an
    # eighth errs by a tenth and is not what counts, and an eighth is black.
    bright, error = np.full((8, 10), 2.0), np.full((8, 10), 0.04)
    error[0, :8], bright[1, :8] = 0.2, 0.0
    error[:, 8:] = 0.02 * np.arange(1, 17).reshape(8, 2)
    names = dict.fromkeys(("R", "G", "B"), bright)
    variance = {f"variance.{name}": error**2 for name in "RGBY"}
    with scratch() as folder:
        write_channels(folder / "blocks.exr", names | variance)
        found = shown_errors(folder / "blocks.exr")
    # Of 1 to 16 the fourth part above 12.25, by a line between 12 and 13.
    assert np.allclose(found, [[0.02, 0.1225]], rtol=1e-5), found


def test_samples_grow_where_what_is_shown_errs() -> None:
    had, errors = np.array([32.0, 32.0, 48.0, 4000.0]), np.array([0.02, 0.009, 0.1, 0.02])
    # Four times as many halve the error; none grows by more at once, none beyond the most, and
    # what is good enough keeps what it has.
    assert grown(had, errors, 0.01, 4096).tolist() == [128, 32, 192, 4096]
    assert grown(had, errors, 0.015, 64).tolist() == [64, 32, 64, 4000]
    # Two of four blocks err alike, in twins of 32 and of 64 samples: of 0.02 to 0.0125 takes 2.56
    # times as many, 82 and 164, which are 96 and 176 in steps: 44 more in the mean of all.
    errors = np.array([0.02, 0.02, 0.0, 0.0])
    twins = [np.full(4, 32.0), np.full(4, 64.0)]
    target = shown_aim(twins, errors, 44.0, 4096, 0.001)
    assert 0.0115 < target <= 0.0125, target
    added = [grown(twin, errors, target, 4096) - twin for twin in twins]
    assert np.mean(added) <= 44.0, added
    assert shown_aim(twins, errors, 1000.0, 4096, 0.008) == 0.008


def test_a_map_of_samples_is_read_as_it_was_written() -> None:
    samples = np.array([[32.0, 48.0], [64.0, 5000.0]])
    with scratch() as folder:
        file = folder / "map.exr"
        write_map(file, samples, (11, 10))
        assert read_channels(file)["samples.Y"].shape == (11, 10)
        assert samples_of(file).tolist() == samples.tolist()


def test_a_print_refuses_a_target_that_is_none() -> None:
    for word, value, problem in (
        ("--noise", "2", "--noise 2.0: from 0 to 1"),
        ("--error", "0", "--error 0.0: above 0, at most 1"),
    ):
        warned = io.StringIO()
        with scratch() as folder, contextlib.redirect_stderr(warned):
            try:
                print_scene(["leaf.toml", "--out", str(folder), word, value])
            except SystemExit as stop:
                assert stop.code == 2 and problem in warned.getvalue(), warned.getvalue()
            else:
                raise AssertionError("it was taken")


def test_a_print_has_first_samples_everywhere_and_goes_on_with_the_rest() -> None:
    with scratch() as folder:
        scene, said, warned = folder / "leaf.toml", io.StringIO(), io.StringIO()
        scene.write_text(SCENE, encoding="utf-8")
        words = [str(scene), "--out", str(folder), "--twins", "2", "--spp", "64"]
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(warned):
            assert print_scene([*words, "--noise", "0.0001"]) == 0
        # There is time for all 64 of the leaf, of which the first 32 were there before; where
        # there is no noise, 32 are all.
        cells = said.getvalue().splitlines()[-1].strip("| ").split(" | ")
        assert all(32 < int(samples) < 64 for samples in cells[2].split(" + ")), cells
        for seed in (1, 2):
            samples = read_channels(folder / f"leaf-{seed}.exr")["samples.Y"]
            assert (samples.min(), samples.max()) == (32, 64), (samples.min(), samples.max())
        assert "noisy parts can reach 0.01 %" in warned.getvalue(), warned.getvalue()
        assert not list(folder.glob("*.checkpoint"))


def test_a_print_goes_on_where_what_is_shown_errs() -> None:
    with scratch() as folder:
        scene, said, warned = folder / "leaf.toml", io.StringIO(), io.StringIO()
        scene.write_text(SCENE, encoding="utf-8")
        words = [str(scene), "--out", str(folder), "--twins", "2", "--noise", "1"]
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(warned):
            assert print_scene([*words, "--error", "0.0001"]) == 0
        # 32 are all at first; then the leaf gets four times as many, the empty ground none.
        for seed in (1, 2):
            samples = read_channels(folder / f"leaf-{seed}.exr")["samples.Y"]
            assert (samples.min(), samples.max()) == (32, 128), (samples.min(), samples.max())
        cells = said.getvalue().splitlines()[-1].strip("| ").split(" | ")
        assert cells[6].endswith(f", {noise(folder / 'leaf.exr')[1]:.2f} %"), cells
        assert "can come to 0.0085 %" in warned.getvalue(), warned.getvalue()
        assert not [*folder.glob("*.checkpoint"), *folder.glob("*.map.exr")]
        # What errs by less than is asked for is shown as it is.
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            assert print_scene([*words, "--error", "1"]) == 0
        samples = read_channels(folder / "leaf-1.exr")["samples.Y"]
        assert (samples == 32).all(), samples.max()


def test_a_print_that_was_kept_goes_on() -> None:
    with scratch() as folder:
        scene, said, warned = folder / "leaf.toml", io.StringIO(), io.StringIO()
        scene.write_text(SCENE, encoding="utf-8")
        words = [str(scene), "--out", str(folder), "--twins", "2", "--noise", "1"]
        resumed = [str(scene), "--out", str(folder), "--resume", "--error", "0.0001"]
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(warned):
            assert print_scene(resumed) == 2
            assert print_scene([*words, "--error", "1", "--keep"]) == 0
            memory = folder / "leaf.twins.json"
            before = json.loads(memory.read_text(encoding="utf-8"))
            assert print_scene(resumed) == 0
            after = json.loads(memory.read_text(encoding="utf-8"))
        for one, other in zip(before, after, strict=True):
            samples = read_channels(folder / one["picture"])["samples.Y"]
            assert (samples.min(), samples.max()) == (32, 128), (samples.min(), samples.max())
            # Its time is that of both.
            assert one["samples"] == 32 and other["samples"] == samples.mean()
            assert other["seconds"] > one["seconds"] and other["tracing"] > one["tracing"]
        # What is missing is told.
        (folder / "leaf-2.checkpoint").unlink()
        with contextlib.redirect_stderr(warned):
            assert print_scene(resumed) == 2
            memory.write_text("{}", encoding="utf-8")
            (folder / "leaf-2.checkpoint").touch()
            assert print_scene(resumed) == 2
            memory.write_text('[{"seed": 1}]', encoding="utf-8")
            assert print_scene(resumed) == 2
        for problem in (
            "leaf.twins.json: No such file or directory: a print with --keep writes it",
            "leaf-2.checkpoint: it is missing",
            "leaf.twins.json: it was not written by reference/print",
        ):
            assert problem in warned.getvalue(), warned.getvalue()


def run() -> int:
    """Runs every test of this file, or those whose names hold the arguments."""
    tests = dict(globals())
    if importlib.util.find_spec("mitsuba_oidn") is None:
        print("skip  what denoises: mitsuba-oidn is missing in this Python", file=sys.stderr)
        for test in (
            test_twins_tell_the_noise_that_is_left,
            test_twins_add_up_their_samples_and_leave_all_else_as_it_was,
            test_twins_without_light_have_no_noise_and_no_bias,
            test_a_print_is_the_mean_of_denoised_renders_and_tells_what_it_took,
            test_a_print_has_first_samples_everywhere_and_goes_on_with_the_rest,
            test_a_print_goes_on_where_what_is_shown_errs,
            test_a_print_that_was_kept_goes_on,
        ):
            del tests[test.__name__]
    return run_tests(tests, "noise")


if __name__ == "__main__":
    sys.exit(run())
