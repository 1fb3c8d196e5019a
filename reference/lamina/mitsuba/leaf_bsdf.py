"""The leaf BSDF in Mitsuba, as the plugin `lamina_leaf`.

Written from `docs/src/theory/leaf-bsdf.md` and from nothing else, so that agreement with the
renderer says something about both. The letters are that page's; what Mitsuba calls `wi` is the
page's ω_o (towards the camera) and the other way round, and its `eval` has the cosine in it.

Parameters of the plugin:

- `tissue`: `contents`, `map` or `measured`, and with it
  the numbers of `prospect.CONTENTS`; or `map`, an EXR with channels of those names; or
  `reflectance` and `transmittance`, spectra;
- `prospect` (the table's file) and `extrapolate`, for the first two;
- `spread_u`, `spread_v`: one thickness of the blade in texture coordinates, for maps whose light
  spreads sideways (`docs/src/theory/light-spread.md`);
- `abaxial_ratio` or `abaxial_reflectance`: a spectrum; if both are absent, the page's ratio by
  absorptance;
- `half`: `adaxial` or `abaxial`, if this is one face of a closed blade;
- `adaxial_eta`, `adaxial_alpha_across`, `adaxial_alpha_along`, and the same for `abaxial_`.

Import it after the variant is chosen; `register()` makes the plugin known.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np
import OpenImageIO as oiio

from lamina.mitsuba import facet, tissue
from lamina.mitsuba.coat import COUNT_AZIMUTH, COUNT_MU, Coat
from lamina.mitsuba.lookup import Table, bits, cell, nearest
from lamina.mitsuba.prospect import CONTENTS, OPTIONAL, Prospect
from lamina.mitsuba.tissue import Double, Tissue, across, slanted

FACES = ("adaxial", "abaxial")


class ContentsMap:
    """A map over uv of each of `CONTENTS`: bilinear between texels, clamped, row 0 at v = 0."""

    def __init__(self, file: Path) -> None:
        image = oiio.ImageInput.open(str(file))
        if image is None:
            raise RuntimeError(f"{file}: {oiio.geterror()}")
        spec = image.spec()
        pixels = image.read_image(oiio.FLOAT)
        image.close()
        names = list(spec.channelnames)
        self.width, self.height = spec.width, spec.height
        # Two texels at least each way, so that there is a cell to interpolate in.
        self.tables = {}
        for name in CONTENTS:
            # Maps may lack what PROSPECT-D does not have.
            if name in OPTIONAL and name not in names:
                plane = np.zeros((self.height, self.width), dtype=np.float32)
            else:
                plane = np.asarray(pixels)[:, :, names.index(name)]
            plane = np.pad(plane, ((0, self.height == 1), (0, self.width == 1)), mode="edge")
            self.tables[name] = Table(plane)
        self.stride = max(self.width, 2)
        # Mean over the map's own texels.
        size = self.width * self.height
        self.mean = {
            name: float(
                table.host.reshape(-1, self.stride)[: self.height, : self.width].sum(
                    dtype=np.float64
                )
                / size
            )
            for name, table in self.tables.items()
        }

    def at(self, uv: Any) -> dict[str, Any]:
        """The contents at texture coordinates."""
        x, a = cell(mi.Float, uv.x * self.width - 0.5, max(self.width, 2))
        y, b = cell(mi.Float, uv.y * self.height - 0.5, max(self.height, 2))
        corner = y * self.stride + x
        result = {}
        for name, table in self.tables.items():
            low = dr.lerp(table.at(mi.Float, corner), table.at(mi.Float, corner + 1), a)
            corner_up = corner + self.stride
            high = dr.lerp(table.at(mi.Float, corner_up), table.at(mi.Float, corner_up + 1), a)
            result[name] = dr.lerp(low, high, b)
        return result

    def drawn(self, kind: type, u: Any, v: Any, within: list[Any]) -> dict[str, Any]:
        """One texel of four at `u`, `v` of type `kind`, by the weights of interpolation."""
        column = nearest(kind, u * self.width - 0.5 + kind(within[0]), self.width)
        row = nearest(kind, v * self.height - 0.5 + kind(within[1]), self.height)
        if isinstance(column, list):
            corner = [j * self.stride + i for i, j in zip(column, row, strict=True)]
        else:
            corner = row * self.stride + column
        return {name: table.at(kind, corner) for name, table in self.tables.items()}


def five_numbers(uv: Any, wavelengths: Any) -> list[Any]:
    """Numbers in [0, 1) that look random, from the place and the first wavelength."""
    state = bits(uv.x), bits(uv.y) ^ bits(wavelengths[0])
    drawn = []
    for step in range(3):
        state = mi.sample_tea_32(state[0], state[1] ^ (step + 1), 8)
        drawn += [mi.Float(word >> 8) * (1.0 / (1 << 24)) for word in state]
    return drawn[:5]


class LeafBSDF(mi.BSDF):
    """Two faces, one transmittance, a rough coat on each."""

    def __init__(self, props: mi.Properties) -> None:
        mi.BSDF.__init__(self, props)
        self.coats = tuple(
            Coat(
                props.get(f"{face}_eta"),
                props.get(f"{face}_alpha_across"),
                props.get(f"{face}_alpha_along"),
            )
            for face in FACES
        )
        # A cut through the tissue has no coat.
        self.half = None
        self.outer = self.coats
        if "half" in props:
            self.half = FACES.index(str(props.get("half")))
            none = Coat(1.0, 1.0, 1.0)
            self.outer = (self.coats[0], none) if self.half == 0 else (none, self.coats[1])
        # Both faces in one table, the abaxial one behind the adaxial one.
        self.albedo = Table(np.stack([coat.table for coat in self.outer]))
        self.kind = str(props.get("tissue"))
        self.abaxial_ratio = None
        self.spread: tuple[float, float] | None = None
        if "abaxial_ratio" in props:
            self.abaxial_ratio = props.get_unbounded_texture("abaxial_ratio")
        self.abaxial_reflectance = None
        if "abaxial_reflectance" in props:
            self.abaxial_reflectance = props.get_texture("abaxial_reflectance")
        self.shape = tissue.shape()
        if self.kind == "measured":
            self.reflectance = props.get_texture("reflectance")
            self.transmittance = props.get_texture("transmittance")
        else:
            table = mi.file_resolver().resolve(str(props.get("prospect")))
            self.prospect = Prospect(
                Path(str(table)), Double, bool(props.get("extrapolate", False))
            )
            if self.kind == "map":
                if "spread_u" in props:
                    self.spread = float(props.get("spread_u")), float(props.get("spread_v"))
                self.map = ContentsMap(Path(str(mi.file_resolver().resolve(str(props.get("map"))))))
            elif self.kind == "contents":
                self.contents = {
                    name: float(props.get(name, 0.0) if name in OPTIONAL else props.get(name))
                    for name in CONTENTS
                }
            else:
                raise ValueError(f"tissue = {self.kind}, not contents, map or measured")
            mean = self.contents if self.kind == "contents" else self.map.mean
            dry = sum(mean[name] for name in ("dry_matter", "proteins", "carbon_based"))
            self.shape = tissue.shape(mean["structure"], mean["water"], dry)
        if all(coat.eta == 1.0 for coat in self.coats):
            self.shape = tissue.EVEN

        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        varying = mi.BSDFFlags.SpatiallyVarying
        self.m_components = [
            mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.Anisotropic | varying | sides,
            mi.BSDFFlags.DiffuseReflection | varying | sides,
            mi.BSDFFlags.DiffuseTransmission | varying | sides,
        ]
        flags = self.m_components[0]
        for component in self.m_components[1:]:
            flags = flags | component
        self.m_flags = flags

    # What is at a hit

    def spectra(self, si: Any, active: Any) -> tuple[Any, Any]:
        """R and T of the leaf at a hit, at its wavelengths."""
        if self.kind == "measured":
            return (
                Double(self.reflectance.eval(si, active)),
                Double(self.transmittance.eval(si, active)),
            )
        contents = self.contents if self.kind == "contents" else self.map.at(si.uv)
        return self.prospect.spectra(si.wavelengths, contents)

    def tissue(self, si: Any, active: Any) -> Tissue:
        """The tissue at a hit."""
        r, t = self.spectra(si, active)
        below = self.ratio(si, r, t, active) * r
        if self.abaxial_reflectance is not None:
            below = Double(self.abaxial_reflectance.eval(si, active))
        found = tissue.leaf(r, t, below, self.coats, self.shape, self.kind == "measured")
        if self.spread is not None:
            found.lets_through(self.spread_transmittance(si, *self.spread), self.coats[0])
        return found if self.half is None else found.half(self.half)

    def spread_transmittance(self, si: Any, spread_u: float, spread_v: float) -> Any:
        """T at one place from which light at the hit comes, drawn for each wavelength's length."""
        kind = mi.UnpolarizedSpectrum
        mean = self.map.mean
        absorbed = self.prospect.absorbed(si.wavelengths, mean)
        scattering = 1.0 + 0.18 * (mean["structure"] - 1.0)
        length = kind(0.81 / scattering * dr.exp(dr.log(1.0 + 6.2 * absorbed) * (-1.0 / 3.0)))
        u1, u2, turn, *within = five_numbers(si.uv, si.wavelengths)
        away = length * kind(-dr.log((1.0 - u1) * (1.0 - u2)))
        s, c = dr.sincos(dr.two_pi * turn)
        u, v = away * kind(c * spread_u), away * kind(s * spread_v)
        at_u, at_v = kind(si.uv.x), kind(si.uv.y)
        there = self.map.drawn(kind, at_u + u, at_v + v, within)
        opposite = self.map.drawn(kind, at_u - u, at_v - v, within)
        here = self.map.drawn(kind, at_u, at_v, within)
        # Texels without tissue are outside the blade.
        first, second = there["structure"] >= 1.0, opposite["structure"] >= 1.0
        entered = {
            name: dr.select(first, there[name], dr.select(second, opposite[name], here[name]))
            for name in CONTENTS
        }
        return self.prospect.spectra(si.wavelengths, entered)[1]

    def ratio(self, si: Any, r: Any, t: Any, active: Any) -> Any:
        """Abaxial over adaxial reflectance at a hit."""
        if self.abaxial_ratio is not None:
            return Double(self.abaxial_ratio.eval(si, active))
        absorbed = dr.clip(1.0 - r - t, 0.0, 1.0)
        return 1.0 + 0.7 * absorbed * absorbed * (3.0 - 2.0 * absorbed)

    @staticmethod
    def axes(si: Any) -> tuple[Any, Any]:
        """Cosine and sine of the turn from the page's x, y axes to Mitsuba's, about z.

        The page's +y is ∂p/∂v made orthogonal to the normal. Without texture coordinates any
        direction will do.
        """
        along = si.to_local(si.dp_dv)
        length = dr.sqrt(along.x * along.x + along.y * along.y)
        good = length > 0.0
        scale = dr.rcp(dr.select(good, length, 1.0))
        return dr.select(good, along.y * scale, 1.0), dr.select(good, along.x * scale, 0.0)

    # The coat. Directions below are in the page's frame, mirrored to z > 0.

    def face(self, adaxial: Any, name: str) -> Any:
        """A number of the face's coat."""
        return dr.select(adaxial, getattr(self.outer[0], name), getattr(self.outer[1], name))

    def coat_albedo(self, w: Any, adaxial: Any) -> Any:
        """E of a face's coat."""
        row, a = cell(mi.Float, dr.sqrt(w.z) * (COUNT_MU - 1.0), COUNT_MU)
        azimuth = dr.atan2(dr.abs(w.y), dr.abs(w.x)) * (2.0 / dr.pi * (COUNT_AZIMUTH - 1.0))
        column, b = cell(mi.Float, azimuth, COUNT_AZIMUTH)
        size = COUNT_MU * COUNT_AZIMUTH
        at = dr.select(adaxial, mi.UInt32(0), mi.UInt32(size)) + row * COUNT_AZIMUTH + column
        e = [self.albedo.at(mi.Float, at + step) for step in (0, 1)]
        e += [self.albedo.at(mi.Float, at + COUNT_AZIMUTH + step) for step in (0, 1)]
        return dr.lerp(dr.lerp(e[0], e[1], b), dr.lerp(e[2], e[3], b), a)

    def smith(self, w: Any, adaxial: Any) -> Any:
        """Smith's Λ."""
        x = self.face(adaxial, "alpha_x") * w.x
        y = self.face(adaxial, "alpha_y") * w.y
        return 0.5 * (dr.sqrt(1.0 + (x * x + y * y) / (w.z * w.z)) - 1.0)

    def distribution(self, h: Any, adaxial: Any) -> Any:
        """D(h)."""
        a_x, a_y = self.face(adaxial, "alpha_x"), self.face(adaxial, "alpha_y")
        x, y = h.x / a_x, h.y / a_y
        inner = x * x + y * y + h.z * h.z
        return dr.rcp(dr.pi * a_x * a_y * inner * inner)

    def coat_times_cosine(self, view: Any, light: Any, adaxial: Any) -> Any:
        """f_coat μ_i."""
        h = dr.normalize(view + light)
        f, _, _, _ = mi.fresnel(dr.dot(view, h), self.face(adaxial, "eta"))
        g = dr.rcp(1.0 + self.smith(view, adaxial) + self.smith(light, adaxial))
        return self.distribution(h, adaxial) * g * f / (4.0 * view.z)

    def coat_pdf(self, view: Any, light: Any, adaxial: Any) -> Any:
        """Density of directions mirrored at the normals that are visible from `view`."""
        h = dr.normalize(view + light)
        g1 = dr.rcp(1.0 + self.smith(view, adaxial))
        return self.distribution(h, adaxial) * g1 / (4.0 * view.z)

    def sample_coat(self, view: Any, u: Any, adaxial: Any) -> Any:
        """Mirrors `view` at a visible normal (spherical cap of Dupuy and Benyoub 2023)."""
        a_x, a_y = self.face(adaxial, "alpha_x"), self.face(adaxial, "alpha_y")
        v = dr.normalize(mi.Vector3f(a_x * view.x, a_y * view.y, view.z))
        z = (1.0 - u.y) * (1.0 + v.z) - v.z
        ring = dr.safe_sqrt(1.0 - z * z)
        s, c = dr.sincos(dr.two_pi * u.x)
        h = mi.Vector3f(ring * c, ring * s, z) + v
        h = dr.normalize(mi.Vector3f(a_x * h.x, a_y * h.y, dr.maximum(h.z, 1e-7)))
        return 2.0 * dr.dot(view, h) * h - view

    # Frames

    @staticmethod
    def to_page(w: Any, axes: tuple[Any, Any]) -> Any:
        """From Mitsuba's shading frame to the page's."""
        c, s = axes
        return mi.Vector3f(c * w.x - s * w.y, s * w.x + c * w.y, w.z)

    @staticmethod
    def mirrored(w: Any, axes: tuple[Any, Any]) -> Any:
        """From Mitsuba's shading frame to the page's, z made positive."""
        c, s = axes
        return mi.Vector3f(c * w.x - s * w.y, s * w.x + c * w.y, dr.abs(w.z))

    @staticmethod
    def returned(w: Any, axes: tuple[Any, Any], adaxial: Any) -> Any:
        """The way back, to a side."""
        c, s = axes
        return mi.Vector3f(c * w.x + s * w.y, c * w.y - s * w.x, dr.select(adaxial, w.z, -w.z))

    # Mitsuba's interface

    def lobes(self, e: Any, found: Tissue, adaxial: Any) -> tuple[Any, Any]:
        """Probability of the coat's lobe, and of reflection if it is the tissue's."""
        r, t = found.chances(adaxial)
        both = r + t
        weight = e + (1.0 - e) * both
        coat = dr.select(weight > 0.0, e / dr.select(weight > 0.0, weight, 1.0), 0.0)
        back = dr.select(both > 0.0, r / dr.select(both > 0.0, both, 1.0), 0.5)
        return coat, back

    def value_and_pdf(self, si: Any, wo: Any, active: Any) -> tuple[Any, Any]:
        """The BSDF times the cosine, and the density of `sample`."""
        cos_view, cos_light = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = active & (cos_view != 0.0) & (cos_light != 0.0)
        adaxial, same = cos_view > 0.0, cos_view * cos_light > 0.0
        axes = self.axes(si)
        # Both are shifted off z = 0 where they are not used, so that nothing is divided by 0.
        view = self.mirrored(dr.select(active, si.wi, mi.Vector3f(0, 0, 1)), axes)
        light = self.mirrored(dr.select(active, wo, mi.Vector3f(0, 0, 1)), axes)

        e_view = self.coat_albedo(view, adaxial)
        e_light = self.coat_albedo(light, cos_light > 0.0)
        found = self.tissue(si, active)
        slants = slanted(view.z), slanted(light.z), across(view, light)
        base = dr.select(
            same,
            found.back(adaxial, found.passing, *slants),
            found.through(adaxial, found.passing, *slants),
        )
        base *= Double((1.0 - e_view) * (1.0 - e_light) * light.z / dr.pi)
        coat = dr.select(same, self.coat_times_cosine(view, light, adaxial), 0.0)
        value = mi.UnpolarizedSpectrum(base) + coat

        p_coat, p_back = self.lobes(e_view, found, adaxial)
        pdf = (1.0 - p_coat) * dr.select(same, p_back, 1.0 - p_back) * light.z / dr.pi
        pdf = pdf + dr.select(same, p_coat * self.coat_pdf(view, light, adaxial), 0.0)
        return dr.select(active, value, 0.0), dr.select(active, pdf, 0.0)

    def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> Any:
        """Draws a direction; gives it with value over density."""
        si = facet.seen(si)
        cos_view = mi.Frame3f.cos_theta(si.wi)
        active = mi.Bool(active) & (cos_view != 0.0)
        adaxial = cos_view > 0.0
        axes = self.axes(si)
        view = self.mirrored(dr.select(active, si.wi, mi.Vector3f(0, 0, 1)), axes)
        e = self.coat_albedo(view, adaxial)
        p_coat, p_back = self.lobes(e, self.tissue(si, active), adaxial)

        in_coat = sample1 < p_coat
        reflected = sample1 - p_coat < (1.0 - p_coat) * p_back
        mirrored = self.sample_coat(view, sample2, adaxial)
        diffuse = mi.warp.square_to_cosine_hemisphere(sample2)
        local = dr.select(in_coat, mirrored, diffuse)
        active &= local.z > 0.0
        side = adaxial == (in_coat | reflected)
        wo = facet.leaving(si, self.returned(local, axes, side))

        value, pdf = facet.folded(self.value_and_pdf, si, wo, active)
        active &= pdf > 0.0
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo = wo
        bs.pdf = dr.select(active, pdf, 0.0)
        bs.eta = 1.0
        bs.sampled_type = dr.select(
            in_coat,
            mi.UInt32(+mi.BSDFFlags.GlossyReflection),
            dr.select(
                reflected,
                mi.UInt32(+mi.BSDFFlags.DiffuseReflection),
                mi.UInt32(+mi.BSDFFlags.DiffuseTransmission),
            ),
        )
        bs.sampled_component = dr.select(
            in_coat, mi.UInt32(0), dr.select(reflected, mi.UInt32(1), mi.UInt32(2))
        )
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
        """The leaf has no parameters that are changed after loading."""

    def to_string(self) -> str:
        """For messages."""
        return f"LeafBSDF[{self.kind}, {self.coats}]"


def register() -> None:
    """Makes `lamina_leaf` known to Mitsuba."""
    mi.register_bsdf("lamina_leaf", LeafBSDF)
