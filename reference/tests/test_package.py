"""Tests of the package `lamina`.

They hold what the package returns against what the program itself prints or writes.
"""

from __future__ import annotations

import csv
import io
import json
import os
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

import lamina
from lamina.checking import problems_of
from lamina.program import toml
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]

FLAT = ROOT / "scenes" / "flat-leaf" / "scene.toml"
SMALL = {"film.spectral.size": [12, 8]}


def printed(*arguments: str) -> str:
    """What the program prints."""
    done = subprocess.run([program(), *arguments], capture_output=True, text=True, check=True)
    return done.stdout


def refused(call: object) -> lamina.LaminaError:
    """The error that a call ends in."""
    try:
        call()  # type: ignore[operator]
    except lamina.LaminaError as failure:
        return failure
    raise AssertionError("it was not refused")


def test_the_program_that_the_environment_names_is_run() -> None:
    assert lamina.program().samefile(program())
    assert printed("--version").split()[1] == lamina.version()


def test_values_are_written_as_toml_reads_them() -> None:
    values = {
        "a": 1,
        "b": 0.1,
        "c": True,
        "d": 'quoted "text" \\ with\nlines',
        "e": [1, [2.5, "x"]],
        "f": {"d65": 0.5},
        "control": "\x00\x1f\x7f\u2028 ü",
        "numbers": [1e300, -0.0, 5e-324, float("inf"), -7],
        "tables": [{"a b.c": [True]}, {}],
    }
    text = "\n".join(f"{key} = {toml(value)}" for key, value in values.items())
    assert tomllib.loads(text) == values


def test_arrays_and_paths_are_values() -> None:
    wide = np.array([[1, 2, 3], [4, 5, 6]], np.float32)
    for value, same in (
        (np.float64(1e-30), 1e-30),
        (np.float32(0.1), float(np.float32(0.1))),
        (np.int32(7), 7),
        (np.bool_(True), True),
        (np.str_("a"), "a"),
        (wide, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]),
        (wide[:, ::2].T, [[1.0, 4.0], [3.0, 6.0]]),
        (np.array(3), 3),
        (np.array([], int), []),
        (np.array([True, False]), [True, False]),
        (np.array(["a", "bc"]), ["a", "bc"]),
        ([np.uint8(255), Path("a", "b.exr")], [255, str(Path("a", "b.exr"))]),
        (range(3), [0, 1, 2]),
    ):
        assert tomllib.loads(f"value = {toml(value)}")["value"] == same, value
    size = {"film.spectral.size": np.array([12, 8]), "film.spectral.spp": np.int64(1)}
    assert dict(lamina.render(FLAT, size).sizes) == {"y": 8, "x": 12, "wavelength": 4, "axis": 3}


@pytest.mark.parametrize(
    "value",
    [{1, 2}, None, b"ab", 1j, np.longdouble(1), np.array([1j]), np.datetime64("2020-01-01")],
)
def test_what_no_file_can_hold_is_refused_by_its_key(value: object) -> None:
    message = r"film\.rgb\.spp cannot be set to .*: take numbers, truths, text"
    with pytest.raises(TypeError, match=message):
        lamina.check(FLAT, {"film.rgb.spp": [value]})  # type: ignore[list-item]


def test_a_number_that_is_not_finite_is_refused_by_the_program() -> None:
    problems = lamina.check(FLAT, {"camera.perspective.vertical_fov_deg": np.nan})
    assert [problem.code for problem in problems] == ["scene::not_finite"]


