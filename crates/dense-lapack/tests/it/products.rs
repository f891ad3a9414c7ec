//! gemm, gemv, symv, syrk and syr2k, called as clarabel calls them (through the crate `blas`),
//! against products of nalgebra on random matrices, in both precisions.

/// Declares the tests of one precision.
macro_rules! precision {
    ($module:ident, $T:ty, $tolerance:expr, $gemm:ident, $gemv:ident, $symv:ident, $syrk:ident, $syr2k:ident) => {
        mod $module {
            use blas::{$gemm, $gemv, $symv, $syr2k, $syrk};
            use nalgebra::DVector;

            helpers!($T, $tolerance);
            triangle_helpers!($T);

            fn op(m: &DMatrix<$T>, trans: u8) -> DMatrix<$T> {
                if trans == b'N' { m.clone() } else { m.transpose() }
            }

            #[test]
            fn gemm() {
                let mut rng = rng();
                for (m, n, k) in crate::support::PRODUCTS {
                    for (ta, tb) in [(b'N', b'N'), (b'T', b'N'), (b'N', b'T'), (b't', b'C')] {
                        let a = matrix(
                            &mut rng,
                            if ta == b'N' { m } else { k },
                            if ta == b'N' { k } else { m },
                        );
                        let b = matrix(
                            &mut rng,
                            if tb == b'N' { k } else { n },
                            if tb == b'N' { n } else { k },
                        );
                        let c = matrix(&mut rng, m, n);
                        let (alpha, beta) = (0.7, -1.3);
                        let expected = op(&a, ta) * op(&b, tb) * alpha + &c * beta;
                        let (pa, pb, mut pc) =
                            (Padded::new(&a, 2), Padded::new(&b, 0), Padded::new(&c, 1));
                        let (lda, ldb, ldc) = (pa.ld(), pb.ld(), pc.ld());
                        // SAFETY: the arrays hold the matrices of these sizes.
                        unsafe {
                            $gemm(
                                ta,
                                tb,
                                int(m),
                                int(n),
                                int(k),
                                alpha,
                                &pa.data,
                                lda,
                                &pb.data,
                                ldb,
                                beta,
                                &mut pc.data,
                                ldc,
                            );
                        }
                        close(&pc.matrix(), &expected, "gemm");
                    }
                }
            }

            /// With α = 0 the factors are not looked at: they may hold no numbers.
            #[test]
            fn alpha_zero_does_not_look() {
                let mut rng = rng();
                let (n, beta) = (5, -0.75);
                let start = matrix(&mut rng, n, n);
                let unset = vec![GUARD; n * n];
                let (size, expected) = (int(n), &start * beta);
                for trans in [b'N', b'T'] {
                    let mut c = Padded::new(&start, 0);
                    // SAFETY: square arrays of size n.
                    unsafe {
                        $gemm(
                            trans,
                            trans,
                            size,
                            size,
                            size,
                            0.0,
                            &unset,
                            size,
                            &unset,
                            size,
                            beta,
                            &mut c.data,
                            size,
                        );
                    }
                    close(&c.matrix(), &expected, "gemm");
                    for (what, two) in [("syrk", false), ("syr2k", true)] {
                        let mut c = Padded::triangle(&start, b'L', 0);
                        // SAFETY: square arrays of size n.
                        unsafe {
                            if two {
                                $syr2k(
                                    b'L',
                                    trans,
                                    size,
                                    size,
                                    0.0,
                                    &unset,
                                    size,
                                    &unset,
                                    size,
                                    beta,
                                    &mut c.data,
                                    size,
                                );
                            } else {
                                $syrk(
                                    b'L',
                                    trans,
                                    size,
                                    size,
                                    0.0,
                                    &unset,
                                    size,
                                    beta,
                                    &mut c.data,
                                    size,
                                );
                            }
                        }
                        close_triangle(&c, &expected, b'L', what);
                    }
                    for symmetric in [false, true] {
                        let mut y = start.column(0).clone_owned();
                        let y = y.as_mut_slice();
                        // SAFETY: a square array and vectors of size n.
                        unsafe {
                            if symmetric {
                                $symv(b'U', size, 0.0, &unset, size, &unset[..n], 1, beta, y, 1);
                            } else {
                                $gemv(
                                    trans,
                                    size,
                                    size,
                                    0.0,
                                    &unset,
                                    size,
                                    &unset[..n],
                                    1,
                                    beta,
                                    y,
                                    1,
                                );
                            }
                        }
                        let error = (DVector::from_column_slice(y) - expected.column(0)).amax();
                        assert!(error <= TOLERANCE, "{error:e}");
                    }
                }
            }

            /// With β = 0 an output that holds no numbers is overwritten.
            #[test]
            fn beta_zero_does_not_look() {
                let mut rng = rng();
                let n = 8;
                let (a, b) = (matrix(&mut rng, n, n), matrix(&mut rng, n, n));
                let x = matrix(&mut rng, n, 1);
                let unset = DMatrix::from_element(n, n, GUARD);
                let mut c = Padded::new(&unset, 0);
                // SAFETY: square arrays of size n.
                unsafe {
                    $gemm(
                        b'N',
                        b'N',
                        int(n),
                        int(n),
                        int(n),
                        1.0,
                        a.as_slice(),
                        int(n),
                        b.as_slice(),
                        int(n),
                        0.0,
                        &mut c.data,
                        int(n),
                    );
                }
                close(&c.matrix(), &(&a * &b), "gemm");
                let mut c = Padded::new(&unset, 0);
                // SAFETY: square arrays of size n.
                unsafe {
                    $syrk(
                        b'U',
                        b'N',
                        int(n),
                        int(n),
                        1.0,
                        a.as_slice(),
                        int(n),
                        0.0,
                        &mut c.data,
                        int(n),
                    );
                }
                close_triangle(&c, &(&a * a.transpose()), b'U', "syrk");
                let mut c = Padded::new(&unset, 0);
                // SAFETY: square arrays of size n.
                unsafe {
                    $syr2k(
                        b'U',
                        b'N',
                        int(n),
                        int(n),
                        1.0,
                        a.as_slice(),
                        int(n),
                        b.as_slice(),
                        int(n),
                        0.0,
                        &mut c.data,
                        int(n),
                    );
                }
                close_triangle(&c, &(&a * b.transpose() + &b * a.transpose()), b'U', "syr2k");
                let mut y = vec![GUARD; n];
                // SAFETY: a square array and vectors of size n.
                unsafe {
                    $gemv(
                        b'N',
                        int(n),
                        int(n),
                        1.0,
                        a.as_slice(),
                        int(n),
                        x.as_slice(),
                        1,
                        0.0,
                        &mut y,
                        1,
                    )
                }
                close(&DMatrix::from_vec(n, 1, y), &(&a * &x), "gemv");
                let mut y = vec![GUARD; n];
                // SAFETY: a square array and vectors of size n.
                unsafe {
                    $symv(b'U', int(n), 1.0, a.as_slice(), int(n), x.as_slice(), 1, 0.0, &mut y, 1)
                }
                let symmetric = DMatrix::from_fn(n, n, |i, j| a[(i.min(j), i.max(j))]);
                close(&DMatrix::from_vec(n, 1, y), &(symmetric * &x), "symv");
            }

            /// Nothing to multiply: C is only scaled.
            #[test]
            fn empty_inner_size() {
                let mut c: Vec<$T> = vec![1.0, 2.0, 3.0, 4.0];
                // SAFETY: no element of a and b is needed.
                unsafe { $gemm(b'N', b'N', 2, 2, 0, 1.0, &[], 2, &[], 1, 0.5, &mut c, 2) }
                close(
                    &DMatrix::from_column_slice(4, 1, &c),
                    &DMatrix::from_column_slice(4, 1, &[0.5, 1.0, 1.5, 2.0]),
                    "gemm",
                );
            }

            /// A vector in an array, `step` apart, backwards when the step is negative.
            fn strided(x: &DVector<$T>, step: i32) -> Vec<$T> {
                let gap = step.unsigned_abs() as usize;
                let mut data = vec![GUARD; (x.len() - 1) * gap + 1];
                for (i, value) in x.iter().enumerate() {
                    data[if step > 0 { i } else { x.len() - 1 - i } * gap] = *value;
                }
                data
            }

            fn unstrided(data: &[$T], length: usize, step: i32) -> DVector<$T> {
                let gap = step.unsigned_abs() as usize;
                for (k, value) in data.iter().enumerate() {
                    assert!(k % gap == 0 || value.is_nan(), "written between the elements");
                }
                DVector::from_fn(length, |i, _| {
                    data[if step > 0 { i } else { length - 1 - i } * gap]
                })
            }

            #[test]
            fn gemv() {
                let mut rng = rng();
                for (m, n) in crate::support::SHAPES {
                    for trans in [b'N', b'T', b'c'] {
                        for (incx, incy) in [(1, 1), (2, 3), (-1, 1), (2, -2)] {
                            let a = matrix(&mut rng, m, n);
                            let (columns, rows) = if trans == b'N' { (n, m) } else { (m, n) };
                            let x =
                                DVector::from_column_slice(matrix(&mut rng, columns, 1).as_slice());
                            let y =
                                DVector::from_column_slice(matrix(&mut rng, rows, 1).as_slice());
                            let (alpha, beta) = (-0.4, 2.5);
                            let expected = op(&a, trans) * &x * alpha + &y * beta;
                            let pa = Padded::new(&a, 3);
                            let (px, mut py) = (strided(&x, incx), strided(&y, incy));
                            // SAFETY: the arrays hold the matrix and the vectors.
                            unsafe {
                                $gemv(
                                    trans,
                                    int(m),
                                    int(n),
                                    alpha,
                                    &pa.data,
                                    pa.ld(),
                                    &px,
                                    incx,
                                    beta,
                                    &mut py,
                                    incy,
                                );
                            }
                            let got = unstrided(&py, rows, incy);
                            assert!((got - expected).amax() <= TOLERANCE, "gemv");
                        }
                    }
                }
            }

            #[test]
            fn symv() {
                let mut rng = rng();
                for n in SIZES {
                    for uplo in [b'U', b'L'] {
                        for (incx, incy) in [(1, 1), (-2, 3)] {
                            let a = matrix(&mut rng, n, n);
                            let a = &a + a.transpose();
                            let x = DVector::from_column_slice(matrix(&mut rng, n, 1).as_slice());
                            let y = DVector::from_column_slice(matrix(&mut rng, n, 1).as_slice());
                            let (alpha, beta) = (1.5, -0.5);
                            let expected = &a * &x * alpha + &y * beta;
                            let pa = Padded::triangle(&a, uplo, 1);
                            let (px, mut py) = (strided(&x, incx), strided(&y, incy));
                            // SAFETY: the arrays hold the triangle and the vectors.
                            unsafe {
                                $symv(
                                    uplo,
                                    int(n),
                                    alpha,
                                    &pa.data,
                                    pa.ld(),
                                    &px,
                                    incx,
                                    beta,
                                    &mut py,
                                    incy,
                                );
                            }
                            let got = unstrided(&py, n, incy);
                            assert!((got - expected).amax() <= TOLERANCE, "symv");
                        }
                    }
                }
            }

            #[test]
            fn syrk_and_syr2k() {
                let mut rng = rng();
                for n in SIZES {
                    for k in [1, 5, n] {
                        for (uplo, trans) in
                            [(b'U', b'N'), (b'U', b'T'), (b'L', b'N'), (b'L', b'T')]
                        {
                            let (rows, columns) = if trans == b'N' { (n, k) } else { (k, n) };
                            let (a, b) =
                                (matrix(&mut rng, rows, columns), matrix(&mut rng, rows, columns));
                            let c = matrix(&mut rng, n, n);
                            let c = &c + c.transpose();
                            let (alpha, beta) = (0.9, 0.3);
                            let (pa, pb) = (Padded::new(&a, 1), Padded::new(&b, 2));
                            let (oa, ob) = (op(&a, trans), op(&b, trans));

                            let expected = &oa * oa.transpose() * alpha + &c * beta;
                            let mut pc = Padded::triangle(&c, uplo, 2);
                            let ldc = pc.ld();
                            // SAFETY: the arrays hold the matrices of these sizes.
                            unsafe {
                                $syrk(
                                    uplo,
                                    trans,
                                    int(n),
                                    int(k),
                                    alpha,
                                    &pa.data,
                                    pa.ld(),
                                    beta,
                                    &mut pc.data,
                                    ldc,
                                );
                            }
                            close_triangle(&pc, &expected, uplo, "syrk");

                            let expected =
                                (&oa * ob.transpose() + &ob * oa.transpose()) * alpha + &c * beta;
                            let mut pc = Padded::triangle(&c, uplo, 0);
                            let ldc = pc.ld();
                            // SAFETY: the arrays hold the matrices of these sizes.
                            unsafe {
                                $syr2k(
                                    uplo,
                                    trans,
                                    int(n),
                                    int(k),
                                    alpha,
                                    &pa.data,
                                    pa.ld(),
                                    &pb.data,
                                    pb.ld(),
                                    beta,
                                    &mut pc.data,
                                    ldc,
                                );
                            }
                            close_triangle(&pc, &expected, uplo, "syr2k");
                        }
                    }
                }
            }
        }
    };
}

precision!(double, f64, crate::support::DOUBLE, dgemm, dgemv, dsymv, dsyrk, dsyr2k);
precision!(single, f32, crate::support::SINGLE, sgemm, sgemv, ssymv, ssyrk, ssyr2k);
