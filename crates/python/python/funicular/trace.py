"""All equilibria of a chain over a parameter, and load paths of any system."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from . import _native
from ._numbers import texts, whole
from ._progress import Progress, shown
from ._result import Result, printable
from .evidence import Record
from .plot import plot_trace
from .system import Described, System, described
from .table import Table, read_csv


class Trace(Result):
    """All equilibria along a path of parameters, or load paths.

    Over values of a chain (``0.5..1.5:5``) all equilibria: ``paths`` has for each path its ``points``, ``branches``,
    ``events`` (folds, branch points, exchanges of stability) and ``checks``. Over a range alone (``loads=0..1.2``), and
    of what is no chain, one path from the equilibrium next to the drawing: ``points``, ``events`` (limit points, branch
    points, kinks), ``end``, ``confirmed``; ``first_loss`` is the first event after which it is unstable, or ``None``.
    With ``branches=1`` the paths that branch off follow it, each with ``branches_from``, the path and the
    event it begins in.
    ``html()`` is a page on which the shape moves along the paths.

    ``table``: a row for each point of each branch or path, with units in the names of the columns. ``checks_agree``:
    whether censuses find exactly the branches, or ``energy`` confirms every point of a load path.

    >>> import funicular as fn
    >>> t = fn.System(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)).trace("anchors.end_m.x=1.5..2.1:7")
    >>> [event] = t.events            # two positions meet where the anchors are 2 m apart
    >>> round(event["values"][0], 9), t.checks_agree
    (2.0, True)
    >>> dome = fn.System.case("star-dome").trace("loads=0..4", of=["joints.N1.z"])
    >>> dome.first_loss["kind"], dome.checks_agree
    ('limit-point', True)
    """

    def __init__(
        self, system: System, text: str, points: str, agree: bool, decided: bool, said: str, page: str
    ) -> None:
        self.system = system
        self._page = page
        self._said = said
        self.data: dict[str, Any] = json.loads(text)
        self._points = points
        self.checks_agree = agree
        self.checks_decided = decided

    @property
    def paths(self) -> list[Record]:
        """The paths, one unless several parameters are combined."""
        return [Record(path) for path in self._paths]

    @property
    def _paths(self) -> list[dict[str, Any]]:
        paths: list[dict[str, Any]] = self.data["load_paths"] if self.is_load_path else self.data["traces"]
        return paths

    @property
    def is_load_path(self) -> bool:
        """Whether load paths were followed."""
        return "load_paths" in self.data

    def html(self) -> str:
        """The shape moved along the load paths, as a page that needs nothing else; empty of all equilibria."""
        return self._page

    @property
    def first_loss(self) -> dict[str, Any] | None:
        """The first event of the first load path after which it is unstable."""
        events = self._paths[0]["events"] if self.is_load_path else []
        return next((event for event in events if event["index"][0] == 0 < event["index"][1]), None)

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happens along all paths: kind, place, values of the parameters."""
        return [event for path in self._paths for event in path["events"]]

    @property
    def table(self) -> Table:
        """A row for each point of each branch or load path; empty cells are NaN, or -1 where numbers count."""
        return read_csv(self._points, COUNTS)

    def plot(self, ax: Any = None, path: int = 1) -> Any:
        """Draw energies over the last parameter, or the last parameter of a load path over the first number shown, into
        axes of matplotlib, which must be installed: what is stable in full, all else broken."""
        return plot_trace(self, ax, path)

    def __repr__(self) -> str:
        if self.is_load_path:
            points = sum(len(path["points"]) for path in self._paths)
            return f"<Trace of {printable(self.system.name)!r}: {points} points, {len(self.events)} events>"
        branches = sum(len(path["branches"]) for path in self.data["traces"])
        return f"<Trace of {printable(self.system.name)!r}: {branches} branches, {len(self.events)} events>"


COUNTS = ("path", "branch", "point", "grid", "event", "index", "index_in_plane", "index_in_space")
"""Columns of whole numbers."""


def trace(
    system: Described,
    *vary: str,
    of: str | Sequence[str] = (),
    max_points: int | None = None,
    branches: int = 0,
    linear_buckling: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Trace:
    """Follow all equilibria of a chain over numbers of its system file, such as ``anchors.end_m.z=-2.9..-0.1:500``, or the
    load path of any system over a range, such as ``loads=0..1.2``, with the numbers ``of`` each point (as ``study`` has
    them), the paths that branch off to this depth, and the estimate of linear buckling.

    Raises ParameterError, NoCensus (longer chains than a census takes), TraceError (no path begins).
    """
    system = described(system)
    points = None if max_points is None else whole("max_points", max_points)
    with shown(progress) as callback:
        found = _native.trace(
            system._problem,
            texts("vary", vary),
            texts("of", of),
            points,
            whole("branches", branches),
            bool(linear_buckling),
            whole("threads", threads),
            callback,
        )
    return Trace(system, *found)
