//! The comparison of matrices of which one triangle is stored.

/// Declares the comparison of triangles for numbers of type `$T`.
macro_rules! triangle_helpers {
    ($T:ty) => {
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
    };
}
