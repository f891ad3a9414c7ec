"""Every result is copied, pickled and sent to other processes whole."""

import copy
import pickle
from multiprocessing import get_context

import funicular as fn
import numpy as np
import pytest

CHAIN = {"lengths": [1.0, 1.0], "masses": [1.0, 1.0], "end": (1.0, 0.0, 0.0)}


def census():
    return fn.System(**CHAIN).census()


RESULTS = {
    "study": lambda: fn.System(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)).study("gravity_m_s2=9,10"),
    "gradient": lambda: fn.gradient(fn.System(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)), "joints.1.at_m.z"),
    "basins": lambda: fn.System(**CHAIN).basins(size=4),
    "rows": lambda: fn.System(**CHAIN).solve_many(lengths=[[1, 1], [1, 3]]),
    "system": lambda: fn.System(**CHAIN),
    "drawn system": lambda: fn.System(**CHAIN).near([[0, 0, 0], [0.5, 0, 0.9], [1, 0, 0]]),
    "answer": lambda: fn.solve(**CHAIN),
    "answer to a drawing": lambda: fn.solve(**CHAIN, near=[[0, 0, 0], [0.5, 0, 0.9], [1, 0, 0]]),
    "equilibrium": lambda: fn.solve(**CHAIN).equilibria[1],
    "evidence": lambda: fn.solve(**CHAIN).evidence,
    "proofs": lambda: fn.solve(**CHAIN).proofs,
    "proof": lambda: fn.solve(**CHAIN).proofs.verified,
    "record": lambda: fn.solve(**CHAIN).agreement,
    "table": lambda: fn.solve(**CHAIN).bars,
    "census": census,
    "batch": lambda: fn.solve_many([[1, 1], [1, 3]], 1.0, (1, 0, 0)),
    "judgement": lambda: fn.judge(fn.System(**CHAIN), [[0, 0, 0], [0.5, 0, -0.8], [1, 0, 0]]),
    "trace": lambda: fn.System(**CHAIN).trace("anchors.end_m.x=0.5..1.5:5"),
    "sweep": lambda: fn.System(**CHAIN).sweep(100),
    "motion": lambda: fn.System(**CHAIN).simulate(time=0.1),
    "modes": lambda: fn.System(**CHAIN).modes(),
    "modes of one": lambda: fn.System(**CHAIN).modes()[0],
    "reproduction": fn.reproduce,
}


def same(a, b):
    """Whether two objects are alike, through and through."""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, fn.System):
        return a == b
    if hasattr(a, "__dict__"):
        return same(vars(a), vars(b))
    return a == b


@pytest.mark.parametrize("made", RESULTS.values(), ids=RESULTS.keys())
def test_copies_are_whole(made):
    result = made()
    repr(result)
    for other in (copy.copy(result), copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
        assert other is not result and same(result, other) and repr(other) == repr(result)
    assert not same(result, made) and not same(np.zeros(1), np.ones(1))


def solved(length):
    return fn.solve(lengths=[length, length], masses=[1, 1], end=(1, 0, 0))


def test_results_come_back_from_other_processes():
    lengths = [0.6, 0.7, 0.8]
    with get_context("spawn").Pool(2) as pool:
        answers = pool.map(solved, lengths)
    assert [a.rung for a in answers] == ["optimal"] * 3
    assert np.allclose([a.joints_m[1, 2] for a in answers], [-((n**2 - 0.25) ** 0.5) for n in lengths])


def test_what_is_not_there_says_what_is():
    a = fn.solve(**CHAIN)
    with pytest.raises(AttributeError, match="index_in_space"):
        a.stability.nothing
    with pytest.raises(AttributeError, match="box_width"):
        a.proofs.verified.nothing
