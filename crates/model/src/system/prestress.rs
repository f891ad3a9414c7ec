//! Members whose prestress is known instead of their unstretched length.

use super::{Kind, Member, PointLoad};
use crate::readable::Readable;
use crate::{Bar, BarError};

/// What is given of a prestressed member: the member at the length at which it bears its prestress.
///
/// The numbers of a system file, of which the unstretched member follows
/// ([`Member::with_prestress`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Prestress {
    /// The axial force, tension positive, N.
    pub force_n: f64,
    /// Length, mass, centre of weight and moments of inertia under this force.
    pub body: Bar,
    /// Forces on the member, at places on this length.
    pub loads: Vec<PointLoad>,
}

/// Why a member has no unstretched length that goes with a prestress.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrestressError {
    /// Occurs when the member has no stiffness.
    #[error(
        "a prestress needs a stiffness: an inextensible member has its length whatever it bears"
    )]
    Inextensible,
    /// Occurs when the stiffness, in N, is zero, negative, infinite or not a number.
    #[error("the stiffness EA of a member must be positive and finite, got {} N", Readable(*.0))]
    Stiffness(f64),
    /// Occurs when the prestress, in N, is infinite or not a number.
    #[error("a prestress must be finite, got {0} N")]
    NotFinite(f64),
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
    /// $$ l = \frac{d}{1 + F/EA}, \qquad\text{since}\qquad F = EA\\,\frac{d - l}{l}. $$
    ///
    /// Its mass stays, and with the length the places of its weight and of its loads are scaled:
    /// they are at the same parts of it. The moments of inertia across it are scaled by the square.
    /// The member as it was is kept in [`prestress`](super::MemberProperties::prestress); give the stiffness before.
    ///
    /// # Errors
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
    /// assert_eq!((tight.given_body().length_m(), tight.prestress_n()), (5.0, Some(200.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_prestress(self, prestress_n: f64) -> Result<Self, PrestressError> {
        let mut member = self.as_given();
        let stiffness_n = member.stiffness_n.ok_or(PrestressError::Inextensible)?;
        let stretch = member.stretch(stiffness_n, prestress_n)?;
        let given =
            Prestress { force_n: prestress_n, body: member.body, loads: member.loads.clone() };
        member.body = given.body.scaled(|x| x / stretch)?;
        let (length_m, stressed_m) = (member.body.length_m(), given.body.length_m());
        for PointLoad { at_m, .. } in &mut member.loads {
            // The end stays the end; what is past it stays past it, and is refused with the system.
            let is_past = *at_m > stressed_m;
            *at_m /= stretch;
            *at_m = if is_past { *at_m } else { at_m.min(length_m) };
        }
        member.prestress = Some(Box::new(given));
        Ok(member)
    }

    /// The member with the length, places and moments that were given, and no prestress: of one
    /// without a prestress itself.
    #[must_use]
    pub fn as_given(mut self) -> Self {
        if self.prestress.is_some()
            && let Some(given) = self.prestress.take()
        {
            (self.body, self.loads) = (given.body, given.loads);
        }
        self
    }

    /// The body as it was given: at the length under the prestress, or unstretched.
    pub fn given_body(&self) -> &Bar {
        self.prestress.as_ref().map_or(&self.body, |given| &given.body)
    }

    /// The forces on the member, at places on the length that was given.
    pub fn given_loads(&self) -> &[PointLoad] {
        self.prestress.as_ref().map_or(&self.loads, |given| &given.loads)
    }

    /// The axial force that the member bears at the length given, N, where it was given.
    pub fn prestress_n(&self) -> Option<f64> {
        self.prestress.as_ref().map(|given| given.force_n)
    }

    /// `1 + F/EA`: the length under a force over the unstretched one.
    fn stretch(&self, stiffness_n: f64, prestress_n: f64) -> Result<f64, PrestressError> {
        if !(stiffness_n.is_finite() && stiffness_n > 0.0) {
            return Err(PrestressError::Stiffness(stiffness_n));
        }
        if !prestress_n.is_finite() {
            return Err(PrestressError::NotFinite(prestress_n));
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
