"""The program's goniometer and the plugin of the leaf see the same leaf, without noise."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("mitsuba")

import csv
import math
import subprocess

import mitsuba as mi
import numpy as np
from mitsuba_leaves import WAVELENGTHS

from lamina.mitsuba import plugins
from validation.program import program

plugins.register()

AZIMUTH = 20.0
SCENE = f"""format = 1
[film.spectral]
bands_nm = [450, 550, 680, 800]
band_width_nm = 1
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, 0, 0.3]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
vertical_fov_deg = 20
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[meshes.blade.rectangle]
width_m = 0.05
height_m = 0.1
[objects.sample]
mesh = "blade"
material = "leaf"
[instruments.arm.gonio]
object = "sample"
spot = {{ at_mm = [1, 2], diameter_mm = 0.001 }}
incidence_deg = [0, 50, 82]
azimuth_deg = {AZIMUTH}
wavelengths_nm = [450, 550, 680, 800]
detector = {{ zenith_deg = [0, 45, 80], relative_azimuth_deg = [0, 70, 180] }}
[materials.leaf.leaf]
adaxial = {{ eta = 1.45, alpha_across = 0.35, alpha_along = 0.25 }}
abaxial = {{ eta = 1.4, alpha = 0.5 }}
"""
WITHERED = "contents = { water_cm = 0.003, dry_matter_g_per_cm2 = 0.004, structure = 2.3 }"
MEASURED = """[materials.leaf.leaf.measured]
reflectance = { table = [[440, 0.05], [550, 0.12], [680, 0.05], [810, 0.6]] }
abaxial_reflectance = { table = [[440, 0.09], [550, 0.19], [680, 0.09], [810, 0.6]] }
transmittance = { table = [[440, 0.01], [550, 0.1], [680, 0.02], [810, 0.4]] }
"""
LEAVES = {
    "green": 'preset = "sun-green"',
    "red": 'preset = "sweetgum-purple-red"\nabaxial_ratio = 2',
    "dead": 'preset = "brown-litter"',
    "withering": f'preset = "golden"\n{WITHERED}',
    "measured": MEASURED,
}


def direction(zenith: float, azimuth: float, side: float) -> tuple[float, float, float]:
    """A unit vector from degrees."""
    theta, phi = math.radians(zenith), math.radians(azimuth)
    ring = math.sin(theta)
    return ring * math.cos(phi), ring * math.sin(phi), side * math.cos(theta)


@pytest.mark.parametrize("name", LEAVES)
def test_goniometer_reads_what_the_plugin_says(name: str, tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE + LEAVES[name], encoding="utf-8")
    table, exported = tmp_path / "arm.csv", tmp_path / "exported"
    for words in (
        ("instruments", scene, "--rays", "512", "--out", table),
        ("export", "mitsuba", scene, "--out", exported),
    ):
        subprocess.run([str(program()), *map(str, words)], check=True, capture_output=True)
    with table.open(encoding="utf-8") as file:
        lines = (line for line in file if not line.startswith("#"))
        rows = [row for row in csv.DictReader(lines) if row["quantity"] in ("brdf", "btdf")]
    lit, seen = [], []
    for row in rows:
        side = 1.0 if row["face"] == "adaxial" else -1.0
        lit.append(direction(float(row["incidence_deg"]), AZIMUTH, side))
        beyond = side if row["quantity"] == "brdf" else -side
        azimuth = AZIMUTH + float(row["view_azimuth_deg"])
        seen.append(direction(float(row["view_zenith_deg"]), azimuth, beyond))

    origin = mi.Point3f(np.tile([[1.0], [2.0], [100.0]], len(rows)))
    ray = mi.Ray3f(origin, mi.Vector3f(0.0, 0.0, -1.0))
    ray.wavelengths = mi.UnpolarizedSpectrum(*WAVELENGTHS)
    loaded = mi.load_file(str(exported / "scene.xml"))
    si = loaded.ray_intersect(ray)
    si.wi = si.to_local(mi.Vector3f(np.array(seen).T))
    light = si.to_local(mi.Vector3f(np.array(lit).T))
    value = np.array(si.bsdf(ray).eval(mi.BSDFContext(), si, light)) / np.abs(np.array(light)[2])
    band = [WAVELENGTHS.index(float(row["wavelength_nm"])) for row in rows]
    want = value[band, np.arange(len(rows))]
    got = np.array([float(row["value"]) for row in rows])
    # Both tables of the coats' albedo are that exact at grazing angles.
    assert len(rows) == 3 * 9 * 4 * 4
    assert np.abs(got / want - 1.0).max() < 7e-4, rows[int(np.abs(got / want - 1.0).argmax())]
