"""What is wrong with a scene file or a file of leaves."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from lamina.program import Folders, LaminaError, Value, allowing, overrides, run

HEAD = re.compile(r"^(error|warning)\[(?P<code>[\w:]+)\]: (?P<text>.*)$")
PLACE = re.compile(r"^\s*--> (?P<file>.*?)(?::(?P<line>\d+):(?P<column>\d+))?$")
HELP = re.compile(r"^\s*= help: (?P<help>.*)$")


@dataclass(frozen=True)
class Problem:
    """One error of a file."""

    code: str
    """Which kind, such as `scene::wrong_type`."""
    text: str
    """What is wrong."""
    file: str
    """The file, or the flag that set the value."""
    line: int | None
    """From 1; None if it belongs to no line."""
    column: int | None
    """From 1; None if it belongs to no line."""
    help: str
    """What would be right."""


def check(
    scene: str | Path, values: Mapping[str, Value] | None = None, *, allow: Folders = ()
) -> list[Problem]:
    """All errors of a scene, or of a file of leaves; an empty list if there are none.

    `values` sets keys as `lamina check -D` does; `allow` is as in `render`. Raises LaminaError for
    a call that the program does not understand, and for whatever is no error of the file.
    """
    try:
        run(["check", str(scene), *overrides("-D", values), *allowing(allow)])
    except LaminaError as failure:
        problems = problems_of(str(failure))
        if not problems:
            raise
        return problems
    return []


def problems_of(text: str) -> list[Problem]:
    """The errors in what the program printed."""
    found: list[Problem] = []
    told: dict[str, str | None] = {}

    def finish() -> None:
        if told:
            line, column = told.get("line"), told.get("column")
            found.append(
                Problem(
                    code=told["code"] or "",
                    text=told["text"] or "",
                    file=told.get("file") or "",
                    line=int(line) if line else None,
                    column=int(column) if column else None,
                    help=told.get("help") or "",
                )
            )

    for row in text.splitlines():
        if head := HEAD.match(row):
            finish()
            told = dict(head.groupdict())
        elif told:
            if (place := PLACE.match(row)) and "file" not in told:
                told |= place.groupdict()
            elif (words := HELP.match(row)) and "help" not in told:
                told |= words.groupdict()
    finish()
    return found
