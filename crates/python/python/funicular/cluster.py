"""Large work on a Dask cluster: parts of it on its workers, each retried where a worker dies.

What comes out is, byte for byte, what one machine computes: a part depends on nothing but its data. Every worker needs
this package. Under Slurm, dask-jobqueue's ``SLURMCluster`` is such a cluster.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._numbers import Array, whole
from ._progress import Progress, shown
from .batch import ARRAYS, slices, solve_rows
from .errors import ClusterError, Error, StoreError
from .system import System

if TYPE_CHECKING:
    import distributed

Starts = tuple[int, int, str, str]
"""Starts of a sweep: how many, the number they come from, how they are spread, and the solver."""

RETRIES = 3
"""How often a part is tried again."""

PARTS_PER_THREAD = 4
"""Parts for each thread of the cluster: what a dead worker loses is little, and the last part ends soon."""

PAUSE_S = 5.0
"""Wait before a part that a disk failed is tried again: a disk needs time to recover."""

WAIT_S = 1.0
"""Between looks at a folder that another process is writing."""

PATIENCE_S = 7200.0
"""Longest wait for such a process: a shard of an hour or two."""


def _parts(client: distributed.Client, wanted: int | None) -> int:
    if wanted is not None:
        return whole("parts", wanted, 1)
    threads = sum(int(count) for count in client.nthreads().values())
    return max(1, PARTS_PER_THREAD * threads)


def _gather(client: distributed.Client, tasks: list[Any], what: str, progress: Progress) -> list[Any]:
    """The results in the order of the tasks; all are cancelled where one cannot be finished."""
    from distributed import as_completed

    try:
        with shown(progress) as callback:
            for done, task in enumerate(as_completed(tasks), 1):
                if task.status != "finished":
                    error = task.exception()
                    # Bad input is told as on one machine; what ended a worker has no better name.
                    if isinstance(error, Error) and not isinstance(error, StoreError):
                        raise error
                    raise ClusterError(f"a part of the {what} could not be finished: {error}") from error
                if callback is not None:
                    callback(what, done, len(tasks))
        return [task.result() for task in tasks]
    finally:
        client.cancel(tasks)


def solve_parts(
    client: distributed.Client,
    data: dict[str, Array | None],
    settings: tuple[float, str, int],
    parts: int | None,
    progress: Progress,
) -> dict[str, Any]:
    """A batch in parts on the workers."""
    lengths = data["lengths"]
    assert lengths is not None
    pieces = list(slices(len(lengths), _parts(client, parts))) or [slice(0, 0)]
    tasks = []
    for piece in pieces:
        rows = {name: None if whole_array is None else whole_array[piece] for name, whole_array in data.items()}
        tasks.append(client.submit(solve_rows, rows, settings, retries=RETRIES, pure=False))
    found = _gather(client, tasks, "parts of the batch", progress)
    joined: dict[str, Any] = {name: np.concatenate([part[name] for part in found]) for name in ARRAYS}
    failures = []
    for piece, part in zip(pieces, found):
        failures += [(piece.start + chain, told) for chain, told in part["failures"]]
    return {**joined, "failures": failures}


def run_shard(
    system: System, starts: Starts, shard: tuple[int, int], rows: tuple[bool, str], folder: str
) -> str:
    """Write one shard on a worker, or go on with what another has left of it.

    If a dead worker's process is still writing, the folder is locked: wait for it. What a disk fails may pass: the
    error is raised after a pause, and the scheduler tries again.
    """
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            text = _native.sweep_write(system._problem, *starts, shard, *rows, folder, True, 1, None)
        except StoreError as error:
            busy = "another process is writing" in str(error)
            if busy and time.monotonic() < deadline:
                time.sleep(WAIT_S)
                continue
            if error.may_pass:
                time.sleep(PAUSE_S)
            raise
        if text is None:
            raise ClusterError(f"shard {shard[0]} of {shard[1]} was stopped")
        return text


def sweep_shards(
    client: distributed.Client,
    system: System,
    starts: Starts,
    rows: tuple[bool, str],
    out: Path,
    shards: int | None,
    progress: Progress,
) -> str:
    """A sweep in shards on the workers, joined in ``out/merged``."""
    out = out.resolve()
    count = _parts(client, shards)
    width = len(str(count))
    folders = [out / "shards" / f"{k:0{width}}-of-{count}" for k in range(1, count + 1)]
    (out / "shards").mkdir(parents=True, exist_ok=True)
    tasks = [
        client.submit(run_shard, system, starts, (k, count), rows, str(folder), retries=RETRIES, pure=False)
        for k, folder in enumerate(folders, 1)
    ]
    _gather(client, tasks, "shards", progress)
    text = _native.sweep_merge(folders, out / "merged", 0, None)
    if text is None:
        raise KeyboardInterrupt
    return text
