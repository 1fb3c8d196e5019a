"""Attributes that say to other programs what an array is, by the CF conventions."""

from __future__ import annotations

import xarray as xr

VERSION = "CF-1.11"

WAVELENGTH = {
    "units": "nm",
    "standard_name": "radiation_wavelength",
    "long_name": "wavelength in a vacuum",
}
BANDS = {
    "band_name": {
        "standard_name": "sensor_band_identifier",
        "long_name": "name of the band",
    },
    "band_width": {
        "units": "nm",
        "standard_name": "sensor_band_spectral_width",
        "long_name": "full width of the band, of a curve at half of its maximum",
    },
}
PIXELS = {
    "y": {"units": "1", "long_name": "row of pixels, from the top"},
    "x": {"units": "1", "long_name": "column of pixels, from the left"},
}
# What the program counts and UDUNITS has no unit for.
COUNTED = {"pixels", "segments", "per segment²", "EV"}
# Units in the names of measures, those that others end in first.
IN_NAMES = {
    "_mm_per_mm2": "mm-1",
    "_per_mm2": "mm-2",
    "_mm3": "mm3",
    "_mm2": "mm2",
    "_mm": "mm",
    "_deg": "degree",
}
ASCII = str.maketrans({"µ": "u", "⁻": "-", "¹": "1", "²": "2", "³": "3", "°": "degree"})


def about(title: str, software: str, history: str) -> dict[str, str]:
    """What a dataset is. It names no time, so that the same call gives the same bytes."""
    return {
        "Conventions": VERSION,
        "title": title,
        "source": software,
        "history": f"{software}: {history}",
    }


def units(unit: str | None) -> dict[str, str]:
    """The attribute of a unit as the program writes it, in the letters of UDUNITS."""
    if not unit:
        return {}
    return {"units": "1" if unit in COUNTED else unit.translate(ASCII)}


def measured(name: str) -> dict[str, str]:
    """The attributes of a leaf's measure, whose unit is part of its name: `width_mm_mean`."""
    found = (unit for part, unit in IN_NAMES.items() if f"{part}_" in f"{name}_")
    return {"units": next(found, "1"), "long_name": name.replace("_", " ")}


def without_fill_values(data: xr.Dataset) -> xr.Dataset:
    """The dataset, whose coordinates are written without fill values, which CF forbids them."""
    for coordinate in data.coords.values():
        coordinate.encoding["_FillValue"] = None
    return data
