"""Files of scenes of clonal mosaics: maps, a cylinder, places of gills and petals."""

import math
import pathlib

import numpy as np
import OpenImageIO as oiio


def write(scenes: pathlib.Path) -> None:
    """Writes all of them into their scenes' folders."""
    grey(stripes(), scenes / "melons/stripes.png")
    (scenes / "melons/cylinder.obj").write_text(cylinder())
    # White, below, is where no cell may be.
    head = np.zeros((200, 400), np.uint8)
    head[165:] = 255
    grey(head, scenes / "fly-agaric/head.png")
    (scenes / "fly-agaric/gills.csv").write_text(gills())
    (scenes / "figures/petals.csv").write_text(petals())


def grey(picture: np.ndarray, out: pathlib.Path) -> None:
    """A picture of one channel as PNG."""
    image = oiio.ImageBuf(oiio.ImageSpec(picture.shape[1], picture.shape[0], 1, oiio.UINT8))
    image.set_pixels(oiio.ROI(), np.ascontiguousarray(picture[:, :, None]))
    image.write(str(out))


def stripes() -> np.ndarray:
    """Eleven wavy white stripes over a fifth of a map round a melon."""
    width, height, count, share = 1024, 512, 11, 0.2
    chance = np.random.default_rng(3)
    turn = np.linspace(0, 1, width, endpoint=False)
    up = np.linspace(0, 1, height)
    white = np.zeros((height, width), bool)

    def wave(bends: int, size: float) -> np.ndarray:
        return size * np.sin(2 * math.pi * (bends * up + chance.random()))

    for stripe in range(count):
        middle = (stripe + 0.5) / count + sum(
            wave(bends, 0.16 / count / bends * chance.normal()) for bends in (1, 3, 7, 12)
        )
        half = share / count / 2 * (1 + wave(7, 0.35))
        away = np.abs((turn[None, :] - middle[:, None] + 0.5) % 1 - 0.5)
        white |= away < half[:, None]
    return (255 * white).astype(np.uint8)


def cylinder() -> str:
    """The control cylinder of the melons in metres, open towards -y; u goes once round."""
    pieces, radius, height = 96, 0.16, 0.26
    first, last = math.pi * (0.5 - 0.62), math.pi * (0.5 + 0.62)
    angles = [first + (last - first) * piece / pieces for piece in range(pieces + 1)]
    lines = ["# The control cylinder, open towards the camera; u goes once round."]
    for angle in angles:
        for z in (-height / 2, height / 2):
            lines.append(f"v {radius * math.cos(angle):.5f} {radius * math.sin(angle):.5f} {z}")
    lines += [f"vt {angle / (2 * math.pi):.5f} {v}" for angle in angles for v in (0, 1)]
    for piece in range(pieces):
        corners = [2 * piece + corner for corner in (1, 2, 4, 3)]
        lines.append("f " + " ".join(f"{corner}/{corner}" for corner in corners))
    return "\n".join(lines) + "\n"


def gills() -> str:
    """Ninety gills round the axis of a cap."""
    rows = ["x_m,y_m,z_m,rotate_z_deg"]
    for gill in range(90):
        angle = 2 * math.pi * gill / 90
        place = f"{0.0325 * math.cos(angle):.5f},{0.0325 * math.sin(angle):.5f}"
        rows.append(f"{place},-0.002,{math.degrees(angle):.0f}")
    return "\n".join(rows) + "\n"


def petals() -> str:
    """Five petals of petunia, five of portulaca, and four rings of tagetes."""
    rows = ["x_m,y_m,z_m,rotate_x_deg,rotate_z_deg,shape"]
    rows += [f"-0.062,0,{0.0004 * (petal % 2)},14,{72 * petal + 8},petunia" for petal in range(5)]
    rows += [f"0,0,{0.0006 * (petal % 2)},22,{72 * petal - 10},portulaca" for petal in range(5)]
    rings = [
        (14, 4, 0.004, 0),
        (12, 24, 0.003, 0.002),
        (10, 44, 0.002, 0.004),
        (6, 66, 0.001, 0.005),
    ]
    for ring, (count, tilt, radius, z) in enumerate(rings):
        for petal in range(count):
            turn = 360 * petal / count + ring * 11
            angle, layer = math.radians(turn), petal % 3
            x, y = 0.06 - radius * math.sin(angle), radius * math.cos(angle)
            rows.append(
                f"{x:.4f},{y:.4f},{z + 0.0003 * layer:.4f},{tilt + 3 * layer},{turn:.1f},tagetes"
            )
    return "\n".join(rows) + "\n"
