"""Fluxes of turbid layers of inclined leaves, by ordinates: `reference/run inclined-foliage`.

A layer of leaves without extent, both of whose faces are Lambertian, lies over Lambertian soil in
the sun. Leaves have all azimuths alike, so fluxes need the mean over azimuth of what leaves
scatter alone (Shultis and Myneni 1988):

    2 ∫ g(θ) [ρ (H⁺ᵢ H⁻ⱼ + H⁻ᵢ H⁺ⱼ) + τ (H⁺ᵢ H⁺ⱼ + H⁻ᵢ H⁻ⱼ)] dθ

where H± is the mean over azimuth of the positive or negative part of the cosine between normal
and direction. The transfer equation at Gauss's directions in both hemispheres is solved by its
eigenvectors. Results are `tests/data/inclined_foliage.csv`, to which
`tests/instruments/anchors.rs` holds foliage as a medium; rows of spherical leaves agree with
PythonicDISORT's.
"""

import sys
from pathlib import Path

import numpy as np

OUT = Path(__file__).resolve().parents[2] / "tests/data/inclined_foliage.csv"
ORDINATES = 32
INCLINATIONS = 1000
SUNS_DEG = (20, 60)
LEAVES = {"near infrared": (0.4957, 0.4409, 0.159), "red": (0.0546, 0.0149, 0.127)}


def ellipsoidal(chi):
    """The density of Campbell's distribution, without its factor."""
    return lambda t: np.sin(t) / (np.cos(t) ** 2 + chi**2 * np.sin(t) ** 2) ** 2


DENSITIES = {
    "spherical": np.sin,
    "uniform": np.ones_like,
    "planophile": lambda t: 1 + np.cos(2 * t),
    "erectophile": lambda t: 1 - np.cos(2 * t),
    "plagiophile": lambda t: 1 - np.cos(4 * t),
    "extremophile": lambda t: 1 + np.cos(4 * t),
    "ellipsoidal 3": ellipsoidal(3),
}


def gauss(count, most):
    """Nodes and weights from 0 to `most`."""
    x, w = np.polynomial.legendre.leggauss(count)
    return most * (x + 1) / 2, most * w / 2


def positive(mu, leaf):
    """Mean over azimuth of the positive part of the cosine, by those of way and inclination."""
    level = mu * leaf
    upright = np.sqrt((1 - mu**2) * (1 - leaf**2))
    edge = np.arccos(np.clip(-level / upright, -1, 1))
    return (level * edge + upright * np.sin(edge)) / np.pi


def fluxes(density, lai, rho, tau, soil, sun_deg, ordinates=ORDINATES):
    """Reflected, arriving at the soil, and arriving there uncollided, of unit irradiance."""
    theta, weight = gauss(INCLINATIONS, np.pi / 2)
    area = density(theta) * weight
    area /= area.sum()
    leaf = np.cos(theta)[None, :]

    def sides(mu):
        mu = np.atleast_1d(mu)[:, None]
        return positive(mu, leaf), positive(-mu, leaf)

    def scattered(source, target):
        (a, b), (c, d) = source, target
        return rho * ((a * area) @ d.T + (b * area) @ c.T) + tau * (
            (a * area) @ c.T + (b * area) @ d.T
        )

    mu, own = gauss(ordinates, 1)
    up, down = slice(0, ordinates), slice(ordinates, 2 * ordinates)
    mus, weights = np.concatenate([mu, -mu]), np.concatenate([own, own])
    all_sides = sides(mus)
    turned = (all_sides[0] + all_sides[1]) @ area
    # dI/dz = A I + source, with z the leaf area below.
    gain = 2 * scattered(all_sides, all_sides).T * weights[None, :]
    matrix = (gain - np.diag(turned)) / mus[:, None]
    values, vectors = np.linalg.eig(matrix)

    cos_sun = np.cos(np.radians(sun_deg))
    sun = sides(-cos_sun)
    slope = ((sun[0] + sun[1]) @ area)[0] / cos_sun
    source = scattered(sun, all_sides)[0] / (np.pi * cos_sun * mus)
    forced = np.linalg.solve(slope * np.eye(2 * ordinates) - matrix, source)
    direct = np.exp(-slope * lai)

    # Modes are 1 at the side from which they decay.
    is_top = values.real > 0
    at_bottom = np.exp(np.where(is_top, -values * lai, 0))
    at_top = np.exp(np.where(is_top, 0, values * lai))
    from_soil = 2 * soil * (own * mu)[None, :]
    system = np.concatenate(
        [vectors[down] * at_top, (vectors[up] - from_soil @ vectors[down]) * at_bottom]
    )
    wanted = np.concatenate(
        [-forced[down], soil * direct / np.pi - (forced[up] - from_soil @ forced[down]) * direct]
    )
    modes = np.linalg.solve(system, wanted)
    top = (vectors @ (modes * at_top)).real + forced
    bottom = (vectors @ (modes * at_bottom)).real + forced * direct
    flux = 2 * np.pi * own * mu
    return flux @ top[up], flux @ bottom[down] + direct, direct


def rows():
    """All cases of the table."""
    for name, density in DENSITIES.items():
        for rho, tau, soil in LEAVES.values():
            for lai in (1, 3):
                for sun in SUNS_DEG:
                    yield name, lai, rho, tau, soil, sun, *fluxes(density, lai, rho, tau, soil, sun)


def main():
    """Writes the table."""
    lines = [
        "# Turbid layers of inclined leaves, by reference/validation/inclined_foliage.py.",
        "inclination,lai,rho,tau,soil,sun_deg,reflected,arriving_at_soil,uncollided",
    ]
    for name, *numbers, reflected, arriving, direct in rows():
        values = ",".join(f"{value:g}" for value in numbers)
        lines.append(f"{name},{values},{reflected:.6f},{arriving:.6f},{direct:.6f}")
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(OUT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
