use std::sync::Arc;
use std::time::Instant;

use model::Vector;
use model::system::System;

use crate::error::Error;
use crate::net::component::check_held;
use crate::net::factor::Factor;
use crate::net::frame::{Frame, Rod};
use crate::net::interior::{ITERATIONS, Interior, relaxable};
use crate::net::jam::at_corners;
use crate::net::limit::Limit;
use crate::net::near::loaded;
use crate::net::newton::{Newton, Pace};
use crate::net::settings::Settings;
use crate::net::shape::{Shape, Slope};
use crate::net::solution::Solution;
use crate::net::start::hanging;
use crate::net::work::Meter;
use crate::thresholds::{GOLDEN, ZERO};
use crate::vector::{along, dot, norm, scaled};

/// Starts elsewhere where the lengths could not be kept from the first one: a loop that closes may
/// have places where it nearly closes.
const RESTARTS: usize = 4;

/// Where lengths overdetermine a shape it has places that nearly close, and others that close, by the
/// dozen: as many starts as make this number of free coordinates together, and at most so many.
const COORDINATES: usize = 900;
const MOST_RESTARTS: usize = 100;

/// Steps from places given in which elastic members keep their own stiffness, as a descent into the nearest minimum does.
const OWN_STEPS: u64 = 200;

/// A shape so many times as far from the origin is elsewhere.
const FAR: f64 = 1e3;

/// Square roots of numbers that no ratio connects, as turns that have nothing in common.
const SPREAD: f64 = 7.0;

/// Find a configuration of least energy from no guess.
///
/// The start is the minimum of the relaxation in which bars are cables. Where every bar pulls
/// there, it is the global minimum and no more than a few steps are left.
///
/// # Errors
///
/// [`Error`]; `Ok` means a local minimum: forces in balance and lengths kept to their tolerance,
/// and no direction in which the energy falls.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // A lamp of 5 kg on two light bars of 1 m between level anchors 1.2 m apart: 0.8 m below them.
/// let joints = vec![
///     Joint::anchor("A", [0.0, 0.0, 0.0]),
///     Joint::anchor("B", [1.2, 0.0, 0.0]),
///     Joint::free("lamp").with_mass(5.0),
/// ];
/// let bar = Bar::homogeneous(1.0, 0.0)?;
/// let members = vec![Member::bar(0, 2, bar), Member::bar(2, 1, bar)];
/// let system = System::new("a lamp", 10.0, joints, members)?;
/// let solution = energy::net::minimise(&system, &Default::default())?;
/// assert!((solution.equilibrium.joints_m[2][2] + 0.8).abs() < 1e-14);
/// // Each bar carries half of the 50 N at an angle whose cosine is 0.8.
/// assert!((solution.equilibrium.axial_n[0] - 31.25).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn minimise(system: &System, settings: &Settings) -> Result<Solution, Error> {
    let from = |corners: Corners| {
        let of = |system: &System| within(system, settings, |f, s| unguided(f, s, corners));
        at_corners(system, of(system), |joined| of(&joined.system))
    };
    match from(Corners::Minima) {
        Err(Error::Jammed { .. }) => from(Corners::Traps),
        found => found,
    }
}

/// What a search takes a corner for that it has run into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Corners {
    /// A minimum, as most are.
    Minima,
    /// None of the minima: it begins elsewhere.
    Traps,
}

