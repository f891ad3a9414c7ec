//! Eigenvalues and singular values.

use std::ffi::{c_char, c_int};

use nalgebra::DMatrix;

use crate::factor::fortran;
use crate::jacobi;
use crate::raw::{
    Scalar, Shape, ViewMut, copy, get, letter, set, size, slice_mut, symmetric, triangle, view_mut,
};

/// `info` of an iteration that did not converge, or had nothing finite to begin with.
const NOT_CONVERGED: c_int = 1;

/// The answer to a workspace query: none is needed.
const WORKSPACE: c_int = 1;

/// Eigenvalues in ascending order, and the vectors if there is a place for them.
fn syevr<T: Scalar>(full: DMatrix<T>, values: &mut [T], vectors: Option<&mut ViewMut<T>>) -> c_int {
    let Some(eigen) = jacobi::eigen(full) else {
        return NOT_CONVERGED;
    };
    values.copy_from_slice(eigen.values.as_slice());
    if let Some(vectors) = vectors {
        vectors.copy_from(&eigen.vectors);
    }
    0
}

/// Singular values in descending order, and thin factors A = U diag(s) Vᵀ if there are places for
/// them.
fn gesvd<'a, T: Scalar>(
    full: &DMatrix<T>,
    values: &mut [T],
    u: Option<&mut ViewMut<'a, T>>,
    vt: Option<&mut ViewMut<'a, T>>,
) -> c_int {
    let Some(factors) = jacobi::singular(full) else {
        return NOT_CONVERGED;
    };
    values.copy_from_slice(factors.values.as_slice());
    for (place, factor) in [(u, factors.u), (vt, factors.vt)] {
        if let Some(place) = place {
            place.copy_from(&factor);
        }
    }
    0
}

/// Whether singular vectors are wanted: 'S' thin, 'N' none.
fn wanted(job: u8) -> Option<bool> {
    match job {
        b'S' => Some(true),
        b'N' => Some(false),
        _ => None,
    }
}

