//! The elastic catenary in closed form: a heavy cable of constant stiffness between two points.
//!
//! With the horizontal force $H$ and the vertical force $V$ at the upper end, and $W = wL$,
//!
//! $$ x = \\frac{HL}{EA} + \\frac Hw\\Big(\\operatorname{asinh}\\frac VH - \\operatorname{asinh}\\frac{V-W}H\\Big), \\qquad
//!    z = \\frac{L}{EA}\\Big(V - \\frac W2\\Big) + \\frac Hw\\bigg(\\sqrt{1 + \\frac{V^2}{H^2}} -
//!    \\sqrt{1 + \\frac{(V-W)^2}{H^2}}\\bigg) . $$
//!
//! Both are derivatives of a convex function of $(H, V)$, so that Newton's method with halved steps
//! finds them. The module stands by itself: neither solver knows it.
//!
//! # References
//!
//! H. M. Irvine, Cable Structures, MIT Press (1981), section 1.3.

/// A heavy elastic cable between two points.
///
/// ```
/// use validate::field::elastic_catenary::ElasticCatenary;
/// // Level ends, hardly any stretch: 2 H/w asinh(W/2H) = x, here with H = w = 1 and W = 2 sinh(1).
/// let length_m = 2.0 * 1.0_f64.sinh();
/// let cable = ElasticCatenary { x_m: 2.0, z_m: 0.0, length_m, stiffness_n: 1e15, weight_n_m: 1.0 };
/// let forces = cable.solve().unwrap();
/// assert!((forces.horizontal_n - 1.0).abs() < 1e-12);
/// assert!((forces.sag_m(&cable) - (1.0_f64.cosh() - 1.0)).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticCatenary {
    /// Horizontal distance of the upper end from the lower, m; positive.
    pub x_m: f64,
    /// Height of the upper end above the lower, m; zero or positive.
    pub z_m: f64,
    /// Unstretched length, m.
    pub length_m: f64,
    /// Axial stiffness EA, N.
    pub stiffness_n: f64,
    /// Weight per unstretched length, N/m; positive.
    pub weight_n_m: f64,
}

/// The forces at its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndForces {
    /// Horizontal force, N, the same all along.
    pub horizontal_n: f64,
    /// Vertical force of the upper support on the cable, upwards, N.
    pub upper_n: f64,
    /// Vertical force of the lower support on the cable, upwards, N: the weight less that of the
    /// upper.
    pub lower_n: f64,
}

/// Steps of Newton's method; it takes some ten.
const STEPS: usize = 200;
/// Halvings of a step before rounding is all that is left.
const HALVINGS: i32 = 50;
/// How far the upper end may be off at the last step, in units of the length: far above the
/// rounding of the two functions, and far below what a wrong branch would leave.
const CLOSED: f64 = 1e-12;

/// `asinh a − asinh b` without cancellation, from `a − b`.
fn asinh_difference(a: f64, b: f64, difference: f64) -> f64 {
    if a + b < 0.0 {
        // asinh is odd.
        return asinh_difference(-b, -a, difference);
    }
    if b <= 0.0 {
        return a.asinh() - b.asinh();
    }
    ((difference + root_difference(a, b, difference)) / (b + b.hypot(1.0))).ln_1p()
}

/// `√(1 + a²) − √(1 + b²)` without cancellation, from `a − b`.
fn root_difference(a: f64, b: f64, difference: f64) -> f64 {
    difference * (a + b) / (a.hypot(1.0) + b.hypot(1.0))
}

impl ElasticCatenary {
    /// Where the upper end is under these forces, m.
    fn end_m(&self, [h, v]: [f64; 2]) -> [f64; 2] {
        let Self { length_m, stiffness_n, weight_n_m, .. } = *self;
        let weight_n = weight_n_m * length_m;
        let (a, b, difference) = (v / h, (v - weight_n) / h, weight_n / h);
        let stretch = length_m / stiffness_n;
        [
            h * stretch + h / weight_n_m * asinh_difference(a, b, difference),
            (v - 0.5 * weight_n) * stretch + h / weight_n_m * root_difference(a, b, difference),
        ]
    }

