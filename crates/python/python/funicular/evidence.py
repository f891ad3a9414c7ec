"""The evidence ladder: how far an equilibrium is proved.

Five rungs, lowest first: ``converged``, ``agreed``, ``verified``, ``complete``, ``optimal``. Each is reached with the
numbers of its proof, or open with its reason.

>>> import funicular as fn
>>> a = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(0, 0, -2))
>>> a.rung
'optimal'
>>> a.proofs.verified.reached, a.proofs.verified.width < 1e-12
(True, True)
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ._result import Result

RUNGS = ("converged", "agreed", "verified", "complete", "optimal")
"""The rungs, lowest first."""


class Record(Result):
    """The numbers of one object of JSON as attributes; ``data`` is the object itself."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data

    def __getattr__(self, name: str) -> Any:
        # A copy that is being made has no data yet.
        data = self.__dict__.get("data", {})
        if name in data:
            return _record(data[name])
        raise AttributeError(f"there is no {name!r}; there are {', '.join(data)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.data]

    def __repr__(self) -> str:
        return f"Record({self.data!r})"


def _record(value: Any) -> Any:
    return Record(value) if isinstance(value, dict) else value


class Proof(Result):
    """One rung.

    ``reached``: whether it was reached; ``how``: how, or why not, in a sentence. The numbers of the proof, or of the
    reason, are attributes too; ``width`` of ``verified`` is the largest relative width of the box.
    """

    def __init__(self, entry: dict[str, Any]) -> None:
        self.rung: str = entry["rung"]
        self.reached: bool = entry["reached"]
        self.how: str = entry["how"]
        self.data: dict[str, Any] = entry.get("proof") or {}
        reason = entry.get("reason")
        self.reason: dict[str, Any] | None = {"kind": reason} if isinstance(reason, str) else reason

    def __getattr__(self, name: str) -> Any:
        # A copy that is being made has nothing yet.
        numbers = {**(self.__dict__.get("reason") or {}), **self.__dict__.get("data", {})}
        if name == "width" and (self.__dict__.get("rung") == "verified" or "box_width" in numbers):
            return numbers.get("box_width")
        if name in numbers:
            return _record(numbers[name])
        rung, known = self.__dict__.get("rung", "a rung"), ", ".join(numbers)
        raise AttributeError(f"{rung} has no {name!r}; it has {known or 'no numbers'}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.data]

    def _content(self) -> dict[str, Any]:
        head = {"rung": self.rung, "reached": self.reached, "how": self.how}
        return {**head, "proof": self.data, "reason": self.reason}

    def __bool__(self) -> bool:
        return self.reached

    def __repr__(self) -> str:
        return f"{'+' if self.reached else '-'} {self.rung}: {self.how}"


class Proofs(Result):
    """The five rungs by name, in their order."""

    converged: Proof
    agreed: Proof
    verified: Proof
    complete: Proof
    optimal: Proof

    def __init__(self, ladder: list[dict[str, Any]]) -> None:
        self._ladder = ladder
        self._all = [Proof(entry) for entry in ladder]
        for proof in self._all:
            setattr(self, proof.rung, proof)

    def _content(self) -> dict[str, Any]:
        return {entry["rung"]: entry for entry in self._ladder}

    def __iter__(self) -> Iterator[Proof]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    @property
    def highest(self) -> str | None:
        """The highest rung reached, or ``None``."""
        reached = [proof.rung for proof in self._all if proof.reached]
        return reached[-1] if reached else None

    def __repr__(self) -> str:
        return "\n".join(map(repr, self._all))


class Evidence(Result):
    """What a solver says of its answer, and the ladder.

    ``residual`` of ``residual_of`` (dimensionless), ``iterations``, ``nullity`` and ``condition`` of the solver's own
    system, ``solve_s`` the solver's own time in seconds, ``proofs`` the ladder.
    """

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.residual: float = data["residual"]
        self.residual_of: str = data["residual_of"]
        self.iterations: int = data["iterations"]
        self.nullity: int = data["nullity"]
        self.condition: float = data["condition"]
        self.solve_s: float = data["solve_s"]
        self.rung: str | None = data["rung"]
        self.proofs = Proofs(data["ladder"])

    def __repr__(self) -> str:
        return f"Evidence(rung={self.rung!r}, residual={self.residual:.1e}, iterations={self.iterations})"
