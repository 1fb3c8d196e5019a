"""Tables read by linear interpolation, in the JIT variants and the scalar one alike."""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

IS_JIT = dr.is_jit_v(mi.Float)
_Buffer = type(mi.TensorXf().array)
Buffer64 = dr.float64_array_t(_Buffer)


class Table:
    """A flat array of numbers that is gathered from."""

    def __init__(self, values: Any, double: bool = False) -> None:
        self.host = np.ascontiguousarray(values, dtype=np.float64 if double else np.float32).ravel()
        self.device = (Buffer64 if double else _Buffer)(self.host) if IS_JIT else None

    def at(self, kind: type, index: Any) -> Any:
        """Entries at `index` as an array of type `kind`."""
        if IS_JIT:
            if dr.depth_v(kind) == 1:
                return dr.gather(kind, self.device, index)
            # One gather a wavelength: a nested type would gather neighbours.
            part = dr.value_t(kind)
            return kind([dr.gather(part, self.device, i) for i in index])
        if isinstance(index, int):
            return float(self.host[index])
        return kind([float(self.host[int(i)]) for i in index])


def cell(kind: type, x: Any, count: int) -> tuple[Any, Any]:
    """Index of the lower neighbour of `x` in 0..count-1, and the share of the upper one.

    `x` outside is clamped to the border; count ≥ 2.
    """
    x = dr.clip(x, 0.0, float(count - 1))
    if not IS_JIT and isinstance(x, float):
        lower = min(int(x), count - 2)
        return lower, x - lower
    if IS_JIT:
        index = dr.minimum(dr.uint32_array_t(kind)(dr.floor(x)), count - 2)
        return index, x - kind(index)
    lowers = [min(int(value), count - 2) for value in x]
    return lowers, x - kind([float(i) for i in lowers])


def nearest(kind: type, x: Any, count: int) -> Any:
    """⌊x⌋ of numbers of type `kind`, within 0..count-1."""
    x = dr.clip(dr.floor(x), 0.0, float(count - 1))
    if IS_JIT:
        return dr.uint32_array_t(kind)(x)
    return int(x) if isinstance(x, float) else [int(value) for value in x]


def bits(x: Any) -> Any:
    """The bits of single-precision numbers."""
    if IS_JIT:
        return dr.reinterpret_array(mi.UInt32, mi.Float(x))
    return int(np.float32(x).view(np.uint32))
