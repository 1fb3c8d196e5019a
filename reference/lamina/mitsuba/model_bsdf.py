"""A surface between paint and metal in Mitsuba, as the plugin `lamina_model`.

Written from `docs/src/theory/leaf-bsdf.md` ("Between paint and metal" and "Relief"). The letters
are that page's; Mitsuba's `wi` is its ω_o, and `eval` has the cosine in it.

Parameters of the plugin, the first three of them textures of the kind `lamina_colours`:

- `colours`: the base colour c;
- `finish`: roughness ρ and fraction of metal m, as green and blue;
- `normals`: normals n as (n + 1) / 2;
- `normal_scale_0`, `normal_scale_1`, …: factors on x and y of the normals of each slot.

Import it after the variant is chosen; `register()` makes the plugin known.
"""

from __future__ import annotations

import math
from typing import Any

import drjit as dr
import mitsuba as mi

from lamina.mitsuba import facet
from lamina.mitsuba.leaf_bsdf import LeafBSDF
from lamina.mitsuba.lookup import Table
from lamina.mitsuba.relief_bsdf import GIVEN_BACK, LEAST_FACING, RoughCoat, albedos
from lamina.mitsuba.tissue import Double

ETA = 1.5
LEAST_ALPHA = 0.02
# Least part of a normal that points away from the surface.
LEAST_UPWARD = 0.02


class Seen:
    """The surface at a hit, with the frame of its relief; directions in it have z > 0."""

    def __init__(self, bsdf: ModelBSDF, si: Any, active: Any) -> None:
        self.turn = LeafBSDF.axes(si)
        finish = bsdf.finish.eval_3(si, active)
        rho, self.metal = finish[1], finish[2]
        alpha = dr.clip(rho * rho, LEAST_ALPHA, 1.0)
        self.coat = RoughCoat(ETA, alpha, alpha, bsdf.tables[0])
        self.mirror = RoughCoat(math.inf, alpha, alpha, bsdf.tables[1])
        self.colour = Double(bsdf.colours.eval(si, active))
        self.view = LeafBSDF.to_page(si.wi, self.turn)

        stored = bsdf.normals.eval_3(si, active)
        scale = bsdf.normals.chosen(si, bsdf.scales)
        n = mi.Vector3f(
            scale * (2.0 * stored[0] - 1.0), scale * (2.0 * stored[1] - 1.0), 2.0 * stored[2] - 1.0
        )
        z = dr.maximum(n.z, LEAST_UPWARD * dr.norm(n))
        along_u = LeafBSDF.to_page(si.to_local(si.dp_du), self.turn)
        x = dr.select(along_u.x < 0.0, -n.x, n.x)
        slope = mi.Vector2f(-x / z, -n.y / z)
        away = (slope.x * self.view.x + slope.y * self.view.y) * dr.sign(self.view.z)
        steep = away > 0.0
        least = (1.0 - LEAST_FACING) * dr.abs(self.view.z) / dr.select(steep, away, 1.0)
        slope *= dr.select(steep, dr.minimum(least, 1.0), 1.0)
        self.z = dr.normalize(mi.Vector3f(-slope.x, -slope.y, 1.0))
        self.y = dr.normalize(mi.Vector3f(0, 1, 0) - self.z * self.z.y)
        self.x = dr.cross(self.y, self.z)
        self.outward = self.inside(self.view)

    def inside(self, w: Any) -> Any:
        """A direction of the page's frame in that of the relief, on the side of the view."""
        side = dr.sign(self.view.z)
        return mi.Vector3f(dr.dot(w, self.x), dr.dot(w, self.y), side * dr.dot(w, self.z))

    def outside(self, w: Any) -> Any:
        """The way back, to Mitsuba's shading frame."""
        side = dr.sign(self.view.z)
        page = self.x * w.x + self.y * w.y + self.z * (side * w.z)
        c, s = self.turn
        return mi.Vector3f(c * page.x + s * page.y, c * page.y - s * page.x, page.z)

    def shining(self) -> Any:
        """Probability that a direction is mirrored at a facet."""
        return 0.25 + 0.5 * self.metal


