"""Radiance above the atmosphere, from figures of a canopy and a table of the atmosphere.

The surface reflects direct and diffuse light towards the sensor and into the half space, and emits
fluorescence; the atmosphere is a layer above it that reflects and transmits. A radiative-transfer
code such as 6S or libRadtran makes the table; the page "Above the canopy" of the book says how.
"""

from __future__ import annotations

import argparse
import csv
import re
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from lamina.conventions import WAVELENGTH
from lamina.measured import read_figures

RADIANCE, IRRADIANCE = "W m-2 sr-1 nm-1", "W m-2 nm-1"
# Columns of a table, which are variables of the dataset without their units: unit, what it is.
COLUMNS = {
    "wavelength_nm": ("nm", "wavelength"),
    "solar_w_m2_nm": (IRRADIANCE, "solar irradiance above the atmosphere, at normal incidence"),
    "path_radiance_w_m2_sr_nm": (RADIANCE, "radiance of the atmosphere over a black surface"),
    "tau_ss": ("1", "direct transmittance towards the surface"),
    "tau_sd": ("1", "direct-to-diffuse transmittance towards the surface"),
    "tau_oo": ("1", "direct transmittance towards the sensor"),
    "tau_do": ("1", "diffuse-to-direct transmittance towards the sensor"),
    "rho_dd": ("1", "reflectance of the atmosphere for diffuse light from below"),
    "both_ways": ("1", "gas transmittance down and up over the product of both"),
}
UNITS = re.compile(r"(_w_m2_sr|_w_m2)?_nm$")
# Angles in the comments of every table, and by how much those of figures may differ, degrees.
ANGLES, SLACK_DEG = ("sun_zenith_deg", "view_zenith_deg"), 0.01
EXCITED = re.compile(r"excited at ([\d.]+) nm")


def read_atmosphere(file: str | Path) -> xr.Dataset:
    """A table of the atmosphere over `wavelength`, with `sun_zenith_deg` and `view_zenith_deg`.

    The file is CSV with the columns `wavelength_nm`, `solar_w_m2_nm`, `path_radiance_w_m2_sr_nm`,
    `tau_ss`, `tau_sd`, `tau_oo`, `tau_do`, `rho_dd` and `both_ways`; both angles are comments such
    as `# sun_zenith_deg = 30`. Raises ValueError for a file that lacks one of them, wavelengths
    that do not rise, and numbers that no atmosphere has.
    """
    lines = Path(file).read_text(encoding="utf-8").splitlines()
    said = dict(re.findall(r"^# *(\w+) = (\S+)$", "\n".join(lines), re.MULTILINE))
    rows = list(csv.DictReader(line for line in lines if line and not line.startswith("#")))
    missing = [name for name in COLUMNS if not rows or name not in rows[0]]
    missing += [f"# {angle} = …" for angle in ANGLES if angle not in said]
    if missing:
        raise ValueError(f"{file}: there is no {missing[0]} in this table of an atmosphere")
    try:
        columns = {name: np.array([float(row[name]) for row in rows]) for name in COLUMNS}
        angles = {angle: float(said[angle]) for angle in ANGLES}
    except (TypeError, ValueError) as failure:
        raise ValueError(f"{file}: {failure}") from failure
    return checked(columns, angles, str(file))


def checked(columns: dict[str, np.ndarray], angles: dict[str, float], of: str) -> xr.Dataset:
    """A table of the atmosphere as a dataset, if it is one."""
    nm = columns["wavelength_nm"]
    for name, values in columns.items():
        most = 1.0 if COLUMNS[name][0] == "1" and name != "both_ways" else np.inf
        wrong = ~(np.isfinite(values) & (values >= 0.0) & (values <= most))
        if wrong.any():
            at = wrong.argmax()
            raise ValueError(f"{of}: {name} is {values[at]:g} at {nm[at]:g} nm")
    if not (np.diff(nm) > 0.0).all():
        raise ValueError(f"{of}: the wavelengths do not rise")
    for name, angle in angles.items():
        if not 0.0 <= angle < 90.0:
            raise ValueError(f"{of}: {name} is {angle:g}; it is 0 to below 90")
    found = {
        UNITS.sub("", name): ("wavelength", columns[name], {"units": unit, "long_name": what})
        for name, (unit, what) in COLUMNS.items()
        if name != "wavelength_nm"
    }
    return xr.Dataset(found, {"wavelength": ("wavelength", nm, WAVELENGTH)}, attrs=angles)


