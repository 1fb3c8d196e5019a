"""Leaves with a relief in Mitsuba, as the plugin `lamina_relief`.

Written from the section "Relief" of `docs/src/theory/leaf-bsdf.md`. Its parameters are those of
`lamina_leaf` and `relief`, an EXR whose channels are, for each face, the means of the slopes along
x and y and of their squares.

Only the finest level of the map is used: scenes that are compared must be seen so closely that a
pixel is narrower than a texel, and end their paths at the first hit. Cells, stomata, bloom and dust
are not part of it.
"""

from __future__ import annotations

from dataclasses import astuple
from functools import lru_cache
from pathlib import Path
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from lamina.exr import read_channels
from lamina.mitsuba import facet, solid_bsdf, tissue
from lamina.mitsuba.coat import Coat, Passing
from lamina.mitsuba.leaf_bsdf import FACES, LeafBSDF
from lamina.mitsuba.lookup import Table, cell
from lamina.mitsuba.tissue import Double, across, slanted

MOMENTS = [f"{face}.{of}" for face in FACES for of in ("x", "y", "xx", "yy")]
# Roughnesses at which albedos are computed; between them they are interpolated.
ALPHAS = np.linspace(0.02, 1.0, 50)
COUNT_MU = 129
SPREAD = 3.0
# The views' cosine to a slope, over that to the mesh, which steeper slopes are lowered to.
LEAST_FACING = 0.5
GIVEN_BACK = 0.5


@lru_cache(maxsize=4)
def albedos(eta: float) -> tuple[np.ndarray, np.ndarray]:
    """E over roughness and √μ, and P, x̄ and x²'s mean over roughness, of coats alike in all
    directions."""
    coats = [Coat(eta, float(alpha), float(alpha)) for alpha in ALPHAS]
    step = (coats[0].table.shape[0] - 1) // (COUNT_MU - 1)
    return (
        np.stack([coat.table[::step, 0] for coat in coats]),
        np.array([astuple(coat.passing) for coat in coats]),
    )


class ReliefMap:
    """Moments of slopes over uv: bilinear between texel centres, clamped, row 0 at v = 0."""

    def __init__(self, file: Path) -> None:
        channels = read_channels(file)
        height, width = channels[MOMENTS[0]].shape
        self.size = width, height
        self.tables = [Table(channels[name]) for name in MOMENTS]

    def at(self, uv: Any) -> list[Any]:
        """The eight moments."""
        width, height = self.size
        x, a = cell(mi.Float, uv.x * width - 0.5, width)
        y, b = cell(mi.Float, uv.y * height - 0.5, height)
        corner = y * width + x
        found = []
        for table in self.tables:
            low = dr.lerp(table.at(mi.Float, corner), table.at(mi.Float, corner + 1), a)
            above = corner + width
            high = dr.lerp(table.at(mi.Float, above), table.at(mi.Float, above + 1), a)
            found.append(dr.lerp(low, high, b))
        return found


