"""One structure with other numbers: many times, and differentiable."""

import funicular as fn
import numpy as np
import pytest
from funicular import gradients

NET = """
gravity_m_s2 = 10
joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [4, 0, 0] }, "C.1" = { at_m = [2, 3, 0.5] }, P = { mass_kg = 3, force_n = [1, 0, 0] } }
bars = [
  { from = "A", to = "P", length_m = 3, mass_kg = 1 },
  { from = "B", to = "P", length_m = 3, mass_kg = 1, kind = "cable", stiffness_n = 1e4 },
  { from = "C.1", to = "P", length_m = 3, mass_kg = 1, kind = "cable", stiffness_n = 2e4 },
]
"""


@pytest.fixture
def net():
    return fn.System.from_toml(NET)


NUMBERS = {
    "lengths": np.array([3.0, 3.0, 3.0]),
    "masses": np.array([1.0, 2.0, 1.0]),
    "stiffnesses": np.array([np.nan, 1e4, 2e4]),
    "joint_masses": np.array([0.0, 0.0, 0.0, 4.0]),
    "forces": np.array([[0.0, 0, 0], [0, 0, 0], [0, 0, 0], [2, 1, 0]]),
    "anchors": np.array([[0.0, 0, 0], [4, 0, 0], [2, 3, 0.5], [np.nan] * 3]),
}

WEIGHTS = np.random.default_rng(1).normal(size=(4, 3)), np.random.default_rng(2).normal(size=3)


def loss(numbers, system):
    joints, axial = gradients.equilibrium(system, numbers)
    return float((joints * WEIGHTS[0]).sum() + (axial * WEIGHTS[1]).sum())


def difference(name, k, system):
    """By central differences."""
    step = 1e-5 * max(1.0, abs(NUMBERS[name].flat[k]))
    ends = []
    for sign in (1, -1):
        moved = {other: values.copy() for other, values in NUMBERS.items()}
        moved[name].flat[k] += sign * step
        ends.append(loss(moved, system))
    return (ends[0] - ends[1]) / (2 * step)


# An anchor has no mass and no force that matter: what acts there goes into the ground.
ENTRIES = [("lengths", 0), ("lengths", 2), ("masses", 1), ("stiffnesses", 1), ("stiffnesses", 2), ("joint_masses", 3)]
ENTRIES += [("forces", 9), ("forces", 11), ("anchors", 3), ("anchors", 7), ("anchors", 8)]


@pytest.mark.parametrize(("name", "k"), ENTRIES)
def test_pullbacks_are_differences(name, k, net):
    by = gradients.pullback(net, NUMBERS, *WEIGHTS)
    assert by[name].shape == NUMBERS[name].shape
    expected = difference(name, k, net)
    assert by[name].flat[k] == pytest.approx(expected, rel=1e-5, abs=1e-6)


def test_other_numbers_are_those_of_a_file(net):
    """As the file with the numbers in it, also through a joint whose name has a dot."""
    changed = NET.replace("[2, 3, 0.5]", "[2, 3, 1]").replace("mass_kg = 3", "mass_kg = 5")
    expected = fn.System.from_toml(changed).solve(solver="lagrange")
    b = net.solve_many(anchors={"C.1": [[2, 3, 0.5], [2, 3, 1]]}, joint_masses=[[0, 0, 0, 3], [0, 0, 0, 5]])
    assert np.array_equal(b.joints_m[1], expected.joints_m) and np.array_equal(b.axial_n[1], expected.axial_n)
    assert np.array_equal(b.axial_max_n[1], expected.axial_max_n) and b.energy_j[1] == expected.energy_j
    assert np.array_equal(b.reactions_n[1], expected.reactions_n)
    assert np.array_equal(b.joints_m[0], net.solve(solver="lagrange").joints_m)


def test_a_row_without_answer_stops_no_other(net):
    b = net.solve_many(lengths=[[3, 3, 3], [-1, 3, 3], [0.1, 3, 3]], solver="both")
    assert b.ok.tolist() == [True, False, True] and set(b.failures) == {1}
    assert isinstance(b.failures[1], fn.BarError)
    assert b.rungs[0] == "agreed" or b.rung[0] >= 1
    with pytest.raises(fn.BarError, match="row 1"):
        b.raise_failures()
    assert np.isnan(b.joints_m[1]).all() and np.isnan(b.table["energy_j"][1])


