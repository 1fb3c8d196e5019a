"""Yields of fluorescence over light and temperature: `reference/run fluorescence-yields`.

The steady-state yield of a C3 leaf after van der Tol et al. (2014), with photosynthesis after
Farquhar and Collatz, as SCOPE 1.71 computes it (`biochemical.m`, read; written anew here from its
equations). Of the light that chlorophyll absorbs, the rate constants of fluorescence K_f, heat
K_d, photochemistry K_p and regulated heat K_n share

    Φ_F = K_f / (K_f + K_d + K_n) (1 − Φ_P)
    K_n = K_0 (1 + β) x^α / (β + x^α),    x = 1 − Φ_P / Φ_P0.

The table is written to `reference/data/fluorescence_yields.csv`; a scene names it as
`fluorescence.yields`.
"""

import sys
from pathlib import Path

import numpy as np

OUT = Path(__file__).resolve().parents[1] / "data/fluorescence_yields.csv"
IRRADIANCES = (0, 25, 50, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1250, 1500, 2000, 2500)
TEMPERATURES_C = (5, 10, 15, 20, 25, 30, 35, 40)

# SCOPE's defaults: capacity at 25 °C, Ball and Berry's slope, and the loss of capacity by heat.
VCMAX25 = 60.0
BALL_BERRY_SLOPE = 8.0
HIGH_SLOPE, HIGH_MIDDLE_K = 0.3, 308.0
ABSORBED = 0.84  # of PAR, by chlorophyll; SCOPE takes what its canopy absorbs
CO2, OXYGEN, HUMIDITY = 410e-6, 0.209, 0.7  # bar, bar, relative, at 1 bar
COTTON = (2.48, 2.83, 0.114)  # K_0, α, β of unstressed cotton
DROUGHT = (5.01, 1.93, 10.0)
KF, KP = 0.05, 4.0


def smaller_root(curvature, a, b):
    """The smaller x with curvature x² − (a + b) x + a b = 0."""
    return (a + b - np.sqrt((a + b) ** 2 - 4 * curvature * a * b)) / (2 * curvature)


def steady_yield(par, temperature_c, regulated=COTTON, vcmax25=VCMAX25):
    """Photons that photosystems emit for each that they absorb."""
    q = (temperature_c - 25) / 10
    kelvin = temperature_c + 273.15
    kd = max(0.8738, 0.0301 * temperature_c + 0.0773)
    open_yield = KP / (KF + kd + KP)
    potential = 0.5 * open_yield * par * ABSORBED
    kc, ko = 350e-6 * 2.1**q, 0.450 * 1.2**q
    compensation = 0.5 * OXYGEN / (2600 * 0.75**q)
    vcmax = vcmax25 * 2.1**q / (1 + np.exp(HIGH_SLOPE * (kelvin - HIGH_MIDDLE_K)))
    inner = max(0.3 * CO2, CO2 * (1 - 1.6 / (BALL_BERRY_SLOPE * HUMIDITY)))
    per_electron = (inner - compensation) / (inner + 2 * compensation) / 5
    by_enzyme = vcmax * (inner - compensation) / (kc * (1 + OXYGEN / ko) + inner)
    by_light = potential * per_electron
    by_sink = vcmax25 / 2 * 1.8**q
    gross = smaller_root(0.98, smaller_root(0.8, by_enzyme, by_light), by_sink)
    photochemistry = open_yield * (gross / by_light if potential > 0 else 1.0)
    closed = max(0.0, 1 - photochemistry / open_yield)
    most, alpha, beta = regulated
    kn = most * (1 + beta) * closed**alpha / (beta + closed**alpha)
    return KF / (KF + kd + kn) * (1 - photochemistry)


def main():
    """Writes the table."""
    lines = ["irradiance_umol_m2_s,temperature_c,yield"]
    lines += [
        f"{par},{temperature},{steady_yield(par, temperature):.6f}"
        for temperature in TEMPERATURES_C
        for par in IRRADIANCES
    ]
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(OUT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
