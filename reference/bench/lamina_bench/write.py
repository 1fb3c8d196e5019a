"""Writes the scenes: `scene.json` with its assets for the peers, `scene.toml` for Lamina.

A scene's folder holds

- `leaf.ply`, or `leaves.ply` with all leaves in one mesh: metres, flat triangles;
- `placements.f32`: where the leaf stands, 3 × 4 matrices row by row, little-endian `float32`;
- `ground.ply`, and `lamp.ply` where there is a lamp (it shines to the side of its normals);
- `leaf-reflectance.csv`, `leaf-transmittance.csv`: wavelength in nm, value;
- `scene.json`: the rest, and names of these files; `scene.txt`: what of it the bare Embree tracer
  needs, a name and its numbers a line.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from . import leaf, scenes, spectra
from .scenes import Setting

# Anyone who reads a folder can tell whether it is of today's scenes.
FORMAT = 1


def write_scene(setting: Setting, folder: Path, size: tuple[int, int] = scenes.SIZE) -> Path:
    """Writes a scene's folder; gives its `scene.json`."""
    folder.mkdir(parents=True, exist_ok=True)
    mesh = leaf.blade(*setting.quads)
    if setting.flat:
        mesh = leaf.flattened(*mesh, setting.placements)
    leaf.write_ply(folder / "leaf.ply", *mesh)
    placements = setting.placements
    if setting.flat:
        placements = np.eye(3, 4, dtype=np.float32)[None]
    (folder / "placements.f32").write_bytes(placements.astype("<f4").tobytes())
    quad = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    half = 0.5 * setting.ground_side_m
    ground = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]])
    leaf.write_ply(folder / "ground.ply", ground.astype(np.float32), quad)
    _write_spectra(folder)
    if setting.lamp:
        corners = setting.lamp.corners().astype(np.float32)
        leaf.write_ply(folder / "lamp.ply", corners, quad)
    (folder / "scene.toml").write_text(lamina_scene(setting, placements, size), encoding="utf-8")
    facts = description(setting, len(mesh[1]), size)
    (folder / "scene.txt").write_text(plain_facts(facts), encoding="utf-8")
    file = folder / "scene.json"
    file.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
    return file


def _write_spectra(folder: Path) -> None:
    """Both of the leaf's spectra as tables that every program reads."""
    nm, reflectance, transmittance = spectra.read()
    for name, values in (("reflectance", reflectance), ("transmittance", transmittance)):
        rows = [f"{a:g},{b:g}" for a, b in zip(nm, values, strict=True)]
        (folder / f"leaf-{name}.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")


def description(setting: Setting, triangles: int, size: tuple[int, int]) -> dict:
    """What `scene.json` holds."""
    camera = setting.camera
    lights: dict = {
        "sun": {
            "towards": scenes.sun_direction().tolist(),
            "irradiance": scenes.SUN_IRRADIANCE,
            "angular_diameter_deg": scenes.SUN_DIAMETER_DEG,
        },
        "sky": {"radiance": scenes.SKY_RADIANCE},
    }
    if setting.lamp:
        lights = {
            "lamp": {
                "mesh": "lamp.ply",
                "corners": setting.lamp.corners().tolist(),
                "radiance": setting.lamp.radiance,
            }
        }
    return {
        "format": FORMAT,
        "name": setting.name,
        "title": setting.title,
        "size": list(size),
        "camera": {
            "position": camera.position,
            "look_at": camera.look_at,
            "up": camera.up,
            "vertical_fov_deg": camera.vertical_fov_deg,
        },
        "leaf": {
            "mesh": "leaf.ply",
            "placements": "placements.f32",
            "triangles": triangles,
            "reflectance_rgb": spectra.REFLECTANCE,
            "transmittance_rgb": spectra.TRANSMITTANCE,
            "reflectance": "leaf-reflectance.csv",
            "transmittance": "leaf-transmittance.csv",
        },
        "ground": {"mesh": "ground.ply", "reflectance": scenes.GROUND_REFLECTANCE},
        "lights": lights,
        # Light in a program without wavelengths: D65's luminance at the value 1.
        "rgb_of_light": spectra.D65_LUMINANCE,
    }


