//! Shapes of the bore of a film: lobes, a profile from a file, pockets. Each is a depth beyond the round bore of the radial clearance.

use std::f64::consts::{PI, TAU};
use std::sync;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::document::schema::Shape::{Between, Count, Number, Text};
use whirl_codegen::document::schema::{Key, key, merged};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Dimension;

use super::columns::{self, Columns};
use super::film_arc::Arc;
use super::library::FileStore;
use super::names;
use super::shapes::{ANGLE, ARC, LENGTH, POSITION};

/// Most lobes.
const MOST_LOBES: usize = 12;

/// Keys of the table `film` that shape the bore, beside its pockets.
pub(super) const BORE_SHAPE: &[Key] = &[
    key("lobes", Count(1, MOST_LOBES), "arcs of the bore, each with a centre of its own; none if left out"),
    key(
        "preload",
        Between(0.0, 1.0),
        "of lobes or of an arc: the radial clearance is that where they are narrowest, c, and their radius that of the journal and c/(1 − preload)",
    )
    .like("0.5"),
    key("lobe_angle", ANGLE, "of the middle of the first lobe, from x of the bore; 0 if left out")
        .like("\"90 deg\""),
    key(
        "lobe_offset",
        Number,
        "where a lobe or an arc is narrowest, as a share of it from its beginning: from 0 to 1; 0.5 if left out",
    ),
    key("profile", Text, "a file of depths over the angle from x of the bore: columns `angle [deg], depth [um]`")
        .like("\"bore.csv\""),
];

/// Keys of a pocket.
pub(super) const POCKET: &[Key] = &[
    merged("angle", ANGLE, "of its middle, from x of the bore towards y"),
    key("arc", ARC, "around the bore"),
    key("width", LENGTH, "around the bore, in place of `arc`"),
    key("z", POSITION, "of its middle, from the middle of the film; 0 if left out"),
    key("length", LENGTH, "along z; that of the film if left out"),
    merged("depth", LENGTH, "beyond the bore around it"),
];

/// Size of an opening or a pocket around the bore: rad or m.
#[derive(Debug, Clone, Copy)]
pub(super) enum Around {
    Arc(f64),
    Width(f64),
}

impl Around {
    /// By `arc` or `width` of a table.
    pub(super) fn read(table: &Table) -> Option<Around> {
        let (arc, width) = (table.quantity("arc"), table.quantity("width"));
        if table.gives("arc") && table.gives("width") {
            table.conflict("arc", "width");
        }
        if !table.has("arc") && !table.has("width") {
            let help = "add `width = \"5 mm\"`, its size around the bore; or `arc = \"20 deg\"`";
            table.absent("width", help);
        }
        arc.map(Around::Arc).or(width.map(Around::Width))
    }

    /// Half of it (rad) on a radius (m).
    pub(super) fn half(self, radius: f64) -> f64 {
        match self {
            Around::Arc(angle) => 0.5 * angle,
            Around::Width(width) => 0.5 * width / radius,
        }
    }
}

/// What makes a bore other than round.
#[derive(Debug, Clone, Default)]
pub(super) struct BoreShape {
    lobes: Option<Lobes>,
    profile: Option<sync::Arc<Columns>>,
    pockets: Vec<Pocket>,
}

#[derive(Debug, Clone, Copy)]
struct Lobes {
    count: usize,
    preload: f64,
    /// The middle of the first (rad).
    angle: f64,
    offset: f64,
    /// Whether it is the one of an arc, about where that is narrowest.
    of_arc: bool,
}

#[derive(Debug, Clone)]
struct Pocket {
    name: Located,
    /// rad and m.
    angle: f64,
    z: f64,
    size: Around,
    /// Along z (m), if it is not that of the film.
    length: Option<f64>,
    /// m.
    depth: f64,
}

impl BoreShape {
    pub(super) fn read(store: FileStore, table: &Table, arc: Option<Arc>) -> BoreShape {
        let lobes = Lobes::read(table, arc);
        let measures: [&[Dimension]; 2] = [&[Dimension::ANGLE], &[Dimension::LENGTH]];
        let profile = columns::read(store, table, "profile", measures);
        if let Some(own) = &profile
            && own.rows.last().is_some_and(|last| last[0] - own.rows[0][0] > TAU * (1.0 + 1e-9))
        {
            let message = format!("`{}` goes around the bore more than once", own.name.text());
            let help = "give depths over one turn, such as from 0 deg to 360 deg";
            table.push(own.name.error_here(Code::TABLE, message).help(help));
        }
        let all = names::in_order(table, "pocket");
        names::plain(table, "pocket", all.iter().map(|(name, _)| name));
        let pockets =
            all.into_iter().filter_map(|(name, own)| own.read(|own| Pocket::read(own, name)));
        BoreShape { lobes, profile, pockets: pockets.collect() }
    }

