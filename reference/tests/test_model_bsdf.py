"""Surfaces between paint and metal in Mitsuba."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("mitsuba")

import drjit as dr
import mitsuba as mi
import numpy as np
from mitsuba_leaves import VIEWS, hit, throughputs


@pytest.fixture
def basis(tmp_path: Path) -> Path:
    """Spectra of red, green and blue of which white is 1."""
    file = tmp_path / "basis.csv"
    rows = "\n".join(f"{nm},0.5,0.3,0.2" for nm in (360, 595, 830))
    file.write_text(f"wavelength_nm,red,green,blue\n{rows}\n", encoding="utf-8")
    return file


def surface(basis: Path, colour: float, rough: float, metal: float, normal: str) -> mi.BSDF:
    """The same everywhere; `normal` as stored."""

    def texture(factor: str) -> dict:
        return {
            "type": "lamina_colours", "basis": str(basis), "repeats_u": 1.0, "repeats_v": 1.0,
            "tinted": False, "slot_0": f"-1e30 0 {factor}",
        }  # fmt: skip

    return mi.load_dict({
        "type": "lamina_model", "colours": texture(f"{colour} {colour} {colour}"),
        "finish": texture(f"1 {rough} {metal}"), "normals": texture(normal), "normal_scale_0": 1.0,
    })  # fmt: skip


FLAT = "0.5 0.5 1"


def test_white_paint_and_white_metal_send_back_all_light(basis: Path) -> None:
    for metal in (0.0, 0.4, 1.0):
        for rough in (0.3, 0.9):
            bsdf = surface(basis, 1.0, rough, metal, FLAT)
            for view in VIEWS:
                got, error = throughputs(bsdf, view)
                assert np.all(np.abs(got[0] - 1.0) < 4.0 * error[0] + 2e-3), (metal, rough, got)
                assert np.all(got[1] == 0.0)


def test_a_smooth_metal_reflects_its_colour(basis: Path) -> None:
    got, error = throughputs(surface(basis, 0.6, 0.1, 1.0, FLAT), (0.0, 0.0, 1.0))
    assert np.all(np.abs(got[0] - 0.6) < 4.0 * error[0] + 1e-3), got[0]


def test_a_surface_is_reciprocal_and_shines_about_its_own_normal(basis: Path) -> None:
    rng = np.random.default_rng(3)
    a, b = (rng.normal(size=(3, 4096)) for _ in range(2))
    a, b = (v / np.sqrt((v * v).sum(axis=0)) for v in (a, b))
    context = mi.BSDFContext()
    bsdf = surface(basis, 0.7, 0.6, 0.5, FLAT)
    there = np.array(bsdf.eval(context, hit(a), mi.Vector3f(b)) / dr.abs(mi.Float(b[2])))
    back = np.array(bsdf.eval(context, hit(b), mi.Vector3f(a)) / dr.abs(mi.Float(a[2])))
    assert np.all(np.abs(there - back) <= 2e-3 * there + 1e-6)

    # 0.6 along u, 0.8 upwards: the mirror image of the zenith is 2 · 0.8 n − z.
    bsdf = surface(basis, 1.0, 0.2, 1.0, "0.8 0.5 0.9")
    si = hit((0.0, 0.0, 1.0))
    si.dp_du = mi.Vector3f(1.0, 0.0, 0.0)
    values = [np.array(bsdf.eval(context, si, mi.Vector3f(x, 0.0, 0.28)))[0] for x in (0.96, -0.96)]
    assert values[0] > 50.0 * (values[1] + 1e-3), values
