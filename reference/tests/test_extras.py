"""A missing requirement is reported first, with the command that installs it."""

from __future__ import annotations

import importlib
import re
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lamina
from lamina import denoise, print, report
from lamina.extras import MODULES
from lamina.mitsuba import variant

HERE = Path(__file__).resolve().parents[1]
DECLARED = tomllib.loads(HERE.joinpath("pyproject.toml").read_text())
VEIN = np.zeros((1, 2))
LEAF = lamina.Grown(VEIN, VEIN, VEIN, VEIN, VEIN, VEIN, VEIN, [], {}, None, None)  # type: ignore[arg-type]
# By extra: a call that needs it.
CALLS: dict[str, Callable[[Path], Any]] = {
    "graph": lambda _: LEAF.graph(),
    "sweep": lambda folder: lamina.sweep("scene.toml", store=folder / "s.zarr", seeds=2),
    "report": lambda folder: report.report(["a.exr", "b.exr"], folder / "r.html"),
    "netcdf": lambda folder: lamina.to_netcdf("figures.json", folder / "f.nc"),
    "mitsuba": lambda _: variant.choose(),
    "scans": lambda folder: lamina.from_scans(
        folder / "leaf", adaxial="a.png", transmitted="t.png", mm_per_pixel=0.1
    ),
    "usd": lambda folder: lamina.to_usd("birch", folder / "leaf.usda"),
}
COMMANDS: dict[str, Callable[[list[str]], int]] = {"denoise": denoise.main, "print": print.main}


def test_every_extra_has_packages_and_every_script_a_function() -> None:
    assert set(DECLARED["project"]["optional-dependencies"]) == set(MODULES)
    assert set(CALLS) | set(COMMANDS) == set(MODULES)
    for script in HERE.joinpath("data", "scripts").iterdir():
        module = re.search(r"^from (lamina\.\w+) import main$", script.read_text(), re.MULTILINE)
        assert module is not None, script
        assert callable(importlib.import_module(module[1]).main), script


@pytest.fixture
def without(monkeypatch: pytest.MonkeyPatch) -> Callable[[str], None]:
    """Takes an extra's modules and the program away."""

    def take(extra: str) -> None:
        monkeypatch.setenv("LAMINA", "/no/such/lamina")
        for module in MODULES[extra]:
            # What Python holds for a module that must not be imported.
            monkeypatch.setitem(sys.modules, module, None)  # type: ignore[arg-type]

    return take


@pytest.mark.parametrize("extra", CALLS)
def test_a_call_names_the_extra_that_it_needs(
    extra: str, without: Callable[[str], None], tmp_path: Path
) -> None:
    without(extra)
    with pytest.raises(lamina.LaminaError) as refused:
        CALLS[extra](tmp_path)
    needed = " and ".join(MODULES[extra])
    assert f"needs {needed}: pip install 'lamina-render[{extra}]'" in str(refused.value)
    assert refused.value.code == 1 and not list(tmp_path.iterdir())


def test_a_render_in_parts_names_the_extra_that_it_needs(
    without: Callable[[str], None], tmp_path: Path
) -> None:
    without("sweep")
    with pytest.raises(lamina.LaminaError, match=r"lamina-render\[sweep\]"):
        lamina.render_in_parts("s.toml", client=None, out=tmp_path / "p", spp=4, parts=2)  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("extra", COMMANDS)
def test_a_command_names_the_extra_that_it_needs(
    extra: str,
    without: Callable[[str], None],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    without(extra)
    out = tmp_path / "out.exr" if extra == "denoise" else tmp_path
    assert COMMANDS[extra](["scene", "--out", str(out)]) == 1
    warned = capsys.readouterr().err
    assert warned.endswith(f": pip install 'lamina-render[{extra}]'\n") and warned.count("\n") == 1
    assert not list(tmp_path.iterdir())