def from_uvspec(
    top: str | Path,
    black: str | Path,
    view: str | Path,
    bright: str | Path,
    *,
    albedo: float,
    sun_zenith_deg: float,
    view_zenith_deg: float,
    scale: float = 1e-3,
) -> xr.Dataset:
    """A table of the atmosphere from four runs of libRadtran's `uvspec`.

    All have `output_user lambda edir edn uu`, one direction of `umu` and `phi`, and the same
    wavelengths. `top` and `black` have `albedo 0`, the sun at `sun_zenith_deg`, and `zout toa` and
    `zout 0`; `view` is `black` with the sun at the zenith angle of the view; `bright` is `black`
    with `albedo`. `scale` turns their irradiances into W m⁻² nm⁻¹: libRadtran's own solar spectra
    are in mW. A spectrum whose absorption varies within its resolution needs runs that resolve it.
    Raises ValueError for tables that do not fit each other.
    """
    runs = [np.loadtxt(file, ndmin=2) for file in (top, black, view, bright)]
    for file, run in zip((top, black, view, bright), runs, strict=True):
        if run.shape[1] != 4:
            raise ValueError(f"{file}: 4 columns are wanted: lambda edir edn uu")
        if run.shape != runs[0].shape or not np.array_equal(run[:, 0], runs[0][:, 0]):
            raise ValueError(f"{file}: it has other wavelengths than {top}")
    above, below, seen, lit = (run.T for run in runs)
    cosines = {angle: np.cos(np.radians(angle)) for angle in (sun_zenith_deg, view_zenith_deg)}
    solar = above[1] / cosines[sun_zenith_deg]
    level, reverse = above[1], solar * cosines[view_zenith_deg]
    dark, light = below[1] + below[2], lit[1] + lit[2]
    columns = {
        "wavelength_nm": above[0],
        "solar_w_m2_nm": solar * scale,
        "path_radiance_w_m2_sr_nm": above[3] * scale,
        "tau_ss": below[1] / level,
        "tau_sd": below[2] / level,
        # Light goes to the sensor as it comes from there.
        "tau_oo": seen[1] / reverse,
        "tau_do": seen[2] / reverse,
        # light = dark / (1 - albedo rho_dd)
        "rho_dd": (1.0 - dark / light) / albedo,
        "both_ways": np.ones_like(solar),
    }
    angles = dict(zip(ANGLES, (sun_zenith_deg, view_zenith_deg), strict=True))
    return checked(columns, angles, str(top))


