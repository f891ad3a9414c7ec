"""One system: chains, networks, results, evidence."""

import json
import pickle
import subprocess
import sys

import funicular as fn
import networkx as nx
import numpy as np
import pytest

# λ of the paper's example at its minimum, in mg: a root finder of 40 digits.
HORIZONTAL, VERTICAL = 0.6489448359339336, 2.312944292241838
WEIGHT_N = 9.80665


def test_the_example_of_the_paper():
    a = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(0, 0, -2))
    assert a.rung == "optimal" and a.agrees and a.is_stable
    assert [e.solver for e in a.equilibria] == ["lagrange", "energy"]
    assert abs(np.hypot(*a.multipliers_n[0, :2]) / WEIGHT_N - HORIZONTAL) < 1e-12
    assert abs(a.multipliers_n[0, 2] / WEIGHT_N - VERTICAL) < 1e-12
    assert a.proofs.verified.width < 1e-12 and a.proofs.verified.system.turns == 1
    assert [p.reached for p in a.proofs] == [True] * 5
    assert a.data["schema_version"] == 3


def test_forces_of_a_chain_balance_every_bar():
    a = fn.solve(lengths=[0.7, 0.9, 0.5, 0.8], masses=[2, 1, 0.1, 3], end=(1.2, 0.7, -0.5), start=(0.1, 0.2, 0.3))
    weights = np.zeros((4, 3))
    weights[:, 2] = np.multiply([2, 1, 0.1, 3], WEIGHT_N)
    assert np.abs(a.start_forces_n + a.end_forces_n - weights).max() < 1e-12
    assert np.allclose(a.reactions_n.sum(axis=0), weights.sum(axis=0))
    assert np.allclose(a.joints_m[0], (0.1, 0.2, 0.3)) and np.allclose(a.joints_m[-1], (1.2, 0.7, -0.5))
    assert np.allclose(np.linalg.norm(np.diff(a.joints_m, axis=0), axis=1), [0.7, 0.9, 0.5, 0.8])
    assert np.array_equal(a.reaction("0"), a.reactions_n[0])


def test_axial_forces_at_the_ends():
    # A rope of 50 kg with 100 kg at its end: the anchor holds 150 kg.
    rope = {
        "joints": {"A": {"at_m": [0, 0, 0]}, "P": {"mass_kg": 100}},
        "bars": [{"from": "A", "to": "P", "length_m": 10, "mass_kg": 50, "kind": "cable"}],
    }
    a = fn.System.from_dict(rope).solve()
    assert np.allclose([a.axial_from_n, a.axial_n, a.axial_to_n], np.multiply([[150], [125], [100]], WEIGHT_N))
    assert np.allclose(a.axial_max_n, 150 * WEIGHT_N)
    b = fn.solve_many(lengths=[[1, 1]], masses=[[1, 1]], ends=[[1, 0, 0]], gravity=10.0)
    # A level V: (H, 10 N) at the anchors along (1, sqrt 3) / 2, H = 10 / (2 sqrt 3).
    level, up = 10 / np.sqrt(12), np.sqrt(0.75)
    assert np.allclose(b.axial_ends_n[0, :, 0], [0.5 * level + 10 * up, 0.5 * level])
    assert np.allclose(b.table["largest_tension_n"], 0.5 * level + 10 * up)


def test_strengths_and_the_weakest_member():
    # The triangle 3, 4, 5: 20 N on two threads that rise 4 in 5 are 12.5 N in each.
    threads = [{"from": end, "to": "lamp", "length_m": 5, "mass_kg": 0} for end in "AB"]
    system = {
        "gravity_m_s2": 10,
        "safety": 2,
        "joints": {"A": {"at_m": [-3, 0, 0]}, "B": {"at_m": [3, 0, 0]}, "lamp": {"mass_kg": 2}},
        "bars": [{**threads[0], "strength_n": 50}, {**threads[1], "strength_n": 20}],
    }
    a = fn.System.from_dict(system).solve()
    assert np.allclose(a.utilisation, [0.25, 0.625]) and np.allclose(a.bars["utilisation"], a.utilisation)
    assert a.weakest.number == 1 and a.weakest.safety_wanted == 2
    assert a.weakest.utilisation == pytest.approx(0.625) and a.weakest.safety == pytest.approx(1.6)
    assert a.to_dict()["equilibria"][0]["weakest"]["number"] == 1
    assert a.is_strong is False and 'class="weak"' in a.svg()
    one = fn.System.from_dict({**system, "bars": [{**threads[0], "strength_n": 50}, threads[1]]}).solve()
    assert np.array_equal(one.utilisation, [one.utilisation[0], np.nan], equal_nan=True)
    with pytest.raises(fn.InputError, match="strength_n"):
        fn.System.from_dict({**system, "bars": threads}).solve()
    bare = fn.System.case("lamp").solve()
    assert bare.weakest is None and bare.utilisation is None and bare.is_strong is None
    assert fn.System.case("tackle").solve().is_strong is True


