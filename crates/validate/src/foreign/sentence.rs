//! The words of a judgement, all of them.

use std::fmt::{self, Display, Formatter};

use model::Place;
use model::number::{Brief, Rounded};
use model::system::{Member, System};
use numerics::vector::{minus, norm};

use super::bounds::STORED;
use super::digits;
use super::given::member_name;
use super::judgement::{Finding, ForcesJudged, Judgement};
use super::violation::{Law, Violation};

impl Display for Finding {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Confirmed => f.write_str("confirmed: an equilibrium is within the tolerance"),
            Self::Refuted => f.write_str(
                "refuted: a law is broken by more than the tolerance explains, so no equilibrium is within it",
            ),
            Self::Far { joints_m, allowed_m } => write!(
                f,
                "undecided: no law is broken beyond the tolerance, but the nearest equilibrium found is {} m away, \
                 and the tolerance is {} m",
                Brief(*joints_m),
                Brief(*allowed_m)
            ),
            Self::OtherForces { forces_n, allowed_n } => write!(
                f,
                "undecided: the positions are those of an equilibrium, whose forces differ by {} N from \
                 those given; the tolerance is {} N",
                Brief(*forces_n),
                Brief(*allowed_n)
            ),
            Self::LoadsHidden { member, force_n, loads_n, allowed_n } => write!(
                f,
                "undecided: the positions are those of an equilibrium, but the forces, up to {} N in member \
                 {member}, exceed the load of any joint ({} N) by so much that the tolerance, {} N, hides them: \
                 a self-stress of any size may be among the forces",
                Brief(*force_n),
                Brief(*loads_n),
                Brief(*allowed_n)
            ),
            Self::NoEquilibrium => {
                f.write_str("undecided: no law is broken, and no solver found an equilibrium")
            }
            Self::ForcesNotFound => {
                f.write_str("undecided: the forces found do not balance to the tolerance, nor is it proved that none do")
            }
        }
    }
}

impl Finding {
    /// The finding in a word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            _ => "undecided",
        }
    }
}

impl Law {
    /// The law in a word or two.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Support => "support",
            Self::Length { .. } => "length",
            Self::Elongation { .. } => "elongation",
            Self::Sign { .. } => "sign",
            Self::Slack { .. } => "slackness",
            Self::Tension { .. } => "one tension",
            Self::Balance { .. } => "balance",
            Self::Reaction { .. } => "force of the ground",
            Self::Whole { .. } => "balance of the whole",
            Self::BelowFloor => "floor",
            Self::FloorPulls { .. } => "push of the floor",
        }
    }
}

/// Enough digits to see a difference of 1e-9 of a length.
fn fine(value: f64) -> Rounded {
    Rounded { value, digits: 10 }
}

struct Force([f64; 3]);

impl Display for Force {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (before, part) in ["(", ", ", ", "].into_iter().zip(self.0) {
            f.write_str(before)?;
            write!(f, "{}", Rounded { value: part, digits: 7 })?;
        }
        f.write_str(") N")
    }
}

impl Violation {
    /// Where it is, by name.
    pub fn place_in(&self, system: &System) -> String {
        match self.place {
            Place::Member(k) if k >= 1 && k <= system.members().len() => {
                format!("member {}", member_name(system, k - 1))
            }
            Place::Joint(k) if k < system.joints().len() => {
                format!("joint {}", system.joints()[k].name)
            }
            Place::Whole => "the whole".to_owned(),
            Place::Member(k) => format!("member {k}"),
            Place::Joint(k) => format!("joint {k}"),
        }
    }

    /// What is broken, with its numbers.
    pub fn what(&self) -> String {
        match self.law {
            Law::Support => format!("{} m off its support", fine(self.value)),
            Law::BelowFloor => format!("{} m below the floor", fine(self.value)),
            Law::FloorPulls { force_n } => {
                format!("the floor would have to pull it down with {} N", fine(force_n))
            }
            Law::Length { length_m, distance_m } => {
                let more = if distance_m > length_m { "more" } else { "less" };
                format!(
                    "its joints are {} m apart, {} m {more} than its length of {} m",
                    fine(distance_m),
                    fine(self.value),
                    fine(length_m)
                )
            }
            Law::Elongation { force_n, elastic_n } => format!(
                "carries {} N, and its elongation gives {} N",
                fine(force_n),
                fine(elastic_n)
            ),
            Law::Sign { force_n } if force_n < 0.0 => {
                format!("a cable that pushes with {} N", fine(-force_n))
            }
            Law::Sign { force_n } => format!("a strut that pulls with {} N", fine(force_n)),
            Law::Slack { force_n, length_m, distance_m } => format!(
                "carries {} N, though its joints are {} m apart and its length is {} m",
                fine(force_n),
                fine(distance_m),
                fine(length_m)
            ),
            Law::Tension { member, sides_n: [before_n, after_n] } => format!(
                "the rope (member {member}) pulls with {} N on one side and {} N on the other",
                fine(before_n),
                fine(after_n)
            ),
            Law::Balance { left_n } => format!("{} are left over", Force(left_n)),
            Law::Reaction { given_n, wanted_n } => format!(
                "the ground is said to push with {}, and its members and loads need {}",
                Force(given_n),
                Force(wanted_n)
            ),
            Law::Whole { left_n } => {
                format!("forces of the ground and loads together leave {}", Force(left_n))
            }
        }
    }
}

