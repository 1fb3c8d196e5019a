"""Fits to measured leaves with each version of PROSPECT: `reference/run measured-leaves`.

`--noda FOLDER` holds the files `*_leaf_*.csv` of Noda et al. (2014), one leaf each: wavelength,
adaxial R, adaxial T, abaxial R, abaxial T. They are in the folder `data-raw/JaLTER/ERDP-2013-02` of
a clone of aphalo/photobiologyPlants. Their terms allow use that is not for profit, so that they are
not in this repository.

`--database FOLDER`, any number of times, holds leaves with known contents in the form of the
authors of PROSPECT: `DataBioch.txt`, `ReflectanceData.txt` and `TransmittanceData.txt`, as at
https://gitlab.com/jbferet/myshareddata in `LOP/ANGERS`, `LOP/LOPEX_FRESH_VAL` and others.

`--clip FILE` is a table of leaves whose reflectance a clip measured, and whose chlorophyll was
extracted: the data frame of `data/chl-raw.RData` in ashiklom/prospect_bayes, written as CSV. No
licence is named there, so that it is not in this repository either.

Each leaf is fitted by `lamina fit` with what was measured, R and T or R alone, from 400 to 2500 nm.
The table has the root mean square and the mean of what the fit exceeds the measurement by: of R and
T by range of wavelengths, and of contents where they are known.
"""

from __future__ import annotations

import argparse
import csv
import math
import subprocess
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "reference" / "results" / "measured-leaves.md"
MODELS = ("prospect-4", "prospect-5", "prospect-d", "prospect-pro")
RANGES = ((400, 700), (700, 1300), (1300, 2500))
# Needles fill the sphere's port only in part.
NEEDLES = ("Picea", "Pinus", "Larix", "Cryptomeria", "Chamaecyparis", "Cunninghamia")
PARTS = ("proteins_g_per_cm2", "carbon_based_g_per_cm2")
# Content, its keys in the program's tables, whose values add up, unit, and factor for the table.
CONTENTS = {
    "CHL": (("chlorophyll_ug_per_cm2",), "µg/cm²", 1.0),
    "CAR": (("carotenoids_ug_per_cm2",), "µg/cm²", 1.0),
    "ANT": (("anthocyanins_ug_per_cm2",), "µg/cm²", 1.0),
    "EWT": (("water_cm",), "mg/cm²", 1e3),
    # A model has the whole or its parts.
    "LMA": (("dry_matter_g_per_cm2", *PARTS), "mg/cm²", 1e3),
    "PROT": (PARTS[:1], "mg/cm²", 1e3),
    "CBC": (PARTS[1:], "mg/cm²", 1e3),
}

Spectrum = dict[float, float]


@dataclass
class Leaf:
    """A measured leaf: R and T by wavelength in nm, and what it is known to hold."""

    name: str
    reflectance: Spectrum
    transmittance: Spectrum
    contents: dict[str, float] = field(default_factory=dict)


def of_noda(folder: Path) -> list[Leaf]:
    """Broad leaves; values outside of 0 to 1 are masked."""
    leaves = []
    for file in sorted(folder.glob("*_leaf_*.csv")):
        if file.name.startswith(NEEDLES):
            continue
        leaf = Leaf(file.stem, {}, {})
        for line in file.read_text(encoding="latin-1").splitlines():
            if line[:1].isdigit():
                nm, r, t, *_ = map(float, line.split(","))
                if 400 <= nm <= 2500 and 0 < r < 1 and 0 < t < 1:
                    leaf.reflectance[nm], leaf.transmittance[nm] = r, t
        leaves.append(leaf)
    return leaves


def of_database(folder: Path) -> list[Leaf]:
    """Leaves with known contents, in the form of PROSPECT's authors."""

    def table(name: str) -> list[dict[str, str]]:
        with (folder / name).open(encoding="utf-8-sig", newline="") as file:
            head = file.readline()
            separator = next((one for one in "\t;," if one in head), None)
            names = [name.strip('" ') for name in head.strip().split(separator)]
            rows = (line.strip().split(separator) for line in file if line.strip())
            return [dict(zip(names, row, strict=True)) for row in rows]

    reflectance, transmittance = table("ReflectanceData.txt"), table("TransmittanceData.txt")
    held = table("DataBioch.txt")
    wavelength, *names = reflectance[0]
    if len(held) != len(names):
        raise SystemExit(f"{folder}: {len(held)} leaves have contents, {len(names)} have spectra")
    leaves = []
    for name, contents in zip(names, held, strict=True):
        r, t = (
            {float(row[wavelength]): float(row[name]) for row in rows}
            for rows in (reflectance, transmittance)
        )
        known = {key.upper(): value for key, value in contents.items()}
        numbers = {key: float(known[key]) for key in CONTENTS if known.get(key, "NA") != "NA"}
        there = {key: value for key, value in numbers.items() if value >= 0}
        leaves.append(Leaf(f"{folder.name}_{name}", r, t, there))
    return leaves


def of_clip(file: Path) -> list[Leaf]:
    """Leaves with R alone, whose chlorophyll (a and b) and dry matter are known in g/m²."""
    leaves = []
    with file.open(encoding="utf-8", newline="") as text:
        for row in csv.DictReader(text):
            by_nm = {
                float(name.removeprefix("Wave_")): float(value)
                for name, value in row.items()
                if name.startswith("Wave_")
            }
            leaf = Leaf(row["Spectra"], {nm: r for nm, r in by_nm.items() if nm >= 400}, {})
            leaf.contents["CHL"] = 100 * (float(row["Chl_a_g_m2"]) + float(row["Chl_b_g_m2"]))
            leaf.contents["LMA"] = 1e-4 * float(row["LMA_gDW_m2"])
            leaves.append(leaf)
    return leaves


