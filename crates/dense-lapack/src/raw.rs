//! From the raw arguments of a Fortran call to safe values: where the `unsafe` lives.

use std::ffi::{c_char, c_int};

use nalgebra::{DMatrix, DMatrixViewMut, Dyn, Matrix, RealField, U1, ViewStorageMut};

/// `f32` or `f64`.
pub(crate) trait Scalar: RealField + Copy {}
impl Scalar for f32 {}
impl Scalar for f64 {}

/// A matrix of the caller, to be written, or to be factored in place.
pub(crate) type ViewMut<'a, T> = DMatrixViewMut<'a, T>;

/// Which triangle of a symmetric matrix is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Triangle {
    Upper,
    Lower,
}

impl Triangle {
    /// Rows of column `j` that belong to the triangle of an n × n matrix.
    pub(crate) fn rows(self, j: usize, n: usize) -> std::ops::Range<usize> {
        match self {
            Self::Upper => 0..j + 1,
            Self::Lower => j..n,
        }
    }
}

/// Shape and leading dimension of a column-major matrix.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    stride: usize,
}

impl Shape {
    /// `None` when a size is negative or the leading dimension is less than `max(1, rows)`.
    pub(crate) fn new(rows: usize, columns: usize, leading: c_int) -> Option<Self> {
        let stride = size(leading)?;
        (stride >= rows.max(1)).then_some(Self { rows, columns, stride })
    }
}

/// A dimension; `None` when it is negative.
pub(crate) fn size(n: c_int) -> Option<usize> {
    usize::try_from(n).ok()
}

/// The value behind a pointer: Fortran passes every scalar by reference.
///
/// # Safety
///
/// `value` points to a readable value.
pub(crate) unsafe fn get<T: Copy>(value: *const T) -> T {
    // SAFETY: the caller's promise.
    unsafe { value.read() }
}

/// Write an output scalar.
///
/// # Safety
///
/// `place` points to a writable value.
pub(crate) unsafe fn set<T>(place: *mut T, value: T) {
    // SAFETY: the caller's promise.
    unsafe { place.write(value) }
}

/// A letter, in upper case.
///
/// # Safety
///
/// `letter` points to a readable character.
pub(crate) unsafe fn letter(letter: *const c_char) -> u8 {
    // SAFETY: the caller's promise.
    unsafe { get(letter.cast::<u8>()) }.to_ascii_uppercase()
}

/// `uplo`: 'U' or 'L'.
///
/// # Safety
///
/// As [`letter`].
pub(crate) unsafe fn triangle(uplo: *const c_char) -> Option<Triangle> {
    // SAFETY: the caller's promise.
    match unsafe { letter(uplo) } {
        b'U' => Some(Triangle::Upper),
        b'L' => Some(Triangle::Lower),
        _ => None,
    }
}

/// `trans`: 'N', or 'T' (and 'C', the same for real numbers).
///
/// # Safety
///
/// As [`letter`].
pub(crate) unsafe fn transposed(trans: *const c_char) -> Option<bool> {
    // SAFETY: the caller's promise.
    match unsafe { letter(trans) } {
        b'N' => Some(false),
        b'T' | b'C' => Some(true),
        _ => None,
    }
}

/// A copy of the matrix `a`, or of its transpose.
///
/// A copy and not a view: it costs nothing next to what follows, a transpose stays contiguous
/// (`axcpy` of nalgebra 0.34 runs past the end of vectors that are not), and no reference to the
/// caller's array outlives the line.
///
/// # Safety
///
/// `a` points to a readable column-major array of this shape.
pub(crate) unsafe fn copy<T: Scalar>(a: *const T, shape: Shape, transpose: bool) -> DMatrix<T> {
    // SAFETY: element (i, j) is a[i + j stride] by the caller's promise.
    let at = |i, j| unsafe { get(a.add(i + j * shape.stride)) };
    if transpose {
        DMatrix::from_fn(shape.columns, shape.rows, |i, j| at(j, i))
    } else {
        DMatrix::from_fn(shape.rows, shape.columns, at)
    }
}

/// A copy of the symmetric n × n matrix of which one triangle is stored; the other is not read.
///
/// # Safety
///
/// `a` points to a column-major array of this shape, readable in that triangle.
pub(crate) unsafe fn symmetric<T: Scalar>(a: *const T, shape: Shape, uplo: Triangle) -> DMatrix<T> {
    let n = shape.columns;
    let mut full = DMatrix::zeros(n, n);
    for j in 0..n {
        for i in uplo.rows(j, n) {
            // SAFETY: the caller's promise.
            let value = unsafe { get(a.add(i + j * shape.stride)) };
            full[(i, j)] = value;
            full[(j, i)] = value;
        }
    }
    full
}

/// The matrix that `alpha` multiplies, as [`copy`]. With α = 0 the BLAS does not reference it, so
/// that it need not be set, nor be there: zeros stand for it.
///
/// # Safety
///
/// As [`copy`], unless α = 0.
pub(crate) unsafe fn factor<T: Scalar>(
    alpha: T,
    a: *const T,
    shape: Shape,
    transpose: bool,
) -> DMatrix<T> {
    if alpha.is_zero() {
        let (rows, columns) = (shape.rows, shape.columns);
        let (rows, columns) = if transpose { (columns, rows) } else { (rows, columns) };
        return DMatrix::zeros(rows, columns);
    }
    // SAFETY: the caller's promise.
    unsafe { copy(a, shape, transpose) }
}

/// The symmetric matrix that `alpha` multiplies, as [`symmetric`] and [`factor`].
///
/// # Safety
///
/// As [`symmetric`], unless α = 0.
pub(crate) unsafe fn symmetric_factor<T: Scalar>(
    alpha: T,
    a: *const T,
    shape: Shape,
    uplo: Triangle,
) -> DMatrix<T> {
    if alpha.is_zero() {
        return DMatrix::zeros(shape.columns, shape.columns);
    }
    // SAFETY: the caller's promise.
    unsafe { symmetric(a, shape, uplo) }
}

/// The matrix `a`, to be written.
///
/// # Safety
///
/// `a` points to a writable column-major array of this shape that nobody else uses during `'a`.
pub(crate) unsafe fn view_mut<'a, T: Scalar>(a: *mut T, shape: Shape) -> ViewMut<'a, T> {
    let (size, strides) = ((Dyn(shape.rows), Dyn(shape.columns)), (U1, Dyn(shape.stride)));
    // SAFETY: element (i, j) is a[i + j stride] by the caller's promise.
    Matrix::from_data(unsafe { ViewStorageMut::from_raw_parts(a, size, strides) })
}

/// An output array.
///
/// # Safety
///
/// `values` points to a writable array of `length` initialised values that nobody else uses during
/// `'a`.
pub(crate) unsafe fn slice_mut<'a, T>(values: *mut T, length: usize) -> &'a mut [T] {
    if length == 0 {
        return &mut [];
    }
    // SAFETY: the caller's promise.
    unsafe { std::slice::from_raw_parts_mut(values, length) }
}

/// What the reference implementation calls XERBLA: a routine without `info` was called wrongly.
pub(crate) fn illegal(routine: &str) -> ! {
    eprintln!("illegal argument in a call of {routine}");
    std::process::abort()
}
