"""The notebooks of the package run."""

import json
from pathlib import Path

import pytest

matplotlib = pytest.importorskip("matplotlib")
pytest.importorskip("mitsuba")


ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.deep
def test_notebooks_run_from_top_to_bottom(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every code cell of every notebook, in a fresh namespace, without a window."""

    matplotlib.use("Agg")
    notebooks = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))
    assert len(notebooks) >= 3
    for file in notebooks:
        cells = json.loads(file.read_text(encoding="utf-8"))["cells"]
        assert not any(cell.get("outputs") for cell in cells), f"{file.name} holds outputs"
        names: dict[str, object] = {"__name__": "__main__"}
        monkeypatch.chdir(file.parent)
        for number, cell in enumerate(cells):
            if cell["cell_type"] == "code":
                source = "".join(cell["source"])
                exec(compile(source, f"{file.name}, cell {number}", "exec"), names)  # noqa: S102
