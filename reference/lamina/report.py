"""Reports as one HTML file that needs nothing else: `lamina-report`, `python -m lamina.report`.

    lamina-report A.exr B.exr --out report.html         two pictures
    lamina-report FOLDER --out report.html              a sweep, or results of reference/compare

Pictures lie one over the other with a border to move; differences and z are maps (blue: the first
is less; red: it is more); numbers are tables; how to make the same again stands below.
"""

from __future__ import annotations

import argparse
import base64
import csv
import json
import shlex
import statistics
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio
import xarray as xr
from numpy.typing import NDArray

from lamina.extras import require
from lamina.plots import plot
from lamina.program import LaminaError, run, version
from lamina.rendered import read

Array = NDArray[np.float64]
# Tasks of a sweep whose pictures are shown, and most rows of its table.
MOST_PICTURES = 60
MOST_ROWS = 2000
Section = dict[str, Any]


def report(paths: Sequence[str | Path], out: str | Path) -> Path:
    """Writes the report of two EXR pictures, of a folder by `lamina sweep`, or of one with results
    of `reference/compare`; gives the file.

    Raises ValueError for anything else, OSError for files that cannot be read.
    """
    require("report", "a report")
    places = [Path(path) for path in paths]
    if len(places) == 2 and all(place.suffix == ".exr" for place in places):
        title, summary, sections = two_pictures(*places)
    elif len(places) == 1 and (places[0] / "sweep.csv").is_file():
        title, summary, sections = of_sweep(places[0])
    elif len(places) == 1 and places[0].is_dir():
        title, summary, sections = of_comparison(places[0])
    else:
        raise ValueError(
            "give two EXR files, a folder of lamina sweep, or one with results of reference/compare"
        )
    from jinja2 import Environment, PackageLoader, StrictUndefined

    pages = Environment(
        loader=PackageLoader("lamina", "."), autoescape=True, undefined=StrictUndefined
    )
    usual = {
        "verdict": "",
        "good": True,
        "lines": [],
        "pair": [],
        "maps": [],
        "plots": [],
        "head": [],
        "rows": [],
        "reproduce": "",
        "texts": [],
    }
    text = pages.get_template("report.html").render(
        title=title,
        summary=summary,
        sections=[usual | section for section in sections],
        software=f"Lamina {version()}",
    )
    file = Path(out)
    half = file.with_name(f".{file.name}.part")
    half.write_text(text, encoding="utf-8")
    half.replace(file)
    return file


def two_pictures(first: Path, second: Path) -> tuple[str, str, list[Section]]:
    """Title, summary and the section of two pictures."""
    a, b = read(first), read(second)
    for place, picture in ((first, a), (second, b)):
        if "denoised" in picture.attrs:
            raise ValueError(f"{place} is denoised: its error is not known")
    layer = next((name for name in ("radiance", "colour") if name in a and name in b), None)
    if layer is None or a[layer].shape != b[layer].shape:
        raise ValueError(f"{first} and {second} are no pictures of one size and kind of film")
    bands = [
        f"{label:g} nm" if layer == "radiance" else str(label)
        for label in a[layer][a[layer].dims[-1]].values
    ]
    mine, other = (picture[layer].values.astype(float) for picture in (a, b))
    variances = [picture[f"{layer}_variance"].values.astype(float) for picture in (a, b)]
    variance = variances[0] + variances[1]
    z = (mine - other) / np.sqrt(np.where(variance > 0, variance, np.inf))
    count = mine[..., 0].size
    rows, maps = [], []
    for number, band in enumerate(bands):
        means = mine[..., number].mean(), other[..., number].mean()
        error = float(np.sqrt(variance[..., number].sum())) / count
        difference = float(means[0] - means[1])
        scale = max(abs(float(means[1])), np.finfo(float).tiny)
        level = difference / error if error > 0 else 0.0
        rows.append(
            [band, f"{means[0]:.5g}", f"{means[1]:.5g}", f"{100 * difference / scale:+.3f}"]
            + [f"{100 * error / scale:.3f}", f"{level:+.2f}"]
            + [f"{100 * float((np.abs(z[..., number]) < 3).mean()):.2f}"]
        )
        relative = (mine[..., number] - other[..., number]) / scale
        maps.append(picture_of(diverging(relative / 0.2), f"difference at {band}, full at ±20 %"))
        maps.append(picture_of(diverging(z[..., number] / 4), f"z at {band}, full at ±4"))
    section: Section = {
        "title": f"{first.name} and {second.name}",
        "lines": [f"{mine.shape[1]} × {mine.shape[0]} pixels"],
        "pair": [shown(first), shown(second)],
        "maps": maps,
        "head": ["band", first.stem, second.stem, "difference %", "± %", "z", "pixels |z| < 3, %"],
        "rows": rows,
        "reproduce": "\n".join(
            command_of(picture, path) for picture, path in ((a, first), (b, second))
        ),
        "texts": [
            (f"The scene of {path.name}", str(picture.attrs.get("scene", "")))
            for picture, path in ((a, first), (b, second))
        ],
    }
    return f"{first.name} against {second.name}", "Two pictures, number by number.", [section]