/// From no guess.
fn unguided(frame: &Arc<Frame>, settings: &Settings, corners: Corners) -> Result<Minimum, Error> {
    let start = hanging(frame)?;
    let factor = Factor::new(&frame.spots, &frame.rods, &frame.meter)?;
    let mut work = Effort::default();
    let (relaxed, factor) = if relaxable(frame) {
        relax(frame, factor, start.clone(), &mut work)?
    } else {
        (start.clone(), factor)
    };
    // A relaxation that went astray is no start; where it flies away its forces hide what is left over.
    let astray = frame.slope(&relaxed).residual() > frame.slope(&start).residual().max(1.0)
        || relaxed.extent() > FAR * (1.0 + start.extent());
    let (first, pace) = if astray {
        (start.clone(), Pace::default())
    } else {
        (relaxed, Pace { near: RELAXED, ..Pace::default() })
    };
    let mut found = descend(frame, factor, first, pace, settings, work);
    let most = (COORDINATES / frame.freedom.max(1)).min(MOST_RESTARTS);
    for attempt in 1..=most.max(RESTARTS) {
        let again = match &found {
            Ok(minimum) => attempt <= most && frame.meter.check().is_ok() && may_be_lower(minimum),
            Err(Error::Jammed { .. }) if corners == Corners::Minima => false,
            Err(Error::IterationLimit { .. }) => {
                attempt <= RESTARTS && (!frame.ropes.is_empty() || frame.has_floor())
            }
            Err(error) => hard_to_close(error),
        };
        if !again {
            break;
        }
        let factor = Factor::new(&frame.spots, &frame.rods, &frame.meter)?;
        let elsewhere = displaced(frame, &start, attempt);
        let pace = Pace { strain: LENGTHS_FIRST, ..Pace::default() };
        let other = descend(frame, factor, elsewhere, pace, settings, work);
        found = better(frame, other, found);
    }
    found
}

/// A minimisation with the work that it may take.
fn within(
    system: &System,
    settings: &Settings,
    minimum: impl FnOnce(&Arc<Frame>, &Settings) -> Result<Minimum, Error>,
) -> Result<Solution, Error> {
    settings.validate()?;
    let clock = Instant::now();
    let meter = Meter::until(settings.max_work);
    let frame = Arc::new(Frame { meter: meter.clone(), ..Frame::new(system)? });
    check_held(system, &frame)?;
    let found = minimum(&frame, settings);
    meter.judged(found.and_then(|found| Solution::new(system, &frame, found, settings, clock)))
}

/// Whether the lengths may be kept elsewhere, or with more weight on them; and a corner that a search has run
/// into may be none of the energy's minima.
fn hard_to_close(error: &Error) -> bool {
    use Error::{Jammed, Misfit, NotClosed, Stalled};
    matches!(error, NotClosed { .. } | Misfit { .. } | Stalled { .. } | Jammed { .. })
}

/// Whether lengths that overdetermine a shape may close elsewhere with less energy. Not where every
/// member pulls.
fn may_be_lower(minimum: &Minimum) -> bool {
    minimum.limit.is_some() && minimum.shape.force.iter().any(|force| *force < 0.0)
}

/// The answer with less energy, or the error that says most: misfits of a shape that is otherwise
/// found.
fn better(
    frame: &Frame,
    new: Result<Minimum, Error>,
    old: Result<Minimum, Error>,
) -> Result<Minimum, Error> {
    use Error::{Jammed, Misfit, Work};
    match (new, old) {
        (Ok(new), Ok(old)) => {
            let [lower, known] = [&new, &old].map(|minimum| frame.energy(&minimum.shape));
            Ok(if lower < known - ZERO * known.abs().max(1.0) { new } else { old })
        }
        // In a corner the two joints may be one.
        (new @ (Ok(_) | Err(Misfit { .. } | Work { .. } | Jammed { .. })), Err(_)) => new,
        (_, old) => old,
    }
}

/// The start with each joint moved by up to the length of the longest member, without any symmetry.
fn displaced(frame: &Frame, start: &Shape, attempt: usize) -> Shape {
    let step: Vec<f64> = (0..frame.freedom)
        .map(|k| (attempt as f64 * SPREAD * (1.0 + GOLDEN * k as f64).sqrt()).sin())
        .collect();
    Shape { x: frame.moved(&start.x, 1.0, &step), force: vec![0.0; start.force.len()] }
}

/// Find a local minimum from places of the joints, m.
///
/// The seed need not keep the lengths; supported joints are moved onto their supports.
///
/// # Errors
///
/// [`Error`]; `Ok` means what it means for [`minimise`].
pub fn minimise_from(
    system: &System,
    seed_m: &[Vector],
    settings: &Settings,
) -> Result<Solution, Error> {
    let found = from_seed(system, seed_m, settings);
    at_corners(system, found, |joined| {
        from_seed(&joined.system, &joined.places_m(seed_m), settings)
    })
}

