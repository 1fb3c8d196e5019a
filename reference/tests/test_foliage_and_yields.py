"""Discrete ordinates of inclined leaves, and yields of fluorescence."""

import csv
import math
from pathlib import Path

import pytest

from validation import fluorescence_yields, inclined_foliage

DATA = Path(__file__).resolve().parents[2] / "tests/data"


def anchors():
    """Canopies by PythonicDISORT that absorb something."""
    text = (DATA / "transport_anchors.csv").read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in text if not line.startswith("#"))
    return [row for row in rows if row["kind"] == "canopy" and row["rho"] != "0.5"]


def test_ordinates_of_spherical_leaves_are_those_of_another_program():
    for row in anchors():
        numbers = [float(row[key]) for key in ("lai", "rho", "tau", "rs", "sza")]
        found = inclined_foliage.fluxes(inclined_foliage.DENSITIES["spherical"], *numbers)
        for value, key in zip(found, ("R1", "T1", "T0"), strict=True):
            assert value == pytest.approx(float(row[key]), abs=1.2e-5), row


def test_the_table_of_fluxes_is_what_its_program_computes():
    text = (DATA / "inclined_foliage.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in text if not line.startswith("#")))
    assert len(rows) == 56
    for row in rows[::9]:
        numbers = [float(row[key]) for key in ("lai", "rho", "tau", "soil", "sun_deg")]
        density = inclined_foliage.DENSITIES[row["inclination"]]
        found = inclined_foliage.fluxes(density, *numbers, ordinates=24)
        wanted = [float(row[key]) for key in ("reflected", "arriving_at_soil", "uncollided")]
        assert found == pytest.approx(wanted, abs=2e-6), row


def test_yields_are_those_of_open_and_of_closed_reaction_centres_at_the_ends():
    for temperature in (5, 25, 40):
        heat = max(0.8738, 0.0301 * temperature + 0.0773)
        dark = fluorescence_yields.steady_yield(0, temperature)
        assert dark == pytest.approx(0.05 / (0.05 + heat + 4), rel=1e-12)
        # All are closed in light without end, and regulated heat is at its most.
        bright = fluorescence_yields.steady_yield(1e9, temperature)
        assert bright == pytest.approx(0.05 / (0.05 + heat + 2.48), rel=1e-5)


def test_the_table_of_yields_is_what_its_program_computes():
    with fluorescence_yields.OUT.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    pairs = len(fluorescence_yields.IRRADIANCES) * len(fluorescence_yields.TEMPERATURES_C)
    assert len(rows) == pairs
    for row in rows:
        place = float(row["irradiance_umol_m2_s"]), float(row["temperature_c"])
        found = fluorescence_yields.steady_yield(*place)
        assert math.isclose(found, float(row["yield"]), abs_tol=6e-7), row
