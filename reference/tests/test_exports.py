"""Holds exports against what others read and check: Khronos' validator and schemas, Mitsuba."""

from __future__ import annotations

import json
import os
import shutil
import struct
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema_rs
import pytest

from validation.program import ROOT, program

VALIDATOR = "gltf-validator@2.0.0-dev.3.10"
CHECK = """
const fs = require("fs"), validator = require("gltf-validator");
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])), { maxIssues: 0 })
  .then(report => console.log(JSON.stringify(report.issues)));
"""
# Where Khronos keeps the schemas of the extensions that the validator does not know.
SCHEMAS = {
    "KHR_materials_diffuse_transmission": "Khronos/{0}/schema/material.{0}.schema.json",
    "EXT_mesh_gpu_instancing": "Vendor/{0}/schema/glTF.{0}.schema.json",
}
# What is exported with which options; a name without a folder is a preset.
EXPORTS = [
    ("instances", []),
    ("closed-blade", []),
    ("pots", []),
    pytest.param("first-leaf", [], marks=pytest.mark.deep),
    pytest.param("compound-leaf", ["--cards", "--triangles", "100"], marks=pytest.mark.deep),
    pytest.param("bough", ["--triangles", "500"], marks=pytest.mark.deep),
    pytest.param("croton-in-pot", ["--plain-nodes", "--one-face"], marks=pytest.mark.deep),
    pytest.param("birch-autumn", ["--illuminant", "a"], marks=pytest.mark.deep),
]


def written(name: str, options: list[str], folder: Path) -> Path:
    """The file of a scene or of a preset."""
    scene = ROOT / "scenes" / name / "scene.toml"
    out = folder / f"{name}.glb"
    named = str(scene) if scene.exists() else name
    words = [
        str(program()),
        "export",
        "gltf",
        named,
        "--texture",
        "128",
        *options,
        "--out",
        str(out),
    ]
    printed = subprocess.run(words, check=True, capture_output=True, text=True)
    assert f"{out.stat().st_size} bytes" in printed.stderr
    return out


@pytest.fixture(scope="module")
def validator(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with Khronos' validator."""
    if shutil.which("node") is None or shutil.which("npm") is None:
        pytest.skip("needs node and npm")
    folder = tmp_path_factory.mktemp("node")
    words = ["npm", "install", "--no-audit", "--no-fund", "--prefix", str(folder), VALIDATOR]
    if subprocess.run(words, capture_output=True, check=False).returncode != 0:
        pytest.skip(f"npm does not install {VALIDATOR}")
    yield folder


@pytest.mark.parametrize(("name", "options"), EXPORTS)
def test_khronos_validator_finds_no_error_and_no_warning(
    name: str, options: list[str], validator: Path, tmp_path: Path
) -> None:
    file = written(name, options, tmp_path)
    words = ["node", "-e", CHECK, str(file)]
    report = subprocess.run(words, cwd=validator, check=True, capture_output=True, text=True)
    issues = json.loads(report.stdout)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"][:5]


def document(file: Path) -> Any:
    """The JSON of a glTF file."""
    data = file.read_bytes()
    (length,) = struct.unpack("<I", data[12:16])
    return json.loads(data[20 : 20 + length])


def extended(value: Any) -> Iterator[tuple[str, Any]]:
    """All objects of extensions in a document, with the names of these."""
    if isinstance(value, dict):
        yield from value.get("extensions", {}).items()
        for part in value.values():
            yield from extended(part)
    elif isinstance(value, list):
        for part in value:
            yield from extended(part)


def resolved(root: Path, value: Any) -> Any:
    """A schema with the schemas that it names in it."""
    if isinstance(value, list):
        return [resolved(root, part) for part in value]
    if not isinstance(value, dict):
        return value
    if isinstance(value.get("$ref"), str):
        text = (root / "specification/2.0/schema" / value["$ref"]).read_text(encoding="utf-8")
        return resolved(root, json.loads(text))
    passed = ("$schema", "$id")
    return {key: resolved(root, part) for key, part in value.items() if key not in passed}


@pytest.mark.parametrize(("name", "options"), [EXPORTS[0]])
def test_extensions_are_as_khronos_schemas_say(
    name: str, options: list[str], tmp_path: Path
) -> None:
    """Khronos allows no copies of its schemas: they are read where a checkout has them."""
    if (checkout := os.environ.get("GLTF_SCHEMAS")) is None:
        pytest.skip("needs GLTF_SCHEMAS, a checkout of KhronosGroup/glTF")
    root = Path(checkout)
    schemas = {
        extension: jsonschema_rs.validator_for(
            resolved(
                root, json.loads((root / "extensions/2.0" / path.format(extension)).read_text())
            )
        )
        for extension, path in SCHEMAS.items()
    }
    found = [
        own for own in extended(document(written(name, options, tmp_path))) if own[0] in schemas
    ]
    assert {extension for extension, _ in found} == set(SCHEMAS)
    for extension, own in found:
        schemas[extension].validate(own)
    with pytest.raises(jsonschema_rs.ValidationError):
        schemas["EXT_mesh_gpu_instancing"].validate({"attributes": {"SCALE": -1}})


@pytest.mark.needs("mitsuba")
def test_an_exported_mitsuba_scene_opens_with_the_package_alone(tmp_path: Path) -> None:
    out = tmp_path / "exported"
    scene = ROOT / "scenes/flat-leaf/scene.toml"
    subprocess.run([str(program()), "export", "mitsuba", str(scene), "--out", str(out)], check=True)
    code = f"import lamina.mitsuba; print(len(lamina.mitsuba.load({str(out)!r}).shapes()))"
    # In a process of its own, where no variant is set yet.
    printed = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT / "reference")},
    )
    assert int(printed.stdout.split()[-1]) >= 2
