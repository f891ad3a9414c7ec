"""What is asked about: chains between two anchors, and any system of bars, cables and struts."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from html import escape
from os import PathLike
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _native
from ._numbers import Array, Numbers, Vector, array, number, same_length, texts, vector, whole
from ._result import plain, printable
from .errors import FileError, InputError, SettingError, ShapeError
from .table import Table, vectors

if TYPE_CHECKING:
    import networkx

    from ._progress import Progress
    from .answer import Answer, Equilibrium
    from .basins import Basins
    from .census import Census
    from .motion import Modes, Motion
    from .rows import SystemBatch
    from .study import LoadCases, Losses, Study, Tolerances
    from .sweep import Sweep
    from .trace import Trace

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity, m/s² (exact by definition: 3rd CGPM, 1901)."""

KINDS = {"bar": 0, "cable": 1, "strut": 2}
"""Which changes of its length a member resists: all; stretching alone; shortening alone."""

Keys = Union[Mapping[int, Any], None]


class System:
    """A system of bars between joints, at rest under gravity along -Z and constant forces; SI units throughout.

    A chain of bars between two anchors is made from arrays::

        System(lengths=[1, 1, 1], masses=[1, 1, 1], end=(0, 0, -2))

    Other ways: :meth:`from_toml` and :meth:`read` (the format of ``funicular format``), :meth:`from_dict`,
    :meth:`from_arrays` (joints and members), :meth:`from_networkx`, :meth:`case` (examples by name).

    Parameters
    ----------
    lengths : (n,) m, positive: the bars from the start to the end
    masses : (n,) kg, zero or positive
    end, start : (3,) m: the anchors
    centres : (n,) m, optional: centre of weight from the first joint of each bar; in the middle if not given
    inertias : (n, 3) kg m², optional: principal central moments, x along the bar; matter for motion alone
    gravity : m/s², positive
    name : for people

    Raises
    ------
    ShapeError, BarError, SystemError : numbers out of range
    Refused : no equilibrium problem (OutOfReach, Taut, BarTooLong, ...), with the numbers as attributes

    Examples
    --------
    >>> import funicular as fn
    >>> s = fn.System(lengths=[0.7, 0.7, 0.7], masses=[2, 1, 1], end=(1.2, 0, -0.5))
    >>> s
    <System 'chain': chain of 3 bars, 2.1 m, 4 kg>
    >>> fn.System(lengths=[1, 1], masses=[1, 1], end=(3, 0, 0))
    Traceback (most recent call last):
    ...
    funicular.errors.OutOfReach: the anchors "0" and "2" are 3 m apart and the members between them reach only 2 m: 1 m are missing
    """

    _problem: _native.Problem

    def __init__(
        self,
        *,
        lengths: Numbers,
        masses: Numbers,
        end: Vector,
        start: Vector = (0.0, 0.0, 0.0),
        centres: Numbers | None = None,
        inertias: Numbers | None = None,
        gravity: float = STANDARD_GRAVITY,
        name: str = "chain",
    ) -> None:
        bars = array("lengths", lengths, ("n",))
        weights = _each("masses", masses, len(bars))
        middles = None if centres is None else array("centres", centres, ("n",))
        moments = None if inertias is None else array("inertias", inertias, ("n", 3))
        same_length(len(bars), centres=middles, inertias=moments)
        anchors = vector("start", start), vector("end", end)
        self._problem = _native.Problem.chain(
            _text("name", name), number("gravity", gravity), *anchors, bars, weights, middles, moments
        )

    @classmethod
    def _of(cls, problem: _native.Problem) -> System:
        system = cls.__new__(cls)
        system._problem = problem
        return system

    @classmethod
    def from_toml(cls, text: str, name: str = "text.toml") -> System:
        """The system of the text of a system file (TOML, or JSON); ``name`` stands for the file in errors.

        >>> import funicular as fn
        >>> s = fn.System.from_toml('''
        ... anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }
        ... bars = [{ length_m = 1, mass_kg = 1, count = 2 }]
        ... ''')
        >>> s.lengths_m.tolist()
        [1.0, 1.0]

        Raises FileError with ``line``, ``column``, ``key`` and ``help``, or the error of what is described.
        """
        return cls._of(_native.Problem.parse(_text("text", text), _text("name", name)))

    @classmethod
    def read(cls, path: str | PathLike[str]) -> System:
        """The system of a file (TOML or JSON; bars and joints in files of their own as CSV or Parquet).

        Or of a file of another program, by its ending: ``dxf`` and ``obj`` lines, ``map`` MAP++, ``tcl`` OpenSees, ``txt`` and
        ``dat`` MoorDyn, ``json`` COMPAS. How that was read is in :attr:`notes`; :meth:`to_toml` is the system as a file
        to be edited.

        Raises FileError when the file cannot be read or used.
        """
        try:
            return cls._of(_native.Problem.read(path))
        except FileError as error:
            if str(path) in _native.Problem.cases():
                error.details["help"] = f"there is a case of that name: System.case({str(path)!r})"
            raise

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> System:
        """The system of a dictionary with the keys of a system file; arrays may be numpy's.

        >>> import funicular as fn
        >>> lamp = fn.System.from_dict({
        ...     "gravity_m_s2": 10,
        ...     "joints": {"A": {"at_m": [-3, 0, 0]}, "B": {"at_m": [3, 0, 0]}, "lamp": {"mass_kg": 2}},
        ...     "bars": [{"from": "A", "to": "lamp", "length_m": 5, "mass_kg": 0, "kind": "cable"},
        ...              {"from": "lamp", "to": "B", "length_m": 5, "mass_kg": 0, "kind": "cable"}],
        ... })
        >>> round(float(lamp.solve().axial_n[0]), 9)    # by the triangle 3, 4, 5
        12.5

        Raises FileError, whose ``key`` says where, or the error of what is described.
        """
        if not isinstance(data, Mapping):
            raise ShapeError(f"data: a dictionary wanted, got {type(data).__name__}", argument="data")
        try:
            text = json.dumps(plain(data), allow_nan=False)
        except (TypeError, ValueError, RecursionError) as error:
            message = f"the dictionary holds what a system file cannot: {error}"
            raise FileError(message, file="dict", help="numbers must be finite, and names texts") from error
        return cls._of(_native.Problem.parse(text, "dict"))

    @classmethod
    def case(cls, name: str) -> System:
        """A named example, such as ``three-equal-bars``, the one of the paper; :func:`funicular.cases` lists them."""
        return cls._of(_native.Problem.case(_text("name", name)))

    @classmethod
    def from_arrays(
        cls,
        *,
        joints: int | Sequence[str],
        anchors: Mapping[Any, Vector],
        bars: Numbers,
        lengths: Numbers,
        masses: Numbers = 0.0,
        joint_masses: Numbers | Mapping[Any, float] = 0.0,
        forces: Numbers | Mapping[Any, Vector] | None = None,
        kinds: str | Sequence[str] = "bar",
        stiffnesses: Numbers | None = None,
        centres: Numbers | None = None,
        gravity: float = STANDARD_GRAVITY,
        name: str = "system",
    ) -> System:
        """Joints, and members between them, from arrays.

        Parameters
        ----------
        joints : how many, or their names (numbers from 0 as texts if not given)
        anchors : {joint: (3,) m}: what cannot move, by number or name
        bars : (m, 2) whole numbers: the joints of each member, from 0
        lengths : (m,) m, unstretched
        masses : (m,) kg, or one for all
        joint_masses : (joints,) kg, one for all, or {joint: kg}
        forces : (joints, 3) N, or {joint: (3,) N}
        kinds : ``bar``, ``cable`` or ``strut``, for each or for all
        stiffnesses : (m,) N, optional: EA; NaN is inextensible
        centres : (m,) m, optional

        >>> import funicular as fn
        >>> s = fn.System.from_arrays(joints=3, anchors={0: (-3, 0, 0), 1: (3, 0, 0)}, joint_masses={2: 2.0},
        ...                           bars=[[0, 2], [2, 1]], lengths=[5, 5], kinds="cable", gravity=10)
        >>> s.solve().joints_m[2].round(9).tolist()
        [0.0, 0.0, -4.0]

        Raises ShapeError, BarError, SystemError, or a class of Refused.
        """
        ends = array("bars", bars, ("m", 2))
        if isinstance(joints, (Sequence, np.ndarray)) and not isinstance(joints, str):
            names = texts("joints", joints)
        elif whole("joints", joints, 1) > 2 * len(ends):
            message = f"joints: {len(ends)} members meet {2 * len(ends)} joints at most, got {joints}"
            raise ShapeError(message, argument="joints", found=str(joints))
        else:
            names = [str(k) for k in range(whole("joints", joints, 1))]
        count = len(names)
        if not (np.all(ends == np.floor(ends)) and np.all((ends >= 0) & (ends < count))):
            raise ShapeError(
                f"bars: numbers of joints from 0 to {count - 1} wanted", argument="bars", found="other numbers"
            )
        first, second = (ends[:, k].astype(np.int64).tolist() for k in (0, 1))
        numbers = {joint: k for k, joint in enumerate(names)}
        if not isinstance(anchors, Mapping):
            raise ShapeError("anchors: a dictionary {joint: (x, y, z)} wanted", argument="anchors")
        held = _by_joint("anchors", anchors, (3,), numbers, count, np.nan)
        supports = np.isfinite(held[:, 0]).astype(int).tolist()
        springs = None if stiffnesses is None else _each("stiffnesses", stiffnesses, len(ends))
        words = [kinds] * len(ends) if isinstance(kinds, str) else texts("kinds", kinds)
        if len(words) != len(ends) or any(word not in KINDS for word in words):
            message = f"kinds: one of {', '.join(KINDS)} for all or for each of {len(ends)} members wanted"
            raise SettingError(message, setting="kinds", allowed=list(KINDS))
        problem = _native.Problem.network(
            _text("name", name),
            number("gravity", gravity),
            names,
            supports,
            held,
            np.zeros((count, 3)),
            _by_joint("joint_masses", joint_masses, (), numbers, count),
            _by_joint("forces", 0.0 if forces is None else forces, (3,), numbers, count),
            first,
            second,
            [KINDS[word] for word in words],
            array("lengths", lengths, (len(ends),)),
            _each("masses", masses, len(ends)),
            None if centres is None else _each("centres", centres, len(ends)),
            springs,
        )
        return cls._of(problem)

    @classmethod
    def from_networkx(cls, graph: networkx.Graph, *, gravity: float | None = None, name: str | None = None) -> System:
        """A graph of networkx: nodes are joints, edges members, their attributes the keys of a system file.

        A node with ``at_m`` is an anchor (with ``free`` one that slides); others are free, and may have ``mass_kg``
        and ``force_n``. An edge has ``length_m`` and, if it has one, ``mass_kg``, ``kind``, ``stiffness_n``. Nodes
        are named by ``str(node)``.

        >>> import networkx as nx, funicular as fn
        >>> g = nx.Graph()
        >>> g.add_node("A", at_m=(0, 0, 0)); g.add_node("B", at_m=(1, 0, 0)); g.add_node("P", mass_kg=5)
        >>> g.add_edge("A", "P", length_m=1, mass_kg=1); g.add_edge("P", "B", length_m=1, mass_kg=1)
        >>> fn.System.from_networkx(g).solve().rung
        'optimal'
        """
        names = {node: str(node) for node in graph.nodes}
        if len(set(names.values())) != len(names):
            raise InputError("two nodes of the graph have the same name as text")
        members = []
        for a, b, about in graph.edges(data=True):
            members.append({"from": names[a], "to": names[b], "mass_kg": 0.0, **about})
        data: dict[str, Any] = {
            "name": name or str(graph.graph.get("name") or "graph"),
            "joints": {names[node]: dict(about) for node, about in graph.nodes(data=True)},
            "bars": members,
        }
        chosen = graph.graph.get("gravity_m_s2") if gravity is None else gravity
        if chosen is not None:
            data["gravity_m_s2"] = chosen
        return cls.from_dict(data)

    @property
    def name(self) -> str:
        """The name."""
        return self._problem.name

    @property
    def notes(self) -> list[str]:
        """How the file of another program was read, in sentences; empty of any other."""
        return self._problem.notes

    @property
    def is_chain(self) -> bool:
        """Whether it is a chain of bars between two anchors."""
        return self._problem.is_chain

    @property
    def gravity_m_s2(self) -> float:
        """Gravity along -Z, m/s²."""
        return self._problem.gravity_m_s2

    @property
    def joint_names(self) -> list[str]:
        """Names of the joints; those of a chain are ``0``, ``1``, ... from the start."""
        return self._problem.joint_names()

    @property
    def member_joints(self) -> list[tuple[int, int]]:
        """The numbers of the joints of each member, from 0."""
        return self._problem.member_joints()

    @property
    def member_via(self) -> list[list[int]]:
        """The numbers of the joints that each member runs over between its own, from 0: rings and pulleys of a rope.

        >>> import funicular as fn
        >>> tackle = fn.System.from_dict({
        ...     "joints": {"beam": {"at_m": [0, 0, 0]}, "block": {"mass_kg": 40}, "winch": {"at_m": [1, 0, -3]}},
        ...     "bars": [{"from": "beam", "via": ["block", "beam", "block", "beam"], "to": "winch", "length_m": 9,
        ...               "kind": "cable"}],
        ... })
        >>> tackle.member_joints, tackle.member_via
        ([(0, 2)], [[1, 0, 1, 0]])
        """
        return self._problem.member_via()

    @property
    def lengths_m(self) -> Array:
        """(m,) Lengths of the members, m."""
        return self._problem.numbers("lengths")

    @property
    def masses_kg(self) -> Array:
        """(m,) Masses of the members, kg."""
        return self._problem.numbers("masses")

    @property
    def supports_m(self) -> Array:
        """(joints, 3) Where joints are held, m; NaN for free ones."""
        return self._problem.supports_m()

    @property
    def members(self) -> Table:
        """The members: their joints, kind, length and mass; where one is a rope also the joints that it runs over."""
        names = self.joint_names
        ends = self.member_joints
        return Table(
            {
                "member": np.arange(1, len(ends) + 1),
                "from": [names[a] for a, _ in ends],
                "to": [names[b] for _, b in ends],
                **self._over(),
                "kind": self._problem.member_kinds(),
                "length_m": self.lengths_m,
                "mass_kg": self.masses_kg,
            }
        )

    def _over(self) -> dict[str, list[str]]:
        """The column of what ropes run over, with blanks between, where there is a rope."""
        names = self.joint_names
        over = [" ".join(names[joint] for joint in via) for via in self.member_via]
        return {"via": over} if any(over) else {}

    @property
    def joints(self) -> Table:
        """The joints: their names, and where they are held (NaN where they are not)."""
        return Table({"joint": self.joint_names, **vectors("", "_m", self.supports_m)})

    def to_toml(self) -> str:
        """The system file that reads back to the same system, bit for bit."""
        return self._problem.toml()

    def near(self, joints: Numbers | Equilibrium) -> System:
        """The same system with another question: the equilibrium next to this shape, not the lowest.

        ``joints``: (joints, 3) m, where every joint is drawn, or an answer; one that is held stays where it is. All that is asked of
        the system begins there: ``solve``, ``modes``, ``simulate``; their argument ``near`` does the same for one
        question. A chain becomes a system of joints and members.

        A rod of 1 m that may turn about its foot hangs, or stands on its head:

        >>> import funicular as fn
        >>> rod = fn.System.from_arrays(joints=2, anchors={0: (0, 0, 0)}, bars=[[0, 1]], lengths=[1], joint_masses={1: 1.0})
        >>> a = rod.near([[0, 0, 0], [0, 0, 0.9]]).solve(solver="lagrange")
        >>> a.joints_m[1].round(12).tolist(), a.is_stable, a.near.is_neighbour
        ([0.0, 0.0, 1.0], False, True)

        Raises ShapeError, AnswerError when there are more or fewer places than joints, SystemError when two are at one
        place.
        """
        places = getattr(joints, "joints_m", joints)
        return System._of(self._problem.near(array("joints", places, ("joints", 3))))

    def _asked(self, near: Numbers | Equilibrium | None) -> System:
        return self if near is None else self.near(near)

    def solve(
        self,
        *,
        near: Numbers | Equilibrium | None = None,
        solver: str = "both",
        equations: str = "condensed",
        census: str = "auto",
        threads: int = 0,
        progress: Progress = None,
    ) -> Answer:
        """The lowest equilibrium, or the one next to a shape, by both solvers, compared, judged, and proved as far as it
        goes.

        See :func:`funicular.solve`, which takes the same settings.
        """
        from .answer import solve

        return solve(
            self, near=near, solver=solver, equations=equations, census=census, threads=threads, progress=progress
        )

    def census(self, *, max_bars: int | None = None, threads: int = 0, progress: Progress = None) -> Census:
        """Every equilibrium, stable or not, with the proof that there is no other. See :class:`funicular.Census`."""
        from .census import census

        return census(self, max_bars=max_bars, threads=threads, progress=progress)

    def trace(
        self,
        *vary: str,
        of: str | Sequence[str] = (),
        max_points: int | None = None,
        branches: int = 0,
        linear_buckling: bool = False,
        threads: int = 0,
        progress: Progress = None,
    ) -> Trace:
        """All equilibria of a chain over a number of its system file, or the load path of any system over a range.

        See :class:`funicular.Trace`.
        """
        from .trace import trace

        return trace(
            self,
            *vary,
            of=of,
            max_points=max_points,
            branches=branches,
            linear_buckling=linear_buckling,
            threads=threads,
            progress=progress,
        )

    def sweep(self, seeds: int, **settings: Any) -> Sweep:
        """Many starts, and where each of them leads. See :func:`funicular.sweep`."""
        from .sweep import sweep

        return sweep(self, seeds, **settings)

    def basins(self, **settings: Any) -> Basins:
        """Which start leads where, as pictures. See :func:`funicular.basins`."""
        from .basins import basins

        return basins(self, **settings)

    def solve_many(
        self,
        *,
        lengths: Numbers | None = None,
        masses: Numbers | None = None,
        stiffnesses: Numbers | None = None,
        joint_masses: Numbers | None = None,
        forces: Numbers | None = None,
        anchors: Numbers | Mapping[Any, Numbers] | None = None,
        solver: str = "lagrange",
        threads: int = 0,
        progress: Progress = None,
    ) -> SystemBatch:
        """The equilibria of this structure with other numbers, in parallel: one structure, k rows of numbers.

        Parameters
        ----------
        lengths, masses, stiffnesses : (k, members), or (members,) for all; m, kg, N
        joint_masses : (k, joints) or (joints,) kg
        forces : (k, joints, 3) or (joints, 3) N
        anchors : (k, joints, 3) or (joints, 3) m, or {joint: (k, 3) or (3,)}
        solver : ``lagrange``, ``energy`` or ``both``

        What is not given stays as it is, and so does what is NaN. A row that has no answer stops no other: its numbers are
        NaN, and ``failures`` says why.

        >>> import funicular as fn, numpy as np
        >>> v = fn.System.from_arrays(joints=3, anchors={0: (-3, 0, 0), 1: (3, 0, 0)}, joint_masses={2: 2.0},
        ...                           bars=[[0, 2], [2, 1]], lengths=[5, 5], gravity=10)
        >>> b = v.solve_many(anchors={1: [[3, 0, 0], [5, 0, 0], [9, 0, 0]]})
        >>> b.joints_m[:2, 2, 2].round(9).tolist(), b.ok.tolist()        # by the triangles 3, 4, 5 and 4, 3, 5
        ([-4.0, -3.0], [True, True, False])

        Raises ShapeError, InputError where arrays do not fit.
        """
        from .rows import solve_nets

        given: dict[str, Any] = {"lengths": lengths, "masses": masses, "stiffnesses": stiffnesses, "joint_masses": joint_masses}
        given |= {"forces": forces, "anchors": anchors}
        return solve_nets(self, given, solver=solver, threads=threads, progress=progress)

    def study(self, *vary: str, **settings: Any) -> Study:
        """The equilibrium over numbers of its file. See :func:`funicular.study`."""
        from .study import study

        return study(self, *vary, **settings)

    def in_case(self, name: str) -> System:
        """The system under the loads of one of its load cases (``[[cases]]``), by their factors.

        Raises SystemError.
        """
        return System._of(self._problem.in_case(_text("name", name)))

    def load_cases(self, **settings: Any) -> LoadCases:
        """Each load case of the file and the envelope over them. See :func:`funicular.load_cases`."""
        from .study import load_cases

        return load_cases(self, **settings)

    def page(self, *vary: str, **settings: Any) -> str:
        """The text of an HTML file on which the system is looked at. See :func:`funicular.page`."""
        from .study import page

        return page(self, *vary, **settings)

    def losses(self, **settings: Any) -> Losses:
        """The loss of each member in turn. See :func:`funicular.losses`."""
        from .study import losses

        return losses(self, **settings)

    def tolerances(self, **settings: Any) -> Tolerances:
        """Guaranteed ranges over the tolerances of its numbers. See :func:`funicular.tolerances`."""
        from .study import tolerances

        return tolerances(self, **settings)

    def derivatives(self, *, of: str | None = None, by: str | None = None, **settings: Any) -> Any:
        """The derivatives ``of`` one number of the equilibrium by all parameters (:func:`funicular.gradient`), ``by`` one
        parameter of all numbers (:func:`funicular.change`), or the stiffness of the anchors (:func:`funicular.anchor_stiffness`).
        """
        from .study import anchor_stiffness, change, gradient

        if of is not None and by is not None:
            raise InputError("derivatives: of or by, not both", argument="by")
        if of is not None:
            return gradient(self, of, **settings)
        return anchor_stiffness(self, **settings) if by is None else change(self, by, **settings)

    def simulate(self, **settings: Any) -> Motion:
        """The system in motion. See :func:`funicular.simulate`."""
        from .motion import simulate

        return simulate(self, **settings)

    def modes(
        self,
        *,
        near: Numbers | Equilibrium | None = None,
        max_bars: int | None = None,
        lowest: int | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Modes:
        """Small oscillations about its equilibria. See :class:`funicular.Modes`."""
        from .motion import modes

        return modes(self, near=near, max_bars=max_bars, lowest=lowest, threads=threads, progress=progress)

    def __repr__(self) -> str:
        bars = len(self.member_joints)
        what = "chain" if self.is_chain else f"{len(self.joint_names)} joints"
        sums = f"{_short(math.fsum(self.lengths_m))} m, {_short(math.fsum(self.masses_kg))} kg"
        return f"<System {printable(self.name)!r}: {what} of {bars} bars, {sums}>"

    def _repr_html_(self) -> str:
        return f"<p><b>{escape(printable(self.name))}</b></p>{self.members._repr_html_()}"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, System) and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> Any:
        # The text reads back to the same numbers, bit for bit.
        return System.from_toml, (self.to_toml(), "pickle")


