"""RAMI's canopies as tables ready to hand in: `reference/run rami`.

`lamina instruments` measures each case several times with other places of the leaves and other
rays. Files are those of RAMI: `brfpp` and `brfop` hold BRFs in the principal and the orthogonal
plane, `brf1` the albedo, `fabs` and `ftran` the shares in percent that the leaves absorb and that
arrive at the soil. Each row of a BRF is zenith angle of the sun, zenith and azimuth angle of the
view (radians; negative zenith angles of the plane, on the side of the sun, have azimuth 0), BRF,
and -1 where RAMI has its error; a comment cannot stand in such a file, so errors are in the table
of the page.

With `--beside FILE.csv`, whose rows are view angles in degrees and BRFs, HET01 in the near infrared
with the sun at 20 degrees is compared to what another program found, such as the reference of
Eradiate's regression test `het01_brfpp` (repository eradiate-data, which states no licence, so that
it is not here). The exit status is 1 if the two differ by more than they may.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes" / "rami"
RESULTS = ROOT / "reference" / "results" / "rami.md"
PLACE = "-1.000000"
# Both have noise of about 1 % an angle (8192 rays of two sets of leaves here, 10,000 samples a
# direction there), and other leaves: at any angle and in the mean over angles they may differ by
# this.
MOST_OFF = 0.04
MEAN_OFF = 0.015


@dataclass(frozen=True)
class Case:
    """A structure of RAMI, a scene with overrides, and the bands by wavelength."""

    name: str
    scene: str
    overrides: tuple[str, ...]
    bands: tuple[tuple[str, float], ...]
    suns: tuple[int, ...]


SOLAR = (("RED", 650.0), ("NIR", 860.0))
PURE = (("NR1", 860.0),)
CASES = (
    Case("HOM01_TUR_PLA", "hom01.toml", (), PURE, (0, 30, 60)),
    Case(
        "HOM01_TUR_ERE",
        "hom01.toml",
        ("objects.leaves.volume.inclination=erectophile",),
        PURE,
        (0, 30, 60),
    ),
    Case("HOM03_DIS_ERE", "hom03.toml", (), SOLAR, (20, 50)),
    Case("HET01_DIS_UNI", "het01.toml", (), SOLAR, (20, 50)),
)


@dataclass(frozen=True)
class Figure:
    """A mean over sets of leaves, and its standard error."""

    value: float
    error: float


# Quantity, sun in degrees, wavelength, zenith and azimuth of the view, or nothing.
Key = tuple[str, float, float, float | None, float | None]
Figures = dict[Key, Figure]


def measure(lamina: Path, case: Case, seeds: int, rays: int) -> Figures:
    """Measure a case with leaves and rays of several seeds."""
    values: dict[Key, list[float]] = {}
    for seed in range(1, seeds + 1):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "figures.json"
            words = [str(lamina), "instruments", str(SCENES / case.scene), "--out", str(out)]
            words += ["--rays", str(rays), "--seed", str(seed)]
            for override in (*case.overrides, f"objects.leaves.volume.seed={seed}"):
                words += ["-D", override]
            subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
            found = json.loads(out.read_text(encoding="utf-8"))
        for row in found["figures"]:
            key = (
                row["quantity"],
                float(row["incidence_deg"]),
                float(row["wavelength_nm"]),
                row.get("view_zenith_deg"),
                row.get("view_azimuth_deg"),
            )
            values.setdefault(key, []).append(row["value"])
    return {key: figure(found) for key, found in values.items()}


def figure(values: Sequence[float]) -> Figure:
    """Mean and standard error; no error of one value."""
    mean = statistics.fmean(values)
    if len(values) < 2:
        return Figure(mean, math.nan)
    return Figure(mean, statistics.stdev(values) / math.sqrt(len(values)))


def plane(figures: Figures, sun: float, nm: float, azimuth: float) -> list[tuple[float, Figure]]:
    """The BRFs of a plane by RAMI's zenith angles, which are negative on the sun's side."""
    rows = [
        (-zenith, found)
        for (quantity, of_sun, of_nm, zenith, of_azimuth), found in figures.items()
        if quantity == "brf"
        and (of_sun, of_nm) == (sun, nm)
        and zenith is not None
        and of_azimuth == azimuth
    ]
    return sorted(rows, key=lambda row: row[0])


def brf_file(sun: float, rows: Iterable[tuple[float, Figure]], azimuths: tuple[int, int]) -> str:
    """A file of BRFs; azimuths are those of negative and of positive zenith angles, degrees."""
    lines = []
    for zenith, found in rows:
        azimuth = azimuths[0] if zenith < 0 else azimuths[1]
        angles = (math.radians(angle) for angle in (sun, abs(zenith), azimuth))
        fields = [*(f"{angle:.6f}" for angle in angles), f"{found.value:.6f}", PLACE]
        lines.append("\t".join(fields))
    return "\n".join([f"{len(lines)}\t5\t{PLACE}", *lines]) + "\n"


def hand_in(folder: Path, case: Case, figures: Figures) -> None:
    """Write the files of a case."""
    for band, nm in case.bands:
        for sun in case.suns:
            name = f"lamina-{case.name}_{band}_{sun:02}.mes"
            one = {key[0]: found for key, found in figures.items() if key[1:3] == (sun, nm)}
            files = {
                "brfpp": brf_file(sun, plane(figures, sun, nm, 0.0), (0, 180)),
                "brfop": brf_file(sun, plane(figures, sun, nm, 90.0), (90, 270)),
                "brf1": "\t".join(
                    [f"1\t5\t{PLACE}\n{math.radians(sun):.6f}", PLACE, PLACE]
                    + [f"{one['reflected'].value:.6f}", f"{PLACE}\n"]
                ),
                "fabs": f"{100 * one['absorbed'].value:.6f}\n",
                "ftran": f"{100 * one['arriving_at_soil'].value:.6f}\n",
            }
            for measure_name, text in files.items():
                (folder / f"{measure_name}_{name}").write_text(text, encoding="utf-8")


def fluxes(case: Case, figures: Figures) -> list[str]:
    """Rows of the page's table of fluxes."""
    quantities = ("reflected", "absorbed", "arriving_at_soil", "absorbed_by_soil", "uncollided")
    rows = []
    for band, nm in case.bands:
        for sun in case.suns:
            found = [figures[(quantity, sun, nm, None, None)] for quantity in quantities]
            cells = [f"{of.value:.4f} ± {of.error:.4f}" for of in found]
            balance = found[0].value + found[1].value + found[3].value - 1.0
            head = f"{case.name}_{band}_{sun:02}"
            rows.append(f"| {head} | {' | '.join(cells)} | {balance:+.0e} |")
    return rows


