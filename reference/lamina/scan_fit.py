"""What a leaf holds, from the colours of its reflectance and its transmittance.

- In: linear sRGB of R and of T, of a leaf under D65.
- Out: contents, and how much less the colours leave open than was open without them.
- Left out: water and dry matter, which absorb no visible light; a colour says nothing of them.

The most probable contents are found by Gauss and Newton's steps with Marquardt's damping. The
program computes every spectrum.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lamina.spectra import optics

Array = NDArray[np.float64]

# What is fitted: mean and standard deviation before anything is seen, and limits. Contents of
# pigments are fitted, and their priors are normal, on the scale of square roots. Our estimates.
PRIORS = {
    "structure": (1.6, 0.3, 1.0, 4.0),
    "chlorophyll": (5.5, 2.5, 0.0, 11.0),
    "carotenoids": (2.8, 0.8, 0.0, 5.5),
    "anthocyanins": (0.5, 1.5, 0.0, 8.0),
    "brown": (0.1, 0.5, 0.0, 2.4),
}
# What colours say nothing of.
WATER_CM = 0.01
DRY_MATTER_G_PER_CM2 = 0.007
# Standard deviation of a colour: a part that is always there, and one in proportion.
NOISE = (0.003, 0.03)
# Leaves whose spectra are computed at a time, and the most steps of a fit.
AT_A_TIME = 4000
STEPS = 12
STARTS = {
    "structure": (1.2, 1.6, 2.2),
    "chlorophyll": (0.3, 2.0, 4.0, 5.5, 7.5),
    "carotenoids": (1.5, 3.0, 4.0),
    "anthocyanins": (0.3, 2.0, 4.5),
    "brown": (0.05, 0.5, 1.2),
}

MEAN, DEVIATION, LOW, HIGH = (np.array(column) for column in zip(*PRIORS.values(), strict=True))


@dataclass(frozen=True)
class Fitted:
    """Contents of each leaf, by their names; and of each, its deviation over that of the prior."""

    contents: dict[str, Array]
    openness: dict[str, Array]
    misfit: Array
    """Root of the mean square of the six colours' departures, `[leaves]`."""


def weights() -> tuple[Array, Array]:
    """Wavelengths, nm, and what linear sRGB takes of a spectrum there, `[wavelengths, 3]`."""
    table = np.loadtxt(Path(__file__).with_name("scan_colours.csv"), delimiter=",", skiprows=3)
    return table[:, 0], table[:, 1:]


def contents_of(place: Array) -> dict[str, Array]:
    """Contents, as `optics` takes them, of places on the scale of the fit, `[leaves, 5]`."""
    found = {name: place[:, number] ** 2 for number, name in enumerate(PRIORS)}
    found["structure"] = place[:, 0]
    found["water"] = np.full(len(place), WATER_CM)
    found["dry_matter"] = np.full(len(place), DRY_MATTER_G_PER_CM2)
    return found


def colours_of(place: Array) -> Array:
    """Linear sRGB of R and T, `[leaves, 6]`; what is below 0 no picture can hold."""
    wavelengths, take = weights()
    parts = []
    for start in range(0, len(place), AT_A_TIME):
        few = contents_of(place[start : start + AT_A_TIME])
        spectra = optics(None, wavelengths=wavelengths.tolist(), **few)  # type: ignore[arg-type]
        parts.append(
            np.hstack([spectra[name].values @ take for name in ("reflectance", "transmittance")])
        )
    colours: Array = np.maximum(np.vstack(parts), 0.0)
    return colours


def cost(departure: Array, place: Array, noise: Array) -> Array:
    """Twice the negative logarithm of the posterior, but for a constant, `[leaves]`."""
    prior: Array = (((place - MEAN) / DEVIATION) ** 2).sum(1)
    whole: Array = prior + ((departure / noise) ** 2).sum(1)
    return whole


def fit(colours: Array) -> Fitted:
    """The most probable contents of leaves with these colours, `[leaves, 6]`."""
    noise = NOISE[0] + NOISE[1] * colours
    starts = np.array(list(product(*STARTS.values())))
    of_starts = colours_of(starts)
    place = np.empty((len(colours), len(PRIORS)))
    for number, (seen, deviation) in enumerate(zip(colours, noise, strict=True)):
        place[number] = starts[cost(of_starts - seen, starts, deviation).argmin()]
    departure = colours_of(place) - colours
    best = cost(departure, place, noise)
    damping = np.full(len(place), 1e-2)
    for _ in range(STEPS):
        slope = slopes(place, departure + colours)
        scaled = slope / noise[:, :, None]
        hessian = np.einsum("lci,lcj->lij", scaled, scaled) + np.diag(DEVIATION**-2)
        gradient = np.einsum("lci,lc->li", scaled, departure / noise)
        gradient += (place - MEAN) / DEVIATION**2
        damped = hessian * (1 + damping[:, None, None] * np.eye(len(PRIORS)))
        step = np.linalg.solve(damped, gradient[:, :, None])[:, :, 0]
        tried = np.clip(place - step, LOW, HIGH)
        tried_departure = colours_of(tried) - colours
        tried_cost = cost(tried_departure, tried, noise)
        better = tried_cost < best
        gained = np.where(better, best - tried_cost, 0.0)
        place[better], departure[better] = tried[better], tried_departure[better]
        best = np.where(better, tried_cost, best)
        damping = np.where(better, damping / 4, damping * 6)
        if gained.max() < 1e-3:
            break
    open_still = np.sqrt(np.diagonal(np.linalg.inv(hessian), axis1=1, axis2=2)) / DEVIATION
    return Fitted(
        contents_of(place),
        {name: open_still[:, number] for number, name in enumerate(PRIORS)},
        np.sqrt((departure**2).mean(1)),
    )


def slopes(place: Array, colours: Array) -> Array:
    """Derivatives of the colours by what is fitted, `[leaves, 6, 5]`, inwards from the limits."""
    found = np.empty((len(place), 6, len(PRIORS)))
    for number in range(len(PRIORS)):
        step = np.where(place[:, number] + 0.02 > HIGH[number], -0.02, 0.02)
        moved = place.copy()
        moved[:, number] += step
        found[:, :, number] = (colours_of(moved) - colours) / step[:, None]
    return found