@pytest.mark.parametrize(
    "camera",
    [
        {"perspective.vertical_fov_deg": 40},
        {"orthographic.height_m": 0.8, "orthographic.look_at_m": [0.1, 0, 0.2]},
    ],
)
def test_openexr_finds_each_point_of_a_picture_in_its_pixel(camera: dict[str, object]) -> None:
    kind = next(iter(camera)).split(".")[0]
    place = {f"{kind}.position_m": [0.2, -2, 0.5], f"{kind}.look_at_m": [0, 0, 0.1]}
    text = (
        "format = 1\nfilm.spectral = "
        "{ size = [48, 32], spp = 1, bands_nm = [550], filter_radius_px = 0.01 }\n"
        + "".join(f"camera.{key} = {toml(value)}\n" for key, value in (place | camera).items())
        + "materials.paint.diffuse.reflectance = 0.5\nmeshes.ball.sphere.radius_m = 0.3\n"
        'objects.ball = { mesh = "ball", material = "paint" }\n'
        "lights.sky.constant.radiance_w_m2_sr_nm = 1\n"
    )
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "scene.toml")
        scene.write_text(text)
        subprocess.run([program(), "render", scene, "--out", Path(folder, "out")], check=True)
        exr = oiio.ImageInput.open(str(Path(folder, "out.exr")))
        spec, pixels = exr.spec(), exr.read_image(oiio.FLOAT)
        exr.close()
    # OpenEXR's matrices are for row vectors.
    to_camera, to_ndc = (
        np.reshape(spec.getattribute(name), (4, 4)) for name in ("worldToCamera", "worldToNDC")
    )
    layers = [spec.channelnames.index(f"P.{axis}") for axis in "XYZ"]
    met = pixels[:, :, spec.channelnames.index("A")] > 0
    assert 100 < met.sum() < met.size
    points = np.append(pixels[met][:, layers], np.ones((met.sum(), 1)), axis=1)
    ndc = points @ to_ndc
    row, column = np.nonzero(met)
    # (0, 0) is the upper left corner, (1, 1) the lower right one.
    np.testing.assert_allclose(ndc[:, 0] / ndc[:, 3] * 48, column + 0.5, atol=0.02)
    np.testing.assert_allclose(ndc[:, 1] / ndc[:, 3] * 32, row + 0.5, atol=0.02)
    seen = points @ to_camera
    # To the right, up, and ahead: left-handed.
    assert np.linalg.det(to_camera[:3, :3]) == pytest.approx(-1, abs=1e-5)
    assert (np.diff(seen[row == 16][:, 0]) > 0).all()
    assert (np.diff(seen[column == 24][:, 1]) < 0).all()
    depth = pixels[met][:, spec.channelnames.index("depth.Z")]
    far = seen[:, 2] if kind == "orthographic" else np.linalg.norm(seen[:, :3], axis=1)
    np.testing.assert_allclose(far, depth, rtol=1e-5)


def test_a_spectral_picture_is_what_the_exr_holds() -> None:
    with tempfile.TemporaryDirectory() as folder:
        stem = Path(folder, "kept")
        picture = lamina.render(FLAT, SMALL, spp=4, seed=2, out=stem)
        exr = oiio.ImageInput.open(str(stem) + ".exr")
        names, pixels = exr.spec().channelnames, exr.read_image(oiio.FLOAT)
        exr.close()
        assert stem.with_suffix(".png").is_file()
    assert dict(picture.sizes) == {"y": 8, "x": 12, "wavelength": 4, "axis": 3}
    assert picture.wavelength.values.tolist() == [450, 550, 650, 750]
    assert picture.radiance.attrs["units"] == "W m-2 sr-1 nm-1"
    assert picture.attrs["software"] == f"Lamina {lamina.version()}"
    assert picture.attrs["spp"] == 4 and picture.attrs["sceneName"] == "flat-leaf"
    for band, channel in ((450, "S0.450,000000nm"), (750, "S0.750,000000nm")):
        ours = picture.radiance.sel(wavelength=band).values
        assert np.array_equal(ours, pixels[:, :, names.index(channel)])
    variance = picture.radiance_variance.sel(wavelength=550).values
    assert np.array_equal(variance, pixels[:, :, names.index("variance.S0.550,000000nm")])
    assert picture.luminance_variance.attrs["units"] == picture.radiance_variance.attrs["units"]
    # Of less than two batches of samples the error of the mean over bands is the greatest possible.
    bound = np.sqrt(picture.radiance_variance).mean("wavelength") ** 2
    np.testing.assert_allclose(picture.luminance_variance, bound, rtol=1e-4)
    assert picture.radiance.values.max() > 0
    assert np.array_equal(picture.mean_albedo, pixels[:, :, names.index("albedo.Y")])
    assert 0 < picture.mean_albedo.max() < 1


def test_a_colour_picture_has_channels_and_layers() -> None:
    colour = FLAT.read_text().replace("[film.spectral]", "[film.rgb]")
    kept = [row for row in colour.splitlines() if not row.startswith("band")]
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "colour.toml")
        scene.write_text("\n".join(kept))
        picture = lamina.render(scene, {"film.rgb.size": [8, 6]}, spp=1)
    assert picture.colour.dims == ("y", "x", "channel")
    layers = {"coverage", "albedo", "normal", "position", "depth", "object", "samples"}
    layers |= {"colour_variance", "luminance_variance"}
    assert layers <= set(picture)
    assert set(np.unique(picture.samples)) == {1.0}


