//! What the tests of all routines share, in either precision: matrices in arrays with padded
//! columns, where a routine that reads or writes what it must not is caught.

/// Declares the helpers for numbers of type `$T`.
///
/// `$tolerance`: a bound on the rounding of sums of up to 40 products of numbers below 1, and on
/// the backward error of factorisations of that size, some hundred units in the last place.
macro_rules! helpers {
    ($T:ty, $tolerance:expr) => {
        use nalgebra::DMatrix;
        use rand::{RngExt, SeedableRng};
        use rand_chacha::ChaCha8Rng;

        const TOLERANCE: $T = $tolerance;

        /// What stands where no routine may look or write.
        const GUARD: $T = <$T>::NAN;

        /// The interpreter that watches every access is a thousand times slower.
        const SIZES: [usize; 7] =
            if cfg!(miri) { [1, 1, 2, 2, 3, 3, 4] } else { [1, 2, 3, 4, 7, 16, 40] };

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
    };
}

/// Sizes of products.
pub const PRODUCTS: [(usize, usize, usize); 5] = if cfg!(miri) {
    [(1, 1, 1), (2, 3, 4), (4, 3, 2), (3, 2, 3), (1, 4, 4)]
} else {
    [(1, 1, 1), (2, 3, 4), (7, 5, 6), (40, 13, 21), (3, 40, 40)]
};
/// Shapes of matrices.
pub const SHAPES: [(usize, usize); 4] =
    if cfg!(miri) { [(1, 1), (3, 5), (4, 2), (2, 3)] } else { [(1, 1), (3, 5), (8, 2), (40, 31)] };
/// Matrices of a kind.
pub const ROUNDS: usize = if cfg!(miri) { 2 } else { 200 };
/// The tolerance in double precision, about 200 units in the last place.
pub const DOUBLE: f64 = 4e-14;
/// The same in single precision.
pub const SINGLE: f32 = 2e-5;
