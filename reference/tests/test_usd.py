"""Holds exports to USD against OpenUSD's validators, MaterialX and Blender."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("pxr")
from pxr import Gf, Usd, UsdGeom, UsdShade, UsdValidation

import lamina
from lamina import usd
from lamina.gltf import Gltf
from validation.program import ROOT

# Grown leaves of two kinds and berries, many of each, and a ground without normals.
SCENE = ROOT / "scenes/instances/scene.toml"
# What a file for Apple's programs may hold.
APPLE = {"Xform", "Scope", "Mesh", "Material", "Shader"}
# A flat leaf of even colour, whose materials have no pictures.
FLAT = """
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.orthographic]
position_m = [0, 0, 0.3]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
height_m = 0.1
[materials.leaf.leaf]
adaxial = { eta = 1.45, alpha = 0.25 }
abaxial = { eta = 1.4, alpha = 0.5 }
[materials.leaf.leaf.contents]
structure = 1.6
chlorophyll_ug_per_cm2 = 45
carotenoids_ug_per_cm2 = 10
anthocyanins_ug_per_cm2 = 0.5
water_cm = 0.011
dry_matter_g_per_cm2 = 0.006
[meshes.card.rectangle]
width_m = 0.04
height_m = 0.08
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[objects.flat]
mesh = "card"
material = "leaf"
"""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The scene in each kind of file, and as glTF."""
    folder = tmp_path_factory.mktemp("usd")
    made = {ending: folder / f"leaves{ending}" for ending in usd.ENDINGS}
    for file in made.values():
        lamina.to_usd(SCENE, file, texture=64)
    made["glb"] = folder / "leaves.glb"
    lamina.run(["export", "gltf", SCENE, "--out", made["glb"]])
    return made


def errors(stage: Usd.Stage) -> Iterator[tuple[str, str]]:
    """What OpenUSD's validators, all of them, find in a stage."""
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    return ((error.GetName(), error.GetMessage()) for error in context.Validate(stage))


def shaders(stage: Usd.Stage) -> list[UsdShade.Shader]:
    return [UsdShade.Shader(prim) for prim in stage.Traverse() if prim.IsA(UsdShade.Shader)]


def value(stage: Usd.Stage, path: str, name: str) -> Any:
    return UsdShade.Shader.Get(stage, path).GetInput(name).Get()


def corners(file: Path) -> np.ndarray[Any, Any]:
    """The least and the greatest coordinates of all vertices of all places in a file of glTF."""
    gltf = Gltf.read(file)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)

    def visit(number: int) -> None:
        nonlocal low, high
        node = gltf.parts["nodes"][number]
        for child in node.get("children", []):
            visit(child)
        if "mesh" not in node:
            return
        own = gltf.extension(node, "EXT_mesh_gpu_instancing").get("attributes", {})
        lists = [gltf.vectors(own[key]) for key in ("TRANSLATION", "ROTATION", "SCALE") if own]
        usual = ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0])
        keys = ("translation", "rotation", "scale")
        alone = [[node.get(key, value)] for key, value in zip(keys, usual, strict=True)]
        for move, turn, scale in zip(*(lists or alone), strict=True):
            x, y, z, w = map(float, turn)
            matrix = np.array(Gf.Matrix3d(Gf.Quatd(w, x, y, z)))
            for primitive in gltf.parts["meshes"][node["mesh"]]["primitives"]:
                vertices = gltf.vectors(primitive["attributes"]["POSITION"])
                placed = (vertices * scale) @ matrix + move
                low, high = np.minimum(low, placed.min(0)), np.maximum(high, placed.max(0))

    for number in gltf.parts["scenes"][0]["nodes"]:
        visit(number)
    return np.array([low, high])


@pytest.mark.parametrize("ending", usd.ENDINGS)
def test_openusd_opens_and_validates_every_kind_of_file(
    ending: str, files: dict[str, Path]
) -> None:
    stage = Usd.Stage.Open(str(files[ending]))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert stage.GetDefaultPrim().GetPath() == "/instances"
    # usd-core comes without MaterialX and so knows none of its nodes.
    unknown = "MissingShaderIdInRegistry"
    found = [own for own in errors(stage) if own[0] != unknown or "'ND_" not in own[1]]
    assert not found
    assert ending != ".usdz" or not list(errors(stage))


