"""Materials of glTF as materials of USD.

Each has a `UsdPreviewSurface`, which every program reads, and for the render context `mtlx` a
Standard Surface of MaterialX. With thin walls its `subsurface` is diffuse transmission: of what
passes the coat the fraction f is let through in one colour and the rest sent back in the base
colour, as in glTF. (The graph of OpenPBR in MaterialX 1.39.5 applies the colour twice.) The preview
surface lets nothing through: its colour is what is sent back, (1 - f) times glTF's base colour.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from pxr import Gf, Sdf, UsdShade

from lamina.gltf import Gltf

# By glTF's number: the words of the preview surface and of MaterialX.
WRAPS = {10497: ("repeat", "periodic"), 33648: ("mirror", "mirror"), 33071: ("clamp", "clamp")}
# The alpha from which a surface is there, as glTF has it where a file says nothing.
CUT = 0.5
MATERIALX = "1.39"
TYPES = Sdf.ValueTypeNames


@dataclass(frozen=True)
class Network:
    """Shaders inside of one material."""

    material: UsdShade.Material

    def node(self, name: str, kind: str, **inputs: tuple[Any, Any]) -> UsdShade.Shader:
        """A shader of a kind; each input has a type and a value, or the output that it is."""
        path = self.material.GetPath().AppendChild(name)
        shader = UsdShade.Shader.Define(self.material.GetPrim().GetStage(), path)
        shader.CreateIdAttr(kind)
        for key, (type_of, value) in inputs.items():
            entry = shader.CreateInput(key, type_of)
            if isinstance(value, UsdShade.Output):
                entry.ConnectToSource(value)
            else:
                entry.Set(value)
        return shader


@dataclass(frozen=True)
class Finish:
    """What glTF says of a material."""

    base: tuple[float, ...]
    base_map: int | None
    metallic: float
    roughness: float
    finish_map: int | None
    normal_map: int | None
    normal_scale: float
    ior: float
    """Refractive index of the coat; 1 is none."""
    through: float
    """Fraction of what passes the coat that is let through."""
    through_colour: tuple[float, ...]
    through_map: int | None
    is_clear: bool
    is_masked: bool

    @classmethod
    def of(cls, gltf: Gltf, material: dict[str, Any]) -> Finish:
        def number(table: dict[str, Any], key: str) -> int | None:
            return table[key]["index"] if key in table else None

        own = material["pbrMetallicRoughness"]
        through = gltf.extension(material, "KHR_materials_diffuse_transmission")
        specular = gltf.extension(material, "KHR_materials_specular").get("specularFactor", 1.0)
        ior = gltf.extension(material, "KHR_materials_ior").get("ior", 1.5)
        return cls(
            base=tuple(own["baseColorFactor"][:3]),
            base_map=number(own, "baseColorTexture"),
            metallic=own["metallicFactor"],
            roughness=own["roughnessFactor"],
            finish_map=number(own, "metallicRoughnessTexture"),
            normal_map=number(material, "normalTexture"),
            normal_scale=material.get("normalTexture", {}).get("scale", 1.0),
            ior=ior if specular > 0 else 1.0,
            through=through.get("diffuseTransmissionFactor", 0.0),
            through_colour=tuple(through.get("diffuseTransmissionColorFactor", (1.0, 1.0, 1.0))),
            through_map=number(through, "diffuseTransmissionColorTexture"),
            is_clear="KHR_materials_transmission" in material.get("extensions", {}),
            is_masked=material.get("alphaMode") == "MASK",
        )


@dataclass(frozen=True)
class Surfaces:
    """Writes materials, whose pictures have a path each, by the number of the texture."""

    gltf: Gltf
    pictures: Sequence[str]
    has_materialx: bool

    def add(self, material: UsdShade.Material, number: int, is_tinted: bool) -> None:
        """Shaders of a material of the file; `is_tinted` if vertices have its base colour."""
        finish = Finish.of(self.gltf, self.gltf.parts["materials"][number])
        self.preview(Network(material), finish, is_tinted)
        if self.has_materialx:
            self.standard(Network(material), finish, is_tinted)

    def wraps(self, texture: int) -> list[tuple[str, str]]:
        sampler = self.gltf.parts["samplers"][self.gltf.parts["textures"][texture]["sampler"]]
        return [WRAPS[sampler[key]] for key in ("wrapS", "wrapT")]

    def preview(self, network: Network, finish: Finish, is_tinted: bool) -> None:
        base = [value * (1 - finish.through) for value in finish.base]
        surface = network.node(
            "preview",
            "UsdPreviewSurface",
            diffuseColor=(TYPES.Color3f, Gf.Vec3f(*base)),
            metallic=(TYPES.Float, finish.metallic),
            roughness=(TYPES.Float, finish.roughness),
            ior=(TYPES.Float, finish.ior),
        )
        material = network.material
        material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
        reader: list[UsdShade.Shader] = []

        def picture(name: str, texture: int, space: str, scale: Sequence[float]) -> UsdShade.Shader:
            if not reader:
                own = network.node("st", "UsdPrimvarReader_float2", varname=(TYPES.String, "st"))
                own.CreateOutput("result", TYPES.Float2)
                reader.append(own)
            wrap_s, wrap_t = (words[0] for words in self.wraps(texture))
            own = network.node(
                name,
                "UsdUVTexture",
                file=(TYPES.Asset, Sdf.AssetPath(self.pictures[texture])),
                st=(TYPES.Float2, reader[0].GetOutput("result")),
                wrapS=(TYPES.Token, wrap_s),
                wrapT=(TYPES.Token, wrap_t),
                sourceColorSpace=(TYPES.Token, space),
            )
            if tuple(scale) != (1.0, 1.0, 1.0):
                own.CreateInput("scale", TYPES.Float4).Set(Gf.Vec4f(*scale, 1.0))
            return own

        def connect(key: str, shader: UsdShade.Shader, output: str, type_of: Any) -> None:
            surface.CreateInput(key, type_of).ConnectToSource(shader.CreateOutput(output, type_of))

        if finish.base_map is not None:
            colours = picture("base", finish.base_map, "sRGB", base)
            connect("diffuseColor", colours, "rgb", TYPES.Float3)
            if finish.is_masked:
                # With a scale, Blender would take the alpha from the colours.
                mask = picture("mask", finish.base_map, "sRGB", (1.0, 1.0, 1.0))
                connect("opacity", mask, "a", TYPES.Float)
                surface.CreateInput("opacityThreshold", TYPES.Float).Set(CUT)
        elif is_tinted:
            varname = (TYPES.String, "displayColor")
            tint = network.node("tint", "UsdPrimvarReader_float3", varname=varname)
            connect("diffuseColor", tint, "result", TYPES.Float3)
        if finish.finish_map is not None:
            scale = (1.0, finish.roughness, finish.metallic or 1.0)
            rough = picture("finish", finish.finish_map, "raw", scale)
            connect("roughness", rough, "g", TYPES.Float)
            if finish.metallic > 0:
                connect("metallic", rough, "b", TYPES.Float)
        if finish.normal_map is not None:
            slope = 2.0 * finish.normal_scale
            normals = picture("normals", finish.normal_map, "raw", (slope, slope, 2.0))
            bias = Gf.Vec4f(-0.5 * slope, -0.5 * slope, -1.0, 0.0)
            normals.CreateInput("bias", TYPES.Float4).Set(bias)
            connect("normal", normals, "rgb", TYPES.Normal3f)
        if finish.is_clear:
            surface.CreateInput("opacity", TYPES.Float).Set(0.0)

    def standard(self, network: Network, finish: Finish, is_tinted: bool) -> None:
        def output(shader: UsdShade.Shader, type_of: Any) -> UsdShade.Output:
            return shader.CreateOutput("out", type_of)

        def picture(name: str, texture: int, kind: str, type_of: Any) -> UsdShade.Output:
            wrap_s, wrap_t = (words[1] for words in self.wraps(texture))
            st = network.node("mtlx_st", "ND_geompropvalue_vector2", geomprop=(TYPES.String, "st"))
            shader = network.node(
                f"mtlx_{name}",
                f"ND_image_{kind}",
                file=(TYPES.Asset, Sdf.AssetPath(self.pictures[texture])),
                texcoord=(TYPES.Float2, output(st, TYPES.Float2)),
                uaddressmode=(TYPES.String, wrap_s),
                vaddressmode=(TYPES.String, wrap_t),
            )
            if kind.startswith("color"):
                shader.GetInput("file").GetAttr().SetColorSpace("srgb_texture")
            return output(shader, type_of)

        def part(name: str, kind: str, of: UsdShade.Output, type_of: Any, index: int) -> Any:
            inputs = {"in": (type_of, of), "index": (TYPES.Int, index)}
            return output(network.node(name, f"ND_extract_{kind}", **inputs), TYPES.Float)

        def times(name: str, of: UsdShade.Output, kind: str, type_of: Any, factor: Any) -> Any:
            inputs = {"in1": (type_of, of), "in2": (type_of, factor)}
            return output(network.node(name, f"ND_multiply_{kind}", **inputs), type_of)

        colour: Any = Gf.Vec3f(*finish.base)
        if is_tinted:
            geomprop = (TYPES.String, "displayColor")
            tint = network.node("mtlx_tint", "ND_geompropvalue_color3", geomprop=geomprop)
            colour = output(tint, TYPES.Color3f)
        opacity: Any = Gf.Vec3f(1.0)
        if finish.base_map is not None and finish.is_masked:
            texel = picture("base", finish.base_map, "color4", TYPES.Color4f)
            inputs = {"in": (TYPES.Color4f, texel)}
            own = output(
                network.node("mtlx_rgb", "ND_convert_color4_color3", **inputs), TYPES.Color3f
            )
            alpha = part("mtlx_alpha", "color4", texel, TYPES.Color4f, 3)
            cut = network.node(
                "mtlx_mask",
                "ND_ifgreatereq_color3",
                value1=(TYPES.Float, alpha),
                value2=(TYPES.Float, CUT),
                in1=(TYPES.Color3f, Gf.Vec3f(1.0)),
                in2=(TYPES.Color3f, Gf.Vec3f(0.0)),
            )
            opacity = output(cut, TYPES.Color3f)
            colour = times("mtlx_base_factor", own, "color3", TYPES.Color3f, colour)
        elif finish.base_map is not None:
            own = picture("base", finish.base_map, "color3", TYPES.Color3f)
            colour = times("mtlx_base_factor", own, "color3", TYPES.Color3f, colour)
        through: Any = Gf.Vec3f(*finish.through_colour)
        if finish.through_map is not None:
            through = picture("through", finish.through_map, "color3", TYPES.Color3f)
        roughness: Any = finish.roughness
        metallic: Any = finish.metallic
        if finish.finish_map is not None:
            texel = picture("finish", finish.finish_map, "vector3", TYPES.Float3)
            rough = part("mtlx_g", "vector3", texel, TYPES.Float3, 1)
            roughness = times("mtlx_roughness", rough, "float", TYPES.Float, roughness)
            if finish.metallic > 0:
                metal = part("mtlx_b", "vector3", texel, TYPES.Float3, 2)
                metallic = times("mtlx_metalness", metal, "float", TYPES.Float, metallic)
        surface = network.node(
            "mtlx_surface",
            "ND_standard_surface_surfaceshader",
            base=(TYPES.Float, 1.0),
            base_color=(TYPES.Color3f, colour),
            metalness=(TYPES.Float, metallic),
            specular=(TYPES.Float, 0.0 if finish.ior == 1.0 else 1.0),
            specular_IOR=(TYPES.Float, finish.ior),
            specular_roughness=(TYPES.Float, roughness),
            transmission=(TYPES.Float, 1.0 if finish.is_clear else 0.0),
            subsurface=(TYPES.Float, finish.through),
            subsurface_color=(TYPES.Color3f, through),
            opacity=(TYPES.Color3f, opacity),
            thin_walled=(TYPES.Bool, finish.through > 0),
        )
        if finish.normal_map is not None:
            texel = picture("normals", finish.normal_map, "vector3", TYPES.Float3)
            inputs = {"in": (TYPES.Float3, texel), "scale": (TYPES.Float, finish.normal_scale)}
            normals = output(
                network.node("mtlx_slopes", "ND_normalmap_float", **inputs), TYPES.Float3
            )
            surface.CreateInput("normal", TYPES.Float3).ConnectToSource(normals)
        material = network.material
        # What `MaterialXConfigAPI` declares, where USD comes with MaterialX.
        material.GetPrim().AddAppliedSchema("MaterialXConfigAPI")
        version = material.GetPrim().CreateAttribute("config:mtlx:version", TYPES.String, False)
        version.Set(MATERIALX)
        end = material.CreateSurfaceOutput("mtlx")
        end.ConnectToSource(surface.CreateOutput("out", TYPES.Token))
