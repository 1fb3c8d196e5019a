"""Tests of sweeps in the package `lamina`, alone and on a cluster of two processes, one of which is
killed:.
"""

from __future__ import annotations

import os
import signal
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from distributed import Client, LocalCluster

import lamina
from lamina import store as stores
from lamina import sweeping
from lamina.listing import list_tasks
from validation.program import program

ROOT = Path(__file__).resolve().parents[2]

FURNACE = ROOT / "scenes" / "furnace" / "scene.toml"
RADIUS = "film.spectral.filter_radius_px"
SMALL = {"film.spectral.size": [12, 8]}


@contextmanager
def cluster() -> Iterator[Client]:
    """Two workers, each a process of its own with one thread."""
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as machines,
        Client(machines) as client,
    ):
        yield client


@contextmanager
def folder() -> Iterator[Path]:
    """A folder that goes away."""
    with tempfile.TemporaryDirectory() as name:
        yield Path(name)


def bytes_of(store: Path) -> dict[str, bytes]:
    """Every file of a store."""
    files = (file for file in store.rglob("*") if file.is_file())
    return {str(file.relative_to(store)): file.read_bytes() for file in files}


def waits_for(what: str, is_there: object) -> None:
    """Waits up to a minute."""
    for _ in range(6000):
        if is_there():  # type: ignore[operator]
            return
        time.sleep(0.01)
    raise AssertionError(f"there is no {what}")


def kill_one(client: Client) -> int:
    """Kills a worker as the system would; its process number."""
    workers = client.run(os.getpid)
    pid = next(iter(workers.values()))
    os.kill(pid, signal.SIGKILL)
    return pid


