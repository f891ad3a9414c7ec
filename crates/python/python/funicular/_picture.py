"""Drawings as texts and as files."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Union

from . import _native

File = Union[str, "PathLike[str]"]

FORMATS = ("svg", "png", "pdf")
"""Endings of the files."""


def ending(path: File) -> str:
    """What the name of a file ends in, behind the point."""
    return Path(path).suffix[1:].lower()


class Picture(str):
    """A drawing: the text of an SVG file, written as PNG, PDF and, for CAD, DXF too.

    >>> import funicular as fn
    >>> p = fn.System.case("lamp").solve().svg()
    >>> p.startswith("<svg"), p.png()[1:4], p.pdf()[:5]
    (True, b'PNG', b'%PDF-')
    """

    __slots__ = ()

    def png(self) -> bytes:
        """The bytes of a PNG file, two pixels to a side of each of the drawing's, on white."""
        return _native.draw(self, "png")

    def pdf(self) -> bytes:
        """The bytes of a PDF file of one page, 96 pixels of the drawing to an inch, with texts that can be searched."""
        return _native.draw(self, "pdf")

    def save(self, path: File) -> None:
        """Write a file: ``.svg``, ``.png``, ``.pdf``, or ``.dxf`` (flat, a unit a pixel; in space: :meth:`Equilibrium.save`)."""
        Path(path).write_bytes(_native.draw(self, ending(path)))

    def _repr_svg_(self) -> str:
        return str(self)
