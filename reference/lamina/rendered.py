"""Pictures as arrays with units and coordinates."""

from __future__ import annotations

import re
import tempfile
import tomllib
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import xarray as xr

from lamina.conventions import BANDS, PIXELS, WAVELENGTH, about, without_fill_values
from lamina.program import Folders, Value, allowing, overrides, run

# Spectral EXR layout of Fichet, Pacanowski and Wilkie (JCGT 10:3, 2021): emissive, unpolarised; the
# decimal point is a comma.
BAND = re.compile(r"^(?P<layer>\w+\.)?S0\.(?P<whole>\d+),(?P<part>\d+)nm$")

# Layers of three channels: name of the variable, its unit, what it is, its axis, the axis' labels.
TRIPLES = {
    "": ("colour", "1", "linear sRGB", "channel", "RGB"),
    "variance": ("colour_variance", "1", "variance of the mean colour", "channel", "RGB"),
    "albedo": ("albedo", "1", "albedo of what is seen first", "channel", "RGB"),
    "N": ("normal", "1", "normal of what is seen first", "axis", "XYZ"),
    "P": ("position", "m", "place of what is seen first", "axis", "XYZ"),
}
SINGLES = {
    "A": ("coverage", "1", "fraction of the pixel that objects cover"),
    "albedo.Y": ("mean_albedo", "1", "albedo of what is seen first, mean over the bands"),
    "depth.Z": ("depth", "m", "distance of what is seen first from the camera"),
    "height.Z": ("height", "m", "height of what is seen first"),
    "id.object": ("object", "1", "number of the object that is seen first"),
    "samples.Y": ("samples", "1", "samples of the pixel"),
    "variance.Y": ("luminance_variance", "1", "variance of the mean luminance"),
}
# Of axes of words.
LABELS = {"channel": "channel of colour", "axis": "axis of the scene"}
RADIANCE = "W m-2 sr-1 nm-1"


def render(
    scene: str | Path,
    values: Mapping[str, Value] | None = None,
    *,
    out: str | Path | None = None,
    spp: int | None = None,
    noise: float | None = None,
    seconds: float | None = None,
    seed: int | None = None,
    threads: int | None = None,
    allow: Folders = (),
) -> xr.Dataset:
    """Renders a scene and gives its picture.

    `values` sets keys as `lamina render -D` does: `{"film.rgb.size": [320, 240]}`. `out` keeps the
    EXR and the PNG under this stem; without it they are deleted once they are read. `allow` names
    folders outside of the scene's own whose files it may name too. The other arguments are the
    program's flags. See `read` for what is in the picture. Raises LaminaError.
    """
    arguments = ["render", str(scene), *overrides("-D", values), *allowing(allow)]
    flags = {
        "--spp": spp,
        "--noise": noise,
        "--time": seconds,
        "--seed": seed,
        "--threads": threads,
    }
    for flag, value in flags.items():
        if value is not None:
            arguments += [flag, str(value)]
    with tempfile.TemporaryDirectory() as folder:
        stem = Path(out) if out is not None else Path(folder, "picture")
        stem = stem.with_suffix("") if stem.suffix in (".exr", ".png") else stem
        run([*arguments, "--out", str(stem)])
        return read(stem.with_name(stem.name + ".exr"))


