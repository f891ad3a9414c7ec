//! The factor multiplied out, signs and counts known beforehand, and pivots of small numbers.

use matrices::sparse::{Entries, Ldlt, Pivots, minimum_degree};
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Joints, the unknowns of each, and which joints are tied.
struct Net(usize, usize, Vec<(usize, usize)>);

/// A matrix, and the signs that its pivots have in every order.
struct Case {
    entries: Entries,
    signs: Vec<f64>,
}

fn random(seed: usize) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed as u64)
}

/// A number between -1 and 1.
fn number(random: &mut ChaCha8Rng) -> f64 {
    random.random_range(-1.0..1.0)
}

fn shuffle<T>(random: &mut ChaCha8Rng, all: &mut [T]) {
    (1..all.len()).rev().for_each(|k| all.swap(k, random.random_range(0..=k)));
}

/// A box of joints, each tied to its neighbours.
fn grid(size: [usize; 3]) -> Net {
    let [x, y, z] = size;
    let steps = [(1, x, 1), (x, y, x), (x * y, z, x * y)];
    let all = x * y * z;
    let ties = steps.iter().flat_map(|(step, count, by)| {
        let inside = (0..all).filter(move |k| k / by % count + 1 < *count);
        inside.map(move |k| (k, k + step))
    });
    Net(all, 3, ties.collect())
}

/// Each joint hangs on one before it, but for a few that hang on none.
fn forest(random: &mut ChaCha8Rng, joints: usize, roots: usize) -> Net {
    let ties = (roots..joints).map(|k| (k, random.random_range(0..k)));
    Net(joints, 3, ties.collect())
}

/// All pairs of a range of joints.
fn clique(joints: std::ops::Range<usize>) -> impl Iterator<Item = (usize, usize)> {
    joints.clone().flat_map(move |a| (joints.start..a).map(move |b| (a, b)))
}

/// Quasidefinite, so that each pivot has the sign of its row in every order (R. J. Vanderbei, SIAM
/// J. Optim. 5 (1995) 100): rows of one sign dominate among themselves, ties of others are free.
/// Rows and columns are scaled.
fn matrix(random: &mut ChaCha8Rng, net: &Net, definite: bool) -> Case {
    let Net(joints, unknowns, ties) = net;
    let size = joints * unknowns;
    let mut sign = || if definite || random.random_bool(0.6) { 1.0 } else { -1.0 };
    let signs: Vec<f64> = (0..size).map(|_| sign()).collect();
    let scales: Vec<f64> = (0..size).map(|_| 10_f64.powf(2.0 * number(random))).collect();
    let mut diagonal: Vec<f64> = (0..size).map(|_| random.random_range(0.1..1.0)).collect();
    let (mut all, triangle) = (Vec::new(), random.random_range(0..3));
    for (a, b) in ties.iter().copied().chain((0..*joints).map(|k| (k, k))) {
        for (i, j) in (0..*unknowns).flat_map(|i| (0..*unknowns).map(move |j| (i, j))) {
            let (i, j) = (a * unknowns + i, b * unknowns + j);
            if a == b && i <= j {
                continue;
            }
            let value = number(random);
            if signs[i] * signs[j] > 0.0 {
                diagonal[i] += value.abs();
                diagonal[j] += value.abs();
            }
            all.push((i.max(j), i.min(j), value));
        }
    }
    all.extend((0..size).map(|k| (k, k, signs[k] * diagonal[k])));
    // Some in two parts, in the one triangle, the other, or both.
    for at in 0..all.len() {
        let (i, j, value) = &mut all[at];
        if random.random_bool(0.1) {
            let part = number(random);
            *value -= part;
            let other = (*i, *j, part);
            all.push(other);
        }
    }
    for (i, j, value) in &mut all {
        *value *= scales[*i] * scales[*j];
        if triangle == 1 || triangle == 2 && random.random_bool(0.5) {
            std::mem::swap(i, j);
        }
    }
    shuffle(random, &mut all);
    Case { entries: Entries::new(size, &all), signs }
}

