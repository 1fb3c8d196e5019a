"""Reflectance and transmittance of leaves."""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from lamina.conventions import WAVELENGTH, without_fill_values
from lamina.program import run

# Argument of `optics`, which is the column of the program's table too, and its unit.
CONTENTS = {
    "structure": "1",
    "chlorophyll": "ug cm-2",
    "carotenoids": "ug cm-2",
    "anthocyanins": "ug cm-2",
    "betacyanins": "ug cm-2",
    "betaxanthins": "ug cm-2",
    "brown": "1",
    "water": "cm",
    "dry_matter": "g cm-2",
    "proteins": "g cm-2",
    "carbon_based": "g cm-2",
}
MODELS = ("prospect-d", "prospect-pro", "prospect-5", "prospect-4")


def optics(
    preset: str | None = None,
    *,
    model: str = MODELS[0],
    wavelengths: Sequence[float] | None = None,
    **contents: ArrayLike,
) -> xr.Dataset:
    """`reflectance` and `transmittance` of leaves by PROSPECT over `wavelength`.

    `preset` is one of those that `lamina optics --list` names; contents that are given take the
    place of its own: `structure` (1 and more), `chlorophyll`, `carotenoids`, `anthocyanins`,
    `betacyanins`, `betaxanthins` (µg/cm²), `brown`, `water` (cm), `dry_matter` (g/cm²); with the
    `model` prospect-pro `proteins` and `carbon_based` (g/cm²) in place of dry matter. Other models
    are prospect-5 and prospect-4. A number holds for all leaves; lists and arrays of one dimension
    have a value for each leaf, and the result has the dimension `leaf` and the contents as its
    coordinates. All leaves are computed by one call of the program, at `wavelengths` (nm) or at
    each nanometre from 400 to 2500.

    Raises TypeError for another name, ValueError for arrays of different lengths or another model,
    LaminaError for a value out of its range and for a content that the model does not have.
    """
    for name in contents:
        if name not in CONTENTS:
            raise TypeError(f"optics() has no {name!r}; it has {', '.join(CONTENTS)}")
    if model not in MODELS:
        raise ValueError(f"there is no model {model!r}; there are {', '.join(MODELS)}")
    given = {name: np.asarray(value, float) for name, value in contents.items()}
    columns = dict(zip(given, np.broadcast_arrays(*given.values()), strict=True))
    shape = next((column.shape for column in columns.values()), ())
    if len(shape) > 1:
        raise ValueError(f"contents of shape {shape}: give numbers, and arrays of one dimension")
    count = shape[0] if shape else 1
    with tempfile.TemporaryDirectory() as folder:
        table, array = Path(folder, "leaves.csv"), Path(folder, "spectra.npy")
        with table.open("w", encoding="utf-8", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(["leaf", *columns])
            values = [np.broadcast_to(column, count).tolist() for column in columns.values()]
            rows.writerows(zip(range(count), *values, strict=True))
        arguments: list[str | Path] = ["optics", "--table", table, "--out", array]
        arguments += ["--model", model]
        if preset is not None:
            arguments += ["--preset", preset]
        nanometres = np.arange(400.0, 2501.0)
        if wavelengths is not None:
            nanometres = np.asarray(wavelengths, float)
            arguments.append("--nm=" + ",".join(map(repr, nanometres.tolist())))
        run(arguments)
        spectra = np.load(array)
    dims = ("leaf", "wavelength") if shape else ("wavelength",)
    found = xr.Dataset(
        {
            name: (
                dims,
                spectra[:, place] if shape else spectra[0, place],
                {"units": "1", "long_name": f"directional-hemispherical {name} of a leaf"},
            )
            for place, name in enumerate(("reflectance", "transmittance"))
        },
        coords={"wavelength": ("wavelength", nanometres, WAVELENGTH)},
        attrs={} if preset is None else {"preset": preset},
    )
    for name, value in given.items():
        if value.ndim:
            attrs = {"units": CONTENTS[name], "long_name": f"{name.replace('_', ' ')} of the leaf"}
            found.coords[name] = ("leaf", columns[name], attrs)
        else:
            found.attrs[name] = float(value)
    return without_fill_values(found)
