"""The paper "Equilibrium of a system of bars using a multibody type method", judged."""

from __future__ import annotations

import json
from typing import Any

from . import _native
from ._numbers import whole
from ._progress import Progress, shown
from ._result import Result


class Reproduction(Result):
    """What the paper claims, what two solvers find, and the verdicts.

    ``data`` is the object that ``funicular reproduce --json`` prints: ``claims``, ``equations``, ``equilibria``,
    ``figures``, ``seeds``, ``summary``, ...; ``html()`` is the report as a page.
    """

    def __init__(self, text: str, page: str, said: str) -> None:
        self.data: dict[str, Any] = json.loads(text)
        self._page = page
        self._said = said

    @property
    def all_as_expected(self) -> bool:
        """Whether every verdict is the one expected."""
        return bool(self.data["all_as_expected"])

    def html(self) -> str:
        """The referee's report as a page that needs nothing else."""
        return self._page

    def __repr__(self) -> str:
        return f"<Reproduction: {self.data['summary']['claims']} claims judged>"


def reproduce(*, threads: int = 0, progress: Progress = None) -> Reproduction:
    """Judge the paper: its claims, its numbers, its equations. Takes some seconds."""
    with shown(progress) as callback:
        return Reproduction(*_native.reproduce(whole("threads", threads), callback))
