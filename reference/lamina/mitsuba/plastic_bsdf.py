"""A diffuse body below a rough coat in Mitsuba, as the plugin `lamina_plastic`.

Written from `docs/src/theory/leaf-bsdf.md` ("A body below a coat"): it is a leaf that lets nothing
through, with one coat on both sides, whose r is given.

Parameters of the plugin:

- `reflectance`: a spectrum or a texture, r of the page;
- `eta`, `alpha`: the coat, the same in all directions.

Import it after the variant is chosen; `register()` makes the plugin known.
"""

from __future__ import annotations

from typing import Any

import mitsuba as mi
import numpy as np

from lamina.mitsuba.coat import Coat
from lamina.mitsuba.leaf_bsdf import LeafBSDF
from lamina.mitsuba.lookup import Table
from lamina.mitsuba.tissue import Double, Tissue, body


class PlasticBSDF(LeafBSDF):
    """A body that sends back a share of what has passed its coat; both sides are alike."""

    def __init__(self, props: mi.Properties) -> None:
        mi.BSDF.__init__(self, props)
        alpha = props.get("alpha")
        self.coats = (Coat(props.get("eta"), alpha, alpha),) * 2
        self.outer = self.coats
        self.albedo = Table(np.stack([coat.table for coat in self.coats]))
        self.kind = "plastic"
        self.reflectance = props.get_texture("reflectance")

        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        varying = mi.BSDFFlags.SpatiallyVarying
        # The last has no light; the leaf's code has a place for it.
        self.m_components = [
            mi.BSDFFlags.GlossyReflection | varying | sides,
            mi.BSDFFlags.DiffuseReflection | varying | sides,
            mi.BSDFFlags.DiffuseTransmission | varying | sides,
        ]
        self.m_flags = self.m_components[0] | self.m_components[1] | self.m_components[2]

    def tissue(self, si: Any, active: Any) -> Tissue:
        """The body at a hit."""
        return body(Double(self.reflectance.eval(si, active)), self.coats[0])

    def to_string(self) -> str:
        """For messages."""
        return f"PlasticBSDF[{self.coats[0]}]"


def register() -> None:
    """Makes `lamina_plastic` known to Mitsuba."""
    mi.register_bsdf("lamina_plastic", PlasticBSDF)