def test_the_same_call_gives_the_same_numbers_and_another_seed_others() -> None:
    first, again, other = (
        lamina.render(FLAT, SMALL, spp=2, seed=seed).radiance for seed in (1, 1, 2)
    )
    assert first.identical(again)
    assert not first.equals(other)


def test_a_leaf_is_what_the_program_writes() -> None:
    leaf = lamina.grow("runions-9c", {"seed": 3}, mesh=True)
    with tempfile.TemporaryDirectory() as folder:
        file, measures = Path(folder, "leaf.json"), Path(folder, "measures.json")
        printed("grow", "runions-9c", "--seed", "3", "--out", str(file), "--measure", str(measures))
        told = json.loads(file.read_text())
        assert json.loads(measures.read_text()) == leaf.measures
    assert leaf.nodes[:, 0].tolist() == told["nodes"]["x_mm"]
    assert leaf.edges[:, 1].tolist() == told["edges"]["to"]
    assert len(leaf.areoles) == leaf.measures["areole_count"]
    graph = leaf.graph()
    length = sum(data["length_mm"] for _, _, data in graph.edges(data=True))
    assert abs(length / leaf.measures["vein_length_mm"] - 1) < 1e-6
    assert leaf.lines().shape == (len(leaf.edges), 2, 2)
    assert leaf.vertices is not None and leaf.faces is not None
    assert leaf.faces.max() == len(leaf.vertices) - 1
    # The blade is as long as the flat leaf, but for its curl.
    assert 0.9 * leaf.measures["length_mm"] < 1000 * np.ptp(leaf.vertices[:, 1]) < 250


BENCH = """format = 1
film.rgb = { size = [8, 8], spp = 1 }
camera.orthographic.position_m = [0, 0, 1]
camera.orthographic.look_at_m = [0, 0, 0]
camera.orthographic.up = [0, 1, 0]
camera.orthographic.height_m = 1
meshes.sheet.rectangle = { width_m = 1, height_m = 1 }
materials.green.leaf = { preset = "sun-green" }
materials.soil.diffuse = { reflectance = 0.2 }
objects.leaf = { mesh = "sheet", material = "green", position_m = [0, 0, 0.5] }
objects.ground = { mesh = "sheet", material = "soil" }

[instruments.ball.sphere]
object = "leaf"
wavelengths_nm = [550, 680, 800]
constituents = true
sensor = "landsat-8-oli"
indices = ["ndvi"]
incident = { par_umol_m2_s = 1000 }
spot = { at_mm = [0, 0], diameter_mm = 10 }

[instruments.field.canopy]
within_m = [-0.5, -0.5, 0.5, 0.5]
wavelengths_nm = [550, 800]
soil = "ground"
layers_m = [0.2]
detector = { zenith_deg = [-30, 0, 30], relative_azimuth_deg = [0, 90] }

[instruments.inside.depth]
object = "leaf"
wavelengths_nm = [450, 680]
slices = 2
"""


def test_figures_of_several_draws_say_what_their_errors_consist_of() -> None:
    columns = "instrument,quantity,part,face,incidence_deg,view_zenith_deg,view_azimuth_deg,"
    columns += "depth_um,band,wavelength_nm,value,standard_error,unit"
    cells = "field,reflected,,,30,,,,,550,0.2,5e-3,1"
    with tempfile.TemporaryDirectory() as name:
        one, many = Path(name, "one.csv"), Path(name, "many.csv")
        one.write_text(f"{columns}\n{cells}\n")
        parts = "draws,error_by_rays,error_by_draws"
        many.write_text(f"{columns},{parts}\n{cells},8,3e-3,4e-3\n")
        assert set(lamina.read_figures(one)["field"]) == {"reflected", "reflected_standard_error"}
        field = lamina.read_figures(many)["field"]
    at = field.sel(incidence=30, wavelength=550)
    assert float(at.reflected_error_by_rays) == 3e-3
    assert float(at.reflected_error_by_draws) == 4e-3
    assert float(at.reflected_draws) == 8 and field.reflected_draws.attrs["units"] == "1"
    assert "reflected_error_by_rays" in field.reflected.attrs["ancillary_variables"]


