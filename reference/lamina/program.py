"""Finding and running the program."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from subprocess import PIPE, Popen
from typing import IO

Value = bool | int | float | str | Sequence["Value"] | Mapping[str, "Value"]
"""What a key of a scene or leaf file may be set to."""


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
    found = shutil.which("lamina")
    if found is not None:
        return Path(found)
    root = Path(__file__).resolve().parents[2]
    built = Path(os.environ.get("CARGO_TARGET_DIR") or root / "target") / "release" / "lamina"
    if built.is_file():
        return built
    raise FileNotFoundError(
        "no program `lamina`: install it (cargo install --path renderer/program), or name it in the "
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
        """What it printed, once it has ended. Raises LaminaError if it failed.

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
        return out


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
        arguments += [flag, f"{key}={toml(value)}"]
    return arguments


def toml(value: Value) -> str:
    """A value as TOML has it, on one line."""
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            escaped = value.replace("\\", "\\\\").replace('"', '\\"')
            for letter, short in (("\n", "\\n"), ("\r", "\\r"), ("\t", "\\t")):
                escaped = escaped.replace(letter, short)
            return f'"{escaped}"'
        case Mapping():
            members = ", ".join(f"{toml(str(key))} = {toml(inner)}" for key, inner in value.items())
            return "{ " + members + " }"
        case Sequence():
            return "[" + ", ".join(toml(inner) for inner in value) + "]"
        case _ if hasattr(value, "item"):
            # A number of NumPy's.
            return toml(value.item())
        case int():
            return str(value)
        case float():
            return repr(value)
    raise TypeError(f"a key cannot be set to {value!r}")
