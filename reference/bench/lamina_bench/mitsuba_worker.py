"""Renders with Mitsuba; also with Eradiate's build of it, whose scalar variants have a leaf.

Mitsuba 3.9.1 has no BSDF that reflects and transmits evenly with independent spectra, so a small
one is written here in Python. The LLVM variants compile it into their kernel, so that it costs
nothing; in a scalar variant every call would go through the interpreter. Eradiate's build of
Mitsuba has `bilambertian` in C++, which its `scalar_spectral` uses here.

Roulette and choice of lights are Mitsuba's defaults, and so is the sampler (independent numbers)
unless the job names another. The sun is a disc far away.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from time import perf_counter

import numpy as np

from . import spectra
from .job import Job, Picture, Renderer, cpu_seconds, serve

# Path samples a kernel launch: bounds the memory of a pass. One launch renders 64 samples of
# 512 × 512 pixels; a sampler that stratifies does so within a launch.
LAUNCH = 1 << 24
SUN_DISTANCE_M = 2000.0


def prepare(job: Job) -> tuple[str, Renderer]:
    """Loads the scene in the variant that the job names."""
    own = Path(sys.prefix, "lib", "libLLVM.so")
    if own.exists():
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", str(own))
    import mitsuba as mi

    variant = job.options["variant"]
    mi.set_variant(variant)
    mi.set_log_level(mi.LogLevel.Error)
    compiled = variant.startswith("llvm")
    if compiled:
        from . import mitsuba_leaf

        mitsuba_leaf.register()
    scene = mi.load_dict(describe(mi, job, "lamina_bench_leaf" if compiled else "bilambertian"))
    width, height = job.scene["size"]
    warm: set[int] = set()

    def render(spp: int, seed: int) -> Picture:
        passes = max(1, -(-width * height * spp // LAUNCH)) if compiled else 1
        while spp % passes:
            passes += 1
        each = spp // passes
        if compiled and each not in warm:
            # The first launch of a size pays for compiling it.
            np.array(mi.render(scene, spp=each, seed=1_000_003))
            warm.add(each)
        began, cpu = perf_counter(), cpu_seconds()
        total = np.zeros((height, width, 3))
        for part in range(passes):
            image = mi.render(scene, spp=each, seed=seed * 1000 + part)
            total += np.array(image, dtype=np.float64)[:, :, :3]
        wall = perf_counter() - began
        cpu = cpu_seconds() - cpu
        return Picture((total / passes).astype(np.float32), wall, cpu)

    return mi.__version__, render


def describe(mi: object, job: Job, leaf_type: str) -> dict:
    """The scene as Mitsuba's dictionary."""
    facts, spectral = job.scene, "spectral" in job.options["variant"]
    white = facts["rgb_of_light"]
    transform = mi.ScalarTransform4f
    camera = facts["camera"]
    nm, reflectance, transmittance = spectra.read()

    def grey(value: float) -> dict:
        return {"type": "uniform", "value": value} if spectral else {"type": "rgb", "value": value}

    def light(value: float) -> dict:
        # Mitsuba's D65 has the luminance 1.
        return {"type": "d65", "scale": white * value} if spectral else grey(white * value)

    def of_leaf(values: np.ndarray, rgb: list[float]) -> dict:
        if not spectral:
            # "rgb" would reach a BSDF in Python as three numbers, not as a texture.
            return {"type": "srgb", "color": list(rgb)}
        return {
            "type": "irregular",
            "wavelengths": ",".join(f"{value:g}" for value in nm),
            "values": ",".join(f"{value:g}" for value in values),
        }

    leaf = facts["leaf"]
    scene: dict = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1},
        "sensor": {
            "type": "perspective",
            "fov": camera["vertical_fov_deg"],
            "fov_axis": "y",
            "near_clip": 1e-3,
            "far_clip": 1e4,
            "to_world": transform().look_at(camera["position"], camera["look_at"], camera["up"]),
            "sampler": {"type": job.options.get("sampler", "independent")},
            "film": {
                "type": "hdrfilm",
                "width": facts["size"][0],
                "height": facts["size"][1],
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
        },
        "leaf-bsdf": {
            "type": leaf_type,
            "reflectance": of_leaf(reflectance, leaf["reflectance_rgb"]),
            "transmittance": of_leaf(transmittance, leaf["transmittance_rgb"]),
        },
        "ground": {
            "type": "ply",
            "filename": str(job.folder / facts["ground"]["mesh"]),
            "face_normals": True,
            "bsdf": {
                "type": "twosided",
                "bsdf": {"type": "diffuse", "reflectance": grey(facts["ground"]["reflectance"])},
            },
        },
    }
    mesh = {
        "type": "ply",
        "filename": str(job.folder / leaf["mesh"]),
        "face_normals": True,
        "bsdf": {"type": "ref", "id": "leaf-bsdf"},
    }
    placements = np.fromfile(job.folder / leaf["placements"], dtype="<f4").reshape(-1, 3, 4)
    matrices = [np.vstack([m, [0, 0, 0, 1]]).astype(np.float64) for m in placements]
    if len(matrices) == 1:
        scene["leaf"] = {**mesh, "to_world": transform(matrices[0])}
    else:
        scene["leaves"] = {"type": "shapegroup", "leaf": mesh}
        for number, matrix in enumerate(matrices):
            scene[f"leaf-{number}"] = {
                "type": "instance",
                "to_world": transform(matrix),
                "shapegroup": {"type": "ref", "id": "leaves"},
            }
    scene.update(lights(facts["lights"], job.folder, light, grey, transform))
    return scene


def lights(facts: dict, folder: Path, light: object, grey: object, transform: object) -> dict:
    """The scene's lights: a far disc and a constant sky, or a square."""
    if "lamp" in facts:
        lamp = facts["lamp"]
        return {
            "lamp": {
                "type": "rectangle",
                "to_world": transform(rectangle_matrix(np.array(lamp["corners"]))),
                "bsdf": {"type": "diffuse", "reflectance": grey(0.0)},
                "emitter": {"type": "area", "radiance": light(lamp["radiance"])},
            }
        }
    sun = facts["sun"]
    half = np.radians(0.5 * sun["angular_diameter_deg"])
    towards = SUN_DISTANCE_M * np.array(sun["towards"])
    place = transform().look_at(towards.tolist(), [0.0, 0.0, 0.0], [0.0, 0.0, 1.0])
    radius = float(SUN_DISTANCE_M * np.tan(half))
    return {
        "sun": {
            "type": "disk",
            "to_world": place @ transform().scale([radius, radius, 1.0]),
            "bsdf": {"type": "diffuse", "reflectance": grey(0.0)},
            "emitter": {
                "type": "area",
                "radiance": light(float(sun["irradiance"] / (np.pi * np.sin(half) ** 2))),
            },
        },
        "sky": {"type": "constant", "radiance": light(facts["sky"]["radiance"])},
    }


def rectangle_matrix(corners: np.ndarray) -> np.ndarray:
    """Takes Mitsuba's rectangle, from -1 to 1 with normal +z, to these corners."""
    along, across = 0.5 * (corners[1] - corners[0]), 0.5 * (corners[3] - corners[0])
    normal = np.cross(along, across)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1] = along, across
    matrix[:3, 2] = normal / np.linalg.norm(normal)
    matrix[:3, 3] = corners.mean(axis=0)
    return matrix


if __name__ == "__main__":
    serve(prepare)
