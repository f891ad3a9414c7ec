//! A system that is changed while it is looked at (`funicular serve`): the text, and what is shown.

use funicular::live::{Ask, Live};
use serde_json::{Value, json};

use crate::run::refused;

fn asked(question: &Value) -> Live {
    serde_json::from_value::<Ask>(question.clone()).unwrap().run()
}

fn place(live: &Live, joint: usize) -> [f64; 3] {
    let data = live.data.as_ref().unwrap_or_else(|| panic!("{:?}", live.error));
    let part = |k: usize| data["shapes"][0]["x"][3 * joint + k].as_f64().unwrap();
    [0, 1, 2].map(|k| part(k) + data["reference"][k].as_f64().unwrap())
}

/// A lamp of 10 kg on two cables, 3-4-5, in all the ways in which tables are written.
const LAMPS: [&str; 3] = [
    "gravity_m_s2 = 10 # here\njoints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 10 } }\n\
     bars = [{ from = \"A\", to = \"P\", length_m = 5, mass_kg = 0, kind = \"cable\" },\n\
             { from = \"B\", to = \"P\", length_m = 5, mass_kg = 0, kind = \"cable\" }]\n",
    "gravity_m_s2 = 10 # here\n[joints]\nA = { at_m = [-3, 0, 0] } # left\nB.at_m = [3, 0, 0]\nP = { mass_kg = 10 }\n\
     [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n\
     [[bars]]\nfrom = \"B\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n",
    "gravity_m_s2 = 10 # here\n[joints.A]\nat_m = [-3, 0, 0] # left\n[joints.B]\nat_m = [3, 0, 0]\n[joints.P]\nmass_kg = 10\n\
     [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n\
     [[bars]]\nfrom = \"B\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n",
];

#[test]
fn a_file_is_changed_as_it_is_written() {
    for text in LAMPS {
        let moved = asked(&json!({
            "text": text, "quick": true, "change": { "joint": { "name": "B", "at_m": [5, 0, 0] } },
        }));
        assert!(
            moved.text.contains("# here") && moved.text.contains("[5.0, 0.0, 0.0]"),
            "{}",
            moved.text
        );
        assert_eq!(moved.text.contains("# left"), text.contains("# left"));
        let [x, _, z] = place(&moved, 2);
        assert!((x - 1.0).abs() < 1e-5 && (z + 3.0).abs() < 1e-5, "{x} {z}");
        // A rope that is shorter than the cables takes all: 100 N / (2 cos), cos = (4.5^2 - 3^2)^0.5 / 4.5.
        let rope = asked(&json!({ "text": text, "change": { "member": {
            "from": "A", "to": "B", "via": ["P"], "kind": "cable", "length_m": 9 } } }));
        let data = rope.data.as_ref().unwrap();
        let tension = data["shapes"][0]["axial"][2].as_f64().unwrap();
        let wanted = 50.0 / (1.0 - (3.0_f64 / 4.5).powi(2)).sqrt();
        assert!((tension - wanted).abs() < 1e-4 * wanted, "{tension}");
        assert!(rope.words.contains("agree") && data["names"][2] == "P", "{}", rope.words);
        // A joint that is not there yet, then what holds it.
        let added =
            asked(&json!({ "text": text, "change": { "joint": { "name": "Q", "mass_kg": 5 } } }));
        assert!(added.error.as_ref().unwrap().contains("no member meets joint \"Q\""), "{added:?}");
        let hung = asked(&json!({ "text": added.text, "change": { "member": {
            "from": "P", "to": "Q", "kind": "bar", "length_m": 2 } } }));
        let names = hung.data.as_ref().unwrap()["names"].as_array().unwrap();
        let added = names.iter().position(|name| name == "Q").unwrap();
        assert!((place(&hung, added)[2] + 6.0).abs() < 1e-5, "{hung:?}");
        assert!(hung.data.unwrap()["shapes"][0]["rungs"].as_array().unwrap().len() >= 4);
    }
}

