"""Many chains at a time."""

import funicular as fn
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st


def random_chains(k, n, seed=0):
    random = np.random.default_rng(seed)
    lengths = random.uniform(0.5, 1.5, (k, n))
    masses = random.uniform(0.1, 3.0, (k, n))
    direction = random.normal(size=(k, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    ends = direction * (random.uniform(0.2, 0.9, k) * lengths.sum(axis=1))[:, None]
    return lengths, masses, ends


@pytest.mark.parametrize("solver", ["lagrange", "both", "energy"])
def test_a_batch_is_its_chains(solver):
    lengths, masses, ends = random_chains(300, 6)
    b = fn.solve_many(lengths, masses, ends, solver=solver)
    assert b.ok.all() and b.statics.max() < 1e-11 and not b.failures and b.raise_failures() is b
    for k in range(0, 300, 37):
        a = fn.solve(lengths=lengths[k], masses=masses[k], end=ends[k], solver=solver, census="never")
        assert a.joints_m.tobytes() == b.joints_m[k].tobytes()
        assert a.axial_n.tobytes() == b.axial_n[k].tobytes()
        assert a.multipliers_n.tobytes() == b.forces_n[k].tobytes()
        assert a.energy_j == b.energy_j[k]
        if solver == "both":
            assert a.rung == b.rungs[k]
    assert b.table.rows == 300 and len(b) == 300


def test_what_is_masked_or_missing_is_refused():
    lengths, masses, ends = random_chains(5, 3)
    hidden = np.ma.array(lengths, mask=np.eye(5, 3, dtype=bool))
    with pytest.raises(fn.ShapeError, match="lengths: .* masked entries"):
        fn.solve_many(hidden, masses, ends)
    shown = np.ma.array(lengths, mask=False)
    assert fn.solve_many(shown, masses, ends).joints_m.tobytes() == fn.solve_many(lengths, masses, ends).joints_m.tobytes()
    for name in ("starts", "masses", "ends"):
        given = {"masses": masses, "ends": ends, name: None}
        with pytest.raises(fn.ShapeError, match=name):
            fn.solve_many(lengths, **given)


def test_the_bits_do_not_depend_on_threads():
    data = random_chains(2000, 4)
    one, two = (fn.solve_many(*data, threads=threads) for threads in (1, 2))
    for name in ("joints_m", "forces_n", "axial_n", "energy_j", "residual", "statics", "rung"):
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes()


def test_failures_stop_nobody():
    lengths, masses, ends = random_chains(1000, 3)
    ends[7] = (100, 0, 0)
    lengths[500, 1] = np.nan
    masses[999] = 0
    b = fn.solve_many(lengths, masses, ends)
    assert sorted(b.failures) == [7, 500, 999] and np.isnan(b.joints_m[7]).all() and b.rungs[7] is None
    assert [type(b.failures[k]) for k in (7, 500, 999)] == [fn.OutOfReach, fn.BarError, fn.NoLoad]
    assert b.failures[7].span_m == 100.0 and np.isnan(b.failures[500].length_m)
    assert b.ok.sum() == 997
    with pytest.raises(fn.OutOfReach, match="chain 7") as error:
        b.raise_failures()
    assert error.value.chain == 7


def test_what_is_given_once_is_for_all():
    lengths, masses, ends = random_chains(50, 3)
    starts = np.full((50, 3), 0.25)
    b = fn.solve_many(lengths, 2.0, ends + 0.25, starts=(0.25, 0.25, 0.25), centres=lengths / 2)
    c = fn.solve_many(lengths, np.full((50, 3), 2.0), ends + 0.25, starts=starts)
    assert b.joints_m.tobytes() == c.joints_m.tobytes()
    assert fn.solve_many(lengths[0], masses[0], ends[:5] * 0.1).joints_m.shape == (5, 4, 3)


def test_empty_and_misshapen_batches():
    nothing = fn.solve_many(np.zeros((0, 4)), np.zeros((0, 4)), np.zeros((0, 3)))
    assert nothing.joints_m.shape == (0, 5, 3) and len(nothing) == 0 and nothing.table.rows == 0
    barless = fn.solve_many(np.zeros((2, 0)), np.zeros((2, 0)), np.zeros((2, 3)))
    assert set(map(type, barless.failures.values())) == {fn.SystemError}
    lengths, masses, ends = random_chains(5, 3)
    for wrong in (
        (lengths, masses[:, :2], ends),
        (lengths, masses, ends[:, :2]),
        (lengths, masses, ends[:4]),
        (lengths[0], masses[0], ends[0]),
        (lengths[None], masses, ends),
        (1.0, masses, ends),
    ):
        with pytest.raises(fn.InputError):
            fn.solve_many(*wrong)


numbers = st.floats(allow_nan=True, allow_infinity=True) | st.floats(0.01, 10.0)


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.lists(st.tuples(numbers, numbers, numbers, numbers), min_size=1, max_size=6),
    st.tuples(numbers, numbers, numbers),
)
def test_any_numbers_have_an_answer_or_a_reason(bars, end):
    data = np.array(bars, dtype=np.float64)
    b = fn.solve_many(data[None, :, 0], data[None, :, 1], [end], starts=(0, 0, 0))
    assert bool(b.ok[0]) != (0 in b.failures)
    if b.ok[0]:
        assert np.isfinite(b.joints_m).all() and np.isfinite(b.axial_n).all()
    else:
        assert isinstance(b.failures[0], fn.Error) and str(b.failures[0])


@settings(max_examples=60, deadline=None)
@given(st.integers(2, 8), st.integers(0, 2**32 - 1), st.floats(0.01, 100.0), st.floats(0.01, 100.0))
def test_scales_and_mirrors(n, seed, mass, length):
    """What physics gives for free: mass scales forces, length scales places, a turn turns."""
    lengths, masses, ends = random_chains(12, n, seed)
    b = fn.solve_many(lengths, masses, ends)
    hangs = b.ok
    assert hangs.sum() >= 2
    lengths, masses, ends = lengths[hangs], masses[hangs], ends[hangs]
    b = fn.solve_many(lengths, masses, ends).raise_failures()
    heavier = fn.solve_many(lengths, mass * masses, ends)
    longer = fn.solve_many(length * lengths, masses, length * ends)
    turned = fn.solve_many(lengths, masses, ends * (-1, -1, 1))
    size, force = lengths.sum(), np.abs(b.forces_n).max()
    assert np.abs(heavier.joints_m - b.joints_m).max() < 1e-7 * size
    assert np.abs(heavier.forces_n / mass - b.forces_n).max() < 1e-7 * force
    assert np.abs(longer.joints_m / length - b.joints_m).max() < 1e-7 * size
    assert np.abs(turned.joints_m * (-1, -1, 1) - b.joints_m).max() < 1e-7 * size
