#!/usr/bin/env python3
"""Run a sweep on the workers of a Dask cluster: one shard per task, then merge.

    dask_sweep.py --scheduler tcp://host:8786 --program funicular --shards 64 --out DIR -- \
        chain.toml --seeds 1e9 --solver both

What stands after `--` is passed to `funicular sweep`. Every worker needs the program under the given name, and
a file system that all of them share: shards are written to DIR/shards/K-of-N, and DIR/merged is, byte for byte,
the folder that one process would have written.

A shard whose worker dies is given to another worker, which goes on with the parts that are whole (`--resume`).
If the dead worker's process is still writing, the new one waits for it: the folder is locked. A shard that
fails for a reason of its own (exit code 2: bad input) fails at once and for all; one that a disk fails (exit code 3:
full, or out of reach) or that is interrupted (130, as batch systems do it) or killed is retried. Without
`--scheduler` a local cluster is started.

Under Slurm, dask-jobqueue's SLURMCluster is such a scheduler; a job array needs no Dask at all: `funicular
sweep ... --shard $SLURM_ARRAY_TASK_ID/64 --resume --out shards/$SLURM_ARRAY_TASK_ID`, then `funicular merge`.

Exit codes are those of `funicular`: 0 done, 1 a check failed, 2 bad input, 130 interrupted; and 3 if a shard or the
merge could not be finished: the same command goes on.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import time

from dask.distributed import Client, LocalCluster, as_completed

# Exit codes of the program.
DONE, CHECK_FAILED, BAD_INPUT, UNDECIDED = 0, 1, 2, 3

# Seconds between looks at a folder that another process is writing.
WAIT = 1.0

# Longest wait for such a process, in seconds: a shard of an hour or two.
PATIENCE = 7200.0


class ShardFailed(Exception):
    """A shard that another attempt may finish."""


# Seconds before a shard that failed may be tried again, by the worker that has it: a disk needs time to recover.
PAUSE = 5.0


def run_shard(program, arguments, number, shards, folder, threads):
    """Run one shard on a worker; the exit code and what the program said."""
    command = [program, "sweep", *arguments, "--shard", f"{number}/{shards}"]
    command += ["--out", folder, "--resume", "--json", "--threads", str(threads)]
    deadline = time.monotonic() + PATIENCE
    while True:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        words = " ".join(done.stderr.split())
        if "another process is writing" not in words or time.monotonic() > deadline:
            break
        time.sleep(WAIT)
    if done.returncode in (DONE, CHECK_FAILED):
        return number, done.returncode, json.loads(done.stdout)["seeds"]["count"]
    if done.returncode == BAD_INPUT:
        return number, BAD_INPUT, done.stderr
    time.sleep(PAUSE)
    raise ShardFailed(f"shard {number}: exit code {done.returncode}: {words}")


def parse(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a running cluster; none: local")
    parser.add_argument("--workers", type=int, default=2, help="of a local cluster [2]")
    parser.add_argument("--program", default="funicular", help="the program on the workers [funicular]")
    parser.add_argument("--shards", type=int, required=True, help="tasks; some per worker")
    parser.add_argument("--threads", type=int, default=1, help="of each shard [1]")
    parser.add_argument("--retries", type=int, default=3, help="of each shard [3]")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="DIR")
    parser.add_argument("sweep", nargs="+", help="after --: arguments of funicular sweep")
    options = parser.parse_args(arguments)
    for name in ("shards", "workers"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} must be positive")
    return options


def run_shards(client, options, folders):
    """All shards; the worst exit code."""
    tasks = [
        client.submit(
            run_shard,
            options.program,
            options.sweep,
            number,
            options.shards,
            str(folder),
            options.threads,
            key=f"shard-{number}-of-{options.shards}-{folder}",
            retries=options.retries,
            pure=False,
        )
        for number, folder in enumerate(folders, 1)
    ]
    worst, finished = DONE, 0
    for task in as_completed(tasks):
        # Not KilledWorker alone: whatever ended it, the shard is not there.
        if task.status != "finished":
            print(f"a shard could not be finished: {task.exception()}", file=sys.stderr)
            client.cancel(tasks)
            return UNDECIDED
        number, code, result = task.result()
        if code == BAD_INPUT:
            print(result, file=sys.stderr)
            client.cancel(tasks)
            return BAD_INPUT
        finished += 1
        worst = max(worst, code)
        print(f"shard {number}: {result} seeds ({finished} of {len(tasks)})", file=sys.stderr)
    return worst


def main(arguments=None):
    options = parse(arguments)
    out = options.out.resolve()
    width = len(str(options.shards))
    folders = [
        out / "shards" / f"{number:0{width}}-of-{options.shards}"
        for number in range(1, options.shards + 1)
    ]
    (out / "shards").mkdir(parents=True, exist_ok=True)
    cluster = None
    if options.scheduler is None:
        cluster = LocalCluster(
            n_workers=options.workers, threads_per_worker=1, dashboard_address=None
        )
    try:
        with Client(options.scheduler or cluster) as client:
            code = run_shards(client, options, folders)
    finally:
        if cluster is not None:
            cluster.close()
    if code in (BAD_INPUT, UNDECIDED):
        return code
    command = [options.program, "merge", *map(str, folders), "--out", str(out / "merged")]
    merged = subprocess.run(command, stdin=subprocess.DEVNULL).returncode
    if merged < 0:
        print(f"the merge was ended by signal {-merged}", file=sys.stderr)
        return UNDECIDED
    return max(code, merged)


if __name__ == "__main__":
    sys.exit(main())
