"""Tones against other software: `reference/run tones`.

A chart of lights from the white point to the spectrum's edge, at strengths of 14 stops, goes
through `lamina tonemap`. colour-science tells hue and lightness of what comes out, OpenImageIO what
the sRGB encoding should be, and a second evaluation of AgX, whose working space is constructed here
from the published turns and insets of the primaries, what its curve should be.

With `--scenes` the scenes below are rendered small, and for each tone the share of pixels is
counted in which a channel is 0 though it has light, or is at the top.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import colour
import numpy as np
import OpenImageIO as oiio

from lamina.exr import Array, write_channels
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
TONES = ("agx", "standard", "filmic", "none")
# Largest turn of a hue in Oklab, degrees, weighted by chroma over 0.1: 16 bits and the differing
# digits of two sets of matrices leave less.
MOST_TURN = 0.6
SCENES = (
    "first-leaf",
    "autumn-leaf",
    "compound-leaf",
    "cupped-leaf",
    "croton",
    "fly-agaric",
    "melons",
    "pigments",
)
SRGB = colour.RGB_COLOURSPACES["sRGB"]
REC2020 = colour.RGB_COLOURSPACES["ITU-R BT.2020"]


def write_exr(file: Path, pixels: Array) -> None:
    """Linear sRGB as 32-bit floats."""
    write_channels(file, dict(zip("RGB", np.moveaxis(pixels, -1, 0), strict=True)))


def read(file: Path) -> tuple[Array, oiio.ImageSpec]:
    """Values of a picture as stored, integers as shares of their greatest."""
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise RuntimeError(f"{file}: {oiio.geterror()}")
    spec = image.spec()
    pixels = np.asarray(image.read_image(spec.format), dtype=np.float64)
    image.close()
    most = {"uint8": 255.0, "uint16": 65535.0}.get(str(spec.format), 1.0)
    return pixels / most, spec


def tonemap(binary: Path, source: Path, out: Path, *words: str) -> tuple[Array, oiio.ImageSpec]:
    """What the program makes of a picture."""
    line = [str(binary), "tonemap", str(source), "--out", str(out), *words]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(line)} failed ({done.returncode}):\n{done.stderr}")
    return read(out)


def chart() -> Array:
    """Linear sRGB: rows of 29 hues, columns of 12 purities by 15 strengths from 2^-9 to 2^5."""
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    edge = [observer[nm] for nm in np.arange(440.0, 650.0, 10.0)]
    ends = (observer[440.0], observer[650.0])
    # Purples close the circle.
    edge += [ends[0] * (1 - share) + ends[1] * share for share in np.linspace(0.1, 0.9, 8)]
    white = colour.xy_to_XYZ(SRGB.whitepoint)
    rows = []
    for light in edge:
        pure = np.asarray(light) / light[1]
        row = []
        for purity in np.linspace(0.0, 0.9, 12):
            # Of equal luminance, so that what is mixed is share of luminance.
            share = purity * 0.6 if pure[2] > 5.0 else purity
            mixed = (1 - share) * white + share * pure
            row += [mixed * 2.0**stops for stops in range(-9, 6)]
        rows.append(row)
    return colour.XYZ_to_RGB(np.array(rows), SRGB)


def oklab(linear: Array) -> tuple[Array, Array, Array]:
    """Lightness, chroma, hue (degrees) of linear sRGB by colour-science."""
    lab = colour.XYZ_to_Oklab(colour.RGB_to_XYZ(linear, SRGB))
    chroma = np.hypot(lab[..., 1], lab[..., 2])
    return lab[..., 0], chroma, np.degrees(np.arctan2(lab[..., 2], lab[..., 1]))


def working_space(turns: list[float], insets: list[float]) -> Array:
    """Rec. 2020 to the space whose primaries are turned (degrees) and moved towards white.

    The turned primary lies where its ray from white leaves Rec. 2020's triangle, then is moved."""
    white = np.array(REC2020.whitepoint)
    corners = np.array(REC2020.primaries)
    primaries = []
    for corner, turn, inset in zip(corners, np.radians(turns), insets, strict=True):
        x, y = corner - white
        ray = np.array([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)])
        reach = []
        for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            along, share = np.linalg.solve(np.stack([ray, one - other], axis=1), one - white)
            if along > 0 and -1e-9 <= share <= 1 + 1e-9:
                reach.append(along)
        primaries.append(white + min(reach) * (1 - inset) * ray)
    to_xyz = colour.normalised_primary_matrix(np.array(primaries), white)
    return np.linalg.inv(REC2020.matrix_RGB_to_XYZ) @ to_xyz


