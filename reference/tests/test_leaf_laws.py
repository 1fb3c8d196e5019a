"""What `docs/src/theory/leaf-bsdf.md` says of every leaf, by quadrature."""

from __future__ import annotations

import pytest

pytest.importorskip("mitsuba")

import itertools
from collections.abc import Iterator

import drjit as dr
import mitsuba as mi
import numpy as np
from mitsuba_leaves import GREEN, TABLE, hit, leaf, measured

from lamina.mitsuba import tissue
from lamina.mitsuba.coat import Coat

LIKE = ((1.45, 0.3, 0.3), (1.45, 0.3, 0.3))
UNLIKE = ((1.5, 0.5, 0.35), (1.35, 0.6, 0.6))
NONE = ((1.0, 0.3, 0.3), (1.0, 0.3, 0.3))
COATS = (LIKE, UNLIKE, NONE)
CLEAR = dict.fromkeys(GREEN, 0.0) | {"structure": 1.7}
# A leaf is dead if it has less than half as much water as dry matter.
DRY = {"water": 0.0, "dry_matter": 1e-12}
DEAD = GREEN | {"chlorophyll": 2.0, "brown": 2.0, "water": 0.001}
WITHERING = GREEN | {"water": 0.006}
RED = GREEN | {"anthocyanins": 20.0}
SINES = (0.0, 0.5, 0.85, 0.98)


def of_contents(coats: tuple, contents: dict) -> mi.BSDF:
    """A leaf of contents."""
    return leaf(coats, tissue="contents", prospect=str(TABLE), **contents)


def leaves(coats: tuple) -> Iterator[tuple[str, mi.BSDF]]:
    """Living, dead and measured leaves, with their names."""
    for name, contents in (("green", GREEN), ("red", RED), ("dead", DEAD), ("dry", WITHERING)):
        yield name, of_contents(coats, contents)
    for r, t, ratio in ((0.1, 0.05, 1.7), (0.45, 0.47, 1.0), (0.3, 0.1, 0.6), (0.06, 0.6, 1.5)):
        yield f"{r}, {t}, {ratio}", measured(coats, r, t, ratio)


def directions(side: float) -> np.ndarray:
    """Views from one side, `[3, views]`."""
    sine, turn = np.array(SINES), np.array([0.0, 0.4, 2.3, 4.0])
    return np.stack([sine * np.cos(turn), sine * np.sin(turn), side * np.sqrt(1.0 - sine**2)])


def shares(bsdf: mi.BSDF, views: np.ndarray) -> np.ndarray:
    """What is sent back and let through, `[2, wavelengths, views]`; nothing may be negative."""
    nodes, weights = np.polynomial.legendre.leggauss(64)
    root = 0.5 * (nodes + 1.0)
    turn = 2.0 * np.pi * (np.arange(96) + 0.5) / 96
    mu, phi = (part.ravel() for part in np.meshgrid(root**2, turn, indexing="ij"))
    sine = np.sqrt(1.0 - mu * mu)
    # dω = dμ dφ, μ = s², dμ = 2 s ds.
    weight = np.repeat(root * weights, 96) * 2.0 * np.pi / 96
    light = np.stack([sine * np.cos(phi), sine * np.sin(phi), mu])
    parts = []
    for side in (1.0, -1.0):
        lit = light * np.array([1.0, 1.0, side])[:, None]
        lit = (
            lit[:, None, :] * np.sign(views[2])[None, :, None] ** np.array([0, 0, 1])[:, None, None]
        )
        seen = np.broadcast_to(views[:, :, None], lit.shape)
        value = bsdf.eval(
            mi.BSDFContext(), hit(seen.reshape(3, -1)), mi.Vector3f(lit.reshape(3, -1))
        )
        value = np.array(value).reshape(-1, views.shape[1], len(weight))
        assert value.min() >= 0.0, (bsdf, value.min())
        parts.append(value @ weight)
    return np.array(parts)


def test_no_leaf_sends_out_more_than_comes_in() -> None:
    for coats in COATS:
        for name, bsdf in leaves(coats):
            for side in (1.0, -1.0):
                whole = shares(bsdf, directions(side)).sum(axis=0)
                assert whole.max() <= 1.0 + 3e-4, (coats, name, side, whole)


def test_leaf_gives_back_r_and_t_along_the_normal() -> None:
    upright = np.array([[0.0], [0.0], [1.0]])
    for coats in COATS:
        for contents in (GREEN, RED, DEAD, WITHERING):
            bsdf = of_contents(coats, contents)
            got = shares(bsdf, upright)[:, :, 0]
            want = np.array([np.array(part).ravel() for part in bsdf.spectra(hit(upright), True)])
            assert np.abs(got - want).max() < 3e-4, (coats, contents, got, want)
        for r, t, ratio in ((0.1, 0.05, 1.7), (0.45, 0.47, 1.0), (0.3, 0.1, 0.6)):
            for side, below in ((1.0, 1.0), (-1.0, ratio)):
                got = shares(measured(coats, r, t, ratio), side * upright)[:, :, 0]
                off = np.abs(got - np.array([[below * r], [t]])).max()
                assert off < 3e-4, (coats, r, t, side, got)


def test_leaf_without_absorption_loses_nothing_at_any_angle() -> None:
    for coats in COATS:
        cases = [of_contents(coats, CLEAR), of_contents(coats, CLEAR | DRY)]
        cases += [measured(coats, r, 1.0 - r) for r in (0.15, 0.3, 0.5, 0.8)]
        for bsdf, side in itertools.product(cases, (1.0, -1.0)):
            whole = shares(bsdf, directions(side)).sum(axis=0)
            assert np.abs(whole - 1.0).max() < 3e-4, (coats, bsdf, side, whole)


def test_leaf_is_reciprocal() -> None:
    rng = np.random.default_rng(7)
    a, b = (rng.normal(size=(3, 4096)) for _ in range(2))
    a, b = (v / np.sqrt((v * v).sum(axis=0)) for v in (a, b))
    for coats in COATS:
        for name, bsdf in leaves(coats):
            there = bsdf.eval(mi.BSDFContext(), hit(a), mi.Vector3f(b)) / dr.abs(mi.Float(b[2]))
            back = bsdf.eval(mi.BSDFContext(), hit(b), mi.Vector3f(a)) / dr.abs(mi.Float(a[2]))
            there, back = np.array(there), np.array(back)
            assert np.all(np.abs(there - back) <= 2e-3 * there + 1e-6), (coats, name)


def test_two_halves_over_each_other_are_the_leaf() -> None:
    coats = tuple(Coat(*numbers) for numbers in UNLIKE)
    kind = tissue.Double
    r, t, below = kind(0.1, 0.3, 0.45, 0.4), kind(0.05, 0.2, 0.5, 0.3), kind(0.2, 0.35, 0.45, 0.5)
    whole = tissue.leaf(r, t, below, coats, tissue.shape(), measured=False)
    upper, lower = (whole.half(face).faces for face in (0, 1))
    # Outside and inside of each half; between the insides light goes back and forth.
    halves = (upper, lower[::-1])
    between = 1.0 / (1.0 - halves[0][1].r * halves[1][1].r)
    for (outside, inside), (_, beyond), want in zip(halves, halves[::-1], whole.faces, strict=True):
        back = outside.r + outside.t * beyond.r * between * inside.t
        through = outside.t * between * beyond.t
        assert np.abs(np.array(back - want.r)).max() < 1e-9
        assert np.abs(np.array(through - want.t)).max() < 1e-9
