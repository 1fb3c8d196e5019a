"""Slabs and half-spaces by packages of other authors: `reference/run slabs`.

Each row of `tests/data/transport_anchors.csv` is solved by iadpython (adding-doubling with Fresnel
boundaries) and, where the slab has the index of air, by PythonicDISORT (discrete ordinates). A
stack of three layers that differ goes through PythonicDISORT too; `leafmodel` tests its own routes
against those figures. The exit status is 1 if a share is further off than the package's stated
error.
"""

from __future__ import annotations

import argparse
import csv
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import iadpython
import numpy as np
from PythonicDISORT.pydisort import pydisort

ROOT = Path(__file__).resolve().parents[2]
ANCHORS = ROOT / "tests" / "data" / "transport_anchors.csv"
RESULTS = ROOT / "reference" / "results" / "slabs.md"
# Heading of the part that slabs_mitsuba writes.
MITSUBA = "## By Mitsuba's volpath"
SHARES = ("R1", "T1", "Rd", "Td")
STREAMS = 64
# Optical depth that stands for infinity in PythonicDISORT.
ENDLESS = 1000.0
# PythonicDISORT agrees to the anchors' last digit; iadpython has errors of its quadrature. It is
# wrong by 1e-3 at 32 points and n = 1, and gives nonsense at 64, so it has 16 there.
TOLERANCES = {"PythonicDISORT": 6e-7, "iadpython": 1.5e-4}


@dataclass(frozen=True)
class Layer:
    """A layer of the refractive index of air."""

    albedo: float
    depth: float
    g: float


# Depth, albedo and g differ from layer to layer.
STACK = (Layer(0.8, 0.5, 0.5), Layer(0.99, 1.0, 0.7), Layer(0.9, 2.0, 0.0))


def by_disort(layers: Sequence[Layer]) -> list[float]:
    """R and T at normal, then at Lambertian incidence; layers have the index of air."""
    depths = np.cumsum([min(layer.depth, ENDLESS) for layer in layers])
    albedos = np.array([layer.albedo for layer in layers])
    moments = np.array([[layer.g**degree for degree in range(4 * STREAMS)] for layer in layers])
    peaks = moments[:, STREAMS]
    shares = []
    for beam, diffuse in ((1.0, 0.0), (0.0, 1.0 / math.pi)):
        solved = pydisort(
            depths, albedos, STREAMS, moments, 1.0, beam, 0.0,
            NLeg=STREAMS, f_arr=peaks, only_flux=True, b_neg=diffuse,
        )  # fmt: skip
        up, down = solved[1], solved[2]
        shares += [float(up(0.0)), float(sum(down(depths[-1])))]
    return shares


def by_iadpython(n: float, a: float, b: float, g: float) -> list[float]:
    """R and T at normal, then at Lambertian incidence."""
    sample = iadpython.Sample(a=a, b=b, g=g, n=n, quad_pts=16 if n == 1.0 else 32)
    return [float(share) for share in sample.rt()]


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def report() -> tuple[str, list[str]]:
    """The tables, and what is too far off."""
    lines = ANCHORS.read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    shown, faults = [], []
    furthest = dict.fromkeys(TOLERANCES, 0.0)
    for row in rows:
        if row["kind"] == "canopy":
            continue
        n, a, b, g = (float(row[key] or 0.0) for key in ("n", "a", "b", "g"))
        # PythonicDISORT excludes an albedo of 1; there is no such row of index 1.
        found = {"iadpython": by_iadpython(n, a, b, g)}
        if n == 1.0:
            found["PythonicDISORT"] = by_disort([Layer(a, b, g)])
        for place, share in enumerate(SHARES):
            if not row[share]:
                continue
            anchor = float(row[share])
            cells = [row["n"], row["a"], row["b"], f"{g:g}", share, f"{anchor:.6f}"]
            for package in TOLERANCES:
                if package not in found:
                    cells += ["–", "–"]
                    continue
                off = found[package][place] - anchor
                furthest[package] = max(furthest[package], abs(off))
                cells += [f"{found[package][place]:.6f}", f"{off:+.1e}"]
                if abs(off) > TOLERANCES[package]:
                    faults.append(f"{package}: {' '.join(cells)}")
            shown.append(cells)
    heads = ["n", "a", "b", "g", "share", "anchor"]
    for package in TOLERANCES:
        heads += [package, "off"]
    out = ["## Slabs and half-spaces by other packages", "", table(heads, shown), ""]
    furthest_words = [f"{package} {off:.1e}" for package, off in furthest.items()]
    out += [f"Furthest off: {', '.join(furthest_words)}.", "", "### Three layers", ""]
    layers = [[f"{layer.albedo:g}", f"{layer.depth:g}", f"{layer.g:g}"] for layer in STACK]
    out += ["From the first on, all of the index of air:", "", table(["a", "b", "g"], layers), ""]
    for words, stack in (("lit on the first", STACK), ("lit on the last", STACK[::-1])):
        shares = zip(SHARES, by_disort(stack), strict=True)
        out.append(f"- {words}: " + ", ".join(f"{name} {share:.7f}" for name, share in shares))
    return "\n".join(out) + "\n", faults


def main() -> int:
    """Prints the tables, or writes them."""
    parser = argparse.ArgumentParser(prog="reference/run slabs", description=__doc__)
    parser.add_argument("--record", action="store_true", help="write to reference/results")
    arguments = parser.parse_args()
    text, faults = report()
    if arguments.record:
        # Below stands what Mitsuba finds, by slabs_mitsuba.
        _, mark, mitsuba = RESULTS.read_text(encoding="utf-8").partition(MITSUBA)
        below = f"\n{mark}{mitsuba}" if mark else ""
        RESULTS.write_text(text + below, encoding="utf-8")
    print(text)
    for fault in faults:
        print(f"too far off: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
