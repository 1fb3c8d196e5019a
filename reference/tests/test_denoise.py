"""Tests of `lamina-denoise`.

Pictures here are made of light that is known and noise of a fixed seed, so that what comes out can
be held against the truth.
"""

from __future__ import annotations

import contextlib
import os
import resource
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("mitsuba_oidn")

from noisy_films import (
    BANDS,
    HEIGHT,
    LEAF,
    PAPER,
    SCENE,
    STEM,
    WIDTH,
    attributes,
    call,
    colour_film,
    denoised,
    error,
    named,
    noisy,
    scratch,
    spectral_film,
    stacked,
    to_709,
    truth,
    write,
)

from lamina.denoise import NOTE, Denoiser
from lamina.exr import read_channels
from lamina.film import ALBEDO
from lamina.film import read as read_film
from validation.program import program


@contextlib.contextmanager
def lamina(named: str) -> Iterator[None]:
    """Another program under LAMINA."""
    kept = os.environ.get("LAMINA")
    os.environ["LAMINA"] = named
    try:
        yield
    finally:
        os.environ.pop("LAMINA")
        if kept is not None:
            os.environ["LAMINA"] = kept


def test_denoised_colours_are_nearer_to_the_truth() -> None:
    light = truth((LEAF, PAPER, STEM))
    right = to_709(light)
    # The trap: a denoiser that takes negative blue for 0 changes every leaf's colour.
    assert right[5, 5, 2] < -0.01
    with scratch() as folder:
        layers = colour_film(light)
        for flags, least in (((), 4.0), (("--no-guides",), 3.0)):
            clean, warned = denoised(folder, layers, *flags)
            got = stacked(clean, ("R", "G", "B"))
            before, after = (error(a, right) for a in (stacked(layers, ("R", "G", "B")), got))
            assert before > least * after, (flags, before, after)
            assert np.abs(got.mean((0, 1)) / right.mean((0, 1)) - 1).max() < 0.05
            assert abs(got[:40, :10, 2].mean() / right[:40, :10, 2].mean() - 1) < 0.1
            assert ("guided by albedo and N" in warned) == (not flags), warned


def test_denoised_bands_are_nearer_to_the_truth() -> None:
    light, layers = spectral_film()
    with scratch() as folder:
        clean, warned = denoised(folder, layers)
    got = stacked(clean, BANDS)
    for number, band in enumerate(BANDS):
        one = (slice(None), slice(None), slice(number, number + 1))
        before, after = error(stacked(layers, BANDS)[one], light[one]), error(got[one], light[one])
        assert before > 3 * after, (band, before, after)
    assert "without guides: the picture has no layer albedo" in warned


def test_guides_keep_what_noise_hides() -> None:
    # Veins of one pixel, of which each pixel of the picture alone tells little.
    light = truth((PAPER, PAPER, PAPER))
    light[:, ::6] *= 0.6
    # Bands that see the same, whose albedo is one number.
    bands = np.stack([light[:, :, 0]] * len(BANDS), axis=2)
    grey = {**spectral_film()[1], **named(BANDS, noisy(bands)), "albedo.Y": light[:, :, 0]}
    with scratch() as folder:
        for layers, names, right in (
            (colour_film(light), ("R", "G", "B"), to_709(light)),
            (grey, BANDS, bands),
        ):
            errors = [
                error(stacked(denoised(folder, layers, *flags)[0], names), right)
                for flags in ((), ("--no-guides",))
            ]
            assert errors[1] > 1.5 * errors[0], (names, errors)


def test_guides_have_the_edges_of_the_light() -> None:
    # Features are means over what was met; where a quarter of a pixel is covered, so is the guide.
    layers = colour_film(truth((PAPER, PAPER, PAPER)))
    layers |= named(ALBEDO, np.full((HEIGHT, WIDTH, 3), 0.8)) | {"A": 0.25 * layers["A"]}
    with scratch() as folder:
        guides = Denoiser().guides(read_film(write(folder / "in.exr", layers)))
    assert abs(guides["albedo"].mean() - 0.2) < 0.01, guides["albedo"].mean()
    assert abs(guides["normal"][:, :, 2].mean() - 0.25) < 0.0125, guides["normal"].mean((0, 1))