/// As it is, the other way, at random, of least degree by unknowns and by joints.
fn orders(random: &mut ChaCha8Rng, net: &Net, entries: &Entries) -> Vec<Vec<usize>> {
    let Net(joints, unknowns, ties) = net;
    let size = joints * unknowns;
    let mut any: Vec<usize> = (0..size).collect();
    shuffle(random, &mut any);
    let ties: Vec<_> = ties.iter().map(|(a, b)| (*a, *b, 1.0)).collect();
    let ties = Entries::new(*joints, &ties);
    let by_joints = minimum_degree(&ties.starts, &ties.rows).unwrap();
    let by_joints = by_joints.iter().flat_map(|k| k * unknowns..(k + 1) * unknowns).collect();
    let by_unknowns = minimum_degree(&entries.starts, &entries.rows).unwrap();
    vec![(0..size).collect(), (0..size).rev().collect(), any, by_unknowns, by_joints]
}

/// Entries of the factor on and below the diagonal, by plain elimination of a pattern.
fn true_entries(matrix: &DMatrix<f64>, order: &[usize]) -> usize {
    let size = order.len();
    let mut is = DMatrix::from_fn(size, size, |i, j| matrix[(order[i], order[j])].abs() > 0.0);
    let mut count = size;
    for k in 0..size {
        let rows: Vec<usize> = (k + 1..size).filter(|i| is[(*i, k)]).collect();
        count += rows.len();
        for (i, j) in rows.iter().flat_map(|i| rows.iter().map(move |j| (*i, *j))) {
            is[(i, j)] = true;
        }
    }
    count
}

/// The factor, checked: multiplied out it is off by few rounding errors, and so are its solutions.
fn check(random: &mut ChaCha8Rng, case: &Case, order: &[usize]) -> Ldlt {
    let (Case { entries, signs }, size) = (case, order.len());
    let mut seen = vec![false; size];
    for k in order {
        assert!(!std::mem::replace(&mut seen[*k], true));
    }
    let mut factor = Ldlt::new(&entries.starts, &entries.rows, order).unwrap();
    let definite = signs.iter().all(|sign| *sign > 0.0);
    let pivots = if definite { Pivots::Positive } else { Pivots::Signed };
    assert!(factor.factorise(&entries.values, pivots));
    assert!(order.iter().zip(factor.pivots()).all(|(k, pivot)| pivot * signs[*k] > 0.0));
    // The matrix, its magnitudes, and those of the product.
    let mut matrix = DMatrix::zeros(size, size);
    let mut large = DMatrix::zeros(size, size);
    for (i, j, at) in entries.places() {
        let value = entries.values[at];
        for at in [(i, j), (j, i)].into_iter().take(if i == j { 1 } else { 2 }) {
            matrix[at] += value;
            large[at] += value.abs();
        }
    }
    let mut columns: Vec<Vec<(usize, f64)>> = order.iter().map(|k| vec![(*k, 1.0)]).collect();
    factor.lower(|i, j, value| {
        assert!(i > j);
        columns[j].push((order[i], value));
    });
    assert_eq!(factor.entries(), columns.iter().map(Vec::len).sum::<usize>());
    // Of the zeros that blocks store there are few.
    let (stored, least) = (factor.entries(), true_entries(&matrix, order));
    assert!(stored >= least && 3 * stored <= 4 * least, "{stored} for {least}");
    let mut product = DMatrix::<f64>::zeros(size, size);
    for (column, pivot) in columns.iter().zip(factor.pivots()) {
        for ((i, a), (j, b)) in column.iter().flat_map(|a| column.iter().map(move |b| (a, b))) {
            let term = a * pivot * b;
            product[(*i, *j)] += term;
            large[(*i, *j)] += term.abs();
        }
    }
    let parts = |off: DMatrix<f64>, all: &DMatrix<f64>| -> f64 {
        off.iter().zip(all).map(|(off, all)| off.abs() / all.max(1e-300)).fold(0.0, f64::max)
    };
    let mut off = [parts(product - &matrix, &large), 0.0];
    for sides in [0, 1, 2, 3, 4, 6] {
        let right: Vec<f64> = (0..sides * size).map(|_| number(random)).collect();
        let mut found = right.clone();
        factor.solve(&mut found);
        for (right, found) in right.chunks(size.max(1)).zip(found.chunks(size.max(1))) {
            let mut alone = right.to_vec();
            factor.solve(&mut alone);
            let most = alone.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            assert!(alone.iter().zip(found).all(|(a, b)| (a - b).abs() <= 1e-10 * most));
            let found = DMatrix::from_column_slice(size, 1, found);
            let residual = &matrix * &found - DMatrix::from_column_slice(size, 1, right);
            off[1] = off[1].max(parts(residual, &(&large * found.abs())));
        }
    }
    let off = off.map(|off| off / f64::EPSILON);
    assert!(off[0] <= 8.0 && off[1] <= 12.0, "{off:?}");
    factor
}

