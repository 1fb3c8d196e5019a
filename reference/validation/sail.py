"""4SAIL beside an exact solution of the same layer of leaves: `reference/run sail`.

A layer of infinitesimal leaves of all directions alike, both faces Lambertian, over Lambertian
soil. What such leaves scatter depends on the angle of scattering alone, so that PythonicDISORT
solves the layer exactly; the Rust tests hold Lamina's canopies to the same numbers
(`tests/data/transport_anchors.csv`). 4SAIL is that of the package prosail, which is not in the
environment: `pip install prosail==2.0.5` brings it. Its own tables of inclinations are not quite
spherical (with them the light that passes a layer without being scattered is up to 4 % off), so
that it gets exact shares of the sphere here.

Written are bidirectional reflectance factors, and how far 4SAIL is off: of the whole, and over
black soil of what is scattered once and of the rest.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PythonicDISORT.pydisort import pydisort
from scipy.interpolate import CubicSpline
from scipy.special import eval_legendre

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "reference" / "results" / "sail.md"
STREAMS = 48
# PythonicDISORT excludes layers that absorb nothing.
MOST_ALBEDO = 0.99999
# Zenith of the view and azimuth from the sun's, degrees; 180 is where light goes on.
VIEWS = ((0.0, 0.0), (45.0, 180.0), (60.0, 90.0), (45.0, 0.0))
# R and T of the leaf, R of the soil.
CASES = {
    "near infrared": (0.4957, 0.4409, 0.159),
    "near infrared, black soil": (0.4957, 0.4409, 0.0),
    "red": (0.0546, 0.0149, 0.127),
}
SUNS_DEG = (20.0, 50.0)
LAIS = (1.0, 3.0, 6.0)

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Layer:
    """A layer of leaves over soil, and the sun's zenith angle."""

    lai: float
    r: float
    t: float
    soil: float
    sun_deg: float


def scattered(cosine: Array | float, r: float, t: float) -> Array:
    """The area scattering phase function of spherically inclined leaves, by the angle's cosine."""
    angle = np.arccos(cosine)
    return np.asarray(
        (r + t) / (3 * np.pi) * (np.sin(angle) - angle * cosine) + t / 3 * np.asarray(cosine)
    )


def exact(layer: Layer) -> list[float]:
    """Bidirectional reflectance factors by discrete ordinates."""
    points, weights = np.polynomial.legendre.leggauss(400)
    albedo = min(layer.r + layer.t, MOST_ALBEDO)
    phase = 8 * scattered(points, layer.r, layer.t) / (layer.r + layer.t)
    moments = [0.5 * np.sum(weights * phase * eval_legendre(n, points)) for n in range(2 * STREAMS)]
    # It is 1 but for the quadrature's error.
    moments[0] = 1.0
    sun = math.cos(math.radians(layer.sun_deg))
    solved = pydisort(
        np.array([0.5 * layer.lai]), np.array([albedo]), STREAMS, np.array([moments]), sun, 1 / sun,
        0.0, NLeg=STREAMS, NFourier=STREAMS, BDRF_Fourier_modes=[layer.soil] if layer.soil else [],
    )  # fmt: skip
    cosines, radiance = np.asarray(solved[0]), solved[4]
    up = np.flatnonzero(cosines > 0)
    up = up[np.argsort(cosines[up])]
    factors = []
    for zenith, azimuth in VIEWS:
        # Azimuths there are those of the directions of travel.
        at = np.asarray(radiance(0.0, math.radians(180 - azimuth))).reshape(len(cosines), -1)[up, 0]
        factors.append(
            math.pi * float(CubicSpline(cosines[up], at)(math.cos(math.radians(zenith))))
        )
    return factors


def once(layer: Layer) -> list[float]:
    """What leaves over black soil scatter once, in closed form."""
    factors = []
    sun = math.radians(layer.sun_deg)
    for zenith, azimuth in VIEWS:
        view = math.radians(zenith)
        turned = math.cos(math.radians(azimuth)) * math.sin(sun) * math.sin(view)
        # Of scattering; straight back is -1.
        cosine = -math.cos(sun) * math.cos(view) - turned
        k = 0.5 / math.cos(sun) + 0.5 / math.cos(view)
        gained = scattered(cosine, layer.r, layer.t) / (math.cos(sun) * math.cos(view))
        factors.append(float(gained) * -math.expm1(-k * layer.lai) / k)
    return factors


def four_sail(layer: Layer) -> list[tuple[float, float]]:
    """Bidirectional reflectance factors by 4SAIL without a hot spot, and what it scatters once."""
    import prosail.FourSAIL as sail  # type: ignore[import-not-found]

    edges = np.linspace(0, math.pi / 2, 19)
    sail.campbell = lambda *_, **__: -np.diff(np.cos(edges))
    factors = []
    for zenith, azimuth in VIEWS:
        faces = (np.array([number]) for number in (layer.r, layer.t))
        out = sail.foursail(
            *faces, 57.3, 0.0, 2, layer.lai, 0.0, layer.sun_deg, zenith, azimuth,
            np.array([layer.soil]),
        )  # fmt: skip
        factors.append((float(out[17][0]), float(out[10][0])))
    return factors


def percent(found: float, expected: float) -> str:
    """How far a number is off."""
    return f"{100 * (found / expected - 1):+.1f}"


def main() -> None:
    """Writes the tables."""
    parser = argparse.ArgumentParser(prog="reference/run sail", description=__doc__)
    parser.add_argument("--out", type=Path, default=RESULTS)
    given = parser.parse_args()
    heads = [f"{zenith:.0f}°, {azimuth:.0f}°" for zenith, azimuth in VIEWS]
    text = [
        "<!-- Written by reference/run sail. -->\n",
        "Bidirectional reflectance factor by zenith of the view and azimuth from the sun, exact,\n"
        "and how far 4SAIL is off, percent. Over black soil, the second number is that of light\n"
        "scattered once and the third that of the rest.\n",
    ]
    for name, (r, t, soil) in CASES.items():
        text.append(f"## {name}: R {r}, T {t}, soil {soil}\n")
        text.append(f"| LAI | sun | {' | '.join(heads)} |\n|{' --- |' * (len(heads) + 2)}")
        for lai in LAIS:
            for sun_deg in SUNS_DEG:
                layer = Layer(lai, r, t, soil, sun_deg)
                cells = []
                for whole, single, (found, own) in zip(
                    exact(layer), once(layer), four_sail(layer), strict=True
                ):
                    off = [percent(found, whole)]
                    if soil == 0:
                        off += [percent(own, single), percent(found - own, whole - single)]
                    cells.append(f"{whole:.4f}, {', '.join(off)}")
                text.append(f"| {lai:.0f} | {sun_deg:.0f}° | {' | '.join(cells)} |")
        text.append("")
    given.out.write_text("\n".join(text), encoding="utf-8")
    print(given.out)


if __name__ == "__main__":
    main()
