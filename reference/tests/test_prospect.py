"""PROSPECT-D and pigments, as the plugins compute them a second time."""

from __future__ import annotations

import pytest

pytest.importorskip("mitsuba")

import csv
import itertools
import re
import subprocess
import tempfile
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np
from mitsuba_leaves import COATS, GREEN, TABLE, WAVELENGTHS, leaf, throughputs

from lamina.mitsuba import prospect, tissue
from validation import pigments
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]


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
shares.pelargonidin = 0.2
shares.cyanidin = 0.3
shares.peonidin = 0.1
shares.delphinidin = 0.2
shares.petunidin = 0.1
shares.malvidin = 0.1
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
    kind = tissue.Double
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


def test_contents_give_back_prospect() -> None:
    kind = tissue.Double
    r, t = prospect.Prospect(TABLE, kind, False).spectra(kind(*WAVELENGTHS), GREEN)
    got, error = throughputs(leaf(COATS[1]), (0.0, 0.0, 1.0))
    want = np.array([np.array(r).ravel(), np.array(t).ravel()])
    assert np.all(np.abs(got - want) < 4.0 * error + 1e-4), (got, want)
