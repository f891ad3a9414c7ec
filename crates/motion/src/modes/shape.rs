//! Modes with their shapes, and the names of those of `ω² = 0`.

use model::Vector;

use super::lanczos::{self, combined, divide, length};
use super::planes::Sector;
use super::solved::Solved;
use super::stiffness::Stiffness;
use super::{Mode, What};
use crate::mechanism::Mechanism;
use crate::state::State;
use numerics::vector::{add_times, dot, norm, times};

/// Part of a turn that may lie outside of the modes of `ω² = 0`, relative.
const IS_A_TURN: f64 = 1e-6;

pub(super) fn modes(
    stiffness: &Stiffness<'_>,
    state: &State,
    sector: &Sector,
    solved: &Solved,
) -> Vec<Mode> {
    let mechanism = stiffness.mechanism;
    let mut found = Vec::new();
    for (k, &omega2_s2) in solved.omega2.iter().enumerate().filter(|(k, _)| !solved.zero[*k]) {
        let what = if omega2_s2 > 0.0 { What::Oscillation } else { What::Leaving };
        let of = (omega2_s2, solved.residual[k]);
        found.push(mode(mechanism, sector, of, &solved.shapes[k], what));
    }
    let zeros: Vec<usize> = (0..solved.omega2.len()).filter(|&k| solved.zero[k]).collect();
    // What the zeros came out as, and how far that is to be trusted.
    let rounding = zeros.iter().map(|&k| solved.omega2[k].abs() + solved.residual[k]);
    let of_zero = (0.0, rounding.fold(0.0, f64::max));
    if zeros.is_empty() {
        return found;
    }
    let zero_shapes: Vec<_> = zeros.iter().map(|&k| solved.shapes[k].clone()).collect();
    let mut named: Vec<Vec<f64>> = Vec::new();
    let entries = stiffness.entries(sector);
    for (axis_m, turn) in turns(mechanism, state, sector) {
        // Coefficients in the zero modes, which are orthonormal in the metric of the inertia.
        let inertial = entries.inertia_times(&turn);
        let size = lanczos::dot(&turn, &inertial).sqrt();
        let along = |shape: &Vec<f64>| lanczos::dot(shape, &inertial) / size;
        let mut coefficients: Vec<f64> = zero_shapes.iter().map(along).collect();
        let length = length(&coefficients);
        if (length - 1.0).abs() <= IS_A_TURN {
            divide(&mut coefficients, length);
            named.push(coefficients);
            found.push(mode(mechanism, sector, of_zero, &turn, What::Turn { axis_m }));
        }
    }
    // What is left of the zero modes when the turns are taken out.
    let mut others: Vec<Vec<f64>> = Vec::new();
    for k in 0..zeros.len() {
        let mut unit = vec![0.0; zeros.len()];
        unit[k] = 1.0;
        for b in named.iter().chain(&others).chain(&named) {
            let part = lanczos::dot(&unit, b);
            unit.iter_mut().zip(b).for_each(|(x, b)| *x -= part * b);
        }
        let length = length(&unit);
        if length > 1.0 / (2.0 * zeros.len() as f64).sqrt() {
            divide(&mut unit, length);
            others.push(unit);
        }
    }
    for other in others {
        let shape = combined(&zero_shapes, &other);
        found.push(mode(mechanism, sector, of_zero, &shape, What::Neutral));
    }
    found
}

