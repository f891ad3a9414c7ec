"""Where do bars that hang from their anchors come to rest, with which forces, and how sure can we be?

>>> import funicular as fn
>>> a = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(0, 0, -2))
>>> a.rung, round(a.energy_j, 6), a.reactions_n[0].round(6).tolist()
('optimal', -35.936776, [0.0, -6.363975, 22.682235])

Where a system comes to rest is found twice, by two solvers that share no mechanics; a third judge checks both from Newton's laws;
and every answer says how far it is proved. World frame, Z up, gravity along -Z, SI units in every name.

| to do | with |
|---|---|
| the hanging equilibrium | :func:`solve`, :meth:`System.solve` |
| many chains at a time; one structure with many numbers | :func:`solve_many`; :meth:`System.solve_many` |
| every equilibrium, with proof | :meth:`System.census` |
| the equilibrium over a parameter | :meth:`System.study` |
| the loss of each member | :func:`losses` |
| load cases and their envelope | :func:`load_cases` |
| a page to look at it; a widget to change it | :func:`page`; :func:`live` |
| pictures; files for ParaView, CAD, MuJoCo, MoorDyn, COMPAS | :meth:`Answer.save` |
| guaranteed ranges over tolerances | :func:`tolerances` |
| its derivatives | :func:`gradient`, :func:`change`, :func:`anchor_stiffness` |
| all equilibria over a parameter | :meth:`System.trace` |
| the same for scipy, JAX, PyTorch | :mod:`funicular.gradients` |
| which start leads where | :func:`sweep`, :func:`basins` |
| motion, small oscillations | :func:`simulate`, :meth:`System.modes` |
| somebody else's answer, judged | :func:`judge` |
| the paper, judged | :func:`reproduce` |
"""

from ._interpreter import refuse_others

refuse_others()

# Whatever loads numpy or the native half comes behind that.
from ._native import __version__, get_threads
from . import gradients
from .answer import Answer, Equilibrium, solve
from .basins import Basins, basins
from .batch import Batch, solve_many
from .census import Census, census
from .errors import *  # noqa: F403
from .errors import __all__ as _errors
from .evidence import Evidence, Proof, Proofs, Record
from .judge import Judgement, judge
from .live import live
from .motion import Modes, ModesOf, Motion, modes, simulate
from .reproduce import Reproduction, reproduce
from ._picture import Picture
from .rows import SystemBatch
from .study import Gradient, LoadCases, Losses, Study, Tolerances, anchor_stiffness, change, gradient
from .study import load_cases, losses, page, study, tolerances
from .sweep import Sweep, sweep
from .system import STANDARD_GRAVITY, System
from .table import Table
from .trace import Trace, trace
from .work import limit_work, set_threads


def cases() -> list[str]:
    """The names of the examples that :meth:`System.case` knows.

    >>> import funicular as fn
    >>> "three-equal-bars" in fn.cases()
    True
    """
    from ._native import Problem

    return Problem.cases()


__all__ = [
    "STANDARD_GRAVITY",
    "Answer",
    "Basins",
    "Batch",
    "Census",
    "Equilibrium",
    "Evidence",
    "Gradient",
    "Judgement",
    "LoadCases",
    "Losses",
    "Modes",
    "ModesOf",
    "Motion",
    "Picture",
    "Proof",
    "Proofs",
    "Record",
    "Reproduction",
    "Study",
    "Sweep",
    "System",
    "SystemBatch",
    "Table",
    "Tolerances",
    "Trace",
    "__version__",
    "anchor_stiffness",
    "basins",
    "cases",
    "census",
    "change",
    "get_threads",
    "gradient",
    "gradients",
    "judge",
    "limit_work",
    "live",
    "load_cases",
    "losses",
    "modes",
    "page",
    "reproduce",
    "set_threads",
    "simulate",
    "solve",
    "solve_many",
    "study",
    "sweep",
    "tolerances",
    "trace",
    *_errors,
]
