#!/usr/bin/env python3
"""Tests of the reference implementation itself: run with `.venv/bin/python reference/selftest.py`.

They hold the Python BSDF to the document's promises before it is used to judge anything, and
show that the comparison tells equal pictures from unequal ones. Seeds are fixed.
"""

from __future__ import annotations

import contextlib
import csv
import io
import itertools
import json
import math
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from lamina_reference import variant

VARIANT = variant.choose()

import drjit as dr
import jsonschema_rs
import mitsuba as mi
import numpy as np
from lamina_reference import (
    colour,
    colours,
    compare,
    half_space,
    leaf_bsdf,
    pigments,
    plugins,
    prospect,
    relief_bsdf,
    render,
)
from lamina_reference.coat import Coat, albedo
from lamina_reference.program import program
from lamina_reference.testing import run_tests

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "leafmodel" / "src" / "optics" / "prospect_d.csv"
GREEN = {
    "structure": 1.5,
    "chlorophyll": 40.0,
    "carotenoids": 8.0,
    "anthocyanins": 0.0,
    "brown": 0.0,
    "water": 0.01,
    "dry_matter": 0.009,
}
# (eta, across, along) of both faces: equal, unequal, nearly smooth, strongly anisotropic, none.
COATS = (
    ((1.45, 0.3, 0.3), (1.45, 0.3, 0.3)),
    ((1.45, 0.25, 0.12), (1.4, 0.45, 0.45)),
    ((1.5, 0.05, 0.05), (1.35, 0.6, 0.3)),
    ((1.5, 0.1, 0.5), (1.5, 0.1, 0.5)),
    ((1.0, 0.3, 0.3), (1.0, 0.3, 0.3)),
)
VIEWS = tuple(
    (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), side * math.cos(t))
    for t, p, side in ((0.01, 0.0, 1), (0.7, 0.5, 1), (1.3, 2.2, 1), (0.3, 4.0, -1), (1.2, 1.0, -1))
)
NAMES = ["450", "550", "650", "750"]
WAVELENGTHS = (450.0, 550.0, 680.0, 800.0)


def leaf(coats: tuple, **tissue: object) -> mi.BSDF:
    """A leaf with these coats; green contents if nothing is said."""
    spec: dict = {"type": "lamina_leaf", "tissue": "contents", "prospect": str(TABLE), **GREEN}
    if tissue:
        spec = {"type": "lamina_leaf", **tissue}
    for face, values in zip(leaf_bsdf.FACES, coats, strict=True):
        for name, value in zip(("eta", "alpha_across", "alpha_along"), values, strict=True):
            spec[f"{face}_{name}"] = value
    return mi.load_dict(spec)


def spectrum(value: float) -> dict:
    """A constant over every wavelength in use."""
    return {"type": "regular", "wavelength_min": 300.0, "wavelength_max": 2600.0,
            "values": f"{value},{value}"}  # fmt: skip


def measured(coats: tuple, r: float, t: float, ratio: float = 1.0) -> mi.BSDF:
    """A leaf of constant R and T."""
    return leaf(
        coats,
        tissue="measured",
        reflectance=spectrum(r),
        transmittance=spectrum(t),
        abaxial_ratio=spectrum(ratio),
    )


def hit(wi: object, along: object = (0.0, 1.0, 0.0)) -> mi.SurfaceInteraction3f:
    """A hit seen from `wi`, on a plane whose v grows along `along`."""
    si = dr.zeros(mi.SurfaceInteraction3f)
    si.wi = mi.Vector3f(wi)
    si.wavelengths = WAVELENGTHS
    si.sh_frame = mi.Frame3f([0, 0, 1])
    si.dp_dv = mi.Vector3f(along)
    si.uv = [0.5, 0.5]
    # Not literals: one compiled kernel then serves all directions.
    dr.make_opaque(si)
    return si


