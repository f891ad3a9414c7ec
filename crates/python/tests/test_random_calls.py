"""Ten thousand calls with whatever arguments: an answer or an error of ours, never a crash."""

import random

import funicular as fn
import numpy as np

CALLS = 10_000

NUMBERS = (0, 1, -1, 2, 0.5, 1e-300, 1e300, 5e-324, float("nan"), float("inf"), 2**70, True, None, "1", b"1", 1j)


def anything(draw, depth=0):
    """A number, text, array or container, mostly of no use."""
    kind = draw.randrange(12)
    if kind < 4 or depth > 2:
        return draw.choice(NUMBERS)
    if kind < 7:
        return [anything(draw, depth + 1) for _ in range(draw.randrange(4))]
    if kind == 7:
        return tuple(draw.uniform(-3, 3) for _ in range(3))
    if kind == 8:
        shape = [draw.randrange(4) for _ in range(draw.randrange(3))]
        dtype = draw.choice(["f8", "f4", "i4", "u1", "c16", "?", "O", "U3", ">f8"])
        return np.zeros(shape, dtype=dtype)
    if kind == 9:
        keys = ("name", "joints", "bars", "anchors", "A", "at_m", "mass_kg", "length_m", "from", "to", "start_m", 3)
        return {draw.choice(keys): anything(draw, depth + 1) for _ in range(draw.randrange(4))}
    if kind == 10:
        return draw.choice(["", "both", "lagrange", "\x00", "\ud800", "A" * 1000, "[joints]\nA = 1\n", "{", "{}"])
    return object()


def usable(draw):
    """The arrays of a chain, one of them perhaps replaced."""
    n = draw.randrange(1, 5)
    chain = {
        "lengths": [draw.uniform(0.5, 2) for _ in range(n)],
        "masses": [draw.uniform(0, 2) for _ in range(n)],
        "end": [draw.uniform(-1, 1) for _ in range(3)],
    }
    if draw.random() < 0.7:
        chain[draw.choice([*chain, "start", "centres", "inertias", "gravity", "name"])] = anything(draw)
    return chain


def call(draw, system):
    which = draw.randrange(16)
    if which < 3:
        return fn.solve(**usable(draw), census="never")
    if which == 3:
        return fn.System.from_dict(anything(draw))
    if which == 4:
        return fn.System.from_toml(anything(draw))
    if which == 5:
        return fn.solve_many(anything(draw), anything(draw), anything(draw))
    if which == 6:
        given = ("joints", "anchors", "bars", "lengths", "masses", "joint_masses", "forces", "kinds", "stiffnesses")
        base = {"joints": 3, "anchors": {0: (0, 0, 0)}, "bars": [[0, 1], [1, 2]], "lengths": [1, 1], "masses": 1.0}
        return fn.System.from_arrays(**{**base, draw.choice(given): anything(draw)})
    if which == 7:
        return fn.judge(system, anything(draw), draw.choice([None, anything(draw)]))
    if which == 8:
        return system.trace(anything(draw), max_points=5)
    if which == 9:
        return system.simulate(time=0.01, **{draw.choice(["start", "step", "damping", "pushes"]): anything(draw)})
    if which == 10:
        return system.sweep(10, **{draw.choice(["seed", "spread", "solver", "threads"]): anything(draw)})
    if which == 11:
        return fn.Table({"a": anything(draw)}).__arrow_c_stream__()
    if which == 12:
        names = ("lengths", "masses", "stiffnesses", "joint_masses", "forces", "anchors", "solver")
        return system.solve_many(**{"lengths": [[1, 1], [1, 1.1]], draw.choice(names): anything(draw)})
    if which == 13:
        return system.basins(**{"size": 2, draw.choice(["size", "bars", "others", "threads"]): anything(draw)})
    if which == 14:
        return fn.gradients.pullback(system, {"lengths": [1, 1]}, draw.choice([np.ones((3, 3)), anything(draw)]), np.ones(2))
    return system.solve(**{draw.choice(["solver", "census", "equations", "threads"]): anything(draw)})


def test_no_call_crashes():
    draw = random.Random(2026)
    system = fn.System.case("two-bars")
    answers = errors = 0
    for _ in range(CALLS):
        try:
            call(draw, system)
        except fn.InternalError:
            raise
        except (fn.Error, TypeError, ValueError, AttributeError, OverflowError, KeyError):
            errors += 1
        else:
            answers += 1
    assert answers > CALLS // 20 and errors > CALLS // 4
    assert system.solve().rung == "optimal"
