"""What is wrong is refused with its numbers, clearly, and without steering a terminal."""

import pickle

import funicular as fn
import numpy as np
import pytest

CHAIN = {"lengths": [1.0, 1.0], "masses": [1.0, 1.0], "end": (1.0, 0.0, 0.0)}


def chain(**other):
    return fn.System(**{**CHAIN, **other})


def test_refusals_carry_their_numbers():
    with pytest.raises(fn.OutOfReach) as error:
        chain(end=(3.5, 0, 0))
    assert (error.value.span_m, error.value.total_length_m, error.value.missing_m) == (3.5, 2.0, 1.5)
    assert (error.value.from_joint, error.value.to_joint) == ("0", "2") and isinstance(error.value, ValueError)
    with pytest.raises(fn.Taut):
        chain(end=(2, 0, 0))
    with pytest.raises(fn.NothingMoves):
        fn.System(lengths=[1], masses=[1], end=(1, 0, 0))
    with pytest.raises(fn.BarTooLong) as error:
        chain(lengths=[5, 1])
    assert (error.value.bar, error.value.length_m, error.value.rest_m) == (1, 5.0, 2.0)
    with pytest.raises(fn.Folded):
        chain(lengths=[2, 1])
    with pytest.raises(fn.NoLoad):
        chain(masses=[0, 0])
    with pytest.raises(fn.Unresolved) as error:
        chain(start=(1e12, 0, 0), end=(1e12 + 2 - 1e-4, 0, 0))
    assert error.value.coordinate_m > 1e11


def test_systems_are_refused_by_name():
    joints = {"A": {"at_m": [0, 0, 0]}, "B": {"at_m": [9, 0, 0]}, "P": {"mass_kg": 1}, "Q": {"mass_kg": 1}}
    bars = [{"from": "A", "to": "P", "length_m": 1, "mass_kg": 1}, {"from": "P", "to": "B", "length_m": 1, "mass_kg": 1}]
    data = {"joints": joints, "bars": bars}
    with pytest.raises(fn.Unconnected) as error:
        fn.System.from_dict(data)
    assert error.value.name == "Q" and error.value.file == "dict"
    del joints["Q"]
    with pytest.raises(fn.OutOfReach) as error:
        fn.System.from_dict(data)
    assert (error.value.from_joint, error.value.to_joint, error.value.span_m) == ("A", "B", 9.0)
    del joints["B"]
    with pytest.raises(fn.FileError) as error:
        fn.System.from_dict(data)
    assert error.value.key == "bars[2].to" and "B" in str(error.value)
    with pytest.raises(fn.Falls):
        fn.System.from_arrays(
            joints=4, anchors={0: (0, 0, 0)}, bars=[[0, 1], [2, 3]], lengths=[1, 1], masses=1.0
        )
    with pytest.raises(fn.NothingMoves):
        anchors = {0: (0, 0, 0), 1: (1, 0, 0)}
        fn.System.from_arrays(joints=2, anchors=anchors, bars=[[0, 1]], lengths=[1], masses=1.0)


def test_places_in_texts_and_files(tmp_path):
    with pytest.raises(fn.FileError) as error:
        fn.System.from_toml("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0]\n")
    assert (error.value.line, error.value.column, error.value.key) == (3, 9, "anchors.end_m")
    assert "vector" in error.value.help
    with pytest.raises(fn.FileError):
        fn.System.read(tmp_path / "missing.toml")
    with pytest.raises(fn.FileError):
        fn.System.read(tmp_path)
    with pytest.raises(fn.FileError):
        fn.System.from_dict({"anchors": {"start_m": [float("nan"), 0, 0]}})
    with pytest.raises(fn.FileError):
        fn.System.from_dict({"joints": {"A": object()}})
    circle = {}
    circle["joints"] = circle
    with pytest.raises(fn.FileError):
        fn.System.from_dict(circle)
    with pytest.raises(fn.UnknownCase) as error:
        fn.System.case("three-equal-bar")
    assert error.value.suggestion == "three-equal-bars"
    assert "did you mean `three-equal-bars`?" in str(error.value)
    with pytest.raises(fn.InputError, match="did you mean `lamp`"):
        fn.System.case("lamp").solve().joint("lmap")
    with pytest.raises(fn.FileError, match=r"System\.case\('lamp'\)"):
        fn.solve("lamp")