def throughputs(bsdf: mi.BSDF, wi: object, side: int = 768) -> tuple[np.ndarray, np.ndarray]:
    """Hemispherical reflectance and transmittance by sampling, with their standard errors.

    Shape `[2, 4]` each: reflected, transmitted; four wavelengths.
    """
    n = side * side
    i = dr.arange(mi.UInt32, n)
    rng = mi.PCG32(size=n)
    u = (mi.Float(i % side) + rng.next_float32()) / side
    v = (mi.Float(i // side) + rng.next_float32()) / side
    bs, weight = bsdf.sample(mi.BSDFContext(), hit(wi), rng.next_float32(), mi.Point2f(u, v))
    weight = np.array(weight)
    same = np.array(bs.wo.z * wi[2] > 0.0)
    parts = np.stack([np.where(same, weight, 0.0), np.where(same, 0.0, weight)])
    return parts.mean(axis=2), parts.std(axis=2) / np.sqrt(n)


def test_prospect_gives_the_reference_spectra() -> None:
    lines = (ROOT / "tests" / "data" / "prospect_d_reference.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    kind = dr.float64_array_t(mi.Float)

    def column(name: str) -> object:
        return kind(np.array([float(row[name]) for row in rows]))

    model = prospect.Prospect(TABLE, kind, False)
    names = ("N", "Cab", "Car", "Ant", "Cbrown", "Cw", "Cm")
    contents = {
        ours: column(theirs)
        for ours, theirs in zip(("structure", *prospect.PROSPECT_D), names, strict=True)
    }
    r, t = model.spectra(column("wavelength_nm"), contents)
    # The reference is printed with ten decimals.
    for ours, name in ((r, "R"), (t, "T")):
        worst = np.max(np.abs(np.array(ours) - np.array(column(name))))
        assert worst < 1e-8, f"{name} is off by {worst}"


def test_prospect_without_absorption_loses_nothing() -> None:
    kind = dr.float64_array_t(mi.Float)
    model = prospect.Prospect(TABLE, kind, False)
    for plates, little in itertools.product((1.0, 1.5, 3.0), (0.0, 1e-12, 1e-9, 1e-7)):
        contents = dict.fromkeys(prospect.CONTENTS, 0.0)
        contents.update(structure=plates, chlorophyll=little)
        r, t = model.spectra(kind(np.linspace(400.0, 700.0, 301)), contents)
        lost = 1.0 - np.array(r) - np.array(t)
        assert np.all(lost > -1e-8) and np.all(lost < 1e-8 + 10.0 * little), (plates, little, lost)


def test_colours_of_the_presets_are_those_of_colour_science() -> None:
    rows = colours.rows(program())
    assert len(rows) == 2 * 19, len(rows)
    for row in rows:
        assert row.worst < colours.MOST, row
        assert row.spectra_differ_by < 1e-8, row


def test_a_colour_five_percent_too_bright_is_told_apart() -> None:
    sun_green = np.array([0.0855, 0.1068, 0.0494])
    assert colour.delta_e_of_xyz(sun_green, sun_green) == 0.0
    assert colour.delta_e_of_xyz(sun_green, 1.05 * sun_green) > colours.MOST
    assert colour.delta_e_of_xyz(sun_green, sun_green * [1.03, 1.0, 1.0]) > colours.MOST


PALETTES = """
format = 1
[film.spectral]
size = [8, 8]
spp = 1
bands_nm = [450, 550, 680, 800]
[camera.perspective]
position_m = [0, 0, 1]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
vertical_fov_deg = 5
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[meshes.card.rectangle]
width_m = 1
height_m = 1
[objects.card]
mesh = "card"
material = "mixed"
[materials.mixed.leaf.contents]
structure = 1.6
chlorophyll_ug_per_cm2 = 12
carotenoids_ug_per_cm2 = 6
anthocyanins_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.005
[materials.mixed.leaf.pigments.chlorophyll]
a_to_b = 2.5
bands = "solution"
packaging = 0.38
[materials.mixed.leaf.pigments.carotenoids]
shares = { lutein = 0.4, beta_carotene = 0.2, zeaxanthin = 0.1, violaxanthin = 0.2, lycopene = 0.1 }
shift_per_cm = -800
[materials.mixed.leaf.pigments.anthocyanins]
shares = { pelargonidin = 0.2, cyanidin = 0.3, peonidin = 0.1, delphinidin = 0.2, petunidin = 0.1, malvidin = 0.1 }
shift_nm = 12
blue_fraction = 0.2
[materials.mixed.leaf.pigments.betalains]
betacyanin = "amaranthine"
betaxanthin = "vulgaxanthin"
packaging = 0.45
"""


def exported_table(text: str, folder: Path) -> Path:
    """The table of absorption that the one leaf of a scene names in its export."""
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [str(program()), "export", "mitsuba", str(folder / "scene.toml"), "--out",
         str(folder / "out")],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    xml = (folder / "out" / "scene.xml").read_text(encoding="utf-8")
    names = re.findall(r'name="prospect" value="([^"]+)"', xml)
    assert len(names) == 1, names
    return folder / "out" / names[0]


def test_exported_palettes_are_the_documented_pigments() -> None:
    with tempfile.TemporaryDirectory() as folder:
        table = exported_table(PALETTES, Path(folder))
        assert table.name != "prospect_d.csv"
        rows = np.loadtxt(
            [line for line in table.read_text().splitlines() if line[:1].isdigit()], delimiter=","
        )
        bsdf = leaf(COATS[1], tissue="contents", prospect=str(table), betacyanins=0.0,
                    **{**GREEN, "anthocyanins": 9.0})  # fmt: skip
    own = np.loadtxt(
        [line for line in TABLE.read_text().splitlines() if line[:1].isdigit()], delimiter=","
    )
    nm = rows[:, 0]
    column = dict(zip(("index", *prospect.ABSORBERS), rows[:, 1:].T, strict=True))
    published = dict(zip(("index", *prospect.PROSPECT_D), own[:, 1:].T, strict=True))
    for name in ("index", "brown", "water", "dry_matter"):
        assert np.array_equal(column[name], published[name]), name
    a, b = (pigments.bands(pigments.CHLOROPHYLL[kind], nm, -400.0, 0.38) for kind in "ab")
    mix = {"lutein": 0.4, "beta_carotene": 0.2, "zeaxanthin": 0.1, "violaxanthin": 0.2,
           "lycopene": 0.1}  # fmt: skip
    red = {"pelargonidin": 0.2, "cyanidin": 0.3, "peonidin": 0.1, "delphinidin": 0.2,
           "petunidin": 0.1, "malvidin": 0.1}  # fmt: skip
    wanted = {
        "chlorophyll": (2.5 * a + b) / 3.5,
        "carotenoids": sum(
            share * pigments.bands(pigments.CAROTENOIDS[name], nm, -800.0, 0.29)
            for name, share in mix.items()
        ),
        "anthocyanins": pigments.anthocyanins(published["anthocyanins"], nm, red, 12.0, 0.2),
        "betacyanins": pigments.betalain("amaranthine", nm, 0.45),
        "betaxanthins": pigments.betalain("vulgaxanthin", nm, 0.45),
    }
    for name, want in wanted.items():
        # Beyond the data bands taper off; there the document gives no figures.
        known = np.isfinite(want) & (nm <= 680.0)
        assert known.sum() > 140, (name, known.sum())
        off = np.abs(column[name] - want)[known].max()
        assert off < 1e-12, (name, off)
    # PROSPECT-D's column with another a/b: times the ratio of two mixes in solution.
    with tempfile.TemporaryDirectory() as folder:
        text = PALETTES.replace('bands = "solution"\npackaging = 0.38', "")
        other = np.loadtxt(
            [line for line in exported_table(text, Path(folder)).read_text().splitlines()
             if line[:1].isdigit()], delimiter=","
        )  # fmt: skip
    ratio = ((2.5 * a + b) / 3.5) / ((3.1 * a + b) / 4.1)
    known = np.isfinite(ratio)
    off = np.abs(other[:, 2] - published["chlorophyll"] * ratio)[known].max()
    assert known.sum() > 300 and off < 1e-12, off
    # The plugin reads the same table.
    kind = leaf_bsdf.Double
    contents = {**GREEN, "anthocyanins": 9.0}
    absorbed = {name: np.interp(WAVELENGTHS, nm, column[name]) for name in prospect.ABSORBERS}
    total = sum(contents.get(name, 0.0) * k for name, k in absorbed.items())
    tau, lost = prospect.transmissivity(kind(*(total / contents["structure"]).tolist()))
    n = np.interp(WAVELENGTHS, nm, column["index"])
    lit = prospect.mean_transmittance(np.deg2rad(40.0), n)
    inside = prospect.mean_transmittance(0.5 * np.pi, n)
    r, t = prospect.pile(*(kind(*v.tolist()) for v in (n, lit, inside)), tau, lost, kind(1.5))
    got, error = throughputs(bsdf, (0.0, 0.0, 1.0))
    want = np.array([np.array(r).ravel(), np.array(t).ravel()])
    assert np.all(np.abs(got - want) < 4.0 * error + 1e-4), (got, want)


def test_coat_albedo_is_the_integral_over_directions() -> None:
    # Over directions instead of visible normals: another route to the same number.
    nodes, weights = np.polynomial.legendre.leggauss(400)
    root = 0.5 * (nodes + 1.0)
    mu, w = root * root, weights * root
    phi = 2.0 * np.pi * (np.arange(720) + 0.5) / 720
    for eta, a_x, a_y in ((1.45, 0.3, 0.3), (1.5, 0.2, 0.5)):
        coat = Coat(eta, a_x, a_y)
        for theta, turn in ((0.2, 0.3), (1.0, 1.2), (1.4, 0.7)):
            o = np.array(
                [np.sin(theta) * np.cos(turn), np.sin(theta) * np.sin(turn), np.cos(theta)]
            )
            s = np.sqrt(1.0 - mu * mu)[:, None]
            i = np.stack(
                [s * np.cos(phi), s * np.sin(phi), np.broadcast_to(mu[:, None], (400, 720))]
            )
            h = i + o[:, None, None]
            h /= np.sqrt((h * h).sum(axis=0))
            d = 1.0 / (np.pi * a_x * a_y * ((h[0] / a_x) ** 2 + (h[1] / a_y) ** 2 + h[2] ** 2) ** 2)
            lam = [0.5 * (np.sqrt(1 + ((a_x * v[0]) ** 2 + (a_y * v[1]) ** 2) / v[2] ** 2) - 1)
                   for v in (o, i)]  # fmt: skip
            c = (o[:, None, None] * h).sum(axis=0)
            g = np.sqrt(eta**2 - 1 + c * c)
            fresnel = 0.5 * ((g - c) / (g + c)) ** 2
            fresnel *= 1 + ((c * (g + c) - 1) / (c * (g - c) + 1)) ** 2
            f = d * fresnel / (1 + lam[0] + lam[1]) / (4 * o[2])
            direct = (f.mean(axis=1) * w).sum() * 2.0 * np.pi
            table = albedo(coat, *(np.array([value]) for value in o))[0]
            assert abs(direct - table) < 5e-5, (coat, theta, direct, table)


def test_leaf_is_sampled_as_its_pdf_says() -> None:
    cases = list(itertools.product(COATS[:4], VIEWS))
    level = 1.0 - (1.0 - 0.01) ** (1.0 / len(cases))
    for coats, wi in cases:
        bsdf = leaf(coats)

        def sample(u: mi.Vector3f, bsdf: mi.BSDF = bsdf, wi: tuple = wi) -> tuple:
            bs, weight = bsdf.sample(
                mi.BSDFContext(), hit(wi, (0.6, 0.8, 0.0)), u.x, mi.Point2f(u.y, u.z)
            )
            return bs.wo, dr.select(bs.pdf > 0.0, mi.Float(1.0), 0.0)

        def pdf(wo: mi.Vector3f, bsdf: mi.BSDF = bsdf, wi: tuple = wi) -> mi.Float:
            return bsdf.pdf(mi.BSDFContext(), hit(wi, (0.6, 0.8, 0.0)), wo)

        test = mi.chi2.ChiSquareTest(
            mi.chi2.SphericalDomain(), sample, pdf, sample_dim=3, sample_count=200_000, res=51,
            ires=16 if coats == COATS[2] else 6,
        )  # fmt: skip
        with contextlib.redirect_stdout(io.StringIO()):
            passed = test.run(level)
        assert passed, (coats, wi, test.p_value, test.messages)


def test_normal_incidence_gives_back_r_and_t() -> None:
    for coats, (r, t) in itertools.product(COATS, ((0.1, 0.05), (0.45, 0.47), (0.3, 0.1))):
        got, error = throughputs(measured(coats, r, t), (0.0, 0.0, 1.0))
        for part, want in zip((0, 1), (r, t), strict=True):
            off = np.abs(got[part] - want).max()
            assert off < 4.0 * error[part].max() + 1e-4, (coats, part, got[part], want)


def test_contents_give_back_prospect() -> None:
    kind = leaf_bsdf.Double
    r, t = prospect.Prospect(TABLE, kind, False).spectra(kind(*WAVELENGTHS), GREEN)
    got, error = throughputs(leaf(COATS[1]), (0.0, 0.0, 1.0))
    want = np.array([np.array(r).ravel(), np.array(t).ravel()])
    assert np.all(np.abs(got - want) < 4.0 * error + 1e-4), (got, want)


def test_lossless_leaf_loses_nothing_at_any_angle() -> None:
    for coats, wi, (r, t) in itertools.product(COATS, VIEWS, ((0.5, 0.5), (0.8, 0.2))):
        got, error = throughputs(measured(coats, r, t), wi)
        off = np.abs(got.sum(axis=0) - 1.0).max()
        assert off < 4.0 * error.max() + 1e-4, (coats, wi, got)


def test_leaf_is_reciprocal() -> None:
    rng = np.random.default_rng(7)
    a, b = (rng.normal(size=(3, 4096)) for _ in range(2))
    a, b = (v / np.sqrt((v * v).sum(axis=0)) for v in (a, b))
    for coats, ratio in itertools.product(COATS, (1.0, 1.6)):
        bsdf = measured(coats, 0.2, 0.3, ratio)
        there = bsdf.eval(mi.BSDFContext(), hit(a), mi.Vector3f(b)) / dr.abs(mi.Float(b[2]))
        back = bsdf.eval(mi.BSDFContext(), hit(b), mi.Vector3f(a)) / dr.abs(mi.Float(a[2]))
        there, back = np.array(there), np.array(back)
        assert np.all(np.abs(there - back) <= 2e-3 * there + 1e-6), coats


def test_half_space_gives_the_anchors() -> None:
    lines = (ROOT / "tests" / "data" / "transport_anchors.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    rows = [row for row in rows if row["b"] == "inf"]
    assert len(rows) == 5
    for row in rows:
        got = half_space.reflectance(float(row["a"]), float(row["n"]))
        assert abs(got - float(row["R1"])) < 1.5e-6, (row["n"], row["a"], got)


def test_half_space_without_scattering_or_absorption() -> None:
    for n in (1.0, 1.33, 1.38, 1.5):
        assert half_space.reflectance(0.0, n) == ((n - 1.0) / (n + 1.0)) ** 2
        assert abs(half_space.reflectance(1e-9, n) - ((n - 1.0) / (n + 1.0)) ** 2) < 1e-9
        # R = 1 - c √(1 - a) near a = 1.
        lost = [1.0 - half_space.reflectance(1.0 - x * x, n) for x in (1e-3, 1e-4)]
        assert abs(lost[0] / lost[1] - 10.0) < 0.1, (n, lost)
        table = half_space.table(n)
        assert np.all(np.diff(table) < 0.0), n
        at = 0.37 * (half_space.COUNT - 1)
        between = np.interp(at, np.arange(half_space.COUNT), table)
        assert abs(between - half_space.reflectance(1.0 - 0.37**2, n)) < 1e-7, n


def solid(alpha: float, coat_eta: float, eta: float = 1.38) -> mi.BSDF:
    """Solid tissue with a hundred times less of everything than `GREEN` but water."""
    held = {name: 0.01 * value for name, value in GREEN.items()} | {"structure": 1.0, "water": 0.01}
    return mi.load_dict({
        "type": "lamina_solid", "tissue": "contents", "prospect": str(TABLE), **held,
        "depth_mm": 0.5, "scattering_per_mm": 1.2, "eta": eta,
        "coat_eta": coat_eta, "coat_alpha": alpha,
    })  # fmt: skip


def test_solid_gives_back_the_half_space() -> None:
    kind = leaf_bsdf.Double
    model = prospect.Prospect(TABLE, kind, False)
    held = {name: 0.01 * value for name, value in GREEN.items()} | {"water": 0.01}
    held |= dict.fromkeys(prospect.BETALAINS, 0.0)
    absorbed = np.array(model.absorbed(kind(*WAVELENGTHS), held)).ravel() / 0.5
    want = np.array([half_space.reflectance(1.2 / (1.2 + mu), 1.38) for mu in absorbed])
    for alpha, coat_eta, side in ((0.05, 1.33, 1.0), (0.3, 1.38, -1.0), (0.6, 1.45, 1.0)):
        got, error = throughputs(solid(alpha, coat_eta), (0.0, 0.0, side))
        assert np.all(np.abs(got[0] - want) < 4.0 * error[0] + 1e-4), (alpha, got[0], want)
        assert np.all(got[1] == 0.0), got[1]


def test_solid_is_reciprocal() -> None:
    rng = np.random.default_rng(8)
    a, b = (rng.normal(size=(3, 4096)) for _ in range(2))
    a, b = (v / np.sqrt((v * v).sum(axis=0)) for v in (a, b))
    bsdf = solid(0.25, 1.4)
    there = bsdf.eval(mi.BSDFContext(), hit(a), mi.Vector3f(b)) / dr.abs(mi.Float(b[2]))
    back = bsdf.eval(mi.BSDFContext(), hit(b), mi.Vector3f(a)) / dr.abs(mi.Float(a[2]))
    there, back = np.array(there), np.array(back)
    assert np.all(np.abs(there - back) <= 2e-3 * there + 1e-6)
    assert np.all(there[:, a[2] * b[2] < 0.0] == 0.0)


def test_spectral_film_gives_the_mean_radiance_of_each_band() -> None:
    bands = [(450.0, 10.0), (550.0, 10.0), (650.0, 20.0), (750.0, 0.0)]
    sky = {"type": "irregular", "wavelengths": "300,900", "values": "1,7"}
    scene = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path"},
        "sensor": {"type": "perspective", "film": render.film(8, 8, bands)},
        "sky": {"type": "constant", "radiance": sky},
    })  # fmt: skip
    picture = render.render(scene, len(bands), spp=4096, passes=16, seed=1)
    error = np.sqrt(picture.variance.mean(axis=(0, 1)) / 64)
    want = np.array([1.0 + (center - 300.0) / 100.0 for center, _ in bands])
    z = (picture.mean.mean(axis=(0, 1)) - want) / error
    assert np.all(error < 1e-3 * want) and np.all(np.abs(z) < 4.0), (z, error)


def furnace_scene(albedo: float) -> mi.Scene:
    """A tilted diffuse square before a graded sky: a picture with noise everywhere."""
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1, "rr_depth": 1000},
        "sensor": {
            "type": "perspective", "fov": 40.0,
            "to_world": mi.ScalarTransform4f().look_at([0, -3, 2], [0, 0, 0], [0, 0, 1]),
            "film": render.film(32, 32, [(float(nm), 10.0) for nm in NAMES]),
        },
        "floor": {"type": "rectangle", "to_world": mi.ScalarTransform4f().scale(20.0),
                  "bsdf": {"type": "diffuse", "reflectance": spectrum(albedo)}},
        "ball": {"type": "sphere", "center": [0.0, 0.0, 0.6], "radius": 0.5,
                 "bsdf": {"type": "diffuse", "reflectance": spectrum(albedo)}},
        "lamp": {"type": "sphere", "center": [2.0, -2.0, 4.0], "radius": 0.5,
                 "emitter": {"type": "area", "radiance": spectrum(20.0)}},
        "sky": {"type": "constant", "radiance": spectrum(0.5)},
    })  # fmt: skip


