use std::sync::Arc;
use std::time::Instant;

use model::{Problem, Vector};

use crate::error::Error;
use crate::run::closure::Shape;
use crate::run::curvature::Curvature;
use crate::run::refine::refine;
use crate::run::scaled_chain::{ScaledChain, Units};
use crate::run::seed::Seed;
use crate::run::settings::Settings;
use crate::run::slope::Slope;
use crate::run::solution::Solution;
use crate::run::solver::FeasibleNewton;
use crate::vector::norm;

/// Corrections of the closure from a seed, which may be anywhere.
const SEED_CORRECTIONS: usize = 300;

/// Coarse chains only make the first guess for finer ones: their gradient need not be smaller than
/// the error of a group of bars being straight,
const COARSE_TOLERANCE: f64 = 1e-4;

/// nor than this part of the mean weight of a group: what hangs at the bottom of a deep chain.
const PART_OF_GROUP: f64 = 0.1;

/// Find the shape of least energy from no guess.
///
/// A long chain is first minimised with neighbouring bars held parallel, eight by eight, and so on
/// down to a few bars that start from a circular arc: the number of iterations does not grow with
/// the number of bars.
///
/// # Errors
///
/// [`Error`]; `Ok` means a local minimum with a projected gradient and a closure below their
/// tolerances and no falling direction. In space that is the global minimum.
///
/// ```
/// let solution = energy::minimise(&model::cases::paper(), &energy::Settings::default())?;
/// let mgl = model::STANDARD_GRAVITY_M_S2; // m = 1 kg, l = 1 m
/// // The paper's V is 6 mgl more than that from joint 0. Reference: 40-digit root finding,
/// // 2.33546865199930500930868666574.
/// let v = solution.equilibrium.energy_j / mgl + 6.0;
/// assert!((v - 2.335_468_651_999_305).abs() < 1e-14);
/// # Ok::<(), energy::Error>(())
/// ```
pub fn minimise(problem: &Problem, settings: &Settings) -> Result<Solution, Error> {
    from_start(problem, settings, |links, _| first_guess(links, settings))
}

/// Find the local minimum below a seed.
///
/// The seed is first closed on the anchors (it is moved as little as possible), then the energy
/// falls monotonically. A saddle or a maximum is left along its lowest mode.
///
/// # Errors
///
/// [`Error`]; `Ok` means what it means for [`minimise`].
///
/// ```
/// use energy::{Seed, Settings, minimise_from};
/// let problem = model::cases::paper();
/// // E2, the hanging shape upside down: no force is left over, and yet it is left.
/// let e2 = [73.920_588_792_231, -38.599_136_184_452, -19.694_867_976_133];
/// let seed = Seed::angles(&problem, &e2.map(f64::to_radians))?;
/// let found = minimise_from(&problem, &seed, &Settings::default())?;
/// let v = found.equilibrium.energy_j / model::STANDARD_GRAVITY_M_S2 + 6.0;
/// assert!((v - 2.335_468_651_999_305).abs() < 1e-13);
/// # Ok::<(), energy::Error>(())
/// ```
pub fn minimise_from(
    problem: &Problem,
    seed: &Seed,
    settings: &Settings,
) -> Result<Solution, Error> {
    from_start(problem, settings, |links, units| seed.in_frame(links, units))
}

/// The minimum below a start, with more digits where some bars need them.
fn from_start(
    problem: &Problem,
    settings: &Settings,
    start: impl FnOnce(&ScaledChain, &Units) -> Result<Vec<Vector>, Error>,
) -> Result<Solution, Error> {
    settings.validate()?;
    let clock = Instant::now();
    let (links, units) = ScaledChain::new(problem, settings.motion);
    let start = start(&links, &units)?;
    let minimum = descend_to_line(links, start, settings)?;
    let (minimum, units, unknown_rad) = refine(problem, units, minimum, settings)?;
    Ok(Solution::new(problem, &units, minimum, unknown_rad, settings, clock))
}

