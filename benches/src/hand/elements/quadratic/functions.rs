//! The functions of quadratic elements and their slopes, differentiated by hand.

use super::super::space::Vector;

/// Corners, then the middles of the edges.
pub(in super::super) const TET10_NODES: [Vector; 10] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.0, 0.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.0],
    [0.0, 0.0, 0.5],
    [0.5, 0.0, 0.5],
    [0.0, 0.5, 0.5],
];

/// L(2L − 1) at corners, 4 LₐL_b on edges, with the volume coordinates L.
pub(in super::super) fn tet10(x: Vector, values: &mut [f64], slopes: &mut [Vector]) {
    const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
    const ALONG: [Vector; 4] =
        [[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let l = [1.0 - x[0] - x[1] - x[2], x[0], x[1], x[2]];
    for a in 0..4 {
        values[a] = l[a] * (2.0 * l[a] - 1.0);
        slopes[a] = ALONG[a].map(|own| own * (4.0 * l[a] - 1.0));
    }
    for (edge, [a, b]) in EDGES.into_iter().enumerate() {
        values[4 + edge] = 4.0 * l[a] * l[b];
        slopes[4 + edge] = [0, 1, 2].map(|i| 4.0 * (l[a] * ALONG[b][i] + l[b] * ALONG[a][i]));
    }
}

/// Corners, then the middles of the edges: below, above, upright.
pub(in super::super) const WEDGE15_NODES: [Vector; 15] = [
    [0.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.5, 0.0, -1.0],
    [0.5, 0.5, -1.0],
    [0.0, 0.5, -1.0],
    [0.5, 0.0, 1.0],
    [0.5, 0.5, 1.0],
    [0.0, 0.5, 1.0],
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
];

/// With the area coordinates L: ½ L(1 ± ζ)(2L − 2 ± ζ) at corners, 2 LₐL_b(1 ± ζ) below and above, L(1 − ζ²) upright.
pub(in super::super) fn wedge15(x: Vector, values: &mut [f64], slopes: &mut [Vector]) {
    const ALONG: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let (l, zeta) = ([1.0 - x[0] - x[1], x[0], x[1]], x[2]);
    for (end, sign) in [-1.0, 1.0].into_iter().enumerate() {
        let rise = 1.0 + sign * zeta;
        for a in 0..3 {
            let rest = 2.0 * l[a] - 2.0 + sign * zeta;
            let by_l = 0.5 * rise * (rest + 2.0 * l[a]);
            let corner = 3 * end + a;
            values[corner] = 0.5 * l[a] * rise * rest;
            slopes[corner] =
                [by_l * ALONG[a][0], by_l * ALONG[a][1], 0.5 * sign * l[a] * (rest + rise)];
            let b = (a + 1) % 3;
            let edge = 6 + 3 * end + a;
            let flat = [0, 1].map(|i| l[a] * ALONG[b][i] + l[b] * ALONG[a][i]);
            values[edge] = 2.0 * l[a] * l[b] * rise;
            slopes[edge] = [2.0 * rise * flat[0], 2.0 * rise * flat[1], 2.0 * sign * l[a] * l[b]];
        }
    }
    for a in 0..3 {
        let bubble = 1.0 - zeta * zeta;
        values[12 + a] = l[a] * bubble;
        slopes[12 + a] = [ALONG[a][0] * bubble, ALONG[a][1] * bubble, -2.0 * zeta * l[a]];
    }
}

/// Corners, then the middles of the edges: below, above, upright.
pub(in super::super) const HEX20_NODES: [Vector; 20] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
];

/// With f = 1 + xₐx along each axis: ⅛ f₀f₁f₂ (Σxₐx − 2) at corners; on an edge 1 − x² in place of the f along it, and ¼.
pub(in super::super) fn hex20(x: Vector, values: &mut [f64], slopes: &mut [Vector]) {
    for (a, node) in HEX20_NODES.iter().enumerate() {
        let along = node.iter().position(|own| *own == 0.0);
        let is_along = |i: usize| along == Some(i);
        let f =
            [0, 1, 2].map(|i| if is_along(i) { 1.0 - x[i] * x[i] } else { 1.0 + node[i] * x[i] });
        let d = [0, 1, 2].map(|i| if is_along(i) { -2.0 * x[i] } else { node[i] });
        let product = f[0] * f[1] * f[2];
        let slope = [d[0] * f[1] * f[2], f[0] * d[1] * f[2], f[0] * f[1] * d[2]];
        if along.is_some() {
            values[a] = product / 4.0;
            slopes[a] = slope.map(|own| own / 4.0);
        } else {
            let rest = node[0] * x[0] + node[1] * x[1] + node[2] * x[2] - 2.0;
            values[a] = product * rest / 8.0;
            slopes[a] = [0, 1, 2].map(|i| (slope[i] * rest + product * node[i]) / 8.0);
        }
    }
}
