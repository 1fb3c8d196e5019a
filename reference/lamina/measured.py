"""Figures of instruments as arrays, and as NetCDF."""

from __future__ import annotations

import argparse
import csv
import json
import sys
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from lamina.extras import require
from lamina.program import Folders, LaminaError, Value, allowing, overrides, run
from lamina.rendered import read

Row = dict[str, object]

# Column of a row, name of its axis, unit.
AXES = (
    ("face", "face", ""),
    ("incidence_deg", "incidence", "degree"),
    ("view_azimuth_deg", "view_azimuth", "degree"),
    ("view_zenith_deg", "view_zenith", "degree"),
    ("depth_um", "depth", "um"),
    ("band", "band", ""),
    ("wavelength_nm", "wavelength", "nm"),
)
# What a part is, by the end of a quantity's name; else it is an object.
PARTS = {"in_layer": "layer", "by_constituent": "constituent", "by_instance": "instance"}
# How the line of a table begins that holds its provenance as JSON.
PROVENANCE = "# provenance: "
# Of means over several draws of the leaves: their number, and the parts of the standard error.
PARTS_OF_ERRORS = ("draws", "error_by_rays", "error_by_draws")
# The band over which photons are summed.
PHOTONS = "PAR"


def instruments(
    scene: str | Path,
    values: Mapping[str, Value] | None = None,
    *,
    rays: int | None = None,
    error: float | str | None = None,
    seed: int = 1,
    only: Iterable[str] = (),
    allow: Folders = (),
) -> dict[str, xr.Dataset]:
    """What the instruments of a scene measure: a dataset for each, by its name.

    `values` set keys of the scene, `rays`, `error`, `seed` and `only` are the options of `lamina
    instruments`; an error of "1%" is relative. `allow` is as in `render`. Raises LaminaError for
    what the program refuses.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "figures.json")
        arguments: list[str | Path] = ["instruments", scene, "--out", file, "--seed", str(seed)]
        arguments += [*overrides("-D", values), *allowing(allow)]
        for name, value in (("--rays", rays), ("--error", error)):
            if value is not None:
                arguments += [name, str(value)]
        for name in only:
            arguments += ["--only", name]
        run(arguments)
        return read_figures(file)


def read_figures(file: str | Path) -> dict[str, xr.Dataset]:
    """A file of `lamina instruments`, JSON or CSV, as a dataset for each instrument.

    A quantity is a variable over what it depends on: `wavelength` (nm) or `band`, `incidence`,
    `view_zenith` and `view_azimuth` (degrees), `face`, `depth` (µm), and `object`, `layer`,
    `constituent` or `instance`. Its standard error is the variable `NAME_standard_error`; of means
    over several draws of the leaves, `NAME_error_by_rays` and `NAME_error_by_draws` are its parts
    and `NAME_draws` is the number of draws. Figures in diffuse light are `NAME_diffuse`, those of
    bands `NAME_in_band`, indices `NAME_of_QUANTITY`. Units are in the attribute `units`. What
    determines the figures is JSON in the attribute `provenance`, unless an older program wrote the
    file. Raises ValueError for a file that is no such table.
    """
    rows, told = rows_of(Path(file))
    names = dict.fromkeys(str(row["instrument"]) for row in rows)
    return {
        name: dataset(
            [row for row in rows if row["instrument"] == name], told | {"instrument": name}
        )
        for name in names
    }


def rows_of(file: Path) -> tuple[list[Row], dict[str, object]]:
    """The rows of a table (numbers as numbers, empty cells as None), and what is said of all."""
    text = file.read_text(encoding="utf-8")
    needed = {"value", "standard_error"} | {column for column, _, unit in AXES if unit}
    numbers = needed | set(PARTS_OF_ERRORS)
    if file.suffix.lower() == ".json":
        try:
            report = json.loads(text)
        except json.JSONDecodeError as failure:
            raise ValueError(f"{file}: this is no JSON: {failure}") from failure
        figures = report.get("figures") if isinstance(report, dict) else None
        if not isinstance(figures, list):
            raise ValueError(f"{file}: this is no file of `lamina instruments`: no `figures`")
        about = {
            key: report[key]
            for key in ("program", "scene", "seed", "rays", "target_error")
            if report.get(key) is not None
        }
        return figures, about | attribute(report.get("provenance"))
    rows: list[Row] = []
    lines = text.splitlines()
    comments = [line for line in lines if line.startswith("#")]
    found = [line.removeprefix(PROVENANCE) for line in comments if line.startswith(PROVENANCE)]
    try:
        about = attribute(json.loads(found[0]) if found else None)
    except json.JSONDecodeError as failure:
        raise ValueError(f"{file}: its provenance is no JSON: {failure}") from failure
    for line in csv.DictReader(lines[len(comments) :]):
        if not {"instrument", "quantity", "unit", *needed} <= set(line):
            raise ValueError(
                f"{file}: this is no file of `lamina instruments`: a column is missing"
            )
        row: Row = {}
        for column, entry in line.items():
            if entry == "":
                row[column] = None
            elif column in numbers and entry != "diffuse":
                row[column] = float(entry)
            else:
                row[column] = entry
        rows.append(row)
    return rows, about


def attribute(provenance: object) -> dict[str, object]:
    """The provenance of a result as a text, which NetCDF can hold; nothing if there is none."""
    return {} if provenance is None else {"provenance": json.dumps(provenance, sort_keys=True)}


def named(row: Row) -> tuple[str, dict[str, object]]:
    """The variable of a row, and its places on the axes."""
    name = str(row["quantity"])
    places: dict[str, object] = {}
    if row["part"] is not None and row["depth_um"] is None:
        if row["wavelength_nm"] is None and row["band"] is None:
            name += f"_of_{row['part']}"
        else:
            ends = (axis for end, axis in PARTS.items() if name.endswith(end))
            places[next(ends, "object")] = row["part"]
    for column, axis, _ in AXES:
        if row[column] is not None:
            places[axis] = row[column]
    if places.get("incidence") == "diffuse":
        name += "_diffuse"
        del places["incidence"]
    if places.get("band") == PHOTONS:
        del places["band"]
    elif "band" in places:
        # A band has its own middle; it is a coordinate of the band.
        name += "_in_band"
        del places["wavelength"]
    return name, places


def dataset(rows: list[Row], about: Mapping[str, object]) -> xr.Dataset:
    """The figures of one instrument."""
    variables: dict[str, list[tuple[dict[str, object], Row]]] = {}
    for row in rows:
        name, places = named(row)
        variables.setdefault(name, []).append((places, row))
    coordinates: dict[str, list[object]] = {}
    for figures in variables.values():
        for places, _ in figures:
            for axis, place in places.items():
                known = coordinates.setdefault(axis, [])
                if place not in known:
                    known.append(place)
    units = {axis: unit for _, axis, unit in AXES}
    for axis, known in coordinates.items():
        if units.get(axis):
            known.sort()
    found: dict[str, xr.Variable] = {}
    for name, figures in variables.items():
        axes = list(figures[0][0])
        shape = [len(coordinates[axis]) for axis in axes]
        columns = ["standard_error"]
        # Files of older programs have no such columns.
        columns += [one for one in PARTS_OF_ERRORS if figures[0][1].get(one) is not None]
        for column in ("value", *columns):
            values = np.full(shape, np.nan)
            for places, row in figures:
                at = tuple(coordinates[axis].index(places[axis]) for axis in axes)
                number = row[column]
                values[at] = np.nan if number is None else float(str(number))
            attributes = {"units": "1" if column == "draws" else str(figures[0][1]["unit"])}
            if column == "value":
                attributes["ancillary_variables"] = " ".join(f"{name}_{one}" for one in columns)
            found[name if column == "value" else f"{name}_{column}"] = xr.Variable(
                axes, values, attributes
            )
    result = xr.Dataset(found, attrs=dict(about))
    for axis, known in coordinates.items():
        attributes = {"units": units[axis]} if units.get(axis) else {}
        result.coords[axis] = xr.Variable(axis, known, attributes)
    middles = {row["band"]: row["wavelength_nm"] for row in rows if row["band"] is not None}
    if "band" in coordinates:
        middle = [float(str(middles[band])) for band in coordinates["band"]]
        result.coords["band_centre"] = xr.Variable("band", middle, {"units": "nm"})
    if "depth" in coordinates:
        layers = {row["depth_um"]: row["part"] for row in rows}
        within = [str(layers[depth]) for depth in coordinates["depth"]]
        result.coords["tissue"] = xr.Variable("depth", within)
    return result


def main() -> None:
    """`lamina-netcdf`: a table of `lamina instruments`, or a picture, as NetCDF."""
    parser = argparse.ArgumentParser(
        prog="lamina-netcdf",
        description="Writes figures of `lamina instruments`, or a picture of `lamina render`, as "
        "NetCDF by the CF conventions. Of a table of several instruments, each goes to a file "
        "STEM-NAME.nc.",
    )
    parser.add_argument(
        "figures", type=Path, help="file of `lamina instruments`, .json or .csv, or .exr"
    )
    parser.add_argument("--out", type=Path, required=True, help="file to write, .nc")
    parser.add_argument("--only", action="append", help="this instrument only")
    given = parser.parse_args()
    try:
        for file in to_netcdf(given.figures, given.out, given.only):
            print(file)
    except (LaminaError, OSError, ValueError) as failure:
        sys.exit(f"lamina-netcdf: {failure}")


def to_netcdf(
    figures: str | Path, out: str | Path, only: Iterable[str] | None = None
) -> list[Path]:
    """Writes a table of `lamina instruments` as NetCDF and gives the files that are written.

    One instrument goes to `out`, each of several to a file `STEM-NAME.nc`. A picture, a file with
    the ending `.exr`, goes to `out` with all that `read` gives. Raises ValueError for an instrument
    that is not there.
    """
    require("netcdf", "NetCDF")
    if Path(figures).suffix == ".exr":
        read(figures).to_netcdf(out)
        return [Path(out)]
    found = read_figures(figures)
    chosen = list(only) if only else list(found)
    for name in chosen:
        if name not in found:
            raise ValueError(f"{figures}: there is no instrument {name}, but {', '.join(found)}")
    out = Path(out)
    files = []
    for name in chosen:
        file = out if len(chosen) == 1 else out.with_name(f"{out.stem}-{name}{out.suffix}")
        found[name].to_netcdf(file)
        files.append(file)
    return files
