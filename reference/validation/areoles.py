"""Distributions of areoles on cleared leaves, summed up from a published data set.

The data set is the repository ilamatos/venation_tradeoffs (GPL-3; facts are taken from it, no
files), which holds a hierarchical loop decomposition of one cleared leaf for each of over a hundred
species: `data/HLD/*.csv`, a row per loop. Its rows of degree 1 that do not touch the border of the
scan are areoles. Of each leaf we take percentiles over its areoles; of all leaves, quartiles of
those. Leaves with fewer than 100 areoles are left out.
"""

from __future__ import annotations

import argparse
import csv
import json
import pathlib
import sys

import numpy as np

RESULTS = pathlib.Path(__file__).resolve().parent.parent / "results"
SHARES = (5, 25, 50, 75, 95)
FEWEST = 100


def percentiles(areas, elongations, circularities):
    """What is compared of one leaf, by name. Areas are over their median: scales differ."""
    areas = np.asarray(areas, float)
    told = {"sd of ln area": float(np.std(np.log(areas[areas > 0])))}
    measured = {
        "area over median": areas / np.median(areas),
        "elongation": elongations,
        "circularity": circularities,
    }
    for name, values in measured.items():
        for share, value in zip(SHARES, np.percentile(values, SHARES), strict=True):
            told[f"{name}, {share} %"] = float(value)
    return told


def read(file):
    """Areas, elongations, circularities of a leaf's areoles; empty lists if the file has none."""
    areas, elongations, circularities = [], [], []
    with file.open(encoding="latin1", newline="") as text:
        for row in csv.DictReader(text):
            if row.get("nodeDegree") != "1" or row.get("Boundary") != "0":
                continue
            try:
                values = [float(row[key]) for key in ("Area", "Elongation", "Circularity")]
            except ValueError:
                continue
            if all(np.isfinite(values)) and values[0] > 0:
                areas.append(values[0])
                elongations.append(values[1])
                circularities.append(values[2])
    return areas, elongations, circularities


def summary(folder):
    leaves = []
    for file in sorted((folder / "data/HLD").glob("*.csv")):
        areoles = read(file)
        if len(areoles[0]) >= FEWEST:
            leaves.append(percentiles(*areoles))
    if not leaves:
        sys.exit(f"areoles: no leaf with {FEWEST} areoles in {folder / 'data/HLD'}")
    quartiles = {
        name: np.percentile([leaf[name] for leaf in leaves], (25, 50, 75)).tolist()
        for name in leaves[0]
    }
    return {"leaves": len(leaves), "quartiles": quartiles}


def main():
    parser = argparse.ArgumentParser(
        prog="reference/run areoles", description=__doc__.split("\n")[0]
    )
    parser.add_argument("dataset", type=pathlib.Path, help="a clone of ilamatos/venation_tradeoffs")
    parser.add_argument(
        "--record", action="store_true", help="write reference/results/areoles.json"
    )
    arguments = parser.parse_args()
    told = summary(arguments.dataset)
    print(f"{told['leaves']} leaves")
    for name, (low, middle, high) in told["quartiles"].items():
        print(f"{name:24} {low:8.3f} {middle:8.3f} {high:8.3f}")
    if arguments.record:
        for values in told["quartiles"].values():
            values[:] = [round(value, 4) for value in values]
        (RESULTS / "areoles.json").write_text(json.dumps(told, indent=1) + "\n")


if __name__ == "__main__":
    main()