def plain_facts(facts: dict) -> str:
    """Lines of a name and its numbers."""
    camera, leaf_facts = facts["camera"], facts["leaf"]
    lines: dict[str, list] = {
        "size": facts["size"],
        "rgb_of_light": [facts["rgb_of_light"]],
        "leaf_reflectance": leaf_facts["reflectance_rgb"],
        "leaf_transmittance": leaf_facts["transmittance_rgb"],
        "ground_reflectance": [facts["ground"]["reflectance"]],
    }
    for key, value in camera.items():
        lines[f"camera_{key}"] = value if isinstance(value, tuple) else [value]
    for light, keys in facts["lights"].items():
        for key, value in keys.items():
            if key != "mesh":
                lines[f"{light}_{key}"] = np.ravel(value).tolist()
    return "".join(
        f"{name} {' '.join(repr(float(value)) for value in values)}\n"
        for name, values in lines.items()
    )


def lamina_scene(setting: Setting, placements: np.ndarray, size: tuple[int, int]) -> str:
    """The scene file for Lamina. A coat whose index is 1 reflects nothing."""
    camera = setting.camera
    lines = [
        f"# {setting.title}. Written by reference/bench; do not edit.",
        "format = 1",
        f'name = "{setting.name}"',
        "",
        "[film.rgb]",
        f"size = {list(size)}",
        "spp = 64",
        "filter_radius_px = 0",
        "",
        "[camera.perspective]",
        f"position_m = {list(camera.position)}",
        f"look_at_m = {list(camera.look_at)}",
        f"up = {list(camera.up)}",
        f"vertical_fov_deg = {camera.vertical_fov_deg}",
        "",
        "[materials.leaf.leaf]",
        "abaxial_ratio = 1",
        "adaxial = { eta = 1 }",
        "abaxial = { eta = 1 }",
        "",
        "[materials.leaf.leaf.measured]",
        'reflectance = { file = "leaf-reflectance.csv" }',
        'transmittance = { file = "leaf-transmittance.csv" }',
        "",
        "[materials.ground.diffuse]",
        f"reflectance = {scenes.GROUND_REFLECTANCE}",
        "",
        "[meshes.leaf.file]",
        'path = "leaf.ply"',
        "",
        "[meshes.ground.file]",
        'path = "ground.ply"',
        "",
        "[objects.ground]",
        'mesh = "ground"',
        'material = "ground"',
        "",
        *_lamina_lights(setting),
    ]
    for number, matrix in enumerate(placements):
        numbers = ", ".join(f"{value:.9g}" for value in matrix.ravel())
        lines += [
            "",
            f"[objects.leaf-{number}]",
            'mesh = "leaf"',
            'material = "leaf"',
            f"matrix = [{numbers}, 0, 0, 0, 1]",
        ]
    return "\n".join(lines) + "\n"


def _lamina_lights(setting: Setting) -> list[str]:
    """The blocks of light, and of the lamp's black square."""
    if setting.lamp is None:
        towards = [float(value) for value in scenes.sun_direction()]
        return [
            "[lights.sun.distant]",
            f"irradiance_w_m2_nm = {{ d65 = {scenes.SUN_IRRADIANCE} }}",
            f"towards = {towards}",
            f"angular_diameter_deg = {scenes.SUN_DIAMETER_DEG}",
            "",
            "[lights.sky.constant]",
            f"radiance_w_m2_sr_nm = {{ d65 = {scenes.SKY_RADIANCE} }}",
        ]
    return [
        "[materials.black.diffuse]",
        "reflectance = 0",
        "",
        "[meshes.lamp.file]",
        'path = "lamp.ply"',
        "",
        "[objects.lamp]",
        'mesh = "lamp"',
        'material = "black"',
        "",
        "[lights.lamp.area]",
        'object = "lamp"',
        f"radiance_w_m2_sr_nm = {{ d65 = {setting.lamp.radiance} }}",
    ]


def write_all(
    folder: Path, names: list[str] | None = None, size: tuple[int, int] = scenes.SIZE
) -> list[Path]:
    """Writes the named scenes, or all of them; gives their `scene.json`."""
    known = {setting.name: setting for setting in scenes.all_settings()}
    wanted = list(known) if names is None else names
    return [write_scene(known[name], folder / name, size) for name in wanted]
