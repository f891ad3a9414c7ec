//! Where many starts of a solver ended.

/// How a solver ended for one start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finish {
    /// At what it looks for, to its tolerance.
    Converged,
    /// The iteration limit was reached.
    IterationLimit,
    /// No step leads further, and it is not there.
    Stalled,
    /// A number overflowed or was undefined, the start's own angles to begin with.
    NonFinite,
}

/// Where many starts in the vertical plane of the anchors ended: one entry per start, n directions
/// per start.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ends {
    /// How.
    pub finish: Vec<Finish>,
    /// Iterations spent, as the solver counts them.
    pub iterations: Vec<u16>,
    /// The solver's own residual where it stopped, without unit; infinite if it never had one.
    pub residual: Vec<f64>,
    /// Potential energy above the height of joint 0, J.
    pub energy_j: Vec<f64>,
    /// Unit directions of the bars of start 0, of start 1, ...: along the heading, and up.
    pub directions: Vec<[f64; 2]>,
}

impl Ends {
    /// Room for so many starts of so many bars; what was there may stand for what nobody writes.
    ///
    /// ```
    /// let mut ends = model::Ends::default();
    /// ends.resize(2, 3);
    /// assert_eq!(ends.finish, [model::Finish::NonFinite; 2]);
    /// assert_eq!(ends.directions.len(), 6);
    /// ```
    pub fn resize(&mut self, starts: usize, bars: usize) {
        self.finish.resize(starts, Finish::NonFinite);
        self.iterations.resize(starts, 0);
        self.residual.resize(starts, f64::NAN);
        self.energy_j.resize(starts, f64::NAN);
        self.directions.resize(starts * bars, [f64::NAN; 2]);
    }
}
