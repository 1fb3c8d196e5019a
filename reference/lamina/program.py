"""Finding and running the program."""

from __future__ import annotations

import json
import os
import shutil
import sysconfig
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from subprocess import PIPE, Popen
from typing import IO, Any

import numpy as np

Value = (
    bool
    | int
    | float
    | str
    | os.PathLike[str]
    | np.generic
    | np.ndarray[Any, Any]
    | Sequence["Value"]
    | Mapping[str, "Value"]
)
"""What a key of a scene or leaf file may be set to: arrays are lists, paths are text."""

Folders = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]
"""Folders outside of a scene's own whose files it may name: one, or several."""


class LaminaError(RuntimeError):
    """The program refused or failed; its text is what it printed.

    `code` is its exit status: 2 for what was wrong in the input or the call, 1 for a system that
    failed (a full disk), 130 for an interrupt.
    """

    def __init__(self, text: str, code: int) -> None:
        super().__init__(text, code)
        self.code = code

    def __str__(self) -> str:
        return str(self.args[0])


def program() -> Path:
    """The `lamina` that is run. Raises FileNotFoundError if there is none."""
    named = os.environ.get("LAMINA")
    if named:
        found = shutil.which(named)
        if found is None:
            raise FileNotFoundError(f"the environment variable LAMINA names no program: {named}")
        return Path(found)
    # The wheel's own program is of this package's version; another on the path may be older.
    for folder in (sysconfig.get_path("scripts"), None):
        found = shutil.which("lamina", path=folder)
        if found is not None:
            return Path(found)
    root = Path(__file__).resolve().parents[2]
    built = Path(os.environ.get("CARGO_TARGET_DIR") or root / "target") / "release" / "lamina"
    if built.is_file():
        return built
    raise FileNotFoundError(
        "no program `lamina`: install it (pip install lamina-render), or name it in the "
        "environment variable LAMINA"
    )


def start(
    arguments: Sequence[str | Path], command: str | None = None, stdout: IO[bytes] | int = PIPE
) -> Started:
    """Starts the program, which ends with this process, however this one ends.

    `command` is another machine's program, which is run if this one has it at the same place.
    """
    here = command is not None and Path(command).is_file()
    # A signal at the death of a parent would come at the end of the thread that starts the program;
    # a pipe closes with the process. Python lets no other program inherit its ends.
    reading, held = os.pipe()
    HELD.add(held)
    try:
        process = Popen(
            [command if here and command else program(), "--end-with-stdin", *arguments],
            stdin=reading,
            stdout=stdout,
            stderr=PIPE,
            text=True,
            encoding="utf-8",
        )
    except BaseException:
        let_go(held)
        raise
    finally:
        os.close(reading)
    return Started(process, held)


@dataclass(frozen=True)
class Started:
    """The program, running."""

    process: Popen[str]
    held: int
    """The end of the pipe that keeps it running."""

    def result(self) -> str:
        """What it printed, as `finished` has it."""
        return self.finished()[0]

    def finished(self) -> tuple[str, str]:
        """What it printed, and its notes, once it has ended. Raises LaminaError if it failed.

        Whatever interrupts the waiting ends the program, which saves its work before it leaves.
        """
        try:
            out, told = self.process.communicate()
        finally:
            let_go(self.held)
            self.process.wait()
        if self.process.returncode != 0:
            text = told.strip() or (out or "").strip()
            raise LaminaError(text, self.process.returncode)
        return out, told


HELD: set[int] = set()
"""The ends of pipes that keep programs running, which this process alone may hold."""


def let_go(held: int) -> None:
    """Closes the end of a pipe: the program behind it ends, if it has not yet."""
    if held in HELD:
        HELD.remove(held)
        os.close(held)


def let_all_go() -> None:
    """Closes the pipes in a process that was forked: it would hold what its parent lets go."""
    for held in tuple(HELD):
        let_go(held)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=let_all_go)


def run(arguments: Sequence[str | Path], command: str | None = None) -> str:
    """Runs the program, gives what it printed. Raises LaminaError if it fails.

    `command` is as in `start`.
    """
    return start(arguments, command).result()


def version() -> str:
    """The program's version, such as `0.1.0`."""
    return run(["--version"]).split()[1]


def overrides(flag: str, values: Mapping[str, Value] | None) -> list[str]:
    """Arguments that set keys: `flag` and `KEY=VALUE` for each, values written as in TOML."""
    arguments: list[str] = []
    for key, value in (values or {}).items():
        arguments += [flag, f"{key}={written(key, value)}"]
    return arguments


def options_of(options: Mapping[str, Value]) -> list[str]:
    """Options by their names, with `_` for `-`: those that are True alone, others with a value."""
    words: list[str] = []
    for key, value in options.items():
        flag = f"--{key.replace('_', '-')}"
        if value is True:
            words.append(flag)
        elif value is not False and value is not None:
            words += [flag, str(value)]
    return words


def allowing(folders: Folders) -> list[str]:
    """Arguments that let documents name files in folders, whichever folder a worker is in."""
    several = [folders] if isinstance(folders, str | os.PathLike) else folders
    return [word for folder in several for word in ("--allow", str(Path(folder).absolute()))]


def written(key: str, value: Value) -> str:
    """The value of a key as TOML. Raises TypeError, with the key, for what TOML does not have."""
    try:
        return toml(value)
    except TypeError as refused:
        raise TypeError(f"{key} cannot be set to {refused}") from None


def toml(value: Value) -> str:
    """A value as TOML has it, on one line; the program refuses numbers that are not finite."""
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            # Every escape of JSON is one of TOML, which also wants one for DEL.
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case os.PathLike():
            return toml(os.fspath(value))
        case Mapping():
            members = ", ".join(f"{toml(str(key))} = {toml(inner)}" for key, inner in value.items())
            return "{ " + members + " }"
        # Numbers of more than 64 bits stay as they are when they are converted.
        case np.ndarray() | np.generic() if value.dtype != np.longdouble:
            return toml(value.tolist())
        case Sequence() if not isinstance(value, bytes | bytearray | memoryview):
            return "[" + ", ".join(toml(inner) for inner in value) + "]"
        case int() | float():
            return repr(value)
    raise TypeError(
        f"{value!r}: take numbers, truths, text, paths, or arrays, lists, tables of these"
    )
