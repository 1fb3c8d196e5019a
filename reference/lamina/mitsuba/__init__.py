"""Leaves, lights and maps of Lamina's in Mitsuba 3, for scenes by `lamina export mitsuba`.

    import lamina.mitsuba

    scene = lamina.mitsuba.load("exported/scene.xml")

`load` chooses Mitsuba's variant, unless one is set, and registers all plugins. Done by hand:

    from lamina.mitsuba import variant

    variant.choose()
    import mitsuba as mi
    from lamina.mitsuba import plugins

    plugins.register()
    scene = mi.load_file("exported/scene.xml")

`variant.choose()` comes first: all other modules are bound to the variant that is set when they are
imported.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from lamina.extras import require
from lamina.mitsuba import variant


def load(scene: str | Path, **parameters: Any) -> Any:
    """The scene of an export, the folder or its `scene.xml`, with all plugins registered.

    `parameters` are Mitsuba's of `load_file`. Raises LaminaError without Mitsuba.
    """
    require("mitsuba", "lamina.mitsuba")
    known = sys.modules.get("mitsuba")
    if known is None or known.variant() is None:
        # Before Mitsuba is imported, which is bound to the libLLVM that it finds first.
        variant.choose()
    import mitsuba as mi

    from lamina.mitsuba import plugins

    plugins.register()
    file = Path(scene)
    return mi.load_file(str(file / "scene.xml" if file.is_dir() else file), **parameters)
