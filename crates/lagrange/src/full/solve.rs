//! The solve, from a seed or from nothing.

use std::time::Instant;

use model::{InSpace, Problem, Stability};

use crate::effort::Effort;
use crate::error::Error;
use crate::full::indeterminate;
use crate::full::mechanism::{Mechanism, Units};
use crate::full::newton::newton;
use crate::full::reduced::Reduced;
use crate::full::relax::relax;
use crate::full::seed::{Seed, perturb};
use crate::full::solution::{Solution, energy, first_offset};
use crate::full::stability::stability;
use crate::settings::Settings;
use crate::thresholds::ZERO;

/// False roots left in one run: with other angles a bar has no false root near by.
const ESCAPES: usize = 16;
/// The first relaxation hands over to Newton's method at this norm of the residual, and each further one at this part of the
/// norm of the one before, down to the tolerance.
const HANDOVER: f64 = 1e-2;

/// A solver with its memory, for many seeds of one problem: nothing is allocated from seed to seed.
///
/// ```
/// use lagrange::{Seed, Settings, Solver};
/// let problem = model::cases::paper();
/// let mut solver = Solver::new(&problem, &Settings::default())?;
/// let found = solver.solve(&Seed::planar(&[0.3, 0.7, -1.3]))?;
/// // V of the paper counts from 6 mgl lower; here mgl = 9.80665 J.
/// assert!((found.energy_j() / 9.80665 + 6.0 - 2.335_468_651_999_305).abs() < 1e-12);
/// assert!(found.effort().iterations < 10);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Solver<'p> {
    problem: &'p Problem,
    settings: Settings,
    units: Units,
    reduced: Reduced,
    perturbed: Vec<[f64; 3]>,
    history: Vec<f64>,
    effort: Effort,
}

/// A converged state in the memory of its solver.
///
/// ```
/// use lagrange::{Seed, Settings, Solver};
/// let problem = model::cases::paper();
/// let mut solver = Solver::new(&problem, &Settings::default())?;
/// let found = solver.solve(&Seed::planar(&[0.3, 0.7, -1.3]))?;
/// assert!(found.residual() <= 1e-13);
/// assert_eq!(found.solution()?.nullity, 4);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Converged<'s> {
    solver: &'s Solver<'s>,
}

impl<'p> Solver<'p> {
    /// A solver for one problem.
    ///
    /// # Errors
    ///
    /// [`Error::Settings`] when a setting is out of range.
    ///
    /// ```
    /// use lagrange::{Settings, Solver};
    /// let unusable = Settings { max_iterations: 0, ..Default::default() };
    /// assert!(Solver::new(&model::cases::paper(), &unusable).is_err());
    /// ```
    pub fn new(problem: &'p Problem, settings: &Settings) -> Result<Self, Error> {
        settings.validate()?;
        let chain = problem.chain();
        let units = Units::total(chain);
        Ok(Self {
            problem,
            settings: *settings,
            units,
            reduced: Reduced::new(Mechanism::scaled(chain, units), settings.lock_margin),
            perturbed: vec![[0.0; 3]; chain.bars().len()],
            history: Vec::with_capacity(2 * settings.max_iterations.min(1000)),
            effort: Effort::default(),
        })
    }

