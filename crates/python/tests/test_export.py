"""Files for other programs, read by those programs: meshio, ezdxf, trimesh, MuJoCo."""

import ezdxf
import funicular as fn
import meshio
import mujoco
import numpy as np
import pytest
import trimesh


def written(tmp_path, answer, ending):
    path = tmp_path / f"shape.{ending}"
    path.write_text(answer.export(ending))
    return str(path)


def test_a_grid_for_paraview(tmp_path):
    answer = fn.System.case("geiger-dome").solve()
    mesh = meshio.read(written(tmp_path, answer, "vtu"))
    assert np.array_equal(mesh.points, answer.joints_m)
    assert np.array_equal(mesh.cells_dict["line"], answer.system.member_joints)
    assert np.array_equal(np.ravel(mesh.cell_data["axial_n"][0]), answer.axial_n)
    assert np.array_equal(mesh.point_data["reaction_n"], answer.reactions_n)


def test_a_drawing_for_cad(tmp_path):
    answer = fn.System.case("x-cross").solve()
    drawing = ezdxf.readfile(written(tmp_path, answer, "dxf"))
    assert not drawing.audit().has_errors
    lines = drawing.modelspace().query("LINE")
    ends = np.array([[line.dxf.start, line.dxf.end] for line in lines])
    assert np.array_equal(ends, answer.joints_m[np.array(answer.system.member_joints)])
    assert sorted(line.dxf.layer for line in lines) == ["cables"] * 4 + ["struts"] * 2
    assert {text.dxf.text for text in drawing.modelspace().query("TEXT")} == set(answer.system.joint_names)


@pytest.mark.parametrize("ending", ["obj", "gltf"])
def test_solids(tmp_path, ending):
    answer = fn.System.case("prism").solve()
    solid = trimesh.load(written(tmp_path, answer, ending), force="mesh")
    solid.merge_vertices()
    assert solid.is_watertight and solid.volume > 0
    size = np.ptp(answer.joints_m, axis=0)[[0, 2, 1] if ending == "gltf" else [0, 1, 2]]
    assert np.all(np.abs(solid.extents - size) < 0.05 * size.max())


def moved(model):
    """How far the bodies are after 0.2 s, m."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    start = data.xpos.copy()
    for _ in range(2000):
        mujoco.mj_step(model, data)
    return np.abs(data.xpos - start).max()


CASES = [
    "three-equal-bars", "propped", "bridle", "mobile", "footbridge", "pendulum-chain", "four-bar-linkage", "prism",
    "pratt-truss", "lattice-tower", "geiger-dome", "ring-on-a-rope", "tackle",
]  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_our_equilibrium_is_at_rest_in_mujoco(tmp_path, case):
    model = mujoco.MjModel.from_xml_path(written(tmp_path, fn.System.case(case).solve(), "xml"))
    # Largest today 4e-11 m.
    assert moved(model) < 1e-6
    # A tenth more of gravity is more than the prestressed nets and trusses move by, but not than what hangs.
    if case in ("three-equal-bars", "ring-on-a-rope", "tackle"):
        model.body_gravcomp[-1] -= 0.1
        model.opt.gravity[0] = 1.0
        assert moved(model) > 1e-6


def test_what_a_format_does_not_have_is_refused():
    answer = fn.System.case("lamp").solve()
    with pytest.raises(fn.InputError, match="MoorDyn has no line that does not stretch"):
        answer.export("txt")
    with pytest.raises(fn.SettingError, match="ending must be one of vtu"):
        answer.export("step")


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
def test_a_drawing_of_another_program_is_read(tmp_path, version):
    drawing = ezdxf.new(version, units=ezdxf.units.CM)
    model = drawing.modelspace()
    places = [(0, 0, 0), (400, 0, 0), (0, 300, 0), (100, 50, 250)]
    for place in places[:3]:
        model.add_point(place, dxfattribs={"layer": "Anchors"})
    model.add_polyline3d([places[0], places[3], places[1]], dxfattribs={"layer": "struts"})
    model.add_line(places[2], places[3], dxfattribs={"layer": "CABLES"})
    model.add_circle((0, 0), 5)
    path = tmp_path / f"tripod-{version}.dxf"
    drawing.saveas(path)
    system = fn.System.read(path)
    # R12 has no units.
    scale = 1.0 if version == "R12" else 0.01
    assert system.members["kind"] == ["strut", "strut", "cable"]
    assert np.allclose(system.lengths_m, scale * np.sqrt([75000, 155000, 135000]), rtol=1e-15)
    assert any("1 CIRCLE" in note for note in system.notes)
    again = fn.System.from_toml(system.to_toml())
    assert again == system and again.notes == []
    path.write_text(path.read_text().replace("Anchors", "Points"))
    with pytest.raises(fn.FileError, match="there is no anchor") as caught:
        fn.System.read(path)
    assert "POINT" in caught.value.help
