"""Solid tissue and relief in Mitsuba."""

from __future__ import annotations

import pytest

pytest.importorskip("mitsuba")

import csv
import itertools
import math
import tempfile
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np
from mitsuba_leaves import GREEN, TABLE, VIEWS, WAVELENGTHS, hit, spectrum, throughputs

from lamina.mitsuba import half_space, leaf_bsdf, prospect, relief_bsdf, tissue

ROOT = Path(__file__).resolve().parents[2]


def test_half_space_gives_the_anchors() -> None:
    lines = (ROOT / "tests" / "data" / "transport_anchors.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    rows = [row for row in rows if row["b"] == "inf"]
    assert len(rows) == 5
    for row in rows:
        got = half_space.reflectance(float(row["a"]), float(row["n"]))
        assert abs(got - float(row["R1"])) < 1.5e-6, (row["n"], row["a"], got)


def test_half_space_without_scattering_or_absorption() -> None:
    for n in (1.0, 1.33, 1.38, 1.5):
        assert half_space.reflectance(0.0, n) == ((n - 1.0) / (n + 1.0)) ** 2
        assert abs(half_space.reflectance(1e-9, n) - ((n - 1.0) / (n + 1.0)) ** 2) < 1e-9
        # R = 1 - c √(1 - a) near a = 1.
        lost = [1.0 - half_space.reflectance(1.0 - x * x, n) for x in (1e-3, 1e-4)]
        assert abs(lost[0] / lost[1] - 10.0) < 0.1, (n, lost)
        table = half_space.table(n)
        assert np.all(np.diff(table) < 0.0), n
        at = 0.37 * (half_space.COUNT - 1)
        between = np.interp(at, np.arange(half_space.COUNT), table)
        assert abs(between - half_space.reflectance(1.0 - 0.37**2, n)) < 1e-7, n


def solid(alpha: float, coat_eta: float, eta: float = 1.38) -> mi.BSDF:
    """Solid tissue with a hundred times less of everything than `GREEN` but water."""
    held = {name: 0.01 * value for name, value in GREEN.items()} | {"structure": 1.0, "water": 0.01}
    return mi.load_dict({
        "type": "lamina_solid", "tissue": "contents", "prospect": str(TABLE), **held,
        "depth_mm": 0.5, "scattering_per_mm": 1.2, "eta": eta,
        "coat_eta": coat_eta, "coat_alpha": alpha,
    })  # fmt: skip


def test_solid_gives_back_the_half_space() -> None:
    kind = tissue.Double
    model = prospect.Prospect(TABLE, kind, False)
    held = {name: 0.01 * value for name, value in GREEN.items()} | {"water": 0.01}
    held |= dict.fromkeys(prospect.OPTIONAL, 0.0)
    absorbed = np.array(model.absorbed(kind(*WAVELENGTHS), held)).ravel() / 0.5
    want = np.array([half_space.reflectance(1.2 / (1.2 + mu), 1.38) for mu in absorbed])
    for alpha, coat_eta, side in ((0.05, 1.33, 1.0), (0.3, 1.38, -1.0), (0.6, 1.45, 1.0)):
        got, error = throughputs(solid(alpha, coat_eta), (0.0, 0.0, side))
        assert np.all(np.abs(got[0] - want) < 4.0 * error[0] + 1e-4), (alpha, got[0], want)
        assert np.all(got[1] == 0.0), got[1]


def test_solid_is_reciprocal() -> None:
    rng = np.random.default_rng(8)
    a, b = (rng.normal(size=(3, 4096)) for _ in range(2))
    a, b = (v / np.sqrt((v * v).sum(axis=0)) for v in (a, b))
    bsdf = solid(0.25, 1.4)
    there = bsdf.eval(mi.BSDFContext(), hit(a), mi.Vector3f(b)) / dr.abs(mi.Float(b[2]))
    back = bsdf.eval(mi.BSDFContext(), hit(b), mi.Vector3f(a)) / dr.abs(mi.Float(a[2]))
    there, back = np.array(there), np.array(back)
    assert np.all(np.abs(there - back) <= 2e-3 * there + 1e-6)
    assert np.all(there[:, a[2] * b[2] < 0.0] == 0.0)


def tilted(slope: tuple[float, float], eta: float, folder: Path) -> tuple[mi.BSDF, mi.BSDF]:
    """A leaf whose faces have one slope everywhere: as relief, and by Mitsuba's own `normalmap`."""
    faces = {}
    for face in leaf_bsdf.FACES:
        faces |= {f"{face}_eta": eta, f"{face}_alpha_across": 0.3, f"{face}_alpha_along": 0.3}
    shares = {"reflectance": spectrum(0.4), "transmittance": spectrum(0.2)}
    plain = {"type": "lamina_leaf", "tissue": "measured", **shares, **faces}
    x, y = slope
    moments = np.tile(np.array([x, y, x * x, y * y] * 2, dtype=np.float32), (2, 2, 1))
    file = folder / f"relief-{x}-{y}.exr"
    mi.Bitmap(moments, channel_names=relief_bsdf.MOMENTS).write(str(file))
    normal = np.array([-x, -y, 1.0]) / math.sqrt(x * x + y * y + 1.0)
    texels = np.tile((0.5 * normal + 0.5).astype(np.float32), (2, 2, 1))
    bitmap = {"type": "bitmap", "bitmap": mi.Bitmap(texels), "raw": True, "format": "variant"}
    # Mitsuba softens terminators by default (Chiang et al. 2019); the relief does not.
    no_terminator = {"use_shadowing_function": False}
    return (
        mi.load_dict({**plain, "type": "lamina_relief", "relief": str(file)}),
        mi.load_dict({"type": "normalmap", "normalmap": bitmap, "leaf": plain, **no_terminator}),
    )


def test_a_slope_tilts_a_face_as_mitsubas_normalmap_does() -> None:
    """Reflection on the adaxial face is the same but for the light that the relief gives back."""
    with tempfile.TemporaryDirectory() as folder:
        for slope, eta in itertools.product(((0.2, 0.0), (-0.1, 0.3)), (1.0, 1.45)):
            ours, theirs = tilted(slope, eta, Path(folder))
            normal_z = 1.0 / math.sqrt(slope[0] ** 2 + slope[1] ** 2 + 1.0)
            back = 1.0 / (1.0 - 0.25 * (1.0 - normal_z))
            compared = 0
            for view, light in itertools.product(VIEWS[:2], repeat=2):
                si, wo = hit(view), mi.Vector3f(*light)
                dr.make_opaque(wo)
                a = np.array(ours.eval(mi.BSDFContext(), si, wo)).ravel()[0]
                b = np.array(theirs.eval(mi.BSDFContext(), si, wo)).ravel()[0]
                # Without a coat all light is the tissue's, which is given back; with one, less.
                least = back if eta == 1.0 else 1.0
                assert b > 0.0 and least - 1e-3 <= a / b <= back + 1e-3, (slope, eta, a / b, back)
                compared += 1
            assert compared == 4