    /// Whether it is round.
    pub(super) fn is_round(&self) -> bool {
        self.lobes.is_none() && self.profile.is_none() && self.pockets.is_empty()
    }

    /// Beyond the round bore (m) at an angle (rad) and z (m) from the middle of a film with this clearance, radius and length (m).
    pub(super) fn depth(&self, [angle, z]: [f64; 2], [clearance, radius, length]: [f64; 3]) -> f64 {
        let lobes = self.lobes.map_or(0.0, |own| own.depth(angle, clearance));
        let profile = self.profile.as_ref().map_or(0.0, |own| over_turn(&own.rows, angle));
        let covers = |own: &&Pocket| {
            let half = own.size.half(radius);
            let along = 0.5 * own.length.unwrap_or(length);
            // Nodes on its edge are in it.
            apart(angle, own.angle).abs() <= half * (1.0 + 1e-9)
                && (z - own.z).abs() <= along * (1.0 + 1e-9)
        };
        let pockets = self.pockets.iter().filter(covers).map(|own| own.depth);
        lobes + profile + pockets.sum::<f64>()
    }

    /// Whose nodes there are none: pockets that lie between nodes.
    pub(super) fn missed<'s>(
        &'s self,
        nodes: &'s [[f64; 2]],
        (radius, length): (f64, f64),
    ) -> impl Iterator<Item = &'s Located> + 's {
        let is_missed = move |own: &&Pocket| {
            let alone = BoreShape { pockets: vec![(*own).clone()], ..BoreShape::default() };
            nodes.iter().all(|node| alone.depth(*node, [0.0, radius, length]) == 0.0)
        };
        self.pockets.iter().filter(is_missed).map(|own| &own.name)
    }

    /// Where it is told, for errors of it as a whole.
    pub(super) fn place(&self) -> Option<&Located> {
        let profile = self.profile.as_ref().map(|own| &own.name);
        profile.or(self.pockets.first().map(|own| &own.name))
    }

    /// All its numbers, for keys of caches.
    pub(super) fn numbers(&self) -> String {
        let BoreShape { lobes, profile, pockets } = self;
        let pockets = pockets.iter().map(|own| {
            let Pocket { name: _, angle, z, size, length, depth } = own;
            format!("{angle:?} {z:?} {size:?} {length:?} {depth:?}")
        });
        let rows = profile.as_ref().map(|own| &own.rows);
        format!("{lobes:?} {rows:?} {:?}", pockets.collect::<Vec<_>>())
    }

    /// What it is, for people.
    pub(super) fn described(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(Lobes { count, preload, angle, offset, of_arc }) = self.lobes {
            let degrees = whirl_text::rounded(angle.to_degrees(), 4);
            lines.push(match of_arc {
                true => format!("preload {preload}, narrowest at {degrees}°"),
                false => format!(
                    "bore of {count} lobes, the first around {degrees}°, preload {preload}, narrowest at {offset} of each"
                ),
            });
        }
        if let Some(own) = &self.profile {
            lines.push(format!("bore with the profile {}", own.name.text()));
        }
        lines.extend(self.pockets.iter().map(|own| {
            let depth = whirl_text::rounded(1e6 * own.depth, 4);
            format!("pocket {}: {depth} µm deep", own.name.text())
        }));
        lines
    }
}

impl Lobes {
    fn read(table: &Table, arc: Option<Arc>) -> Option<Lobes> {
        const OF_LOBES: [&str; 3] = ["preload", "lobe_angle", "lobe_offset"];
        const NOT_OF_ARCS: [&str; 2] = ["lobes", "lobe_angle"];
        let count = table.optional_count("lobes");
        let preload = table.has("preload").then(|| table.number_or_middle("preload"));
        let angle = table.quantity("lobe_angle").unwrap_or(0.0);
        let offset = table.optional_number("lobe_offset").map_or(0.5, |own| nearest(&own.0));
        if table.gives("arc") {
            for key in NOT_OF_ARCS.into_iter().filter(|key| table.gives(key)) {
                let message = format!("`{key}` is of a bore that closes, and this film is an arc");
                let help = "leave it out: an arc has a `preload` of its own, narrowest at `lobe_offset` of it";
                table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
            }
            if !table.gives("preload") && table.gives("lobe_offset") {
                table.absent("preload", "add `preload = 0.5`: without one the arc is round");
            }
            in_arc(table, offset);
            let Arc { start, size } = arc?;
            let angle = start + offset * size;
            return Some(Lobes { count: 1, preload: preload?, angle, offset: 0.5, of_arc: true });
        }
        let Some(count) = count else {
            for key in OF_LOBES.into_iter().filter(|key| table.gives(key)) {
                let message = format!("`{key}` is of a bore with `lobes`, or of an `arc`");
                let help = "add `lobes = 2`, or leave it out";
                table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
            }
            return None;
        };
        in_arc(table, offset);
        if preload.is_none() {
            table.absent("preload", "add `preload = 0.5`: without one the bore is round");
        }
        Some(Lobes { count, preload: preload?, angle, offset, of_arc: false })
    }

