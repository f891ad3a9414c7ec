"""The native half of the package; see the other modules for what it is used for."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Optional, Union, final

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[np.float64]
_Vector = tuple[float, float, float]
_Progress = Optional[Callable[[str, int, int], None]]
_Path = Union[str, PathLike[str]]

__all__ = [
    "Problem",
    "__version__",
    "arrow_stream",
    "basins",
    "census",
    "derivatives",
    "draw",
    "export",
    "get_threads",
    "judge",
    "limit_work",
    "load_cases",
    "losses",
    "modes",
    "live_answer",
    "live_page",
    "page",
    "pullback",
    "reproduce",
    "save_motion",
    "set_threads",
    "simulate",
    "solve",
    "solve_many",
    "solve_nets",
    "solve_text",
    "study",
    "sweep",
    "sweep_merge",
    "sweep_write",
    "tolerances",
    "trace",
]
__version__: str

@final
class Problem:
    @property
    def notes(self) -> list[str]: ...
    @staticmethod
    def chain(
        name: str,
        gravity_m_s2: float,
        start_m: _Vector,
        end_m: _Vector,
        lengths_m: _Array,
        masses_kg: _Array,
        centres_m: _Array | None,
        inertias_kg_m2: _Array | None,
    ) -> Problem: ...
    @staticmethod
    def network(
        name: str,
        gravity_m_s2: float,
        names: list[str],
        supports: list[int],
        at_m: _Array,
        directions: _Array,
        joint_masses_kg: _Array,
        forces_n: _Array,
        from_: list[int],
        to: list[int],
        kinds: list[int],
        lengths_m: _Array,
        masses_kg: _Array,
        centres_m: _Array | None,
        stiffnesses_n: _Array | None,
        /,
    ) -> Problem: ...
    @staticmethod
    def parse(text: str, name: str) -> Problem: ...
    @staticmethod
    def read(path: _Path) -> Problem: ...
    @staticmethod
    def case(name: str) -> Problem: ...
    @staticmethod
    def cases() -> list[str]: ...
    def near(self, joints_m: _Array) -> Problem: ...
    def in_case(self, name: str) -> Problem: ...
    def numbers(self, name: str) -> _Array: ...
    def with_numbers(self, arrays: list[tuple[str, _Array]]) -> Problem: ...
    @property
    def name(self) -> str: ...
    @property
    def is_chain(self) -> bool: ...
    @property
    def gravity_m_s2(self) -> float: ...
    def toml(self) -> str: ...
    def joint_names(self) -> list[str]: ...
    def supports_m(self) -> _Array: ...
    def member_joints(self) -> list[tuple[int, int]]: ...
    def member_via(self) -> list[list[int]]: ...
    def member_kinds(self) -> list[str]: ...

def set_threads(threads: int) -> None: ...
def get_threads() -> int: ...
def limit_work(numbers: int) -> None: ...
def solve(
    problem: Problem, solver: str, equations: str, census: str, threads: int, progress: _Progress
) -> tuple[str, list[dict[str, Any]]]: ...
def solve_text(problem: Problem, solver: str, equations: str, census: str) -> str: ...
def export(
    problem: Problem,
    joints_m: _Array,
    axial_n: _Array,
    reactions_n: _Array,
    used: _Array | None,
    ending: str,
    view: str,
) -> str: ...
def draw(svg: str, ending: str) -> bytes: ...
def solve_many(
    chains: int,
    bars: int,
    lengths_m: _Array,
    masses_kg: _Array,
    centres_m: _Array | None,
    starts_m: _Array,
    ends_m: _Array,
    gravity_m_s2: float,
    solver: str,
    threads: int,
    progress: _Progress,
) -> dict[str, Any]: ...
def solve_nets(
    problem: Problem,
    count: int,
    arrays: list[tuple[str, _Array]],
    solver: str,
    threads: int,
    progress: _Progress,
) -> dict[str, Any]: ...
def basins(
    problem: Problem,
    size: int,
    bars: Sequence[int],
    others_deg: float,
    joint: str | None,
    plane: str,
    threads: int,
    progress: _Progress,
) -> tuple[dict[str, Any], list[str], tuple[Sequence[str], Sequence[Sequence[float]]], str]: ...
def pullback(problem: Problem, by_joints: _Array | None, by_axial: _Array | None, threads: int) -> dict[str, Any]: ...
def census(
    problem: Problem, max_bars: int | None, threads: int, progress: _Progress
) -> tuple[tuple[str, list[dict[str, Any]]], str]: ...
def trace(
    problem: Problem,
    vary: list[str],
    numbers: list[str],
    max_points: int | None,
    branches: int,
    linear_buckling: bool,
    threads: int,
    progress: _Progress,
) -> tuple[str, str, bool, bool, str, str]: ...
def study(
    problem: Problem,
    vary: list[str],
    zip: bool,
    numbers: list[str],
    solver: str,
    threads: int,
    progress: _Progress,
) -> tuple[str, str, list[str], bool, bool, str]: ...
def load_cases(problem: Problem, solver: str, threads: int, progress: _Progress) -> tuple[str, str, bool | None]: ...
def live_page(text: str) -> str: ...
def live_answer(path: str, question: str) -> str: ...
def page(
    problem: Problem, vary: list[str], motion: tuple[str, float, float] | None, threads: int, progress: _Progress
) -> str: ...
def losses(problem: Problem, solver: str, threads: int, progress: _Progress) -> tuple[str, str, bool]: ...
def tolerances(
    problem: Problem, draws: tuple[int, int, str], solver: str, threads: int, progress: _Progress
) -> tuple[str, str]: ...
def derivatives(
    problem: Problem, number: str | None, by: str | None, threads: int, progress: _Progress
) -> str: ...
def sweep(
    problem: Problem, seeds: int, number: int, spread: str, solver: str, threads: int, progress: _Progress
) -> tuple[str, str]: ...
def sweep_write(
    problem: Problem,
    seeds: int,
    number: int,
    spread: str,
    solver: str,
    shard: tuple[int, int],
    angles: bool,
    file_format: str,
    folder: _Path,
    resume: bool,
    threads: int,
    progress: _Progress,
) -> str | None: ...
def sweep_merge(folders: Sequence[_Path], out: _Path, threads: int, progress: _Progress) -> str | None: ...
def simulate(
    problem: Problem,
    start_word: str,
    start_joints_m: _Array | None,
    time_s: float,
    step_s: float,
    store_s: float | None,
    order: int,
    damping_1_s: float,
    friction_n_m_s: float,
    pushes: list[tuple[str, _Vector]],
    forces: str | None,
    threads: int,
    progress: _Progress,
) -> tuple[dict[str, Any], str]: ...
def save_motion(
    problem: Problem,
    path: _Path,
    time_s: _Array,
    joints_m: _Array,
    velocities_m_s: _Array,
    axial_n: _Array,
    reactions_n: _Array,
    kinetic_j: _Array,
    potential_j: _Array,
) -> None: ...
def modes(
    problem: Problem, max_bars: int | None, lowest: int | None, threads: int, progress: _Progress
) -> tuple[str, str]: ...
def judge(
    problem: Problem,
    joints_m: _Array,
    axial_n: _Array | None,
    reactions_n: list[tuple[str, _Vector]] | None,
    source: str,
    tolerance: float | None,
    threads: int,
    progress: _Progress,
) -> tuple[str, bool, bool, str, str, bool | None]: ...
def arrow_stream(names: list[str], columns: list[Any]) -> object: ...
def reproduce(threads: int, progress: _Progress) -> tuple[str, str, str]: ...
