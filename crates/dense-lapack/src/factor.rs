//! Cholesky and LU.

use std::ffi::{c_char, c_int};

use nalgebra::{DMatrix, DVector, LU};

use crate::raw::{
    Scalar, Shape, Triangle, ViewMut, copy, get, set, size, slice_mut, triangle, view_mut,
};

/// Fortran's argument numbers and orders count from 1.
pub(crate) fn fortran(k: usize) -> c_int {
    c_int::try_from(k).unwrap_or(c_int::MAX)
}

/// Factor in place; the number of the first leading minor that is not positive, or 0. The other
/// triangle is neither read nor written.
fn potrf<T: Scalar>(uplo: Triangle, a: &mut ViewMut<T>) -> c_int {
    let n = a.nrows();
    // Element (i, j) of the lower factor, i >= j.
    let at = |i, j| if uplo == Triangle::Lower { (i, j) } else { (j, i) };
    for j in 0..n {
        for k in 0..j {
            let factor = a[at(j, k)];
            for i in j..n {
                let product = a[at(i, k)] * factor;
                a[at(i, j)] -= product;
            }
        }
        let pivot = a[at(j, j)];
        // Written so that a pivot that is not a number fails.
        if !(pivot > T::zero() && pivot.is_finite()) {
            return fortran(j + 1);
        }
        let root = pivot.sqrt();
        a[at(j, j)] = root;
        for i in j + 1..n {
            a[at(i, j)] /= root;
        }
    }
    0
}

/// Solve L Lᵀ X = B, or Uᵀ U X = B, in place.
fn potrs<T: Scalar>(uplo: Triangle, a: &DMatrix<T>, b: &mut ViewMut<T>) {
    let mut x = b.clone_owned();
    // A zero pivot would be the caller's: potrf leaves none. As in the reference it goes
    // unreported.
    let _ = match uplo {
        Triangle::Lower => {
            a.solve_lower_triangular_mut(&mut x) && a.tr_solve_lower_triangular_mut(&mut x)
        }
        Triangle::Upper => {
            a.tr_solve_upper_triangular_mut(&mut x) && a.solve_upper_triangular_mut(&mut x)
        }
    };
    b.copy_from(&x);
}

/// Factor P A = L U in place and solve A X = B in place; the number of the first zero pivot, or 0.
fn gesv<T: Scalar>(a: &mut ViewMut<T>, pivots: &mut [c_int], b: &mut ViewMut<T>) -> c_int {
    let n = a.nrows();
    if n == 0 {
        return 0;
    }
    let lu = LU::new(a.clone_owned());
    a.copy_from(lu.lu_internal());
    // Row i of P A was row order[i] of A. Fortran wants the exchanges that led there.
    let mut order = DVector::from_fn(n, |i, _| i);
    lu.p().permute_rows(&mut order);
    let mut current: Vec<usize> = (0..n).collect();
    for i in 0..n {
        let from = (i..n).find(|&k| current[k] == order[i]).unwrap_or(i);
        current.swap(i, from);
        pivots[i] = fortran(from + 1);
    }
    if let Some(zero) = (0..n).find(|&i| a[(i, i)].is_zero()) {
        return fortran(zero + 1);
    }
    let mut x = b.clone_owned();
    lu.solve_mut(&mut x);
    b.copy_from(&x);
    0
}

macro_rules! export {
    ($T:ty, $potrf:ident, $potrs:ident, $gesv:ident) => {
        /// Cholesky factor of a positive definite matrix, in place of its triangle. `info` = k > 0:
        /// the leading minor of order k is not positive.
        ///
        /// # Safety
        ///
        /// The LAPACK contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $potrf(
            uplo: *const c_char,
            n: *const c_int,
            a: *mut $T,
            lda: *const c_int,
            info: *mut c_int,
        ) {
            // SAFETY: the LAPACK contract.
            let arguments = unsafe {
                (|| {
                    let uplo = triangle(uplo).ok_or(-1)?;
                    let n = size(get(n)).ok_or(-2)?;
                    Ok((uplo, view_mut(a, Shape::new(n, n, get(lda)).ok_or(-4)?)))
                })()
            };
            let code =
                arguments.map_or_else(|illegal| illegal, |(uplo, mut a)| potrf(uplo, &mut a));
            // SAFETY: the LAPACK contract.
            unsafe { set(info, code) }
        }

        /// Solve A X = B, with the factor that potrf left in A, in place of B.
        ///
        /// # Safety
        ///
        /// The LAPACK contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $potrs(
            uplo: *const c_char,
            n: *const c_int,
            nrhs: *const c_int,
            a: *const $T,
            lda: *const c_int,
            b: *mut $T,
            ldb: *const c_int,
            info: *mut c_int,
        ) {
            // SAFETY: the LAPACK contract.
            let arguments = unsafe {
                (|| {
                    let uplo = triangle(uplo).ok_or(-1)?;
                    let n = size(get(n)).ok_or(-2)?;
                    let columns = size(get(nrhs)).ok_or(-3)?;
                    let a = copy(a, Shape::new(n, n, get(lda)).ok_or(-5)?, false);
                    Ok((uplo, a, view_mut(b, Shape::new(n, columns, get(ldb)).ok_or(-7)?)))
                })()
            };
            let code = match arguments {
                Ok((uplo, a, mut b)) => {
                    potrs(uplo, &a, &mut b);
                    0
                }
                Err(illegal) => illegal,
            };
            // SAFETY: the LAPACK contract.
            unsafe { set(info, code) }
        }

        /// Solve A X = B by LU with partial pivoting, in place of B; the factors are left in A and
        /// the row exchanges in `ipiv`. `info` = k > 0: pivot k is zero, nothing was solved.
        ///
        /// # Safety
        ///
        /// The LAPACK contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $gesv(
            n: *const c_int,
            nrhs: *const c_int,
            a: *mut $T,
            lda: *const c_int,
            ipiv: *mut c_int,
            b: *mut $T,
            ldb: *const c_int,
            info: *mut c_int,
        ) {
            // SAFETY: the LAPACK contract.
            let arguments = unsafe {
                (|| {
                    let n = size(get(n)).ok_or(-1)?;
                    let columns = size(get(nrhs)).ok_or(-2)?;
                    let a = view_mut(a, Shape::new(n, n, get(lda)).ok_or(-4)?);
                    let b = view_mut(b, Shape::new(n, columns, get(ldb)).ok_or(-7)?);
                    Ok((a, slice_mut(ipiv, n), b))
                })()
            };
            let code = arguments.map_or_else(
                |illegal| illegal,
                |(mut a, pivots, mut b)| gesv(&mut a, pivots, &mut b),
            );
            // SAFETY: the LAPACK contract.
            unsafe { set(info, code) }
        }
    };
}

export!(f64, dpotrf_, dpotrs_, dgesv_);
export!(f32, spotrf_, spotrs_, sgesv_);