/// What a run of the minimiser ends with.
#[derive(Debug)]
pub(crate) struct Minimum {
    pub(crate) links: Arc<ScaledChain>,
    pub(crate) shape: Arc<Shape>,
    pub(crate) slope: Arc<Slope>,
    pub(crate) iterations: u64,
    /// Evaluations of energy, gradient and Hessian.
    pub(crate) evaluations: u64,
    /// Why it is not known to be a minimum, if it is not.
    pub(crate) unsettled: Option<Error>,
}

impl Minimum {
    /// An error if it is not known to be a minimum, or if all bars lie on one line and what decides
    /// between such positions is lost.
    pub(crate) fn settled(self) -> Result<Self, Error> {
        match (self.unsettled, self.slope.lost(&self.links)) {
            (Some(error), _) => Err(error),
            (None, Some(across)) => Err(Error::NearlyFolded { across }),
            (None, None) => Ok(Self { unsettled: None, ..self }),
        }
    }

    /// The second derivative at the minimum.
    pub(crate) fn curvature(&self) -> Curvature {
        Curvature {
            links: Arc::clone(&self.links),
            shape: Arc::clone(&self.shape),
            slope: Arc::clone(&self.slope),
        }
    }
}

/// Directions to start from: the minimum of the coarser chain, or the arc. Where the coarser chain
/// bends too sharply for its groups the bars around the bend are minimised by themselves, their
/// ends held.
fn first_guess(links: &ScaledChain, settings: &Settings) -> Result<Vec<Vector>, Error> {
    let Some(grouped) = links.grouped() else { return Ok(links.arc()) };
    let start = first_guess(&grouped.links, settings)?;
    let tolerance = COARSE_TOLERANCE.min(PART_OF_GROUP / grouped.links.bars() as f64);
    let coarse =
        Settings { gradient_tolerance: settings.gradient_tolerance.max(tolerance), ..*settings };
    // A coarse chain without an answer is no reason to give up: the arc remains.
    let Ok(Minimum { shape, .. }) = descend(grouped.links.clone(), start, &coarse) else {
        return Ok(links.arc());
    };
    let mut u = grouped.spread(&shape.u);
    if let Some(bars) = grouped.bend(&shape.u)
        && let Some((part, turn)) = links.part(bars.clone(), &u)
        && let Ok(bent) = first_guess(&part, settings).and_then(|u| descend(part, u, &coarse))
    {
        u.splice(bars, bent.shape.u.iter().map(|u| turn.back(*u)));
    }
    Ok(u)
}

/// Largest gap that is a closed chain's, as a part of the length it can spare: with more, it may be
/// that no chain of these bars is near.
const OPEN_PART: f64 = 0.1;

/// Close the start and run the solver.
pub(crate) fn descend(
    links: ScaledChain,
    start: Vec<Vector>,
    settings: &Settings,
) -> Result<Minimum, Error> {
    descend_to_line(links, start, settings)?.settled()
}

/// The same; all bars may end on one line.
fn descend_to_line(
    links: ScaledChain,
    start: Vec<Vector>,
    settings: &Settings,
) -> Result<Minimum, Error> {
    let links = Arc::new(links);
    let moments = links.measure(&start);
    let closed = links.close(Shape { u: start, moments }, SEED_CORRECTIONS).map_err(
        |(gap, iterations)| Error::SeedNotClosed { gap: gap / links.total(), iterations },
    )?;
    let mut solver = FeasibleNewton::new(Arc::clone(&links), *settings);
    let (shape, slope) = solver.run(closed, settings.max_iterations)?;
    let FeasibleNewton { iterations, evaluations, finished, mut unsettled, .. } = solver;
    if !finished {
        let error = Error::NotConverged { iterations, gradient: slope.residual() };
        // Newton's method may still get there from where the iterations ended, unless fewer were asked for.
        if settings.max_iterations < Settings::default().max_iterations {
            return Err(error);
        }
        unsettled = Some(error);
    }
    let gap = norm(shape.moments.gap);
    if gap > OPEN_PART * links.spare() {
        return Err(Error::SeedNotClosed {
            gap: gap / links.total(),
            iterations: SEED_CORRECTIONS,
        });
    }
    Ok(Minimum { links, shape, slope, iterations, evaluations, unsettled })
}

#[cfg(test)]
mod tests;