def brfs(case: Case, figures: Figures, zeniths: Sequence[int]) -> list[str]:
    """Rows of the page's table of BRFs in the principal plane."""
    rows = []
    for band, nm in case.bands:
        for sun in case.suns:
            of_plane = dict(plane(figures, sun, nm, 0.0))
            cells = [f"{of_plane[zenith].value:.4f}" for zenith in zeniths]
            worst = max(found.error / found.value for found in of_plane.values())
            head = f"{case.name}_{band}_{sun:02}"
            rows.append(f"| {head} | {' | '.join(cells)} | {100 * worst:.2f} |")
    return rows


def against(file: Path, figures: Figures) -> tuple[list[str], list[float]]:
    """Rows of the comparison, and the relative differences."""
    lines = file.read_text(encoding="utf-8").splitlines()
    reference = [line.split(",") for line in lines if not line.startswith(("#", "view"))]
    of_plane = dict(plane(figures, 20, 860.0, 0.0))
    rows, differences = [], []
    for zenith, value in ((float(fields[0]), float(fields[1])) for fields in reference):
        found = of_plane[zenith]
        off = found.value / value - 1.0
        differences.append(off)
        rows.append(f"| {zenith:.0f} | {found.value:.4f} ± {found.error:.4f} | {100 * off:+.2f} |")
    return rows, differences


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, write and compare."""
    parser = argparse.ArgumentParser(prog="reference/run rami", description=__doc__)
    parser.add_argument("--lamina", type=Path, default=ROOT / "target" / "release" / "lamina")
    parser.add_argument("--out", type=Path, help="folder for the files to hand in")
    parser.add_argument("--seeds", type=int, default=4, help="sets of leaves")
    parser.add_argument("--rays", type=int, default=1 << 16, help="rays of each set")
    parser.add_argument(
        "--beside", type=Path, help="BRFs of HET01_DIS_UNI_NIR_20 by another program"
    )
    parser.add_argument("--only", help="cases whose names contain this")
    parser.add_argument("--record", action="store_true", help="write reference/results/rami.md")
    options = parser.parse_args(arguments)
    cases = [case for case in CASES if (options.only or "") in case.name]
    zeniths = [-75, -61, -51, -41, -31, -21, -11, -1, 11, 21, 31, 41, 51, 61, 75]
    tables: list[list[str]] = [[], [], []]
    differences: list[float] = []
    for case in cases:
        print(f"measuring {case.name}", file=sys.stderr)
        figures = measure(options.lamina, case, options.seeds, options.rays)
        tables[0] += fluxes(case, figures)
        tables[1] += brfs(case, figures, zeniths)
        if case.name == "HET01_DIS_UNI" and options.beside:
            tables[2], differences = against(options.beside, figures)
        if options.out:
            options.out.mkdir(parents=True, exist_ok=True)
            hand_in(options.out, case, figures)
    head = ["case", "reflected", "absorbed", "arriving at soil", "absorbed by soil", "uncollided"]
    page = [
        "# RAMI's canopies",
        "",
        f"`reference/run rami --seeds {options.seeds} --rays {options.rays} --record`. Means over "
        "sets of",
        "leaves; errors are those of the sets. Shares of the incident light; the last column is "
        "what is",
        "missing of their sum.",
        "",
        f"| {' | '.join([*head, 'balance'])} |",
        "|---" * (len(head) + 1) + "|",
        *tables[0],
        "",
        "BRF in the principal plane by RAMI's zenith angles (negative on the side of the sun), "
        "and the",
        "greatest standard error of the 76 angles, percent.",
        "",
        f"| case | {' | '.join(f'{zenith}°' for zenith in zeniths)} | error |",
        "|---" * (len(zeniths) + 2) + "|",
        *tables[1],
    ]
    if tables[2]:
        page += [
            "",
            "HET01_DIS_UNI_NIR_20, and how far it is from what another program found (`--beside`).",
            "",
            "| view, ° | Lamina | difference, % |",
            "|---|---|---|",
            *tables[2],
        ]
    text = "\n".join(page) + "\n"
    print(text)
    if options.record:
        RESULTS.write_text(text, encoding="utf-8")
    if differences:
        worst = max(abs(off) for off in differences)
        mean = statistics.fmean(differences)
        print(f"differs by up to {100 * worst:.1f} %, in the mean by {100 * mean:+.2f} %")
        return int(worst > MOST_OFF or abs(mean) > MEAN_OFF)
    return 0


if __name__ == "__main__":
    sys.exit(main())
