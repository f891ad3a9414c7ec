//! Vectors of three numbers, and sums of them that do not drift.

use model::Vector;

/// Scalar product.
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a + s b`.
pub(crate) fn along(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

pub(crate) fn scaled(s: f64, a: Vector) -> Vector {
    [s * a[0], s * a[1], s * a[2]]
}

/// Euclidean length.
pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector of `a`, whatever its size; `None` for zero, infinite or NaN.
pub(crate) fn unit(a: Vector) -> Option<Vector> {
    let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if !(a.iter().all(|x| x.is_finite()) && largest > 0.0) {
        return None;
    }
    // Divide by the largest component first: a tiny vector has no square.
    let b = a.map(|x| x / largest);
    let length = norm(b);
    Some(b.map(|x| x / length))
}

/// The part of `v` tangent to the sphere at the unit vector `u`: `(I - u uᵀ) v`.
///
/// Written as `u × (v × u)`: for `u` near `v` the difference of two large numbers never appears.
pub(crate) fn tangent(u: Vector, v: Vector) -> Vector {
    cross(u, cross(v, u))
}

/// A compensated sum of vectors (Knuth's two-sum per component).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct VectorSum {
    total: Vector,
    lost: Vector,
}

impl VectorSum {
    #[inline]
    pub(crate) fn add(&mut self, term: Vector) {
        for (k, &t) in term.iter().enumerate() {
            self.add_to(k, t);
        }
    }

    #[inline]
    pub(crate) fn add_to(&mut self, k: usize, t: f64) {
        let s = self.total[k];
        let next = s + t;
        let back = next - s;
        self.lost[k] += (s - (next - back)) + (t - back);
        self.total[k] = next;
    }

    pub(crate) fn value(&self) -> Vector {
        along(self.total, 1.0, self.lost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangent_part_of_a_nearly_parallel_vector_is_exact() {
        let e = 1e-9_f64;
        // u = (cos e, sin e, 0): the exact x component of (I - u uᵀ) x is sin² e.
        let u = [e.cos(), e.sin(), 0.0];
        let t = tangent(u, [1.0, 0.0, 0.0]);
        assert!((t[0] / (e.sin() * e.sin()) - 1.0).abs() < 1e-15);
        assert!(dot(t, u).abs() < 1e-24);
    }

    #[test]
    fn compensated_sums_keep_what_plain_sums_lose() {
        let mut sum = VectorSum::default();
        for term in [1e16, 1.0, -1e16] {
            sum.add([term, -term, 0.0]);
        }
        assert_eq!(sum.value().map(f64::to_bits), [1.0, -1.0, 0.0].map(f64::to_bits));
    }

    #[test]
    fn unit_vectors_of_tiny_huge_and_impossible_vectors() {
        for size in [1e-300, 1.0, 1e300] {
            let u = unit([3.0 * size, 0.0, 4.0 * size]).unwrap();
            assert!((u[0] - 0.6).abs() < 1e-15 && (u[2] - 0.8).abs() < 1e-15);
        }
        for bad in [[0.0; 3], [f64::NAN, 1.0, 0.0], [f64::INFINITY, 0.0, 0.0]] {
            assert!(unit(bad).is_none());
        }
    }
}