def command_of(picture: xr.Dataset, path: Path) -> str:
    """How a picture was made, by what it tells of itself."""
    told = picture.attrs
    words = ["lamina", "render", f"{told.get('sceneName', 'scene')}.toml"]
    words += ["--spp", str(told.get("spp")), "--seed", str(told.get("seed"))]
    words += ["--out", path.stem]
    return f"# {told.get('software')}, scene {told.get('sceneHash')}\n{shlex.join(words)}"


def of_sweep(folder: Path) -> tuple[str, str, list[Section]]:
    """Title, summary and sections of a folder by `lamina sweep`."""
    about = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))
    with (folder / "sweep.csv").open(encoding="utf-8", newline="") as table:
        tasks = list(csv.DictReader(table))
    keys = [key["key"] for key in about["keys"]]
    units = {key["key"]: key["unit"] for key in about["keys"]}
    names = list(tasks[0]) if tasks else []
    outputs = names[names.index("file") + 1 :] if tasks else []
    done = [task for task in tasks if task["state"] == "done"]
    shorts = {key: short_of(key, keys) for key in keys}
    plots = []
    others = [key for key in keys if key != "seed"]
    for key in others or keys:
        for name in chosen(outputs):
            unit = f", {units[key]}" if units[key] else ""
            if name.startswith("mean."):
                points = [
                    (task[key], task[name], task.get(name.replace("mean.", "error."), ""))
                    for task in done
                    if task[name]
                ]
            else:
                points = over_seeds(done, key, others, name)
            plots += plot(points, shorts[key] + unit, name, True)
    rows = []
    for number, task in enumerate(tasks[:MOST_ROWS]):
        picture: Any = ""
        file = folder / task["file"]
        if task["file"] and file.suffix == ".png" and number < MOST_PICTURES:
            settings = ", ".join(f"{shorts[key]} {task[key]}" for key in keys)
            picture = embedded(file, settings)
        rows.append(
            [task["task"], *(task[key] for key in keys), picture, task["state"]]
            + [number_of(task[name]) for name in outputs]
        )
    lines = [] if len(tasks) <= MOST_ROWS else [f"The first {MOST_ROWS} of {len(tasks)} tasks."]
    ends = [task for task in done if task["file"].endswith(".png")]
    pair = []
    if len(ends) > 1:
        for task in (ends[0], ends[-1]):
            settings = ", ".join(f"{shorts[key]} {task[key]}" for key in keys)
            pair.append(embedded(folder / task["file"], f"task {task['task']}: {settings}"))
        if len({(picture["width"], picture["height"]) for picture in pair}) > 1:
            pair = []
    is_of_leaves = any(task["file"].endswith(".svg") for task in done)
    told = []
    if is_of_leaves and others and "seed" in keys:
        told = ["A point is the mean over the seeds of one setting, its bar a standard error."]
    sections: list[Section] = [
        {
            "title": "The sweep",
            "verdict": f"{len(done)} of {len(tasks)} tasks are done",
            "good": len(done) == len(tasks),
            "lines": [f"{shorts[key]} is {key}" for key in keys if shorts[key] != key] + told,
            "pair": pair,
            "plots": plots,
            "maps": contact_sheet(folder, done, shorts),
        },
        {
            "title": "Tasks",
            "lines": lines,
            "head": ["task", *(shorts[key] for key in keys), "picture", "state", *outputs],
            "rows": rows,
            "reproduce": f"# Lamina {about['program']}\n"
            + shlex.join(
                ["lamina", "sweep", about["what"], *about.get("words", []), "--out", folder.name]
            ),
        },
    ]
    return f"Sweep of {Path(about['what']).name}", f"{len(tasks)} tasks.", sections


