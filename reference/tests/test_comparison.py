"""The comparison with Mitsuba passes equal pictures, and catches a loss of one percent."""

from __future__ import annotations

import pytest

pytest.importorskip("mitsuba")

import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np
from mitsuba_leaves import GREEN, NAMES, TABLE, spectrum

from lamina.mitsuba import leaf_bsdf
from validation import compare, render


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


@pytest.mark.deep
def test_comparison_catches_one_percent_lost_in_the_leaf() -> None:
    mi.register_bsdf("lossy_leaf", LossyLeaf)
    right = render.render(leaf_scene("lamina_leaf"), 4, spp=1024, passes=32, seed=1)
    again = render.render(leaf_scene("lamina_leaf"), 4, spp=1024, passes=32, seed=1001)
    wrong = render.render(leaf_scene("lossy_leaf"), 4, spp=1024, passes=32, seed=2001)
    same = compare.compare(again, right, NAMES)
    assert same.passed, same.failures
    caught = compare.compare(wrong, right, NAMES)
    assert not caught.checks()["mean"] and not caught.checks()["regions"], caught.bands
