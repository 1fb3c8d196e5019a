"""Tests of `lamina-print`: where the samples of a print go, and what is told of it."""

from __future__ import annotations

import contextlib
import io
import json

import numpy as np
import pytest
from noisy_films import SCENE, attributes, scratch
from scipy.ndimage import gaussian_filter

from lamina.allotment import (
    BLOCK,
    aim,
    grown,
    samples_of,
    shown_aim,
    shown_errors,
    traced_errors,
    write_map,
)
from lamina.denoise import NOTE
from lamina.exr import Array, read_channels, write_channels
from lamina.kept_print import errors_of, remembered, remembered_mean
from lamina.print import arguments, between, noise
from lamina.print import main as print_scene
from lamina.twins import Pixels, left_noise, noise_told_by_others


@pytest.mark.needs("mitsuba_oidn")
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
    # eighth errs by a tenth, which is not what counts.
    errors = np.full((8, 10), 0.02)
    errors[0, :8] = 0.1
    errors[:, 8:] = 0.01 * np.arange(1, 17).reshape(8, 2)
    # Of 1 to 16 the fourth part above 12.25, by a line between 12 and 13.
    assert np.allclose(shown_errors(errors), [[0.02, 0.1225]], rtol=1e-5), shown_errors(errors)


def test_samples_grow_where_what_is_shown_errs() -> None:
    had, errors = np.array([32.0, 32.0, 48.0, 4000.0]), np.array([0.02, 0.009, 0.1, 0.02])
    # Four times as many halve the error; none grows by more at once, none beyond the most, and
    # what is good enough keeps what it has.
    assert grown(had, errors, 0.01, 4096).tolist() == [128, 32, 192, 4096]
    assert grown(had, errors, 0.015, 64).tolist() == [64, 32, 64, 4000]
    # Two of four blocks err alike, in twins of 32 and of 64 samples: of 0.02 to 0.0125 takes 2.56
    # times as many, 82 and 164, which are 96 and 176 in steps: 44 more in the mean of all.
    told = [np.array([0.02, 0.02, 0.0, 0.0]), np.array([0.0, 0.0, 0.02, 0.02])]
    twins = [np.full(4, 32.0), np.full(4, 64.0)]
    target = shown_aim(twins, told, 44.0, 4096, 0.001)
    assert 0.0115 < target <= 0.0125, target
    added = [
        grown(twin, error, target, 4096) - twin for twin, error in zip(twins, told, strict=True)
    ]
    assert np.mean(added) <= 44.0, added
    assert shown_aim(twins, told, 1000.0, 4096, 0.008) == 0.008


def scattered(rng: np.random.Generator, size: int) -> Array:
    """Errors as a denoiser leaves them: blotches of a few pixels, here and there larger ones."""
    blotches = gaussian_filter(rng.standard_normal((size, size)), 1.0)
    large = gaussian_filter(rng.standard_normal((size, size)), BLOCK)
    return np.asarray(np.exp(0.6 * large / large.std()) * blotches / blotches.std())


def test_by_what_others_tell_the_error_stays_true() -> None:
    # Four twins get more samples where what is shown of them errs by more than 0.85 %. Nobody
    # knows the truth of a picture; here it is known that there is nothing but noise of 0.9 %.
    size, names = 512, ("R", "G", "B")
    shares = np.full(4, 0.25)
    rng = np.random.default_rng(1)
    before = [scattered(rng, size) for _ in range(4)]
    spread = 0.009 * 2 / np.sqrt(np.mean(np.square(before)))

    def shown(errors: list[Array]) -> list[Pixels]:
        light = [np.repeat(1 + spread * error[..., None], 3, axis=2) for error in errors]
        return [values.astype(np.float32) for values in light]

    def told(by_others: bool) -> float:
        """Error that is told after more samples, over the true one."""
        light = shown(before)
        judged = noise_told_by_others(light, shares, names)
        if not by_others:
            judged = [np.sqrt(left_noise(light, shares, names)["variance.Y"].astype(float))] * 4
        more = [grown(np.full((64, 64), 1.0), shown_errors(error), 0.0085, 64) for error in judged]
        fresh = np.random.default_rng(2)
        after = []
        for error, samples in zip(before, more, strict=True):
            share = (1 / samples).repeat(BLOCK, 0).repeat(BLOCK, 1)
            others = scattered(fresh, size) * np.sqrt(share * (1 - share))
            after.append(error * share + others)
        square = left_noise(shown(after), shares, names)["variance.Y"].mean()
        right = np.mean(np.square(spread * np.mean(after, axis=0)))
        return float(np.sqrt(square / right))

    # Of eight pairs of seeds it scatters by 0.29 %.
    assert abs(told(True) - 1) < 0.01, told(True)
    # By its own difference too it would be told too small, by 2.6 % of eight pairs of seeds.
    assert told(False) < 0.98, told(False)


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


@pytest.mark.needs("mitsuba_oidn")
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


@pytest.mark.needs("mitsuba_oidn")
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


@pytest.mark.needs("mitsuba_oidn")
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
        # What was shown tells enough to go on, unless a render has since gone on by itself.
        options = arguments(resumed)
        twins = remembered(options)
        shown = remembered_mean(options, twins)
        assert shown and shown.picture == folder / "leaf.exr" and len(shown.errors) == 2
        assert shown.errors[0].shape == samples_of(twins[0].picture).shape
        whole = errors_of(options).read_bytes()
        errors_of(options).write_bytes(whole[: len(whole) // 2])
        assert remembered_mean(options, twins) is None
        errors_of(options).write_bytes(whole)
        assert remembered_mean(options, twins) is not None
        # Nothing is left to do, and nothing is denoised.
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(warned):
            was = shown.picture.stat().st_mtime_ns
            assert print_scene([*resumed, "--error", "1"]) == 0
            assert shown.picture.stat().st_mtime_ns == was
        twins[1].picture.touch()
        assert remembered_mean(options, twins) is None
        # More renders, with samples where the others have theirs; fewer there cannot be.
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(warned):
            assert print_scene([*resumed, "--twins", "3"]) == 0
            assert print_scene([*resumed, "--twins", "2"]) == 2
        cells = said.getvalue().splitlines()[-1].strip("| ").split(" | ")
        assert len(cells[2].split(" + ")) == 3, cells
        assert "--twins 2: there are 3" in warned.getvalue(), warned.getvalue()
        third = samples_of(folder / "leaf-3.exr")
        both = np.mean([samples_of(twin.picture) for twin in twins], axis=0)
        assert (both == 32).any() and (both == 128).any()
        assert (third[both == 32] < third.max()).all() and third[both == 128].min() == third.max()
        assert not list(folder.glob("*.map.exr"))
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
            "leaf.twins.json: it was not written by lamina-print",
        ):
            assert problem in warned.getvalue(), warned.getvalue()
