//! Why a rung is open, in words.

use std::fmt::{self, Display, Formatter};

use super::size;
use crate::evidence::reason::{NoAnswer, Reason};

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
                "one family with slack bars is not a manifold: they also fit into one line, or close upon themselves",
            ),
            Self::SingularFamilies { listed } => write!(
                f,
                "{listed} families with slack bars are not manifolds: they also fit into one line, or close upon \
                 themselves"
            ),
            Self::StraightPosition { sides } => write!(
                f,
                "sides {} are together as long as the others: a straight position exists, and the configuration space \
                 is not a manifold there",
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