def agx_curve(light: Array, contrast: float = 1.0) -> Array:
    """The sigmoid of AgX between its ends, by its definition."""
    low, high, slope, power, out = -10.0, 6.5, 2.4 * contrast, 1.5, 0.18 ** (1 / 2.4)
    x = (np.clip(np.log2(np.maximum(light, 1e-30) / 0.18), low, high) - low) / (high - low)
    pivot = -low / (high - low)
    run = np.where(x >= pivot, 1 - pivot, pivot)
    rise = np.where(x >= pivot, 1 - out, out)
    scale = ((slope * run) ** -power * ((slope * run / rise) ** power - 1)) ** (-1 / power)
    term = slope * np.abs(x - pivot) / scale
    bent = scale * term / (1 + term**power) ** (1 / power)
    return np.clip(out + np.sign(x - pivot) * bent, 0, 1) ** 2.4


def agx(linear: Array) -> Array:
    """AgX of colours inside sRGB, before anything is done about hue and gamut."""
    inset = working_space(
        [2.13976149, -1.22827335, -3.05174246], [0.32965205, 0.28051336, 0.12475368]
    )
    outset = np.linalg.inv(working_space([0.0, 0.0, 0.0], [0.32317438, 0.28325605, 0.0374326]))
    wide = colour.RGB_to_RGB(linear, SRGB, REC2020)
    shown = np.einsum("ij,...j->...i", outset, agx_curve(np.einsum("ij,...j->...i", inset, wide)))
    return colour.RGB_to_RGB(shown, REC2020, SRGB)


def check_chart(binary: Path, folder: Path) -> tuple[list[str], list[str]]:
    """Lines of the report, and what is wrong."""
    light = chart()
    source = folder / "chart.exr"
    write_exr(source, light)
    lightness, chroma, hue = oklab(light)
    lines = [
        f"{light.shape[0] * light.shape[1]} lights; {np.mean(light.min(-1) < 0):.0%} are outside "
        "of sRGB.",
        "",
        "| tone | a channel 0 | a channel at the top | largest turn of hue, degrees | lightness "
        "kept to |",
        "| --- | --- | --- | --- | --- |",
    ]
    wrong = []
    for tone in TONES:
        shown, spec = tonemap(
            binary, source, folder / f"{tone}.png", "--tone", tone, "--sixteen-bits"
        )
        if spec.get_string_attribute("oiio:ColorSpace") not in (
            "sRGB",
            "srgb_rec709_scene",
            "srgb_rec709_display",
            "srgb_tx",
        ):
            wrong.append(
                f"{tone}: the PNG's colours are said to be "
                f"{spec.get_string_attribute('oiio:ColorSpace')}"
            )
        if str(spec.format) != "uint16":
            wrong.append(f"{tone}: {spec.format} instead of 16 bits")
        linear = colour.models.eotf_sRGB(shown)
        own_lightness, own_chroma, own_hue = oklab(linear)
        turn = np.abs((own_hue - hue + 180) % 360 - 180)
        # Of a colour that is nearly grey a hue says little.
        turn = np.where(chroma > 0.01, turn * np.minimum(own_chroma / 0.1, 1), 0.0)
        zero = np.mean((shown == 0).any(-1))
        top = np.mean((shown == 1).any(-1))
        below_white = lightness < 0.99
        moved = np.abs(own_lightness - lightness)[below_white].max()
        lines.append(
            f"| {tone} | {zero:.1%} | {top:.1%} | {turn.max():.2f} | "
            + (f"{moved:.4f} |" if tone == "standard" else "a curve |")
        )
        if tone in ("agx", "standard"):
            if turn.max() > MOST_TURN:
                wrong.append(f"{tone}: a hue turns by {turn.max():.2f} degrees")
            if zero > 0:
                wrong.append(f"{tone}: {zero:.2%} of the chart have a channel of 0")
        if tone == "standard" and moved > 2e-3:
            wrong.append(f"standard: lightness moves by {moved}")
    # Colours well inside sRGB, in cells of one pixel.
    grid = np.stack(np.meshgrid(*[np.linspace(0.25, 0.75, 7)] * 3), axis=-1).reshape(7, 49, 3)
    inside, encoded = folder / "inside.exr", folder / "inside.png"
    write_exr(inside, grid)
    shown, _ = tonemap(binary, inside, encoded, "--tone", "standard", "--sixteen-bits")
    by_colour = np.abs(shown - colour.models.eotf_inverse_sRGB(grid))
    buffer = oiio.ImageBufAlgo.colorconvert(oiio.ImageBuf(str(inside)), "lin_rec709", "sRGB")
    by_oiio = np.abs(shown - buffer.get_pixels(oiio.FLOAT))
    pale = np.abs(oklab(grid)[1]) < 0.05
    lines += [
        "",
        f"`standard` within sRGB: at most {by_colour[pale].max():.1e} from colour-science and "
        f"{by_oiio[pale].max():.1e} from OpenImageIO in sRGB values.",
    ]
    if by_colour[pale].max() > 2e-4 or by_oiio[pale].max() > 2e-4:
        wrong.append("standard: colours inside sRGB are not encoded as they are")
    greys = np.repeat(0.18 * 2.0 ** np.linspace(-8, 6, 57), 3).reshape(1, 57, 3)
    ramp = folder / "ramp.exr"
    write_exr(ramp, greys)
    on_greys = 0.0
    for contrast in (1.0, 0.6, 1.4, 2.0):
        flags = ("--tone", "agx", "--contrast", str(contrast), "--sixteen-bits")
        shown, _ = tonemap(binary, ramp, folder / "ramp.png", *flags)
        expected = colour.models.eotf_inverse_sRGB(agx_curve(greys, contrast))
        on_greys = max(on_greys, np.abs(shown - expected).max())
    shown, _ = tonemap(binary, inside, encoded, "--tone", "agx", "--sixteen-bits")
    expected = agx(grid)
    of_ours, of_theirs = oklab(colour.models.eotf_sRGB(shown)), oklab(expected)
    on_colours = max(
        np.abs(of_ours[0] - of_theirs[0]).max(), np.abs(of_ours[1] - of_theirs[1])[pale].max()
    )
    lines.append(
        f"`agx` against a second evaluation: greys differ by at most {on_greys:.1e} in sRGB "
        "values with contrasts "
        f"from 0.6 to 2, lightness and "
        f"chroma of colours by {on_colours:.1e} in Oklab."
    )
    if on_greys > 2e-4 or on_colours > 2e-3:
        wrong.append(f"agx: {on_greys:.1e} on greys, {on_colours:.1e} on colours")
    return lines, wrong


