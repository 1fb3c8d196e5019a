"""What pigments absorb, from the figures that `docs/src/theory/pigments.md` rests on.

A second transcription of the same figures: sums of Gaussians in wavenumber fitted to chlorophylls
in diethyl ether and carotenoids in methanol, peaks and molar absorptivities of anthocyanins and
betalains. The tables that the program exports are held to it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# eps L/(mol cm), M g/mol, range of the fit nm, (height, centre 1/cm, deviation 1/cm).
CHLOROPHYLL = {
    "a": (111160.0, 893.5, (380.0, 720.0), (
        (0.3017, 26375, 488), (0.6409, 24527, 895), (0.6552, 23376, 335), (0.1440, 23157, 172),
        (0.0298, 18030, 1988), (0.0369, 17433, 251), (0.1005, 16285, 355), (0.2558, 15257, 236),
        (0.5252, 15133, 140))),
    "b": (159100.0, 907.5, (380.0, 700.0), (
        (0.1067, 26802, 2500), (0.3127, 23284, 587), (0.6165, 22111, 355), (0.3660, 21861, 449),
        (0.0451, 17785, 1605), (0.0314, 16755, 355), (0.0754, 15661, 281), (0.2708, 15558, 142))),
}  # fmt: skip
CAROTENOIDS = {
    "lutein": (144800.0, 568.9, (370.0, 560.0), (
        (0.1990, 24046, 460), (0.4420, 24009, 1880), (0.6622, 22584, 582), (0.7143, 21188, 460))),
    "beta_carotene": (139500.0, 536.9, (370.0, 560.0), (
        (0.4140, 23818, 1861), (0.2147, 23691, 567), (0.6898, 22215, 643), (0.6786, 20824, 526))),
    "zeaxanthin": (144300.0, 568.9, (370.0, 560.0), (
        (0.4509, 23706, 1916), (0.2002, 23678, 473), (0.6439, 22259, 614), (0.6603, 20864, 512))),
    "violaxanthin": (153000.0, 600.9, (370.0, 560.0), (
        (0.2272, 24313, 362), (0.4309, 24271, 1825), (0.6842, 22835, 533), (0.7984, 21443, 369))),
    "lycopene": (185000.0, 536.9, (370.0, 560.0), (
        (0.4151, 22856, 1953), (0.2735, 22611, 463), (0.6797, 21329, 439), (0.7164, 20007, 435))),
}  # fmt: skip
# Peak nm, eps L/(mol cm) and M g/mol of the 3-glucoside.
ANTHOCYANINS = {
    "pelargonidin": (520.0, 25800.0, 433.4),
    "cyanidin": (535.0, 26900.0, 449.4),
    "peonidin": (532.0, 12700.0, 463.4),
    "delphinidin": (544.0, 29000.0, 465.4),
    "petunidin": (543.0, 15900.0, 479.4),
    "malvidin": (542.0, 28000.0, 493.4),
}
BLUE_PEAK_NM = 585.0
# Peak nm, eps L/(mol cm), M g/mol, deviations in nm on the blue and the red side.
BETALAINS = {
    "betanin": (538.0, 62500.0, 550.5, 41.0, 28.0),
    "amaranthine": (536.0, 56600.0, 726.6, 41.0, 28.0),
    "indicaxanthin": (480.0, 48000.0, 308.3, 32.0, 32.0),
    "vulgaxanthin": (477.0, 48000.0, 339.3, 32.0, 32.0),
}


def in_solution(epsilon: float, molar_mass: float) -> float:
    """cm²/µg, Napierian."""
    return epsilon * 1e3 * np.log(10.0) / molar_mass * 1e-6


def bands(substance: tuple, nm: Array, shift: float, packaging: float) -> Array:
    """cm²/µg in the leaf; not a number where the fit does not reach."""
    epsilon, molar_mass, (first, last), gaussians = substance
    nu = 1e7 / nm - shift
    shape = sum(a * np.exp(-0.5 * ((nu - c) / s) ** 2) for a, c, s in gaussians)
    known = (1e7 / nu >= first) & (1e7 / nu <= last)
    return np.where(known, packaging * in_solution(epsilon, molar_mass) * shape, np.nan)


def anthocyanins(
    column: Array, nm: Array, shares: dict[str, float], shift: float, blue: float
) -> Array:
    """cm²/µg in the leaf from PROSPECT-D's column at `nm`; not a number where it does not reach."""

    def moved(peak: float) -> Array:
        source = 1e7 / (1e7 / nm + 1e7 / 535.0 - 1e7 / peak)
        return np.interp(source, nm, column, left=np.nan, right=np.nan)

    _, epsilon, molar_mass = ANTHOCYANINS["cyanidin"]
    total = np.zeros_like(nm)
    for name, share in shares.items():
        peak, own, mass = ANTHOCYANINS[name]
        height = own / mass / (epsilon / molar_mass)
        form = (1.0 - blue) * moved(peak + shift) + blue * moved(BLUE_PEAK_NM)
        total = total + share * height * form
    return total


def betalain(name: str, nm: Array, packaging: float) -> Array:
    """cm²/µg in the leaf."""
    peak, epsilon, molar_mass, below, above = BETALAINS[name]
    z = (nm - peak) / np.where(nm < peak, below, above)
    return packaging * in_solution(epsilon, molar_mass) * np.exp(-0.5 * z * z)
