"""Holds canopies for Eradiate against the scene that they are of, and opens them in Eradiate."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lamina
from validation.program import ROOT

# A flat leaf of 4 cm by 8 cm, 1 cm above a soil, and a second one, turned and mirrored.
SCENE = """
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, 0, 1]
look_at_m = [0, 0.01, 0]
vertical_fov_deg = 40
[meshes.card.rectangle]
width_m = 0.04
height_m = 0.08
[meshes.plane.rectangle]
width_m = 1
height_m = 1
[materials.leaf.leaf]
adaxial = { eta = 1.45, alpha = 0.3 }
abaxial = { eta = 1.4, alpha = 0.5 }
[materials.leaf.leaf.measured]
reflectance = { table = [[400, 0.05], [2500, 0.47]] }
abaxial_reflectance = 0.2
transmittance = { table = [[400, 0.01], [2500, 0.43]] }
[materials.soil.diffuse]
reflectance = { table = [[400, 0.1], [2500, 0.52]] }
[objects.leaves]
mesh = "card"
material = "leaf"
instances = { file = "places.csv" }
[objects.floor]
mesh = "plane"
material = "soil"
position_m = [0, 0, 0.5]
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"""
PLACES = (
    "x_m,y_m,z_m,rotate_x_deg,rotate_z_deg,scale_x,scale_y,scale_z\n"
    "0.1,0.2,0.51,0,0,1,1,1\n0.1,0.2,0.56,30,90,1,2,1\n"
)


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("eradiate")
    (folder / "places.csv").write_text(PLACES, encoding="utf-8")
    (folder / "scene.toml").write_text(SCENE, encoding="utf-8")
    return folder / "scene.toml"


def vertices_of(file: Path) -> np.ndarray[Any, Any]:
    """Three corners of each triangle of a PLY."""
    head, _, data = file.read_bytes().partition(b"end_header\n")
    count = int(head.split(b"element vertex ")[1].split()[0])
    faces = np.frombuffer(data[12 * count :], [("count", "u1"), ("corners", "<u4", 3)])
    vertices = np.frombuffer(data[: 12 * count], "<f4").reshape(-1, 3)
    return vertices[faces["corners"]]


def test_the_canopy_has_the_places_and_the_spectra_of_the_scene(
    scene: Path, tmp_path: Path
) -> None:
    out = tmp_path / "canopy"
    files = lamina.to_eradiate(scene, out, ground="floor")
    names = ["scenario.json", "lamina.json", "leaves-material-leaf-0.ply"]
    assert [file.name for file in files] == names
    found = json.loads(files[0].read_text(encoding="utf-8"))
    size = found["canopy"]["size"]
    # The second leaf, 16 cm long, was tilted about x and then turned by a quarter, to lie along x.
    tilted, height = 0.16 * np.cos(np.pi / 6), 0.06 + 0.08 * np.sin(np.pi / 6)
    assert np.allclose(size, [tilted, 0.08, height], atol=1e-6)
    (object_,) = found["canopy"]["instanced_canopy_elements"]
    (place,) = object_["instance_positions"]
    assert np.allclose(np.array(place)[:2, 3], np.array(size)[:2] / 2)
    (element,) = object_["canopy_element"]["mesh_tree_elements"]
    nm = np.array(element["reflectance"]["wavelengths"])
    assert (nm[0], nm[-1]) == (400, 2500)
    mean = (0.05 + 0.42 * (nm - 400) / 2100 + 0.2) / 2
    assert np.allclose(element["reflectance"]["values"], mean, atol=1e-5)
    transmittance = 0.01 + 0.42 * (nm - 400) / 2100
    assert np.allclose(element["transmittance"]["values"], transmittance, atol=1e-5)
    soil = 0.1 + 0.42 * (nm - 400) / 2100
    assert np.allclose(found["surface"]["reflectance"]["values"], soil, atol=1e-5)
    corners = vertices_of(out / element["mesh_filename"])
    a, b, c = (corners[:, corner] for corner in range(3))
    normals = np.cross(b - a, c - a) / 2
    assert np.allclose(normals[:, 2].sum(), 0.04 * 0.08 + 0.04 * tilted, atol=1e-7)
    low, high = corners.reshape(-1, 3).min(0), corners.reshape(-1, 3).max(0)
    assert np.allclose(low[:2], -high[:2], atol=1e-6)
    assert np.allclose(high[2], height, atol=1e-6)


def test_discs_have_the_area_the_middle_and_the_normal_of_their_blades(
    scene: Path, tmp_path: Path
) -> None:
    out = tmp_path / "discs"
    lamina.to_eradiate(scene, out, ground="floor", discs=True)
    flat, tilted = np.loadtxt(out / "leaves-material-leaf-0.txt")
    assert np.allclose(np.pi * np.array([flat[0], tilted[0]]) ** 2, [0.0032, 0.0064])
    assert np.allclose([flat[1:4], tilted[1:4]], [[0, 0, 0.01], [0, 0, 0.06]], atol=1e-6)
    assert np.allclose(flat[4:], [0, 0, 1], atol=1e-6)
    # Turned about x and then about z: the normal -y of the tilt became x.
    assert np.allclose(tilted[4:], [0.5, 0, np.sqrt(0.75)], atol=1e-6)
    spectra = np.loadtxt(out / "leaves-material-leaf-0.csv", delimiter=",", skiprows=1)
    assert spectra.shape == (211, 3)


ERADIATE = """
import json, sys
import eradiate
eradiate.set_mode("mono")
from pathlib import Path
from eradiate.experiments import CanopyExperiment
from eradiate.scenes.biosphere import LeafCloud, load_scenario

