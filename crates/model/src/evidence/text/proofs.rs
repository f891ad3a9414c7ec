//! What is proved or found, in words.

use std::fmt::{self, Display, Formatter};

use super::{counted, ordinal, size};
use crate::evidence::agreed::{
    Agreed, Choices, Disagreement, Excess, ForcesFound, LargeForce, Place, Proved, Quantity, Room,
};
use crate::evidence::certificate::Optimal;
use crate::evidence::complete::{Complete, CompleteSystem};
use crate::evidence::convergence::{Convergence, ForceUncertainty, UncertaintyCause};
use crate::evidence::force_choice::ForceChoice;
use crate::evidence::rigidity::Rigidity;
use crate::evidence::rung::Rung;
use crate::evidence::self_stresses::SelfStresses;
use crate::evidence::status::Status;
use crate::evidence::verified::{Verified, VerifiedSystem};
use crate::number::Number;

impl Display for Rung {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::Agreed => "agreed",
            Self::Verified => "verified",
            Self::Complete => "complete",
            Self::Optimal => "optimal",
        })
    }
}

impl<P: Display> Display for Status<P> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reached(proof) => proof.fmt(f),
            Self::Open(reason) => reason.fmt(f),
        }
    }
}

impl Display for Convergence {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { residual_of, .. } = self;
        let residual = size(f, self.residual);
        write!(f, "{residual_of}: {residual} after {}", counted(self.iterations, "iteration"))?;
        match self.tolerance {
            // Also where the residual is not a number.
            Some(tolerance) if !matches!(self.residual.partial_cmp(&tolerance), Some(order) if order.is_le()) =>
            {
                write!(f, ", above the tolerance of {tolerance:.0e}")?;
            }
            _ => {}
        }
        self.force_uncertainty.map_or(Ok(()), |uncertainty| write!(f, "; {uncertainty}"))
    }
}

impl Display for ForceUncertainty {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self.cause {
            UncertaintyCause::WeakClosure => {
                "the closure hardly depends on the pull, and its rounding leaves the forces"
            }
            UncertaintyCause::ParallelBars => {
                "the bars are so nearly parallel that their directions in double precision leave the forces"
            }
        })?;
        write!(f, " uncertain by up to {:.0e} of the largest", self.relative)
    }
}

impl Display for Agreed {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (k, solver) in self.solvers.iter().enumerate() {
            let before = match k {
                0 => "",
                _ if k + 1 == self.solvers.len() => " and ",
                _ => ", ",
            };
            write!(f, "{before}{solver}")?;
        }
        let Self { joints_m, forces_n, energy_j, statics, .. } = self;
        let [joints, forces, energy, statics] =
            [joints_m, forces_n, energy_j, statics].map(|value| size(f, *value));
        write!(
            f,
            " differ by {joints} m, {forces} N, {energy} J; the statics judge finds every bar in balance to {statics}"
        )?;
        if let Some(room) = &self.room {
            write!(f, "; {room}")?;
        }
        if self.shape_only {
            f.write_str(
                "; of the shape alone: the forces are one of a family, chosen by convention",
            )?;
        }
        self.forces_found.as_ref().map_or(Ok(()), |found| write!(f, "{found}"))
    }
}

impl Display for ForcesFound {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if let Some(choices) = &self.choices {
            write!(f, "; {choices}")?;
        }
        if let Some(large) = &self.large {
            write!(f, "; {large}")?;
        }
        self.proved.map_or(Ok(()), |proved| write!(f, "; {proved}"))
    }
}

impl Display for Choices {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { between, choices, member, forces_n } = self;
        let [first, second] = forces_n.map(|force_n| Number::significant(force_n, 6));
        write!(
            f,
            "the solvers name different forces of the family: in member {member} {first} N by {} ({}), {second} N by {} ({})",
            between[0], choices[0], between[1], choices[1]
        )
    }
}

impl Display for LargeForce {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { member, force_n, ratio } = *self;
        let [force_n, ratio] = [force_n, ratio].map(|value| Number::size(value, 2));
        write!(
            f,
            "member {member} bears {force_n} N, {ratio} times all that acts on the system: the shape is nearly \
             singular"
        )
    }
}

impl Display for Proved {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rank => "proved: the lengths are independent",
            Self::Stability => "proved: the energy rises along every motion that keeps the lengths",
            Self::RankAndStability => {
                "proved: the lengths are independent, and the energy rises along every motion that keeps them"
            }
        })
    }
}

impl Display for Room {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { turning_parts, free_joints, undetermined } = self;
        let turning = match turning_parts {
            0 => None,
            1 => Some("one part turns freely about a vertical and was turned first".to_owned()),
            _ => Some(format!(
                "{turning_parts} parts turn freely about verticals and were turned onto each other first"
            )),
        };
        let free = match free_joints {
            0 => None,
            1 => Some(
                "one joint whose members bear no force is free to move and not compared".to_owned(),
            ),
            _ => Some(format!(
                "{free_joints} joints whose members bear no force are free to move and not \
                 compared"
            )),
        };
        let sliding = match &undetermined[..] {
            [] => None,
            [one] => Some(format!("{one} slides through equilibria with the same forces")),
            names => {
                Some(format!("{} slide through equilibria with the same forces", names.join(", ")))
            }
        };
        let parts: Vec<String> = [turning, free, sliding].into_iter().flatten().collect();
        f.write_str(&parts.join("; "))
    }
}

