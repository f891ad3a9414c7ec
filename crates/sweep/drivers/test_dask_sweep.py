#!/usr/bin/env python3
"""A real local cluster of two workers, one of them killed in the middle: the same bytes as one process.

    test_dask_sweep.py PROGRAM FOLDER
"""

import filecmp
import os
import pathlib
import subprocess
import sys
import threading
import time

import dask_sweep
import psutil
from dask.distributed import Client, LocalCluster

SHARDS = 6
SWEEP = ["--case", "three-equal-bars", "--seeds", "600_000", "--seed", "5", "--solver", "lagrange", "--angles"]

# Seconds after which something hangs.
PATIENCE = 300.0


def kill_a_busy_worker(client, shards):
    """Wait until a shard is half written, then end its worker and all its processes, as a power failure does."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        for address, process in client.run(os.getpid).items():
            worker = psutil.Process(process)
            for child in worker.children(recursive=True):
                try:
                    command = child.cmdline()
                except psutil.Error:
                    continue
                if "--out" not in command:
                    continue
                folder = pathlib.Path(command[command.index("--out") + 1])
                if (folder / "summary.json").exists() or not any(folder.glob("part-*")):
                    continue
                child.suspend()
                if (folder / "summary.json").exists():
                    child.resume()
                    continue
                worker.kill()
                child.kill()
                return address, folder
        time.sleep(0.005)
    raise AssertionError("no shard was ever half written")


def same(one, other):
    """Whether two folders hold the same files with the same bytes."""
    names = sorted(os.listdir(one))
    assert names == sorted(os.listdir(other)), (names, os.listdir(other))
    differing = [n for n in names if not filecmp.cmp(one / n, other / n, shallow=False)]
    assert not differing, differing
    return len(names)


# A program whose first try at the second shard meets a full disk, and whose first merge is killed.
UNRELIABLE = """#!/bin/sh
case "$*" in
sweep*"--shard 2/"*) if mkdir '{folder}/full' 2>/dev/null; then echo 'No space left on device' >&2; exit 3; fi ;;
merge*) if mkdir '{folder}/killed' 2>/dev/null; then kill -9 $$; fi ;;
esac
exec '{program}' "$@"
"""


def unreliable(program, folder):
    """Write it."""
    path = folder / "unreliable"
    path.write_text(UNRELIABLE.format(program=program, folder=folder))
    path.chmod(0o755)
    return path


def main():
    program, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    whole, out = folder / "whole", folder / "dask"
    subprocess.run(
        [program, "sweep", *SWEEP, "--out", whole], check=True, stdout=subprocess.DEVNULL
    )
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, Client(cluster) as client:
        arguments = ["--scheduler", cluster.scheduler_address, "--program", program]
        arguments += ["--shards", str(SHARDS), "--out", str(out), "--", *SWEEP]
        codes = []
        driver = threading.Thread(target=lambda: codes.append(dask_sweep.main(arguments)))
        driver.start()
        address, shard = kill_a_busy_worker(client, out / "shards")
        left = len(list(shard.glob("part-*")))
        assert not (shard / "summary.json").exists()
        print(f"killed {address} with {left} parts of shard {shard.name} written", flush=True)
        driver.join(PATIENCE)
        assert codes == [0], codes
        files = same(whole, out / "merged")
        print(f"{files} files: the same bytes as one process")

        # Bad input is told once, and not retried.
        bad = ["--scheduler", cluster.scheduler_address, "--program", program, "--shards", "2"]
        bad += ["--out", str(folder / "bad"), "--", "--case", "nonsense", "--seeds", "10"]
        assert dask_sweep.main(bad) == dask_sweep.BAD_INPUT

        # A disk that is full for a while costs an attempt, a merge that is killed is no success, and both go on.
        again = ["--scheduler", cluster.scheduler_address, "--shards", "2", "--out", str(folder / "again")]
        again += ["--program", str(unreliable(program, folder)), "--", "--case", "three-equal-bars"]
        again += ["--seeds", "20_000", "--solver", "lagrange"]
        assert dask_sweep.main(again) == dask_sweep.UNDECIDED
        assert (folder / "full").exists() and not (folder / "again/merged").exists()
        assert dask_sweep.main(again) == dask_sweep.DONE


if __name__ == "__main__":
    main()
