"""The leaf's spectra: smooth curves whose colours are the RGB values that the other programs use.

`leaf.csv` was written by this module (`python -m lamina_bench.spectra`) and is committed. Of all
curves that are linear between knots 10 nm apart it takes the smoothest pair (least sum of squared
second differences) under these conditions, all with light of D65 and the CIE 1931 observer, in
linear sRGB: R and T have the colours `REFLECTANCE` and `TRANSMITTANCE`, and R², R T and T² have
the squares and products of those colours. The second condition makes light that was scattered
twice look alike in spectral programs and in those that multiply RGB values; from the third
scattering on they differ, where little light is left.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FILE = Path(__file__).resolve().parent / "leaf.csv"
REFLECTANCE = (0.08, 0.16, 0.05)
TRANSMITTANCE = (0.05, 0.14, 0.02)
KNOTS_NM = np.arange(360.0, 831.0, 10.0)
# Bounds of the curves, R and T: they stay positive, and R + T stays below 1. At the violet end,
# which not every program renders, they stay low.
LEAST = (0.01, 0.005)
MOST = (0.55, 0.4)
VIOLET_NM = 435.0
MOST_VIOLET = (0.12, 0.10)
# CIE Y of D65 that has the value 1 at 560 nm, over that of equal energy of value 1: what RGB 1 of
# a program without wavelengths has to be multiplied by.
D65_LUMINANCE = 0.9889


def read(file: Path = FILE) -> tuple[Array, Array, Array]:
    """Wavelengths (nm), reflectance and transmittance as they are committed."""
    table = np.loadtxt(file, delimiter=",", skiprows=1)
    return table[:, 0], table[:, 1], table[:, 2]


def colour_weights() -> tuple[Array, Array]:
    """Wavelengths by 1 nm, and `[wavelengths, 3]` that turn a reflectance into linear sRGB."""
    import warnings

    with warnings.catch_warnings():
        # It says at import that there is no matplotlib, which nothing here needs.
        warnings.simplefilter("ignore")
        import colour as science

    shape = science.SpectralShape(360, 830, 1)
    observer = science.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values
    d65 = science.SDS_ILLUMINANTS["D65"].copy().align(shape).values
    to_rgb = np.asarray(science.RGB_COLOURSPACES["sRGB"].matrix_XYZ_to_RGB)
    weights = (observer * d65[:, None]) @ to_rgb.T
    return np.arange(360.0, 831.0), weights / weights.sum(axis=0)


def fit() -> tuple[Array, Array]:
    """Reflectance and transmittance at the knots."""
    from scipy.optimize import minimize

    nm, weights = colour_weights()
    count = KNOTS_NM.size
    hats = np.stack([np.interp(nm, KNOTS_NM, row) for row in np.eye(count)], axis=1)
    bend = np.diff(np.eye(count), 2, axis=0)
    r_colour, t_colour = np.array(REFLECTANCE), np.array(TRANSMITTANCE)

    def misses(x: Array) -> Array:
        r, t = hats @ x[:count], hats @ x[count:]
        wanted = (r_colour, t_colour, r_colour**2, r_colour * t_colour, t_colour**2)
        return 20.0 * np.concatenate(
            [weights.T @ curve - want
             for curve, want in zip((r, t, r * r, r * t, t * t), wanted, strict=True)]
        )  # fmt: skip

    def slopes(x: Array) -> Array:
        r, t = hats @ x[:count], hats @ x[count:]
        none = np.zeros((3, count))

        def by(curve: Array) -> Array:
            return (weights * curve[:, None]).T @ hats

        plain = weights.T @ hats
        rows = [[plain, none], [none, plain], [2 * by(r), none], [by(t), by(r)], [none, 2 * by(t)]]
        return 20.0 * np.block(rows)

    def roughness(x: Array) -> float:
        return 100.0 * float(((bend @ x.reshape(2, count).T) ** 2).sum())

    def roughness_slope(x: Array) -> Array:
        return 200.0 * (x.reshape(2, count) @ bend.T @ bend).ravel()

    x = np.repeat([0.1, 0.08], count)
    bounds = [
        (LEAST[kind], MOST_VIOLET[kind] if nm < VIOLET_NM else MOST[kind])
        for kind in (0, 1)
        for nm in KNOTS_NM
    ]
    for conditions in (6, 15):
        found = minimize(
            roughness,
            x,
            jac=roughness_slope,
            bounds=bounds,
            method="SLSQP",
            constraints={
                "type": "eq",
                "fun": lambda x, n=conditions: misses(x)[:n],
                "jac": lambda x, n=conditions: slopes(x)[:n],
            },
            options={"maxiter": 3000, "ftol": 1e-9},
        )
        x = found.x
    return x[:count], x[count:]


def main() -> None:
    """Writes `leaf.csv`."""
    r, t = fit()
    lines = ["wavelength_nm,reflectance,transmittance"]
    lines += [f"{nm:.0f},{a:.5f},{b:.5f}" for nm, a, b in zip(KNOTS_NM, r, t, strict=True)]
    FILE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
