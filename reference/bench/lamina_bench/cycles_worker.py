"""Renders with Cycles, through Blender's Python module `bpy`.

The leaf is the sum of a diffuse and a translucent shader, which is the even reflector and
transmitter that the other programs render. Adaptive sampling, denoiser, clamping and the threshold
that skips weak lights are off; bounces are practically unlimited. All else is Cycles' default.

The time is what Cycles itself writes into its picture: the render without synchronisation, in
hundredths of a second. Processor time is that of the whole call; what a picture of one sample a
pixel takes is nearly all synchronisation, so that the render's own is
(cpu(N) − cpu(1)) N / (N − 1).
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

from . import leaf
from .job import Job, Picture, Renderer, cpu_seconds, serve

MOST_BOUNCES = 1024
_RENDER_TIME = re.compile(rb"cycles\.[^\0]*\.render_time\0string\0....([0-9:.]+)", re.DOTALL)


def prepare(job: Job) -> tuple[str, Renderer]:
    """Builds the scene in Blender."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    settings(scene, job.scene)
    camera(scene, job.scene["camera"])
    white = job.scene["rgb_of_light"]
    facts = job.scene["leaf"]
    blade = mesh("leaf", job.folder / facts["mesh"],
                 leaf_material(facts["reflectance_rgb"], facts["transmittance_rgb"]))  # fmt: skip
    placements = np.fromfile(job.folder / facts["placements"], dtype="<f4").reshape(-1, 3, 4)
    for matrix in placements:
        put(scene, blade).matrix_world = Matrix([*matrix.tolist(), (0, 0, 0, 1)])
    grey = [job.scene["ground"]["reflectance"]] * 3
    put(scene, mesh("ground", job.folder / job.scene["ground"]["mesh"],
                    leaf_material(grey, None)))  # fmt: skip
    lights(scene, job.scene["lights"], white)
    synchronisation = 0.0

    def render(spp: int, seed: int) -> Picture:
        scene.cycles.samples = spp
        scene.cycles.seed = seed
        file = Path(job.options["scratch"], f"cycles-{seed}.exr")
        scene.render.filepath = str(file)
        before = cpu_seconds()
        bpy.ops.render.render(write_still=True)
        cpu = cpu_seconds() - before
        if spp > 1:
            cpu = (cpu - synchronisation) * spp / (spp - 1)
        picture = read(file, job.scene["size"])
        wall = own_seconds(file)
        file.unlink()
        return Picture(picture, wall, cpu)

    # The first render hands the scene over and builds the tree; persistent data keep both.
    render(1, 0)
    synchronisation = render(1, 0).cpu_s
    return bpy.app.version_string, render


def settings(scene: bpy.types.Scene, facts: dict) -> None:
    """Picture and integrator."""
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = True
    scene.render.resolution_x, scene.render.resolution_y = facts["size"]
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "NONE"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.blur_glossy = 0.0
    cycles.pixel_filter_type = "BOX"
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max", "volume"):
        setattr(cycles, f"{kind}_bounces", MOST_BOUNCES)


