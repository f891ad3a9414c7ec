"""The equilibrium as a function of its numbers with derivatives: for scipy, JAX and PyTorch.

The numbers are arrays by their names: ``lengths``, ``masses``, ``stiffnesses`` (members,), ``joint_masses`` (joints,),
``forces``, ``anchors`` (joints, 3), in SI units; those not given stay as the system has them, and so does what is NaN. The
equilibrium is that of ``lagrange``; derivatives follow from one solve with the transposed Jacobian, whatever the number of
numbers, and hold as long as no slack member becomes taut and no taut one slack.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _native
from ._numbers import Array, array
from .errors import Error, InputError, SettingError, ShapeError
from .rows import numbers_of
from .system import System

Loss = Callable[[Array, Array], tuple[float, Any, Any]]


def equilibrium(system: System, numbers: Mapping[str, Any]) -> tuple[Array, Array]:
    """Places of the joints (joints, 3), m, and axial forces (members,), N, with these numbers."""
    problem = system._problem.with_numbers(numbers_of(system, numbers))
    found = _native.pullback(problem, None, None, 0)
    return found["joints_m"], found["axial_n"]


def pullback(system: System, numbers: Mapping[str, Any], by_joints: Any, by_axial: Any) -> dict[str, Array]:
    """The derivatives of a function of places and axial forces by these numbers, from its derivatives by those.

    >>> import funicular as fn, numpy as np
    >>> v = fn.System.from_arrays(joints=3, anchors={0: (-3, 0, 0), 1: (3, 0, 0)}, joint_masses={2: 0.8},
    ...                           bars=[[0, 2], [2, 1]], lengths=[5, 5], gravity=10)
    >>> height = np.zeros((3, 3)); height[2, 2] = 1
    >>> fn.gradients.pullback(v, {"lengths": [5, 5]}, height, np.zeros(2))["lengths"].round(9).tolist()    # half of l/h
    [-0.625, -0.625]
    """
    given = numbers_of(system, numbers)
    problem = system._problem.with_numbers(given)
    joints = array("by_joints", by_joints, (len(system.joint_names), 3))
    axial = array("by_axial", by_axial, (len(system.member_joints),))
    found = _native.pullback(problem, joints, axial, 0)
    found["joint_masses"] = -system.gravity_m_s2 * found["forces"][:, 2]
    return {name: found[name] for name, _ in given}


def for_scipy(
    system: System, loss: Loss, names: Sequence[str]
) -> tuple[Callable[[Array], tuple[float, Array]], Array]:
    """A function of one array, the numbers of these names that the system has, for ``scipy.optimize.minimize(fun, x0, jac=True)``;
    and those numbers now.

    ``loss``: from places and axial forces to a value and its derivatives by both.

    Bars as long as the joint hangs 4.5 m below the anchors:

    >>> import funicular as fn, numpy as np
    >>> v = fn.System.from_arrays(joints=3, anchors={0: (-3, 0, 0), 1: (3, 0, 0)}, joint_masses={2: 0.8},
    ...                           bars=[[0, 2], [2, 1]], lengths=[5, 5], gravity=10)
    >>> def off(joints, axial):
    ...     by = np.zeros_like(joints); by[2] = 2 * (joints[2] - (0, 0, -4.5))
    ...     return float(((joints[2] - (0, 0, -4.5)) ** 2).sum()), by, np.zeros_like(axial)
    >>> fun, x0 = fn.gradients.for_scipy(v, off, ["lengths"])
    >>> value, gradient = fun(x0)
    >>> round(value, 9), gradient.round(9).tolist()          # 2 (0.5) (-0.625)
    (0.25, [-0.625, -0.625])
    """
    now = {name: _now(system, name) for name in names}
    known = {name: np.isfinite(values) for name, values in now.items()}
    x0 = np.concatenate([values[known[name]] for name, values in now.items()])

    def numbers(x: Array) -> dict[str, Array]:
        found, at = {}, 0
        for name, values in now.items():
            some = values.copy()
            count = int(known[name].sum())
            some[known[name]] = x[at : at + count]
            found[name], at = some, at + count
        return found

    def fun(x: Array) -> tuple[float, Array]:
        x = array("x", x, x0.shape)
        if not np.isfinite(x).all():
            raise ShapeError("x: finite numbers wanted", argument="x", expected="finite numbers", found="nan or inf")
        given = numbers(x)
        value, by_joints, by_axial = loss(*equilibrium(system, given))
        by = pullback(system, given, by_joints, by_axial)
        return float(value), np.concatenate([by[name][known[name]] for name in now])

    return fun, x0


def _now(system: System, name: str) -> Array:
    """The numbers of the system, in the shape of the array."""
    if name not in SHAPES:
        raise SettingError(f"names: one of {', '.join(SHAPES)} wanted, got {name!r:.80}", setting="names")
    found: Array = system._problem.numbers(name).reshape(SHAPES[name])
    return found


SHAPES: dict[str, tuple[int, ...]] = {
    "lengths": (-1,),
    "masses": (-1,),
    "stiffnesses": (-1,),
    "joint_masses": (-1,),
    "forces": (-1, 3),
    "anchors": (-1, 3),
}
"""What may vary."""


def for_jax(system: System) -> Callable[[Mapping[str, Any]], tuple[Any, Any]]:
    """A function of a dictionary of arrays of JAX, to places and axial forces, for ``jax.grad``, ``jax.jit``, ``jax.vmap``.

    Its derivatives are those of reverse mode, once; in the precision that JAX is set to (``jax_enable_x64``).
    """
    try:
        import jax
        import jax.numpy as jnp
    except ImportError as error:
        raise Error("for_jax() needs JAX: pip install jax") from error
    joints, members = len(system.joint_names), len(system.member_joints)

    def like(shape: tuple[int, ...]) -> Any:
        return jax.ShapeDtypeStruct(shape, jnp.zeros(()).dtype)

    def plain(numbers: Mapping[str, Any]) -> dict[str, Array]:
        return {name: np.asarray(values, dtype=np.float64) for name, values in numbers.items()}

    def cast(values: Array) -> Any:
        return np.asarray(values, dtype=jnp.zeros(()).dtype)

    def solved(numbers: Mapping[str, Any]) -> tuple[Any, Any]:
        at, axial = equilibrium(system, plain(numbers))
        return cast(at), cast(axial)

    def back(numbers: Mapping[str, Any], by: tuple[Any, Any]) -> dict[str, Any]:
        by_joints, by_axial = (np.asarray(one, dtype=np.float64) for one in by)
        found = pullback(system, plain(numbers), by_joints, by_axial)
        return {name: cast(values) for name, values in found.items()}

    def value(numbers: Mapping[str, Any]) -> Any:
        shapes = (like((joints, 3)), like((members,)))
        return jax.pure_callback(solved, shapes, numbers, vmap_method="sequential")

    function = jax.custom_vjp(value)

    def forward(numbers: Mapping[str, Any]) -> Any:
        return function(numbers), numbers

    def backward(numbers: Mapping[str, Any], by: Any) -> Any:
        shapes = {name: like(jnp.shape(values)) for name, values in numbers.items()}
        return (jax.pure_callback(back, shapes, numbers, by, vmap_method="sequential"),)

    function.defvjp(forward, backward)
    made: Callable[[Mapping[str, Any]], tuple[Any, Any]] = function
    return made


def for_torch(system: System) -> Callable[[Mapping[str, Any]], tuple[Any, Any]]:
    """A function of a dictionary of tensors of PyTorch, to places and axial forces, through which ``backward()`` goes."""
    try:
        import torch
    except ImportError as error:
        raise Error("for_torch() needs PyTorch: pip install torch") from error

    def plain(names: Sequence[str], tensors: Sequence[Any]) -> dict[str, Array]:
        return {name: tensor.detach().double().cpu().numpy() for name, tensor in zip(names, tensors)}

    class Equilibrium(torch.autograd.Function):  # type: ignore[misc]
        @staticmethod
        def forward(ctx: Any, names: tuple[str, ...], *tensors: Any) -> Any:
            ctx.names = names
            ctx.save_for_backward(*tensors)
            found = equilibrium(system, plain(names, tensors))
            return tuple(torch.from_numpy(one).to(tensors[0]) for one in found)

        @staticmethod
        def backward(ctx: Any, by_joints: Any, by_axial: Any) -> Any:
            tensors = ctx.saved_tensors
            by = (one.double().cpu().numpy() for one in (by_joints, by_axial))
            found = pullback(system, plain(ctx.names, tensors), *by)
            return (None, *(torch.from_numpy(found[name]).to(t) for name, t in zip(ctx.names, tensors)))

    def function(numbers: Mapping[str, Any]) -> tuple[Any, Any]:
        tensors = [torch.as_tensor(values) for values in numbers.values()]
        if not tensors:
            raise InputError(f"numbers are wanted: {', '.join(SHAPES)}", argument="numbers")
        joints, axial = Equilibrium.apply(tuple(numbers), *tensors)
        return joints, axial

    return function
