#!/usr/bin/env python3
"""Writes the colour tables that the renderer compiles in (`renderer/trace/src/spectrum/*.csv`).

- `cie_1931_2deg.csv`: the CIE 1931 2° colour-matching functions, 360-830 nm by 1 nm.
- `cie_d65.csv`: CIE standard illuminant D65, 300-830 nm by 5 nm, 100 at 560 nm.
- `rgb_basis.csv`: three reflectances, one for each linear sRGB primary, 360-830 nm by 5 nm.

The first two are the published figures as colour-science carries them. The third is computed
here by a quadratic programme in the manner of Mallett and Yuksel, "Spectral Primary
Decomposition for Rendering with sRGB Reflectance" (EGSR 2019).

Run it as `reference/run tables`; the tables are committed, so that only
a change of their definition needs it.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

Array = NDArray[np.float64]

FOLDER = Path(__file__).resolve().parent.parent / "renderer" / "trace" / "src" / "spectrum"
BASIS_NM = np.arange(360.0, 830.1, 5.0)
OBSERVER_NM = np.arange(360.0, 830.1, 1.0)
REC709_XY = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
# Digits kept in rgb_basis.csv: rounding moves a colour by less than 1e-6.
BASIS_DIGITS = 7


def observer() -> Array:
    """Colour-matching functions on `OBSERVER_NM`, shape `[471, 3]`."""
    table = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    assert np.array_equal(table.wavelengths, OBSERVER_NM)
    return np.asarray(table.values, dtype=np.float64)


def d65() -> tuple[Array, Array]:
    """Wavelengths (300-830 nm by 5 nm) and relative power of D65, 100 at 560 nm.

    colour-science carries the standard's figures up to 780 nm. The standard defines D65 as
    S0 + M1 S1 + M2 S2 of the daylight components (CIE 015:2018, 4.1.2), which it lists up to
    830 nm: M1 and M2 are recovered from the known figures and continue the table. (The
    two-digit chromaticity of D65 gives M1 and M2 that miss the figures by up to 0.05.)
    """
    published = colour.SDS_ILLUMINANTS["D65"]
    basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    nm = np.arange(300.0, 830.1, 5.0)
    s0, s1, s2 = (np.asarray(basis[name].values, dtype=np.float64) for name in ("S0", "S1", "S2"))
    assert all(np.array_equal(basis[name].wavelengths, nm) for name in ("S0", "S1", "S2"))
    known = np.asarray(published.values, dtype=np.float64)
    count = known.size
    parts = np.column_stack([s1, s2])
    factors, *_ = np.linalg.lstsq(parts[:count], known - s0[:count], rcond=None)
    power = s0 + parts @ factors
    assert np.max(np.abs(power[:count] - known)) < 2e-3
    return nm, np.concatenate([known, power[count:]])


def rgb_from_xyz(white: Array) -> Array:
    """The matrix from XYZ (white at Y = 1) to linear RGB with the Rec. 709 primaries."""
    xyz = np.column_stack([REC709_XY, 1.0 - REC709_XY.sum(axis=1)]).T
    return np.linalg.inv(xyz * np.linalg.solve(xyz, white))


def colour_matrix() -> tuple[Array, Array]:
    """What turns a reflectance at `BASIS_NM`, linear between, into linear RGB under D65.

    Gives the matrix `[3, 95]` and the one from XYZ to RGB that it holds. The integral is the
    sum over whole nanometres from 360 to 830.
    """
    nm, power = d65()
    weights = observer() * np.interp(OBSERVER_NM, nm, power)[:, None]
    weights /= weights[:, 1].sum()
    white = weights.sum(axis=0)
    hats = np.stack([np.interp(OBSERVER_NM, BASIS_NM, row) for row in np.eye(BASIS_NM.size)])
    to_rgb = rgb_from_xyz(white)
    return to_rgb @ weights.T @ hats.T, to_rgb


def rgb_basis() -> Array:
    """Three reflectances `[3, 95]` in [0, 1] that add up to 1 and have the primaries' colours.

    Least sum of squared first differences, as Mallett and Yuksel have it. Blue is one minus
    the others, so that the sum is exact.
    """
    to_rgb, _ = colour_matrix()
    count = BASIS_NM.size
    step = np.diff(np.eye(count), axis=0)
    form = step.T @ step
    # Variables: red and green. Blue = 1 - red - green; a constant has no differences.
    hessian = 2.0 * np.block([[2.0 * form, form], [form, 2.0 * form]])
    zero = np.zeros_like(to_rgb)
    equal = np.block([[to_rgb, zero], [zero, to_rgb]])
    goal = np.array([1.0, 0.0, 0.0, 0.0, 1.0, 0.0])
    both = np.hstack([np.eye(count), np.eye(count)])
    result = minimize(
        lambda x: 0.5 * x @ hessian @ x,
        np.full(2 * count, 1.0 / 3.0),
        jac=lambda x: hessian @ x,
        method="SLSQP",
        bounds=[(0.0, 1.0)] * (2 * count),
        constraints=[
            {"type": "eq", "fun": lambda x: equal @ x - goal, "jac": lambda _: equal},
            {"type": "ineq", "fun": lambda x: 1.0 - both @ x, "jac": lambda _: -both},
        ],
        options={"maxiter": 1000, "ftol": 1e-13},
    )
    assert result.success, result.message
    red, green = np.round(np.clip(result.x.reshape(2, count), 0.0, 1.0), BASIS_DIGITS)
    basis = np.stack([red, green, np.round(1.0 - red - green, BASIS_DIGITS)])
    assert basis.min() >= 0.0
    assert np.max(np.abs(to_rgb @ basis.T - np.eye(3))) < 1e-5
    return basis


def write(name: str, notes: list[str], header: str, rows: list[str]) -> None:
    """Writes one table: notes as `#` lines, then the header, then the rows."""
    lines = [f"# {note}" for note in notes] + [header] + rows
    (FOLDER / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> None:
    """Writes the three tables."""
    made = "Written by reference/run tables from colour-science (BSD-3-Clause)."
    write(
        "cie_1931_2deg.csv",
        [
            "CIE 1931 2-degree colour-matching functions (CIE 015:2018, ISO/CIE 11664-1).",
            made,
        ],
        "wavelength_nm,x,y,z",
        [
            f"{nm:.0f},{x:.10g},{y:.10g},{z:.10g}"
            for nm, (x, y, z) in zip(OBSERVER_NM, observer(), strict=True)
        ],
    )
    nm, power = d65()
    write(
        "cie_d65.csv",
        [
            "CIE standard illuminant D65, relative, 100 at 560 nm (ISO/CIE 11664-2, CIE 015:2018).",
            made,
        ],
        "wavelength_nm,d65",
        [f"{a:.0f},{b:.6g}" for a, b in zip(nm, power, strict=True)],
    )
    _, to_rgb = colour_matrix()
    write(
        "rgb_basis.csv",
        [
            "Reflectances of the linear sRGB primaries: r red + g green + b blue under D65 has the",
            "colour (r, g, b). Linear between rows, constant outside; the rows add up to 1.",
            "After Mallett and Yuksel, Spectral Primary Decomposition for Rendering with sRGB",
            "Reflectance (EGSR 2019), computed for the tables beside this one.",
            "Rec. 709 primaries with the white that D65 has in these tables; XYZ to RGB:",
            *(" ".join(f"{value:.9f}" for value in row) for row in to_rgb),
            "Written by reference/run tables.",
        ],
        "wavelength_nm,red,green,blue",
        [
            f"{nm:.0f},{r:.7f},{g:.7f},{b:.7f}"
            for nm, (r, g, b) in zip(BASIS_NM, rgb_basis().T, strict=True)
        ],
    )


if __name__ == "__main__":
    main()
