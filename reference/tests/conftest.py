"""Which tests run: all but those that take long, and none whose modules are missing."""

from __future__ import annotations

import os
from importlib.util import find_spec

import pytest

from lamina.mitsuba import variant
from validation.program import program

# Tests run in folders of their own, and the package looks for the program by this variable first.
os.environ["LAMINA"] = str(program().resolve())


# Before a test module imports Mitsuba, which is bound to the libLLVM that it finds first.
if find_spec("mitsuba") is not None:
    variant.choose()


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--all", action="store_true", help="run tests that take long too")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves deep tests out, and says why a test is skipped."""
    if not config.getoption("--all"):
        deep = [item for item in items if item.get_closest_marker("deep")]
        config.hook.pytest_deselected(items=deep)
        items[:] = [item for item in items if item not in deep]
    for item in items:
        for marker in item.iter_markers("needs"):
            missing = [name for name in marker.args if find_spec(name) is None]
            if missing:
                reason = f"needs {', '.join(missing)}"
                item.add_marker(pytest.mark.skip(reason=reason))
