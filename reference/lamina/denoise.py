"""Takes noise out of a picture: `lamina-denoise IN.exr --out OUT.exr`, or renders a scene before.

Open Image Denoise guesses each pixel from its neighbours. What comes out is for the eye: it is
biased, and of one picture nobody knows by how much. The file says so in `lamina:denoised`; its
layer `variance` is that of the picture which went in.

With twins, renders of the same scene with other seeds, all are denoised and their mean is written.
`lamina.twins` estimates the bias, and what is left of the noise, which the layer `variance` has.

- In: an EXR of Lamina, of a colour film or a spectral one; its layers `albedo` and `N` as guides.
  Or a scene file, which is rendered once all is checked that can be without rays.
- Out: the same EXR with other radiance, and with alpha that has the same soft edges; if wanted, a
  picture to look at by `lamina tonemap`.
- Always true: no other layer and no attribute changes, but for variances and samples if there are
  twins; OUT is whole or not there.
- Left out: pictures by other programs, parts of a render, tests of light.
"""

from __future__ import annotations

import argparse
import sys
import tomllib
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory, TemporaryFile
from time import perf_counter
from typing import Any

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray

from lamina.extras import require
from lamina.film import Failed, Film, Pixels, Refused, read, write
from lamina.program import LaminaError, program, run
from lamina.scene_picture import check_size, rendered
from lamina.twins import bias, left_noise

NOTE = "lamina:denoised"
NORMAL = ("N.X", "N.Y", "N.Z")
SAMPLES, ALPHA = ("samples.Y",), ("A",)
SEED, SCENE = "lamina:seed", "lamina:scene"
# Linear Rec. 709 to linear Rec. 2020 (ITU-R BT.2087): many leaf greens have a negative blue in the
# first, and the denoiser takes what is below 0 for 0.
REC2020 = np.array([[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]])
# A grey of two pixels comes out a quarter too dark, one of 16 within 0.2 %.
LEAST_SIZE = 16
# Pixels across, around one that is near an edge.
EDGE = 5


def check(film: Film, file: Path, guides: bool) -> None:
    """Refuses pictures that would come out wrong."""
    note = film.spec.get_string_attribute(NOTE)
    if note:
        raise Refused(f"{file}: it is denoised already ({NOTE}: {note})")
    if not film.light():
        raise Refused(f"{file}: it has no colours: neither channels R, G, B nor bands S0.…nm")
    if min(film.pixels.shape[:2]) < LEAST_SIZE:
        raise Refused(f"{file}: it has less than {LEAST_SIZE} pixels across or down")
    # The denoiser takes NaN for 0 and says nothing.
    for names in (film.light(), *((film.albedo(), NORMAL, ("A",)) if guides else ())):
        for name in names:
            if film.has((name,)):
                bad = np.argwhere(~np.isfinite(film.pixels[:, :, film.places((name,))[0]]))
                if len(bad):
                    y, x = bad[0]
                    raise Refused(
                        f"{file}: {name} is not finite in {len(bad)} pixels, "
                        f"the first at x = {x}, y = {y}"
                    )


def traced_scene(text: str) -> object:
    """What samples depend on in a scene file: neither their number, the target noise and the seed
    nor how the picture is developed. A text that is no TOML stands for itself.
    """
    try:
        scene = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return text
    scene.pop("picture", None)
    films = scene.get("film", {})
    for film in films.values() if isinstance(films, dict) else ():
        for key in ("spp", "noise", "seed") if isinstance(film, dict) else ():
            film.pop(key, None)
    return scene


def check_twins(films: list[Film], files: list[Path]) -> None:
    """Refuses a further picture that is not of the same scene, or not of other random numbers."""
    seeds: dict[str, Path] = {}
    for film, file in zip(films, files, strict=True):
        first, other = films[0].spec, film.spec
        if first.channelnames != other.channelnames or films[0].pixels.shape != film.pixels.shape:
            raise Refused(f"{file}: it is no twin: it has another size or other layers")
        of_first, of_other = (
            traced_scene(spec.get_string_attribute(SCENE)) for spec in (first, other)
        )
        if of_first != of_other:
            raise Refused(f"{file}: it is no twin: it is of another scene")
        seed = other.get_string_attribute(SEED)
        if seed in seeds:
            raise Refused(
                f"{file}: it is no twin: {seeds[seed]} is of seed {seed} too; render with another "
                "--seed"
            )
        seeds[seed] = file