def read(file: str | Path) -> xr.Dataset:
    """The layers of an EXR of the program's.

    Dimensions are `y` and `x` (pixels, from the top left corner), and `wavelength` (nm) for a
    spectral film, `channel` (R, G, B) for a colour film, `axis` (X, Y, Z) for places and
    directions. Along `wavelength` lie the full widths of the bands in nm, `band_width`, and a
    sensor's names of them, `band_name`. `radiance` and `radiance_variance`, or `colour` and
    `colour_variance`: means over samples and the variances of those means, by batches of samples;
    `luminance_variance`: that of the mean luminance (of a spectral film, of the mean over bands),
    with what their even spread gains; then `coverage`, `depth`, `normal`, `position`,
    `albedo` (of a spectral film `mean_albedo`, over its bands), `object` and `samples`. Each has
    its `units`; what the program wrote about the render is in `attrs`. Raises OSError for a file
    that is no EXR.
    """
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise OSError(f"{file}: {oiio.geterror()}")
    spec = image.spec()
    pixels = np.asarray(image.read_image(oiio.FLOAT))
    image.close()
    layers: dict[str, xr.DataArray] = {}
    spectral: dict[str, list[tuple[float, int]]] = {}
    for number, name in enumerate(spec.channelnames):
        if band := BAND.match(name):
            layer = (band["layer"] or "").rstrip(".")
            centre = float(f"{band['whole']}.{band['part']}")
            spectral.setdefault(layer, []).append((centre, number))
        elif name in SINGLES:
            key, unit, words = SINGLES[name]
            layers[key] = xr.DataArray(
                pixels[:, :, number], dims=("y", "x"), attrs={"units": unit, "long_name": words}
            )
    if spectral and "luminance_variance" in layers:
        layers["luminance_variance"].attrs["units"] = f"({RADIANCE})2"
    for layer, bands in spectral.items():
        bands.sort()
        name = "radiance" if not layer else f"radiance_{layer}"
        is_variance = layer == "variance"
        layers[name] = xr.DataArray(
            pixels[:, :, [number for _, number in bands]],
            dims=("y", "x", "wavelength"),
            coords={"wavelength": ("wavelength", [band for band, _ in bands], WAVELENGTH)},
            attrs={
                "units": f"({RADIANCE})2" if is_variance else RADIANCE,
                "long_name": "variance of the mean spectral radiance"
                if is_variance
                else "spectral radiance",
            },
        )
    numbers = {name: number for number, name in enumerate(spec.channelnames)}
    for layer, (name, unit, words, axis, labels) in TRIPLES.items():
        channels = [f"{layer}.{label}" if layer else label for label in labels]
        if all(channel in numbers for channel in channels):
            layers[name] = xr.DataArray(
                pixels[:, :, [numbers[channel] for channel in channels]],
                dims=("y", "x", axis),
                coords={axis: (axis, list(labels), {"long_name": LABELS[axis]})},
                attrs={"units": unit, "long_name": words},
            )
    for name in ("radiance", "colour"):
        if f"{name}_variance" in layers:
            layers[name].attrs["ancillary_variables"] = f"{name}_variance"
    told = {
        attribute.name.removeprefix("lamina:"): attribute.value
        for attribute in spec.extra_attribs
        if attribute.name.startswith("lamina:")
    }
    software, name = spec.get_string_attribute("Software"), str(told.get("sceneName", "picture"))
    made = f"render of {name}, seed {told.get('seed')}, {told.get('spp')} samples per pixel"
    picture = xr.Dataset(
        layers,
        coords={
            axis: (axis, np.arange(count), PIXELS[axis])
            for axis, count in zip(("y", "x"), pixels.shape, strict=False)
        },
        attrs={**about(name, software, made), "software": software, **told},
    )
    if "wavelength" in picture.dims:
        picture = picture.assign_coords(bands_of(picture))
    return without_fill_values(picture)


def bands_of(picture: xr.Dataset) -> dict[str, tuple[str, object, dict[str, str]]]:
    """Coordinates along the wavelengths: full widths of the bands, and a sensor's names of them."""
    if "bands" in picture.attrs:
        # A name may have spaces.
        rows = [line.rsplit(" ", 2) for line in str(picture.attrs["bands"]).splitlines()]
        rows.sort(key=lambda row: float(row[1]))
        names, _, widths = zip(*rows, strict=True)
        return {
            "band_name": ("wavelength", np.array(names), BANDS["band_name"]),
            "band_width": ("wavelength", np.array(widths, dtype=float), BANDS["band_width"]),
        }
    film = tomllib.loads(str(picture.attrs.get("scene", ""))).get("film", {}).get("spectral", {})
    even = np.full(picture.sizes["wavelength"], float(film.get("band_width_nm", 10)))
    return {"band_width": ("wavelength", even, BANDS["band_width"])}
