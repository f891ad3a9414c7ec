//! The interactive view: the closure curve with the named places on it, and the piece of the page.

use report::view::{Sample, View};

use crate::REPORT;

/// E1, deg, to the digits of the project's independent 40-digit solution.
const E1: [f64; 2] = [19.694_867_976_133_02, 38.599_136_184_451_89];

fn view() -> View {
    View::new(REPORT.reproduction())
}

fn at(view: &View, name: &str) -> Sample {
    let state = view.states.iter().find(|s| s.name == name).expect("a named place");
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
    assert_eq!(view.curve.len(), 2 * 361 + 6);
    let far =
        |p: &Sample, q: &Sample| (p.0 - q.0).abs().max((p.1 - q.1).abs()).max((p.3 - q.3).abs());
    for (k, p) in view.curve.iter().enumerate() {
        let [t, a, b] = [p.0, p.1, p.2].map(f64::to_radians);
        // The angles have nine decimals of a degree.
        assert!((t.cos() + a.cos() + b.cos() - 2.0).abs() < 1e-10, "{p:?}");
        assert!((t.sin() + a.sin() + b.sin()).abs() < 1e-10, "{p:?}");
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
    let [ix, _] = REPORT.reproduction().figures.scan_results;
    let beta = at(&view, "(ix)").2;
    assert!((beta.rem_euclid(360.0) - ix[2].rem_euclid(360.0)).abs() < 1e-9, "{beta} {ix:?}");
    assert!((beta + 73.9258).abs() < 5e-5, "{beta}");
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