def test_comparison_passes_equal_pictures_and_fails_a_one_percent_error() -> None:
    first = render.render(furnace_scene(0.5), 4, spp=1024, passes=32, seed=1)
    second = render.render(furnace_scene(0.5), 4, spp=1024, passes=32, seed=1001)
    other = render.render(furnace_scene(0.505), 4, spp=1024, passes=32, seed=2001)
    same = compare.compare(first, second, NAMES)
    assert same.passed, same.failures
    differs = compare.compare(first, other, NAMES)
    assert not differs.passed
    with tempfile.TemporaryDirectory() as folder:
        differs.write_pictures(Path(folder), "self")
        assert (Path(folder) / "self-z.png").stat().st_size > 0


def tilted(slope: tuple[float, float], eta: float, folder: Path) -> tuple[mi.BSDF, mi.BSDF]:
    """A leaf whose faces have one slope everywhere: as relief, and by Mitsuba's own `normalmap`."""
    faces = {}
    for face in leaf_bsdf.FACES:
        faces |= {f"{face}_eta": eta, f"{face}_alpha_across": 0.3, f"{face}_alpha_along": 0.3}
    shares = {"reflectance": spectrum(0.4), "transmittance": spectrum(0.2)}
    plain = {"type": "lamina_leaf", "tissue": "measured", **shares, **faces}
    x, y = slope
    moments = np.tile(np.array([x, y, x * x, y * y] * 2, dtype=np.float32), (2, 2, 1))
    file = folder / f"relief-{x}-{y}.exr"
    mi.Bitmap(moments, channel_names=relief_bsdf.MOMENTS).write(str(file))
    normal = np.array([-x, -y, 1.0]) / math.sqrt(x * x + y * y + 1.0)
    texels = np.tile((0.5 * normal + 0.5).astype(np.float32), (2, 2, 1))
    bitmap = {"type": "bitmap", "bitmap": mi.Bitmap(texels), "raw": True, "format": "variant"}
    # Mitsuba softens terminators by default (Chiang et al. 2019); the relief does not.
    no_terminator = {"use_shadowing_function": False}
    return (
        mi.load_dict({**plain, "type": "lamina_relief", "relief": str(file)}),
        mi.load_dict({"type": "normalmap", "normalmap": bitmap, "leaf": plain, **no_terminator}),
    )