/// With all joints for themselves.
fn from_seed(system: &System, seed_m: &[Vector], settings: &Settings) -> Result<Solution, Error> {
    within(system, settings, |frame, settings| {
        let start = seeded(frame, seed_m)?;
        let factor = || Factor::new(&frame.spots, &frame.rods, &frame.meter);
        let none = Effort::default();
        let own = || {
            let max_iterations = settings.max_iterations.min(OWN_STEPS);
            let few = Settings { max_iterations, ..*settings };
            let pace = Pace { own: true, ..Pace::default() };
            descend(frame, factor().ok()?, start.clone(), pace, &few, none).ok()
        };
        let elastic = frame.rods.iter().any(Rod::elastic);
        let mut found = match elastic.then(own).flatten() {
            Some(found) => Ok(found),
            // Stiffnesses of different orders lead down a narrow valley, and springs that soften them past it.
            None => descend(frame, factor()?, start.clone(), Pace::default(), settings, none),
        };
        if found.as_ref().is_err_and(hard_to_close) && frame.slope(&start).misfit < RELAXED {
            // The loads have crushed it, which its lengths would not allow.
            let pace = Pace { near: RELAXED, ..Pace::default() };
            let near = descend(frame, factor()?, start, pace, settings, none);
            found = better(frame, near, found);
        }
        found
    })
}

/// Find the local minimum next to a structure as it is drawn, m.
///
/// The descent begins with the forces of the linear analysis at that shape and takes small steps,
/// so that it stays in the basin that the drawing lies in. Where it lies in none, the minimum found
/// is elsewhere: how far is for the caller to say.
///
/// # Errors
///
/// [`Error`]; `Ok` means what it means for [`minimise`].
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // Two props of 5 m, elastic, feet 6 m apart, 10 N on top: under the load they stand.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::anchor("C", [0.0, 3.0, 0.0]),
///     Joint::free("top").with_force([0.0, 0.0, -10.0]),
/// ];
/// let bar = Bar::homogeneous(5.0, 0.0)?;
/// let members = (0..3).map(|foot| Member::bar(foot, 3, bar).with_stiffness(1e6)).collect();
/// let system = System::new("props", 10.0, joints, members)?;
/// let drawn = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
/// let solution = energy::net::minimise_near(&system, &drawn, &Default::default())?;
/// assert!((solution.equilibrium.joints_m[3][2] - 4.0).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn minimise_near(
    system: &System,
    drawing_m: &[Vector],
    settings: &Settings,
) -> Result<Solution, Error> {
    let found = near_drawing(system, drawing_m, settings);
    at_corners(system, found, |joined| {
        near_drawing(&joined.system, &joined.places_m(drawing_m), settings)
    })
}

/// With all joints for themselves, in short steps; where these lead nowhere, in longer ones.
fn near_drawing(
    system: &System,
    drawing_m: &[Vector],
    settings: &Settings,
) -> Result<Solution, Error> {
    let by = |least: f64| {
        let mut step = DRAWN_STEP;
        let found = within(system, settings, |frame, settings| {
            let drawn = seeded(frame, drawing_m)?;
            let mut factor = Factor::new(&frame.spots, &frame.rods, &frame.meter)?;
            let (start, moved) = loaded(frame, &mut factor, &drawn);
            step = moved.clamp(least, DRAWN_STEP);
            // With forces near those of the minimum.
            let pace = Pace { strain: LENGTHS_FIRST, near: DRAWN, step, own: true };
            descend(frame, factor, start, pace, settings, Effort::default())
        });
        (found, step < DRAWN_STEP)
    };
    match by(LEAST_DRAWN_STEP) {
        (Err(error), true) if !matches!(error, Error::Work { .. }) => {
            by(DRAWN_STEP).0.map_err(|_| error)
        }
        (found, _) => found,
    }
}

