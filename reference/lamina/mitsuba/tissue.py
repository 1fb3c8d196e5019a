"""The tissue under a leaf's coats, at the wavelengths of a hit.

Written from the sections "The tissue under the coat" and "A closed blade" of
`docs/src/theory/leaf-bsdf.md`, in that page's letters.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from lamina.mitsuba.coat import INDEX_WITHIN, Coat, Passing

Double = dr.float64_array_t(mi.UnpolarizedSpectrum)
# k and r₀ of b, e and d of both faces, and q₁ √N, q₂, κ, δ₁ and δ₂, of a living and a dead leaf.
SATURATING = np.array(
    [
        [[[0.036, 0.014], [0.92, 0.32], [0.054, 0.104]],
         [[0.655, 0.304], [1.42, 0.275], [0.089, 0.12]]],
        [[[0.356, 0.01], [8.84, 1.0], [0.378, 0.708]],
         [[1.126, 0.235], [9.453, 1.0], [0.299, 0.407]]],
    ]
)  # fmt: skip
STEEPNESS = np.array([[3.783, 0.0, 0.251, 0.12, 0.094], [0.0, 1.392, 0.0, 0.079, 0.0]])
UNKNOWN_STRUCTURE = 1.6
MOST_STEEP = 3.443
MOST_THROUGH_HALVES = 0.999


@dataclass(frozen=True)
class Shape:
    """The numbers of the page's tables for one leaf."""

    saturating: list[list[list[float]]]
    steepness: list[float]


# Tissue of leaves without coats, as canopy models have them.
EVEN = Shape([[[0.0, 1.0]] * 3] * 2, [0.0] * 5)


def shape(structure: float = UNKNOWN_STRUCTURE, water: float = 1.0, dry: float = 1.0) -> Shape:
    """The numbers of a leaf of this structure and these mean contents (g/cm²)."""
    dead = min(max((dry - water) / (0.5 * dry), 0.0), 1.0) if dry > 0.0 else 0.0
    mix = np.array([1.0 - dead, dead])
    steepness = (mix @ STEEPNESS).tolist()
    steepness[0] /= math.sqrt(structure)
    return Shape(np.tensordot(mix, SATURATING, 1).tolist(), steepness)


def slanted(mu: Any) -> Any:
    """x of a cosine outside."""
    return 1.0 - dr.sqrt(1.0 - (1.0 - mu * mu) / (INDEX_WITHIN * INDEX_WITHIN))


def across(w_o: Any, w_i: Any) -> Any:
    """s of two directions."""
    return -(w_o.x * w_i.x + w_o.y * w_i.y)


@dataclass
class Face:
    """What the tissue does to light that has passed the coat of one face."""

    r: Any
    t: Any
    q: Any
    b: Any
    e: Any
    d: Any

    @property
    def absorbed(self) -> Any:
        """A."""
        return dr.maximum(0.0, 1.0 - self.r - self.t)

    def back(self, passing: Passing, x_o: Any, x_i: Any, s: Any) -> Any:
        """f_back but for Θ_o Θ_i/π."""
        kept = (1.0 - self.absorbed) * self.t * self.q
        a = 2.0 * kept + self.absorbed * self.b
        g = kept * self.q
        x, xx = Double(passing.x), Double(passing.xx)
        mean, most = a * x - g * xx, 0.5 * self.r
        over = mean > most
        scale = dr.select(over, most / dr.select(over, mean, 1.0), 1.0)
        x_o, x_i = Double(x_o), Double(x_i)
        h = scale * (a * (x_o + x_i) - g * (x_o * x_o + x_i * x_i) - mean)
        more = self.e * (x_o - x) * (x_i - x) + self.d * Double(s)
        return (self.r + h + more) / Double(passing.share)


def face_of(r: Any, t: Any, q: Any = 0.0, numbers: Any = ((0.0, 1.0),) * 3) -> Face:
    """A face that sends back r and lets t through; `numbers` are k and r₀ of b, e and d."""
    return Face(r, t, Double(q), *(k * r / (r + r_0) for k, r_0 in numbers))


