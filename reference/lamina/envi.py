"""Spectral pictures as files of ENVI: raw numbers band by band, and a header as text."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import xarray as xr

from lamina.program import LaminaError
from lamina.rendered import RADIANCE, read


def to_envi(picture: xr.Dataset | str | Path, out: str | Path) -> list[Path]:
    """Writes the radiance of a spectral picture for ENVI and gives both files that are written.

    `picture` is what `render` or `read` gives, or an EXR. `out` gets 32-bit floats in
    W m-2 sr-1 nm-1, band after band, row after row from the top; the header beside it, with the
    ending `.hdr`, has the middles and the widths of the bands in nm and their names. Raises
    ValueError for a picture without bands.
    """
    data = picture if isinstance(picture, xr.Dataset) else read(picture)
    if "radiance" not in data:
        raise ValueError("the picture has no bands: render it on a spectral film")
    radiance = data["radiance"].transpose("wavelength", "y", "x")
    bands, lines, samples = radiance.shape
    middles = [f"{nm:.6f}" for nm in radiance["wavelength"].values]
    names = radiance["band_name"].values if "band_name" in data.coords else middles
    header = {
        "description": braces([f"{data.attrs.get('title', 'picture')}: radiance in {RADIANCE}"]),
        "samples": samples,
        "lines": lines,
        "bands": bands,
        "header offset": 0,
        "file type": "ENVI Standard",
        "data type": 4,
        "interleave": "bsq",
        "byte order": 0,
        "sensor type": data.attrs.get("sensor", "Unknown"),
        "z plot titles": braces(["Wavelength (nm)", f"Radiance ({RADIANCE})"]),
        "wavelength units": "Nanometers",
        "wavelength": braces(middles),
        "fwhm": braces([f"{nm:.3f}" for nm in radiance["band_width"].values]),
        "band names": braces([str(name) for name in names]),
    }
    out = Path(out)
    about = out.with_suffix(".hdr")
    if about == out:
        raise ValueError(f"{out}: that is the header's name, give the picture another ending")
    # The header last: without it no program takes the numbers for a whole picture.
    about.unlink(missing_ok=True)
    np.ascontiguousarray(radiance.values, dtype="<f4").tofile(out)
    about.write_text(
        "ENVI\n" + "".join(f"{key} = {value}\n" for key, value in header.items()), "utf-8"
    )
    return [out, about]


def braces(entries: list[str]) -> str:
    """A list as ENVI has it, whose entries hold neither commas nor braces."""
    plain = str.maketrans({",": ";", "{": "(", "}": ")", "\n": " "})
    return "{" + ", ".join(entry.translate(plain) for entry in entries) + "}"


def main() -> None:
    """`lamina-envi`: a spectral picture for ENVI."""
    parser = argparse.ArgumentParser(
        prog="lamina-envi",
        description="Writes the bands of a picture for ENVI: numbers band by band, and a header "
        "with wavelengths, widths and names beside them.",
    )
    parser.add_argument("picture", type=Path, help="file of `lamina render`, .exr")
    parser.add_argument("--out", type=Path, required=True, help="file to write, .img")
    given = parser.parse_args()
    try:
        for file in to_envi(given.picture, given.out):
            print(file)
    except (LaminaError, OSError, ValueError) as failure:
        sys.exit(f"lamina-envi: {failure}")


if __name__ == "__main__":
    main()