def test_all_else_in_the_file_stays_and_the_note_is_added() -> None:
    light, bands = spectral_film()
    for layers, guides in ((colour_film(truth((LEAF, PAPER, STEM))), "albedo, N"), (bands, "none")):
        with scratch() as folder:
            clean, _ = denoised(folder, layers)
            source, out = folder / "in.exr", folder / "out.exr"
            before = read_channels(source)
            assert list(before) == list(clean)
            for name, values in before.items():
                same = np.array_equal(values, clean[name])
                assert same == (name not in ("R", "G", "B", *BANDS)), name
            old, new = attributes(source), attributes(out)
            kind, note = new.pop(NOTE)
            assert old == new, set(old.items()) ^ set(new.items())
            words = note.decode()
            assert kind == "string" and words.startswith("Open Image Denoise 2."), words
            assert f"; guides: {guides}; " in words and "no measurement" in words, words


def test_one_picture_gives_the_same_bytes_again_and_is_not_changed() -> None:
    with scratch() as folder:
        source = write(folder / "in.exr", colour_film(truth((LEAF, PAPER, STEM))))
        bytes_in = source.read_bytes()
        for name in ("a.exr", "b.exr"):
            assert call(source, "--out", folder / name)[0] == 0
        assert (folder / "a.exr").read_bytes() == (folder / "b.exr").read_bytes()
        assert source.read_bytes() == bytes_in


def test_a_band_without_light_stays_black() -> None:
    _, layers = spectral_film()
    layers[BANDS[2]] = np.zeros((HEIGHT, WIDTH))
    with scratch() as folder:
        clean, _ = denoised(folder, layers)
    assert not clean[BANDS[2]].any() and clean[BANDS[1]].mean() > 0.1


def test_what_is_below_zero_in_a_band_is_kept_in_the_mean() -> None:
    light, layers = spectral_film()
    layers[BANDS[0]] = layers[BANDS[0]].copy()
    layers[BANDS[0]][:, :20] = -0.3
    with scratch() as folder:
        clean, _ = denoised(folder, layers)
    assert np.abs(clean[BANDS[0]][:, :16] + 0.3).max() < 0.02


def test_the_picture_to_look_at_is_shown_as_its_scene_says() -> None:
    with scratch() as folder:
        scene, stem = folder / "scene.toml", folder / "made"
        scene.write_text(SCENE, encoding="utf-8")
        line = [str(program()), "render", str(scene), "--out", str(stem), "--noise", "0"]
        subprocess.run(line, check=True, capture_output=True)
        out, png = folder / "out.exr", folder / "out.png"
        status, said, warned = call(f"{stem}.exr", "--out", out, "--png", png)
        assert status == 0 and said == f"{out}\n{png}\n", warned
        assert "guided by albedo and N" in warned
        old, new = attributes(Path(f"{stem}.exr")), attributes(out)
        # Whether a channel is linear to the eye is nothing that a film of light says.
        assert old.pop("channels")[0] == new.pop("channels")[0] == "chlist"
        assert NOTE in new and old == {name: new[name] for name in new if name != NOTE}
        own = folder / "own.png"
        line = [str(program()), "tonemap", str(out), "--out", str(own)]
        flags = ["--exposure-ev", "2", "--tone", "filmic"]
        subprocess.run([*line, *flags], check=True, capture_output=True)
        assert own.read_bytes() == png.read_bytes()
        subprocess.run([*line, "--exposure-ev", "0"], check=True, capture_output=True)
        assert own.read_bytes() != png.read_bytes()
        # Of the render it is the same picture but for its noise.
        shown, rendered = (read_channels(file) for file in (png, Path(f"{stem}.png")))
        assert np.abs(shown["G"] - rendered["G"]).mean() < 0.05


