"""A stage of USD with what a file of glTF holds.

All is below one prim, the default one: materials, and a prim for each node. A mesh of several nodes
is a class that they inherit, as instances. The two faces of a leaf are two meshes, each seen from
its own side; the variant `one` of the set `faces` shows the adaxial one from both sides instead.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Kind, Sdf, Tf, Usd, UsdGeom, UsdShade, Vt

from lamina.gltf import Gltf
from lamina.usd_surfaces import Surfaces

INSTANCES = "EXT_mesh_gpu_instancing"
FACES = "faces"


class Stage:
    """A file that is being written."""

    def __init__(self, gltf: Gltf, pictures: list[str], layer: Path, has_materialx: bool) -> None:
        """Begins a file, with a path for the picture of each texture."""
        self.gltf = gltf
        self.stage = Usd.Stage.CreateNew(str(layer))
        UsdGeom.SetStageUpAxis(self.stage, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(self.stage, 1.0)
        self.stage.SetMetadata("documentation", gltf.parts["asset"]["generator"])
        name = gltf.parts["scenes"][0]["name"]
        self.root = UsdGeom.Xform.Define(self.stage, f"/{Tf.MakeValidIdentifier(name)}")
        self.root.GetPrim().SetDisplayName(name)
        self.stage.SetDefaultPrim(self.root.GetPrim())
        Usd.ModelAPI(self.root).SetKind(Kind.Tokens.component)
        self.taken: set[Sdf.Path] = set()
        self.surfaces = Surfaces(gltf, pictures, has_materialx)
        self.materials = self.with_materials()
        # Meshes of two faces: the adaxial one, and the abaxial one on its back.
        self.backs: list[tuple[Sdf.Path, Sdf.Path]] = []
        uses = Counter(node["mesh"] for node in gltf.parts["nodes"] if "mesh" in node)
        several = [mesh for mesh, count in uses.items() if count > 1]
        self.prototypes = {mesh: self.prototype(mesh) for mesh in several}

    def write(self, one_face: bool) -> None:
        """Writes the file."""
        for node in self.gltf.parts["scenes"][0]["nodes"]:
            self.add_node(node, self.root.GetPath())
        if self.backs:
            self.add_variants(one_face)
        boxes = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default", "render"])
        about = UsdGeom.ModelAPI.Apply(self.root.GetPrim())
        about.SetExtentsHint(about.ComputeExtentsHint(boxes))
        self.stage.GetRootLayer().Save()

    def path(self, parent: Sdf.Path, name: str) -> Sdf.Path:
        """A path below another for what has a name; no other has it."""
        word = Tf.MakeValidIdentifier(name)
        path, number = parent.AppendChild(word), 1
        while path in self.taken:
            number += 1
            path = parent.AppendChild(f"{word}_{number}")
        self.taken.add(path)
        return path

    def xform(self, parent: Sdf.Path, name: str) -> UsdGeom.Xform:
        return UsdGeom.Xform.Define(self.stage, self.path(parent, name))

    def with_materials(self) -> list[UsdShade.Material]:
        meshes = self.gltf.parts["meshes"]
        primitives = [primitive for mesh in meshes for primitive in mesh["primitives"]]
        tinted = {own["material"] for own in primitives if "COLOR_0" in own["attributes"]}
        scope = self.path(self.root.GetPath(), "Materials")
        UsdGeom.Scope.Define(self.stage, scope)
        made = []
        for number, material in enumerate(self.gltf.parts["materials"]):
            path = self.path(scope, material["name"])
            own = UsdShade.Material.Define(self.stage, path)
            own.GetPrim().SetDisplayName(material["name"])
            self.surfaces.add(own, number, number in tinted)
            made.append(own)
        return made

    def prototype(self, mesh: int) -> Sdf.Path:
        """A mesh of several nodes: a class that each of them inherits."""
        scope = self.root.GetPath().AppendChild("Prototypes")
        UsdGeom.Scope.Define(self.stage, scope)
        self.taken.add(scope)
        prim = self.xform(scope, self.gltf.parts["meshes"][mesh]["name"]).GetPrim()
        prim.SetSpecifier(Sdf.SpecifierClass)
        self.add_meshes(mesh, prim.GetPath())
        return prim.GetPath()

    def add_node(self, number: int, parent: Sdf.Path) -> None:
        node = self.gltf.parts["nodes"][number]
        instances = self.gltf.extension(node, INSTANCES)
        if instances:
            path = self.path(parent, node["name"])
            place: UsdGeom.Xformable = UsdGeom.PointInstancer.Define(self.stage, path)
        else:
            place = self.xform(parent, node["name"])
        move(place, node)
        if instances:
            self.add_instances(place, node["mesh"], instances["attributes"])
        elif "mesh" in node:
            self.add_mesh(node["mesh"], place.GetPrim(), may_share=True)
        for child in node.get("children", ()):
            self.add_node(child, place.GetPath())

    def add_mesh(self, mesh: int, prim: Usd.Prim, may_share: bool) -> None:
        """Shows a mesh by a prim."""
        if mesh in self.prototypes:
            prim.GetInherits().AddInherit(self.prototypes[mesh])
            prim.SetInstanceable(may_share)
        else:
            self.add_meshes(mesh, prim.GetPath())

    def add_instances(
        self, places: UsdGeom.PointInstancer, mesh: int, attributes: dict[str, int]
    ) -> None:
        name = self.gltf.parts["meshes"][mesh]["name"]
        prototype = self.xform(places.GetPath(), name)
        self.add_mesh(mesh, prototype.GetPrim(), may_share=False)
        positions, turns, scales = (
            np.ascontiguousarray(self.gltf.vectors(attributes[key]), np.float32)
            for key in ("TRANSLATION", "ROTATION", "SCALE")
        )
        places.CreatePrototypesRel().AddTarget(prototype.GetPath())
        places.CreateProtoIndicesAttr(Vt.IntArray(len(positions), 0))
        places.CreatePositionsAttr(Vt.Vec3fArray.FromNumpy(positions))
        # Halves for programs that know no others; the floats count where both are known.
        places.CreateOrientationsAttr(Vt.QuathArray.FromNumpy(turns.astype(np.float16)))
        places.CreateOrientationsfAttr(Vt.QuatfArray.FromNumpy(turns))
        places.CreateScalesAttr(Vt.Vec3fArray.FromNumpy(scales))
        now = Usd.TimeCode.Default()
        places.CreateExtentAttr(places.ComputeExtentAtTime(now, now))

    def add_meshes(self, mesh: int, parent: Sdf.Path) -> None:
        """A mesh of glTF, which is one of USD for each of its surfaces."""
        adaxial: tuple[int, Sdf.Path] | None = None
        for primitive in self.gltf.parts["meshes"][mesh]["primitives"]:
            material = self.materials[primitive["material"]]
            path = self.path(parent, material.GetPath().name)
            about = self.gltf.parts["materials"][primitive["material"]]
            base = about["pbrMetallicRoughness"]["baseColorFactor"][:3]
            own = self.surface(path, primitive, base)
            UsdShade.MaterialBindingAPI.Apply(own.GetPrim()).Bind(material)
            places = primitive["attributes"]["POSITION"]
            # The backs of a leaf have the places of its adaxial face.
            if adaxial is not None and adaxial[0] == places:
                self.backs.append((adaxial[1], path))
            elif not about["doubleSided"]:
                adaxial = places, path
            if about["doubleSided"]:
                own.CreateDoubleSidedAttr(True)

    def surface(self, path: Sdf.Path, primitive: dict[str, Any], base: list[float]) -> UsdGeom.Mesh:
        mesh = UsdGeom.Mesh.Define(self.stage, path)
        vectors = {
            key: self.gltf.vectors(accessor).astype(np.float32)
            for key, accessor in primitive["attributes"].items()
        }
        indices = self.gltf.vectors(primitive["indices"]).astype(np.int32).ravel()
        positions = Vt.Vec3fArray.FromNumpy(vectors["POSITION"])
        mesh.CreatePointsAttr(positions)
        mesh.CreateFaceVertexCountsAttr(Vt.IntArray(len(indices) // 3, 3))
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(indices))
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(positions))
        if "NORMAL" in vectors:
            mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(vectors["NORMAL"]))
            mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
        primvars = UsdGeom.PrimvarsAPI(mesh)
        if "TEXCOORD_0" in vectors:
            # The first row of a picture is at t = 1.
            s, t = vectors["TEXCOORD_0"].T
            kind = Sdf.ValueTypeNames.TexCoord2fArray
            own = primvars.CreatePrimvar("st", kind, UsdGeom.Tokens.vertex)
            own.Set(Vt.Vec2fArray.FromNumpy(np.stack([s, 1 - t], 1)))
        if "COLOR_0" in vectors:
            colours = vectors["COLOR_0"] * np.array(base, np.float32)
            mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.vertex).Set(
                Vt.Vec3fArray.FromNumpy(colours)
            )
        return mesh

    def add_variants(self, one_face: bool) -> None:
        """A variant with both faces of leaves, and one with the adaxial face from both sides."""
        variants = self.root.GetPrim().GetVariantSets().AddVariantSet(FACES)
        for name in ("two", "one"):
            variants.AddVariant(name)
            variants.SetVariantSelection(name)
            with variants.GetVariantEditContext():
                for front, back in self.backs:
                    # A local opinion would be stronger than that of a variant.
                    own = UsdGeom.Mesh(self.stage.OverridePrim(front))
                    own.CreateDoubleSidedAttr(name == "one")
                    if name == "one":
                        self.stage.OverridePrim(back).SetActive(False)
        variants.SetVariantSelection("one" if one_face else "two")


def move(place: UsdGeom.Xformable, node: dict[str, Any]) -> None:
    """The transform of a node."""
    if "translation" in node:
        place.AddTranslateOp().Set(Gf.Vec3d(*node["translation"]))
    if "rotation" in node:
        x, y, z, w = node["rotation"]
        place.AddOrientOp().Set(Gf.Quatf(w, x, y, z))
    if "scale" in node:
        place.AddScaleOp().Set(Gf.Vec3f(*node["scale"]))
