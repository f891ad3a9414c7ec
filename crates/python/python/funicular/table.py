"""Tables of results: columns with units in their names, for pandas, Arrow, polars, DuckDB and others."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import MOST_WIDTH
from ._result import Result, printable
from .errors import ShapeError

if TYPE_CHECKING:
    import pandas

Column = Union["npt.NDArray[np.float64]", "npt.NDArray[np.int64]", "list[str]"]

SHOWN = 20
"""Rows that a notebook shows."""


class Table(dict[str, Column], Result):
    """Columns of equal length by their names: one-dimensional arrays of doubles or integers, or lists of texts.

    Whatever reads the Arrow PyCapsule interface reads a table: ``pyarrow.table(t)``, ``polars.DataFrame(t)``,
    ``duckdb.sql("from t")``. ``to_pandas()`` makes a data frame.

    >>> import funicular as fn
    >>> a = fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0))
    >>> a.joints
    joint  x_m  y_m        z_m  reaction_x_n  reaction_y_n  reaction_z_n
    0        0    0          0      -2.83094             0       9.80665
    1      0.5    0  -0.866025             0             0             0
    2        1    0          0       2.83094             0       9.80665
    >>> a.joints["z_m"].round(4).tolist()
    [0.0, -0.866, 0.0]
    """

    def __init__(self, columns: Mapping[str, Any]) -> None:
        super().__init__({name: _column(values) for name, values in columns.items()})

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self.values()), []))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The table as an Arrow stream of one batch (a requested schema is not met, as the interface allows)."""
        return _native.arrow_stream(list(self), list(self.values()))

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame of pandas, which must be installed."""
        import pandas

        frame: pandas.DataFrame = pandas.DataFrame(self)
        return frame

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mapping) or list(self) != list(other):
            return False
        return all(np.array_equal(self[name], other[name], equal_nan=not isinstance(self[name], list)) for name in self)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        count = min(self.rows, SHOWN)
        columns = []
        for name, column in self.items():
            cells = [printable(name), *(printable(_shown(column[k])) for k in range(count))]
            width = max(map(len, cells))
            text = isinstance(column, list)
            columns.append([cell.ljust(width) if text else cell.rjust(width) for cell in cells])
        lines = ["  ".join(cells).rstrip() for cells in zip(*columns)]
        more = [f"({count} of {self.rows} rows)"] if self.rows > count else []
        return "\n".join(lines + more)

    def _content(self) -> dict[str, Any]:
        return dict(self)

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{escape(name)}</th>" for name in self)
        lines = []
        for k in range(min(self.rows, SHOWN)):
            cells = (_shown(column[k]) for column in self.values())
            lines.append("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>")
        more = f"<p>{self.rows} rows</p>" if self.rows > SHOWN else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>{more}"


def _shown(value: Any) -> str:
    # Without the sign of a zero.
    return f"{value + 0.0:.6g}" if isinstance(value, (float, np.floating)) else str(value)


def _column(values: Any) -> Column:
    if isinstance(values, np.ndarray):
        if values.ndim != 1 or values.dtype.kind not in "fiub" or values.dtype.itemsize > MOST_WIDTH:
            found = f"an array of {values.dtype} of shape {values.shape}"
            raise ShapeError(f"a column is one list of numbers or texts, got {found}", argument="columns", found=found)
        if values.dtype.kind == "f":
            return np.require(values, np.float64, ["C", "A"])
        return np.require(values, np.int64, ["C", "A"])
    listed: Sequence[Any] = list(values)
    if all(isinstance(value, str) for value in listed):
        return [str(value) for value in listed]
    try:
        found_array = np.asarray(listed)
    except ValueError as error:
        raise ShapeError("a column is one list of numbers or texts", argument="columns") from error
    return _column(found_array)


def vectors(prefix: str, unit: str, values: npt.NDArray[np.float64]) -> dict[str, npt.NDArray[np.float64]]:
    """Three columns of an array of shape (n, 3)."""
    return {f"{prefix}{axis}{unit}": values[:, k] for k, axis in enumerate("xyz")}


def read_csv(text: str, counts: Sequence[str] = (), texts: Sequence[str] = ()) -> Table:
    """A table of our own CSV: whole numbers in the columns of ``counts``, -1 where a cell is empty; ``true`` and ``false`` as 1 and
    0; ``texts`` as they are; all others as doubles, NaN where a cell is empty."""
    head, *lines = list(csv.reader(io.StringIO(text))) or [[]]
    columns: dict[str, Any] = {}
    for k, name in enumerate(head):
        cells = [line[k] for line in lines]
        if name in texts:
            columns[name] = cells
        elif name in counts:
            columns[name] = np.array([int(cell) if cell else -1 for cell in cells], dtype=np.int64)
        elif any(cell in ("true", "false") for cell in cells):
            columns[name] = np.array([cell == "true" for cell in cells], dtype=np.int64)
        else:
            columns[name] = np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)
    return Table(columns)
