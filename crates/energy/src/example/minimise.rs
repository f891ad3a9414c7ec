//! The minimum that the scan was looking for: (vi) on the closure curve, from any seed.

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use argmin::core::{
    CostFunction, Executor, Gradient, IterState, KV, Problem, Solver, State, TerminationReason,
    TerminationStatus,
};

use super::{beta, closure, closure_gradient, potential, potential_gradient};
use crate::error::Error;
use crate::run::Settings;
use crate::thresholds::{BISECTIONS, CORRECTIONS, ROUNDING, STEP_ROUNDING};

/// A local minimum of (vi) on the closure curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExampleMinimum {
    /// Angle of bar 1 from the descending vertical, rad, in (-pi, pi].
    pub theta_rad: f64,
    /// Angle of bar 2, rad.
    pub alpha_rad: f64,
    /// Angle of bar 3, rad.
    pub beta_rad: f64,
    /// Energy (vi), `mgl`.
    pub energy_mgl: f64,
    /// Gradient of (vi) along the curve per unit of its length in the plane of theta and alpha,
    /// `mgl` per rad: zero at an equilibrium.
    pub gradient_mgl: f64,
    /// Second derivative along the curve, `mgl` per rad²: positive at a minimum.
    pub curvature_mgl: f64,
    /// What is left of the closure.
    pub closure: f64,
    /// Iterations of the minimiser.
    pub iterations: u64,
}

/// Minimise (vi) over theta and alpha on the closure curve, from any seed.
///
/// The curve is closed and has two minima, E1 and its mirror image, both global, and two maxima
/// between them; a seed goes to the minimum on its side. `gradient_tolerance` of the settings is in
/// `mgl` here; `motion` means nothing.
///
/// Section VIII, Solution 1 of the paper, (vi) and (viii).
///
/// # Errors
///
/// [`Error::SeedAngle`] for a seed that is not finite, or an error of the run.
///
/// ```
/// let found = energy::example::minimise(0.3, 0.7, &energy::Settings::default())?;
/// // 40-digit root finding: theta = 19.69486797613301988864753 deg.
/// assert!((found.theta_rad.to_degrees() - 19.694_867_976_133_02).abs() < 1e-13);
/// # Ok::<(), energy::Error>(())
/// ```
pub fn minimise(
    theta_rad: f64,
    alpha_rad: f64,
    settings: &Settings,
) -> Result<ExampleMinimum, Error> {
    settings.validate()?;
    if let Some(&angle_rad) = [theta_rad, alpha_rad].iter().find(|a| !a.is_finite()) {
        return Err(Error::SeedAngle { angle_rad });
    }
    let start = onto_curve([theta_rad, alpha_rad].map(wrapped));
    let begin = |state: Iterate| state.param(start).max_iters(settings.max_iterations);
    let solver = CurveNewton { settings: *settings, converged: false, polished: false };
    let executor = Executor::new(Example, solver).configure(begin);
    let other = |error: argmin::core::Error| Error::Ended { reason: error.to_string() };
    let ended = executor.ctrlc(false).timer(false).run();
    let state = ended.map_err(|error| error.downcast::<Error>().unwrap_or_else(other))?.state;
    let Some(&place) = state.get_param() else {
        return Err(Error::NotFinite { quantity: "last iterate" });
    };
    let Along { gradient, curvature, .. } = Along::at(place);
    let limit = Error::NotConverged { iterations: state.get_iter(), gradient: gradient.abs() };
    verdict(state.get_termination_status(), limit, |reason| Error::Ended { reason })?;
    let [theta_rad, alpha_rad] = place;
    Ok(ExampleMinimum {
        theta_rad,
        alpha_rad,
        beta_rad: beta(theta_rad, alpha_rad),
        energy_mgl: potential(theta_rad, alpha_rad),
        gradient_mgl: gradient,
        curvature_mgl: curvature,
        closure: closure(theta_rad, alpha_rad),
        iterations: state.get_iter(),
    })
}

