"""The six scenes as plain data, the same for every program.

Close up (5,040 triangles), 300 leaves in one mesh (1.5 million triangles), 10,000 instances of
the leaf (50 million triangles as seen by rays); each under sun and sky, and under one square lamp.
Metres, z up. Light has the spectrum of D65; numbers of light are its value at 560 nm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import leaf

Vector = tuple[float, float, float]

SIZE = (512, 512)
GROUND_REFLECTANCE = 0.3
SUN_IRRADIANCE = 1.0
SKY_RADIANCE = 0.1
SUN_ELEVATION_DEG = 50.0
SUN_AZIMUTH_DEG = 130.0
SUN_DIAMETER_DEG = 0.53


@dataclass(frozen=True)
class Camera:
    """A pinhole."""

    position: Vector
    look_at: Vector
    vertical_fov_deg: float
    up: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Lamp:
    """A square that shines evenly to the side of its target."""

    centre: Vector
    target: Vector
    side_m: float
    radiance: float

    def corners(self) -> NDArray[np.float64]:
        """Four corners, `[4, 3]`, anticlockwise as seen from the target."""
        normal = np.subtract(self.target, self.centre)
        normal = normal / np.linalg.norm(normal)
        along = np.cross((0.0, 1.0, 0.0), normal)
        along = along / np.linalg.norm(along)
        across = np.cross(normal, along)
        half = 0.5 * self.side_m
        signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
        return np.array([self.centre + half * (a * along + b * across) for a, b in signs])


@dataclass(frozen=True)
class Setting:
    """What is rendered: where leaves are, from where they are seen, what lights them."""

    name: str
    title: str
    camera: Camera
    # `[count, 3, 4]`, local to world, of the leaf.
    placements: NDArray[np.float32]
    # Whether the leaves are written as one mesh.
    flat: bool
    ground_side_m: float
    # `None` is sun and sky.
    lamp: Lamp | None
    # Of the leaf, along and across.
    quads: tuple[int, int] = leaf.COARSE


def sun_direction() -> NDArray[np.float64]:
    """The unit vector towards the middle of the sun."""
    high, round_z = np.radians(SUN_ELEVATION_DEG), np.radians(SUN_AZIMUTH_DEG)
    return np.array([np.cos(high) * np.cos(round_z), np.cos(high) * np.sin(round_z), np.sin(high)])


def canopy(count: int, extent: Vector, lowest_m: float, seed: int) -> NDArray[np.float32]:
    """Leaves scattered evenly in a box that stands on the ground; most of them lie rather flat."""
    random = np.random.Generator(np.random.PCG64(seed))
    size = np.array(extent)
    middle = random.random((count, 3)) * size
    middle -= np.array([0.5 * size[0], 0.5 * size[1], -lowest_m])
    tilt = np.radians(70.0) * random.random(count)
    towards, own = 2.0 * np.pi * random.random((2, count))
    return np.concatenate(
        [_turns(towards, "z") @ _turns(tilt, "x") @ _turns(own, "z"), middle[:, :, None]], axis=2
    ).astype(np.float32)


def _turns(angle: NDArray[np.float64], axis: str) -> NDArray[np.float64]:
    """Rotations about an axis of the world, `[count, 3, 3]`."""
    c, s, none, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    rows = {
        "x": [[one, none, none], [none, c, -s], [none, s, c]],
        "z": [[c, -s, none], [s, c, none], [none, none, one]],
    }[axis]
    return np.moveaxis(np.array(rows), 2, 0)


def all_settings() -> list[Setting]:
    """The six, in the order of the tables."""
    tilt = _turns(np.array([np.radians(12.0)]), "x")
    one_leaf = np.concatenate([tilt, [[[0.0], [0.0], [0.03]]]], axis=2).astype(np.float32)
    bough = canopy(300, (0.45, 0.45, 0.35), 0.05, seed=300)
    stand = canopy(10_000, (2.6, 2.6, 1.2), 0.05, seed=10_000)
    close = Camera((0.0, -0.12, 0.20), (0.0, 0.0, 0.03), 20.0)
    near = Camera((0.0, -0.90, 0.75), (0.0, 0.0, 0.19), 33.0)
    far = Camera((0.0, -4.5, 3.5), (0.0, 0.0, 0.4), 33.0)
    parts = (
        ("close", "one leaf close up", close, one_leaf, False, 2.0,
         Lamp((0.12, 0.05, 0.35), (0.0, 0.0, 0.03), 0.10, 10.0)),
        ("mesh", "300 leaves in one mesh", near, bough, True, 40.0,
         Lamp((0.3, 0.2, 1.3), (0.0, 0.0, 0.2), 0.40, 10.0)),
        ("instances", "10,000 instances", far, stand, False, 40.0,
         Lamp((1.5, 1.0, 4.5), (0.0, 0.0, 0.5), 1.0, 20.0)),
    )  # fmt: skip
    return [
        Setting(f"{name}-{light}", f"{title}, {words}", camera, placements, flat, side,
                lamp if light == "lamp" else None)
        for name, title, camera, placements, flat, side, lamp in parts
        for light, words in (("sun", "sun + sky"), ("lamp", "one square lamp"))
    ]  # fmt: skip
