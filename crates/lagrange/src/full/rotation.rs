//! Rotation matrices, eqs. (1)-(5), and the direction of a bar with its derivatives.

use nalgebra::{Matrix3, RealField, Vector3};

/// Matrix of rotation of a bar,
/// $\mathbf{A}_i = \boldsymbol\psi_i\\,\boldsymbol\theta_i\\,\boldsymbol\varphi_i$, from the axes
/// of the bar to the world frame; angles in rad.
///
/// The paper prints two of the entries of (5) with slips: entry (3,1) ends in
/// $s\psi\\,s\varphi$ (printed $s\psi\\,s\theta$), entry (3,3) is $c\psi\\,c\theta$ (printed
/// $c\psi\\,c\varphi$). The product of (2), (3) and (4) decides, and a test multiplies it out.
///
/// Paper, eqs. (1)-(5).
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// // The paper's choice psi = 0, theta = pi/2 puts the bar at phi = 0 on the descending vertical.
/// let a = lagrange::rotation(0.0, FRAC_PI_2, 0.0);
/// assert!((a[(2, 0)] + 1.0_f64).abs() < 1e-15);
/// ```
pub fn rotation<T: RealField + Copy>(psi: T, theta: T, phi: T) -> Matrix3<T> {
    Frame::new([psi, theta, phi]).rotation()
}

/// Direction $u_i = \mathbf{A}_i e_x$ of a bar, from its first joint to its last: the first column
/// of (5).
///
/// ```
/// // The paper's psi = 0, theta = pi/2: phi counts from the descending vertical towards +Y.
/// let u = lagrange::direction(0.0, std::f64::consts::FRAC_PI_2, 0.5_f64);
/// assert!((u.y - 0.5_f64.sin()).abs() < 1e-15 && (u.z + 0.5_f64.cos()).abs() < 1e-15);
/// ```
pub fn direction<T: RealField + Copy>(psi: T, theta: T, phi: T) -> Vector3<T> {
    Frame::new([psi, theta, phi]).direction()
}

/// Derivatives of [`direction`] by the angles: columns
/// $\partial u/\partial\psi,\ \partial u/\partial\theta,\ \partial u/\partial\varphi$.
///
/// Its kernel is the spin of the bar about its own axis; see [`spin`](crate::spin()).
///
/// ```
/// // Along e_x psi turns nothing, theta turns the bar down, phi towards +Y.
/// let gradient = lagrange::direction_gradient(0.0, 0.0, 0.0_f64);
/// assert_eq!(gradient.column(0).norm(), 0.0);
/// assert_eq!((gradient[(2, 1)], gradient[(1, 2)]), (-1.0, 1.0));
/// ```
pub fn direction_gradient<T: RealField + Copy>(psi: T, theta: T, phi: T) -> Matrix3<T> {
    let frame = Frame::new([psi, theta, phi]);
    frame.gradient(&frame.direction())
}

/// Second derivatives of [`direction`] contracted with a vector $F$: the symmetric matrix
/// $F \cdot \partial^2 u / \partial a\\,\partial b$ over $a, b \in \\{\psi, \theta, \varphi\\}$.
///
/// ```
/// use nalgebra::Vector3;
/// // Along e_x the bar is on the axis of psi: only theta and phi turn it.
/// let h = lagrange::direction_hessian(0.0, 0.0, 0.0, &Vector3::new(2.0_f64, 0.0, 0.0));
/// assert_eq!(h, nalgebra::Matrix3::from_diagonal(&Vector3::new(0.0, -2.0, -2.0)));
/// ```
pub fn direction_hessian<T: RealField + Copy>(
    psi: T,
    theta: T,
    phi: T,
    force: &Vector3<T>,
) -> Matrix3<T> {
    let frame = Frame::new([psi, theta, phi]);
    let u = frame.direction();
    frame.hessian(&u, &frame.gradient(&u), force)
}

/// Sines and cosines of the three angles of a bar: everything above is a polynomial in them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame<T> {
    psi: (T, T),
    theta: (T, T),
    phi: (T, T),
}

impl<T: RealField + Copy> Frame<T> {
    pub fn new([psi, theta, phi]: [T; 3]) -> Self {
        Self { psi: psi.sin_cos(), theta: theta.sin_cos(), phi: phi.sin_cos() }
    }

    /// Eq. (5).
    fn rotation(&self) -> Matrix3<T> {
        let ((s_psi, c_psi), (s_th, c_th), (s_phi, c_phi)) = (self.psi, self.theta, self.phi);
        Matrix3::from_columns(&[
            self.direction(),
            Vector3::new(
                -c_th * s_phi,
                -s_psi * s_th * s_phi + c_psi * c_phi,
                c_psi * s_th * s_phi + s_psi * c_phi,
            ),
            Vector3::new(s_th, -s_psi * c_th, c_psi * c_th),
        ])
    }

    /// First column of (5).
    pub fn direction(&self) -> Vector3<T> {
        let ((s_psi, c_psi), (s_th, c_th), (s_phi, c_phi)) = (self.psi, self.theta, self.phi);
        Vector3::new(
            c_th * c_phi,
            s_psi * s_th * c_phi + c_psi * s_phi,
            -c_psi * s_th * c_phi + s_psi * s_phi,
        )
    }

    /// Derivatives of the direction `u` by the angles, as columns.
    pub fn gradient(&self, u: &Vector3<T>) -> Matrix3<T> {
        let ((s_psi, c_psi), (s_th, c_th), (s_phi, c_phi)) = (self.psi, self.theta, self.phi);
        // A turn by psi is a turn about e_x.
        let by_psi = Vector3::new(T::zero(), -u.z, u.y);
        let by_theta = Vector3::new(-s_th, s_psi * c_th, -c_psi * c_th) * c_phi;
        let by_phi = Vector3::new(
            -c_th * s_phi,
            -s_psi * s_th * s_phi + c_psi * c_phi,
            c_psi * s_th * s_phi + s_psi * c_phi,
        );
        Matrix3::from_columns(&[by_psi, by_theta, by_phi])
    }

    /// Second derivatives of the direction `u`, contracted with `force`.
    pub fn hessian(&self, u: &Vector3<T>, gradient: &Matrix3<T>, force: &Vector3<T>) -> Matrix3<T> {
        let ((s_psi, c_psi), (s_th, c_th), (s_phi, c_phi)) = (self.psi, self.theta, self.phi);
        // A derivative by psi is a cross product with e_x.
        let about_x = |y: T, z: T| force.z * y - force.y * z;
        let psi_psi = -(force.y * u.y + force.z * u.z);
        let psi_theta = about_x(gradient[(1, 1)], gradient[(2, 1)]);
        let psi_phi = about_x(gradient[(1, 2)], gradient[(2, 2)]);
        let theta_theta = force.dot(&Vector3::new(-c_th, -s_psi * s_th, c_psi * s_th)) * c_phi;
        let theta_phi = force.dot(&Vector3::new(s_th, -s_psi * c_th, c_psi * c_th)) * s_phi;
        let phi_phi = -force.dot(u);
        Matrix3::from_columns(&[
            Vector3::new(psi_psi, psi_theta, psi_phi),
            Vector3::new(psi_theta, theta_theta, theta_phi),
            Vector3::new(psi_phi, theta_phi, phi_phi),
        ])
    }
    /// Angles of a turn about the bar's own axis; see the module `spin`.
    pub fn spin(&self) -> Vector3<T> {
        let ((s_th, c_th), (s_phi, c_phi)) = (self.theta, self.phi);
        Vector3::new(c_phi, c_th * s_phi, -s_th * c_phi)
    }
}
