"""A leaf from scans: `lamina-scans --adaxial A.png --transmitted T.png ... --out FOLDER`.

- In: scans of a leaf's adaxial face and of the light that passes it, on request of the abaxial
  face; millimetres per pixel; what is white.
- Out: a folder with the margin, a map of contents, a scene that shows the leaf, and a report.
- Always true: R + T of every texel is at most 1, since both are PROSPECT's for its contents.
- Left out: holes, relief, and what an RGB picture cannot show: water and dry matter.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lamina.exr import write_channels
from lamina.extras import require
from lamina.program import LaminaError, run, start, toml
from lamina.scan_fit import fit
from lamina.scan_outline import Similarity, leaf_of, registered
from lamina.scan_pictures import White, linear_of, read, reflected

Array = NDArray[np.float64]
# Colours of sRGB that are fitted apart, in steps of one side.
STEPS = 64
# How far sizes of scans may differ, and the margins, of the leaf's length.
SIZES = 0.02
MARGINS = 0.01
# A scan whose mirror image lies so much nearer to the margin shows the other face.
OTHER_FACE = 0.6


def from_scans(
    out: str | Path,
    *,
    adaxial: str | Path,
    transmitted: str | Path,
    mm_per_pixel: float,
    abaxial: str | Path | None = None,
    white: White = 1.0,
    transmitted_white: White | None = None,
    transmitted_face: str = "adaxial",
    base: Sequence[float] | None = None,
    apex: Sequence[float] | None = None,
    map_size: int = 256,
) -> dict[str, Any]:
    """Makes a leaf of scans in the new folder `out`, and gives the report that lies in it.

    Scans are RGB pictures in sRGB, of one flat leaf each on an even background, at `mm_per_pixel`.
    `white` is the reflectance of a pixel with the greatest value, or a patch of a reference,
    `(column, row, width, height, reflectance)` in pixels, of each reflected scan;
    `transmitted_white` is the same of the transmitted one, whose bare background counts as 1
    without it. Scans see the adaxial face, but for `abaxial`, and for the transmitted one with
    `transmitted_face="abaxial"`. `base` and `apex` are pixels of the adaxial scan, where the
    margin's own are wrong. The map has `map_size` texels along the leaf. Raises LaminaError.
    """
    require("scans", "a leaf from scans")
    folder = Path(out)
    checked(folder, mm_per_pixel, map_size, transmitted_face)
    scans = {"adaxial": Path(adaxial), "transmitted": Path(transmitted)}
    if abaxial is not None:
        scans["abaxial"] = Path(abaxial)
    pictures = {name: read(path) for name, path in scans.items()}
    leaves = {name: leaf_of(linear_of(pictures[name]), str(path)) for name, path in scans.items()}
    linear = {}
    for name, path in scans.items():
        given = transmitted_white if name == "transmitted" else white
        linear[name] = reflected(pictures[name], leaves[name][0], given, str(path))
    margin, corners, svg, notes = traced(scans["adaxial"], mm_per_pixel, base, apex)
    length = float(np.ptp(corners[:, 1]))
    places: dict[str, Similarity] = {}
    for name, (_, contour) in leaves.items():
        mirrored = name == "abaxial" or (name == "transmitted" and transmitted_face == "abaxial")
        places[name] = registered(margin, contour, mm_per_pixel, mirrored)
        other = registered(margin, contour, mm_per_pixel, not mirrored).residual_mm
        if other < OTHER_FACE * places[name].residual_mm:
            raise LaminaError(
                f"{scans[name]}: it shows the other face: its mirror image lies {other:.2f} mm "
                f"from the traced margin, and itself {places[name].residual_mm:.2f} mm",
                2,
            )
        size = places[name].scale / places["adaxial"].scale
        agrees(places[name].residual_mm, size, str(scans[name]), mm_per_pixel, length)
    seen = {
        name: texels(linear[name], leaves[name][0], places[name], corners, map_size)
        for name in scans
    }
    both = np.concatenate([seen["adaxial"], seen["transmitted"]], axis=2)
    channels, report = inverted(both)
    report["length_mm"] = length
    report["notes_on_tracing"] = notes
    report["registration"] = {
        name: {"residual_mm": place.residual_mm, "size": place.scale}
        for name, place in places.items()
    }
    ratio = None
    if "abaxial" in seen:
        ratio = float(seen["abaxial"].mean() / seen["adaxial"].mean())
        report["abaxial_ratio"] = ratio
    folder.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-") as here:
        made = Path(here, folder.name)
        made.mkdir()
        (made / "margin.svg").write_text(svg, encoding="utf-8")
        write_channels(made / "contents.exr", channels)
        (made / "scene.toml").write_text(scene(corners, length, map_size, ratio), encoding="utf-8")
        (made / "report.json").write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
        run(["check", made / "scene.toml"])
        made.rename(folder)
    return report


def checked(folder: Path, mm_per_pixel: float, map_size: int, face: str) -> None:
    """Refuses what is wrong before anything is read."""
    if folder.exists():
        raise LaminaError(f"{folder} is there already: name a new folder", 2)
    if not (np.isfinite(mm_per_pixel) and 1e-4 <= mm_per_pixel <= 10):
        raise LaminaError(f"mm_per_pixel is {mm_per_pixel}: it may be 0.0001 to 10", 2)
    if not 16 <= map_size <= 2048:
        raise LaminaError(f"map_size is {map_size}: it may be 16 to 2048", 2)
    if face not in ("adaxial", "abaxial"):
        raise LaminaError(f"transmitted_face is {face!r}: it may be adaxial or abaxial", 2)


def traced(
    path: Path, mm_per_pixel: float, base: Sequence[float] | None, apex: Sequence[float] | None
) -> tuple[Array, Array, str, list[str]]:
    """Even points and corners of the traced margin, mm, base to apex along +y; its SVG; notes."""
    words: list[str | Path] = ["trace", path, "--mm-per-pixel", repr(mm_per_pixel)]
    for flag, place in (("--base", base), ("--apex", apex)):
        if place is not None:
            words += [flag, ",".join(repr(float(number)) for number in place)]
    with TemporaryDirectory() as here:
        lines = Path(here, "leaf.geojson")
        _, notes = start([*words, "--out", lines]).finished()
        features = json.loads(lines.read_text(encoding="utf-8"))["features"]
    margin = next(one for one in features if one["properties"]["kind"] == "margin")
    corners = np.round(np.array(margin["geometry"]["coordinates"][0], float), 4)
    steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    even = np.arange(0.0, along[-1], mm_per_pixel)
    points = np.stack([np.interp(even, along, corners[:, axis]) for axis in (0, 1)], axis=1)
    way = "L".join(f"{x:.4f} {-y:.4f}" for x, y in corners[:-1])
    low, size = corners.min(0), np.ptp(corners, axis=0)
    box = f"{low[0]:.4f} {-low[1] - size[1]:.4f} {size[0]:.4f} {size[1]:.4f}"
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">'
    drawn = f'{svg}<path id="margin" d="M{way}Z"/></svg>\n'
    return points, corners, drawn, notes.splitlines()


def agrees(residual_mm: float, size: float, named: str, mm_per_pixel: float, length: float) -> None:
    """Refuses a scan that is not of the same leaf at the same scale."""
    limit = max(MARGINS * length, 1.5 * mm_per_pixel)
    if residual_mm > limit:
        raise LaminaError(
            f"{named}: its outline lies {residual_mm:.2f} mm from the traced margin; "
            f"at most {limit:.2f} mm are accepted: is it the same leaf, flat, and seen from the "
            "face that was stated?",
            2,
        )
    if abs(size - 1) > SIZES:
        raise LaminaError(
            f"{named}: the leaf is {size:.3f} times as large as in the adaxial scan: all "
            "scans need the same mm_per_pixel",
            2,
        )


def texels(
    linear: Array, leaf: NDArray[np.bool_], place: Similarity, margin: Array, size: int
) -> Array:
    """A scan over the leaf's box, `[rows, columns, 3]`, the first row at the base."""
    from scipy import ndimage

    low, extent = margin.min(0), np.ptp(margin, axis=0)
    columns, rows = (max(2, round(size * side / extent.max())) for side in extent)
    x = low[0] + (np.arange(columns) + 0.5) / columns * extent[0]
    y = low[1] + (np.arange(rows) + 0.5) / rows * extent[1]
    wanted = place.pixels(np.stack(np.meshgrid(x, y), axis=2).reshape(-1, 2))
    # Pixels at the margin are half background: take those within, and continue them outwards.
    inner = ndimage.binary_erosion(leaf, iterations=2)
    nearest = ndimage.distance_transform_edt(~inner, return_indices=True)[1]
    pixels_per_texel = np.sqrt(abs(np.linalg.det(place.matrix))) * extent.max() / size
    spread = 0.5 * np.sqrt(max(pixels_per_texel**2 - 1, 0))
    found = np.empty((rows * columns, 3))
    for channel in range(3):
        filled = linear[:, :, channel][tuple(nearest)]
        smooth = ndimage.gaussian_filter(filled, spread) if spread > 0 else filled
        found[:, channel] = ndimage.map_coordinates(smooth, wanted.T[::-1], order=1, mode="nearest")
    return found.reshape(rows, columns, 3)


