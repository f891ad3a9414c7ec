"""Many chains of the same number of bars at a time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import Array, Numbers, array, number, whole
from ._progress import Progress, shown
from .errors import InputError, ShapeError
from .rows import Answers
from .system import STANDARD_GRAVITY
from .table import Table

if TYPE_CHECKING:
    import distributed

ARRAYS = ("joints_m", "forces_n", "axial_n", "energy_j", "residual", "statics", "rung")
"""What a batch has for each chain."""


class Batch(Answers):
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
        raise ShapeError(f"{name}: an array is required", argument=name) from error


def slices(count: int, parts: int) -> Iterator[slice]:
    """So many parts of nearly equal size, in order."""
    for k in range(parts):
        begin, end = count * k // parts, count * (k + 1) // parts
        if begin < end:
            yield slice(begin, end)