#[test]
fn the_factor_multiplied_out_is_the_matrix() {
    let random = &mut random(1);
    let parts = |k: usize| (k + 1, k % 7 * k / 7);
    let mut nets = vec![
        Net(0, 3, vec![]),
        Net(1, 1, vec![]),
        Net(7, 1, vec![]),
        grid([30, 1, 1]),
        grid([4, 7, 1]),
        grid([10, 9, 1]),
        grid([4, 5, 4]),
        forest(random, 50, 1),
        forest(random, 60, 9),
        Net(60, 1, (1..60).map(|k| (0, k)).collect()),
        Net(60, 1, (0..59).map(|k| (59, k)).collect()),
        Net(100, 1, (0..99).map(parts).collect()),
        Net(150, 1, clique(0..150).collect()),
        // Wide blocks with many rows below them.
        Net(70, 3, clique(0..45).chain(clique(36..70)).collect()),
        Net(260, 1, clique(0..110).chain(clique(100..190)).chain(clique(150..260)).collect()),
    ];
    for joints in [2, 5, 17, 40] {
        let mut end = || random.random_range(0..joints);
        let ties = (0..2 * joints).map(|_| (end(), end())).filter(|(a, b)| a != b).collect();
        nets.push(Net(joints, 1 + joints % 3, ties));
    }
    for net in &nets {
        for definite in [true, false] {
            let case = matrix(random, net, definite);
            for order in orders(random, net, &case.entries) {
                check(random, &case, &order);
            }
        }
    }
    let net = grid([25, 24, 1]);
    for definite in [true, false] {
        let case = matrix(random, &net, definite);
        let order = &orders(random, &net, &case.entries)[4];
        check(random, &case, order);
    }
}

#[test]
fn chains_and_trees_are_not_filled_in() {
    let random = &mut random(2);
    for roots in [0, 1, 2, 9] {
        let net = if roots == 0 { grid([40, 1, 1]) } else { forest(random, 90, roots) };
        let case = matrix(random, &net, false);
        for order in &orders(random, &net, &case.entries)[3..] {
            let factor = check(random, &case, order);
            // 6 + 5 + 4 entries a joint, 3 + 2 + 1 of the last of each tree.
            assert_eq!(factor.entries(), 15 * net.0 - 9 * roots.max(1));
        }
    }
}

#[test]
fn negative_pivots_are_as_many_as_negative_squares() {
    let random = &mut random(3);
    for size in [1, 2, 5, 20, 50] {
        let squares: Vec<f64> = (0..size).map(|_| number(random)).collect();
        let forms = DMatrix::from_fn(size, size, |_, _| number(random));
        let sum = forms.tr_mul(&DMatrix::from_diagonal(&squares.clone().into())) * &forms;
        let all: Vec<_> = clique(0..size).chain((0..size).map(|k| (k, k))).collect();
        let all: Vec<_> = all.iter().map(|(i, j)| (*i, *j, sum[(*i, *j)])).collect();
        let entries = Entries::new(size, &all);
        let order: Vec<usize> = (0..size).rev().collect();
        let mut factor = Ldlt::new(&entries.starts, &entries.rows, &order).unwrap();
        assert!(factor.factorise(&entries.values, Pivots::Signed));
        let negative = |all: &[f64]| all.iter().filter(|x| **x < 0.0).count();
        assert_eq!(negative(factor.pivots()), negative(&squares));
        assert_eq!(negative(&matrices::dense::eigenvalues(&sum).unwrap()), negative(&squares));
    }
}

/// Pivots of [[a, b], [b, c]], and whether the factorisation came to its end.
fn pivots([a, b, c]: [f64; 3], pivots: Pivots) -> (bool, [f64; 2]) {
    let mut factor = Ldlt::new(&[0, 2, 3], &[0, 1, 1], &[0, 1]).unwrap();
    // What was there before is forgotten.
    assert!(factor.factorise(&[3.0, 5.0, 11.0], Pivots::Signed));
    (factor.factorise(&[a, b, c], pivots), [factor.pivots()[0], factor.pivots()[1]])
}