def test_every_question_takes_a_path(tmp_path):
    path = tmp_path / "v.toml"
    path.write_text(fn.System(lengths=[1, 1], masses=[1, 1], end=(1, 0, 0)).to_toml())
    vary = "anchors.end_m.x=1,1.5"
    asked = {
        "solve": lambda of: fn.solve(of),
        "study": lambda of: fn.study(of, vary).data,
        "trace": lambda of: fn.trace(of, vary).data["traces"],
        "census": lambda of: fn.census(of).complete,
        "modes": lambda of: fn.modes(of)[0].omega2_s2.tolist(),
        "gradient": lambda of: fn.gradient(of, "joints.1.at_m.z").data,
        "change": lambda of: fn.change(of, "bars.1.length_m").data,
        "anchor_stiffness": lambda of: len(fn.anchor_stiffness(of)),
        "basins": lambda of: fn.basins(of, size=4).outcome("energy").tolist(),
        "sweep": lambda of: fn.sweep(of, seeds=10).data["seeds"],
        "simulate": lambda of: fn.simulate(of, time=0.01).joints_m.tolist(),
        "judge": lambda of: fn.judge(of, fn.solve(of).joints_m).confirmed,
    }
    for name, ask in asked.items():
        by_path, by_text, by_system = ask(path), ask(str(path)), ask(fn.System.read(path))
        if name != "solve":
            assert by_path == by_text == by_system, name
        for wrong in (7, None, {}):
            with pytest.raises(fn.InputError):
                ask(wrong)


@pytest.mark.parametrize(
    "wrong",
    [
        {"lengths": [1.0, float("nan")]},
        {"lengths": [1.0, -1.0]},
        {"lengths": [1.0, float("inf")]},
        {"lengths": []},
        {"lengths": [[1.0, 1.0]]},
        {"lengths": ["a", "b"]},
        {"lengths": [1 + 2j, 1]},
        {"lengths": [[1.0], [1.0, 2.0]]},
        {"lengths": None},
        {"lengths": "12"},
        {"lengths": {1: 2}},
        {"lengths": [10**400, 1]},
        {"lengths": np.array([1.0, 1.0], dtype=np.longdouble)},
        {"lengths": np.array([True, True])},
        {"lengths": np.array(["2020-01-01"], dtype="datetime64[D]")},
        {"lengths": [1e308, 1e308]},
        {"masses": [1.0, -1.0]},
        {"masses": [1.0, 1.0, 1.0]},
        {"masses": [1e-320, 0.0]},
        {"end": (1.0, 0.0)},
        {"end": (np.nan, 0.0, 0.0)},
        {"end": 1.0},
        {"start": (np.inf, 0.0, 0.0)},
        {"gravity": 0.0},
        {"gravity": "9.81"},
        {"gravity": [9.81]},
        {"centres": [0.5]},
        {"centres": [0.5, 2.0]},
        {"inertias": [[0, 1], [0, 1]]},
        {"inertias": [[0, -1, 1], [0, 1, 1]]},
        {"name": 7},
        {"name": "\ud800"},
    ],
    ids=repr,
)
def test_wrong_numbers_are_refused(wrong):
    with pytest.raises(fn.Error) as error:
        chain(**wrong)
    assert isinstance(error.value, ValueError) and str(error.value)


def test_numbers_of_any_type_and_order_are_read():
    expected = chain(lengths=[1.0, 2.0, 2.0], masses=[1.0, 2.0, 3.0]).to_toml()
    for lengths in (
        (1, 2, 2),
        np.array([1, 2, 2], dtype=np.int8),
        np.array([1, 2, 2], dtype=np.float32),
        np.array([1, 2, 2], dtype=">f8"),
        np.array([1, 0, 2, 0, 2.0])[::2],
        np.array([2, 2, 1.0])[::-1],
        np.asfortranarray([[1.0, 9], [2, 9], [2, 9]])[:, 0],
        np.ma.masked_array([1.0, 2.0, 2.0]),
        np.frombuffer(b"x" + np.array([1.0, 2.0, 2.0]).tobytes(), dtype=np.uint8)[1:].view(np.float64),
    ):
        if isinstance(lengths, np.ndarray):
            lengths.flags.writeable = False
        assert chain(lengths=lengths, masses=[1, 2, 3]).to_toml() == expected