def test_alpha_has_the_soft_edges_of_the_colours_that_are_multiplied_by_it() -> None:
    # A white foreground before nothing: colour and alpha are the same, and so is their noise. The
    # edge is 24 pixels wide, as out of focus, and 8 samples know it badly.
    x = np.arange(WIDTH)
    soft = np.broadcast_to(np.clip((x - 36) / 24, 0, 1), (HEIGHT, WIDTH))
    share = np.random.default_rng(5).binomial(8, soft) / 8
    layers = named(("R", "G", "B"), np.stack([0.5 * share] * 3, axis=2)) | {"A": share}
    with scratch() as folder:
        clean, _ = denoised(folder, layers, "--no-guides")
    alpha = clean["A"]
    edge = (soft > 0.2) & (soft < 0.8)
    before, after = (np.abs(found - soft)[edge].mean() for found in (share, alpha))
    assert before > 3 * after, (before, after)
    fringes = {
        name: np.abs(clean["G"][edge] / 0.5 - over[edge]).mean()
        for name, over in (("kept", share), ("denoised", alpha))
    }
    assert fringes["denoised"] < 0.1 * fringes["kept"], fringes
    for away, value in ((x < 30, 0), (x > 66, 1)):
        assert (alpha[:, away] == value).all(), value


def test_a_scene_is_rendered_and_denoised_in_one_command() -> None:
    with scratch() as folder:
        scene, out, png = folder / "scene.toml", folder / "out.exr", folder / "out.png"
        scene.write_text(SCENE, encoding="utf-8")
        words = ("--out", out, "--png", png, "--spp", 4, "-D", "film.rgb.seed=3")
        status, said, warned = call(scene, *words)
        assert status == 0 and said == f"{out}\n{png}\n", warned
        stem = folder / "own"
        line = [str(program()), "render", str(scene), "--out", str(stem), "--spp", "4"]
        subprocess.run([*line, "--seed", "3"], check=True, capture_output=True)
        assert call(f"{stem}.exr", "--out", folder / "own-clean.exr")[0] == 0
        same = read_channels(out), read_channels(folder / "own-clean.exr")
        assert all(np.array_equal(same[0][name], same[1][name]) for name in same[0])
        assert not [file for file in folder.iterdir() if file.name.startswith(".")]


def test_a_scene_that_cannot_be_denoised_is_refused_before_it_is_rendered() -> None:
    with scratch() as folder, lamina("/bin/false"):
        scene, out = folder / "scene.toml", folder / "out.exr"
        scene.write_text(SCENE.replace("[48, 32]", "[48, 8]"), encoding="utf-8")
        for words, message in (
            ((), "film.size = [48, 8]: at least 16 pixels"),
            (("-D", "film.rgb.size=[9, 64]"), "film.size = [9, 64]: at least 16 pixels"),
            (("--twin", out), "lamina-print renders and denoises several"),
        ):
            status, said, warned = call(scene, "--out", out, *words)
            assert (status, said) == (2, "") and message in warned, warned
        # Only the program can say what else is wrong.
        assert call(scene, "--out", out, "-D", "film.rgb.size=[48, 32]")[0] == 1
        assert list(folder.iterdir()) == [scene]


def test_a_denoised_picture_is_refused() -> None:
    with scratch() as folder:
        _, layers = spectral_film()
        denoised(folder, layers)
        status, _, warned = call(folder / "out.exr", "--out", folder / "again.exr")
        assert status == 2 and f"denoised already ({NOTE}: Open Image Denoise 2." in warned, warned
        assert not (folder / "again.exr").exists()