def test_threads_do_not_matter(net):
    masses = np.random.default_rng(3).uniform(0, 3, (20, 4))
    one, two = (net.solve_many(joint_masses=masses, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.joints_m, two.joints_m) and len(one) == 20


def test_arrays_that_do_not_fit_are_refused(net):
    for bad in ({"lengths": [[1, 2]]}, {"lengths": np.ones((2, 3)), "masses": np.ones((3, 3))}):
        with pytest.raises(fn.ShapeError):
            net.solve_many(**bad)
    for bad in ({}, {"lengths": [3, 3, 3]}, {"anchors": {"P": [[1, 2, 3]]}}):
        with pytest.raises(fn.InputError):
            net.solve_many(**bad)
    with pytest.raises(fn.Error):
        gradients.equilibrium(net, {"stiffnesses": [np.nan, -1.0, 1.0]})
    with pytest.raises(fn.InputError):
        gradients.equilibrium(net, {"colours": [1]})


def test_scipy_finds_lengths(net):
    optimize = pytest.importorskip("scipy.optimize")
    goal = np.array([2.0, 1.0, -1.5])

    def off(joints, axial):
        by = np.zeros_like(joints)
        by[3] = 2 * (joints[3] - goal)
        return ((joints[3] - goal) ** 2).sum(), by, np.zeros_like(axial)

    fun, x0 = gradients.for_scipy(net, off, ["lengths"])
    assert optimize.check_grad(lambda x: fun(x)[0], lambda x: fun(x)[1], x0) < 1e-5
    found = optimize.minimize(fun, x0, jac=True, tol=1e-14)
    joints, _ = gradients.equilibrium(net, {"lengths": found.x})
    assert np.abs(joints[3] - goal).max() < 1e-5
    # The stiff members alone have a stiffness, three anchors nine coordinates.
    assert len(gradients.for_scipy(net, off, ["stiffnesses", "anchors"])[1]) == 2 + 9
    with pytest.raises(fn.SettingError):
        gradients.for_scipy(net, off, ["colours"])
    # Numbers that are none, or not as many.
    for wrong in ([2.2], [3.0] * 4, [np.nan, 3, 3], [np.inf, 3, 3], 3.0):
        with pytest.raises(fn.ShapeError, match="^x: "):
            fun(wrong)


def test_jax_differentiates(net):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    function = gradients.for_jax(net)
    given = {name: NUMBERS[name] for name in ("lengths", "forces", "joint_masses")}

    def value(numbers):
        joints, axial = function(numbers)
        return (joints * WEIGHTS[0]).sum() + (axial * WEIGHTS[1]).sum()

    expected = gradients.pullback(net, given, *WEIGHTS)
    for grad in (jax.grad(value), jax.jit(jax.grad(value))):
        found = grad(given)
        for name, by in expected.items():
            assert np.allclose(found[name], by, rtol=1e-12, atol=1e-12)
    rows = jax.numpy.stack([given["lengths"], given["lengths"] + 0.1])
    both = jax.vmap(lambda lengths: value({**given, "lengths": lengths}))(rows)
    assert np.isclose(both[1], value({**given, "lengths": rows[1]}), rtol=1e-12)


def test_torch_differentiates(net):
    torch = pytest.importorskip("torch", reason="torch takes 800 MB; tried where it is installed")
    function = gradients.for_torch(net)
    given = {
        name: torch.tensor(NUMBERS[name], dtype=torch.float64, requires_grad=True) for name in ("lengths", "forces")
    }
    joints, axial = function(given)
    value = (joints * torch.tensor(WEIGHTS[0])).sum() + (axial * torch.tensor(WEIGHTS[1])).sum()
    value.backward()
    expected = gradients.pullback(net, {name: NUMBERS[name] for name in given}, *WEIGHTS)
    for name, by in expected.items():
        assert np.allclose(given[name].grad.numpy(), by, rtol=1e-12, atol=1e-12)
    # Differences by PyTorch itself.
    assert torch.autograd.gradcheck(lambda *t: function(dict(zip(given, t))), list(given.values()), atol=1e-4)
    with pytest.raises(fn.InputError):
        function({})


def test_what_is_not_installed_is_named(net, monkeypatch):
    import sys

    for name, made in (("jax", gradients.for_jax), ("torch", gradients.for_torch)):
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(fn.Error, match="pip install"):
            made(net)