def chosen(adaxial: Any, upper: Any, lower: Any) -> Any:
    """The numbers of one of two faces."""
    names = [field.name for field in fields(upper)]
    return type(upper)(
        *(dr.select(adaxial, getattr(upper, name), getattr(lower, name)) for name in names)
    )


class Tissue:
    """What both faces of a leaf send back and let through."""

    def __init__(self, faces: tuple[Face, Face], passing: tuple[Passing, ...], form: Shape) -> None:
        self.faces, self.passing, self.form = faces, passing, form

    def p(self, passing: tuple[Passing, ...]) -> list[Any]:
        """p of both faces if `passing` is what their coats let pass."""
        return [
            Double(light.share) * light.m(face.q)
            for face, light in zip(self.faces, passing, strict=True)
        ]

    def back(self, adaxial: Any, passing: tuple[Passing, ...], *slants: Any) -> Any:
        """f_back of a face but for Θ_o Θ_i/π; `slants` are x_o, x_i and s."""
        return chosen(adaxial, *self.faces).back(chosen(adaxial, *passing), *slants)

    def through(
        self, adaxial: Any, passing: tuple[Passing, ...], x_o: Any, x_i: Any, s: Any
    ) -> Any:
        """f_through seen from a face but for Θ_o Θ_i/π."""
        upper, lower = self.faces
        p = self.p(passing)
        c = dr.minimum(upper.t / p[1], lower.t / p[0])
        seen, lit = chosen(adaxial, upper, lower), chosen(adaxial, lower, upper)
        less = (1.0 - seen.q * Double(x_o)) * (1.0 - lit.q * Double(x_i))
        delta = self.form.steepness[3] + self.form.steepness[4] * upper.absorbed
        return c * less * less * (1.0 + delta * Double(s))

    def chances(self, adaxial: Any) -> tuple[Any, Any]:
        """What the tissue reflects and lets through seen from a face: mean over wavelengths."""
        face = chosen(adaxial, *self.faces)
        return mi.Float(dr.mean(face.r)), mi.Float(dr.mean(face.t))

    def lets_through(self, t: Any, coat: Coat) -> None:
        """Lets through what entered elsewhere, `coat` being the adaxial one; r and q stay."""
        upper, lower = self.faces
        p_a, p_b = self.p(self.passing)
        most = dr.minimum(1.0 - upper.r, (1.0 - lower.r) * p_b / p_a)
        upper.t = dr.minimum(t / (1.0 - coat.normal), most)
        lower.t = upper.t * p_a / p_b

    def half(self, face: int) -> Tissue:
        """One face with half of the tissue."""
        p = self.p(self.passing)
        k = [dr.rsqrt(part) - dr.sqrt(part) for part in p]
        r = [side.r for side in self.faces]
        t = dr.minimum(dr.sqrt(self.faces[0].t * self.faces[1].t), MOST_THROUGH_HALVES)
        rest = dr.rcp(1.0 - t * t)
        s = [(r[i] - t * r[1 - i]) * rest for i in (0, 1)]
        w = [(k[i] - t * k[1 - i]) * rest for i in (0, 1)]
        # τ² (1 + t w_A w_B) + t (s_A w_B + s_B w_A) τ = t (1 - s_A s_B)
        a = 1.0 + t * w[0] * w[1]
        b = t * (s[0] * w[1] + s[1] * w[0])
        c = t * (s[0] * s[1] - 1.0)
        root = dr.sqrt(dr.maximum(b * b - 4.0 * a * c, 0.0))
        tau = dr.select(b > 0.0, -2.0 * c / (root + b), (root - b) / (2.0 * a))
        tau = dr.clip(tau, 0.0, dr.sqrt(dr.minimum(p[0], p[1])))
        own = dr.sqrt(p[face])
        sigma = dr.clip(s[face] + w[face] * tau, 0.0, 1.0 - own * tau)
        rho = dr.clip(sigma - k[face] * tau, 0.0, dr.maximum(1.0 - tau / own, 0.0))
        outside = face_of(rho, tau / own, self.faces[face].q, self.form.saturating[face])
        inside = face_of(sigma, tau * own)
        cut = Passing(1.0, 0.0, 0.0)
        if face == 0:
            return Tissue((outside, inside), (self.passing[0], cut), self.form)
        return Tissue((inside, outside), (cut, self.passing[1]), self.form)


