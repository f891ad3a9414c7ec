//! `funicular page`: what a page shows is what the solvers say.

use funicular::{Page, prelude::*};
use serde_json::Value;

use crate::run::{good, holding, refused, run};

fn data(page: &str) -> Value {
    let data = page.split("application/json\">").nth(1).unwrap().split("</script>").next().unwrap();
    serde_json::from_str(data).unwrap()
}

fn near(found: &Value, wanted: f64) -> bool {
    (found.as_f64().unwrap() - wanted).abs() < 1e-4 * wanted.abs().max(1.0)
}

/// A lamp of 100 N on two ropes, 3-4-5: 62.5 N in each. Its side wind of 75 N makes 125 N of it.
const LAMP: &str = "name = \"lamp </script><b>&\"\ngravity_m_s2 = 10\n\
    joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, \"</script>\" = { mass_kg = 10 } }\n\
    bars = [{ from = \"A\", to = \"</script>\", length_m = 5, mass_kg = 0, strength_n = 250 },\n\
            { from = \"B\", to = \"</script>\", length_m = 5, mass_kg = 0 }]\n\
    [[loads]]\nname = \"wind\"\njoint = \"</script>\"\nforce_n = [0, 75, 0]\n\
    [[cases]]\nname = \"still\"\nfactors = {}\n[[cases]]\nname = \"storm\"\nfactors = { wind = 1 }\n\
    [[cases]]\nname = \"nothing\"\nfactors = { permanent = 0 }\n";

#[test]
fn equilibria_load_cases_modes_and_a_path_of_a_lamp() {
    let problem = Problem::parse(LAMP, "lamp.toml").unwrap();
    let page = Page::new().vary("loads=0.5..2").unwrap().run(&problem).unwrap();
    assert!(page.answer().agrees());
    let html = page.html();
    assert!(html.contains("<title>lamp &lt;/script&gt;&lt;b&gt;&amp;</title>"));
    assert!(!html.contains("http") && html.matches("</script>").count() == 2);
    let data = data(html);
    assert_eq!(data["names"], serde_json::json!(["A", "B", "</script>"]));
    assert_eq!((&data["bars"][1], &data["held"][2]), (&serde_json::json!([1, 2]), &0.into()));
    let shapes = data["shapes"].as_array().unwrap();
    let of = |group: &str, label: &str| {
        let of = |shape: &&Value| {
            shape["group"] == group && shape["label"].as_str().unwrap().starts_with(label)
        };
        shapes.iter().find(of).unwrap_or_else(|| panic!("{group}, {label}"))
    };
    let answer = of("Equilibria", "the answer");
    assert!(near(&answer["axial"][0], 78.125) && near(&answer["used"][0], 0.3125));
    assert!(answer["used"][1].is_null());
    let [y, z] = [7, 8].map(|k| answer["x"][k].clone());
    assert!(near(&y, 2.4) && near(&z, -3.2), "{y} {z}");
    assert!(answer["facts"].as_str().unwrap().contains("Largest tension: 78.125 N"));
    assert!(near(&answer["ground"][0][1][2], 50.0));
    let rung = |name: &str| {
        let rungs = answer["rungs"].as_array().unwrap();
        rungs.iter().find(|rung| rung[1] == name).unwrap()[0].as_bool().unwrap()
    };
    assert!(rung("agreed") && rung("optimal"));
    assert!(near(&of("Load cases", "still")["axial"][0], 62.5));
    assert!(near(&of("Load cases", "storm")["axial"][0], 78.125));
    assert_eq!(shapes.iter().filter(|shape| shape["group"] == "Load cases").count(), 2);
    // A pendulum of 4 m under 12.5 m/s^2 swings across.
    let modes = shapes.iter().find_map(|shape| shape["modes"].as_array()).unwrap();
    assert!(modes.iter().any(|mode| near(&mode["omega2"], 12.5 / 4.0)), "{modes:?}");
    let path = &data["tracks"][0];
    assert_eq!((&path["group"], &path["over"]), (&"Load paths".into(), &"loads".into()));
    let last = path["at"].as_array().unwrap().len() - 1;
    assert!(near(&path["at"][0], 0.5) && near(&path["at"][last], 2.0));
    // Three digits of 156.25 N, and a place to the tenth of a pixel.
    assert_eq!(path["axial"][last][0], 156);
    let unit = path["unit"].as_f64().unwrap();
    let z = path["x"][last][8].as_f64().unwrap() * unit;
    assert!((z + 3.2).abs() <= 0.5 * unit && unit < 1e-3, "{z} {unit}");
    let curve = &path["charts"][0]["curves"][0];
    assert!(curve["stable"][last] == true && curve["x"].as_array().unwrap().len() == last + 1);
    let note = path["note"].as_str().unwrap();
    assert!(note.starts_with("A load path") && note.contains("energy: an equilibrium"), "{note}");
}