#[test]
fn pivots_are_taken_as_asked() {
    let replaced = Pivots::Replaced { least: 0.5, instead: 8.0 };
    let raised = Pivots::Raised { least: 0.5, instead: 8.0 };
    let nan = f64::NAN;
    for (matrix, how, expected) in [
        ([2.0, 2.0, 3.0], Pivots::Positive, [2.0, 1.0]),
        ([2.0, 2.0, 2.0], Pivots::Positive, [2.0, nan]),
        ([2.0, 2.0, 1.0], Pivots::Positive, [2.0, nan]),
        ([0.0, 0.0, 1.0], Pivots::Positive, [nan, nan]),
        ([-2.0, 2.0, 1.0], Pivots::Positive, [nan, nan]),
        ([-2.0, 2.0, 1.0], Pivots::Signed, [-2.0, 3.0]),
        ([2.0, 2.0, 1.0], Pivots::Signed, [2.0, -1.0]),
        ([2.0, 2.0, 2.0], Pivots::Signed, [2.0, nan]),
        ([-0.0, 2.0, 2.0], Pivots::Signed, [nan, nan]),
        ([0.5, 8.0, 9.0], replaced, [8.0, 1.0]),
        ([-0.5, 8.0, -9.0], replaced, [-8.0, -1.0]),
        ([0.0, 8.0, 8.25], replaced, [8.0, 8.0]),
        ([-1.0, 2.0, -4.25], replaced, [-1.0, -8.0]),
        ([0.625, 0.0, -0.625], replaced, [0.625, -0.625]),
        ([0.5, 8.0, 9.0], raised, [8.0, 1.0]),
        ([-9.0, 8.0, 8.5], raised, [8.0, 8.0]),
        ([0.625, 0.0, -0.625], raised, [0.625, 8.0]),
        ([1.0, 2.0, 1.0], raised, [1.0, 8.0]),
    ] {
        let (came, found) = pivots(matrix, how);
        assert_eq!(came, !expected[1].is_nan(), "{matrix:?} {how:?}");
        let same = |k: usize| found[k].total_cmp(&expected[k].copysign(found[k])).is_eq();
        let signs = (0..2).all(|k| found[k].is_nan() || found[k] * expected[k] > 0.0);
        assert!(same(0) && same(1) && signs, "{matrix:?} {how:?}: {found:?}");
    }
    for bad in [nan, f64::INFINITY, f64::NEG_INFINITY] {
        for how in [Pivots::Positive, Pivots::Signed, replaced, raised] {
            for at in 0..3 {
                let mut matrix = [2.0, 1.0, 2.0];
                matrix[at] = bad;
                let (came, found) = pivots(matrix, how);
                assert!(!came && found[1].is_nan(), "{matrix:?} {how:?}: {found:?}");
            }
        }
    }
}

#[test]
fn a_second_factorisation_is_as_the_first() {
    let random = &mut random(4);
    let net = grid([9, 8, 1]);
    let case = matrix(random, &net, false);
    let Entries { starts, rows, values } = &case.entries;
    let order = &orders(random, &net, &case.entries)[3];
    let bits = |factor: &Ldlt| {
        let mut all: Vec<u64> = factor.pivots().iter().map(|x| x.to_bits()).collect();
        factor.lower(|_, _, value| all.push(value.to_bits()));
        all
    };
    let mut once = Ldlt::new(starts, rows, order).unwrap();
    assert!(once.factorise(values, Pivots::Signed));
    let mut again = Ldlt::new(starts, rows, order).unwrap();
    let others: Vec<f64> = values.iter().map(|x| x * number(random)).collect();
    again.factorise(&others, Pivots::Signed);
    again.factorise(&vec![f64::NAN; others.len()], Pivots::Signed);
    again.factorise(&others, Pivots::Positive);
    assert!(bits(&again) != bits(&once));
    assert!(again.factorise(values, Pivots::Signed));
    assert_eq!(bits(&again), bits(&once));
}

/// Places that are given twice, out of order, or not at all on the diagonal: as matrices are put together.
#[test]
fn any_pattern_has_an_order() {
    let patterns: [&[(usize, usize)]; 3] = [
        &[(1, 0), (1, 0), (1, 0), (1, 0), (2, 1), (2, 1), (3, 2), (2, 2)],
        &[(3, 0), (1, 0), (2, 0)],
        &[],
    ];
    for places in patterns {
        let entries: Vec<_> = places.iter().map(|(row, column)| (*row, *column, 1.0)).collect();
        let entries = Entries::new(4, &entries);
        let mut order = minimum_degree(&entries.starts, &entries.rows).unwrap();
        order.sort_unstable();
        assert_eq!(order, [0, 1, 2, 3], "{places:?}");
    }
}
