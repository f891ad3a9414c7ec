"""Every equilibrium of a system, with proof."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import _native
from ._html import picture
from ._numbers import Array, whole
from ._progress import Progress, shown
from ._result import Result, printable
from .answer import Equilibrium
from .evidence import Record
from .plot import plot_census
from .system import Described, System, described
from .table import Table


class Census(Result):
    """All equilibria, stable or not, by energy, and what is known of the list.

    ``complete``: whether it is proved that there is no other. ``summary``: the numbers of the list (``count``,
    ``circles``, ``decided``, ``undecided_boxes``, and of each of the ``parts`` the ``chain`` or the ``net``). A census is
    a sequence of :class:`Equilibrium`; what only the census of one row of bars knows of one stands in its ``data``
    (``label``, ``signs``, ``enclosures``, ...).

    >>> import funicular as fn
    >>> c = fn.System.case("three-equal-bars").census()
    >>> c.complete, len(c), c.summary.parts[0]["chain"]["circle_count"]
    (True, 4, 2)
    >>> [round(e.energy_j / 9.80665, 6) for e in c]    # E1 and E2 with their mirror images, in mgl above joint 0
    [-3.664531, -3.664531, -2.335469, -2.335469]
    """

    def __init__(self, system: System, found: tuple[str, list[dict[str, Any]]], said: str) -> None:
        text, arrays = found
        self.system = system
        self._said = said
        self.data: dict[str, Any] = json.loads(text)
        pairs = zip(self.data["equilibria"], arrays)
        self.equilibria = [Equilibrium(system, data, found) for data, found in pairs]

    @property
    def complete(self) -> bool:
        """Whether it is proved that there is no other equilibrium."""
        return bool(self.data["census"]["complete"])

    @property
    def summary(self) -> Record:
        """The numbers of the list."""
        return Record(self.data["census"])

    def energy_bounds_j(self) -> Array:
        """(equilibria, 2) Of one row of bars: intervals that hold the exact energies, J."""
        bounds = [found["enclosures"]["energy_j"] for found in self.data["equilibria"] if "enclosures" in found]
        return np.array(bounds, dtype=np.float64).reshape(-1, 2)

    @property
    def table(self) -> Table:
        """A row for each equilibrium."""
        return Table(
            {
                "equilibrium": [str(e.data.get("label", k + 1)) for k, e in enumerate(self.equilibria)],
                "energy_j": np.array([e.energy_j for e in self.equilibria], dtype=np.float64),
                "in_space": [str(e.stability.in_space) for e in self.equilibria],
                "index_in_space": np.array([e.stability.index_in_space for e in self.equilibria], dtype=np.int64),
                "rung": [str(e.rung) for e in self.equilibria],
            }
        )

    def plot(self, most: int = 9, *, view: str = "best") -> Any:
        """Draw the first equilibria side by side, each into axes of matplotlib, which must be installed; a figure."""
        return plot_census(self, most, view)

    def __len__(self) -> int:
        return len(self.equilibria)

    def __getitem__(self, k: int) -> Equilibrium:
        return self.equilibria[k]

    def __iter__(self) -> Iterator[Equilibrium]:
        return iter(self.equilibria)

    def __repr__(self) -> str:
        what = "complete" if self.complete else "not complete"
        return f"<Census of {printable(self.system.name)!r}: {len(self)} equilibria, {what}>"

    def _repr_html_(self) -> str:
        said = "There is no other equilibrium: proved." if self.complete else "The list is not proved complete."
        return f"{self.table._repr_html_()}<p>{said}</p>{''.join(map(picture, self.equilibria[:4]))}"


def census(system: Described, *, max_bars: int | None = None, threads: int = 0, progress: Progress = None) -> Census:
    """The census of a system. ``max_bars``: refuse longer chains (16 if not said). Raises NoCensus, Refused."""
    system = described(system)
    bars = None if max_bars is None else whole("max_bars", max_bars)
    with shown(progress) as callback:
        return Census(system, *_native.census(system._problem, bars, whole("threads", threads), callback))
