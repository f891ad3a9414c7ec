//! Systems above a flat floor without friction: closed forms, both solvers, the judge, the
//! certificate.

use model::system::{Joint, Member, System, SystemEquilibrium};
use model::{Bar, Rung, Vector};
use validate::answer::Solvers;
use validate::foreign::{Finding, ForeignAnswer, Law, bounds, judge_foreign};
use validate::systems::{ask, certify, judge};

/// Relative to the number itself.
const DIGITS: f64 = 1e-10;

#[track_caller]
fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= DIGITS * wanted.abs(), "{found} is not {wanted}");
}

/// Both answers, which agree.
#[track_caller]
fn answers(system: &System) -> Vec<SystemEquilibrium> {
    let answer = ask(system, Solvers::Both, &|_| {});
    assert!(answer.agrees(), "{:?}, {:?}", answer.agreement, answer.failures);
    answer.equilibria
}

/// A weight on a rod of 5 m above a floor 4 m below its anchor, drawn aside.
fn drawn_aside(force_n: f64) -> System {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(1.0).with_force([force_n, 0.0, 0.0]),
    ];
    let members = vec![Member::bar(0, 1, Bar::homogeneous(5.0, 0.0).unwrap())];
    let system = System::new("drawn aside", 10.0, joints, members).unwrap();
    system.with_floor(-4.0).unwrap()
}

/// On the floor the rod has the slope 4 to 3: it pulls with 5/3 of the force aside, and the floor
/// bears what it does not lift; drawn harder the weight leaves the floor.
#[test]
fn a_weight_lies_on_the_floor_until_it_is_lifted() {
    for e in answers(&drawn_aside(3.0)) {
        close(e.axial_n[0], 5.0);
        close(e.joints_m[1][0], 3.0);
        close(e.joints_m[1][2], -4.0);
        close(e.reactions_n[1][2], 6.0);
        assert!(e.reactions_n[1][..2].iter().all(|n| n.abs() <= 0.0), "{:?}", e.reactions_n);
        assert_eq!(e.evidence.rung(), Some(Rung::Optimal), "{:#?}", e.evidence.ladder);
        assert!(e.evidence.ladder.verified.is_reached(), "{:#?}", e.evidence.ladder);
    }
    // At the force at which the floor would bear nothing neither is proved.
    let edge = ask(&drawn_aside(7.5), Solvers::Both, &|_| {});
    for e in &edge.equilibria {
        assert!(!e.evidence.ladder.verified.is_reached(), "{:#?}", e.evidence.ladder);
    }
    for e in answers(&drawn_aside(9.0)) {
        assert!(e.evidence.ladder.verified.is_reached(), "{:#?}", e.evidence.ladder);
        close(e.axial_n[0], 181.0_f64.sqrt());
        assert!(e.reactions_n[1].iter().all(|n| n.abs() <= 0.0), "{:?}", e.reactions_n);
    }
}

/// A heavy inextensible line of `n` bars on a floor at the height of its anchor: parameter `a` of
/// the catenary, rise `d`, length `l`, weight 1 N/m. What hangs is `s² = d² + 2 a d` long.
fn mooring(n: usize, [a, d, l]: [f64; 3], stiffness_n: Option<f64>) -> System {
    let hanging = (d * d + 2.0 * a * d).sqrt();
    let far = l - hanging + a * (1.0 + d / a).acosh();
    let bar = Bar::homogeneous(l / n as f64, 0.1 * l / n as f64).unwrap();
    let joint = |k: usize| match k {
        0 => Joint::anchor("anchor", [0.0; 3]),
        _ if k == n => Joint::anchor("ship", [far, 0.0, d]),
        _ => Joint::free(k.to_string()),
    };
    let member = |k| Member { stiffness_n, ..Member::cable(k, k + 1, bar) };
    let joints = (0..=n).map(joint).collect();
    let system = System::new("mooring", 10.0, joints, (0..n).map(member).collect()).unwrap();
    system.with_floor(0.0).unwrap()
}

