//! `funicular convert`: files that other programs, and this one, read.

use crate::run::run;

/// A lamp of 40 N on two elastic cables of 2.5 and 3.2 m, stretched to the triangle 3, 4, 5: 32 and 24 N.
const LAMP: &str = "name = \"lamp\"\ngravity_m_s2 = 10\n\
    joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [5, 0, 0] }, P = { mass_kg = 4 } }\n\
    bars = [{ from = \"A\", to = \"P\", length_m = 2.5, mass_kg = 0, kind = \"cable\", stiffness_n = 160 },\n\
    { from = \"P\", to = \"B\", length_m = 3.2, mass_kg = 0, kind = \"cable\", stiffness_n = 96 }]\n";

#[test]
fn what_is_written_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("lamp.toml"), LAMP).unwrap();
    for (file, what) in [
        ("lamp.vtu", "an unstructured grid for ParaView"),
        ("lamp.dxf", "a drawing for CAD"),
        ("lamp.obj", "solids for 3D programs"),
        ("lamp.GLTF", "solids for 3D programs"),
        ("lamp.xml", "a model for MuJoCo"),
        ("lamp.txt", "an input file of MoorDyn"),
        ("lamp.json", "a graph for COMPAS"),
    ] {
        let (code, text, said) = run(folder, &["convert", "lamp.toml", "--to", file]);
        assert_eq!((code, text), (Some(0), format!("{file}: {what}; agreed\n")), "{said}");
        assert!(folder.join(file).metadata().unwrap().len() > 200);
    }
    let (code, text, _) = run(folder, &["judge", "lamp.toml", "--answer", "lamp.vtu"]);
    assert_eq!(code, Some(0), "{text}");
    for file in ["lamp.txt", "lamp.json"] {
        let (code, text, said) = run(folder, &["solve", file, "--json"]);
        assert_eq!(code, Some(0), "{said}");
        let answer: serde_json::Value = serde_json::from_str(&text).unwrap();
        let place = |k: usize| answer["equilibria"][0]["joints"][2]["at_m"][k].as_f64().unwrap();
        assert!((place(0) - 1.8).hypot(place(2) + 2.4) < 1e-9, "{file}: {text}");
    }
}

#[test]
fn what_cannot_be_written_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("lamp.toml"), LAMP).unwrap();
    for (arguments, words) in [
        (&["lamp.toml", "--to", "lamp.step"][..], "there are .vtu, .dxf"),
        (&["lamp.toml", "--to", "lamp"], "no format has the ending of lamp"),
        (&["lamp.toml", "--to", "lamp.toml"], "no format"),
        (&["--case", "lamp", "--to", "out.txt"], "MoorDyn has no line that does not stretch"),
        (&["lamp.toml"], "--to"),
    ] {
        let (code, _, said) = run(folder, &[&["convert"], arguments].concat());
        assert_eq!(code, Some(2), "{arguments:?}: {said}");
        assert!(said.contains(words), "{said}");
    }
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 1);
    assert_eq!(std::fs::read_to_string(folder.join("lamp.toml")).unwrap(), LAMP);
}
