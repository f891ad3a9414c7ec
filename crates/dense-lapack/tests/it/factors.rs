//! potrf, potrs and gesv, called as clarabel calls them (through the crate `lapack`): the factors
//! multiply back and solve, in both precisions.

/// Declares the tests of one precision.
macro_rules! precision {
    ($module:ident, $T:ty, $tolerance:expr, $potrf:ident, $potrs:ident, $gesv:ident) => {
        mod $module {
            use lapack::{$gesv, $potrf, $potrs};

            helpers!($T, $tolerance);
            triangle_helpers!($T);

            /// The factor multiplies back to the matrix, is nalgebra's, and solves.
            #[test]
            fn potrf_and_potrs() {
                let mut rng = rng();
                for n in SIZES {
                    for uplo in [b'U', b'L'] {
                        let a = matrix(&mut rng, n, n);
                        let a = &a * a.transpose() + DMatrix::identity(n, n);
                        let mut factor = Padded::triangle(&a, uplo, 1);
                        let lda = factor.ld();
                        let mut info = -99;
                        // SAFETY: the array holds the triangle.
                        unsafe { $potrf(uplo, int(n), &mut factor.data, lda, &mut info) }
                        assert_eq!(info, 0);
                        let lower = a.clone().cholesky().unwrap().l();
                        let expected = if uplo == b'U' { lower.transpose() } else { lower.clone() };
                        close_triangle(&factor, &expected, uplo, "potrf");

                        let x = matrix(&mut rng, n, 3);
                        let mut b = Padded::new(&(&a * &x), 2);
                        let ldb = b.ld();
                        // SAFETY: the arrays hold the factor and the right-hand sides.
                        unsafe {
                            $potrs(uplo, int(n), 3, &factor.data, lda, &mut b.data, ldb, &mut info)
                        }
                        assert_eq!(info, 0);
                        // The residual, not the error: A may be ill-conditioned.
                        close(&(&a * b.matrix()), &(&a * &x), "potrs");
                    }
                }
            }

            /// The order of the first minor that is not positive is what the reference reports.
            #[test]
            fn potrf_refuses_what_is_not_positive_definite() {
                for uplo in [b'U', b'L'] {
                    for (bad, value) in [(0, -1.0), (2, 0.0), (3, <$T>::NAN), (1, <$T>::INFINITY)] {
                        let mut a = DMatrix::<$T>::identity(4, 4);
                        a[(bad, bad)] = value;
                        let mut info = 0;
                        // SAFETY: a 4 × 4 array.
                        unsafe { $potrf(uplo, 4, a.as_mut_slice(), 4, &mut info) }
                        assert_eq!(info, int(bad + 1), "{value}");
                    }
                }
            }

            /// P A = L U from the arrays that come back, and A X = B.
            #[test]
            fn gesv() {
                let mut rng = rng();
                for n in SIZES {
                    let a = matrix(&mut rng, n, n);
                    let x = matrix(&mut rng, n, 2);
                    let (mut lu, mut b) = (Padded::new(&a, 2), Padded::new(&(&a * &x), 1));
                    let (lda, ldb) = (lu.ld(), b.ld());
                    let mut pivots = vec![0; n];
                    let mut info = -99;
                    // SAFETY: the arrays hold the matrix, the pivots and the right-hand sides.
                    unsafe {
                        $gesv(
                            int(n),
                            2,
                            &mut lu.data,
                            lda,
                            &mut pivots,
                            &mut b.data,
                            ldb,
                            &mut info,
                        )
                    }
                    assert_eq!(info, 0);
                    close(&(&a * b.matrix()), &(&a * &x), "gesv");
                    let factors = lu.matrix();
                    let lower = factors.lower_triangle();
                    let lower =
                        DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { lower[(i, j)] });
                    let mut permuted = a.clone();
                    for (i, &pivot) in pivots.iter().enumerate() {
                        permuted.swap_rows(i, usize::try_from(pivot).unwrap() - 1);
                    }
                    close(&(&lower * factors.upper_triangle()), &permuted, "LU");
                    assert!(lower.amax() <= 1.0, "pivoting is partial");
                }
            }

            #[test]
            fn gesv_reports_a_zero_pivot() {
                let mut a: [$T; 4] = [1.0, 2.0, 2.0, 4.0];
                let (mut b, mut pivots, mut info): ([$T; 2], _, _) = ([1.0, 1.0], [0; 2], 0);
                // SAFETY: a 2 × 2 system.
                unsafe { $gesv(2, 1, &mut a, 2, &mut pivots, &mut b, 2, &mut info) }
                assert_eq!(info, 2);
                assert!(b.iter().all(|x| (x - 1.0).abs() <= 0.0), "b was written");
            }

            /// LAPACK's answer to an illegal argument k is -k; nothing else happens.
            #[test]
            fn illegal_arguments() {
                let mut a: [$T; 4] = [1.0, 0.0, 0.0, 1.0];
                let (mut b, mut pivots, mut info): ([$T; 2], _, _) = ([1.0; 2], [0; 2], 0);
                let mut check = |k: i32, call: &mut dyn FnMut(&mut i32)| {
                    call(&mut info);
                    assert_eq!(info, -k);
                };
                // SAFETY: 2 × 2 arrays; the illegal argument is seen before they are used.
                unsafe {
                    check(1, &mut |info| $potrf(b'X', 2, &mut a, 2, info));
                    check(2, &mut |info| $potrf(b'U', -1, &mut a, 2, info));
                    check(4, &mut |info| $potrf(b'U', 2, &mut a, 1, info));
                    check(1, &mut |info| $potrs(b'X', 2, 1, &a, 2, &mut b, 2, info));
                    check(3, &mut |info| $potrs(b'U', 2, -1, &a, 2, &mut b, 2, info));
                    check(7, &mut |info| $potrs(b'U', 2, 1, &a, 2, &mut b, 1, info));
                    check(1, &mut |info| $gesv(-1, 1, &mut a, 2, &mut pivots, &mut b, 2, info));
                    check(4, &mut |info| $gesv(2, 1, &mut a, 0, &mut pivots, &mut b, 2, info));
                }
            }
        }
    };
}

precision!(double, f64, crate::support::DOUBLE, dpotrf, dpotrs, dgesv);
precision!(single, f32, crate::support::SINGLE, spotrf, spotrs, sgesv);