@pytest.mark.parametrize("ending", usd.ENDINGS)
def test_all_places_of_the_scene_are_in_the_file(ending: str, files: dict[str, Path]) -> None:
    stage = Usd.Stage.Open(str(files[ending]))
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    places = Counter[str]()
    cache = UsdGeom.XformCache()
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdGeom.Mesh):
            continue
        points = np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get())
        matrices = [np.array(cache.GetLocalToWorldTransform(prim))]
        for parent in Usd.PrimRange.AllPrims(stage.GetDefaultPrim()):
            own = UsdGeom.PointInstancer(parent)
            if own and prim.GetPath().HasPrefix(parent.GetPath()):
                now = Usd.TimeCode.Default()
                moves = own.ComputeInstanceTransformsAtTime(now, now, own.ExcludeProtoXform)
                relative = matrices[0] @ np.linalg.inv(
                    np.array(cache.GetLocalToWorldTransform(parent))
                )
                outer = np.array(cache.GetLocalToWorldTransform(parent))
                matrices = [relative @ np.array(move) @ outer for move in moves]
        for matrix in matrices:
            placed = points @ matrix[:3, :3] + matrix[3, :3]
            low, high = np.minimum(low, placed.min(0)), np.maximum(high, placed.max(0))
        places[UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPath().name] += len(
            matrices
        )
    # Both faces of all leaves, and what has none; numbers of the scene file.
    gltf = Gltf.read(files["glb"])
    of_gltf = Counter[str]()
    for node in gltf.parts["nodes"]:
        if "mesh" in node:
            own_lists = gltf.extension(node, "EXT_mesh_gpu_instancing").get("attributes")
            count = len(gltf.vectors(own_lists["SCALE"])) if own_lists else 1
            for primitive in gltf.parts["meshes"][node["mesh"]]["primitives"]:
                name = gltf.parts["materials"][primitive["material"]]["name"]
                of_gltf[name.replace("-", "_").replace(".", "_")] += count
    assert places == of_gltf
    assert np.abs(np.array([low, high]) - corners(files["glb"])).max() < 2e-6


def test_the_variant_one_shows_the_adaxial_face_from_both_sides(files: dict[str, Path]) -> None:
    for ending in (".usda", ".usdz"):
        stage = Usd.Stage.Open(str(files[ending]))
        faces = stage.GetDefaultPrim().GetVariantSet("faces")

        def sides(stage: Usd.Stage = stage) -> dict[str, bool]:
            proxies = stage.Traverse(Usd.TraverseInstanceProxies())
            meshes = [UsdGeom.Mesh(prim) for prim in proxies if prim.IsA(UsdGeom.Mesh)]
            own = {mesh.GetPrim().GetName(): mesh.GetDoubleSidedAttr().Get() for mesh in meshes}
            return {name: is_double for name, is_double in own.items() if "leaf" in name}

        names = [f"leaf_{kind}_{face}" for kind in ("ovate", "broad") for face in ("ad", "ab")]
        assert faces.GetVariantSelection() == "two"
        assert sides() == {f"{name}axial": False for name in names}
        faces.SetVariantSelection("one")
        assert sides() == {f"{name}axial": True for name in names if name.endswith("ad")}


def test_what_is_let_through_is_in_the_standard_surface_and_missing_in_the_preview(
    tmp_path: Path,
) -> None:
    scene = tmp_path / "flat.toml"
    scene.write_text(FLAT, encoding="utf-8")
    file, glb = tmp_path / "flat.usda", tmp_path / "flat.glb"
    assert lamina.to_usd(scene, file) == [file]
    lamina.run(["export", "gltf", scene, "--out", glb])
    stage = Usd.Stage.Open(str(file))
    materials = Gltf.read(glb).parts["materials"]
    assert [own["name"] for own in materials] == ["material-leaf.adaxial", "material-leaf.abaxial"]
    for own, face in zip(materials, ("adaxial", "abaxial"), strict=True):
        through = own["extensions"]["KHR_materials_diffuse_transmission"]
        fraction = through["diffuseTransmissionFactor"]
        assert 0.05 < fraction < 0.5
        base = np.array(own["pbrMetallicRoughness"]["baseColorFactor"][:3])
        root = f"/{stage.GetDefaultPrim().GetName()}/Materials/material_leaf_{face}"
        preview, standard = f"{root}/preview", f"{root}/mtlx_surface"
        sent_back = base * (1 - fraction)
        assert np.allclose(value(stage, preview, "diffuseColor"), sent_back, atol=1e-6)
        assert np.allclose(value(stage, standard, "base_color"), base, atol=1e-6)
        assert value(stage, standard, "thin_walled") is True
        assert value(stage, standard, "subsurface") == pytest.approx(fraction, abs=1e-6)
        colour = through["diffuseTransmissionColorFactor"]
        assert np.allclose(value(stage, standard, "subsurface_color"), colour, atol=1e-6)
        assert value(stage, preview, "ior") == pytest.approx(1.45 if face == "adaxial" else 1.4)


def test_a_package_holds_what_apples_programs_read(files: dict[str, Path]) -> None:
    stage = Usd.Stage.Open(str(files[".usdz"]))
    assert {prim.GetTypeName() for prim in Usd.PrimRange.AllPrims(stage.GetDefaultPrim())} == APPLE
    assert {shader.GetIdAttr().Get()[:3] for shader in shaders(stage)} == {"Usd"}
    with zipfile.ZipFile(files[".usdz"]) as package:
        first, *others = package.namelist()
    assert first == "leaves.usdc"
    assert others and {Path(other).suffix for other in others} == {".png"}


