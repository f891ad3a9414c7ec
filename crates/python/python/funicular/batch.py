"""Many chains of the same number of bars at a time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import Array, Numbers, array, number, whole
from ._progress import Progress, shown
from ._result import Result
from .errors import Error, InputError, ShapeError, _make
from .evidence import RUNGS
from .system import STANDARD_GRAVITY, System
from .table import Table

if TYPE_CHECKING:
    import distributed
    from typing_extensions import Self

Rows = Union[slice, "npt.NDArray[Any]", Sequence[int]]

ARRAYS = ("joints_m", "forces_n", "axial_n", "energy_j", "residual", "statics", "rung")
"""What a batch has for each chain."""


class _Rows(Result):
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


class Batch(_Rows):
    """The hanging equilibria of k chains of n bars, as arrays; NaN where there is none.

    ``joints_m``
        (k, n + 1, 3) places of the joints, m.
    ``forces_n``
        (k, n + 1, 3) forces at the joints, N: entry 0 that of the ground on bar 1, entry i that of bar i+1 on bar i, the
        last that of the ground on bar n.
    ``axial_n``
        (k, n) axial forces, tension positive, N.
    ``energy_j``
        (k,) potential energies above the start anchors, J.
    ``residual``
        (k,) the solver's own residuals, dimensionless.
    ``statics``
        (k,) the largest violation of geometry and of Newton's laws that the judge finds, dimensionless.
    ``rung``
        (k,) highest rung reached: 0 converged, 1 agreed, 4 optimal; -1 none.
    ``failures``
        {number of the chain: why it has no answer}.
    """

    joints_m: Array
    forces_n: Array
    axial_n: Array
    residual: Array
    statics: Array

    _arrays = ARRAYS
    _what = "chain"

    @property
    def axial_ends_n(self) -> Array:
        """(k, n, 2) axial forces at both ends of each bar, N: a heavy bar that is not level has its largest at one of them."""
        along = np.diff(self.joints_m, axis=1)
        along = along / np.linalg.norm(along, axis=2, keepdims=True)
        # Entry 0 is the force on bar 1, the others that on the bar before.
        starts = -self.forces_n[:, :-1]
        starts[:, 0] *= -1.0
        ends: Array = np.stack([-(starts * along).sum(axis=2), (self.forces_n[:, 1:] * along).sum(axis=2)], axis=2)
        return ends

    @property
    def table(self) -> Table:
        """A row for each chain: energy, pull on both anchors, largest axial forces, how sure."""
        start, end = np.linalg.norm(self.forces_n[:, 0], axis=1), np.linalg.norm(self.forces_n[:, -1], axis=1)
        return Table(
            {
                "chain": np.arange(len(self)),
                "energy_j": self.energy_j,
                "start_n": start,
                "end_n": end,
                "largest_tension_n": self.axial_ends_n.max(axis=(1, 2), initial=-np.inf),
                "largest_compression_n": -self.axial_ends_n.min(axis=(1, 2), initial=np.inf),
                "statics": self.statics,
                "rung": self.rung.astype(np.int64),
            }
        )

    def __repr__(self) -> str:
        return f"<Batch of {len(self)} chains of {self.axial_n.shape[1]} bars, {len(self._failures)} without answer>"


class SystemBatch(_Rows):
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


def solve_many(
    lengths: Numbers,
    masses: Numbers,
    ends: Numbers,
    *,
    starts: Numbers = (0.0, 0.0, 0.0),
    centres: Numbers | None = None,
    gravity: float = STANDARD_GRAVITY,
    solver: str = "lagrange",
    threads: int = 0,
    progress: Progress = None,
    client: distributed.Client | None = None,
    parts: int | None = None,
) -> Batch:
    """The hanging equilibria of many chains of the same number of bars, in parallel.

    A chain that has no answer stops no other: its numbers are NaN, and ``failures`` says why. The answers depend
    neither on the threads nor on the cluster, to the last bit.

    Parameters
    ----------
    lengths : (k, n) m; or (n,) for all chains
    masses : (k, n) kg; (n,) or one number for all
    ends : (k, 3) m; or (3,) for all
    starts : (k, 3) or (3,) m
    centres : (k, n) m, optional
    solver : ``lagrange``: every answer is held against the statics judge; ``both``: solved by both, compared and
        certified, which takes longer; ``energy``
    threads : how many share the work, 0 for what :func:`set_threads` says
    progress : ``True`` for a bar, or a function of (what, done, total)
    client : a client of ``dask.distributed``: the chains are shared out among its workers, in ``parts`` parts

    Raises
    ------
    ShapeError, InputError : arrays that do not fit
    ClusterError : a part that no worker could finish

    Examples
    --------
    >>> import funicular as fn, numpy as np
    >>> x = np.linspace(0.5, 1.5, 5)
    >>> b = fn.solve_many(np.ones((5, 2)), 1.0, np.stack([x, 0 * x, 0 * x], axis=1))
    >>> b.joints_m.shape, bool(b.ok.all()), bool(b.statics.max() < 1e-14)
    ((5, 3, 3), True, True)
    >>> bool(np.allclose(b.joints_m[:, 1, 2], -np.sqrt(1 - (x / 2) ** 2)))
    True
    """
    data = _arrays(lengths, masses, ends, starts, centres)
    settings = (number("gravity", gravity), str(solver), whole("threads", threads))
    if client is not None:
        from .cluster import solve_parts

        return Batch(solve_parts(client, data, settings, parts, progress))
    with shown(progress) as callback:
        return Batch(solve_rows(data, settings, callback))


def solve_rows(
    data: dict[str, Array | None], settings: tuple[float, str, int], progress: Any = None
) -> dict[str, Any]:
    """The native batch over arrays that were checked."""
    # What comes over a network may lie anywhere in memory.
    data = {name: None if rows is None else np.require(rows, requirements=["C", "A"]) for name, rows in data.items()}
    lengths, masses, starts, ends = data["lengths"], data["masses"], data["starts"], data["ends"]
    assert lengths is not None and masses is not None and starts is not None and ends is not None
    chains, bars = lengths.shape
    return _native.solve_many(chains, bars, lengths, masses, data["centres"], starts, ends, *settings, progress)


def _arrays(lengths: Any, masses: Any, ends: Any, starts: Any, centres: Any) -> dict[str, Array | None]:
    """Arrays of full shape, those given once for all chains repeated."""
    given = {"lengths": lengths, "masses": masses, "ends": ends, "starts": starts, "centres": centres}
    sizes = {name: _rows(name, value) for name, value in given.items() if value is not None and np.ndim(value) == 2}
    if len(set(sizes.values())) > 1:
        told = ", ".join(f"{name} {size}" for name, size in sizes.items())
        raise ShapeError(f"arrays over different numbers of chains: {told}", argument="lengths", found=told)
    if not sizes:
        raise InputError("one of lengths, masses, ends, starts must have a row for each chain")
    chains = next(iter(sizes.values()))
    bars = array("lengths", lengths, ("k", "n") if np.ndim(lengths) == 2 else ("n",)).shape[-1]
    whole_arrays: dict[str, Array | None] = {"centres": None}
    for name, value in given.items():
        if value is None and name == "centres":
            continue
        size = 3 if name in ("ends", "starts") else bars
        shape: tuple[int, ...] = (chains, size) if np.ndim(value) == 2 else (size,)
        if np.ndim(value) == 0 and name == "masses":
            shape = ()
        found = array(name, value, shape)
        whole_arrays[name] = np.ascontiguousarray(np.broadcast_to(found, (chains, size)))
    return whole_arrays


def _rows(name: str, value: Any) -> int:
    try:
        return len(value)
    except TypeError as error:
        raise ShapeError(f"{name}: an array is wanted", argument=name) from error


def slices(count: int, parts: int) -> Iterator[slice]:
    """So many parts of nearly equal size, in order."""
    for k in range(parts):
        begin, end = count * k // parts, count * (k + 1) // parts
        if begin < end:
            yield slice(begin, end)
