"""Sweeps: thousands of renders, or leaves, on this machine or on a cluster."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any
from uuid import uuid4

import numpy as np
import xarray as xr

from lamina.conventions import measured
from lamina.extras import require
from lamina.grown import numbers_of
from lamina.listing import Listing, flags, list_tasks, tasks_at
from lamina.program import Folders, LaminaError, Value, program, run
from lamina.progress import bar
from lamina.rendered import read

if TYPE_CHECKING:
    from distributed import Client

# Store, name of the call, file of tasks, offset and number of a batch's first, count, program.
Call = tuple[str, str, str, int, int, int, str]
# A task that failed: number, reason, exit status.
Failed = tuple[int, str, int]

# Results that a worker holds at a time, bytes.
MOST_BYTES = 64 << 20
# Batches of a sweep: enough for a thousand workers, few enough for the scheduler, which takes about
# a millisecond for each.
MOST_BATCHES = 20_000


def sweep(
    what: str | Path,
    client: Client | None = None,
    *,
    store: str | Path,
    over: Mapping[str, Sequence[Value]] | None = None,
    seeds: int | None = None,
    values: Mapping[str, Value] | None = None,
    spp: int | None = None,
    noise: float | None = None,
    batch: int | None = None,
    threads: int | None = None,
    allow: Folders = (),
    progress: bool | None = None,
) -> xr.Dataset:
    """Does the tasks of a sweep and gives their results.

    `what` is a sweep file; or, with `over` (values by key) or `seeds`, a scene, which is rendered,
    or a leaf, which is grown and measured. `values`, `spp` and `noise` are the same for all tasks;
    `allow` is as in `render`. The program expands the sweep: `lamina sweep --list`.

    With a `client` of Dask distributed its workers do the tasks, `threads` each (1); without one
    this process does, with all processors. Workers need this package, the program in the same
    version, and the folder of `store`: results go there, not through the scheduler. A worker hands
    in `batch` tasks at a time. `progress` shows a bar of the tasks that are done, or none; by
    default it is shown in terminals and notebooks.

    `store` is a Zarr store, which is made, or taken up: what is done in it is not done again. Its
    bytes depend on the sweep alone, whatever was killed or repeated on the way. The dataset has
    the layers of `render`, or the numbers among a leaf's measures, over `task`; `id`, `done` and
    the keys of the sweep are coordinates.

    Raises LaminaError for what the program refuses, before anything is done, or once all other
    tasks are done for those that failed; ValueError if the store holds something else.
    """
    require("sweep", "lamina.sweep")
    from lamina import store as stores

    place = Path(store).resolve()
    place.parent.mkdir(parents=True, exist_ok=True)
    words = flags(over, seeds, values, spp, noise, allow)
    listing = list_tasks(what, words, place.with_name(place.name + ".tasks"))
    command = str(program())
    if place.exists():
        group = stores.reopen(place, listing)
    else:
        layers = first_layers(listing, command, client)
        group = stores.create(place, listing, layers, batch or batch_of(listing, layers))
    length = int(str(group.attrs["batch"]))
    done = stores.part(group, "done")
    is_open = done != np.array(listing.ids, np.uint64)
    starts = [
        start
        for start in range(0, len(listing.ids), length)
        if is_open[start : start + length].any()
    ]
    call = uuid4().hex
    calls = [
        (str(place), call, str(listing.file), listing.offsets[start], start, length, command)
        for start in starts
    ]
    failed: list[Failed] = []
    with bar(len(listing.ids), "tasks", int((~is_open).sum()), progress) as shown:
        batches = in_turn(calls, threads) if client is None else on_cluster(client, calls, threads)
        for start, of_batch in batches:
            failed += of_batch
            shown.update(int(is_open[start : start + length].sum()))
    if client is not None:
        # Halves that killed workers have left.
        for half in place.rglob("*.partial"):
            half.unlink(missing_ok=True)
    if failed:
        told = "\n".join(f"task {number}: {text}" for number, text, _ in sorted(failed)[:20])
        raise LaminaError(f"{len(failed)} tasks failed\n{told}", max(code for *_, code in failed))
    return stores.results(place)


def batch_of(listing: Listing, layers: Mapping[str, xr.DataArray]) -> int:
    """Tasks that one chunk holds: as few as the scheduler can bear, as the memory allows."""
    size = sum(layer.nbytes for layer in layers.values())
    most = max(MOST_BYTES // max(size, 1), 1)
    return int(min(max(-(-len(listing.ids) // MOST_BATCHES), 1), most))


def first_layers(listing: Listing, command: str, client: Client | None) -> dict[str, xr.DataArray]:
    """What each task gives, from one of them with few samples."""
    task = tasks_at(listing.file, listing.offsets[0], 1)[0]
    few = ["--spp", "1", "--noise", "0"] if listing.kind == "render" else []
    task = {**task, "arguments": without_samples(task["arguments"]) + few}
    if client is None:
        return layers_of(task, listing.version, command, None)
    future = client.submit(layers_of, task, listing.version, command, 1, pure=False)
    return future.result()


def without_samples(arguments: list[str]) -> list[str]:
    """Arguments of a render but for its samples and noise."""
    kept: list[str] = []
    words = iter(arguments)
    for word in words:
        if word in ("--spp", "--noise"):
            next(words)
        else:
            kept.append(word)
    return kept


def in_turn(calls: list[Call], threads: int | None) -> Iterator[tuple[int, list[Failed]]]:
    """Does batches one after the other; the first task of each, and those that failed."""
    for call in calls:
        yield call[4], work(*call, threads)


def on_cluster(
    client: Client, calls: list[Call], threads: int | None
) -> Iterator[tuple[int, list[Failed]]]:
    """Lets workers do batches; the first task of each, as they end, and those that failed."""
    from distributed import as_completed

    futures = [client.submit(work, *call, threads or 1, pure=False, retries=2) for call in calls]
    starts = {future.key: call[4] for future, call in zip(futures, calls, strict=True)}
    for future in as_completed(futures):  # type: ignore[no-untyped-call]
        start = starts[future.key]
        if future.status == "finished":
            yield start, future.result()
        else:
            yield start, [(start, repr(future.exception()), 1)]
        future.release()


def work(
    store: str,
    call: str,
    tasks: str,
    offset: int,
    first: int,
    count: int,
    command: str,
    threads: int | None,
) -> list[Failed]:
    """Does the open tasks of a batch and writes them; gives those that failed, with why.

    It may be done several times, and by several workers at a time: they write the same bytes.
    """
    from lamina import store as stores

    group, arrays = stores.arrays(store, call)
    chosen = slice(first, first + count)
    done = np.asarray(arrays["done"][chosen])
    listed = tasks_at(tasks, offset, len(done))
    identities = np.array([int(task["id"], 16) for task in listed], np.uint64)
    version = str(group.attrs["software"]).removeprefix("Lamina ")
    was_done = bool(done.any())
    failed: list[Failed] = []
    blocks: dict[str, stores.Array] = {}
    for index in np.flatnonzero(done != identities):
        try:
            layers = layers_of(listed[index], version, command, threads)
        except LaminaError as failure:
            failed.append((first + int(index), str(failure), failure.code))
            continue
        for name, layer in layers.items():
            if (there := arrays.get(name)) is None:
                continue
            if name not in blocks:
                # What nobody has written need not be read.
                empty = np.full((len(done), *there.shape[1:]), np.nan, there.dtype)
                blocks[name] = np.asarray(there[chosen]) if was_done else empty
            if blocks[name].shape[1:] != layer.shape:
                shapes = f"{layer.shape}, the others {blocks[name].shape[1:]}"
                text = f"{name} has the shape {shapes}: one store holds pictures of one size"
                failed.append((first + int(index), text, 2))
                break
            blocks[name][index] = layer.values
        else:
            done[index] = identities[index]
    for name, block in sorted(blocks.items()):
        arrays[name][chosen] = block
    # What this says to be there is there.
    arrays["done"][chosen] = done
    return failed


def layers_of(
    task: dict[str, Any], version: str, command: str, threads: int | None
) -> dict[str, xr.DataArray]:
    """Does a task in a folder of its own; its results by name."""
    arguments = list(task["arguments"])
    if threads is not None:
        arguments += ["--threads", str(threads)]
    with tempfile.TemporaryDirectory(prefix="lamina-task-") as folder:
        if arguments[0] == "grow":
            measures = Path(folder, "measures.json")
            run([*arguments, "--measure", measures], command)
            numbers = numbers_of(measures.read_text(encoding="utf-8"))
            return {
                name: xr.DataArray(np.float64(value), attrs=measured(name))
                for name, value in numbers.items()
            }
        run([*arguments, "--out", Path(folder, "picture")], command)
        picture = read(Path(folder, "picture.exr"))
    if picture.attrs["software"] != f"Lamina {version}":
        raise LaminaError(
            f"the worker's program is {picture.attrs['software']}, the sweep's is Lamina {version}",
            1,
        )
    return {str(name): picture[name] for name in picture.data_vars}
