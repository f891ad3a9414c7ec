//! Pairs of a number and a vector, and the cone of those whose number is larger than the vector is
//! long.
//!
//! With $z = (z_0, \vec z)$, the product $y \circ z = (y \cdot z,\ y_0 \vec z + z_0 \vec y)$, the
//! unit $(1, 0)$ and the determinant $\det z = z_0^2 - |\vec z|^2$, the cone is that of the
//! squares. For two pairs inside it there is one symmetric matrix $W$ that keeps the cone, with $W
//! z = W^{-1} s$; with $\bar v = (z/\sqrt{\det z} + J s/\sqrt{\det s})/2\gamma$, $\det \bar v = 1$,
//! $J = \mathrm{diag}(1, -1, -1, -1)$ and $\rho = \sqrt{\det z/\det s}$,
//!
//! $$ W^{-2} = \rho\\,(2 \bar v \bar v^T - J), \qquad W^{-2} s = z . $$
//!
//! Yu. E. Nesterov, M. J. Todd, Math. Oper. Res. 22 (1997) 1-42, doi:10.1287/moor.22.1.1 (the
//! matrix $W$).

use nalgebra::{Matrix3, Vector3};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair {
    pub head: f64,
    pub tail: Vector3<f64>,
}

impl Pair {
    pub fn new(head: f64, tail: Vector3<f64>) -> Self {
        Self { head, tail }
    }

    pub fn dot(&self, other: &Self) -> f64 {
        self.head * other.head + self.tail.dot(&other.tail)
    }

    pub fn plus(&self, t: f64, other: &Self) -> Self {
        Self { head: self.head + t * other.head, tail: self.tail + other.tail * t }
    }

    /// Positive inside the cone; as a product, without cancellation near its boundary.
    pub fn det(&self) -> f64 {
        let size = self.tail.norm();
        (self.head - size) * (self.head + size)
    }

    pub fn inside(&self) -> bool {
        self.head > 0.0 && self.det() > 0.0
    }

    pub fn product(&self, other: &Self) -> Self {
        Self { head: self.dot(other), tail: other.tail * self.head + self.tail * other.head }
    }

    /// The pair whose product with this one is another.
    pub fn divide(&self, other: &Self) -> Self {
        let head = (self.head * other.head - self.tail.dot(&other.tail)) / self.det();
        Self { head, tail: (other.tail - self.tail * head) / self.head }
    }

    /// How far one can go from here, inside, along a step before the boundary is reached.
    pub fn way(&self, step: &Self) -> f64 {
        // The zeros of the determinant, $a t^2 + 2 b t + c$, by their reciprocals.
        let a = step.det();
        let b = self.head * step.head - self.tail.dot(&step.tail);
        let c = self.det();
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return f64::INFINITY;
        }
        let root = discriminant.sqrt();
        let reciprocal = if b < 0.0 { (root - b) / c } else { -a / (b + root) };
        if reciprocal > 0.0 { reciprocal.recip() } else { f64::INFINITY }
    }
}

/// The matrix $W$ of two pairs inside the cone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scaling {
    /// $\\rho$: the part of $W^{-2}$ across both vectors where they are parallel.
    pub rho: f64,
    v: Pair,
}

impl Scaling {
    pub fn new(z: &Pair, s: &Pair) -> Self {
        let (of_z, of_s) = (z.det().sqrt(), s.det().sqrt());
        let gamma = (0.5 * (1.0 + z.dot(s) / (of_z * of_s))).sqrt();
        let half = 0.5 / gamma;
        let v = Pair::new(
            half * (z.head / of_z + s.head / of_s),
            (z.tail / of_z - s.tail / of_s) * half,
        );
        Self { rho: of_z / of_s, v }
    }

    /// $W^{-2} y$
    pub fn squared_inverse(&self, y: &Pair) -> Pair {
        let along = 2.0 * self.v.dot(y);
        let product = Pair::new(self.v.head * along - y.head, self.v.tail * along + y.tail);
        Pair::new(product.head * self.rho, product.tail * self.rho)
    }