def top_of_atmosphere(
    atmosphere: xr.Dataset,
    *,
    rso: ArrayLike,
    rdo: ArrayLike,
    rsd: ArrayLike,
    rdd: ArrayLike,
    emitted: ArrayLike = 0.0,
    emitted_towards: ArrayLike | None = None,
) -> xr.Dataset:
    """Radiance above the atmosphere over a surface that goes on evenly, W m⁻² sr⁻¹ nm⁻¹.

    The surface has four reflectance factors, each a number or an array over the table's
    wavelengths: of direct (s) or diffuse light (d), towards the sensor (o) or into the half space
    (d). It emits the exitance `emitted` (W m⁻² nm⁻¹), and towards the sensor the radiance
    `emitted_towards`; left out, that is the same in all directions.

    The variables are `radiance`, the sum of `path_radiance`, `reflected` and `fluorescence`, and
    `reflectance`, π times the radiance over the solar irradiance of a level plane; and at the
    surface `surface_radiance` with the fluorescence in it, `surface_fluorescence`,
    `irradiance_sun` and `irradiance_sky`.
    """
    table = atmosphere
    s_o, d_o, s_d, d_d, exitance, towards = (
        xr.zeros_like(table["solar"]) + np.asarray(value, float)
        for value in (
            *(rso, rdo, rsd, rdd, emitted),
            np.asarray(emitted) / np.pi if emitted_towards is None else emitted_towards,
        )
    )
    level = table["solar"] * np.cos(np.radians(table.attrs["sun_zenith_deg"]))
    # What goes up comes down again in part, and so on without end.
    again = 1.0 / (1.0 - d_d * table["rho_dd"])
    sun = table["tau_ss"] * level
    sky = (table["tau_sd"] * level + table["rho_dd"] * s_d * sun) * again
    upwards = s_d * sun + d_d * sky
    left = (s_o * sun + d_o * sky) / np.pi
    glow_upwards = exitance * again
    glow = towards + d_o * table["rho_dd"] * glow_upwards / np.pi

    def arriving(direct: xr.DataArray, hemispherical: xr.DataArray) -> xr.DataArray:
        return table["tau_oo"] * direct + table["tau_do"] * hemispherical / np.pi

    reflected = table["both_ways"] * arriving(left, upwards)
    fluorescence = arriving(glow, glow_upwards)
    radiance = table["path_radiance"] + reflected + fluorescence
    variables = {
        "radiance": (radiance, RADIANCE),
        "path_radiance": (table["path_radiance"], RADIANCE),
        "reflected": (reflected, RADIANCE),
        "fluorescence": (fluorescence, RADIANCE),
        "reflectance": (np.pi * radiance / level, "1"),
        "surface_radiance": (left + glow, RADIANCE),
        "surface_fluorescence": (glow, RADIANCE),
        "irradiance_sun": (sun, IRRADIANCE),
        "irradiance_sky": (sky, IRRADIANCE),
    }
    made = {name: data.assign_attrs(units=unit) for name, (data, unit) in variables.items()}
    return xr.Dataset(made, attrs=dict(table.attrs))


def above_canopy(figures: xr.Dataset, atmosphere: xr.Dataset) -> xr.Dataset:
    """Radiance above the atmosphere over a canopy, as `top_of_atmosphere` gives it.

    `figures` are those of an instrument `canopy` (`lamina.instruments`, `lamina.read_figures`)
    with `diffuse = true`, an `incidence_deg` that is the table's zenith angle of the sun and a
    `detector` with the zenith angle of the view. Where it has `fluorescence` with `excitation_nm`,
    direct and diffuse light at the surface excite. Figures are interpolated between their
    wavelengths; the emission is taken as the same in all directions. Raises ValueError for figures
    that lack something, or whose wavelengths do not cover the table's.
    """
    nm = atmosphere["wavelength"].values
    angles = {
        axis: atmosphere.attrs[name]
        for axis, name in zip(("incidence", "view_zenith"), ANGLES, strict=True)
    }

    def of(name: str, help: str) -> xr.DataArray:
        if name not in figures:
            raise ValueError(f"the canopy's figures have no {name}: {help}")
        data = figures[name]
        for axis, angle in angles.items():
            if axis not in data.dims:
                continue
            if np.abs(data[axis] - angle).min() > SLACK_DEG:
                known = ", ".join(f"{value:g}" for value in data[axis].values)
                raise ValueError(
                    f"the canopy's figures have no {axis} of {angle:g}°, the table's, but {known}"
                )
            data = data.sel({axis: angle}, method="nearest")
        return data.isel(view_azimuth=0) if "view_azimuth" in data.dims else data

    def curve(data: xr.DataArray) -> Callable[[np.ndarray], np.ndarray]:
        data = data.dropna("wavelength")
        known = data["wavelength"].values
        return lambda at: np.interp(at, known, data.values, left=np.nan, right=np.nan)

    needed = {
        "rso": ("brf", "give it a `detector`"),
        "rdo": ("hdrf_diffuse", "measure with `diffuse = true` and a `detector`"),
        "rsd": ("reflected", "it is no canopy"),
        "rdd": ("reflected_diffuse", "measure with `diffuse = true`"),
    }
    surface = {name: curve(of(*source))(nm) for name, source in needed.items()}
    for name, values in surface.items():
        if np.isnan(values).any():
            raise ValueError(
                f"{needed[name][0]} is not known at {nm[np.isnan(values)][0]:g} nm, where the "
                "table of the atmosphere begins or ends: widen `range_nm`, or cut the table"
            )
    if "fluorescence_upwards" not in figures:
        return top_of_atmosphere(atmosphere, **surface)
    lit = top_of_atmosphere(atmosphere, **surface)
    emitted = np.zeros_like(nm)
    for name, light in (
        ("fluorescence_upwards", "irradiance_sun"),
        ("fluorescence_upwards_diffuse", "irradiance_sky"),
    ):
        data = of(name, "measure with `diffuse = true`")
        by_nm = {
            float(found[1]): np.nan_to_num(curve(data.sel(object=part))(nm))
            for part in data["object"].values
            if (found := EXCITED.fullmatch(str(part)))
        }
        if len(by_nm) < 2:
            raise ValueError("fluorescence needs two wavelengths of `excitation_nm`, or more")
        exciting = np.array(sorted(by_nm))
        if nm[0] > exciting[0] or nm[-1] < exciting[-1]:
            raise ValueError(
                f"light from {exciting[0]:g} to {exciting[-1]:g} nm excites fluorescence, but the "
                f"table of the atmosphere has {nm[0]:g} to {nm[-1]:g} nm: compute a wider table"
            )
        inside = (nm >= exciting[0]) & (nm <= exciting[-1])
        # Photons for each photon, at the table's own wavelengths of excitation.
        matrix = np.stack([by_nm[at] for at in exciting])
        matrix = np.stack([np.interp(nm[inside], exciting, row) for row in matrix.T])
        energy = lit[light].values[inside] * nm[inside]
        emitted += np.trapezoid(matrix * energy, nm[inside], axis=1) / nm
    return top_of_atmosphere(atmosphere, **surface, emitted=emitted)