def test_ranges_over_tolerances():
    # 2 kg and half a kilogram on a bar of 3 m below an anchor that is known to 0.1 m, under 10 m/s^2.
    bar = '{ from = "A", to = "P", length_m = 3, mass_kg = 0 }'
    joints = "A = { at_m = [0, 0, 0], at_tolerance_m = 0.1 }, P = { mass_kg = 2, mass_tolerance_kg = 0.5 }"
    text = f"gravity_m_s2 = 10\njoints = {{ {joints} }}\nbars = [{bar}]"
    found = fn.System.from_toml(text).tolerances(draws=50, seed=3)
    assert found.is_proved and found.is_stable and found.reason is None
    assert found.axial_n == pytest.approx(np.array([[15.0, 25.0]]))
    assert found.joints_m[1, 2] == pytest.approx([-3.1, -2.9]) and found.joints_m.shape == (2, 3, 2)
    assert [number.name for number in found.numbers][2:] == ["joints.A.at_m.z", "joints.P.mass_kg"]
    assert found.bars[0].axial_n.is_hull and found.bars[0].axial_n.most_by == "joints.P.mass_kg"
    assert found.draws.solved == 50 and found.draws.outside == 0 and 1 < found.bars[0].drawn_n.deviation < 5
    assert "exactly one equilibrium" in str(found).replace("\n", " ")
    # Below the lowest support, which moves with it.
    assert (found.sag.joint, found.sag.to) == ("P", "A")
    assert (found.sag.depth_m.least, found.sag.depth_m.most) == pytest.approx((3.0, 3.0))
    # A ring in the middle of a rope of 10 m hangs 4 m below its anchors, 3-4-5; 0.02 m more of it are 0.01 m more of each span.
    ring = """
        joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, ring = { mass_kg = 1 } }
        bars = [{ from = "A", via = ["ring"], to = "B", length_m = 10, kind = "cable", length_tolerance_m = 0.02 }]
    """
    sag = fn.System.from_toml(ring).tolerances().sag
    assert (sag.joint, sag.to) == ("ring", "B")
    ends = np.array([sag.depth_m.least, sag.depth_m.most])
    assert ends == pytest.approx(np.sqrt(np.array([4.99, 5.01]) ** 2 - 9), abs=1e-9)
    exact = fn.System.case("lamp").tolerances()
    assert not exact.is_proved and "tolerance" in exact.reason and exact.axial_n.shape == (0, 2) and exact.draws is None


def test_thousands_of_draws_stay_within_their_ranges():
    # A lamp on two elastic cables, all of their numbers uncertain; half of the draws at the ends of the tolerances.
    text = """
        gravity_m_s2 = 10
        tolerances = { length_tolerance_m = 2e-3, stiffness_tolerance = 0.05, at_tolerance_m = 5e-3 }
        joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [6, 0, 0] }, lamp = { mass_kg = 12, mass_tolerance_kg = 0.5 } }
        bars = [{ from = "A", to = "lamp", length_m = 4, mass_kg = 0, stiffness_n = 2e4 },
                { from = "lamp", to = "B", length_m = 3.5, mass_kg = 0, stiffness_n = 3e4 }]
    """
    system = fn.System.from_toml(text)
    ranges = system.tolerances()
    assert ranges.is_proved
    rows, rng = 20_000, np.random.default_rng(1)

    def draws(*shape):
        within = rng.uniform(-1, 1, (rows, *shape))
        within[::2] = np.sign(within[::2])
        return within

    found = system.solve_many(
        lengths=[4, 3.5] + 2e-3 * draws(2),
        stiffnesses=[2e4, 3e4] * (1 + 0.05 * draws(2)),
        joint_masses=[0, 0, 12] + 0.5 * draws(3) * [0, 0, 1],
        anchors={0: 5e-3 * draws(3), 1: [6, 0, 0] + 5e-3 * draws(3)},
    )
    assert found.ok.all()
    for least_and_most, values, room in [(ranges.axial_n, found.axial_n, 1e-7), (ranges.joints_m, found.joints_m, 1e-9)]:
        least, most = least_and_most[..., 0], least_and_most[..., 1]
        assert (values >= least - room).all() and (values <= most + room).all()
        # The corners of the numbers are among the draws, or nearly: the ranges are no wider than they need be.
        reached = (values.max(axis=0) - values.min(axis=0)) / (most - least)
        assert (reached > 0.95).all(), reached


