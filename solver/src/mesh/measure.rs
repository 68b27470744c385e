//! Circles, radii and sections measured from nodes.

use std::f64::consts::TAU;

/// What is nearer to the outermost point of a rim than this part of its radius may be of it, and rounds until it is known.
const RIM: f64 = 0.03;
const RIMS: usize = 30;
/// Points of a rim at least, the widest angle between two (rad), and how far they may be off its circle, in radii.
const LEAST: usize = 8;
const WIDEST: f64 = 1.6;
const ROUND: f64 = 2e-3;

/// A circle through points of a plane, as near to them as can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Its centre (m).
    pub centre: [f64; 2],
    /// Its radius (m).
    pub radius: f64,
    /// The largest distance of a point from it (m).
    pub deviation: f64,
}

/// The circle that makes Σ (|p − centre|² − radius²)² least (Kåsa, IEEE Trans. Instrum. Meas. 25 (1976)
/// 8–14): exact for points on a circle, however unevenly they are spaced. `None` for points on a line.
pub fn circle(points: &[[f64; 2]]) -> Option<Circle> {
    let count = points.len() as f64;
    let mean = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count);
    let offsets: Vec<[f64; 2]> = points.iter().map(|p| [p[0] - mean[0], p[1] - mean[1]]).collect();
    let sum = |term: fn(f64, f64) -> f64| offsets.iter().map(|&[u, v]| term(u, v)).sum::<f64>();
    let (uu, uv, vv) = (sum(|u, _| u * u), sum(|u, v| u * v), sum(|_, v| v * v));
    let right = [0.5 * sum(|u, v| u * (u * u + v * v)), 0.5 * sum(|u, v| v * (u * u + v * v))];
    let determinant = uu * vv - uv * uv;
    // The points' smaller extent over their larger one, squared: below rounding they are on a line.
    if !(determinant > 1e-12 * (uu + vv) * (uu + vv)) {
        return None;
    }
    let offset = [
        (right[0] * vv - right[1] * uv) / determinant,
        (right[1] * uu - right[0] * uv) / determinant,
    ];
    let radius = (offset[0].powi(2) + offset[1].powi(2) + (uu + vv) / count).sqrt();
    let distance = |&[u, v]: &[f64; 2]| (u - offset[0]).hypot(v - offset[1]);
    let deviation = offsets.iter().map(|p| (distance(p) - radius).abs()).fold(0.0, f64::max);
    Some(Circle { centre: [mean[0] + offset[0], mean[1] + offset[1]], radius, deviation })
}

/// The circle on which the outermost of some points stand all around, as those of a journal or of the end of a shaft do, with or
/// without points inside; `None` where they do not: on one side alone, on a square, or fewer than eight.
pub fn rim(points: &[[f64; 2]]) -> Option<Circle> {
    let away =
        |circle: &Circle, [x, y]: &[f64; 2]| (x - circle.centre[0]).hypot(y - circle.centre[1]);
    let mut own = points.to_vec();
    let mut found = circle(&own)?;
    for _ in 0..RIMS {
        let reach = points.iter().map(|point| away(&found, point)).fold(0.0, f64::max);
        let is_outside = |point: &&[f64; 2]| away(&found, point) >= (1.0 - RIM) * reach;
        let next: Vec<[f64; 2]> = points.iter().filter(is_outside).copied().collect();
        let is_same = next.len() == own.len();
        own = next;
        found = circle(&own)?;
        if is_same {
            break;
        }
    }
    let mut angles: Vec<f64> =
        own.iter().map(|[x, y]| (y - found.centre[1]).atan2(x - found.centre[0])).collect();
    angles.sort_by(f64::total_cmp);
    let last = angles.last()? - TAU;
    let before = std::iter::once(last).chain(angles.iter().copied());
    let widest = before.zip(&angles).map(|(a, b)| b - a).fold(0.0, f64::max);
    (own.len() >= LEAST && widest < WIDEST && found.deviation <= ROUND * found.radius)
        .then_some(found)
}

/// Radius of the full circle with the radius of gyration of the points' convex hull, √(2 I_p/A).
///
/// A round section meshed by a polygon of n corners on its circle is smaller than the circle by the factor
/// √((2 + cos 2π/n)/3), so that this is never more than the radius of the shaft that the mesh stands for.
/// `None` for points on a line.
pub fn section_radius(points: &[[f64; 2]]) -> Option<f64> {
    let hull = convex_hull(points);
    let (mut area, mut polar, mut first) = (0.0, 0.0, [0.0; 2]);
    for (place, &[x, y]) in hull.iter().enumerate() {
        let [next_x, next_y] = hull[(place + 1) % hull.len()];
        let cross = x * next_y - next_x * y;
        area += 0.5 * cross;
        polar += cross * (x * x + x * next_x + next_x * next_x) / 12.0;
        polar += cross * (y * y + y * next_y + next_y * next_y) / 12.0;
        first[0] += cross * (x + next_x) / 6.0;
        first[1] += cross * (y + next_y) / 6.0;
    }
    let central = polar - (first[0].powi(2) + first[1].powi(2)) / area;
    (area > 0.0 && central > 0.0).then(|| (2.0 * central / area).sqrt())
}