class Denoiser:
    """Open Image Denoise on the processor, so that one picture gives the same bytes again."""

    def __init__(self) -> None:
        # By name: its type stubs do not parse, and mypy would stop at them.
        mitsuba_oidn: Any = import_module("mitsuba_oidn")
        self.error: type[Exception] = mitsuba_oidn.Error
        self.device: Any = mitsuba_oidn.Device(mitsuba_oidn.DeviceType.CPU)
        self.version = (
            f"Open Image Denoise {mitsuba_oidn.oidn_version()} "
            f"(mitsuba-oidn {mitsuba_oidn.__version__})"
        )

    def run(self, kind: str, pictures: list[Pixels], guides: dict[str, Pixels]) -> list[Pixels]:
        """One filter over pictures of one size: `color` by guides, or a guide itself."""
        made = []
        try:
            # To make a filter takes as long as to run it.
            rt = self.device.new_filter("RT")
            for name, guide in guides.items():
                rt.set_image(name, guide)
            rt.hdr = kind == "color"
            rt.clean_aux = bool(guides)
            for picture in pictures:
                out = np.zeros_like(picture)
                made.append(out)
                # Without any light there is no exposure, and black would come out as grey.
                if not picture.any():
                    continue
                rt.set_image(kind, picture)
                rt.set_image("output", out)
                rt.execute()
        except self.error as error:
            raise Failed(f"Open Image Denoise: {error}") from error
        return made

    def guides(self, film: Film) -> dict[str, Pixels]:
        """Albedo and normals without noise of their own; nothing if the film has no albedo.

        The film's features are means over covered samples; radiance is one over all of them, so
        that features are weighed by coverage to have the same edges.
        """
        # Normals alone are no input that the denoiser knows.
        if not film.albedo():
            return {}
        layers = {"albedo": film.albedo()} | ({"normal": NORMAL} if film.has(NORMAL) else {})
        share = film.layer(("A",)) if film.has(("A",)) else np.float32(1)
        return {
            kind: self.run(kind, [film.layer(names) * share], {})[0]
            for kind, names in layers.items()
        }

    def light(self, light: Pixels, guides: dict[str, Pixels]) -> Pixels:
        """Radiance with less noise, each channel alone: measured, three at once are worse.

        What is below 0 is added again as it was, so that it is not taken from the mean.
        """
        channels = [np.maximum(light[:, :, number], 0) for number in range(light.shape[2])]
        return np.stack(self.run("color", channels, guides), axis=2) + np.minimum(light, 0)

    def alpha(self, film: Film, guides: dict[str, Pixels]) -> Pixels:
        """Coverage by the filter of radiance, so that both have the same soft edges.

        Colours are multiplied by alpha: a smooth edge over a rough alpha would get fringes.
        Away from edges it stays as it was, exactly 0 or 1.
        """
        # Only here, so that the module can be read without the extra.
        from scipy.ndimage import maximum_filter, minimum_filter

        share = film.layer(ALPHA)[:, :, 0].copy()
        is_soft = minimum_filter(share, EDGE) < maximum_filter(share, EDGE)
        clean = self.run("color", [share], guides)[0]
        made: Pixels = np.where(is_soft, np.clip(clean, 0, 1), share)
        return made


def cleaned(film: Film, denoiser: Denoiser, guides: dict[str, Pixels]) -> Pixels:
    """Radiance with less noise."""
    names = film.light()
    light = film.layer(names)
    if names != ("R", "G", "B"):
        return denoiser.light(light, guides)
    wide = denoiser.light((light @ REC2020.T).astype(np.float32), guides)
    made: Pixels = wide @ np.linalg.inv(REC2020).T
    return made


@dataclass
class Mean:
    """Denoised films as one, and each alone."""

    film: Film
    # What is to be said of it.
    told: str
    # Radiance of each, and its share in the film's.
    clean: list[Pixels]
    shares: NDArray[np.float64]


def denoise(films: list[Film], denoiser: Denoiser, with_guides: bool) -> Mean:
    """The first film with denoised radiance and the note.

    Of twins the radiance is the mean of all, by their samples, and the variance is of that.
    """
    first = films[0]
    guides = [denoiser.guides(film) if with_guides else {} for film in films]
    clean = [cleaned(film, denoiser, guide) for film, guide in zip(films, guides, strict=True)]
    pixels = first.pixels.copy()
    names = first.light()
    # By their mean numbers of samples, not each pixel's own, which go with how bright it came out.
    counts = [float(film.layer(SAMPLES).mean()) if film.has(SAMPLES) else 1.0 for film in films]
    shares = np.array(counts) / sum(counts)
    pixels[:, :, first.places(names)] = np.average(clean, axis=0, weights=shares)
    if first.has(ALPHA):
        alphas = [denoiser.alpha(film, guide) for film, guide in zip(films, guides, strict=True)]
        pixels[:, :, first.places(ALPHA)[0]] = np.average(alphas, axis=0, weights=shares)
    layers = ["albedo", "N"][: len(guides[0])]
    how = f"guided by {' and '.join(layers)}"
    if not layers:
        how = f"without guides{': the picture has no layer albedo' if with_guides else ''}"
    error = "variance is that of the picture before"
    if len(films) > 1:
        seeds = " and ".join(film.spec.get_string_attribute(SEED) for film in films)
        off = bias(clean, [film.layer(names) for film in films], names)
        error = (
            f"mean of seeds {seeds}; variance is that of the noise left, without bias; "
            f"bias of luminance {off}"
        )
        how += f", bias {off}"
        for layer, values in left_noise(clean, shares, names).items():
            if first.has((layer,)):
                pixels[:, :, first.places((layer,))[0]] = values
        if first.has(SAMPLES):
            pixels[:, :, first.places(SAMPLES)] = sum(film.layer(SAMPLES) for film in films)
    spec = oiio.ImageSpec(first.spec)
    spec.attribute(
        NOTE,
        f"{denoiser.version}; guides: {', '.join(layers) or 'none'}; each channel alone; "
        f"biased, no measurement; {error}",
    )
    return Mean(Film(spec, pixels), how, clean, shares)


