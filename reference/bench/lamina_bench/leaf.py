"""One leaf as a mesh, by formula, and its binary PLY file.

- **In**: quads along the midrib and across.
- **Out**: positions (m) and triangles; the base at -y, the tip at +y, the adaxial side +z.
- **Always true**: 2 × along × across triangles, none degenerate; no normals are written, so that
  every program shades each triangle flat.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

LENGTH_M = 0.08
WIDTH_M = 0.05
FOLD_DEG = 14.0
CURL_DEG = 40.0
RUFFLE_M = 0.0025
RUFFLE_WAVES = 3.0
# Half the width of the blunt ends: a point would make degenerate triangles.
BLUNT_M = 0.0004
# Quads along and across: 5,040 triangles, and 504,000.
COARSE = (60, 42)
FINE = (600, 420)

Vertices = NDArray[np.float32]
Triangles = NDArray[np.int32]


def blade(along: int, across: int) -> tuple[Vertices, Triangles]:
    """A folded, curled and ruffled blade."""
    v, u = np.meshgrid(np.linspace(0.0, 1.0, along + 1), np.linspace(-1.0, 1.0, across + 1),
                       indexing="ij")  # fmt: skip
    half = BLUNT_M + 0.5 * WIDTH_M * np.sin(np.pi * v**0.8) ** 0.9
    x = u * half
    lift = np.abs(x) * np.tan(np.radians(FOLD_DEG))
    lift += RUFFLE_M * u**2 * np.sin(2.0 * np.pi * RUFFLE_WAVES * v + 0.7 * np.sign(u))
    # The midrib is an arc of a circle: what stands above it is lifted along the arc's normal.
    bend = np.radians(CURL_DEG)
    radius = LENGTH_M / bend
    angle = bend * (v - 0.5)
    y = (radius - lift) * np.sin(angle)
    z = radius - (radius - lift) * np.cos(angle)
    positions = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32)
    corner = (np.arange(along)[:, None] * (across + 1) + np.arange(across)[None, :]).ravel()
    a, b, c, d = corner, corner + 1, corner + across + 2, corner + across + 1
    triangles = np.stack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)], 1).reshape(-1, 3)
    return positions, triangles.astype(np.int32)


def flattened(
    positions: Vertices, triangles: Triangles, placements: NDArray[np.float32]
) -> tuple[Vertices, Triangles]:
    """One mesh of all placements, `[count, 3, 4]` local to world."""
    turned = np.einsum("nij,vj->nvi", placements[:, :, :3], positions) + placements[:, None, :, 3]
    offsets = np.arange(len(placements), dtype=np.int32) * len(positions)
    faces = triangles[None, :, :] + offsets[:, None, None]
    return turned.reshape(-1, 3).astype(np.float32), faces.reshape(-1, 3).astype(np.int32)


def write_ply(file: Path, positions: Vertices, triangles: Triangles) -> None:
    """Binary little-endian PLY with positions and triangles alone."""
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(positions)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    file.write_bytes(header.encode() + positions.astype("<f4").tobytes() + faces.tobytes())


def read_ply(file: Path) -> tuple[Vertices, Triangles]:
    """Reads what `write_ply` wrote."""
    data = file.read_bytes()
    header, _, body = data.partition(b"end_header\n")
    counts = [int(line.split()[2]) for line in header.splitlines() if line.startswith(b"element")]
    positions = np.frombuffer(body, dtype="<f4", count=3 * counts[0]).reshape(-1, 3)
    kind = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    faces = np.frombuffer(body, dtype=kind, count=counts[1], offset=positions.nbytes)
    return positions, faces["corners"].copy()
