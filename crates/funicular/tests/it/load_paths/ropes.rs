//! Load paths of ropes over rings and gables.

use funicular::prelude::*;
use funicular::{LoadEnd, LoadEventKind, LoadPath, PathProved};

use super::{SHARP, is_proved, load_n, near, path};

/// A ring of 10 kg on a rope between A and B, 4 m apart: both spans lean by `a` with `sin a = 4/L`.
fn ring(more: &str) -> Problem {
    Problem::parse(
        &format!(
            "gravity_m_s2 = 9.8\n[joints]\nA = {{ at_m = [0, 0, 0] }}\nB = {{ at_m = [4, 0, 1] }}\n\
             P = {{ mass_kg = 10 }}\n{more}[[bars]]\nfrom = \"A\"\nto = \"B\"\nvia = [\"P\"]\n\
             kind = \"cable\"\nlength_m = 5\n"
        ),
        "ring.toml",
    )
    .unwrap()
}

fn path_of(problem: &Problem, vary: &str) -> LoadPath {
    let found = Trace::new().vary(vary).unwrap().run(problem).unwrap();
    assert!(found.checks_agree() && found.checks_decided(), "{found}");
    let path = found.load_paths().unwrap().paths()[0].clone();
    assert_eq!((path.end, &path.events[..]), (LoadEnd::Range, &[][..]), "{found}");
    assert!(path.points.len() > 2);
    path
}

/// The ring, and the tension of its rope, at every point: over its length, its load, and the place of B.
#[test]
fn a_ring_follows_its_rope() {
    let is_known = |path: &LoadPath, known: &dyn Fn(f64) -> (f64, f64, [f64; 2])| {
        for point in &path.points {
            let (length_m, load_n, [bx, bz]) = known(point.values[0]);
            let sin = bx / length_m;
            let cos = (1.0 - sin * sin).sqrt();
            let z = 0.5 * (bz - length_m * cos);
            near(point.axial_n[0], load_n / (2.0 * cos));
            let [x, y, at_z] = point.joints_m[2];
            near(at_z, z);
            near(x, -z * sin / cos);
            assert!(y.abs() < 1e-9 && point.index == 0);
        }
    };
    let problem = ring("");
    let path = path_of(&problem, "bars.1.length_m=4.5..9");
    is_known(&path, &|length_m| (length_m, 98.0, [4.0, 1.0]));
    assert_eq!(path.proved.because.as_deref(), Some("more than loads vary"));
    let path = path_of(&problem, "joints.P.mass_kg=10..1");
    is_known(&path, &|mass_kg| (5.0, 9.8 * mass_kg, [4.0, 1.0]));
    let PathProved { to, first, because, .. } = &path.proved;
    assert_eq!((*to, *first, because.as_deref()), (Some(1.0), None, None));
    let path = path_of(&problem, "joints.B.at_m.x=4..1");
    is_known(&path, &|x| (5.0, 98.0, [x, 1.0]));
    let path = path_of(&problem, "joints.B.at_m.z=1..-2.5");
    is_known(&path, &|z| (5.0, 98.0, [4.0, z]));
}

/// The shallow gable, its bars of EA = 1 N from A and B to P, on which a rope of EA = 0.3 N from A over P to B lies:
/// 1 - l/l0 less 0.3 (2 l/L - 1) is c (1 - l/l1), as if the bars had EA = c and another length.
#[test]
fn a_rope_over_a_gable_moves_its_limit() {
    let (l0, rope_m, soft) = (1.25_f64.sqrt(), 1.9, 0.3);
    let c = 1.0 + soft;
    let l1 = c / (1.0 / l0 + 2.0 * soft / rope_m);
    let w = (l1 * l1 - 1.0).sqrt();
    let bar = |from: &str, to: &str| {
        format!("[[bars]]\nfrom = \"{from}\"\nto = \"{to}\"\nlength_m = {l0}\nstiffness_n = 1\n")
    };
    let text = format!(
        "[joints]\nA = {{ at_m = [-1, 0, 0] }}\nB = {{ at_m = [1, 0, 0] }}\n\
         P = {{ at_m = [0, 0, 0], free = \"z\", force_n = [0, 0, -1], near_m = [0, 0, {w}] }}\n{}{}\
         [[bars]]\nfrom = \"A\"\nto = \"B\"\nvia = [\"P\"]\nkind = \"cable\"\nlength_m = {rope_m}\n\
         stiffness_n = {soft}\n",
        bar("A", "P"),
        bar("B", "P"),
    );
    let path = path(&text, "loads=0..1");
    let limit_n = c * load_n(l1, l1.cbrt());
    near(path.events[0].values[0], limit_n);
    let [low, high] = path.events[0].enclosed.unwrap();
    assert!(low - 1e-15 <= limit_n && limit_n <= high + 1e-15 && high - low < 1e-13);
    is_proved(&path, LoadEventKind::Limit, limit_n);
    for point in path.points.iter().take(3) {
        let l = point.joints_m[2][2].hypot(1.0);
        near(point.axial_n[2], soft * (2.0 * l / rope_m - 1.0));
    }
}

