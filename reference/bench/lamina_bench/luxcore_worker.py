"""Renders with LuxCore's PATHCPU engine.

The leaf is `mattetranslucent`, the even reflector and transmitter. The sampler is SOBOL, LuxCore's
default, without adaptive sampling; clamping and denoiser are off, all else is default.

LuxCore stops when its film notices that the samples are there, a little late: an answer tells how
many there were. The time is LuxCore's own, which starts when everything is built.
"""

from __future__ import annotations

import math
import os
import sys
from time import perf_counter, sleep

import numpy as np
import pyluxcore

from .job import Job, Picture, Renderer, cpu_seconds, serve

MOST_DEPTH = 1024
POLL_S = 0.005


def prepare(job: Job) -> tuple[str, Renderer]:
    """Builds LuxCore's scene once; each picture is a session of its own."""
    pyluxcore.Init()
    pyluxcore.SetLogHandler(lambda message: None)
    scene = pyluxcore.Scene()
    properties = pyluxcore.Properties()
    for name, value in describe(job).items():
        properties.Set(pyluxcore.Property(name, value))
    scene.Parse(properties)
    width, height = job.scene["size"]

    def render(spp: int, seed: int) -> Picture:
        config = pyluxcore.Properties()
        for name, value in configuration(width, height, spp, seed).items():
            config.Set(pyluxcore.Property(name, value))
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(config, scene))
        session.Start()
        began, cpu = perf_counter(), cpu_seconds()
        while not session.HasDone():
            sleep(POLL_S)
            session.UpdateStats()
        wall, cpu = perf_counter() - began, cpu_seconds() - cpu
        session.UpdateStats()
        stats = session.GetStats()
        seconds = stats.Get("stats.renderengine.time").GetFloat()
        samples = stats.Get("stats.renderengine.total.samplecount").GetFloat()
        session.Stop()
        pixels = np.empty(3 * width * height, dtype=np.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels, 0)
        # Rows count from below.
        rgb = pixels.reshape(height, width, 3)[::-1].copy()
        return Picture(rgb, seconds, cpu, samples / (width * height), {"waited_s": wall})

    return pyluxcore.Version(), render


def configuration(width: int, height: int, spp: int, seed: int) -> dict:
    """Properties of one picture."""
    return {
        "renderengine.type": "PATHCPU",
        "renderengine.seed": seed + 1,
        "sampler.type": "SOBOL",
        "sampler.sobol.adaptive.strength": 0.0,
        "path.pathdepth.total": MOST_DEPTH,
        "path.pathdepth.diffuse": MOST_DEPTH,
        "path.clamping.variance.maxvalue": 0.0,
        "film.width": width,
        "film.height": height,
        "film.filter.type": "NONE",
        "film.outputs.0.type": "RGB",
        "film.outputs.0.filename": "unused.exr",
        "batch.haltspp": [spp, 0],
    }


def describe(job: Job) -> dict:
    """The scene as LuxCore's properties."""
    facts = job.scene
    camera = facts["camera"]
    leaf, ground = facts["leaf"], facts["ground"]
    row = 2.0 / facts["size"][1]
    out = {
        "scene.camera.type": "perspective",
        "scene.camera.lookat.orig": list(camera["position"]),
        "scene.camera.lookat.target": list(camera["look_at"]),
        "scene.camera.up": list(camera["up"]),
        "scene.camera.fieldofview": camera["vertical_fov_deg"],
        # LuxCore's picture is one row lower than everybody else's: the window makes up for it.
        "scene.camera.screenwindow": [-1.0, 1.0, -1.0 - row, 1.0 - row],
        "scene.camera.cliphither": 1e-3,
        "scene.camera.clipyon": 1e4,
        "scene.camera.autovolume.enable": False,
        "scene.materials.leaf.type": "mattetranslucent",
        "scene.materials.leaf.kr": list(leaf["reflectance_rgb"]),
        # LuxCore transmits kt (1 - kr).
        "scene.materials.leaf.kt": [
            t / (1.0 - r)
            for r, t in zip(leaf["reflectance_rgb"], leaf["transmittance_rgb"], strict=True)
        ],
        "scene.materials.ground.type": "matte",
        "scene.materials.ground.kd": [ground["reflectance"]] * 3,
        "scene.shapes.leaf.type": "mesh",
        "scene.shapes.leaf.ply": str(job.folder / leaf["mesh"]),
        "scene.shapes.ground.type": "mesh",
        "scene.shapes.ground.ply": str(job.folder / ground["mesh"]),
        "scene.objects.ground.shape": "ground",
        "scene.objects.ground.material": "ground",
    }
    placements = np.fromfile(job.folder / leaf["placements"], dtype="<f4").reshape(-1, 3, 4)
    for number, matrix in enumerate(placements):
        name = f"scene.objects.leaf{number}"
        out[f"{name}.shape"] = "leaf"
        out[f"{name}.material"] = "leaf"
        # Column by column.
        whole = np.vstack([matrix, [0, 0, 0, 1]]).astype(np.float64)
        out[f"{name}.transformation"] = whole.T.ravel().tolist()
    out.update(lights(job))
    return out


def lights(job: Job) -> dict:
    """A disc at infinity and a constant sky, or a shining square."""
    white, facts = job.scene["rgb_of_light"], job.scene["lights"]
    if "lamp" in facts:
        radiance = [white * facts["lamp"]["radiance"]] * 3
        return {
            "scene.materials.lamp.type": "matte",
            "scene.materials.lamp.kd": [0.0, 0.0, 0.0],
            "scene.materials.lamp.emission": radiance,
            "scene.shapes.lamp.type": "mesh",
            "scene.shapes.lamp.ply": str(job.folder / facts["lamp"]["mesh"]),
            "scene.objects.lamp.shape": "lamp",
            "scene.objects.lamp.material": "lamp",
        }
    sun = facts["sun"]
    half = 0.5 * sun["angular_diameter_deg"]
    return {
        "scene.lights.sun.type": "distant",
        "scene.lights.sun.direction": [-float(value) for value in sun["towards"]],
        "scene.lights.sun.theta": half,
        # The gain is the disc's radiance.
        "scene.lights.sun.gain": [
            white * sun["irradiance"] / (math.pi * math.sin(math.radians(half)) ** 2)
        ]
        * 3,
        "scene.lights.sky.type": "constantinfinite",
        "scene.lights.sky.gain": [white * facts["sky"]["radiance"]] * 3,
    }


if __name__ == "__main__":
    serve(prepare)
    sys.stdout.flush()
    # LuxCore crashes when Python takes its objects down at the end.
    os._exit(0)
