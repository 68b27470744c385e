//! Points of integration with their weights, those that the specs of the elements name.

pub use crate::textbook::Point;

/// Four points of a tetrahedron, exact to degree 2.
pub mod tet_4 {
    use super::Point;

    /// How many.
    pub const POINTS: usize = 4;

    /// Each of them.
    pub fn points() -> Vec<Point> {
        let root = 5.0_f64.sqrt();
        super::around((5.0 - root) / 20.0, (5.0 + 3.0 * root) / 20.0, 1.0 / 24.0).to_vec()
    }
}

/// Fifteen points of a tetrahedron, exact to degree 5 (Keast).
pub mod tet_15 {
    use super::Point;

    /// How many.
    pub const POINTS: usize = 15;

    /// Each of them.
    pub fn points() -> Vec<Point> {
        let root = 15.0_f64.sqrt();
        let mut points = vec![([0.25; 3], 8.0 / 405.0)];
        for sign in [-1.0, 1.0] {
            let (near, far) = ((7.0 + sign * root) / 34.0, (13.0 - 3.0 * sign * root) / 34.0);
            points.extend(super::around(near, far, (2665.0 - 14.0 * sign * root) / 226_800.0));
        }
        let [low, high] = [-1.0, 1.0].map(|sign| (5.0 + sign * root) / 20.0);
        for pick in 1..7 {
            let x = [0, 1, 2].map(|i| if pick >> i & 1 == 0 { low } else { high });
            points.push((x, 5.0 / 567.0));
        }
        points
    }
}

/// Six points of the triangle times three along the axis, exact to degree 4.
pub mod wedge_18 {
    use super::Point;

    /// How many.
    pub const POINTS: usize = 18;

    /// Each of them.
    pub fn points() -> Vec<Point> {
        // Dunavant's second rule: two orbits of three points.
        let ten = 10.0_f64.sqrt();
        let (spread, turn) =
            ((38.0 - 44.0 * 0.4_f64.sqrt()).sqrt(), (213_125.0 - 53_320.0 * ten).sqrt());
        let mut points = Vec::new();
        for sign in [1.0, -1.0] {
            let near = (8.0 - ten + sign * spread) / 18.0;
            let weight = 0.5 * (620.0 + sign * turn) / 3720.0;
            let far = 1.0 - 2.0 * near;
            for [xi, eta] in [[near, near], [far, near], [near, far]] {
                for (zeta, along) in super::gauss_3() {
                    points.push(([xi, eta, zeta], weight * along));
                }
            }
        }
        points
    }
}

/// Three Gauss points along each axis, exact to degree 5.
pub mod hex_27 {
    use super::Point;

    /// How many.
    pub const POINTS: usize = 27;

    /// Each of them.
    pub fn points() -> Vec<Point> {
        let mut points = Vec::new();
        for (xi, first) in super::gauss_3() {
            for (eta, second) in super::gauss_3() {
                for (zeta, third) in super::gauss_3() {
                    points.push(([xi, eta, zeta], first * second * third));
                }
            }
        }
        points
    }
}

fn gauss_3() -> [(f64, f64); 3] {
    let far = 0.6_f64.sqrt();
    [(-far, 5.0 / 9.0), (0.0, 8.0 / 9.0), (far, 5.0 / 9.0)]
}

/// Points of a tetrahedron with one volume coordinate `far` and three `near`.
fn around(near: f64, far: f64, weight: f64) -> [Point; 4] {
    [[near; 3], [far, near, near], [near, far, near], [near, near, far]].map(|x| (x, weight))
}
