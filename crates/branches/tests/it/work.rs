//! The work of continuations, frozen: how many points curves take, how often a census is asked; and that no unit
//! changes a digit of it. A step that is shorter than it need be changes no answer, and is a change all the same.
//! Where one is meant, the failing test prints the table that then belongs here.

use branches::{Combine, Continuation, ContinuationSettings, EventKind, Variation};
use samples::assert_frozen;

/// Bars by length, mass and centre of weight, the last anchor, the parameters.
type Drawn = (&'static [[f64; 3]], [f64; 3], &'static [&'static str]);

/// Three equal bars between level anchors and over one another; three and four different ones, past positions in
/// which they are straight, and up to where they are out of reach; a bar that grows, and one that gets heavier.
const CHAINS: [Drawn; 7] = [
    (&[[1.0, 1.0, 0.5]; 3], [1.0, 0.0, 0.0], &["anchors.end_m.x=0.05..2.9:8"]),
    (&[[1.0, 1.0, 0.5]; 3], [0.0, 0.0, -1.0], &["anchors.end_m.z=-3.1..-0.1:9"]),
    (
        &[[0.75, 1.0, 0.25], [1.25, 0.5, 0.5], [0.5, 0.75, 0.375]],
        [0.5, 0.25, 0.125],
        &["anchors.end_m.x=0.125..2.5:7"],
    ),
    (
        &[[0.75, 1.0, 0.25], [1.25, 0.5, 0.5], [0.5, 0.75, 0.375]],
        [0.5, 0.25, 0.125],
        &["bars.2.length_m=0.75..1.75:5", "bars.2.centre_m=0.25..0.75:5"],
    ),
    (
        &[[0.75, 1.0, 0.25], [1.25, 0.5, 0.5], [0.5, 0.75, 0.375]],
        [0.0, 0.0, -0.5],
        &["bars.3.mass_kg=0.125..4:6"],
    ),
    (
        &[[0.75, 1.0, 0.5], [0.5, 0.25, 0.125], [1.0, 0.5, 0.75], [0.375, 1.5, 0.125]],
        [1.25, 0.0, 0.5],
        &["anchors.end_m.z=0.25..1.25:5"],
    ),
    (
        &[[0.75, 1.0, 0.5], [0.5, 0.25, 0.125], [1.0, 0.5, 0.75], [0.375, 1.5, 0.125]],
        [1.0, 0.5, -0.25],
        &["anchors.end_m.x=2..0.5:5"],
    ),
];

/// A continuation with lengths and masses times these.
fn run((bars, end_m, vary): Drawn, [length, mass]: [f64; 2]) -> Continuation {
    let bar = |[length_m, mass_kg, centre_m]: &[f64; 3]| {
        let (long, heavy, centre) = (length_m * length, mass_kg * mass, centre_m * length);
        format!("[[bars]]\nlength_m = {long}\nmass_kg = {heavy}\ncentre_m = {centre}\n")
    };
    let bars: String = bars.iter().map(bar).collect();
    let end_m = end_m.map(|x| x * length);
    let text = format!("anchors = {{ start_m = [0, 0, 0], end_m = {end_m:?} }}\n{bars}");
    let chain = samples::parsed(&text).into_chain();
    let vary: Vec<_> = vary
        .iter()
        .map(|vary| {
            let (name, range) = vary.split_once('=').unwrap();
            let (ends, count) = range.split_once(':').unwrap();
            let factor = if name.ends_with("_kg") { mass } else { length };
            let end = |text: &str| text.parse::<f64>().unwrap() * factor;
            let (low, high) = ends.split_once("..").unwrap();
            format!("{name}={}..{}:{count}", end(low), end(high)).parse().unwrap()
        })
        .collect();
    let variation = Variation::new(&chain, &vary, Combine::Zip).unwrap();
    Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {}).unwrap()
}

/// Branches, their points, sum of all indices in the plane and in space; folds, straight positions, branch points,
/// exchanges in space, unloaded bars; censuses between, points added.
fn row(found: &Continuation) -> [usize; 11] {
    let points = || found.branches.iter().flat_map(|branch| &branch.points);
    let count = |name: &str| found.events.iter().filter(|event| event.kind.name() == name).count();
    let kinds = ["fold", "straight", "branch-point", "space-exchange", "unloaded"];
    let [fold, straight, crossing, space, unloaded] = kinds.map(count);
    [
        found.branches.len(),
        points().count(),
        points().map(|point| point.index_in_plane).sum(),
        points().map(|point| point.index_in_space).sum(),
        fold,
        straight,
        crossing,
        space,
        unloaded,
        found.checks.between,
        found.checks.added,
    ]
}

#[test]
fn work_of_continuations() {
    let found = CHAINS.map(|drawn| row(&run(drawn, [1.0; 2])));
    let expected = [
        [12, 192, 95, 287, 4, 3, 2, 0, 6, 10, 0],
        [8, 142, 71, 142, 0, 6, 0, 0, 0, 10, 0],
        [10, 153, 78, 232, 5, 3, 0, 0, 5, 14, 0],
        [8, 110, 55, 165, 2, 1, 0, 0, 4, 7, 0],
        [4, 44, 22, 44, 0, 0, 0, 0, 0, 5, 0],
        [8, 107, 88, 226, 1, 1, 0, 0, 0, 6, 0],
        [20, 239, 240, 599, 9, 4, 0, 0, 5, 17, 0],
    ];
    assert_frozen(&found, &expected);
}

#[test]
fn continuations_scale_without_rounding() {
    for drawn in CHAINS {
        let one = run(drawn, [1.0; 2]);
        for [length, mass] in [[16.0, 1.0], [0.125, 64.0]] {
            let other = run(drawn, [length, mass]);
            assert_eq!(row(&one), row(&other), "{drawn:?}");
            let same = |one: f64, factor: f64, other: f64| {
                assert_eq!((one * factor).to_bits(), other.to_bits(), "{one} {factor} {other}");
            };
            for (a, b) in one.events.iter().zip(&other.events) {
                assert_eq!(
                    (a.kind, &a.angles_rad, &a.branches),
                    (b.kind, &b.angles_rad, &b.branches)
                );
                assert_eq!((a.position, a.position_error), (b.position, b.position_error));
                assert_eq!((a.residual, a.singular), (b.residual, b.singular));
                same(a.energy_j, length * mass, b.energy_j);
                same(a.span_m, length, b.span_m);
            }
            for (a, b) in one.branches.iter().zip(&other.branches) {
                assert_eq!((a.start, a.end), (b.start, b.end));
                for (a, b) in a.points.iter().zip(&b.points) {
                    assert_eq!((a.position, &a.angles_rad), (b.position, &b.angles_rad));
                    assert_eq!((a.grid, a.proved, a.event), (b.grid, b.proved, b.event));
                    same(a.energy_j, length * mass, b.energy_j);
                    let pulls = a.pull_n.iter().flatten().zip(b.pull_n.iter().flatten());
                    for (a, b) in pulls.chain(a.axial_n.iter().zip(&b.axial_n)) {
                        same(*a, mass, *b);
                    }
                }
            }
        }
    }
}

/// Every event of a kind that is proved has its place from its census or its curve to many digits.
#[test]
fn events_say_how_far_they_may_be_off() {
    for drawn in CHAINS {
        for event in run(drawn, [1.0; 2]).events {
            assert!((0.0..1e-9).contains(&event.position_error), "{event:?}");
            assert!(event.values_error.iter().all(|error| (0.0..1e-9).contains(error)));
            assert!((0.0..1e-10).contains(&event.residual), "{event:?}");
            let singular = matches!(event.kind, EventKind::Fold | EventKind::BranchPoint);
            assert!(!singular || event.singular < 1e-7, "{event:?}");
        }
    }
}

/// At every point of every branch, by its angles and its pull alone: with `F` the pull and the weight hung on a bar,
/// half ways by the lever rule, `F` is along the bar, its part along it the axial force; the bars reach from anchor
/// to anchor; and the energy is that of the weights.
#[test]
fn points_are_equilibria_by_statics_alone() {
    const G: f64 = 9.80665;
    for drawn in CHAINS {
        let found = run(drawn, [1.0; 2]);
        let points = found.branches.iter().flat_map(|branch| &branch.points);
        for point in points {
            let (mut bars, mut end_m) = (drawn.0.to_vec(), drawn.1);
            for (name, value) in found.parameters.iter().zip(&point.values) {
                match name.split('.').collect::<Vec<_>>()[..] {
                    ["anchors", "end_m", axis] => end_m["xyz".find(axis).unwrap()] = *value,
                    ["bars", bar, field] => {
                        let fields = ["length_m", "mass_kg", "centre_m"];
                        let field = fields.iter().position(|name| *name == field).unwrap();
                        bars[bar.parse::<usize>().unwrap() - 1][field] = *value;
                    }
                    _ => panic!("{name}"),
                }
            }
            let (mut at, mut energy_j, mut carried_kg) = ([0.0; 2], 0.0, 0.0);
            let weight_n: f64 = bars.iter().map(|[_, mass_kg, _]| G * mass_kg).sum();
            for (k, [length_m, mass_kg, centre_m]) in bars.iter().enumerate() {
                let (sin, cos) = point.angles_rad[k].sin_cos();
                energy_j += G * mass_kg * (at[1] - centre_m * cos);
                at = [at[0] + length_m * sin, at[1] - length_m * cos];
                let hung_n = G * (carried_kg + mass_kg * (1.0 - centre_m / length_m));
                carried_kg += mass_kg;
                let Some([h, v]) = point.pull_n else { continue };
                let size = h.abs() + v.abs() + weight_n;
                let along = h * sin - (v + hung_n) * cos;
                let across = h * cos + (v + hung_n) * sin;
                assert!(across.abs() < 1e-9 * size, "{drawn:?}: {across} of {size} N");
                let axial_n = point.axial_n[k];
                assert!((along - axial_n).abs() < 1e-11 * size, "{along} {axial_n} N");
            }
            let level_m = end_m[0].hypot(end_m[1]);
            assert!((at[0].abs() - level_m).abs() < 1e-10 && (at[1] - end_m[2]).abs() < 1e-10);
            assert!((energy_j - point.energy_j).abs() < 1e-11 * weight_n, "{energy_j} {point:?}");
            assert!((point.span_m - level_m.hypot(end_m[2])).abs() < 1e-12);
        }
    }
}

/// Each census is told of once, and the last is the last of all.
#[test]
fn censuses_are_counted_as_they_are_taken() {
    let vary =
        ["anchors.end_m.z=0".parse().unwrap(), "anchors.end_m.x=0.7..1.4:4".parse().unwrap()];
    let chain = model::cases::paper().into_chain();
    let variation = Variation::new(&chain, &vary, Combine::Product).unwrap();
    let seen = std::sync::Mutex::new(vec![]);
    let found =
        Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|progress| {
            seen.lock().unwrap().push((progress.done, progress.total));
        });
    let mut seen = seen.into_inner().unwrap();
    seen.sort_unstable();
    let all = 4 + found.unwrap().checks.between;
    assert_eq!(
        seen.iter().map(|(done, _)| *done).collect::<Vec<_>>(),
        (1..=all).collect::<Vec<_>>()
    );
    assert!(seen[..4].iter().all(|(_, total)| *total == 4) && seen[all - 1].1 == all, "{seen:?}");
}
