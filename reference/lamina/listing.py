"""The tasks of a sweep as the program lists them, kept as a file that workers read."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lamina.program import Folders, Value, allowing, overrides, start, written


@dataclass(frozen=True)
class Listing:
    """A sweep's tasks; the first line of the file tells what they share."""

    file: Path
    kind: str
    """`render` or `grow`."""
    version: str
    """The program's, without which no bytes are promised."""
    keys: list[dict[str, Any]]
    """`key` and `unit` (or None) of what is varied."""
    ids: list[int]
    columns: dict[str, list[Value]]
    """The values of each key, by task."""
    offsets: list[int]
    """Where each task's line begins in the file, bytes."""


def flags(
    over: Mapping[str, Sequence[Value]] | None,
    seeds: int | None,
    values: Mapping[str, Value] | None,
    spp: int | None,
    noise: float | None,
    allow: Folders,
) -> list[str]:
    """What a call adds to a sweep file, as flags of `lamina sweep`."""
    words = [*overrides("-D", values), *allowing(allow)]
    for key, members in (over or {}).items():
        words += ["--over", f"{key}={','.join(written(key, member) for member in members)}"]
    for flag, value in (("--seeds", seeds), ("--spp", spp), ("--noise", noise)):
        if value is not None:
            words += [flag, str(value)]
    return words


def list_tasks(what: str | Path, words: Sequence[str], file: Path) -> Listing:
    """Lets the program list a sweep into `file`. Raises LaminaError for what it refuses."""
    folder = file.parent
    with tempfile.NamedTemporaryFile(dir=folder, prefix=f".{file.name}-", delete=False) as out:
        try:
            start(["sweep", str(what), *words, "--list"], stdout=out).result()
            Path(out.name).replace(file)
        except BaseException:
            Path(out.name).unlink(missing_ok=True)
            raise
    return read(file)


def read(file: Path) -> Listing:
    """The listing that a file holds."""
    ids: list[int] = []
    offsets: list[int] = []
    with file.open("rb") as lines:
        about = json.loads(lines.readline())
        columns: dict[str, list[Value]] = {key["key"]: [] for key in about["keys"]}
        while True:
            offset = lines.tell()
            line = lines.readline()
            if not line:
                break
            task = json.loads(line)
            offsets.append(offset)
            ids.append(int(task["id"], 16))
            for key, column in columns.items():
                column.append(task["values"][key])
    return Listing(file, about["kind"], about["program"], about["keys"], ids, columns, offsets)


def tasks_at(file: str | os.PathLike[str], offset: int, count: int) -> list[dict[str, Any]]:
    """Some tasks from the place of the first one."""
    with Path(file).open("rb") as lines:
        lines.seek(offset)
        return [json.loads(lines.readline()) for _ in range(count)]
