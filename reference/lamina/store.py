"""Results of a sweep as a Zarr store: one array a layer over `task`, inputs as coordinates.

A chunk holds a batch of tasks and is written by one worker, whole or not at all; the array `done`
is written last and holds the identity of each task whose results are there. Nothing in the store
tells when, where or how often something was made, so that its bytes depend on the sweep alone.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, cast

import numpy as np
import xarray as xr
import zarr

from lamina.conventions import about, units, without_fill_values
from lamina.listing import Listing
from lamina.program import Value

Array = np.ndarray[Any, Any]

# The second version of the format is the one that all readers know, text included.
FORMAT: Literal[2] = 2


def create(
    path: Path, listing: Listing, layers: Mapping[str, xr.DataArray], batch: int
) -> zarr.Group:
    """A new store for the tasks of a listing, each with layers as those given."""
    software = f"Lamina {listing.version}"
    made = "pictures" if listing.kind == "render" else "leaves"
    keys = ", ".join(key["key"] for key in listing.keys)
    attributes = {
        **about(f"Sweep of {made} over {keys}", software, "lamina.sweep"),
        "software": software,
        "kind": listing.kind,
        # As text, because NetCDF has no attributes of attributes.
        "keys": json.dumps(listing.keys),
        "batch": batch,
    }
    group = zarr.create_group(str(path), zarr_format=FORMAT, attributes=attributes)
    count = len(listing.ids)
    for name, layer in layers.items():
        for dimension, coordinate in layer.coords.items():
            if str(dimension) not in group:
                coordinates(group, str(dimension), coordinate)
        attrs = {"_ARRAY_DIMENSIONS": ["task", *map(str, layer.dims)], **layer.attrs}
        group.create_array(
            name,
            shape=(count, *layer.shape),
            chunks=(batch, *(max(length, 1) for length in layer.shape)),
            dtype=layer.dtype,
            fill_value=np.nan,
            attributes=attrs,
        )
    group.create_array(
        "done",
        shape=(count,),
        chunks=(batch,),
        dtype=np.uint64,
        fill_value=0,
        attributes={"_ARRAY_DIMENSIONS": ["task"], "long_name": "id of the task if it is done"},
    )
    inputs(group, listing)
    zarr.consolidate_metadata(str(path), zarr_format=FORMAT)
    return group


def coordinates(group: zarr.Group, name: str, values: xr.DataArray) -> None:
    """A coordinate that all tasks share."""
    data = np.asarray(values.values)
    attrs = {"_ARRAY_DIMENSIONS": [name], **values.attrs}
    column(group, name, data.astype(str) if data.dtype.kind in "OU" else data, attrs)


def inputs(group: zarr.Group, listing: Listing) -> None:
    """The identity of each task and the values of its keys, in place of those that are there."""
    dims = {"_ARRAY_DIMENSIONS": ["task"]}
    identities = np.array([f"{identity:016x}" for identity in listing.ids])
    column(group, "id", identities, {**dims, "long_name": "hash of all that the task depends on"})
    for key in listing.keys:
        attrs = {**dims, "long_name": key["key"], **units(key["unit"])}
        column(group, key["key"], array_of(listing.columns[key["key"]]), attrs)


def column(group: zarr.Group, name: str, data: Array, attrs: dict[str, Any]) -> None:
    """Writes a small array whole."""
    # A fill value would make readers take an input that equals it for a missing one.
    array = group.create_array(
        name,
        shape=data.shape,
        chunks=(max(min(len(data), 1 << 16), 1),),
        dtype=data.dtype,
        fill_value=None,
        attributes=attrs,
        overwrite=True,
    )
    array[:] = data


def array_of(values: list[Value]) -> Array:
    """Values of a key as an array: numbers, truths, or text; lists and tables are text as JSON."""
    if all(isinstance(value, bool) for value in values):
        return np.array(values, bool)
    if all(isinstance(value, int) and not isinstance(value, bool) for value in values):
        return np.array(values)
    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        return np.array(values, float)
    texts = [value if isinstance(value, str) else json.dumps(value) for value in values]
    return np.array(texts, str)


def reopen(path: Path, listing: Listing) -> zarr.Group:
    """The store of an earlier run, made longer if the sweep has grown at its end.

    Raises ValueError if it holds another sweep.
    """
    group = opened(path)
    if "id" not in group or "batch" not in group.attrs:
        raise ValueError(f"{path} is no store of a sweep: name another one")
    known = [int(str(identity), 16) for identity in part(group, "id")]
    is_same = known == listing.ids[: len(known)] and group.attrs["keys"] == json.dumps(listing.keys)
    if not is_same:
        raise ValueError(
            f"{path} holds the results of another sweep, scene or version: name another store, or "
            "remove it"
        )
    if len(known) < len(listing.ids):
        for name, array in group.arrays():
            if array.shape[:1] == (len(known),) and dimension_of(array) == "task":
                if name in ("id", *listing.columns):
                    continue
                array.resize((len(listing.ids), *array.shape[1:]))
        inputs(group, listing)
        zarr.consolidate_metadata(str(path), zarr_format=FORMAT)
    return group


def dimension_of(array: zarr.Array[Any]) -> str:
    """The first dimension of an array."""
    names = cast("list[str]", array.attrs["_ARRAY_DIMENSIONS"])
    return names[0]


def opened(path: str | Path) -> zarr.Group:
    """A store that is there, to be written into."""
    return zarr.open_group(str(path), mode="r+", zarr_format=FORMAT, use_consolidated=False)


@lru_cache(maxsize=4)
def arrays(path: str, call: str) -> tuple[zarr.Group, dict[str, zarr.Array[Any]]]:
    """A store that is there and its arrays, looked up once for each call of `sweep` in a process:
    to open an array takes as long as to write a small one.

    `call` names the call: a later one may have made the store longer, or another one.
    """
    group = opened(path)
    return group, dict(group.arrays())


def part(group: zarr.Group, name: str, chosen: slice = slice(None)) -> Array:
    """Some tasks of an array."""
    return np.asarray(cast("zarr.Array[Any]", group[name])[chosen])


def results(path: Path) -> xr.Dataset:
    """The store as a dataset that reads what is asked for; `done` tells which tasks are there."""
    data: xr.Dataset = xr.open_zarr(
        str(path), zarr_format=FORMAT, chunks=None, mask_and_scale=False
    )
    identities = np.array([int(str(identity), 16) for identity in data.id.values], np.uint64)
    is_done = np.asarray(data.done.values, np.uint64) == identities
    done = ("task", is_done, {"long_name": "whether the task is done"})
    for layer in data.variables.values():
        # What no task has filled is no number, which needs no telling.
        layer.attrs.pop("_FillValue", None)
    names = [key["key"] for key in json.loads(data.attrs["keys"])]
    return without_fill_values(
        data.drop_vars("done").set_coords(["id", *names]).assign_coords(done=done)
    )
