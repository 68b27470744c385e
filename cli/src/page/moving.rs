//! Motions of an analysis in space: the surfaces of the bodies, and modes or orbits of their nodes.

use num_complex::Complex64;
use serde::Serialize;

use super::about::LAYOUT;
use super::encode::Packed;
use super::shapes::Shapes;

/// What its file is called behind the name of the analysis.
pub(crate) const MOTIONS: &str = ".motions.json";
/// Numbers of all motions of an analysis, at most: a page has several.
const MOST: usize = 80_000;

/// Motions of points: Re(w e^{iφ}) along x, y, z.
#[derive(Default)]
pub(crate) struct Moving {
    motions: Vec<Motion>,
    numbers: usize,
    /// How many had no room.
    left_out: usize,
}

#[derive(Serialize)]
struct Motion {
    /// Under what it is listed, and its name there.
    group: String,
    name: String,
    /// How it goes round, and where.
    words: String,
    rpm: Option<f64>,
    hertz: f64,
    /// How far the point gets that gets furthest (m); none of a mode, whose furthest one gets to 1.
    metres: Option<f64>,
    /// Of 32767 in the numbers below.
    largest: f64,
    /// By shapes: Re w of all points, three each, then −Im w, from 32768 on: they move as a cos φ + b sin φ.
    points: Vec<Packed>,
}

/// A file.
#[derive(Serialize)]
struct Content<'a> {
    layout: u32,
    shapes: &'a Shapes,
    motions: &'a [Motion],
    /// How many motions had no room.
    left_out: usize,
}

impl Moving {
    /// For how many motions of so many points there is room; the first one is always shown.
    pub(crate) fn room(&self, points: usize) -> usize {
        let room = MOST.saturating_sub(self.numbers) / (6 * points.max(1));
        room.max(usize::from(self.motions.is_empty()))
    }

    /// Counts motions for which there is no room.
    pub(crate) fn leave_out(&mut self, motions: usize) {
        self.left_out += motions;
    }

    /// Adds a motion for which there is room: what it is called and what is said of it; its speed, its frequency and how far points get.
    pub(crate) fn add(
        &mut self,
        (group, name, words): (String, String, String),
        (rpm, hertz, metres): (Option<f64>, f64, Option<f64>),
        moved: &[Vec<[Complex64; 3]>],
    ) {
        self.numbers += 6 * moved.iter().map(Vec::len).sum::<usize>();
        let numbers = |own: &Complex64| [own.re, -own.im];
        let all = moved.iter().flatten().flatten().flat_map(numbers);
        let largest = all.fold(f64::MIN_POSITIVE, |most: f64, own| most.max(own.abs()));
        let part = |own: f64| (32768.0 + own / largest * 32767.0).round() as u16;
        let packed = |own: &Vec<[Complex64; 3]>| {
            let half = |k: usize| own.iter().flatten().map(move |own| part(numbers(own)[k]));
            Packed::short(half(0).chain(half(1)))
        };
        let points = moved.iter().map(packed).collect();
        self.motions.push(Motion { group, name, words, rpm, hertz, metres, largest, points });
    }

    /// The text of the file; none without any motion.
    pub(crate) fn json(&self, shapes: &Shapes) -> Option<String> {
        let Moving { motions, left_out, .. } = self;
        let content = Content { layout: LAYOUT, shapes, motions, left_out: *left_out };
        (!motions.is_empty())
            .then(|| serde_json::to_string(&content).expect("the keys are strings") + "\n")
    }
}
