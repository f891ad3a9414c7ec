#!/usr/bin/env python3
"""Memory over a million solves, one by one.

    .venv/bin/python benches/python/leaks.py [SOLVES]      (after crates/python/environment)
"""

import resource
import sys
import time

import funicular as fn

PARTS = 10


def resident_mb():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize() / 2**20


def main():
    solves = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000
    system = fn.System(lengths=[1.0, 1.2, 0.8], masses=[1.0, 2.0, 1.0], end=(1.5, 0.0, -0.5))
    begun = time.monotonic()
    print("    solves   resident / MB       s")
    for part in range(PARTS + 1):
        print(f"{part * solves // PARTS:10}   {resident_mb():13.1f}   {time.monotonic() - begun:5.0f}", flush=True)
        if part < PARTS:
            for _ in range(solves // PARTS):
                answer = system.solve(census="never")
                assert answer.joints_m.shape == (4, 3)
    assert answer.rung == "optimal"


if __name__ == "__main__":
    main()
