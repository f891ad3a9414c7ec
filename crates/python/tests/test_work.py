"""Work beside the interpreter: the lock, Ctrl-C, progress, forks, other interpreters, leaks."""

import gc
import os
import resource
import signal
import subprocess
import sys
import threading
import time

import funicular as fn
import numpy as np
import pytest

# A census of a chain of 16 bars takes seconds.
LONG = {"lengths": np.linspace(0.7, 1.3, 16), "masses": np.linspace(1.0, 2.0, 16), "end": (4.0, 0.0, -1.0)}


def test_the_lock_is_released():
    system = fn.System.case("three-equal-bars")
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    other = threading.Thread(target=tick)
    other.start()
    begun = time.monotonic()
    system.sweep(1_000_000, solver="lagrange")
    ended = time.monotonic()
    done.set()
    other.join()
    within = [t for t in ticks if begun < t < ended]
    assert len(within) > 20 * (ended - begun)


@pytest.mark.parametrize(
    "work",
    [
        lambda: fn.System(**LONG).census(),
        lambda: fn.System.case("three-equal-bars").sweep(10**12),
        lambda: fn.System.case("three-equal-bars").simulate(time=1e5, start="seed:1"),
        lambda: fn.System(**{**LONG, "lengths": np.ones(6), "masses": np.ones(6)}).trace("anchors.end_m.x=1..5:400"),
        lambda: fn.solve_many(np.ones((500_000, 10)), 1.0, (4.0, 0.0, 0.0), solver="both"),
    ],
    ids=["census", "sweep", "simulate", "trace", "solve_many"],
)
def test_ctrl_c_stops_long_work(work):
    # What is started in the background of a shell ignores it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work()
    assert time.monotonic() - begun < 5.0
    timer.join()


def test_short_work_does_not_wait_for_what_a_thread_has_begun():
    lengths = np.random.default_rng(0).uniform(0.5, 1.0, (100_000, 10))
    begun = threading.Event()

    def long():
        fn.solve_many(lengths, np.ones(10), (3.0, 0.0, -1.0), solver="both", progress=lambda *_: begun.set())

    other = threading.Thread(target=long)
    other.start()
    begun.wait()
    fn.solve(fn.System.case("three-equal-bars"))
    assert other.is_alive()
    other.join()


def test_a_cancelled_sweep_leaves_what_goes_on(tmp_path):
    system = fn.System.case("three-equal-bars")
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    settings = {"solver": "lagrange", "seed": 5}
    system.sweep(500_000, out=whole, **settings)

    class Enough(Exception):
        pass

    def enough(what, done, total):
        raise Enough

    with pytest.raises(Enough):
        system.sweep(500_000, out=stopped, progress=enough, **settings)
    for _ in range(200):
        try:
            again = system.sweep(500_000, out=stopped, resume=True, **settings)
            break
        except fn.StoreError as error:
            # The work that was cancelled ends by itself, some parts later.
            assert error.may_pass
            time.sleep(0.1)
    assert again.seeds == 500_000
    assert {p.name: p.read_bytes() for p in whole.iterdir()} == {p.name: p.read_bytes() for p in stopped.iterdir()}
    with pytest.raises(fn.StoreError):
        system.sweep(1000, out=stopped, **settings)


def test_progress_is_told_in_the_thread_of_the_caller():
    told = []
    fn.System.case("three-equal-bars").sweep(
        1_000_000, solver="lagrange", progress=lambda what, done, total: told.append((threading.get_ident(), what, done, total))
    )
    assert told and {(t[0], t[1], t[3]) for t in told} == {(threading.get_ident(), "starts", 1_000_000)}
    assert [t[2] for t in told] == sorted(t[2] for t in told)
    fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0), progress=True)


def test_what_progress_raises_is_raised():
    def stop(*_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        fn.System(**LONG).census(progress=stop)


def test_a_forked_process_works():
    fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0))
    code = """
import os, funicular as fn
fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0))
child = os.fork()
if child == 0:
    os._exit(0 if fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)).agrees else 1)
print(os.waitpid(child, 0)[1])
"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert said.stdout.strip() == "0"


def test_many_threads_of_python_at_once():
    expected = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(1, 0, -1)).joints_m.tobytes()
    found = []

    def work():
        for _ in range(20):
            found.append(fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(1, 0, -1)).joints_m.tobytes())

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 160


def test_other_interpreters_are_refused_clearly():
    """A second interpreter in one process gets an ImportError that says why, and the first goes on."""
    code = """
import funicular
try:
    import _xxsubinterpreters as interpreters
except ImportError:
    import _interpreters as interpreters
other = interpreters.create()
script = '''
import sys
sys.path[:] = PATH
try:
    from funicular import _native
except ImportError as error:
    print("refused:", error, flush=True)
else:
    print("imported", flush=True)
'''.replace("PATH", repr(__import__("sys").path))
interpreters.run_string(other, script)
print(funicular.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)).rung)
"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert said.returncode == 0, said.stderr
    lines = said.stdout.splitlines()
    assert lines[0].startswith("refused:") and "interpreter" in lines[0] and lines[-1] == "optimal", said


def resident_kb():
    gc.collect()
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize() // 1024


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="memory is read from /proc")
def test_nothing_leaks():
    """Hundreds of thousands of solves in batches, thousands one by one, and as many errors, leave the memory as it was."""
    lengths, masses = np.ones((50_000, 3)), np.ones((50_000, 3))
    ends = np.stack([np.linspace(1, 2.9, 50_000), np.zeros(50_000), np.zeros(50_000)], axis=1)
    system = fn.System.case("two-bars")
    table = system.solve().joints

    def one_by_one():
        for _ in range(300):
            system.solve(census="never")
            table.__arrow_c_stream__()
            try:
                fn.System(lengths=[1, 1], masses=[1, 1], end=(3, 0, 0))
            except fn.OutOfReach:
                pass

    for _ in range(2):
        fn.solve_many(lengths, masses, ends)
        one_by_one()
    # A leak grows each time; what allocators take once more for themselves does not.
    for _ in range(3):
        before = resident_kb()
        for _ in range(4):
            fn.solve_many(lengths, masses, ends)
            one_by_one()
        grown = resident_kb() - before
        if grown < 2_000:
            break
    # A leak of one joint of every solve would be 5 MB; what allocators keep is less.
    assert grown < 2_000, f"{grown} kB"