    /// The flexibility: `∂x/∂H`, `∂x/∂V = ∂z/∂H`, `∂z/∂V`.
    fn flexibility(&self, [h, v]: [f64; 2]) -> [f64; 3] {
        let Self { length_m, stiffness_n, weight_n_m, .. } = *self;
        let weight_n = weight_n_m * length_m;
        let (a, b, difference) = (v / h, (v - weight_n) / h, weight_n / h);
        let (cos_a, cos_b) = (1.0 / a.hypot(1.0), 1.0 / b.hypot(1.0));
        // a/√(1+a²) − b/√(1+b²) = (a² − b²)/((1+a²)(1+b²)) over the sum of the two, where they have
        // one sign.
        let sines = if a * b > 0.0 {
            let (sin_a, sin_b) = (a * cos_a, b * cos_b);
            difference * (a + b) * (cos_a * cos_b).powi(2) / (sin_a + sin_b)
        } else {
            a * cos_a - b * cos_b
        };
        let stretch = length_m / stiffness_n;
        let cosines = -root_difference(a, b, difference) * cos_a * cos_b;
        [
            stretch + (asinh_difference(a, b, difference) - sines) / weight_n_m,
            cosines / weight_n_m,
            stretch + sines / weight_n_m,
        ]
    }

    /// A start: Irvine's parabola, as mooring programs have it.
    fn start(&self) -> [f64; 2] {
        let Self { x_m, z_m, length_m, weight_n_m, .. } = *self;
        let slack = (length_m * length_m - z_m * z_m) / (x_m * x_m) - 1.0;
        // A taut cable has no parabola.
        let lambda = if slack > 0.0 { (3.0 * slack).sqrt() } else { 0.2 };
        let horizontal = weight_n_m * x_m / (2.0 * lambda);
        [horizontal, 0.5 * weight_n_m * (z_m / lambda.tanh() + length_m)]
    }

    /// The forces; nothing where Newton's method does not end, or a number is out of range.
    pub fn solve(&self) -> Option<EndForces> {
        let positive = [self.x_m, self.length_m, self.stiffness_n, self.weight_n_m];
        if positive.iter().any(|x| !(x.is_finite() && *x > 0.0))
            || self.z_m.is_nan()
            || self.z_m < 0.0
        {
            return None;
        }
        let misfit = |force: [f64; 2]| {
            let [x, z] = self.end_m(force);
            [x - self.x_m, z - self.z_m]
        };
        let mut force = self.start();
        for _ in 0..STEPS {
            let left = misfit(force);
            let [xx, xz, zz] = self.flexibility(force);
            let determinant = xx * zz - xz * xz;
            let step = [
                (xz * left[1] - zz * left[0]) / determinant,
                (xz * left[0] - xx * left[1]) / determinant,
            ];
            let size = |v: [f64; 2]| v[0].hypot(v[1]);
            let moved = |part: f64| [force[0] + part * step[0], force[1] + part * step[1]];
            // Halved until the horizontal force stays positive and the end comes nearer.
            let nearer =
                |part: &f64| moved(*part)[0] > 0.0 && size(misfit(moved(*part))) < size(left);
            let Some(part) = (0..HALVINGS).map(|k| 0.5_f64.powi(k)).find(nearer) else {
                let [horizontal_n, upper_n] = force;
                let lower_n = self.weight_n_m * self.length_m - upper_n;
                let closed = size(left) <= CLOSED * self.length_m;
                return closed.then_some(EndForces { horizontal_n, upper_n, lower_n });
            };
            force = moved(part);
        }
        None
    }
}

/// A cable whose lower part lies on a floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnFloor {
    /// The forces at its ends; the lower end is drawn level.
    pub ends: EndForces,
    /// Unstretched length of the part that lies, m.
    pub lies_m: f64,
}

