"""Colours of leaves, twice: `reference/run colours`.

For each preset of `lamina optics` the program gives R and T (CSV) and their colours under D65
(JSON). Here the same colours come from colour-science, once from the program's own R and T and
once from those of `prospect.py`, which shares nothing with the program but the published table.
The ΔE2000 between the program's colour and either must stay below `MOST`.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from lamina.mitsuba import variant
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
# Largest ΔE2000 between the program's colour of R or T and colour-science's.
MOST = 0.5
# sRGB of R and T worked out before the program existed, with another program for PROSPECT-D.
# Brown litter was a range of contents there, of which the colour stands for one.
EARLIER = {
    "sun-green": ("485f33", "3c5600"),
    "shade-thin": ("496233", "546f00"),
    "dark-evergreen": ("405635", "183100"),
    "young-red-flush": ("684439", "733d15"),
    "chlorotic": ("969846", "9a993a"),
    "golden": ("c29930", "c39602"),
    "white-sector": ("9cab8d", "b6c0a1"),
    "cream-sector": ("b3b888", "a2a36e"),
    "birch-yellow": ("a4803d", "a88029"),
    "oak-yellow-brown": ("9b7f3a", "b09036"),
    "ginkgo-yellow": ("c59528", "be8a00"),
    "poplar-yellow": ("b59339", "b38d19"),
    "sugar-maple-orange": ("a56e38", "a36610"),
    "red-maple-scarlet": ("8b4a3d", "833415"),
    "sweetgum-purple-red": ("6b3a39", "611301"),
    "smoke-tree-purple": ("483a39", "371200"),
    "croton-red": ("6c4139", "4c1500"),
    "croton-yellow": ("c0992a", "a47b00"),
    "brown-litter": ("9a8362", "82673f"),
}


@dataclass
class Row:
    """One preset's R or T."""

    preset: str
    of: str
    lamina: str
    colour_science: str
    earlier: str
    # ΔE2000 of the program's colour against colour-science's: of its own spectrum, of Python's.
    delta_e_same_spectrum: float
    delta_e_own_spectrum: float
    # Against the earlier colour, which is known to 8 bits only.
    delta_e_earlier: float
    # Largest difference between the two spectra, 400 to 2500 nm.
    spectra_differ_by: float

    @property
    def worst(self) -> float:
        """The ΔE2000 that decides."""
        return max(self.delta_e_same_spectrum, self.delta_e_own_spectrum)


def lamina(binary: Path, *words: object) -> str:
    """What the program prints to stdout; its own report is in the error if it fails."""
    if not binary.is_file():
        raise RuntimeError(f"{binary} is missing: run cargo build --release")
    done = subprocess.run(
        [str(binary), "optics", *(str(word) for word in words)],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise RuntimeError(f"lamina optics failed ({done.returncode}):\n{done.stderr}")
    return done.stdout


def rows(binary: Path) -> list[Row]:
    """R and T of every preset."""
    # Both need Mitsuba's variant to be chosen.
    import drjit as dr
    import mitsuba as mi

    from lamina.mitsuba import prospect
    from validation import colour

    kind = dr.float64_array_t(mi.Float)
    table = ROOT / "leafmodel" / "optics" / "src" / "prospect_d.csv"
    model = prospect.Prospect(table, kind, False)
    names = [line.split()[0] for line in lamina(binary, "--list").splitlines()]
    result = []
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            csv, file = Path(folder) / "leaf.csv", Path(folder) / "colour.json"
            lamina(binary, "--preset", name, "--out", csv, "--colour", file)
            data = json.loads(file.read_text(encoding="utf-8"))
            colours = data["colours"]
            nm, *ours = np.loadtxt(csv, delimiter=",", skiprows=3).T
            contents = data["contents"]
            assert all(contents[absorber] == 0.0 for absorber in prospect.OPTIONAL), name
            own = [np.array(part).ravel() for part in model.spectra(kind(nm), contents)]
            for of, spectrum, other, earlier in zip("RT", ours, own, EARLIER[name], strict=True):
                xyz = np.array(colours[of]["xyz"])
                same = colour.xyz_under_d65(nm, spectrum)
                theirs = colour.xyz_under_d65(nm, other)
                hex_colour = colour.hex_of(theirs)
                result.append(
                    Row(
                        name,
                        of,
                        colours[of]["hex"],
                        hex_colour,
                        f"#{earlier}",
                        colour.delta_e_of_xyz(xyz, same),
                        colour.delta_e_of_xyz(xyz, theirs),
                        colour.delta_e_of_hex(colours[of]["hex"], f"#{earlier}"),
                        float(np.abs(spectrum - other).max()),
                    )
                )
    assert {row.preset for row in result} == set(EARLIER), "a preset without an earlier colour"
    return result


def markdown(result: list[Row]) -> str:
    """The table that is recorded."""
    worst = max(row.worst for row in result)
    lines = [
        "## Colours of the presets",
        "",
        "sRGB under D65 of R and T of each preset. Largest ΔE2000 between Lamina and "
        f"colour-science: {worst:.4f} "
        f"(allowed: below {MOST}).",
        "",
        "*Same*: colour-science on Lamina's spectrum. *Own*: colour-science on the spectrum of "
        "the PROSPECT-D in Python. "
        "*Earlier*: colours worked out before there was a program, known to 8 bits; shown, not "
        "tested.",
        "",
        "| preset | of | Lamina | colour-science | earlier | ΔE2000 same | ΔE2000 own | ΔE2000 "
        "earlier | "
        "spectra differ by |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in result:
        lines.append(
            f"| {row.preset} | {row.of} | {row.lamina} | {row.colour_science} | {row.earlier} | "
            f"{row.delta_e_same_spectrum:.4f} | {row.delta_e_own_spectrum:.4f} | "
            f"{row.delta_e_earlier:.2f} | {row.spectra_differ_by:.1e} |"
        )
    return "\n".join(lines)


def swatches(result: list[Row], file: Path) -> None:
    """A row a preset: R and T by Lamina, and each beside it by colour-science."""
    from validation import colour, compare

    pair = [
        np.stack([colour.srgb_of_hex(row.lamina), colour.srgb_of_hex(row.colour_science)])
        for row in result
    ]
    pixels = np.concatenate([np.stack(pair[0::2]), np.stack(pair[1::2])], axis=1)
    compare.write_png(file, np.kron(pixels, np.ones((20, 60, 1))))


def main() -> int:
    """Compares, prints the table and says with its exit code whether all agree."""
    parser = argparse.ArgumentParser(prog="reference/run colours", description=__doc__)
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument("--results", type=Path, default=ROOT / "out" / "reference")
    parser.add_argument(
        "--record", action="store_true", help="write to reference/results, which is committed"
    )
    options = parser.parse_args()
    variant.choose()
    result = rows(options.lamina)
    folder = ROOT / "reference" / "results" if options.record else options.results
    folder.mkdir(parents=True, exist_ok=True)
    text = markdown(result)
    (folder / "colours.md").write_text(text + "\n", encoding="utf-8")
    data = {"largest_allowed": MOST, "rows": [asdict(row) for row in result]}
    (folder / "colours.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    swatches(result, folder / "colours.png")
    print(text)
    bad = [f"{row.preset} {row.of}: {row.worst:.3f}" for row in result if not row.worst < MOST]
    print("\n".join(["differ:", *bad]) if bad else "all agree", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
