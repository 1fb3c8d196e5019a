"""Surfaces of grains in Mitsuba."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("mitsuba")

import drjit as dr
import mitsuba as mi
import numpy as np
from mitsuba_leaves import VIEWS, hit, spectrum, throughputs

import lamina

NUMBERS = {"asymmetry": 0.4, "backward": 0.3, "opposition": 0.9}
SCENE = """
format = 1
film.spectral = { size = [8, 8], spp = 1, bands_nm = [550] }
meshes.sheet.rectangle = { width_m = 1, height_m = 1 }
objects.sheet = { mesh = "sheet", material = "soil" }

[camera.orthographic]
position_m = [0, 0, 1]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
height_m = 1

[materials.soil.hapke]
albedo = 0.7
asymmetry = 0.4
backward = 0.3
opposition = 0.9
opposition_width = 0.05

[instruments.arm.gonio]
object = "sheet"
faces = "adaxial"
incidence_deg = [0, 30, 70]
wavelengths_nm = [550]
detector = { zenith_deg = [-75, -30, 0, 29, 30, 60], relative_azimuth_deg = [0, 50, 90] }
"""


def soil(albedo: float, **others: float) -> mi.BSDF:
    """Grains of one albedo."""
    numbers = {"width": 0.05} | NUMBERS | others
    return mi.load_dict({"type": "lamina_hapke", "albedo": spectrum(albedo), **numbers})


def towards(zenith: float, azimuth: float) -> tuple[float, float, float]:
    """A direction by its angles in degrees."""
    theta, phi = np.radians(zenith), np.radians(azimuth)
    sin = np.sin(theta)
    return float(sin * np.cos(phi)), float(sin * np.sin(phi)), float(np.cos(theta))


def test_values_are_those_of_the_program(tmp_path: Path) -> None:
    file = tmp_path / "soil.toml"
    file.write_text(SCENE, encoding="utf-8")
    measured = lamina.instruments(file, rays=512)["arm"].brdf.sel(face="adaxial", wavelength=550)
    bsdf, context = soil(0.7), mi.BSDFContext()
    for incidence in measured.incidence.values:
        for azimuth in measured.view_azimuth.values:
            for zenith in measured.view_zenith.values:
                own = measured.sel(
                    incidence=incidence, view_azimuth=azimuth, view_zenith=zenith
                ).item()
                wo = mi.Vector3f(*towards(zenith, azimuth))
                value = np.array(bsdf.eval(context, hit(towards(incidence, 0.0)), wo)).ravel()[0]
                value /= abs(np.cos(np.radians(zenith)))
                assert abs(value - own) < 2e-4 * own, (incidence, azimuth, zenith, value, own)


def test_what_is_drawn_has_the_albedo_that_values_integrate_to() -> None:
    bsdf, context = soil(0.7), mi.BSDFContext()
    rng = np.random.default_rng(2)
    count = 1 << 16
    z, phi = rng.random(count), 2.0 * np.pi * rng.random(count)
    sin = np.sqrt(1.0 - z * z)
    up = mi.Vector3f(sin * np.cos(phi), sin * np.sin(phi), z)
    for view in VIEWS:
        side = mi.Vector3f(up.x, up.y, dr.mulsign(up.z, mi.Float(view[2])))
        values = np.array(bsdf.eval(context, hit(view), side))[0] * 2.0 * np.pi
        got, error = throughputs(bsdf, view)
        off = abs(got[0][0] - values.mean())
        noise = np.hypot(error[0][0], values.std() / np.sqrt(count))
        assert off < 4.0 * noise, (view, got, values.mean())
        assert np.all(got[1] == 0.0)
