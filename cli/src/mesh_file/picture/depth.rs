//! Which faces are in front: the nearest one at every pixel.

use super::view::Seen;

/// A raster of what is nearest.
pub(super) struct Depth {
    width: usize,
    height: usize,
    /// Pixels a point.
    fine: f64,
    near: Vec<f32>,
    /// The face at a pixel, by its place, from 1; 0 where there is none.
    face: Vec<u32>,
}

impl Depth {
    /// An empty one over a sheet of so many points.
    pub(super) fn new([width, height]: [f64; 2], fine: f64) -> Depth {
        let [width, height] = [width, height].map(|points| (points * fine).ceil() as usize);
        let pixels = width * height;
        Depth { width, height, fine, near: vec![f32::NEG_INFINITY; pixels], face: vec![0; pixels] }
    }

    /// Puts a face in, by its corners.
    pub(super) fn put(&mut self, place: usize, corners: &[Seen]) {
        for k in 1..corners.len().saturating_sub(1) {
            self.triangle(place, [corners[0], corners[k], corners[k + 1]]);
        }
    }

    fn triangle(&mut self, place: usize, corners: [Seen; 3]) {
        let [a, b, c] = corners.map(|[x, y, z]| [x * self.fine, y * self.fine, z]);
        let double = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if double.abs() < 1e-12 {
            return;
        }
        let ends = |k: usize, most: usize| {
            let low = a[k].min(b[k]).min(c[k]).floor().max(0.0) as usize;
            let high = (a[k].max(b[k]).max(c[k]).ceil().max(0.0) as usize).min(most);
            low..high
        };
        for row in ends(1, self.height) {
            for column in ends(0, self.width) {
                let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
                let u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / double;
                let v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / double;
                let w = 1.0 - u - v;
                if u < 0.0 || v < 0.0 || w < 0.0 {
                    continue;
                }
                let near = (u * a[2] + v * b[2] + w * c[2]) as f32;
                let pixel = row * self.width + column;
                if near > self.near[pixel] {
                    self.near[pixel] = near;
                    self.face[pixel] = place as u32 + 1;
                }
            }
        }
    }

    fn pixel(&self, [x, y, _]: Seen) -> Option<usize> {
        let [column, row] = [x, y].map(|own| (own * self.fine).floor());
        let inside =
            column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < self.height as f64;
        inside.then(|| row as usize * self.width + column as usize)
    }

    /// Whether nothing is in front of a point by more than so many points.
    pub(super) fn shows(&self, seen: Seen, within: f64) -> bool {
        self.pixel(seen).is_none_or(|pixel| seen[2] + within >= f64::from(self.near[pixel]))
    }

    /// Whether each of so many faces is in front somewhere.
    pub(super) fn in_front(&self, faces: usize) -> Vec<bool> {
        let mut found = vec![false; faces];
        self.face.iter().filter(|&&own| own > 0).for_each(|&own| found[own as usize - 1] = true);
        found
    }

    /// Stretches of a row of equal colour, by the colour of each face: first column, row and columns, in points.
    pub(super) fn stretches(&self, colour: impl Fn(usize) -> usize) -> Vec<([f64; 3], usize)> {
        let mut found: Vec<([f64; 3], usize)> = Vec::new();
        for row in 0..self.height {
            let line = &self.face[row * self.width..(row + 1) * self.width];
            let mut before = None;
            for (column, &face) in line.iter().enumerate() {
                let own = (face > 0).then(|| colour(face as usize - 1));
                match (own, found.last_mut()) {
                    (Some(_), Some(last)) if own == before => last.0[2] += 1.0 / self.fine,
                    (Some(own), _) => {
                        let at = [column, row].map(|pixels| pixels as f64 / self.fine);
                        found.push(([at[0], at[1], 1.0 / self.fine], own));
                    }
                    (None, _) => {}
                }
                before = own;
            }
        }
        found
    }

    /// Points of a pixel.
    pub(super) fn pixel_size(&self) -> f64 {
        1.0 / self.fine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square([x, y]: [f64; 2], z: f64) -> [Seen; 4] {
        [[x, y, z], [x + 2.0, y, z], [x + 2.0, y + 2.0, z], [x, y + 2.0, z]]
    }

    #[test]
    fn the_nearest_face_is_in_front_in_any_order() {
        for order in [[0, 1, 2], [2, 1, 0]] {
            let mut depth = Depth::new([4.0, 4.0], 2.0);
            // The second hides the first, and the third is half behind it.
            let faces = [square([1.0, 1.0], 1.0), square([1.0, 1.0], 3.0), square([2.0, 1.0], 2.0)];
            order.into_iter().for_each(|place| depth.put(place, &faces[place]));
            assert_eq!(depth.in_front(3), [false, true, true]);
            assert!(!depth.shows([1.5, 1.5, 2.5], 0.1) && depth.shows([1.5, 1.5, 2.5], 0.6));
            assert!(depth.shows([0.5, 0.5, -9.0], 0.0));
            let row = depth.stretches(|face| face);
            assert_eq!(row[..2], [([1.0, 1.0, 2.0], 1), ([3.0, 1.0, 1.0], 2)]);
        }
    }
}
