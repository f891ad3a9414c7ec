//! One part that is far heavier than all others: what is light is found beside it, or a solver says that it
//! is not known.

use std::f64::consts::TAU;

use model::Bar;
use model::system::{Joint, Member, System};
use rand::{Rng, RngExt};
use validate::systems::{SystemAnswer, ask_with};
use validate::{Question, UseCensus};

fn asked(system: &System) -> SystemAnswer {
    let question = Question { census: UseCensus::Never, ..Question::default() };
    ask_with(system, &question, &|_| {})
}

/// Bars of some length, mass and centre, of which one is as many times heavier, or lighter.
fn bars(random: &mut impl Rng, count: usize, ratio: f64) -> Vec<Bar> {
    let odd = random.random_range(0..count);
    let factor = if random.random_range(0..3) == 0 { ratio.recip() } else { ratio };
    let mut one = |k: usize| {
        let (length_m, mass_kg) = (random.random_range(0.5..2.0), random.random_range(0.5..2.0));
        let centre_m = random.random_range(0.1..0.9) * length_m;
        let mass_kg = if k == odd { factor * mass_kg } else { mass_kg };
        Bar::new(length_m, mass_kg, centre_m, [0.0; 3]).unwrap()
    };
    (0..count).map(&mut one).collect()
}

/// A chain is found by both solvers, up to the last digit in which a double holds the lightest mass.
#[test]
fn chains_with_one_heavy_bar_are_found_by_both() {
    for (stream, ratio) in (0..60).zip([1e9, 1e12, 1e14, 1e15].into_iter().cycle()) {
        let mut random = samples::stream(32, stream);
        let count = random.random_range(2..12);
        let bars = bars(&mut random, count, ratio);
        let total_m: f64 = bars.iter().map(Bar::length_m).sum();
        let longest_m = bars.iter().map(Bar::length_m).fold(0.0, f64::max);
        let least_m = (2.0 * longest_m - total_m).max(0.0);
        let span_m = least_m + random.random_range(0.05..0.95) * (total_m - least_m);
        let rise: f64 = random.random_range(-1.4..1.4);
        let end_m = [span_m * rise.cos(), 0.0, span_m * rise.sin()];
        let answer = asked(&samples::of_bars(9.81, bars, end_m).chain().into());
        let reasons = answer.agreement.map(|found| found.disagreement.sentences());
        assert_eq!(reasons, Some(vec![]), "{stream}: {:?}", answer.failures);
    }
}

/// Strands of bars between anchors and one joint: no answer that is wrong, and some that are right.
#[test]
fn nets_with_one_heavy_bar_are_found_or_not_known() {
    let mut agreed = 0;
    for (stream, ratio) in (0..45).zip([1e8, 1e12, 1e14].into_iter().cycle()) {
        let mut random = samples::stream(33, stream);
        let strands: u32 = random.random_range(2..5);
        let mut joints = vec![Joint::free("P").with_mass(random.random_range(0.5..2.0))];
        let counts: Vec<usize> = (0..strands).map(|_| random.random_range(1..4)).collect();
        let mut rest = bars(&mut random, counts.iter().sum(), ratio).into_iter();
        let mut members = vec![];
        for (strand, count) in counts.into_iter().enumerate() {
            let strand_bars: Vec<Bar> = rest.by_ref().take(count).collect();
            let length_m: f64 = strand_bars.iter().map(Bar::length_m).sum();
            let away_m = random.random_range(0.2..0.6) * length_m;
            let angle = (strand as f64 + random.random_range(-0.3..0.3)) * TAU / f64::from(strands);
            let at_m = [away_m * angle.cos(), away_m * angle.sin(), random.random_range(-0.5..0.5)];
            joints.push(Joint::anchor(format!("A{strand}"), at_m));
            let mut from = joints.len() - 1;
            for (k, bar) in strand_bars.into_iter().enumerate() {
                let to = if k + 1 == count { 0 } else { joints.len() };
                if to > 0 {
                    joints.push(Joint::free(format!("{strand}.{k}")));
                }
                members.push(Member::bar(from, to, bar));
                from = to;
            }
        }
        let Ok(system) = System::new("", 9.81, joints, members) else { continue };
        if system.refusal().is_err() {
            continue;
        }
        let answer = asked(&system);
        let reasons = answer.agreement.as_ref().map(|found| found.disagreement.sentences());
        assert!(!answer.check_failed(), "{stream}: {reasons:?}");
        agreed += usize::from(answer.agrees());
    }
    assert!(agreed > 15, "{agreed}");
}
