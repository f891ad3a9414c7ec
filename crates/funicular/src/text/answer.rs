//! The answer of `solve`, for people.

use std::fmt::{self, Write as _};

use model::number::Number;
use model::system::{Kind, Support, System, SystemEquilibrium};
use model::{Evidence, Rung, SolverName};

use super::printable::Printable;
use super::printed::quantity;
use super::shape::Shape;
use super::tables::{counted, duration, long, numbers_from, rung, short, table, word, wrapped};
use crate::extremes::Extremes;
use crate::solve::SolveAnswer;
use crate::weakest::Weakest;

/// Where the sentences of the ladder begin.
const LADDER_INDENT: usize = 15;

/// As `funicular solve` prints it.
impl fmt::Display for SolveAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&answer(self, false, false))
    }
}

/// The whole answer; how far it is proved in full, or in a line.
pub fn answer(solution: &SolveAnswer, summary: bool, evidence: bool) -> String {
    let system = solution.system();
    let mut text = system_line(system) + "\n";
    let equilibria = solution.equilibria();
    let shown = shown(solution);
    if let Some(found) = shown {
        text += &shape(system, found, Some(summary));
        text += &energy(found);
    }
    text += &question(solution);
    text += &shown.map_or_else(String::new, |found| of_a_plane(system, found));
    let answers: Vec<_> = equilibria.iter().map(|e| (&e.solver, &e.evidence)).collect();
    if evidence {
        text.push('\n');
        text += &overview(equilibria);
        text += &ladder(&answers);
    } else {
        text += &shown.map_or_else(String::new, |found| in_a_line(&found.evidence, answers.len()));
    }
    for failure in solution.failures() {
        text += &(wrapped(&format!("No answer of {failure}"), 2) + "\n");
    }
    if let Some(agreement) = solution.agreement() {
        let [joints_m, forces_n, energy_j] =
            [agreement.joints_m, agreement.forces_n, agreement.energy_j]
                .map(|x| Number::size(x, 1));
        let _ = writeln!(
            text,
            "Agreement: {} (joints {joints_m} m, forces {forces_n} N, energy {energy_j} J)",
            agreement.verdict
        );
        // What is slack ends a motion where it gets taut.
        let first = solution.equilibria().first();
        let is_slack = first.is_some_and(|e| {
            let members = solution.system().members().iter().zip(&e.axial_n);
            members.into_iter().any(|(member, n)| member.kind != Kind::Bar && n.abs() <= 0.0)
        });
        let far = if is_slack { ", as far as slack members let it" } else { "" };
        let turning = match agreement.turned_parts {
            0 => None,
            1 => Some(format!(
                "One part turns freely about a vertical: each turn of it is an equilibrium{far}."
            )),
            parts => Some(format!(
                "{parts} parts turn freely about verticals: each turn of them is an equilibrium{far}."
            )),
        };
        let names = Printable(&agreement.undetermined.join(", ")).to_string();
        let sliding = match agreement.undetermined.len() {
            0 => None,
            1 => Some(format!("Not determined by equilibrium: at least the place of {names}.")),
            _ => Some(format!("Not determined by equilibrium: at least the places of {names}.")),
        };
        let idle = (agreement.free_joints > 0).then(|| {
            let joints = counted(agreement.free_joints, "joint");
            format!(
                "Not determined by equilibrium: the place of {joints} whose members bear no force."
            )
        });
        let level = (agreement.sliding_parts > 0).then(|| {
            format!("What stands on level supports alone moves freely there: each place is an equilibrium{far}.")
        });
        let unresisted = first.map_or(0, |e| agreement.unresisted(e));
        let easy = (agreement.agrees() && unresisted > 0).then(|| {
            let motions = counted(unresisted, "motion");
            let along = if unresisted == 1 { "it" } else { "them" };
            format!(
                "Nothing resists {motions} here, to second order: other places along {along} may be equilibria too, with \
                 other forces."
            )
        });
        for sentence in turning.into_iter().chain(level).chain(sliding).chain(idle).chain(easy) {
            text += &wrapped(&sentence, 0);
            text.push('\n');
        }
    }
    text
}

