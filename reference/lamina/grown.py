"""Grown leaves: margin, network of veins, measures and mesh as arrays."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lamina.extras import require
from lamina.program import Folders, Value, allowing, overrides, run

if TYPE_CHECKING:
    import networkx

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Grown:
    """A leaf as it was grown, in millimetres; the blade is flat here, but for `vertices`."""

    outline: Array
    """Corners of the margin, counter-clockwise, `[corners, 2]`."""
    base: Array
    """Where the petiole meets the blade, `[2]`."""
    apex: Array
    """The tip, `[2]`."""
    nodes: Array
    """Places of the veins' nodes, `[nodes, 2]`; older ones come first."""
    edges: NDArray[np.int64]
    """Numbers of the node nearer to the petiole and of the farther one, `[edges, 2]`."""
    radii: Array
    """Radius of the vein at both nodes, `[edges, 2]`."""
    orders: NDArray[np.int64]
    """Order of the vein: 1 for primaries, then upwards."""
    areoles: list[dict[str, Any]]
    """Area, perimeter, elongation, circularity, centroid and corners of each."""
    measures: dict[str, Any]
    """What `lamina grow --measure` writes; `docs/src/theory/measures.md` defines it."""
    vertices: Array | None
    """Vertices of the blade in space, `[vertices, 3]`, m; None unless the mesh was asked for."""
    faces: NDArray[np.int64] | None
    """Corners of its triangles, `[faces, 3]`, from 0."""

    def graph(self) -> networkx.Graph:
        """The veins as a graph: nodes with `x_mm`, `y_mm`; edges with `length_mm`, `radius_mm` (the
        mean of both ends) and `order`. Needs networkx.
        """
        require("graph", "a graph of veins")
        import networkx

        graph = networkx.Graph()
        for number, (x, y) in enumerate(self.nodes):
            graph.add_node(number, x_mm=float(x), y_mm=float(y))
        steps = self.nodes[self.edges[:, 1]] - self.nodes[self.edges[:, 0]]
        lengths = np.hypot(*steps.T)
        for (a, b), length, radii, order in zip(
            self.edges, lengths, self.radii, self.orders, strict=True
        ):
            graph.add_edge(
                int(a),
                int(b),
                length_mm=float(length),
                radius_mm=float(radii.mean()),
                order=int(order),
            )
        return graph

    def lines(self) -> Array:
        """Both ends of every piece of vein, `[edges, 2, 2]`: for drawing, or for geometries."""
        return self.nodes[self.edges]


def grow(
    leaf: str | Path,
    values: Mapping[str, Value] | None = None,
    *,
    mesh: bool = False,
    allow: Folders = (),
) -> Grown:
    """Grows a leaf.

    `leaf` is a preset's name (`lamina grow --list`), a file of leaves, or `FILE.toml#NAME`;
    `values` sets keys of its plan as `lamina grow --set` does. `mesh` makes the blade in space too,
    which takes longer. `allow` is as in `render`. Raises LaminaError.
    """
    with tempfile.TemporaryDirectory() as folder:
        network, measures = Path(folder, "leaf.json"), Path(folder, "measures.json")
        blade = Path(folder, "leaf.ply")
        files = [str(network), *([str(blade)] if mesh else [])]
        run(
            ["grow", str(leaf), *overrides("--set", values), *allowing(allow)]
            + ["--out", *files, "--measure", str(measures)]
        )
        measured = json.loads(measures.read_text(encoding="utf-8"))
        vertices, faces = mesh_of(blade) if mesh else (None, None)
        return leaf_of(network, measured, vertices, faces)


def frames(
    leaf: str | Path,
    count: int,
    values: Mapping[str, Value] | None = None,
    *,
    allow: Folders = (),
) -> list[Grown]:
    """A leaf at `count` times of its growth; the last one is the grown leaf.

    Arguments are those of `grow`; the leaves are without measures. Raises LaminaError.
    """
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder, "leaf.json"))
        setting = [*overrides("--set", values), *allowing(allow)]
        run(["grow", str(leaf), *setting, "--frames", str(count), "--out", out])
        files = sorted(Path(folder).glob("leaf-*.json"))
        return [leaf_of(file, {}, None, None) for file in files]


def leaf_of(
    file: Path,
    measures: dict[str, Any],
    vertices: Array | None,
    faces: NDArray[np.int64] | None,
) -> Grown:
    """A leaf from the JSON of its veins."""
    told = json.loads(file.read_text(encoding="utf-8"))
    margin, nodes, edges = told["outline"], told["nodes"], told["edges"]
    return Grown(
        outline=np.asarray(margin["points_mm"], float).reshape(-1, 2),
        base=np.asarray(margin["base_mm"], float),
        apex=np.asarray(margin["apex_mm"], float),
        nodes=np.column_stack([nodes["x_mm"], nodes["y_mm"]]).astype(float),
        edges=np.column_stack([edges["from"], edges["to"]]).astype(np.int64).reshape(-1, 2),
        radii=np.column_stack([edges["radius_from_mm"], edges["radius_to_mm"]]).astype(float),
        orders=np.asarray(edges["order"], np.int64),
        areoles=told["areoles"],
        measures=measures,
        vertices=vertices,
        faces=faces,
    )


def numbers_of(measures: str) -> dict[str, float]:
    """The numbers in the JSON of measures, those of objects inside by their path: `a.b`."""
    numbers: dict[str, float] = {}

    def take(told: Mapping[str, Any], before: str) -> None:
        for key, value in told.items():
            if isinstance(value, Mapping):
                take(value, f"{before}{key}.")
            elif isinstance(value, int | float) and not isinstance(value, bool):
                numbers[before + key] = float(value)

    take(json.loads(measures), "")
    return numbers


def mesh_of(file: Path) -> tuple[Array, NDArray[np.int64]]:
    """Vertices (m) and triangles of the PLY that the program writes."""
    data = file.read_bytes()
    head, _, _ = data.partition(b"end_header\n")
    counts = [int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element")]
    floats = head.count(b"property float")
    start = len(head) + len(b"end_header\n")
    vertices = np.frombuffer(data, "<f4", counts[0] * floats, start).reshape(-1, floats)
    face = np.dtype([("corners", "u1"), ("vertices", "<i4", 3), ("part", "u1")])
    faces = np.frombuffer(data, face, counts[1], start + vertices.nbytes)
    return vertices[:, :3].astype(float), faces["vertices"].astype(np.int64)
