//! Morse indices and the certificate, both O(n), against eigenvalues of dense matrices.
//!
//! Nothing of a solver is used by the judge here: the second derivative of the Lagrangian in joint
//! coordinates is the stress matrix of the axial forces, once for each of X, Y and Z, the bars are
//! the constraints, and the index is counted on their null space.

use std::f64::consts::PI;

use lagrange::{Seed, Settings, condensed, solve_from};
use model::{Bar, Equilibrium, InPlane, InSpace, NoCertificate, Problem, Vector};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};
use validate::certificate::certify;

/// Bars of the largest chain.
const LARGEST: usize = 12;
/// Seeds for each chain, half of them in the plane of the anchors.
const SEEDS: usize = 12;
/// Eigenvalues below this, in units of the largest force density, are zero: the turn about vertical
/// anchors gives 1e-15, and an equilibrium with one between this and `CLEAR` would be too close to
/// call.
const ZERO: f64 = 1e-11;
const CLEAR: f64 = 1e-8;

fn random_problem(rng: &mut ChaCha8Rng, n: usize, vertical: bool) -> Problem {
    let line = if vertical { Line::Vertical } else { Line::Any };
    General { span: 0.1..0.9, line, ..General::default() }.problem(rng, n)
}

/// Negative and zero eigenvalues of the second derivative on the motions that keep the bars whole,
/// the joints given by `coordinates` numbers each; `None` when an eigenvalue is too close to zero
/// to call.
fn inertia(joints: &[Vec<f64>], density: &[f64], coordinates: usize) -> Option<[usize; 2]> {
    let (n, size) = (density.len(), (density.len() - 1) * coordinates);
    let mut hessian = DMatrix::zeros(size, size);
    let mut rows = DMatrix::zeros(n, size);
    // Joint k of 1..n has the columns from here on; the anchors have none.
    let column = |k: usize| (k >= 1 && k < n).then(|| (k - 1) * coordinates);
    for i in 0..n {
        let ends = [(column(i), -1.0), (column(i + 1), 1.0)];
        for (a, sign_a) in ends {
            let Some(a) = a else { continue };
            for c in 0..coordinates {
                rows[(i, a + c)] = sign_a * (joints[i + 1][c] - joints[i][c]);
            }
            for (b, sign_b) in ends {
                let Some(b) = b else { continue };
                for c in 0..coordinates {
                    hessian[(a + c, b + c)] += density[i] * sign_a * sign_b;
                }
            }
        }
    }
    // The null space of the rows: eigenvectors of rowsᵀ rows with eigenvalue 0.
    let eigen = SymmetricEigen::new(rows.transpose() * &rows);
    let free: Vec<DVector<f64>> = (0..size)
        .filter(|k| eigen.eigenvalues[*k] < ZERO)
        .map(|k| eigen.eigenvectors.column(k).into_owned())
        .collect();
    assert_eq!(free.len(), size.saturating_sub(n), "the bars are on one line");
    if free.is_empty() {
        return Some([0, 0]);
    }
    let free = DMatrix::from_columns(&free);
    let largest = density.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let values = (free.transpose() * hessian * &free).symmetric_eigenvalues();
    let sizes = || values.iter().map(|value| value / largest);
    if sizes().any(|value| (ZERO..CLEAR).contains(&value.abs())) {
        return None;
    }
    Some([sizes().filter(|v| *v < -ZERO).count(), sizes().filter(|v| v.abs() <= ZERO).count()])
}

/// The index in the plane of the equilibrium and in space by dense matrices, and the zero
/// eigenvalues.
fn dense(problem: &Problem, found: &Equilibrium) -> Option<[[usize; 2]; 2]> {
    let bars = problem.chain().bars();
    let density: Vec<f64> =
        found.axial_n.iter().zip(bars).map(|(n, bar)| n / bar.length_m()).collect();
    // The plane: along the largest horizontal extent of any joint, and up.
    let far = found.joints_m.iter().fold([0.0, 0.0], |far: [f64; 2], [x, y, _]| {
        if x.hypot(*y) > far[0].hypot(far[1]) { [*x, *y] } else { far }
    });
    let level = far[0].hypot(far[1]);
    let space: Vec<Vec<f64>> = found.joints_m.iter().map(|joint| joint.to_vec()).collect();
    let plane: Vec<Vec<f64>> = found
        .joints_m
        .iter()
        .map(|[x, y, z]| vec![(x * far[0] + y * far[1]) / level, *z])
        .collect();
    Some([inertia(&plane, &density, 2)?, inertia(&space, &density, 3)?])
}

fn directions(problem: &Problem, found: &Equilibrium) -> energy::Seed {
    let pairs = found.joints_m.windows(2);
    let directions: Vec<Vector> =
        pairs.map(|pair| std::array::from_fn(|k| pair[1][k] - pair[0][k])).collect();
    energy::Seed::directions(problem, &directions).unwrap()
}

