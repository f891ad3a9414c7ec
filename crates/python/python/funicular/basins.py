"""Which start leads where, over the starting angles of two bars."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import Array, number, whole
from ._progress import Progress, shown
from ._result import Result, printable
from .errors import InputError, SettingError
from .plot import plot_basins
from .system import Described, System, described
from .table import Table

LARGEST = 4096
"""Largest picture: 16 million starts for each solver."""


class Basins(Result):
    """Where the starts over the angles of two bars led, by both solvers.

    ``equilibria``: what the outcomes 0, 1, 2, ... stand for, in words; negative outcomes are failures. ``angles_deg``:
    (size,) the starting angles; ``bars``: the two bars, the lower first.

    >>> import funicular as fn
    >>> b = fn.basins(fn.System.case("three-equal-bars"), size=8)
    >>> b.outcome("lagrange").shape, len(b.equilibria)      # E1, E2 and their mirror images
    ((8, 8), 4)
    >>> int((b.outcome("energy") < 0).sum())                # each start reached one
    0
    """

    def __init__(self, system: System, bars: tuple[int, int], found: dict[str, Any], names: list[str], said: str) -> None:
        self.system = system
        self.bars = bars
        self.equilibria = names
        self._found = found
        self._said = said

    def _of(self, solver: str) -> dict[str, Any]:
        if solver not in self._found:
            raise InputError(f"{solver!r:.80} was not asked; {', '.join(self._found)} were")
        found: dict[str, Any] = self._found[solver]
        return found

    def outcome(self, solver: str) -> npt.NDArray[np.int16]:
        """(size, size) Where each start led: a row for each angle of the second bar, a column for each of the first."""
        found: npt.NDArray[np.int16] = self._of(solver)["outcome"]
        return found

    def iterations(self, solver: str) -> npt.NDArray[Any]:
        """(size, size) What each start took."""
        found: npt.NDArray[Any] = self._of(solver)["iterations"]
        return found

    @property
    def angles_deg(self) -> Array:
        """(size,) The starting angles from the descending vertical, degrees."""
        size = len(self.outcome("lagrange"))
        found: Array = np.asarray((np.arange(size) + 0.5) * (360.0 / size), dtype=np.float64)
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

    def svg(self, solver: str, iterations: bool = False) -> str:
        """The picture of one solver: the equilibrium reached, or the iterations spent."""
        return str(self._of(solver)["svg"][bool(iterations)])

    def plot(self, solver: str = "lagrange", ax: Any = None, *, iterations: bool = False) -> Any:
        """Draw into axes of matplotlib, which must be installed."""
        return plot_basins(self, solver, ax, iterations=iterations)

    def _content(self) -> dict[str, Any]:
        by = {s: {"outcome": self.outcome(s), "iterations": self.iterations(s)} for s in self._found}
        return {"bars": self.bars, "equilibria": self.equilibria, "angles_deg": self.angles_deg, "solvers": by}

    def __repr__(self) -> str:
        size = len(self.angles_deg)
        return f"<Basins of {printable(self.system.name)!r}: {size} x {size} starts, {len(self.equilibria)} equilibria>"


def basins(
    system: Described,
    *,
    size: int = 300,
    bars: tuple[int, int] = (1, 2),
    others: float = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> Basins:
    """Start both solvers from ``size`` times ``size`` pairs of angles of two ``bars``, from 1; all other bars start at the
    angle ``others``, degrees from the descending vertical.

    Raises ChainsOnly, SettingError, SweepError.
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
        found = _native.basins(system._problem, side, [first, second], angle, whole("threads", threads), callback)
    return Basins(system, (first, second), *found)
