"""What guessed constants of leaf optics are worth: `reference/run constants`.

Each constant that was recalled, estimated or assumed has a range that is as likely. R and T of a
leaf that holds enough of what it acts on are computed by `lamina optics` with the ends of the range
and with the value in use. The table has the greatest change of R and T from 400 to 2500 nm, and
where it is.

A constant of a pigment's spectrum changes the absorption alone: the pigment is in the leaf as a
table of specific absorption (`--extra-absorption`), made from `pigments.py`. A constant that
multiplies contents changes the contents.
"""

from __future__ import annotations

import argparse
import csv
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.pigments import BETALAINS, CAROTENOIDS, bands, in_solution
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "reference" / "results" / "constants.md"
NM = np.arange(400.0, 2501.0)

Array = NDArray[np.float64]
Leaf = dict[str, float]

GREEN: Leaf = {"n": 1.5, "cab": 40, "car": 8, "ant": 0, "brown": 0, "cw": 0.01, "cm": 0.006}
DEAD: Leaf = {"n": 2.2, "cab": 0.3, "car": 1, "ant": 0, "brown": 1.1, "cw": 0.001, "cm": 0.0045}
AUTUMN: Leaf = {
    "n": 1.65,
    "cab": 1.5,
    "car": 5,
    "ant": 0,
    "brown": 0.12,
    "cw": 0.0085,
    "cm": 0.0054,
}
# Holds nothing that the pigments under trial absorb as well.
BARE: Leaf = GREEN | {"cab": 5, "car": 0}


@dataclass(frozen=True)
class Trial:
    """A constant: its value and range, and leaves that have what follows from each."""

    name: str
    unit: str
    values: tuple[float, float, float]
    leaf: Leaf
    what: str
    # Absorption in cm²/µg of 10 µg/cm², where it is not contents that change.
    absorptions: tuple[Array, ...] = ()
    contents: tuple[Leaf, ...] = ()


def carotenoid(epsilon: float, shift: float, packaging: float) -> Array:
    """Lutein's specific absorption with another peak, shift and packaging."""
    _, molar_mass, fitted, gaussians = CAROTENOIDS["lutein"]
    found = bands((epsilon, molar_mass, fitted, gaussians), NM, shift, packaging)
    return np.nan_to_num(found)


def betalain(name: str, epsilon: float, below: float, above: float, packaging: float) -> Array:
    """A betalain's specific absorption with another peak, widths and packaging."""
    peak, _, molar_mass, _, _ = BETALAINS[name]
    z = (NM - peak) / np.where(NM < peak, below, above)
    return packaging * in_solution(epsilon, molar_mass) * np.exp(-0.5 * z * z)


def of_spectra() -> Iterator[Trial]:
    """Constants of pigments."""
    lutein = CAROTENOIDS["lutein"][0]
    _, epsilon, _, below, above = BETALAINS["betanin"]
    _, epsilon_x, _, width, _ = BETALAINS["indicaxanthin"]
    per_mole = "L/(mol cm)"
    tried: tuple[tuple[str, str, tuple[float, float, float], Callable[[float], Array]], ...] = (
        (
            "carotenoids, molar absorptivity (lutein)",
            per_mole,
            (0.9 * lutein, lutein, 1.1 * lutein),
            lambda value: carotenoid(value, -950.0, 0.29),
        ),
        (
            "carotenoids, shift",
            "1/cm",
            (-1400.0, -950.0, -900.0),
            lambda value: carotenoid(lutein, value, 0.29),
        ),
        (
            "carotenoids, packaging",
            "",
            (0.24, 0.29, 0.34),
            lambda value: carotenoid(lutein, -950.0, value),
        ),
        (
            "betalains, packaging (betanin)",
            "",
            (0.4, 0.5, 0.55),
            lambda value: betalain("betanin", epsilon, below, above, value),
        ),
        (
            "betanin, molar absorptivity",
            per_mole,
            (60000.0, 62500.0, 65000.0),
            lambda value: betalain("betanin", value, below, above, 0.5),
        ),
        (
            "betanin, deviation towards the blue",
            "nm",
            (35.0, 41.0, 47.0),
            lambda value: betalain("betanin", epsilon, value, above, 0.5),
        ),
        (
            "betanin, deviation towards the red",
            "nm",
            (24.0, 28.0, 32.0),
            lambda value: betalain("betanin", epsilon, below, value, 0.5),
        ),
        (
            "betaxanthins, molar absorptivity",
            per_mole,
            (43000.0, 48000.0, 53000.0),
            lambda value: betalain("indicaxanthin", value, width, width, 0.5),
        ),
        (
            "betaxanthins, deviation",
            "nm",
            (27.0, 32.0, 37.0),
            lambda value: betalain("indicaxanthin", epsilon_x, value, value, 0.5),
        ),
    )
    for name, unit, values, made in tried:
        absorptions = tuple(made(value) for value in values)
        yield Trial(name, unit, values, BARE, "10 µg/cm² of it", absorptions)


