"""Slabs and half-spaces by Mitsuba's `volpath`: `reference/run slabs-mitsuba`.

Each row of `tests/data/transport_anchors.csv` is a homogeneous medium between two planes, with
smooth dielectric boundaries or, where the index is that of air, none. By reciprocity, what a slab
reflects of light along a direction is what is seen along that direction under light from everywhere
above; what it transmits is what is seen of light from everywhere below. So rays start just above
the slab, along its normal (R1, T1) or with the density of Lambertian light (Rd, Td), a red lamp
covers everything above and a green one everything below. Independent passes give the standard
error. The exit status is 1 if a share is further off than four standard errors.
"""

from __future__ import annotations

import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np

from lamina.mitsuba import variant

# Before Dr.Jit loads a library of the system.
variant.choose("llvm_ad_rgb")

import drjit as dr
import mitsuba as mi

ROOT = Path(__file__).resolve().parents[2]
ANCHORS = ROOT / "tests" / "data" / "transport_anchors.csv"
RESULTS = ROOT / "reference" / "results" / "slabs.md"
HEADING = "## By Mitsuba's volpath"
# Optical depth that stands for infinity: tests/instruments/slabs.rs says why it is enough.
ENDLESS = 400.0
# Half the extent of planes over the thickness of a slab: light nearer to the horizon is lost.
EXTENT = 1e5
PASSES = 16


def scene(n: float, a: float, b: float, g: float) -> mi.Scene:
    """A slab from z = -b to 0, its extinction 1 per unit of length."""
    depth = min(b, ENDLESS)
    place = mi.ScalarTransform4f
    wide = place().scale([EXTENT, EXTENT, 1.0])
    downwards = place().rotate([1, 0, 0], 180)
    boundary = (
        {"type": "null"} if n == 1.0 else {"type": "dielectric", "int_ior": n, "ext_ior": 1.0}
    )
    phase = {"type": "hg", "g": g} if g != 0.0 else {"type": "isotropic"}
    medium = {"type": "homogeneous", "albedo": a, "sigma_t": 1.0, "phase": phase}

    def face(height: float, turn: mi.ScalarTransform4f) -> dict:
        to_world = place().translate([0, 0, height]) @ turn @ wide
        return {"type": "rectangle", "to_world": to_world, "bsdf": boundary, "interior": medium}

    def lamp(height: float, turn: mi.ScalarTransform4f, colour: list[float]) -> dict:
        to_world = place().translate([0, 0, height]) @ turn @ wide
        radiance = {"type": "rgb", "value": colour}
        black = {"type": "diffuse", "reflectance": 0.0}
        emitter = {"type": "area", "radiance": radiance}
        return {"type": "rectangle", "to_world": to_world, "bsdf": black, "emitter": emitter}

    return mi.load_dict(
        {
            "type": "scene",
            "top": face(0.0, place()),
            "bottom": face(-depth, downwards),
            "above": lamp(1.0, downwards, [1.0, 0.0, 0.0]),
            "below": lamp(-depth - 1.0, place(), [0.0, 1.0, 0.0]),
        }
    )


def shares(
    slab: mi.Scene, diffuse: bool, rays: int, first_seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """R and T with their standard errors."""
    integrator = mi.load_dict({"type": "volpath", "max_depth": -1, "rr_depth": 64})
    found = []
    for seed in range(PASSES):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(first_seed + seed, rays)
        if diffuse:
            down = -mi.warp.square_to_cosine_hemisphere(sampler.next_2d())
        else:
            down = mi.Vector3f(0.0, 0.0, -1.0)
        ray = mi.RayDifferential3f(mi.Ray3f(mi.Point3f(0.0, 0.0, 0.5), down))
        radiance, _, _ = integrator.sample(slab, sampler, ray)
        found.append([float(dr.mean(radiance[0])[0]), float(dr.mean(radiance[1])[0])])
    means = np.array(found)
    return means.mean(axis=0), means.std(axis=0, ddof=1) / math.sqrt(PASSES)


def report(rays: int) -> tuple[str, list[str]]:
    """The table, and what is too far off."""
    lines = ANCHORS.read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    heads = ["n", "a", "b", "g", "share", "anchor", "Mitsuba", "standard error", "z"]
    shown, faults, greatest, errors, seed = [], [], 0.0, 0.0, 1
    for row in rows:
        if row["kind"] == "canopy":
            continue
        n, a, b, g = (float(row[key] or 0.0) for key in ("n", "a", "b", "g"))
        slab = scene(n, a, b, g)
        for diffuse, names in ((False, ("R1", "T1")), (True, ("Rd", "Td"))):
            if not row[names[0]]:
                continue
            found = shares(slab, diffuse, rays, seed)
            seed += PASSES
            for name, share, error in zip(names, *found, strict=True):
                anchor = float(row[name])
                z = (share - anchor) / error if error > 0.0 else 0.0
                cells = [row["n"], row["a"], row["b"], f"{g:g}", name, f"{anchor:.6f}"]
                cells += [f"{share:.6f}", f"{error:.1e}", f"{z:+.2f}"]
                shown.append("| " + " | ".join(cells) + " |")
                print(shown[-1], file=sys.stderr, flush=True)
                greatest, errors = max(greatest, abs(z)), max(errors, error)
                if abs(z) >= 4.0:
                    faults.append(shown[-1])
    out = [HEADING, "", f"Mitsuba {mi.__version__}, {PASSES} passes of {rays} rays.", ""]
    out += ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads), *shown, ""]
    out += [f"Greatest |z|: {greatest:.2f}; greatest standard error: {errors:.1e}."]
    return "\n".join(out) + "\n", faults


def main() -> int:
    """Prints the table, or writes it."""
    parser = argparse.ArgumentParser(prog="reference/run slabs-mitsuba", description=__doc__)
    parser.add_argument("--record", action="store_true", help="write to reference/results")
    parser.add_argument("--rays", type=int, default=1 << 16, help="rays of each of the passes")
    arguments = parser.parse_args()
    text, faults = report(arguments.rays)
    if arguments.record:
        before = RESULTS.read_text(encoding="utf-8").split(HEADING)[0].rstrip()
        RESULTS.write_text(f"{before}\n\n{text}", encoding="utf-8")
    print(text)
    for fault in faults:
        print(f"too far off: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
