"""One interpreter of a process holds the package: numpy and the native half are loaded once."""

from __future__ import annotations

from importlib import import_module


def refuse_others() -> None:
    """Raise ImportError in any interpreter but the main one."""
    for name in ("_interpreters", "_xxsubinterpreters"):
        try:
            interpreters = import_module(name)
        except ImportError:
            continue
        # Some versions give a number, some a pair that begins with it.
        if interpreters.get_current() != interpreters.get_main():
            raise ImportError("funicular works in the main interpreter of a process alone, not in a subinterpreter")
        return
