//! Chains written down as numbers, and a frame whose lengths do not fit.

use model::system::{Joint, Member, Misfit, System};
use model::system_file::Described;
use model::{Anchors, Bar, Chain, Problem, Vector};

/// A chain from the origin to `end_m`, in gravity 9.81 m/s²; bars as (length m, mass kg, distance
/// of the centre of weight from the first joint m).
///
/// ```
/// let problem = samples::chain(&[(2.0, 1.0, 0.5), (1.0, 3.0, 0.5)], [1.5, 0.0, 0.0]);
/// assert_eq!(problem.chain().bars()[0].centre_m(), 0.5);
/// ```
pub fn chain(bars: &[(f64, f64, f64)], end_m: Vector) -> Problem {
    let bars = bars.iter().map(|(l, m, r)| Bar::new(*l, *m, *r, [0.0; 3]).expect("a valid bar"));
    of_bars(9.81, bars, end_m)
}

/// A chain of homogeneous bars (length m, mass kg) from the origin to `end_m`.
///
/// ```
/// let problem = samples::homogeneous(10.0, &[(2.0, 1.0), (1.0, 3.0)], [1.5, 0.0, 0.0]);
/// assert_eq!(problem.chain().bars()[0].centre_m(), 1.0);
/// ```
pub fn homogeneous(gravity_m_s2: f64, bars: &[(f64, f64)], end_m: Vector) -> Problem {
    let bars = bars.iter().map(|(l, m)| Bar::homogeneous(*l, *m).expect("a valid bar"));
    of_bars(gravity_m_s2, bars, end_m)
}

/// A chain of these bars from the origin to `end_m`.
///
/// ```
/// let bar = model::Bar::homogeneous(1.0, 2.0).unwrap();
/// assert_eq!(samples::of_bars(10.0, [bar; 3], [1.0, 0.0, 0.0]).chain().bars(), [bar; 3]);
/// ```
pub fn of_bars(gravity_m_s2: f64, bars: impl IntoIterator<Item = Bar>, end_m: Vector) -> Problem {
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let bars = bars.into_iter().collect();
    let chain = Chain::new("of a test", gravity_m_s2, anchors, bars).expect("a valid chain");
    Problem::new(chain).expect("a chain with an answer")
}

/// Anchors A, B, C and so on at these places, and after them free joints P, Q, R and so on of these
/// masses, kg.
///
/// ```
/// let joints = samples::joints(&[[0.0; 3], [6.0, 0.0, 0.0]], &[2.0]);
/// assert!(joints[1].support.is_fixed() && joints[2].mass_kg == 2.0);
/// ```
#[must_use]
pub fn joints(anchors_m: &[Vector], masses_kg: &[f64]) -> Vec<Joint> {
    let anchors = ('A'..).zip(anchors_m).map(|(name, at_m)| Joint::anchor(name.to_string(), *at_m));
    let free = |(name, mass_kg): (char, &f64)| Joint::free(name.to_string()).with_mass(*mass_kg);
    anchors.chain(('P'..).zip(masses_kg).map(free)).collect()
}

/// A chain of `n` equal homogeneous bars from the origin to `end_m`, `length_m` long and `mass_kg`
/// heavy in all, in standard gravity.
///
/// ```
/// let problem = samples::equal_bars(10, 1.5, 1.0, [1.0, 0.0, -0.2]);
/// assert!((problem.chain().total_length_m() - 1.5).abs() < 1e-15);
/// ```
pub fn equal_bars(n: usize, length_m: f64, mass_kg: f64, end_m: Vector) -> Problem {
    let bar = Bar::homogeneous(length_m / n as f64, mass_kg / n as f64).expect("a valid bar");
    of_bars(model::STANDARD_GRAVITY_M_S2, vec![bar; n], end_m)
}

/// The chain that the text of a system file describes.
///
/// ```
/// let anchors = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }";
/// let text = format!("{anchors}\nbars = [{{ length_m = 1, mass_kg = 1, count = 2 }}]");
/// assert_eq!(samples::parsed(&text).chain().bars().len(), 2);
/// ```
pub fn parsed(text: &str) -> Problem {
    match model::system_file::parse(text, "sample.toml") {
        Ok(Described::Chain(problem)) => problem,
        other => panic!("no chain: {other:?}"),
    }
}

/// Four bars from a square of anchors, 3 m aside and 4 m above the joint 0 with its 3 kg: 5 m long and 0.5 kg heavy,
/// but the third is 2 mm longer. All are known to within what is given, m.
///
/// ```
/// assert_eq!(samples::legs([1e-3; 4]).members()[2].body.length_m(), 5.002);
/// ```
pub fn legs(within_m: [f64; 4]) -> System {
    let corners = [[3.0, 0.0, 4.0], [-3.0, 0.0, 4.0], [0.0, 3.0, 4.0], [0.0, -3.0, 4.0]];
    let mut joints = vec![Joint::free("P").with_mass(3.0)];
    joints.extend(corners.iter().enumerate().map(|(k, at)| Joint::anchor(format!("A{k}"), *at)));
    let bars = [5.0, 5.0, 5.002, 5.0].into_iter().zip(within_m).enumerate();
    let members = bars.map(|(k, (length_m, within_m))| {
        let body = Bar::homogeneous(length_m, 0.5).expect("a valid bar");
        Member::bar(k + 1, 0, body).with_length_tolerance(within_m)
    });
    System::new("legs", 10.0, joints, members.collect()).expect("a valid system")
}

/// Assert that these are the misfits of [`legs`]: of the shape that meets all lengths best a quarter of the 2 mm
/// is left in each, the two across the longer one too long, and it and the one opposite too short. They come in
/// this order, of members by what they may be off.
pub fn assert_misfits_of_legs(misfits: &[Misfit], order: [(usize, f64); 4]) {
    assert_eq!(misfits.len(), 4);
    for (found, (member, within_m)) in misfits.iter().zip(order) {
        let misfit_m = if member < 2 { 5e-4 } else { -5e-4 };
        assert_eq!(found.member, member, "{misfits:?}");
        assert!((found.misfit_m - misfit_m).abs() < 1e-6, "{misfits:?}");
        assert!((found.within_m - within_m).abs() < 1e-18, "{misfits:?}");
    }
}

/// Assert that these are the place of the joint of [`legs`] and the forces of its bars, where they are known to
/// within the 2 mm: it moves away from the longer one by half of them over the cosine 3/5, and down by a quarter
/// over 4/5; it hangs by all alike, each by a quarter of the 4 kg over the cosine 4/5.
pub fn assert_shared_by_legs(at_m: Vector, axial_n: &[f64]) {
    for (found, wanted) in at_m.iter().zip([0.0, -1e-3 / 0.6, -0.5e-3 / 0.8]) {
        assert!((found - wanted).abs() < 2e-6, "{at_m:?}");
    }
    assert!(axial_n.iter().all(|axial_n| (axial_n / 12.5 - 1.0).abs() < 2e-3), "{axial_n:?}");
}
