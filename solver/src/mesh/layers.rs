//! What generated meshes share: checked dimensions, and planes along z refined at supports.

use whirl_specs::Element;
use whirl_text::rounded;

use crate::error::Error;

/// Lengths nearer than this part of the whole are the same.
const SAME: f64 = 1e-9;

/// A dimension that cannot be, what is said of it, and what would do.
pub(super) fn wrong(
    dimension: &str,
    value: impl ToString,
    what: impl Into<String>,
    help: impl Into<String>,
) -> Error {
    Error::Dimension {
        dimension: dimension.to_owned(),
        value: value.to_string(),
        what: what.into(),
        help: help.into(),
    }
}

/// A length in mm as people write it: without the digits that the change of units adds.
pub(super) fn length(metres: f64) -> String {
    format!("{} mm", rounded(1e3 * metres, 10))
}

/// Most cells of a generated mesh: far more than a march has use for, and less than a gigabyte.
pub(super) const MOST_CELLS: usize = 1_000_000;

/// Every length positive and finite.
pub(super) fn positive(lengths: &[(&str, f64)]) -> Result<(), Error> {
    match lengths.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
        Some((name, value)) => {
            Err(wrong(name, length(*value), "is not positive", "give a length above zero"))
        }
        None => Ok(()),
    }
}

/// The element that Abaqus calls `name`.
pub(super) fn element(
    elements: &[&'static Element],
    name: &str,
    origin: &str,
) -> Result<&'static Element, Error> {
    elements.iter().find(|element| element.abaqus.contains(&name)).copied().ok_or_else(|| {
        let what = format!("no element for {name}; is it among specs/elements?");
        Error::Mesh { origin: origin.to_owned(), what }
    })
}