/// What is solved, in lines of its own.
pub(super) fn system_line(system: &System) -> String {
    let members = counted(system.members().len(), "member");
    let joints = counted(system.joints().len(), "joint");
    let name = format!("{}: {members} between {joints},", Printable(system.name()));
    format!(
        "{}\n{} long, {}, g = {} m/s^2{}\n",
        wrapped(&name, 0),
        quantity(system.total_length_m(), "m"),
        quantity(system.total_mass_kg(), "kg"),
        short(system.gravity_m_s2()),
        stiffness(system),
    )
}

/// The axial stiffness of the members that have one, which may be made of other numbers of the file.
fn stiffness(system: &System) -> String {
    let members = system.members();
    let all = || members.iter().filter_map(|member| member.stiffness_n);
    let of = match all().count() {
        elastic if elastic < members.len() => format!(" in {elastic} of {} members", members.len()),
        _ => String::new(),
    };
    let (least, most) =
        all().fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), n| (a.min(n), b.max(n)));
    match all().next() {
        None => String::new(),
        Some(_) if least < most => {
            format!(", EA {} to {}{of}", quantity(least, "N"), quantity(most, "N"))
        }
        Some(_) => format!(", EA {}{of}", quantity(most, "N")),
    }
}

/// The energy, and whether it rises in every direction.
fn energy(found: &SystemEquilibrium) -> String {
    let energy = quantity(found.energy_j, "J");
    let index = match found.stability.index_in_space {
        0 => String::new(),
        1 => ", the energy falls in 1 direction".to_owned(),
        index => format!(", the energy falls in {index} directions"),
    };
    format!("Energy: {energy}, {}{index}.\n", word(&found.stability.in_space))
}

/// What stands out in an equilibrium, and its energy.
pub fn facts(system: &System, found: &SystemEquilibrium) -> String {
    shape(system, found, None) + &energy(found)
}

/// Which question is answered where no shape was given.
fn lowest(proved: bool) -> &'static str {
    if proved {
        "The lowest equilibrium of all (proved).\n"
    } else {
        "The lowest equilibrium found; that none is lower is not proved.\n"
    }
}

/// Who found it only when asked again.
fn again(asked_again: &[SolverName]) -> String {
    let names: Vec<_> = asked_again.iter().map(ToString::to_string).collect();
    if names.is_empty() {
        return String::new();
    }
    let who = names.join(" and ");
    wrapped(
        &format!("{who} had found another equilibrium or none, and began again next to this one."),
        0,
    ) + "\n"
}

/// The first of the answers; where they differ the one that is proved further, or lower.
fn shown(solution: &SolveAnswer) -> Option<&SystemEquilibrium> {
    let further = |a: &SystemEquilibrium, b: &SystemEquilibrium| {
        let rungs = a.evidence.rung().cmp(&b.evidence.rung());
        rungs.then(b.energy_j.total_cmp(&a.energy_j)).is_lt()
    };
    let differ = solution.agreement().is_some_and(|both| !both.agrees());
    let all = solution.equilibria().iter();
    all.reduce(|best, next| if differ && further(best, next) { next } else { best })
}

/// What is known of an answer, to stand with what is made of it.
pub fn remarks(answer: &SolveAnswer) -> String {
    let verdict = answer.agreement().map(|both| both.verdict.to_string());
    let missing = answer.failures().iter().map(|failure| format!("no answer of {failure}"));
    let is_far = answer.near().is_some_and(|near| !near.is_neighbour);
    let far = is_far.then(|| "not the neighbour of the shape given".to_owned());
    verdict.into_iter().chain(missing).chain(far).collect::<Vec<_>>().join("; ")
}

/// In a line which question this answers.
fn question(solution: &SolveAnswer) -> String {
    let proved = solution.equilibria().iter().any(|e| e.evidence.ladder.optimal.is_reached());
    let Some(near) = solution.near() else {
        return lowest(proved).to_owned() + &again(solution.asked_again());
    };
    let moved = if near.moved <= UNMOVED {
        "no joint moves".to_owned()
    } else {
        format!(
            "joint {} is {} m from it, {:.2} % of the shortest member there",
            Printable(&near.joint),
            short(near.moved_m),
            100.0 * near.moved
        )
    };
    let barrier = near.barrier_j.map_or_else(String::new, |barrier_j| {
        format!(", and the energy rises by {} J on the way", short(barrier_j))
    });
    let stays = solution.equilibria().first().is_some_and(|e| e.stability.index_in_space == 0);
    let found = if near.is_neighbour && stays && !solution.check_failed() {
        format!("The stable equilibrium next to the shape given ({moved})")
    } else if near.is_neighbour {
        format!("An equilibrium near the shape given ({moved})")
    } else {
        format!("Not the neighbour of the shape given ({moved}{barrier})")
    };
    let energy_j = shown(solution).map(|e| e.energy_j);
    let lower = match near.lower_j.zip(energy_j) {
        // That of the other answer is not lower than this one.
        Some((lower_j, here_j)) if here_j - lower_j > 1e-9 * here_j.abs() => {
            format!("; another is lower, by {} J", short(here_j - lower_j))
        }
        None if proved => "; it is the lowest of all (proved)".to_owned(),
        _ => String::new(),
    };
    // As past a limit load.
    let has_way = shown(solution).is_some_and(|e| e.stability.neutral == 0);
    let way = if near.moved > FAR && has_way {
        " The way there: funicular trace --vary loads=0.01..1"
    } else {
        ""
    };
    wrapped(&format!("{found}{lower}.{way}"), 0) + "\n" + &again(solution.asked_again())
}

