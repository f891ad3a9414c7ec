//! Many seeds through the lanes.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

use model::{Ends, Finish, Problem};

use super::kernel::{Common, MOST_ALLOWED, State, step};
use super::lanes::{LANES, Lanes, each};
use super::numbers::{Bar, Numbers};
use super::signs::Signs;
use crate::settings::{SettingsError, within};

/// Passes over the bars that a solve by signs may take for each Newton step that was allowed
/// before: none of the chains tried took more than the 1,000 of the default.
const PASSES_PER_STEP: usize = 2;
/// Part of the tolerance to which a solve by signs closes: the largest component and the rounding
/// of the directions stay below the whole.
const CLOSURE: f64 = 0.5;

/// What can be chosen.
///
/// ```
/// let settings = lagrange::batch::BatchSettings { max_iterations: 100, ..Default::default() };
/// assert_eq!((settings.tolerance, settings.max_iterations), (1e-13, 100));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BatchSettings {
    /// A seed has converged when no equation is larger than this: moment rows in units of the
    /// largest force times the mean length, closure in units of the total length. Default 1e-13,
    /// from 1e-15 to 1e-3.
    pub tolerance: f64,
    /// Newton steps after which a seed is solved by the signs of its bars, which may take twice as
    /// many passes over the bars. Default 1000, from 1 to 60,000.
    pub max_iterations: u32,
}

impl Default for BatchSettings {
    fn default() -> Self {
        Self { tolerance: 1e-13, max_iterations: 1000 }
    }
}

impl BatchSettings {
    /// Check every range.
    ///
    /// # Errors
    ///
    /// [`SettingsError`] with the first field that is out of range.
    ///
    /// ```
    /// let settings = lagrange::batch::BatchSettings { tolerance: 0.0, ..Default::default() };
    /// assert_eq!(settings.validate().unwrap_err().low, 1e-15);
    /// ```
    pub fn validate(&self) -> Result<(), SettingsError> {
        within(&[
            ("tolerance", self.tolerance, 1e-15, 1e-3),
            ("max_iterations", f64::from(self.max_iterations), 1.0, f64::from(MOST_ALLOWED)),
        ])
    }
}

/// A solver of one problem for many seeds in its vertical plane.
///
/// ```
/// use lagrange::batch::{Batch, BatchSettings};
/// use model::{Ends, Finish};
/// let batch = Batch::new(&model::cases::paper(), BatchSettings::default())?;
/// let mut ends = Ends::default();
/// batch.solve(&[0.3, 0.7, -1.3, 2.8, 2.4, 4.0], &mut ends);
/// assert_eq!(ends.finish, [Finish::Converged; 2]);
/// // V of the paper counts from 6 mgl lower; here mgl = 9.80665 J.
/// assert!((ends.energy_j[0] / 9.80665 + 6.0 - 2.335_468_651_999_305).abs() < 1e-12);
/// # Ok::<(), lagrange::SettingsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Batch {
    numbers: Numbers,
    settings: BatchSettings,
}

impl Batch {
    /// Prepare a problem.
    ///
    /// # Errors
    ///
    /// [`SettingsError`] when a setting is out of range.
    ///
    /// ```
    /// use lagrange::batch::{Batch, BatchSettings};
    /// let problem = model::cases::paper();
    /// let unusable = BatchSettings { max_iterations: 0, ..Default::default() };
    /// assert_eq!(Batch::new(&problem, unusable).unwrap_err().name, "max_iterations");
    /// ```
    pub fn new(problem: &Problem, settings: BatchSettings) -> Result<Self, SettingsError> {
        settings.validate()?;
        Ok(Self { numbers: Numbers::of(problem), settings })
    }

    pub(super) fn bars(&self) -> usize {
        self.numbers.bars.len()
    }

    /// Unit vector (X, Y) of the plane: from the first anchor towards the last, +Y if they are on
    /// one vertical.
    ///
    /// ```
    /// use lagrange::batch::{Batch, BatchSettings};
    /// // The paper's anchors are on one vertical, and its plane is OYZ.
    /// let batch = Batch::new(&model::cases::paper(), BatchSettings::default())?;
    /// assert_eq!(batch.heading(), [0.0, 1.0]);
    /// # Ok::<(), lagrange::SettingsError>(())
    /// ```
    pub fn heading(&self) -> [f64; 2] {
        self.numbers.heading
    }

    /// Solve all seeds: `angles` holds n angles from the descending vertical, rad, for each of
    /// them. What was in `ends` is replaced, its memory used again.
    ///
    /// The residual is the largest equation, in the units of [`BatchSettings::tolerance`];
    /// iterations are Newton steps, and passes over the bars by which signs were solved for.
    ///
    /// # Panics
    ///
    /// When `angles` does not hold a multiple of n numbers.
    ///
    /// ```
    /// use lagrange::batch::{Batch, BatchSettings};
    /// let batch = Batch::new(&model::cases::paper(), BatchSettings::default())?;
    /// let mut ends = model::Ends::default();
    /// // E1 and E2: two seeds of three angles.
    /// batch.solve(&[0.3, 0.7, -1.3, 1.3, -0.7, -0.3], &mut ends);
    /// assert!((ends.energy_j[1] / 9.80665 + 6.0 - 3.664531348000695).abs() < 1e-12);
    /// # Ok::<(), lagrange::SettingsError>(())
    /// ```
    pub fn solve(&self, angles: &[f64], ends: &mut Ends) {
        let bars = self.bars();
        assert!(angles.len().is_multiple_of(bars), "{bars} angles for every seed");
        ends.resize(angles.len() / bars, bars);
        match bars {
            2 => self.unrolled::<2>(angles, ends),
            3 => self.unrolled::<3>(angles, ends),
            4 => self.unrolled::<4>(angles, ends),
            5 => self.unrolled::<5>(angles, ends),
            6 => self.unrolled::<6>(angles, ends),
            _ => self.run(&self.numbers.bars, &mut vec![State::ZERO; bars], angles, ends),
        }
        self.solve_by_signs(angles, ends);
    }

