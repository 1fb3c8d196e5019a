"""A scene or a leaf as USD: `lamina-usd SCENE|PRESET --out leaf.usdz`.

What the program writes as glTF becomes a layer of USD, in metres and with +y up.

- In: a scene file or a preset, and options of `lamina export gltf`.
- Out: `.usda` or `.usdc` with a folder of pictures, or `.usdz`, one file by Apple's rules: preview
  surfaces alone, and an instance for each place in place of a `PointInstancer`.
- Always true: the same scene gives the same bytes.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from lamina.extras import require
from lamina.gltf import Gltf
from lamina.program import Folders, LaminaError, Value, allowing, options_of, overrides, start

ENDINGS = (".usda", ".usdc", ".usdz")
# When all files in a package were made, by the local clock that it records.
MADE = (1980, 1, 1, 0, 0, 0, 0, 1, -1)


def to_usd(
    scene: str | Path,
    out: str | Path,
    values: Mapping[str, Value] | None = None,
    *,
    allow: Folders = (),
    **options: Value,
) -> list[Path]:
    """Writes a scene or a preset as USD and gives the files: the layer first, then its pictures.

    `out` ends in .usda, .usdc or .usdz. `values` sets keys as `lamina render -D` does; `allow` is
    as in `render`. `options` are those of `lamina export gltf` with `_` for `-`, such as
    `texture=512`. With `one_face` the variant set `faces` shows one surface, seen from both sides,
    in the adaxial face's colours; without, a surface for each face.
    """
    one_face = bool(options.pop("one_face", False))
    words = [*overrides("-D", values), *allowing(allow), *options_of(options)]
    return write(scene, Path(out), words, one_face)[0]


def write(scene: str | Path, out: Path, words: list[str], one_face: bool) -> tuple[list[Path], str]:
    """What `to_usd` does, with options as words; and the notes on what was written."""
    if out.suffix not in ENDINGS:
        raise LaminaError(f"{out}: USD's files end in {', '.join(ENDINGS)}", 2)
    if not out.parent.is_dir():
        raise LaminaError(f"{out}: there is no folder {out.parent}", 2)
    require("usd", "an export to USD")
    from lamina.usd_stage import Stage

    is_package = out.suffix == ".usdz"
    with TemporaryDirectory(dir=out.parent, prefix=f".{out.name}-") as folder:
        here = Path(folder)
        glb = here / "scene.glb"
        plain = ["--plain-nodes"] if is_package and "--plain-nodes" not in words else []
        export = ["export", "gltf", scene, "--out", glb, *plain, *words]
        _, notes = start(export).finished()
        gltf = Gltf.read(glb)
        pictures = written_pictures(gltf, here, f"{out.stem}-textures")
        layer = here / (f"{out.stem}.usdc" if is_package else out.name)
        stage = Stage(gltf, [f"./{file}" for file in pictures], layer, not is_package)
        stage.write(one_face)
        if is_package:
            packed(here, layer, here / out.name)
            files = [out]
        else:
            if pictures:
                out.with_name(f"{out.stem}-textures").mkdir(exist_ok=True)
            files = [out, *(out.parent / file for file in pictures)]
        # The layer last, so that it never names what is not there.
        for file in reversed(files):
            (here / file.relative_to(out.parent)).replace(file)
    # The program's last note has the bytes of the glTF file.
    whole = sum(file.stat().st_size for file in files)
    return files, re.sub(r"\d+ bytes$", f"{whole} bytes", notes.rstrip())


def written_pictures(gltf: Gltf, here: Path, name: str) -> list[str]:
    """Writes the picture of each texture below a folder, and gives its path there."""
    paths: list[str] = []
    if "textures" in gltf.parts:
        (here / name).mkdir()
    for texture in gltf.parts.get("textures", []):
        image = gltf.parts["images"][texture["source"]]
        stem = re.sub(r"[^A-Za-z0-9._-]", "_", image["name"])
        path, number = f"{name}/{stem}.png", 1
        while path in paths:
            number += 1
            path = f"{name}/{stem}-{number}.png"
        (here / path).write_bytes(gltf.view(image["bufferView"]))
        paths.append(path)
    return paths


def packed(here: Path, layer: Path, out: Path) -> None:
    """Packs a layer and its pictures."""
    from pxr import Sdf, UsdUtils

    made = time.mktime(MADE)
    for file in here.rglob("*"):
        os.utime(file, (made, made))
    if not UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(layer)), str(out)):
        raise LaminaError(f"{out.name} could not be packed", 1)


def arguments(words: list[str] | None) -> tuple[argparse.Namespace, list[str]]:
    """What is to be written, and options of `lamina export gltf`."""
    parser = argparse.ArgumentParser(
        prog="lamina-usd",
        description="Writes a scene or a preset leaf as USD, in metres and with +y up.",
        epilog="All other options are those of `lamina export gltf`: -D KEY=VALUE, --illuminant, "
        "--texture, --triangles, --cards, --plain-nodes, --allow.",
        allow_abbrev=False,
    )
    parser.add_argument("scene", metavar="SCENE|PRESET")
    parser.add_argument(
        "--out", type=Path, required=True, help="file to write: .usda, .usdc or .usdz"
    )
    parser.add_argument(
        "--one-face",
        action="store_true",
        help="show leaves as one surface with the adaxial face's colours, for programs that draw "
        "both sides of every surface",
    )
    return parser.parse_known_args(words)


def main(words: list[str] | None = None) -> int:
    """Writes USD; the exit codes of `lamina`."""
    options, others = arguments(words)
    try:
        files, notes = write(options.scene, options.out, others, options.one_face)
    except LaminaError as error:
        print(f"lamina-usd: {error}", file=sys.stderr)
        return error.code
    except OSError as error:
        print(f"lamina-usd: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    print(files[0])
    print(notes, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
