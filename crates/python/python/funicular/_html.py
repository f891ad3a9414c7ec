"""What a notebook shows."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from .errors import Error

if TYPE_CHECKING:
    from .answer import Equilibrium

WIDTH = "max-width: 42rem"


def picture(equilibrium: Equilibrium) -> str:
    """The drawing to scale, or why there is none."""
    try:
        svg = equilibrium.svg()
    except Error as error:
        return f"<p>No picture: {escape(str(error))}.</p>"
    begin = max(svg.find("<svg"), 0)
    return f'<div style="{WIDTH}; background: white">{svg[begin:]}</div>'


def ladder(equilibrium: Equilibrium) -> str:
    """The rungs as a table."""
    rows = []
    for proof in equilibrium.proofs:
        mark = "&#10003;" if proof.reached else "&ndash;"
        cells = f"<td>{mark}</td><th>{proof.rung}</th><td style='text-align: left'>{escape(proof.how)}</td>"
        rows.append(f"<tr>{cells}</tr>")
    return f"<table>{''.join(rows)}</table>"


def page(equilibrium: Equilibrium) -> str:
    """Name, picture and ladder."""
    stable = equilibrium.stability.in_space
    head = f"<b>{escape(equilibrium.system.name)}</b>: {equilibrium.energy_j:.9g} J, {stable}, {equilibrium.solver}"
    return f"<p>{head}</p>{picture(equilibrium)}{ladder(equilibrium)}"
