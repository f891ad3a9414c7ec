"""On a real Dask cluster of two workers, one of them killed in the middle: the same bytes as on one machine."""

import filecmp
import os
import threading
import time

import funicular as fn
import numpy as np
import psutil
import pytest

pytest.importorskip("distributed")
from distributed import Client, LocalCluster  # noqa: E402

# What a cluster leaves behind when a worker is killed is no business of ours.
pytestmark = pytest.mark.filterwarnings("ignore")

SEEDS, SHARDS, PATIENCE_S = 2_000_000, 6, 120.0


@pytest.fixture(scope="module")
def client():
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client


def kill_a_busy_worker(client, shards):
    """Wait until a shard is half written, then end the process of a worker, as a power failure does."""
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        running = {address: keys for address, keys in client.processing().items() if keys}
        half = [f for f in shards.glob("*") if any(f.glob("part-*")) and not (f / "summary.json").exists()]
        if running and half:
            address = sorted(running)[0]
            process = client.run(os.getpid, workers=[address])[address]
            psutil.Process(process).kill()
            return
        time.sleep(0.002)
    raise AssertionError("no shard was ever half written")


def test_a_sweep_with_a_worker_killed_is_the_same_bytes(client, tmp_path):
    system = fn.System.case("three-equal-bars")
    settings = {"seed": 5, "solver": "lagrange", "angles": True}
    whole = system.sweep(SEEDS, out=tmp_path / "whole", **settings)
    killer = threading.Thread(target=kill_a_busy_worker, args=(client, tmp_path / "dask" / "shards"))
    killer.start()
    shared = system.sweep(SEEDS, out=tmp_path / "dask", client=client, shards=SHARDS, **settings)
    killer.join()
    names = sorted(os.listdir(tmp_path / "whole"))
    assert names == sorted(os.listdir(shared.folder)) and shared.seeds == SEEDS
    assert filecmp.cmpfiles(tmp_path / "whole", shared.folder, names, shallow=False) == (names, [], [])
    assert shared.data["outcomes"] == whole.data["outcomes"]


def test_a_batch_is_the_same_bytes(client):
    random = np.random.default_rng(1)
    lengths, masses = random.uniform(0.5, 1.5, (5000, 8)), random.uniform(0.1, 2, (5000, 8))
    ends = random.uniform(-2, 2, (5000, 3))
    ends[4321] = (1000, 0, 0)
    one = fn.solve_many(lengths, masses, ends)
    told = []
    shared = fn.solve_many(
        lengths, masses, ends, client=client, parts=7, progress=lambda what, done, total: told.append((done, total))
    )
    for name in ("joints_m", "forces_n", "axial_n", "energy_j", "residual", "statics", "rung"):
        assert getattr(one, name).tobytes() == getattr(shared, name).tobytes()
    assert told[-1] == (7, 7) and list(shared.failures) == [4321]


def test_a_batch_with_a_worker_killed_is_the_same_bytes(client):
    random = np.random.default_rng(2)
    lengths, masses = random.uniform(0.5, 1.5, (20_000, 8)), random.uniform(0.1, 2, (20_000, 8))
    ends = random.uniform(-2, 2, (20_000, 3))
    one = fn.solve_many(lengths, masses, ends, solver="both")
    killed = []

    def kill(what, done, total):
        # The first part is done, the others are on both workers.
        if not killed:
            address = sorted(client.nthreads())[0]
            process = client.run(os.getpid, workers=[address])[address]
            psutil.Process(process).kill()
            killed.append(process)

    shared = fn.solve_many(lengths, masses, ends, solver="both", client=client, parts=12, progress=kill)
    assert killed and not psutil.pid_exists(killed[0])
    for name in ("joints_m", "forces_n", "axial_n", "energy_j", "residual", "statics", "rung"):
        assert getattr(one, name).tobytes() == getattr(shared, name).tobytes()


def test_bad_input_is_told_and_not_retried(client, tmp_path):
    with pytest.raises(fn.SettingError):
        fn.System.case("two-bars").sweep(10, spread="nonsense", out=tmp_path / "bad", client=client, shards=2)
    with pytest.raises(fn.InputError):
        fn.System.case("two-bars").sweep(10, client=client)


def test_what_cannot_be_finished_is_told(client, tmp_path, monkeypatch):
    monkeypatch.setattr(fn.cluster, "PAUSE_S", 0.0)
    (tmp_path / "full" / "shards").mkdir(parents=True)
    (tmp_path / "full" / "shards" / "1-of-2").write_text("no folder")
    with pytest.raises(fn.ClusterError):
        fn.System.case("two-bars").sweep(1000, out=tmp_path / "full", client=client, shards=2)
