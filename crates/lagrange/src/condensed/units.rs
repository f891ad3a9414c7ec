//! The units in which a chain is solved: of its own size, so that no length, mass or gravity
//! overflows.

/// What one is, in SI units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    /// m, a power of two.
    pub length: f64,
    /// kg, a power of two.
    pub mass: f64,
    /// m/s².
    pub gravity: f64,
}

impl Units {
    /// N
    pub fn force(self) -> f64 {
        self.mass * self.gravity
    }
}
