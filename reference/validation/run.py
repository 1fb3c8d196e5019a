"""The comparison from end to end: `reference/compare SCENE_FOLDER...`.

For each scene: export it, render it in Mitsuba in independent passes, render it with Lamina under
as many seeds, compare, and write `NAME.md`, `NAME.json` and the maps.

Lamina's samples inside one picture are low-discrepancy points, so that the variance which it
writes into its own file, found as if they were independent, is too large, and a z-test with it
too kind. Here the variance is that of the mean over seeds, which are independent.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter, process_time

from lamina.mitsuba import variant
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
SCENES = (
    "flat-leaf",
    "furnace",
    "two-leaves",
    "textured-veins",
    "relief",
    "closed-blade",
    "solid-fruit",
    "instances",
    "spots",
    "pots",
    "milk-glass",
)


def arguments() -> argparse.Namespace:
    """What is to be done."""
    parser = argparse.ArgumentParser(prog="reference/compare", description=__doc__)
    parser.add_argument("scenes", nargs="*", type=Path, help="scene folders; default: the eleven")
    parser.add_argument("--lamina", type=Path, default=program())
    parser.add_argument(
        "--spp", type=int, default=None, help="Lamina's samples a pixel, all seeds (1024)"
    )
    parser.add_argument("--seeds", type=int, default=16, help="Lamina's independent pictures")
    parser.add_argument("--mitsuba-spp", type=int, default=1024, help="Mitsuba's, all passes")
    parser.add_argument("--passes", type=int, default=32, help="Mitsuba's independent pictures")
    parser.add_argument("--results", type=Path, default=ROOT / "out" / "reference")
    parser.add_argument(
        "--record", action="store_true", help="write to reference/results, which is committed"
    )
    parser.add_argument(
        "--time",
        action="store_true",
        help="compare speed instead: one picture each at the scene's own spp (or at --spp)",
    )
    parser.add_argument("--variant", default=None, help="Mitsuba's variant, if not the best one")
    parser.add_argument("--work", type=Path, default=None, help="keep the pictures in this folder")
    return parser.parse_args()


def lamina(program: Path, *words: object) -> None:
    """Runs the renderer; its own report goes to stderr if it fails."""
    done = subprocess.run(
        [str(program), *(str(word) for word in words)], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise RuntimeError(f"lamina {words[0]} failed ({done.returncode}):\n{done.stderr}")


def render_lamina(program: Path, scene: Path, spp: int, seeds: int, work: Path) -> tuple:
    """Mean over seeds with its variance; the bands' centres; seconds that all of it took."""
    from validation.picture import mean_of, read_lamina

    began = perf_counter()
    pictures = []
    each = max(spp // seeds, 1)
    for seed in range(1, seeds + 1):
        stem = work / f"lamina-{seed}"
        lamina(program, "render", scene, "--spp", each, "--seed", seed, "--out", stem)
        picture, bands = read_lamina(Path(f"{stem}.exr"))
        pictures.append(picture.mean)
    return mean_of(pictures, perf_counter() - began, each * seeds), bands


def compare_scene(folder: Path, options: argparse.Namespace, work: Path):
    """Renders a scene twice and compares; gives the scene's name and the comparison."""
    from lamina.mitsuba import plugins
    from validation import compare, render

    plugins.register()
    scene_file = folder / "scene.toml" if folder.is_dir() else folder
    exported = work / "exported"
    lamina(options.lamina, "export", "mitsuba", scene_file, "--out", exported)
    scene, facts = render.load(exported)
    theirs = render.render(
        scene, len(facts["bands"]), options.mitsuba_spp, options.passes, seed=10_000
    )
    ours, bands = render_lamina(options.lamina, scene_file, options.spp, options.seeds, work)
    centres = [band["center_nm"] for band in facts["bands"]]
    if centres != bands:
        raise RuntimeError(f"exported bands {centres}, rendered bands {bands}")
    return facts["name"], compare.compare(ours, theirs, [f"{band:g}" for band in bands])


def time_scene(folder: Path, options: argparse.Namespace, work: Path) -> str:
    """Seconds that both programs take for one picture at equal samples a pixel."""
    from lamina.mitsuba import plugins
    from validation import render

    plugins.register()
    scene_file = folder / "scene.toml" if folder.is_dir() else folder
    lamina(options.lamina, "export", "mitsuba", scene_file, "--out", work / "exported")
    scene, facts = render.load(work / "exported")
    spp = options.spp or facts["spp"]
    stats = work / "stats.json"
    stem = work / "lamina"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    lamina(options.lamina, "render", scene_file, "--spp", spp, "--out", stem, "--stats", stats)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    our_cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    ours = json.loads(stats.read_text(encoding="utf-8"))
    # The first picture pays for compiling; the second has another seed and the same kernel.
    first = render.render(scene, len(facts["bands"]), spp, 1, seed=1).seconds
    began = process_time()
    second = render.render(scene, len(facts["bands"]), spp, 1, seed=1000).seconds
    their_cpu = process_time() - began
    return (
        f"{facts['name']}, {facts['width']} × {facts['height']} at {spp} spp: "
        f"Lamina {ours['seconds']:.1f} s ({ours['build_seconds']:.1f} s of it to build, "
        f"{our_cpu:.1f} s of processor time); Mitsuba ({options.variant}) {second:.1f} s "
        f"({their_cpu:.1f} s of processor time; {first:.1f} s with compilation)"
    )


def main() -> int:
    """Compares every scene; 0 if all checks hold, 2 if there is no program."""
    options = arguments()
    if not options.lamina.is_file():
        print(
            f"reference/compare: there is no program {options.lamina}: "
            "build it with cargo build --release, or name it by --lamina or LAMINA",
            file=sys.stderr,
        )
        return 2
    options.variant = variant.choose(options.variant)
    from validation import tables

    if options.record:
        options.results = ROOT / "reference" / "results"
    scenes = options.scenes or [ROOT / "scenes" / name for name in SCENES]
    if options.time:
        for folder in scenes:
            with tempfile.TemporaryDirectory(prefix="lamina-compare-") as scratch:
                print(time_scene(folder, options, Path(scratch)), flush=True)
        return 0
    options.spp = options.spp or 1024
    options.results.mkdir(parents=True, exist_ok=True)
    checks = {True: 0, False: 0}
    for folder in scenes:
        with tempfile.TemporaryDirectory(prefix="lamina-compare-") as scratch:
            work = options.work / folder.stem if options.work else Path(scratch)
            work.mkdir(parents=True, exist_ok=True)
            name, result = compare_scene(folder, options, work)
        # Names come from a scene file, which may hold anything: only a plain one names a file.
        stem = "".join(c if c.isalnum() or c in "-_" else "-" for c in name)
        text = tables.table(name, result, options.variant)
        print(text, flush=True)
        (options.results / f"{stem}.md").write_text(text + "\n", encoding="utf-8")
        data = {"scene": name, "variant": options.variant, **result.as_json()}
        (options.results / f"{stem}.json").write_text(
            json.dumps(data, indent=1) + "\n", encoding="utf-8"
        )
        result.write_pictures(options.results, stem)
        for criterion, held in result.checks().items():
            checks[held] += 1
            if not held:
                print(f"FAIL  {name}: {criterion}", file=sys.stderr)
    print(f"comparison with Mitsuba: {checks[True]} passed, {checks[False]} failed")
    return 1 if checks[False] else 0


if __name__ == "__main__":
    sys.exit(main())
