"""Parts of the package that need more than the package itself does, and what they need.

`require` comes before any work, so that nothing is rendered for a call that cannot end well.
"""

from __future__ import annotations

from importlib.util import find_spec

from lamina.program import LaminaError

DISTRIBUTION = "lamina-render"
# By the name of the extra: the modules that must be there. `pyproject.toml` names their packages.
MODULES = {
    "graph": ("networkx",),
    "sweep": ("zarr", "distributed", "tqdm"),
    "report": ("jinja2",),
    "netcdf": ("scipy",),
    "denoise": ("mitsuba_oidn", "scipy"),
    "print": ("mitsuba_oidn", "scipy"),
    "mitsuba": ("mitsuba", "scipy"),
    "scans": ("scipy",),
    "usd": ("pxr",),
}


def require(extra: str, what: str) -> None:
    """Raises LaminaError, with the command that helps, if a module of an extra is missing.

    `what` is the part of the package that needs it, the subject of the message.
    """
    missing = [name for name in MODULES[extra] if find_spec(name) is None]
    if missing:
        command = f"pip install '{DISTRIBUTION}[{extra}]'"
        raise LaminaError(f"{what} needs {' and '.join(missing)}: {command}", 1)
