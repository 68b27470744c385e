//! The points of a sweep in their order.

use whirl_codegen::document::tree::{Content, Node, Tree};
use whirl_solver::cache::Key;

use super::axis::Axis;
use super::definition::Sweep;
use super::vary::Varied;
use crate::values::level::Level;

/// A point of a sweep: values of the keys that vary.
#[derive(Debug, Clone)]
pub struct Point {
    /// Its place among all, from 0.
    number: usize,
    /// The way that passes it, where points go on from each other.
    pub(super) way: Option<&'static str>,
    /// In the order of the keys.
    pub(super) levels: Vec<Level>,
    /// Names of the keys, as TOML writes them.
    names: Vec<String>,
}

impl Point {
    /// Its place among all, from 0.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The keys with their values, both as they would be written in a case: `springs.radial_clearance`, `"25 um"`.
    pub fn values(&self) -> impl Iterator<Item = (&str, &str)> {
        self.names
            .iter()
            .map(String::as_str)
            .zip(self.levels.iter().map(|own| own.literal.as_str()))
    }

    /// The values as lines of TOML, as [`crate::CaseText::with_values`] takes them.
    pub fn lines(&self) -> String {
        self.values().map(|(key, value)| format!("{key} = {value}\n")).collect()
    }
}

impl Sweep {
    /// Number of points.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.count).product()
    }

    /// Points that go on from each other; one where none does.
    pub(super) fn chain(&self) -> usize {
        match self.along {
            Some(_) => self.axes.last().map_or(1, |axis| axis.count),
            None => 1,
        }
    }

    /// Number of chains.
    pub(super) fn chains(&self) -> usize {
        self.count() / self.chain()
    }

    /// All points, the last key varying fastest.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        (0..self.count()).map(|number| self.point(number))
    }

    /// A point by its number.
    ///
    /// # Panics
    /// If there are fewer points.
    pub fn point(&self, number: usize) -> Point {
        assert!(number < self.count(), "there are {} points", self.count());
        let mut places = Vec::with_capacity(self.axes.len());
        let mut left = number;
        for axis in self.axes.iter().rev() {
            places.push(left % axis.count);
            left /= axis.count;
        }
        places.reverse();
        self.at(number, &places)
    }

    /// The point with these places on the axes.
    pub(super) fn at(&self, number: usize, places: &[usize]) -> Point {
        let mut taken = vec![0; self.keys.len()];
        let mut way = None;
        for (k, (axis, place)) in self.axes.iter().zip(places).enumerate() {
            let mut place = *place;
            if let (Some(along), true) = (self.along, k + 1 == self.axes.len()) {
                let (value, direction) = along.value(place, axis.count);
                (place, way) = (value, Some(direction));
            }
            axis.keys.iter().for_each(|key| taken[*key] = place);
        }
        let levels = self.keys.iter().zip(taken).map(|(key, place)| key.level(place)).collect();
        let names = self.keys.iter().map(|key| key.name.clone()).collect();
        Point { number, way, levels, names }
    }

    /// The number of the point with these values on the axes, by their places among those of each axis; `way`: on which it is
    /// passed, where points go on from each other.
    pub(super) fn number(&self, values: &[usize], way: Option<&str>) -> usize {
        let last = self.axes.len() - 1;
        let place = |(k, axis): (usize, &Axis)| match way {
            Some("down") if k == last => axis.count - 1 - values[k],
            _ => values[k],
        };
        let places = self.axes.iter().enumerate().map(|own| (own.1.count, place(own)));
        places.fold(0, |number, (count, place)| number * count + place)
    }

    /// The values of a point as a file that stands before the case, each with its place in the sweep.
    pub(super) fn tree(&self, point: &Point) -> Tree {
        let mut tree = Tree::default();
        for (key, level) in self.keys.iter().zip(&point.levels) {
            insert(&mut tree, key, &level.node);
        }
        tree
    }

    /// What makes each point of a chain another one than all others: its values, and those from which it goes on. A Latin
    /// hypercube may have the same values twice.
    pub(super) fn identities(&self, chain: usize) -> impl Iterator<Item = Key> {
        let first = chain * self.chain();
        (first..first + self.chain()).scan(None, |before: &mut Option<Key>, number| {
            let sample = self.samples.map(|_| number);
            *before = Some(Key::of(&(*before, self.point(number).lines(), sample)));
            *before
        })
    }
}

fn insert(tree: &mut Tree, key: &Varied, value: &Node) {
    let Some(((last, place), tables)) = key.path.split_last() else { return };
    let mut within = tree;
    for (name, place) in tables {
        let table = || {
            let content = Content::Table(Tree::default());
            (place.clone(), Node { place: place.clone(), content })
        };
        let (_, node) = within.entries.entry(name.clone()).or_insert_with(table);
        let Content::Table(inner) = &mut node.content else { return };
        within = inner;
    }
    within.entries.insert(last.clone(), (place.clone(), value.clone()));
}
