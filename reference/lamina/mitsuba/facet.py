"""Light at a triangle of a smooth surface, so that no closed body leaks.

Written from the section "Shading normals" of `docs/src/theory/paths.md`. A plugin cannot move the
start of a ray, so light that would leave between the plane of the triangle and that of the shading
normal is always mirrored at the triangle. The renderer does that only where no ray may rise.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import drjit as dr
import mitsuba as mi


def normal_of(si: Any) -> Any:
    """The triangle's normal in the shading frame, on the side of the shading normal."""
    normal = si.to_local(si.n)
    return dr.mulsign(normal, normal.z)


def is_between(w: Any, normal: Any) -> Any:
    """Whether a local direction lies between the two planes."""
    return dr.dot(w, normal) * w.z < 0.0


def mirrored(w: Any, normal: Any) -> Any:
    """The mirror image of a local direction at the triangle."""
    return w - 2.0 * dr.dot(w, normal) * normal


def seen(si: Any) -> Any:
    """A hit whose view is on the side of the triangle from which it comes."""
    turned = mi.SurfaceInteraction3f(si)
    turned.wi.z = dr.select(is_between(si.wi, normal_of(si)), -si.wi.z, si.wi.z)
    return turned


def leaving(si: Any, wo: Any) -> Any:
    """The direction in which light leaves that a BSDF sends to `wo`."""
    normal = normal_of(si)
    return dr.select(is_between(wo, normal), mirrored(wo, normal), wo)


def folded(value_and_pdf: Callable[..., tuple[Any, Any]], si: Any, wo: Any, active: Any) -> Any:
    """Value times cosine and density towards `wo`, with the light that is mirrored there."""
    normal = normal_of(si)
    between = is_between(wo, normal)
    value, pdf = value_and_pdf(si, wo, active & ~between)
    beside = dr.abs(wo.z) > 2.0 * dr.abs(dr.dot(wo, normal)) * normal.z
    image = mirrored(wo, normal)
    more, denser = value_and_pdf(si, image, active & ~between & beside)
    return value + more, pdf + denser
