"""Many leaves in one call of `lamina optics`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import lamina
from lamina.program import run


def test_arrays_give_a_leaf_for_each_value() -> None:
    found = lamina.optics(
        "sun-green", chlorophyll=[20, 40, 60], water=np.array([0.01, 0.02, 0.03]), brown=0.1
    )
    assert dict(found.sizes) == {"leaf": 3, "wavelength": 2101}
    assert found.chlorophyll.values.tolist() == [20, 40, 60]
    assert found.attrs == {"preset": "sun-green", "brown": 0.1}
    alone = lamina.optics("sun-green", chlorophyll=40, water=0.02, brown=0.1)
    assert alone.reflectance.dims == ("wavelength",)
    for name in ("reflectance", "transmittance"):
        assert np.array_equal(found[name].isel(leaf=1), alone[name])


def test_wavelengths_may_be_chosen() -> None:
    every = lamina.optics(chlorophyll=[30])
    some = lamina.optics(chlorophyll=[30], wavelengths=[680, 550.5])
    assert some.wavelength.values.tolist() == [680, 550.5]
    assert float(some.reflectance[0, 0]) == float(every.reflectance.sel(wavelength=680)[0])


def test_what_no_leaf_has_is_refused() -> None:
    with pytest.raises(lamina.LaminaError, match="outside 0 to 1 g/cm²"):
        lamina.optics(dry_matter=[0.01, 90])
    with pytest.raises(ValueError, match="shape"):
        lamina.optics(chlorophyll=[1, 2], water=[0.1, 0.2, 0.3])
    with pytest.raises(ValueError, match="one dimension"):
        lamina.optics(chlorophyll=[[1, 2]])
    with pytest.raises(TypeError, match="chlorophyll"):
        lamina.optics(chlorofyll=3)


def test_a_fit_of_many_spectra_gives_back_the_table(tmp_path: Path) -> None:
    """A table to spectra, those to contents, and these to the same spectra."""
    table, spectra, contents, again = (
        tmp_path / name for name in ("leaves.csv", "spectra.csv", "contents.csv", "again.csv")
    )
    table.write_text('id;cab;car\nbirch;30,5;7\n"oak, old";45;9\n', encoding="utf-8")
    run(["optics", "--table", table, "--out", spectra])
    long = pd.read_csv(spectra, comment="#")
    assert list(long) == ["id", "wavelength_nm", "R", "T"]
    assert long.id.unique().tolist() == ["birch", "oak, old"] and len(long) == 2 * 2101
    birch = lamina.optics(chlorophyll=30.5, carotenoids=7)
    np.testing.assert_allclose(long.R[long.id == "birch"], birch.reflectance, rtol=1e-15)
    run(["fit", spectra, "--out", contents])
    found = pd.read_csv(contents, comment="#")
    np.testing.assert_allclose(found.chlorophyll_ug_per_cm2, [30.5, 45], rtol=1e-3)
    run(["optics", "--table", contents, "--out", again])
    assert pd.read_csv(again, comment="#").leaf.unique().tolist() == ["birch", "oak, old"]
    np.testing.assert_allclose(pd.read_csv(again, comment="#").R, long.R, atol=1e-5)
