"""The directional albedo of a leaf's coat, tabulated by quadrature.

The coat is the one lobe of `docs/src/theory/leaf-bsdf.md`: GGX (Trowbridge-Reitz) normals with a
roughness across and along the vein, height-correlated Smith masking, Fresnel. Its albedo
E(ω) = ∫ f μ' dω' is integrated over the half vectors that ω sees: with h distributed as the
visible normals (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7:4, 2018), drawn
through the spherical cap of Dupuy and Benyoub (2023), the integrand is F G₂/G₁ and smooth, so
that a product rule over the unit square converges fast.

Double precision and numpy; nothing here depends on Mitsuba's variant.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]

# E is tabulated over √μ (it is steep at grazing incidence) and the azimuth in one quadrant.
COUNT_MU = 513
COUNT_AZIMUTH = 65
# The table is a cubic spline through this many computed values.
SPLINE_MU = 65
SPLINE_AZIMUTH = 25
# Nodes of the quadrature over the visible normals. Where the mirrored direction meets the
# horizon the integrand has a kink, which decides the error: some 1e-5 at these counts.
NODES_CAP = 96
NODES_TURN = 128
# √μ of the outermost column, in place of 0.
GRAZING = 1e-4
# Index of the tissue into which light is refracted.
INDEX_WITHIN = 1.45


@dataclass(frozen=True)
class Coat:
    """One face's coat: refractive index and GGX roughness across (x) and along (y) the vein.

    An infinite index reflects all light.
    """

    eta: float
    alpha_x: float
    alpha_y: float

    def __post_init__(self) -> None:
        in_range = 1.0 <= self.eta <= 2.5 or np.isinf(self.eta)
        if not (in_range and all(0.0 < a <= 1.0 for a in self.alphas)):
            raise ValueError(f"{self} is out of range")

    @property
    def alphas(self) -> tuple[float, float]:
        """Both roughnesses."""
        return self.alpha_x, self.alpha_y

    @property
    def table(self) -> Array:
        """E at √μ (rows, 0 to 1) and azimuth (columns, 0 to π/2 from the x axis)."""
        return _table(self)

    @property
    def normal(self) -> float:
        """E at normal incidence."""
        return _normal(self)

    @property
    def passing(self) -> Passing:
        """What passes of diffuse light."""
        return _passing(self)


@dataclass(frozen=True)
class Passing:
    """Diffuse light that passes a coat: P, and the means of x and of its square."""

    share: Any
    x: Any
    xx: Any

    def m(self, q: Any) -> Any:
        """m of a steepness."""
        return 1.0 - 2.0 * q * self.x + q * q * self.xx


def fresnel(cos_i: Array, eta: float) -> Array:
    """Unpolarised reflectance of a dielectric of index `eta` seen from air."""
    if np.isinf(eta):
        return np.ones_like(cos_i)
    cos_t = np.sqrt(1.0 - (1.0 - cos_i * cos_i) / (eta * eta))
    senkrecht = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    return 0.5 * (senkrecht**2 + parallel**2)


def smith_lambda(coat: Coat, x: Array, y: Array, z: Array) -> Array:
    """Smith's Λ for directions with z > 0."""
    slope2 = ((coat.alpha_x * x) ** 2 + (coat.alpha_y * y) ** 2) / (z * z)
    return 0.5 * (np.sqrt(1.0 + slope2) - 1.0)


