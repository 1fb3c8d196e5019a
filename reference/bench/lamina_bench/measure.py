"""Measures Lamina alone on one or more scenes: error, seconds, efficiency.

For tuning: `reference/bench/measure scene.toml --spp 64 --seeds 3 --lamina target/release/lamina`.
The error is relative to `reference.npy` beside the scene if there is one, else to the mean of the
pictures themselves (a little too small then, for all versions of the program alike).
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from . import lamina, statistics

ROOT = Path(__file__).resolve().parents[3]


def main() -> None:
    """Prints one line a scene."""
    parser = argparse.ArgumentParser(prog="reference/bench/measure", description=__doc__)
    parser.add_argument("scenes", nargs="+", type=Path, help="scene files or their folders")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--lamina", type=Path, default=ROOT / "target" / "release" / "lamina")
    parser.add_argument("-D", dest="overrides", action="append", default=[], metavar="KEY=VALUE")
    options = parser.parse_args()
    print(
        f"{'scene':16} {'spp':>5} {'relMSE':>10} {'x spp':>8} {'wall s':>8} {'cpu s':>8} "
        f"{'1/(relMSE wall)':>16} {'1/(relMSE cpu/2)':>17} {'Mpaths/s':>9}  mean R G B"
    )
    for scene in options.scenes:
        file = scene / "scene.toml" if scene.is_dir() else scene
        overrides = tuple(options.overrides)
        start = lamina.render(options.lamina, file, 1, 0, overrides)
        runs = [
            lamina.render(options.lamina, file, options.spp, seed, overrides)
            for seed in range(1, options.seeds + 1)
        ]
        pictures = np.stack([run.rgb for run in runs])
        known = file.parent / "reference.npy"
        own = pictures.mean(axis=0)
        truth = np.load(known) if known.exists() else own
        if truth.shape != own.shape:
            truth = own
        error = statistics.rel_mse(pictures, truth)
        wall = float(np.median([run.wall_s for run in runs]))
        cpu = float(np.median([run.cpu_s for run in runs]))
        cpu = lamina.cpu_of_render(cpu, start.cpu_s, options.spp)
        paths = np.median([run.stats["mpaths_per_s"] for run in runs])
        red, green, blue = pictures.mean(axis=(0, 1, 2))
        print(
            f"{file.parent.name:16} {options.spp:5d} {error:10.5f} {error * options.spp:8.4f} "
            f"{wall:8.2f} {cpu:8.2f} {statistics.efficiency(error, wall):16.3f} "
            f"{statistics.efficiency(error, 0.5 * cpu):17.3f} {paths:9.3f}  "
            f"{red:.5f} {green:.5f} {blue:.5f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