/// What the end of a run says: converged, the `limit` of iterations, or another end, by its text.
fn verdict<E>(
    status: &TerminationStatus,
    limit: E,
    other: impl FnOnce(String) -> E,
) -> Result<(), E> {
    match status {
        TerminationStatus::Terminated(TerminationReason::SolverConverged) => Ok(()),
        TerminationStatus::Terminated(TerminationReason::MaxItersReached) => Err(limit),
        TerminationStatus::Terminated(reason) => Err(other(reason.text().to_owned())),
        TerminationStatus::NotTerminated => Err(other("not terminated".to_owned())),
    }
}

/// The angle in (-pi, pi].
fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

/// The closed chain on the ray from the straight chain `(0, 0)` through the seed.
///
/// The closure is -1 at `(0, 0)` and rises along every ray until both angles are beyond 90 degrees:
/// its derivative along the ray is `4 a sin(ta) + 4 b sin(tb) - 2 (b - a) sin(t (b - a))`, and with
/// `|sin(x ± y)| <= |sin x| + |sin y|` that is not negative. Closed chains have angles below 76
/// degrees (`cos >= 1/4`), so each ray meets the curve exactly once.
fn onto_curve([theta, alpha]: [f64; 2]) -> [f64; 2] {
    let largest = theta.abs().max(alpha.abs());
    // The straight chain itself is on every ray: take the one between the axes.
    let ray = if largest > 0.0 { [theta / largest, alpha / largest] } else { [1.0, 1.0] };
    // The closed chain is between the angles 0 and 90 degrees.
    let (mut low, mut high) = (0.0_f64, 2.0 * FRAC_PI_4);
    let mut t = FRAC_PI_4;
    for _ in 0..BISECTIONS {
        let place = ray.map(|x| t * x);
        let f = closure(place[0], place[1]);
        if f < 0.0 {
            low = t;
        } else {
            high = t;
        }
        let g = closure_gradient(place);
        let newton = t - f / (g[0] * ray[0] + g[1] * ray[1]);
        if (newton - t).abs() <= STEP_ROUNDING {
            break;
        }
        t = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
    }
    let (place, _) = corrected(ray.map(|x| t * x));
    place
}

/// Back to the curve by Newton's method across it; with what is left.
fn corrected(mut place: [f64; 2]) -> ([f64; 2], f64) {
    let mut f = closure(place[0], place[1]);
    for _ in 0..CORRECTIONS {
        if f.abs() <= ROUNDING {
            break;
        }
        let g = closure_gradient(place);
        let step = f / (g[0] * g[0] + g[1] * g[1]);
        place = [place[0] - step * g[0], place[1] - step * g[1]];
        f = closure(place[0], place[1]);
    }
    (place, f)
}

/// First and second derivative of the energy along the curve, by its length.
#[derive(Debug, Clone, Copy)]
struct Along {
    tangent: [f64; 2],
    gradient: f64,
    curvature: f64,
}

impl Along {
    fn at(place: [f64; 2]) -> Self {
        let (v, f) = (potential_gradient(place), closure_gradient(place));
        let size = f[0].hypot(f[1]);
        let tangent = [-f[1] / size, f[0] / size];
        let gradient = v[0] * tangent[0] + v[1] * tangent[1];
        // Multiplier of the closure by least squares, and the second derivatives of V + mu f.
        let mu = -(v[0] * f[0] + v[1] * f[1]) / (size * size);
        let [theta, alpha] = place;
        let across = 2.0 * (alpha - theta).cos();
        let tt = 2.0 * theta.cos() + mu * (4.0 * theta.cos() - across);
        let aa = alpha.cos() + mu * (4.0 * alpha.cos() - across);
        let ta = mu * across;
        let [x, y] = tangent;
        Self { tangent, gradient, curvature: tt * x * x + 2.0 * ta * x * y + aa * y * y }
    }
}

/// The example as argmin sees it.
#[derive(Debug, Clone, Copy)]
struct Example;

impl CostFunction for Example {
    type Param = [f64; 2];
    type Output = f64;

