//! Chains nobody chose: branches against censuses and closed forms, on coarse grids and on fine
//! ones.

use branches::{Combine, Continuation, ContinuationSettings, EventKind, Variation};
use census::{Census, Settings};

/// Positions of events must be this good.
const PARAMETER: f64 = 1e-10;

/// Knuth's linear congruential generator; the high bits are the good ones.
struct Random(u64);

impl Random {
    fn next(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        let part = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        // Three decimals: what a failure prints can be typed.
        ((low + part * (high - low)) * 1e3).round() / 1e3
    }
}

struct Drawn {
    lengths: [f64; 3],
    height: f64,
    text: String,
}

fn draw(random: &mut Random) -> Drawn {
    let height = random.next(-0.5, 0.5);
    let bars = [(); 3].map(|()| {
        let length = random.next(0.4, 1.7);
        let mass = random.next(0.2, 1.5);
        let centre = random.next(0.05, 0.95) * length;
        (length, format!("length_m = {length}\nmass_kg = {mass}\ncentre_m = {centre}\n"))
    });
    let lengths = [bars[0].0, bars[1].0, bars[2].0];
    let bars = bars.map(|(_, text)| format!("[[bars]]\n{text}")).concat();
    let text = format!("anchors = {{ start_m = [0, 0, 0], end_m = [1, 0, {height}] }}\n{bars}");
    Drawn { lengths, height, text }
}

fn variation(text: &str, vary: &str) -> Variation {
    let chain = samples::parsed(text).into_chain();
    Variation::new(&chain, &[vary.parse().unwrap()], Combine::Product).unwrap()
}

fn places(trace: &Continuation, kind: EventKind) -> Vec<f64> {
    trace.events.iter().filter(|event| event.kind == kind).map(|event| event.values[0]).collect()
}

/// Where the chain can lie on one line: the distance is a sum of the lengths with signs.
fn straights(drawn: &Drawn, range: [f64; 2]) -> Vec<f64> {
    let [a, b, c] = drawn.lengths;
    let reach = [a + b + c, a + b - c, a - b + c, b + c - a].map(f64::abs);
    let mut x: Vec<f64> = reach
        .iter()
        .filter(|reach| **reach > drawn.height.abs())
        .map(|reach| (reach * reach - drawn.height * drawn.height).sqrt())
        .filter(|x| (range[0]..=range[1]).contains(x))
        .collect();
    x.sort_by(f64::total_cmp);
    x
}

fn indices(branches: &Continuation, position: f64) -> Vec<usize> {
    let mut found = vec![];
    for branch in branches.branches.iter().filter(|branch| branch.covers(position)) {
        // Behind an event the index is that of the next point.
        let after = branch.points.iter().find(|point| point.position > position).unwrap();
        let before = branch.before(position).unwrap();
        let point = if before.event.is_some() { after } else { before };
        found.push(point.index_in_plane);
    }
    found.sort_unstable();
    found
}

/// The branches at as many values as given, none of them a value of the trace.
fn counts(variation: &Variation, trace: &Continuation, range: [f64; 2], values: usize) {
    let mut compared = 0;
    for k in 0..values {
        let position = (k as f64 + 0.371_9) / values as f64;
        let problem = variation.problem(&[range[0] + position * (range[1] - range[0])]);
        let Ok(problem) = problem else { continue };
        let census = Census::take(&problem, &Settings::default()).unwrap();
        if !census.complete {
            continue;
        }
        let mut wanted: Vec<usize> = census.equilibria.iter().map(|e| e.index_in_plane).collect();
        wanted.sort_unstable();
        assert_eq!(indices(trace, position), wanted, "at {:?}", trace.points[0].values);
        compared += 1;
    }
    assert!(compared * 10 > values * 9, "{compared} of {values}");
}

#[test]
fn random_chains_have_the_branches_of_their_censuses() {
    let mut random = Random(20);
    for _ in 0..12 {
        let drawn = draw(&mut random);
        let total: f64 = drawn.lengths.iter().sum();
        let range = [0.1, (0.97 * total * 1e3).round() / 1e3];
        let mut coarse_folds = None;
        for points in [9, 70] {
            let variation = variation(
                &drawn.text,
                &format!("anchors.end_m.x={}..{}:{points}", range[0], range[1]),
            );
            let trace =
                Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {})
                    .unwrap();
            let which = format!("{points} points of\n{}", drawn.text);
            assert!(trace.checks.agree(), "{:?} {which}", trace.checks);
            // Without symmetry nothing branches.
            assert_eq!(places(&trace, EventKind::BranchPoint), [0.0; 0], "{which}");
            let (found, wanted) = (places(&trace, EventKind::Straight), straights(&drawn, range));
            assert_eq!(found.len(), wanted.len(), "{found:?} {wanted:?} {which}");
            for (found, wanted) in found.iter().zip(&wanted) {
                assert!((found - wanted).abs() <= PARAMETER, "{found} {wanted} {which}");
            }
            counts(&variation, &trace, range, 60);
            let folds = places(&trace, EventKind::Fold);
            let coarse: &Vec<f64> = coarse_folds.get_or_insert_with(|| folds.clone());
            assert_eq!(folds.len(), coarse.len(), "{folds:?} {coarse:?} {which}");
            for (fine, coarse) in folds.iter().zip(coarse) {
                assert!((fine - coarse).abs() <= PARAMETER, "{fine} {coarse} {which}");
            }
        }
    }
}

/// A straight chain and a fold 2.7 µm from each other, on one curve.
#[test]
fn a_fold_next_to_a_straight_chain_is_not_stepped_over() {
    const TEXT: &str = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0.22] }\n\
        bars = [{ length_m = 0.436, mass_kg = 0.305, centre_m = 0.049 },\n\
                { length_m = 1.076, mass_kg = 0.653, centre_m = 0.697 },\n\
                { length_m = 0.53, mass_kg = 0.227, centre_m = 0.144 }]";
    let straight: [f64; 2] = [0.436 + 1.076 - 0.53, 1.076 + 0.53 - 0.436];
    let straight = straight.map(|reach| (reach * reach - 0.22 * 0.22).sqrt());
    for points in [7, 100, 233, 700] {
        let variation = variation(TEXT, &format!("anchors.end_m.x=0.1..1.94:{points}"));
        let trace =
            Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {}).unwrap();
        assert!(trace.checks.agree(), "{points}: {:?}", trace.checks);
        let found = places(&trace, EventKind::Straight);
        assert_eq!(found.len(), straight.len(), "{points}: {found:?}");
        for (found, wanted) in found.iter().zip(&straight) {
            assert!((found - wanted).abs() <= PARAMETER, "{points}: {found} {wanted}");
        }
        let folds = places(&trace, EventKind::Fold);
        assert_eq!(folds.len(), 5, "{points}: {folds:?}");
        assert!(folds.iter().any(|x| (x - 1.149_132_763).abs() < 1e-9), "{points}: {folds:?}");
    }
}