impl ElasticCatenary {
    /// The cable with its lower end on a level floor without friction, on which its lower part
    /// lies. The part $V/w$ hangs, with $\\operatorname{asinh}(V/H)$ as above, and $H$ stretches
    /// all of it:
    ///
    /// $$ z = \\frac Hw\\Big(\\sqrt{1 + V^2/H^2} - 1\\Big) + \\frac{V^2}{2 w\\,EA}, \\qquad
    ///    x = L - \\frac Vw + \\frac{HL}{EA} + \\frac Hw \\operatorname{asinh}\\frac VH . $$
    ///
    /// Nothing where no part lies, or a number is out of range. Source: J. M. J. Journée and
    /// W. W. Massie, Offshore Hydromechanics, TU Delft (2001), chapter on mooring; the rigid limit
    /// is $(V/w)^2 = z^2 + 2 z H/w$.
    ///
    /// ```
    /// use validate::field::elastic_catenary::ElasticCatenary;
    /// // Hardly any stretch, H = w = 1: cosh u - 1 = 1 m of height, 3 m lie.
    /// let u = 2.0_f64.acosh();
    /// let (x_m, length_m) = (3.0 + u, 3.0 + u.sinh());
    /// let cable = ElasticCatenary { x_m, z_m: 1.0, length_m, stiffness_n: 1e15, weight_n_m: 1.0 };
    /// let found = cable.solve_on_floor().unwrap();
    /// assert!((found.ends.horizontal_n - 1.0).abs() < 1e-9 && (found.lies_m - 3.0).abs() < 1e-9);
    /// ```
    pub fn solve_on_floor(&self) -> Option<OnFloor> {
        let Self { x_m, z_m, length_m, stiffness_n, weight_n_m } = *self;
        let numbers = [x_m, z_m, length_m, stiffness_n, weight_n_m];
        if numbers.iter().any(|x| !(x.is_finite() && *x > 0.0)) {
            return None;
        }
        let weight_n = weight_n_m * length_m;
        // Both functions rise: with the force that hangs at H, and with H where that force is V.
        let height = |h: f64, v: f64| {
            (v.hypot(h) - h) / weight_n_m + v * v / (2.0 * weight_n_m * stiffness_n)
        };
        let hanging = |h: f64| bisect([0.0, weight_n], |v| height(h, v) - z_m);
        let width = |h: f64, v: f64| {
            length_m * (1.0 + h / stiffness_n) - v / weight_n_m + h / weight_n_m * (v / h).asinh()
        };
        // All of it hangs, and the lower end is level, where √(W² + H²) = H + w z', with z' without
        // the stretch. Where the stretch alone is as high a part lies whatever the force, and the end
        // is beyond x where H stretches the length by that.
        let taut_n = weight_n_m * z_m - weight_n * weight_n / (2.0 * stiffness_n);
        let most = if taut_n > 0.0 {
            (weight_n - taut_n) * (weight_n + taut_n) / (2.0 * taut_n)
        } else {
            stiffness_n * x_m / length_m
        };
        if most <= 0.0 {
            return None;
        }
        let span = |h: f64| hanging(h).map_or(f64::NAN, |v| width(h, v) - x_m);
        let horizontal_n = bisect([f64::EPSILON * most, most * (1.0 - f64::EPSILON)], span)?;
        let upper_n = hanging(horizontal_n)?;
        let ends = EndForces { horizontal_n, upper_n, lower_n: 0.0 };
        Some(OnFloor { ends, lies_m: length_m - upper_n / weight_n_m })
    }
}

/// A zero of a rising function between two places, to rounding; nothing where the signs at both are
/// one.
fn bisect([mut low, mut high]: [f64; 2], rises: impl Fn(f64) -> f64) -> Option<f64> {
    if rises(low) > 0.0 || rises(high) < 0.0 {
        return None;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Some(low);
        }
        if rises(middle) > 0.0 { high = middle } else { low = middle }
    }
}

