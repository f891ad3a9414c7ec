//! syevr, gesdd and gesvd, called as clarabel calls them (through the crate `lapack`): the factors
//! are orthonormal and multiply back, on random, graded and rank-deficient matrices, in both
//! precisions.

/// Declares the tests of one precision.
macro_rules! precision {
    ($module:ident, $T:ty, $tolerance:expr, $syevr:ident, $gesdd:ident, $gesvd:ident) => {
        mod $module {
            use lapack::{$gesdd, $gesvd, $syevr};
            use nalgebra::DVector;

            helpers!($T, $tolerance);

            /// Both calls of clarabel: how much workspace, then the work.
            fn eigen(jobz: u8, uplo: u8, a: &DMatrix<$T>) -> (DVector<$T>, Padded) {
                let n = a.nrows();
                let mut pa = Padded::triangle(a, uplo, 1);
                let lda = pa.ld();
                let mut z = Padded::new(&DMatrix::from_element(n, n, GUARD), 1);
                let ldz = z.ld();
                let (mut w, mut support) = (vec![GUARD; n], vec![0; 2 * n]);
                let (mut work, mut iwork) = (vec![0.0; 1], vec![0; 1]);
                let (mut found, mut info) = (0, -99);
                for (lwork, liwork) in [(-1, -1), (1, 1)] {
                    // SAFETY: the arrays have the sizes that the call states.
                    unsafe {
                        $syevr(
                            jobz,
                            b'A',
                            uplo,
                            int(n),
                            &mut pa.data,
                            lda,
                            0.0,
                            0.0,
                            0,
                            0,
                            -1.0,
                            &mut found,
                            &mut w,
                            &mut z.data,
                            ldz,
                            &mut support,
                            &mut work,
                            lwork,
                            &mut iwork,
                            liwork,
                            &mut info,
                        );
                    }
                    assert_eq!(info, 0);
                    assert!(work[0] >= 1.0 && iwork[0] >= 1);
                }
                assert_eq!(found, int(n));
                (DVector::from_vec(w), z)
            }

            #[test]
            fn syevr() {
                let mut rng = rng();
                for n in SIZES {
                    for uplo in [b'U', b'L'] {
                        for rank in [n, 1] {
                            let factor = matrix(&mut rng, n, rank);
                            let signs = DMatrix::from_fn(rank, rank, |i, j| {
                                if i != j {
                                    0.0
                                } else if i % 3 == 0 {
                                    -1.0
                                } else {
                                    1.0
                                }
                            });
                            let a = &factor * signs * factor.transpose();
                            let (values, vectors) = eigen(b'V', uplo, &a);
                            let vectors = vectors.matrix();
                            assert!(values.as_slice().is_sorted(), "ascending");
                            close(
                                &(vectors.transpose() * &vectors),
                                &DMatrix::identity(n, n),
                                "orthonormal",
                            );
                            close(
                                &(&vectors * DMatrix::from_diagonal(&values) * vectors.transpose()),
                                &a,
                                "A = Z W Z'",
                            );
                            let (alone, untouched) = eigen(b'N', uplo, &a);
                            assert!((alone - &values).amax() <= TOLERANCE * a.amax());
                            assert!(untouched.data.iter().all(|x| x.is_nan()));
                            let mut expected: Vec<$T> =
                                a.symmetric_eigenvalues().iter().copied().collect();
                            expected.sort_by(<$T>::total_cmp);
                            assert!(
                                (values - DVector::from_vec(expected)).amax()
                                    <= TOLERANCE * a.amax().max(1.0)
                            );
                        }
                    }
                }
            }

            /// Both routines of clarabel, with the workspace asked for first.
            fn singular(divide: bool, job: u8, a: &DMatrix<$T>) -> (DVector<$T>, Padded, Padded) {
                let (m, n) = a.shape();
                let k = m.min(n);
                let mut pa = Padded::new(a, 1);
                let lda = pa.ld();
                let mut u = Padded::new(&DMatrix::from_element(m, k, GUARD), 2);
                let mut vt = Padded::new(&DMatrix::from_element(k, n, GUARD), 1);
                let (ldu, ldvt) = (u.ld(), vt.ld());
                let mut s = vec![GUARD; k];
                let (mut work, mut iwork, mut info) = (vec![0.0; 1], vec![0; 8 * k], -99);
                for lwork in [-1, 1] {
                    // SAFETY: the arrays have the sizes that the call states.
                    unsafe {
                        if divide {
                            $gesdd(
                                job,
                                int(m),
                                int(n),
                                &mut pa.data,
                                lda,
                                &mut s,
                                &mut u.data,
                                ldu,
                                &mut vt.data,
                                ldvt,
                                &mut work,
                                lwork,
                                &mut iwork,
                                &mut info,
                            );
                        } else {
                            $gesvd(
                                job,
                                job,
                                int(m),
                                int(n),
                                &mut pa.data,
                                lda,
                                &mut s,
                                &mut u.data,
                                ldu,
                                &mut vt.data,
                                ldvt,
                                &mut work,
                                lwork,
                                &mut info,
                            );
                        }
                    }
                    assert_eq!(info, 0);
                    assert!(work[0] >= 1.0);
                }
                (DVector::from_vec(s), u, vt)
            }

            fn check_singular(a: &DMatrix<$T>) {
                let k = a.nrows().min(a.ncols());
                let scale = a.amax().max(<$T>::MIN_POSITIVE);
                for divide in [true, false] {
                    let (s, u, vt) = singular(divide, b'S', a);
                    let (u, vt) = (u.matrix(), vt.matrix());
                    assert!(
                        s.iter().rev().is_sorted() && s[k - 1] >= 0.0,
                        "descending, not negative"
                    );
                    close(&(u.transpose() * &u), &DMatrix::identity(k, k), "U orthonormal");
                    close(&(&vt * vt.transpose()), &DMatrix::identity(k, k), "V orthonormal");
                    let back = &u * DMatrix::from_diagonal(&s) * &vt;
                    // With orthonormal factors this bounds the error of every singular value
                    // (Weyl).
                    close(&(back / scale), &(a / scale), "A = U S V'");
                    let (alone, u, vt) = singular(divide, b'N', a);
                    assert!((alone - s).amax() <= TOLERANCE * scale);
                    assert!(u.data.iter().chain(&vt.data).all(|x| x.is_nan()));
                }
            }

            #[test]
            fn gesdd_and_gesvd() {
                let mut rng = rng();
                for m in SIZES {
                    for n in SIZES {
                        check_singular(&matrix(&mut rng, m, n));
                    }
                }
            }

            /// What the last iterations of an interior point method hand over: products of Cholesky
            /// factors whose columns differ by many orders of magnitude, nearly of rank one.
            #[test]
            fn singular_values_of_graded_matrices() {
                let mut rng = rng();
                for round in 0..crate::support::ROUNDS {
                    let n = 2 + round % 30;
                    let grade = |m: DMatrix<$T>, towards_end: bool| {
                        let m = m.lower_triangle();
                        DMatrix::from_fn(n, n, |i, j| {
                            let k = if towards_end { j } else { n - 1 - j };
                            m[(i, j)] * <$T>::powi(0.5, i32::try_from(k).unwrap())
                        })
                    };
                    let a = grade(matrix(&mut rng, n, n), true);
                    let b = grade(matrix(&mut rng, n, n), round % 2 == 0);
                    check_singular(&(b.transpose() * a));
                }
            }

            /// Fewer independent columns than columns: the factors are orthonormal all the same.
            #[test]
            fn singular_values_of_rank_deficient_matrices() {
                let mut rng = rng();
                check_singular(&DMatrix::zeros(5, 3));
                for rank in 1..6 {
                    check_singular(&(matrix(&mut rng, 9, rank) * matrix(&mut rng, rank, 6)));
                    let mut copies = matrix(&mut rng, 8, 8);
                    copies.set_column(3, &copies.column(0).clone_owned());
                    copies.fill_column(5, 0.0);
                    check_singular(&copies);
                }
            }

            /// A diagonal times an orthogonal matrix has the diagonal for singular values, down to
            /// the smallest, to relative accuracy.
            #[test]
            fn small_singular_values_are_accurate() {
                let mut rng = rng();
                let n = 12;
                let orthogonal = matrix(&mut rng, n, n).qr().q();
                let expected =
                    DVector::from_fn(n, |i, _| <$T>::powi(0.25, i32::try_from(i).unwrap()));
                let a = orthogonal * DMatrix::from_diagonal(&expected);
                let (s, _, _) = singular(true, b'N', &a);
                for (s, expected) in s.iter().zip(&expected) {
                    assert!((s / expected - 1.0).abs() <= TOLERANCE, "{s:e} {expected:e}");
                }
            }

            /// Many orders of magnitude on the diagonal, as in the step length of an interior point
            /// method near its end.
            #[test]
            fn eigenvalues_of_graded_matrices() {
                let mut rng = rng();
                for round in 0..crate::support::ROUNDS {
                    let n = 2 + round % 30;
                    let m = matrix(&mut rng, n, n);
                    let size = |i: usize| <$T>::powi(0.5, i32::try_from(i).unwrap());
                    let a =
                        DMatrix::from_fn(n, n, |i, j| (m[(i, j)] + m[(j, i)]) * size(i) * size(j));
                    let (values, vectors) = eigen(b'V', b'U', &a);
                    let vectors = vectors.matrix();
                    close(
                        &(vectors.transpose() * &vectors),
                        &DMatrix::identity(n, n),
                        "orthonormal",
                    );
                    let back = &vectors * DMatrix::from_diagonal(&values) * vectors.transpose();
                    close(&(back / a.amax()), &(&a / a.amax()), "A = Z W Z'");
                }
            }

            #[test]
            fn what_is_not_finite_does_not_converge() {
                for bad in [<$T>::NAN, <$T>::INFINITY] {
                    let mut a = DMatrix::<$T>::identity(4, 4);
                    a[(1, 2)] = bad;
                    let (mut s, mut u, mut vt): ([$T; 4], [$T; 16], [$T; 16]) =
                        ([0.0; 4], [0.0; 16], [0.0; 16]);
                    let (mut work, mut iwork, mut info): ([$T; 1], _, _) = ([0.0], [0; 32], 0);
                    // SAFETY: 4 × 4 arrays.
                    unsafe {
                        $gesdd(
                            b'S',
                            4,
                            4,
                            a.as_mut_slice(),
                            4,
                            &mut s,
                            &mut u,
                            4,
                            &mut vt,
                            4,
                            &mut work,
                            1,
                            &mut iwork,
                            &mut info,
                        )
                    }
                    assert!(info > 0);
                    info = 0;
                    // SAFETY: 4 × 4 arrays.
                    unsafe {
                        $gesvd(
                            b'S',
                            b'S',
                            4,
                            4,
                            a.as_mut_slice(),
                            4,
                            &mut s,
                            &mut u,
                            4,
                            &mut vt,
                            4,
                            &mut work,
                            1,
                            &mut info,
                        )
                    }
                    assert!(info > 0);
                    info = 0;
                    let (mut found, mut support) = (0, [0; 8]);
                    // SAFETY: 4 × 4 arrays.
                    unsafe {
                        $syevr(
                            b'V',
                            b'A',
                            b'U',
                            4,
                            a.as_mut_slice(),
                            4,
                            0.0,
                            0.0,
                            0,
                            0,
                            -1.0,
                            &mut found,
                            &mut s,
                            &mut u,
                            4,
                            &mut support,
                            &mut work,
                            1,
                            &mut iwork,
                            1,
                            &mut info,
                        );
                    }
                    assert!(info > 0);
                }
            }

            /// LAPACK's answer to an illegal argument k is -k; nothing else happens.
            #[test]
            fn illegal_arguments() {
                let mut a: [$T; 4] = [1.0, 0.0, 0.0, 1.0];
                let (mut u, mut vt): ([$T; 4], [$T; 4]) = ([0.0; 4], [0.0; 4]);
                let (mut iwork, mut work, mut s): (_, [$T; 1], [$T; 2]) =
                    ([0; 16], [0.0], [0.0; 2]);
                let (mut info, mut found) = (0, 0);
                let mut check = |k: i32, call: &mut dyn FnMut(&mut i32)| {
                    call(&mut info);
                    assert_eq!(info, -k);
                };
                // SAFETY: 2 × 2 arrays; the illegal argument is seen before they are used.
                unsafe {
                    check(1, &mut |info| {
                        $gesdd(
                            b'O', 2, 2, &mut a, 2, &mut s, &mut u, 2, &mut vt, 2, &mut work, 1,
                            &mut iwork, info,
                        )
                    });
                    check(10, &mut |info| {
                        $gesdd(
                            b'S', 2, 2, &mut a, 2, &mut s, &mut u, 2, &mut vt, 1, &mut work, 1,
                            &mut iwork, info,
                        )
                    });
                    check(2, &mut |info| {
                        $gesvd(
                            b'S', b'A', 2, 2, &mut a, 2, &mut s, &mut u, 2, &mut vt, 2, &mut work,
                            1, info,
                        )
                    });
                    check(9, &mut |info| {
                        $gesvd(
                            b'S', b'S', 2, 2, &mut a, 2, &mut s, &mut u, 1, &mut vt, 2, &mut work,
                            1, info,
                        )
                    });
                    let mut support = [0; 4];
                    check(2, &mut |info| {
                        $syevr(
                            b'N',
                            b'X',
                            b'U',
                            2,
                            &mut a,
                            2,
                            0.0,
                            0.0,
                            1,
                            1,
                            -1.0,
                            &mut found,
                            &mut s,
                            &mut u,
                            2,
                            &mut support,
                            &mut work,
                            1,
                            &mut iwork,
                            1,
                            info,
                        );
                    });
                    check(15, &mut |info| {
                        $syevr(
                            b'V',
                            b'A',
                            b'U',
                            2,
                            &mut a,
                            2,
                            0.0,
                            0.0,
                            1,
                            1,
                            -1.0,
                            &mut found,
                            &mut s,
                            &mut u,
                            1,
                            &mut support,
                            &mut work,
                            1,
                            &mut iwork,
                            1,
                            info,
                        );
                    });
                }
            }
        }
    };
}

precision!(double, f64, crate::support::DOUBLE, dsyevr, dgesdd, dgesvd);
precision!(single, f32, crate::support::SINGLE, ssyevr, sgesdd, sgesvd);