def test_the_loss_of_each_member():
    # The triangle 3, 4, 5: without one thread the lamp hangs 5 m below the other anchor, from 4 m below the middle.
    text = """
        gravity_m_s2 = 10
        joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, lamp = { mass_kg = 2 } }
        bars = [{ from = "A", to = "lamp", length_m = 5, mass_kg = 0, strength_n = 50 },
                { from = "B", to = "lamp", length_m = 5, mass_kg = 0, strength_n = 16 }]
    """
    found = fn.System.from_toml(text).losses()
    first, second = found.losses
    assert first.bar == 1 and first.weakest.bar == 2 and first.weakest.utilisation == pytest.approx(1.25)
    assert second.bar == 2 and second.weakest.bar == 1 and second.weakest.utilisation == pytest.approx(0.4)
    assert first.moves == "lamp" and first.moves_m == pytest.approx(np.sqrt(10)) and first.agrees
    assert not found.survives and "is at 125 % of its strength." in str(found) and found.to_dict()["losses"][0]["bar"] == 1
    bars = [{"from": "A", "to": "P", "length_m": 1, "mass_kg": 0}]
    hanger = fn.System.from_dict({"joints": {"A": {"at_m": [0, 0, 0]}, "P": {"mass_kg": 1}}, "bars": bars}).losses()
    assert hanger.losses[0].outcome == "falls" and not hanger.survives


def test_load_cases_and_their_envelope():
    # 3-4-5: each thread takes 62.5 N of the weight, and 25 N of a wind of 30 N along them, or is relieved of it.
    text = """
        gravity_m_s2 = 10
        joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, lamp = { mass_kg = 10 } }
        bars = [{ from = "A", to = "lamp", length_m = 5, mass_kg = 0, strength_n = 175 },
                { from = "B", to = "lamp", length_m = 5, mass_kg = 0 }]
        loads = [{ name = "wind", joint = "lamp", force_n = [30, 0, 0] }]
        cases = [{ name = "east", factors = { wind = 1 } }, { name = "west", factors = { wind = -1 } }]
    """
    system = fn.System.from_toml(text)
    found = system.load_cases()
    assert [case.name for case in found.cases] == ["east", "west"] and found.is_strong
    first, second = found.bars
    assert first.ends == ["A", "lamp"] and first.most_n.case == "east" and first.most_n.value == pytest.approx(87.5)
    assert first.least_n.case == "west" and first.least_n.value == pytest.approx(37.5)
    assert first.utilisation.value == pytest.approx(0.5) and not hasattr(second, "utilisation")
    assert [support.most_n.case for support in found.supports] == ["east", "west"]
    assert "Worst: in east" in str(found) and found.to_dict()["bars"][0]["bar"] == 1
    assert system.in_case("west").solve().axial_n == pytest.approx([37.5, 87.5])
    assert fn.System.from_toml(system.to_toml()).load_cases().to_dict() == found.to_dict()
    with pytest.raises(fn.SystemError, match="no load case"):
        system.in_case("north")
    with pytest.raises(fn.Error, match="no load cases"):
        fn.System.case("lamp").load_cases()


def test_a_page_to_look_at():
    system = fn.System.case("lamp")
    text = system.page("loads=0.5..2")
    assert text.startswith("<!DOCTYPE html>") and text.count("Load paths") == 1 and system.page() != text
    chain = fn.System.case("two-bars")
    assert '"group":"Study"' in chain.page("anchors.end_m.x=0.4..1.6:5")
    moved = fn.page(chain, motion="seed:3", time=0.5, damping=1)
    assert moved.count('"group":"Motion"') == 1 and '"group":"Study"' not in moved
    with pytest.raises(fn.Error, match="nothing hangs"):
        chain.page("anchors.end_m.x=7,8")
    with pytest.raises(fn.SettingError, match="start"):
        chain.page(motion="anywhere")


def gable():
    # Feet 6 m apart, two bars of 5 m and EA = 1000 N, 10 kg between them.
    return fn.System.from_arrays(
        joints=3,
        anchors={0: (-3, 0, 0), 1: (3, 0, 0)},
        bars=[[0, 2], [1, 2]],
        lengths=[5, 5],
        joint_masses={2: 10},
        stiffnesses=[1e3, 1e3],
        gravity=10,
    )


def height_of_a_gable():
    # Each bar has the length l and pushes with 200 N/m (5 - l): 100 N = 400 (5 - l) h / l, above its largest value.
    low, high = 2.0, 4.0
    for _ in range(100):
        h = (low + high) / 2
        length = np.hypot(3, h)
        low, high = (h, high) if 400 * (5 - length) * h / length > 100 else (low, h)
    return low