/// The catenary on a floor: its level pull is `a` times the weight per length.
#[test]
fn a_line_on_the_floor_tends_to_the_catenary() {
    let line = [20.0, 15.0, 50.0];
    let mut errors = vec![];
    for n in [10, 20, 40, 80, 160, 320] {
        let system = mooring(n, line, None);
        let both = answers(&system);
        for e in &both {
            assert!(certify(&system, e).is_ok(), "{n}, {}", e.solver);
            assert!(n > 80 || e.evidence.ladder.verified.is_reached(), "{:#?}", e.evidence.ladder);
            let lies = e.reactions_n[1..n].iter().filter(|force| force[2] > 0.0).count();
            let part = lies as f64 / n as f64;
            let wanted = 1.0 - 825.0_f64.sqrt() / 50.0;
            assert!((part - wanted).abs() < 1.5 / n as f64, "{n}: {part} of {wanted} lie");
            // The whole weight rests on anchors and floor.
            let borne: f64 = e.reactions_n.iter().map(|force| force[2]).sum();
            close(borne, 50.0);
        }
        errors.push((both[0].reactions_n[n][0] - 20.0).abs());
    }
    println!("{errors:?}");
    assert!(errors[5] < errors[0] / 300.0 && errors[5] < 1e-2, "{errors:?}");
}

#[test]
fn elastic_lines_on_the_floor_tend_to_rigid_ones() {
    let rigid = answers(&mooring(24, [20.0, 15.0, 50.0], None))[0].reactions_n[24][0];
    let mut last = f64::INFINITY;
    for stiffness_n in [1e4, 1e5, 1e6] {
        let soft = answers(&mooring(24, [20.0, 15.0, 50.0], Some(stiffness_n)));
        let off = (soft[0].reactions_n[24][0] - rigid).abs();
        assert!(off < 0.11 * last, "{off} after {last}");
        last = off;
    }
}

/// A net of cables and bars, hung over a floor that its middle reaches.
pub fn net(seed: u64, elastic: bool, bars: bool) -> System {
    let side = 5;
    let mut random = seed;
    // Marsaglia's xorshift: numbers from 0 to 1 that are the same everywhere.
    let mut draw = move || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut joints = vec![];
    for k in 0..side * side {
        let (row, column) = (k / side, k % side);
        let corner = row % (side - 1) == 0 && column % (side - 1) == 0;
        let at = [column as f64, row as f64, 0.5 * draw()];
        joints.push(if corner {
            Joint::anchor(k.to_string(), at)
        } else {
            Joint::free(k.to_string()).with_mass(0.2 + draw())
        });
    }
    let mut members = vec![];
    for k in 0..side * side {
        let mut add = |to: usize| {
            let body = Bar::homogeneous(1.1 + 0.2 * draw(), 0.3 * draw()).unwrap();
            let bar = draw() < 0.5 && bars;
            let member = if bar { Member::bar(k, to, body) } else { Member::cable(k, to, body) };
            members.push(if elastic { member.with_stiffness(1e3 + 1e4 * draw()) } else { member });
        };
        if k % side + 1 < side {
            add(k + 1);
        }
        if k / side + 1 < side {
            add(k + side);
        }
    }
    let system = System::new(format!("net {seed}"), 9.81, joints, members).unwrap();
    system.with_floor(-0.8 - draw()).unwrap()
}

/// Nets of cables have one minimum: forces and energy agree, and places but for joints that lie
/// loose. Bars may have several: where the answers are not one, each is judged to be in balance and
/// their energies differ.
#[test]
fn both_solvers_lay_nets_on_the_floor_alike() {
    let (mut lying, mut loose, mut apart) = (0, 0, vec![]);
    for seed in 1..=20_u64 {
        for (elastic, bars) in [(false, false), (true, false), (false, true), (true, true)] {
            let system = net(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15), elastic, bars);
            let answer = ask(&system, Solvers::Both, &|_| {});
            let agreement = answer.agreement.as_ref().unwrap();
            if bars && !answer.agrees() {
                assert!(agreement.statics.iter().all(|found| found.passes(1e-8)));
                if agreement.energy_j > 1e-3 {
                    apart.push(agreement.energy_j);
                } else {
                    // One answer: a stiff member without force is a little beyond its budget.
                    let same = agreement.joints_m < 1e-12 && agreement.forces_n < 1e-12;
                    assert!(same, "{seed} {elastic}: {agreement:?}");
                }
                continue;
            }
            assert!(answer.agrees(), "{seed} {elastic} {bars}: {agreement:?}");
            loose += agreement.free_joints;
            let joints = system.joints().iter().zip(&answer.equilibria[0].reactions_n);
            lying += joints.filter(|(j, force)| !j.support.is_fixed() && force[2] > 0.0).count();
        }
    }
    println!("{lying} joints lie, {loose} of them loose; apart: {apart:?}");
    assert!(lying > 200 && loose > 50 && apart.len() <= 8, "{lying} {loose} {apart:?}");
}