@dataclass
class Errors:
    """Root mean square and mean of differences."""

    count: int = 0
    total: float = 0.0
    squares: float = 0.0

    def add(self, difference: float) -> None:
        """Counts one more."""
        self.count += 1
        self.total += difference
        self.squares += difference * difference

    def text(self, digits: int) -> str:
        """As a cell of a table."""
        if self.count == 0:
            return "–"
        rms, mean = math.sqrt(self.squares / self.count), self.total / self.count
        return f"{rms:.{digits}f} ({mean:+.{digits}f})"


def quantities(leaves: list[Leaf]) -> str:
    """What was measured of each: R and T, or R alone."""
    return "RT" if all(leaf.transmittance for leaf in leaves) else "R"


def fitted(
    leaves: list[Leaf], model: str, lamina: Path, folder: Path
) -> tuple[list[dict[str, str]], list[dict[str, str]]]:
    """Rows of contents, and rows of measured and fitted spectra."""
    spectra, contents, found = (folder / name for name in ("in.csv", "contents.csv", "out.csv"))
    with spectra.open("w", encoding="utf-8", newline="") as file:
        out = csv.writer(file)
        out.writerow(("leaf", "wavelength_nm", *quantities(leaves)))
        for leaf in leaves:
            for nm, r in leaf.reflectance.items():
                t = [leaf.transmittance[nm]] if leaf.transmittance else []
                out.writerow((leaf.name, nm, r, *t))
    outputs = ("--out", contents, "--spectra-out", found)
    subprocess.run(
        [lamina, "fit", spectra, "--model", model, *outputs], check=True, capture_output=True
    )
    tables = []
    for path in (contents, found):
        with path.open(encoding="utf-8", newline="") as text:
            tables.append(list(csv.DictReader(line for line in text if not line.startswith("#"))))
    return tables[0], tables[1]


def sections(name: str, leaves: list[Leaf], lamina: Path) -> Iterable[str]:
    """The tables of a set of leaves."""
    of_spectra: list[str] = []
    of_contents: list[str] = []
    there = [key for key in CONTENTS if any(key in leaf.contents for leaf in leaves)]
    measured = quantities(leaves)
    for model in MODELS:
        with tempfile.TemporaryDirectory() as folder:
            contents, spectra = fitted(leaves, model, lamina, Path(folder))
        errors = {(quantity, low): Errors() for quantity in measured for low, _ in RANGES}
        for row in spectra:
            nm = float(row["wavelength_nm"])
            low = max(low for low, _ in RANGES if low <= nm)
            for quantity in measured:
                difference = float(row[f"{quantity}_fitted"]) - float(row[quantity])
                errors[quantity, low].add(difference)
        cells = [errors[quantity, low].text(4) for quantity in measured for low, _ in RANGES]
        of_spectra.append(f"| {model} | " + " | ".join(cells) + " |")
        cells = []
        for key in there:
            columns, _, factor = CONTENTS[key]
            error = Errors()
            for leaf, row in zip(leaves, contents, strict=True):
                found = [float(row[column]) for column in columns if row.get(column)]
                if key in leaf.contents and found:
                    error.add(factor * (sum(found) - leaf.contents[key]))
            cells.append(error.text(2))
        of_contents.append(f"| {model} | " + " | ".join(cells) + " |")
    heads = [f"{quantity} {low}–{high}" for quantity in measured for low, high in RANGES]
    yield f"## {name}: {len(leaves)} leaves\n"
    yield "| model | " + " | ".join(heads) + " |\n|" + " --- |" * (len(heads) + 1)
    yield "\n".join(of_spectra) + "\n"
    if there:
        heads = [f"{key}, {CONTENTS[key][1]}" for key in there]
        yield "| model | " + " | ".join(heads) + " |\n|" + " --- |" * (len(heads) + 1)
        yield "\n".join(of_contents) + "\n"


def main() -> None:
    """Writes the tables."""
    parser = argparse.ArgumentParser(prog="reference/run measured-leaves", description=__doc__)
    parser.add_argument("--noda", type=Path, help="folder of the files of Noda et al.")
    parser.add_argument("--database", type=Path, action="append", default=[], help="see above")
    parser.add_argument("--clip", type=Path, help="a table of leaves with R alone, see above")
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument("--out", type=Path, default=RESULTS)
    given = parser.parse_args()
    sets = [(folder.name, of_database(folder)) for folder in given.database]
    if given.noda:
        sets.insert(0, ("Noda et al.", of_noda(given.noda)))
    if given.clip:
        sets.append(("Shiklomanov et al.", of_clip(given.clip)))
    if not sets:
        parser.error("name leaves by --noda, --database or --clip")
    text = [
        "<!-- Written by reference/run measured-leaves. -->\n",
        "Root mean square of fit less measurement, and in brackets its mean.\n",
    ]
    for name, leaves in sets:
        text += sections(name, leaves, given.lamina)
    given.out.write_text("\n".join(text), encoding="utf-8")
    print(given.out)


if __name__ == "__main__":
    main()
