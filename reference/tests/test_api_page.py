"""The book's page of the package."""

from __future__ import annotations

import pytest

pytest.importorskip("griffe")
pytest.importorskip("ruff")

import lamina
from book import api


def test_the_page_of_the_package_is_current() -> None:
    text = api.page()
    assert api.PAGE.read_text(encoding="utf-8") == text, "reference/run api writes it again"
    assert all(f"### `lamina.{name}`\n" in text for name in lamina.__all__)