# Name, words for the leaf, leaf, content, what the numbers are factors on, and the numbers.
VEIN = GREEN | {"n": 1.95, "cab": 4, "car": 0.96, "cw": 0.02, "cm": 0.015}
OVER_A_VEIN = "tissue over a thick vein"
IN_AUTUMN = "a leaf in yellow autumn"
DRY = "a dead, dry leaf"
OF_CONTENTS: tuple[tuple[str, str, Leaf, str, float, tuple[float, float, float]], ...] = (
    ("veins, factor on structure", OVER_A_VEIN, VEIN, "n", 1.5, (1.1, 1.3, 1.5)),
    ("veins, factor on chlorophyll", OVER_A_VEIN, VEIN, "cab", 40.0, (0.05, 0.1, 0.4)),
    ("veins, factor on carotenoids", OVER_A_VEIN, VEIN, "car", 8.0, (0.05, 0.12, 0.4)),
    ("veins, factor on water", OVER_A_VEIN, VEIN, "cw", 0.01, (1.2, 2.0, 3.0)),
    ("veins, factor on dry matter", OVER_A_VEIN, VEIN, "cm", 0.006, (1.5, 2.5, 4.0)),
    ("ageing, factor on structure", IN_AUTUMN, AUTUMN, "n", 1.5, (1.0, 1.1, 1.3)),
    ("ageing, factor on water", IN_AUTUMN, AUTUMN, "cw", 0.01, (0.6, 0.85, 1.0)),
    ("ageing, factor on dry matter", IN_AUTUMN, AUTUMN, "cm", 0.006, (0.7, 0.9, 1.0)),
    ("ageing, brown of living tissue", IN_AUTUMN, AUTUMN, "brown", 1.0, (0.0, 0.12, 0.37)),
    ("ageing, chlorophyll that stays, µg/cm²", IN_AUTUMN, AUTUMN, "cab", 1.0, (0.5, 1.5, 3.0)),
    ("dead tissue, structure", DRY, DEAD, "n", 1.0, (1.8, 2.2, 2.6)),
    ("dead tissue, brown", DRY, DEAD, "brown", 1.0, (0.8, 1.1, 1.5)),
    ("dead tissue, carotenoids, µg/cm²", DRY, DEAD, "car", 1.0, (0.0, 1.0, 1.5)),
    ("dead tissue, water, cm", DRY, DEAD, "cw", 1.0, (0.0005, 0.001, 0.002)),
)


def of_contents() -> Iterator[Trial]:
    """Constants that multiply or replace contents."""
    for name, what, leaf, key, times, values in OF_CONTENTS:
        leaves = tuple(leaf | {key: times * value} for value in values)
        yield Trial(name, "", values, leaf, what, contents=leaves)


def spectra(lamina: Path, leaf: Leaf, absorption: Array | None) -> Array:
    """R and T, `[2, wavelength]`."""
    arguments = ["--" + key + f"={value}" for key, value in leaf.items()]
    with tempfile.TemporaryDirectory() as folder:
        if absorption is not None:
            table = Path(folder, "extra.csv")
            rows = (f"{nm:.0f},{value:.9g}" for nm, value in zip(NM, absorption, strict=True))
            head = "wavelength_nm,absorption_cm2_per_ug\n"
            table.write_text(head + "\n".join(rows), encoding="utf-8")
            arguments += ["--extra-absorption", str(table), "--extra", "10"]
        command: list[str | Path] = [lamina, "optics", *arguments, "--out", "-"]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    found = [[float(row["R"]), float(row["T"])] for row in csv.DictReader(lines)]
    return np.array(found).T


def row(lamina: Path, trial: Trial) -> str:
    """A row of the table."""
    leaves = trial.contents or (trial.leaf,) * 3
    absorptions: tuple[Array | None, ...] = trial.absorptions or (None,) * 3
    pairs = zip(leaves, absorptions, strict=True)
    low, used, high = (spectra(lamina, leaf, absorption) for leaf, absorption in pairs)
    change = np.maximum(np.abs(low - used), np.abs(high - used))
    cells = []
    for share in change:
        at = int(np.argmax(share))
        cells.append(f"{share[at]:.3f} at {NM[at]:.0f}")
    least, value, most = (f"{value:g}" for value in trial.values)
    name = trial.name + (f", {trial.unit}" if trial.unit else "")
    return f"| {name} | {value} | {least} to {most} | {trial.what} | {cells[0]} | {cells[1]} |"


def main() -> None:
    """Writes the table."""
    parser = argparse.ArgumentParser(prog="reference/run constants", description=__doc__)
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument("--out", type=Path, default=RESULTS)
    given = parser.parse_args()
    text = [
        "| constant | value | as likely | leaf | change of R, nm | change of T, nm |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    text += [row(given.lamina, trial) for trial in (*of_spectra(), *of_contents())]
    given.out.write_text("\n".join(text) + "\n", encoding="utf-8")
    print(given.out)


if __name__ == "__main__":
    main()