impl EndForces {
    /// How far the lowest point of the cable is below its lower end, m; 0 where that end is the
    /// lowest.
    pub fn sag_m(&self, cable: &ElasticCatenary) -> f64 {
        let ElasticCatenary { stiffness_n, weight_n_m, .. } = *cable;
        if self.lower_n <= 0.0 {
            return 0.0;
        }
        let (h, v) = (self.horizontal_n, self.lower_n);
        // The part of the cable whose weight the lower end bears, up to where it is level.
        0.5 * v * v / (weight_n_m * stiffness_n) + h / weight_n_m * ((v / h).hypot(1.0) - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{ElasticCatenary, EndForces, asinh_difference, bisect, root_difference};

    fn cable([x_m, z_m, length_m, stiffness_n, weight_n_m]: [f64; 5]) -> ElasticCatenary {
        ElasticCatenary { x_m, z_m, length_m, stiffness_n, weight_n_m }
    }

    /// The near-taut line of MoorPy's table, to the digits of an evaluation in extended precision.
    #[test]
    fn a_nearly_taut_line_to_its_digits() {
        let cable = cable([
            246.224_209_400_329_47, 263.557_663_308_431_64, 360.635_662_623_969_27, 700e6, 3.087_35,
        ]);
        let found = cable.solve().unwrap();
        // The inputs are rounded to 17 digits, and the force of a nearly taut line has lost seven
        // of them.
        for (value, wanted) in [
            (found.horizontal_n, 58_377.241_422_650),
            (found.upper_n, 63_044.412_955_917),
            (-found.lower_n, 61_931.004_442_948),
        ] {
            assert!((value / wanted - 1.0).abs() < 1e-9, "{value} {wanted}");
        }
        assert!((found.upper_n + found.lower_n - 3.087_35 * 360.635_662_623_969_27).abs() < 1e-9);
    }

    #[test]
    fn differences_keep_their_digits() {
        for (b, difference) in
            [(0.5, 1e-9), (-0.5, 1e-9), (-1e-3, 2e-3), (2.0, 1.0), (-3.0, 1.0), (-1e3, 1e-12)]
        {
            let a = b + difference;
            let found = asinh_difference(a, b, difference);
            // By the mean value; its second derivative is below 1/2.
            let middle = 0.5_f64.mul_add(difference, b);
            let wanted = difference / middle.hypot(1.0);
            assert!(
                (found - wanted).abs() <= 0.1 * difference.powi(3) + 1e-15 * difference.max(0.1),
                "{b}"
            );
        }
    }

    /// Irvine's parabola: `λ² = 3 ((L² - z²)/x² - 1)`, `H = w x/2λ`, `V = w (z coth λ + L)/2`.
    #[test]
    fn the_start_is_that_of_the_parabola() {
        let cable = cable([2.0, 3.0, 5.0, 1e9, 6.0]);
        let [h, v] = cable.start();
        assert!((h - 2.0).abs() < 1e-14, "{h}");
        let (up, down) = (3.0_f64.exp(), (-3.0_f64).exp());
        assert!((v - 3.0 * (3.0 * (up + down) / (up - down) + 5.0)).abs() < 1e-13, "{v}");
        // Drawn straight there is no sag, and λ is taken to be 0.2.
        let [h, v] = ElasticCatenary { x_m: 4.0, ..cable }.start();
        let (up, down) = (0.2_f64.exp(), (-0.2_f64).exp());
        assert!((h - 60.0).abs() < 1e-12, "{h}");
        assert!((v - 3.0 * (3.0 * (up + down) / (up - down) + 5.0)).abs() < 1e-12, "{v}");
    }

    /// Forces first: with 2 N and 3 N at the upper end of 10 m of 1 N/m, 7 m lie, and 50 N of
    /// stiffness add `V²/2wEA` to the height and `HL/EA` to the width. Weights and stiffness times
    /// a power of two are forces times that, however small.
    #[test]
    fn a_cable_that_stretches_on_a_floor_has_the_forces_it_was_made_with() {
        let (h, v) = (2.0_f64, 3.0_f64);
        let z_m = (h * h + v * v).sqrt() - h + v * v / 100.0;
        let slope = v / h;
        let asinh = (slope + (slope * slope + 1.0).sqrt()).ln();
        let x_m = 7.0 + h * 10.0 / 50.0 + h * asinh;
        for scale in [1.0, 2.0_f64.powi(-60), 2.0_f64.powi(60)] {
            let (stiffness_n, weight_n_m) = (50.0 * scale, scale);
            let cable = ElasticCatenary { x_m, z_m, length_m: 10.0, stiffness_n, weight_n_m };
            let found = cable.solve_on_floor().unwrap();
            assert!((found.ends.horizontal_n / scale - h).abs() < 1e-12, "{scale}: {found:?}");
            assert!((found.ends.upper_n / scale - v).abs() < 1e-12, "{scale}: {found:?}");
            assert!((found.lies_m - 7.0).abs() < 1e-12, "{scale}: {found:?}");
        }
    }

    #[test]
    fn what_is_no_cable_has_no_forces() {
        let cable = cable([1.0, 0.0, 2.0, 1.0, 1.0]);
        assert!(cable.solve().is_some());
        for wrong in [
            ElasticCatenary { x_m: 0.0, ..cable },
            ElasticCatenary { z_m: -1.0, ..cable },
            ElasticCatenary { length_m: f64::NAN, ..cable },
            ElasticCatenary { weight_n_m: 0.0, ..cable },
            ElasticCatenary { stiffness_n: f64::INFINITY, ..cable },
        ] {
            assert_eq!(wrong.solve(), None, "{wrong:?}");
        }
    }

    /// Of 1 N/m: hardly anything lies, 3 N of 3.05 N hang; half a metre of 1/10 N, which its own weight
    /// alone would stretch by more than that: 0.12 N of it hang; and a cable that hardly stretches.
    #[test]
    fn cables_nearly_lifted_and_very_soft_ones_lie_as_they_were_made() {
        for (length_m, stiffness_n, h, v) in
            [(3.05, 50.0, 2.0, 3.0), (0.5, 0.1, 0.2, 0.12), (10.0, 1e9, 2.0, 3.0)]
        {
            let slope: f64 = v / h;
            let z_m = f64::hypot(h, v) - h + v * v / (2.0 * stiffness_n);
            let x_m = length_m - v + h * length_m / stiffness_n + h * slope.asinh();
            let cable = ElasticCatenary { x_m, z_m, length_m, stiffness_n, weight_n_m: 1.0 };
            let found = cable.solve_on_floor().unwrap();
            assert!((found.ends.horizontal_n / h - 1.0).abs() < 1e-12, "{found:?}");
            assert!((found.ends.upper_n / v - 1.0).abs() < 1e-12, "{found:?}");
            assert!((found.lies_m - (length_m - v)).abs() < 1e-12, "{found:?}");
        }
        // Too short to reach the floor.
        let short = cable([1.0, 5.0, 3.0, 1e9, 1.0]);
        assert_eq!(short.solve_on_floor(), None);
        let fine = ElasticCatenary { z_m: 1.0, x_m: 2.5, ..short };
        assert!(fine.solve_on_floor().is_some());
        for wrong in [
            ElasticCatenary { z_m: 0.0, x_m: 3.5, ..fine },
            ElasticCatenary { stiffness_n: f64::INFINITY, ..fine },
            ElasticCatenary { length_m: f64::NAN, ..fine },
            ElasticCatenary { weight_n_m: -1.0, ..fine },
        ] {
            assert_eq!(wrong.solve_on_floor(), None, "{wrong:?}");
        }
    }

    /// `12 N` across, and slopes of 3/4 at the upper end and ±5/12 at the lower: roots of 5/4 and
    /// 13/12, inverse sines of `ln 2` and `ln 3/2`. Mirrored, the slopes and heights change sign.
    #[test]
    fn ends_and_flexibilities_are_those_of_the_closed_form() {
        let (ln2, ln3) = (2.0_f64.ln(), 3.0_f64.ln());
        let cable = |length_m: f64| ElasticCatenary {
            x_m: 1.0,
            z_m: 1.0,
            length_m,
            // The stretch is 1/4 m/N.
            stiffness_n: 4.0 * length_m,
            weight_n_m: 2.0,
        };
        // 14 N between +9 N and -5 N; 4 N between 9 and 5 N; and between -5 N and -9 N.
        let cases = [
            (7.0, 9.0, 3.0 + 6.0 * ln3, 0.5 + 1.0, ln3, 64.0 / 65.0, -8.0 / 65.0),
            (
                2.0,
                9.0,
                3.0 + 6.0 * (2.0 * ln2 - ln3),
                2.75,
                2.0 * ln2 - ln3,
                14.0 / 65.0,
                -8.0 / 65.0,
            ),
            (
                2.0,
                -5.0,
                3.0 + 6.0 * (2.0 * ln2 - ln3),
                -2.75,
                2.0 * ln2 - ln3,
                14.0 / 65.0,
                8.0 / 65.0,
            ),
        ];
        for (length_m, v, x, z, angles, sines, cosines) in cases {
            let cable = cable(length_m);
            let close = |found: f64, wanted: f64| {
                assert!(
                    (found - wanted).abs() < 1e-14 * wanted.abs().max(1.0),
                    "{v}: {found} {wanted}"
                );
            };
            let end = cable.end_m([12.0, v]);
            close(end[0], x);
            close(end[1], z);
            let [xx, xz, zz] = cable.flexibility([12.0, v]);
            close(xx, 0.25 + 0.5 * (angles - sines));
            close(xz, 0.5 * cosines);
            close(zz, 0.25 + 0.5 * sines);
        }
        assert!((root_difference(0.75, 5.0 / 12.0, 1.0 / 3.0) - 1.0 / 6.0).abs() < 1e-15);
        assert!((asinh_difference(0.75, 0.0, 0.75) - ln2).abs() < 1e-15);
        assert!((asinh_difference(0.0, -0.75, 0.75) - ln2).abs() < 1e-15);
    }

    /// A lower end that bears 9 N of 12 N across: 9/2 m of 2 N/m below it, `81/(2 · 2 · 27)` of them
    /// stretch and `6 (5/4 - 1)` hang.
    #[test]
    fn the_sag_is_that_of_what_the_lower_end_bears() {
        let cable = cable([1.0, 0.0, 10.0, 27.0, 2.0]);
        let sag =
            |lower_n: f64| EndForces { horizontal_n: 12.0, upper_n: 1.0, lower_n }.sag_m(&cable);
        assert!((sag(9.0) - (0.75 + 1.5)).abs() < 1e-15);
        assert_eq!(sag(0.0).to_bits(), 0);
        assert_eq!(sag(-9.0).to_bits(), 0);
    }

    #[test]
    fn a_zero_is_found_where_the_signs_differ() {
        let found = bisect([0.0, 3.0], |x| x * x - 2.0).unwrap();
        assert!((found - 2.0_f64.sqrt()).abs() <= 2.0 * f64::EPSILON, "{found}");
        // At an end, too.
        assert!(bisect([0.0, 3.0], |x| x).is_some_and(|x| x.abs() < 1e-300));
        assert!(bisect([0.0, 3.0], |x| x - 3.0).is_some_and(|x| (x - 3.0).abs() < 1e-15));
        assert_eq!(bisect([0.0, 3.0], |x| x + 1.0), None);
        assert_eq!(bisect([0.0, 3.0], |x| x - 4.0), None);
    }
}
