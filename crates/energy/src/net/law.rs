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
//!
//! A rope over rings and pulleys has the excess `sum |d| - l` over its strands, whatever its law: each
//! strand has its own `J`, and all have the force of the rope.
//!
//! Where lengths overdetermine the shape and are not met, the two laws differ: `linear` members
//! have that of elastic ones without being longer by a force.

use model::Vector;
use model::system::Kind;

use crate::net::factor::Block;
use crate::net::frame::Rod;
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
        } else if self.elastic() || self.linear || self.rope > 0 {
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
            stretch: stiffness,
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

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [Kind; 3] = [Kind::Bar, Kind::Cable, Kind::Strut];

    fn rod(kind: Kind, flexibility: f64) -> Rod {
        Rod {
            from: 0,
            to: 1,
            length: 2.0,
            kind,
            flexibility,
            ground: false,
            within: 0.0,
            linear: false,
            rope: 0,
        }
    }

    #[test]
    fn excesses_have_their_first_and_second_difference_quotients() {
        let h = 1e-4;
        let floor = Rod { ground: true, ..rod(Kind::Cable, 0.0) };
        for rod in [rod(Kind::Bar, 0.0), rod(Kind::Bar, 0.3), floor] {
            let at = [1.2, -0.7, 0.4];
            let moved =
                |k: usize, h: f64| std::array::from_fn(|j| at[j] + if j == k { h } else { 0.0 });
            let here = rod.excess(at);
            for k in 0..3 {
                let unit: Vector = std::array::from_fn(|j| if j == k { 1.0 } else { 0.0 });
                let (a, b) = (rod.excess(moved(k, h)), rod.excess(moved(k, -h)));
                assert!(((a.value - b.value) / (2.0 * h) - here.gradient[k]).abs() < 1e-8);
                assert!((here.change(unit) - here.gradient[k]).abs() < 1e-15);
                for j in 0..3 {
                    let other: Vector = std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 });
                    // Of F c + s c² / 2: F c'' + s c' c'ᵀ.
                    let bend = (a.gradient[j] - b.gradient[j]) / (2.0 * h);
                    let exact = 5.0 * bend + 3.0 * here.gradient[k] * here.gradient[j];
                    assert!((here.block(5.0, 3.0).between(unit, other) - exact).abs() < 1e-7);
                }
            }
        }
        assert!((floor.excess([0.3, 0.4, -0.5]).value - 0.5).abs() < 1e-15);
        for (d, excess) in [([0.0, 3.0, 4.0], 3.0), ([0.0, 0.0, 1.0], -1.0)] {
            assert!((rod(Kind::Bar, 0.1).excess(d).value - excess).abs() < 1e-15);
        }
        // (9 - 4) / 4
        assert!((rod(Kind::Bar, 0.0).excess([3.0, 0.0, 0.0]).value - 1.25).abs() < 1e-15);
    }

    /// A slack member has the force zero, and resists nothing with it.
    #[test]
    fn cables_pull_struts_push_and_neither_resists_nothing() {
        for (force, expected) in
            [(1.0, [true, true, false]), (0.0, [true, false, false]), (-1.0, [true, false, true])]
        {
            assert_eq!(KINDS.map(|kind| rod(kind, 0.0).resists(force)), expected);
        }
        for (excess, expected) in
            [(0.3, [3.0, 3.0, 0.0]), (0.0, [0.0; 3]), (-0.3, [-3.0, 0.0, -3.0])]
        {
            for (kind, force) in KINDS.into_iter().zip(expected) {
                assert!((rod(kind, 0.1).prestress(excess) - force).abs() < 1e-14);
                assert!(rod(kind, 0.0).prestress(excess).abs() <= 0.0);
            }
        }
    }

    #[test]
    fn misfits_are_what_the_law_does_not_allow() {
        // Excess, force and the misfit, over the length 2, of bar, cable and strut; flexibility 0.1.
        for (excess, force, expected) in [
            (0.4, 0.0, [0.2, 0.2, 0.0]),
            (-0.4, 0.0, [0.2, 0.0, 0.2]),
            (0.4, 2.0, [0.1, 0.1, 0.0]),
            (0.1, 2.0, [0.05, 0.05, 0.05]),
            (-0.4, -2.0, [0.1, 0.0, 0.1]),
            (-0.1, -2.0, [0.05, 0.05, 0.05]),
        ] {
            for (kind, misfit) in KINDS.into_iter().zip(expected) {
                let found = rod(kind, 0.1).misfit(excess, force);
                assert!((found - misfit).abs() < 1e-15, "{kind:?} {excess} {force}: {found}");
            }
        }
    }

    /// The augmented Lagrangian of a member, its derivatives, and its jump-free switch.
    #[test]
    fn softened_members_have_their_force_as_derivative_of_the_potential() {
        let (estimate, kappa, h) = (0.8, 5.0, 1e-5);
        for flexibility in [0.0, 0.3] {
            for (kind, excess) in
                [(Kind::Bar, 0.4), (Kind::Cable, 0.4), (Kind::Cable, -0.4), (Kind::Strut, -0.4)]
            {
                let rod = rod(kind, flexibility);
                let at = |c: f64| rod.softened(c, estimate, kappa);
                let (a, b, here) = (at(excess + h), at(excess - h), at(excess));
                assert!(((a.potential - b.potential) / (2.0 * h) - here.force).abs() < 1e-9);
                assert!(((a.force - b.force) / (2.0 * h) - here.stiffness).abs() < 1e-8);
                let works = rod.resists(estimate + kappa * excess);
                assert_eq!(here.force.abs() > 0.0, works);
            }
            let cable = rod(Kind::Cable, flexibility);
            let (a, b) = (-estimate / kappa + 1e-9, -estimate / kappa - 1e-9);
            let (a, b) = (cable.softened(a, estimate, kappa), cable.softened(b, estimate, kappa));
            assert!((a.potential - b.potential).abs() < 1e-15);
            // With the estimate right and the member as long as its force makes it nothing is left.
            let there = cable.spring(flexibility * estimate, estimate, kappa);
            assert!((there.force - estimate).abs() < 1e-15);
        }
    }
}