def test_words_and_settings():
    system = chain()
    for setting in ({"solver": "newton"}, {"census": "maybe"}, {"equations": "none"}, {"threads": -1}, {"threads": 0.5}):
        with pytest.raises(fn.SettingError):
            system.solve(**setting)
    with pytest.raises(fn.SettingError):
        system.solve(threads=5000)
    for threads in (5000, -1, "two"):
        with pytest.raises(fn.SettingError):
            fn.set_threads(threads)
    with pytest.raises(fn.SettingError):
        fn.limit_work(0)
    with pytest.raises(fn.SettingError):
        system.solve(progress=3)
    with pytest.raises(fn.ParameterError) as error:
        system.trace("anchors.end_m.q=0..1:3")
    assert error.value.help
    with pytest.raises(fn.SettingError):
        system.simulate(time=-1)
    with pytest.raises(fn.SettingError):
        system.simulate(time=1e9, step=1e-6, store=1e-6)
    with pytest.raises(fn.ShapeError):
        fn.System.from_arrays(joints=10**15, anchors={0: (0, 0, 0)}, bars=[[0, 1]], lengths=[1])
    with pytest.raises(fn.SettingError):
        system.simulate(order=3)
    with pytest.raises(fn.SettingError):
        system.simulate(start="nowhere")
    with pytest.raises(fn.SettingError):
        system.simulate(pushes={"Z": (0, 0, 1)})
    with pytest.raises(fn.MotionError):
        system.simulate(start=np.zeros((3, 3)))
    with pytest.raises(fn.SettingError):
        system.sweep(10.5)
    with pytest.raises(fn.ChainsOnly):
        fn.System.case("footbridge").sweep(10, spread="sobol")
    with pytest.raises(fn.NoCensus):
        fn.System(lengths=np.ones(40), masses=1.0 * np.ones(40), end=(20, 0, 0)).census()
    with pytest.raises(fn.InputError):
        fn.solve()
    with pytest.raises(fn.InputError):
        fn.solve(system, lengths=[1, 1])


def test_joints_and_words_of_arrays_are_checked():
    v = {"anchors": {0: (-3, 0, 0), 1: (3, 0, 0)}, "bars": [[0, 2], [2, 1]], "lengths": [5, 5], "joint_masses": {2: 2.0}}
    named = fn.System.from_arrays(joints=np.array(["A", "B", "P"]), **v)
    assert named.joint_names == ["A", "B", "P"]
    for wrong in (
        {"anchors": {0: (-3, 0, 0), "A": (3, 0, 0)}},
        {"anchors": [(-3, 0, 0), (3, 0, 0)]},
        {"kinds": None},
        {"joint_masses": {"P": 1, 2: 3}},
        {"gravity": "9.8"},
    ):
        with pytest.raises(fn.ShapeError):
            fn.System.from_arrays(joints=["A", "B", "P"], **{**v, **wrong})
    with pytest.raises(fn.ShapeError):
        named.study({"bars.1.length_m": 3})
    with pytest.raises(fn.InputError) as error:
        fn.solve(named.to_toml())
    assert "from_toml" in error.value.help


def test_text_that_would_steer_a_terminal_is_shown_escaped():
    nasty = "\x1b]0;X\x07\x1b[2J\u202e"
    with pytest.raises(fn.FileError) as error:
        fn.System.from_toml(f'name = "a"\n[joints]\nA = {{ at_m = [0, 0, 0] }}\n"{nasty[-1]}x" = 3\n', name=nasty)
    for text in (str(error.value), error.value.file):
        assert not any(c in text for c in "\x1b\x07\u202e") and "u{1b}" in text
    joints = {"A\x1b[2J": {"at_m": [0, 0, 0]}, "B": {"at_m": [9, 0, 0]}, "P": {"mass_kg": 1}}
    bars = [{"from": "A\x1b[2J", "to": "P", "length_m": 1, "mass_kg": 1}]
    bars.append({"from": "P", "to": "B", "length_m": 1, "mass_kg": 1})
    with pytest.raises(fn.OutOfReach) as error:
        fn.System.from_dict({"joints": joints, "bars": bars})
    assert "\x1b" not in str(error.value) + error.value.from_joint
    bars[0]["length_m"] = 9
    system = fn.System.from_dict({"name": nasty, "joints": joints, "bars": bars})
    for shown in (repr(system), repr(system.solve())):
        assert "\x1b" not in shown and "\u202e" not in shown


def test_errors_travel():
    with pytest.raises(fn.OutOfReach) as error:
        chain(end=(3.5, 0, 0))
    again = pickle.loads(pickle.dumps(error.value))
    assert type(again) is fn.OutOfReach and again.span_m == 3.5 and str(again) == str(error.value)
    with pytest.raises(AttributeError):
        _ = error.value.nonsense
