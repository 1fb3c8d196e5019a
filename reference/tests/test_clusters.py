"""Programs that end with their parents, bars of progress, and arrays by the CF conventions."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import termios
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from distributed import Client, LocalCluster

import lamina
from lamina.program import HELD, Started, let_go, run, start

ROOT = Path(__file__).resolve().parents[2]
FURNACE = ROOT / "scenes" / "furnace" / "scene.toml"
FLAT = ROOT / "scenes" / "flat-leaf" / "scene.toml"
CROTON = ROOT / "scenes" / "croton" / "scene.toml"
CANOPY = ROOT / "scenes" / "rami" / "hom01.toml"
RADIUS = "film.spectral.filter_radius_px"
SMALL = {"film.spectral.size": [12, 8]}
# What renders for minutes.
LONG = ["render", FURNACE, "--spp", "1000000", "--noise", "0", "--threads", "1"]


def ends(pid: int, seconds: float) -> bool:
    """Whether a process ends, or is a zombie, within a time."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        try:
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except FileNotFoundError:
            return True
        if state == "Z":
            return True
        time.sleep(0.01)
    return False


def appears(file: Path) -> None:
    """Waits up to a minute for a file."""
    until = time.monotonic() + 60
    while not file.exists():
        assert time.monotonic() < until, f"{file} does not appear"
        time.sleep(0.01)


def works(pid: int, seconds: float) -> None:
    """Waits up to a minute until a process has used so much of a processor."""
    until = time.monotonic() + 60
    used = 0.0
    while used < seconds:
        assert time.monotonic() < until, f"{pid} has used {used} s of a processor"
        time.sleep(0.05)
        user = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[11]
        used = int(user) / os.sysconf("SC_CLK_TCK")


def children(pid: int) -> list[int]:
    """The processes that a process has started."""
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


def stopped(started: Started) -> bool:
    """Lets a program go; whether it then ends soon."""
    let_go(started.held)
    is_over = ends(started.process.pid, 2)
    started.process.kill()
    started.process.communicate()
    return is_over


@pytest.fixture
def client() -> Iterator[Client]:
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as machines,
        Client(machines) as client,
    ):
        yield client


def test_a_render_ends_with_its_work_saved_when_python_is_killed(tmp_path: Path) -> None:
    code = (
        "import lamina, sys\n"
        "lamina.render(sys.argv[1], spp=1000000, noise=0, threads=1, out=sys.argv[2])\n"
    )
    stem = tmp_path / "kept"
    parent = subprocess.Popen([sys.executable, "-c", code, str(FURNACE), str(stem)])
    appears(tmp_path / ".lamina-kept.exr.lock")
    [program] = children(parent.pid)
    works(program, 0.8)
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    assert ends(program, 2)
    assert stem.with_suffix(".checkpoint").is_file()
    assert lamina.read(stem.with_suffix(".exr")).attrs["sceneName"] == "furnace"


def test_a_render_goes_on_when_the_thread_that_started_it_ends(tmp_path: Path) -> None:
    started: list[Started] = []
    words = [*LONG, "--out", tmp_path / "x"]
    thread = threading.Thread(target=lambda: started.append(start(words)))
    thread.start()
    thread.join()
    assert not ends(started[0].process.pid, 1.5)
    assert stopped(started[0])


def test_no_other_program_and_no_fork_keeps_a_program_running(tmp_path: Path) -> None:
    first = start([*LONG, "--out", tmp_path / "first"])
    second = start([*LONG, "--out", tmp_path / "second"])
    fork = os.fork()
    if fork == 0:
        time.sleep(60)
        os._exit(0)
    assert stopped(first)
    assert second.process.poll() is None
    assert stopped(second)
    os.kill(fork, signal.SIGKILL)
    os.waitpid(fork, 0)
    assert not HELD


@pytest.mark.parametrize(
    "words",
    [
        # These grow for a while.
        ["render", CROTON, "--out", "x"],
        ["grow", "poplar-x10", "--out", "x.svg"],
        ["instruments", CANOPY, "--rays", "1000000000", "--out", "x.csv"],
        ["merge", "whole.part", "--out", "pipe"],
        ["optics", "--out", "pipe.csv"],
    ],
    ids=lambda words: words[0],
)
def test_every_command_ends_with_its_input(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    if words[0] == "merge":
        words_of_part = ["--spp", "1", "--samples", "0..1", "--noise", "0", "--out", "whole"]
        run(["render", FURNACE, *words_of_part])
    # Programs wait at pipes that nobody reads.
    for ending in ("csv", "exr"):
        os.mkfifo(f"pipe.{ending}")
    started = start(words)
    assert not ends(started.process.pid, 0.5), started.process.communicate()
    assert stopped(started)
    assert not list(tmp_path.glob(".lamina-*"))


def test_an_interrupted_call_leaves_no_program(tmp_path: Path) -> None:
    # A shell that runs the tests in its background lets them ignore it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        started = start([*LONG, "--checkpoint-every", "0.1", "--out", tmp_path / "x"])

        def interrupt() -> None:
            # Once there is something to save.
            until = time.monotonic() + 60
            while not (tmp_path / "x.checkpoint").exists() and time.monotonic() < until:
                time.sleep(0.1)
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=interrupt).start()
        with pytest.raises(KeyboardInterrupt):
            started.result()
    finally:
        signal.signal(signal.SIGINT, before)
    assert started.process.returncode == 130
    assert (tmp_path / "x.checkpoint").is_file()


