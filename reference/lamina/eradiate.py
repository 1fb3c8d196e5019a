"""A scene or a leaf for Eradiate: `lamina-eradiate SCENE|PRESET --out FOLDER`.

Leaves, stalks, axes and fruits become the canopy of a scenario, which Eradiate's `load_scenario`
reads: all places of a material in an object are one mesh, because Eradiate turns no instance.

- In: a scene file or a preset, and options of `lamina export gltf`.
- Out, in FOLDER: `scenario.json` with R and T of each material from 400 to 2500 nm, and a PLY for
  each mesh, in metres, +z up, the canopy above the origin and the ground at z = 0; with discs, for
  each kind of blade a file for `LeafCloud.from_file`, and its spectra as CSV.
- Always true: the two faces of a blade are one mesh, whose R is the mean of theirs.
- Left out: lights, camera, angles at which surfaces scatter, glass and water.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import numpy.typing as npt

from lamina.gltf import Gltf
from lamina.program import Folders, LaminaError, Value, allowing, options_of, overrides, start

Array = npt.NDArray[Any]
SCENARIO = "scenario.json"
# Marks a folder that an export may replace.
MARK = "lamina.json"
# From +y up to +z up, for vertices as rows: x, -z, y.
Z_UP = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


@dataclass(eq=False)
class Part:
    """All places of a material in an object: vertices in metres with +z up, and triangles."""

    object: str
    material: str
    file: str
    """Name of its file, without the ending, and its own in the scenario."""
    extras: dict[str, list[float]]
    is_blade: bool
    vertices: list[Array]
    triangles: list[Array]


def to_eradiate(
    scene: str | Path,
    out: str | Path,
    values: Mapping[str, Value] | None = None,
    *,
    ground: str | None = None,
    discs: bool = False,
    allow: Folders = (),
    **options: Value,
) -> list[Path]:
    """Writes a scene or a preset as a canopy for Eradiate and gives the files.

    `ground` is the object whose material becomes that of the surface at z = 0; without, the surface
    is black. With `discs` each blade is a disc of its area. `values` sets keys as `lamina render
    -D` does; `allow` is as in `render`. `options` are those of `lamina export gltf` with `_` for
    `-`, such as `memory=4`. An earlier export in the folder `out` is replaced.
    """
    words = [*overrides("-D", values), *allowing(allow), *options_of(options)]
    return write(scene, Path(out), words, ground, discs)[0]


def write(
    scene: str | Path, out: Path, words: list[str], ground: str | None, discs: bool
) -> tuple[list[Path], str]:
    """What `to_eradiate` does, with options as words; and the notes on what was written."""
    if out.exists() and not (out / MARK).is_file():
        where = "name a new folder, or one that was exported before"
        raise LaminaError(f"{out} exists and holds no {MARK}: {where}", 2)
    if not out.parent.is_dir():
        raise LaminaError(f"{out}: there is no folder {out.parent}", 2)
    with TemporaryDirectory(dir=out.parent, prefix=f".{out.name}-") as folder:
        glb = Path(folder) / "scene.glb"
        _, notes = start(["export", "gltf", scene, "--spectra", "--out", glb, *words]).finished()
        gltf = Gltf.read(glb)
        parts = parts_of(gltf)
        soil = [part for part in parts if part.object == ground]
        canopy = [part for part in parts if part.object != ground]
        if ground is not None and not soil:
            known = ", ".join(sorted({part.object for part in parts}))
            raise LaminaError(f"--ground {ground}: the scene has no such object, only {known}", 2)
        if not canopy:
            raise LaminaError(f"{scene}: nothing but the ground {ground} is left for a canopy", 2)
        shift, size = settle(canopy, soil)
        made = Path(folder) / "made"
        made.mkdir()
        clouds = [part for part in canopy if discs and part.is_blade]
        for part in clouds:
            write_cloud(part, made, shift)
        meshes = [part for part in canopy if part not in clouds]
        for part in meshes:
            (made / f"{part.file}.ply").write_bytes(ply(part, shift))
        save(made / SCENARIO, scenario(meshes, soil, size))
        save(made / MARK, {"program": gltf.parts["asset"]["generator"]})
        names = [SCENARIO, *sorted({file.name for file in made.iterdir()} - {SCENARIO})]
        if out.exists():
            shutil.rmtree(out)
        made.replace(out)
    files = [out / name for name in names]
    x, y, z = size
    triangles = sum(len(own) for part in meshes for own in part.triangles)
    leaves = sum(len(part.vertices) for part in clouds)
    whole = sum(file.stat().st_size for file in files)
    about = f"{triangles} triangles, {leaves} discs, {whole} bytes"
    size_note = f"note: {x:.3f} m × {y:.3f} m × {z:.3f} m high, {about}"
    return files, "\n".join([*notes.splitlines()[:-1], size_note])


def save(file: Path, content: dict[str, Any]) -> None:
    file.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def parts_of(gltf: Gltf) -> list[Part]:
    """What a scene holds, by object and material."""
    found: dict[tuple[str, int], Part] = {}
    nodes = gltf.parts["nodes"]
    for root in gltf.parts["scenes"][0]["nodes"]:
        name = nodes[root]["name"].removesuffix(".mirrored")
        for node in (root, *nodes[root].get("children", ())):
            if "mesh" not in nodes[node]:
                continue
            places = list(places_of(gltf, nodes[node]))
            positions = set()
            for primitive in gltf.parts["meshes"][nodes[node]["mesh"]]["primitives"]:
                accessor, number = primitive["attributes"]["POSITION"], primitive["material"]
                # The backs of a blade, on the same places, are the blade once more.
                if accessor in positions:
                    continue
                positions.add(accessor)
                if (name, number) not in found:
                    found[name, number] = part_of(gltf, name, number)
                part = found[name, number]
                vertices = gltf.vectors(accessor).astype(np.float64)
                triangles = gltf.vectors(primitive["indices"]).reshape(-1, 3)
                for linear, moved in places:
                    part.vertices.append((vertices @ linear + moved) @ Z_UP)
                    mirrors = np.linalg.det(linear) < 0
                    part.triangles.append(triangles[:, ::-1] if mirrors else triangles)
    return list(found.values())


def part_of(gltf: Gltf, name: str, number: int) -> Part:
    """A part without places."""
    materials = gltf.parts["materials"]
    material = materials[number]
    if "KHR_materials_transmission" in material.get("extensions", {}):
        what = material["name"]
        raise LaminaError(f"{name}: {what} is clear, and Eradiate's canopies hold no glass", 2)
    if material.get("alphaMode") == "MASK":
        finer = "give the leaf a greater blade.max_edge_mm instead of --triangles"
        raise LaminaError(f"{name}: a mask cuts its blades, which Eradiate ignores; {finer}", 2)
    own = material["name"].removesuffix(".adaxial")
    extras = material["extras"]
    is_blade = own != material["name"]
    if is_blade:
        # The abaxial face's material follows that of the adaxial one.
        back = materials[number + 1]["extras"]["reflectance"]
        mean = (np.array(extras["reflectance"]) + np.array(back)) / 2
        extras = {**extras, "reflectance": mean.round(6).tolist()}
    # With its number, because names that differ may be the same as names of files.
    return Part(name, own, f"{plain(name)}-{plain(own)}-{number}", extras, is_blade, [], [])


def places_of(gltf: Gltf, node: dict[str, Any]) -> Iterator[tuple[Array, Array]]:
    """Where a node's mesh lies: what rows of vertices are multiplied by, and what is added."""
    attributes = gltf.extension(node, "EXT_mesh_gpu_instancing").get("attributes")
    outer, shift = placed(
        node.get("translation", (0, 0, 0)),
        node.get("rotation", (0, 0, 0, 1)),
        node.get("scale", (1, 1, 1)),
    )
    if attributes is None:
        yield outer, shift
        return
    keys = ("TRANSLATION", "ROTATION", "SCALE")
    for move, turn, scale in zip(*(gltf.vectors(attributes[key]) for key in keys), strict=True):
        linear, moved = placed(move, turn, scale)
        yield linear @ outer, moved @ outer + shift


