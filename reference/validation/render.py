"""Renders an exported scene in Mitsuba: per band the mean radiance and its variance.

The picture is rendered in independent passes with seeds of their own; the spread of the passes
gives the variance of their mean, pixel by pixel, whatever the sampler does inside a pass.

**What `specfilm` returns.** Its channel j is ∫ s_j(λ) L(λ) dλ, an integral: the sample's 1/pdf is
multiplied by the response s_j. A response of 1/width over the band therefore gives the mean
radiance of the band, W m⁻² sr⁻¹ nm⁻¹; a test holds this to the closed form of a sky of
known radiance. Wavelengths are drawn from the sum of all responses, which the film resamples at
the finest spacing of any of them: each response is written with `STEPS` intervals, so that the
resampled edges lie within 1/STEPS of the band's width.
"""

from __future__ import annotations

import json
from pathlib import Path
from time import perf_counter

import drjit as dr
import mitsuba as mi
import numpy as np

from validation.picture import Picture, mean_of

# Intervals that a band's response is written with.
STEPS = 64
# A single wavelength is rendered as a band of this width, nm: in float32 a wavelength near
# 2000 nm has steps of 1.2e-4 nm, which are then 2.4e-4 of the band.
LEAST_WIDTH_NM = 0.5
# Path samples a kernel launch: bounds the memory of a pass.
LAUNCH = 1 << 22


def film(width: int, height: int, bands: list[tuple[float, float]]) -> dict:
    """A `specfilm` that returns each band's mean radiance; bands are (centre, width) in nm."""
    spec: dict = {
        "type": "specfilm",
        "width": width,
        "height": height,
        "component_format": "float32",
        "rfilter": {"type": "box"},
    }
    for number, (center, full_width) in enumerate(bands):
        wide = max(full_width, LEAST_WIDTH_NM)
        spec[f"band{number:02d}"] = {
            "type": "regular",
            "wavelength_min": center - 0.5 * wide,
            "wavelength_max": center + 0.5 * wide,
            "values": ",".join([repr(1.0 / wide)] * (STEPS + 1)),
        }
    return spec


def load(folder: Path) -> tuple[mi.Scene, dict]:
    """Loads an exported scene and its `lamina.json`; the leaf BSDF must be registered."""
    facts = json.loads((folder / "lamina.json").read_text(encoding="utf-8"))
    return mi.load_file(str(folder / "scene.xml")), facts


def render(scene: mi.Scene, bands: int, spp: int, passes: int, seed: int) -> Picture:
    """Renders `passes` independent pictures that have `spp` samples a pixel together."""
    each = max(spp // passes, 1)
    began = perf_counter()
    width, height = (int(n) for n in scene.sensors()[0].film().crop_size())
    parts = max(1, -(-width * height * each // LAUNCH))
    while each % parts:
        parts += 1
    pictures = []
    with dr.suspend_grad():
        for number in range(passes):
            sums = np.zeros((height, width, bands))
            for part in range(parts):
                tensor = mi.render(scene, spp=each // parts, seed=seed + number * parts + part)
                sums += np.array(tensor, dtype=np.float64)[:, :, :bands]
            pictures.append(sums / parts)
    return mean_of(pictures, perf_counter() - began, each * passes)