    /// Solve the seeds that the iteration has not brought to an end.
    fn solve_by_signs(&self, angles: &[f64], ends: &mut Ends) {
        let Numbers { bars, span, .. } = &self.numbers;
        let n = bars.len();
        let limit = PASSES_PER_STEP * self.settings.max_iterations as usize;
        let mut signs = Signs::new(bars, *span, CLOSURE * self.settings.tolerance);
        for seed in 0..ends.finish.len() {
            if ends.finish[seed] != Finish::IterationLimit {
                continue;
            }
            let directions = &mut ends.directions[seed * n..(seed + 1) * n];
            let Some(root) = signs.solve(&angles[seed * n..(seed + 1) * n], limit, directions)
            else {
                continue;
            };
            ends.residual[seed] = self.numbers.largest(directions, root.pull);
            ends.energy_j[seed] = self.numbers.energy_j(directions);
            let spent = usize::from(ends.iterations[seed]) + root.passes;
            ends.iterations[seed] = u16::try_from(spent).unwrap_or(u16::MAX);
            if ends.residual[seed] <= self.settings.tolerance {
                ends.finish[seed] = Finish::Converged;
            }
        }
    }

    /// With the number of bars known to the compiler.
    #[inline(never)]
    fn unrolled<const N: usize>(&self, angles: &[f64], ends: &mut Ends) {
        let mut bars = [Bar::default(); N];
        bars.copy_from_slice(&self.numbers.bars);
        pulp::Arch::new().dispatch(Widest { batch: self, bars: &bars, angles, ends });
    }

    #[inline(always)]
    fn run(&self, bars: &[Bar], states: &mut [State], angles: &[f64], ends: &mut Ends) {
        let seeds = angles.len() / bars.len();
        let mut common = Common {
            pull: [Lanes::ZERO; 2],
            pull_before: [Lanes::ZERO; 2],
            count: [0; LANES],
            far: [true; LANES],
        };
        // Which seed each lane has; one that is not there when there are none left.
        let mut seed = [usize::MAX; LANES];
        let (mut next, mut busy) = (0, 0);
        for (lane, seed) in seed.iter_mut().enumerate().take(seeds) {
            *seed = next;
            load(states, angles, next, lane);
            (next, busy) = (next + 1, busy + 1);
        }
        while busy > 0 {
            let converged =
                step(bars, self.numbers.span, self.settings.tolerance, states, &mut common);
            let ended: [bool; LANES] =
                each(|k| converged[k] || (common.count[k] > self.settings.max_iterations));
            if !ended.contains(&true) {
                continue;
            }
            for lane in 0..LANES {
                if !ended[lane] || seed[lane] == usize::MAX {
                    continue;
                }
                self.store(states, &common, lane, converged[lane], seed[lane], ends);
                common.count[lane] = 0;
                if next < seeds {
                    seed[lane] = next;
                    load(states, angles, next, lane);
                    next += 1;
                } else {
                    seed[lane] = usize::MAX;
                    busy -= 1;
                }
            }
        }
    }

    /// Write down where a lane is.
    #[inline(always)]
    fn store(
        &self,
        states: &[State],
        common: &Common,
        lane: usize,
        converged: bool,
        seed: usize,
        ends: &mut Ends,
    ) {
        let bars = states.len();
        let directions = &mut ends.directions[seed * bars..(seed + 1) * bars];
        for (u, state) in directions.iter_mut().zip(states) {
            *u = [state.sin.0[lane], -state.cos.0[lane]];
        }
        let pull = common.pull_before.map(|part| part.0[lane]);
        ends.energy_j[seed] = self.numbers.energy_j(directions);
        ends.residual[seed] = self.numbers.largest(directions, pull);
        // The step at which convergence was seen was not needed.
        ends.iterations[seed] = u16::try_from(common.count[lane] - 1).unwrap_or(u16::MAX);
        ends.finish[seed] = if converged {
            Finish::Converged
        } else if ends.residual[seed].is_finite() {
            Finish::IterationLimit
        } else {
            Finish::NonFinite
        };
    }
}

/// The same loop compiled for the widest vectors that the processor has: the operations are the
/// same, entry by entry, and so are the bits.
struct Widest<'a, const N: usize> {
    batch: &'a Batch,
    bars: &'a [Bar; N],
    angles: &'a [f64],
    ends: &'a mut Ends,
}

impl<const N: usize> pulp::NullaryFnOnce for Widest<'_, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.batch.run(self.bars, &mut [State::ZERO; N], self.angles, self.ends);
    }
}

#[inline(always)]
fn load(states: &mut [State], angles: &[f64], seed: usize, lane: usize) {
    let bars = states.len();
    for (state, angle) in states.iter_mut().zip(&angles[seed * bars..]) {
        // An angle without bounds would be outside the range of the sine.
        state.angle.0[lane] = angle % std::f64::consts::TAU;
    }
}