@lru_cache(maxsize=4)
def legendre_nodes(count: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss-Legendre quadrature, which take as long as a coat's albedo."""
    return np.polynomial.legendre.leggauss(count)


def albedo(coat: Coat, x: Array, y: Array, z: Array) -> Array:
    """E for unit directions with z > 0 (arrays of one length)."""
    # A boundary between equal media reflects nothing.
    if coat.eta == 1.0:
        return np.zeros_like(z)
    nodes, weights = legendre_nodes(NODES_CAP)
    turns = 2.0 * np.pi * np.arange(NODES_TURN) / NODES_TURN
    u, phi = (part.ravel() for part in np.meshgrid(0.5 * (nodes + 1.0), turns, indexing="ij"))
    weight = np.repeat(0.5 * weights / NODES_TURN, NODES_TURN)
    x, y, z = x[:, None], y[:, None], z[:, None]

    # The view in the space where the roughness is 1, and the cap of normals that it sees.
    vx, vy, vz = coat.alpha_x * x, coat.alpha_y * y, z
    length = np.sqrt(vx * vx + vy * vy + vz * vz)
    vx, vy, vz = vx / length, vy / length, vz / length
    cap_z = (1.0 - u) * (1.0 + vz) - vz
    ring = np.sqrt(np.maximum(1.0 - cap_z * cap_z, 0.0))
    hx = coat.alpha_x * (ring * np.cos(phi) + vx)
    hy = coat.alpha_y * (ring * np.sin(phi) + vy)
    hz = np.maximum(cap_z + vz, 0.0)
    length = np.sqrt(hx * hx + hy * hy + hz * hz)
    hx, hy, hz = hx / length, hy / length, hz / length

    cosine = np.clip(x * hx + y * hy + z * hz, 0.0, 1.0)
    ox, oy, oz = 2.0 * cosine * hx - x, 2.0 * cosine * hy - y, 2.0 * cosine * hz - z
    above = oz > 0.0
    view = smith_lambda(coat, x, y, z)
    away = smith_lambda(coat, ox, oy, np.where(above, oz, 1.0))
    shadowed = np.where(above, (1.0 + view) / (1.0 + view + away), 0.0)
    return (fresnel(cosine, coat.eta) * shadowed) @ weight


@lru_cache(maxsize=64)
def _table(coat: Coat) -> Array:
    root = np.linspace(0.0, 1.0, SPLINE_MU)
    root[0] = GRAZING
    mu = root * root
    sine = np.sqrt(1.0 - mu * mu)
    isotropic = coat.alpha_x == coat.alpha_y
    angles = np.linspace(0.0, 0.5 * np.pi, SPLINE_AZIMUTH)
    columns = [
        albedo(coat, sine * np.cos(angle), sine * np.sin(angle), mu)
        for angle in (angles[:1] if isotropic else angles)
    ]
    fine = CubicSpline(root, np.stack(columns, axis=1))(np.linspace(0.0, 1.0, COUNT_MU))
    if isotropic:
        return np.repeat(fine, COUNT_AZIMUTH, axis=1)
    # Even about both axes, so the slope is 0 at either end.
    along = CubicSpline(angles, fine, axis=1, bc_type="clamped")
    everywhere: Array = along(np.linspace(0.0, 0.5 * np.pi, COUNT_AZIMUTH))
    return everywhere


@lru_cache(maxsize=64)
def _normal(coat: Coat) -> float:
    return float(albedo(coat, np.array([0.0]), np.array([0.0]), np.array([1.0]))[0])


@lru_cache(maxsize=64)
def _passing(coat: Coat) -> Passing:
    nodes, weights = legendre_nodes(48)
    root = 0.5 * (nodes + 1.0)
    mu = root * root
    # dω μ = μ dμ dφ, μ = s², so 2 μ dμ = 4 s³ ds; φ by the midpoint rule over a quadrant.
    turns = 1 if coat.alpha_x == coat.alpha_y else 16
    azimuth = (np.arange(turns) + 0.5) / turns * 0.5 * np.pi
    m, a = (grid.ravel() for grid in np.meshgrid(mu, azimuth, indexing="ij"))
    sine = np.sqrt(1.0 - m * m)
    e = albedo(coat, sine * np.cos(a), sine * np.sin(a), m).reshape(len(mu), -1).mean(axis=1)
    part = (1.0 - e) * 4.0 * root**3 * 0.5 * weights
    share = float(np.sum(part))
    x = 1.0 - np.sqrt(1.0 - (1.0 - mu * mu) / INDEX_WITHIN**2)
    # A perfect mirror lets nothing pass.
    over = max(share, 1e-30)
    return Passing(share, float(np.sum(part * x)) / over, float(np.sum(part * x * x)) / over)
