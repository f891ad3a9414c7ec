//! Newton's method and boxes next to the paper's equilibria.

use super::*;
use crate::run::Census;
use crate::run::plane::face::Face;
use crate::run::plane::loads::JointLoads;
use crate::settings::Settings;

fn of_cells(check: impl Fn(&System, &[i8], &Cell)) {
    let problem = model::cases::paper();
    let system = System::new(problem.chain(), JointLoads::NONE);
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert_eq!(census.equilibria.len(), 2);
    for found in &census.equilibria {
        let cell = Cell { face: found.alone_in.chart, at: found.alone_in.at };
        check(&system, &found.signs, &cell);
    }
}

/// Where the cell is the zero itself, a step of a rounding stays in it.
#[test]
fn a_point_is_left_by_no_more_than_its_last_place() {
    of_cells(|system, signs, cell| {
        let start = cell.middle();
        let (zero, _) = newton(system, signs, cell, start, cell.half()).unwrap();
        let (again, step) = newton(system, signs, cell, zero, [0.0; 2]).unwrap();
        for k in 0..2 {
            assert!((again[k] - zero[k]).abs() <= 1e-15 && step[k] <= 1e-15, "{again:?} {zero:?}");
        }
        // From further away than one and a half of the cell nothing is found.
        let away = [0, 1].map(|k| 0.6 * (zero[k] - start[k]).abs());
        assert!((0..2).any(|k| away[k] > 1e-12));
        assert!(newton(system, signs, cell, start, away).is_none());
        let near = [0, 1].map(|k| 0.7 * (zero[k] - start[k]).abs().max(1e-9));
        assert!(newton(system, signs, cell, start, near).is_some());
    });
}

#[test]
fn a_zero_is_enclosed_to_its_last_places() {
    of_cells(|system, signs, cell| {
        let Finding::One(Zero { tight, alone_in }) = examine(system, signs, cell) else { panic!() };
        assert!(alone_in.encloses(&tight));
        let narrowed = narrow(system, signs, cell);
        assert!(!narrowed.disjoint(&tight));
        for k in 0..2 {
            assert!(tight.at[k].width() < 1e-13 && narrowed.at[k].width() < 1e-12, "{tight:?}");
        }
        let image = krawczyk_about_zero(system, signs, cell).unwrap();
        assert!(!image.disjoint(&tight));
    });
}

/// The slope over a cell says nothing of a zero beside it, whichever way that lies: the image is that about
/// the middle then.
#[test]
fn a_zero_outside_of_the_cell_is_no_point_of_it() {
    of_cells(|system, signs, cell| {
        let (zero, _) = newton(system, signs, cell, cell.middle(), cell.half()).unwrap();
        for axis in 0..2 {
            let half = 1e-3;
            let at = [0, 1].map(|k| {
                let middle = if k == axis { zero[k] + 1.2 * half } else { zero[k] };
                Interval::new(middle - half, middle + half)
            });
            let beside = Cell { face: cell.face, at };
            let about_middle = krawczyk(system, signs, &beside, beside.middle());
            assert_eq!(krawczyk_about_zero(system, signs, &beside), about_middle, "axis {axis}");
        }
    });
}

#[test]
fn two_cells_have_in_common_what_both_hold() {
    let cell = |at: [[f64; 2]; 2]| Cell {
        face: Face::Near,
        at: at.map(|[low, high]| Interval::new(low, high)),
    };
    let one = cell([[0.0, 2.0], [1.0, 3.0]]);
    assert_eq!(
        common(&one, &cell([[1.0, 4.0], [-1.0, 2.0]])),
        Some(cell([[1.0, 2.0], [1.0, 2.0]]))
    );
    assert_eq!(common(&one, &cell([[2.5, 4.0], [1.0, 2.0]])), None);
    assert_eq!(common(&one, &cell([[1.0, 4.0], [3.5, 5.0]])), None);
}

/// `[2 1; 4 3]` has the determinant 2; `[1 2; 2 4]` none.
#[test]
fn matrices_are_inverted_where_they_can_be() {
    assert_eq!(inverse([[2.0, 1.0], [4.0, 3.0]]), Some([[1.5, -0.5], [-2.0, 1.0]]));
    assert_eq!(inverse([[1.0, 2.0], [2.0, 4.0]]), None);
}
