"""How far light that a leaf lets through spreads sideways: `reference/run light-spread`.

A Monte Carlo simulation of a slab of leaf tissue: it scatters (Henyey-Greenstein) and absorbs, and
its faces are rough, so that light is diffuse after either of them, as between PROSPECT's plates.
Paths are drawn once without absorption; absorption then weights each by exp(-a L), with the
absorption a of the slab and the path's length L. Lengths are in thicknesses of the slab.

The printed tables are: that the slab with its scattering from N and with PROSPECT's own absorption
has PROSPECT's R and T; where light that entered at one point leaves; how well the kernel and the
length of `docs/src/theory/light-spread.md` fit; the check by diffusion theory; and the lengths of
leaves in mm.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "leafmodel" / "optics" / "src" / "prospect_d.csv"
INDEX = 1.43
ASYMMETRY = 0.8
# Reduced scattering of the slab, µs' d, for N plates: fitted to the transmittance without
# absorption.
PER_PLATE = 1.85
STRUCTURES = (1.3, 1.5, 1.8, 2.1, 2.5, 3.0)
ABSORBED = (0.0, 0.03, 0.1, 0.2, 0.4, 0.8, 1.5, 3.0)
# N, chlorophyll, carotenoids, anthocyanins, brown, water, dry matter.
LEAVES = {
    "sun-green": (1.6, 45.0, 10.0, 0.5, 0.0, 0.011, 0.006),
    "shade-thin": (1.3, 35.0, 8.0, 0.0, 0.0, 0.008, 0.003),
    "dark-evergreen": (2.1, 75.0, 15.0, 1.0, 0.0, 0.022, 0.013),
    "golden": (1.55, 1.0, 7.1, 0.0, 0.0, 0.0064, 0.0036),
}
WAVELENGTHS = (450, 550, 680, 800)


def averaged_transmittance(alpha: float) -> float:
    """Fresnel transmittance into the slab, averaged over a cone (Stern 1964)."""
    nodes, weights = np.polynomial.legendre.leggauss(128)
    theta = 0.5 * alpha * (nodes + 1.0)
    cos_i = np.cos(theta)
    cos_t = np.sqrt(1.0 - (np.sin(theta) / INDEX) ** 2)
    across = (cos_i - INDEX * cos_t) / (cos_i + INDEX * cos_t)
    along = (INDEX * cos_i - cos_t) / (INDEX * cos_i + cos_t)
    flux = np.sin(theta) * cos_i * alpha * weights
    return float(((1.0 - 0.5 * (across**2 + along**2)) * flux).sum() / np.sin(alpha) ** 2)


LIT, INSIDE = averaged_transmittance(np.radians(40.0)), averaged_transmittance(0.5 * np.pi)
KEPT = 1.0 - INSIDE / INDEX**2


def prospect(plates: float, absorbed: float) -> tuple[float, float]:
    """R and T of PROSPECT's pile that absorbs `absorbed` > 0 in all."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    mu = 0.5 * (nodes + 1.0)
    tau = float((mu * np.exp(-absorbed / plates / mu) * weights).sum())
    t_out, series = INSIDE / INDEX**2, 1.0 - (KEPT * tau) ** 2
    t_top, t = LIT * tau * t_out / series, INSIDE * tau * t_out / series
    r_top, r = 1.0 - LIT + KEPT * tau * t_top, 1.0 - INSIDE + KEPT * tau * t
    d = np.sqrt((1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * (1.0 - r - t))
    a, b = (1.0 + r * r - t * t + d) / (2.0 * r), (1.0 - r * r + t * t + d) / (2.0 * t)
    rest = b ** (plates - 1.0)
    below = (a * rest) ** 2 - 1.0
    r_rest, t_rest = a * (rest**2 - 1.0) / below, rest * (a * a - 1.0) / below
    between = 1.0 - r * r_rest
    return r_top + t_top * r_rest * t / between, t_top * t_rest / between


def diffuse(count: int, rng: np.random.Generator) -> np.ndarray:
    """Directions of light from a perfectly rough face towards +z."""
    cos = np.sqrt(rng.random(count))
    sin, turn = np.sqrt(1.0 - cos * cos), 2.0 * np.pi * rng.random(count)
    return np.stack([sin * np.cos(turn), sin * np.sin(turn), cos])


def scattered(w: np.ndarray, g: float, rng: np.random.Generator) -> np.ndarray:
    """Directions after scattering by Henyey and Greenstein's phase function."""
    x = rng.random(w.shape[1])
    cos = (
        (1.0 + g * g - ((1.0 - g * g) / (1.0 - g + 2.0 * g * x)) ** 2) / (2.0 * g)
        if g
        else 2.0 * x - 1.0
    )
    sin, turn = np.sqrt(np.maximum(1.0 - cos * cos, 0.0)), 2.0 * np.pi * rng.random(len(x))
    # An orthonormal frame without a pole (Duff et al. 2017).
    sign = np.copysign(1.0, w[2])
    a = -1.0 / (sign + w[2])
    b = w[0] * w[1] * a
    first = np.stack([1.0 + sign * w[0] ** 2 * a, sign * b, -sign * w[0]])
    second = np.stack([b, sign + w[1] ** 2 * a, -w[1]])
    out = sin * np.cos(turn) * first + sin * np.sin(turn) * second + cos * w
    return out / np.linalg.norm(out, axis=0)


def paths(reduced: float, g: float, count: int, rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Side (+1 through), distance from the point of entry and length of each path."""
    depth = reduced / (1.0 - g)
    w, place, length = diffuse(count, rng), np.zeros((3, count)), np.zeros(count)

    def free(size: int) -> np.ndarray:
        return -np.log1p(-rng.random(size)) / depth if depth > 0.0 else np.full(size, np.inf)

    left, found = free(count), []
    while len(left):
        to_face = np.where(w[2] > 0.0, 1.0 - place[2], place[2]) / np.maximum(np.abs(w[2]), 1e-300)
        meets = to_face <= left
        step = np.where(meets, to_face, left)
        place, length, left = place + w * step, length + step, left - step
        side = np.where(w[2] > 0.0, 1.0, -1.0)
        place[2] = np.where(meets, 0.5 * (side + 1.0), place[2])
        leaves = meets & (rng.random(len(left)) >= KEPT)
        found.append((side[leaves], np.hypot(place[0], place[1])[leaves], length[leaves]))
        back = diffuse(len(left), rng)
        back[2] *= -side
        w = np.where(meets, back, scattered(w, g, rng))
        left = np.where(meets, left, free(len(left)))
        w, place, length, left = w[:, ~leaves], place[:, ~leaves], length[~leaves], left[~leaves]
    return tuple(np.concatenate(part) for part in zip(*found, strict=True))


class Leaving:
    """The light that leaves on one side, at one absorption."""

    def __init__(self, found: tuple[np.ndarray, ...], side: float, absorbed: float) -> None:
        sides, distance, length = found
        mine = sides == side
        weight = np.exp(-absorbed * length[mine])
        order = np.argsort(distance[mine])
        self.share = weight.sum() / len(sides)
        self.distance = distance[mine][order]
        self.below = np.cumsum(weight[order]) / weight.sum()
        self.rms = float(np.sqrt((weight * distance[mine] ** 2).sum() / weight.sum()))

    def within(self, share: float) -> float:
        """Distance within which a share of it leaves."""
        return float(self.distance[np.searchsorted(self.below, share)])

    def kernel(self) -> tuple[float, float]:
        """Length s of the kernel with the same median, and its greatest deviation."""
        s = self.within(0.5) / MEDIAN
        x = self.distance / s
        return s, float(np.abs(1.0 - (1.0 + x) * np.exp(-x) - self.below).max())


# Median of the distance from which light comes by the kernel, over s: 1 - (1 + x) exp(-x) = 1/2.
MEDIAN = 1.67835


def length(plates: float, absorbed: float) -> float:
    """The page's length s of the kernel."""
    return 0.81 / ((1.0 + 0.18 * (plates - 1.0)) * np.cbrt(1.0 + 6.2 * absorbed))


def diffusion_rms(reduced: float, absorbed: float) -> float:
    """Root mean square distance of light through the slab by diffusion theory.

    Source at 2/3 of a transport length, the mean depth to which diffuse light gets unscattered;
    extrapolated boundaries behind faces that send back KEPT of all light (as Contini et al. 1997).
    """
    d = 1.0 / (3.0 * reduced)
    beyond = 2.0 * d * (1.0 + KEPT) / (1.0 - KEPT)
    kappa = np.sqrt(absorbed / d)
    near, whole = 2.0 / (3.0 * reduced) + beyond, 1.0 + 2.0 * beyond
    slope = (
        near / np.tanh(kappa * near)
        + beyond * np.tanh(kappa * beyond)
        - whole / np.tanh(kappa * whole)
    )
    return float(np.sqrt(-2.0 / kappa * slope))


def leaf_absorption(contents: tuple[float, ...], nm: int) -> float:
    """What a leaf's contents absorb, by PROSPECT-D's table."""
    lines = TABLE.read_text(encoding="utf-8").splitlines()
    row = next(line for line in lines if line.startswith(f"{nm},") or line.startswith(f"{nm}.0,"))
    coefficients = [float(value) for value in row.split(",")][2:]
    return sum(k * c for k, c in zip(coefficients, contents[1:], strict=True))


def table(heads: list[str], rows: list[list[str]]) -> str:
    """A table in Markdown."""
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def report(count: int) -> str:
    """All tables."""
    rng = np.random.default_rng(7)
    slabs = {n: paths(PER_PLATE * (n - 1.0), ASYMMETRY, count, rng) for n in STRUCTURES}
    shown, fits, shapes = [], [], []
    for n, found in slabs.items():
        for a in ABSORBED:
            through, back = Leaving(found, 1.0, a), Leaving(found, -1.0, a)
            s, off = through.kernel()
            fits.append(length(n, a) / s - 1.0)
            shapes.append(off)
            r, t = prospect(n, max(a, 1e-7))
            if n in (1.5, 2.1):
                cells = [1.0 - LIT + LIT * back.share, r, LIT * through.share, t]
                cells += [s, length(n, a), off, through.within(0.5), through.rms, back.within(0.5)]
                shown.append([f"{n}", f"{a}"] + [f"{value:.3f}" for value in cells])
    heads = [
        "*N*",
        "Σ C k",
        "R slab",
        "R PROSPECT",
        "T slab",
        "T PROSPECT",
        "*s*",
        "*s* by formula",
    ]
    heads += ["off the kernel", "median through", "rms through", "median reflected"]
    out = ["## How far light spreads sideways in a leaf", "", table(heads, shown), ""]
    out.append(
        f"The formula for *s* is off by {100 * min(fits):+.1f} to {100 * max(fits):+.1f} % over all"
        f" N and Σ C k (root mean square {100 * np.sqrt(np.mean(np.square(fits))):.1f} %), the "
        "kernel's"
        f" share within any distance by {max(shapes):.3f} at most."
    )
    out += ["", "### The phase function", ""]
    rows = []
    for g in (0.0, 0.5, 0.8, 0.9):
        found = paths(PER_PLATE * 0.6, g, count, rng)
        rows.append(
            [f"{g}"] + [f"{Leaving(found, 1.0, a).kernel()[0]:.3f}" for a in (0.03, 0.4, 1.5)]
        )
    out.append(table(["*g*", *(f"*s* at Σ C k = {a}" for a in (0.03, 0.4, 1.5))], rows))
    out += ["", "### Against diffusion theory", ""]
    rows = []
    for reduced in (2.0, 5.0, 15.0):
        found = paths(reduced, 0.0, count // 2, rng)
        for a in (0.1, 0.5):
            simulated, closed = Leaving(found, 1.0, a).rms, diffusion_rms(reduced, a)
            rows.append(
                [
                    f"{reduced:g}",
                    f"{a}",
                    f"{simulated:.3f}",
                    f"{closed:.3f}",
                    f"{100 * (closed / simulated - 1):+.1f} %",
                ]
            )
    out.append(table(["µs′ d", "µa d", "rms, simulated", "rms, diffusion", "difference"], rows))
    out += [
        "",
        "### In leaves",
        "",
        "Length *s*, mm; half of the light comes from within 1.68 *s*.",
        "",
    ]
    rows = []
    for name, contents in LEAVES.items():
        for thickness in (0.1, 0.2, 0.4):
            lengths = [
                thickness * length(contents[0], leaf_absorption(contents, nm)) for nm in WAVELENGTHS
            ]
            rows.append([name, f"{thickness}"] + [f"{value:.3f}" for value in lengths])
    out.append(table(["leaf", "thickness, mm", *(f"{nm} nm" for nm in WAVELENGTHS)], rows))
    return "\n".join(out) + "\n"


def main() -> None:
    """Prints the tables, or writes them."""
    parser = argparse.ArgumentParser(prog="reference/run light-spread", description=__doc__)
    parser.add_argument("--paths", type=int, default=100_000, help="paths in each slab")
    parser.add_argument("--record", action="store_true", help="write to reference/results")
    arguments = parser.parse_args()
    text = report(arguments.paths)
    if arguments.record:
        (ROOT / "reference" / "results" / "light-spread.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