def inverted(colours: Array) -> tuple[dict[str, Array], dict[str, Any]]:
    """Channels of a map of contents, and what the report says of the fit."""
    flat = np.clip(colours.reshape(-1, 6), 0, 1)
    # Like colours hold the same: each group is fitted once, at its mean.
    groups = np.round(flat ** (1 / 2.4) * STEPS).astype(int)
    _, member = np.unique(groups, axis=0, return_inverse=True)
    member = member.ravel()
    count = np.bincount(member)
    means = np.stack([np.bincount(member, flat[:, c]) / count for c in range(6)], axis=1)
    fitted = fit(means)
    shape = colours.shape[:2]
    channels = {name: value[member].reshape(shape) for name, value in fitted.contents.items()}
    misfit = float(np.sqrt((fitted.misfit[member] ** 2).mean()))
    report: dict[str, Any] = {
        "colours_fitted": len(means),
        "misfit_rms": misfit,
        "contents": {
            name: {"mean": float(value.mean()), "deviation": float(value.std())}
            for name, value in channels.items()
        },
        "deviation_over_prior": {
            name: float(value[member].mean()) for name, value in fitted.openness.items()
        },
        "not_seen": ["water", "dry_matter"],
    }
    return channels, report


def scene(margin: Array, length: float, size: int, ratio: float | None) -> str:
    """A scene with the leaf in the sun of an even sky; other keys can be set and added."""
    base = margin[np.linalg.norm(margin, axis=1).argmin()]
    apex = margin[np.abs(margin - [0, margin[:, 1].max()]).sum(1).argmin()]
    ends = f"base = {toml([base[0], -base[1]])}, apex = {toml([apex[0], -apex[1]])}"
    factors = ("structure", "chlorophyll", "carotenoids", "water", "dry_matter")
    span = float(np.linalg.norm(apex - base))
    return f"""# A leaf from scans: margin.svg and contents.exr lie beside this file.
format = 1

[leaves.scan]
length_mm = {span!r}
map_size = {max(size, 16)}
{"" if ratio is None else f"abaxial_ratio = {ratio!r}"}
outline.svg = {{ path = "margin.svg", id = "margin", {ends} }}
venation.arcuate = {{ width = 0.0005 }}
# The scan shows its own veins.
veins = {{ {", ".join(f"{name} = 1" for name in factors)} }}
layers.scan = {{ map = "contents.exr" }}

[leaves.scan.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.007

[objects.scan]
leaf = "scan"

[film.rgb]
size = [480, 640]
spp = 64

[camera.orthographic]
position_m = [0, {length / 2000!r}, 0.5]
look_at_m = [0, {length / 2000!r}, 0]
up = [0, 1, 0]
frame = "scan"

[lights.sky.constant]
radiance_w_m2_sr_nm = {{ d65 = 1 }}
"""


