//! Heavy elastic cables: the catenary table of MoorPy's tests, and two tests of code_aster.

use model::system::{Joint, Member, Support, System, SystemError};
use model::{Bar, SolverName};
use toml::{Table, Value};

use super::elastic_catenary::{ElasticCatenary, EndForces};
use super::entry::{BothSolvers, Compared, Entry, HandCheck};
use super::run_of_members::{end_forces, run_of_members, run_on_floor};
use crate::built_in::{count, key, number, numbers, optional, parsed, tables, texts};
use crate::foreign::{ForeignAnswer, judge_foreign};
use crate::question::Solvers;
use crate::systems::ask;

const MOORPY: &str = "NREL MoorPy, tests/test_catenary.py, \
    github.com/NREL/MoorPy, commit 9881074d9c75";
const HEAVY_CABLE: &str =
    "EDF, code_aster, validation manual V6.02.114 (input) and V6.05.116, section 2.2 (number)";
const STAYED_FRAME: &str = "EDF, code_aster, validation manual V6.02.105 (SSNL105), section 2";
/// Members of a run for the report.
const MEMBERS: usize = 100;

/// The table of MoorPy's tests.
///
/// # Panics
/// Never: a test reads the file that is compiled in.
pub fn moorpy() -> Vec<Entry> {
    let file = parsed(include_str!("../../data/external/moorpy-catenary.toml"));
    let tolerance = key(&file, "tolerance", number);
    key(&file, "case", tables).into_iter().map(|case| moorpy_case(case, tolerance)).collect()
}

fn moorpy_case(case: &Table, tolerance: f64) -> Entry {
    let title = format!("mooring line, index {}", key(case, "index", count));
    // Of a floor at the height of the lower end, where there is one.
    let friction = optional(case, "friction", number);
    if friction.is_some_and(|friction| friction > 0.0) {
        let because =
            "part of the line lies on a floor with friction, which is not part of our systems";
        return Entry::not_judged(title, MOORPY, because);
    }
    let [x_m, z_m, length_m, stiffness_n, weight_n_m] =
        numbers(case, ["x_m", "z_m", "length_m", "stiffness_n", "weight_n_m"]);
    // A line lighter than water hangs upwards: the mirror image has the lower end above.
    let upwards = weight_n_m < 0.0;
    let cable = ElasticCatenary { x_m, z_m, length_m, stiffness_n, weight_n_m: weight_n_m.abs() };
    let floor = friction.and_then(|_| cable.solve_on_floor());
    let Some(found) = floor.map(|floor| floor.ends).or_else(|| cable.solve()) else {
        return Entry::not_judged(title, MOORPY, "the closed form was not found");
    };
    let EndForces { horizontal_n, upper_n, lower_n } = found;
    // Forces on the line by MoorPy's signs: at A, the given end at the origin, and at B.
    let ours = if upwards {
        [horizontal_n, upper_n, -horizontal_n, lower_n]
    } else {
        [horizontal_n, -lower_n, -horizontal_n, -upper_n]
    };
    let names = ["H at A / N", "V at A / N", "H at B / N", "V at B / N"];
    let mut numbers: Vec<Compared> = names
        .iter()
        .zip(&key(case, "expected", texts))
        .zip(ours)
        .map(|((what, printed), ours)| Compared::new(what, printed, ours, Some(tolerance)))
        .collect();
    numbers.extend(optional(case, "on_floor_m", Value::as_str).zip(floor).map(
        |(printed, floor)| {
            Compared::new("length on the floor / m", printed, floor.lies_m, Some(tolerance))
        },
    ));
    // What lies bears on the floor.
    let lies_m = numbers.get(4).map_or(0.0, |number| number.published);
    let weight_n = weight_n_m * (length_m - lies_m);
    let [a, b] = [1, 3].map(|k| numbers.get(k).map_or(f64::NAN, |number| number.published));
    let by_hand = HandCheck {
        law: "the vertical forces at both ends together are the weight of the line that hangs",
        broken_n: (a + b + weight_n).abs(),
        allowed_n: tolerance * (a.abs() + b.abs()),
    };
    let solvers = by_both(&cable, &found, floor.is_some());
    Entry { title, source: MOORPY, numbers, by_hand: Some(by_hand), solvers, not_judged: None }
}

