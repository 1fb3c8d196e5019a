"""Compares Lamina with its peers on six leaf scenes: `reference/bench/run`.

Makes the peers' environments and the scenes, renders everything in turn, checks that the means
agree, and writes one table (`bench.md`, `bench.json`) and a chart of error against time for each
scene (`bench-SCENE.svg`).
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from datetime import UTC, datetime
from pathlib import Path

from . import campaign, environments, machine, report, scenes, svg, write
from .programs import programs

ROOT = environments.ROOT
OUT = ROOT / "out" / "bench"
RESULTS = ROOT / "reference" / "results"
LADDER = (4, 16, 64)
QUICK_LADDER = (4, 16)
QUICK_SIZE = 128
# Smaller pictures have no pixel that shows nothing but leaf.
LEAST_SIZE = 32


def arguments() -> argparse.Namespace:
    """What is to be done."""
    scene_names = [setting.name for setting in scenes.all_settings()]
    program_names = [program.name for program in programs(Path("lamina"))]
    parser = argparse.ArgumentParser(
        prog="reference/bench/run", description=__doc__,
        epilog="Other commands: reference/bench/rates (rays per second against Embree), "
        "reference/bench/measure (Lamina alone on one scene, for tuning).",
    )  # fmt: skip
    parser.add_argument(
        "--scenes",
        nargs="+",
        choices=scene_names,
        default=scene_names,
        metavar="SCENE",
        help=f"some of: {', '.join(scene_names)}",
    )
    parser.add_argument(
        "--programs",
        nargs="+",
        choices=program_names,
        default=program_names,
        metavar="PROGRAM",
        help=f"some of: {', '.join(program_names)}",
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help=f"{QUICK_SIZE} × {QUICK_SIZE} pixels at {QUICK_LADDER} spp: shows "
        "that the harness works; its figures are not to be quoted",
    )
    parser.add_argument("--size", type=int, default=None, help="pixels of each side (512)")
    parser.add_argument(
        "--spp", type=int, nargs="+", default=None, help="samples a pixel (4 16 64)"
    )
    parser.add_argument("--seeds", type=int, default=3, help="rounds, at least 3 (3)")
    parser.add_argument(
        "--limit",
        type=float,
        default=900.0,
        help="seconds after which a program is stopped on a scene (900)",
    )
    parser.add_argument(
        "--clock",
        choices=("wall", "cpu"),
        default="wall",
        help="what seconds are: wall, or processor seconds over the number of processors, for a "
        "machine that is not idle (wall)",
    )
    parser.add_argument("--lamina", type=Path, default=ROOT / "target" / "release" / "lamina")
    parser.add_argument("--results", type=Path, default=None,
                        help="where the table goes: reference/results if everything is run, "
                        "else out/bench")  # fmt: skip
    options = parser.parse_args()
    whole = len(options.scenes) == len(scene_names) and len(options.programs) == len(program_names)
    if options.results is None:
        options.results = RESULTS if whole and not options.quick else OUT
    options.size = options.size or (QUICK_SIZE if options.quick else scenes.SIZE[0])
    options.spp = sorted(set(options.spp or (QUICK_LADDER if options.quick else LADDER)))
    if options.seeds < campaign.statistics.LEAST_SEEDS:
        parser.error(f"--seeds {options.seeds}: at least {campaign.statistics.LEAST_SEEDS}")
    if options.size < LEAST_SIZE:
        parser.error(f"--size {options.size}: at least {LEAST_SIZE}")
    if not options.limit > 0.0:
        parser.error(f"--limit {options.limit}: above 0")
    if options.spp[0] < 2:
        parser.error(f"--spp {options.spp[0]}: at least 2")
    if not options.lamina.exists():
        parser.error(f"--lamina {options.lamina}: there is no such program; cargo build --release")
    return options


def main() -> int:
    """Runs the campaign; 1 if Lamina's means disagree with the others' anywhere."""
    options = arguments()
    about = machine.facts(ROOT)
    plan = campaign.Plan(tuple(options.spp), options.seeds, options.limit, options.clock)
    size = (options.size, options.size)
    chosen = [one for one in programs(options.lamina) if one.name in options.programs]
    results: dict = {
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
        "machine": about,
        "plan": {
            "size": size,
            "ladder": plan.ladder,
            "seeds": plan.seeds,
            "clock": plan.clock,
        },
        "scenes": [],
    }
    for one in chosen:
        # Environments are made before anything is measured; what is missing is told in the table.
        try:
            one.make()
        except environments.Unavailable as reason:
            print(f"{one.name}: {reason}", file=sys.stderr)
    options.results.mkdir(parents=True, exist_ok=True)
    for file in write.write_all(OUT / "scenes", options.scenes, size):
        folder = file.parent
        work = OUT / "work" / folder.name
        shutil.rmtree(work, ignore_errors=True)
        found = campaign.measure(folder, chosen, plan, work, options.lamina)
        title = json.loads(file.read_text(encoding="utf-8"))["title"]
        rows = campaign.facts(found, plan, lambda text: print(text, file=sys.stderr))
        results["scenes"].append({"name": folder.name, "title": title, "programs": rows})
        lines = [(row["title"].replace(" (Eradiate's build)", ""), points_of(row)) for row in rows]
        chart = options.results / f"bench-{folder.name}.svg"
        chart.write_text(svg.plot(title, lines, campaign.CLOCKS[plan.clock]), encoding="utf-8")
        # Written after every scene: a run that is stopped leaves what it has measured.
        (options.results / "bench.json").write_text(
            json.dumps(results, indent=1) + "\n", encoding="utf-8"
        )
        (options.results / "bench.md").write_text(report.page(results), encoding="utf-8")
        for pictures in work.glob("*.npy"):
            pictures.unlink()
    print(options.results / "bench.md")
    ours = [row for scene in results["scenes"] for row in scene["programs"]
            if row["program"] == "lamina"]  # fmt: skip
    return 1 if any(not row["agrees"] for row in ours) else 0


def points_of(row: dict) -> list[tuple[float, float]]:
    """Seconds and error of everything that was measured of a program whose means agree."""
    if not row["agrees"]:
        return []
    points = [*row["points"], *([row["equal_time"]] if row["equal_time"] else [])]
    return [(at["seconds"], at["rel_mse"]) for at in points]


if __name__ == "__main__":
    sys.exit(main())
