"""The texture `lamina_colours` in Mitsuba."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

pytest.importorskip("mitsuba")

import mitsuba as mi
import numpy as np
from mitsuba_leaves import WAVELENGTHS

PROPERTIES = ("x", "y", "z", "u", "v", "tint_0", "tint_1", "tint_2")
# Three corners in the xy plane, each with a colour.
CORNERS = [
    (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.2, 0.0),
    (1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.4),
    (0.0, 1.0, 0.0, 0.0, 1.0, 0.5, 0.0, 1.0),
]


def triangle(file: Path) -> mi.Shape:
    """A triangle in a file as the program writes it."""
    lines = ["ply", "format binary_little_endian 1.0", "element vertex 3"]
    lines += [f"property float {name}" for name in PROPERTIES]
    lines += ["element face 1", "property list uchar uint vertex_indices", "end_header\n"]
    rows = b"".join(struct.pack("<8f", *corner) for corner in CORNERS)
    file.write_bytes("\n".join(lines).encode() + rows + struct.pack("<B3I", 3, 0, 1, 2))
    return mi.load_dict({"type": "ply", "filename": str(file), "face_normals": True})


def test_colours_of_vertices_are_factors_on_those_of_a_map(tmp_path: Path) -> None:
    basis = tmp_path / "basis.csv"
    # Red is 0.5, green 0.3, blue 0.1 at all wavelengths.
    rows = "\n".join(f"{nm},0.5,0.3,0.1" for nm in (360, 595, 830))
    basis.write_text(f"wavelength_nm,red,green,blue\n{rows}\n", encoding="utf-8")
    scene = mi.load_dict({"type": "scene", "shape": triangle(tmp_path / "triangle.ply")})
    weights = np.array([0.5, 0.3, 0.2])
    x, y = weights[1], weights[2]
    ray = mi.Ray3f(mi.Point3f(float(x), float(y), 1.0), mi.Vector3f(0.0, 0.0, -1.0))
    ray.wavelengths = mi.UnpolarizedSpectrum(WAVELENGTHS)
    hit = scene.ray_intersect(ray)
    factor = np.array([0.5, 1.0, 0.25])
    tint = weights @ np.array(CORNERS)[:, 5:]
    for tinted in (False, True):
        texture = mi.load_dict({
            "type": "lamina_colours", "basis": str(basis), "repeats_u": 1.0, "repeats_v": 1.0,
            "tinted": tinted, "slot_0": f"-1e30 0 {factor[0]} {factor[1]} {factor[2]}",
        })  # fmt: skip
        want = float((factor * (tint if tinted else 1.0)) @ [0.5, 0.3, 0.1])
        got = np.array(texture.eval(hit)).ravel()
        assert np.allclose(got, want, atol=1e-6), (tinted, got, want)
