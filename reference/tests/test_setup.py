"""`reference/setup` and `reference/run`, with a stand-in for Python that downloads nothing."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

REFERENCE = Path(__file__).resolve().parents[1]
# Makes an environment whose Python runs nothing but does what FAILS says.
PYTHON = """#!/bin/sh
case "$1 $2" in
    "-m venv")
        mkdir -p "$3/bin"
        printf '#!/bin/sh\\ntest -z "$FAILS"\\n' > "$3/bin/python"
        chmod +x "$3/bin/python" ;;
esac
"""


@pytest.fixture
def python(tmp_path: Path) -> Path:
    """The stand-in."""
    file = tmp_path / "python"
    file.write_text(PYTHON)
    file.chmod(0o755)
    return file


def setup(python: Path, venv: Path, fails: str = "") -> subprocess.CompletedProcess[str]:
    """Runs the script."""
    variables = {"PYTHON": str(python), "LAMINA_VENV": str(venv), "FAILS": fails}
    return subprocess.run(
        [REFERENCE / "setup"], env=os.environ | variables, capture_output=True, text=True
    )


def files(folder: Path) -> set[str]:
    """Every file of a folder."""
    return {str(file.relative_to(folder)) for file in folder.rglob("*")}


def test_an_environment_is_made_once(python: Path, tmp_path: Path) -> None:
    venv = tmp_path / "a b" / "venv"
    first = setup(python, venv)
    assert first.returncode == 0 and first.stdout == f"{venv}/bin/python\n", first.stderr
    (venv / "mine").touch()
    assert setup(python, venv).stdout == first.stdout
    assert (venv / "mine").exists()
    # Other packages are wanted: it is made again, from nothing.
    (venv / "requirements.sha256").write_text("of earlier packages\n")
    assert setup(python, venv).stdout == first.stdout
    assert files(venv) == {"bin", "bin/python", "requirements.sha256"}


def test_a_folder_of_somebody_else_is_left_as_it_is(python: Path, tmp_path: Path) -> None:
    for name, file in (("home", "thesis.tex"), ("venv", "bin/python")):
        folder = tmp_path / name
        (folder / file).parent.mkdir(parents=True)
        (folder / file).write_text("mine")
        before = files(folder)
        done = setup(python, folder)
        assert done.returncode == 1 and done.stdout == ""
        assert f"{folder} was not made by this script" in done.stderr
        assert "LAMINA_VENV" in done.stderr and done.stderr.count("\n") == 1
        assert files(folder) == before and (folder / file).read_text() == "mine"
    # A file is no folder, and an empty folder is nobody's.
    done = setup(python, tmp_path / "home" / "thesis.tex")
    assert done.returncode == 1 and (tmp_path / "home" / "thesis.tex").read_text() == "mine"
    (tmp_path / "empty").mkdir()
    assert setup(python, tmp_path / "empty").returncode == 0


def test_an_environment_that_failed_is_not_taken_for_a_finished_one(
    python: Path, tmp_path: Path
) -> None:
    venv = tmp_path / "venv"
    for _ in range(2):
        assert setup(python, venv, fails="no network").returncode != 0
        assert (venv / "requirements.sha256").read_text() == "unfinished\n"
    assert setup(python, venv).returncode == 0
    (venv / "requirements.sha256").write_text("of earlier packages\n")
    assert setup(python, venv, fails="no network").returncode != 0
    assert (venv / "requirements.sha256").read_text() == "unfinished\n"
    # One that is finished is not touched if the Python that could make another is too old.
    assert setup(python, venv).returncode == 0
    (venv / "requirements.sha256").write_text("of earlier packages\n")
    assert setup(Path("/bin/false"), venv).returncode == 1
    assert (venv / "requirements.sha256").read_text() == "of earlier packages\n"


def run(*words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Runs a command by its name."""
    return subprocess.run(
        [REFERENCE / "run", *words], env=os.environ | variables, capture_output=True, text=True
    )


def test_every_command_has_a_module_and_a_line() -> None:
    lines = run().stdout.splitlines()[1:]
    names = {line.split()[0] for line in lines}
    assert {"compare", "denoise", "noise", "print", "slabs", "rami"} <= names
    assert all(len(line.split()) > 3 for line in lines), lines
    rows = [row.split("|") for row in (REFERENCE / "run").read_text().splitlines()]
    modules = [row[1] for row in rows if len(row) == 5 and row[0] in names]
    assert len(modules) == len(names) == len(lines)
    for module in modules:
        assert (REFERENCE / Path(*module.split("."))).with_suffix(".py").is_file(), module


def test_an_unknown_command_is_refused_with_the_names() -> None:
    done = run("denoize")
    assert done.returncode == 2 and done.stdout == ""
    assert "there is no command denoize" in done.stderr and "  denoise " in done.stderr


def test_a_missing_program_is_reported_before_an_environment_is_made(tmp_path: Path) -> None:
    there = {"LAMINA": "/no/such/lamina", "LAMINA_NOTEBOOKS_VENV": str(tmp_path / "venv")}
    done = run("notebooks", **there)
    assert done.returncode == 1 and "there is no program /no/such/lamina" in done.stderr
    assert done.stderr.count("\n") == 1 and not (tmp_path / "venv").exists()