/// What rounding moves, as a part of the shortest member at a joint.
const UNMOVED: f64 = 1e-12;
/// A joint that has moved by more than this part of the shortest member there is far from where it was drawn.
const FAR: f64 = 0.25;

/// How a structure that falls out of the plane in which it is drawn is kept there.
fn of_a_plane(system: &System, found: &SystemEquilibrium) -> String {
    /// What is out of a plane by no more than this part of the length of all members is drawn in it.
    const FLAT: f64 = 1e-9;
    let falls = found.stability.index_in_space > 0;
    let is_free = system.joints().iter().any(|joint| joint.support == Support::Free);
    let drawing_m = system.drawing().filter(|_| falls && is_free).unwrap_or_default();
    let first_m = found.joints_m[0];
    let lies = |axis: usize| {
        let mut places = drawing_m.iter().chain(&found.joints_m);
        places.all(|at| (at[axis] - first_m[axis]).abs() <= FLAT * system.total_length_m())
    };
    let plane = [("xz", 1), ("yz", 0)].into_iter().find(|(_, axis)| lies(*axis));
    plane.filter(|_| !drawing_m.is_empty()).map_or_else(String::new, |(plane, _)| {
        let sentence = format!(
            "All joints are drawn in one plane, and nothing holds them in it: plane = \"{plane}\" in the file does."
        );
        wrapped(&sentence, 0) + "\n"
    })
}

/// What is said of the forces besides the rungs, with a mark and of what.
fn notes(evidence: &Evidence) -> Vec<(char, &'static str, String)> {
    let stresses = evidence.self_stresses.as_ref().map(|some| ('!', "forces", some.to_string()));
    let rigidity = evidence.rigidity.as_ref().map(|some| (' ', "rigidity", some.to_string()));
    let jams = evidence.jams.iter().map(|some| ('!', "jam", some.to_string()));
    stresses.into_iter().chain(jams).chain(rigidity).collect()
}

/// The rungs in a line; and, where a check was not passed or forces are not unique, how that is.
fn in_a_line(best: &Evidence, answers: usize) -> String {
    let marks = best.ladder.statements().map(|s| format!("{} {}", mark(s.reached), s.rung));
    let mut text = wrapped(&format!("Evidence: {} (--evidence)", marks.join(" ")), 2) + "\n";
    for statement in best.ladder.statements() {
        let checked = matches!(statement.rung, Rung::Converged | Rung::Agreed);
        if checked && !statement.reached && answers > 1 {
            text += &line('-', &statement.rung.to_string(), &statement.how);
        }
    }
    let forces = notes(best).into_iter().filter(|(mark, ..)| *mark == '!');
    text = forces.fold(text, |text, (mark, of, what)| text + &line(mark, of, &what));
    if let Some(agreed) = best.ladder.agreed.proof()
        && agreed.shape_only
    {
        let choices = agreed.forces_found.as_ref().and_then(|found| found.choices.as_ref());
        let differ = choices.map(ToString::to_string);
        // Of a large system they are known to be some, but not counted.
        let uncounted = best.self_stresses.is_none().then(|| {
            "not unique: self-stresses may be added without a change of shape or balance".to_owned()
        });
        let said: Vec<String> = uncounted.into_iter().chain(differ).collect();
        if !said.is_empty() {
            text += &line('!', "forces", &said.join("; "));
        }
    }
    text
}

