//! The gallery: systems of bars, hanging or drawn, and ropes over pulleys, of which a number is known in a closed form, by
//! both solvers.
//!
//! Each reference number is of kind `analytic`: it follows from the numbers of the system file by
//! the formula that stands beside it, and from no solver.

use model::STANDARD_GRAVITY_M_S2 as G;
use model::cases::{Case, exhibits};
use model::system::{System, SystemEquilibrium};

use crate::question::Solvers;
use crate::systems::{SystemAnswer, ask};

/// A number of an exhibit that is known in a closed form.
#[derive(Debug, Clone, Copy)]
pub struct ClosedForm {
    /// What it is.
    pub what: &'static str,
    /// How it follows from the numbers of the system file.
    pub formula: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// The same number of an answer.
    pub of: fn(&System, &SystemEquilibrium) -> f64,
}

/// An exhibit with its answers and what it is held against.
#[derive(Debug, Clone)]
pub struct Piece {
    /// The system file with its name.
    pub exhibit: &'static Case,
    /// The system.
    pub system: System,
    /// What both solvers and the judges say.
    pub answer: SystemAnswer,
    /// What is known.
    pub closed_form: ClosedForm,
}

/// All of the gallery, and the structures that stand where they are drawn, solved.
///
/// ```
/// for piece in validate::gallery::solve() {
///     let wanted = piece.closed_form.value;
///     assert!(piece.answer.agrees());
///     for e in &piece.answer.equilibria {
///         let found = (piece.closed_form.of)(&piece.system, e);
///         assert!((found - wanted).abs() < 1e-11 * wanted.abs(), "{}", piece.exhibit.name);
///     }
/// }
/// ```
pub fn solve() -> Vec<Piece> {
    let one = |exhibit: &'static Case| {
        let system = exhibit.system();
        let answer = ask(&system, Solvers::Both, &|_| {});
        Some(Piece { exhibit, system, answer, closed_form: closed_form(exhibit.name)? })
    };
    exhibits().filter_map(one).collect()
}

/// What is known of an exhibit.
fn closed_form(name: &str) -> Option<ClosedForm> {
    let (what, formula, unit, value, of): (_, _, _, f64, fn(&System, &SystemEquilibrium) -> f64) =
        match name {
            "lamp" => ("pull of the shorter cable", "4/5 m g", "N", 0.8 * 2.0 * G, |s, e| {
                axial(s, e, "A", "lamp")
            }),
            "bridle" => ("upward force at an anchor", "1/3 of 24 kg g", "N", 8.0 * G, |s, e| {
                reaction(s, e, "A")[2]
            }),
            "mobile" => (
                "force of the uppermost beam",
                "−(3 kg g · 0.4 m / 0.3 m − 0.5 N)",
                "N",
                0.5 - 3.0 * G * 0.4 / 0.3,
                |s, e| axial(s, e, "L1", "R1"),
            ),
            "footbridge" => (
                "level pull of a cable",
                "65 kg g d n² / (8 f), d = 2 m, n = 6, f = 3 m",
                "N",
                65.0 * G * 2.0 * 36.0 / 24.0,
                |s, e| reaction(s, e, "l6")[0],
            ),
            "net" => ("upward force at a corner", "1/4 of 28.8 kg g", "N", 7.2 * G, |s, e| {
                reaction(s, e, "8-8")[2]
            }),
            "ring" => ("upward force at an anchor", "1/3 of 12 kg g", "N", 4.0 * G, |s, e| {
                reaction(s, e, "A")[2]
            }),
            "tripod" => {
                ("pull of a leg", "1/3 of 30 kg g · 3 m / 2.4 m", "N", 12.5 * G, |s, e| {
                    axial(s, e, "A", "top")
                })
            }
            "pendulum-chain" => (
                "pull of the uppermost bar",
                "√((20 N)² + (5.5 kg g)²)",
                "N",
                20.0_f64.hypot(5.5 * G),
                |_, e| e.axial_n[0],
            ),
            "four-bar-linkage" => {
                ("pull of a crank", "5/8 of 8 kg g", "N", 5.0 * G, |s, e| axial(s, e, "A", "C"))
            }
            "warren-truss" => (
                "force of the end diagonal",
                "−5/2 · 100 kg g · √89/8",
                "N",
                -250.0 * G * 89.0_f64.sqrt() / 8.0,
                |s, e| axial(s, e, "A", "E"),
            ),
            "pratt-truss" => {
                ("upward force at the roller", "3/2 · 1000 N", "N", 1500.0, |s, e| {
                    reaction(s, e, "L4")[2]
                })
            }
            "lattice-tower" => ("upward force at all feet", "200 kg g", "N", 200.0 * G, |_, e| {
                e.reactions_n.iter().map(|force| force[2]).sum()
            }),
            "star-dome" => {
                ("upward force at all supports", "the load", "N", 294.196_481_19, |_, e| {
                    e.reactions_n.iter().map(|force| force[2]).sum()
                })
            }
            "geiger-dome" => {
                ("upward force at a support", "1/8 of 180 kg g", "N", 22.5 * G, |s, e| {
                    reaction(s, e, "S0")[2]
                })
            }
            "ring-on-a-rope" => {
                ("pull of the rope", "5/6 of 10 kg g", "N", 50.0 * G / 6.0, |_, e| e.axial_n[0])
            }
            "tackle" => ("pull of the rope", "1/3 of 60 kg g", "N", 20.0 * G, |_, e| e.axial_n[0]),
            _ => return None,
        };
    Some(ClosedForm { what, formula, unit, value, of })
}

/// Axial force of the member between two joints, N.
fn axial(system: &System, e: &SystemEquilibrium, from: &str, to: &str) -> f64 {
    let ends = [from, to].map(|name| system.joint(name));
    let between = system.members().iter().position(|m| [Some(m.from), Some(m.to)] == ends);
    between.map_or(f64::NAN, |member| e.axial_n[member])
}

/// Force of the ground on a joint, N.
fn reaction(system: &System, e: &SystemEquilibrium, joint: &str) -> [f64; 3] {
    system.joint(joint).map_or([f64::NAN; 3], |joint| e.reactions_n[joint])
}

#[cfg(test)]
mod tests;
