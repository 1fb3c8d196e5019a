"""A half-space of isotropic scatterers below a smooth boundary: reflectance by discrete ordinates.

Written from what `docs/src/theory/solid-tissue.md` says the half-space is, and not from how the
renderer solves it: no H function here. The radiative transfer equation μ dI/dτ = -I + S with the
source S = (a/2) ∫ I dμ is taken at Gauss directions, its solutions that die out downwards are found
as eigenvectors, and the boundary fixes how much there is of each. The half-space is lit evenly from
outside; what leaves it straight up is by reciprocity the reflectance at normal incidence.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]

# Gauss directions on either side of the critical angle.
NODES = 24
# Albedos at which it is solved, evenly spaced in √(1 - a), and entries of the table read from.
SOLVED = 257
COUNT = 16385


def _directions(n: float) -> tuple[Array, Array]:
    """Cosines inside and their weights, split where reflection becomes total."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    # Denser towards grazing directions, where the radiance has a singular slope.
    x, w = 0.5 * (nodes + 1.0), 0.5 * weights
    x, w = x * x, 2.0 * x * w
    critical = np.sqrt(1.0 - 1.0 / (n * n))
    below, above = critical * x, critical + (1.0 - critical) * x
    mu = np.concatenate([below, above]) if critical > 0.0 else above
    weight = np.concatenate([critical * w, (1.0 - critical) * w]) if critical > 0.0 else w
    return mu, weight


def fresnel_inside(mu: Array, n: float) -> Array:
    """Unpolarised reflectance at the boundary seen from inside; 1 past the critical angle."""
    sin_out = n * np.sqrt(1.0 - mu * mu)
    total = sin_out >= 1.0
    out = np.sqrt(np.maximum(1.0 - sin_out * sin_out, 0.0))
    senkrecht = (n * mu - out) / (n * mu + out)
    parallel = (mu - n * out) / (mu + n * out)
    return np.where(total, 1.0, 0.5 * (senkrecht**2 + parallel**2))


def reflectance(a: float, n: float) -> float:
    """Directional-hemispherical reflectance at normal incidence, specular part included."""
    straight = ((n - 1.0) / (n + 1.0)) ** 2
    if a <= 0.0:
        return straight
    if a >= 1.0:
        return 1.0
    mu, w = _directions(n)
    count = len(mu)
    # With p, m the radiances down and up, s = p + m and d = p - m:
    # μ s' = -d and μ d' = -s + a Σ w s (both halves share the source), so that
    # μ² s'' = s - a Σ w s: eigenvectors of M⁻² (1 - a 1 wᵀ) with eigenvalues k².
    matrix = (np.eye(count) - a * np.outer(np.ones(count), w)) / (mu * mu)[:, None]
    squared, s = np.linalg.eig(matrix)
    squared, s = squared.real, s.real
    k = np.sqrt(np.maximum(squared, 1e-30))
    # s ~ exp(-kτ): d = -μ s' = μ k s.
    d = mu[:, None] * k[None, :] * s
    down, up = 0.5 * (s + d), 0.5 * (s - d)
    # At the top: down = r up + (1 - r) n² for radiance 1 outside.
    r = fresnel_inside(mu, n)
    share = np.linalg.solve(down - r[:, None] * up, (1.0 - r) * n * n)
    # Straight up leaves ∫ S e^-τ dτ, with S = (a/2) Σ w s e^-kτ.
    leaving = np.sum(share * 0.5 * a * (w @ s) / (1.0 + k))
    return float(straight + (1.0 - straight) * leaving / (n * n))


@lru_cache(maxsize=16)
def table(n: float) -> Array:
    """Reflectance at `COUNT` values of √(1 - a) from 0 to 1, in which it is smooth."""
    s = np.linspace(0.0, 1.0, SOLVED)
    values = np.array([reflectance(1.0 - x * x, n) for x in s])
    fine: Array = CubicSpline(s, values)(np.linspace(0.0, 1.0, COUNT))
    return fine