def short_of(key: str, keys: Sequence[str]) -> str:
    """The end of a key's path that tells it from the others."""
    parts = key.split(".")
    for length in range(1, len(parts)):
        short = ".".join(parts[-length:])
        if sum(other == short or other.endswith(f".{short}") for other in keys) == 1:
            return short
    return key


def over_seeds(
    tasks: Sequence[dict[str, str]], key: str, others: Sequence[str], name: str
) -> list[tuple[str, str, str]]:
    """For each setting of all keys but the seed the value of one, and mean and standard error."""
    settings: dict[tuple[str, ...], list[float]] = {}
    for task in tasks:
        if task[name]:
            setting = (task.get(key, ""), *(task[other] for other in others if other != key))
            settings.setdefault(setting, []).append(float(task[name]))
    if len({value for values in settings.values() for value in values}) < 2:
        return []
    points = []
    for setting, values in settings.items():
        mean = statistics.fmean(values)
        many = len(values) > 1
        error = statistics.stdev(values) / len(values) ** 0.5 if many else 0.0
        points.append((setting[0], repr(mean), repr(error)))
    return points


def contact_sheet(
    folder: Path, tasks: Sequence[dict[str, str]], shorts: dict[str, str]
) -> list[dict[str, Any]]:
    """The small pictures of the leaves of a sweep, with their settings."""
    leaves = [task for task in tasks if task["file"].endswith(".svg")][:MOST_PICTURES]
    files = [(folder / task["file"]).with_suffix(".png") for task in leaves]
    return [
        embedded(file, ", ".join(f"{short} {task[key]}" for key, short in shorts.items()))
        for task, file in zip(leaves, files, strict=True)
        if file.is_file()
    ]


def chosen(outputs: Sequence[str]) -> list[str]:
    """The outputs that are plotted: the means of a picture, or what leaves are most asked for."""
    means = [name for name in outputs if name.startswith("mean.") and name != "mean.A"]
    leaf = (
        "vein_density_mm_per_mm2",
        "areoles_per_mm2",
        "freely_ending_veinlets_per_mm2",
        "vein_distance_mm_mean",
        "areole_area_cv",
        "loop_nesting",
        "length_mm",
        "area_mm2",
    )
    return means or [name for name in leaf if name in outputs]


def number_of(text: str) -> str:
    """A number as a table shows it."""
    return f"{float(text):.5g}" if text else ""


