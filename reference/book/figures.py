"""Pictures of the book that are put together from what `lamina grow` and `lamina render` write."""

import json
import math
import pathlib
import subprocess
import tomllib
from collections import Counter

import numpy as np
import OpenImageIO as oiio

from book.contact_sheet import centred, pixels


def lamina(program: pathlib.Path, *words: object) -> None:
    """Runs the program without its words."""
    subprocess.run(
        [str(word) for word in (program, *words)],
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def write(picture: np.ndarray, out: pathlib.Path, quality: int = 88) -> None:
    """Writes pixels (height, width, 3) as JPEG, or as PNG with a fifth of the levels.

    Fewer levels make the file of a drawing smaller.
    """
    if out.suffix == ".png":
        picture = (np.rint(picture / 5) * 5).astype(np.uint8)
    spec = oiio.ImageSpec(picture.shape[1], picture.shape[0], 3, oiio.UINT8)
    spec.attribute("compression", f"jpeg:{quality}")
    spec.attribute("png:compressionLevel", 9)
    image = oiio.ImageBuf(spec)
    image.set_pixels(oiio.ROI(), np.ascontiguousarray(picture))
    image.write(str(out))


def resized(picture: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """A picture of another size (height, width)."""
    spec = oiio.ImageSpec(picture.shape[1], picture.shape[0], 3, oiio.UINT8)
    image = oiio.ImageBuf(spec)
    image.set_pixels(oiio.ROI(), np.ascontiguousarray(picture))
    smaller = oiio.ImageBufAlgo.resize(image, roi=oiio.ROI(0, size[1], 0, size[0]))
    return smaller.get_pixels(oiio.UINT8)


def fitted(picture: np.ndarray, size: tuple[int, int], margin: float = 0.04) -> np.ndarray:
    """What a picture shows on white, as large as a field (height, width) holds."""
    ink = (picture < 250).any(axis=2)
    rows, columns = (np.flatnonzero(ink.any(axis=axis)) for axis in (1, 0))
    cut = picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    scale = (1 - 2 * margin) * min(
        outer / inner for outer, inner in zip(size, cut.shape[:2], strict=True)
    )
    inner = tuple(max(1, round(scale * side)) for side in cut.shape[:2])
    return centred(resized(cut, inner), size)


def lettered(picture: np.ndarray, words: list[tuple[int, int, str]], size: int = 30) -> np.ndarray:
    """A picture with words in it, each at the left end of its base line (across, down)."""
    spec = oiio.ImageSpec(picture.shape[1], picture.shape[0], 3, oiio.UINT8)
    image = oiio.ImageBuf(spec)
    image.set_pixels(oiio.ROI(), np.ascontiguousarray(picture))
    for across, down, word in words:
        oiio.ImageBufAlgo.render_text(image, across, down, word, size, "", (0.1, 0.1, 0.1))
    return image.get_pixels(oiio.UINT8)


def drawings(
    program: pathlib.Path,
    rows: list[list[str]],
    width: int,
    out: pathlib.Path,
    folder: pathlib.Path,
) -> None:
    """Presets drawn side by side in rows, each as large as its share of the row."""
    fields = []
    for row in rows:
        side = width // len(row)
        height = min(side, 2 * width // 5)
        drawn = []
        for name in row:
            lamina(program, "grow", name, "--out", folder / f"{name}.png", "--size", 2 * side)
            drawn.append(fitted(pixels(folder / f"{name}.png"), (height, side)))
        fields.append(centred(np.hstack(drawn), (height, width)))
    write(np.vstack(fields), out)


def stages(
    program: pathlib.Path,
    leaves: list[tuple[str, list[int], int]],
    width: int,
    out: pathlib.Path,
    folder: pathlib.Path,
) -> None:
    """Leaves while they grow, one in each row, every stage as large as its field.

    Each leaf comes with the numbers of the frames that are shown, and their count.
    """
    rows = []
    for number, (leaf, frames, count) in enumerate(leaves):
        stem = folder / f"stage-{number}"
        lamina(
            program,
            "grow",
            leaf,
            "--frames",
            count,
            "--out",
            stem.with_suffix(".png"),
            "--size",
            4000,
            "--caption",
            "none",
        )
        side = width // len(frames)
        shown = [
            fitted(pixels(folder / f"{stem.name}-{frame:04}.png"), (5 * side // 4, side))
            for frame in frames
        ]
        rows.append(np.hstack(shown))
    write(np.vstack(rows), out)


def inset(
    whole: pathlib.Path, part: pathlib.Path, box: tuple[int, int, int, int], out: pathlib.Path
) -> None:
    """A rendered picture with a magnified part in its upper left corner.

    `box` (left, top, right, bottom) is outlined.
    """
    picture, detail = pixels(whole).copy(), pixels(part)
    left, top, right, bottom = box
    for edge in range(4):
        picture[top - edge, left:right] = picture[bottom + edge, left:right] = 40
        picture[top:bottom, left - edge] = picture[top:bottom, right + edge] = 40
    height, width = detail.shape[:2]
    picture[16 : height + 24, 16 : width + 24] = 40
    picture[20 : height + 20, 20 : width + 20] = detail
    write(picture, out)


def cells(
    program: pathlib.Path, path: pathlib.Path, out: pathlib.Path, folder: pathlib.Path
) -> None:
    """The cells and the network of each transport leaf of a scene, as an SVG.

    It has the page of the scene's picture.
    """
    scene = tomllib.loads(path.read_text())
    camera = scene["camera"]["orthographic"]
    width, height = scene["film"]["rgb"]["size"]
    scale = height / camera["height_m"] / 1000
    middle = [1000 * place for place in camera["look_at_m"][:2]]
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}">',
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    for name, thing in scene["objects"].items():
        file = folder / f"{name}.json"
        lamina(
            program,
            "grow",
            f"{path}#{thing['leaf']}",
            "--set",
            "venation.cells.least_cells=1",
            "--out",
            file,
        )
        grown = json.loads(file.read_text())
        edge = grown["segment_mm"]
        # Nodes stand in the middles of their cells, but for some that the smooth margin has moved.
        across, along = (
            [place / edge for place in grown["nodes"][key]] for key in ("x_mm", "y_mm")
        )
        foot = Counter(round(y % 1, 6) for y in along).most_common(1)[0][0]
        places = [(round(x), round(y - foot)) for x, y in zip(across, along, strict=True)]
        at = [1000 * place for place in thing.get("position_m", [0, 0, 0])[:2]]
        left, top = (
            width / 2 + (at[0] - middle[0]) * scale,
            height / 2 - (at[1] - middle[1]) * scale,
        )
        side = edge * scale
        parts.append(
            f'<g transform="translate({left:.2f} {top:.2f}) scale({side:.4f} {-side:.4f}) '
            f'translate(0 {foot:.4f})" fill="none">'
        )
        parts += shape(places, side)
        parts += network(grown["edges"], places, edge)
        parts.append("</g>")
    out.write_text("\n".join(parts) + "\n</svg>\n")


def shape(places: list[tuple[int, int]], side: float) -> list[str]:
    """Cells as filled strips, with lines between them where these can be seen."""
    strips = runs(sorted((y, x) for x, y in set(places)))
    filled = "".join(f"M{x - 0.5} {y - 0.5}h{n}v1h-{n}z" for y, x, n in strips)
    parts = [f'<path d="{filled}" fill="#dcebc2"/>']
    if side > 2.5:
        lines = "".join(f"M{x - 0.5} {y + half}h{n}" for y, x, n in strips for half in (-0.5, 0.5))
        upright = runs(sorted(set(places)))
        lines += "".join(
            f"M{x + half} {y - 0.5}v{n}" for x, y, n in upright for half in (-0.5, 0.5)
        )
        parts.append(
            f'<path d="{lines}" stroke="#a9c48a" stroke-width="{min(0.09, 1.2 / side):.3f}"/>'
        )
    return parts


def runs(places: list[tuple[int, int]]) -> list[list[int]]:
    """Sorted places (line, place) as runs [line, first place, count]."""
    found: list[list[int]] = []
    for line, place in places:
        if found and found[-1][0] == line and found[-1][1] + found[-1][2] == place:
            found[-1][2] += 1
        else:
            found.append([line, place, 1])
    return found


def network(edges: dict, places: list[tuple[int, int]], edge: float) -> list[str]:
    """The ways from cell to cell, wider where more is supplied."""
    widths: dict[float, str] = {}
    for start, end, radius in zip(edges["from"], edges["to"], edges["radius_from_mm"], strict=True):
        (x, y), (u, v) = places[start], places[end]
        way = f"h{u - x}" if y == v else f"v{v - y}" if x == u else f"l{u - x} {v - y}"
        size = round(max(0.09, 2 * radius / edge), 3)
        widths[size] = widths.get(size, "") + f"M{x} {y}{way}"
    return [
        f'<path d="{way}" stroke="#2f5d1e" stroke-width="{size}" stroke-linecap="round"/>'
        for size, way in sorted(widths.items())
    ]


def fields(program: pathlib.Path, leaf: str, out: pathlib.Path, folder: pathlib.Path) -> None:
    """The outputs Vein, Net and Fac of the article's shader over one leaf, side by side."""
    lamina(
        program,
        "grow",
        leaf,
        "--fields",
        folder / "fields.exr",
        "--out",
        folder / "leaf.png",
        "--size",
        1600,
    )
    image = oiio.ImageBuf(str(folder / "fields.exr"))
    names = image.spec().channelnames
    told = image.get_pixels()[::-1]
    blade = fitted_mask(pixels(folder / "leaf.png"), told.shape[:2])
    panels, words = [], []
    for number, (key, word) in enumerate([("vein", "Vein"), ("net", "Net"), ("fac", "Fac")]):
        level = told[:, :, names.index(key)] ** (1 / 2.2)
        grey = np.where(blade, 225 - 190 * level, 255)
        side = 620
        panels.append(fitted(np.repeat(grey[:, :, None], 3, 2).astype(np.uint8), (1160, side)))
        words.append((number * side + 270, 1205, word))
    write(
        lettered(
            np.vstack([np.hstack(panels), np.full((70, 3 * 620, 3), 255, np.uint8)]), words, 40
        ),
        out,
    )


def fitted_mask(drawn: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Where the blade of a drawing lies on a map (height, width) over the leaf's box."""
    ink = (drawn < 250).any(axis=2)
    rows, columns = (np.flatnonzero(ink.any(axis=axis)) for axis in (1, 0))
    cut = drawn[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    return (resized(cut, size) < 250).any(axis=2)


def study(
    program: pathlib.Path,
    base: dict,
    values: dict,
    between: list[str],
    out: pathlib.Path,
    folder: pathlib.Path,
) -> None:
    """How the parameters of splines shape veins.

    A row for each, with the points of the splines, and a row of presets between two forms.
    """
    side, height, left = 340, 210, 190
    rows, words = [], []
    for number, (key, tries) in enumerate(values.items()):
        drawn = []
        for place, value in enumerate(tries):
            plan = base | {key: value}
            words.append((left + place * side + 12, number * height + 30, f"{value:g}"))
            drawn.append(leaf_with_points(program, plan, (height, side), folder))
        rows.append(np.hstack([np.full((height, left, 3), 255, np.uint8), *drawn]))
        words.append((10, number * height + 115, key.capitalize()))
    drawn = []
    for name in between:
        lamina(program, "grow", name, "--out", folder / "between.png", "--size", 1280)
        drawn.append(fitted(np.rot90(pixels(folder / "between.png"), -1), (height, side)))
    rows.append(np.hstack([np.full((height, left, 3), 255, np.uint8), *drawn]))
    words += [
        (10, len(values) * height + 100, "pinnate"),
        (10, len(values) * height + 140, "to arcuate"),
    ]
    write(lettered(np.vstack(rows), words, 28), out)


def leaf_with_points(
    program: pathlib.Path, plan: dict, size: tuple[int, int], folder: pathlib.Path
) -> np.ndarray:
    """One leaf with its tip to the right.

    Starts of its veins are red, their control points blue, their ends green.
    """
    sets = [
        word for key, value in plan.items() for word in ("--set", f"venation.arcuate.{key}={value}")
    ]
    lamina(program, "grow", "arcuate", *sets, "--out", folder / "study.png", "--size", 1280)
    drawn = np.rot90(pixels(folder / "study.png"), -1).copy()
    ink = (drawn < 250).any(axis=2)
    columns = np.flatnonzero(ink.any(axis=0))
    length, foot, axis = columns[-1] - columns[0], columns[0], drawn.shape[0] / 2
    angle1, length1, angle2, length2 = math.radians(45), 0.45, math.radians(38), 0.5
    corners = np.array(
        [
            [0, 0],
            [length1 * math.cos(angle1), length1 * math.sin(angle1)],
            [1 - length2 * math.cos(angle2), length2 * math.sin(angle2)],
            [1, 0],
        ]
    )

    def margin(t: float) -> np.ndarray:
        return np.array([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]) @ corners

    step = 1 / (plan["laterals"] + 1)
    down, across = np.mgrid[: drawn.shape[0], : drawn.shape[1]]
    for vein in range(plan["laterals"]):
        place = vein * step + step / 2
        end = margin(1 - plan["squish"] + place * plan["squish"])
        control = margin(1 - plan["squish2"] + place * plan["squish2"]) * [1, plan["up"]]
        start = np.array([step / 2 + vein * step * plan["squish3"], 0])
        for point, colour in [
            (control, (50, 80, 210)),
            (end, (20, 150, 60)),
            (start, (210, 40, 40)),
        ]:
            for way in (-1, 1):
                dot = (across - foot - point[0] * length) ** 2 + (
                    down - axis - way * point[1] * length
                ) ** 2 < 13**2
                drawn[dot] = colour
    return fitted(drawn, size)


def growth_diagram(out: pathlib.Path) -> None:
    """Young's Fig. 1: how the margin cell of one row moves in a few steps of growth.

    The numbers are those of Fig. 3b, and a slope.
    """
    axial, ratio, place, falloff, slope, rows = 0.1, 1.2, 0.3, 2.5, 0.45, 150
    before, after, row = 60, 63, 62

    def margin(step: int, index: int) -> tuple[float, float, float]:
        fastest = 1 + round(place * (rows - 1))
        far = (
            (fastest - index) / (fastest - 1)
            if index < fastest
            else (index - fastest) / (rows - fastest)
        )
        across = (1 + axial / ratio * (1 - far**falloff)) ** step
        foot = (1 + axial) ** step * (index - 1) / (rows - 1)
        return across, foot + slope * across, foot

    height = (1 + axial) ** after
    scale = 1500 / height

    def at(x: float, y: float) -> str:
        return f"{330 + x * scale * 1.25:.1f} {1640 - y * scale:.1f}"

    def curve(step: int) -> str:
        return "M" + "L".join(at(*margin(step, index)[:2]) for index in range(1, rows + 1))

    def word(x: float, y: float, text: str, anchor: str = "start") -> str:
        across, down = at(x, y).split()
        return f'<text x="{across}" y="{down}" text-anchor="{anchor}">{text}</text>'

    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="1600" height="1720" '
        'viewBox="0 0 1600 1720" font-family="sans-serif" font-size="36" fill="#222">',
        '<rect width="100%" height="100%" fill="white"/>',
        f'<path d="{curve(after)}" fill="none" stroke="#2f6b2f" stroke-width="5"/>',
        f'<path d="{curve(before)}" fill="none" stroke="#2f6b2f" stroke-width="5" '
        'stroke-dasharray="18 12"/>',
        f'<path d="M{at(0, 0)}L{at(0, height * 1.03)}" stroke="#222" stroke-width="5"/>',
    ]
    for step, fill, number in [(before, "#ffffff", 1), (after, "#dcebc2", 2)]:
        x, y, foot = margin(step, row)
        count = 14 if step == before else 17
        for cell in range(count):
            share = [(cell + corner) / count for corner in (0, 1)]
            half = height * 0.012
            corners = [
                (x * share[0], foot + (y - foot) * share[0] - half),
                (x * share[1], foot + (y - foot) * share[1] - half),
            ]
            corners += [(a, b + 2 * half) for a, b in reversed(corners)]
            colour = "#e0a030" if cell == count - 1 else fill
            parts.append(
                f'<path d="M{"L".join(at(*corner) for corner in corners)}Z" fill="{colour}" '
                'stroke="#555" stroke-width="2"/>'
            )
        parts.append(
            f'<path d="M{at(x, y)}L{at(x, -height * 0.02)}" stroke="#888" stroke-width="2" '
            'stroke-dasharray="4 8"/>'
        )
        parts.append(word(x, -height * 0.055, f"x{number}", "middle"))
        parts.append(word(-height * 0.02, foot, f"y{number}", "end"))
    x, y, foot = margin(after, row)
    parts += [
        f'<path d="M{at(0, 0)}L{at(height * 0.62, 0)}" stroke="#222" stroke-width="3"/>',
        word(x * 0.4, foot + (y - foot) * 0.4 + height * 0.035, "cell row of length L", "middle"),
        word(x * 1.03, y + height * 0.02, "margin cell, after"),
        word(x * 1.06, margin(before, row)[1] - height * 0.05, "margin cell, before"),
        word(height * 0.02, height * 0.99, "midrib"),
        word(
            margin(after, 125)[0] * 1.12,
            margin(after, 125)[1],
            "margin after (line) and before (dashes)",
        ),
    ]
    out.write_text("\n".join(parts) + "\n</svg>\n")