/// Under its wind the lamp is a pendulum of 4 m under 12.5 m/s^2, and is pushed along its circle.
#[test]
fn a_motion_of_a_lamp_beside_its_equilibrium() {
    let problem = Problem::parse(LAMP, "lamp.toml").unwrap();
    let push = [0.0, 8.0, 6.0];
    let motion = Simulate::new().time_s(2.0).push("</script>", push);
    let page = Page::new().simulate(motion).run(&problem).unwrap();
    assert_eq!(page.contents(), "1 equilibrium with modes, 2 load cases, 1 motion");
    let data = data(page.html());
    let [ref motion] = data["tracks"].as_array().unwrap()[..] else { panic!("one track") };
    assert!(motion["motion"] == true && motion["over"] == "time / s");
    let curves = motion["charts"][0]["curves"].as_array().unwrap();
    // 10 N s on 10 kg, 1 m/s: 5 J.
    assert!(near(&curves[0]["y"][0], 5.0), "{}", curves[0]["y"][0]);
    let sums = curves[2]["y"].as_array().unwrap();
    assert!(sums.iter().all(|sum| near(sum, sums[0].as_f64().unwrap())));
    let far = &motion["charts"][1]["curves"][0]["y"];
    assert!(far[0].as_f64().unwrap() < 1e-9);
    // Up the circle until it stands 5 J / 125 N higher.
    let most = far.as_array().unwrap().iter().map(|far| far.as_f64().unwrap()).fold(0.0, f64::max);
    let highest = 2.0 * 4.0 * ((1.0_f64 - 0.04 / 4.0).acos() / 2.0).sin();
    assert!((most / highest - 1.0).abs() < 1e-3, "{most} {highest}");
}

/// Where no load path can be followed the shapes of a study stand there, and that they do.
#[test]
fn a_study_where_there_is_no_load_path() {
    // Two bars of 1 m hang as a V; anchors 2.2 m apart are out of reach.
    let v = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
             bars = [{ length_m = 1, mass_kg = 1, count = 2 }]";
    let problem = Problem::parse(v, "v.toml").unwrap();
    let page = Page::new().vary("anchors.end_m.x=0.4..2.2:10").unwrap().run(&problem).unwrap();
    let of_page = data(page.html());
    let study = &of_page["tracks"][0];
    assert_eq!((&study["group"], &study["over"]), (&"Study".into(), &"anchors.end_m.x / m".into()));
    for k in 0..10 {
        let at = 0.4 + 0.2 * f64::from(k);
        let k = usize::try_from(k).unwrap();
        assert!(near(&study["at"][k], at));
        if at > 2.0 - 1e-9 {
            let said = study["events"][k.to_string()].as_str().unwrap();
            assert!(study["x"][k].is_null() && said.starts_with("no shape"), "{said}");
            continue;
        }
        let unit = study["unit"].as_f64().unwrap();
        let z = study["x"][k][5].as_f64().unwrap() * unit;
        assert!((z + (1.0 - 0.25 * at * at).sqrt()).abs() < 1.5 * unit, "{at}: {z}");
    }
    let note = study["note"].as_str().unwrap();
    let told = "at each of 10 values the system is solved by itself. It has a shape at 8 of them, and both solvers agree at 8";
    assert!(note.contains(told) && note.contains("over a range alone"), "{note}");
    // With more bars there are more joints.
    let page = Page::new().vary("bars.1.count=2..4").unwrap().run(&problem).unwrap();
    let of_page = data(page.html());
    let nets = of_page["tracks"][0]["nets"].as_array().unwrap();
    let bars: Vec<_> = nets.iter().map(|net| net["bars"].as_array().unwrap().len()).collect();
    assert_eq!(bars, [2, 3, 4]);
    assert_eq!(of_page["tracks"][0]["x"][2].as_array().unwrap().len(), 3 * 5);
    // A path that begins where nothing hangs is none; a part of its range has shapes.
    let page = Page::new().vary("anchors.end_m.x=2.2..1").unwrap().run(&problem).unwrap();
    let study = &data(page.html())["tracks"][0];
    assert!(study["group"] == "Study" && study["at"].as_array().unwrap().len() == 41);
    assert!(study["x"][0].is_null() && study["x"][40].is_array());
    let nowhere = Page::new().vary("anchors.end_m.x=2.2..3").unwrap().run(&problem);
    assert!(matches!(nowhere, Err(Error::NoShapes(_))));
}

