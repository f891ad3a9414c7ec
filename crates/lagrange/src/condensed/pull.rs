//! The pull on the first anchor: three numbers that determine the whole equilibrium.

use std::ops::Range;

use model::Vector;

use super::chain::Condensed;
use super::newton::{Budget, Root};
use super::regime::Regime;
use super::settings::Settings;
use super::system::Closure;
use crate::error::Error;
use crate::thresholds::UPRIGHT;

/// Which bars are not in tension.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Signs {
    /// All are.
    Tension,
    /// This one is in compression.
    Compressed(usize),
    /// These carry no force at all: they have just to fill the gap between the strands.
    Unloaded(Range<usize>),
}

/// An equilibrium, as briefly as it can be said: the force in the bottom bar and the signs.
///
/// Every force in the chain is this one plus weights, every bar is parallel to its force.
///
/// ```
/// use lagrange::condensed::{Condensed, Settings};
/// let chain = Condensed::new(&model::cases::paper());
/// let pull = chain.pull(&Settings::default())?;
/// // E1: the third bar props the chain up, 2.3129 of the three weights hang on the first anchor.
/// assert_eq!(pull.compressed(), [2]);
/// assert!((pull.ground_n()[2] / 9.80665 - 2.312944292241838).abs() < 1e-14);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Pull {
    /// Horizontal unit vector of the plane.
    pub(super) level: [f64; 2],
    /// Force in the bottom bar, horizontal and vertical, in units of the chain.
    pub(super) force: [f64; 2],
    pub(super) signs: Signs,
    /// Derivative of the closure by the force: largest pivot, and what elimination leaves of the
    /// other.
    pub(super) pivots: [f64; 2],
    /// Size of the terms of which that remainder is the difference.
    pub(super) remainder_of: f64,
    /// Force of the ground on bar 1 at joint 0, N.
    ground_n: Vector,
    /// The last closure computed, where an iteration found the force.
    closure: Option<Closure>,
    passes: usize,
}

impl Pull {
    /// From the force in the bottom bar and the derivative of the closure there: 11, 12, 22.
    pub(super) fn new(
        chain: &Condensed,
        signs: Signs,
        force: [f64; 2],
        [a, b, c]: [f64; 3],
        passes: usize,
    ) -> Self {
        let (first, second) = if a.abs() >= c.abs() { (a, c) } else { (c, a) };
        let taken = if b.abs() > 0.0 { b / first * b } else { 0.0 };
        let (level, unit) = (chain.span.level, chain.units.force());
        let vertical = (chain.bars.at_start - chain.bars.loads[0]) - force[1];
        Self {
            level,
            force,
            signs,
            pivots: [first, second - taken],
            remainder_of: second.abs() + taken.abs(),
            ground_n: [-force[0] * level[0] * unit, -force[0] * level[1] * unit, vertical * unit],
            closure: None,
            passes,
        }
    }

    /// From the root of an iteration: `force` is its force in upright axes.
    pub(super) fn at(
        chain: &Condensed,
        signs: Signs,
        force: [f64; 2],
        root: &Root,
        budget: &Budget,
    ) -> Self {
        let pull = Self::new(chain, signs, force, root.closure.jacobian, budget.spent);
        Self { closure: Some(root.closure), ..pull }
    }

    /// Of two bars with the force densities $\tau_i = N_i/l_i$, their sum, and twice the area between them and
    /// their anchors. The derivative of the closure by the force,
    /// $\sum (1 - u_i u_i^T)/\tau_i$, has the determinant $(u_1 \times u_2)^2/(\tau_1 \tau_2)$,
    /// of which nothing is left in the difference of its entries; the pivots are its eigenvalues.
    pub(super) fn of_triangle(
        chain: &Condensed,
        signs: Signs,
        force: [f64; 2],
        densities: [f64; 2],
        sum: f64,
        area: f64,
    ) -> Self {
        let mut pull = Self::new(chain, signs, force, [0.0; 3], 0);
        let lengths = &chain.bars.lengths;
        let sine = area / (lengths[0] * lengths[1]);
        let determinant = sine / densities[0] * (sine / densities[1]);
        let half = 0.5 * sum / densities[0] / densities[1];
        let first = half + (half * half - determinant).max(0.0).sqrt().copysign(half);
        pull.pivots = [first, determinant / first];
        pull.remainder_of = first.abs();
        pull
    }

    /// Force of the ground on bar 1 at joint 0, world frame, N: the paper's λ₁, λ₂, λ₃. The chain
    /// pulls the anchor with the opposite of it.
    pub fn ground_n(&self) -> Vector {
        self.ground_n
    }

    /// The compressed bars, numbered from 0.
    pub fn compressed(&self) -> Vec<usize> {
        match &self.signs {
            Signs::Tension | Signs::Unloaded(_) => Vec::new(),
            Signs::Compressed(bar) => vec![*bar],
        }
    }

    /// Passes over all bars that it took.
    pub fn passes(&self) -> usize {
        self.passes
    }
}

impl Condensed {
    /// The pull of the hanging equilibrium: the global minimum of the energy.
    ///
    /// No guess is needed. Whether a bar is compressed, and which, follows from the lengths; with
    /// all bars in tension the pull is the minimum of a convex function, with one compressed the
    /// only root of its kind. With the anchors on one vertical every vertical plane is as good as
    /// any other; the answer lies in OYZ and the bars in tension lean towards +Y.
    ///
    /// # Errors
    ///
    /// [`Error::Settings`] for settings out of range, [`Error::NotClosed`] when
    /// the passes over the bars run out.
    ///
    /// ```
    /// use lagrange::condensed::{Condensed, Settings};
    /// let chain = Condensed::new(&model::cases::paper());
    /// let [x, y, z] = chain.pull(&Settings::default())?.ground_n();
    /// let weight = model::STANDARD_GRAVITY_M_S2;
    /// assert!(x.abs() < 1e-15 && (y / weight + 0.648944835933934).abs() < 1e-14);
    /// assert!((z / weight - 2.312944292241838).abs() < 1e-14);
    /// # Ok::<(), lagrange::Error>(())
    /// ```
    pub fn pull(&self, settings: &Settings) -> Result<Pull, Error> {
        settings.validate()?;
        let mut budget = Budget::of(settings);
        let found = Regime::of(self).solve(self, &mut budget);
        let pull = found.ok_or(Error::NotClosed { closure: f64::NAN, passes: budget.spent })?;
        let finite = pull.ground_n.iter().all(|component| component.is_finite());
        if finite { Ok(pull) } else { Err(Error::Overflow) }
    }

    /// The pull of a chain whose forces are indeterminate; `None` for any other.
    pub(crate) fn indeterminate_pull(&self) -> Option<Pull> {
        let indeterminate = Regime::of(self) == Regime::Indeterminate;
        let mut budget = Budget::of(&Settings::default());
        indeterminate.then(|| Regime::Indeterminate.solve(self, &mut budget)).flatten()
    }

    /// How far rounding may have moved the force of a pull, as a part of the largest force.
    pub(super) fn force_error(&self, pull: &Pull) -> f64 {
        let largest = pull.force[0].hypot(pull.force[1]) + self.largest_load();
        // Between anchors on one vertical a chain that is straight, one of its bars pushed, shares
        // the weight along the vertical in any way.
        let upright = self.span.across <= 0.0 && pull.force[0].abs() <= UPRIGHT * largest;
        if upright && matches!(pull.signs, Signs::Compressed(_)) {
            return 1.0;
        }
        pull.closure.map_or(0.0, |closure| closure.force_error() / largest)
    }
}