class ModelBSDF(mi.BSDF):
    """Paint and metal, mixed; both sides are alike."""

    def __init__(self, props: mi.Properties) -> None:
        mi.BSDF.__init__(self, props)
        self.colours, self.finish, self.normals = (
            props.get_texture(name) for name in ("colours", "finish", "normals")
        )
        self.scales: list[float] = []
        while f"normal_scale_{len(self.scales)}" in props:
            self.scales.append(float(props.get(f"normal_scale_{len(self.scales)}")))
        self.tables = [
            (Table(table), Table(means)) for table, means in map(albedos, (ETA, math.inf))
        ]
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        varying = mi.BSDFFlags.SpatiallyVarying
        self.m_components = [
            mi.BSDFFlags.GlossyReflection | varying | sides,
            mi.BSDFFlags.DiffuseReflection | varying | sides,
        ]
        self.m_flags = self.m_components[0] | self.m_components[1]

    def value_and_pdf(self, si: Any, wo: Any, active: Any) -> tuple[Any, Any]:
        """The BSDF times the cosine, and the density of `sample`."""
        active = active & (si.wi.z * wo.z > 0.0)
        seen = Seen(self, si, active)
        light = seen.inside(LeafBSDF.to_page(wo, seen.turn))
        active &= light.z > 0.0
        light.z = dr.select(active, light.z, 1.0)
        view, mu = seen.outward, light.z
        h = dr.normalize(view + light)
        cosine = dr.dot(view, h)
        masked = 1.0 + seen.coat.smith(view)
        shape = seen.coat.distribution(h) / (4.0 * view.z)

        c, m = seen.colour, Double(seen.metal)
        paint, _, _, _ = mi.fresnel(cosine, ETA)
        metal = c + (1.0 - c) * Double(dr.power(1.0 - cosine, 5.0))
        at_once = (1.0 - m) * Double(paint) + m * metal
        at_once *= Double(shape / (masked + seen.coat.smith(light)))

        def base(coat: RoughCoat) -> Any:
            passed = (1.0 - coat.albedo(view.z)) * (1.0 - coat.albedo(mu))
            return Double(passed * mu / (dr.pi * coat.passing.share))

        mean, held = c + (1.0 - c) / 21.0, Double(seen.mirror.passing.share)
        later = mean * mean * (1.0 - held) / (1.0 - mean * held)
        back = Double(dr.rcp(1.0 - 0.5 * GIVEN_BACK * (1.0 - seen.z.z)))
        rest = (1.0 - m) * c * base(seen.coat) + m * later * base(seen.mirror)
        value = mi.UnpolarizedSpectrum(at_once + rest * back)
        chance = seen.shining()
        pdf = chance * shape / masked + (1.0 - chance) * mu / dr.pi
        return dr.select(active, value, 0.0), dr.select(active, pdf, 0.0)

    def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
        """Draws a direction; gives it with value over density."""
        si = facet.seen(si)
        active = mi.Bool(active) & (si.wi.z != 0.0)
        seen = Seen(self, si, active)
        in_coat = sample1 < seen.shining()
        # The cap of normals that the view sees (Dupuy and Benyoub 2023).
        alpha, view = seen.coat.alpha_x, seen.outward
        v = dr.normalize(mi.Vector3f(alpha * view.x, alpha * view.y, view.z))
        z = (1.0 - sample2.y) * (1.0 + v.z) - v.z
        ring = dr.safe_sqrt(1.0 - z * z)
        s, c = dr.sincos(dr.two_pi * sample2.x)
        h = mi.Vector3f(ring * c, ring * s, z) + v
        h = dr.normalize(mi.Vector3f(alpha * h.x, alpha * h.y, dr.maximum(h.z, 1e-7)))
        mirrored = 2.0 * dr.dot(view, h) * h - view
        local = dr.select(in_coat, mirrored, mi.warp.square_to_cosine_hemisphere(sample2))
        active &= local.z > 0.0
        wo = facet.leaving(si, seen.outside(local))
        value, pdf = facet.folded(self.value_and_pdf, si, wo, active)
        active &= pdf > 0.0
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo = wo
        bs.pdf = dr.select(active, pdf, 0.0)
        bs.eta = 1.0
        bs.sampled_type = dr.select(
            in_coat,
            mi.UInt32(+mi.BSDFFlags.GlossyReflection),
            mi.UInt32(+mi.BSDFFlags.DiffuseReflection),
        )
        bs.sampled_component = dr.select(in_coat, mi.UInt32(0), mi.UInt32(1))
        return bs, dr.select(active, value / dr.select(active, pdf, 1.0), 0.0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """f times the cosine."""
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density of `sample`."""
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Both at once."""
        return facet.folded(self.value_and_pdf, facet.seen(si), wo, mi.Bool(active))

    def traverse(self, callback: Any) -> None:
        """It has no parameters that are changed after loading."""

    def to_string(self) -> str:
        """For messages."""
        return f"ModelBSDF[{len(self.scales)} slots]"


def register() -> None:
    """Makes `lamina_model` known to Mitsuba."""
    mi.register_bsdf("lamina_model", ModelBSDF)