/// What both solvers make of a run of members, against the closed form.
fn by_both(cable: &ElasticCatenary, closed: &EndForces, on_floor: bool) -> Option<BothSolvers> {
    let run = if on_floor { run_on_floor } else { run_of_members };
    let answer = ask(&run(cable, MEMBERS).ok()?, Solvers::Both, &|_| {});
    // A lower end on the floor bears half of its first member.
    let counted = if on_floor { 2 } else { 3 };
    let wanted = [closed.horizontal_n, closed.upper_n, closed.lower_n];
    let largest = wanted.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
    let off = |forces: [f64; 3]| {
        forces.iter().zip(wanted).take(counted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            / largest
    };
    let by = |solver: SolverName| {
        let found = answer.by(&solver).and_then(end_forces).map(off);
        (solver, found)
    };
    let off = vec![by(SolverName::LAGRANGE), by(SolverName::ENERGY)];
    Some(BothSolvers::Run { members: MEMBERS, off })
}

/// The two tests of code_aster.
///
/// # Panics
/// Never: a test reads the file that is compiled in.
pub fn code_aster() -> Vec<Entry> {
    let file = parsed(include_str!("../../data/external/code-aster.toml"));
    let [cable, stays] =
        ["heavy_cable", "stayed_frame"].map(|name| key(&file, name, Value::as_table));
    vec![heavy(cable), frame(stays)]
}

fn heavy(cable: &Table) -> Entry {
    let title = "cable of 325 m between level ends 325 m apart";
    let given = |name| key(cable, name, number);
    let area_m2 = given("area_m2");
    let closed = ElasticCatenary {
        x_m: given("span_m"),
        z_m: 0.0,
        length_m: given("length_m"),
        stiffness_n: given("modulus_pa") * area_m2,
        weight_n_m: given("density_kg_m3") * area_m2 * given("gravity_m_s2"),
    };
    let Some(found) = closed.solve() else {
        return Entry::not_judged(title, HEAVY_CABLE, "the closed form was not found");
    };
    let printed = key(cable, "sag_m", Value::as_str);
    let number = Compared::new("height of the middle / m", printed, -found.sag_m(&closed), None);
    Entry {
        title: title.to_owned(),
        source: HEAVY_CABLE,
        numbers: vec![number],
        by_hand: None,
        solvers: by_both(&closed, &found, false),
        not_judged: None,
    }
}

/// A square of bars with cables on its diagonals, in the plane: one is taut, the other slack.
fn square(force_n: f64) -> Result<System, SystemError> {
    let at = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let in_plane = |k: usize| Support::Plane { at_m: at[k], normal: [0.0, 0.0, 1.0] };
    let held = |name: &str, support| Joint::free(name).held_by(support);
    let joints = vec![
        Joint::anchor("1", at[0]),
        held("2", in_plane(1)),
        held("3", in_plane(2)).with_force([force_n, 0.0, 0.0]),
        held("4", Support::Line { at_m: at[3], direction: [1.0, 0.0, 0.0] }),
    ];
    let length = |length_m| {
        Bar::homogeneous(length_m, 0.0).map_err(|_| SystemError::Overflow("length of a member"))
    };
    let (side, diagonal) = (length(1.0)?, length(std::f64::consts::SQRT_2)?);
    let mut members: Vec<Member> =
        [[0, 1], [1, 2], [2, 3], [3, 0]].map(|[a, b]| Member::bar(a, b, side)).into();
    members.extend([[0, 2], [1, 3]].map(|[a, b]| Member::cable(a, b, diagonal)));
    System::new("stayed frame", model::STANDARD_GRAVITY_M_S2, joints, members)
}

fn frame(published: &Table) -> Entry {
    let title = "square frame with two stays";
    let [force_n, tolerance] = numbers(published, ["force_n", "tolerance"]);
    // The stay is the diagonal of a square with the force along a side.
    let numbers = [
        ("force of the taut stay / N", "diagonal_n", force_n * std::f64::consts::SQRT_2),
        ("force of bar 3-4 / N", "bar_n", -force_n),
    ]
    .map(|(what, name, ours)| {
        Compared::new(what, key(published, name, Value::as_str), ours, Some(tolerance))
    });
    let [diagonal_n, bar_n] = numbers.each_ref().map(|number| number.published);
    let judged = square(force_n).ok().and_then(|system| {
        let joints_m = system.joints().iter().filter_map(|joint| joint.support.at_m()).collect();
        let forces = vec![0.0, 0.0, bar_n, 0.0, diagonal_n, 0.0];
        let answer = ForeignAnswer::in_order(&system, "code_aster", joints_m, Some(forces)).ok()?;
        judge_foreign(&system, &answer, tolerance, &|_| {}).ok()
    });
    let Some(judged) = judged else {
        return Entry::not_judged(title, STAYED_FRAME, "the frame could not be judged");
    };
    let half = diagonal_n * std::f64::consts::FRAC_1_SQRT_2;
    let left_n = (force_n - half).hypot(bar_n + half);
    Entry {
        title: title.to_owned(),
        source: STAYED_FRAME,
        numbers: numbers.into(),
        by_hand: Some(HandCheck {
            law: "stay, bar and load balance at the corner where they meet",
            broken_n: left_n,
            allowed_n: tolerance * force_n,
        }),
        solvers: judged.nearest().map(|nearest| BothSolvers::Judged {
            finding: judged.finding.word(),
            joints_m: nearest.joints_m,
            rung: judged.ladder.highest(),
        }),
        not_judged: None,
    }
}

#[cfg(test)]
mod tests;