def test_a_sweep_shows_a_bar_if_that_is_asked_for(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    wanted = {"over": {RADIUS: [0.5, 1, 1.5]}, "values": SMALL, "spp": 1}
    lamina.sweep(FURNACE, store=tmp_path / "quiet.zarr", **wanted)
    assert capfd.readouterr().err == ""
    lamina.sweep(FURNACE, store=tmp_path / "told.zarr", progress=True, **wanted)
    assert "3/3" in capfd.readouterr().err
    # What was done before counts.
    lamina.sweep(FURNACE, store=tmp_path / "told.zarr", progress=True, **wanted)
    assert "3/3" in capfd.readouterr().err


def test_a_terminal_shows_a_bar_unasked(tmp_path: Path) -> None:
    terminal, end = os.openpty()
    termios.tcsetwinsize(end, (24, 80))
    code = "import lamina, sys; lamina.sweep(sys.argv[1], store=sys.argv[2], seeds=2, spp=1)"
    words = [sys.executable, "-c", code, str(FURNACE), str(tmp_path / "s.zarr")]
    subprocess.run(words, stderr=end, check=True)
    assert b"2/2" in os.read(terminal, 1 << 16)


def test_a_cluster_shows_bars_too(
    tmp_path: Path, client: Client, capfd: pytest.CaptureFixture[str]
) -> None:
    wanted = {"over": {RADIUS: [0.5, 1]}, "values": SMALL, "spp": 1}
    lamina.sweep(FURNACE, client, store=tmp_path / "s.zarr", progress=True, **wanted)
    assert "2/2" in capfd.readouterr().err
    whole = lamina.render_in_parts(
        FURNACE, SMALL, client=client, out=tmp_path / "p", spp=4, parts=2, progress=True
    )
    assert "2/2" in capfd.readouterr().err
    assert whole.attrs["spp"] == 4


def test_arrays_explain_themselves_by_the_conventions(tmp_path: Path) -> None:
    picture = lamina.render(FLAT, SMALL, spp=1, seed=2)
    swept = lamina.sweep(
        FLAT, store=tmp_path / "s.zarr", over={RADIUS: [0.5, 1.5]}, values=SMALL, spp=1
    )
    leaves = lamina.optics(chlorophyll=[20, 40], wavelengths=[550, 680])
    for data in (picture, swept):
        assert data.attrs["Conventions"] == "CF-1.11"
        assert {"title", "source", "history"} <= set(data.attrs)
        assert data.x.values.tolist() == list(range(12))
        assert data.radiance.attrs["ancillary_variables"] == "radiance_variance"
    for data in (picture, swept, leaves):
        assert data.wavelength.attrs["standard_name"] == "radiation_wavelength"
        for name, variable in data.variables.items():
            assert "long_name" in variable.attrs, name
            assert "units" in variable.attrs or variable.dtype.kind in "UTb", name
    assert swept[RADIUS].attrs == {"long_name": RADIUS, "units": "1"}
    for number, data in enumerate((picture, swept, leaves)):
        file = tmp_path / f"{number}.nc"
        data.to_netcdf(file)
        with xr.open_dataset(file) as kept:
            assert all("_FillValue" not in kept[name].encoding for name in kept.coords)
            np.testing.assert_array_equal(kept.wavelength, data.wavelength)


def test_measures_of_leaves_have_the_units_of_their_names(tmp_path: Path) -> None:
    segments = {"kill_distance_segments": [3, 4]}
    leaves = lamina.sweep("runions-9c", store=tmp_path / "s.zarr", over=segments)
    for name, unit in (
        ("vein_density_mm_per_mm2", "mm-1"),
        ("area_mm2", "mm2"),
        ("vein_distance_mm_mean", "mm"),
        ("branching_angle_deg_median", "degree"),
        ("width_over_length", "1"),
    ):
        assert leaves[name].attrs["units"] == unit, name
