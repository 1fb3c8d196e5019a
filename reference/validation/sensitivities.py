"""Cameras of films against colour-science: `reference/run sensitivities`.

Each camera that ships sees the training set, the chart and leaves under D65. Its matrix is fitted a
second time here, by numpy's least squares with white held, and compared with the one that the
program writes into its pictures. colour-science tells the differences of colours (CIEDE2000) to the
CIE 1931 2° observer, and fits a matrix in its own way (`matrix_idt`: least differences in CIELAB),
whose errors stand beside.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

from validation.program import program

Array = NDArray[np.float64]
ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "renderer" / "trace" / "src" / "spectrum" / "cameras"
CAMERAS = ("nikon-d5100", "canon-5d-mark-ii", "sony-a7r-iii", "sigma-sd1-merrill")
NM = np.arange(380.5, 780.0, 1.0)
SRGB = colour.RGB_COLOURSPACES["sRGB"]
# Largest difference of an entry of the two matrices: the program adds up over the same steps.
MOST_OFF = 2e-3
# Largest difference of a camera's colours and the program's in CIEDE2000, over the training set.
MOST_TOLD_OFF = 0.02
SCENE = """
format = 1
[film.rgb]
size = [1, 1]
spp = 1
sensitivities = "{camera}"
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 10
[materials.grey.diffuse]
reflectance = 0.5
[meshes.dot.sphere]
radius_m = 0.1
[objects.dot]
mesh = "dot"
material = "grey"
[lights.room.constant]
radiance_w_m2_sr_nm = 1
"""


def table(file: Path) -> Array:
    """Rows of wavelength and values."""
    return rows_of(file.read_text(encoding="utf-8"))


def rows_of(text: str) -> Array:
    """Rows of numbers of a text; lines of comments and names are left out."""
    lines = [line for line in text.splitlines() if line[:1].isdigit()]
    return np.array([[float(field) for field in line.split(",")] for line in lines])


def on_steps(rows: Array, *, outside: float | None = None) -> Array:
    """Columns of a table at `NM`, linear; `None` holds the ends."""
    columns = [
        np.interp(NM, rows[:, 0], column, left=outside, right=outside) for column in rows[:, 1:].T
    ]
    return np.array(columns).T


def outputs(binary: Path, *words: str) -> str:
    """What the program prints."""
    done = subprocess.run([str(binary), *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"lamina {' '.join(words)} failed:\n{done.stderr}")
    return done.stdout


def leaves(binary: Path) -> Array:
    """R and T of all presets at `NM`; the ends of 400 to 2500 nm are held."""
    lines = outputs(binary, "optics", "--list").splitlines()
    names = [line.split()[0] for line in lines if line.strip()]
    known = []
    for name in names:
        text = outputs(binary, "optics", "--preset", name, "--out", "-")
        rows = rows_of(text)
        known += [np.interp(NM, rows[:, 0], column) for column in rows[:, 1:3].T]
    return np.array(known).T


def told(binary: Path, folder: Path, camera: str) -> tuple[Array, float]:
    """The matrix and the mean error that the program writes into a picture."""
    scene = folder / f"{camera}.toml"
    scene.write_text(SCENE.format(camera=camera), encoding="utf-8")
    outputs(binary, "render", str(scene), "--out", str(folder / camera))
    text = outputs(binary, "info", str(folder / f"{camera}.exr"))
    words = re.search(r"lamina:observer.*\[([^\]]*)\].*training set ([0-9.]+)", text)
    if words is None:
        raise RuntimeError(f"{camera}: its picture does not tell its matrix")
    rows = [[float(number) for number in row.split()] for row in words[1].split(";")]
    return np.array(rows), float(words[2])


def fitted(seen: Array, wanted: Array) -> Array:
    """Least squares with rows whose sum is 1."""
    blue = seen[:, 2:]
    rows = []
    for channel in range(3):
        (p, q), *_ = np.linalg.lstsq(
            seen[:, :2] - blue, wanted[:, channel] - blue[:, 0], rcond=None
        )
        rows.append([p, q, 1 - p - q])
    return np.array(rows)


def main() -> int:
    """Compares, prints the table and says with its exit code whether all is as it should be."""
    parser = argparse.ArgumentParser(prog="reference/run sensitivities", description=__doc__)
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument(
        "--record", action="store_true", help="write to reference/results, which is committed"
    )
    options = parser.parse_args()
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    shape = colour.SpectralShape(380, 780, 5)
    power = colour.SDS_ILLUMINANTS["D65"]
    light = np.interp(NM, power.wavelengths, power.values)
    eye = np.array([np.interp(NM, observer.wavelengths, column) for column in observer.values.T]).T
    chart = colour.SDS_COLOURCHECKERS["BabelColor Average"]
    sets = {
        "training": on_steps(table(FOLDER / "training.csv")),
        "chart": np.array(
            [np.interp(NM, patch.wavelengths, patch.values) for patch in chart.values()]
        ).T,
        "leaves": leaves(options.lamina),
    }
    white = light @ eye / (light @ eye[:, 1])
    to_rgb = SRGB.matrix_XYZ_to_RGB

    def by_eye(share: Array) -> Array:
        rgb = (share * light[:, None]).T @ eye / (light @ eye[:, 1]) @ to_rgb.T
        return rgb / (to_rgb @ white)

    def lab(rgb: Array) -> Array:
        return colour.XYZ_to_Lab(rgb @ SRGB.matrix_RGB_to_XYZ.T, SRGB.whitepoint)

    def differences(rgb: Array, wanted: Array) -> Array:
        return np.asarray(colour.delta_E(lab(rgb), lab(wanted), method="CIE 2000"))

    counts = {name: values.shape[1] for name, values in sets.items()}
    lines = [
        "CIEDE2000 to the CIE 1931 2° observer under D65, mean and greatest: "
        f"{counts['training']} surfaces of the training set, {counts['chart']} patches of a chart "
        f"(colour-science: BabelColor Average), R and T of leaves ({counts['leaves']} spectra). "
        "In brackets the means by "
        "`matrix_idt` of colour-science.",
        "",
        "| camera | training | chart | leaves | matrix differs by |",
        "| --- | --- | --- | --- | --- |",
    ]
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        for camera in CAMERAS:
            rows = table(FOLDER / f"{camera}.csv")
            sensitivities = on_steps(rows, outside=0.0)
            balance = light @ sensitivities
            raw = {
                key: (share * light[:, None]).T @ sensitivities / balance
                for key, share in sets.items()
            }
            wanted = {key: by_eye(share) for key, share in sets.items()}
            matrix = fitted(raw["training"], wanted["training"])
            own, own_mean = told(options.lamina, Path(name), camera)
            off = np.abs(own - matrix).max()
            if off > MOST_OFF:
                wrong.append(f"{camera}: an entry of the matrix differs by {off:.1e}")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                # It takes the channel of the highest peak for the one that sees white brightest:
                # with channels that see it alike that is no matter.
                theirs, _ = colour.matrix_idt(
                    colour.MultiSpectralDistributions(rows[:, 1:] / balance, rows[:, 0]).align(
                        shape, extrapolator_kwargs={"method": "Constant", "left": 0, "right": 0}
                    ),
                    power,
                )
            # To ACES2065-1, and adapted to its white; from there back.
            aces = colour.RGB_COLOURSPACES["ACES2065-1"]
            to_srgb = colour.matrix_RGB_to_RGB(aces, SRGB, "CAT02") @ theirs
            cells = []
            for key in sets:
                found = differences(raw[key] @ own.T, wanted[key])
                if key == "training" and abs(found.mean() - own_mean) > MOST_TOLD_OFF:
                    wrong.append(f"{camera}: tells {own_mean} for {found.mean():.3f}")
                by_theirs = differences(raw[key] @ to_srgb.T, wanted[key])
                cells.append(f"{found.mean():.2f}, {found.max():.2f} ({by_theirs.mean():.2f})")
            lines.append(f"| {camera} | " + " | ".join(cells) + f" | {off:.0e} |")
    text = "\n".join(["## Cameras", "", *lines])
    print(text)
    if options.record:
        file = ROOT / "reference" / "results" / "sensitivities.md"
        file.write_text(text + "\n", encoding="utf-8")
    print("\n".join(["wrong:", *wrong]) if wrong else "all as it should be", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
