"""The hanging equilibrium, with the evidence for it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from difflib import get_close_matches
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from . import _native
from ._html import ladder, page
from ._numbers import Array, Numbers, Vector, whole
from ._picture import FORMATS, File, Picture, ending
from ._progress import Progress, shown
from ._result import Result, printable
from .errors import InputError
from .evidence import Evidence, Proofs, Record
from .plot import plot
from .system import STANDARD_GRAVITY, Described, System, described
from .table import Table, vectors


ARRAYS = (
    "joints_m",
    "axial_n",
    "axial_from_n",
    "axial_to_n",
    "axial_max_n",
    "start_forces_n",
    "end_forces_n",
    "reactions_n",
    "multipliers_n",
    "utilisation",
)
"""What an equilibrium has for its joints and members."""

EXTREMES = ("sag_m", "largest_tension_n", "largest_compression_n")
"""What stands out in it."""


class Equilibrium(Result):
    """One equilibrium: places of the joints, forces, and how far it is proved.

    All arrays are in the order of the joints or members of the system, world frame, Z up:

    ``joints_m``
        (joints, 3) places, m.
    ``axial_n``
        (members,) axial forces, tension positive, N; weights lumped to the joints by the lever rule: the value in the middle
        of a homogeneous member.
    ``axial_from_n``, ``axial_to_n``, ``axial_max_n``
        (members,) the same at the joint where the member begins, where it ends, and where it is largest, N.
    ``start_forces_n``, ``end_forces_n``
        (members, 3) forces on each member at the joint where it begins, and ends, N.
    ``reactions_n``
        (joints, 3) forces of the ground, N; zero at free joints.
    ``multipliers_n``
        (n + 1, 3) for chains: entry 0 the force of the ground on bar 1, entry k that of bar k+1 on bar k, the last that
        of the ground on bar n, N; ``None`` for other systems.
    ``utilisation``
        (members,) the part of its strength that each member uses (``strength_n``, ``compression_n`` or ``bending_n_m2`` in
        its file), NaN without one, infinite where nothing bounds its force; ``None`` where no member has a strength.
    ``weakest``
        the member that is nearest to breaking, against the safety wanted: its ``number`` (from 0), ``utilisation``, ``safety``
        (strength over force) and ``safety_wanted``; ``None`` where no member has a strength.
    ``is_strong``
        whether all members are as strong as wanted; ``None`` where no member has a strength.
    ``sag_m``
        how deep a joint hangs below the line that its row of members spans, the largest, m; ``None`` where no row spans
        anything and no joint is below the supports.
    ``largest_tension_n``, ``largest_compression_n``
        anywhere along a member, both positive, N; ``None`` where nothing pulls, or pushes.
    """

    joints_m: Array
    axial_n: Array
    axial_from_n: Array
    axial_to_n: Array
    axial_max_n: Array
    start_forces_n: Array
    end_forces_n: Array
    reactions_n: Array
    multipliers_n: Array | None
    utilisation: Array | None
    weakest: Record | None
    is_strong: bool | None
    sag_m: float | None
    largest_tension_n: float | None
    largest_compression_n: float | None

    def __init__(self, system: System, data: dict[str, Any], arrays: dict[str, Any]) -> None:
        self.system = system
        self._data = data
        self._take(arrays)

    def _take(self, arrays: dict[str, Any]) -> None:
        for name in ARRAYS + EXTREMES:
            setattr(self, name, arrays[name])
        weakest = arrays["weakest"]
        self.weakest = None if weakest is None else Record(weakest)
        self.is_strong = arrays["is_strong"]

    @property
    def data(self) -> dict[str, Any]:
        """Its object of JSON: ``solver``, ``energy_j``, ``stability``, ``evidence``, ..."""
        return self._data

    @property
    def _own(self) -> dict[str, Any]:
        return self.data

    def _content(self) -> dict[str, Any]:
        found = {name: getattr(self, name) for name in (*ARRAYS, *EXTREMES, "weakest")}
        return {**self.data, **found}

    @property
    def solver(self) -> str:
        """Who found it."""
        return str(self._own["solver"])

    @property
    def energy_j(self) -> float:
        """Potential energy, J, above the height of the first anchor."""
        return float(self._own["energy_j"])

    @cached_property
    def stability(self) -> Record:
        """``in_space`` (``stable`` or ``unstable``), ``index_in_space``, ``index_in_plane``, ``neutral``."""
        return Record(self._own["stability"])

    @property
    def is_stable(self) -> bool:
        """Whether the energy falls in no direction of space."""
        return bool(self.stability.in_space == "stable")

    @cached_property
    def evidence(self) -> Evidence:
        """Residual, iterations, condition, and the ladder."""
        return Evidence(self._own["evidence"])

    @property
    def proofs(self) -> Proofs:
        """The evidence ladder, rung by rung."""
        return self.evidence.proofs

    @property
    def rung(self) -> str | None:
        """The highest rung reached."""
        return self.evidence.rung

    @property
    def joints(self) -> Table:
        """A row for each joint: name, place, force of the ground."""
        columns = {"joint": self.system.joint_names, **vectors("", "_m", self.joints_m)}
        return Table({**columns, **vectors("reaction_", "_n", self.reactions_n)})

    @property
    def bars(self) -> Table:
        """A row for each member: joints, axial force, forces on it at both ends."""
        names = self.system.joint_names
        ends = self.system.member_joints
        used = {} if self.utilisation is None else {"utilisation": self.utilisation}
        return Table(
            {
                "member": np.arange(1, len(ends) + 1),
                "from": [names[a] for a, _ in ends],
                "to": [names[b] for _, b in ends],
                **self.system._over(),
                "axial_n": self.axial_n,
                "axial_from_n": self.axial_from_n,
                "axial_to_n": self.axial_to_n,
                "axial_max_n": self.axial_max_n,
                **vectors("start_", "_n", self.start_forces_n),
                **vectors("end_", "_n", self.end_forces_n),
                **used,
            }
        )

    def _joint(self, joint: str | int) -> int:
        """The number of a joint."""
        names = self.system.joint_names
        if isinstance(joint, str):
            if joint not in names:
                meant = [*get_close_matches(joint, names, 1), None][0]
                near = meant and f"did you mean `{meant}`?"
                raise InputError(f"there is no joint {joint!r:.80}", suggestion=meant, help=near)
            return names.index(joint)
        number = whole("joint", joint)
        if number >= len(names):
            raise InputError(f"there is no joint {number}: the last is {len(names) - 1}")
        return number

    def reaction(self, joint: str | int) -> Array:
        """(3,) Force of the ground on a joint, by its name or number, N."""
        force: Array = self.reactions_n[self._joint(joint)]
        return force

    def joint(self, joint: str | int) -> Array:
        """(3,) Place of a joint, by its name or number, m."""
        place: Array = self.joints_m[self._joint(joint)]
        return place

    def member(self, first: str | int, second: str | int) -> Record:
        """The member between two joints: ``number`` (from 0), ``axial_n``, ``axial_from_n``, ``axial_to_n``, ``axial_max_n``,
        N, and ``start_force_n``, ``end_force_n``, (3,) N, in the direction in which the system has it.

        Raises InputError where no member connects them, or more than one.

        >>> import funicular as fn
        >>> lamp = fn.System.case("lamp").solve()
        >>> lamp.member("A", "lamp").axial_max_n == float(lamp.axial_max_n[0])
        True
        """
        wanted = {self._joint(first), self._joint(second)}
        found = [k for k, ends in enumerate(self.system.member_joints) if set(ends) == wanted]
        if len(found) != 1:
            count = "no member" if not found else f"{len(found)} members"
            raise InputError(f"{count} between the joints {first!r:.80} and {second!r:.80}")
        k = found[0]
        names = ("axial_n", "axial_from_n", "axial_to_n", "axial_max_n")
        numbers: dict[str, Any] = {name: float(getattr(self, name)[k]) for name in names}
        forces = {"start_force_n": self.start_forces_n[k], "end_force_n": self.end_forces_n[k]}
        return Record({"number": k, **numbers, **forces})

    def svg(self, view: str = "best") -> Picture:
        """The picture to scale: joints, supports, loads, reactions, tension and compression.

        ``view``: from where it is seen, ``best``, ``front`` (x to the right, z up), ``side`` (y, z) or ``top`` (x, y).
        """
        return Picture(self._file(self.axial_max_n, "svg", view))

    def save(self, path: File, view: str = "best") -> None:
        """Write a file: a picture (``.svg``, ``.png``, ``.pdf``; see :meth:`svg`), or one for another program (:meth:`export`)."""
        if ending(path) in FORMATS:
            self.svg(view).save(path)
        else:
            Path(path).write_text(self.export(ending(path)), encoding="utf-8", newline="\n")

    def export(self, ending: str) -> str:
        """The text of a file for another program, of the format that the ending of its name stands for.

        ``vtu`` ParaView, ``dxf`` CAD, ``obj`` and ``gltf`` solids, ``xml`` MuJoCo, ``urdf`` links, ``txt`` MoorDyn, ``json`` COMPAS.

        >>> import funicular as fn
        >>> text = fn.System.case("lamp").solve().export("vtu")
        >>> text.startswith("<?xml"), "axial_n" in text
        (True, True)
        """
        return self._file(self.axial_n, str(ending))

    def _file(self, axial_n: Array, ending: str, view: str = "best") -> str:
        joints, axial, ground = map(np.ascontiguousarray, (self.joints_m, axial_n, self.reactions_n))
        return _native.export(self.system._problem, joints, axial, ground, self.utilisation, ending, view)

    def plot(self, ax: Any = None, *, space: bool | None = None, forces: bool = True, view: str = "best") -> Any:
        """Draw into axes of matplotlib, which must be installed; see :func:`funicular.plot.plot`."""
        return plot(self, ax, space=space, forces=forces, view=view)

    def __repr__(self) -> str:
        where = printable(self.system.name)
        return f"<Equilibrium of {where!r} by {self.solver}: {self.energy_j:.6g} J, {self.rung}>"

    def _repr_html_(self) -> str:
        return page(self)


class Answer(Equilibrium):
    """What the solvers found, compared, judged and proved as far as it goes.

    ``equilibria`` has one :class:`Equilibrium` for each solver that has an answer, ``lagrange`` first. All that an
    equilibrium has (``joints_m``, ``axial_n``, ``energy_j``, ``proofs``, ``rung``, ``plot()``, ...) the answer has
    too: it is that of the first.
    """

    def __init__(
        self, system: System, asked: tuple[str, str, str], text: str, arrays: list[dict[str, Any]]
    ) -> None:
        self.system = system
        self._asked = asked
        self._text = text
        self._arrays = arrays
        self._take(arrays[0])

    @property
    def _own(self) -> dict[str, Any]:
        first: dict[str, Any] = self.data["equilibria"][0]
        return first

    def _content(self) -> dict[str, Any]:
        return {**self.data, "equilibria": self.equilibria}

    def __str__(self) -> str:
        # As `funicular solve` prints it; it is solved again for that.
        return _native.solve_text(self.system._problem, *self._asked)

    @cached_property
    def data(self) -> dict[str, Any]:
        """The object that ``funicular solve --summary --json`` prints."""
        found: dict[str, Any] = json.loads(self._text)
        return found

    @cached_property
    def equilibria(self) -> list[Equilibrium]:
        """One for each solver that has an answer."""
        pairs = zip(self.data["equilibria"], self._arrays)
        return [Equilibrium(self.system, data, arrays) for data, arrays in pairs]

    def by(self, solver: str) -> Equilibrium:
        """The answer of ``lagrange`` or ``energy``."""
        for equilibrium in self.equilibria:
            if equilibrium.solver == solver:
                return equilibrium
        raise InputError(f"{solver!r:.80} has no answer here")

    @property
    def failures(self) -> list[dict[str, Any]]:
        """Why solvers that were asked have no answer: ``solver``, ``reason``, ``refusal`` with its numbers."""
        return list(self.data["failures"])

    @property
    def near(self) -> Record | None:
        """How the first answer lies to the shape next to which it was sought; ``None`` where the lowest was sought.

        ``is_neighbour``; ``joint``, ``moved_m`` and ``moved`` (in units of the shortest member there): the largest move;
        ``barrier_j``: how far the energy rises on the way; ``lower_j``: the energy of a lower equilibrium, if one is known.
        """
        return Record(self.data["near"]) if self.data.get("near") else None

    @property
    def asked_again(self) -> tuple[str, ...]:
        """The solvers that had no answer or another equilibrium, and were asked again next to a known one."""
        return tuple(self.data.get("asked_again", ()))

    @property
    def agreement(self) -> Record | None:
        """The comparison of both answers, with its numbers; ``None`` if there is one answer."""
        return Record(self.data["agreement"]) if self.data["agreement"] else None

    @property
    def agrees(self) -> bool:
        """Whether both solvers answered and agree, and the judge finds both in balance."""
        return len(self.equilibria) > 1 and all(e.proofs.agreed.reached for e in self.equilibria)

    def __repr__(self) -> str:
        verdict = self.agreement.verdict if self.agreement else ", ".join(e.solver for e in self.equilibria)
        agreed = "agreed" if self.agrees else "not confirmed" if verdict == "agreed" else verdict
        return f"<Answer of {printable(self.system.name)!r}: {self.energy_j:.6g} J, {self.rung} ({agreed})>"

    def _repr_html_(self) -> str:
        rest = "".join(f"<h4>{e.solver}</h4>{ladder(e)}" for e in self.equilibria[1:])
        return page(self) + rest


def solve(
    system: Described | Numbers | None = None,
    masses: Numbers | None = None,
    end: Vector | None = None,
    *,
    near: Numbers | Equilibrium | None = None,
    lengths: Numbers | None = None,
    start: Vector = (0.0, 0.0, 0.0),
    centres: Numbers | None = None,
    gravity: float = STANDARD_GRAVITY,
    name: str = "chain",
    solver: str = "both",
    equations: str = "condensed",
    census: str = "auto",
    threads: int = 0,
    progress: Progress = None,
) -> Answer:
    """The lowest equilibrium, or the one next to a shape, by two solvers that share no mechanics, compared, judged and proved as far as it goes.

    Parameters
    ----------
    system : a :class:`System`, the path of a system file, or a dictionary with its keys; or give a chain by ``lengths`` (here or by that name),
        ``masses``, ``end`` and what else its arrays need
    near : (joints, 3) m, or an answer, optional: a shape, next to which the equilibrium is sought: see :meth:`System.near`
    solver : ``both``, ``lagrange`` or ``energy``
    equations : ``condensed``, or ``full`` for all coordinates and multipliers of the paper (some 30 bars)
    census : ``auto`` looks up chains of up to 8 bars in the list of all equilibria, ``never`` none, ``always`` all
    threads : how many share the work, 0 for what :func:`set_threads` says; no answer depends on it
    progress : ``True`` for a bar, or a function of (what, done, total)

    Returns
    -------
    Answer

    Raises
    ------
    ShapeError, BarError, SystemError : numbers out of range
    Refused : no equilibrium problem: OutOfReach, Taut, BarTooLong, Folded, NothingMoves, NoLoad, ...
    Unsolved : no solver that was asked has an answer; ``failures`` says why

    Examples
    --------
    The example of the paper: three bars of 1 m and 1 kg, anchors 2 m apart on one vertical.

    >>> import funicular as fn
    >>> a = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(0, 0, -2))
    >>> a.rung, a.agrees
    ('optimal', True)
    >>> round(float(a.multipliers_n[0, 2]) / 9.80665, 12)    # λ₃ in mg, as a root finder of 40 digits has it
    2.312944292242
    >>> fn.solve([1, 1, 1], [1, 1, 1], (0, 0, -2)).energy_j == a.energy_j
    True
    """
    if isinstance(system, (str, PathLike, Mapping)):
        system = described(system)
    elif system is not None and not isinstance(system, System):
        if lengths is not None:
            raise InputError("the lengths of the chain are given twice")
        system, lengths = None, system
    if system is None:
        if lengths is None or masses is None or end is None:
            raise InputError("give a system, the path of a system file, or lengths, masses and end")
        system = System(
            lengths=lengths, masses=masses, end=end, start=start, centres=centres, gravity=gravity, name=name
        )
    elif lengths is not None or masses is not None or end is not None:
        raise InputError("give a system or the arrays of a chain, not both")
    system = system._asked(near)
    asked = (str(solver), str(equations), str(census))
    with shown(progress) as callback:
        found = _native.solve(system._problem, *asked, whole("threads", threads), callback)
    return Answer(system, asked, *found)
