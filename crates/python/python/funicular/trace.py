"""All equilibria of a chain over a parameter: branches, folds, exchanges of stability."""

from __future__ import annotations

import json
from typing import Any

from . import _native
from ._numbers import whole
from ._progress import Progress, shown
from ._result import Result, printable
from .evidence import Record
from .plot import plot_trace
from .system import Described, System, described
from .table import Table, read_csv


class Trace(Result):
    """All equilibria along a path of parameters.

    ``paths``: for each path its ``points``, ``branches``, ``events`` (folds, branch points, exchanges of stability) and
    ``checks``; ``table``: a row for each point of each branch, with units in the names of the columns.
    ``checks_agree``: whether a census between the points finds exactly the branches there.

    >>> import funicular as fn
    >>> t = fn.System(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)).trace("anchors.end_m.x=1.5..2.1:7")
    >>> [event] = t.events            # two positions meet where the anchors are 2 m apart
    >>> round(event["values"][0], 9), t.checks_agree
    (2.0, True)
    """

    def __init__(self, system: System, text: str, points: str, agree: bool, decided: bool, said: str) -> None:
        self.system = system
        self._said = said
        self.data: dict[str, Any] = json.loads(text)
        self._points = points
        self.checks_agree = agree
        self.checks_decided = decided

    @property
    def paths(self) -> list[Record]:
        """The paths, one unless several parameters are combined."""
        return [Record(path) for path in self.data["traces"]]

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happens along all paths: kind, place, values of the parameters."""
        return [event for path in self.data["traces"] for event in path["events"]]

    @property
    def table(self) -> Table:
        """A row for each point of each branch; empty cells are NaN, or -1 where numbers count."""
        return read_csv(self._points, COUNTS)

    def plot(self, ax: Any = None, path: int = 1) -> Any:
        """Draw energies over the last parameter into axes of matplotlib, which must be installed: stable branches in full,
        others broken."""
        return plot_trace(self, ax, path)

    def __repr__(self) -> str:
        branches = sum(len(path["branches"]) for path in self.data["traces"])
        return f"<Trace of {printable(self.system.name)!r}: {branches} branches, {len(self.events)} events>"


COUNTS = ("path", "branch", "grid", "event", "index_in_plane", "index_in_space")
"""Columns of whole numbers."""


def trace(
    system: Described, *vary: str, max_points: int | None = None, threads: int = 0, progress: Progress = None
) -> Trace:
    """Follow all equilibria of a chain over numbers of its system file, such as ``anchors.end_m.z=-2.9..-0.1:500``.

    Raises ParameterError, ChainsOnly, NoCensus (longer chains than a census takes), TraceError.
    """
    system = described(system)
    points = None if max_points is None else whole("max_points", max_points)
    with shown(progress) as callback:
        found = _native.trace(system._problem, list(map(str, vary)), points, whole("threads", threads), callback)
    return Trace(system, *found)
