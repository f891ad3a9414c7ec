"""Somebody else's answer, judged."""

from __future__ import annotations

import json
from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np

from . import _native
from ._numbers import Array, Numbers, Vector, array, number, vector, whole
from ._progress import Progress, shown
from ._result import Result, printable
from .answer import Equilibrium
from .errors import InputError
from .evidence import Proofs, Record
from .system import Described, System, described
from .table import Table


class Judgement(Result):
    """What Newton's laws, the laws of the members and both solvers say of an answer.

    ``confirmed``: an equilibrium is within the tolerance; ``refuted``: a law is broken by more than the tolerance
    explains; neither: see ``says``. ``broken``: what is broken, largest first; ``nearest``: how far away the nearest
    equilibrium is; ``proofs``: how far the equilibrium is proved that the answer stands for. ``is_strong``: whether all members
    are as strong as wanted under the forces that were judged, ``None`` where no member has a strength.
    """

    def __init__(
        self, system: System, text: str, confirmed: bool, refuted: bool, page: str, said: str, is_strong: bool | None
    ) -> None:
        self.system = system
        self._said = said
        self.data: dict[str, Any] = json.loads(text)
        self.confirmed = confirmed
        self.refuted = refuted
        self._page = page
        self.is_strong = is_strong

    @property
    def finding(self) -> str:
        """The finding in a word: ``confirmed``, ``refuted``, ``far``, ``other_forces``, ``no_equilibrium``, ..."""
        return str(self.data["finding"])

    @property
    def says(self) -> str:
        """The finding in a sentence."""
        return str(self.data["says"])

    @property
    def broken(self) -> list[Record]:
        """What is broken: ``at``, ``law``, ``value``, ``allowed``, ``says``."""
        return [Record(violation) for violation in self.data["broken"]]

    @property
    def largest(self) -> float:
        """The largest violation in units of what the tolerance explains: 1 or less is none."""
        return float(self.data["largest"])

    @property
    def nearest(self) -> Record:
        """How far away the nearest equilibrium is."""
        return Record(self.data["nearest"])

    @property
    def proofs(self) -> Proofs:
        """The ladder of the answer."""
        return Proofs(self.data["ladder"])

    @property
    def weakest(self) -> Record | None:
        """The member that is nearest to breaking: ``bar``, from 1, ``utilisation``, ``safety`` and ``safety_wanted``; ``None`` where
        no member has a strength. ``data["bars"]`` has the ``utilisation`` of each."""
        return Record(self.data["weakest"]) if "weakest" in self.data else None

    @property
    def table(self) -> Table:
        """A row for each violation."""
        rows = self.data["broken"]
        return Table(
            {
                "at": [str(row["at"]) for row in rows],
                "says": [str(row["says"]) for row in rows],
                "value": np.array([row["value"] for row in rows], dtype=np.float64),
                "allowed": np.array([row["allowed"] for row in rows], dtype=np.float64),
            }
        )

    def html(self) -> str:
        """The judgement as a page that needs nothing else."""
        return self._page

    def __repr__(self) -> str:
        return f"<Judgement of {printable(self.system.name)!r}: {self.says}>"

    def _repr_html_(self) -> str:
        frame = "width: 100%; height: 34rem; border: 0"
        return f'<iframe sandbox="" style="{frame}" srcdoc="{escape(self._page)}"></iframe>'


def judge(
    system: Described,
    joints: Numbers | Mapping[Any, Vector] | Equilibrium,
    forces: Numbers | None = None,
    *,
    reactions: Mapping[Any, Vector] | None = None,
    tolerance: float | None = None,
    source: str = "an answer from elsewhere",
    threads: int = 0,
    progress: Progress = None,
) -> Judgement:
    """Hold any answer against the laws of statics, the third judge of this project, and against both solvers.

    Parameters
    ----------
    joints : (joints, 3) m in the order of the system, or {name: (3,) m}, or an answer with its forces
    forces : (members,) N, axial, tension positive, or one for each span of each member, ropes among them; without them those
        are taken that balance the places best
    reactions : {joint: (3,) N}, optional: forces of the ground, to be judged too
    tolerance : how well the answer is taken to know its numbers, of the size of the system and the largest force
        (1e-6; from 1e-13 to 0.1)

    Raises
    ------
    ShapeError, AnswerError, SettingError

    >>> import funicular as fn
    >>> s = fn.System(lengths=[5, 5], masses=[1, 1], end=(6, 0, 0))
    >>> fn.judge(s, [[0, 0, 0], [3, 0, -4], [6, 0, 0]]).confirmed      # by the triangle 3, 4, 5
    True
    >>> wrong = fn.judge(s, [[0, 0, 0], [3, 0, -4.001], [6, 0, 0]])
    >>> wrong.refuted, round(wrong.broken[0].value, 6)                 # bars 0.8 mm too long
    (True, 0.0008)

    A system with strengths is held against these, and one with load cases judged in each:

    >>> lamp = fn.System.from_toml('''gravity_m_s2 = 10
    ... joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, lamp = { mass_kg = 4 } }
    ... bars = [{ from = "A", to = "lamp", length_m = 5, mass_kg = 0, strength_n = 100, safety = 3 },
    ...         { from = "B", to = "lamp", length_m = 5, mass_kg = 0, strength_n = 200 }]
    ... loads = [{ name = "snow", joint = "lamp", mass_kg = 2 }]
    ... cases = [{ name = "winter", factors = { snow = 2 } }]''')
    >>> winter = fn.judge(lamp.in_case("winter"), {"A": (-3, 0, 0), "B": (3, 0, 0), "lamp": (0, 0, -4)}, [50, 50])
    >>> winter.confirmed, winter.is_strong, winter.weakest.bar, winter.weakest.safety
    (True, False, 1, 2.0)
    """
    system = described(system)
    if isinstance(joints, Equilibrium):
        places = joints.joints_m
        forces = joints.axial_n if forces is None else forces
    elif isinstance(joints, Mapping):
        names = system.joint_names
        given = {str(name): at for name, at in joints.items()}
        if set(given) != set(names):
            odd = sorted(set(given) ^ set(names))[:5]
            raise InputError(f"joints: one place for each joint of the system wanted; see {', '.join(map(repr, odd))}")
        places = np.array([vector(f"joints[{name!r}]", given[name]) for name in names])
    else:
        places = array("joints", joints, ("joints", 3))
    axial: Array | None = None if forces is None else array("forces", forces, ("members",))
    ground = None
    if reactions is not None:
        ground = [(str(name), vector(f"reactions[{name!r}]", force)) for name, force in reactions.items()]
    knows = None if tolerance is None else number("tolerance", tolerance)
    with shown(progress) as callback:
        found = _native.judge(
            system._problem, places, axial, ground, str(source), knows, whole("threads", threads), callback
        )
    return Judgement(system, *found)
