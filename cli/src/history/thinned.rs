//! Curves with no more points than a figure can show.

/// Buckets of a curve: more than a figure has pixels from left to right.
const BUCKETS: f64 = 2048.0;

/// Buckets of equal length between two abscissae.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bucket {
    first: f64,
    width: f64,
}

impl Bucket {
    /// Buckets from `first` to `last`.
    pub(crate) fn between(first: f64, last: f64) -> Bucket {
        Bucket { first, width: (last - first) / BUCKETS }
    }

    fn of(&self, at: f64) -> f64 {
        if self.width > 0.0 { ((at - self.first) / self.width).floor() } else { 0.0 }
    }
}

/// Points of a bucket that are all kept.
const FEW: usize = 6;

/// A curve of which every bucket with more than a few points keeps its first and its last one and its extremes in x
/// and y, in their order: it looks like the whole curve, spikes of a single row included.
#[derive(Debug, Default)]
pub(crate) struct Thinned {
    points: Vec<(f64, f64)>,
    bucket: f64,
    count: usize,
    few: [(f64, f64); FEW],
    /// First, minimum and maximum x, minimum and maximum y, last, with their places in the bucket.
    kept: [(usize, (f64, f64)); FEW],
}

impl Thinned {
    /// Adds a point of the bucket with `at`; points come bucket after bucket.
    pub(crate) fn push(&mut self, buckets: Bucket, at: f64, point: (f64, f64)) {
        let bucket = buckets.of(at);
        if self.count > 0 && bucket != self.bucket {
            self.close();
        }
        let entry = (self.count, point);
        if self.count == 0 {
            self.bucket = bucket;
            self.kept = [entry; FEW];
        }
        if self.count < FEW {
            self.few[self.count] = point;
        }
        let [_, left, right, low, high, last] = &mut self.kept;
        let (x, y) = point;
        let beyond = [x < left.1.0, x > right.1.0, y < low.1.1, y > high.1.1, true];
        for (kept, beyond) in [left, right, low, high, last].into_iter().zip(beyond) {
            if beyond {
                *kept = entry;
            }
        }
        self.count += 1;
    }

    fn close(&mut self) {
        if self.count <= FEW {
            self.points.extend(&self.few[..self.count]);
        } else {
            self.kept.sort_by_key(|(place, _)| *place);
            let mut before = None;
            for (place, point) in self.kept {
                if before != Some(place) {
                    self.points.push(point);
                }
                before = Some(place);
            }
        }
        self.count = 0;
    }

    /// The points that are kept.
    pub(crate) fn finish(mut self) -> Vec<(f64, f64)> {
        self.close();
        self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_are_all_kept_and_many_keep_their_spikes() {
        let curve = |rows: usize, spike: usize| {
            let buckets = Bucket::between(0.0, rows as f64);
            let mut curve = Thinned::default();
            for row in 0..rows {
                let y = if row == spike { 50.0 } else { (row as f64 * 0.01).sin() };
                curve.push(buckets, row as f64, (row as f64, y));
            }
            curve.finish()
        };
        for rows in [0, 1, 2, 700, 12_000] {
            let all = curve(rows, 0);
            assert!(all.windows(2).all(|pair| pair[1].0 > pair[0].0), "{rows}");
            // Of up to six points in a bucket none is lost.
            assert!(all.len() == rows, "{} of {rows}", all.len());
        }
        let many = curve(1_000_000, 123_456);
        assert!(many.len() <= 4 * 2049, "{}", many.len());
        assert!(
            many.contains(&(123_456.0, 50.0)) && many.contains(&(999_999.0, (9999.99_f64).sin()))
        );
        assert!(many.windows(2).all(|pair| pair[1].0 > pair[0].0));
    }
}
