"""Which Mitsuba is used: spectral, compiled through LLVM where that is to be had.

Dr.Jit loads libLLVM when Mitsuba is first imported, so `choose` comes before that. The
environment's own libLLVM (`karellen-llvm-core`) goes first: it is pinned, and older system ones
(LLVM 14 and 15, as of Debian 12) abort the process with "Cannot select: fmaximum" on code that
Mitsuba 3.9 brings forth. Next comes what the system has, then the scalar variant, in which a BSDF
written in Python is some 40 times slower.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from lamina.extras import require

JIT = "llvm_ad_spectral"
SCALAR = "scalar_spectral"


def choose(wanted: str | None = None) -> str:
    """Sets Mitsuba's variant (`wanted`, or the best there is) and gives its name."""
    require("mitsuba", "lamina.mitsuba")
    own = Path(sys.prefix, "lib", "libLLVM.so")
    if own.exists():
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", str(own))
    import mitsuba as mi

    name = wanted or JIT
    if name == JIT and not _llvm_works():
        print(
            f"reference: no usable libLLVM, so Mitsuba runs as {SCALAR}, many times slower",
            file=sys.stderr,
        )
        name = SCALAR
    mi.set_variant(name)
    return name


def _llvm_works() -> bool:
    """Whether Dr.Jit finds a libLLVM."""
    import drjit as dr

    return bool(dr.has_backend(dr.JitBackend.LLVM))