def test_figures_of_instruments_are_arrays_and_netcdf_and_say_their_units() -> None:
    import xarray as xr

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene, told = folder / "bench.toml", folder / "figures.json"
        scene.write_text(BENCH)
        table = folder / "figures.csv"
        printed("instruments", str(scene), "--rays", "1024", "--out", str(told), str(table))
        figures = json.loads(told.read_text())["figures"]
        found = lamina.instruments(scene, rays=1024)
        assert list(found) == ["ball", "field", "inside"]
        ball, field, inside = found.values()
        for file in (told, table):
            kept = lamina.read_figures(file)["ball"].attrs["provenance"]
            assert json.loads(kept)["settings"] == {"rays": ["1024"], "seed": ["1"]}
        row = next(
            row
            for row in figures
            if (row["instrument"], row["quantity"], row["face"], row["incidence_deg"])
            == ("ball", "reflectance", "abaxial", "diffuse")
            and row["band"] is None
            and row["wavelength_nm"] == 800
        )
        ours = ball.reflectance_diffuse.sel(face="abaxial", wavelength=800)
        assert float(ours) == row["value"] and ours.attrs["units"] == "1"
        error = ball.reflectance_diffuse_standard_error.sel(face="abaxial", wavelength=800)
        assert float(error) == row["standard_error"]
        assert set(ball.absorbed_by_constituent.dims) == {
            "constituent",
            "face",
            "incidence",
            "wavelength",
        }
        assert ball.absorbed_photon_flux.attrs["units"] == "umol m-2 s-1"
        nir, red = (ball.reflectance_in_band.sel(band=band) for band in ("B5", "B4"))
        ndvi = (nir - red) / (nir + red)
        assert np.allclose(ndvi, ball.ndvi_of_reflectance, atol=1e-6)
        assert float(ball.band_centre.sel(band="B5")) == 865 and ball.attrs["seed"] == 1
        assert dict(field.brf.sizes) == {
            "incidence": 1,
            "view_azimuth": 2,
            "view_zenith": 3,
            "wavelength": 2,
        }
        assert field.absorbed_in_layer.sizes["layer"] == 2
        assert inside.fluence.attrs["units"] == "1" and inside.depth.attrs["units"] == "um"
        # The cuticle is the outermost of the five layers.
        assert inside.tissue.values[0] == "cuticle" and inside.depth.size == 10
        # The table has the same to its nine digits.
        by_csv = lamina.read_figures(table)["field"]
        assert np.allclose(by_csv.brf, field.brf, atol=1e-9)
        files = lamina.to_netcdf(told, folder / "all.nc")
        assert [file.name for file in files] == ["all-ball.nc", "all-field.nc", "all-inside.nc"]
        kept = xr.load_dataset(files[1])
        assert kept.brf.equals(field.brf) and kept.brf.attrs == field.brf.attrs
        assert kept.wavelength.attrs["units"] == "nm"
        command = [sys.executable, "-c", "import lamina.measured as m; m.main()", str(told)]
        command += ["--out", str(folder / "one.nc"), "--only"]
        environment = os.environ | {"PYTHONPATH": str(ROOT / "reference")}
        done = subprocess.run(
            [*command, "inside"], capture_output=True, text=True, env=environment, check=True
        )
        assert done.stdout.strip() == str(folder / "one.nc")
        assert xr.load_dataset(folder / "one.nc").fluence.equals(inside.fluence)
        wrong = subprocess.run(
            [*command, "outside"], capture_output=True, text=True, env=environment, check=False
        )
        assert wrong.returncode != 0 and "no instrument outside, but ball" in wrong.stderr


def test_bands_of_pictures_are_written_for_envi_and_as_netcdf() -> None:
    import xarray as xr

    sensor = {"size": [6, 4], "spp": 2, "sensor": "landsat-9"}
    film = {"film.spectral": sensor, "extrapolate": True}
    with tempfile.TemporaryDirectory() as name:
        stem = Path(name, "seen")
        picture = lamina.render(FLAT, film, out=stem)
        assert list(picture.band_name.values) == [f"B{n}" for n in (1, 2, 3, 8, 4, 5, 9, 6, 7)]
        assert abs(float(picture.band_width.sel(wavelength=654.3, method="nearest")) - 37) < 1
        written = lamina.to_envi(picture, stem.with_suffix(".img"))
        assert [file.name for file in written] == ["seen.img", "seen.hdr"]
        header = dict(
            line.split(" = ", 1) for line in written[1].read_text().splitlines() if " = " in line
        )
        shape = [int(header[key]) for key in ("bands", "lines", "samples")]
        assert shape == [9, 4, 6] and header["interleave"] == "bsq"
        numbers = np.fromfile(written[0], "<f4").reshape(shape)
        assert np.array_equal(numbers, picture.radiance.transpose("wavelength", "y", "x"))
        wavelengths = [float(nm) for nm in header["wavelength"].strip("{}").split(", ")]
        assert np.allclose(wavelengths, picture.wavelength, atol=1e-6)
        assert header["band names"] == "{B1, B2, B3, B8, B4, B5, B9, B6, B7}"
        (file,) = lamina.to_netcdf(stem.with_suffix(".exr"), stem.with_suffix(".nc"))
        kept = xr.load_dataset(file)
        assert kept.radiance.equals(picture.radiance) and kept.attrs["Conventions"] == "CF-1.11"
        assert kept.band_width.attrs["standard_name"] == "sensor_band_spectral_width"
    # A film of boxes has the widths that its scene says.
    boxes = lamina.render(FLAT, SMALL | {"film.spectral.band_width_nm": 7}, spp=1)
    assert set(boxes.band_width.values) == {7.0}
    with pytest.raises(ValueError, match="no bands"):
        lamina.to_envi(boxes.drop_vars("radiance"), "never.img")