/// A body along z with supports in it, by the names of its dimensions.
pub(super) struct LayerPlan<'a> {
    pub(super) start: f64,
    pub(super) length: f64,
    /// z of the middles of the supports, ascending, with the dimension's name.
    pub(super) supports: (&'a str, &'a [f64]),
    pub(super) support_length: (&'a str, f64),
    pub(super) layers_in_support: (&'a str, usize),
    pub(super) layers_between: (&'a str, usize),
    /// Longest layer at the ends where there is no span to compare with.
    pub(super) longest: f64,
    /// Cells of a layer, at most.
    pub(super) in_layer: usize,
}

/// Planes between layers of cells.
pub(super) struct Layers {
    /// z of the planes, ascending.
    pub(super) planes: Vec<f64>,
    /// First plane of each support.
    pub(super) support_starts: Vec<usize>,
}

impl LayerPlan<'_> {
    /// Equal layers in each support and in each span; at the ends, layers no longer than the longest of
    /// a span.
    pub(super) fn layers(&self) -> Result<Layers, Error> {
        let (name, supports) = self.supports;
        let (length_name, support_length) = self.support_length;
        let (count_name, inside) = self.layers_in_support;
        let (between_name, between) = self.layers_between;
        let same = SAME * self.length;
        let (start, end) = (self.start, self.start + self.length);
        if inside == 0 || !inside.is_multiple_of(2) {
            let help = "make it 2, 4 or another even number, so that nodes stand in the middle";
            return Err(wrong(count_name, inside, "is not an even number above zero", help));
        }
        if between == 0 {
            let help = "make it 1 at least";
            return Err(wrong(between_name, between, "leaves no layer of cells", help));
        }
        let (Some(first), Some(last)) = (supports.first(), supports.last()) else {
            let help = "list the middle of one at least";
            return Err(wrong(name, "[]", "lists no place", help));
        };
        for (k, pair) in supports.windows(2).enumerate() {
            let gap = pair[1] - pair[0] - support_length;
            // Written so that NaN is refused as well.
            let apart = gap > same;
            if !apart {
                let at = format!("{name}[{}]", k + 1);
                let what = format!(
                    "overlaps or touches the one before it: {name}[{k}] = {}, and {length_name} = {}",
                    length(pair[0]),
                    length(support_length)
                );
                let help = "list them in ascending order, farther apart";
                return Err(wrong(&at, length(pair[1]), what, help));
            }
        }
        let (head, tail) =
            (first - 0.5 * support_length - start, end - last - 0.5 * support_length);
        for (gap, k, z) in [(head, 0, first), (tail, supports.len() - 1, last)] {
            let inside = gap >= -same;
            if !inside {
                let what = format!(
                    "with {length_name} = {} reaches beyond the body, which goes from {} to {}",
                    length(support_length),
                    length(start),
                    length(end)
                );
                let half = 0.5 * support_length;
                let help =
                    format!("place it between {} and {}", length(start + half), length(end - half));
                return Err(wrong(&format!("{name}[{k}]"), length(*z), what, help));
            }
        }
        let span = |pair: &[f64]| (pair[1] - pair[0] - support_length) / between as f64;
        let longest = supports.windows(2).map(span).fold(0.0, f64::max);
        let longest = if longest > 0.0 { longest } else { self.longest };
        let at_end = |gap: f64| match gap > same {
            true => (gap / longest - SAME).ceil().max(1.0) as usize,
            false => 0,
        };
        let spans = supports.len() - 1;
        let of_ends = at_end(head).saturating_add(at_end(tail));
        let count = supports.len().saturating_mul(inside).saturating_add(of_ends);
        let count = count.saturating_add(spans.saturating_mul(between));
        if count.saturating_mul(self.in_layer) > MOST_CELLS {
            let what = format!(
                "makes too many cells: {count} layers of up to {} cells, where a mesh made from \
                 dimensions has at most {MOST_CELLS} cells",
                self.in_layer
            );
            let help = "make fewer layers, or fewer cells in each";
            // Of layers at the ends, which nobody counts, the length is to blame.
            return Err(match of_ends > count / 2 {
                true => wrong("length", length(self.length), what, help),
                false if inside >= between => wrong(count_name, inside, what, help),
                false => wrong(between_name, between, what, help),
            });
        }

        let mut layers = Layers { planes: Vec::new(), support_starts: Vec::new() };
        layers.divide(start, start + head, at_end(head));
        for (k, &middle) in supports.iter().enumerate() {
            let left = middle - 0.5 * support_length;
            layers.support_starts.push(layers.planes.len());
            layers.divide(left, left + support_length, inside);
            if let Some(next) = supports.get(k + 1) {
                layers.divide(left + support_length, next - 0.5 * support_length, between);
            }
        }
        let right = last + 0.5 * support_length;
        layers.divide(right, end, at_end(tail));
        layers.planes.push(if tail > same { end } else { right });
        Ok(layers)
    }
}

impl Layers {
    /// Planes of equal layers from `from` on; the last plane, at `to`, is that of what follows.
    fn divide(&mut self, from: f64, to: f64, count: usize) {
        let step = |i: usize| from + (to - from) * i as f64 / count as f64;
        self.planes.extend((0..count).map(step));
    }

    /// Lets a layer end at z, unless one does nearby, or z is within a support, whose layers are counted.
    pub(super) fn split(&mut self, z: f64, in_support: usize, near: f64) {
        let plane = self.planes.partition_point(|own| *own < z);
        let inside = 0 < plane && plane < self.planes.len();
        let of_support = self.support_starts.iter().any(|first| {
            let layers = first + 1..=first + in_support;
            layers.contains(&plane)
        });
        if !inside || of_support || (self.planes[self.nearest(z)] - z).abs() <= near {
            return;
        }
        self.planes.insert(plane, z);
        self.support_starts.iter_mut().filter(|own| **own >= plane).for_each(|own| *own += 1);
    }

    /// The plane nearest to z.
    pub(super) fn nearest(&self, z: f64) -> usize {
        let distance = |plane: &usize| (self.planes[*plane] - z).abs();
        let compare = |a: &usize, b: &usize| distance(a).total_cmp(&distance(b));
        (0..self.planes.len()).min_by(compare).unwrap_or(0)
    }

    /// The plane at z.
    pub(super) fn at(&self, z: f64) -> Option<usize> {
        let length = self.planes[self.planes.len() - 1] - self.planes[0];
        let plane = self.nearest(z);
        ((self.planes[plane] - z).abs() <= SAME * length).then_some(plane)
    }
}
