//! The table `film` of a joint: nodes, how far the film reaches, its sides and openings.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::document::schema::Shape::{Either, Flag, List, Named, Number, Tuple, Words};
use whirl_codegen::document::schema::{Key, Shape, key, merged};

use super::film_arc::Arc;
use super::film_bore::{Around, BoreShape, POCKET};
use super::film_heat::{HEAT, HeatTable};
use super::library::FileStore;
use super::names;
use super::shapes::{ANGLE, ARC, LENGTH, POSITION, SUPPLY};

/// The table `film` of a joint.
pub(super) const FILM: &[Key] = &[
    key("grid", List(&Number), "nodes around and along; 72 and 7 if left out, of an arc 37 and 7")
        .like("[72, 7]"),
    key("left", SIDE, LEFT).like("\"open\""),
    key("right", SIDE, "the same of the end at greater z").like("\"2 bar\""),
    key(
        "arc",
        Tuple(&ANGLE, 2),
        "of a film that does not close: the angles from x towards y at which it starts and ends",
    )
    .like("[\"240 deg\", \"300 deg\"]"),
    key("start", SIDE, START).like("\"0 bar\""),
    key("end", SIDE, "the same of the edge at the second angle of `arc`").like("\"open\""),
    key("flexible", Flag, FLEXIBLE),
    key(
        "heat",
        Shape::Table(&[HEAT]),
        "its temperature, on which its viscosity depends; none if left out",
    ),
    key("opening", Named(&Shape::Table(&[OPENING])), "holes and grooves in the bore, by name"),
    key("pocket", Named(&Shape::Table(&[POCKET])), "places of the bore that are deeper, by name"),
];

const SIDE: Shape = Either(&[SUPPLY, Words(&WITHOUT_PRESSURE)]);

const FLEXIBLE: &str = "whether a bore that is a `surface` of a mesh gives way under the film; false: it stays as round as it is; true if left out";
const LEFT: &str = "the end at smaller z: open to air at the pressure of the cavity, closed, or flooded with this pressure; open if left out";
const START: &str = "the edge at the first angle of `arc`: flooded with this pressure, open or closed; flooded with the pressure of the cavity if left out";

const OPENING: &[Key] = &[
    merged("angle", ANGLE, "of its middle, from x of the bore towards y"),
    key("arc", ARC, "around the bore"),
    key("width", LENGTH, "around the bore, in place of `arc`"),
    key("z", POSITION, "of its middle, from the middle of the film; 0 if left out"),
    merged("length", LENGTH, "along z"),
    merged("pressure", SUPPLY, "of the oil in it, above that of the cavity"),
];

/// Nodes around and along where a case says none: all around, and of an arc.
const GRID: [usize; 2] = [72, 7];
const GRID_OF_ARC: [usize; 2] = [37, 7];
/// Most of them.
const MOST: [f64; 2] = [2000.0, 101.0];
/// Keys of both ends, and what results call these.
const ENDS: [&str; 2] = ["left", "right"];
/// The same of the edges of an arc.
const EDGES: [&str; 2] = ["start", "end"];
/// Words for sides without a pressure.
const WITHOUT_PRESSURE: [&str; 2] = ["open", "closed"];

/// The table `film` of a joint.
#[derive(Debug, Clone)]
pub(super) struct FilmTable {
    pub(super) grid: [usize; 2],
    pub(super) grid_place: Located,
    pub(super) arc: Option<Arc>,
    /// Ends, then the edges of an arc.
    pub(super) sides: Vec<(Side, Located)>,
    pub(super) openings: Vec<Opening>,
    pub(super) bore: BoreShape,
    /// Whether a bore with a mesh deforms, and where the case says that it does.
    pub(super) flexible: (bool, Option<Located>),
    pub(super) heat: Option<HeatTable>,
    /// Where the joint names the film.
    pub(super) place: Located,
}

/// An end of a film, or an edge of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    Open,
    Closed,
    /// With this pressure above that of the cavity (Pa).
    Flooded(f64),
}

/// A hole or a groove in the bore.
#[derive(Debug, Clone)]
pub(super) struct Opening {
    pub(super) name: Located,
    /// Its middle, from x (rad), and from the middle of the film (m).
    pub(super) angle: f64,
    pub(super) z: f64,
    pub(super) size: Around,
    /// Along z (m).
    pub(super) length: f64,
    /// Above that of the cavity (Pa).
    pub(super) pressure: f64,
}

