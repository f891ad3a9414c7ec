//! Members whose prestress is known instead of their unstretched length.

use super::{Kind, Member, PointLoad};
use crate::readable::Readable;
use crate::{Bar, BarError};

/// Why a member has no unstretched length that goes with a prestress.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrestressError {
    /// Occurs when the member has no stiffness.
    #[error(
        "a prestress needs a stiffness: an inextensible member has its length whatever it bears"
    )]
    Inextensible,
    /// Occurs when the stiffness is zero, negative, infinite or not a number.
    #[error("the stiffness EA of a member must be positive and finite, got {} N", Readable(*stiffness_n))]
    Stiffness {
        /// The stiffness as given.
        stiffness_n: f64,
    },
    /// Occurs when the prestress is infinite or not a number.
    #[error("a prestress must be finite, got {prestress_n} N")]
    NotFinite {
        /// The prestress as given.
        prestress_n: f64,
    },
    /// Occurs when a cable is to push or a strut to pull.
    #[error("{} under a prestress of {} N", contradiction(*kind), Readable(*prestress_n))]
    Sign {
        /// The kind of the member.
        kind: Kind,
        /// The prestress as given.
        prestress_n: f64,
    },
    /// Occurs when the member would be pressed to nothing from any length.
    #[error(
        "a prestress must be greater than -EA = {} N, which no length bears, got {} N",
        Readable(-*stiffness_n), Readable(*prestress_n)
    )]
    Crushed {
        /// The stiffness.
        stiffness_n: f64,
        /// The prestress as given.
        prestress_n: f64,
    },
    /// Occurs when the unstretched length is out of range.
    #[error(transparent)]
    Bar(#[from] BarError),
}

fn contradiction(kind: Kind) -> &'static str {
    match kind {
        Kind::Cable => "a cable cannot push, as it would",
        Kind::Strut => "a strut cannot pull, as it would",
        Kind::Bar => "a bar cannot be",
    }
}

impl Member {
    /// The same elastic member with another unstretched length: so long that it bears the axial
    /// force `prestress_n` (N, tension positive) at the length `d` that it has,
    ///
    /// $$ l = \frac{d}{1 + F/EA}, \qquad\text{since}\qquad F = EA\,\frac{d - l}{l}. $$
    ///
    /// Its mass stays, and with the length the places of its weight and of its loads are scaled:
    /// they are at the same parts of it.
    ///
    /// # Errors
    ///
    /// [`PrestressError`]: no stiffness, a cable that would push, a strut that would pull, a
    /// pressure from the stiffness on.
    ///
    /// ```
    /// use model::{Bar, system::{Member, PrestressError}};
    /// let rope = Member::cable(0, 1, Bar::homogeneous(5.0, 2.0)?);
    /// assert_eq!(rope.clone().with_prestress(200.0), Err(PrestressError::Inextensible));
    /// // At a quarter of its stiffness it is a quarter longer than it was.
    /// let tight = rope.with_stiffness(800.0).with_prestress(200.0)?;
    /// assert_eq!((tight.body.length_m(), tight.body.centre_m(), tight.body.mass_kg()), (4.0, 2.0, 2.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_prestress(mut self, prestress_n: f64) -> Result<Self, PrestressError> {
        let stiffness_n = self.stiffness_n.ok_or(PrestressError::Inextensible)?;
        let stretch = self.stretch(stiffness_n, prestress_n)?;
        let body = self.body;
        let (stressed_m, mass_kg) = (body.length_m(), body.mass_kg());
        let length_m = stressed_m / stretch;
        // The last place of it may be past the end by rounding.
        let scaled = |at_m: f64| (at_m / stretch).min(length_m);
        let slender = Bar::slender_inertia(stressed_m, mass_kg);
        let stands_in = slender.map(f64::to_bits) == body.inertia_kg_m2().map(f64::to_bits);
        let inertia_kg_m2 =
            if stands_in { Bar::slender_inertia(length_m, mass_kg) } else { body.inertia_kg_m2() };
        let middle = body.centre_m().to_bits() == (0.5 * stressed_m).to_bits();
        let centre_m = if middle { 0.5 * length_m } else { scaled(body.centre_m()) };
        self.body = Bar::new(length_m, mass_kg, centre_m, inertia_kg_m2)?;
        for PointLoad { at_m, .. } in &mut self.loads {
            *at_m = scaled(*at_m);
        }
        Ok(self)
    }

    /// `1 + F/EA`: the length under a force over the unstretched one.
    fn stretch(&self, stiffness_n: f64, prestress_n: f64) -> Result<f64, PrestressError> {
        if !(stiffness_n.is_finite() && stiffness_n > 0.0) {
            return Err(PrestressError::Stiffness { stiffness_n });
        }
        if !prestress_n.is_finite() {
            return Err(PrestressError::NotFinite { prestress_n });
        }
        let contradicts = match self.kind {
            Kind::Bar => false,
            Kind::Cable => prestress_n < 0.0,
            Kind::Strut => prestress_n > 0.0,
        };
        if contradicts {
            return Err(PrestressError::Sign { kind: self.kind, prestress_n });
        }
        if prestress_n <= -stiffness_n {
            return Err(PrestressError::Crushed { stiffness_n, prestress_n });
        }
        Ok(1.0 + prestress_n / stiffness_n)
    }
}
