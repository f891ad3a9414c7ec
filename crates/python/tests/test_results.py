"""What every result can do besides: dictionaries, JSON, text, plots."""

import json
import math

import funicular as fn
import numpy as np
import pytest
from test_copies import CHAIN, RESULTS

WRITTEN = {name: made for name, made in RESULTS.items() if "system" not in name}


def leaves(value):
    """Everything in dictionaries and lists."""
    if isinstance(value, (dict, list)):
        for entry in value.values() if isinstance(value, dict) else value:
            yield from leaves(entry)
    else:
        yield value


@pytest.mark.parametrize("made", WRITTEN.values(), ids=WRITTEN.keys())
def test_results_are_dictionaries_and_json(made):
    result = made()
    found = result.to_dict()
    assert found and json.loads(result.to_json()) == json.loads(json.dumps(found))
    for value in leaves(found):
        assert value is None or isinstance(value, (str, int, float, bool))
        assert not isinstance(value, float) or math.isfinite(value)


def test_what_is_written_is_what_is_there():
    a = fn.solve(**CHAIN)
    first = a.to_dict()["equilibria"][0]
    assert first["solver"] == "lagrange" and first["joints_m"] == a.joints_m.tolist()
    assert first["evidence"]["rung"] == a.rung
    b = fn.solve_many([[1, 1], [1, 3]], 1.0, (1, 0, 0)).to_dict()
    assert b["energy_j"][1] is None and list(b["failures"]) == ["1"]
    assert a.joints.to_dict()["z_m"] == a.joints_m[:, 2].tolist()


@pytest.mark.parametrize("name", ["answer", "census", "study", "trace", "modes", "sweep", "basins", "judgement", "reproduction"])
def test_results_print_as_the_program_does(name):
    result = RESULTS[name]()
    text = str(result)
    assert len(text.splitlines()) > 1 and text != repr(result)


def test_the_answer_prints_its_numbers():
    # Two bars of 1 m over 1 m: the joint is sqrt(3)/2 deep, each anchor carries one bar.
    text = str(fn.solve(**CHAIN, name="two\x1b[2Jbars"))
    assert "-0.866025" in text and "9.80665" in text and "Agreement: agreed" in text
    assert "\x1b" not in text


def test_tables_print_numbers():
    a = fn.solve(**CHAIN)
    assert a.joints["z_m"][1] < 0.0 and "-0.866025" in repr(a.joints)
    long = fn.Table({"k": np.arange(100), "name": ["x\x1b[2J"] * 100})
    assert "(20 of 100 rows)" in repr(long) and "\x1b" not in repr(long)


def test_basins_count_every_start():
    b = fn.basins(fn.System(**CHAIN), size=6)
    for solver in ("lagrange", "energy"):
        assert b.outcome(solver).shape == b.iterations(solver).shape == (6, 6)
        assert sum(n for s, n in zip(b.table["solver"], b.table["count"]) if s == solver) == 36
        assert b.svg(solver).lstrip().startswith("<?xml") or "<svg" in b.svg(solver)
        assert b.svg(solver) != b.svg(solver, iterations=True)
    # The mirror image of a start leads to the same energy: two bars hang, or stand.
    assert len(b.equilibria) == 2 and b.starts.tolist() == [[30, 90, 150, 210, 270, 330]] * 2
    with pytest.raises(fn.SettingError):
        fn.basins(fn.System(**CHAIN), size=1)
    with pytest.raises(fn.Error):
        fn.basins(fn.System(**CHAIN), bars=(1, 3))
    with pytest.raises(fn.InputError):
        b.outcome("newton")


def test_starts_of_a_system_are_places_of_its_joints():
    # Two cables of 3 m and 4 m, anchors 5 m apart: the lamp hangs at (1.8, 0, -2.4), the only equilibrium.
    lamp = fn.System.case("lamp")
    b = lamp.basins(size=4)
    assert b.labels == ("start of joint lamp: x / m", "start of joint lamp: z / m")
    np.testing.assert_allclose(b.ranges, [[1.8 - 4, 1.8 + 4], [-2.4 - 4, -2.4 + 4]], atol=1e-9)
    assert (b.outcome("energy") == 0).all() and len(b.equilibria) == 1
    assert lamp.basins(size=2, joint="lamp", plane="yz").labels[0] == "start of joint lamp: y / m"
    assert sum(lamp.sweep(20).counts("energy").values()) == 20
    with pytest.raises(fn.Error, match="not a joint that can move"):
        lamp.basins(size=2, joint="A")
    with pytest.raises(fn.Error, match="chains between two anchors"):
        lamp.sweep(20, spread="sobol")


def test_pictures_are_seen_from_where_one_asks():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("Agg")
    answer = fn.System.case("bridle").solve()
    pictures = {answer.svg(view) for view in ("best", "front", "side", "top")}
    assert len(pictures) == 4 and answer.svg() == answer.svg("best")
    for view, (x, y) in {"front": (0, 2), "side": (1, 2), "top": (0, 1)}.items():
        marks = answer.plot(view=view).lines[-1]
        assert np.allclose(marks.get_xdata(), answer.joints_m[:, x]) and np.allclose(marks.get_ydata(), answer.joints_m[:, y])
    for wrong in (lambda: answer.svg("below"), lambda: answer.plot(view="below")):
        with pytest.raises(fn.SettingError, match="below"):
            wrong()
    pyplot.close("all")


def test_plots_have_the_numbers():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("Agg")
    system = fn.System(**CHAIN)
    study = system.study("anchors.end_m.x=0.4..1.6:4")
    sag = study.plot().axes[0].lines[0]
    # A triangle: sqrt(1 - (d/2)^2).
    assert np.allclose(sag.get_ydata(), np.sqrt(1 - (sag.get_xdata() / 2) ** 2))
    with pytest.raises(fn.InputError):
        study.plot("nothing")
    assert len(system.census().plot().axes) == 2
    energies = np.concatenate([line.get_ydata() for line in system.trace("anchors.end_m.x=0.5..1.5:5").plot().lines])
    assert np.nanmin(energies) < 0 < np.nanmax(energies)
    basins = system.basins(size=4)
    assert basins.plot("energy").images[0].get_array().shape == (4, 4)
    assert basins.plot(iterations=True).images[0].get_array().min() >= 0
    modes = system.modes()
    assert len(modes.plot().lines) == 3 * 2
    with pytest.raises(fn.InputError):
        modes.plot(mode=99)
    pyplot.close("all")
