"""What `lamina export gltf` writes, as Python reads it."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

# By glTF's number of a component, and by its word for a vector.
COMPONENTS = {5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass(frozen=True)
class Gltf:
    """A binary file: its JSON, and its bytes. Numbers name entries of a list of the JSON."""

    parts: dict[str, Any]
    data: bytes

    @classmethod
    def read(cls, file: Path) -> Gltf:
        whole = file.read_bytes()
        (length,) = struct.unpack_from("<I", whole, 12)
        return cls(json.loads(whole[20 : 20 + length]), whole[28 + length :])

    def view(self, number: int) -> bytes:
        """Bytes of a view."""
        view = self.parts["bufferViews"][number]
        return self.data[view["byteOffset"] :][: view["byteLength"]]

    def vectors(self, accessor: int) -> npt.NDArray[Any]:
        """Vectors or numbers, one in each row."""
        about = self.parts["accessors"][accessor]
        numbers = np.frombuffer(self.view(about["bufferView"]), COMPONENTS[about["componentType"]])
        return numbers.reshape(about["count"], WIDTHS[about["type"]])

    def extension(self, entry: dict[str, Any], name: str) -> dict[str, Any]:
        """What an extension says of an entry; an empty table if it says nothing."""
        own: dict[str, Any] = entry.get("extensions", {}).get(name, {})
        return own
