//! Every exported symbol, called as clarabel calls it (through the crates `blas` and `lapack`),
//! against nalgebra or against what the routine is defined to do, on random matrices with padded
//! columns, in both precisions.

use dense_lapack as _;

/// Declares the tests of one precision.
///
/// `$tolerance`: a bound on the rounding of sums of up to 40 products of numbers below 1, and on the
/// backward error of factorisations of that size, some hundred units in the last place.
macro_rules! precision {
    ($module:ident, $T:ty, $tolerance:expr, $gemm:ident, $gemv:ident, $symv:ident, $syrk:ident,
     $syr2k:ident, $potrf:ident, $potrs:ident, $gesv:ident, $syevr:ident, $gesdd:ident, $gesvd:ident) => {
        mod $module {
            use blas::{$gemm, $gemv, $symv, $syr2k, $syrk};
            use lapack::{$gesdd, $gesv, $gesvd, $potrf, $potrs, $syevr};
            use nalgebra::{DMatrix, DVector};
            use rand::{RngExt, SeedableRng};
            use rand_chacha::ChaCha8Rng;

            const TOLERANCE: $T = $tolerance;
            /// What stands where no routine may look or write.
            const GUARD: $T = <$T>::NAN;
            const SIZES: [usize; 7] = [1, 2, 3, 4, 7, 16, 40];

            fn rng() -> ChaCha8Rng {
                ChaCha8Rng::seed_from_u64(20_261_121)
            }

            fn matrix(rng: &mut ChaCha8Rng, rows: usize, columns: usize) -> DMatrix<$T> {
                DMatrix::from_fn(rows, columns, |_, _| rng.random_range(-1.0..1.0))
            }

            /// A matrix in an array whose columns are `padding` longer than they need to be.
            struct Padded {
                data: Vec<$T>,
                rows: usize,
                columns: usize,
                leading: usize,
            }

            impl Padded {
                fn new(m: &DMatrix<$T>, padding: usize) -> Self {
                    let leading = m.nrows() + padding;
                    let mut data = vec![GUARD; leading * m.ncols()];
                    for j in 0..m.ncols() {
                        for i in 0..m.nrows() {
                            data[i + j * leading] = m[(i, j)];
                        }
                    }
                    Self { data, rows: m.nrows(), columns: m.ncols(), leading }
                }

                /// Only one triangle is there; the other is guarded.
                fn triangle(m: &DMatrix<$T>, uplo: u8, padding: usize) -> Self {
                    let mut padded = Self::new(m, padding);
                    for j in 0..m.ncols() {
                        for i in 0..m.nrows() {
                            if !stored(uplo, i, j) {
                                padded.data[i + j * padded.leading] = GUARD;
                            }
                        }
                    }
                    padded
                }

                fn get(&self, i: usize, j: usize) -> $T {
                    self.data[i + j * self.leading]
                }

                /// The matrix, after a look at the padding: nobody wrote there.
                fn matrix(&self) -> DMatrix<$T> {
                    for (k, x) in self.data.iter().enumerate() {
                        assert!(k % self.leading < self.rows || x.is_nan(), "padding written");
                    }
                    DMatrix::from_fn(self.rows, self.columns, |i, j| self.get(i, j))
                }

                fn ld(&self) -> i32 {
                    int(self.leading)
                }
            }

            fn int(n: usize) -> i32 {
                i32::try_from(n).unwrap()
            }

            fn stored(uplo: u8, i: usize, j: usize) -> bool {
                if uplo == b'U' { i <= j } else { i >= j }
            }

            fn close(a: &DMatrix<$T>, b: &DMatrix<$T>, what: &str) {
                assert_eq!(a.shape(), b.shape(), "{what}");
                let scale = b.amax().max(1.0);
                let error = (a - b).amax();
                assert!(error <= TOLERANCE * scale, "{what}: {error:e} of {scale:e}");
            }

            /// One triangle of `a` is that of `b`; the other is still guarded.
            fn close_triangle(a: &Padded, b: &DMatrix<$T>, uplo: u8, what: &str) {
                let full = a.matrix();
                for j in 0..b.ncols() {
                    for i in 0..b.nrows() {
                        if stored(uplo, i, j) {
                            let error = (full[(i, j)] - b[(i, j)]).abs();
                            assert!(error <= TOLERANCE * b.amax().max(1.0), "{what}: {error:e}");
                        } else {
                            assert!(full[(i, j)].is_nan(), "{what}: wrong triangle written");
                        }
                    }
                }
            }

            fn op(m: &DMatrix<$T>, trans: u8) -> DMatrix<$T> {
                if trans == b'N' { m.clone() } else { m.transpose() }
            }

            #[test]
            fn gemm() {
                let mut rng = rng();
                for (m, n, k) in [(1, 1, 1), (2, 3, 4), (7, 5, 6), (40, 13, 21), (3, 40, 40)] {
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
                for (m, n) in [(1, 1), (3, 5), (8, 2), (40, 31)] {
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
                    // With orthonormal factors this bounds the error of every singular value (Weyl).
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
                for round in 0..200 {
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
                for round in 0..200 {
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
                let (mut b, mut u, mut vt): ([$T; 2], [$T; 4], [$T; 4]) =
                    ([1.0; 2], [0.0; 4], [0.0; 4]);
                let (mut pivots, mut iwork, mut work, mut s): (_, _, [$T; 1], [$T; 2]) =
                    ([0; 2], [0; 16], [0.0], [0.0; 2]);
                let (mut info, mut found) = (0, 0);
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
                            b'I',
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

precision!(
    double, f64, 4e-14, dgemm, dgemv, dsymv, dsyrk, dsyr2k, dpotrf, dpotrs, dgesv, dsyevr, dgesdd,
    dgesvd
);
precision!(
    single, f32, 2e-5, sgemm, sgemv, ssymv, ssyrk, ssyr2k, spotrf, spotrs, sgesv, ssyevr, sgesdd,
    sgesvd
);
