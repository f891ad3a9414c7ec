//! syevr with a range, as the reference has it: which eigenvalues are found, how many, and what is
//! not written.

/// Declares the tests of one precision.
macro_rules! precision {
    ($module:ident, $T:ty, $tolerance:expr, $syevr:ident) => {
        mod $module {
            use lapack::$syevr;

            helpers!($T, $tolerance);

            const N: usize = 9;

            /// Second differences: eigenvalue k is 2 - 2 cos(k π / (n + 1)), with the vector
            /// sin(i k π / (n + 1)), i from 1.
            fn differences() -> DMatrix<$T> {
                DMatrix::from_fn(N, N, |i, j| match i.abs_diff(j) {
                    0 => 2.0,
                    1 => -1.0,
                    _ => 0.0,
                })
            }

            fn angle(i: usize, k: usize) -> $T {
                let turn = std::f64::consts::PI * (i * k) as f64 / (N + 1) as f64;
                #[expect(clippy::allow_attributes, reason = "a cast in one precision only")]
                #[allow(clippy::cast_possible_truncation, clippy::unnecessary_cast)]
                return turn as $T;
            }

            struct Found {
                info: i32,
                count: i32,
                values: Vec<$T>,
                vectors: Padded,
                support: Vec<i32>,
            }

            fn eigen(range: u8, a: &DMatrix<$T>, between: ($T, $T), numbers: (i32, i32)) -> Found {
                let n = a.nrows();
                let mut pa = Padded::triangle(a, b'L', 1);
                let lda = pa.ld();
                let mut vectors = Padded::new(&DMatrix::from_element(n, n, GUARD), 1);
                let ldz = vectors.ld();
                let (mut values, mut support) = (vec![GUARD; n], vec![-7; 2 * n]);
                let (mut work, mut iwork, mut count, mut info) = ([0.0], [0], -99, -99);
                // SAFETY: the arrays have the sizes that the call states.
                unsafe {
                    $syevr(
                        b'V',
                        range,
                        b'L',
                        int(n),
                        &mut pa.data,
                        lda,
                        between.0,
                        between.1,
                        numbers.0,
                        numbers.1,
                        0.0,
                        &mut count,
                        &mut values,
                        &mut vectors.data,
                        ldz,
                        &mut support,
                        &mut work,
                        1,
                        &mut iwork,
                        1,
                        &mut info,
                    );
                }
                Found { info, count, values, vectors, support }
            }

            /// Eigenvalues `first` to `last`, counted from 1, and nothing else.
            fn assert_found(found: &Found, first: usize, last: usize) {
                let count = last + 1 - first;
                assert_eq!((found.info, found.count), (0, int(count)));
                for (place, k) in (first..=last).enumerate() {
                    let expected = 2.0 - 2.0 * angle(1, k).cos();
                    assert!((found.values[place] - expected).abs() <= TOLERANCE, "{k}");
                    // Unit length: the sines' squares sum to (n + 1) / 2.
                    let scale = (5.0 as $T).sqrt();
                    let sign = found.vectors.get(0, place).signum();
                    for i in 0..N {
                        let expected = sign * angle(i + 1, k).sin() / scale;
                        let x = found.vectors.get(i, place);
                        assert!((x - expected).abs() <= 10.0 * TOLERANCE, "{k} {i}: {x}");
                    }
                }
                assert!(found.values[count..].iter().all(|x| x.is_nan()), "values beyond");
                let beyond = &found.vectors.data[count * found.vectors.leading..];
                assert!(beyond.iter().all(|x| x.is_nan()), "vectors beyond");
                let whole = if count == N { [1, int(N)].repeat(N) } else { vec![-7; 2 * N] };
                assert_eq!(found.support, whole);
            }

            #[test]
            fn numbers() {
                let a = differences();
                for (first, last) in [(1, 1), (1, 4), (3, 7), (9, 9), (1, 9)] {
                    // What the range does not ask for is not looked at.
                    let found = eigen(b'I', &a, (GUARD, GUARD), (int(first), int(last)));
                    assert_found(&found, first, last);
                }
            }

            #[test]
            fn values() {
                let a = differences();
                // Eigenvalue 5 is 2, and 2 to 8 are within 0.2 and 3.7.
                for (between, first, last) in [
                    ((0.2, 3.7), 2, 8),
                    ((1.9, 2.1), 5, 5),
                    ((-1.0, 1.9), 1, 4),
                    ((0.0, 9.0), 1, 9),
                ] {
                    assert_found(&eigen(b'V', &a, between, (0, -5)), first, last);
                }
                let none = eigen(b'V', &a, (2.1, 2.2), (0, 0));
                assert_eq!((none.info, none.count), (0, 0));
                assert!(none.values.iter().chain(&none.vectors.data).all(|x| x.is_nan()));
            }

            /// Of any matrix, what is found is the same as among all of them.
            #[test]
            fn parts_of_the_whole() {
                let mut rng = rng();
                for n in SIZES {
                    let factor = matrix(&mut rng, n, n);
                    let a = &factor + factor.transpose();
                    let all = eigen(b'A', &a, (0.0, 0.0), (0, 0));
                    let (first, count) = (n.div_ceil(3), n.div_ceil(2));
                    let last = first + count - 1;
                    let some = eigen(b'I', &a, (0.0, 0.0), (int(first), int(last)));
                    assert_eq!((all.count, some.count), (int(n), int(count)));
                    for (x, y) in some.values[..count].iter().zip(&all.values[first - 1..last]) {
                        assert!((x - y).abs() <= TOLERANCE * a.amax(), "{x:e} {y:e}");
                    }
                    let expected = all.vectors.matrix().columns(first - 1, count).clone_owned();
                    let found = some.vectors.matrix().columns(0, count).clone_owned();
                    close(&found, &expected, "vectors");
                }
            }

            /// The interval is open below and closed above.
            #[test]
            fn ends_of_the_interval() {
                let diagonal = [3.0, 1.0, 4.0, 2.0];
                let a = DMatrix::from_fn(4, 4, |i, j| if i == j { diagonal[i] } else { 0.0 });
                let found = eigen(b'V', &a, (1.0, 3.0), (0, 0));
                assert_eq!((found.info, found.count), (0, 2));
                assert!((found.values[0] - 2.0).abs() + (found.values[1] - 3.0).abs() <= 0.0);
            }

            #[test]
            fn illegal_ranges() {
                let a = differences();
                for (info, range, between, numbers) in [
                    (-2, b'X', (0.0, 1.0), (1, 1)),
                    (-8, b'V', (1.0, 1.0), (1, 1)),
                    (-8, b'V', (1.0, 0.0), (1, 1)),
                    (-9, b'I', (0.0, 1.0), (0, 1)),
                    (-9, b'I', (0.0, 1.0), (10, 10)),
                    (-10, b'I', (0.0, 1.0), (3, 2)),
                    (-10, b'I', (0.0, 1.0), (1, 10)),
                ] {
                    let found = eigen(range, &a, between, numbers);
                    assert_eq!((found.info, found.count), (info, -99), "{numbers:?}");
                }
            }
        }
    };
}

precision!(double, f64, crate::support::DOUBLE, dsyevr);
precision!(single, f32, crate::support::SINGLE, ssyevr);
