"""Tables of daylight and of its reference: reference/run daylight FOLDER-OF-THE-PROJECT.

Writes the coefficients that SPCTRL2 needs, the basis of the CIE's daylight, and what pvlib makes of
the same atmospheres and of the sun's position. Needs pvlib and colour-science:
`pip install pvlib==0.16.1 colour-science==0.4.7`.
"""

from __future__ import annotations

import sys
from pathlib import Path

import colour
import numpy as np
import pandas as pd
import pvlib
from pvlib.spectrum import spectrl2
from pvlib.spectrum.spectrl2 import _SPECTRL2_COEFFS as COEFFICIENTS

# Elevation (degrees), turbidity after Preetham, ozone (atm-cm), water vapour (cm), pressure (Pa),
# ground albedo, day of the year.
ATMOSPHERES = [
    (90.0, 2.0, 0.30, 1.5, 101300.0, 0.2, 172),
    (60.0, 2.5, 0.34, 1.42, 101300.0, 0.2, 80),
    (41.8, 3.0, 0.344, 1.42, 101300.0, 0.0, 1),
    (30.0, 4.0, 0.35, 3.0, 90000.0, 0.8, 266),
    (15.0, 6.0, 0.25, 0.5, 101300.0, 0.3, 355),
    (5.0, 2.5, 0.34, 1.42, 101300.0, 0.2, 40),
    (2.0, 10.0, 0.40, 5.0, 70000.0, 1.0, 200),
]
# Latitude and longitude (degrees, north and east), and a time in UTC.
PLACES = [
    (51.48, 0.0, "2026-06-21T12:00:00"),
    (51.48, 0.0, "2026-12-21T12:00:00"),
    (52.52, 13.405, "2026-06-21T04:30:00"),
    (40.0, -105.0, "2024-02-29T17:15:00"),
    (-33.87, 151.21, "2026-01-15T02:00:00"),
    (0.0, 100.0, "2026-03-20T05:30:00"),
    (64.15, -21.94, "2026-06-21T23:30:00"),
    (-54.8, -68.3, "1999-09-01T14:45:30"),
    (78.2, 15.6, "2049-05-10T22:00:00"),
    (35.68, 139.69, "1960-10-05T05:00:00"),
]


def optical_depth(turbidity: float) -> float:
    """Of aerosol at 500 nm: Preetham's Ångström coefficient, with the exponent of SPCTRL2."""
    return (0.04608 * turbidity - 0.04586) * 0.5**-1.14


def write(file: Path, about: list[str], header: str, rows: list[str]) -> None:
    lines = [*(f"# {line}" for line in about), header, *rows]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> None:
    root = Path(sys.argv[1])
    shipped = root / "renderer" / "trace" / "src" / "light" / "daylight"
    data = root / "tests" / "data"
    kept = COEFFICIENTS[COEFFICIENTS["wavelength"] <= 2600]
    names = [
        "wavelength",
        "spectral_irradiance_et",
        "water_vapor_absorption",
        "ozone_absorption",
        "mixed_absorption",
    ]
    write(
        shipped / "spctrl2.csv",
        [
            "Extraterrestrial irradiance at the mean distance (W m-2 nm-1) and absorption "
            "by water vapour (cm-1),",
            "ozone (cm-1) and mixed gases, 300-2600 nm: Bird and Riordan 1984, "
            "SERI/TR-215-2436, table 2-1.",
        ],
        "nm,extraterrestrial,water,ozone,mixed",
        [",".join(f"{row[name]:.10g}" for name in names) for row in kept],
    )
    basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    nm = np.arange(300.0, 831.0, 10.0)
    columns = [[basis[name][value] for value in nm] for name in ("S0", "S1", "S2")]
    write(
        shipped / "cie_daylight.csv",
        [
            "Mean and first two components of daylight, 300-830 nm: CIE 015:2018, "
            "as tabulated in colour-science."
        ],
        "nm,s0,s1,s2",
        [",".join(f"{value:.6g}" for value in row) for row in zip(nm, *columns, strict=True)],
    )
    rows = []
    for number, (elevation, turbidity, ozone, water, pressure, albedo, day) in enumerate(
        ATMOSPHERES
    ):
        zenith = 90.0 - elevation
        airmass = pvlib.atmosphere.get_relative_airmass(zenith, model="kastenyoung1989")
        of = spectrl2(
            apparent_zenith=zenith,
            aoi=zenith,
            surface_tilt=0,
            ground_albedo=albedo,
            surface_pressure=pressure,
            relative_airmass=airmass,
            precipitable_water=water,
            ozone=ozone,
            aerosol_turbidity_500nm=optical_depth(turbidity),
            dayofyear=day,
        )
        for nm_, direct, diffuse in zip(
            of["wavelength"], of["dni"].ravel(), of["dhi"].ravel(), strict=True
        ):
            if 400 <= nm_ <= 2500:
                rows.append(f"{nm_:g},{number},{direct:.8g},{diffuse:.8g}")
    cases = ["; ".join(f"{value:g}" for value in case) for case in ATMOSPHERES]
    write(
        data / "daylight_reference.csv",
        [
            f"SPCTRL2 by pvlib {pvlib.__version__}: direct normal and diffuse horizontal "
            "irradiance, W m-2 nm-1.",
            "Cases: elevation (degrees); turbidity; ozone (atm-cm); water vapour (cm); "
            "pressure (Pa); albedo; day",
            *(f"case {number}: {case}" for number, case in enumerate(cases)),
        ],
        "nm,case,direct,diffuse",
        rows,
    )
    rows = []
    for latitude, longitude, time in PLACES:
        index = pd.DatetimeIndex([pd.Timestamp(time, tz="UTC")])
        sun = pvlib.solarposition.get_solarposition(
            index, latitude, longitude, pressure=101325, temperature=10
        )
        moment = index[0]
        hours = moment.hour + moment.minute / 60 + moment.second / 3600
        rows.append(
            f"{moment.year},{moment.month},{moment.day},{hours:.9g},{latitude:g},{longitude:g},"
            f"{sun['elevation'].iloc[0]:.6f},{sun['apparent_elevation'].iloc[0]:.6f},{sun['azimuth'].iloc[0]:.6f}"
        )
    write(
        data / "sun_position_reference.csv",
        [
            f"The sun by the NREL algorithm of Reda and Andreas (2004) in pvlib "
            f"{pvlib.__version__}: degrees, azimuth from north",
            "over east, apparent elevation with refraction at 101325 Pa and 10 degrees Celsius.",
        ],
        "year,month,day,hours_utc,latitude,longitude,elevation,apparent_elevation,azimuth",
        rows,
    )


if __name__ == "__main__":
    main()