def camera(scene: bpy.types.Scene, facts: dict) -> None:
    """A pinhole that looks along its -z, up is its +y."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(facts["vertical_fov_deg"])
    data.clip_start, data.clip_end = 1e-3, 1e4
    stand = bpy.data.objects.new("camera", data)
    position, up = Vector(facts["position"]), Vector(facts["up"])
    back = (position - Vector(facts["look_at"])).normalized()
    right = up.cross(back).normalized()
    rows = np.eye(4)
    rows[:3, 0], rows[:3, 1], rows[:3, 2], rows[:3, 3] = right, back.cross(right), back, position
    stand.matrix_world = Matrix(rows.tolist())
    scene.collection.objects.link(stand)
    scene.camera = stand


def leaf_material(reflectance: list[float], transmittance: list[float] | None) -> object:
    """Diffuse, and translucent if it transmits; colours are linear."""
    material = bpy.data.materials.new("even")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*reflectance, 1.0)
    shader = diffuse.outputs[0]
    if transmittance is not None:
        translucent = tree.nodes.new("ShaderNodeBsdfTranslucent")
        translucent.inputs["Color"].default_value = (*transmittance, 1.0)
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(shader, both.inputs[0])
        tree.links.new(translucent.outputs[0], both.inputs[1])
        shader = both.outputs[0]
    tree.links.new(shader, out.inputs["Surface"])
    return material


def mesh(name: str, file: Path, material: object) -> bpy.types.Mesh:
    """A mesh of flat triangles."""
    positions, triangles = leaf.read_ply(file)
    data = bpy.data.meshes.new(name)
    data.vertices.add(len(positions))
    data.vertices.foreach_set("co", positions.ravel())
    data.loops.add(triangles.size)
    data.loops.foreach_set("vertex_index", triangles.ravel())
    data.polygons.add(len(triangles))
    data.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    data.update(calc_edges=True)
    data.shade_flat()
    data.materials.append(material)
    return data


def put(scene: bpy.types.Scene, data: bpy.types.Mesh) -> bpy.types.Object:
    """An object that shows a mesh; objects of one mesh are instances."""
    shown = bpy.data.objects.new(data.name, data)
    scene.collection.objects.link(shown)
    return shown


def lights(scene: bpy.types.Scene, facts: dict, white: float) -> None:
    """Sun and sky, or a square area light, which shines along its -z."""
    if "lamp" in facts:
        corners = np.array(facts["lamp"]["corners"])
        along, across = corners[1] - corners[0], corners[3] - corners[0]
        light = bpy.data.lights.new("lamp", "AREA")
        light.shape = "SQUARE"
        light.size = float(np.linalg.norm(along))
        # An area light of power P has the radiance P / (π A).
        area = float(np.linalg.norm(np.cross(along, across)))
        light.energy = white * facts["lamp"]["radiance"] * np.pi * area
        back = -np.cross(along, across) / area
        rows = np.eye(4)
        rows[:3, 0] = along / light.size
        rows[:3, 1] = np.cross(back, rows[:3, 0])
        rows[:3, 2], rows[:3, 3] = back, corners.mean(axis=0)
    else:
        sun = facts["sun"]
        light = bpy.data.lights.new("sun", "SUN")
        light.energy = white * sun["irradiance"]
        light.angle = math.radians(sun["angular_diameter_deg"])
        rows = np.array(Vector(sun["towards"]).to_track_quat("Z", "Y").to_matrix().to_4x4())
        world = bpy.data.worlds.new("sky")
        world.use_nodes = True
        background = world.node_tree.nodes["Background"]
        background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        background.inputs["Strength"].default_value = white * facts["sky"]["radiance"]
        scene.world = world
    light.cycles.max_bounces = MOST_BOUNCES
    stand = bpy.data.objects.new(light.name, light)
    stand.matrix_world = Matrix(rows.tolist())
    scene.collection.objects.link(stand)


def read(file: Path, size: list[int]) -> np.ndarray:
    """Linear RGB of a picture that Blender wrote."""
    image = bpy.data.images.load(str(file))
    pixels = np.empty(4 * size[0] * size[1], dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    # Blender counts rows from below.
    return pixels.reshape(size[1], size[0], 4)[::-1, :, :3].copy()


def own_seconds(file: Path) -> float:
    """What Cycles says in the picture's header: hours, minutes and seconds."""
    found = _RENDER_TIME.search(file.read_bytes()[:65536])
    if found is None:
        raise RuntimeError("Cycles wrote no render time into its picture")
    seconds = 0.0
    for part in found[1].decode().split(":"):
        seconds = 60.0 * seconds + float(part)
    return seconds


if __name__ == "__main__":
    serve(prepare)