/// P hangs from C while the rope is slack. It is taut as soon as 1 m and 3 m level, and z down, are
/// 9 m together: its first span is 73/18 m then. In the lowest point of the rope, 4.5 m from A and B, it
/// bears all.
#[test]
fn a_rope_becomes_taut_on_a_path() {
    let problem = Problem::parse(
        "gravity_m_s2 = 9.8\n[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [4, 0, 0] }\n\
         C = { at_m = [1, 0, 1] }\nP = { mass_kg = 10 }\n\
         [[bars]]\nfrom = \"C\"\nto = \"P\"\nkind = \"cable\"\nlength_m = 4\nmass_kg = 0\n\
         [[bars]]\nfrom = \"A\"\nto = \"B\"\nvia = [\"P\"]\nkind = \"cable\"\nlength_m = 9\n",
        "slack.toml",
    )
    .unwrap();
    let found = Trace::new().vary("bars.1.length_m=4..5.2").unwrap().run(&problem).unwrap();
    assert!(found.checks_agree() && found.checks_decided(), "{found}");
    let path = &found.load_paths().unwrap().paths()[0];
    let [event, lowest] = &path.events[..] else { panic!("{found}") };
    let first_m: f64 = 73.0 / 18.0;
    near(event.values[0], 1.0 + (first_m * first_m - 1.0).sqrt());
    assert_eq!((event.kind, &event.taut[..]), (LoadEventKind::Kink, &[2][..]));
    let deep_m = (4.5_f64 * 4.5 - 4.0).sqrt();
    near(lowest.values[0], (1.0 + deep_m).hypot(1.0));
    assert_eq!((lowest.kind, &lowest.slack[..]), (LoadEventKind::Kink, &[1][..]));
    for point in &path.points {
        let [x, _, z] = point.joints_m[3];
        let (rope_m, length_m) = (x.hypot(z) + (4.0 - x).hypot(z), point.values[0]);
        let off_m = (x - 1.0).hypot(z - 1.0) - length_m;
        let both = (event.values[0]..=lowest.values[0]).contains(&length_m);
        assert!(rope_m <= 9.0 + SHARP && off_m <= SHARP, "{rope_m} {off_m}");
        assert!(!both || (rope_m - 9.0).abs() + off_m.abs() < 2.0 * SHARP, "{rope_m} {off_m}");
    }
    near(path.points.last().unwrap().axial_n[1], 49.0 * 4.5 / deep_m);
}

/// With B above A by h both spans lean by 3 in 4, so that the ring is at A where h is 3 m.
#[test]
fn a_path_ends_where_a_ring_comes_to_its_pulley() {
    let found = Trace::new().vary("joints.B.at_m.z=1..4").unwrap().run(&ring("")).unwrap();
    let path = &found.load_paths().unwrap().paths()[0];
    let last = path.points.last().unwrap().values[0];
    assert!(path.end == LoadEnd::Jams && (last - 3.0).abs() < 5e-3, "{found}");
    assert!(found.checks_agree() && !found.checks_decided(), "{found}");
    assert!(
        found.to_string().contains("the path ends where P comes to A along its rope"),
        "{found}"
    );
}

/// A weight hangs from a rope over B with a ring of the same mass between A and B, 2 m apart: the spans lean by asin(1/2), each
/// is 2/sqrt(3) m long, and the weight hangs by what is left. It is at B where that is nothing, or where the ring has sqrt(3) times
/// its mass, or B is 2 sqrt(3) m away.
#[test]
fn a_path_ends_where_a_weight_comes_to_its_pulley() {
    let file = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [2, 0, 0] }\nR = { mass_kg = 1 }\nW = { mass_kg = 1 }\n\
                [[bars]]\nfrom = \"A\"\nvia = [\"R\", \"B\"]\nto = \"W\"\nkind = \"cable\"\nlength_m = 4\n";
    let problem = Problem::parse(file, "counterweight.toml").unwrap();
    let third = 3.0_f64.sqrt().recip();
    for (vary, at) in [
        ("bars.1.length_m=4..2.1", 4.0 * third),
        ("joints.R.mass_kg=1..5", 3.0 * third),
        ("joints.B.at_m.x=2..3.9", 6.0 * third),
    ] {
        let found = Trace::new().vary(vary).unwrap().run(&problem).unwrap();
        let path = &found.load_paths().unwrap().paths()[0];
        let last = path.points.last().unwrap().values[0];
        assert!(path.end == LoadEnd::Jams && (last - at).abs() < 5e-3, "{found}");
        assert!(
            found.checks_agree() && found.to_string().contains("where W comes to B"),
            "{found}"
        );
    }
}

/// A rope of 100 m over two sheaves 8 mm apart: a span that is short from the start is no end. 60 kg hang from it.
#[test]
fn a_rope_over_twin_sheaves_goes_on() {
    let file = "[joints]\np = { at_m = [0, 0, 60] }\nq = { at_m = [0.008, 0, 60] }\nfloor = { at_m = [0, 0, 0] }\n\
                load = { near_m = [0, 0, 20], mass_kg = 50 }\ncw = { near_m = [0.008, 0, 0.008], mass_kg = 60 }\n\
                [[bars]]\nfrom = \"load\"\nvia = [\"p\", \"q\"]\nto = \"cw\"\nkind = \"cable\"\nlength_m = 100\n\
                [[bars]]\nfrom = \"load\"\nto = \"floor\"\nlength_m = 19\nstiffness_n = 2000\nmass_kg = 0\n";
    let path = path_of(&Problem::parse(file, "twin.toml").unwrap(), "loads=1..2");
    for point in &path.points {
        near(point.axial_n[0], 60.0 * 9.80665 * point.values[0]);
    }
}