def test_results_are_those_of_single_renders() -> None:
    radii = [0.5, 1.5]
    with folder() as made:
        pictures = lamina.sweep(
            FURNACE, store=made / "s.zarr", over={RADIUS: radii}, seeds=2, values=SMALL, spp=4
        )
        assert dict(pictures.sizes)["task"] == 4 and bool(pictures.done.all())
        assert pictures[RADIUS].values.tolist() == [0.5, 0.5, 1.5, 1.5]
        assert pictures[RADIUS].attrs["units"] == "1"
        assert pictures.seed.values.tolist() == [1, 2, 1, 2]
        for task in range(4):
            values = SMALL | {RADIUS: radii[task // 2]}
            alone = lamina.render(FURNACE, values, spp=4, seed=1 + task % 2)
            for name in ("radiance", "radiance_variance", "coverage", "samples"):
                there = pictures[name].isel(task=task)
                assert np.array_equal(there.values, alone[name].values, equal_nan=True), name
                assert there.attrs == alone[name].attrs
            assert pictures.wavelength.values.tolist() == alone.wavelength.values.tolist()
        assert not np.array_equal(pictures.radiance[0], pictures.radiance[1])


def test_a_grown_leaf_has_its_measures() -> None:
    with folder() as made:
        leaves = lamina.sweep(
            "runions-9c", store=made / "s.zarr", over={"kill_distance_segments": [1, 2]}
        )
        for task, distance in enumerate([1, 2]):
            alone = lamina.grow("runions-9c", {"kill_distance_segments": distance}).measures
            for name in ("vein_length_mm", "length_mm", "vein_density_mm_per_mm2"):
                assert float(leaves[name][task]) == alone[name], name


def test_what_is_done_is_not_done_again_and_a_sweep_may_grow() -> None:
    with folder() as made:
        place = made / "s.zarr"

        def swept(radii: list[float]) -> None:
            lamina.sweep(FURNACE, store=place, over={RADIUS: radii}, values=SMALL, spp=2)

        def times() -> dict[str, int]:
            chunks = (place / "radiance").glob("[0-9]*")
            return {chunk.name: chunk.stat().st_mtime_ns for chunk in chunks}

        swept([0.5, 1])
        first = times()
        assert len(first) == 2
        swept([0.5, 1])
        assert times() == first
        swept([0.5, 1, 1.5])
        longer = times()
        assert len(longer) == 3 and longer.items() >= first.items()
        fresh = made / "fresh.zarr"
        lamina.sweep(FURNACE, store=fresh, over={RADIUS: [0.5, 1, 1.5]}, values=SMALL, spp=2)
        assert bytes_of(place) == bytes_of(fresh)
        # A chunk that says to be open is made again, to the same bytes.
        (place / "done" / "1").unlink()
        swept([0.5, 1, 1.5])
        assert times() != longer
        assert bytes_of(place) == bytes_of(fresh)
        try:
            swept([0.5, 2])
        except ValueError as refused:
            assert "another sweep" in str(refused)
        else:
            raise AssertionError("another sweep was taken for the same")


def test_a_killed_worker_changes_nothing() -> None:
    wanted = {"over": {RADIUS: [0.5, 1, 1.5]}, "seeds": 4, "values": SMALL, "spp": 600}
    with folder() as made:
        serial, killed = made / "serial.zarr", made / "killed.zarr"
        lamina.sweep(FURNACE, store=serial, threads=2, batch=2, **wanted)
        with cluster() as client:
            result: list[object] = []

            def sweep() -> None:
                result.append(lamina.sweep(FURNACE, client, store=killed, batch=2, **wanted))

            thread = threading.Thread(target=sweep)
            thread.start()
            waits_for("first result", lambda: any(killed.glob("done/[0-9]*")))
            before = len(list(killed.glob("done/[0-9]*")))
            pid = kill_one(client)
            thread.join()
            assert before < 6, "the sweep was over before the worker was killed"
            assert pid not in client.run(os.getpid).values()
        assert result and bool(result[0].done.all())  # type: ignore[attr-defined]
        assert bytes_of(serial) == bytes_of(killed)


def test_a_render_in_parts_is_the_render_in_one_go_though_a_worker_is_killed() -> None:
    values = {"film.spectral.size": [48, 40]}
    with folder() as made:
        whole, cut = made / "whole", made / "cut"
        lamina.render(FURNACE, values, spp=900, noise=0, seed=5, out=whole)
        with cluster() as client:
            result: list[object] = []

            def render() -> None:
                picture = lamina.render_in_parts(
                    FURNACE, values, client=client, out=cut, spp=900, parts=7, seed=5
                )
                result.append(picture)

            thread = threading.Thread(target=render)
            thread.start()
            parts = made / "cut.parts"
            waits_for("first part", lambda: any(parts.glob("*.part")))
            assert len(list(parts.glob("*.part"))) < 7
            kill_one(client)
            thread.join()
        assert len(result) == 1
        for ending in (".exr", ".png"):
            assert Path(f"{whole}{ending}").read_bytes() == Path(f"{cut}{ending}").read_bytes()
        assert not parts.exists()


def test_workers_read_files_elsewhere_where_their_folder_is_allowed() -> None:
    flat = ROOT / "scenes" / "flat-leaf" / "scene.toml"
    with folder() as made, cluster() as client:
        (made / "sky.csv").write_text("300,0.1\n2600,0.1\n")
        sky = {"lights.sky.constant.radiance_w_m2_sr_nm": {"file": made / "sky.csv"}}
        here = os.path.relpath(made)
        client.run(os.chdir, "/")
        pictures = lamina.sweep(
            flat, client, store=made / "s.zarr", values=SMALL | sky, seeds=1, spp=1, allow=here
        )
        assert bool(pictures.done.all())
        picture = lamina.render_in_parts(
            flat,
            SMALL | sky,
            client=client,
            out=made / "picture",
            spp=2,
            parts=2,
            allow=[here],
        )
        assert picture.radiance.shape[:2] == (8, 12)


def test_failures_are_told_when_the_rest_is_done() -> None:
    with folder() as made:
        place = made / "s.zarr"
        try:
            lamina.sweep(FURNACE, store=place, over={RADIUS: [1, -1]})
        except lamina.LaminaError as refused:
            assert refused.code == 2 and "--over:1:" in str(refused)
        else:
            raise AssertionError("a negative radius was taken")
        assert not place.exists()
        sizes = {"film.spectral.size": [[12, 8], [8, 8]]}
        try:
            lamina.sweep(FURNACE, store=place, over=sizes, spp=1)
        except lamina.LaminaError as refused:
            assert "task 1: " in str(refused) and "one size" in str(refused)
        else:
            raise AssertionError("pictures of two sizes went into one store")
        assert stores.results(place).done.values.tolist() == [True, False]


def test_the_scheduler_gets_no_pictures() -> None:
    """What a task is called with, and gives back, is small whatever the pictures hold."""
    import pickle

    with folder() as made:
        listing = list_tasks(FURNACE, ["--over", f"{RADIUS}=0.5..2/500"], made / "tasks")
        assert len(listing.ids) == len(set(listing.ids)) == 500
        layer = lamina.render(FURNACE, SMALL, spp=1).radiance
        assert sweeping.batch_of(listing, {"radiance": layer}) == 1
        call = (str(made), str(listing.file), listing.offsets[0], 0, 1, str(program()), 1)
        assert len(pickle.dumps((sweeping.work, call))) < 1000