    /// The equilibrium that the seed leads to, whatever its stability: Newton's method from the
    /// seed, and if that stops at a local minimum of the residual, from where the chain has relaxed
    /// to.
    ///
    /// # Errors
    ///
    /// [`Error`]: a seed that does not fit, or no convergence.
    ///
    /// ```
    /// use lagrange::{Seed, Settings, Solver};
    /// let problem = model::cases::paper();
    /// let mut solver = Solver::new(&problem, &Settings::default())?;
    /// // E1 and its mirror image: one energy.
    /// let one = solver.solve(&Seed::planar(&[0.3, 0.7, -1.3]))?.energy_j();
    /// let other = solver.solve(&Seed::planar(&[-0.3, -0.7, 1.3]))?.energy_j();
    /// assert!((one - other).abs() < 1e-13);
    /// # Ok::<(), lagrange::Error>(())
    /// ```
    pub fn solve(&mut self, seed: &Seed) -> Result<Converged<'_>, Error> {
        let clock = Instant::now();
        seed.check(self.reduced.carried.len())?;
        self.reset();
        self.reduced.start(seed.angles());
        let mut converged = self.newton()?;
        while !converged && self.effort.relaxations < self.settings.relaxations {
            self.relax_from(seed);
            converged = self.newton()?;
        }
        self.effort.solve_s = clock.elapsed().as_secs_f64();
        if converged { Ok(Converged { solver: self }) } else { Err(self.stagnated()) }
    }

    /// The stable equilibrium, from no guess: an arc between the anchors is relaxed and then
    /// solved, again from a perturbed arc while the result is unstable.
    ///
    /// For a chain, stable in space means that no configuration has less energy: the stress matrix
    /// of a stable equilibrium is positive semidefinite.
    ///
    /// # Errors
    ///
    /// [`Error::Unstable`] or [`Error::Stagnated`] when nothing stable is found.
    ///
    /// ```
    /// use lagrange::{Settings, Solver};
    /// let problem = model::cases::paper();
    /// let mut solver = Solver::new(&problem, &Settings::default())?;
    /// assert_eq!(solver.solve_stable()?.stability().index_in_space, 0);
    /// # Ok::<(), lagrange::Error>(())
    /// ```
    pub fn solve_stable(&mut self) -> Result<Converged<'_>, Error> {
        let clock = Instant::now();
        let seed = Seed::arc(self.problem);
        self.reset();
        let mut last = None;
        loop {
            self.relax_from(&seed);
            let converged = self.newton()?;
            self.effort.solve_s = clock.elapsed().as_secs_f64();
            if converged {
                indeterminate::resolve(&mut self.reduced, self.problem, &self.settings);
                let stability = stability(&self.reduced.mechanism, &self.reduced.here);
                if stability.in_space == InSpace::Stable {
                    return Ok(Converged { solver: self });
                }
                last = Some(stability.index_in_space);
            }
            if self.effort.relaxations > self.settings.relaxations {
                let unstable = last.map(|index| Error::Unstable { index });
                return Err(unstable.unwrap_or_else(|| self.stagnated()));
            }
        }
    }

    fn reset(&mut self) {
        self.history.clear();
        self.effort = Effort::default();
        self.reduced.reparametrisations = 0;
    }

    /// Runs of Newton's method until one ends at no false root; whether it has converged.
    fn newton(&mut self) -> Result<bool, Error> {
        for _ in 0..ESCAPES {
            let before = self.history.len();
            self.reduced.choose_unit();
            let converged = newton(&mut self.reduced, &self.settings, &mut self.history);
            self.effort.iterations += self.history.len() - before;
            self.effort.reparametrisations = self.reduced.reparametrisations;
            if !converged {
                return Ok(false);
            }
            // The equations hold. Do the moments?
            let (bar, moment) = self.reduced.largest_moment();
            if moment <= ZERO {
                return Ok(true);
            }
            if self.settings.lock_margin <= 0.0 {
                return Err(Error::FalseRoot { bar: bar + 1, moment });
            }
            self.effort.false_roots += 1;
            // Every bar off its best angles is below this margin.
            self.reduced.leave_gimbal_lock(1.0);
        }
        Ok(false)
    }

    /// Relax the chain from the seed, perturbed when this is not the first time.
    fn relax_from(&mut self, seed: &Seed) {
        let round = self.effort.relaxations;
        self.perturbed.copy_from_slice(seed.angles());
        if round > 0 {
            perturb(&mut self.perturbed, round);
        }
        self.reduced.start(&self.perturbed);
        let power = i32::try_from(round + 1).unwrap_or(i32::MAX);
        let handover = HANDOVER.powi(power).max(self.settings.tolerance);
        let steps = relax(&mut self.reduced, handover, self.settings.max_relaxation_steps);
        self.effort.relaxations += 1;
        self.effort.relaxation_steps += steps;
        self.effort.iterations += steps;
    }

    fn stagnated(&self) -> Error {
        Error::Stagnated {
            residual: self.reduced.norm(),
            iterations: self.effort.iterations,
            relaxations: self.effort.relaxations,
        }
    }
}

