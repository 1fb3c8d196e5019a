"""How far a long call is, as a bar."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tqdm import tqdm


def bar(all_of: int, unit: str, done: int, progress: bool | None) -> tqdm:
    """A bar on stderr, in a notebook a widget, of `all_of` things, `done` of which are done before.

    `progress` says whether it is shown; None shows it in terminals and notebooks.
    """
    from tqdm.auto import tqdm

    if progress is None:
        progress = sys.stderr.isatty() or "ipykernel" in sys.modules
    return tqdm(total=all_of, initial=done, unit=f" {unit}", disable=not progress)