def _short(value: float) -> str:
    return f"{value:.6g}"


def _text(argument: str, value: Any) -> str:
    if not isinstance(value, str):
        raise ShapeError(f"{argument}: a text wanted, got {type(value).__name__}", argument=argument)
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise ShapeError(f"{argument}: the text holds half a character", argument=argument) from error
    return str(value)


def _each(argument: str, value: Any, count: int) -> Array:
    """One number for each, or the same for all."""
    if np.ndim(value) == 0:
        return np.full(count, number(argument, value))
    return array(argument, value, (count,))


def _joint(argument: str, joint: Any, numbers: Mapping[str, int], count: int) -> int:
    """The number of a joint, given by number or name."""
    found = numbers.get(joint) if isinstance(joint, str) else whole(argument, joint)
    if found is None or found >= count:
        raise ShapeError(f"{argument}: there is no joint {joint!r:.80}", argument=argument)
    return found


def _by_joint(
    argument: str, value: Any, shape: tuple[int, ...], numbers: Mapping[str, int], count: int, rest: float = 0.0
) -> Array:
    """An entry for each joint, from an array, one for all, or by joint, where others have the rest."""
    if isinstance(value, Mapping):
        found = np.full((count, *shape), rest)
        at = [_joint(argument, joint, numbers, count) for joint in value]
        if len(set(at)) < len(at):
            raise ShapeError(f"{argument}: a joint is given twice, by its name and its number", argument=argument)
        for k, (joint, entry) in zip(at, value.items()):
            found[k] = array(f"{argument}[{joint!r}]", entry, shape)
        return found
    if np.ndim(value) == 0:
        return np.full((count, *shape), number(argument, value))
    return array(argument, value, (count, *shape))


Described = System | str | PathLike[str] | Mapping[str, Any]
"""A system, the path of its file, or a dictionary with the keys of one."""


def described(system: Described) -> System:
    """The system itself, or that of the file or dictionary."""
    if isinstance(system, str) and "\n" in system:
        message = "a system, or the path of a system file, is required, not its text"
        raise InputError(message, argument="system", help="System.from_toml(text) reads a text")
    if isinstance(system, (str, PathLike)):
        return System.read(system)
    if isinstance(system, Mapping):
        return System.from_dict(system)
    if isinstance(system, System):
        return system
    message = f"a system, or the path of a system file, is required, not {type(system).__name__}"
    raise InputError(message, argument="system")
