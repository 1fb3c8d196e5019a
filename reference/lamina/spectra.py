"""Reflectance and transmittance of a leaf."""

from __future__ import annotations

import io

import numpy as np
import xarray as xr

from lamina.program import run

# Argument of `optics`, flag of the program, unit.
CONTENTS = {
    "structure": ("--n", "1"),
    "chlorophyll": ("--cab", "ug cm-2"),
    "carotenoids": ("--car", "ug cm-2"),
    "anthocyanins": ("--ant", "ug cm-2"),
    "betacyanins": ("--betacyanins", "ug cm-2"),
    "betaxanthins": ("--betaxanthins", "ug cm-2"),
    "brown": ("--brown", "1"),
    "water": ("--cw", "cm"),
    "dry_matter": ("--cm", "g cm-2"),
}


def optics(preset: str | None = None, **contents: float) -> xr.Dataset:
    """`reflectance` and `transmittance` of a leaf by PROSPECT-D over `wavelength` (400–2500 nm).

    `preset` is one of those that `lamina optics --list` names; contents that are given take the
    place of its own: `structure` (1 and more), `chlorophyll`, `carotenoids`, `anthocyanins`,
    `betacyanins`, `betaxanthins` (µg/cm²), `brown`, `water` (cm), `dry_matter` (g/cm²). Raises
    TypeError for another name, LaminaError for a value out of its range.
    """
    arguments: list[str] = ["optics", "--out", "-"]
    if preset is not None:
        arguments += ["--preset", preset]
    for name, value in contents.items():
        if name not in CONTENTS:
            raise TypeError(f"optics() has no {name!r}; it has {', '.join(CONTENTS)}")
        # One word, so that a negative number is not taken for a flag.
        arguments.append(f"{CONTENTS[name][0]}={float(value)!r}")
    table = np.loadtxt(io.StringIO(run(arguments)), delimiter=",", skiprows=2)
    wavelengths = ("wavelength", table[:, 0], {"units": "nm"})
    quantities = {
        name: ("wavelength", table[:, column], {"units": "1"})
        for name, column in (("reflectance", 1), ("transmittance", 2))
    }
    told: dict[str, float | str] = {} if preset is None else {"preset": preset}
    told |= {name: float(value) for name, value in contents.items()}
    return xr.Dataset(quantities, coords={"wavelength": wavelengths}, attrs=told)
