"""How much of the machine the package takes."""

from __future__ import annotations

from . import _native
from ._numbers import whole


def set_threads(threads: int) -> None:
    """How many threads share the work where nothing is said, 0 for one per processor. No answer depends on it."""
    _native.set_threads(whole("threads", threads))


def limit_work(numbers: int) -> None:
    """Hold every solve of this process to so much work, numbers in all factors of its matrices, which is iterations times size.

    What needs more ends without an answer; 10**10 where nothing is said.
    """
    _native.limit_work(whole("numbers", numbers, 1))
