"""Numbers and arrays as they come from outside, checked."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from .errors import SettingError, ShapeError

if TYPE_CHECKING:
    from typing_extensions import TypeAlias

Array: TypeAlias = "npt.NDArray[np.float64]"
Vector = Union[Sequence[float], "npt.NDArray[Any]"]
Numbers = Union[Sequence[Any], "npt.NDArray[Any]", float]

MOST_WIDTH = 8
"""Bytes of the widest numbers that a double can stand for: longer ones would lose digits silently."""


def array(argument: str, value: Any, shape: tuple[int | str, ...]) -> Array:
    """A contiguous array of doubles of this shape, whatever it was before; letters stand for any size."""
    if np.ma.is_masked(value):
        # What the mask hides would be taken for a number.
        raise _misshapen(argument, shape, "an array with masked entries")
    try:
        given = np.asarray(value)
    except Exception as error:
        raise _misshapen(argument, shape, "no rectangular array") from error
    if given.dtype.kind not in "iuf" or given.dtype.itemsize > MOST_WIDTH:
        what = "text" if given.dtype.kind in "SU" else f"numbers of the type {given.dtype}"
        raise _misshapen(argument, shape, what if shape else f"{value!r:.80}")
    # A number stays one: `ascontiguousarray` would make a list of it.
    found: Array = np.array(given, dtype=np.float64, order="C")
    fits = found.ndim == len(shape) and all(
        isinstance(wanted, str) or wanted == size for wanted, size in zip(shape, found.shape)
    )
    if not fits:
        raise _misshapen(argument, shape, f"an array of shape {found.shape}")
    return found


def _misshapen(argument: str, shape: tuple[int | str, ...], found: str) -> ShapeError:
    expected = "a real number" if not shape else f"real numbers of shape ({', '.join(map(str, shape))}{',' if len(shape) == 1 else ''})"
    message = f"{argument}: {expected} wanted, got {found}"
    return ShapeError(message, argument=argument, expected=expected, found=found)


def vector(argument: str, value: Any) -> tuple[float, float, float]:
    """Three numbers."""
    x, y, z = array(argument, value, (3,)).tolist()
    return x, y, z


def number(argument: str, value: Any) -> float:
    """One number."""
    return float(array(argument, value, ()))


def whole(argument: str, value: Any, least: int = 0) -> int:
    """A whole number that is not below the least."""
    if isinstance(value, (bool, np.bool_)):
        found = None
    elif isinstance(value, (int, np.integer)):
        found = int(value)
    elif isinstance(value, (float, np.floating)) and float(value).is_integer():
        found = int(value)
    else:
        found = None
    if found is None or not least <= found < 2**63:
        message = f"{argument}: a whole number from {least} wanted, got {value!r:.80}"
        raise SettingError(message, setting=argument, value=value)
    return found


def texts(argument: str, value: Any) -> list[str]:
    """A list of texts; one alone is a list of one."""
    found = [value] if isinstance(value, str) or not isinstance(value, Iterable) else list(value)
    for entry in found:
        if not isinstance(entry, str):
            raise ShapeError(f"{argument}: a text, or a list of texts, wanted, got {entry!r:.80}", argument=argument)
    return [str(entry) for entry in found]


def same_length(wanted: int, **others: Array | None) -> None:
    """Refuse arrays that are not as long as another."""
    for argument, other in others.items():
        if other is not None and len(other) != wanted:
            raise _misshapen(argument, (wanted, *other.shape[1:]), f"an array of shape {other.shape}")
