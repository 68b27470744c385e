//! A parallel projection of space on a sheet, and what is hidden in it.

/// x is up, z runs to the right and away from the viewer, who looks down a little: radians.
const TURN: f64 = 0.62;
const DOWN: f64 = 0.40;
/// Where the light comes from: right, up, towards the viewer.
const LIGHT: [f64; 3] = [-0.35, 0.60, 0.72];

/// Where things are on a sheet: x to the right and y down, in points, and how near they are to the viewer, in points.
pub(super) type Seen = [f64; 3];

/// A projection.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    /// Directions to the right, up and towards the viewer.
    axes: [[f64; 3]; 3],
    /// Points a metre.
    pub(super) scale: f64,
    /// The origin on the sheet.
    origin: [f64; 2],
}

impl View {
    /// A view of a box of the sheet (left, top, width, height) that shows all of these positions.
    pub(super) fn of<'a>(
        positions: impl Iterator<Item = &'a [f64; 3]>,
        [left, top, width, height]: [f64; 4],
    ) -> View {
        let ((sin, cos), (rise, level)) = (TURN.sin_cos(), DOWN.sin_cos());
        let towards = [rise, level * cos, -level * sin];
        let right = [0.0, sin, cos];
        let up = cross(towards, right);
        let mut view = View { axes: [right, up, towards], scale: 1.0, origin: [0.0; 2] };
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for position in positions {
            let seen = view.seen(*position);
            for k in 0..2 {
                low[k] = low[k].min(seen[k]);
                high[k] = high[k].max(seen[k]);
            }
        }
        let scale = (width / (high[0] - low[0])).min(height / (high[1] - low[1]));
        let middle = [left + 0.5 * width, top + 0.5 * height];
        view.origin = middle;
        // Of nothing, and of a point, there is nothing to fit in.
        if scale.is_finite() && scale > 0.0 {
            view.scale = scale;
            view.origin = [0, 1].map(|k| middle[k] - scale * 0.5 * (low[k] + high[k]));
        }
        view
    }

    /// Where a position (m) is.
    pub(super) fn seen(&self, position: [f64; 3]) -> Seen {
        let [x, y, depth] = self.axes.map(|axis| self.scale * dot(axis, position));
        [self.origin[0] + x, self.origin[1] - y, depth]
    }

    /// How a direction is seen: right, down, towards the viewer.
    pub(super) fn direction(&self, own: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|axis| dot(axis, own));
        [x, -y, z]
    }

    /// The brightness of a face with these corners, from 0 to 1; none of one that looks away.
    pub(super) fn shade(&self, corners: &[[f64; 3]]) -> Option<f64> {
        // The area vector of a polygon, which a warped face has, too.
        let mut area = [0.0; 3];
        for (place, &corner) in corners.iter().enumerate() {
            let part = cross(corner, corners[(place + 1) % corners.len()]);
            area.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
        let [right, up, towards] = self.axes.map(|axis| dot(axis, area));
        let length = (right * right + up * up + towards * towards).sqrt();
        if !(towards > 1e-9 * length) {
            return None;
        }
        let lit = (LIGHT[0] * right + LIGHT[1] * up + LIGHT[2] * towards) / length;
        Some(0.52 + 0.48 * lit.clamp(0.0, 1.0))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [f64; 4] = [10.0, 20.0, 200.0, 100.0];

    #[test]
    fn everything_is_in_its_box() {
        let corners: Vec<[f64; 3]> =
            (0..8).map(|k| [0, 1, 2].map(|axis| f64::from(k >> axis & 1) - 3.0)).collect();
        let view = View::of(corners.iter(), BOX);
        for [x, y, _] in corners.iter().map(|corner| view.seen(*corner)) {
            assert!((10.0 - 1e-9..=210.0 + 1e-9).contains(&x), "{x}");
            assert!((20.0 - 1e-9..=120.0 + 1e-9).contains(&y), "{y}");
        }
        // x is up, and z to the right and away from the viewer.
        let [right, down, _] = view.direction([1.0, 0.0, 0.0]);
        assert!(right.abs() < 1e-12 && down < -0.5);
        let [right, _, towards] = view.direction([0.0, 0.0, 1.0]);
        assert!(right > 0.5 && towards < 0.0);
    }

    #[test]
    fn faces_that_look_away_have_no_brightness() {
        let face = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut back = face;
        back.reverse();
        assert!(View::of(face.iter(), BOX).shade(&face).is_some_and(|own| own > 0.5));
        assert_eq!(View::of(face.iter(), BOX).shade(&back), None);
    }

    #[test]
    fn a_view_of_nothing_is_finite() {
        let one = [[1.0, 2.0, 3.0]];
        for view in [View::of([].iter(), BOX), View::of(one.iter(), BOX)] {
            assert!(view.seen([0.0; 3]).iter().all(|own| own.is_finite()));
        }
    }
}