def test_the_equilibrium_next_to_a_shape():
    up = [[-3, 0, 0], [3, 0, 0], [0.1, 0, 3.9]]
    h = height_of_a_gable()
    lowest = gable().solve()
    assert lowest.near is None and lowest.joints_m[2, 2] < -4 and lowest.rung == "optimal"
    for a in (gable().solve(near=up, solver="lagrange"), gable().near(up).solve(solver="lagrange")):
        # It stands in its plane, and falls to the side.
        assert np.allclose(a.joints_m[2], (0, 0, h), atol=1e-10) and a.stability.index_in_space == 1
        assert a.near.is_neighbour and a.near.joint == "2"
        assert abs(a.near.moved_m - np.hypot(0.1, 3.9 - h)) < 1e-9
        assert abs(a.near.lower_j - lowest.energy_j) < 1e-9
    # 200 N/m along each bar; across it the force turns.
    length = np.hypot(3, h)
    turned = -200 * (5 - length) / length
    omega2 = [2 * turned / 10] + [
        (400 * along**2 + 2 * turned * (1 - along**2)) / 10 for along in (3 / length, h / length)
    ]
    modes = gable().modes(near=up)
    assert len(modes) == 1 and np.allclose(modes[0].omega2_s2, omega2, atol=1e-8)
    motion = gable().simulate(near=up, time=0.1)
    assert np.allclose(motion.joints_m[:, 2], (0, 0, h), atol=1e-6)


def test_what_stands_where_it_is_drawn():
    truss = fn.System.case("warren-truss").solve()
    assert truss.agrees and truss.near.is_neighbour and truss.near.lower_j < -1000
    # By the method of joints.
    assert abs(truss.axial_n.min() + 250 * WEIGHT_N * np.sqrt(89) / 8) < 1e-8
    with pytest.raises(fn.errors.SystemError, match="drawn at one place"):
        gable().near([[-3, 0, 0], [3, 0, 0], [3, 0, 0]])
    with pytest.raises(fn.errors.AnswerError):
        gable().solve(near=[[0, 0, 0]])
    with pytest.raises(fn.errors.ShapeError):
        gable().modes(near=[0, 0, 0])


def test_the_same_system_in_five_ways():
    toml = """
    name = "lamp"
    [joints]
    A = { at_m = [0, 0, 0] }
    B = { at_m = [4, 0, 0] }
    P = { mass_kg = 20, force_n = [0, 30, 0] }
    [[bars]]
    from = "A"
    to = "P"
    length_m = 3
    mass_kg = 1
    kind = "cable"
    [[bars]]
    from = "P"
    to = "B"
    length_m = 2
    mass_kg = 0.5
    """
    read = fn.System.from_toml(toml)
    members = [
        {"from": "A", "to": "P", "length_m": np.float64(3), "mass_kg": 1, "kind": "cable"},
        {"from": "P", "to": "B", "length_m": 2, "mass_kg": 0.5},
    ]
    joints = {"A": {"at_m": np.zeros(3)}, "B": {"at_m": (4, 0, 0)}, "P": {"mass_kg": 20, "force_n": [0, 30, 0]}}
    data = fn.System.from_dict({"name": "lamp", "joints": joints, "bars": members})
    arrays = fn.System.from_arrays(
        joints=["A", "B", "P"],
        anchors={"A": (0, 0, 0), 1: (4, 0, 0)},
        bars=[[0, 2], [2, 1]],
        lengths=[3, 2],
        masses=[1, 0.5],
        joint_masses={"P": 20},
        forces={2: (0, 30, 0)},
        kinds=["cable", "bar"],
        name="lamp",
    )
    graph = nx.Graph(name="lamp")
    for name, about in joints.items():
        graph.add_node(name, **about)
    for member in members:
        graph.add_edge(member["from"], member["to"], **{k: v for k, v in member.items() if k not in ("from", "to")})
    drawn = fn.System.from_networkx(graph)
    again = fn.System.from_toml(arrays.to_toml())
    answers = [system.solve(census="never") for system in (read, data, arrays, again, pickle.loads(pickle.dumps(read)))]
    assert read == data == arrays == again
    for other in answers[1:]:
        assert np.array_equal(answers[0].joints_m, other.joints_m)
        assert np.array_equal(answers[0].axial_n, other.axial_n)
    # A graph has no directions: its members may run the other way.
    assert np.allclose(drawn.solve(census="never").joints_m, answers[0].joints_m, atol=1e-12)
    assert answers[0].multipliers_n is None and answers[0].agrees


def test_chains_as_cases_files_and_text(tmp_path):
    case = fn.System.case("three-equal-bars")
    path = tmp_path / "chain.toml"
    path.write_text(case.to_toml())
    assert fn.System.read(path) == case == fn.System.read(str(path))
    assert case.is_chain and case.joint_names == ["0", "1", "2", "3"]
    assert set(fn.cases()) >= {"three-equal-bars", "two-bars", "footbridge"}
    assert not fn.System.case("footbridge").is_chain