#[test]
fn a_chain_has_joints_by_number() {
    let text = "gravity_m_s2 = 10\nanchors = { start_m = [-3, 0, 0], end_m = [3, 0, 0] }\n\
                bars = [{ length_m = 5, mass_kg = 1e-9, count = 2 }]\n";
    let ends = [("0", [-5.0, 0.0, 0.0], -1.0), ("2", [5.0, 0.0, 0.0], 1.0)];
    for (name, at_m, middle) in ends {
        let moved = asked(
            &json!({ "text": text, "quick": true, "change": { "joint": { "name": name, "at_m": at_m } } }),
        );
        let [x, _, z] = place(&moved, 1);
        assert!((x - middle).abs() < 1e-5 && (z + 3.0).abs() < 1e-5, "{x} {z}");
    }
    let loaded =
        asked(&json!({ "text": text, "change": { "joint": { "name": "1", "mass_kg": 10 } } }));
    let tension = loaded.data.as_ref().unwrap()["shapes"][0]["axial"][0].as_f64().unwrap();
    assert!(loaded.text.contains("loads") && (tension - 62.5).abs() < 1e-3, "{tension}");
    let wrong =
        asked(&json!({ "text": text, "change": { "joint": { "name": "P", "mass_kg": 10 } } }));
    assert_eq!(wrong.error.as_deref(), Some("a chain has no joint \"P\""));
    assert_eq!(wrong.text, text);
}

/// The hand is where the joint can be: it is there but for the spring. Elsewhere the joint comes as near as it can.
#[test]
fn a_free_joint_follows_the_hand() {
    let text = LAMPS[1];
    let near_m = json!([[-3, 0, 0], [3, 0, 0], [0, 0, -4]]);
    for (hand, wanted) in
        [([1.0, 0.0, -2.5], [1.0, 0.0, -2.5]), ([0.0, 0.0, -9.0], [0.0, 0.0, -4.0])]
    {
        let held = asked(&json!({
            "text": text, "quick": true, "near_m": near_m, "held": { "joint": "P", "at_m": hand },
        }));
        let found = place(&held, 2);
        let off = (0..3).map(|k| (found[k] - wanted[k]).powi(2)).sum::<f64>().sqrt();
        assert!(off < 0.03, "{found:?}");
        let data = held.data.as_ref().unwrap();
        assert_eq!(
            (data["names"].as_array().unwrap().len(), data["bars"].as_array().unwrap().len()),
            (3, 2)
        );
        assert_eq!(held.text, text);
    }
}

#[test]
fn what_is_wrong_is_said() {
    let error = |question: Value| asked(&question).error.unwrap();
    assert!(error(json!({ "text": "x =" })).contains("the file:1"));
    assert!(
        error(json!({ "text": "x =", "change": { "joint": { "name": "A" } } })).contains("TOML")
    );
    let many = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\nbars = [{ length_m = 1, mass_kg = 1, count = 2001 }]";
    assert!(error(json!({ "text": many })).starts_with("2001 members"));
    let rope = format!(
        "joints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ mass_kg = 1 }} }}\nbars = [{{ from = \"A\", to = \"P\", \
         length_m = 999, kind = \"cable\", via = [{}] }}]",
        "\"P\", \"A\", ".repeat(60)
    );
    assert!(error(json!({ "text": rope })).contains("121 spans"));
    let file = "bars_file = \"/etc/passwd\"\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }";
    assert!(error(json!({ "text": file })).contains("bars_file"));
    assert!(
        error(json!({ "text": LAMPS[0], "held": { "joint": "X", "at_m": [0, 0, 0] } }))
            .contains("no joint \"X\"")
    );
    let unknown = serde_json::from_value::<Ask>(json!({ "text": "", "file": "/etc/passwd" }));
    assert!(unknown.unwrap_err().to_string().contains("unknown field"));
}

/// The page holds nothing that ends its script, begins with the file, and can be kept without the program.
#[test]
fn the_page_begins_with_the_file() {
    let text = LAMPS[0].replace("P = ", "\"</script>\" = ").replace("\"P\"", "\"</script>\"");
    let page = Ask::new(text.clone()).page(false);
    assert!(page.contains("id=\"file\"") && page.matches("</script>").count() == 2);
    let kept = |text: &str| {
        let question = json!({ "text": text }).to_string();
        Ask::answer("page", question.as_bytes()).unwrap()
    };
    let page = kept(&text).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && !page.contains("id=\"file\""));
    assert!(!page.contains("fetch(") && kept("x =").is_err());
    assert!(Ask::answer("file", b"").is_none());
    let wrong = Ask::new("x =").page(true);
    assert!(wrong.contains("\"error\":\""));
}

#[test]
fn bad_input_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let table: [(&[&str], _); 2] =
        [(&["absent.toml"], "absent.toml"), (&["--port", "70000"], "--port")];
    refused(&folder, &["serve"], &table);
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    refused(&folder, &["serve"], &[(&["--port", &port], &port)]);
}
