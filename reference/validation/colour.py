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
_D65_XY = science.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["D65"]


def xyz_under_d65(wavelengths: Array, values: Array) -> Array:
    """XYZ (Y of the perfect diffuser is 1) of a reflectance or transmittance lit by D65.

    `wavelengths` in nm, rising by 1; `values` of the same shape. By ASTM E308, 360 to 780 nm by
    1 nm; below the first wavelength its value holds.
    """
    spectrum = science.SpectralDistribution(dict(zip(wavelengths, values, strict=True)))
    shape = science.SpectralShape(360, 780, 1)
    spectrum = spectrum.align(shape, extrapolator_kwargs={"method": "Constant"})
    observer, d65 = _OBSERVER.copy().align(shape), _D65.copy().align(shape)
    xyz = science.sd_to_XYZ(spectrum, observer, d65, method="ASTM E308")
    return np.asarray(xyz, dtype=np.float64) / 100.0


def hex_of(xyz: Array) -> str:
    """Encoded sRGB as web pages write it, clipped."""
    srgb = science.XYZ_to_sRGB(xyz)
    return "#" + "".join(f"{round(255.0 * float(c)):02x}" for c in np.clip(srgb, 0.0, 1.0))


def srgb_of_hex(text: str) -> Array:
    """Encoded sRGB in [0, 1] of `#rrggbb`."""
    return np.array([int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])


def lightness_chroma_of_xyz(xyz: Array) -> tuple[float, float]:
    """CIELAB L* and C* of a colour under D65, Y of white 1."""
    lightness, a, b = science.XYZ_to_Lab(xyz, _D65_XY)
    return float(lightness), float(np.hypot(a, b))


def lightness_chroma(linear: Array) -> tuple[float, float]:
    """L* and C* of linear sRGB."""
    xyz = science.RGB_to_XYZ(linear, "sRGB", apply_cctf_decoding=False)
    return lightness_chroma_of_xyz(xyz)


def lightness_chroma_of_srgb(encoded: Array) -> tuple[float, float]:
    """L* and C* of encoded sRGB."""
    return lightness_chroma_of_xyz(science.sRGB_to_XYZ(encoded))


def delta_e_of_xyz(ours: Array, theirs: Array) -> float:
    """ΔE2000 of two colours under D65, Y of white 1."""
    lab = [science.XYZ_to_Lab(xyz, _D65_XY) for xyz in (ours, theirs)]
    return float(science.delta_E(*lab, method="CIE 2000"))


def delta_e_of_hex(ours: str, theirs: str) -> float:
    """ΔE2000 of two colours as web pages write them."""
    return delta_e_of_xyz(*(science.sRGB_to_XYZ(srgb_of_hex(text)) for text in (ours, theirs)))


def xyz_of_bands(bands: list[float]) -> Array | None:
    """XYZ of light of 1 in each band, `[bands, 3]`, or `None` without colour.

    The bands (centres in nm) stand for a spectrum that is linear between them and constant
    beyond. Three bands between 430 and 680 nm are asked for at least.
    """
    centres = np.asarray(bands)
    if ((centres > 430.0) & (centres < 680.0)).sum() < 3:
        return None
    nm = np.arange(380.0, 780.1, 5.0)
    observer = np.asarray(_OBSERVER.copy().align(science.SpectralShape(380, 780, 5)).values)
    hats = np.stack([np.interp(nm, centres, row) for row in np.eye(centres.size)])
    return np.asarray(hats @ observer / observer[:, 1].sum(), dtype=np.float64)


def shown(ours: Array, theirs: Array, bands: list[float]) -> list[Array]:
    """Two pictures `[height, width, bands]` to look at, `[height, width, 3]` within 0 to 1.

    Both have one exposure: all but 0.5 % of the pixels of `theirs` are below white. Light of equal
    energy is white; bands without colour are shown as grey, by their mean.
    """
    to_xyz = xyz_of_bands(bands)
    if to_xyz is None:
        pair = [np.repeat(picture.mean(axis=2)[..., None], 3, axis=2) for picture in (ours, theirs)]
    else:
        white = science.XYZ_to_sRGB(to_xyz.sum(axis=0), apply_cctf_encoding=False)
        pair = [
            science.XYZ_to_sRGB(picture @ to_xyz, apply_cctf_encoding=False) / white
            for picture in (ours, theirs)
        ]
    bright = max(float(np.percentile(pair[1], 99.5)), np.finfo(float).tiny)
    return [
        np.asarray(science.cctf_encoding(np.clip(picture / bright, 0.0, 1.0)), dtype=np.float64)
        for picture in pair
    ]


def delta_e_2000(ours: Array, theirs: Array, bands: list[float]) -> Array | None:
    """ΔE2000 per pixel of two pictures `[height, width, bands]`, or `None` without colour.

    The bands are those of `xyz_of_bands`. The white is the brightest pixel of `theirs`, at
    L* = 100, of the chromaticity of equal energy.
    """
    to_xyz = xyz_of_bands(bands)
    if to_xyz is None:
        return None
    white = to_xyz.sum(axis=0)
    pair = [picture @ to_xyz for picture in (ours, theirs)]
    brightest = max(float(pair[1][:, :, 1].max()), np.finfo(float).tiny)
    x, y = (white / white.sum())[:2]
    lab = [
        science.XYZ_to_Lab(np.maximum(xyz, 0.0) / brightest / white[1], np.array([x, y]))
        for xyz in pair
    ]
    return np.asarray(science.delta_E(lab[0], lab[1], method="CIE 2000"), dtype=np.float64)
