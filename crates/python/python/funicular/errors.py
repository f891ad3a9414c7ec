"""Errors, with the numbers they rest on as attributes.

Every error of the package is an :class:`Error`. What is wrong with the data given is an :class:`InputError`, which is
a ``ValueError``; a system that has no equilibrium problem is :class:`Refused`, also a ``ValueError``; a problem that no
solver could answer is :class:`Unsolved`.

>>> import funicular as fn
>>> try:
...     fn.solve(lengths=[1, 1], masses=[1, 1], end=(3, 0, 0))
... except fn.OutOfReach as error:
...     print(error.span_m, error.total_length_m, error.missing_m)
3.0 2.0 1.0
"""

from __future__ import annotations

from typing import Any

__all__ = [
    "AnswerError",
    "BarError",
    "BarTooLong",
    "ChainsOnly",
    "ClusterError",
    "Error",
    "Falls",
    "FileError",
    "Folded",
    "InputError",
    "InternalError",
    "LoadOnAnchors",
    "MotionError",
    "NoCensus",
    "NoLoad",
    "NothingMoves",
    "OutOfReach",
    "ParameterError",
    "Refused",
    "SettingError",
    "ShapeError",
    "StoreError",
    "SweepError",
    "SystemError",
    "Taut",
    "TraceError",
    "DerivativesError",
    "Unconnected",
    "UnknownCase",
    "Unresolved",
    "Unsolved",
]


class Error(Exception):
    """Whatever goes wrong in this package.

    Numbers stand as attributes under the names of the errors' documentation; ``details`` has all of them. An
    attribute that an error of this class may have, and this one has not, is ``None``. ``help`` says what is allowed,
    what is near to what was given, or what to do about it.
    """

    help: str
    details: dict[str, Any]

    def __init__(self, message: str, **details: Any) -> None:
        super().__init__(message)
        self.details = details

    def __getattr__(self, name: str) -> Any:
        details = self.__dict__.get("details", {})
        if name in details:
            return details[name]
        if any(name in getattr(cls, "__annotations__", {}) for cls in type(self).__mro__):
            return None
        raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.details]

    def __str__(self) -> str:
        message = str(self.args[0]) if self.args else ""
        details = self.__dict__.get("details", {})
        helps = details.get("help")
        return f"{message}\nhelp: {helps}" if helps else message

    def __reduce__(self) -> Any:
        return _make, (type(self).__name__, self.args[0] if self.args else "", self.details)


class InternalError(Error, RuntimeError):
    """A bug of this package: please report it."""


class InputError(Error, ValueError):
    """The data given are out of range or do not fit together."""


class ShapeError(InputError):
    """An array has the wrong shape, or holds what is no number."""

    argument: str
    expected: str
    found: str


class SettingError(InputError):
    """A setting is out of range or none of the words allowed."""

    setting: str
    value: Any
    allowed: list[str]


class BarError(InputError):
    """A number of a bar is out of range."""

    length_m: float
    mass_kg: float
    centre_m: float
    moment_kg_m2: float


class SystemError(InputError):
    """A number of a system is out of range, a total overflows or vanishes, or a member names a joint that is not there."""

    name: str
    joint: int
    joints: int
    member: int
    mass_kg: float
    coordinate_m: float
    component_n: float
    gravity_m_s2: float
    quantity: str
    total: float


class FileError(InputError):
    """A system file, text or dictionary cannot be read or used, or a file of another program.

    ``line`` and ``column`` count from 1; of a dictionary they are those of its JSON, and ``key`` says more.
    """

    file: str
    line: int
    column: int
    key: str


class UnknownCase(InputError):
    """There is no case of this name; ``suggestion`` is the name that is nearest, if one is near."""

    name: str
    suggestion: str


class ChainsOnly(InputError):
    """What was asked for is possible for chains between two anchors alone."""

    what: str


class AnswerError(InputError):
    """An answer from elsewhere does not fit the system."""

    of: str
    wanted: int
    found: int
    what: str
    name: str


class ParameterError(InputError):
    """A parameter of a trace is written wrongly, or does not fit the chain."""

    text: str
    column: int


class Refused(Error, ValueError):
    """The system is no equilibrium problem."""


class OutOfReach(Refused):
    """Anchors are further apart (``span_m``) than what lies between them reaches (``total_length_m``)."""

    span_m: float
    total_length_m: float
    missing_m: float
    from_joint: str
    to_joint: str


class Taut(Refused):
    """Bars reach from anchor to anchor and no further: straight, and the force along them is indeterminate."""

    span_m: float
    total_length_m: float
    from_joint: str
    to_joint: str


class BarTooLong(Refused):
    """A bar is longer than the rest of a loop through it (``way``, names of joints): the loop cannot close."""

    bar: int
    length_m: float
    rest_m: float
    from_joint: str
    to_joint: str
    way: list[str]


class Folded(Refused):
    """A bar is just as long as the rest of a loop through it: it closes on one line only."""

    bar: int
    length_m: float
    from_joint: str
    to_joint: str
    way: list[str]


class Unresolved(Refused):
    """The coordinates of the anchors are so large that their rounding decides."""

    coordinate_m: float
    rounding_m: float
    margin_m: float


class NoLoad(Refused):
    """Nothing has weight and no force acts, or all loads cancel where they act: every position is an equilibrium."""


class LoadOnAnchors(Refused):
    """All loads rest on the supports: every position is an equilibrium."""


class Unconnected(Refused):
    """No member meets a joint."""

    name: str
    joint: int


class Falls(Refused):
    """Nothing holds a part of the system."""

    name: str
    joint: int
    joints: int


class NothingMoves(Refused):
    """Every joint is an anchor."""


class Unsolved(Error, ArithmeticError):
    """No solver that was asked has an answer.

    ``failures`` has a dictionary for each: ``solver``, ``reason`` in words, ``refusal`` with the numbers.
    """

    failures: list[dict[str, Any]]


class NoCensus(Error):
    """No census can be taken; ``reason`` has the numbers."""

    reason: Any


class TraceError(Error):
    """No equilibrium can be followed."""


class DerivativesError(InputError):
    """What is asked for is no number of the equilibrium, or no parameter that has derivatives."""

    text: str


class SweepError(Error):
    """A sweep cannot be prepared."""


class StoreError(Error, OSError):
    """The folder of a sweep cannot be read or written, or holds something else.

    ``may_pass`` is 1 where a disk is full or another process writes: the same call may succeed later.
    """

    may_pass: int


class MotionError(Error):
    """A system cannot be set in motion, or a step cannot be taken."""


class ClusterError(Error):
    """A part of the work on a cluster could not be finished, whoever was asked to."""


def _make(name: str, message: str, details: dict[str, Any]) -> Error:
    """The error of this class name."""
    found = globals().get(name, Error)
    cls: type[Error] = found if isinstance(found, type) and issubclass(found, Error) else Error
    return cls(message, **details)
