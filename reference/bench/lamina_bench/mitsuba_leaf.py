"""An even reflector and transmitter for Mitsuba, `lamina_bench_leaf`, in Python with Dr.Jit.

Import it after the variant is chosen. Its two spectra are independent, both faces are alike, and
directions are drawn by the cosine, to one side or the other by the mean of the spectra.
"""

from __future__ import annotations

import drjit as dr
import mitsuba as mi


class Leaf(mi.BSDF):
    """Reflects `reflectance` and transmits `transmittance`, both evenly in all directions."""

    def __init__(self, props: mi.Properties) -> None:
        super().__init__(props)
        self.reflectance = props["reflectance"]
        self.transmittance = props["transmittance"]
        both = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [
            mi.BSDFFlags.DiffuseReflection | both,
            mi.BSDFFlags.DiffuseTransmission | both,
        ]
        self.m_flags = self.m_components[0] | self.m_components[1]

    def _share(self, r: mi.Spectrum, t: mi.Spectrum) -> mi.Float:
        """Probability of reflection."""
        return dr.mean(r) / dr.maximum(dr.mean(r) + dr.mean(t), 1e-8)

    def sample(self, ctx, si, sample1, sample2, active=True):  # noqa: ANN001, ANN201
        """A direction, its density, and the spectrum over the probability."""
        r = self.reflectance.eval(si, active)
        t = self.transmittance.eval(si, active)
        share = self._share(r, t)
        reflected = sample1 < share
        cosine = mi.Frame3f.cos_theta(si.wi)
        wo = mi.warp.square_to_cosine_hemisphere(sample2)
        density = mi.warp.square_to_cosine_hemisphere_pdf(wo)
        same_side = (cosine > 0.0) == reflected
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo = dr.select(same_side, wo, -wo)
        probability = dr.select(reflected, share, 1.0 - share)
        bs.pdf = density * probability
        bs.eta = 1.0
        bs.sampled_component = dr.select(reflected, mi.UInt32(0), mi.UInt32(1))
        bs.sampled_type = dr.select(
            reflected,
            mi.UInt32(+mi.BSDFFlags.DiffuseReflection),
            mi.UInt32(+mi.BSDFFlags.DiffuseTransmission),
        )
        active = active & (cosine != 0.0) & (bs.pdf > 0.0)
        weight = dr.select(reflected, r, t) / dr.maximum(probability, 1e-8)
        return bs, weight & active

    def eval(self, ctx, si, wo, active=True):  # noqa: ANN001, ANN201
        """The BSDF times the cosine."""
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):  # noqa: ANN001, ANN201
        """Density of `sample`."""
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):  # noqa: ANN001, ANN201
        """Both."""
        r = self.reflectance.eval(si, active)
        t = self.transmittance.eval(si, active)
        share = self._share(r, t)
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        reflected = cos_i * cos_o > 0.0
        active = active & (cos_i * cos_o != 0.0)
        value = dr.select(reflected, r, t) * dr.abs(cos_o) * dr.inv_pi
        density = dr.select(reflected, share, 1.0 - share) * dr.abs(cos_o) * dr.inv_pi
        return value & active, dr.select(active, density, 0.0)

    def to_string(self) -> str:
        """Its name."""
        return "lamina_bench_leaf"


def register() -> None:
    """Makes the plugin known in the present variant."""
    mi.register_bsdf("lamina_bench_leaf", Leaf)