def check_places(source: Path, out: Path, png: Path | None) -> None:
    """Refuses outputs before any work is done."""
    if out.suffix != ".exr":
        raise Refused(f"{out}: the ending tells what is written: exr")
    if png and png.suffix not in (".png", ".jpg", ".jpeg"):
        raise Refused(f"{png}: the ending tells what is written: png or jpg")
    for file in filter(None, (out, png)):
        if file.resolve() == source.resolve() or (
            file.exists() and source.exists() and file.samefile(source)
        ):
            raise Refused(f"{file}: it is the input, which is kept")
        folder = file.resolve().parent
        if file.is_dir():
            raise Refused(f"{file}: it is a folder")
        if not folder.is_dir():
            raise Refused(f"{file}: there is no folder {folder}")
        try:
            # Permissions do not tell all: a disk may be read-only.
            with TemporaryFile(dir=folder, prefix=".lamina-"):
                pass
        except OSError as error:
            raise Failed(f"{file}: the folder cannot be written: {error.strerror}") from error
    if png:
        try:
            program()
        except FileNotFoundError as error:
            raise Refused(f"{png}: lamina tonemap writes it, and {error}") from error


def arguments(words: list[str] | None) -> argparse.Namespace:
    """What is to be done."""
    parser = argparse.ArgumentParser(
        prog="lamina-denoise",
        description="Takes noise out of a picture, or of one that it renders, by Open Image "
        "Denoise. What comes out is for the eye, no measurement.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "picture",
        type=Path,
        metavar="IN.exr|SCENE.toml",
        help="a picture of Lamina's, or a scene file, which is rendered first",
    )
    parser.add_argument("--out", type=Path, required=True, metavar="OUT.exr")
    parser.add_argument(
        "--png", type=Path, metavar="OUT.png", help="also one to look at, png or jpg"
    )
    parser.add_argument(
        "--twin",
        type=Path,
        action="append",
        default=[],
        metavar="TWIN.exr",
        help="the same scene rendered with another --seed: the mean is written, and what is left "
        "of the noise and the bias are told; may be given again for more",
    )
    parser.add_argument(
        "--no-guides", action="store_true", help="leave the layers albedo and N aside"
    )
    scene = parser.add_argument_group("of a scene, as `lamina render` takes them")
    scene.add_argument("--spp", type=int, metavar="N", help="samples a pixel")
    scene.add_argument(
        "-D", dest="overrides", action="append", metavar="KEY=VALUE", help="override a value"
    )
    scene.add_argument(
        "--allow",
        action="append",
        metavar="DIR",
        help="a folder outside of the scene's own whose files it may name",
    )
    options = parser.parse_args(words)
    is_scene = options.picture.suffix == ".toml"
    if is_scene and options.twin:
        parser.error("--twin: of a scene, lamina-print renders and denoises several")
    if not is_scene and (options.spp or options.overrides or options.allow):
        parser.error("--spp, -D and --allow are for a scene, and IN.exr is rendered already")
    return options


def denoise_scene(options: argparse.Namespace) -> None:
    """Renders a scene and denoises the picture; whatever can be refused is refused before."""
    require("denoise", "denoising")
    check_places(options.picture, options.out, options.png)
    check_size(options.picture, options.overrides or [], LEAST_SIZE)
    with TemporaryDirectory(prefix=".lamina-", dir=options.out.resolve().parent) as folder:
        options.picture = rendered(options, Path(folder))
        denoise_files(options)


def denoise_files(options: argparse.Namespace) -> Mean:
    """Reads, denoises, writes, says what was done, and returns it."""
    require("denoise", "denoising")
    sources: list[Path] = [options.picture, *options.twin]
    films = []
    for source in sources:
        check_places(source, options.out, options.png)
    for source in sources:
        films.append(read(source))
        check(films[-1], source, not options.no_guides)
    check_twins(films, sources)
    denoiser = Denoiser()
    began = perf_counter()
    mean = denoise(films, denoiser, not options.no_guides)
    write(mean.film, options.out)
    print(f"{denoiser.version}, {mean.told}, {perf_counter() - began:.1f} s", file=sys.stderr)
    print(options.out)
    if options.png:
        # By the scene's own block `picture`.
        try:
            run(["tonemap", options.out, "--out", options.png])
        except LaminaError as error:
            raise Failed(f"{options.png}: lamina tonemap failed: {error}") from error
        print(options.png)
    return mean


def main(words: list[str] | None = None) -> int:
    """Denoises a picture; 0 done, 1 the system failed, 2 bad input, 130 interrupted."""
    try:
        options = arguments(words)
        if options.picture.suffix == ".toml":
            denoise_scene(options)
        else:
            denoise_files(options)
    except LaminaError as error:
        print(f"lamina-denoise: {error}", file=sys.stderr)
        return error.code
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