def placed(move: Any, turn: Any, scale: Any) -> tuple[Array, Array]:
    """A place of glTF, with a quaternion x, y, z, w, for vertices as rows."""
    x, y, z, w = np.array(turn, np.float64) / np.linalg.norm(turn)
    columns = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    return np.diag(np.array(scale, np.float64)) @ columns.T, np.array(move, np.float64)


def settle(canopy: list[Part], soil: list[Part]) -> tuple[Array, Array]:
    """What brings the canopy above the origin and the ground to z = 0, and the canopy's size."""
    low, high = bounds(canopy)
    level = bounds(soil)[1][2] if soil else low[2]
    middle = (low + high) / 2
    size = np.array([*(high - low)[:2], high[2] - level])
    return -np.array([middle[0], middle[1], level]), size


def bounds(parts: list[Part]) -> tuple[Array, Array]:
    """The least and the greatest coordinates."""
    all_of = [own for part in parts for own in part.vertices]
    return np.min([own.min(0) for own in all_of], 0), np.max([own.max(0) for own in all_of], 0)


def plain(name: str) -> str:
    """A name as files and Eradiate have it."""
    return re.sub(r"[^A-Za-z0-9_-]", "_", name)


def ply(part: Part, shift: Array) -> bytes:
    """A part as binary PLY."""
    counts = np.cumsum([0, *(len(own) for own in part.vertices[:-1])])
    vertices = np.concatenate(part.vertices) + shift
    triangles = np.concatenate(
        [own.astype(np.int64) + count for own, count in zip(part.triangles, counts, strict=True)]
    )
    faces = np.empty(len(triangles), [("count", "u1"), ("vertices", "<u4", 3)])
    faces["count"], faces["vertices"] = 3, triangles
    head = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\n"
        "property list uchar uint vertex_indices\nend_header\n"
    )
    return head.encode() + vertices.astype("<f4").tobytes() + faces.tobytes()


