#!/usr/bin/env python3
"""100,000 chains of 10 bars: the package beside a loop over SciPy, in one run on one machine.

    crates/python/environment && .venv/bin/pip install -r benches/python/requirements.txt
    .venv/bin/python benches/python/batch.py [--chains N] [--scipy N]

Both get the same chains, which hang with all bars in tension, and both give all joints and forces. SciPy solves, chain
by chain, for the pull on the first anchor (two unknowns in the plane of the anchors): ``scipy.optimize.root`` with the
derivative given, from the pull of a parabola. That is the least that a loop can do; the package also holds every answer
against the statics judge, and ``solver="both"`` solves by both solvers, compares and certifies.
"""

import argparse
import resource
import time

import funicular as fn
import numpy as np
from scipy.optimize import root

G = 9.80665
BARS = 10
RUNS = 5
LIMIT_S = 1.0


def draw(count):
    """Random chains whose anchors are further apart than the longest bar, so that no bar is pushed."""
    random = np.random.default_rng(20261122)
    lengths, masses = random.uniform(0.5, 1.5, (count, BARS)), random.uniform(0.5, 2.0, (count, BARS))
    angle, steep = random.uniform(0, 2 * np.pi, count), random.uniform(-0.6, 0.6, count)
    direction = np.stack([np.cos(angle) * np.cos(steep), np.sin(angle) * np.cos(steep), np.sin(steep)], axis=1)
    return lengths, masses, direction * (random.uniform(0.4, 0.9, count) * lengths.sum(axis=1))[:, None]


def by_scipy(lengths, masses, end):
    """Joints (n + 1, 3) and forces (n + 1, 3) of one chain."""
    across = np.hypot(end[0], end[1])
    level = end[:2] / across
    weights = G * masses
    # Bar i is parallel to the mean of the forces at its ends.
    carried = np.cumsum(weights) - 0.5 * weights

    def closure(pull):
        force = np.stack([np.full(len(carried), pull[0]), pull[1] + carried])
        size = np.hypot(*force)
        unit = force / size
        gap = (lengths * unit).sum(axis=1) - (across, end[2])
        k = lengths / size
        mixed = -(k * unit[0] * unit[1]).sum()
        return gap, np.array([[(k * unit[1] ** 2).sum(), mixed], [mixed, (k * unit[0] ** 2).sum()]])

    total, chord = lengths.sum(), np.hypot(across, end[2])
    sag = np.sqrt(max(24 * (total / chord - 1), 1e-6))
    found = root(closure, [weights.sum() / sag, weights.sum() * (end[2] / across / sag - 0.5)], jac=True, tol=1e-13)
    force = np.stack([np.full(len(carried), found.x[0]), found.x[1] + carried])
    steps = lengths * force / np.hypot(*force)
    x, z = np.concatenate([[[0], [0]], np.cumsum(steps, axis=1)], axis=1)
    joints = np.stack([level[0] * x, level[1] * x, z], axis=1)
    vertical = found.x[1] + np.concatenate([[0.0], np.cumsum(weights)])
    forces = np.stack([level[0] * np.full(len(vertical), found.x[0]), level[1] * found.x[0] + 0 * vertical, vertical], 1)
    forces[0] *= -1.0
    return joints, forces, found.success


def timed(work):
    begun, user = time.perf_counter(), resource.getrusage(resource.RUSAGE_SELF).ru_utime
    found = work()
    return found, time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_utime - user


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--chains", type=int, default=100_000)
    parser.add_argument("--scipy", type=int, help="chains for SciPy; all if not said")
    options = parser.parse_args()
    data = draw(options.chains)
    print(f"{options.chains} chains of {BARS} bars, {fn.get_threads()} threads")
    best = None
    for solver in ("lagrange", "both"):
        runs = [timed(lambda: fn.solve_many(*data, solver=solver)) for _ in range(RUNS if solver == "lagrange" else 1)]
        batch, wall, user = min(runs, key=lambda run: run[1])
        assert batch.ok.all()
        print(f"funicular, {solver:8} {wall:8.3f} s, {user:8.3f} s of processors; out of balance {batch.statics.max():.1e}")
        best = best or (batch, wall)
    count = options.scipy or options.chains

    def loop():
        return [by_scipy(*(rows[k] for rows in data)) for k in range(count)]

    found, wall, _ = timed(loop)
    solved = [k for k, (_, _, success) in enumerate(found) if success]
    scaled = wall * options.chains / count
    print(f"scipy.optimize.root, {count} chains: {wall:.1f} s, {scaled:.1f} s for all; {len(solved)} solved")
    batch, ours = best
    apart = max(np.abs(found[k][0] - batch.joints_m[k]).max() for k in solved)
    relative = max(np.abs(found[k][1] - batch.forces_n[k]).max() / np.abs(batch.forces_n[k]).max() for k in solved)
    print(f"largest difference: {apart:.1e} m, forces {relative:.1e} of the largest")
    print(f"ratio {scaled / ours:.0f}; within {LIMIT_S:g} s: {'yes' if ours <= LIMIT_S else 'no'}")


if __name__ == "__main__":
    main()
