"""Many starts through both solvers, and where each of them leads."""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._numbers import whole
from ._progress import Progress, shown
from ._result import Result, printable
from .errors import InputError
from .evidence import Record
from .system import Described, System, described
from .table import Table

if TYPE_CHECKING:
    import distributed


class Sweep(Result):
    """What became of all starts.

    ``equilibria``: what the outcomes 0, 1, 2, ... stand for; ``complete``: whether it is proved that there are no
    others; ``outcomes``: all counts; ``table``: the same as rows; ``folder``: where the rows of the starts stand, if they
    were written.

    >>> import funicular as fn
    >>> s = fn.System.case("three-equal-bars").sweep(2000)
    >>> s.complete, s.counts("lagrange").keys() == {0, 1, 2, 3}    # the four equilibria of the census, nothing else
    (True, True)
    >>> sum(s.counts("energy").values())
    2000
    """

    def __init__(self, system: System, text: str, folder: Path | None = None, said: str = "") -> None:
        self.system = system
        self._said = said
        self.folder = folder
        self.data: dict[str, Any] = json.loads(text)

    @property
    def seeds(self) -> int:
        """Number of starts."""
        return int(self.data["seeds"])

    @property
    def equilibria(self) -> list[Record]:
        """What the outcomes stand for."""
        return [Record(found) for found in self.data["equilibria"]]

    @property
    def complete(self) -> bool:
        """Whether it is proved that there are no others."""
        return bool(self.data["complete"])

    @property
    def outcomes(self) -> Record:
        """All counts: ``solvers``, ``comparisons`` of both, ``disagreements`` that should not be."""
        return Record(self.data["outcomes"])

    def counts(self, solver: str) -> dict[int, int]:
        """How many starts of a solver led to each equilibrium; negative outcomes are failures."""
        solvers = self.data["outcomes"]["solvers"]
        if solver not in solvers:
            raise InputError(f"{solver!r:.80} was not asked; {', '.join(solvers)} was")
        return {int(row["outcome"]): int(row["count"]) for row in solvers[solver]}

    @property
    def table(self) -> Table:
        """A row for each solver and outcome."""
        rows = [(s, k, n) for s in self.data["outcomes"]["solvers"] for k, n in sorted(self.counts(s).items())]
        return Table(
            {
                "solver": [solver for solver, _, _ in rows],
                "outcome": np.array([outcome for _, outcome, _ in rows], dtype=np.int64),
                "count": np.array([count for _, _, count in rows], dtype=np.int64),
            }
        )

    def __repr__(self) -> str:
        return f"<Sweep of {printable(self.system.name)!r}: {self.seeds} starts, {len(self.equilibria)} equilibria>"


def sweep(
    system: Described,
    seeds: int,
    *,
    seed: int = 1,
    spread: str = "uniform",
    solver: str = "both",
    out: str | PathLike[str] | None = None,
    resume: bool = False,
    angles: bool = False,
    format: str = "parquet",
    threads: int = 0,
    progress: Progress = None,
    client: distributed.Client | None = None,
    shards: int | None = None,
) -> Sweep:
    """Run random starts through the solvers, and say which equilibrium each reaches.

    A start of a chain between two anchors is an angle for each bar; of any other system, a place for each joint in
    space, where ``spread`` is ``uniform`` and ``angles`` are not written.

    Parameters
    ----------
    seeds : how many starts
    seed : what all starts come from; another number gives others
    spread : ``uniform``, ``sobol`` or ``grid``
    solver : ``both``, ``lagrange`` or ``energy``
    out : a folder for a row per start, ``format`` ``parquet`` or ``csv``; ``angles`` writes the starts, too;
        ``resume`` goes on with what is there, also after Ctrl-C
    client : a client of ``dask.distributed``: ``shards`` shards are shared out among its workers, and joined in
        ``out/merged``, byte for byte what one machine writes. ``out`` must be on a file system that all share.

    Raises
    ------
    ChainsOnly, SettingError, SweepError, StoreError, ClusterError

    >>> import funicular as fn
    >>> fn.sweep(fn.System.case("two-bars"), 100)
    <Sweep of 'two bars': 100 starts, 2 equilibria>
    """
    system = described(system)
    starts = (whole("seeds", seeds), whole("seed", seed), str(spread), str(solver))
    pool = whole("threads", threads)
    problem = system._problem
    if client is not None:
        if out is None:
            raise InputError("a sweep on a cluster needs out, a folder that all workers share")
        from .cluster import sweep_shards

        rows = (bool(angles), str(format))
        text = sweep_shards(client, system, starts, rows, Path(out), shards, progress)
        return Sweep(system, text, Path(out).resolve() / "merged")
    with shown(progress) as callback:
        if out is None:
            text, said = _native.sweep(problem, *starts, pool, callback)
            return Sweep(system, text, said=said)
        folder = Path(out)
        rows_settings = (bool(angles), str(format), folder, bool(resume))
        found = _native.sweep_write(problem, *starts, (1, 1), *rows_settings, pool, callback)
    if found is None:
        raise KeyboardInterrupt
    return Sweep(system, found, folder)