def main() -> None:
    """`lamina-above-canopy`: radiance above the atmosphere, from the figures of a canopy."""
    parser = argparse.ArgumentParser(
        prog="lamina-above-canopy",
        description="Writes radiance above the atmosphere as CSV, from a canopy that `lamina "
        "instruments` measured and a table of the atmosphere.",
    )
    parser.add_argument("figures", type=Path, help="file of `lamina instruments`, .csv or .json")
    parser.add_argument("atmosphere", type=Path, help="table of the atmosphere, .csv")
    parser.add_argument("--out", type=Path, required=True, help="table to write, .csv")
    parser.add_argument("--instrument", help="name of the canopy, if there are several instruments")
    parser.add_argument(
        "--show", type=float, nargs="*", default=[], metavar="NM", help="wavelengths to print too"
    )
    given = parser.parse_args()
    try:
        known = read_figures(given.figures)
        name = given.instrument or (next(iter(known)) if len(known) == 1 else "")
        if name not in known:
            raise ValueError(f"{given.figures}: --instrument is one of {', '.join(known)}")
        found = above_canopy(known[name], read_atmosphere(given.atmosphere))
        provenance = known[name].attrs.get("provenance")
        head = [f"# provenance of the canopy: {provenance}"] if provenance else []
        units = {"W m-2 sr-1 nm-1": "_w_m2_sr_nm", "W m-2 nm-1": "_w_m2_nm", "1": ""}
        columns = [f"{key}{units[data.attrs['units']]}" for key, data in found.items()]
        rows = zip(found["wavelength"].values, *(found[key].values for key in found), strict=True)
        lines = [*head, ",".join(["wavelength_nm", *columns])]
        lines += [",".join(f"{value:.6g}" for value in row) for row in rows]
        part = given.out.with_name(f".{given.out.name}.part")
        try:
            part.write_text("\n".join(lines) + "\n", encoding="utf-8")
            part.replace(given.out)
        finally:
            part.unlink(missing_ok=True)
    except (OSError, ValueError) as failure:
        sys.exit(f"lamina-above-canopy: {failure}")
    for nm in given.show:
        at = found.sel(wavelength=nm, method="nearest")
        radiance, glow, below = (
            float(at[key]) for key in ("radiance", "fluorescence", "surface_fluorescence")
        )
        print(
            f"{float(at['wavelength']):g} nm: radiance {radiance:.4g} {RADIANCE}, fluorescence in "
            f"it {glow:.3g} ({glow / radiance:.2%}), and {below:.3g} at the surface"
        )
    print(given.out)