def test_a_slope_tilts_a_face_as_mitsubas_normalmap_does() -> None:
    """Reflection on the adaxial face is the same but for the light that the relief gives back."""
    with tempfile.TemporaryDirectory() as folder:
        for slope, eta in itertools.product(((0.2, 0.0), (-0.1, 0.3)), (1.0, 1.45)):
            ours, theirs = tilted(slope, eta, Path(folder))
            normal_z = 1.0 / math.sqrt(slope[0] ** 2 + slope[1] ** 2 + 1.0)
            back = 1.0 / (1.0 - 0.25 * (1.0 - normal_z))
            compared = 0
            for view, light in itertools.product(VIEWS[:2], repeat=2):
                si = hit(view)
                a = np.array(ours.eval(mi.BSDFContext(), si, mi.Vector3f(*light))).ravel()[0]
                b = np.array(theirs.eval(mi.BSDFContext(), si, mi.Vector3f(*light))).ravel()[0]
                # Without a coat all light is the tissue's, which is given back; with one, less.
                least = back if eta == 1.0 else 1.0
                assert b > 0.0 and least - 1e-3 <= a / b <= back + 1e-3, (slope, eta, a / b, back)
                compared += 1
            assert compared == 4


class LossyLeaf(leaf_bsdf.LeafBSDF):
    """A leaf that loses 1 % of the light at every scattering."""

    def value_and_pdf(self, si: object, wo: object, active: object) -> tuple:
        value, pdf = super().value_and_pdf(si, wo, active)
        return 0.99 * value, pdf


