//! What a sweep takes, told before it is begun.

use std::time::Instant;

use model::{Ends, Problem};

use crate::error::SweepError;
use crate::settings::Settings;
use crate::solver::{BatchSolver, Solvers};

/// Bars of the starts that are timed: a fraction of a second of work.
const TIMED_BARS: usize = 1 << 14;

/// Processor time of a sweep over so many seeds, s, from the time that a few of them take here:
/// good to a factor of three. The time of a census, which is of a second or so, is left out.
///
/// # Errors
///
/// [`SweepError`] for settings out of range.
///
/// ```
/// # use std::sync::Arc;
/// # use model::{Ends, Finish};
/// # use sweep::{BatchSolver, Finds, Settings, Solvers, expected_time_s};
/// /// Takes its time, and fails.
/// #[derive(Debug)]
/// struct Slow;
///
/// impl BatchSolver for Slow {
///     fn name(&self) -> &str {
///         "slow"
///     }
///     fn finds(&self) -> Finds {
///         Finds::Equilibria
///     }
///     fn solve(&self, starts_rad: &[f64], _: &mut Ends) {
///         // Half a millisecond for each bar.
///         std::thread::sleep(std::time::Duration::from_micros(500 * starts_rad.len() as u64));
///     }
/// }
/// let problem = model::cases::paper();
/// let time = expected_time_s(&problem, &Settings::default(), &Solvers::new(vec![Arc::new(Slow)]), 10_000)?;
/// // 10,000 starts of three bars; a busy machine may sleep longer.
/// assert!(time >= 15.0 && time < 150.0);
/// # Ok::<(), sweep::SweepError>(())
/// ```
pub fn expected_time_s(
    problem: &Problem,
    settings: &Settings,
    solvers: &Solvers,
    seeds: u64,
) -> Result<f64, SweepError> {
    settings.validate()?;
    let bars = problem.chain().bars().len();
    let starts = settings.source.ready(settings.number, bars)?;
    let timed = (TIMED_BARS / bars.max(1)).clamp(1, 64) as u64;
    let mut angles = vec![];
    starts.fill(0..timed.min(seeds.max(1)), bars, &mut angles);
    let one_s = |solver: &dyn BatchSolver| {
        let start = Instant::now();
        solver.solve(&angles, &mut Ends::default());
        start.elapsed().as_secs_f64() / (angles.len() / bars.max(1)).max(1) as f64
    };
    let seed_s: f64 = solvers.asked.iter().map(|solver| one_s(solver.as_ref())).sum();
    Ok(seeds as f64 * seed_s)
}
