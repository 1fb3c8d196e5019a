"""Colours of leaves by the program and by colour-science."""

from __future__ import annotations

import pytest

pytest.importorskip("mitsuba")

import numpy as np

from validation import colour, colours
from validation.program import program


def test_colours_of_the_presets_are_those_of_colour_science() -> None:
    rows = colours.rows(program())
    assert len(rows) == 2 * 19, len(rows)
    for row in rows:
        assert row.worst < colours.MOST, row
        assert row.spectra_differ_by < 1e-8, row


def test_a_colour_five_percent_too_bright_is_told_apart() -> None:
    sun_green = np.array([0.0855, 0.1068, 0.0494])
    assert colour.delta_e_of_xyz(sun_green, sun_green) == 0.0
    assert colour.delta_e_of_xyz(sun_green, 1.05 * sun_green) > colours.MOST
    assert colour.delta_e_of_xyz(sun_green, sun_green * [1.03, 1.0, 1.0]) > colours.MOST