def refusals(folder: Path) -> list[tuple[list[object], int, str]]:
    """Words that are refused, the exit status, and what is said."""
    _, layers = spectral_film()
    good = write(folder / "good.exr", layers)
    other = write(folder / "other.exr", {"A": layers["A"], "depth.Z": layers["A"]})
    broken = layers | {BANDS[1]: layers[BANDS[1]].copy()}
    broken[BANDS[1]][7, 11] = np.nan
    broken[BANDS[1]][8, 2] = np.inf
    nan = write(folder / "nan.exr", broken)
    again = write(folder / "again.exr", layers, {NOTE: "by someone"})
    small = write(folder / "small.exr", {name: layers[name][:15, :40] for name in layers})
    cut, text = folder / "cut.exr", folder / "text.exr"
    cut.write_bytes(good.read_bytes()[:3000])
    text.write_text("no picture")
    link, inside = folder / "link.exr", folder / "text.exr" / "x.exr"
    link.symlink_to(good)
    new = folder / "new.exr"
    return [
        ([folder / "none.exr", "--out", new], 2, "none.exr: No such file"),
        ([folder, "--out", new], 2, "Is a directory"),
        ([text, "--out", new], 2, "text.exr: it is no EXR file"),
        ([cut, "--out", new], 2, "cut.exr: it is damaged: "),
        ([other, "--out", new], 2, "neither channels R, G, B nor bands"),
        ([nan, "--out", new], 2, f"{BANDS[1]} is not finite in 2 pixels, the first at x = 11, y"),
        ([again, "--out", new], 2, "denoised already (lamina:denoised: by someone)"),
        ([small, "--out", new], 2, "it has less than 16 pixels across or down"),
        ([good, "--out", good], 2, "good.exr: it is the input"),
        ([good, "--out", link], 2, "link.exr: it is the input"),
        ([link, "--out", good], 2, "good.exr: it is the input"),
        ([good, "--out", folder / "new.tif"], 2, "the ending tells what is written: exr"),
        ([good, "--out", folder / "no" / "x.exr"], 2, "there is no folder"),
        ([good, "--out", inside], 2, "there is no folder"),
        ([good, "--out", new, "--png", folder / "x.tif"], 2, "what is written: png or jpg"),
        ([good, "--out", new, "--png", folder / "no" / "x.png"], 2, "there is no folder"),
        ([good, "--out", new, "--quality", "best"], 2, "unrecognized arguments: --quality best"),
        ([good], 2, "the following arguments are required: --out"),
    ]  # fmt: skip


def test_what_cannot_be_done_is_told_in_one_line_and_leaves_nothing() -> None:
    with scratch() as folder:
        for words, status, message in refusals(folder):
            files = sorted(folder.iterdir())
            got, said, warned = call(*words)
            assert (got, said) == (status, ""), (words, got, said, warned)
            last = warned.splitlines()[-1]
            assert message in last and last.startswith("lamina-denoise: "), warned
            # argparse shows the usage first.
            assert warned.count("\n") == 1 or warned.startswith("usage: "), warned
            assert sorted(folder.iterdir()) == files, words


def test_a_folder_that_cannot_be_written_is_told() -> None:
    with scratch() as folder:
        good = write(folder / "good.exr", spectral_film()[1])
        # Whoever may do everything writes into any folder but those of the kernel.
        out = Path("/proc/x.exr")
        if os.geteuid() != 0:
            closed = folder / "closed"
            closed.mkdir(mode=0o500)
            out = closed / "x.exr"
        status, _, warned = call(good, "--out", out)
        assert status == 1 and "x.exr: the folder cannot be written: " in warned, warned


def test_a_program_for_the_picture_that_is_missing_is_told() -> None:
    with scratch() as folder:
        good = write(folder / "good.exr", spectral_film()[1])
        out, png = folder / "out.exr", folder / "out.png"
        with lamina("/no/such/lamina"):
            status, _, warned = call(good, "--out", out, "--png", png)
        assert status == 2 and "LAMINA names no program: /no/such/lamina" in warned, warned
        # Before any work.
        assert not out.exists()


def test_a_program_for_the_picture_that_fails_leaves_the_exr() -> None:
    with scratch() as folder:
        good = write(folder / "good.exr", spectral_film()[1])
        out, png = folder / "out.exr", folder / "out.png"
        with lamina("/bin/false"):
            status, said, warned = call(good, "--out", out, "--png", png)
        assert status == 1 and "tonemap" in warned and said == f"{out}\n", warned
        assert NOTE in attributes(out) and not png.exists()


def test_a_full_disk_leaves_the_old_file() -> None:
    with scratch() as folder:
        good = write(folder / "good.exr", spectral_film()[1])
        out = folder / "out.exr"
        out.write_text("old")
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, limits[1]))
        try:
            status, said, warned = call(good, "--out", out)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        assert status == 1 and said == "" and "out.exr: " in warned, (status, warned)
        assert out.read_text() == "old"
        # And with room it is replaced.
        assert call(good, "--out", out)[0] == 0 and NOTE in attributes(out)
