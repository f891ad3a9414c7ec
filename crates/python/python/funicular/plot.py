"""Pictures by matplotlib, where that is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error, InputError, SettingError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .answer import Equilibrium
    from .basins import Basins
    from .census import Census
    from .motion import Modes
    from .study import Study
    from .system import System
    from .trace import Trace

FLAT = 1e-9
"""A system is drawn in its plane if it is flatter than this part of its size."""

# Blue and orange of Okabe and Ito (2008): told apart by everyone.
PULLS, PUSHES, NOTHING = "#0072b2", "#d55e00", "#999999"


def _pyplot() -> Any:
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise Error("plot() needs matplotlib: pip install matplotlib; svg() needs nothing") from error
    return pyplot


def _axes(ax: Any) -> Any:
    """The axes given, or new ones."""
    return _pyplot().figure().add_subplot() if ax is None else ax


VIEWS = {"front": ("x", "z"), "side": ("y", "z"), "top": ("x", "y")}
"""The axes to the right and up that are seen from there."""


def plot(
    equilibrium: Equilibrium, ax: Any = None, *, space: bool | None = None, forces: bool = True, view: str = "best"
) -> Any:
    """Draw an equilibrium into axes of matplotlib (new ones if none are given), and return them.

    ``space``: in three dimensions; if not said, where the joints lie in no vertical plane. ``view``: from the
    ``front``, the ``side`` or the ``top``, along an axis. ``forces``: members in the colour and width of their axial
    force (blue pulls, orange pushes), reactions as arrows.
    """
    if view != "best" and view not in VIEWS:
        raise SettingError(f"view: best, {', '.join(VIEWS)} are allowed, not {view!r:.80}", setting="view", value=view)
    pyplot = _pyplot()
    joints = equilibrium.joints_m
    if view in VIEWS:
        space, seen = False, np.array([np.eye(3)["xyz".index(axis)] for axis in VIEWS[view]]).T
        (right, up), origin = VIEWS[view], np.zeros(3)
    else:
        level = np.append(_level(joints), 0.0)
        seen = np.column_stack([level, [0.0, 0.0, 1.0]])
        (right, up), origin = ("level", "z"), joints[0] * [1.0, 1.0, 0.0]
    if space is None:
        off = np.abs((joints - joints[0]) @ np.array([-level[1], level[0], 0.0])).max(initial=0.0)
        space = bool(off > FLAT * np.ptp(joints, axis=0).max())
    if ax is None:
        figure = pyplot.figure()
        ax = figure.add_subplot(projection="3d") if space else figure.add_subplot()
    places = joints if space else (joints - origin) @ seen
    largest = float(np.abs(equilibrium.axial_max_n).max(initial=0.0)) or 1.0
    for path, axial in zip(_paths(equilibrium.system), equilibrium.axial_max_n):
        line = places[path].T
        if not forces:
            ax.plot(*line, color="black", linewidth=1.5)
            continue
        color = PULLS if axial > 0 else PUSHES if axial < 0 else NOTHING
        ax.plot(*line, color=color, linewidth=1.0 + 3.0 * abs(axial) / largest, solid_capstyle="round")
    ax.plot(*places.T, linestyle="", marker="o", markersize=3, color="black")
    if forces:
        _reactions(ax, equilibrium, places, seen, space)
    if space:
        ax.set(xlabel="x / m", ylabel="y / m", zlabel="z / m")
    else:
        ax.set(xlabel=f"{right} / m", ylabel=f"{up} / m")
    ax.set_aspect("equal")
    ax.set_title(equilibrium.system.name.replace("$", r"\$"))
    return ax


def _paths(system: System) -> list[list[int]]:
    """The joints of each member, from its first to its last."""
    return [[a, *via, b] for (a, b), via in zip(system.member_joints, system.member_via)]


def _level(joints: Any) -> Any:
    """The level direction in which the system is widest."""
    across = joints[:, :2] - joints[:, :2].mean(axis=0)
    if not np.abs(across).max(initial=0.0) > 0.0:
        return np.array([1.0, 0.0])
    direction = np.linalg.svd(across, full_matrices=False)[2][0]
    return direction if direction[np.abs(direction).argmax()] > 0 else -direction


def _reactions(ax: Any, equilibrium: Equilibrium, places: Any, seen: Any, space: bool) -> None:
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
    flat = scale * forces[held] @ seen
    units = {"angles": "xy", "scale_units": "xy", "scale": 1.0}
    ax.quiver(*places[held].T, *flat.T, color="black", width=0.004, **units)


def plot_census(census: Census, most: int, view: str) -> Any:
    """The first equilibria side by side, each with its number and how many directions lead down from it."""
    shown = census.equilibria[:most]
    across = max(1, int(np.ceil(np.sqrt(len(shown)))))
    figure = _pyplot().figure(layout="constrained")
    for k, equilibrium in enumerate(shown):
        ax = plot(equilibrium, figure.add_subplot(-(-len(shown) // across), across, k + 1), space=False, view=view)
        label = equilibrium.data.get("label", k + 1)
        ax.set_title(f"{label}: {equilibrium.energy_j:.4g} J, index {equilibrium.stability.index_in_space}")
    return figure


def plot_study(study: Study, columns: Sequence[str], path: int) -> Any:
    """Columns over the last parameter, one below the other."""
    table, over = study.table, study.parameters[-1]
    missing = [name for name in columns if name not in table]
    if missing:
        raise InputError(f"there is no column {missing[0]!r:.80}; there are {', '.join(table)}")
    figure = _pyplot().figure(layout="constrained")
    on = np.asarray(table["path"]) == path
    for k, name in enumerate(columns):
        ax = figure.add_subplot(len(columns), 1, k + 1)
        ax.plot(np.asarray(table[over])[on], np.asarray(table[name])[on], color=PULLS)
        ax.set(xlabel=over, ylabel=name)
    return figure


def plot_trace(trace: Trace, ax: Any, path: int) -> Any:
    """Energies of all branches of a path, or a load path; what is stable in space in full, all else broken."""
    if trace.is_load_path:
        return _plot_load_path(trace, _axes(ax), path)
    ax, table, over = _axes(ax), trace.table, trace.data["traces"][path - 1]["parameters"][-1]
    columns = (np.asarray(table[name]) for name in ("path", "branch", "index_in_space", over, "energy_j"))
    paths, branches, index, x, energy = columns
    for branch in np.unique(branches[paths == path]):
        on = (paths == path) & (branches == branch)
        for stable, style in ((True, "-"), (False, "--")):
            shown = np.where((index[on] == 0) == stable, energy[on], np.nan)
            ax.plot(x[on], shown, style, color=PULLS if stable else PUSHES, linewidth=1.5)
    ax.set(xlabel=over, ylabel="energy / J")
    return ax


def _plot_load_path(trace: Trace, ax: Any, path: int) -> Any:
    table, over = trace.table, trace.data["parameters"][-1]
    shown = trace.data["of"][0] if trace.data["of"] else "energy_j"
    family = [path]
    for number, one in enumerate(trace.data["load_paths"], start=1):
        if one.get("branches_from", {}).get("path", -1) + 1 in family:
            family.append(number)
    for member in family:
        on = np.asarray(table["path"]) == member
        index, x, y = (np.asarray(table[name])[on] for name in ("index", shown, over))
        for stable, style in ((True, "-"), (False, "--")):
            # A part begins at the event that ends the part before it.
            is_so = (index == 0) == stable
            is_so |= np.roll(is_so, -1) & (np.arange(len(index)) < len(index) - 1)
            ax.plot(x, np.where(is_so, y, np.nan), style, color=PULLS if stable else PUSHES, linewidth=1.5)
    ax.set(xlabel=shown, ylabel=over)
    return ax


def plot_basins(basins: Basins, solver: str, ax: Any, *, iterations: bool) -> Any:
    """Which start leads where, or what it took."""
    ax = _axes(ax)
    values = basins.iterations(solver) if iterations else np.ma.masked_less(basins.outcome(solver), 0)
    extent = tuple(float(x) for x in basins.ranges.ravel())
    image = ax.imshow(values, origin="lower", extent=extent, cmap="viridis", interpolation="nearest")
    ax.figure.colorbar(image, ax=ax, label="iterations" if iterations else "equilibrium")
    ax.set(xlabel=basins.labels[0], ylabel=basins.labels[1], title=solver)
    return ax


def plot_mode(modes: Modes, mode: int, equilibrium: int, ax: Any) -> Any:
    """A system at rest, and both ends of a mode a tenth of its size away."""
    ax, found = _axes(ax), modes[equilibrium]
    if not 0 <= mode < len(found.what):
        raise InputError(f"there is no mode {mode}: there are {len(found.what)}, from 0")
    size = float(np.ptp(found.joints_m, axis=0).max())
    level = _level(found.joints_m)
    for scale, color in ((0.1, PULLS), (-0.1, PUSHES), (0.0, "black")):
        joints = found.joints_m + scale * size * found.shapes[mode]
        for path in _paths(modes.system):
            line = joints[path]
            ax.plot(line[:, :2] @ level, line[:, 2], color=color, linewidth=1.5)
    ax.set(xlabel="level / m", ylabel="z / m", title=f"{found.what[mode]}, omega^2 = {found.omega2_s2[mode]:.4g} 1/s^2")
    ax.set_aspect("equal")
    return ax