def of_comparison(folder: Path) -> tuple[str, str, list[Section]]:
    """Title, summary and a section for each result of `reference/compare`."""
    sections: list[Section] = []
    for file in sorted(folder.glob("*.json")):
        told = json.loads(file.read_text(encoding="utf-8"))
        if not isinstance(told, dict) or not {"scene", "bands", "passed"} <= told.keys():
            continue
        names = {
            "difference": "difference by band, full at ±20 % of its mean",
            "z": "z by band, full at ±4",
            "delta-e": "ΔE2000, white at 4",
        }
        maps = [
            embedded(file.with_name(f"{file.stem}-{name}.png"), words)
            for name, words in names.items()
            if file.with_name(f"{file.stem}-{name}.png").is_file()
        ]
        both = [file.with_name(f"{file.stem}-{name}.png") for name in ("lamina", "mitsuba")]
        pair = [
            embedded(path, path.stem.rsplit("-", 1)[-1].title()) for path in both if path.is_file()
        ]
        rows = [
            [band["name"], f"{band['mean']:.5g}", f"{100 * band['difference']:+.3f}"]
            + [f"{100 * band['error']:.3f}", f"{band['z']:+.2f}"]
            + [f"{100 * band['pixels_passed']:.3f}", f"{band['region_z']:+.2f}"]
            for band in told["bands"]
        ]
        spp, seconds = told["spp"], told["seconds"]
        sections.append(
            {
                "title": told["scene"],
                "verdict": "agrees"
                if told["passed"]
                else "differs: " + "; ".join(told["failures"]),
                "good": bool(told["passed"]),
                "lines": [
                    f"{name.title()}: {spp[name]} samples a pixel, {seconds[name]:.1f} s"
                    for name in ("lamina", "mitsuba")
                ]
                + [f"Mitsuba's variant is {told['variant']}."],
                "pair": pair if len(pair) == 2 else [],
                "maps": maps,
                "head": ["band nm", "mean", "difference %", "± %", "z", "pixels passed %"]
                + ["worst region's z"],
                "rows": rows,
                "reproduce": f"reference/compare scenes/{told['scene']} --spp {spp['lamina']} "
                f"--mitsuba-spp {spp['mitsuba']} --variant {told['variant']}",
            }
        )
    if not sections:
        raise ValueError(f"{folder} holds neither a sweep nor results of reference/compare")
    passed = sum(section["good"] for section in sections)
    return "Lamina against Mitsuba", f"{passed} of {len(sections)} scenes agree.", sections


def shown(exr: Path) -> dict[str, Any]:
    """The picture to look at of an EXR, made from it."""
    with tempfile.TemporaryDirectory() as folder:
        png = Path(folder, "shown.png")
        try:
            run(["tonemap", exr, "--out", png])
        except LaminaError:
            # A spectral film has no colours that everyone sees alike: the mean over bands in grey.
            light = read(exr)["radiance"].values.astype(float).mean(axis=-1)
            grey = np.clip(light / max(float(np.percentile(light, 99.5)), 1e-30), 0, 1) ** (1 / 2.2)
            return picture_of(np.repeat(grey[..., None], 3, axis=2), f"{exr.name}, mean of bands")
        return embedded(png, exr.name)


def diverging(value: Array) -> Array:
    """−1 to 1 as blue over white to red, `[y, x, 3]`."""
    level = np.clip(np.nan_to_num(value), -1, 1)
    return np.stack(
        [1 + np.minimum(level, 0), 1 - np.abs(level), 1 - np.maximum(level, 0)], axis=-1
    )


def picture_of(rgb: Array, name: str) -> dict[str, Any]:
    """A picture from values in [0, 1], `[y, x, 3]`."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "map.png")
        pixels = np.ascontiguousarray(np.round(255 * np.clip(rgb, 0, 1)).astype(np.uint8))
        out = oiio.ImageOutput.create(str(file))
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, oiio.UINT8)
        if out is None or not out.open(str(file), spec) or not out.write_image(pixels):
            raise OSError(f"{name}: {oiio.geterror()}")
        out.close()
        return embedded(file, name)


def embedded(file: Path, name: str) -> dict[str, Any]:
    """A PNG as part of the page."""
    data = file.read_bytes()
    # The header chunk begins with both lengths.
    width, height = (int.from_bytes(data[start : start + 4], "big") for start in (16, 20))
    text = "data:image/png;base64," + base64.b64encode(data).decode("ascii")
    return {"data": text, "name": name, "width": width, "height": height}


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; 2 for input that is none."""
    parser = argparse.ArgumentParser(
        prog="lamina-report",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("paths", nargs="+", metavar="A.exr B.exr|FOLDER")
    parser.add_argument("--out", default="report.html", metavar="FILE.html")
    options = parser.parse_args(arguments)
    try:
        print(report(options.paths, options.out))
    except (ValueError, OSError, LaminaError) as refused:
        print(f"lamina-report: {refused}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