    /// The part of $W^{-2}$ for the vector alone where the number has the compliance `c`: the first
    /// row of $W^{-2}$ is eliminated. Also that row, and what it is divided by.
    pub fn block(&self, c: f64) -> Block {
        let corner = self.rho * (2.0 * self.v.head * self.v.head - 1.0);
        let row = self.v.tail * (2.0 * self.rho * self.v.head);
        let divisor = 1.0 + c * corner;
        let square = self.v.tail * self.v.tail.transpose() * (2.0 * self.rho);
        let stiffness =
            Matrix3::identity() * self.rho + square - row * row.transpose() * (c / divisor);
        Block { stiffness, row, divisor }
    }

    /// $W y$
    pub fn apply(&self, y: &Pair) -> Pair {
        let turned = half_turn(&Pair::new(self.v.head, -self.v.tail), y);
        let scale = self.rho.sqrt().recip();
        Pair::new(turned.head * scale, turned.tail * scale)
    }

    /// $W^{-1} y$
    pub fn apply_inverse(&self, y: &Pair) -> Pair {
        let turned = half_turn(&self.v, y);
        let scale = self.rho.sqrt();
        Pair::new(turned.head * scale, turned.tail * scale)
    }
}

/// What a member puts into the matrix over the places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    pub stiffness: Matrix3<f64>,
    pub row: Vector3<f64>,
    pub divisor: f64,
}

/// The square root of $2 v v^T - J$ times a pair.
fn half_turn(v: &Pair, y: &Pair) -> Pair {
    let along = v.tail.dot(&y.tail);
    let tail = y.tail + v.tail * (y.head + along / (1.0 + v.head));
    Pair::new(v.head * y.head + along, tail)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs() -> [Pair; 2] {
        [Pair::new(2.0, Vector3::new(0.5, -1.0, 1.2)), Pair::new(0.7, Vector3::new(0.1, 0.3, -0.2))]
    }

    fn near(a: &Pair, b: &Pair) -> bool {
        (a.head - b.head).abs() + (a.tail - b.tail).norm() < 1e-13
    }

    #[test]
    fn the_scaling_takes_one_pair_to_the_other() {
        let [z, s] = pairs();
        let w = Scaling::new(&z, &s);
        assert!(near(&w.squared_inverse(&s), &z));
        assert!(near(&w.apply(&z), &w.apply_inverse(&s)));
        assert!(near(&w.apply(&w.apply_inverse(&s)), &s));
        assert!(near(&w.apply_inverse(&w.apply_inverse(&s)), &z));
    }

    #[test]
    fn division_undoes_the_product() {
        let [z, s] = pairs();
        assert!(near(&z.divide(&z.product(&s)), &s));
    }

    /// With the number eliminated by $\Delta s_0 = c\\,\Delta z_0$.
    #[test]
    fn the_block_is_the_matrix_without_the_number() {
        let [z, s] = pairs();
        let (w, c) = (Scaling::new(&z, &s), 0.3);
        let block = w.block(c);
        let u = Vector3::new(0.3, -0.4, 0.9);
        let head = block.row.dot(&u) / block.divisor;
        let tail = block.stiffness * u;
        let check = w.squared_inverse(&Pair::new(-c * head, u));
        assert!(near(&check, &Pair::new(head, tail)));
    }

    #[test]
    fn the_way_ends_at_the_boundary() {
        let [z, s] = pairs();
        for step in [
            Pair::new(-1.0, Vector3::zeros()),
            Pair::new(0.1, Vector3::new(1.0, 2.0, 3.0)),
            Pair::new(-0.5, Vector3::new(0.5, 0.1, 0.0)),
        ] {
            for from in [z, s] {
                let way = from.way(&step);
                assert!(from.plus(0.999 * way, &step).inside());
                assert!(!from.plus(1.001 * way, &step).inside());
            }
        }
        assert!(z.way(&s).is_infinite());
    }
}
