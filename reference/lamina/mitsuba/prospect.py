"""PROSPECT-D: reflectance and transmittance of a leaf from what it contains.

Written from Jacquemoud and Baret, "PROSPECT: A Model of Leaf Optical Properties Spectra" (Remote
Sens. Environ. 34, 1990) and Féret et al. 2017 (PROSPECT-D), which give: the absorption of a
plate K = Σ Cᵢ kᵢ / N, its transmissivity τ = (1 - K) e⁻ᴷ + K² E₁(K) = 2 E₃(K), the mean Fresnel
transmittance t_av(α, n) of light within a cone of half angle α (Stern 1964), a plate as the sum
over internal reflections (Allen et al. 1969), and N - 1 more plates, N real (Stokes 1862).

Everything is done in double precision: near zero absorption the Stokes formulae divide small
differences. t_av is found by quadrature of Fresnel's formulae and tabulated over n.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import drjit as dr
import numpy as np

from lamina.mitsuba.lookup import Table, cell

# PROSPECT-D's own absorbers, in the order of the published table's columns after the refractive
# index.
PROSPECT_D = ("chlorophyll", "carotenoids", "anthocyanins", "brown", "water", "dry_matter")
# Those of exported tables, which have betalains, PROSPECT-PRO's parts of dry matter and a
# constituent of the scene's own besides.
OPTIONAL = ("betacyanins", "betaxanthins", "proteins", "carbon_based", "extra")
ABSORBERS = (*PROSPECT_D[:3], *OPTIONAL[:2], *PROSPECT_D[3:], *OPTIONAL[2:])
CONTENTS = ("structure", *ABSORBERS)
# Refractive indices for which t_av is tabulated; linear between is good to 1e-9 at this count.
INDEX_RANGE = (1.2, 1.7)
INDEX_COUNT = 8193
EULER = 0.57721566490153286


def mean_transmittance(alpha: float, n: np.ndarray) -> np.ndarray:
    """t_av(α, n): Fresnel transmittance from air into index n, averaged over a cone.

    The average is over sin²θ from 0 to sin²α, that is over equal flux from equal solid angles
    seen in projection, both polarisations alike.
    """
    nodes, weights = np.polynomial.legendre.leggauss(128)
    # θ as the variable keeps the integrand smooth up to grazing incidence.
    theta = 0.5 * alpha * (nodes + 1.0)[:, None]
    cos_i, sin_i = np.cos(theta), np.sin(theta)
    cos_t = np.sqrt(1.0 - (sin_i / n) ** 2)
    senkrecht = (cos_i - n * cos_t) / (cos_i + n * cos_t)
    parallel = (n * cos_i - cos_t) / (n * cos_i + cos_t)
    passed = 1.0 - 0.5 * (senkrecht**2 + parallel**2)
    flux = 2.0 * sin_i * cos_i * 0.5 * alpha * weights[:, None]
    return np.asarray((passed * flux).sum(axis=0) / np.sin(alpha) ** 2)


def transmissivity(k: Any) -> tuple[Any, Any]:
    """τ = 2 E₃(k) and 1 - τ for k ≥ 0, both without loss of digits.

    E₁ by its power series below 1; E₃ by its continued fraction (Abramowitz and Stegun 5.1.22)
    from 1 on.
    """
    small = dr.minimum(k, 1.0)
    # E₁(k) = -γ - ln k - Σ (-k)ⁿ/(n n!),  1 - e⁻ᵏ = -Σ (-k)ⁿ/n!
    term = dr.full(type(k), 1.0) if not isinstance(k, float) else 1.0
    series = 0.0
    risen = 0.0
    for n in range(1, 20):
        term = term * (-small) / n
        series = series + term / n
        risen = risen - term
    e1 = -EULER - dr.log(dr.maximum(small, 1e-300)) - series
    lost_small = risen + small * (1.0 - risen) - small * small * e1
    large = dr.maximum(k, 1.0)
    steps = 60
    tail = large + (3 + 2 * steps)
    for n in range(steps, 0, -1):
        tail = large + (3 + 2 * (n - 1)) - n * (3 + n - 1) / tail
    tau_large = 2.0 * dr.exp(-large) / tail
    below = k < 1.0
    return (
        dr.select(below, 1.0 - lost_small, tau_large),
        dr.select(below, lost_small, 1.0 - tau_large),
    )


class Prospect:
    """The model with its table, for wavelengths held in arrays of type `kind` (double)."""

    def __init__(self, table: Path, kind: type, extrapolate: bool) -> None:
        rows = np.loadtxt(
            [line for line in table.read_text(encoding="utf-8").splitlines() if line[:1].isdigit()],
            delimiter=",",
        )
        self.kind = kind
        self.extrapolate = extrapolate
        self.first, self.last = rows[0, 0], rows[-1, 0]
        self.count = len(rows)
        columns = {2 + len(names): names for names in (PROSPECT_D, ABSORBERS)}
        self.absorbers = columns[rows.shape[1]]
        assert np.array_equal(rows[:, 0], np.arange(self.first, self.last + 0.5))
        self.index = Table(rows[:, 1], double=True)
        self.absorption = [Table(column, double=True) for column in rows[:, 2:].T]
        n = np.linspace(*INDEX_RANGE, INDEX_COUNT)
        self.lit = Table(mean_transmittance(np.deg2rad(40.0), n), double=True)
        self.inside = Table(mean_transmittance(0.5 * np.pi, n), double=True)

    def _between(self, table: Table, index: Any, share: Any) -> Any:
        low = table.at(self.kind, index)
        above = index + 1 if not isinstance(index, list) else [i + 1 for i in index]
        return low + share * (table.at(self.kind, above) - low)

    def absorbed(self, wavelengths: Any, contents: dict[str, Any]) -> Any:
        """Σ Cᵢ kᵢ of contents at `wavelengths` (nm); end values outside the table."""
        kind = self.kind
        index, share = cell(kind, kind(wavelengths) - self.first, self.count)
        total = kind(0.0)
        for name, table in zip(self.absorbers, self.absorption, strict=True):
            total = total + kind(contents[name]) * self._between(table, index, share)
        return total

    def spectra(self, wavelengths: Any, contents: dict[str, Any]) -> tuple[Any, Any]:
        """R and T at `wavelengths` (nm); `contents` is keyed by `CONTENTS`.

        Outside the table its end values hold if `extrapolate`, else R = T = 0.
        """
        kind = self.kind
        index, share = cell(kind, kind(wavelengths) - self.first, self.count)
        n = self._between(self.index, index, share)
        total = self.absorbed(wavelengths, contents)
        structure = dr.maximum(kind(contents["structure"]), 1.0)
        tau, lost = transmissivity(dr.maximum(total / structure, 0.0))

        low, high = INDEX_RANGE
        where = (n - low) * ((INDEX_COUNT - 1) / (high - low))
        at, part = cell(kind, where, INDEX_COUNT)
        t_lit = self._between(self.lit, at, part)
        t_in = self._between(self.inside, at, part)
        r, t = pile(n, t_lit, t_in, tau, lost, structure)
        if not self.extrapolate:
            known = (wavelengths >= self.first) & (wavelengths <= self.last)
            r, t = dr.select(known, r, 0.0), dr.select(known, t, 0.0)
        return r, t


def pile(n: Any, t_lit: Any, t_in: Any, tau: Any, lost: Any, plates: Any) -> tuple[Any, Any]:
    """R and T of `plates` plates of index n; `lost` is 1 - τ.

    The topmost plate is lit within 40°, the others by diffuse light.
    """
    t_out = t_in / (n * n)
    r_out = 1.0 - t_out
    series = 1.0 - (r_out * tau) * (r_out * tau)
    t_top = t_lit * tau * t_out / series
    r_top = (1.0 - t_lit) + r_out * tau * t_top
    t = t_in * tau * t_out / series
    r = (1.0 - t_in) + r_out * tau * t
    # What one plate absorbs, 1 - r - t, in a form that has no difference in it.
    a = t_in * lost / (1.0 - r_out * tau)

    # Stokes' pile in the letters a, b of Jacquemoud and Baret, with a - 1 and b - 1 again free
    # of differences.
    d = dr.sqrt(dr.maximum(a * (1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t), 0.0))
    more_a = (a * (1.0 - r + t) + d) / (2.0 * r)
    more_b = (a * (1.0 - t + r) + d) / (2.0 * t)
    # exp and log of 1 + small: below this the limit is as good as the formula in double.
    lossless = more_b < 1e-7
    b_rest = dr.exp((plates - 1.0) * dr.log(1.0 + dr.select(lossless, 1.0, more_b)))
    a_one = 1.0 + more_a
    # Deep absorption: b^(N-1) overflows long after T has become 0.
    b_rest = dr.minimum(b_rest, 1e100)
    below = dr.select(lossless, 1.0, a_one * a_one * b_rest * b_rest - 1.0)
    r_rest = a_one * (b_rest * b_rest - 1.0) / below
    t_rest = b_rest * (a_one * a_one - 1.0) / below
    t_clear = t / (t + (1.0 - t) * (plates - 1.0))
    r_rest = dr.select(lossless, 1.0 - t_clear, r_rest)
    t_rest = dr.select(lossless, t_clear, t_rest)

    between = 1.0 - r * r_rest
    return r_top + t_top * r_rest * t / between, t_top * t_rest / between
