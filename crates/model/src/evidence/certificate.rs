//! The rung `optimal`.

use serde::Serialize;

use super::finite;

/// No configuration has less energy: the stress matrix is positive semidefinite.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Optimal {
    /// The energy less a proved lower bound of all energies, in units of the weight between the
    /// anchors times the total length; nothing where a factorisation in intervals proves it of the
    /// exact equilibrium.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<f64>,
    /// Whether the stress matrix is singular as far as doubles can tell: the free turn about the
    /// vertical through both anchors.
    pub singular: bool,
}

/// Why there is no certificate of global minimality.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "because", rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoCertificate {
    /// Occurs when two or more bars are in compression: the stress matrix has a negative
    /// eigenvalue, and the equilibrium is unstable in space.
    #[error(
        "{bars} bars are in compression: the stress matrix is indefinite, there is less energy elsewhere"
    )]
    SeveralCompressed {
        /// How many.
        bars: usize,
    },
    /// Occurs when one bar is in compression and its force is too large for the others to hold it
    /// up in space: `Σ 1/τ_i > 0`, proven.
    #[error(
        "bar {bar} is pressed too hard: the sum of the inverse force densities is {excess:e} of its terms, the \
         stress matrix is indefinite, there is less energy elsewhere"
    )]
    Indefinite {
        /// The compressed bar, from 1.
        bar: usize,
        /// `Σ 1/τ_i` over `Σ |1/τ_i|`.
        #[serde(with = "finite")]
        excess: f64,
    },
    /// Occurs when the bound holds but stays too far below the energy.
    #[error("{}", off(*gap))]
    Gap {
        /// The gap in units of the weight between the anchors × total length.
        #[serde(with = "finite")]
        gap: f64,
    },
    /// Occurs when the last joint is so far from its anchor, measured by the slack of the chain,
    /// that no configuration of the chain need be near.
    #[error(
        "the last joint is {gap_m:.1e} m from its anchor, and the chain has only {slack_m:.1e} m of slack"
    )]
    NotClosed {
        /// How far the joint is from the anchor, beyond the rounding of coordinates, m.
        #[serde(with = "finite")]
        gap_m: f64,
        /// Slack: the length to spare before the bars lie on one line, m.
        #[serde(with = "finite")]
        slack_m: f64,
    },
    /// Occurs when the energy is proved to fall in some directions.
    #[error("the energy falls in {directions} directions")]
    EnergyFalls {
        /// How many independent ones.
        directions: usize,
    },
    /// Occurs when the pivots of the stress matrix are not proved positive, nor otherwise.
    #[error("the pivots of the stress matrix are not proved positive")]
    PivotsUndecided,
    /// Occurs when the stress matrix of a system is not proved positive definite.
    #[error(
        "the stress matrix is not proved positive definite, with {compressed} members compressed"
    )]
    NotDefinite {
        /// How many members are compressed; without any only a part that nothing loads or that
        /// turns freely leaves it singular.
        compressed: usize,
    },
    /// Occurs when a rope runs over rings or pulleys, and not every member of the system pulls: only
    /// then a bound is known.
    #[error(
        "a bound with ropes over rings or pulleys is known where anchors hold all parts and every member \
         pulls, and {members} push or may push"
    )]
    NotConvex {
        /// How many members push, or may; without any a part without anchors slides away.
        members: usize,
    },
    /// Occurs when a number of the answer is not finite, or the arrays do not fit the chain.
    #[error("the answer is incomplete or not finite")]
    Unusable,
}

fn off(gap: f64) -> String {
    if gap < 0.0 {
        let below = -gap;
        return format!(
            "the energy is {below:.1e} of weight times length below the least that any configuration has: lengths are off"
        );
    }
    format!("the lower bound stays {gap:.1e} of weight times length below the energy")
}
