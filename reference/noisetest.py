#!/usr/bin/env python3
"""Tests of `reference/noise`: run by `reference/self-test`."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np

from lamina_reference.exr import Array, write_channels
from lamina_reference.noise import relative_error
from lamina_reference.testing import run_tests

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
        for name, problem in ((file, "no layer variance of R, G, B"), (Path(folder, "no.exr"), "no.exr")):
            try:
                relative_error(str(name))
            except SystemExit as refusal:
                assert problem in str(refusal)
            else:
                raise AssertionError(f"{name} has no noise to tell")


if __name__ == "__main__":
    sys.exit(run_tests(globals(), "noise"))
