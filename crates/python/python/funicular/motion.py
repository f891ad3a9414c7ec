"""Systems in motion: simulation, and small oscillations."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import Array, Numbers, Vector, array, number, vector, whole
from ._picture import File, ending
from ._progress import Progress, shown
from ._result import Result, printable
from .answer import Equilibrium
from .errors import SettingError
from .plot import plot_mode
from .system import Described, System, described
from .table import Table

MOST_BYTES = 16e9
"""Memory that the stored times of a motion may take."""

Start = Union[str, "npt.NDArray[Any]", list[Any]]

TIMES = ("time_s", "joints_m", "velocities_m_s", "reactions_n", "axial_n", "kinetic_j", "potential_j")

MOVING = ("time_s", "joints_m", "velocities_m_s", "axial_n", "reactions_n", "kinetic_j", "potential_j")
"""What files for ParaView have."""


class Motion(Result):
    """A motion at its stored times.

    ``time_s`` (t,) s; ``joints_m``, ``velocities_m_s``, ``reactions_n`` (t, joints, 3); ``axial_n`` (t, members) N,
    tension positive; ``kinetic_j``, ``potential_j``, ``energy_j`` (t,) J. ``laws_off`` and ``lengths_off`` (t,): what
    is left over in Newton's and Euler's laws and in the lengths, dimensionless.
    """

    time_s: Array
    joints_m: Array
    velocities_m_s: Array
    reactions_n: Array
    axial_n: Array
    kinetic_j: Array
    potential_j: Array
    laws_off: Array
    lengths_off: Array

    def __init__(self, system: System, arrays: dict[str, Any], page: str) -> None:
        self.system = system
        self._page = page
        for name in (*TIMES, "laws_off", "lengths_off"):
            setattr(self, name, arrays[name])

    def _content(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in (*TIMES, "energy_j", "laws_off", "lengths_off")}

    @property
    def energy_j(self) -> Array:
        """(t,) Mechanical energy, J."""
        found: Array = self.kinetic_j + self.potential_j
        return found

    @property
    def table(self) -> Table:
        """A row for each time: energies, and the places of all joints."""
        columns: dict[str, Any] = {name: getattr(self, name) for name in ("time_s", "kinetic_j", "potential_j")}
        for k, joint in enumerate(self.system.joint_names):
            columns |= {f"{joint}_{axis}_m": self.joints_m[:, k, i] for i, axis in enumerate("xyz")}
        return Table(columns)

    def html(self) -> str:
        """The page of a system with this motion alone; it needs nothing else. See :func:`funicular.page`."""
        return self._page

    def save(self, path: File) -> None:
        """Write a file: ``.html``, the animation; or ``x.pvd`` for ParaView, with a grid of each stored time in the folder ``x``
        beside it, which must be new or empty: forces and velocities as fields, and the energies of the time."""
        if ending(path) == "html":
            Path(path).write_text(self._page, encoding="utf-8", newline="\n")
        elif ending(path) == "pvd":
            arrays = (getattr(self, name) for name in MOVING)
            _native.save_motion(self.system._problem, path, *map(np.ascontiguousarray, arrays))
        else:
            raise SettingError(f"path: its name must end in .pvd or .html, got {str(path)!r:.80}", setting="path", value=str(path))

    def __repr__(self) -> str:
        return f"<Motion of {printable(self.system.name)!r}: {self.time_s[-1]:g} s, {len(self.time_s)} stored times>"

    def _repr_html_(self) -> str:
        frame = "width: 100%; height: 34rem; border: 0"
        return f'<iframe sandbox="allow-scripts" style="{frame}" srcdoc="{escape(self._page)}"></iframe>'


def simulate(
    system: Described,
    *,
    near: Numbers | Equilibrium | None = None,
    start: Start = "rest",
    time: float = 10.0,
    step: float = 1e-3,
    store: float | None = None,
    order: int = 2,
    damping: float = 0.0,
    friction: float = 0.0,
    pushes: Mapping[Any, Vector] | None = None,
    forces: Mapping[Any, Any] | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Motion:
    """Set a system in motion, and follow it with rigid bars (RATTLE).

    Parameters
    ----------
    near : (joints, 3) m, optional: a shape, next to whose equilibrium ``rest`` is: see :meth:`System.near`
    start : ``rest`` (the stable equilibrium), ``equilibrium:2``, ``angles=0,60,-60`` (members from the descending
        vertical, degrees), ``seed:7`` (at random), or (joints, 3) places, m
    time, step, store : s; ``store`` is the time between stored times, a thousandth of the whole if not given
    order : 2, 4 or 8 in the step; 4 takes five times the work, 8 seventeen times
    damping : of a medium, 1/s, momentum falls at this rate; friction : N m s, in the joints
    pushes : {joint: (3,) N s}, impulses at the beginning
    forces : {joint: (k, 4)}, forces over time, a row ``time_s, x_n, y_n, z_n`` for each of rising times: linear
        between them, zero before the first and after the last

    Raises
    ------
    MotionError, SettingError, and the errors of :func:`solve`

    >>> import funicular as fn
    >>> m = fn.System.case("three-equal-bars").simulate(start="angles=0,60,-60", time=2)
    >>> m.joints_m.shape
    (1001, 4, 3)
    >>> bool(abs(m.energy_j - m.energy_j[0]).max() < 1e-4)    # kept to the order of the step squared
    True

    A weight on a level line, drawn along it by 3 N for 2 s, moves at 6 m/s:

    >>> s = fn.System.from_toml('''
    ... joints = { S = { at_m = [0, 0, 0], free = "x", mass_kg = 1 }, P = { mass_kg = 1e-6 } }
    ... bars = [{ from = "S", to = "P", length_m = 1, mass_kg = 0 }]
    ... ''')
    >>> draw = {"S": [[0, 3, 0, 0], [2, 3, 0, 0]]}
    >>> m = s.simulate(start=[[0, 0, 0], [0, 0, -1]], time=2, order=4, forces=draw)
    >>> bool(abs(m.velocities_m_s[-1, 0, 0] - 6) < 1e-3)
    True
    """
    system = described(system)
    system = system._asked(near)
    word, joints = (start, None) if isinstance(start, str) else ("rest", array("start", start, ("joints", 3)))
    impulses = [(str(joint), vector(f"pushes[{joint!r}]", push)) for joint, push in (pushes or {}).items()]
    _affordable(system, number("time", time), number("step", step), store)
    with shown(progress) as callback:
        found = _native.simulate(
            system._problem,
            word,
            joints,
            number("time", time),
            number("step", step),
            None if store is None else number("store", store),
            whole("order", order),
            number("damping", damping),
            number("friction", friction),
            impulses,
            _force_table(forces),
            whole("threads", threads),
            callback,
        )
    return Motion(system, *found)


def _force_table(forces: Mapping[Any, Any] | None) -> str | None:
    """Forces over time as the table that the program reads."""
    if not forces:
        return None
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["time_s", "joint", "x_n", "y_n", "z_n"])
    for joint, points in forces.items():
        for time_s, *force_n in array(f"forces[{joint!r}]", points, ("times", 4)).tolist():
            rows.writerow([repr(time_s), str(joint), *map(repr, force_n)])
    return text.getvalue()


def _affordable(system: System, time: float, step: float, store: float | None) -> None:
    """Refuse more stored times than memory has room for."""
    kept = step if store is None else max(step, number("store", store))
    if store is None or not (time > 0.0 and kept > 0.0):
        return
    numbers = 9 * len(system.joint_names) + len(system.member_joints) + len(TIMES)
    wanted = time / kept * numbers * np.dtype(np.float64).itemsize
    if not wanted <= MOST_BYTES:
        message = f"the stored times would take {wanted / 1e9:.3g} GB: store fewer (store = {kept:g} s now)"
        raise SettingError(message, setting="store", value=kept)


class Modes(Result):
    """Small oscillations about all equilibria of a chain where a census is complete, else about the stable one.

    ``equilibria``: for each its ``label``, ``energy_j``, ``joints_m`` and :class:`ModesOf`.

    >>> import funicular as fn
    >>> m = fn.System.from_toml('''
    ... anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }
    ... bars = [{ length_m = 1, mass_kg = 1, count = 2 }]
    ... ''').modes()
    >>> told = 2 * 9.80665 * (3**0.5 / 4) / 0.5      # a plate that swings about its upper edge: M g h / J
    >>> abs(float(m[0].omega2_s2[0]) - told) < 1e-9, m.complete
    (True, True)
    """

    def __init__(self, system: System, text: str, said: str) -> None:
        self.system = system
        self._said = said
        self.data: dict[str, Any] = json.loads(text)
        self.equilibria = [ModesOf(found) for found in self.data["equilibria"]]

    @property
    def complete(self) -> bool:
        """Whether a census proves that there are no other equilibria."""
        return bool(self.data["complete"])

    def plot(self, mode: int = 0, equilibrium: int = 0, ax: Any = None) -> Any:
        """Draw a mode of an equilibrium, both numbered from 0, into axes of matplotlib, which must be installed."""
        return plot_mode(self, mode, equilibrium, ax)

    def __len__(self) -> int:
        return len(self.equilibria)

    def __getitem__(self, k: int) -> ModesOf:
        return self.equilibria[k]

    def __repr__(self) -> str:
        return f"<Modes of {printable(self.system.name)!r}: {len(self)} equilibria>"


class ModesOf(Result):
    """The modes of one equilibrium, by ascending ω², zero and negative ones included.

    ``omega2_s2`` (modes,) 1/s²; ``frequencies_hz`` (modes,) Hz, NaN where it does not oscillate; ``shapes`` (modes,
    joints, 3), the largest displacement 1; ``what`` each mode is, in words; ``joints_m`` (joints, 3) m.
    ``omega2_between_s2`` (modes, 2) 1/s²: each ω² is proved to lie between these, NaN where ``data["enclosed"]`` says
    that it is not.
    """

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.label: str = data["label"]
        self.energy_j: float = data["energy_j"]
        self.joints_m: Array = np.array([joint["at_m"] for joint in data["joints"]], dtype=np.float64)
        modes = data["modes"]
        self.omega2_s2: Array = np.array([mode["omega2_s2"] for mode in modes], dtype=np.float64)
        ends = [mode.get("omega2_between_s2", [np.nan, np.nan]) for mode in modes]
        self.omega2_between_s2: Array = np.array(ends, dtype=np.float64).reshape(len(modes), 2)
        shapes = np.array([mode["shape"] for mode in modes], dtype=np.float64)
        self.shapes: Array = shapes.reshape(len(modes), len(self.joints_m), 3)
        self.what: list[str] = [mode["what"] for mode in modes]
        self.frequencies_hz: Array = np.array([mode.get("frequency_hz", np.nan) for mode in modes], dtype=np.float64)
        self.rates_1_s: Array = np.array([mode.get("rate_1_s", np.nan) for mode in modes], dtype=np.float64)

    def __repr__(self) -> str:
        return f"<ModesOf {printable(self.label)!r}: {len(self.omega2_s2)} modes>"

    @property
    def table(self) -> Table:
        """A row for each mode."""
        return Table({"omega2_s2": self.omega2_s2, "frequency_hz": self.frequencies_hz, "what": self.what})


def modes(
    system: Described,
    *,
    near: Numbers | Equilibrium | None = None,
    max_bars: int | None = None,
    lowest: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Modes:
    """Small oscillations. Raises MotionError.

    ``near``: (joints, 3) m, a shape, about whose equilibrium they are: see :meth:`System.near`. ``max_bars``: take a census of chains of up to so many (8). ``lowest``: find so many modes of each equilibrium; if
    not given all of systems of up to 100 joints, and 20 of larger ones.

    >>> import funicular as fn
    >>> rope = fn.System.from_toml('''
    ... anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }
    ... bars = [{ length_m = 0.01, mass_kg = 0.01, count = 200 }]
    ... ''')
    >>> len(rope.modes(lowest=30)[0].omega2_s2)
    30
    """
    system = described(system)._asked(near)
    bars = None if max_bars is None else whole("max_bars", max_bars)
    count = None if lowest is None else whole("lowest", lowest)
    with shown(progress) as callback:
        return Modes(system, *_native.modes(system._problem, bars, count, whole("threads", threads), callback))