/// The seed in the solver's units, on the supports. Elastic members bear what their lengths say
/// where no load gives a scale of the forces, the others nothing.
pub(super) fn seeded(frame: &Frame, seed_m: &[Vector]) -> Result<Shape, Error> {
    let joints = frame.joints;
    let scale = 1.0 / frame.length_m;
    let x: Vec<Vector> =
        seed_m.iter().map(|at_m| scaled(scale, along(*at_m, -1.0, frame.origin_m))).collect();
    let given = x.iter().filter(|x| norm(**x).is_finite()).count();
    if x.len() != joints || given != joints {
        return Err(Error::Seed { joints, given });
    }
    // What stands behind the joints stays where it is.
    let behind = frame.supports[joints..].iter().copied();
    let onto = |(joint, x): (usize, Vector)| {
        let (spot, support) = (&frame.spots[joint], frame.supports[joint]);
        let away = along(x, -1.0, support);
        let free = spot.axes[..spot.freedom].iter();
        free.fold(support, |sum, axis| along(sum, dot(away, *axis), *axis))
    };
    let x: Vec<Vector> = x.into_iter().chain(behind).enumerate().map(onto).collect();
    let mut force = vec![0.0; frame.rods.len()];
    if frame.largest_force(&force) <= 0.0 {
        let excesses = frame.excesses(&x);
        for ((force, rod), excess) in force.iter_mut().zip(&frame.rods).zip(excesses) {
            *force = rod.prestress(excess.value);
        }
    }
    Ok(Shape { x, force })
}

/// What a search has cost.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Effort {
    pub(super) relaxation: u64,
    pub(super) iterations: u64,
}

/// What a run of the minimiser ends with.
pub(super) struct Minimum {
    pub(super) shape: Shape,
    pub(super) factor: Factor,
    pub(super) effort: Effort,
    /// Where lengths overdetermine the shape.
    pub(super) limit: Option<Limit>,
}

/// The minimum with bars taken for cables.
fn relax(
    frame: &Arc<Frame>,
    factor: Factor,
    start: Shape,
    effort: &mut Effort,
) -> Result<(Shape, Factor), Error> {
    let mut solver = Interior::new(Arc::clone(frame), factor, &start);
    frame.finite_slope(&start)?;
    let mut shape = start;
    // Ended or not: a relaxation is only a start.
    while effort.relaxation < ITERATIONS {
        frame.meter.check()?;
        effort.relaxation += 1;
        let Some(next) = solver.mehrotra(&shape) else { break };
        let unbalance = frame.finite_slope(&next)?.unbalance;
        shape = next;
        if solver.centred(&shape.force, unbalance) {
            break;
        }
    }
    Ok((solver.settled(&shape), solver.factor))
}

/// First strain of the springs where the lengths come before the loads.
const LENGTHS_FIRST: f64 = 1e-3;

/// Misfit from a relaxation, or from a seed that is meant to be near its answer, which are right for most members, up to
/// which Newton's method for places and forces is tried: in any case.
const RELAXED: f64 = 0.5;

/// The same next to a drawing: from further away it might leave the basin.
const DRAWN: f64 = 0.05;

/// Largest relative displacement of the ends of a member in one step next to a drawing, over its
/// length: less than what turns a member over. Of elastic structures it is no longer than the displacement of the linear
/// analysis, but for the least: a stiff dome has other minima beside that next to its drawing.
const DRAWN_STEP: f64 = 0.1;
const LEAST_DRAWN_STEP: f64 = 1e-3;

/// Down to a local minimum.
fn descend(
    frame: &Arc<Frame>,
    factor: Factor,
    start: Shape,
    pace: Pace,
    settings: &Settings,
    mut effort: Effort,
) -> Result<Minimum, Error> {
    let mut solver = Newton::new(Arc::clone(frame), factor, *settings, &start.force, pace);
    let mut slope = frame.finite_slope(&start)?;
    let mut shape = start;
    while !solver.ended {
        if effort.iterations >= settings.max_iterations {
            let Slope { unbalance, misfit, .. } = slope;
            let iterations = effort.iterations;
            let limit = || Error::IterationLimit { iterations, unbalance, misfit };
            let relaxed = frame.is_relaxed(&shape);
            return Err(if relaxed {
                Error::NoLoad
            } else {
                frame.jam(&shape).unwrap_or_else(limit)
            });
        }
        shape = solver.iterate(&shape, &slope)?;
        slope = frame.finite_slope(&shape)?;
        effort.iterations += 1;
    }
    let Newton { factor, limit, .. } = solver;
    Ok(Minimum { shape, factor, effort, limit })
}
