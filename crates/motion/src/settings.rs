use crate::error::{MotionError, Result};

/// Order of the integrator.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Order {
    /// RATTLE.
    #[default]
    Second,
    /// Five steps of RATTLE of the lengths `p h, p h, (1 − 4p) h, p h, p h`, `p = 1/(4 − 4^(1/3))`
    /// (Suzuki, Phys. Lett. A 146 (1990) 319-323).
    Fourth,
    /// Seventeen steps of RATTLE (W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089-1099), for motions
    /// to many digits.
    Eighth,
}

/// Settings of an integration.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Settings {
    /// Order in the length of the step.
    pub order: Order,
    /// Drag of a medium, 1/s: the force `−c M v` opposes the momentum. At least zero; default zero.
    pub damping_1_s: f64,
    /// Friction in the joints, N m s: each member turns against a pin with the moment `−k (ω_member
    /// − ω_pin)`, less its part along the member. The pin of an anchor stands still, the pin of any
    /// other joint has no inertia and turns so that the moments on it cancel. A rope over rings and
    /// pulleys bends without any. At least zero; default zero.
    pub friction_n_m_s: f64,
}

impl Settings {
    /// Refuse what is out of range.
    ///
    /// # Errors
    ///
    /// [`MotionError::Input`] when a damping is negative or not finite.
    pub fn validate(&self) -> Result<()> {
        let dampings = [
            ("damping, 1/s", self.damping_1_s),
            ("friction in the joints, N m s", self.friction_n_m_s),
        ];
        for (what, value) in dampings {
            if !(value.is_finite() && value >= 0.0) {
                let reason = format!("must be zero or positive, and finite, got {value}");
                return Err(MotionError::Input { what, reason });
            }
        }
        Ok(())
    }
}
