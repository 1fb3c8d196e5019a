"""What the figures were measured on."""

from __future__ import annotations

import os
import platform
import subprocess
from pathlib import Path

# Load of a machine that does nothing else.
IDLE = 0.3


def _line(file: str, key: str) -> str:
    """The value of the first line of a `key : value` file, or nothing."""
    try:
        text = Path(file).read_text(encoding="utf-8")
    except OSError:
        return ""
    return next(
        (line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith(key)), ""
    )


def commit(root: Path) -> str:
    """The commit that is checked out, marked if files differ from it."""
    done = subprocess.run(
        ["git", "-C", str(root), "describe", "--always", "--dirty", "--abbrev=10"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.stdout.strip() or "unknown"


def facts(root: Path) -> dict:
    """Processor, memory, system, and the load before anything was started."""
    memory = _line("/proc/meminfo", "MemTotal").split()
    flags = _line("/proc/cpuinfo", "flags").split()
    return {
        "processor": _line("/proc/cpuinfo", "model name") or platform.processor(),
        "processors": os.cpu_count(),
        "vectors": [name for name in ("avx2", "avx512f") if name in flags],
        "memory_gib": round(int(memory[0]) / 1048576, 1) if memory else None,
        "system": f"{platform.system()} {platform.release()}, Python {platform.python_version()}",
        "load_before": os.getloadavg()[0],
        "commit": commit(root),
    }


def warning(about: dict) -> list[str]:
    """Lines of Markdown that say so if others used the machine too."""
    if about["load_before"] <= IDLE:
        return []
    return [
        "**The machine was not idle when this was measured: wall seconds are worth little, "
        "processor seconds somewhat more.**",
        "",
    ]