/// A case of the paper has a census: its four equilibria stand beside the answer.
#[test]
fn all_equilibria_of_the_paper() {
    let page = Page::new().run(&Problem::case("three-equal-bars").unwrap()).unwrap();
    let data = data(page.html());
    let census = Census::new().run(&Problem::case("three-equal-bars").unwrap()).unwrap();
    let labels: Vec<&str> = data["shapes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|shape| shape["label"].as_str().unwrap())
        .collect();
    assert_eq!(labels.len(), 1 + 4, "{labels:?}\n{census}");
    assert_eq!(labels.iter().filter(|label| label.contains("unstable")).count(), 2, "{labels:?}");
}

#[test]
fn the_program_writes_a_page_or_says_why_not() {
    let folder = holding([("lamp.toml", LAMP)]);
    let text = good(&folder, &["page", "lamp.toml", "--out", "page.html"]);
    assert_eq!(text, "page.html: 1 equilibrium with modes, 2 load cases; agreed\n");
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    let again = Page::new().run(&Problem::parse(LAMP, "lamp.toml").unwrap()).unwrap();
    assert!(page == again.html());
    let (code, text, _) =
        run(&folder, &["page", "lamp.toml", "--load-case", "storm", "--out", "storm.html"]);
    assert_eq!((code, text.contains("load case")), (Some(0), false), "{text}");
    let table = [
        (&["--out", "a.html", "--vary", "joints.Q.mass_kg=1..2"][..], "Q"),
        (&["--out", "lamp.toml"], "lamp.toml"),
        (&[], "--out"),
        (&["--out", "a.html", "--load-case", "calm"], "no load case"),
        (&["--damping", "1", "--out", "moved.html"], "--motion"),
    ];
    refused(&folder, &["page", "lamp.toml"], &table);
    let nowhere = ["--case", "two-bars", "--vary", "anchors.end_m.x=7,8", "--out", "a.html"];
    refused(&folder, &["page"], &[(&nowhere, "nothing hangs")]);
    assert!(!folder.path().join("a.html").exists());
    let moved = ["--motion", "seed:7", "--time", "2", "--damping", "1"];
    let values = ["--vary", "joints.A.at_m.x=-3..-2", "--out", "moved.html"];
    let text = good(&folder, &[&["page", "lamp.toml"], &moved[..], &values].concat());
    assert!(text.contains("2 load cases, 1 motion, 1 load path; agreed"), "{text}");
    assert_eq!(std::fs::read_to_string(folder.path().join("lamp.toml")).unwrap(), LAMP);
}

/// A net of 144 bars with all its modes, a motion and a load path stays below a megabyte.
#[test]
fn a_page_of_a_hundred_members_is_small() {
    let problem = Problem::case("net").unwrap();
    let motion = Simulate::new().start(Start::Rest).time_s(0.5).push("4-4", [1.0, 0.0, 0.0]);
    let page = Page::new().vary("loads=0.5..2").unwrap().simulate(motion).modes(Modes::new());
    let page = page.run(&problem).unwrap();
    let members = problem.system().members().len();
    assert!(members > 100 && page.html().len() < 1_000_000, "{} for {members}", page.html().len());
}

/// Every case has a picture, a page, its file as it is printed and an answer in which both solvers agree.
#[test]
fn the_gallery_has_every_case() {
    let folder = tempfile::tempdir().unwrap();
    let text = good(&folder, &["cases", "--html", "gallery"]);
    let index = std::fs::read_to_string(folder.path().join("gallery/index.html")).unwrap();
    let (_, list, _) = run(&folder, &["cases"]);
    let names: Vec<&str> =
        index.split("<article id=\"").skip(1).map(|card| card.split('"').next().unwrap()).collect();
    assert!(text.starts_with(&format!("{} cases", names.len())) && names.len() > 30, "{text}");
    for name in names {
        let read = |ending: &str| {
            std::fs::read_to_string(folder.path().join(format!("gallery/{name}.{ending}"))).unwrap()
        };
        assert!(list.contains(&format!(" {name} ")), "{name}");
        assert_eq!(read("toml"), funicular::case_text(name).unwrap());
        assert!(read("html").starts_with("<!DOCTYPE html>") && read("svg").contains("<svg"));
        let answer: Value = serde_json::from_str(&read("json")).unwrap();
        assert_eq!(answer["agreement"]["verdict"], "agreed", "{name}");
    }
    let (code, _, said) = run(&folder, &["cases", "lamp", "--html", "gallery"]);
    assert!(code == Some(2) && said.contains("--html"), "{said}");
    // Files of one's own have the names of cases.
    std::fs::create_dir(folder.path().join("own")).unwrap();
    std::fs::write(folder.path().join("own/lamp.toml"), "mine").unwrap();
    let (code, _, said) = run(&folder, &["cases", "--html", "own"]);
    assert!(code == Some(2) && said.contains("the folder own is not empty"), "{said}");
    assert_eq!(std::fs::read_to_string(folder.path().join("own/lamp.toml")).unwrap(), "mine");
    assert_eq!(std::fs::read_dir(folder.path().join("own")).unwrap().count(), 1);
    let (code, _, said) = run(&folder, &["page", "--case", "lamp", "--out", "lamp.pdf"]);
    assert!(code == Some(2) && said.contains("a page is written as .html, not as .pdf"), "{said}");
}
