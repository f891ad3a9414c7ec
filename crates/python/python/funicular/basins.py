"""Which start leads where, over the starting angles of two bars or the starting place of a joint."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import Array, number, whole
from ._picture import Picture
from ._progress import Progress, shown
from ._result import Result, printable
from .errors import InputError, SettingError
from .plot import plot_basins
from .system import Described, System, described
from .table import Table

LARGEST = 4096
"""Largest picture: 16 million starts for each solver."""


class Basins(Result):
    """Where the starts led, by both solvers.

    ``equilibria``: what the outcomes 0, 1, 2, ... stand for, in words; negative outcomes are failures. ``labels``: what
    the two axes are; ``starts``: (2, size) the starts along each, degrees or m.

    >>> import funicular as fn
    >>> b = fn.basins(fn.System.case("three-equal-bars"), size=8)
    >>> b.outcome("lagrange").shape, len(b.equilibria)      # E1, E2 and their mirror images
    ((8, 8), 4)
    >>> int((b.outcome("energy") < 0).sum())                # each start reached one
    0
    """

    def __init__(self, system: System, found: dict[str, Any], names: list[str], axes: Any, said: str) -> None:
        self.system = system
        self.equilibria = names
        self.labels, ranges = (str(axes[0][0]), str(axes[0][1])), np.asarray(axes[1], dtype=np.float64)
        self.ranges: Array = ranges
        self._found = found
        self._said = said

    def _of(self, solver: str) -> dict[str, Any]:
        if solver not in self._found:
            raise InputError(f"{solver!r:.80} was not asked; {', '.join(self._found)} were")
        found: dict[str, Any] = self._found[solver]
        return found

    def outcome(self, solver: str) -> npt.NDArray[np.int16]:
        """(size, size) Where each start led: a row for each start along the second axis, a column for each along the first."""
        found: npt.NDArray[np.int16] = self._of(solver)["outcome"]
        return found

    def iterations(self, solver: str) -> npt.NDArray[Any]:
        """(size, size) What each start took."""
        found: npt.NDArray[Any] = self._of(solver)["iterations"]
        return found

    @property
    def starts(self) -> Array:
        """(2, size) The starts along both axes, degrees or m."""
        size = len(self.outcome("lagrange"))
        low, high = self.ranges[:, :1], self.ranges[:, 1:]
        found: Array = low + (np.arange(size) + 0.5) * ((high - low) / size)
        return found

    @property
    def table(self) -> Table:
        """A row for each solver and outcome."""
        found = [(s, *np.unique(self.outcome(s), return_counts=True)) for s in self._found]
        rows = [(s, int(k), int(n)) for s, outcomes, counts in found for k, n in zip(outcomes, counts)]
        return Table(
            {
                "solver": [solver for solver, _, _ in rows],
                "outcome": np.array([outcome for _, outcome, _ in rows], dtype=np.int64),
                "count": np.array([count for _, _, count in rows], dtype=np.int64),
            }
        )

    def svg(self, solver: str, iterations: bool = False) -> Picture:
        """The picture of one solver: the equilibrium reached, or the iterations spent."""
        return Picture(self._of(solver)["svg"][bool(iterations)])

    def plot(self, solver: str = "lagrange", ax: Any = None, *, iterations: bool = False) -> Any:
        """Draw into axes of matplotlib, which must be installed."""
        return plot_basins(self, solver, ax, iterations=iterations)

    def _content(self) -> dict[str, Any]:
        by = {s: {"outcome": self.outcome(s), "iterations": self.iterations(s)} for s in self._found}
        return {"labels": self.labels, "equilibria": self.equilibria, "starts": self.starts, "solvers": by}

    def __repr__(self) -> str:
        size = self.starts.shape[1]
        return f"<Basins of {printable(self.system.name)!r}: {size} x {size} starts, {len(self.equilibria)} equilibria>"


def basins(
    system: Described,
    *,
    size: int = 300,
    bars: tuple[int, int] = (1, 2),
    others: float = 0.0,
    joint: str | None = None,
    plane: str = "xz",
    threads: int = 0,
    progress: Progress = None,
) -> Basins:
    """Start both solvers from ``size`` times ``size`` starts.

    Of a chain between two anchors: angles of two ``bars``, from 1; all other bars start at the angle ``others``, degrees
    from the descending vertical. Of any other system: places of a ``joint`` (the first that can move) in a ``plane``
    (``"xz"``, ``"yz"``, ``"xy"``) through where it hangs; all other joints start where they hang.

    Raises SettingError, SweepError.
    """
    system = described(system)
    side = whole("size", size, 2)
    if side > LARGEST:
        raise SettingError(f"size: at most {LARGEST}, got {side}", setting="size", value=side)
    if len(bars) != 2:
        raise SettingError("bars: two bars wanted", setting="bars")
    first, second = sorted(whole("bars", bar, 1) for bar in bars)
    angle = number("others", others)
    with shown(progress) as callback:
        found = _native.basins(
            system._problem, side, [first, second], angle, joint, plane, whole("threads", threads), callback
        )
    return Basins(system, *found)
