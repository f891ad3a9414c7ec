/// What a solve took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Effort {
    /// Steps of all kinds.
    pub iterations: usize,
    /// Steps of relaxation among them.
    pub relaxation_steps: usize,
    /// Relaxations: 0 when Newton's method got there from the seed.
    pub relaxations: usize,
    /// How many times a bar was described by other angles, away from gimbal lock; see
    /// [`Settings::lock_margin`](crate::Settings::lock_margin).
    pub reparametrisations: usize,
    /// False roots of the paper's equations that were met and left.
    pub false_roots: usize,
    /// Wall-clock time, s.
    pub solve_s: f64,
}
