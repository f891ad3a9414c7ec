"""Files for other programs, read by those programs: meshio, ezdxf, trimesh, MuJoCo; pictures by matplotlib and pypdf."""

import xml.etree.ElementTree as ET

import ezdxf
import funicular as fn
import meshio
import mujoco
import numpy as np
import pypdf
import pytest
import trimesh
from matplotlib.image import imread


def written(tmp_path, answer, ending):
    path = tmp_path / f"shape.{ending}"
    answer.save(path)
    return str(path)


def test_a_grid_for_paraview(tmp_path):
    answer = fn.System.case("geiger-dome").solve()
    mesh = meshio.read(written(tmp_path, answer, "vtu"))
    assert np.array_equal(mesh.points, answer.joints_m)
    assert np.array_equal(mesh.cells_dict["line"], answer.system.member_joints)
    assert np.array_equal(np.ravel(mesh.cell_data["axial_n"][0]), answer.axial_n)
    assert np.array_equal(mesh.point_data["reaction_n"], answer.reactions_n)


def test_a_motion_for_paraview(tmp_path):
    motion = fn.System.case("lamp").simulate(pushes={"lamp": (0.3, 0.2, 0)}, time=0.5, step=0.01, store=0.1)
    motion.save(tmp_path / "motion.pvd")
    stored = ET.parse(tmp_path / "motion.pvd").findall("Collection/DataSet")
    assert np.array_equal([float(entry.get("timestep")) for entry in stored], motion.time_s)
    for k, entry in enumerate(stored):
        grid = meshio.read(tmp_path / entry.get("file"))
        assert np.array_equal(grid.points, motion.joints_m[k])
        assert np.array_equal(grid.point_data["velocity_m_s"], motion.velocities_m_s[k])
        assert np.array_equal(np.ravel(grid.cell_data["axial_n"][0]), motion.axial_n[k])
        told = {name: float(np.ravel(values)[0]) for name, values in grid.field_data.items()}
        assert told == {
            "TimeValue": motion.time_s[k],
            "kinetic_j": motion.kinetic_j[k],
            "potential_j": motion.potential_j[k],
            "energy_j": motion.energy_j[k],
        }
    with pytest.raises(FileExistsError, match="is not empty"):
        motion.save(tmp_path / "motion.pvd")
    with pytest.raises(fn.SettingError, match="must end in .pvd or .html"):
        motion.save(tmp_path / "motion.xyz")
    motion.save(tmp_path / "motion.html")
    assert (tmp_path / "motion.html").read_text(encoding="utf-8") == motion.html()


def test_pictures(tmp_path):
    answer = fn.System.case("pratt-truss").solve()
    drawing = ET.fromstring(answer.svg())
    width, height = float(drawing.get("width")), float(drawing.get("height"))
    # Two pixels to one; white, with the blue of tension and the black of letters.
    pixels = np.rint(255 * imread(written(tmp_path, answer, "png"))).astype(int)
    assert pixels.shape[:2] == (round(2 * height), round(2 * width))
    colours, counts = np.unique(pixels.reshape(-1, pixels.shape[2])[:, :3], axis=0, return_counts=True)
    found = {tuple(colour): count for colour, count in zip(colours.tolist(), counts.tolist())}
    assert max(found, key=found.get) == (255, 255, 255)
    assert min(found[0x00, 0x72, 0xB2], found[0, 0, 0]) > 100
    page = pypdf.PdfReader(written(tmp_path, answer, "pdf")).pages[0]
    assert np.allclose([page.mediabox.width, page.mediabox.height], [0.75 * width, 0.75 * height])
    words = page.extract_text()
    texts = ["".join(text.itertext()) for text in drawing.iter("{http://www.w3.org/2000/svg}text")]
    assert len(texts) > 10 and all(text in words for text in texts)
    assert any("\N{MINUS SIGN}" in text for text in texts)
    answer.svg().save(tmp_path / "drawing.svg")
    assert (tmp_path / "drawing.svg").read_text(encoding="utf-8") == answer.svg()
    flat = ezdxf.readfile(written(tmp_path, answer.svg(), "dxf"))
    assert not flat.audit().has_errors
    letters = [ezdxf.decode_dxf_unicode(text.dxf.text) for text in flat.modelspace().query("TEXT")]
    assert sorted(letters) == sorted(texts)
    # Every member in tension is a line of its blue.
    blue = [line for line in flat.modelspace().query("POLYLINE") if line.dxf.layer == "0072b2"]
    assert len(blue) >= np.count_nonzero(answer.axial_n > 1e-6 * np.abs(answer.axial_n).max())
    basins = fn.basins(fn.System.case("two-bars"), size=4).svg("energy")
    assert basins.png().startswith(b"\x89PNG") and basins.pdf().startswith(b"%PDF-")
    with pytest.raises(fn.SettingError, match="one of svg, png, pdf, dxf"):
        basins.save(tmp_path / "basins.gif")


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


