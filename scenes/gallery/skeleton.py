#!/usr/bin/env python3
"""Writes skeleton.ply, the veins of a leaf without its tissue, from the network that `lamina grow` writes:

    lamina grow aspen --set length_mm=60 --set final_length_segments=640 --out veins.json
    scenes/gallery/skeleton.py veins.json scenes/gallery/skeleton.ply

Each vein is a tube of a few sides, a little swollen, that bends with the blade. Lengths of the file are millimetres.
"""

import json
import sys

import numpy as np

SIDES = 3
TOLERANCE_MM = 0.02
SWOLLEN, LEAST_MM = 1.25, 0.034
CURL, FOLD = 0.55, 0.22


def chains(count, edges):
    """Paths between nodes where veins meet or end, as lists of (node, edge behind it)."""
    around = [[] for _ in range(count)]
    for k, (a, b) in enumerate(edges):
        around[a].append((b, k))
        around[b].append((a, k))
    used = np.zeros(len(edges), bool)
    ends = [n for n in range(count) if len(around[n]) not in (0, 2)]
    for start in ends + list(range(count)):
        for other, edge in around[start]:
            if used[edge]:
                continue
            path = [start]
            node, link = other, edge
            while True:
                used[link] = True
                path.append(node)
                if len(around[node]) != 2 or node == start:
                    break
                onward = [(n, e) for n, e in around[node] if not used[e]]
                if not onward:
                    break
                node, link = onward[0]
            yield path


def thinned(points, tolerance):
    """The places of a line that keep it within the tolerance (Douglas and Peucker)."""
    keep = {0, len(points) - 1}
    stack = [(0, len(points) - 1)]
    while stack:
        a, b = stack.pop()
        if b < a + 2:
            continue
        along = points[b] - points[a]
        length = np.hypot(*along)
        rel = points[a + 1 : b] - points[a]
        off = np.abs(rel[:, 0] * along[1] - rel[:, 1] * along[0]) / length if length > 1e-9 else np.hypot(*rel.T)
        worst = int(off.argmax())
        if off[worst] > tolerance:
            middle = a + 1 + worst
            keep.add(middle)
            stack += [(a, middle), (middle, b)]
    return sorted(keep)


def bent(points, length):
    """The flat net in space: folded about the midrib and curled along it, with a slow wave."""
    x, y = points.T
    turn = CURL / length
    z = np.abs(x) * FOLD * (1 - 0.4 * y / length) + 0.9 * np.sin(x / 7 + y / 11) * np.abs(x) / length * 2
    angle = y * turn
    return np.stack([x, np.sin(angle) / turn, z * np.cos(angle) - (1 - np.cos(angle)) / turn], 1)


def main():
    veins = json.load(open(sys.argv[1], encoding="utf-8"))
    flat = np.stack([veins["nodes"]["x_mm"], veins["nodes"]["y_mm"]], 1)
    edges = np.stack([veins["edges"]["from"], veins["edges"]["to"]], 1)
    radius = np.zeros(len(flat))
    for end, radii in (("from", "radius_from_mm"), ("to", "radius_to_mm")):
        np.maximum.at(radius, veins["edges"][end], veins["edges"][radii])
    radius = np.maximum(SWOLLEN * radius, LEAST_MM)
    space = bent(flat, veins["outline"]["apex_mm"][1])
    vertices, faces, size = [], [], 0
    turns = 2 * np.pi * np.arange(SIDES) / SIDES
    for path in chains(len(flat), edges.tolist()):
        path = [path[k] for k in thinned(flat[path], TOLERANCE_MM)]
        line, wide = space[path], radius[path]
        along = np.gradient(line, axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        side = np.cross(along, [0.0, 0.0, 1.0])
        side /= np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-9)
        up = np.cross(side, along)
        ring = line[:, None] + wide[:, None, None] * (np.cos(turns)[None, :, None] * side[:, None] + np.sin(turns)[None, :, None] * up[:, None])
        vertices.append(ring.reshape(-1, 3))
        for k in range(len(path) - 1):
            for s in range(SIDES):
                a, b = size + k * SIDES + s, size + k * SIDES + (s + 1) % SIDES
                faces += [(a, a + SIDES, b), (b, a + SIDES, b + SIDES)]
        size += len(path) * SIDES
    vertices = np.concatenate(vertices).astype("<f4")
    table = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    table["n"], table["v"] = 3, faces
    with open(sys.argv[2], "wb") as file:
        file.write(
            f"ply\nformat binary_little_endian 1.0\ncomment veins of an aspen, written by skeleton.py\nelement vertex {len(vertices)}\n"
            f"property float x\nproperty float y\nproperty float z\nelement face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n".encode()
        )
        vertices.tofile(file)
        table.tofile(file)
    print(f"{len(vertices)} corners, {len(faces)} triangles")


if __name__ == "__main__":
    main()
