"""PROSPECT-PRO, -5 and -4 by another program: `reference/run models`.

progeosail 2.1.0 computes R and T of leaves by chance and writes them to
`tests/data/prospect_models_reference.csv`, to which `tests/optics.rs` holds the program. It has
tables of its own for PROSPECT-PRO and PROSPECT-5; that of PROSPECT-5 is rounded to single
precision. PROSPECT-4 is not in it: there it computes with the columns of `prospect_others.csv`.

progeosail is not in the environment: `pip install progeosail==2.1.0` brings it.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "leafmodel" / "optics" / "src" / "prospect_others.csv"
RESULT = ROOT / "tests" / "data" / "prospect_models_reference.csv"
LEAVES = 12
STEP_NM = 75
CONTENTS = ("n", "cab", "car", "ant", "brown", "cw", "cm", "proteins", "cbc")
LOW = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.001, 0.0, 0.0005)
HIGH = (3.0, 90.0, 25.0, 15.0, 1.0, 0.04, 0.02, 0.003, 0.015)
INPUTS = {
    "prospect-pro": ("n", "cab", "car", "ant", "brown", "cw", "proteins", "cbc"),
    "prospect-5": ("n", "cab", "car", "brown", "cw", "cm"),
    "prospect-4": ("n", "cab", "cw", "cm"),
}

Array = NDArray[np.float64]


def spectra(model: str, leaf: dict[str, float], columns: dict[str, Array]) -> list[Array]:
    """R and T at each whole nanometre from 400 to 2500."""
    from progeosail.prospect_d import run_prospect  # type: ignore[import-not-found]

    own = {}
    if model == "prospect-4":
        own = {
            "nr": columns["refractive_index_4_5"],
            "kab": columns["k_cab_4_cm2_per_ug"],
            "km": columns["k_m_4_5_cm2_per_g"],
        }
    version = "PRO" if model == "prospect-pro" else "5"
    order = ("n", "cab", "car", "brown", "cw", "cm")
    _, r, t = run_prospect(
        *(leaf[name] for name in order),
        ant=leaf["ant"],
        prot=leaf["proteins"],
        cbc=leaf["cbc"],
        prospect_version=version,
        **own,
    )
    return [r, t]


def main() -> None:
    """Writes the table."""
    argparse.ArgumentParser(prog="reference/run models", description=__doc__).parse_args()
    with TABLE.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    chance = np.random.default_rng(65)
    with RESULT.open("w", encoding="utf-8", newline="") as file:
        file.write(
            "# R and T of leaves by chance, computed by progeosail 2.1.0 (reference/run models).\n"
        )
        out = csv.writer(file, lineterminator="\n")
        out.writerow(("model", *CONTENTS, "wavelength_nm", "R", "T"))
        for model, inputs in INPUTS.items():
            for _ in range(LEAVES):
                drawn = dict(zip(CONTENTS, chance.uniform(LOW, HIGH), strict=True))
                leaf = {name: float(f"{drawn[name]:.4g}") for name in inputs}
                leaf = dict.fromkeys(CONTENTS, 0.0) | leaf
                r, t = spectra(model, leaf, columns)
                for at in range(0, 2101, STEP_NM):
                    values = (f"{share[at]:.12g}" for share in (r, t))
                    out.writerow((model, *leaf.values(), 400 + at, *values))
    print(RESULT.relative_to(ROOT))


if __name__ == "__main__":
    main()
