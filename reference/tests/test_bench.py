"""Tests of the peers' harness; no peer is started.

Its statistics are held to closed forms, its scenes and spectra to what they claim to be, and its
table to the promise that no efficiency is printed of a program whose means are off.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

import numpy as np

from lamina_bench import (
    campaign,
    environments,
    job,
    lamina,
    leaf,
    programs,
    rates,
    report,
    scenes,
    spectra,
    statistics,
    svg,
    write,
)
from validation.program import program

PROGRAM = program()
ORDINARY = campaign.Plan((4, 16), 3, 1.0)


def fails(action: object, kind: type[Exception] = ValueError) -> bool:
    """Whether a call without arguments raises this."""
    try:
        action()
    except kind:
        return True
    return False


def test_rel_mse_is_that_of_known_deviations() -> None:
    reference = np.random.default_rng(1).uniform(0.2, 2.0, (6, 5, 3))
    deviation = np.random.default_rng(2).uniform(0.0, 0.1, reference.shape)
    # The unbiased variance of a - d, a, a + d is d².
    pictures = np.stack([reference - deviation, reference, reference + deviation])
    epsilon = (0.1 * reference.mean()) ** 2
    want = np.mean(deviation**2 / (reference**2 + epsilon))
    assert abs(statistics.rel_mse(pictures, reference) / want - 1.0) < 1e-12
    # Brighter light changes nothing.
    brighter = statistics.rel_mse(1e3 * pictures, 1e3 * reference)
    assert abs(brighter / want - 1.0) < 1e-12


def test_black_pixels_count_as_a_tenth_of_the_mean() -> None:
    reference = np.array([0.0, 2.0]).reshape(1, 2, 1)
    deviation = np.array([0.05, 0.0]).reshape(1, 2, 1)
    pictures = np.stack([reference - deviation, reference, reference + deviation])
    # The mean is 1, so that ε = 0.01: (0.05² / 0.01 + 0) / 2.
    assert abs(statistics.rel_mse(pictures, reference) - 0.125) < 1e-12


def test_efficiency_does_not_change_with_the_number_of_independent_samples() -> None:
    random = np.random.default_rng(3)
    reference = np.ones((200, 200, 3))
    found = []
    for spp in (1, 16, 256):
        noise = random.normal(0.0, 0.5 / np.sqrt(spp), (3, *reference.shape))
        error = statistics.rel_mse(reference + noise, reference)
        # Seconds grow with the samples: 0.25 / 1.01 a sample and 2 s a sample.
        found.append(statistics.efficiency(error, 2.0 * spp))
    # χ² of 2 degrees a value: the error's own relative deviation is 1 / √120,000.
    worst = max(abs(value * 2.0 * 0.25 / 1.01 - 1.0) for value in found)
    assert worst < 4.0 / np.sqrt(120_000), found


def test_what_is_no_measurement_is_refused() -> None:
    good = np.ones((3, 2, 2, 3))
    broken = good.copy()
    broken[1, 0, 0, 0] = np.nan
    assert fails(lambda: statistics.rel_mse(good[:2], good[0]))
    assert fails(lambda: statistics.rel_mse(broken, good[0]))
    assert fails(lambda: statistics.rel_mse(good, 0.0 * good[0]))
    assert fails(lambda: statistics.efficiency(0.0, 1.0))
    assert fails(lambda: statistics.efficiency(1.0, 0.0))


def test_standard_errors_of_regions_are_those_of_independent_pixels() -> None:
    random = np.random.default_rng(4)
    region = np.zeros((100, 100), dtype=bool)
    region[:, :50] = True
    pictures = random.normal(1.0, 0.2, (4, 100, 100, 3))
    mean = statistics.region_mean(pictures, region)
    want = 0.2 / np.sqrt(4 * region.sum())
    assert np.all(np.abs(mean.error / want - 1.0) < 0.05), mean
    assert np.all(np.abs(mean.value - 1.0) < 5.0 * want), mean


def test_means_disagree_only_beyond_bound_and_errors() -> None:
    def mean(value: float, error: float) -> statistics.Mean:
        return statistics.Mean(np.full(3, value), np.full(3, error))

    truth = mean(1.0, 1e-4)
    assert statistics.agrees(mean(1.01, 1e-4), truth, 0.02)
    assert not statistics.agrees(mean(1.03, 1e-4), truth, 0.02)
    assert not statistics.agrees(mean(0.97, 1e-4), truth, 0.02)
    # A noisy mean is not held to more than it can tell.
    assert statistics.agrees(mean(1.03, 0.01), truth, 0.02)
    one_channel = statistics.Mean(np.array([1.0, 1.0, 1.1]), np.full(3, 1e-4))
    assert not statistics.agrees(one_channel, truth, 0.02)


def test_equal_time_buys_samples_by_the_clock_that_is_asked_for() -> None:
    peer = campaign.Measured(programs.programs(PROGRAM)[1])
    peer.series[16] = campaign.Series(
        spp=[16.0] * 3, wall_s=[2.0, 1.0, 3.0], cpu_s=[1.0, 1.0, 5.0], pictures=[]
    )
    assert campaign.affordable(peer, ORDINARY, budget_s=6.0) == 48
    by_cpu = replace(ORDINARY, clock="cpu")
    seconds = peer.series[16].seconds("cpu")
    assert campaign.affordable(peer, by_cpu, budget_s=3.0 * seconds) == 48
    assert campaign.affordable(peer, ORDINARY, budget_s=1e-9) == 1
    peer.series[16].wall_s.pop()
    assert campaign.affordable(peer, ORDINARY, budget_s=6.0) is None


def test_processor_time_of_the_render_leaves_the_start_out() -> None:
    # 3 s to start and 0.5 s a sample: 3.5 s at one, 35 s at 64.
    assert abs(lamina.cpu_of_render(35.0, 3.5, 64) - 32.0) < 1e-12


def test_spectra_have_the_colours_and_the_products_of_colours() -> None:
    nm, weights = spectra.colour_weights()
    knots, r, t = spectra.read()
    assert r.min() > 0.0 and t.min() > 0.0 and (r + t).max() < 1.0
    r, t = np.interp(nm, knots, r), np.interp(nm, knots, t)
    r_colour, t_colour = np.array(spectra.REFLECTANCE), np.array(spectra.TRANSMITTANCE)
    for curve, want in (
        (r, r_colour),
        (t, t_colour),
        (r * r, r_colour**2),
        (r * t, r_colour * t_colour),
        (t * t, t_colour**2),
    ):
        # The table has five decimals.
        assert np.all(np.abs(weights.T @ curve - want) < 2e-5), (weights.T @ curve, want)


def test_meshes_are_as_large_as_the_table_says_and_have_no_degenerate_triangle() -> None:
    for quads, triangles in ((leaf.COARSE, 5040), (leaf.FINE, 504_000)):
        positions, corners = leaf.blade(*quads)
        assert len(corners) == triangles
        a, b, c = (positions[corners[:, i]].astype(np.float64) for i in range(3))
        normals = np.cross(b - a, c - a)
        # The adaxial side looks up.
        assert np.linalg.norm(normals, axis=1).min() > 0.0
        assert normals[:, 2].mean() > 0.0
    counts = {setting.name: len(setting.placements) for setting in scenes.all_settings()}
    assert counts == {"close-sun": 1, "close-lamp": 1, "mesh-sun": 300, "mesh-lamp": 300,
                      "instances-sun": 10_000, "instances-lamp": 10_000}  # fmt: skip


def test_placements_turn_and_do_not_stretch() -> None:
    turns = scenes.canopy(500, (1.0, 1.0, 1.0), 0.1, seed=5)[:, :, :3].astype(np.float64)
    unit = turns @ turns.transpose(0, 2, 1)
    assert np.abs(unit - np.eye(3)).max() < 1e-6
    assert np.abs(np.linalg.det(turns) - 1.0).max() < 1e-6


def test_lamps_face_their_targets() -> None:
    for setting in scenes.all_settings():
        if setting.lamp is None:
            continue
        corners = setting.lamp.corners()
        normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
        assert abs(np.linalg.norm(normal) / setting.lamp.side_m**2 - 1.0) < 1e-12
        towards = np.subtract(setting.lamp.target, setting.lamp.centre)
        cosine = normal @ towards / np.linalg.norm(normal) / np.linalg.norm(towards)
        assert abs(cosine - 1.0) < 1e-12
        assert np.abs(corners.mean(axis=0) - setting.lamp.centre).max() < 1e-12


def test_ply_files_read_back() -> None:
    mesh = leaf.blade(7, 4)
    with tempfile.TemporaryDirectory() as folder:
        leaf.write_ply(Path(folder, "leaf.ply"), *mesh)
        again = leaf.read_ply(Path(folder, "leaf.ply"))
    assert all(np.array_equal(a, b) for a, b in zip(mesh, again, strict=True))


def test_lamina_accepts_the_scenes() -> None:
    with tempfile.TemporaryDirectory() as folder:
        for file in write.write_all(Path(folder), ["close-sun", "instances-lamp"]):
            done = subprocess.run(
                [str(PROGRAM), "check", str(file.parent / "scene.toml")],
                capture_output=True, text=True, check=False,
            )  # fmt: skip
            assert done.returncode == 0, done.stderr
            assert "warning" not in done.stderr, done.stderr


def test_answers_of_a_stopped_worker_are_kept() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "scene.json").write_text('{"size": [4, 2]}', encoding="utf-8")
        requests = [job.Request(4, seed, str(folder / f"{seed}.npy")) for seed in (1, 2)]
        job.write(folder / "job.json", folder / "scene.json", requests, {"variant": "x"})
        read = job.read(folder / "job.json")
        assert read.requests == requests and read.options == {"variant": "x"}

        def prepare(given: job.Job) -> tuple[str, job.Renderer]:
            def render(spp: int, seed: int) -> job.Picture:
                if seed == 2:
                    raise RuntimeError("stopped")
                return job.Picture(np.full((2, 4, 3), spp, dtype=np.float32), 1.5, 2.5)

            return "9.9", render

        sys.argv, kept = ["worker", str(folder / "job.json")], sys.argv
        try:
            assert fails(lambda: job.serve(prepare), RuntimeError)
        finally:
            sys.argv = kept
        start, answers = job.answers(folder / "job.json")
        assert start["version"] == "9.9"
        assert [(one.seed, one.wall_s, one.cpu_s) for one in answers] == [(1, 1.5, 2.5)]
        assert np.all(np.load(answers[0].rgb) == 4.0)


def measured(folder: Path, brightness: dict[str, float]) -> list[campaign.Measured]:
    """Made-up pictures of some programs: light of this brightness with 1 % of noise."""
    known = {one.name: one for one in programs.programs(PROGRAM)}
    random = np.random.default_rng(6)
    found = []
    for name, level in brightness.items():
        one = campaign.Measured(known[name], version="1")
        for spp in ORDINARY.ladder:
            series = one.series.setdefault(spp, campaign.Series())
            for seed in range(3):
                file = folder / f"{name}-{spp}-{seed}.npy"
                np.save(file, level + 0.01 * random.standard_normal((32, 32, 3)))
                series.pictures.append(file)
                series.spp.append(spp)
                series.wall_s.append(0.1 * spp)
                series.cpu_s.append(0.1 * spp)
        found.append(one)
    return found


def test_a_program_whose_means_are_off_gets_no_efficiency() -> None:
    with tempfile.TemporaryDirectory() as folder:
        found = measured(Path(folder), {"lamina": 1.0, "cycles": 1.001, "embree": 1.05})
        luxcore = next(one for one in programs.programs(PROGRAM) if one.name == "luxcore")
        found.append(campaign.Measured(luxcore, reason="needs a horse"))
        whole = {"picture": np.ones((32, 32), dtype=bool)}
        campaign.compare_means(found, ORDINARY, whole)
        rows = campaign.facts(found, ORDINARY)
    by_name = {row["program"]: row for row in rows}
    for name, right in (("lamina", True), ("cycles", True), ("embree", False)):
        points = by_name[name]["points"]
        assert by_name[name]["agrees"] == right
        assert len(points) == 2 and all((at["efficiency"] is not None) == right for at in points)
    # 1e-4 / 1.01 in 1.6 s.
    assert abs(by_name["lamina"]["points"][-1]["efficiency"] * 1.6e-4 / 1.01 - 1.0) < 0.1
    scene = {"name": "made-up", "title": "made up", "programs": rows}
    text = "\n".join(report.scene_table(scene))
    assert "+4.9" in text and "so no efficiency" in text, text
    assert "LuxCore PATHCPU: needs a horse." in text, text
    line = report.summary([scene], "top")[-1]
    assert line.count("–") == 2, line
    # Equal samples, seconds and noise: the two stand alike, and the bare tracer is no peer.
    stands = report.standing([scene], 16)[-1].split(" | ")
    assert stands[1] == "Cycles (of those that finished)", stands
    assert abs(float(stands[2].strip("*")) - 1.0) < 0.2, stands
    json.dumps(rows)


def test_rates_of_programs_that_hit_something_else_are_not_printed() -> None:
    embree = {"mrays_per_s": 9.0, "mrays_per_cpu_s": 2.0, "rays": 100_000, "hits": 50_000}
    answers = {
        "Lamina": {**embree, "mrays_per_cpu_s": 3.0, "hits": 50_009},
        "Embree": embree,
        "Embree, robust": embree,
    }
    # Processor time is compared if all tell it; nine rays of 100,000 are within the agreement.
    assert rates.row("a", "b", answers).endswith("| 3.00 | 2.00 | 2.00 | **1.50** |")
    del answers["Embree"]["mrays_per_cpu_s"]
    assert rates.row("a", "b", answers).endswith("| 9.00 | 9.00 | 9.00 | **1.00** |")
    answers["Lamina"]["hits"] = 50_011
    assert rates.row("a", "b", answers).endswith("| **hits 50011: differs** | 9.00 | 9.00 | – |")


def test_programs_that_cannot_be_had_are_told_with_the_reason() -> None:
    cycles = programs.programs(PROGRAM)[1]
    kept = environments.FOLDER, environments.PYTHON
    with tempfile.TemporaryDirectory() as folder:
        try:
            environments.FOLDER, environments.PYTHON = Path(folder), "no-such-python"
            outcome = programs.run(cycles, Path("scene.json"), [], Path(folder), 1.0)
        finally:
            environments.FOLDER, environments.PYTHON = kept
    assert outcome.reason is not None and "apt-get install python3.11" in outcome.reason
    gone = programs.programs(Path("/no/such/lamina"))[0]
    outcome = programs.run(gone, Path("scene.json"), [], Path("/nowhere"), 1.0)
    assert outcome.reason is not None and "cargo build --release" in outcome.reason


def test_charts_are_logarithmic_and_leave_empty_lines_out() -> None:
    text = svg.plot("a <b>", [("one", [(1.0, 0.1), (10.0, 0.01), (100.0, 0.001)]), ("none", [])],
                    "seconds")  # fmt: skip
    tree = ElementTree.fromstring(text)
    lines = tree.findall("{http://www.w3.org/2000/svg}polyline")
    assert len(lines) == 1
    places = np.array([pair.split(",") for pair in lines[0].get("points").split()], dtype=float)
    steps = np.diff(places, axis=0)
    assert np.abs(steps[0] - steps[1]).max() < 0.2, places
    assert steps[0, 0] > 0.0 and steps[0, 1] > 0.0