/// Answers of others: with forces and without, on the floor and below it.
#[test]
fn answers_of_others_are_judged_above_the_floor() {
    let system = drawn_aside(3.0);
    let found = |x: f64, z: f64, axial_n: Option<f64>| {
        let at = vec![[0.0; 3], [x, 0.0, z]];
        let axial_n = axial_n.map(|n| vec![n]);
        let answer = ForeignAnswer::in_order(&system, "a table", at, axial_n).unwrap();
        judge_foreign(&system, &answer, bounds::TOLERANCE, &|_| {}).unwrap()
    };
    for axial_n in [Some(5.0), None] {
        let good = found(3.0, -4.0, axial_n);
        assert_eq!(good.finding, Finding::Confirmed, "{:?}", good.violations);
        assert_eq!(good.ladder.highest(), Some(Rung::Optimal), "{:?}", good.ladder);
    }
    // The pendulum that knows no floor hangs lower.
    let size = 109.0_f64.sqrt();
    let low = found(15.0 / size, -50.0 / size, Some(size));
    assert_eq!(low.finding, Finding::Refuted);
    assert!(
        low.violations
            .iter()
            .any(|v| v.law == Law::BelowFloor && (v.value - (50.0 / size - 4.0)).abs() < 1e-9)
    );
    // With twice the force aside the floor would have to pull.
    let heavy = drawn_aside(9.0);
    let at = vec![[0.0; 3], [3.0, 0.0, -4.0]];
    let answer = ForeignAnswer::in_order(&heavy, "a table", at, Some(vec![15.0])).unwrap();
    let pulled = judge_foreign(&heavy, &answer, bounds::TOLERANCE, &|_| {}).unwrap();
    assert_eq!(pulled.finding, Finding::Refuted);
    let pulls =
        |law: &Law| matches!(law, Law::FloorPulls { force_n } if (force_n - 2.0).abs() < 1e-9);
    assert!(pulled.violations.iter().any(|v| pulls(&v.law)), "{:?}", pulled.violations);
}

/// Two thousand members: the set of those that lie is found in a few rounds, whatever their number.
#[test]
fn long_lines_settle_on_the_floor() {
    let system = mooring(2000, [20.0, 15.0, 50.0], None);
    let both = answers(&system);
    for e in &both {
        assert!((e.reactions_n[2000][0] - 20.0).abs() < 1e-4, "{}", e.reactions_n[2000][0]);
    }
    println!("{}", both[0].evidence.iterations);
    assert!(both[0].evidence.iterations < 400, "{}", both[0].evidence.iterations);
}

/// What is below the floor, pulled by it or pushed above it is found.
#[test]
fn the_judge_knows_the_floor() {
    let system = drawn_aside(3.0);
    let good = answers(&system).remove(0);
    assert!(judge(&system, &good).passes(1e-12));
    let with = |place: Vector, push_n: f64| {
        let mut wrong = good.clone();
        wrong.joints_m[1] = place;
        wrong.reactions_n[1] = [0.0, 0.0, push_n];
        judge(&system, &wrong)
    };
    let [x, _, z] = good.joints_m[1];
    assert!(with([x, 0.0, z], good.reactions_n[1][2]).passes(1e-12));
    // The rod is a little too long as well.
    assert!(with([x, 0.0, z - 0.01], 6.0).support > 1e-3);
    assert!(with([x, 0.0, z + 0.01], 6.0).joint > 1e-3);
    assert!(with([x, 0.0, z], -6.0).joint > 0.5);
    // A floor that answers aside.
    let mut aside = good.clone();
    aside.reactions_n[1][0] = 1.0;
    assert!(judge(&system, &aside).joint > 0.1);
    // Without the push of the floor nothing is proved.
    let mut unheld = good;
    unheld.reactions_n[1] = [0.0; 3];
    assert!(certify(&system, &unheld).is_err());
}