# P and Q are drawn apart along the floor by a taut cable and a bar, with a slack elastic one between them.
FLOOR = """
floor_m = 0
[joints]
A = { at_m = [0, 0, 2] }
B = { at_m = [5, 0.5, 1.5] }
P = { mass_kg = 1, force_n = [3, 0, 0] }
Q = { mass_kg = 2, force_n = [-5, 0, 0] }
[[bars]]
from = "A"
to = "P"
length_m = 2.2
mass_kg = 0.3
kind = "cable"
[[bars]]
from = "P"
to = "Q"
length_m = 2.5
mass_kg = 0.2
kind = "cable"
stiffness_n = 3000
[[bars]]
from = "Q"
to = "B"
length_m = 2.4
mass_kg = 0.7
"""
CASES = [case for case in fn.cases() if len(fn.System.case(case).joint_names) <= 32]


@pytest.mark.parametrize("case", CASES)
def test_our_equilibrium_is_at_rest_in_mujoco(tmp_path, case):
    model = mujoco.MjModel.from_xml_path(written(tmp_path, fn.System.case(case).solve(), "xml"))
    # Largest today 6e-9 m, of the chain that is nearly taut.
    assert moved(model) < 1e-6
    # A tenth more of gravity is more than the prestressed nets and trusses move by, but not than what hangs.
    if case in ("three-equal-bars", "ring-on-a-rope", "tackle"):
        model.body_gravcomp[-1] -= 0.1
        model.opt.gravity[0] = 1.0
        assert moved(model) > 1e-6


def test_what_lies_on_the_floor_lies_there_in_mujoco(tmp_path):
    answer = fn.System.from_toml(FLOOR).solve()
    assert np.abs(answer.joints_m[2:, 2]).max() < 1e-12
    # The cable leans by sqrt(2.2^2 - 2^2) to 2.2 under 3 N, the bar by sqrt(2.4^2 - 1.5^2) to 2.4 under 5 N.
    told = [3 * 2.2 / 0.84**0.5, 0, 5 * 2.4 / 3.51**0.5]
    assert np.abs(answer.axial_n - told).max() < 1e-9
    model = mujoco.MjModel.from_xml_path(written(tmp_path, answer, "xml"))
    assert moved(model) < 1e-6
    # Without the floor they fall g t^2/2 in 0.2 s, less what the members hold.
    model.geom_contype[:] = model.geom_conaffinity[:] = 0
    assert moved(model) > 1e-2


def test_links_hang_at_our_rest_and_swing_at_our_frequencies(tmp_path):
    system = fn.System.from_toml(
        """
        joints = { A = { at_m = [0.3, -0.2, 5] }, P = { mass_kg = 0.4 }, Q = { mass_kg = 1.1 }, R = {} }
        bars = [
          { from = "P", to = "A", length_m = 1, mass_kg = 2, centre_m = 0.3, inertia_kg_m2 = [0, 0.25, 0.25] },
          { from = "P", to = "Q", length_m = 0.7, mass_kg = 0.5 },
          { from = "P", to = "R", length_m = 0.45, mass_kg = 0.9 },
        ]
        """
    )
    answer = system.solve()
    model = mujoco.MjModel.from_xml_path(written(tmp_path, answer, "urdf"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    # Links begin at P, A's other end, but for the first, which begins at A.
    assert np.abs(data.xpos[1:] - answer.joints_m[[0, 1, 1]]).max() < 1e-12
    assert moved(model) < 1e-6

    def pull(turn):
        mujoco.mj_resetData(model, data)
        mujoco.mj_integratePos(model, data.qpos, turn, 1.0)
        mujoco.mj_forward(model, data)
        return data.qfrc_bias.copy()

    # Bars do not turn about themselves; the others are the level axes of the three ball joints.
    level = [k for k in range(model.nv) if k % 3 != 2]
    step = 1e-5
    stiffness = np.array([(pull(step * e) - pull(-step * e)) / (2 * step) for e in np.eye(model.nv)])[np.ix_(level, level)]
    mass = np.zeros((model.nv, model.nv))
    pull(np.zeros(model.nv))
    mujoco.mj_fullM(model, data, mass)
    omega2 = np.sort(np.linalg.eigvals(np.linalg.solve(mass[np.ix_(level, level)], stiffness)).real)
    told = np.sort(system.modes()[0].omega2_s2)
    assert np.abs(omega2 - told).max() < 1e-6 * told.max()


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
