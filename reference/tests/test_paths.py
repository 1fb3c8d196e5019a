"""Walks paths of the book as a reader does.

Each text that a page says to save is saved, each command is run, and every line that the page shows
of what comes out must come out: its words in this order in a line that a command printed, or in a
table that it wrote. Pages may leave out columns and lines, and change nothing.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from validation.program import program

ROOT = Path(__file__).resolve().parents[2]
GUIDE = ROOT / "docs" / "src" / "guide"

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SAVE = re.compile(r"[Ss]ave (?:this|it|them) as ((?:`[^`]+`(?:,? and )?)+)")
SAYS = re.compile(r"(?:program says|prints) `([^`]+)`")
PICTURE = re.compile(r"\[[^\]]*\]\(([\w-]+\.png)\)")


def words_of(line: str) -> list[str]:
    """Words without the commas behind them."""
    return [word.rstrip(",") for word in line.split()]


def follows(words: list[str], line: list[str]) -> bool:
    """Whether `words` stand in `line` in their order, others perhaps between them."""
    rest = iter(line)
    return all(word in rest for word in words)


def walk(page: str) -> None:
    """Does what a page says, in an empty folder, and holds what comes out against what it shows."""
    text = (GUIDE / page).read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryDirectory() as programs:
        folder = Path(name)
        Path(programs, "lamina").symlink_to(program().resolve())
        # Pages say python3: that of this environment, which has matplotlib.
        here = str(Path(sys.executable).parent)
        paths = os.pathsep.join([programs, here, os.environ["PATH"]])
        for picture in PICTURE.findall(text):
            shutil.copy(GUIDE / picture, folder)
        out: list[list[str]] = []
        missing: list[str] = []
        files: list[str] = []
        commands, shown, at = 0, 0, 0

        def expect(lines: list[str]) -> None:
            tables = [table.read_text(encoding="utf-8") for table in folder.glob("*.csv")]
            known = out + [words_of(line) for table in tables for line in table.splitlines()]
            missing.extend(
                line for line in lines if not any(follows(words_of(line), words) for words in known)
            )

        for block in BLOCK.finditer(text):
            said = " ".join(text[at : block.start()].split())
            expect(SAYS.findall(said))
            shown += len(SAYS.findall(said))
            for names in SAVE.findall(said):
                files += re.findall(r"`([^`]+)`", names)
            at = block.end()
            language, body = block.groups()
            if language == "sh":
                commands += 1
                done = subprocess.run(
                    ["bash", "-e", "-o", "pipefail", "-c", body],
                    cwd=folder,
                    env={**os.environ, "PATH": paths, "MPLBACKEND": "Agg"},
                    capture_output=True,
                    text=True,
                )
                if done.returncode:
                    raise AssertionError(f"{page}: {body}ended with:\n{done.stderr}")
                out += [words_of(line) for line in (done.stdout + done.stderr).splitlines()]
            elif language == "text" and files:
                Path(folder, files.pop(0)).write_text(body, encoding="utf-8")
            elif language == "text":
                lines = [line for line in body.splitlines() if line.strip()]
                shown += len(lines)
                expect(lines)
        expect(SAYS.findall(" ".join(text[at:].split())))
    assert not missing, f"{page}: nothing printed or wrote\n" + "\n".join(missing)
    assert commands >= 3 and shown >= 10, f"{page}: {commands} commands, {shown} lines shown"


@pytest.mark.deep
def test_the_biologists_path_leads_where_its_page_says() -> None:
    walk("biologist.md")


@pytest.mark.deep
def test_growth_is_fitted_to_a_leaf_as_the_page_says() -> None:
    walk("fit.md")
