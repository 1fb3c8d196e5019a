"""Radiance above the atmosphere, against closed forms and against tables whose answer is known."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from lamina.atmosphere import (
    COLUMNS,
    above_canopy,
    from_uvspec,
    read_atmosphere,
    top_of_atmosphere,
)

GUIDE = Path(__file__).resolve().parents[2] / "docs" / "src" / "guide"
NM = np.array([400.0, 500.0, 600.0, 700.0, 760.0, 800.0])
SUN, VIEW = 40.0, 20.0
CLEAR = {name: 0.0 for name in COLUMNS} | {"tau_ss": 1.0, "tau_oo": 1.0, "both_ways": 1.0}
HAZY = {
    "path_radiance_w_m2_sr_nm": 0.02,
    "tau_ss": 0.7,
    "tau_sd": 0.15,
    "tau_oo": 0.75,
    "tau_do": 0.12,
    "rho_dd": 0.2,
    "both_ways": 1.0,
}


def table(folder: Path, **columns: float) -> xr.Dataset:
    """A table that is the same at all wavelengths, with a solar irradiance that is not."""
    rows = [columns | {"wavelength_nm": nm, "solar_w_m2_nm": 1.0 + nm / 1000.0} for nm in NM]
    lines = [f"# sun_zenith_deg = {SUN}", f"# view_zenith_deg = {VIEW}", ",".join(COLUMNS)]
    lines += [",".join(str(row[name]) for name in COLUMNS) for row in rows]
    file = folder / "atmosphere.csv"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return read_atmosphere(file)


def level(air: xr.Dataset) -> np.ndarray:
    return air["solar"].values * np.cos(np.radians(SUN))


def test_without_an_atmosphere_the_radiance_is_the_surfaces(tmp_path: Path) -> None:
    air = table(tmp_path, **CLEAR)
    found = top_of_atmosphere(air, rso=0.3, rdo=0.5, rsd=0.6, rdd=0.7, emitted=0.01)
    np.testing.assert_allclose(found["radiance"], 0.3 * level(air) / np.pi + 0.01 / np.pi)
    np.testing.assert_allclose(found["radiance"], found["surface_radiance"])
    np.testing.assert_allclose(found["fluorescence"], 0.01 / np.pi)
    towards = top_of_atmosphere(
        air, rso=0, rdo=0, rsd=0, rdd=0, emitted=0.01, emitted_towards=0.02 + 0.0 * NM
    )
    np.testing.assert_allclose(towards["radiance"], 0.02)


def test_over_a_black_surface_there_is_the_path_radiance(tmp_path: Path) -> None:
    air = table(tmp_path, **HAZY)
    found = top_of_atmosphere(air, rso=0, rdo=0, rsd=0, rdd=0)
    np.testing.assert_allclose(found["radiance"], 0.02)


def test_over_a_lambertian_surface_the_textbooks_formula_holds(tmp_path: Path) -> None:
    air = table(tmp_path, **HAZY)
    albedo = 0.4
    found = top_of_atmosphere(air, rso=albedo, rdo=albedo, rsd=albedo, rdd=albedo)
    through = (0.7 + 0.15) * (0.75 + 0.12)
    expected = 0.02 + through * level(air) * albedo / np.pi / (1.0 - albedo * 0.2)
    np.testing.assert_allclose(found["radiance"], expected)
    arriving = found["irradiance_sun"] + found["irradiance_sky"]
    np.testing.assert_allclose(arriving, 0.85 * level(air) / (1.0 - albedo * 0.2))


def test_what_is_emitted_goes_up_once_and_is_thrown_back_without_end(tmp_path: Path) -> None:
    # Gas that passes light both ways better than each way alone says nothing of emission.
    air = table(tmp_path, **(HAZY | {"both_ways": 1.5}))
    albedo, exitance = 0.4, 0.02
    dark, lit = (
        top_of_atmosphere(air, rso=albedo, rdo=albedo, rsd=albedo, rdd=albedo, emitted=emitted)
        for emitted in (0.0, exitance)
    )
    expected = (0.75 + 0.12) * exitance / np.pi / (1.0 - albedo * 0.2)
    np.testing.assert_allclose(lit["radiance"] - dark["radiance"], expected)


def test_each_kind_of_light_meets_its_own_reflectance(tmp_path: Path) -> None:
    air = table(tmp_path, **HAZY)
    factors = {"rso": 0.1, "rdo": 0.2, "rsd": 0.3, "rdd": 0.4}
    found = top_of_atmosphere(air, **factors)
    # The orders of reflection between surface and atmosphere, one by one.
    sun, sky, radiance = 0.7 * level(air), 0.15 * level(air), 0.02 + 0.0 * NM
    for _ in range(40):
        up = 0.3 * sun + 0.4 * sky
        radiance = radiance + (0.75 * (0.1 * sun + 0.2 * sky) + 0.12 * up) / np.pi
        sun, sky = 0.0 * sun, 0.2 * up
    np.testing.assert_allclose(found["radiance"], radiance)


def test_runs_of_uvspec_give_the_atmosphere_that_they_were_made_of(tmp_path: Path) -> None:
    solar, albedo = 1500.0 + NM, 0.5
    above, seen = (solar * np.cos(np.radians(angle)) for angle in (SUN, VIEW))
    none, direct, diffuse = 0.0 * NM, 0.7 * above, 0.15 * above
    runs = {
        "top": (above, none, 20.0 + none),
        "black": (direct, diffuse, none),
        "view": (0.75 * seen, 0.12 * seen, none),
        "bright": (direct, (direct + diffuse) / (1.0 - albedo * 0.2) - direct, none),
    }
    for name, columns in runs.items():
        np.savetxt(tmp_path / name, np.column_stack([NM, *columns]))
    files = [tmp_path / name for name in runs]
    found = from_uvspec(*files, albedo=albedo, sun_zenith_deg=SUN, view_zenith_deg=VIEW)
    for name, value in HAZY.items():
        np.testing.assert_allclose(found[name.removesuffix("_w_m2_sr_nm")], value, err_msg=name)
    np.testing.assert_allclose(found["solar"], solar / 1000.0)
    np.savetxt(tmp_path / "view", np.column_stack([NM + 1.0, *runs["view"]]))
    with pytest.raises(ValueError, match="other wavelengths"):
        from_uvspec(*files, albedo=albedo, sun_zenith_deg=SUN, view_zenith_deg=VIEW)


def figures(sun: float = SUN) -> xr.Dataset:
    """A canopy whose factors are those of a Lambertian one, and whose leaves emit one photon per
    ten thousand and nanometre at every wavelength of emission, whatever excites them."""
    level = (("incidence", "wavelength"), np.full((1, NM.size), 0.4))
    seen = ("incidence", "view_azimuth", "view_zenith", "wavelength")
    excited = [f"excited at {nm:g} nm" for nm in (400, 500, 600, 700)]
    glow = np.where(NM >= 700.0, 1e-4, np.nan)
    return xr.Dataset(
        {
            "reflected": level,
            "reflected_diffuse": ("wavelength", level[1][0]),
            "brf": (seen, level[1][:, None, None, :]),
            "hdrf_diffuse": (seen[1:], level[1][0][None, None, :]),
            "fluorescence_upwards": (
                ("object", "incidence", "wavelength"),
                np.tile(glow, (4, 1, 1)),
            ),
            "fluorescence_upwards_diffuse": (("object", "wavelength"), np.tile(glow, (4, 1))),
        },
        {
            "wavelength": NM,
            "incidence": [sun],
            "view_zenith": [VIEW],
            "view_azimuth": [0.0],
            "object": excited,
        },
    )


def test_a_canopy_emits_what_both_kinds_of_light_excite(tmp_path: Path) -> None:
    air = table(tmp_path, **HAZY)
    found = above_canopy(figures(), air)
    inside = NM <= 700.0
    photons = np.trapezoid((0.85 * level(air) / (1.0 - 0.4 * 0.2) * NM)[inside], NM[inside]) * 1e-4
    emitted = np.where(NM >= 700.0, photons / NM, 0.0)
    expected = (0.75 + 0.12) * emitted / np.pi / (1.0 - 0.4 * 0.2)
    np.testing.assert_allclose(found["fluorescence"], expected)
    whole = top_of_atmosphere(air, rso=0.4, rdo=0.4, rsd=0.4, rdd=0.4, emitted=emitted)
    np.testing.assert_allclose(found["radiance"], whole["radiance"])


def test_figures_that_do_not_fit_the_table_are_refused(tmp_path: Path) -> None:
    air = table(tmp_path, **HAZY)
    with pytest.raises(ValueError, match=r"no incidence of 40°, the table's, but 30"):
        above_canopy(figures(sun=30.0), air)
    with pytest.raises(ValueError, match="diffuse = true"):
        above_canopy(figures().drop_vars("reflected_diffuse"), air)
    with pytest.raises(ValueError, match="brf is not known at 400 nm"):
        above_canopy(figures().isel(wavelength=slice(1, None)), air)
    with pytest.raises(ValueError, match="light from 400 to 700 nm excites"):
        above_canopy(figures(), air.isel(wavelength=slice(2, None)))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("tau_ss", "tau"), "there is no tau_ss"),
        (("# sun_zenith_deg = 40.0\n", ""), "there is no # sun_zenith_deg"),
        (("\n500.0,", "\n900.0,"), "do not rise"),
        (("0.75,", "1.75,"), "tau_oo is 1.75 at 400 nm"),
        (("0.75,", "high,"), "high"),
        (("= 40.0", "= 95"), "sun_zenith_deg is 95"),
    ],
)
def test_tables_that_are_none_are_refused(
    tmp_path: Path, change: tuple[str, str], said: str
) -> None:
    table(tmp_path, **HAZY)
    file = tmp_path / "atmosphere.csv"
    file.write_text(file.read_text(encoding="utf-8").replace(*change, 1), encoding="utf-8")
    with pytest.raises(ValueError, match=re.escape(said)):
        read_atmosphere(file)


def test_the_command_writes_a_table_and_names_what_is_wrong(tmp_path: Path) -> None:
    rows = [
        "instrument,quantity,part,face,incidence_deg,view_zenith_deg,view_azimuth_deg,depth_um"
        ",band,wavelength_nm,value,standard_error,unit"
    ]
    for nm in (400, 850):
        rows += [
            f"field,reflected,,,30,,,,,{nm},0.3,0,1",
            f"field,reflected,,,diffuse,,,,,{nm},0.3,0,1",
            f"field,brf,,,30,0,0,,,{nm},0.3,0,1",
            f"field,hdrf,,,diffuse,0,0,,,{nm},0.3,0,1",
        ]
    (tmp_path / "field.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")

    def call(*more: str) -> subprocess.CompletedProcess[str]:
        files = ["field.csv", str(GUIDE / "atmosphere.csv"), "--out", "toa.csv"]
        command = [sys.executable, "-c", "from lamina.atmosphere import main; main()", *files]
        paths = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])}
        return subprocess.run(
            [*command, *more], cwd=tmp_path, env=paths, capture_output=True, text=True
        )

    done = call("--show", "760")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("760 nm: radiance 0.02")
    heads, *lines = (tmp_path / "toa.csv").read_text(encoding="utf-8").splitlines()
    assert heads.startswith("wavelength_nm,radiance_w_m2_sr_nm,") and len(lines) == 181
    refused = call("--instrument", "lawn")
    assert refused.returncode == 1
    assert refused.stderr == "lamina-above-canopy: field.csv: --instrument is one of field\n"
