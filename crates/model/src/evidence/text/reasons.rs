//! Why a rung is open, in words.

use std::fmt::{self, Display, Formatter};

use super::{counted, ordinal, size};
use crate::evidence::certificate::NoCertificate;
use crate::evidence::complete::NoCensus;
use crate::evidence::reason::{NoAnswer, Reason};
use crate::evidence::verified::NoBox;

/// Each part in a sentence.
fn sentences(parts: &[impl Display]) -> Vec<String> {
    parts.iter().map(ToString::to_string).collect()
}

/// What the judge of balance found of an answer that stands alone.
fn balance(f: &mut Formatter<'_>, statics: f64) -> fmt::Result {
    let statics = size(f, statics);
    write!(f, "; the statics judge finds every bar in balance to {statics}")
}

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotTried => f.write_str("not tried"),
            Self::AboveTolerance(convergence) => convergence.fmt(f),
            Self::OneSolverOnly { solver, statics } => {
                write!(f, "only {solver} was asked")?;
                balance(f, *statics)
            }
            Self::OtherSolverWithoutAnswer { solver, because, statics } => {
                write!(f, "{solver} {because}")?;
                balance(f, *statics)
            }
            Self::SolversDisagree(disagreement) => disagreement.fmt(f),
            Self::JudgeRefuses { excesses } => {
                write!(f, "the judge refuses this answer: {}", sentences(excesses).join("; "))
            }
            Self::RefutedByCensus { distance } => write!(
                f,
                "refuted: the census lists all equilibria with proof, and the nearest lies {distance:.1e} of the total \
                 length away"
            ),
            Self::NoCensus(because) => because.fmt(f),
            Self::SlackFamily => f.write_str(
                "the answer is one of a family with slack bars, which the census lists as a whole: it is not alone in \
                 any box",
            ),
            Self::NotAmongDecided { cells } => write!(
                f,
                "the census leaves {cells} cells of pulls undecided, and this answer is in none of its boxes"
            ),
            Self::Elsewhere { distance } => write!(
                f,
                "the nearest equilibrium of the census lies {distance:.1e} of the total length away"
            ),
            Self::AtStraight { distance } => write!(
                f,
                "the answer lies within {distance:.1e} of the total length of a straight position, which the census lists \
                 apart: all bars lie in the vertical through both anchors, in equilibrium under any force along it"
            ),
            Self::NothingListed => {
                f.write_str("the census lists no equilibrium to compare with")
            }
            Self::CensusUndecided { cells } => write!(f, "{cells} cells of pulls are undecided"),
            Self::SingularFamilies { listed: 1 } => f.write_str(
                "one family with slack bars is no manifold: they also fit into one line, or close upon themselves",
            ),
            Self::SingularFamilies { listed } => write!(
                f,
                "{listed} families with slack bars are no manifolds: they also fit into one line, or close upon \
                 themselves"
            ),
            Self::StraightPosition { sides } => write!(
                f,
                "sides {} are together as long as the others: a straight position exists, and the configuration space \
                 is no manifold there",
                sides.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
            ),
            Self::CountUnchecked { sides } => write!(
                f,
                "the number of equilibria is not checked: the topology of a polygon of {sides} sides is not counted"
            ),
            Self::NoBox(because) => because.fmt(f),
            Self::NoCertificate(because) => because.fmt(f),
        }
    }
}

impl Display for NoAnswer {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MinimaOnly => "looks for minima and has no answer here",
            Self::Refused => "has no answer",
        })
    }
}

impl Display for NoCensus {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAsked => f.write_str("no census was taken (`funicular census` takes one, where there can be one)"),
            Self::TooManyBars { bars, limit } => {
                write!(f, "no census: {bars} bars, and the limit is {limit}")
            }
            Self::Settings => f.write_str("no census: its settings are out of range"),
            Self::Refused => f.write_str("no census: the system is no equilibrium problem"),
            Self::Closures { closures } => write!(
                f,
                "no census: {closures} independent closures in one part, with more joints than are searched or self-stresses"
            ),
            Self::Motions { closures, motions, limit } => write!(
                f,
                "no census: a net of {closures} closures whose joints move in {motions} independent ways, and the limit \
                 is {limit}"
            ),
            Self::Bridle { bars, limit } => {
                write!(f, "no census: the strands of a bridle have {bars} bars, and the limit is {limit}")
            }
            Self::Undecided { boxes } => {
                write!(f, "{boxes} boxes of places of the joints of a net are undecided")
            }
            Self::PlaneOnly => f.write_str(
                "the list is complete among the configurations in the vertical plane of the anchors; no others were looked for",
            ),
            Self::Turns { joint } => write!(
                f,
                "no census: what hangs at the {} joint turns freely about the vertical",
                ordinal(*joint)
            ),
            Self::LoadsNotDown { joint } => write!(
                f,
                "no census: the {} joint of a chain between anchors bears a force that is not straight down",
                ordinal(*joint)
            ),
            Self::Elastic { member } => {
                write!(
                    f,
                    "no census: member {member} is elastic, in a chain between anchors or between joints that nothing \
                     inextensible bounds"
                )
            }
            Self::Limp { member } => write!(
                f,
                "no census: member {member} bears nothing that is proved to turn it, and may point anywhere or be slack \
                 and taut"
            ),
            Self::Flat { joint } => write!(
                f,
                "no census: the members that hold the {} joint may lie flat, or nothing pulls it aside",
                ordinal(*joint)
            ),
            Self::Floor => f.write_str("no census knows a floor"),
            Self::Slider { joint } => {
                write!(
                    f,
                    "no census: the {} joint slides; only chains and trees that slide in the vertical plane of their \
                     anchors and loads have one",
                    ordinal(*joint)
                )
            }
            Self::Cables => f.write_str(
                "no census: of cables and ropes alone an equilibrium that is verified is the only one, and none is",
            ),
            Self::Loose { joint } => write!(
                f,
                "no census: nothing holds the {} joint, which bears no load, where members are slack",
                ordinal(*joint)
            ),
            Self::SlackSets { limit } => write!(
                f,
                "no census: its cables, struts and ropes may be slack or jam in more than {limit} ways"
            ),
            Self::TooManyPositions { limit } => {
                write!(f, "no census: more than {limit} equilibria")
            }
        }
    }
}