def leaf_scene(plugin: str) -> mi.Scene:
    """A tilted green leaf over a card, under a lamp and a sky."""
    spec = {"type": plugin, "tissue": "contents", "prospect": str(TABLE), **GREEN}
    for face in leaf_bsdf.FACES:
        spec.update({f"{face}_eta": 1.45, f"{face}_alpha_across": 0.3, f"{face}_alpha_along": 0.2})
    turn = mi.ScalarTransform4f().translate([0, 0, 0.7]).rotate([1, 0, 0], 25.0)
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1, "rr_depth": 1000},
        "sensor": {
            "type": "perspective", "fov": 30.0,
            "to_world": mi.ScalarTransform4f().look_at([0, -3, 3], [0, 0, 0.5], [0, 0, 1]),
            "film": render.film(32, 32, [(float(nm), 10.0) for nm in NAMES]),
        },
        "leaf": {"type": "rectangle", "to_world": turn, "bsdf": spec},
        "card": {"type": "rectangle", "to_world": mi.ScalarTransform4f().scale(5.0),
                 "bsdf": {"type": "diffuse", "reflectance": spectrum(0.3)}},
        "lamp": {"type": "sphere", "center": [2.0, -2.0, 4.0], "radius": 0.5,
                 "emitter": {"type": "area", "radiance": spectrum(20.0)}},
        "sky": {"type": "constant", "radiance": spectrum(0.5)},
    })  # fmt: skip


