"""Where the program is: the variable `LAMINA` if it is set, else cargo's release build."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def program() -> Path:
    """The `lamina` to run; it need not be there."""
    named = os.environ.get("LAMINA")
    target = os.environ.get("CARGO_TARGET_DIR") or ROOT / "target"
    return Path(named) if named else Path(target) / "release" / "lamina"
