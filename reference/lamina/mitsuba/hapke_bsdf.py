"""A surface of grains in Mitsuba, as the plugin `lamina_hapke`.

Written from `docs/src/theory/soil.md`. Both sides are alike.

Parameters of the plugin:

- `albedo`: a spectrum, w of the page;
- `asymmetry`, `backward`: b and c of the phase function;
- `opposition`, `width`: B0 and h of the opposition effect.

Import it after the variant is chosen; `register()` makes the plugin known.
"""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi


def multiple(albedo: Any, cosine: Any) -> Any:
    """H of Hapke (2002) at a cosine."""
    gamma = dr.sqrt(dr.maximum(1.0 - albedo, 0.0))
    r0 = (1.0 - gamma) / (1.0 + gamma)
    mu = dr.maximum(cosine, 1e-6)
    bracket = r0 + 0.5 * (1.0 - 2.0 * r0 * mu) * dr.log((1.0 + mu) / mu)
    return 1.0 / (1.0 - albedo * mu * bracket)


class HapkeBSDF(mi.BSDF):
    """Grains that scatter light into two lobes, brighter from where the light comes."""

    def __init__(self, props: mi.Properties) -> None:
        mi.BSDF.__init__(self, props)
        self.albedo = props.get_texture("albedo")
        self.b, self.c = props.get("asymmetry"), props.get("backward")
        self.b0, self.h = props.get("opposition"), props.get("width")
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [mi.BSDFFlags.GlossyReflection | sides]
        self.m_flags = self.m_components[0]

    def value(self, si: Any, wo: Any, active: Any) -> Any:
        """The BSDF without the cosine."""
        w = self.albedo.eval(si, active)
        cos_g = dr.clip(dr.dot(si.wi, wo), -1.0, 1.0)
        square = self.b * self.b
        back = (1.0 - square) * (1.0 - 2.0 * self.b * cos_g + square) ** -1.5
        forth = (1.0 - square) * (1.0 + 2.0 * self.b * cos_g + square) ** -1.5
        phase = 0.5 * (1.0 + self.c) * back + 0.5 * (1.0 - self.c) * forth
        tangent = dr.tan(0.5 * dr.acos(cos_g))
        once = phase * (1.0 + self.b0 / (1.0 + tangent / self.h))
        mu0, mu = dr.abs(si.wi.z), dr.abs(wo.z)
        again = multiple(w, mu0) * multiple(w, mu) - 1.0
        same = active & (si.wi.z * wo.z > 0.0)
        return dr.select(same, w / (4.0 * dr.pi * (mu0 + mu)) * (once + again), 0.0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """The value times the cosine."""
        return self.value(si, wo, active) * dr.abs(wo.z)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Half by the cosine, half evenly over the hemisphere."""
        own = 0.5 * (dr.abs(wo.z) * dr.inv_pi + dr.inv_two_pi)
        return dr.select(active & (si.wi.z * wo.z > 0.0), own, 0.0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Both."""
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def sample(self, ctx: Any, si: Any, lobe: Any, u: Any, active: Any = True) -> Any:
        """A direction by that density."""
        cosine = mi.warp.square_to_cosine_hemisphere(u)
        even = mi.warp.square_to_uniform_hemisphere(u)
        up = dr.select(lobe < 0.5, cosine, even)
        sampled = mi.BSDFSample3f()
        sampled.wo = mi.Vector3f(up.x, up.y, dr.mulsign(up.z, si.wi.z))
        sampled.pdf = self.pdf(ctx, si, sampled.wo, active)
        sampled.eta = 1.0
        sampled.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        sampled.sampled_component = mi.UInt32(0)
        is_any = active & (sampled.pdf > 0.0)
        weight = self.eval(ctx, si, sampled.wo, is_any) / sampled.pdf
        return sampled, dr.select(is_any, weight, 0.0)

    def to_string(self) -> str:
        """For messages."""
        return f"HapkeBSDF[b={self.b}, c={self.c}, B0={self.b0}, h={self.h}]"


def register() -> None:
    """Makes `lamina_hapke` known to Mitsuba."""
    mi.register_bsdf("lamina_hapke", HapkeBSDF)
