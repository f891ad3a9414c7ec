//! Level 2 and 3: products.

use std::ffi::{c_char, c_int};

use nalgebra::{DMatrix, DVector};

use crate::raw::{
    Scalar, Shape, Triangle, ViewMut, factor, get, illegal, size, symmetric_factor, transposed,
    triangle, view_mut,
};

/// `new + β old`; with β = 0 what was there before is not looked at.
fn accumulate<T: Scalar>(place: &mut T, new: T, beta: T) {
    *place = if beta.is_zero() { new } else { new + beta * *place };
}

/// C ← α A B + β C.
fn gemm<T: Scalar>(alpha: T, a: &DMatrix<T>, b: &DMatrix<T>, beta: T, c: &mut ViewMut<T>) {
    for (place, value) in c.iter_mut().zip(&(a * b)) {
        accumulate(place, alpha * *value, beta);
    }
}

/// y ← α A x + β y; with α = 0 x is not looked at.
fn gemv<T: Scalar>(alpha: T, a: &DMatrix<T>, x: &Strided<T>, beta: T, y: &mut StridedMut<T>) {
    let factor = |i| if alpha.is_zero() { T::zero() } else { x.get(i) };
    let product = a * DVector::from_fn(x.length, |i, _| factor(i));
    for (i, value) in product.iter().enumerate() {
        let mut sum = if beta.is_zero() { T::zero() } else { y.0.get(i) };
        accumulate(&mut sum, alpha * *value, beta);
        y.set(i, sum);
    }
}

/// One triangle of C ← α P + β C.
fn add_to_triangle<T: Scalar>(
    uplo: Triangle,
    alpha: T,
    product: &DMatrix<T>,
    beta: T,
    c: &mut ViewMut<T>,
) {
    let n = c.nrows();
    for j in 0..n {
        for i in uplo.rows(j, n) {
            accumulate(&mut c[(i, j)], alpha * product[(i, j)], beta);
        }
    }
}

/// A vector of the caller, every `step`-th element of an array.
struct Strided<T> {
    first: *mut T,
    length: usize,
    step: isize,
}

impl<T: Copy> Strided<T> {
    /// `None` when the step is zero. A negative step runs through the array backwards.
    ///
    /// # Safety
    ///
    /// `x` points to an array of at least 1 + (length - 1) |step| values, readable for as long as
    /// the result is used.
    unsafe fn new(x: *const T, length: usize, step: c_int) -> Option<Self> {
        let step = isize::try_from(step).ok().filter(|step| *step != 0)?;
        let last = isize::try_from(length).ok()? - 1;
        let first = if step < 0 && last > 0 {
            // SAFETY: the element is in the array by the caller's promise.
            unsafe { x.offset(-step * last) }
        } else {
            x
        };
        Some(Self { first: first.cast_mut(), length, step })
    }

    fn place(&self, i: usize) -> *mut T {
        assert!(i < self.length, "element {i} of a vector of {}", self.length);
        // An array has no more than `isize::MAX` elements, so the product does not wrap.
        self.first.wrapping_offset(i.cast_signed() * self.step)
    }

    fn get(&self, i: usize) -> T {
        // SAFETY: `place` stays in the array, readable by the promise made to `new`.
        unsafe { get(self.place(i)) }
    }
}

/// A vector of the caller, to be written.
struct StridedMut<T>(Strided<T>);

impl<T: Copy> StridedMut<T> {
    /// # Safety
    ///
    /// As [`Strided::new`], and nobody else uses the array for as long as the result is used.
    unsafe fn new(y: *mut T, length: usize, step: c_int) -> Option<Self> {
        // SAFETY: the caller's promise.
        unsafe { Strided::new(y, length, step) }.map(Self)
    }

    fn set(&mut self, i: usize, value: T) {
        // SAFETY: `place` stays in the array, writable by the promise made to `new`.
        unsafe { self.0.place(i).write(value) }
    }
}