    fn cost(&self, place: &[f64; 2]) -> Result<f64, argmin::core::Error> {
        let value = potential(place[0], place[1]);
        if value.is_finite() {
            Ok(value)
        } else {
            Err(Error::NotFinite { quantity: "energy" }.into())
        }
    }
}

impl Gradient for Example {
    type Param = [f64; 2];
    type Gradient = f64;

    /// Along the curve.
    fn gradient(&self, place: &[f64; 2]) -> Result<f64, argmin::core::Error> {
        Ok(Along::at(*place).gradient)
    }
}

type Iterate = IterState<[f64; 2], f64, (), (), (), f64>;

/// Newton's method along the curve, for argmin: it has no solver for constrained problems.
///
/// Each step goes along the tangent, downhill by the gradient over the size of the curvature, and
/// back onto the curve; it is halved until the energy falls. At a maximum it steps aside.
#[derive(Debug)]
struct CurveNewton {
    settings: Settings,
    converged: bool,
    polished: bool,
}

/// The longest step along the curve, rad. The curve is about six radians long.
const LONGEST_STEP: f64 = 0.5;

/// The step aside at a maximum, rad: far enough for the energy to notice.
const STEP_ASIDE: f64 = 0.1;

impl Solver<Example, Iterate> for CurveNewton {
    fn name(&self) -> &'static str {
        "Newton along the closure curve"
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Example>,
        mut state: Iterate,
    ) -> Result<(Iterate, Option<KV>), argmin::core::Error> {
        let Some(place) = state.take_param() else {
            return Err(Error::NotFinite { quantity: "first iterate" }.into());
        };
        let value = problem.cost(&place)?;
        let along = Along::at(place);
        let size = along.gradient.abs();
        let stationary = size <= self.settings.gradient_tolerance
            && closure(place[0], place[1]).abs() <= self.settings.closure_tolerance;
        let minimum = stationary && along.curvature > 0.0;
        if minimum && (self.polished || size <= f64::EPSILON) {
            self.converged = true;
            return Ok((state.param(place).gradient(along.gradient).cost(value), None));
        }
        // One more step than the tolerance asks for squares what is left.
        self.polished = minimum;
        let newton = -along.gradient / along.curvature.abs();
        let mut step = if along.curvature < 0.0 && newton.abs() < STEP_ASIDE {
            STEP_ASIDE.copysign(newton)
        } else {
            newton.clamp(-LONGEST_STEP, LONGEST_STEP)
        };
        for _ in 0..BISECTIONS {
            let aside = [place[0] + step * along.tangent[0], place[1] + step * along.tangent[1]];
            let (next, left) = corrected(aside);
            let lower = problem.cost(&next)?;
            let gradient = problem.gradient(&next)?;
            let falls = lower < value || (lower - value <= STEP_ROUNDING && gradient.abs() < size);
            if left.abs() <= self.settings.closure_tolerance && falls {
                return Ok((state.param(next).gradient(gradient).cost(lower), None));
            }
            step *= 0.5;
            if minimum {
                // The gradient has reached its rounding.
                self.converged = true;
                return Ok((state.param(place).gradient(along.gradient).cost(value), None));
            }
        }
        Err(Error::NoDescent {
            iterations: state.get_iter(),
            gradient: size,
            gap: closure(place[0], place[1]).abs(),
            directions: usize::from(along.curvature < 0.0),
        }
        .into())
    }

    fn terminate(&mut self, _state: &Iterate) -> TerminationStatus {
        if self.converged {
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// E1 and its mirror image, deg and mgl: 40-digit root finding (external).
    const E1_DEG: [f64; 3] = [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];
    const E1_MGL: f64 = 2.335_468_651_999_305;

    #[test]
    fn every_seed_of_a_grid_over_the_torus_ends_at_e1_or_its_mirror_image() {
        let mut most = 0;
        for i in -36..36 {
            for k in -36..36 {
                let seed = [i, k].map(|x| f64::from(x) * 5.0_f64.to_radians());
                let found = minimise(seed[0], seed[1], &Settings::default()).unwrap();
                let side = found.theta_rad.signum();
                let angles = [found.theta_rad, found.alpha_rad, found.beta_rad];
                for (angle, e1) in angles.iter().zip(E1_DEG) {
                    assert!((side * angle - e1.to_radians()).abs() < 1e-14, "{seed:?}");
                }
                assert!((found.energy_mgl - E1_MGL).abs() < 2e-15);
                assert!(found.gradient_mgl.abs() <= 1e-12 && found.closure.abs() < 1e-14);
                assert!(found.curvature_mgl > 0.0);
                most = most.max(found.iterations);
            }
        }
        // The work, frozen: a change of the method shows here.
        assert_eq!(most, 11);
    }

    #[test]
    fn a_maximum_is_left() {
        // E2, the other planar equilibrium: 40-digit root finding (external).
        let e2 = [73.920_588_792_231_34_f64, -38.599_136_184_451_89].map(f64::to_radians);
        assert!(Along::at(e2).gradient.abs() < 1e-14 && Along::at(e2).curvature < 0.0);
        let found = minimise(e2[0], e2[1], &Settings::default()).unwrap();
        assert!((found.energy_mgl - E1_MGL).abs() < 2e-15);
    }

    #[test]
    fn the_curvature_is_its_difference_quotient() {
        // The gradient by arc length, differenced along the curve.
        for place in [[0.3, 0.4], [-0.9, 0.2], [1.0, -1.0], [0.05, 0.9]] {
            let place = onto_curve(place);
            let along = Along::at(place);
            let g = |h: f64| {
                let aside = [place[0] + h * along.tangent[0], place[1] + h * along.tangent[1]];
                Along::at(corrected(aside).0).gradient
            };
            let d = |h: f64| (g(h) - g(-h)) / (2.0 * h);
            let quotient = (4.0 * d(5e-4) - d(1e-3)) / 3.0;
            assert!((along.curvature - quotient).abs() < 1e-9, "{place:?}");
        }
    }

    #[test]
    fn seeds_that_are_no_numbers_and_runs_without_time_are_errors() {
        let settings = Settings::default();
        assert!(matches!(minimise(f64::NAN, 0.0, &settings), Err(Error::SeedAngle { .. })));
        assert!(matches!(minimise(0.0, f64::INFINITY, &settings), Err(Error::SeedAngle { .. })));
        let short = Settings { max_iterations: 1, ..settings };
        assert!(matches!(
            minimise(-1.0, 1.0, &short),
            Err(Error::NotConverged { iterations: 1, .. })
        ));
        assert!(minimise(1e6, -1e6, &settings).is_ok());
    }

    /// The closed chain lies on the ray of its seed, to the accuracy of the search along it.
    #[test]
    fn closed_chains_lie_on_their_rays() {
        for i in -7..8 {
            for k in -7..8 {
                let seed = [f64::from(i) * 0.4, f64::from(k) * 0.4];
                let [theta, alpha] = onto_curve(seed);
                assert!(closure(theta, alpha).abs() < 1e-14);
                let [x, y] = if i == 0 && k == 0 { [1.0, 1.0] } else { seed };
                assert!((theta * y - alpha * x).abs() < 1e-5 * x.hypot(y), "{seed:?}");
                assert!(theta * x + alpha * y > 0.0, "{seed:?}");
            }
        }
    }

    /// Only one of the reasons to stop is a success.
    #[test]
    fn a_run_that_ends_otherwise_is_an_error() {
        let run = |status| verdict(&status, None, Some);
        let reason = |reason| run(TerminationStatus::Terminated(reason));
        assert_eq!(reason(TerminationReason::SolverConverged), Ok(()));
        assert_eq!(reason(TerminationReason::MaxItersReached), Err(None));
        for other in [
            TerminationReason::TargetCostReached,
            TerminationReason::Interrupt,
            TerminationReason::Timeout,
            TerminationReason::SolverExit("tired".to_owned()),
        ] {
            assert!(matches!(reason(other), Err(Some(_))));
        }
        assert!(matches!(run(TerminationStatus::NotTerminated), Err(Some(_))));
    }
}
