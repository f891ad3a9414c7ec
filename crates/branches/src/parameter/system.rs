use model::Vector;
use model::budget::Budget;
use model::system::{Joint, Member, PointLoad, System};

use crate::parameter::apply::{PointError, UncheckedBar, counts};
use crate::parameter::base::resolved;
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
    let resolved: Vec<Number> = numbers.iter().map(|(number, _)| resolved(base, number)).collect();
    let values: Vec<f64> = numbers.iter().map(|(_, value)| *value).collect();
    answerable(with_numbers(base, &resolved, &values)?)
}

/// A system that has an equilibrium, as far as can be told, and fits into memory.
pub(crate) fn answerable(system: System) -> Result<System, PointError> {
    Budget::default().fits_solve(&system)?;
    system.refusal().map_err(Box::new)?;
    Ok(system)
}

/// The system with numbers that are resolved, whether or not it has an equilibrium.
pub(crate) fn with_numbers(
    base: &System,
    numbers: &[Number],
    values: &[f64],
) -> Result<System, PointError> {
    let Unchecked { gravity_m_s2, floor_m, mut joints, members } =
        Unchecked::new(base, numbers, values);
    let members = members.into_iter().enumerate().map(|(k, member)| member.checked(k + 1));
    let mut members: Vec<Member> = members.collect::<Result<_, _>>()?;
    for (number, value) in numbers.iter().zip(values) {
        if let Number::Joint(name, JointField::Share) = number
            && let Some(joint) = base.joint(name)
        {
            rows::share(&joints, &mut members, joint, *value)?;
        }
    }
    for (row, value) in counts(numbers, values) {
        rows::set(&mut joints, &mut members, row, value)?;
    }
    let mut system = System::new(base.name(), gravity_m_s2, joints, members)?;
    if let Some(floor_m) = floor_m {
        system = system.with_floor(floor_m)?;
    }
    Ok(with_loads(system, base, numbers, values))
}

/// With the loads by name and the cases of the base: other numbers are changed beside them, later too.
fn with_loads(system: System, base: &System, numbers: &[Number], values: &[f64]) -> System {
    let Factors { loads, lengths } = Factors::of(numbers, values);
    let of_joint = |(number, value): (&Number, &f64)| match number {
        Number::Joint(name, field) => Some((base.joint(name)?, *field, *value)),
        _ => None,
    };
    let changed: Vec<_> = numbers.iter().zip(values).filter_map(of_joint).collect();
    let own = |joint: usize, mut mass_kg: f64, mut force_n: Vector| {
        for (_, field, value) in changed.iter().filter(|(of, ..)| *of == joint) {
            match field {
                JointField::Mass => mass_kg = *value,
                JointField::Force(axis) => force_n[*axis] = *value,
                JointField::Place(_) | JointField::Share => {}
            }
        }
        (mass_kg, force_n)
    };
    system.with_loads_of(base, own, [loads, loads / lengths])
}

/// The numbers of a system without shares and counts, not checked: between two points of a path they
/// need not describe one.
pub(crate) struct Unchecked {
    pub(crate) gravity_m_s2: f64,
    floor_m: Option<f64>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) members: Vec<UncheckedMember>,
}

impl Unchecked {
    /// With numbers that are resolved.
    pub(crate) fn new(base: &System, numbers: &[Number], values: &[f64]) -> Self {
        // First, whatever the order: other numbers are what they say.
        let factors = Factors::of(numbers, values);
        let mut new = Self {
            gravity_m_s2: base.gravity_m_s2(),
            floor_m: base.floor_m(),
            joints: base.joints().to_vec(),
            members: base.members().iter().map(UncheckedMember::new).collect(),
        };
        if factors != Factors::NONE {
            for joint in &mut new.joints {
                joint.mass_kg *= factors.loads;
                joint.force_n = joint.force_n.map(|force| force * factors.loads);
            }
            for member in &mut new.members {
                member.scale(factors);
            }
        }
        for (number, value) in numbers.iter().zip(values) {
            match number {
                Number::Gravity => new.gravity_m_s2 = *value,
                Number::Floor => new.floor_m = Some(*value),
                Number::Joint(name, field) => {
                    if let Some(joint) = base.joint(name) {
                        set_joint(
                            base,
                            joint,
                            &mut new.joints[joint],
                            (*field, *value),
                            factors.loads,
                        );
                    }
                }
                Number::Bar(which, field) if *field != BarField::Count => {
                    let named = new.members.iter_mut().enumerate();
                    let acts = matches!(field, BarField::Mass | BarField::Inertia(_));
                    let value = if acts { base.permanent_factor() * value } else { *value };
                    for (_, member) in named.filter(|(k, _)| which.has(k + 1)) {
                        member.set(*field, value);
                    }
                }
                // Factors are set before, counts come last; what is of no row of bars is refused before.
                _ => {}
            }
        }
        new
    }
}

/// Factors of all bars.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Factors {
    loads: f64,
    lengths: f64,
}