@pytest.mark.parametrize("ending", usd.ENDINGS)
def test_the_same_scene_gives_the_same_bytes(
    ending: str, files: dict[str, Path], tmp_path: Path
) -> None:
    again = tmp_path / files[ending].name
    # In a process of its own: addresses in memory differ.
    code = "import sys; from lamina.usd import main; sys.exit(main())"
    words = [sys.executable, "-c", code, str(SCENE), "--texture", "64", "--out", str(again)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "reference"), "TZ": "Asia/Tokyo"}
    printed = subprocess.run(words, check=True, capture_output=True, text=True, env=environment)
    made = sorted(file for file in tmp_path.rglob("*") if file.is_file())
    for file in made:
        assert file.read_bytes() == (files[ending].parent / file.relative_to(tmp_path)).read_bytes()
    assert printed.stderr.endswith(f", {sum(file.stat().st_size for file in made)} bytes\n")
    assert printed.stdout == f"{again}\n"
    assert not list(tmp_path.glob(".*"))


@pytest.mark.needs("MaterialX")
def test_all_nodes_are_as_materialx_defines_them(tmp_path: Path) -> None:
    import MaterialX as mx

    library = mx.createDocument()
    folders, places = mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath()
    mx.loadLibraries(folders, places, library)
    types = {
        "asset": "filename",
        "bool": "boolean",
        "color3f": "color3",
        "color4f": "color4",
        "float2": "vector2",
        "float3": "vector3",
        "int": "integer",
        "token": "surfaceshader",
    }
    file = tmp_path / "bough.usdc"
    lamina.to_usd(ROOT / "scenes/bough/scene.toml", file, texture=64, triangles=500)
    checked = 0
    stage = Usd.Stage.Open(str(file))
    for shader in shaders(stage):
        kind = shader.GetIdAttr().Get()
        if not kind.startswith("ND_"):
            continue
        node = library.getNodeDef(kind)
        for own, named in [
            *((entry, node.getActiveInput) for entry in shader.GetInputs()),
            *((entry, node.getActiveOutput) for entry in shader.GetOutputs()),
        ]:
            word = str(own.GetTypeName())
            assert named(own.GetBaseName()).getType() == types.get(word, word), (kind, word)
            checked += 1
    assert checked > 100


BLENDER = """
import bpy, json, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=sys.argv[1])
places = bpy.context.evaluated_depsgraph_get().object_instances
meshes = [o.data for o in bpy.data.objects if o.type == "MESH"]
pictures = {}
for material in bpy.data.materials:
    nodes = material.node_tree.nodes
    images = [n.image for n in nodes if n.type == "TEX_IMAGE"]
    pictures[material.name] = [i.size[0] for i in images]
print("found:", json.dumps({
    "places": sum(p.object.type == "MESH" for p in places),
    "texcoords": {m.name: [layer.name for layer in m.uv_layers] for m in meshes},
    "height": max((p.matrix_world.translation.z for p in places)),
    "pictures": pictures,
}))
"""


@pytest.mark.needs("bpy")
@pytest.mark.parametrize("ending", usd.ENDINGS)
def test_blender_opens_every_kind_of_file(ending: str, files: dict[str, Path]) -> None:
    words = [sys.executable, "-c", BLENDER, str(files[ending])]
    printed = subprocess.run(words, check=True, capture_output=True, text=True, timeout=300)
    text = next(line for line in printed.stdout.splitlines() if line.startswith("found:"))
    found = json.loads(text.removeprefix("found:"))
    # Ten leaves with two faces each, four berries, and the ground.
    assert found["places"] == 23
    faces = [f"leaf_{kind}_{face}axial" for kind in ("ovate", "broad") for face in ("ad", "ab")]
    assert {name: found["texcoords"][name] for name in faces} == dict.fromkeys(faces, ["st"])
    assert {name: found["pictures"][name] for name in faces} == dict.fromkeys(faces, [64])
    assert 0 < found["height"] < 0.1


@pytest.mark.parametrize(
    ("out", "options", "said"),
    [
        ("leaf.usd", {}, "USD's files end in .usda, .usdc, .usdz"),
        ("none/leaf.usda", {}, "there is no folder"),
        ("leaf.usda", {"texture": 100}, "--texture"),
        ("leaf.usda", {"colour": 1}, "--colour"),
    ],
)
def test_bad_input_is_refused_and_leaves_nothing(
    out: str, options: dict[str, Any], said: str, tmp_path: Path
) -> None:
    with pytest.raises(lamina.LaminaError, match=said) as refused:
        lamina.to_usd(SCENE, tmp_path / out, **options)
    assert refused.value.code == 2
    assert not list(tmp_path.iterdir())