/// Mean distance of points of a plane from its origin (m): the radius of a bore whose nodes they are. NaN of no points.
pub fn mean_radius(points: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (sum, count) =
        points.fold((0.0, 0.0), |(sum, count), [x, y]| (sum + f64::hypot(x, y), count + 1.0));
    sum / count
}

/// Corners of the convex hull, anticlockwise (Andrew, Inf. Process. Lett. 9 (1979) 216–219).
fn convex_hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let turns_left = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let half = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for &point in points {
            while chain.len() > 1
                && !turns_left(chain[chain.len() - 2], chain[chain.len() - 1], point)
            {
                chain.pop();
            }
            chain.push(point);
        }
        // The last one begins the other half.
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter());
    hull.extend(half(&mut sorted.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(centre: [f64; 2], radius: f64, angles: &[f64]) -> Vec<[f64; 2]> {
        angles
            .iter()
            .map(|a| [centre[0] + radius * a.cos(), centre[1] + radius * a.sin()])
            .collect()
    }

    #[test]
    fn a_circle_is_found_from_nodes_on_an_arc_of_it() {
        let circle = circle(&around([3e-3, -1e-3], 0.034, &[0.1, 0.3, 0.35, 1.9])).unwrap();
        for (found, known) in circle.centre.into_iter().zip([3e-3, -1e-3]) {
            // Rounding of the products over the smallness of the arc.
            assert!((found - known).abs() < 1e-14, "{circle:?}");
        }
        assert!((circle.radius - 0.034).abs() < 1e-14 && circle.deviation < 1e-14);
    }

    #[test]
    fn a_rim_is_found_around_what_is_inside_and_not_on_one_side_of_it() {
        let all = |count: u32| -> Vec<f64> {
            (0..count).map(|k| TAU * f64::from(k) / f64::from(count)).collect()
        };
        let centre = [3e-3, -1e-3];
        let disc: Vec<[f64; 2]> = (1..=6)
            .flat_map(|k| around(centre, 0.012 / 6.0 * f64::from(k), &all(6 * k)))
            .chain([[3.5e-3, 4e-3], [9e-3, 1e-3]])
            .collect();
        let found = rim(&disc).expect("a rim");
        assert!((found.radius - 0.012).abs() < 1e-12, "{found:?}");
        assert!((found.centre[0] - 3e-3).hypot(found.centre[1] + 1e-3) < 1e-12, "{found:?}");
        // Twelve points on a half of it, four all around, and a square.
        assert_eq!(rim(&around(centre, 0.012, &all(24)[..12])), None);
        assert_eq!(rim(&around(centre, 0.012, &all(4))), None);
        let square: Vec<[f64; 2]> = (0..81).map(|k| [f64::from(k % 9), f64::from(k / 9)]).collect();
        assert_eq!(rim(&square), None);
    }

    #[test]
    fn the_mean_radius_is_the_mean_distance_from_the_origin() {
        assert_eq!(mean_radius([[3.0, -4.0], [0.0, 1.0], [0.0, 0.0]].into_iter()), 2.0);
        assert!(mean_radius(std::iter::empty()).is_nan());
    }

    #[test]
    fn points_on_a_line_have_neither_circle_nor_section() {
        let line = [[1.0, 1.0], [2.0, 2.0], [4.0, 4.0]];
        assert_eq!(circle(&line), None);
        assert_eq!(section_radius(&line), None);
        assert_eq!(circle(&[]), None);
        assert_eq!(section_radius(&[[1.0, 0.0]]), None);
    }

    #[test]
    fn a_polygon_has_the_radius_of_gyration_of_its_formula() {
        for corners in [4, 8, 24] {
            let angles: Vec<f64> =
                (0..corners).map(|k| TAU * f64::from(k) / f64::from(corners)).collect();
            // Nodes within, and a centre off the axis, change nothing.
            let points =
                [around([0.1, 0.2], 0.03, &angles), around([0.1, 0.2], 0.02, &angles)].concat();
            let exact = 0.03 * ((2.0 + (TAU / f64::from(corners)).cos()) / 3.0).sqrt();
            // I_p about the origin is 50 times that about the centre.
            assert!((section_radius(&points).unwrap() / exact - 1.0).abs() < 1e-12);
        }
    }
}