def write_cloud(part: Part, folder: Path, shift: Array) -> None:
    """A part's blades as discs of their area: radius, centre and normal in each line, m."""
    rows = []
    for vertices, triangles in zip(part.vertices, part.triangles, strict=True):
        a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a) / 2
        areas = np.linalg.norm(normals, axis=1)
        centre = ((a + b + c) / 3 * areas[:, None]).sum(0) / areas.sum() + shift
        normal = normals.sum(0) / np.linalg.norm(normals.sum(0))
        rows.append([np.sqrt(areas.sum() / np.pi), *centre, *normal])
    np.savetxt(folder / f"{part.file}.txt", rows, fmt="%.8g")
    spectra = np.stack([part.extras[key] for key in ("wavelength_nm", *QUANTITIES)], 1)
    head = "wavelength_nm,reflectance,transmittance"
    file = folder / f"{part.file}.csv"
    np.savetxt(file, spectra, fmt="%.8g", delimiter=",", header=head, comments="")


QUANTITIES = ("reflectance", "transmittance")


def scenario(meshes: list[Part], soil: list[Part], size: Array) -> dict[str, Any]:
    """What `scenario.json` holds."""
    objects: dict[str, list[Part]] = {}
    for part in meshes:
        objects.setdefault(part.object, []).append(part)
    # The loader takes half of the size from the places of instances.
    place = np.eye(4)
    place[:2, 3] = size[:2] / 2
    elements = [
        {
            "canopy_element": {
                "type": "mesh_tree",
                "id": f"{plain(name)}-{number}",
                "mesh_tree_elements": [
                    {
                        "id": part.file,
                        "mesh_filename": f"{part.file}.ply",
                        "mesh_units": "meter",
                        **{key: spectrum(part, key) for key in QUANTITIES},
                    }
                    for part in parts
                ],
            },
            "instance_positions": [place.tolist()],
        }
        for number, (name, parts) in enumerate(objects.items())
    ]
    black = {"type": "uniform", "quantity": "reflectance", "value": 0.0}
    return {
        "surface": {
            "type": "lambertian",
            "reflectance": spectrum(soil[0], "reflectance") if soil else black,
        },
        "canopy": {
            "type": "discrete_canopy",
            "size": size.tolist(),
            "size_units": "meter",
            "instanced_canopy_elements": elements,
        },
    }


def spectrum(part: Part, quantity: str) -> dict[str, Any]:
    """A spectrum of Eradiate's."""
    return {
        "type": "interpolated",
        "quantity": quantity,
        "wavelengths": part.extras["wavelength_nm"],
        "wavelengths_units": "nm",
        "values": part.extras[quantity],
    }


def main(words: list[str] | None = None) -> int:
    """Writes a canopy; the exit codes of `lamina`."""
    parser = argparse.ArgumentParser(
        prog="lamina-eradiate",
        description="Writes a scene or a preset leaf as a canopy for Eradiate's load_scenario.",
        epilog="All other options are those of `lamina export gltf`: -D KEY=VALUE, --allow.",
        allow_abbrev=False,
    )
    parser.add_argument("scene", metavar="SCENE|PRESET")
    parser.add_argument("--out", type=Path, required=True, help="folder to write")
    parser.add_argument(
        "--ground", metavar="OBJECT", help="object that becomes the surface (default: it is black)"
    )
    parser.add_argument("--discs", action="store_true", help="write blades as discs of their area")
    given, others = parser.parse_known_args(words)
    try:
        files, notes = write(given.scene, given.out, others, given.ground, given.discs)
    except (LaminaError, OSError) as error:
        print(f"lamina-eradiate: {error}", file=sys.stderr)
        return error.code if isinstance(error, LaminaError) else 1
    except KeyboardInterrupt:
        return 130
    for file in files:
        print(file)
    print(notes, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
