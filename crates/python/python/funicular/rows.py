"""One structure with many rows of numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import Array, array, whole
from ._progress import Progress, shown
from ._result import Result
from .errors import Error, InputError, ShapeError, _make
from .evidence import RUNGS
from .system import System
from .table import Table

if TYPE_CHECKING:
    from typing_extensions import Self


class Answers(Result):
    """Answers in rows."""

    energy_j: Array
    rung: npt.NDArray[np.int8]
    _arrays: tuple[str, ...] = ()
    _what = ""

    def __init__(self, found: dict[str, Any]) -> None:
        for name in self._arrays:
            setattr(self, name, found[name])
        self._failures: list[tuple[int, tuple[str, str, dict[str, Any]]]] = found["failures"]

    @property
    def failures(self) -> dict[int, Error]:
        """Why rows have no answer, by their numbers from 0."""
        return {row: _make(*parts) for row, parts in self._failures}

    @property
    def ok(self) -> npt.NDArray[np.bool_]:
        """(k,) Which rows have an answer."""
        return ~np.isnan(self.energy_j)

    @property
    def rungs(self) -> list[str | None]:
        """The highest rungs by name."""
        return [RUNGS[rung] if rung >= 0 else None for rung in self.rung.tolist()]

    def raise_failures(self) -> Self:
        """Raise the first failure if there is one, with its number; else return the batch."""
        if self._failures:
            row, (name, message, details) = self._failures[0]
            raise _make(name, f"{self._what} {row}: {message}", {**details, self._what: row})
        return self

    def _content(self) -> dict[str, Any]:
        arrays = {name: getattr(self, name) for name in self._arrays}
        return {**arrays, "failures": {row: message for row, (_, message, _) in self._failures}}

    def __len__(self) -> int:
        return len(self.energy_j)


class SystemBatch(Answers):
    """The equilibria of one structure with k rows of numbers, as arrays; NaN where there is none.

    ``joints_m``, ``reactions_n``
        (k, joints, 3) places, m, and forces of the ground, N.
    ``axial_n``, ``axial_max_n``
        (k, members) axial forces, tension positive: in the middle, and where they are largest, N.
    ``energy_j``, ``residual``
        (k,) potential energies, J, and the solver's own residuals, dimensionless.
    ``rung``, ``failures``
        as of :class:`Batch`.
    """

    joints_m: Array
    reactions_n: Array
    axial_n: Array
    axial_max_n: Array
    residual: Array
    _arrays = ("joints_m", "reactions_n", "axial_n", "axial_max_n", "energy_j", "residual", "rung")
    _what = "row"

    @property
    def table(self) -> Table:
        """A row for each: energy, largest axial forces, the lowest height of a joint, how sure."""
        return Table(
            {
                "row": np.arange(len(self)),
                "energy_j": self.energy_j,
                "largest_tension_n": self.axial_max_n.max(axis=1, initial=-np.inf),
                "largest_compression_n": -self.axial_max_n.min(axis=1, initial=np.inf),
                "lowest_m": self.joints_m[:, :, 2].min(axis=1, initial=np.inf),
                "rung": self.rung.astype(np.int64),
            }
        )

    def __repr__(self) -> str:
        return f"<SystemBatch of {len(self)} rows, {len(self._failures)} without answer>"


def numbers_of(system: System, given: Mapping[str, Any], rows: int | None = None) -> list[tuple[str, Array]]:
    """Arrays of a system by their names, checked; with ``rows`` a row of each for every answer."""
    joints, members = len(system.joint_names), len(system.member_joints)
    shapes: dict[str, tuple[int, ...]] = {name: (members,) for name in ("lengths", "masses", "stiffnesses")}
    shapes |= {"joint_masses": (joints,), "forces": (joints, 3), "anchors": (joints, 3)}
    found = []
    for name, value in given.items():
        if name not in shapes:
            raise InputError(f"there are no numbers {name!r:.80}; there are {', '.join(shapes)}")
        shape = shapes[name]
        if rows is None:
            found.append((name, array(name, value, shape)))
            continue
        whole_shape = (rows, *shape)
        one = np.ndim(value) == len(shape)
        checked = array(name, value, shape if one else whole_shape)
        found.append((name, np.ascontiguousarray(np.broadcast_to(checked, whole_shape))))
    return found


def solve_nets(
    system: System, given: Mapping[str, Any], *, solver: str, threads: int, progress: Progress
) -> SystemBatch:
    """See :meth:`System.solve_many`."""
    arrays = {name: value for name, value in given.items() if value is not None}
    anchors = arrays.get("anchors")
    if isinstance(anchors, Mapping):
        arrays["anchors"] = _anchors(system, anchors)
    dimensions = {name: 3 if name in ("forces", "anchors") else 2 for name in arrays}
    sizes = {name: len(value) for name, value in arrays.items() if np.ndim(value) == dimensions[name]}
    if len(set(sizes.values())) > 1:
        told = ", ".join(f"{name} {size}" for name, size in sizes.items())
        raise ShapeError(f"arrays over different numbers of rows: {told}", argument=next(iter(sizes)), found=told)
    if not sizes:
        raise InputError("one of the arrays must have a row for each answer")
    count = next(iter(sizes.values()))
    rows = numbers_of(system, arrays, count)
    with shown(progress) as callback:
        return SystemBatch(
            _native.solve_nets(system._problem, count, rows, str(solver), whole("threads", threads), callback)
        )


def _anchors(system: System, given: Mapping[Any, Any]) -> Array:
    """Places of some anchors by their joints; all others stay where they are."""
    names = system.joint_names
    rows = max((len(value) for value in given.values() if np.ndim(value) == 2), default=0)
    found = np.full((rows, len(names), 3) if rows else (len(names), 3), np.nan)
    for joint, value in given.items():
        k = names.index(joint) if joint in names else whole("anchors", joint)
        if k >= len(names) or np.isnan(system.supports_m[k]).any():
            raise InputError(f"anchors: there is no anchor {joint!r:.80}")
        shape: tuple[int, ...] = (rows, 3) if np.ndim(value) == 2 else (3,)
        found[..., k, :] = array(f"anchors[{joint!r}]", value, shape)
    return found