class RoughCoat:
    """One face's coat at one place."""

    def __init__(
        self,
        eta: float,
        alpha_x: Any,
        alpha_y: Any,
        tables: tuple[Table, Table],
        there: bool = True,
    ) -> None:
        self.eta, self.alpha_x, self.alpha_y = eta, alpha_x, alpha_y
        # A cut through the tissue has no coat.
        self.there = mi.Float(1.0 if there else 0.0)
        # Albedos are those of the coat alike in all directions with the same mean square.
        alpha = dr.sqrt(0.5 * (alpha_x * alpha_x + alpha_y * alpha_y))
        self.table, means = tables
        low, high = float(ALPHAS[0]), float(ALPHAS[-1])
        place = (alpha - low) / (high - low) * (len(ALPHAS) - 1.0)
        self.row, self.share = cell(mi.Float, place, len(ALPHAS))
        at = [3 * self.row + number for number in range(3)]
        share, x, xx = (
            dr.lerp(means.at(mi.Float, i), means.at(mi.Float, i + 3), self.share) for i in at
        )
        self.passing = Passing(1.0 - self.there * (1.0 - share), x, xx)

    def albedo(self, mu: Any) -> Any:
        """E at a cosine."""
        column, a = cell(mi.Float, dr.sqrt(mu) * (COUNT_MU - 1.0), COUNT_MU)
        at = self.row * COUNT_MU + column
        low = dr.lerp(self.table.at(mi.Float, at), self.table.at(mi.Float, at + 1), a)
        at = at + COUNT_MU
        high = dr.lerp(self.table.at(mi.Float, at), self.table.at(mi.Float, at + 1), a)
        return self.there * dr.lerp(low, high, self.share)

    def smith(self, w: Any) -> Any:
        """Smith's Λ."""
        x, y = self.alpha_x * w.x, self.alpha_y * w.y
        return 0.5 * (dr.sqrt(1.0 + (x * x + y * y) / (w.z * w.z)) - 1.0)

    def distribution(self, h: Any) -> Any:
        """D(h)."""
        x, y = h.x / self.alpha_x, h.y / self.alpha_y
        inner = x * x + y * y + h.z * h.z
        return dr.rcp(dr.pi * self.alpha_x * self.alpha_y * inner * inner)

    def times_cosine(self, view: Any, light: Any) -> Any:
        """f_coat times the cosine of the light."""
        h = dr.normalize(view + light)
        f, _, _, _ = mi.fresnel(dr.dot(view, h), self.eta)
        g = dr.rcp(1.0 + self.smith(view) + self.smith(light))
        return self.there * self.distribution(h) * g * f / (4.0 * view.z)


def chosen(condition: Any, a: RoughCoat, b: RoughCoat) -> RoughCoat:
    """One of two coats."""
    coat = RoughCoat.__new__(RoughCoat)
    for name in ("alpha_x", "alpha_y", "row", "share", "there"):
        setattr(coat, name, dr.select(condition, getattr(a, name), getattr(b, name)))
    coat.passing = tissue.chosen(condition, a.passing, b.passing)
    if a.eta != b.eta:
        raise ValueError("both coats must have one refractive index")
    coat.eta, coat.table = a.eta, a.table
    return coat


