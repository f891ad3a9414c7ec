//! Strengths in system files: read, refused, and written back.

use model::system::{Strength, System};
use model::system_file::{Described, parse, write_network};

use crate::support::{Folder, refused_at, system};

fn chain(root: &str, first: &str, second: &str) -> String {
    format!(
        "{root}\nanchors = {{ start_m = [0, 0, 0], end_m = [2, 0, 0] }}\n\
         bars = [{{ length_m = 1, mass_kg = 1, count = 2{first} }}, {{ length_m = 2, mass_kg = 1{second} }}]"
    )
}

fn net(root: &str, first: &str, second: &str) -> String {
    format!(
        "{root}\njoints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [2, 0, 0] }}, P = {{}} }}\n\
         bars = [{{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 1, count = 2{first} }}, \
         {{ from = \"P\", to = \"B\", length_m = 2, mass_kg = 1{second} }}]"
    )
}

fn strengths(system: &System) -> Vec<Option<Strength>> {
    system.members().iter().map(|member| member.strength.as_deref().copied()).collect()
}

#[test]
fn every_bar_has_its_own_and_what_the_file_wants_of_all() {
    let strength = |tension_n, compression_n, safety| {
        Some(Strength::new(tension_n, compression_n, safety).unwrap())
    };
    for file in [chain as fn(&str, &str, &str) -> String, net] {
        let read = |root, first, second| strengths(&system(&file(root, first, second)));
        let pair = strength(Some(70.0), None, 1.0);
        assert_eq!(read("", ", strength_n = 70", ""), [pair, pair, None]);
        let pair = strength(None, Some(50.0), 3.0);
        let last = strength(Some(9.0), Some(8.0), 4.0);
        let second = ", strength_n = 9, compression_n = 8, safety = 4";
        assert_eq!(read("safety = 3", ", compression_n = 50", second), [pair, pair, last]);
        // π²/l² EI: of the bar of 2 m a quarter of that of 1 m.
        let bending = ", bending_n_m2 = 3";
        let euler_n = |length_m: f64| 3.0 * (std::f64::consts::PI / length_m).powi(2);
        let [short, long] = [1.0, 2.0].map(|l| strength(None, Some(euler_n(l)), 1.0));
        assert_eq!(read("", bending, bending), [short, short, long]);
    }
}

#[test]
fn what_is_written_reads_back() {
    for text in [
        chain("safety = 2.5", ", strength_n = 70", ", compression_n = 0.1, safety = 1"),
        net("safety = 2.5", ", bending_n_m2 = 0.3", ", strength_n = 1e5, safety = 1.25"),
    ] {
        let read = system(&text);
        assert_eq!(system(&write_network(&read)), read);
    }
}

#[test]
fn rows_of_a_file_have_them_too() {
    let folder = Folder::new("strengths");
    let root = "safety = 2\nbars_file = \"bars.csv\"\n\
                joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [2, 0, 0] }, P = {} }";
    let path = folder.file("net.toml", root);
    let read = |rows: &str| {
        let head = "from,to,length_m,mass_kg,strength_n,compression_n,safety\n";
        folder.file("bars.csv", format!("{head}{rows}\n"));
        model::system_file::read(&path)
    };
    let Ok(Described::System(system)) = read("A,P,1,1,70,,\nP,B,2,1,,50,4") else { panic!() };
    let wanted = [
        Some(Strength::new(Some(70.0), None, 2.0).unwrap()),
        Some(Strength::new(None, Some(50.0), 4.0).unwrap()),
    ];
    assert_eq!(strengths(&system), wanted);
    for (row, key) in [
        ("A,P,1,1,-70,,\nP,B,2,1,,,", "strength_n"),
        ("A,P,1,1,70,0,\nP,B,2,1,,,", "compression_n"),
        ("A,P,1,1,70,,inf\nP,B,2,1,,,", "safety"),
        ("A,P,1,1,,,2\nP,B,2,1,,,", "strength_n"),
    ] {
        let error = read(row).unwrap_err().to_string();
        assert!(error.contains(key), "{error}");
    }
}

#[test]
fn what_is_no_strength_is_refused_where_it_stands() {
    for file in [chain as fn(&str, &str, &str) -> String, net] {
        for (root, first, key, words) in [
            ("", ", strength_n = 0", "bars[1].strength_n", "positive and finite"),
            ("", ", compression_n = -1", "bars[1].compression_n", "positive and finite"),
            ("", ", bending_n_m2 = nan", "bars[1].bending_n_m2", "positive and finite"),
            ("", ", strength_n = 1, safety = 0", "bars[1].safety", "positive and finite"),
            ("safety = inf", ", strength_n = 1", "safety", "positive and finite"),
            ("", ", safety = 2", "bars[1].safety", "strength_n"),
            ("safety = 2", "", "safety", "strength_n"),
            ("", ", compression_n = 1, bending_n_m2 = 1", "bars[1].bending_n_m2", "compression_n"),
            ("", ", strength_n = \"much\"", "bars[1].strength_n", "number"),
            ("", ", strenght_n = 1", "bars[1].strenght_n", "strength_n"),
        ] {
            refused_at(&file(root, first, ""), key, words);
        }
    }
    for (kind, key, words) in [
        ("cable", "compression_n", "a cable cannot push: it has no compression_n"),
        ("cable", "bending_n_m2", "no bending_n_m2"),
        ("strut", "strength_n", "a strut cannot pull: it has no strength_n"),
    ] {
        let text = net("", &format!(", kind = \"{kind}\", {key} = 1"), "");
        let error = parse(&text, "system.toml").unwrap_err();
        assert_eq!(error.key(), Some("bars[1]"), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

/// The three numbers of a strength, one after the other.
#[test]
fn strengths_are_positive() {
    for (tension_n, compression_n, safety, what) in [
        (Some(0.0), Some(1.0), 1.0, "strength_n"),
        (Some(1.0), Some(f64::NAN), 1.0, "compression_n"),
        (None, None, -2.0, "safety"),
    ] {
        let error = Strength::new(tension_n, compression_n, safety).unwrap_err();
        assert_eq!(error.what, what);
    }
    // Each force against its own strength.
    let both = Strength::new(Some(10.0), Some(2.0), 1.0).unwrap();
    for (least_n, most_n, wanted) in [(-1.0, 4.0, 0.5), (-0.5, 4.0, 0.4), (1.0, 4.0, 0.4)] {
        assert!((both.utilisation(least_n, most_n) - wanted).abs() < 1e-15);
    }
}
