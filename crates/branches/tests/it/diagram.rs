//! The bifurcation diagram against closed forms, in pixels.

use branches::{
    Abscissa, Combine, Continuation, ContinuationSettings, EventKind, Variation, diagram,
};

fn run(vary: &[&str]) -> Continuation {
    let vary: Vec<_> = vary.iter().map(|text| text.parse().unwrap()).collect();
    let chain = model::cases::paper().into_chain();
    let variation = Variation::new(&chain, &vary, Combine::Product).unwrap();
    Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {}).unwrap()
}

fn attribute(line: &str, name: &str) -> f64 {
    let (_, rest) = line.split_once(&format!(" {name}=\"")).unwrap();
    rest.split_once('"').unwrap().0.parse().unwrap()
}

/// The corners of a line or an area.
fn corners(line: &str) -> Vec<[f64; 2]> {
    let (_, rest) = line.split_once("points=\"").unwrap();
    let pair = |text: &str| {
        let (x, y) = text.split_once(',').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    rest.split_once('"').unwrap().0.split(' ').map(pair).collect()
}

/// Level anchors from 1.1 m to 1.3 m apart, on 770 pixels with a margin of 2 % of the range on both sides.
#[test]
fn folds_stand_where_the_distance_is_the_root_of_three_halves() {
    let found = run(&["anchors.end_m.z=0", "anchors.end_m.x=1.1..1.3:3"]);
    for abscissa in [Abscissa::Parameter, Abscissa::Span] {
        let svg = diagram(&found, "level", abscissa, 2);
        let circles: Vec<&str> = svg.lines().filter(|line| line.contains("<circle")).collect();
        let folds: Vec<_> = found.events.iter().filter(|e| e.kind == EventKind::Fold).collect();
        // In both panels, and once in the legend.
        assert_eq!((folds.len(), circles.len()), (4, 9));
        let x = 100.0 + 770.0 * (1.5_f64.sqrt() - 1.1 + 0.004) / 0.208;
        for (circle, fold) in circles[4..8].iter().zip(&folds) {
            let y = 750.0 - 310.0 * (fold.angles_rad[1].to_degrees() + 190.0) / 380.0;
            let at = [attribute(circle, "cx"), attribute(circle, "cy")];
            assert!((at[0] - x).abs() < 0.01 && (at[1] - y).abs() < 0.01, "{at:?} {x} {y}");
        }
        // Of energies the highest is as far below the upper edge as the lowest above the lower one: 5 % of their
        // range.
        let points = || found.branches.iter().flat_map(|branch| &branch.points);
        let low = points().map(|point| point.energy_j).fold(f64::INFINITY, f64::min);
        let high = points().map(|point| point.energy_j).fold(f64::NEG_INFINITY, f64::max);
        for (circle, fold) in circles[..4].iter().zip(&folds) {
            let part = (fold.energy_j - low + 0.05 * (high - low)) / (1.1 * (high - low));
            assert!((attribute(circle, "cy") - (400.0 - 310.0 * part)).abs() < 0.01);
        }
        // Every point is a corner of its line in either panel.
        let lines = svg.lines().filter(|line| line.contains("<polyline"));
        let corners: Vec<[f64; 2]> = lines.flat_map(corners).collect();
        for point in points() {
            let over = point.values[1];
            let x = 100.0 + 770.0 * (over - 1.1 + 0.004) / 0.208;
            let part = (point.energy_j - low + 0.05 * (high - low)) / (1.1 * (high - low));
            let turned = (point.angles_rad[1].to_degrees() + 190.0) / 380.0;
            for y in [400.0 - 310.0 * part, 750.0 - 310.0 * turned] {
                let near = |at: &[f64; 2]| (at[0] - x).abs() < 0.01 && (at[1] - y).abs() < 0.01;
                assert!(corners.iter().any(near), "{x} {y}");
            }
        }
        let named = |text: &str| svg.matches(&format!(">{text}<")).count();
        let over = match abscissa {
            Abscissa::Parameter => "anchors.end_m.x / m",
            Abscissa::Span => "distance of the anchors / m",
        };
        let angle = "angle of bar 2 from the vertical / \u{b0}";
        assert_eq!([over, angle, "anchors.end_m.z = 0 m"].map(named), [1, 1, 1]);
    }
}

/// What is drawn is in the legend, and nothing else.
#[test]
fn legends_name_what_is_drawn() {
    let level = ["anchors.end_m.z=0", "anchors.end_m.x=0.05..2.9:12"];
    let upright = ["anchors.end_m.z=-3.3..-0.9:9"];
    for (vary, wanted) in [
        (&["anchors.end_m.z=0", "anchors.end_m.x=2.5..2.9:2"][..], vec![]),
        (&level[..], vec!["fold", "branch point", "straight chain"]),
        (&upright[..], vec!["straight chain", "no chain"]),
        (&["anchors.end_m.x=1", "anchors.end_m.z=-2.2..-1.8:2"][..], vec!["fold"]),
    ] {
        let found = run(vary);
        let svg = diagram(&found, "drawn", Abscissa::Parameter, 1);
        let points = || found.branches.iter().flat_map(|branch| &branch.points);
        let styles = [
            ("stable in space", points().any(|p| p.index_in_space == 0)),
            (
                "stable in the plane only",
                points().any(|p| p.index_in_space > 0 && p.index_in_plane == 0),
            ),
            ("unstable", points().any(|p| p.index_in_plane > 0)),
        ];
        let exchanges = found.events.iter().any(|event| event.kind.name() == "space-exchange");
        let others = [
            ("fold", wanted.contains(&"fold")),
            ("branch point", wanted.contains(&"branch point")),
            ("straight chain", wanted.contains(&"straight chain")),
            ("stability in space changes", exchanges),
            ("no chain", wanted.contains(&"no chain")),
        ];
        let mut at =
            (0..).map(|k| [136.0 + 195.0 * f64::from(k % 4), 831.0 + 26.0 * f64::from(k / 4)]);
        let line = |holds: &str| svg.lines().rfind(|line| line.contains(holds));
        for (name, drawn) in styles.into_iter().chain(others) {
            let text = line(&format!(">{name}<"));
            assert_eq!(text.is_some(), drawn, "{vary:?}: {name}");
            let Some(text) = text else { continue };
            let [x, y] = at.next().unwrap();
            let found = ["x", "y"].map(|name| attribute(text, name));
            assert!((found[0] - x).abs() + (found[1] - y).abs() < 0.02, "{text} {x} {y}");
            // What is left of it.
            let wanted = match name {
                "fold" => [("cx", x - 20.0), ("cy", y - 5.0)],
                "no chain" => [("x", x - 32.0), ("y", y - 12.0)],
                "unstable" => [("x1", x - 34.0), ("x2", x - 6.0)],
                _ => continue,
            };
            let mark = svg.lines().skip_while(|line| *line != text).nth(1).unwrap();
            for (name, wanted) in wanted {
                assert!((attribute(mark, name) - wanted).abs() < 0.01, "{mark}");
            }
        }
    }
}

/// Marks by their corners: triangles where the anchors pass a vertical, between ±0.6 m; diamonds and squares where
/// level anchors are 2^(2/3) - 1 and 1 from each other, between 0.4 m and 1.1 m.
#[test]
fn marks_have_their_corners_around_their_events() {
    let angle = |degrees: f64| 750.0 - 310.0 * (degrees + 190.0) / 380.0;
    for (vary, kind, low, high, shape) in [
        (
            ["anchors.end_m.z=-0.5", "anchors.end_m.x=-0.6..0.6:5"],
            "space-exchange",
            -0.6,
            0.6,
            vec![[0.0, -6.0], [5.5, 4.0], [-5.5, 4.0]],
        ),
        (
            ["anchors.end_m.z=0", "anchors.end_m.x=0.4..1.1:4"],
            "branch-point",
            0.4,
            1.1,
            vec![[0.0, -6.0], [6.0, 0.0], [0.0, 6.0], [-6.0, 0.0]],
        ),
    ] {
        let found = run(&vary);
        let svg = diagram(&found, "marks", Abscissa::Parameter, 1);
        let drawn: Vec<_> =
            svg.lines().filter(|line| line.contains("<polygon")).map(corners).collect();
        let events: Vec<_> = found.events.iter().filter(|e| e.kind.name() == kind).collect();
        // In both panels, and once in the legend.
        assert!(!events.is_empty() && drawn.len() == 2 * events.len() + 1, "{}", drawn.len());
        for (found, event) in drawn[events.len()..].iter().zip(&events) {
            let x = 100.0 + 770.0 * ((event.values[1] - low) / (high - low) + 0.02) / 1.04;
            let y = angle(event.angles_rad[0].to_degrees());
            assert_eq!(found.len(), shape.len());
            for (found, [right, down]) in found.iter().zip(&shape) {
                assert!((found[0] - x - right).abs() < 0.01, "{found:?} {x} {right}");
                assert!((found[1] - y - down).abs() < 0.01, "{found:?} {y} {down}");
            }
        }
        let squares: Vec<&str> = svg
            .lines()
            .filter(|line| line.contains("<rect") && line.contains("\"8.00\""))
            .collect();
        let straight: Vec<_> =
            found.events.iter().filter(|event| event.kind == EventKind::Straight).collect();
        assert_eq!(squares.len(), if straight.is_empty() { 0 } else { 2 * straight.len() + 1 });
        for (square, event) in squares.iter().skip(straight.len()).zip(&straight) {
            let x = 100.0 + 770.0 * ((event.values[1] - low) / (high - low) + 0.02) / 1.04;
            let y = angle(event.angles_rad[0].to_degrees());
            assert!((attribute(square, "x") - (x - 4.0)).abs() < 0.01, "{square} {x}");
            assert!((attribute(square, "y") - (y - 4.0)).abs() < 0.01, "{square} {y}");
        }
    }
}
