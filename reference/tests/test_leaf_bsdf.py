"""The leaf BSDF in Mitsuba: sampling, energy, reciprocity."""

from __future__ import annotations

import pytest

pytest.importorskip("mitsuba")

import contextlib
import io
import itertools

import drjit as dr
import mitsuba as mi
import numpy as np
from mitsuba_leaves import COATS, VIEWS, hit, leaf, measured, throughputs

from lamina.mitsuba.coat import Coat, albedo


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


@pytest.mark.deep
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
        for side in (1.0, -1.0):
            got, error = throughputs(measured(coats, r, t), (0.0, 0.0, side))
            for part, want in zip((0, 1), (r, t), strict=True):
                off = np.abs(got[part] - want).max()
                assert off < 4.0 * error[part].max() + 1e-4, (coats, side, part, got[part], want)


# The triangle's normal in the shading frame, 20° off, and views, two of them between the planes.
TRIANGLE = (0.342, 0.0, 0.94)
ACROSS = (
    (0.2, 0.3, 0.9),
    (-0.5, 0.1, 0.6),
    (0.3, -0.4, -0.7),
    (0.97, 0.1, -0.12),
    (-0.97, 0.1, 0.12),
)


def tilted(wi: object) -> mi.SurfaceInteraction3f:
    """A hit on a triangle that the shading normal is not at right angles to."""
    length = float(np.linalg.norm(wi))
    normal = np.array(TRIANGLE) / np.linalg.norm(TRIANGLE)
    return hit(tuple(x / length for x in wi), normal=tuple(float(x) for x in normal))


def test_light_keeps_its_side_of_a_tilted_triangle_and_its_energy() -> None:
    side = 512
    n = side * side
    index = dr.arange(mi.UInt32, n)
    for coats, wi in itertools.product(COATS[:2], ACROSS):
        rng = mi.PCG32(size=n)
        u = (mi.Float(index % side) + rng.next_float32()) / side
        v = (mi.Float(index // side) + rng.next_float32()) / side
        bsdf, si = measured(coats, 0.6, 0.4), tilted(wi)
        bs, weight = bsdf.sample(mi.BSDFContext(), si, rng.next_float32(), mi.Point2f(u, v))
        got = np.array(weight)
        off = np.abs(got.mean(axis=1) - 1.0).max()
        assert off < 4.0 * got.std() / side + 1e-4, (coats, wi, off)
        drawn = np.array(bs.pdf) > 0.0
        wo, triangle = np.array(bs.wo), np.array(si.n).ravel()[:, None]
        assert np.all(((wo * triangle).sum(axis=0) * wo[2] >= 0.0)[drawn]), (coats, wi)
        value, pdf = bsdf.eval_pdf(mi.BSDFContext(), si, bs.wo)
        ratio = np.array(value) / np.maximum(np.array(pdf), 1e-20)
        assert np.all(np.abs(ratio - got)[:, drawn] <= 2e-3 * got[:, drawn] + 1e-5), (coats, wi)


@pytest.mark.deep
def test_tilted_leaf_is_sampled_as_its_pdf_says() -> None:
    level = 1.0 - (1.0 - 0.01) ** (1.0 / len(ACROSS))
    for wi in ACROSS:
        bsdf = leaf(COATS[0])

        def sample(u: mi.Vector3f, bsdf: mi.BSDF = bsdf, wi: tuple = wi) -> tuple:
            context = mi.BSDFContext()
            bs, _ = bsdf.sample(context, tilted(wi), u.x, mi.Point2f(u.y, u.z))
            return bs.wo, dr.select(bs.pdf > 0.0, mi.Float(1.0), 0.0)

        def pdf(wo: mi.Vector3f, bsdf: mi.BSDF = bsdf, wi: tuple = wi) -> mi.Float:
            return bsdf.pdf(mi.BSDFContext(), tilted(wi), wo)

        test = mi.chi2.ChiSquareTest(
            mi.chi2.SphericalDomain(), sample, pdf, sample_dim=3, sample_count=200_000, res=51,
            ires=16,
        )  # fmt: skip
        with contextlib.redirect_stdout(io.StringIO()):
            passed = test.run(level)
        assert passed, (wi, test.p_value, test.messages)
