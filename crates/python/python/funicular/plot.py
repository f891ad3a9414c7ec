"""Pictures by matplotlib, where that is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error

if TYPE_CHECKING:
    from .answer import Equilibrium

FLAT = 1e-9
"""A system is drawn in its plane if it is flatter than this part of its size."""

# Blue and orange of Okabe and Ito (2008): told apart by everyone.
PULLS, PUSHES, NOTHING = "#0072b2", "#d55e00", "#999999"


def plot(equilibrium: Equilibrium, ax: Any = None, *, space: bool | None = None, forces: bool = True) -> Any:
    """Draw an equilibrium into axes of matplotlib (new ones if none are given), and return them.

    ``space``: in three dimensions; if not said, where the joints lie in no vertical plane. ``forces``: members in the
    colour and width of their axial force (blue pulls, orange pushes), reactions as arrows.
    """
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise Error("plot() needs matplotlib: pip install matplotlib; svg() needs nothing") from error
    joints = equilibrium.joints_m
    level = _level(joints)
    across = joints[:, :2] - joints[0, :2]
    off = np.abs(across @ np.array([-level[1], level[0]])).max(initial=0.0)
    if space is None:
        space = bool(off > FLAT * np.ptp(joints, axis=0).max())
    if ax is None:
        figure = pyplot.figure()
        ax = figure.add_subplot(projection="3d") if space else figure.add_subplot()
    places = joints if space else np.column_stack([across @ level, joints[:, 2]])
    largest = float(np.abs(equilibrium.axial_max_n).max(initial=0.0)) or 1.0
    for (a, b), axial in zip(equilibrium.system.member_joints, equilibrium.axial_max_n):
        line = places[[a, b]].T
        if not forces:
            ax.plot(*line, color="black", linewidth=1.5)
            continue
        color = PULLS if axial > 0 else PUSHES if axial < 0 else NOTHING
        ax.plot(*line, color=color, linewidth=1.0 + 3.0 * abs(axial) / largest, solid_capstyle="round")
    ax.plot(*places.T, linestyle="", marker="o", markersize=3, color="black")
    if forces:
        _reactions(ax, equilibrium, places, level, space)
    if space:
        ax.set(xlabel="x / m", ylabel="y / m", zlabel="z / m")
    else:
        ax.set(xlabel="level / m", ylabel="z / m")
    ax.set_aspect("equal")
    ax.set_title(equilibrium.system.name.replace("$", r"\$"))
    return ax


def _level(joints: Any) -> Any:
    """The level direction in which the system is widest."""
    across = joints[:, :2] - joints[:, :2].mean(axis=0)
    if not np.abs(across).max(initial=0.0) > 0.0:
        return np.array([1.0, 0.0])
    direction = np.linalg.svd(across, full_matrices=False)[2][0]
    return direction if direction[np.abs(direction).argmax()] > 0 else -direction


def _reactions(ax: Any, equilibrium: Equilibrium, places: Any, level: Any, space: bool) -> None:
    """Forces of the ground as arrows, the longest a quarter of the size of the system."""
    forces = equilibrium.reactions_n
    sizes = np.linalg.norm(forces, axis=1)
    held = sizes > 0.0
    if not held.any():
        return
    scale = 0.25 * float(np.ptp(equilibrium.joints_m, axis=0).max()) / float(sizes.max())
    if space:
        ax.quiver(*places[held].T, *(scale * forces[held]).T, color="black", linewidth=1)
        return
    flat = scale * np.column_stack([forces[held][:, :2] @ level, forces[held][:, 2]])
    units = {"angles": "xy", "scale_units": "xy", "scale": 1.0}
    ax.quiver(*places[held].T, *flat.T, color="black", width=0.004, **units)
