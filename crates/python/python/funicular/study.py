"""The equilibrium over numbers of the file, and its derivatives by them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _native
from ._numbers import number, texts, whole
from ._picture import Picture
from ._progress import Progress, shown
from ._result import Result, printable
from .errors import InputError
from .evidence import Record
from .plot import plot_study
from .system import Described, System, described
from .table import Table, read_csv


class Study(Result):
    """The equilibrium at each combination of the parameters, by both solvers, compared and judged.

    ``table``: a row for each point, with the parameters, sag, forces, angles and what was asked for besides, units in the
    names; ``refused`` says why a point has none. ``svg(path)``: a figure of a path, from 1. ``agrees``: whether all points
    that can hang are agreed upon.

    >>> import funicular as fn
    >>> v = fn.System(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0))
    >>> s = v.study("anchors.end_m.x=0.4..2.2:10", of=["joints.1.z"])
    >>> s.table["sag_m"][:3].round(6).tolist()          # a triangle: sqrt(1 - (d/2)^2)
    [0.979796, 0.953939, 0.916515]
    >>> s.table["refused"][-1]                          # anchors 2.2 m apart
    'the anchors "0" and "2" are 2.2 m apart and the members between them reach only 2 m: 0.2 m are missing'
    """

    def __init__(
        self, system: System, text: str, points: str, figures: list[str], failed: bool, decided: bool, said: str
    ) -> None:
        self.system = system
        self._said = said
        self.data: dict[str, Any] = json.loads(text)
        self._points = points
        self._figures = figures
        self.check_failed = failed
        self.is_decided = decided

    @property
    def agrees(self) -> bool:
        """Whether no check failed and every point that can hang has an answer of both solvers."""
        return self.is_decided and not self.check_failed

    @property
    def parameters(self) -> list[str]:
        """What varies, by its path in a system file."""
        return list(self.data["parameters"])

    @property
    def table(self) -> Table:
        """A row for each point."""
        return read_csv(self._points, counts=COUNTS, texts=TEXTS)

    def svg(self, path: int = 1) -> Picture:
        """Sag, forces and angles over the last parameter, along one path."""
        if not 1 <= whole("path", path, 1) <= len(self._figures):
            raise InputError(f"there is no path {path}: there are {len(self._figures)}")
        return Picture(self._figures[path - 1])

    def plot(self, *columns: str, path: int = 1) -> Any:
        """Draw columns of the table (sag and largest tension if none are given) over the last parameter, each into axes of
        matplotlib, which must be installed; a figure."""
        return plot_study(self, columns or ("sag_m", "tension_n"), path)

    def _repr_svg_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        return f"<Study of {printable(self.system.name)!r} over {', '.join(self.parameters)}: {self.table.rows} points>"


COUNTS = ("path", "tension_bar", "compression_bar")
"""Columns of whole numbers."""
TEXTS = ("evidence", "lowest_joint", "refused")
"""Columns of words and names."""


def study(
    system: Described,
    *vary: str,
    zip: bool = False,
    of: str | Sequence[str] = (),
    solver: str = "both",
    threads: int = 0,
    progress: Progress = None,
) -> Study:
    """The equilibrium over numbers of its file, such as ``bars.1.length_m=1,1.1,1.2`` or ``anchors.end_m.x=0.5..1.5:40``.

    Several are combined, or taken in step with ``zip``. ``of``: numbers to show besides, such as ``joints.P.z``, ``sag.A-B``,
    ``bars.1.axial_max_n``, ``height``.

    Raises ParameterError.
    """
    system = described(system)
    with shown(progress) as callback:
        found = _native.study(
            system._problem,
            texts("vary", vary),
            bool(zip),
            texts("of", of),
            str(solver),
            whole("threads", threads),
            callback,
        )
    return Study(system, *found)


class Losses(Result):
    """What becomes of a system that loses a member, each in turn.

    ``losses``
        a :class:`Record` for each: ``bar``, the member that is lost, from 1; where something hangs then ``lowest_joint``, ``sag_m``,
        ``moves``, ``moves_m`` (the joint that moves farthest), ``tension_n``, ``compression_n`` (bar, from 1, and force), ``weakest``,
        ``rung``, ``agrees``; else ``outcome`` (``falls``, ``leaves`` its drawing, ``no-load``, ``unknown``) and ``reason``.
    ``survives``
        whether all of it still hangs after any one loss, and is as strong as wanted.
    """

    def __init__(self, system: System, text: str, said: str, survives: bool) -> None:
        self.system = system
        self.data = json.loads(text)
        self.losses = [Record(loss) for loss in self.data["losses"]]
        self.survives = survives
        self._said = said

    def __repr__(self) -> str:
        return f"<Losses of {printable(self.system.name)!r}: {'survived' if self.survives else 'not survived'}>"


def losses(system: Described, *, solver: str = "both", threads: int = 0, progress: Progress = None) -> Losses:
    """The loss of each member in turn: what hangs then, with which forces, and which loss lets a part fall.

    >>> import funicular as fn
    >>> found = fn.losses(fn.System.case("lamp"))       # on two cables of 3 and 4 m: each bears all of it alone
    >>> found.survives, [loss.moves for loss in found.losses]
    (True, ['lamp', 'lamp'])
    """
    system = described(system)
    with shown(progress) as callback:
        found = _native.losses(system._problem, str(solver), whole("threads", threads), callback)
    return Losses(system, *found)


class LoadCases(Result):
    """A system in each of its load cases, and the envelope over them.

    ``cases``
        a :class:`Record` for each: ``name``, and what :class:`Losses` has of what hangs, or ``outcome`` and ``reason``; joints move
        from where they are in the first case.
    ``bars``
        a :class:`Record` for each: ``bar``, from 1, ``ends``, ``least_n`` and ``most_n``, each with ``value`` and ``case``; with
        a strength ``utilisation``.
    ``supports``
        a :class:`Record` for each: ``joint`` and ``most_n``, the largest size of the force of the ground.
    ``is_strong``
        whether all is as strong as wanted in every case; ``None`` without strengths.
    """

    def __init__(self, system: System, text: str, said: str, is_strong: bool | None) -> None:
        self.system = system
        self.data = json.loads(text)
        self.cases, self.bars, self.supports = (
            [Record(one) for one in self.data[key]] for key in ("cases", "bars", "supports")
        )
        self.is_strong = is_strong
        self._said = said

    def __repr__(self) -> str:
        return f"<LoadCases of {printable(self.system.name)!r}: {', '.join(printable(case.name) for case in self.cases)}>"


def load_cases(
    system: Described, *, solver: str = "both", threads: int = 0, progress: Progress = None
) -> LoadCases:
    """Where a system comes to rest in each of the load cases of its file, and the least and largest forces over them.

    >>> import funicular as fn
    >>> pole = fn.System.from_toml('''
    ... joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }
    ... bars = [{ from = "A", to = "P", length_m = 1, mass_kg = 0 }]
    ... loads = [{ name = "snow", joint = "P", mass_kg = 4 }]
    ... cases = [{ name = "summer", factors = {} }, { name = "winter", factors = { snow = 1.5 } }]''')
    >>> found = fn.load_cases(pole)
    >>> found.bars[0].most_n.case, round(found.bars[0].most_n.value / found.bars[0].least_n.value)
    ('winter', 7)
    >>> pole.in_case("winter").name
    'unnamed, winter'
    """
    system = described(system)
    with shown(progress) as callback:
        found = _native.load_cases(system._problem, str(solver), whole("threads", threads), callback)
    return LoadCases(system, *found)


def page(
    system: Described,
    *vary: str,
    motion: str | None = None,
    time: float = 10.0,
    damping: float = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> str:
    """A page to look at a system: the text of an HTML file that needs nothing else.

    It shows the answer of both solvers, all equilibria where a census is complete, the load cases and the lowest modes; over a
    range, ``"loads=0.5..2"``, also the load path, with a slider, or where none can be followed, and over values of a chain,
    the shapes of a study, and says which. ``motion`` is a ``start`` of :func:`simulate`, with ``time`` (s) and ``damping``
    (1/s): the motion from there is played.

    >>> import funicular as fn
    >>> text = fn.page(fn.System.case("lamp"), "loads=0.5..2", motion="seed:7", time=1)
    >>> text.startswith("<!DOCTYPE html>"), "Load paths" in text, "Motion" in text
    (True, True, True)
    """
    moved = None if motion is None else (str(motion), number("time", time), number("damping", damping))
    with shown(progress) as callback:
        return _native.page(described(system)._problem, texts("vary", vary), moved, whole("threads", threads), callback)


class Tolerances(Result):
    """Ranges of an equilibrium over all values of its numbers within their tolerances, guaranteed.

    ``is_proved``, ``reason``
        whether one equilibrium is proved for all values, near that of the numbers given; else why not.
    ``is_stable``
        whether it is stable for all of them.
    ``numbers``
        a :class:`Record` for each uncertain number: ``name``, ``given``, ``within``.
    ``bars``, ``joints``
        a :class:`Record` for each: ``axial_n``, and ``at_m``, ``reaction_n`` for each axis, with ``least``, ``most``, ``least_reached``,
        ``most_reached``, ``is_hull``, ``most_by`` (the number on which it depends most) and ``most_change``.
    ``axial_n``, ``joints_m``
        least and most of all forces and places, as arrays of shape (bars, 2) and (joints, 3, 2).
    ``sag``
        a :class:`Record` of the largest sag of the numbers given: the ``joint``, the line ``from`` and ``to`` below which it hangs
        (one name twice: the lowest support), and ``depth_m``, with the same as a force; ``None`` where nothing sags.
    ``draws``
        what became of random values, if any were drawn.
    """

    def __init__(self, system: System, text: str, said: str) -> None:
        self.system = system
        self.data = json.loads(text)
        found = self.data["tolerances"]
        self.is_proved: bool = found["is_proved"]
        self.reason: str | None = found.get("reason")
        self.is_stable: bool | None = found.get("is_stable")
        self.numbers = [Record(number) for number in found.get("numbers", [])]
        self.bars = [Record(bar) for bar in found.get("bars", [])]
        self.joints = [Record(joint) for joint in found.get("joints", [])]
        self.sag = Record(found["sag"]) if found.get("sag") else None
        self.draws = Record(found["draws"]) if "draws" in found else None
        ends = [[bar["axial_n"]["least"], bar["axial_n"]["most"]] for bar in found.get("bars", [])]
        self.axial_n = np.array(ends).reshape(-1, 2)
        places = [[[x["least"], x["most"]] for x in joint["at_m"]] for joint in found.get("joints", [])]
        self.joints_m = np.array(places).reshape(-1, 3, 2)
        self._said = said

    def __repr__(self) -> str:
        return f"<Tolerances of {printable(self.system.name)!r}: {'proved' if self.is_proved else 'not proved'}>"


def tolerances(
    system: Described,
    *,
    draws: int = 0,
    seed: int = 1,
    distribution: str = "uniform",
    solver: str = "both",
    threads: int = 0,
    progress: Progress = None,
) -> Tolerances:
    """Bound all places, forces, reactions and the largest sag over the tolerances in the system's file, in interval arithmetic;
    with ``draws`` solve so many random values within them too, ``uniform``, ``normal`` (a third of the tolerance as deviation, cut off
    at it) or at their ``ends``.

    >>> import funicular as fn
    >>> text = '''gravity_m_s2 = 10
    ... joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2, mass_tolerance_kg = 0.5 } }
    ... bars = [{ from = "A", to = "P", length_m = 3, mass_kg = 0 }]'''
    >>> found = fn.System.from_toml(text).tolerances()
    >>> found.is_proved, found.axial_n.round(9).tolist(), found.bars[0].axial_n.most_by
    (True, [[15.0, 25.0]], 'joints.P.mass_kg')
    """
    system = described(system)
    with shown(progress) as callback:
        drawn = whole("draws", draws), whole("seed", seed), str(distribution)
        found = _native.tolerances(system._problem, drawn, str(solver), whole("threads", threads), callback)
    return Tolerances(system, *found)


class Gradient(Record):
    """The derivatives of one number of an equilibrium: ``of``, ``value`` (m or N), ``derivatives``; ``gradient["bars.1.length_m"]``
    is the derivative by that parameter, ``table`` has all with their units."""

    def __getitem__(self, parameter: str) -> float:
        for one in self.data["derivatives"]:
            if one["parameter"] == parameter:
                return float(one["value"])
        raise KeyError(parameter)

    @property
    def table(self) -> Table:
        """A row for each parameter: its path, the derivative, its unit."""
        rows = self.data["derivatives"]
        values = np.array([row["value"] for row in rows], dtype=np.float64)
        return Table(
            {"parameter": [row["parameter"] for row in rows], "value": values, "unit": [row["unit"] for row in rows]}
        )


def gradient(system: Described, of: str, *, threads: int = 0, progress: Progress = None) -> Gradient:
    """The derivatives of one number of the equilibrium, ``joints.P.at_m.z`` or ``bars.2.axial_n``, by lengths, masses, stiffnesses,
    prestresses, forces and anchors, by ``lagrange``.

    >>> import funicular as fn
    >>> v = fn.System.from_toml('''
    ... gravity_m_s2 = 10
    ... joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 0.8 } }
    ... bars = [{ from = "A", to = "P", length_m = 5, mass_kg = 0 }, { from = "P", to = "B", length_m = 5, mass_kg = 0 }]
    ... ''')
    >>> round(fn.gradient(v, "joints.P.at_m.z")["bars.1.length_m"], 12)      # half of l/h
    -0.625

    Raises DerivativesError where ``of`` is no such number, Error where the equilibrium has no derivatives.
    """
    system = described(system)
    with shown(progress) as callback:
        text = _native.derivatives(system._problem, str(of), None, whole("threads", threads), callback)
    return Gradient(json.loads(text))


def change(system: Described, by: str, *, threads: int = 0, progress: Progress = None) -> Record:
    """How the whole equilibrium changes by one parameter, such as ``bars.1.length_m`` or ``anchors.end_m.x``: ``unit``, ``joints_m``
    and ``reactions_n`` by name, ``axial_n``, each per unit of the parameter.

    Raises DerivativesError where there are no derivatives by it, Error where the equilibrium has none.
    """
    system = described(system)
    with shown(progress) as callback:
        text = _native.derivatives(system._problem, None, str(by), whole("threads", threads), callback)
    return Record(json.loads(text))


def anchor_stiffness(system: Described, *, threads: int = 0, progress: Progress = None) -> list[Record]:
    """The stiffness matrices of all pairs of anchors: ``of``, ``by``, ``stiffness_n_m`` (3 lists of 3), N/m.

    Raises Error where the equilibrium has no derivatives, or an anchor cannot move alone.
    """
    system = described(system)
    with shown(progress) as callback:
        text = _native.derivatives(system._problem, None, None, whole("threads", threads), callback)
    return [Record(pair) for pair in json.loads(text)]