def numbers(text: str) -> float | list[float]:
    """A number, or several between commas."""
    found = [float(word) for word in text.split(",")]
    return found[0] if len(found) == 1 else found


def arguments(words: list[str] | None) -> argparse.Namespace:
    """What is to be made of which scans."""
    parser = argparse.ArgumentParser(
        prog="lamina-scans",
        description="Makes a leaf of scans: its margin, what it holds, and a scene with it.",
        allow_abbrev=False,
    )
    parser.add_argument("--adaxial", required=True, help="scan of the adaxial face")
    parser.add_argument("--transmitted", required=True, help="picture of the light that passes")
    parser.add_argument("--abaxial", help="scan of the abaxial face")
    parser.add_argument("--mm-per-pixel", type=float, required=True, help="25.4 over the dpi")
    parser.add_argument(
        "--white",
        type=numbers,
        default=1.0,
        metavar="R|X,Y,W,H,R",
        help="reflectance of the greatest pixel value, or a patch and its reflectance [default: 1]",
    )
    parser.add_argument(
        "--transmitted-white",
        type=numbers,
        metavar="T|X,Y,W,H,T",
        help="the same of the transmitted picture [default: its background is 1]",
    )
    parser.add_argument(
        "--transmitted-face",
        choices=("adaxial", "abaxial"),
        default="adaxial",
        help="face that the transmitted picture shows [default: adaxial]",
    )
    parser.add_argument("--base", type=numbers, metavar="X,Y", help="pixel of the blade's base")
    parser.add_argument("--apex", type=numbers, metavar="X,Y", help="pixel of the blade's tip")
    parser.add_argument(
        "--map-size", type=int, default=256, help="texels along the leaf [default: 256]"
    )
    parser.add_argument("--out", required=True, help="folder to make")
    return parser.parse_args(words)


def main(words: list[str] | None = None) -> int:
    """Makes a leaf of scans; the exit codes of `lamina`."""
    options = vars(arguments(words))
    try:
        report = from_scans(options.pop("out"), **options)
    except LaminaError as error:
        print(f"lamina-scans: {error}", file=sys.stderr)
        return error.code
    except OSError as error:
        print(f"lamina-scans: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    print(json.dumps(report, indent=2))
    return 0


if __name__ == "__main__":
    sys.exit(main())
