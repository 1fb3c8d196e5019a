"""Leaves in Mitsuba, and hits on them, for tests of the plugins."""

from __future__ import annotations

import math
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

from lamina.mitsuba import leaf_bsdf, plugins

plugins.register()

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "leafmodel" / "optics" / "src" / "prospect_d.csv"
GREEN = {
    "structure": 1.5,
    "chlorophyll": 40.0,
    "carotenoids": 8.0,
    "anthocyanins": 0.0,
    "brown": 0.0,
    "water": 0.01,
    "dry_matter": 0.009,
}
# (eta, across, along) of both faces: equal, unequal, nearly smooth, strongly anisotropic, none.
COATS = (
    ((1.45, 0.3, 0.3), (1.45, 0.3, 0.3)),
    ((1.45, 0.25, 0.12), (1.4, 0.45, 0.45)),
    ((1.5, 0.05, 0.05), (1.35, 0.6, 0.3)),
    ((1.5, 0.1, 0.5), (1.5, 0.1, 0.5)),
    ((1.0, 0.3, 0.3), (1.0, 0.3, 0.3)),
)
VIEWS = tuple(
    (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), side * math.cos(t))
    for t, p, side in ((0.01, 0.0, 1), (0.7, 0.5, 1), (1.3, 2.2, 1), (0.3, 4.0, -1), (1.2, 1.0, -1))
)
NAMES = ["450", "550", "650", "750"]
WAVELENGTHS = (450.0, 550.0, 680.0, 800.0)


def leaf(coats: tuple, **tissue: object) -> mi.BSDF:
    """A leaf with these coats; green contents if nothing is said."""
    spec: dict = {"type": "lamina_leaf", "tissue": "contents", "prospect": str(TABLE), **GREEN}
    if tissue:
        spec = {"type": "lamina_leaf", **tissue}
    for face, values in zip(leaf_bsdf.FACES, coats, strict=True):
        for name, value in zip(("eta", "alpha_across", "alpha_along"), values, strict=True):
            spec[f"{face}_{name}"] = value
    return mi.load_dict(spec)


def spectrum(value: float) -> dict:
    """A constant over every wavelength in use."""
    return {"type": "regular", "wavelength_min": 300.0, "wavelength_max": 2600.0,
            "values": f"{value},{value}"}  # fmt: skip


def measured(coats: tuple, r: float, t: float, ratio: float = 1.0) -> mi.BSDF:
    """A leaf of constant R and T."""
    return leaf(
        coats,
        tissue="measured",
        reflectance=spectrum(r),
        transmittance=spectrum(t),
        abaxial_ratio=spectrum(ratio),
    )


def hit(
    wi: object, along: object = (0.0, 1.0, 0.0), normal: object = (0.0, 0.0, 1.0)
) -> mi.SurfaceInteraction3f:
    """A hit seen from `wi`; `along` is where v grows, `normal` that of the triangle."""
    si = dr.zeros(mi.SurfaceInteraction3f)
    si.wi = mi.Vector3f(wi)
    si.wavelengths = WAVELENGTHS
    si.sh_frame = mi.Frame3f([0, 0, 1])
    si.n = mi.Normal3f(normal)
    si.dp_dv = mi.Vector3f(along)
    si.uv = [0.5, 0.5]
    # Not literals: one compiled kernel then serves all directions.
    dr.make_opaque(si)
    return si


def throughputs(bsdf: mi.BSDF, wi: object, side: int = 768) -> tuple[np.ndarray, np.ndarray]:
    """Hemispherical reflectance and transmittance by sampling, with their standard errors.

    Shape `[2, 4]` each: reflected, transmitted; four wavelengths.
    """
    n = side * side
    i = dr.arange(mi.UInt32, n)
    rng = mi.PCG32(size=n)
    u = (mi.Float(i % side) + rng.next_float32()) / side
    v = (mi.Float(i // side) + rng.next_float32()) / side
    bs, weight = bsdf.sample(mi.BSDFContext(), hit(wi), rng.next_float32(), mi.Point2f(u, v))
    weight = np.array(weight)
    same = np.array(bs.wo.z * wi[2] > 0.0)
    parts = np.stack([np.where(same, weight, 0.0), np.where(same, 0.0, weight)])
    return parts.mean(axis=2), parts.std(axis=2) / np.sqrt(n)
