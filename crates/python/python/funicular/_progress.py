"""Progress of long work: a function of one's own, or a bar of tqdm where that is installed."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Union

from .errors import SettingError

Callback = Callable[[str, int, int], None]
"""Called with what is done, how much of it, and of how much in all (0: not known)."""

Progress = Union[Callback, bool, None]


@contextmanager
def shown(progress: Progress) -> Iterator[Callback | None]:
    """The function to be called, for as long as the work lasts."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        with _Bar() as bar:
            yield bar.show
    elif callable(progress):
        yield progress
    else:
        message = f"progress: True, or a function of (what, done, total), wanted, got {progress!r:.80}"
        raise SettingError(message, setting="progress", value=progress)


class _Bar:
    """A bar of tqdm, or where that is not installed a line on standard error now and then."""

    PAUSE_S = 2.0

    def __init__(self) -> None:
        self._bar: Any = None
        self._last = time.monotonic()
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._tqdm = None
        else:
            self._tqdm = tqdm

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def show(self, what: str, done: int, total: int) -> None:
        if self._tqdm is None:
            now = time.monotonic()
            if now - self._last >= self.PAUSE_S:
                self._last = now
                of = f"{done} of {total} " if total else ""
                print(f"{of}{what}", file=sys.stderr, flush=True)
            return
        if self._bar is None:
            self._bar = self._tqdm(total=total or None, unit="", desc=what, leave=False)
        self._bar.total = total or None
        self._bar.set_description(what, refresh=False)
        self._bar.n = done
        self._bar.refresh()