impl Judgement {
    /// Which forces were judged, in a sentence.
    pub fn forces_sentence(&self) -> String {
        match &self.forces {
            ForcesJudged::Given => match self.force_digits {
                None => "The forces are those of the answer.".to_owned(),
                Some(digits) => format!(
                    "The forces are those of the answer, taken as printed to {digits} digits: known to {} N.",
                    Brief(self.bounds.force_n)
                ),
            },
            ForcesJudged::Found(best) => format!(
                "The answer has no forces: those that balance best leave {} N (root of the sum of squares over \
                 the joints), the largest of them is {} N.",
                Brief(best.residual_n),
                fine(best.largest_n)
            ),
        }
    }

    /// At which tolerance the answer would be confirmed, if it is not and there is one; and to what
    /// its positions look rounded, if that explains it.
    pub fn tolerance_sentence(&self, system: &System) -> Option<String> {
        let Some(tolerance) = self.confirmed_at else { return self.unit_sentence(system) };
        let confirmed = format!("with --tolerance {tolerance:.0e} the answer is confirmed.");
        let moving = system.joints().iter().zip(&self.answer.joints_m);
        let moving = moving.filter(|(joint, _)| !joint.support.is_fixed());
        let rounded = digits::places(moving.flat_map(|(_, at_m)| *at_m)).and_then(|places| {
            let unit_m = 0.1_f64.powi(i32::try_from(places).ok()?);
            // Half a unit in every direction.
            // More than the tolerance allows, else something other than the places is wrong.
            let explained = self.nearest()?.joints_m
                <= 0.5 * 3.0_f64.sqrt() * unit_m * (1.0 + STORED)
                && unit_m > self.bounds.position_m;
            explained.then(|| format!("Positions look rounded to {unit_m:.places$} m: "))
        });
        let capital = || format!("W{}", &confirmed[1..]);
        Some(rounded.map_or_else(capital, |rounded| rounded + &confirmed))
    }

    /// In which unit the places seem to be, if in that and not in metres members are as long as in the system.
    fn unit_sentence(&self, system: &System) -> Option<String> {
        /// How far all lengths together may be from those of the system: elastic members stretch, slack ones sag, and
        /// anchors that the answer leaves out are in metres.
        const NEAR: f64 = 0.1;
        let at_m = &self.answer.joints_m;
        let spans = system.members().iter().flat_map(Member::spans);
        let distances_m: f64 = spans.map(|[a, b]| norm(minus(at_m[a], at_m[b]))).sum();
        let lengths_m: f64 = system.members().iter().map(|one| one.body.length_m()).sum();
        let units = [("millimetres", 1e-3), ("centimetres", 1e-2), ("feet", 0.3048)];
        let fits = |unit_m: f64| (unit_m * distances_m / lengths_m - 1.0).abs() < NEAR;
        let (unit, _) = units.into_iter().find(|(_, unit_m)| fits(*unit_m))?;
        Some(format!("The places seem to be in {unit}: they are read in metres."))
    }

    /// How large the error is, one sentence for each equilibrium and each solver without one.
    pub fn error_sentences(&self, system: &System) -> Vec<String> {
        let start = if self.nearest.without_guess { "without a guess" } else { "from the answer" };
        let found = self.nearest.equilibria.iter().map(|one| {
            let rung = one.equilibrium.evidence.rung();
            let rung = rung.map_or_else(|| "no rung".to_owned(), |rung| rung.to_string());
            let joint = system
                .joints()
                .get(one.joint)
                .map_or_else(String::new, |joint| joint.name.to_string());
            let forces = match one.member.checked_sub(1) {
                Some(k) if k < system.members().len() => format!(
                    "; forces differ by up to {} N, in member {}",
                    Brief(one.forces_n),
                    member_name(system, k)
                ),
                _ => String::new(),
            };
            // The bounds are rounded outwards: by less than a unit of the last digit told.
            let proved = one.proved.as_ref().map_or_else(String::new, |proved| {
                let [nearest_m, farthest_m] = outwards(proved.joints_m).map(Brief);
                let [least_n, most_n] = outwards(proved.forces_n).map(Brief);
                format!(
                    " Proved: the largest error of a joint is between {nearest_m} and {farthest_m} \
                     m, of a force between {least_n} and {most_n} N."
                )
            });
            let away = if one.joints_m > 0.0 || one.joints_m.is_nan() {
                format!("up to {} m away, at joint {joint}", Brief(one.joints_m))
            } else {
                "in the same places".to_owned()
            };
            let falls = one.equilibrium.stability.index_in_space > 0;
            let what = if falls { "an unstable equilibrium" } else { "an equilibrium" };
            format!(
                "{}, {start}, finds {what} ({rung}) {away}{forces}.{proved}",
                one.equilibrium.solver
            )
        });
        let failed =
            self.nearest.failures.iter().map(|failure| format!("No equilibrium by {failure}."));
        found.chain(failed).collect()
    }
}

/// An enclosure that stays one when its ends are told with four digits.
fn outwards([least, most]: [f64; 2]) -> [f64; 2] {
    const HALF_A_UNIT: f64 = 5e-4;
    [least * (1.0 - HALF_A_UNIT), most * (1.0 + HALF_A_UNIT)]
}

#[cfg(test)]
mod tests;