def test_optics_are_the_programs_table() -> None:
    told = lamina.optics("birch-yellow", water=0.012)
    table = printed("optics", "--preset", "birch-yellow", "--cw", "0.012", "--out", "-")
    rows = list(csv.DictReader(line for line in io.StringIO(table) if line[0] != "#"))
    assert told.wavelength.values.tolist() == [float(row["wavelength_nm"]) for row in rows]
    assert told.reflectance.values.tolist() == [float(row["R"]) for row in rows]
    assert told.transmittance.values.tolist() == [float(row["T"]) for row in rows]
    assert told.attrs == {"preset": "birch-yellow", "water": 0.012}


def test_problems_of_a_scene_are_told_with_their_places() -> None:
    assert lamina.check(FLAT) == []
    file = ROOT / "tests" / "format" / "broken" / "unknown_name.toml"
    problems = lamina.check(file)
    assert problems and all(problem.code.startswith("scene::") for problem in problems)
    lines = file.read_text().splitlines()
    for problem in problems:
        assert problem.file.endswith("unknown_name.toml") and problem.help
        assert problem.line is not None and 1 <= problem.line <= len(lines)
    wrong = {"film.spectral.spp": "many", "camera.perspective.vertical_fov_deg": 500}
    found = lamina.check(FLAT, wrong)
    assert [problem.code for problem in found] == ["scene::wrong_type", "scene::out_of_range"]
    assert problems_of("nothing of the kind") == []


def test_files_elsewhere_are_read_where_their_folder_is_allowed(tmp_path: Path) -> None:
    spectrum, drawing = tmp_path / "flat.csv", tmp_path / "margin.svg"
    spectrum.write_text("300,0.1\n2600,0.1\n")
    drawing.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L10-20L0-50L-10-20Z"/></svg>'
    )
    within = tmp_path / "within"
    within.mkdir()
    scene, leaf = within / "bench.toml", within / "leaf.toml"
    scene.write_text(BENCH)
    leaf.write_text(
        'format = 1\n[leaves.leaf]\npreset = "cherry"\nlength_mm = 10\n'
        'outline = { svg = { path = "../margin.svg" } }\n'
    )
    sky: dict[str, lamina.Value] = {"lights.sky.constant.radiance_w_m2_sr_nm": {"file": spectrum}}
    soil: dict[str, lamina.Value] = {"materials.soil.diffuse.reflectance": {"file": spectrum}}
    calls: list[Callable[[lamina.Folders], object]] = [
        lambda allow: lamina.render(FLAT, SMALL | sky, spp=1, allow=allow),
        lambda allow: lamina.instruments(scene, soil, rays=512, only=["ball"], allow=allow),
        lambda allow: lamina.grow(leaf, allow=allow),
        lambda allow: lamina.frames(leaf, 2, allow=allow),
    ]
    for call in calls:
        assert "--allow DIR" in str(refused(partial(call, ())))
        assert call(tmp_path)
    assert [problem.code for problem in lamina.check(FLAT, sky)] == ["scene::path_outside"]
    assert lamina.check(FLAT, sky, allow=[within, tmp_path]) == []


def test_what_the_program_refuses_is_an_error_with_its_words() -> None:
    assert "poplar" in str(refused(lambda: lamina.grow("popplar")))
    assert "outside 0 to 1 cm" in str(refused(lambda: lamina.optics(water=-1)))
    failure = refused(lambda: lamina.render("nowhere.toml"))
    assert "nowhere.toml" in str(failure) and failure.code == 2
    try:
        lamina.optics(chlorofyll=3)
    except TypeError as wrong:
        assert "chlorophyll" in str(wrong)
    else:
        raise AssertionError("a name with a typo was taken")