def test_one_solver_alone_gets_no_comparison():
    for solver in ("lagrange", "energy"):
        a = fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0), solver=solver, census="never")
        assert [e.solver for e in a.equilibria] == [solver] and a.agreement is None and not a.agrees
        assert a.proofs.agreed.reason["kind"]
    full = fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0), equations="full")
    assert full.agrees


def test_answers_do_not_depend_on_threads():
    system = fn.System(lengths=np.linspace(0.5, 1.5, 300), masses=np.linspace(1, 2, 300), end=(120, 3, -40))
    one, two = (system.solve(threads=threads) for threads in (1, 2))
    assert one.joints_m.tobytes() == two.joints_m.tobytes()
    assert one.axial_n.tobytes() == two.axial_n.tobytes()
    fn.set_threads(1)
    assert fn.get_threads() == 1
    assert system.solve().joints_m.tobytes() == one.joints_m.tobytes()
    fn.set_threads(0)


def test_results_own_their_memory():
    a = fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0))
    joints = a.joints_m
    assert joints.flags.c_contiguous and joints.flags.writeable and joints.dtype == np.float64
    del a
    joints += 1
    assert np.isfinite(joints).all()


def test_tables_are_read_by_others_without_our_knowing_them():
    import pandas
    import polars
    import pyarrow

    a = fn.System.case("footbridge").solve(census="never")
    for table in (a.joints, a.bars, a.system.members, a.system.joints):
        arrow, frame = pyarrow.table(table), polars.DataFrame(table)
        pandas_frame = table.to_pandas()
        assert arrow.column_names == list(table) == list(frame.columns) == list(pandas_frame.columns)
        assert arrow.num_rows == len(frame) == len(pandas_frame) == table.rows
        for name, column in table.items():
            assert arrow[name].to_pylist() == list(column) or np.array_equal(arrow[name], column, equal_nan=True)
        assert pyarrow.table(table) == arrow or any("nan" in str(c) for c in table.values())
    assert isinstance(pandas_frame, pandas.DataFrame)
    empty = fn.Table({"a": np.zeros(0), "b": []})
    assert pyarrow.table(empty).num_rows == 0
    names = fn.Table({"joint": ["ä", "", "λ₃ \U0001f4a1"]})
    assert pyarrow.table(names)["joint"].to_pylist() == names["joint"]


def test_tables_are_dictionaries_of_columns():
    import pandas

    a = fn.System.case("lamp").solve()
    frame = pandas.DataFrame(a.joints)
    assert list(frame["joint"]) == ["A", "B", "lamp"] and frame["z_m"].tolist() == a.joints_m[:, 2].tolist()
    assert a.joints == dict(a.joints) and a.joints != a.bars and pickle.loads(pickle.dumps(a.joints)) == a.joints


def test_an_answer_is_a_shape_and_an_answer_to_be_judged():
    lamp = fn.System.case("lamp")
    a = lamp.solve()
    again = lamp.solve(near=a)
    assert again.near.is_neighbour and np.allclose(again.joints_m, a.joints_m, atol=1e-12)
    assert fn.judge(lamp, a).confirmed
    assert fn.judge(lamp, a, 1.001 * a.axial_n).refuted
    one = lamp.study("loads=0.5..1:2", of="joints.lamp.z")
    assert one.table == lamp.study("loads=0.5..1:2", of=["joints.lamp.z"]).table


def test_streams_that_nobody_reads_are_freed():
    table = fn.Table({"a": np.zeros(1000), "b": ["x"] * 1000})
    for _ in range(1000):
        table.__arrow_c_stream__()


def test_notebooks_show_the_picture_and_the_ladder():
    a = fn.System.from_toml(
        """
        name = "<script>alert(1)</script>"
        anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }
        bars = [{ length_m = 1, mass_kg = 1, count = 2 }]
        """
    ).solve()
    shown = a._repr_html_()
    assert "<svg" in shown and "optimal" in shown and "no configuration" in a.proofs.optimal.how
    assert "<script>" not in shown
    assert "<svg" in a.equilibria[1]._repr_html_() and "<table>" in a.joints._repr_html_()
    assert "<svg" in a.system.census()._repr_html_()