impl Display for Rigidity {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { rank, mechanisms, self_stresses, gap: [counted, left] } = *self;
        let counted = Number::size(counted, 1);
        let left = size(f, left);
        let plural = |n: usize| if n == 1 { "" } else { "s" };
        write!(
            f,
            "{rank} independent length{}, {mechanisms} mechanism{}, {self_stresses} self-stress{}; singular \
             values from {counted} of the largest count, up to {left} do not",
            plural(rank),
            plural(mechanisms),
            if self_stresses == 1 { "" } else { "es" },
        )
    }
}

impl Display for SelfStresses {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { dimension, choice, .. } = self;
        let them = if *dimension == 1 { "a self-stress" } else { "self-stresses" };
        write!(
            f,
            "one family of dimension {dimension}: {them} may be added without a change of shape or balance; the \
             forces given are {choice}"
        )
    }
}

impl Display for ForceChoice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AnchorsMovedApart => {
                "the limit for anchors moved apart level, by convention, which is no evidence for them"
            }
            Self::EquallyStiff => {
                "the limit for equally stiff members as these become rigid, by convention, which is no \
                 evidence for them"
            }
            Self::Unknown => "the solver's own choice, which is no evidence for them",
        })
    }
}

impl Display for Excess {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { what, value, budget } = self;
        write!(f, "{what}: {value:.2e} is over its budget of {budget:.2e}")
    }
}

impl Display for Quantity {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Joints { between: [a, b] } => write!(f, "joints of {a} and {b} / m"),
            Self::Forces { between: [a, b] } => write!(f, "forces of {a} and {b} / N"),
            Self::Energy { between: [a, b] } => write!(f, "energy of {a} and {b} / J"),
            Self::Statics { solver, place } => write!(f, "statics of {solver}, {place}"),
            Self::MorseIndex { between: [a, b] } => {
                write!(f, "numbers of directions in which the energy falls, by {a} and {b}")
            }
            Self::SelfStresses { solver } => {
                write!(f, "what the self-stresses of {solver} leave at a joint")
            }
            Self::NamedForces { between: [a, b] } => {
                write!(f, "forces that {a} and {b} name by the same convention / N")
            }
            Self::EquallyStiff { solver } => {
                write!(f, "forces of {solver} less those of equally stiff members / N")
            }
            Self::LargeForce { solver, member } => {
                write!(f, "force of {solver} over all that acts on the system, at member {member}")
            }
        }
    }
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Member(number) => write!(f, "at member {number}"),
            Self::Joint(number) => write!(f, "at the {} joint", ordinal(number + 1)),
            Self::Whole => f.write_str("of the whole system"),
        }
    }
}

impl Display for Disagreement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentences().join("; "))
    }
}

impl Display for Verified {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [width, distance] = [self.box_width, self.distance].map(|value| size(f, value));
        write!(
            f,
            "Krawczyk's test in intervals: exactly one equilibrium{} in a box of relative width {width}, and this \
             answer within {distance} of the total length of it",
            if self.circle { " (a circle of them, turned about the anchors)" } else { "" },
        )?;
        self.system.map_or(Ok(()), |system| system.write(f))
    }
}

impl VerifiedSystem {
    fn write(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { turns, slack, loose_joints, .. } = *self;
        let [width_m, width_n, distance_n] =
            [self.width_m, self.width_n, self.distance_n].map(|value| size(f, value));
        write!(f, "; {width_m} m and {width_n} N wide, forces within {distance_n} N")?;
        if turns > 0 {
            write!(
                f,
                "; one for each turn of what turns freely about a vertical, {}",
                counted(turns, "turn")
            )?;
        }
        if slack > 0 {
            write!(f, "; {} proved slack", counted(slack, "member"))?;
        }
        if loose_joints > 0 {
            let joints = counted(loose_joints, "joint");
            write!(
                f,
                "; one for each place near by of {joints} without load between slack members"
            )?;
        }
        Ok(())
    }
}

impl Display for Complete {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { in_plane, families, patterns, cells, system } = self;
        match system {
            None => write!(f, "one of {in_plane} in the plane")?,
            Some(CompleteSystem { positions, .. }) => {
                write!(f, "one of {positions}, free turns apart")?;
            }
        }
        match families {
            0 => {}
            1 => write!(f, ", besides a family with slack bars")?,
            _ => write!(f, ", besides {families} families with slack bars")?,
        }
        f.write_str(", and no other")?;
        // Nothing had to be searched where the energy is convex.
        if *cells == 0 && *patterns <= 1 {
            return Ok(());
        }
        write!(
            f,
            ": {patterns} patterns of tension and compression excluded everywhere else, in {cells} cells of pulls"
        )
    }
}

impl Display for Optimal {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("the stress matrix is positive semidefinite")?;
        if self.singular {
            f.write_str(" (singular: the free turn about the vertical)")?;
        }
        match self.gap {
            None => f.write_str(", by factorisation in intervals"),
            Some(gap) => {
                let gap = size(f, gap);
                write!(
                    f,
                    ": no configuration has less energy than {gap} of weight times length below this one"
                )
            }
        }
    }
}