/// The full system and the energy, each by its own O(n) means, count the index of equilibria of all
/// kinds as the eigenvalues do, and the condensed equations that of the hanging one; and the
/// certificate proves exactly those that are stable in space.
#[test]
fn indices_are_those_of_dense_matrices() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut by_index = [0; 2 * LARGEST];
    let (mut certified, mut close) = (0, 0);
    for n in 2..=LARGEST {
        for k in 0..2 * SEEDS {
            let vertical = k % 4 == 3;
            let problem = random_problem(&mut rng, n, vertical);
            let mut any = || rng.random_range(-PI..PI);
            let seed = if k % 2 == 0 {
                let span = problem.chain().anchors().difference_m();
                let phi: Vec<f64> = (0..n).map(|_| any()).collect();
                Seed::planar_towards(span[1].atan2(span[0]), &phi)
            } else {
                Seed::spatial((0..n).map(|_| [any(), any(), any()]).collect())
            };
            // Not every seed leads somewhere.
            let Ok(full) = solve_from(&problem, &seed, &Settings::default()) else { continue };
            let full = full.equilibrium;
            let Some([[in_plane, flat], [in_space, turns]]) = dense(&problem, &full) else {
                close += 1;
                continue;
            };
            let what = format!("n = {n}, seed {k}");
            assert_eq!(flat, 0, "{what}");
            assert_eq!(turns, usize::from(vertical), "{what}");

            let second = energy::second_order(&problem, &directions(&problem, &full)).unwrap();
            let hanging = (in_space == 0)
                .then(|| condensed::solve(&problem, &condensed::Settings::default()).unwrap())
                .map(|hanging| ("condensed", hanging.equilibrium.stability));
            for (who, stability) in
                [("full", full.stability), ("energy", second.stability)].into_iter().chain(hanging)
            {
                assert_eq!(stability.index_in_plane, in_plane, "{what}, {who}");
                assert_eq!(stability.index_in_space, in_space, "{what}, {who}");
                let stable = if in_space == 0 { InSpace::Stable } else { InSpace::Unstable };
                assert_eq!(stability.in_space, stable, "{what}, {who}");
                let character = match in_plane {
                    0 => InPlane::Minimum,
                    index if index == n - 2 => InPlane::Maximum,
                    _ => InPlane::Saddle,
                };
                assert_eq!(stability.in_plane, character, "{what}, {who}");
            }
            match certify(&problem, &full) {
                Ok(proof) => {
                    assert_eq!(in_space, 0, "{what}: {proof:?}");
                    certified += 1;
                }
                Err(NoCertificate::SeveralCompressed { .. } | NoCertificate::Indefinite { .. }) => {
                    assert!(in_space > 0, "{what}");
                }
                Err(reason) => panic!("{what}: {reason}"),
            }
            by_index[in_space] += 1;
        }
    }
    println!("by index in space: {by_index:?}, {certified} certified, {close} too close to call");
    // All kinds occur, or nothing was tested.
    assert!(by_index.iter().filter(|count| **count > 0).count() >= 10, "{by_index:?}");
    assert_eq!(certified, by_index[0]);
    assert!(close <= 2, "{close}");
}

/// The hanging chain turned upside down is the maximum: every bar in compression, no direction that
/// does not lower the energy, n - 2 in the plane and n - 1 across it.
#[test]
fn the_highest_equilibrium_of_a_hundred_thousand_bars() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for n in [10, 1000, 100_000] {
        let bars: Vec<Bar> = (0..n)
            .map(|_| {
                let length = rng.random_range(0.5..1.5) / n as f64;
                Bar::homogeneous(length, rng.random_range(0.1..2.0)).unwrap()
            })
            .collect();
        let [problem, mirrored] =
            [0.2, -0.2].map(|rise| samples::of_bars(9.81, bars.clone(), [0.5, 0.3, rise]));
        let settings = condensed::Settings::default();
        let hanging = condensed::solve(&mirrored, &settings).unwrap().equilibrium;
        // Upside down each bar is pressed as hard as it was pulled: the push of the ground is
        // inwards where the pull was outwards, and carries the same weight.
        let mut arch = hanging;
        for joint in &mut arch.joints_m {
            joint[2] = -joint[2];
        }
        let reactions = [&mut arch.reactions_n.start, &mut arch.reactions_n.end];
        for [x, y, _] in arch.multipliers_n.iter_mut().chain(reactions) {
            (*x, *y) = (-*x, -*y);
        }
        for axial in &mut arch.axial_n {
            *axial = -*axial;
        }
        arch.energy_j = -arch.energy_j;
        let second = energy::second_order(&problem, &directions(&problem, &arch)).unwrap();
        assert!(second.residual < 1e-9, "{}", second.residual);
        let stability = second.stability;
        assert_eq!(stability.in_plane, InPlane::Maximum);
        assert_eq!(stability.index_in_plane, n - 2);
        assert_eq!(stability.index_in_space, 2 * n - 3);
        let reason = certify(&problem, &arch).unwrap_err();
        assert_eq!(reason, NoCertificate::SeveralCompressed { bars: n });
    }
}