class ReliefBSDF(LeafBSDF):
    """A leaf whose faces have normals and roughnesses of their own."""

    def __init__(self, props: mi.Properties) -> None:
        LeafBSDF.__init__(self, props)
        file = mi.file_resolver().resolve(str(props.get("relief")))
        self.relief = ReliefMap(Path(str(file)))
        self.rough = []
        for coat in self.coats:
            table, means = albedos(coat.eta)
            self.rough.append((Table(table), Table(means)))

    def local_faces(self, si: Any) -> list[tuple[Any, RoughCoat]]:
        """Slope and coat of the adaxial and the abaxial face."""
        moments = self.relief.at(si.uv)
        faces = []
        for number, coat in enumerate(self.coats):
            if self.half == 1 - number:
                own = self.coats[1 - number]
                alphas = mi.Float(own.alpha_x), mi.Float(own.alpha_y)
                none = RoughCoat(own.eta, *alphas, self.rough[1 - number], there=False)
                faces.append((mi.Vector2f(0.0, 0.0), none))
                continue
            x, y, xx, yy = moments[4 * number : 4 * number + 4]
            across, along = (
                dr.clip(
                    dr.sqrt(alpha * alpha + SPREAD * dr.maximum(square - mean * mean, 0.0)),
                    0.02,
                    1.0,
                )
                for alpha, square, mean in ((coat.alpha_x, xx, x), (coat.alpha_y, yy, y))
            )
            rough = RoughCoat(coat.eta, across, along, self.rough[number])
            faces.append((mi.Vector2f(x, y), rough))
        return faces

    def value_and_pdf(self, si: Any, wo: Any, active: Any) -> tuple[Any, Any]:
        """The BSDF times the cosine, and the density of `sample`: the cosine's, to either side."""
        active = active & (si.wi.z != 0.0) & (wo.z != 0.0)
        axes = self.axes(si)
        up = mi.Vector3f(0, 0, 1)
        view = self.to_page(dr.select(active, si.wi, up), axes)
        light = self.to_page(dr.select(active, wo, up), axes)
        adaxial, same = view.z > 0.0, view.z * light.z > 0.0
        (slope_a, coat_a), (slope_b, coat_b) = self.local_faces(si)
        own, other = chosen(adaxial, coat_a, coat_b), chosen(adaxial, coat_b, coat_a)

        slope = dr.select(adaxial, slope_a, slope_b)
        away = (slope.x * view.x + slope.y * view.y) * dr.sign(view.z)
        steep = away > 0.0
        least = (1.0 - LEAST_FACING) * dr.abs(view.z) / dr.select(steep, away, 1.0)
        slope = slope * dr.select(steep, dr.minimum(least, 1.0), 1.0)
        normal = dr.normalize(mi.Vector3f(-slope.x, -slope.y, 1.0))
        y_axis = dr.normalize(mi.Vector3f(0, 1, 0) - normal * normal.y)
        x_axis = dr.cross(y_axis, normal)

        def in_face(w: Any) -> Any:
            return mi.Vector3f(dr.dot(w, x_axis), dr.dot(w, y_axis), dr.dot(w, normal))

        beyond = dr.select(adaxial, slope_b, slope_a)
        beyond = dr.normalize(mi.Vector3f(-beyond.x, -beyond.y, 1.0))
        seen, lit = in_face(view), in_face(light)
        seen.z = dr.abs(seen.z)
        cosine = dr.select(same, lit.z, dr.dot(light, beyond))
        bright = cosine * light.z > 0.0
        cosine = dr.abs(cosine)
        lit.z = dr.select(bright & same, dr.abs(lit.z), 1.0)
        back = dr.rcp(1.0 - 0.5 * GIVEN_BACK * (1.0 - dr.select(same, normal.z, beyond.z)))

        e_view = own.albedo(seen.z)
        e_light = dr.select(same, own.albedo(cosine), other.albedo(cosine))
        found = self.tissue(si, active)
        passing = coat_a.passing, coat_b.passing
        slants = slanted(seen.z), slanted(cosine)
        base = dr.select(
            same,
            found.back(adaxial, passing, *slants, across(seen, lit)),
            found.through(adaxial, passing, *slants, across(view, light)),
        )
        base *= Double((1.0 - e_view) * (1.0 - e_light) * back * cosine / dr.pi)
        coat = dr.select(same, own.times_cosine(seen, lit), 0.0)
        value = mi.UnpolarizedSpectrum(base) + coat
        pdf = 0.5 * dr.abs(light.z) / dr.pi
        return dr.select(active & bright, value, 0.0), dr.select(active, pdf, 0.0)

    def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
        """Draws a direction by its cosine, to either side; gives it with value over density."""
        si = facet.seen(si)
        active = mi.Bool(active) & (si.wi.z != 0.0)
        wo = mi.warp.square_to_cosine_hemisphere(sample2)
        is_above = sample1 < 0.5
        wo.z = dr.select(is_above, wo.z, -wo.z)
        wo = facet.leaving(si, wo)
        value, pdf = facet.folded(self.value_and_pdf, si, wo, active)
        active &= pdf > 0.0
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo = wo
        bs.pdf = dr.select(active, pdf, 0.0)
        bs.eta = 1.0
        same = si.wi.z * wo.z > 0.0
        bs.sampled_type = dr.select(
            same,
            mi.UInt32(+mi.BSDFFlags.DiffuseReflection),
            mi.UInt32(+mi.BSDFFlags.DiffuseTransmission),
        )
        bs.sampled_component = dr.select(same, mi.UInt32(1), mi.UInt32(2))
        return bs, dr.select(active, value / dr.select(active, pdf, 1.0), 0.0)

    def to_string(self) -> str:
        """For messages."""
        return f"ReliefBSDF[{self.kind}, {self.coats}, {self.relief.size}]"


def register() -> None:
    """Makes `lamina_leaf`, `lamina_solid` and `lamina_relief` known to Mitsuba."""
    solid_bsdf.register()
    mi.register_bsdf("lamina_relief", ReliefBSDF)