def test_comparison_catches_one_percent_lost_in_the_leaf() -> None:
    mi.register_bsdf("lossy_leaf", LossyLeaf)
    right = render.render(leaf_scene("lamina_leaf"), 4, spp=1024, passes=32, seed=1)
    again = render.render(leaf_scene("lamina_leaf"), 4, spp=1024, passes=32, seed=1001)
    wrong = render.render(leaf_scene("lossy_leaf"), 4, spp=1024, passes=32, seed=2001)
    same = compare.compare(again, right, NAMES)
    assert same.passed, same.failures
    caught = compare.compare(wrong, right, NAMES)
    assert not caught.checks()["mean"] and not caught.checks()["regions"], caught.bands


# Broken scenes that a schema cannot tell from good ones: numbers that do not go together, names
# and files that are not there, curves that cross themselves. Ascending.
BEYOND_A_SCHEMA = """
    area_light bands camera_at_itself camera_upside colours_of_mesh compound_bipinnate
    compound_overlap compound_pair compound_palmate compound_palmate_round coverage dark_light
    energy file_missing growth_arrival growth_steps instances_flood instances_rows leaf_individual
    lens_angle lens_behind lens_blades lens_magnification lens_near lens_object lens_tilt matrix
    model mosaic_shares no_light outline_cubic_crossing outline_curve_crossing outline_curve_end
    outline_growth_crossing outline_growth_crossing_axis outline_specimen_inside
    outline_specimen_nested outline_specimen_notch outline_svg_crossing outline_svg_end
    outline_svg_parts outline_teeth_crossing outline_transport_cells path_outside picture_infrared
    plant_climbs_on_many plant_days plant_flower plant_leaf plant_order plant_pot plant_relief
    plant_room plant_shines plant_wall scatter_days scatter_effect scatter_order senescence_auxin
    sensitivities_file solid_mesh solid_mosaic surface_cells surface_stomata table_file unknown_name
    unsorted venation_agrophic venation_cells venation_craspedodromous venation_origin
    venation_origins_meet venation_pairs venation_quaternaries venation_sinus
    venation_transport_fine venation_young white_light wilting_on_ground wrong_file
""".split()


