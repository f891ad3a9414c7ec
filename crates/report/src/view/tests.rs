use model::{InPlane, InSpace, Ladder, Stability};

use super::*;

/// E1, deg and mgl, to the digits of the project's independent 40-digit solution.
const E1: [f64; 4] =
    [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34, 2.335_468_651_993_005];

/// (ix) and (x) as printed.
const PRINTED: [[f64; 4]; 2] =
    [[19.70975, 38.58306, 286.0742, 2.33547], [0.0573, 299.94274, 59.94267, 2.50087]];

fn position(name: &'static str, [theta, alpha, beta]: [f64; 3], v: f64, index: usize) -> Position {
    Position {
        name,
        lagrange_deg: [theta, alpha, beta],
        energy_deg: None,
        lagrange_mgl: v,
        energy_mgl: None,
        forces_mg: [[0.0, 1.0], [0.0; 2], [0.0; 2], [0.0, 2.0]],
        axial_mg: [1.0; 3],
        stability: Stability {
            in_plane: if index == 0 { InPlane::Minimum } else { InPlane::Maximum },
            index_in_plane: index,
            in_space: InSpace::Stable,
            index_in_space: index,
        },
        nullity: 4,
        ladder: Ladder::default(),
    }
}

fn view() -> View {
    let [t, a, b, v] = E1;
    // E2 is E1 turned upside down: angles in reverse order and sign, V(E1) + V(E2) = 6 mgl.
    let equilibria = [
        position("E1", [t, a, b], v, 0),
        position("E1'", [-t, -a, -b], v, 0),
        position("E2", [-b, -a, -t], 6.0 - v, 1),
        position("E2'", [b, a, t], 6.0 - v, 1),
    ];
    View::of(&equilibria, PRINTED, vec![[1.0, 2.0]])
}

fn at(view: &View, name: &str) -> Sample {
    let state = view.states.iter().find(|s| s.name == name).unwrap();
    view.curve[state.at]
}

#[test]
fn the_slope_vanishes_at_the_equilibria_and_not_at_x() {
    let view = view();
    for name in ["E1", "E1'", "E2", "E2'"] {
        // Curvatures of V along the curve are of order ten, angles good to 1e-13 deg.
        assert!(at(&view, name).4.unwrap().abs() < 1e-8, "{name}");
    }
    // 0.8675215 mgl/rad: the doctest of `energy::example::slope`, there from a difference quotient.
    assert!((at(&view, "(x)").4.unwrap() - 0.867_521_5).abs() < 1e-5);
    // The printed (ix) is half a step away from E1.
    assert!(at(&view, "(ix)").4.unwrap().abs() > 1e-5);
}

#[test]
fn every_sample_closes_and_none_jumps() {
    let view = view();
    assert_eq!(view.curve.len(), 2 * SAMPLES + view.states.len());
    let far =
        |p: &Sample, q: &Sample| (p.0 - q.0).abs().max((p.1 - q.1).abs()).max((p.3 - q.3).abs());
    for (k, p) in view.curve.iter().enumerate() {
        let [t, a, b] = [p.0, p.1, p.2].map(f64::to_radians);
        // The printed angles have five decimals of a degree.
        assert!((t.cos() + a.cos() + b.cos() - 2.0).abs() < 1e-6, "{p:?}");
        assert!((t.sin() + a.sin() + b.sin()).abs() < 1e-6, "{p:?}");
        let next = &view.curve[(k + 1) % view.curve.len()];
        assert!(far(p, next) < 2.0, "{p:?} {next:?}");
    }
}

#[test]
fn each_named_place_is_a_sample_of_its_own() {
    let view = view();
    let mut places: Vec<usize> = view.states.iter().map(|s| s.at).collect();
    places.sort_unstable();
    places.dedup();
    assert_eq!(places.len(), 6);
    let e1 = at(&view, "E1");
    assert!((e1.0 - E1[0]).abs() < 1e-8 && (e1.1 - E1[1]).abs() < 1e-8);
    // 286.0742 deg of the print is -73.9258 deg here.
    assert!((at(&view, "(ix)").2 + 73.9258).abs() < 1e-9);
}

#[test]
fn the_fragment_is_self_contained_and_filled_in() {
    let html = view().fragment().unwrap();
    for marker in ["@rows@", "@data@", "@script@", "@every@"] {
        assert!(!html.contains(marker), "{marker}");
    }
    for outside in ["src=", "href=", "url(", "@import", "fetch(", "https://"] {
        assert!(!html.contains(outside), "{outside}");
    }
    // The name of the SVG namespace is the only address.
    assert_eq!(html.matches("http").count(), html.matches("http://www.w3.org/2000/svg").count());
    for (open, close) in
        [("<script", "</script>"), ("<style", "</style>"), ("<figure", "</figure>")]
    {
        assert_eq!(html.matches(open).count(), html.matches(close).count(), "{open}");
    }
    assert!(html.contains("<td>19.69487</td>"), "the table for pages without scripts");
}

#[test]
fn nothing_in_the_data_can_end_the_script() {
    let mut view = view();
    view.states[0].says = "</script><b>".to_owned();
    let html = view.fragment().unwrap();
    assert!(!html.contains("</script><b>"));
    assert!(html.contains("\\u003c/script>"));
}
