//! The laws of the members: potential by length, without their weight.
//!
//! Every law is that of the excess `c` of a member's length over the unstretched one `l`:
//!
//! | | `c(d)` | its gradient `J` | its second derivative |
//! |---|---|---|---|
//! | inextensible | `(d·d - l²) / 2l` | `d / l` | `I / l` |
//! | elastic | `|d| - l` | `u = d / |d|` | `(I - u uᵀ) / |d|` |
//!
//! An elastic member of force `F` is longer by `phi F`, `phi = l / EA`; the Lagrangian of a member
//! is `F c - phi F² / 2`, and `c = phi F` wherever the member resists. A bar always resists, a
//! cable where `F > 0`, a strut where `F < 0`; elsewhere `F = 0`. The force of an inextensible
//! member is the multiplier of its length: the derivative of the least energy by that length, with
//! the sign changed. The floor under a joint is a cable whose excess is the depth, `c = -d_z`,
//! linear in the places.

use model::Vector;
use model::system::Kind;

use crate::network::factor::Block;
use crate::network::frame::Rod;
use crate::vector::{dot, norm, scaled};

/// The excess length of a member and its derivatives at one configuration.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excess {
    /// `c`
    pub(super) value: f64,
    /// `J`
    pub(super) gradient: Vector,
    /// The second derivative is `bend (I - stiff J Jᵀ)`.
    bend: f64,
    /// One for elastic members, zero for inextensible ones.
    stiff: f64,
}

impl Rod {
    /// Whether its length changes with its force.
    pub(super) fn elastic(&self) -> bool {
        self.flexibility > 0.0
    }

    /// The excess length at the difference `d` of the ends.
    pub(super) fn excess(&self, d: Vector) -> Excess {
        if self.ground {
            Excess { value: -d[2], gradient: [0.0, 0.0, -1.0], bend: 0.0, stiff: 0.0 }
        } else if self.elastic() {
            let length = norm(d).max(f64::MIN_POSITIVE);
            Excess {
                value: length - self.length,
                gradient: scaled(1.0 / length, d),
                bend: 1.0 / length,
                stiff: 1.0,
            }
        } else {
            // The difference of the squares as a product: no cancellation near the length.
            let length = norm(d);
            Excess {
                value: 0.5 * (length - self.length) * (length + self.length) / self.length,
                gradient: scaled(1.0 / self.length, d),
                bend: 1.0 / self.length,
                stiff: 0.0,
            }
        }
    }

    /// Whether it resists with a force of this sign.
    pub(super) fn resists(&self, force: f64) -> bool {
        match self.kind {
            Kind::Bar => true,
            Kind::Cable => force > 0.0,
            Kind::Strut => force < 0.0,
        }
    }

    /// The force of an elastic member at an excess; none of an inextensible one, whose length does
    /// not say.
    pub(super) fn prestress(&self, excess: f64) -> f64 {
        if self.elastic() && self.resists(excess) { excess / self.flexibility } else { 0.0 }
    }

    /// What the length says against the law, over the unstretched length: too long, too short, or
    /// not as long as its force makes it.
    pub(super) fn misfit(&self, excess: f64, force: f64) -> f64 {
        let off = excess - self.flexibility * force;
        let misfit = match self.kind {
            Kind::Bar => off,
            Kind::Cable if force > 0.0 => off,
            Kind::Strut if force < 0.0 => off,
            Kind::Cable => off.max(0.0),
            Kind::Strut => off.min(0.0),
        };
        misfit.abs() / self.length
    }
}

impl Excess {
    /// The second derivative of `force c + stiffness c² / 2`, but for the change of the force.
    pub(super) fn block(&self, force: f64, stiffness: f64) -> Block {
        Block {
            isotropic: force * self.bend,
            along: stiffness - force * self.bend * self.stiff,
            direction: self.gradient,
        }
    }

    /// Change of the excess to first order.
    pub(super) fn change(&self, relative: Vector) -> f64 {
        dot(self.gradient, relative)
    }
}

/// A member in the augmented Lagrangian: its force `F` is an estimate, and a spring of stiffness
/// `kappa` stands in series with the member.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Softened {
    /// Force with the spring.
    pub(super) force: f64,
    /// Derivative of the force by the excess.
    pub(super) stiffness: f64,
    /// Potential of both.
    pub(super) potential: f64,
}

impl Rod {
    /// The softened member at an excess, if it resists there.
    pub(super) fn spring(&self, excess: f64, estimate: f64, kappa: f64) -> Softened {
        let trial = estimate + kappa * excess;
        let series = 1.0 + kappa * self.flexibility;
        Softened {
            force: trial / series,
            stiffness: kappa / series,
            potential: 0.5 * (trial * trial / series - estimate * estimate) / kappa,
        }
    }

    /// The softened member at an excess.
    pub(super) fn softened(&self, excess: f64, estimate: f64, kappa: f64) -> Softened {
        if self.resists(estimate + kappa * excess) {
            self.spring(excess, estimate, kappa)
        } else {
            let potential = -0.5 * estimate * estimate / kappa;
            Softened { potential, ..Softened::default() }
        }
    }
}