impl Factors {
    const NONE: Self = Self { loads: 1.0, lengths: 1.0 };

    fn of(numbers: &[Number], values: &[f64]) -> Self {
        let factor = |of: Number| -> f64 {
            let of = numbers.iter().zip(values).filter(|(number, _)| **number == of);
            of.map(|(_, factor)| *factor).product()
        };
        Self { loads: factor(Number::Loads), lengths: factor(Number::Lengths) }
    }
}

/// Set a number of a joint as its file has it: other loads there, times their factor, are beside it.
fn set_joint(
    base: &System,
    number: usize,
    joint: &mut Joint,
    (field, value): (JointField, f64),
    loads: f64,
) {
    let (factor, own) = (base.permanent_factor(), base.own_load(number));
    let set = |total: &mut f64, own: Option<f64>| {
        *total = own.map_or(factor * value, |own| *total + factor * (value - loads * own));
    };
    match field {
        JointField::Place(axis) => {
            if let Some(at_m) = joint.support.at_m_mut() {
                at_m[axis] = value;
            }
        }
        JointField::Mass => set(&mut joint.mass_kg, own.map(|(mass_kg, _)| mass_kg)),
        JointField::Force(axis) => {
            set(&mut joint.force_n[axis], own.map(|(_, force_n)| force_n[axis]));
        }
        // Of the rows that meet there.
        JointField::Share => {}
    }
}

/// A member whose numbers are not checked yet.
pub(crate) struct UncheckedMember {
    /// As the base has it, or, once a number is set, as a system file gives it: what follows from its
    /// numbers, as an unstretched length, is found when all are set.
    member: Member,
    is_changed: bool,
    /// The length that the file would have, once that is set, m.
    length_m: Option<f64>,
    has_own_mass: bool,
    pub(crate) body: UncheckedBar,
    prestress_n: Option<f64>,
}

impl UncheckedMember {
    fn new(member: &Member) -> Self {
        let body = UncheckedBar::new(member.given_body());
        let prestress_n = member.prestress_n();
        Self {
            member: member.clone(),
            is_changed: false,
            length_m: None,
            has_own_mass: false,
            body,
            prestress_n,
        }
    }

    fn changed(&mut self) -> &mut Member {
        if !self.is_changed {
            self.is_changed = true;
            self.member = self.member.clone().as_given();
        }
        &mut self.member
    }

    fn scale(&mut self, factors: Factors) {
        let member = self.changed();
        let half_m = 0.5 * member.body.length_m();
        let by_length = &mut member.by_length.force_n_per_m;
        *by_length = by_length.map(|x| x * factors.loads);
        for load in &mut member.loads {
            load.force_n = load.force_n.map(|force| force * factors.loads);
            // In the middle it stays there, whatever length is set.
            if load.at_m.to_bits() != half_m.to_bits() {
                load.at_m *= factors.lengths;
            }
        }
        self.body = self.body.stretched(factors.lengths);
        self.body.mass_kg *= factors.loads;
    }

    fn set(&mut self, field: BarField, value: f64) {
        let member = self.changed();
        let growth = member.by_length.growth;
        match field {
            BarField::Length | BarField::Centre => {
                self.body.set(field, growth * value);
                self.length_m = if field == BarField::Length { Some(value) } else { self.length_m };
            }
            BarField::Stiffness => member.stiffness_n = Some(value),
            BarField::Prestress => self.prestress_n = Some(value),
            BarField::LengthTolerance => member.set_length_tolerance(Some(value)),
            _ => {
                self.body.set(field, value);
                self.has_own_mass |= field == BarField::Mass;
            }
        }
    }

    /// The member of this number, from 1.
    fn checked(self, bar: usize) -> Result<Member, PointError> {
        let Self { mut member, is_changed, length_m, has_own_mass, mut body, prestress_n } = self;
        if !is_changed {
            return Ok(member);
        }
        let half_m = 0.5 * member.body.length_m();
        let by_length = member.by_length;
        // What is given a metre follows the length.
        let from_m = member.body.length_m() / by_length.growth;
        let more_m = length_m.map_or(0.0, |length_m| length_m - from_m);
        if by_length.mass && !has_own_mass {
            body.mass_kg *= 1.0 + more_m / from_m;
        }
        let force_n = by_length.force_n_per_m.map(|x| x * more_m);
        if force_n.iter().any(|x| x.abs() > 0.0) {
            member.loads.push(PointLoad { at_m: half_m, force_n, is_spread: true });
        }
        member.body = body.bar().map_err(|error| PointError::Bar { bar, error })?;
        let new_half_m = 0.5 * member.body.length_m();
        for load in &mut member.loads {
            if load.at_m.to_bits() == half_m.to_bits() {
                load.at_m = new_half_m;
            }
        }
        match prestress_n {
            Some(prestress_n) => member
                .with_prestress(prestress_n)
                .map_err(|error| PointError::Prestress { bar, error }),
            None => Ok(member),
        }
    }
}
