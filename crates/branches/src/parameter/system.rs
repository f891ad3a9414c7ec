//! From numbers to systems.

use model::Vector;
use model::budget::Budget;
use model::system::{Joint, Member, Support, System};

use crate::parameter::apply::{PointError, UncheckedBar, counts};
use crate::parameter::base::Base;
use crate::parameter::number::{BarField, JointField, Number};
use crate::parameter::rows;

/// The system with these numbers in place of its own, validated.
///
/// A force in the middle of a bar stays in the middle, others stay where they are. Shares and then
/// counts of rows change last: the numbers of bars are those of the base.
///
/// # Errors
///
/// [`PointError`] when a number is out of range or the system has no equilibrium.
pub fn apply(base: &System, numbers: &[(Number, f64)]) -> Result<System, PointError> {
    let system = with_numbers(base, numbers)?;
    Budget::default().fits_solve(&system)?;
    system.refusal().map_err(Box::new)?;
    Ok(system)
}

/// The same whether or not it has an equilibrium.
pub(crate) fn with_numbers(base: &System, numbers: &[(Number, f64)]) -> Result<System, PointError> {
    let (mut joints, mut members) = (base.joints().to_vec(), base.members().to_vec());
    let (mut gravity_m_s2, mut floor_m) = (base.gravity_m_s2(), base.floor_m());
    let (mut of_members, mut shares) = (Vec::new(), Vec::new());
    // First, whatever the order: other numbers are what they say.
    let factor = |of: Number| -> f64 {
        numbers.iter().filter(|(number, _)| *number == of).map(|(_, factor)| *factor).product()
    };
    let factors = Factors { loads: factor(Number::Loads), lengths: factor(Number::Lengths) };
    for joint in &mut joints {
        joint.mass_kg *= factors.loads;
        joint.force_n = joint.force_n.map(|force| force * factors.loads);
    }
    for (number, value) in numbers {
        match base.resolved(number) {
            Number::Gravity => gravity_m_s2 = *value,
            Number::Floor => floor_m = Some(*value),
            Number::Joint(name, JointField::Share) => shares.push((name, *value)),
            Number::Joint(name, field) => {
                if let Some(joint) = base.joint(&name) {
                    set_joint(&mut joints[joint], field, *value);
                }
            }
            // Factors are set before, counts come last; what is of no row of bars is refused before.
            Number::Loads
            | Number::Lengths
            | Number::Bar(_, BarField::Count)
            | Number::Anchor(..)
            | Number::Row(..) => {}
            Number::Bar(which, field) => {
                of_members.push((which, field, *value));
            }
        }
    }
    for (k, member) in members.iter_mut().enumerate() {
        let mut numbers = of_members.iter().filter(|(which, ..)| which.has(k + 1)).peekable();
        if numbers.peek().is_some() || factors != Factors::NONE {
            let numbers = numbers.map(|(_, field, value)| (*field, *value));
            *member = with(member.clone(), k + 1, factors, numbers)?;
        }
    }
    for (name, value) in shares {
        if let Some(joint) = base.joint(&name) {
            rows::share(&joints, &mut members, joint, value)?;
        }
    }
    for (row, value) in counts(base, numbers) {
        rows::set(&mut joints, &mut members, row, value)?;
    }
    let mut system = System::new(base.name(), gravity_m_s2, joints, members)?;
    if let Some(floor_m) = floor_m {
        system = system.with_floor(floor_m)?;
    }
    Ok(system)
}

/// Factors of all bars.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Factors {
    loads: f64,
    lengths: f64,
}

impl Factors {
    const NONE: Self = Self { loads: 1.0, lengths: 1.0 };
}

fn set_joint(joint: &mut Joint, field: JointField, value: f64) {
    match field {
        JointField::Place(axis) => {
            if let Some(at_m) = place(&mut joint.support) {
                at_m[axis] = value;
            }
        }
        JointField::Mass => joint.mass_kg = value,
        JointField::Force(axis) => joint.force_n[axis] = value,
        // Of the rows that meet there.
        JointField::Share => {}
    }
}

fn place(support: &mut Support) -> Option<&mut Vector> {
    match support {
        Support::Free => None,
        Support::Fixed { at_m } | Support::Line { at_m, .. } | Support::Plane { at_m, .. } => {
            Some(at_m)
        }
    }
}

/// A member with its loads and its length times factors and other numbers, all as a system file gives them: what follows from them, as an
/// unstretched length, is found when all are set.
fn with(
    member: Member,
    bar: usize,
    factors: Factors,
    numbers: impl Iterator<Item = (BarField, f64)>,
) -> Result<Member, PointError> {
    let mut prestress_n = member.prestress_n();
    let mut member = member.as_given();
    let half_m = 0.5 * member.body.length_m();
    let mut body = UncheckedBar::new(&member.body);
    body.set(BarField::Mass, factors.loads * body.mass_kg);
    if factors.lengths.to_bits() != 1.0_f64.to_bits() {
        body.set(BarField::Length, 2.0 * half_m * factors.lengths);
    }
    for load in &mut member.loads {
        load.force_n = load.force_n.map(|force| force * factors.loads);
    }
    for (field, value) in numbers {
        match field {
            BarField::Stiffness => member.stiffness_n = Some(value),
            BarField::Prestress => prestress_n = Some(value),
            BarField::LengthTolerance => member.set_length_tolerance(Some(value)),
            _ => body.set(field, value),
        }
    }
    member.body = body.bar().map_err(|error| PointError::Bar { bar, error })?;
    let new_half_m = 0.5 * member.body.length_m();
    for load in &mut member.loads {
        if load.at_m.to_bits() == half_m.to_bits() {
            load.at_m = new_half_m;
        }
    }
    match prestress_n {
        Some(prestress_n) => {
            member.with_prestress(prestress_n).map_err(|error| PointError::Prestress { bar, error })
        }
        None => Ok(member),
    }
}