impl Display for NoCertificate {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::SeveralCompressed { bars } => write!(
                f,
                "{bars} bars are in compression: the stress matrix is indefinite, there is less energy elsewhere"
            ),
            Self::Indefinite { bar, excess } => write!(
                f,
                "bar {bar} is pressed too hard: the sum of the inverse force densities is {excess:e} of its terms, the \
                 stress matrix is indefinite, there is less energy elsewhere"
            ),
            Self::Gap { gap } if *gap < 0.0 => write!(
                f,
                "the energy is {:.1e} of weight times length below the least that any configuration has: lengths are off",
                -gap
            ),
            Self::Gap { gap } => {
                write!(f, "the lower bound stays {gap:.1e} of weight times length below the energy")
            }
            Self::NotClosed { gap_m, slack_m } => write!(
                f,
                "the last joint is {gap_m:.1e} m from its anchor, and the chain has only {slack_m:.1e} m of slack"
            ),
            Self::EnergyFalls { directions } => {
                write!(f, "the energy falls in {directions} directions")
            }
            Self::PivotsUndecided => {
                f.write_str("the pivots of the stress matrix are not proved positive")
            }
            Self::NotConvex { members } => write!(
                f,
                "a bound with ropes over rings or pulleys is known where anchors hold all parts and every member \
                 pulls, and {members} push or may push"
            ),
            Self::NotDefinite { compressed } => write!(
                f,
                "the stress matrix is not proved positive definite, with {compressed} members compressed"
            ),
            Self::Unusable => f.write_str("the answer is incomplete or not finite"),
        }
    }
}

impl Display for NoBox {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("no box is proved to hold exactly one equilibrium: ")?;
        match self {
            Self::TooLarge { unknowns, limit } => {
                write!(f, "{unknowns} unknowns, and the limit is {limit}")
            }
            Self::SelfStresses { dimension } => write!(
                f,
                "the members bear {} without any load, so the forces are a family",
                counted(*dimension, "independent state")
            ),
            Self::FreeMotions { dimension } => write!(
                f,
                "nothing brings the joints back, to first order, from {}",
                counted(*dimension, "independent motion")
            ),
            Self::Rope { member } => {
                write!(
                    f,
                    "a span of the rope that is member {member} has no length, and is not proved to bear less than its tension"
                )
            }
            Self::Degenerate { member } => {
                write!(
                    f,
                    "member {member} has just its length and bears no force but that of its own weight"
                )
            }
            Self::WrongSign { member } => {
                write!(
                    f,
                    "member {member} is not proved to bear a force of the sign that its kind allows"
                )
            }
            Self::NotSlack { member } => write!(f, "member {member} is not proved to be slack"),
            Self::BetweenAnchors { member } => {
                write!(f, "member {member} connects two anchors, and nothing tells its force")
            }
            Self::Floor { joint } => write!(
                f,
                "the {} joint is not proved to be above the floor, nor to be pushed by it",
                ordinal(*joint)
            ),
            Self::NotConverged => f.write_str(
                "no equilibrium with the same members in action is found next to the answer",
            ),
            Self::Singular => f.write_str("the derivative of the equations is singular"),
            Self::NotContracting => f.write_str(
                "Krawczyk's test fails, as it does next to places with a singular derivative",
            ),
            Self::Elsewhere { distance_m, distance_n } => write!(
                f,
                "the equilibrium that is proved is {distance_m:.1e} m and {distance_n:.1e} N away"
            ),
            Self::NotFinite => f.write_str("the answer is incomplete or not finite"),
        }
    }
}
