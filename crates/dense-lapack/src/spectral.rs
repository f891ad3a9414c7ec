//! Eigenvalues and singular values.

use std::ffi::{c_char, c_int};
use std::ops::Range;

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

/// Which eigenvalues are wanted.
#[derive(Debug, Clone, Copy)]
enum Wanted<T> {
    All,
    /// Those in (lower, upper].
    Between(T, T),
    /// The first to the last of these, counted from 1 in ascending order.
    Numbers(usize, usize),
}

impl<T: Scalar> Wanted<T> {
    /// `range` with its four numbers; the number of the illegal argument, as the reference looks at
    /// them.
    fn new(range: u8, n: usize, between: (T, T), numbers: (c_int, c_int)) -> Result<Self, c_int> {
        match range {
            b'A' => Ok(Self::All),
            b'V' if n > 0 && between.1 <= between.0 => Err(-8),
            b'V' => Ok(Self::Between(between.0, between.1)),
            b'I' => {
                let (most, (first, last)) = (fortran(n), numbers);
                if first < 1 || first > most.max(1) {
                    return Err(-9);
                }
                if last < most.min(first) || last > most {
                    return Err(-10);
                }
                Ok(Self::Numbers(size(first).ok_or(-9)?, size(last).ok_or(-10)?))
            }
            _ => Err(-2),
        }
    }

    /// The places of those wanted among all eigenvalues in ascending order.
    fn places(self, values: &[T]) -> Range<usize> {
        match self {
            Self::All => 0..values.len(),
            Self::Between(lower, upper) => {
                let first = values.partition_point(|value| *value <= lower);
                let last = values.partition_point(|value| *value <= upper);
                first..last.max(first)
            }
            Self::Numbers(first, last) => (first - 1).min(last)..last,
        }
    }
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
        /// The eigenvalues of a symmetric matrix that `range` asks for, ascending, their number
        /// `m`, and their orthonormal eigenvectors if `jobz` is 'V'. `range` is 'A' for all, 'V'
        /// for those in (`vl`, `vu`], 'I' for numbers `il` to `iu`. `info` > 0: the iteration did
        /// not converge. `isuppz` is written where all are asked for, as by the reference.
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
            vl: *const $T,
            vu: *const $T,
            il: *const c_int,
            iu: *const c_int,
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
                    let range = letter(range);
                    // Numbers that the range does not ask for need not be set.
                    let between = if range == b'V' { (get(vl), get(vu)) } else { (0.0, 0.0) };
                    let numbers = if range == b'I' { (get(il), get(iu)) } else { (0, 0) };
                    if !matches!(range, b'A' | b'V' | b'I') {
                        return Err(-2);
                    }
                    let uplo = triangle(uplo).ok_or(-3)?;
                    let n = size(get(n)).ok_or(-4)?;
                    let shape = Shape::new(n, n, get(lda)).ok_or(-6)?;
                    let wanted = Wanted::new(range, n, between, numbers)?;
                    Shape::new(if vectors { n } else { 0 }, n, get(ldz)).ok_or(-15)?;
                    if get(lwork) == -1 || get(liwork) == -1 {
                        set(work, <$T>::from(1u8));
                        set(iwork, WORKSPACE);
                        return Err(0);
                    }
                    Ok((symmetric(a, shape, uplo), wanted, vectors))
                })()
            };
            let found = arguments.and_then(|(full, wanted, vectors)| {
                let eigen = jacobi::eigen(full).ok_or(NOT_CONVERGED)?;
                Ok((wanted.places(eigen.values.as_slice()), eigen, vectors))
            });
            // SAFETY: the LAPACK contract.
            unsafe {
                let code = match found {
                    Ok((places, eigen, vectors)) => {
                        let (n, count) = (eigen.values.len(), places.len());
                        set(m, fortran(count));
                        slice_mut(w, count)
                            .copy_from_slice(&eigen.values.as_slice()[places.clone()]);
                        if let Some(shape) =
                            Shape::new(n, count, get(ldz)).filter(|_| vectors && count > 0)
                        {
                            let columns = eigen.vectors.columns_range(places);
                            view_mut(z, shape).copy_from(&columns);
                        }
                        if count == n {
                            for ends in slice_mut(isuppz, 2 * n).chunks_exact_mut(2) {
                                ends.copy_from_slice(&[1, fortran(n)]);
                            }
                        }
                        0
                    }
                    Err(code) => code,
                };
                set(info, code);
            }
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
