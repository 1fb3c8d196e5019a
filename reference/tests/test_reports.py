"""Tests of reports. Pages are opened in Chromium too if it is there."""

from __future__ import annotations

import csv
import json
import re
import shutil
import subprocess
import tempfile
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

import lamina
from lamina.plots import plot, ticks
from lamina.report import main as command
from lamina.report import report
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]

FURNACE = ROOT / "scenes" / "furnace" / "scene.toml"
SMALL = {"film.spectral.size": [12, 8]}
VOID = {"meta", "img", "input", "link", "br", "hr"}


class Page(HTMLParser):
    """What a page holds; raises AssertionError for tags that do not match."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.open: list[str] = []
        self.links: list[str] = []
        self.pictures: list[str | None] = []
        self.text = file.read_text(encoding="utf-8")
        self.feed(self.text)
        assert self.open == [], self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        known = dict(attrs)
        self.links += [known[name] or "" for name in ("src", "href") if name in known]
        if tag == "img":
            assert known["width"] and known["height"]
            self.pictures.append(known["alt"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Drawn lines and circles close themselves."""

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open.pop() == tag, tag


def checked(file: Path) -> Page:
    """A page that needs nothing else, and that Chromium shows if it is there."""
    page = Page(file)
    assert all(link.startswith(("data:image/png;base64,", "#part-")) for link in page.links)
    assert not re.search(r"https?://|@import|url\(", page.text)
    assert "viewport" in page.text and "prefers-color-scheme: dark" in page.text
    browser = shutil.which("chromium")
    if browser:
        done = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=400,800"]
            + ["--dump-dom", file.as_uri()],
            capture_output=True,
            text=True,
            timeout=120,
            check=True,
        )
        # The script has run: it sets where the border is.
        assert ("--cut: 50%" in done.stdout) == ('class="cut"' in page.text)
    return page


def test_two_pictures_are_compared_by_their_numbers() -> None:
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder)
        pictures = [
            lamina.render(FURNACE, SMALL, spp=4, seed=seed, out=made / name)
            for seed, name in ((1, "a"), (2, "<b>"))
        ]
        file = report([made / "a.exr", made / "<b>.exr"], made / "page.html")
        page = checked(file)
        assert len(page.pictures) == 2 + 2 * 4
        means = [float(picture.radiance.sel(wavelength=550).mean()) for picture in pictures]
        for mean in means:
            assert f"<td>{mean:.5g}</td>" in page.text
        # Names are text, never tags.
        assert "&lt;b&gt;" in page.text and "<b>" not in page.text


def test_a_denoised_picture_is_no_measurement() -> None:
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, "made.exr")
        lamina.render(FURNACE, SMALL, spp=1, out=made)
        denoised = oiio.ImageBuf(str(made))
        denoised.specmod().attribute("lamina:denoised", "by hand")
        assert denoised.write(str(made.with_stem("clean")))
        try:
            report([made, made.with_stem("clean")], Path(folder, "page.html"))
        except ValueError as error:
            assert "clean.exr is denoised" in str(error), error
        else:
            raise AssertionError("a denoised picture was compared")
        assert not Path(folder, "page.html").exists()


def test_a_sweep_has_its_tasks_pictures_and_plots() -> None:
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, "made")
        words = ["--over", "film.spectral.filter_radius_px=0.5,1,2", "--spp", "2"]
        size = ["-D", "film.spectral.size=[12, 8]"]
        subprocess.run(
            [program(), "sweep", FURNACE, *words, *size, "--out", made],
            capture_output=True,
            check=True,
        )
        page = checked(report([made], Path(folder, "page.html")))
        assert "3 of 3 tasks are done" in page.text
        assert "--over film.spectral.filter_radius_px=0.5,1,2 -D " in page.text
        assert "film.spectral.size=[12, 8]&#39; --spp 2 --out made" in page.text
        assert len(page.pictures) == 3 + 2
        # A plot for each of the four bands, each with three points.
        assert page.text.count("<circle") == 4 * 3
        with (made / "sweep.csv").open(newline="") as table:
            for row in csv.DictReader(table):
                assert f"<td>{float(row['mean.550nm']):.5g}</td>" in page.text


def test_a_sweep_of_leaves_has_means_over_seeds_and_a_contact_sheet() -> None:
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, "made")
        words = ["--over", "kill_distance_segments=1,4", "--seeds", "3", "--out", made]
        subprocess.run([program(), "sweep", "poplar", *words], capture_output=True, check=True)
        page = checked(report([made], Path(folder, "page.html")))
        assert "6 of 6 tasks are done" in page.text
        # Each leaf once; its page needs no drawing of a quarter of a megabyte.
        assert len(page.pictures) == 6 and len(page.text) < 1_000_000
        assert "kill_distance_segments 4, seed 3" in page.pictures
        name = "vein_density_mm_per_mm2"
        with (made / "sweep.csv").open(newline="") as table:
            rows = list(csv.DictReader(table))
        for kill in ("1", "4"):
            values = [float(row[name]) for row in rows if row["kill_distance_segments"] == kill]
            mean, error = np.mean(values), np.std(values, ddof=1) / np.sqrt(3)
            assert f"<title>{kill}: {mean:.6g} ± {error:.2g}</title>" in page.text
        # The length does not vary and has no plot; six measures have, over the key that was swept.
        assert page.text.count('<figure class="plot">') == 6
        assert "length_mm over" not in page.text


def test_results_of_the_comparison_are_told_as_they_are() -> None:
    results = ROOT / "reference" / "results"
    told = json.loads((results / "flat-leaf.json").read_text())
    with tempfile.TemporaryDirectory() as folder:
        page = checked(report([results], Path(folder, "page.html")))
        assert "flat-leaf" in page.text and "ΔE2000" in page.text
        # Results from before they had both pictures go without the border.
        pairs = len(list(results.glob("*-mitsuba.png")))
        assert page.text.count('class="cut"') == pairs
        assert f"<td>{told['bands'][0]['z']:+.2f}</td>" in page.text
        # A result that differs is told so.
        told |= {"passed": False, "failures": ["[mean] 450 nm <off>"]}
        Path(folder, "x.json").write_text(json.dumps(told))
        page = checked(report([folder], Path(folder, "page.html")))
        assert "differs: [mean] 450 nm &lt;off&gt;" in page.text


def test_other_input_is_refused_in_one_line() -> None:
    with tempfile.TemporaryDirectory() as folder:
        assert command([folder, "--out", f"{folder}/page.html"]) == 2
        assert command([f"{folder}/none", "--out", f"{folder}/page.html"]) == 2
        assert not Path(folder, "page.html").exists()


def test_ticks_are_round_and_hold_all_points() -> None:
    for low, high in ((0.0, 1.0), (-3e-7, 2e-6), (0.0384, 0.0411), (5.0, 5.0), (-90.0, 1234.0)):
        marks = ticks(low, high)
        assert marks[0] <= low and marks[-1] >= high and 2 <= len(marks) <= 8, marks
        assert np.allclose(np.diff(marks), marks[1] - marks[0])
    assert plot([("a", "1", ""), ("b", "2", "")], "x", "y", False) == []