def body(r: Any, coat: Coat) -> Tissue:
    """A body that sends back r of what has passed its coat, and lets nothing through."""
    face = face_of(r, Double(0.0))
    return Tissue((face, face), (coat.passing, coat.passing), shape())


def under_coat(whole: Any, coat: Coat) -> Any:
    """r of tissue that together with its coat sends back `whole` of light along the normal."""
    return dr.maximum(0.0, (whole - coat.normal) / (1.0 - coat.normal))


def leaf(
    r: Any, t: Any, below: Any, coats: tuple[Coat, ...], form: Shape, measured: bool
) -> Tissue:
    """The tissue of a leaf of R, T and ρR; `measured` if as much goes through from both sides."""
    upper, lower = coats
    inward = dr.minimum(t / (1.0 - upper.normal), 1.0)
    q = steepness([under_coat(r, upper), under_coat(below, lower)], inward, coats, form)
    if measured:
        q = alike(q, coats)
    passing = tuple(coat.passing for coat in coats)
    p_a, p_b = (light.share * light.m(number) for light, number in zip(passing, q, strict=True))
    t_a = dr.minimum(inward, p_b / p_a)
    t_b = dr.minimum(1.0, t_a * p_a / p_b)
    r_a = dr.minimum(under_coat(r, upper), 1.0 - t_a)
    a_b = dr.maximum(0.0, 1.0 - below - t) / (1.0 - lower.normal)
    r_b = dr.clip(1.0 - t_b - a_b, 0.0, 1.0 - t_b)
    upper_numbers, lower_numbers = form.saturating
    faces = face_of(r_a, t_a, q[0], upper_numbers), face_of(r_b, t_b, q[1], lower_numbers)
    return Tissue(faces, passing, form)


def steepness(r: list[Any], t: Any, coats: tuple[Coat, ...], form: Shape) -> list[Any]:
    """q of both faces."""
    q_1, q_2, kappa = form.steepness[:3]
    q = q_1 * (1.0 - dr.sqrt(dr.sqrt(dr.sqrt(t)))) + q_2 * (1.0 - t)
    both = r[0] + r[1]
    u = kappa * dr.select(both > 0.0, (r[1] - r[0]) / dr.select(both > 0.0, both, 1.0), 0.0)
    steep = []
    for r_f, q_f, coat in zip(r, (q * (1.0 + u), q * (1.0 - u)), coats, strict=True):
        absorbed = dr.maximum(0.0, 1.0 - r_f - t)
        part = 4.0 * (1.0 - absorbed) * t * coat.passing.x
        bound = dr.select(part > 0.0, r_f / dr.select(part > 0.0, part, 1.0), MOST_STEEP)
        steep.append(dr.minimum(q_f, dr.minimum(bound, MOST_STEEP)))
    return steep


def alike(q: list[Any], coats: tuple[Coat, ...]) -> list[Any]:
    """q with which both faces let the same fraction of light along the normal through."""
    a, b = (coat.passing for coat in coats)
    ratio = (a.share / (1.0 - coats[0].normal)) / (b.share / (1.0 - coats[1].normal))
    m_b = a.m(q[0]) * ratio
    over = m_b > 1.0
    return [
        dr.select(over, falling(Double(1.0 / ratio), a), q[0]),
        dr.select(over, 0.0, falling(m_b, b)),
    ]


def falling(m: Any, passing: Passing) -> Any:
    """The q of which m is this."""
    under = dr.maximum(0.0, passing.x * passing.x - passing.xx * (1.0 - m))
    return dr.clip((passing.x - dr.sqrt(under)) / passing.xx, 0.0, MOST_STEEP)
