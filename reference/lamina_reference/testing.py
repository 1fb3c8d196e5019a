"""Runs tests that are plain functions, and tells how they went."""

from __future__ import annotations

import importlib.util
import sys
import traceback
from collections.abc import Mapping
from time import perf_counter
from typing import Any


def without_denoiser(tests: Mapping[str, Any], *needing: str) -> dict[str, Any]:
    """Tests without those of these names if Open Image Denoise is missing, which is told."""
    if importlib.util.find_spec("mitsuba_oidn") is not None:
        return dict(tests)
    print("skip  what denoises: mitsuba-oidn is missing in this Python", file=sys.stderr)
    left_out = {f"test_{name}" for name in needing}
    assert left_out <= set(tests), left_out - set(tests)
    return {name: test for name, test in tests.items() if name not in left_out}


def run_tests(names: Mapping[str, Any], label: str) -> int:
    """Runs every `test_…` of a module, or those whose names hold a word of the command line.

    Gives the exit status: 1 if one of them failed. `label` stands before the counts.
    """
    passed, failed = 0, 0
    for name, test in list(names.items()):
        if not name.startswith("test_") or (
            sys.argv[1:] and not any(word in name for word in sys.argv[1:])
        ):
            continue
        began = perf_counter()
        try:
            test()
            passed += 1
            seconds = perf_counter() - began
            print(f"ok    {name[5:].replace('_', ' ')} ({seconds:.1f} s)", file=sys.stderr)
        except Exception:  # A test must not keep the others from being run.
            failed += 1
            print(f"FAIL  {name[5:].replace('_', ' ')}\n{traceback.format_exc()}", file=sys.stderr)
    print(f"{label}: {passed} passed, {failed} failed")
    return 1 if failed else 0