cloud = LeafCloud.from_file(sys.argv[2])
experiment = CanopyExperiment(
    **load_scenario(Path(sys.argv[1]), padding=0),
    illumination={"type": "directional", "zenith": 0, "irradiance": 1.0},
    measures={
        "type": "distant",
        "direction": [0, 0, 1],
        "srf": {"type": "delta", "wavelengths": [550.0, 2000.0]},
        "target": [0.01, 0.02, 0.01],
        "spp": 100000,
    },
)
brf = eradiate.run(experiment)["brf"]
print("found:", json.dumps([brf.values.ravel().tolist(), cloud.n_leaves()]))
"""


@pytest.mark.parametrize("soil", [0.0, 0.5])
def test_eradiate_opens_the_canopy_and_sees_what_its_leaves_reflect_and_let_through(
    soil: float, scene: Path, tmp_path: Path
) -> None:
    """Eradiate has a Mitsuba of its own, so that it lies in an environment of its own."""
    if (python := os.environ.get("ERADIATE_PYTHON")) is None:
        pytest.skip("needs ERADIATE_PYTHON, a Python with eradiate")
    alone = tmp_path / "scene.toml"
    alone.write_text(scene.read_text(encoding="utf-8"), encoding="utf-8")
    head, _, _ = PLACES.split("\n", 2)
    # One leaf as a roof of 4 m by 8 m, 1 cm above the ground.
    (tmp_path / "places.csv").write_text(f"{head}\n0,0,0.51,0,0,100,100,1\n", encoding="utf-8")
    ground = {"materials.soil.diffuse.reflectance": soil}
    canopy, discs = tmp_path / "canopy", tmp_path / "discs"
    lamina.to_eradiate(alone, canopy, ground, ground="floor")
    lamina.to_eradiate(alone, discs, ground, ground="floor", discs=True)
    words = [python, "-c", ERADIATE, str(canopy), str(discs / "leaves-material-leaf-0.txt")]
    printed = subprocess.run(words, check=True, capture_output=True, text=True, timeout=600)
    text = next(line for line in printed.stdout.splitlines() if line.startswith("found:"))
    brfs, leaves = json.loads(text.removeprefix("found:"))
    assert leaves == 1
    for nm, brf in zip((550, 2000), brfs, strict=True):
        r = (0.05 + 0.42 * (nm - 400) / 2100 + 0.2) / 2
        t = 0.01 + 0.42 * (nm - 400) / 2100
        # What passes the leaf, and after each meeting with the ground passes it again.
        wanted = r + t**2 * soil / (1 - soil * r)
        # Single precision without the ground; with it, the noise of 100,000 paths.
        assert brf == pytest.approx(wanted, abs=2e-4 if soil > 0 else 1e-5)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"ground": "soil"}, "--ground soil: the scene has no such object, only floor, leaves"),
        ({"cards": True}, "cards"),
    ],
)
def test_bad_input_is_refused_and_leaves_nothing(
    options: dict[str, Any], said: str, scene: Path, tmp_path: Path
) -> None:
    with pytest.raises(lamina.LaminaError, match=said) as refused:
        lamina.to_eradiate(scene, tmp_path / "out", **options)
    assert refused.value.code == 2
    assert not list(tmp_path.iterdir())


def test_a_folder_of_something_else_is_left_alone(scene: Path, tmp_path: Path) -> None:
    (tmp_path / "scenario.json").write_text("{}", encoding="utf-8")
    with pytest.raises(lamina.LaminaError, match=r"holds no lamina\.json"):
        lamina.to_eradiate(scene, tmp_path)
    assert (tmp_path / "scenario.json").read_text(encoding="utf-8") == "{}"


def test_blades_that_a_mask_cuts_are_refused(tmp_path: Path) -> None:
    scene = ROOT / "scenes/instances/scene.toml"
    with pytest.raises(lamina.LaminaError, match=r"leaves: a mask cuts .* blade\.max_edge_mm"):
        lamina.to_eradiate(scene, tmp_path / "out", triangles=100)
    assert not list(tmp_path.iterdir())


def test_glass_is_refused_by_name(tmp_path: Path) -> None:
    scene = ROOT / "scenes/milk-glass/scene.toml"
    with pytest.raises(lamina.LaminaError, match="Eradiate's canopies hold no glass"):
        lamina.to_eradiate(scene, tmp_path / "out")