/// Turns of the parts that turn freely about a vertical, in the coordinates of a sector.
fn turns(mechanism: &Mechanism, state: &State, sector: &Sector) -> Vec<([f64; 2], Vec<f64>)> {
    let reference = mechanism.reference_m;
    let axes = &sector.axes;
    let mut found = Vec::new();
    for part in mechanism.system.parts() {
        let Some(axis_m) = part.axis_m else { continue };
        let mut turn = vec![0.0; mechanism.moving * axes.len()];
        for joint in part.joints {
            let slot = mechanism.slot_of[joint];
            if slot < mechanism.moving {
                let x = state.at[slot][0] + reference[0] - axis_m[0];
                let y = state.at[slot][1] + reference[1] - axis_m[1];
                for (k, axis) in axes.iter().enumerate() {
                    turn[slot * axes.len() + k] = dot(*axis, [-y, x, 0.0]);
                }
            }
        }
        let length_m = mechanism.system.total_length_m();
        if turn.iter().any(|x: &f64| x.abs() > IS_A_TURN * length_m) {
            found.push((axis_m, turn));
        }
    }
    found
}

/// A mode with its shape by joint; the largest displacement is 1, its largest component positive.
fn mode(
    mechanism: &Mechanism,
    sector: &Sector,
    (omega2_s2, residual_s2): (f64, f64),
    y: &[f64],
    what: What,
) -> Mode {
    let axes = &sector.axes;
    let mut by_slot = vec![[0.0; 3]; mechanism.joint_at.len()];
    for (slot, x) in by_slot.iter_mut().enumerate().take(mechanism.moving) {
        for (k, axis) in axes.iter().enumerate() {
            *x = add_times(*x, y[slot * axes.len() + k], *axis);
        }
    }
    let mut shape: Vec<Vector> = mechanism.by_joint(&by_slot);
    let mut largest = [0.0; 3];
    for x in &shape {
        // Of equal ones the first, whatever their rounding.
        if norm(*x) > norm(largest) * (1.0 + 1e-9) {
            largest = *x;
        }
    }
    let lead = largest
        .into_iter()
        .fold(0.0, |a: f64, x| if x.abs() > a.abs() * (1.0 + 1e-9) { x } else { a });
    let scale = lead.signum() / norm(largest);
    for x in &mut shape {
        *x = times(scale, *x);
    }
    Mode { omega2_s2, residual_s2, shape, what, direction: sector.direction }
}

#[cfg(test)]
mod tests {
    use super::super::planes::Direction;
    use super::*;
    use model::Bar;
    use model::system::{Joint, Member, System};

    /// A zero that came out as -3 with one within 1 of it is within 4 of one; of joints that move as far the first
    /// moves forward.
    #[test]
    fn a_zero_is_as_near_as_what_it_came_out_as() {
        let free = |name| Joint::free(name).with_mass(2.0);
        let joints = vec![Joint::anchor("O", [0.0; 3]), free("P"), free("Q")];
        let cord = |to| Member::bar(0, to, Bar::homogeneous(1.0, 0.0).unwrap());
        let system = System::new("cords", 9.81, joints, vec![cord(1), cord(2)]).unwrap();
        let at = [[0.0; 3], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
        let mechanism = super::super::about_equilibrium(&system, &at).unwrap();
        let state = super::super::at_rest(&mechanism, &at).unwrap();
        let mut vectors = vec![[0.0; 3]; mechanism.vectors()];
        state.rows(&mechanism, &mut vectors);
        let stiffness = Stiffness::new(&mechanism, &state, &vectors, vec![0.0; 2]);
        let axes = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let sector = Sector { direction: Direction::Space, axes };
        let solved = Solved {
            omega2: vec![-3.0, 7.0],
            zero: vec![true, false],
            residual: vec![1.0, 0.5],
            shapes: vec![vec![0.0, 0.0, 0.5, 0.0, 0.0, 0.5], vec![0.0, -0.5, 0.0, 0.0, 0.5, 0.0]],
            total: 2,
            negative: 0,
        };
        let found = modes(&stiffness, &state, &sector, &solved);
        let told: Vec<[f64; 2]> = found.iter().map(|m| [m.omega2_s2, m.residual_s2]).collect();
        assert_eq!(told, [[7.0, 0.5], [0.0, 4.0]]);
        assert_eq!(found[0].shape, [[0.0; 3], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]);
    }
}