macro_rules! export {
    ($T:ty, $syevr:ident, $gesdd:ident, $gesvd:ident) => {
        /// All eigenvalues of a symmetric matrix, ascending, and its orthonormal eigenvectors if
        /// `jobz` is 'V'. `info` > 0: the iteration did not converge.
        ///
        /// # Safety
        ///
        /// The LAPACK contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $syevr(
            jobz: *const c_char,
            range: *const c_char,
            uplo: *const c_char,
            n: *const c_int,
            a: *mut $T,
            lda: *const c_int,
            _vl: *const $T,
            _vu: *const $T,
            _il: *const c_int,
            _iu: *const c_int,
            _abstol: *const $T,
            m: *mut c_int,
            w: *mut $T,
            z: *mut $T,
            ldz: *const c_int,
            isuppz: *mut c_int,
            work: *mut $T,
            lwork: *const c_int,
            iwork: *mut c_int,
            liwork: *const c_int,
            info: *mut c_int,
        ) {
            // SAFETY: the LAPACK contract.
            let arguments = unsafe {
                (|| {
                    let vectors = match letter(jobz) {
                        b'V' => true,
                        b'N' => false,
                        _ => return Err(-1),
                    };
                    if letter(range) != b'A' {
                        return Err(-2);
                    }
                    let uplo = triangle(uplo).ok_or(-3)?;
                    let n = size(get(n)).ok_or(-4)?;
                    let shape_a = Shape::new(n, n, get(lda)).ok_or(-6)?;
                    let shape_z =
                        Shape::new(if vectors { n } else { 0 }, n, get(ldz)).ok_or(-15)?;
                    if get(lwork) == -1 || get(liwork) == -1 {
                        set(work, <$T>::from(1u8));
                        set(iwork, WORKSPACE);
                        return Err(0);
                    }
                    let z = vectors.then(|| view_mut(z, shape_z));
                    let full = symmetric(a, shape_a, uplo);
                    Ok((full, slice_mut(w, n), z, slice_mut(isuppz, 2 * n)))
                })()
            };
            let code = match arguments {
                Ok((full, values, mut vectors, support)) => {
                    // SAFETY: the LAPACK contract.
                    unsafe { set(m, fortran(values.len())) };
                    let rows = fortran(values.len());
                    for ends in support.chunks_exact_mut(2) {
                        ends.copy_from_slice(&[1, rows]);
                    }
                    syevr(full, values, vectors.as_mut())
                }
                Err(code) => code,
            };
            // SAFETY: the LAPACK contract.
            unsafe { set(info, code) }
        }

        /// Singular values of an m × n matrix, descending, and the thin factors U and Vᵀ if `jobz`
        /// is 'S'. `info` > 0: the iteration did not converge.
        ///
        /// # Safety
        ///
        /// The LAPACK contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $gesdd(
            jobz: *const c_char,
            m: *const c_int,
            n: *const c_int,
            a: *mut $T,
            lda: *const c_int,
            s: *mut $T,
            u: *mut $T,
            ldu: *const c_int,
            vt: *mut $T,
            ldvt: *const c_int,
            work: *mut $T,
            lwork: *const c_int,
            _iwork: *mut c_int,
            info: *mut c_int,
        ) {
            // SAFETY: the LAPACK contract.
            let arguments = unsafe {
                (|| {
                    let vectors = wanted(letter(jobz)).ok_or(-1)?;
                    let (m, n) = (size(get(m)).ok_or(-2)?, size(get(n)).ok_or(-3)?);
                    let k = m.min(n);
                    let shape_a = Shape::new(m, n, get(lda)).ok_or(-5)?;
                    let of = |rows, columns| if vectors { (rows, columns) } else { (0, 0) };
                    let (u_size, vt_size) = (of(m, k), of(k, n));
                    let shape_u = Shape::new(u_size.0, u_size.1, get(ldu)).ok_or(-8)?;
                    let shape_vt = Shape::new(vt_size.0, vt_size.1, get(ldvt)).ok_or(-10)?;
                    if get(lwork) == -1 {
                        set(work, <$T>::from(1u8));
                        return Err(0);
                    }
                    let u = vectors.then(|| view_mut(u, shape_u));
                    let vt = vectors.then(|| view_mut(vt, shape_vt));
                    Ok((copy(a, shape_a, false), slice_mut(s, k), u, vt))
                })()
            };
            let code = match arguments {
                Ok((full, values, mut u, mut vt)) => gesvd(&full, values, u.as_mut(), vt.as_mut()),
                Err(code) => code,
            };
            // SAFETY: the LAPACK contract.
            unsafe { set(info, code) }
        }

        /// As gesdd, with a letter for each factor.
        ///
        /// # Safety
        ///
        /// The LAPACK contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $gesvd(
            jobu: *const c_char,
            jobvt: *const c_char,
            m: *const c_int,
            n: *const c_int,
            a: *mut $T,
            lda: *const c_int,
            s: *mut $T,
            u: *mut $T,
            ldu: *const c_int,
            vt: *mut $T,
            ldvt: *const c_int,
            work: *mut $T,
            lwork: *const c_int,
            info: *mut c_int,
        ) {
            // SAFETY: the LAPACK contract.
            let arguments = unsafe {
                (|| {
                    let left = wanted(letter(jobu)).ok_or(-1)?;
                    let right = wanted(letter(jobvt)).ok_or(-2)?;
                    let (m, n) = (size(get(m)).ok_or(-3)?, size(get(n)).ok_or(-4)?);
                    let k = m.min(n);
                    let shape_a = Shape::new(m, n, get(lda)).ok_or(-6)?;
                    let shape_u = Shape::new(if left { m } else { 0 }, k, get(ldu)).ok_or(-9)?;
                    let shape_vt =
                        Shape::new(if right { k } else { 0 }, n, get(ldvt)).ok_or(-11)?;
                    if get(lwork) == -1 {
                        set(work, <$T>::from(1u8));
                        return Err(0);
                    }
                    let u = left.then(|| view_mut(u, shape_u));
                    let vt = right.then(|| view_mut(vt, shape_vt));
                    Ok((copy(a, shape_a, false), slice_mut(s, k), u, vt))
                })()
            };
            let code = match arguments {
                Ok((full, values, mut u, mut vt)) => gesvd(&full, values, u.as_mut(), vt.as_mut()),
                Err(code) => code,
            };
            // SAFETY: the LAPACK contract.
            unsafe { set(info, code) }
        }
    };
}

export!(f64, dsyevr_, dgesdd_, dgesvd_);
export!(f32, ssyevr_, sgesdd_, sgesvd_);
