"""Job arrays without Dask: the templates of `reference/cluster`, with a stand-in for Slurm."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from lamina.program import program, run

ROOT = Path(__file__).resolve().parents[2]
CLUSTER = ROOT / "reference" / "cluster"
FURNACE = ROOT / "scenes" / "furnace" / "scene.toml"
SMALL = ["-D", "film.spectral.size=[12,8]"]

# As Slurm, it does the jobs of an array by their numbers and succeeds whatever becomes of them.
SBATCH = """#!/bin/bash
[[ $1 == --array=* ]] || exit 1
jobs=${1#--array=}
shift
[[ $jobs == *-* ]] && jobs=$(seq -s, "${jobs%-*}" "${jobs#*-}")
for job in ${jobs//,/ }; do
    SLURM_ARRAY_TASK_ID=$job SLURM_CPUS_PER_TASK=1 bash "$@" || echo "$job" >> failed
done
echo "Submitted batch job 1"
"""
# The program, which fails on one node.
LAMINA = """#!/bin/bash
[[ $SLURM_ARRAY_TASK_ID == "$BROKEN" ]] && exit 1
exec "$PROGRAM" "$@"
"""


@pytest.fixture
def slurm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder in which `sbatch` and `lamina` can be called."""
    tools = tmp_path / "bin"
    tools.mkdir()
    for name, text in (("sbatch", SBATCH), ("lamina", LAMINA)):
        (tools / name).write_text(text)
        (tools / name).chmod(0o755)
    monkeypatch.setenv("PROGRAM", str(program()))
    monkeypatch.setenv("PATH", f"{tools}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def sbatch(array: str, script: str, *words: str | Path, broken: str = "") -> None:
    """Submits a template."""
    command = ["sbatch", f"--array={array}", CLUSTER / script, *words]
    subprocess.run(command, env=os.environ | {"BROKEN": broken}, check=True)


def test_a_sweep_is_done_in_parts_and_its_failures_again(slurm: Path) -> None:
    sweep = [FURNACE, *SMALL, "--spp", "2", "--over", "film.spectral.filter_radius_px=0.5,1,1.5"]
    sweep += ["--seeds", "2", "--out"]
    sbatch("0-3", "sweep.sbatch", "4", *sweep, "made", broken="2")
    assert Path("failed").read_text().split() == ["2"]
    assert len(list(Path("made", "tasks").glob("*.exr"))) == 6 - 1
    sbatch("2", "sweep.sbatch", "4", *sweep, "made")
    assert Path("failed").read_text().split() == ["2"]
    run(["sweep", *sweep, "whole"])
    pictures = {file.name: file.read_bytes() for file in Path("whole", "tasks").glob("*.exr")}
    before = {file: file.stat().st_mtime_ns for file in Path("made", "tasks").glob("*.exr")}
    run(["sweep", *sweep, "made"])
    assert {file.name: file.read_bytes() for file in before} == pictures
    assert all(file.stat().st_mtime_ns == time for file, time in before.items())
    assert Path("made", "sweep.csv").read_bytes() == Path("whole", "sweep.csv").read_bytes()


def test_a_render_is_done_in_parts_and_its_failures_again(slurm: Path) -> None:
    words = ["3", FURNACE, "leaf", "7", *SMALL]
    sbatch("0-2", "render.sbatch", *words, broken="1")
    assert Path("failed").read_text().split() == ["1"]
    # Parts that are there are left as they are.
    sbatch("0-2", "render.sbatch", *words)
    assert Path("failed").read_text().split() == ["1"]
    parts = sorted(Path("leaf.parts").iterdir())
    assert [part.name for part in parts] == ["0-2.part", "2-4.part", "4-7.part"]
    run(["merge", *parts, "--out", "leaf"])
    run(["render", FURNACE, *SMALL, "--spp", "7", "--noise", "0", "--out", "whole"])
    assert Path("leaf.exr").read_bytes() == Path("whole.exr").read_bytes()


def test_a_template_without_its_words_says_how_it_is_called(slurm: Path) -> None:
    for script in ("sweep.sbatch", "render.sbatch"):
        done = subprocess.run(
            ["bash", CLUSTER / script], capture_output=True, text=True, check=False
        )
        assert done.returncode != 0 and "sbatch --array=0-" in done.stderr