macro_rules! export {
    ($T:ty, $gemm:ident, $gemv:ident, $symv:ident, $syrk:ident, $syr2k:ident) => {
        /// C ← α op(A) op(B) + β C, with op(A) of size m × k and op(B) of size k × n.
        ///
        /// # Safety
        ///
        /// The BLAS contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $gemm(
            transa: *const c_char,
            transb: *const c_char,
            m: *const c_int,
            n: *const c_int,
            k: *const c_int,
            alpha: *const $T,
            a: *const $T,
            lda: *const c_int,
            b: *const $T,
            ldb: *const c_int,
            beta: *const $T,
            c: *mut $T,
            ldc: *const c_int,
        ) {
            // SAFETY: the BLAS contract.
            let arguments = unsafe {
                (|| {
                    let (m, n, k) = (size(get(m))?, size(get(n))?, size(get(k))?);
                    let (ta, tb) = (transposed(transa)?, transposed(transb)?);
                    let shape_a = if ta { (k, m) } else { (m, k) };
                    let shape_b = if tb { (n, k) } else { (k, n) };
                    Some((
                        factor(get(alpha), a, Shape::new(shape_a.0, shape_a.1, get(lda))?, ta),
                        factor(get(alpha), b, Shape::new(shape_b.0, shape_b.1, get(ldb))?, tb),
                        view_mut(c, Shape::new(m, n, get(ldc))?),
                        get(alpha),
                        get(beta),
                    ))
                })()
            };
            match arguments {
                Some((a, b, mut c, alpha, beta)) => gemm(alpha, &a, &b, beta, &mut c),
                None => illegal(stringify!($gemm)),
            }
        }

        /// y ← α op(A) x + β y, with A of size m × n.
        ///
        /// # Safety
        ///
        /// The BLAS contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $gemv(
            trans: *const c_char,
            m: *const c_int,
            n: *const c_int,
            alpha: *const $T,
            a: *const $T,
            lda: *const c_int,
            x: *const $T,
            incx: *const c_int,
            beta: *const $T,
            y: *mut $T,
            incy: *const c_int,
        ) {
            // SAFETY: the BLAS contract.
            let arguments = unsafe {
                (|| {
                    let (m, n, transpose) = (size(get(m))?, size(get(n))?, transposed(trans)?);
                    let (length_x, length_y) = if transpose { (m, n) } else { (n, m) };
                    Some((
                        factor(get(alpha), a, Shape::new(m, n, get(lda))?, transpose),
                        Strided::new(x, length_x, get(incx))?,
                        StridedMut::new(y, length_y, get(incy))?,
                        get(alpha),
                        get(beta),
                    ))
                })()
            };
            match arguments {
                Some((a, x, mut y, alpha, beta)) => gemv(alpha, &a, &x, beta, &mut y),
                None => illegal(stringify!($gemv)),
            }
        }

        /// y ← α A x + β y, with A symmetric of size n × n, of which one triangle is read.
        ///
        /// # Safety
        ///
        /// The BLAS contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $symv(
            uplo: *const c_char,
            n: *const c_int,
            alpha: *const $T,
            a: *const $T,
            lda: *const c_int,
            x: *const $T,
            incx: *const c_int,
            beta: *const $T,
            y: *mut $T,
            incy: *const c_int,
        ) {
            // SAFETY: the BLAS contract.
            let arguments = unsafe {
                (|| {
                    let n = size(get(n))?;
                    let (shape, uplo) = (Shape::new(n, n, get(lda))?, triangle(uplo)?);
                    Some((
                        symmetric_factor(get(alpha), a, shape, uplo),
                        Strided::new(x, n, get(incx))?,
                        StridedMut::new(y, n, get(incy))?,
                        get(alpha),
                        get(beta),
                    ))
                })()
            };
            match arguments {
                Some((a, x, mut y, alpha, beta)) => gemv(alpha, &a, &x, beta, &mut y),
                None => illegal(stringify!($symv)),
            }
        }

        /// One triangle of C ← α op(A) op(A)ᵀ + β C, with op(A) of size n × k.
        ///
        /// # Safety
        ///
        /// The BLAS contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $syrk(
            uplo: *const c_char,
            trans: *const c_char,
            n: *const c_int,
            k: *const c_int,
            alpha: *const $T,
            a: *const $T,
            lda: *const c_int,
            beta: *const $T,
            c: *mut $T,
            ldc: *const c_int,
        ) {
            // SAFETY: the BLAS contract.
            let arguments = unsafe {
                (|| {
                    let (n, k, transpose) = (size(get(n))?, size(get(k))?, transposed(trans)?);
                    let (rows, columns) = if transpose { (k, n) } else { (n, k) };
                    Some((
                        triangle(uplo)?,
                        factor(get(alpha), a, Shape::new(rows, columns, get(lda))?, transpose),
                        view_mut(c, Shape::new(n, n, get(ldc))?),
                        get(alpha),
                        get(beta),
                    ))
                })()
            };
            match arguments {
                Some((uplo, a, mut c, alpha, beta)) => {
                    add_to_triangle(uplo, alpha, &(&a * a.transpose()), beta, &mut c);
                }
                None => illegal(stringify!($syrk)),
            }
        }

        /// One triangle of C ← α (op(A) op(B)ᵀ + op(B) op(A)ᵀ) + β C, both op of size n × k.
        ///
        /// # Safety
        ///
        /// The BLAS contract, see the [crate](crate#safety).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $syr2k(
            uplo: *const c_char,
            trans: *const c_char,
            n: *const c_int,
            k: *const c_int,
            alpha: *const $T,
            a: *const $T,
            lda: *const c_int,
            b: *const $T,
            ldb: *const c_int,
            beta: *const $T,
            c: *mut $T,
            ldc: *const c_int,
        ) {
            // SAFETY: the BLAS contract.
            let arguments = unsafe {
                (|| {
                    let (n, k, transpose) = (size(get(n))?, size(get(k))?, transposed(trans)?);
                    let (rows, columns) = if transpose { (k, n) } else { (n, k) };
                    Some((
                        triangle(uplo)?,
                        factor(get(alpha), a, Shape::new(rows, columns, get(lda))?, transpose),
                        factor(get(alpha), b, Shape::new(rows, columns, get(ldb))?, !transpose),
                        view_mut(c, Shape::new(n, n, get(ldc))?),
                        get(alpha),
                        get(beta),
                    ))
                })()
            };
            match arguments {
                Some((uplo, a, bt, mut c, alpha, beta)) => {
                    let product = a * bt;
                    let both = &product + product.transpose();
                    add_to_triangle(uplo, alpha, &both, beta, &mut c);
                }
                None => illegal(stringify!($syr2k)),
            }
        }
    };
}

export!(f64, dgemm_, dgemv_, dsymv_, dsyrk_, dsyr2k_);
export!(f32, sgemm_, sgemv_, ssymv_, ssyrk_, ssyr2k_);
