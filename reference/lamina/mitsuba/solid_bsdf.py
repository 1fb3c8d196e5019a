"""Solid tissue in Mitsuba, as the plugin `lamina_solid`.

Written from `docs/src/theory/solid-tissue.md` and `docs/src/theory/leaf-bsdf.md`: it is a leaf that
lets nothing through, whose reflectance is that of a half-space of `half_space`.

Parameters of the plugin:

- `tissue`: `contents` or `map`, and with it the numbers of `prospect.CONTENTS`, or `map`, an EXR
  with channels of those names;
- `prospect` (the table's file) and `extrapolate`;
- `depth_mm`, `scattering_per_mm`, `eta`: the half-space;
- `coat_eta`, `coat_alpha`: the skin's surface, the same in all directions.

Import it after the variant is chosen; `register()` makes both plugins known.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from lamina.mitsuba import half_space, leaf_bsdf
from lamina.mitsuba.coat import Coat
from lamina.mitsuba.leaf_bsdf import ContentsMap, LeafBSDF
from lamina.mitsuba.lookup import Table, cell
from lamina.mitsuba.prospect import CONTENTS, OPTIONAL, Prospect
from lamina.mitsuba.tissue import Double, Tissue, body, under_coat


class SolidBSDF(LeafBSDF):
    """A half-space of pigments below a rough coat; both sides are alike."""

    def __init__(self, props: mi.Properties) -> None:
        mi.BSDF.__init__(self, props)
        alpha = props.get("coat_alpha")
        self.coats = (Coat(props.get("coat_eta"), alpha, alpha),) * 2
        self.outer = self.coats
        self.albedo = Table(np.stack([coat.table for coat in self.coats]))
        self.depth = float(props.get("depth_mm"))
        self.scattering = float(props.get("scattering_per_mm"))
        self.solved = Table(half_space.table(float(props.get("eta"))), double=True)
        resolve = mi.file_resolver().resolve
        extrapolate = bool(props.get("extrapolate", False))
        table = Path(str(resolve(str(props.get("prospect")))))
        self.prospect = Prospect(table, Double, extrapolate)
        self.kind = str(props.get("tissue"))
        if self.kind == "map":
            self.map = ContentsMap(Path(str(resolve(str(props.get("map"))))))
        elif self.kind == "contents":
            self.contents = {
                name: float(props.get(name, 0.0) if name in OPTIONAL else props.get(name))
                for name in CONTENTS
            }
        else:
            raise ValueError(f"tissue = {self.kind}, not contents or map")

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
        contents = self.contents if self.kind == "contents" else self.map.at(si.uv)
        coat = self.coats[0]
        return body(under_coat(self.reflectance(si.wavelengths, contents), coat), coat)

    def reflectance(self, wavelengths: Any, contents: dict[str, Any]) -> Any:
        """R of tissue with these contents at `wavelengths` (nm)."""
        absorbed = self.prospect.absorbed(wavelengths, contents) / self.depth
        root = dr.sqrt(dr.maximum(absorbed / (self.scattering + absorbed), 0.0))
        at, share = cell(Double, root * (half_space.COUNT - 1.0), half_space.COUNT)
        above = at + 1 if not isinstance(at, list) else [i + 1 for i in at]
        low = self.solved.at(Double, at)
        r = low + share * (self.solved.at(Double, above) - low)
        if not self.prospect.extrapolate:
            known = (wavelengths >= self.prospect.first) & (wavelengths <= self.prospect.last)
            r = dr.select(known, r, 0.0)
        return r

    def to_string(self) -> str:
        """For messages."""
        return f"SolidBSDF[{self.kind}, {self.coats[0]}]"


def register() -> None:
    """Makes `lamina_leaf` and `lamina_solid` known to Mitsuba."""
    leaf_bsdf.register()
    mi.register_bsdf("lamina_solid", SolidBSDF)
