"""Colours of spectra and of spectral pictures, by colour-science.

The package is asked for its own observer and illuminant, and for its own integration, so that it
can check what the renderer makes of the same spectra.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray

with warnings.catch_warnings():
    # It says at import that there is no matplotlib, which nothing here needs.
    warnings.simplefilter("ignore")
    import colour as science

Array = NDArray[np.float64]

_OBSERVER = science.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
_D65 = science.SDS_ILLUMINANTS["D65"]


def srgb_under_d65(wavelengths: Array, values: Array) -> Array:
    """Linear sRGB (white is 1, 1, 1) of a reflectance or transmittance lit by D65.

    `wavelengths` in nm, rising by a constant step; `values` of the same shape. Not clipped.
    """
    spectrum = science.SpectralDistribution(dict(zip(wavelengths, values, strict=True)))
    shape = science.SpectralShape(380, 780, 5)
    xyz = science.sd_to_XYZ(
        spectrum.align(shape), _OBSERVER.copy().align(shape), _D65.copy().align(shape)
    )
    return np.asarray(science.XYZ_to_RGB(xyz / 100.0, "sRGB"), dtype=np.float64)


def delta_e_2000(ours: Array, theirs: Array, bands: list[float]) -> Array | None:
    """ΔE2000 per pixel of two pictures `[height, width, bands]`, or `None` without colour.

    The bands (centres in nm) stand for a spectrum that is linear between them and constant
    beyond. The white is the brightest pixel of `theirs`, at L* = 100, of the chromaticity of
    equal energy. Three bands between 430 and 680 nm are asked for at least.
    """
    centres = np.asarray(bands)
    if ((centres > 430.0) & (centres < 680.0)).sum() < 3:
        return None
    nm = np.arange(380.0, 780.1, 5.0)
    observer = np.asarray(_OBSERVER.copy().align(science.SpectralShape(380, 780, 5)).values)
    hats = np.stack([np.interp(nm, centres, row) for row in np.eye(centres.size)])
    to_xyz = hats @ observer / observer[:, 1].sum()
    white = to_xyz.sum(axis=0)
    pair = [picture @ to_xyz for picture in (ours, theirs)]
    brightest = max(float(pair[1][:, :, 1].max()), np.finfo(float).tiny)
    x, y = (white / white.sum())[:2]
    lab = [
        science.XYZ_to_Lab(np.maximum(xyz, 0.0) / brightest / white[1], np.array([x, y]))
        for xyz in pair
    ]
    return np.asarray(science.delta_E(lab[0], lab[1], method="CIE 2000"), dtype=np.float64)