    /// c m/(1 − m) (1 − cos ψ) at the angle ψ from where the lobe is narrowest.
    fn depth(&self, angle: f64, clearance: f64) -> f64 {
        let arc = TAU / self.count as f64;
        let from_first = (angle - self.angle + 0.5 * arc).rem_euclid(TAU);
        let within = from_first.rem_euclid(arc) - self.offset * arc;
        clearance * self.preload / (1.0 - self.preload) * (1.0 - within.cos())
    }
}

/// Notes an offset that is none.
fn in_arc(table: &Table, offset: f64) {
    if !(0.0..=1.0).contains(&offset) {
        let message = "`lobe_offset` is a share of the arc of a lobe, from 0 to 1";
        let at = table.written("lobe_offset");
        table.push(at.error_here(Code::BAD_VALUE, message).help("such as `lobe_offset = 0.5`"));
    }
}

impl Pocket {
    fn read(table: &Table, name: Located) -> Option<Self> {
        let size = Around::read(table);
        let z = table.quantity("z").unwrap_or(0.0);
        let length = table.quantity("length");
        let [angle, depth] = ["angle", "depth"].map(|key| table.quantity(key));
        Some(Pocket { name, angle: angle?, z, size: size?, length, depth: depth? })
    }
}

/// The angle from one to another, from −π to π.
fn apart(angle: f64, from: f64) -> f64 {
    (angle - from + PI).rem_euclid(TAU) - PI
}

/// What rows over an angle have there: straight between two of them, and from the last to the first of the next turn.
fn over_turn(rows: &[[f64; 2]], angle: f64) -> f64 {
    let first = rows[0];
    let angle = first[0] + (angle - first[0]).rem_euclid(TAU);
    let next = rows.partition_point(|row| row[0] <= angle);
    let before = rows[next - 1];
    let after = rows.get(next).copied().unwrap_or([first[0] + TAU, first[1]]);
    match after[0] > before[0] {
        true => before[1] + (after[1] - before[1]) * (angle - before[0]) / (after[0] - before[0]),
        false => before[1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_lobe_is_a_round_bore_out_of_the_middle() {
        let lobes = Lobes { count: 1, preload: 0.4, angle: 0.7, offset: 0.5, of_arc: false };
        let clearance = 60e-6;
        let (wide, out) = (clearance / 0.6, clearance * 0.4 / 0.6);
        for k in 0..17 {
            let angle = 0.37 * f64::from(k);
            let gap = clearance + lobes.depth(angle, clearance);
            assert!((gap - (wide - out * (angle - 0.7).cos())).abs() < 1e-18, "{angle}");
        }
    }

    #[test]
    fn lobes_are_narrowest_where_they_are_told_to_be() {
        let arc = TAU / 3.0;
        let lobes = Lobes { count: 3, preload: 0.5, angle: 0.2, offset: 0.75, of_arc: false };
        for k in 0..3 {
            let narrow = 0.2 + arc * (f64::from(k) + 0.25);
            assert!(lobes.depth(narrow, 1.0) < 1e-15);
            assert!(lobes.depth(narrow + 0.1, 1.0) > 0.0 && lobes.depth(narrow - 0.1, 1.0) > 0.0);
        }
        // The end of a lobe and the beginning of the next one.
        let end = 0.2 + 0.5 * arc;
        let both = [-1e-9, 1e-9].map(|own| lobes.depth(end + own, 1.0));
        assert!((both[0] - (1.0 - (0.25 * arc).cos())).abs() < 1e-8);
        assert!((both[1] - (1.0 - (0.75 * arc).cos())).abs() < 1e-8);
    }

    #[test]
    fn a_profile_goes_on_with_its_first_row() {
        let rows = [[0.5, 1.0], [2.0, 4.0], [5.0, 3.0]];
        for (angle, depth) in [
            (0.5, 1.0),
            (1.25, 2.5),
            (5.0, 3.0),
            (0.5 + TAU, 1.0),
            (5.0 - TAU, 3.0),
            (0.5 * (5.0 + 0.5 + TAU), 2.0),
        ] {
            assert!((over_turn(&rows, angle) - depth).abs() < 1e-12, "{angle}");
        }
    }
}