def test_plots_only_with_matplotlib():
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    a = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(1, 0, -1))
    axes = a.plot()
    assert axes.name == "rectilinear" and len(axes.lines) == 4
    assert a.plot(forces=False, space=True).name == "3d"
    assert fn.System.case("footbridge").solve(census="never").plot().name in ("rectilinear", "3d")
    pyplot.close("all")
    code = """
import sys
sys.modules["matplotlib"] = None
import funicular as fn
a = fn.solve(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0))
try:
    a.plot()
except fn.Error as error:
    print("matplotlib" in str(error))
print([name for name in ("pandas", "networkx", "pyarrow", "tqdm", "distributed") if name in sys.modules])
"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.split("\n")[:2] == ["True", "[]"]


def test_load_paths_branch_off():
    # An upright bar of 1 m between two springs of 10 N: it falls to a side under 20 * 100 / 101^1.5 N.
    joints = {"A": {"at_m": [0, 0, 0]}, "L": {"at_m": [-10, 0, 0]}, "R": {"at_m": [10, 0, 0]}}
    joints["P"] = {"at_m": [0, 0, 1], "near_m": [0, 0, 1], "free": "xz", "force_n": [0, 0, -1]}
    bars = [{"from": "A", "to": "P", "length_m": 1, "mass_kg": 0}]
    bars += [{"from": end, "to": "P", "stiffness_n": 10, "mass_kg": 0} for end in "LR"]
    system = fn.System.from_dict({"joints": joints, "bars": bars})
    trace = system.trace("loads=0,4,-4", branches=1, linear_buckling=True)
    straight, round_ = trace.paths
    critical = 2000 / 101**1.5
    assert straight.linear_buckling == pytest.approx(critical, rel=1e-6)
    assert trace.first_loss["kind"] == "branch-point" and trace.first_loss["values"] == pytest.approx([critical])
    assert (round_.end, round_.branches_from.path, round_.joins.event) == ("joins", 0, 0)
    assert trace.html().startswith("<!DOCTYPE html>") and trace.checks_agree
    assert system.trace("loads=0..4").html() != trace.html()


def test_census_trace_sweep_modes_motion():
    system = fn.System.case("three-equal-bars")
    census = system.census()
    assert census.complete and [e.data["label"] for e in census] == ["1", "1'", "2", "2'"]
    assert (census.energy_bounds_j()[:, 1] - census.energy_bounds_j()[:, 0] < 1e-12).all()
    assert census.table["in_space"] == ["stable", "stable", "unstable", "unstable"]
    pendulum = {"A": {"at_m": [0, 0, 0]}, "P": {"mass_kg": 1}, "Q": {"mass_kg": 1}}
    bars = [{"from": a, "to": b, "length_m": 1, "mass_kg": 0} for a, b in ("AP", "PQ")]
    double = fn.System.from_dict({"gravity_m_s2": 10, "joints": pendulum, "bars": bars})
    assert [round(e.energy_j) for e in double.census()] == [-30, -10, 10, 30]
    trace = system.trace("anchors.end_m.z=-2.9..-1:20")
    table = trace.table
    assert trace.checks_agree and table.rows > 40 and table["energy_j"].min() < -40
    assert trace.html() == ""
    sweep = system.sweep(5000, solver="lagrange", seed=3)
    assert set(sweep.counts("lagrange")) == {0, 1, 2, 3} and sweep.seeds == 5000
    modes = system.modes()
    assert modes.complete and len(modes) == 4 and (modes[0].omega2_s2 > -1e-9).all()
    motion = system.simulate(start="seed:7", time=0.5, store=0.1, damping=1.0)
    assert motion.time_s.tolist() == pytest.approx([0, 0.1, 0.2, 0.3, 0.4, 0.5])
    assert motion.laws_off.max() < 1e-9 and motion.html().startswith("<!DOCTYPE html>")
    still = system.simulate(start=census[0].joints_m, time=0.01)
    assert np.abs(still.joints_m - census[0].joints_m).max() < 1e-9


def test_what_the_program_prints_is_what_the_package_knows():
    a = fn.System.case("two-bars").solve()
    text = json.dumps(a.data)
    assert {"schema_version", "system", "equilibria", "agreement"} <= a.data.keys() and "NaN" not in text


def test_judging():
    system = fn.System(lengths=[5, 5], masses=[1, 1], end=(6, 0, 0))
    places = [[0, 0, 0], [3, 0, -4], [6, 0, 0]]
    right = fn.judge(system, places)
    assert right.confirmed and not right.refuted and right.finding == "confirmed"
    # Each bar leans 3 to 4 and carries half its weight to the middle: 5/4 of half a bar's weight, both sides alike.
    axial = 0.5 * 9.80665 * 5 / 4
    assert fn.judge(system, places, [axial, axial]).confirmed
    assert not fn.judge(system, places, [axial, -axial]).confirmed
    named = dict(zip(("0", "1", "2"), places))
    assert fn.judge(system, named).confirmed
    assert fn.judge(system, [[0, 0, 0], [3, 0, 4], [6, 0, 0]]).proofs.optimal.reached is False
    with pytest.raises(fn.AnswerError) as error:
        fn.judge(system, places[:2])
    assert (error.value.wanted, error.value.found) == (3, 2)
    with pytest.raises(fn.SettingError):
        fn.judge(system, places, tolerance=1.0)


def test_a_force_over_time_and_the_order_of_the_steps() -> None:
    slider = fn.System.from_toml(
        'joints = { S = { at_m = [0, 0, 0], free = "x", mass_kg = 1 }, P = { mass_kg = 1e-9 } }\n'
        'bars = [{ from = "S", to = "P", length_m = 1, mass_kg = 0 }]\n'
    )
    # 3 N more each second: the speed is 3/2 t² m/s, the way t³/2.
    pull = {"S": [[0, 0, 0, 0], [2, 6, 0, 0]]}
    moved = slider.simulate(start=[[0, 0, 0], [0, 0, -1]], time=2, order=4, forces=pull)
    assert abs(moved.velocities_m_s[-1, 0, 0] - 6) < 1e-2
    assert abs(moved.joints_m[-1, 0, 0] - 4) < 1e-2
    # Of a higher order the energy is kept better.
    chain = fn.System.case("three-equal-bars")
    lost = []
    for order in (2, 4, 8):
        energy = chain.simulate(start="angles=0,60,-60", time=1, step=1e-2, order=order).energy_j
        lost.append(float(abs(energy - energy[0]).max()))
    assert lost[0] > 100 * lost[1] > 100 * lost[2], lost


def test_the_lowest_modes_and_enclosures_of_their_frequencies() -> None:
    rope = fn.System.from_toml(
        "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n"
        "bars = [{ length_m = 0.01, mass_kg = 0.01, count = 200 }]\n"
    )
    assert [len(rope.modes(lowest=k)[0].omega2_s2) for k in (3, 25)] == [3, 25]
    assert np.isnan(rope.modes(lowest=3)[0].omega2_between_s2).all()
    two = fn.System.from_toml(
        "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\nbars = [{ length_m = 1, mass_kg = 1, count = 2 }]\n"
    )
    # Both bars swing about the line of the anchors like a plate: 3/2 g/h with h = √3/2 m.
    hanging = two.modes()[0]
    low, high = hanging.omega2_between_s2[0]
    told = 9.80665 * 3**0.5
    assert low - 1e-13 <= told <= high + 1e-13 and high - low < 1e-11
    assert hanging.data["enclosed"]["inertia"] == {"negative": 0, "zero": 0, "positive": 1}


def test_a_path_and_arrays_as_one_would_type_them(tmp_path):
    path = tmp_path / "lamp.toml"
    path.write_text(
        "gravity_m_s2 = 10\n"
        "joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, lamp = { mass_kg = 2 } }\n"
        "bars = [{ from = 'A', to = 'lamp', length_m = 5, mass_kg = 0 },\n"
        "        { from = 'lamp', to = 'B', length_m = 5, mass_kg = 0 }]\n"
    )
    # The triangle 3, 4, 5: 20 N on two threads that rise 4 in 5.
    for given in (path, str(path)):
        a = fn.solve(given)
        assert a.joint("lamp") == pytest.approx([0, 0, -4]) and a.joint(2) == pytest.approx([0, 0, -4])
        assert a.sag_m == pytest.approx(4) and a.largest_tension_n == pytest.approx(12.5)
        assert a.largest_compression_n is None
        for ends in (("A", "lamp"), ("lamp", "A"), (2, 0)):
            member = a.member(*ends)
            assert member.number == 0 and member.axial_max_n == pytest.approx(12.5)
            assert member.start_force_n == pytest.approx([-7.5, 0, 10])
    with pytest.raises(fn.InputError, match="no member between"):
        a.member("A", "B")
    with pytest.raises(fn.InputError, match="there is no joint 'C'"):
        a.joint("C")
    with pytest.raises(fn.InputError, match="there is no joint 3"):
        a.member("A", 3)
    chain = fn.solve([1, 1, 1], [1, 1, 1], (0, 0, -2))
    named = fn.solve(lengths=[1, 1, 1], masses=[1, 1, 1], end=(0, 0, -2))
    assert (chain.joints_m == named.joints_m).all()
    for wrong in (lambda: fn.solve([1, 1], [1, 1], (1, 0, 0), lengths=[1, 1]), lambda: fn.solve(path, [1]), fn.solve):
        with pytest.raises(fn.InputError):
            wrong()
    with pytest.raises(fn.FileError):
        fn.solve(tmp_path / "none.toml")


def test_an_error_says_what_helps():
    with pytest.raises(fn.FileError) as error:
        fn.System.from_toml("anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\nbars = [{ lenght_m = 1 }]")
    assert "help: did you mean `length_m`?" in str(error.value)
    assert str(pickle.loads(pickle.dumps(error.value))) == str(error.value)


V = """
gravity_m_s2 = 10
joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 0.8 } }
bars = [{ from = "A", to = "P", length_m = 5, mass_kg = 0 }, { from = "P", to = "B", length_m = 5, mass_kg = 0 }]
"""


def test_a_study_is_the_triangle_at_every_span():
    v = fn.System.from_toml(V)
    s = v.study("joints.B.at_m.x=1,3,5,9", of=["joints.P.z"])
    # Half the span is 2, 3, 4, 6 m: a triangle of 5 m sides, the last out of reach.
    sag = np.sqrt(25 - np.array([2, 3, 4]) ** 2)
    assert s.table["sag_m"][:3] == pytest.approx(sag) and np.isnan(s.table["sag_m"][3])
    assert s.table["joints.P.z"][:3] == pytest.approx(-sag)
    assert s.table["tension_n"][:3] == pytest.approx(4 * 5 / sag)
    assert s.table["agrees"][:3].tolist() == [1, 1, 1] and s.table["refused"][3] and not s.table["refused"][0]
    assert s.agrees and s.parameters == ["joints.B.at_m.x"] and "<svg" in s.svg()
    both = v.study("joints.P.mass_kg=1,2", "gravity_m_s2=9,10", zip=True)
    assert both.table["tension_n"] == pytest.approx([9 / 2 * 5 / 4, 20 / 2 * 5 / 4])
    with pytest.raises(fn.ParameterError, match="unknown key"):
        v.study("joints.P.mas_kg=1,2")
    with pytest.raises(fn.InputError, match="no path 2"):
        s.svg(2)


def test_derivatives_are_those_of_the_triangle():
    v = fn.System.from_toml(V)
    found = fn.gradient(v, "joints.P.at_m.z")
    # z = -sqrt(l^2 - 9): a metre more of both bars lowers it by l/h, of one by half.
    assert found.value == pytest.approx(-4) and found["bars.1.length_m"] == pytest.approx(-0.625)
    assert set(found.table["parameter"]) >= {"bars.1.length_m", "bars.2.length_m"}
    with pytest.raises(KeyError):
        found["bars.3.length_m"]
    assert v.derivatives(of="joints.P.at_m.z").data == found.data
    by = v.derivatives(by="bars.1.length_m")
    assert by.joints_m.P[2] == pytest.approx(-0.625) and by.unit == "m"
    pairs = {(pair.of, pair.by): pair.stiffness_n_m for pair in v.derivatives()}
    # The pull W/2 a/sqrt(l^2 - a^2) of half the span a grows by W l^2/(4 h^3) with the span.
    assert pairs["B", "B"][0][0] == pytest.approx(8 * 25 / (4 * 64))
    for wrong in (lambda: fn.gradient(v, "joints.P.at_m.w"), lambda: fn.change(v, "bars.1.color")):
        with pytest.raises(fn.errors.InputError):
            wrong()


def test_a_ring_on_a_rope_swings_and_moves_and_has_derivatives():
    # 10 kg on a rope of 5 m from the origin to 4 m aside and 1 m up: T = W / (2 cos a) with sin a = d / L.
    ring = fn.System.from_dict(
        {
            "joints": {"A": {"at_m": [0, 0, 0]}, "B": {"at_m": [4, 0, 1]}, "P": {"mass_kg": 10}},
            "bars": [{"from": "A", "via": ["P"], "to": "B", "length_m": 5, "kind": "cable"}],
        }
    )
    assert ring.member_joints == [(0, 1)] and ring.member_via == [[2]] and list(ring.members["via"]) == ["P"]
    weight = 10 * 9.80665
    answer = ring.solve()
    assert abs(answer.axial_n[0] - weight / 1.2) < 1e-9 and list(answer.bars["via"]) == ["P"]
    # Along its ellipse, and about the line of its ends 4/3 m above it.
    told = [9.80665 * 2.5 * 2**0.5 / (50 / 9) ** 1.5, 0.75 * 9.80665]
    np.testing.assert_allclose(ring.modes()[0].omega2_s2, told, rtol=1e-9)
    by_length = -weight * 16 / (250 * 0.216)
    assert abs(fn.gradient(ring, "bars.1.axial_n")["bars.1.length_m"] - by_length) < 1e-6
    back = fn.gradients.pullback(ring, {"lengths": [5]}, np.zeros((3, 3)), [1])
    assert abs(back["lengths"][0] - by_length) < 1e-6
    # Released 1 mm along the level of its rest, half a period later it is on the other side.
    rest = answer.joints_m.copy()
    rest[2, 0] += 1e-3
    period = 2 * np.pi / told[0] ** 0.5
    moved = ring.simulate(start=rest, time=period / 2, step=period / 2000)
    assert abs(moved.joints_m[-1, 2, 0] - 4 / 3 + 1e-3) < 1e-5
