"""What every result can do besides: become dictionaries, JSON and text."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np


class Result:
    """Written as the program writes it: ``print(result)``, ``to_dict()``, ``to_json()``."""

    _said: str = ""

    def _content(self) -> dict[str, Any]:
        data: dict[str, Any] = getattr(self, "data", {})
        return dict(data)

    def to_dict(self) -> dict[str, Any]:
        """All of it as dictionaries, lists, texts and numbers, with units in the names; ``None`` where there is no number."""
        found: dict[str, Any] = plain(self._content(), finite=True)
        return found

    def to_json(self, indent: int | None = None) -> str:
        """The same as a text of JSON."""
        return json.dumps(self.to_dict(), indent=indent, allow_nan=False)

    def __str__(self) -> str:
        return self._said or repr(self)


def plain(value: Any, finite: bool = False) -> Any:
    """What JSON has; with ``finite`` ``None`` in the place of NaN and infinity."""
    if isinstance(value, Result):
        return plain(value._content(), finite)
    if isinstance(value, Mapping):
        return {str(key): plain(entry, finite) for key, entry in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist(), finite)
    if isinstance(value, np.generic):
        return plain(value.item(), finite)
    if isinstance(value, (list, tuple)):
        return [plain(entry, finite) for entry in value]
    if finite and isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def printable(text: str) -> str:
    """The text without what could steer a terminal or turn its direction round."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