def check_scenes(binary: Path, folder: Path) -> list[str]:
    """A table of the shares of pixels with lost channels, of what stands in the picture."""
    lines = [
        "",
        "Share of the pixels covered by something in which a channel is 0 of 255 though the "
        "strongest is not below "
        "26, and in which one is 255 (120 pixels across, 16 samples a pixel, the scene's "
        "exposure).",
        "",
        "| scene | " + " | ".join(f"{tone}: 0 | {tone}: 255" for tone in TONES) + " |",
        "| --- |" + " --- | --- |" * len(TONES),
    ]
    for scene in SCENES:
        file = ROOT / "scenes" / scene / "scene.toml"
        out = folder / scene
        line = [str(binary), "render", str(file), "--spp", "16", "--noise", "0", "--out", str(out)]
        line += ["-D", "film.rgb.size=[120,120]"]
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(line)} failed:\n{done.stderr}")
        pixels, spec = read(out.with_suffix(".exr"))
        covered = pixels[:, :, spec.channelnames.index("A")] > 0.5
        cells = []
        for tone in TONES:
            shown, _ = tonemap(binary, out.with_suffix(".exr"), folder / "t.png", "--tone", tone)
            shown = np.round(shown * 255)[covered]
            lost = (shown.min(-1) == 0) & (shown.max(-1) >= 26)
            cells.append(f"{lost.mean():.1%} | {(shown.max(-1) == 255).mean():.1%}")
        lines.append(f"| {scene} | " + " | ".join(cells) + " |")
        print(lines[-1], file=sys.stderr)
    return lines


def main() -> int:
    """Compares, prints the table and says with its exit code whether all is as it should be."""
    parser = argparse.ArgumentParser(prog="reference/run tones", description=__doc__)
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument("--scenes", action="store_true", help="count lost channels in scenes too")
    parser.add_argument(
        "--record", action="store_true", help="write to reference/results, which is committed"
    )
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        lines, wrong = check_chart(options.lamina, Path(name))
        if options.scenes:
            lines += check_scenes(options.lamina, Path(name))
    text = "\n".join(["## Tones", "", *lines])
    print(text)
    if options.record:
        file = ROOT / "reference" / "results" / "tones.md"
        file.write_text(text + "\n", encoding="utf-8")
    print("\n".join(["wrong:", *wrong]) if wrong else "all as it should be", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