impl Converged<'_> {
    /// Potential energy from the height of joint 0, J.
    ///
    /// ```
    /// use lagrange::{Seed, Settings, Solver};
    /// let problem = model::cases::paper();
    /// let mut solver = Solver::new(&problem, &Settings::default())?;
    /// let found = solver.solve(&Seed::planar(&[0.3, 0.7, -1.3]))?;
    /// assert!((found.energy_j() / 9.80665 + 3.664531348000695).abs() < 1e-12);
    /// # Ok::<(), lagrange::Error>(())
    /// ```
    pub fn energy_j(&self) -> f64 {
        energy(&self.solver.reduced) * self.solver.units.weight * self.solver.units.length
    }

    /// The largest equation, in the units of [`Settings::tolerance`].
    pub fn residual(&self) -> f64 {
        self.solver.reduced.largest()
    }

    /// What it took.
    pub fn effort(&self) -> Effort {
        self.solver.effort
    }

    /// Second-order behaviour.
    pub fn stability(&self) -> Stability {
        stability(&self.solver.reduced.mechanism, &self.solver.reduced.here)
    }

    /// Horizontal vector from joint 0 to joint 1, m, which tells an equilibrium from its mirror
    /// image.
    pub fn first_offset_m(&self) -> [f64; 2] {
        let offset = first_offset(&self.solver.reduced) * self.solver.units.length;
        [offset.x, offset.y]
    }

    /// The whole answer. The singular values behind its nullity and condition cost far more than
    /// the solve.
    ///
    /// # Errors
    ///
    /// [`Error::Spectrum`] when their iteration does not converge.
    pub fn solution(&self) -> Result<Solution, Error> {
        let Solver { problem, settings, reduced, effort, history, .. } = self.solver;
        Solution::new(problem, settings, reduced, *effort, history.clone())
    }
}

/// The equilibrium that a seed leads to, stable or not.
///
/// # Errors
///
/// [`Error`]; `Ok` means converged.
///
/// ```
/// use lagrange::{Seed, Settings, solve_from};
/// let problem = model::cases::paper();
/// // Upside down: the maximum in the plane, which no minimiser finds.
/// let found = solve_from(&problem, &Seed::planar(&[1.3, -0.7, -0.3]), &Settings::default())?;
/// assert_eq!(found.equilibrium.stability.in_plane, model::InPlane::Maximum);
/// let [psi, _, phi] = found.angles_rad[0]; // theta = pi/2: both turn in the plane
/// assert!(((psi + phi).to_degrees() - 73.920_588_792_231_34).abs() < 1e-12);
/// # Ok::<(), lagrange::Error>(())
/// ```
pub fn solve_from(problem: &Problem, seed: &Seed, settings: &Settings) -> Result<Solution, Error> {
    Solver::new(problem, settings)?.solve(seed)?.solution()
}

/// The stable equilibrium, from no guess.
///
/// # Errors
///
/// [`Error`]; `Ok` means converged and stable.
///
/// ```
/// let found = lagrange::solve(&model::cases::paper(), &lagrange::Settings::default())?;
/// // The two anchors carry the three bars, eq. (40).
/// let reactions = found.equilibrium.reactions_n;
/// assert!((reactions.start[2] + reactions.end[2] - 3.0 * 9.80665).abs() < 1e-12);
/// # Ok::<(), lagrange::Error>(())
/// ```
pub fn solve(problem: &Problem, settings: &Settings) -> Result<Solution, Error> {
    Solver::new(problem, settings)?.solve_stable()?.solution()
}