impl Opening {
    fn read(table: &Table, name: Located) -> Option<Self> {
        let size = Around::read(table);
        let z = table.quantity("z").unwrap_or(0.0);
        let [angle, length, pressure] =
            ["angle", "length", "pressure"].map(|key| table.quantity(key));
        let (angle, size, length, pressure) = (angle?, size?, length?, pressure?);
        Some(Opening { name, angle, z, size, length, pressure })
    }
}

impl FilmTable {
    /// Of a joint that names a film and says no more of it.
    pub(super) fn of_name(name: &Located) -> Self {
        FilmTable {
            grid: GRID,
            grid_place: name.clone(),
            arc: None,
            sides: vec![(Side::Open, name.clone()); 2],
            openings: Vec::new(),
            bore: BoreShape::default(),
            flexible: (true, None),
            heat: None,
            place: name.clone(),
        }
    }

    pub(super) fn read(store: FileStore, table: &Table, name: &Located) -> Self {
        let arc = Arc::read(table);
        let usual = if arc.is_some() { GRID_OF_ARC } else { GRID };
        let (grid, grid_place) = grid(table, name, usual);
        let ends = ENDS.map(|key| side(table, key, name, Side::Open));
        let edges = EDGES.map(|key| side(table, key, name, Side::Flooded(0.0)));
        let mut sides = ends.to_vec();
        match (arc, table.gives("arc")) {
            (None, false) => {
                for key in EDGES.into_iter().filter(|key| table.gives(key)) {
                    let message = format!("`{key}` is an edge of an arc, and this film closes");
                    let help = "add `arc = [\"240 deg\", \"300 deg\"]`, or leave it out";
                    table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
                }
            }
            _ => sides.extend(edges),
        }
        let all = names::in_order(table, "opening");
        let called = if arc.is_some() { &[ENDS, EDGES].concat() } else { &ENDS[..] };
        for (name, _) in all.iter().filter(|(name, _)| called.contains(&name.text())) {
            let message =
                format!("an opening cannot be called `{}`, as an end of the film is", name.text());
            table.push(name.error_here(Code::BAD_VALUE, message).help("give it another name"));
        }
        names::plain(table, "opening", all.iter().map(|(name, _)| name));
        let openings =
            all.into_iter().filter_map(|(name, own)| own.read(|own| Opening::read(own, name)));
        let (openings, bore) = (openings.collect(), BoreShape::read(store, table, arc));
        let said = table.optional_boolean("flexible");
        let at = (said == Some(true)).then(|| table.written("flexible"));
        let flexible = (said != Some(false), at);
        let heat = table.optional_table("heat");
        let heat = heat.and_then(|own| own.read(|own| HeatTable::read(store, own)));
        FilmTable {
            grid,
            grid_place,
            arc,
            sides,
            openings,
            bore,
            flexible,
            heat,
            place: name.clone(),
        }
    }

    /// What results call its sides and openings.
    pub(super) fn called(&self) -> Vec<String> {
        let sides = ENDS.into_iter().chain(EDGES).take(self.sides.len());
        let openings = self.openings.iter().map(|own| own.name.text());
        sides.chain(openings).map(str::to_owned).collect()
    }
}

/// Nodes around and along, and where they are told.
fn grid(table: &Table, name: &Located, usual: [usize; 2]) -> ([usize; 2], Located) {
    let counts = table.positive_numbers("grid");
    match counts.as_slice() {
        [around, along]
            if [around, along].iter().all(|own| own.fract() == 0.0)
                && *around <= MOST[0]
                && *along <= MOST[1] =>
        {
            ([*around as usize, *along as usize], table.written("grid"))
        }
        _ => {
            if table.gives("grid") {
                let message = format!(
                    "`grid` is two whole numbers: nodes around, {} at most, and along, {} at most",
                    MOST[0], MOST[1]
                );
                let help = "such as `grid = [72, 7]`";
                let at = table.written("grid");
                table.push(at.error_here(Code::BAD_VALUE, message).help(help));
            }
            (usual, name.clone())
        }
    }
}

/// What a side is, and where that is told.
fn side(table: &Table, key: &'static str, name: &Located, usual: Side) -> (Side, Located) {
    let said = table.gives(key).then(|| table.written(key));
    let word = said.as_ref().map(|own| own.text().trim_matches(['"', '\'']).to_owned());
    let side = match word.as_deref() {
        None => usual,
        Some("open") => Side::Open,
        Some("closed") => Side::Closed,
        Some(_) => table.quantity(key).map_or(usual, Side::Flooded),
    };
    if word.is_some_and(|own| WITHOUT_PRESSURE.contains(&own.as_str())) {
        table.pass_over(key);
    }
    (side, said.unwrap_or_else(|| name.clone()))
}
