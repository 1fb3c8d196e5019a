"""Rays per second on one thread, Lamina against Embree ray by ray: `reference/bench/rates`.

Three geometries: 300 leaves in one mesh, one leaf of 504,000 triangles close up, 10,000 instances;
leaves alone. Both programs read the same rays, which start at what the camera sees: bounces
(closest hit, cosine-distributed to either side) and occlusion rays (any hit, to the sky). Programs
take turns. Hits must agree in number to 1e-4, or no rate is printed. `README.md` has the format of
the files and the command line that Lamina's side has to have.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from . import environments, leaf, machine, scenes, write
from .environments import Unavailable

ROOT = environments.ROOT
OUT = ROOT / "out" / "bench" / "rays"
RESULTS = ROOT / "reference" / "results"
KINDS = (("bounces", "closest"), ("occlusion", "occluded"))
# By wall, and by the thread's processor time, which only some programs tell.
FIGURES = ("mrays_per_s", "mrays_per_cpu_s")
# Hits of two programs may differ by this share: without its robust flag Embree loses a few.
AGREEMENT = 1e-4


def settings() -> list[scenes.Setting]:
    """The three geometries, under names of their own."""
    known = {setting.name: setting for setting in scenes.all_settings()}
    # The camera goes nearer, so that the fine leaf fills the picture.
    near = replace(known["close-sun"].camera, vertical_fov_deg=12.0)
    return [
        replace(known["mesh-sun"], name="mesh", title="300 leaves in one mesh"),
        replace(known["close-sun"], name="fine", title="one leaf of 504,000 triangles", camera=near,
                quads=leaf.FINE),
        replace(known["instances-sun"], name="instances", title="10,000 instances"),
    ]  # fmt: skip


def write_rays(setting: scenes.Setting, folder: Path, tracer: Path, per_pixel: int) -> None:
    """Writes a geometry's folder with its two files of rays."""
    write.write_scene(setting, folder)
    subprocess.run([str(tracer), "rays", str(folder), str(per_pixel), str(folder)], check=True)


def ask(command: list[str]) -> dict:
    """Runs a program of the documented command line and reads its line of JSON."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        words = (done.stderr or done.stdout).strip().splitlines() or ["no message"]
        raise Unavailable(f"`{Path(command[0]).name}` ended with {done.returncode}: {words[-1]}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def commands(options: argparse.Namespace, tracer: Path) -> dict[str, list[str]]:
    """How each program is started, without its arguments."""
    lamina = ["cargo", "bench", "--quiet", "--manifest-path", str(ROOT / "Cargo.toml"),
              "-p", "lamina-benches", "--bench", "traversal", "--"]  # fmt: skip
    if options.traversal:
        lamina = [str(options.traversal)]
    return {
        "Lamina": lamina,
        "Embree": [str(tracer), "rates"],
        "Embree, robust": [str(tracer), "rates"],
    }


def measure(folder: Path, options: argparse.Namespace, tracer: Path) -> dict:
    """Rates of all programs on one geometry: medians over rounds, and what was hit."""
    found: dict = {}
    missing: dict[str, str] = {}
    for rays, query in KINDS:
        answers: dict[str, list[dict]] = {}
        for _ in range(options.rounds):
            for name, command in commands(options, tracer).items():
                if name in missing:
                    continue
                words = [str(folder / "leaf.ply"), str(folder / "placements.f32"),
                         str(folder / f"{rays}.rays"), query]  # fmt: skip
                if name != "Lamina":
                    words.append("robust" if "robust" in name else "fast")
                try:
                    answer = ask([*command, *words, "1"])
                except Unavailable as reason:
                    missing[name] = str(reason)
                    continue
                answers.setdefault(name, []).append(answer)
        found[rays] = {
            name: {
                **{
                    key: float(np.median([one[key][0] for one in of_program]))
                    for key in FIGURES
                    if key in of_program[0]
                },
                "rays": of_program[0]["rays"],
                "hits": of_program[0]["hits"],
                "sum_of_t": of_program[0]["sum_of_t"],
            }
            for name, of_program in answers.items()
        }
    return {"rates": found, "missing": missing}


def row(title: str, rays: str, answers: dict) -> str:
    """One line of the table."""
    robust = answers["Embree, robust"]
    cells = [f"{title}, {rays}", f"{robust['rays']}", f"{robust['hits']}"]
    # Processor time if everybody tells it.
    figure = FIGURES[1] if all(FIGURES[1] in one for one in answers.values()) else FIGURES[0]
    for name in ("Lamina", "Embree", "Embree, robust"):
        one = answers.get(name)
        if one is None:
            cells.append("–")
        elif abs(one["hits"] - robust["hits"]) > AGREEMENT * robust["rays"]:
            cells.append(f"**hits {one['hits']}: differs**")
        else:
            cells.append(f"{one[figure]:.2f}")
    try:
        cells.append(f"**{float(cells[3]) / float(cells[4]):.2f}**")
    except ValueError:
        cells.append("–")
    return f"| {' | '.join(cells)} |"


def page(results: dict) -> str:
    """The table."""
    about = results["machine"]
    lines = [
        "# Rays per second",
        "",
        "Written by `reference/bench/rates`; `reference/bench/README.md` says how.",
        "",
        f"{about['processor']}, one thread; load {about['load_before']:.1f} before the start; "
        f"Embree 4.4.0, `rtcIntersect1` and `rtcOccluded1`; Lamina at commit {about['commit']}; "
        f"{results['date']}. Millions of rays per second of the thread's processor time, or of "
        f"wall where a program does not tell the former; medians of {results['rounds']} rounds.",
        "",
        *machine.warning(about),
        "| geometry, rays | rays | hits | Lamina | Embree | Embree, robust | Lamina over Embree |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    notes: dict[str, None] = {}
    for geometry in results["geometries"]:
        for rays, answers in geometry["rates"].items():
            lines.append(row(geometry["title"], rays, answers))
        for name, reason in geometry["missing"].items():
            notes[f"- {name}: {reason}"] = None
    return "\n".join([*lines, *([""] if notes else []), *notes]) + "\n"


def main() -> int:
    """Writes the rays, measures, and writes the table."""
    parser = argparse.ArgumentParser(prog="reference/bench/rates", description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--per-pixel", type=int, default=4, help="rays of each kind a pixel (4)")
    parser.add_argument("--traversal", type=Path, default=None,
                        help="Lamina's side, instead of cargo bench --bench traversal")  # fmt: skip
    parser.add_argument("--rays-only", type=Path, default=None, metavar="FOLDER",
                        help="write geometry and rays there and stop")  # fmt: skip
    parser.add_argument("--results", type=Path, default=RESULTS)
    options = parser.parse_args()
    about = machine.facts(ROOT)
    try:
        tracer = environments.tracer()
    except Unavailable as reason:
        print(f"reference/bench/rates: Embree {reason}", file=sys.stderr)
        return 1
    results: dict = {
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
        "machine": about,
        "rounds": options.rounds,
        "geometries": [],
    }
    for setting in settings():
        folder = (options.rays_only or OUT) / setting.name
        write_rays(setting, folder, tracer, options.per_pixel)
        if options.rays_only:
            print(folder)
            continue
        found = measure(folder, options, tracer)
        results["geometries"].append({"name": setting.name, "title": setting.title, **found})
    if not options.rays_only:
        options.results.mkdir(parents=True, exist_ok=True)
        text = json.dumps(results, indent=1) + "\n"
        (options.results / "bench-rates.json").write_text(text, encoding="utf-8")
        (options.results / "bench-rates.md").write_text(page(results), encoding="utf-8")
        print(options.results / "bench-rates.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