/// A line of the ladder.
pub(super) fn line(mark: char, of: &str, what: &str) -> String {
    wrapped(&format!("  {mark} {of:<10} {what}"), LADDER_INDENT) + "\n"
}

/// Whether a rung is reached.
pub(super) fn mark(reached: bool) -> char {
    if reached { '+' } else { '-' }
}

/// How far each equilibrium is proved, rung by rung; once where the evidence for all is the same.
fn ladder(answers: &[(&SolverName, &Evidence)]) -> String {
    let names: Vec<String> = answers.iter().map(|(solver, _)| solver.to_string()).collect();
    let mut rungs: Vec<String> = answers.iter().map(|(_, evidence)| rung(evidence)).collect();
    rungs.dedup();
    if answers.is_empty() {
        return String::new();
    }
    let mut text =
        format!("Evidence for the answer of {}: {}\n", names.join(" and "), rungs.join(" and "));
    let rows = |evidence: &Evidence| {
        let statements = evidence.ladder.statements();
        let marked = statements.into_iter().map(|s| (mark(s.reached), s.rung.to_string(), s.how));
        let notes = notes(evidence).into_iter().map(|(mark, of, what)| (mark, of.to_owned(), what));
        marked.chain(notes).collect::<Vec<_>>()
    };
    let all: Vec<_> = answers.iter().map(|(_, evidence)| rows(evidence)).collect();
    let most = all.iter().map(Vec::len).max().unwrap_or_default();
    for k in 0..most {
        let said: Vec<_> = all.iter().map(|rows| rows.get(k)).collect();
        match said[0] {
            Some((mark, of, what)) if said.iter().all(|other| *other == said[0]) => {
                text += &line(*mark, of, what);
            }
            _ => {
                for (name, row) in names.iter().zip(said) {
                    let Some((mark, of, what)) = row else { continue };
                    text += &line(*mark, of, &format!("{name}: {what}"));
                }
            }
        }
    }
    text + "\n"
}

fn overview(equilibria: &[SystemEquilibrium]) -> String {
    let mut table = table(["solver", "energy / J", "in space", "residual", "steps", "time"]);
    for e in equilibria {
        table.add_row([
            e.solver.to_string(),
            long(e.energy_j),
            format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space),
            Number::size(e.evidence.residual, 1).to_string(),
            e.evidence.iterations.to_string(),
            duration(e.evidence.solve_s),
        ]);
    }
    numbers_from(&mut table, 1);
    format!("{table}\n(in brackets: the number of directions in which the energy falls)\n\n")
}

/// An equilibrium in tables, those of joints left out in a summary, and what stands out; or that alone.
fn shape(system: &System, e: &SystemEquilibrium, tables: Option<bool>) -> String {
    let held = system.joints().iter().zip(&e.reactions_n).enumerate();
    let lies = |force: &[f64; 3]| force.iter().any(|n| n.abs() > 0.0);
    // What a plane keeps in it, as that of a planar drawing, is shown where it bears something.
    let holds = |support: Support| matches!(support, Support::Fixed { .. } | Support::Line { .. });
    let held = held.filter(|(_, (joint, force))| holds(joint.support) || lies(force));
    let shape = Shape {
        name: &|joint| Printable(&system.joints()[joint].name).to_string(),
        ends: &|bar| [system.members()[bar].from, system.members()[bar].to],
        via: &|bar| system.members()[bar].via(),
        joints_m: &e.joints_m,
        extremes: Extremes::of(system, e),
        axial: e.axial_forces(system),
        reactions_n: held.map(|(k, (_, force))| (k, *force)).collect(),
        idle: &|bar| idle(system.members()[bar].kind, e.is_idle(system, bar)),
        used: &|bar| e.utilisation(system, bar),
        weakest: Weakest::of(system, e),
        ranges: e.evidence.self_stresses.as_ref().and_then(|family| family.ranges.as_deref()),
        solver: &e.solver,
    };
    tables.map_or_else(|| shape.summary(), |summary| shape.text(summary))
}

/// What a member without force does: a cable or a strut may be away from its length, or have it and
/// bear nothing, which decides nothing about either.
fn idle(kind: Kind, is_idle: bool) -> &'static str {
    match (kind, is_idle) {
        (Kind::Bar, _) => "no force",
        (Kind::Cable, true) => "slack",
        (Kind::Cable, false) => "just taut",
        (Kind::Strut, true) => "loose",
        (Kind::Strut, false) => "just tight",
    }
}