def scene_schema() -> jsonschema_rs.Validator:
    """The schema that is committed."""
    text = (ROOT / "scenes" / "scene.schema.json").read_text()
    return jsonschema_rs.validator_for(json.loads(text))


def test_every_scene_of_the_repository_is_valid_by_the_schema() -> None:
    """An editor that goes by the schema finds no fault with them."""
    schema = scene_schema()
    scenes = sorted((ROOT / "scenes").glob("*/*.toml"))
    assert len(scenes) >= 20, scenes
    # A file of leaves alone, whose stages are drawn.
    scenes.remove(ROOT / "scenes/figures/runions-20.toml")
    for scene in scenes:
        errors = list(schema.iter_errors(tomllib.loads(scene.read_text())))
        assert not errors, f"{scene}: {errors[0].message} at {errors[0].instance_path}"


def test_broken_scenes_are_refused_by_the_schema_as_far_as_one_can_tell() -> None:
    """Unknown keys, wrong types, ranges, missing keys and kinds."""
    schema = scene_schema()
    refused, passed = [], []
    for scene in sorted((ROOT / "tests" / "format" / "broken").glob("*.toml")):
        try:
            tree = tomllib.loads(scene.read_text())
        except (tomllib.TOMLDecodeError, UnicodeDecodeError):
            continue
        (passed if schema.is_valid(tree) else refused).append(scene.stem)
    unlisted, too_many = set(passed) - set(BEYOND_A_SCHEMA), set(BEYOND_A_SCHEMA) - set(passed)
    assert not unlisted, f"the schema finds no fault with {unlisted}, which BEYOND_A_SCHEMA lacks"
    assert not too_many, f"BEYOND_A_SCHEMA has {too_many}, which are refused or are not there"
    assert len(refused) >= 40, refused


def main() -> int:
    """Runs every test of this file, or those whose names hold the arguments."""
    plugins.register()
    return run_tests(globals(), f"reference ({VARIANT})")


if __name__ == "__main__":
    sys.exit(main())
