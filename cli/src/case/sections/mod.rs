//! A body from a table of its sections: `[body.NAME] sections`, in a file or in the case.

mod file;
mod row;

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::{Table, Value};
use whirl_solver::mesh::sections::{SectionTable, TableCells};

use self::row::RowDraft;
use super::dimensions::{Dimensions, Sections};
use super::library::FileStore;
use super::machine::Materials;
use super::rotor::{Body, GeneratedMesh, Mesh, StaticCorrection};
use super::selections;

/// Most rows: far more than a rotor has.
const MOST_ROWS: usize = 2_000;
/// Keys of other meshes, and what to do instead.
const OF_OTHERS: [(&str, &str); 2] = [
    ("units", "leave it out: the columns of a table name their units"),
    ("merge", "leave it out: a mesh made from sections has each node once"),
];

/// What a table says of a body that is made from sections.
pub(super) fn read(
    store: FileStore,
    table: &Table,
    materials: &Materials,
    turns: bool,
) -> Option<Body> {
    let before = table.errors();
    for key in ["mesh", "dimensions", "matrices"].into_iter().filter(|key| table.has(key)) {
        table.conflict(key, "sections");
    }
    for (key, help) in OF_OTHERS {
        if table.has(key) {
            let message = format!("`{key}` is of a mesh file, and this body has `sections`");
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    let (modes, damping) = (table.count_or_one("modes"), table.quantity("damping").unwrap_or(0.0));
    let material = materials.of(table);
    let regions = materials.regions(table);
    let selections = selections::read(table);
    let cells = table.in_table("cells", cells).unwrap_or_default();
    let rows = match table.value("sections") {
        Some(Value::String(name)) => file::read(store, table, &name),
        Some(Value::Array(..)) => {
            Some(table.tables("sections").into_iter().map(|own| own.read(row::inline)).collect())
        }
        Some(other) => {
            let message = "`sections` is a file, or a list of rows";
            let help = "such as `sections = \"rotor.csv\"`, or `sections = [{ length = \"100 mm\", outer = \"50 mm\" }]`";
            table.error(Code::BAD_VALUE, other.span(), format!("{message}: {help}"));
            None
        }
        None => None,
    };
    let drafts: Vec<RowDraft> = rows?;
    if drafts.is_empty() && table.errors() == before {
        let message = "`sections` has no row";
        let help = "add a row: its length and its outer diameter";
        table.push(table.written("sections").error_here(Code::TABLE, message).help(help));
    }
    if drafts.len() > MOST_ROWS {
        let message =
            format!("a table of sections has at most {MOST_ROWS} rows, this has {}", drafts.len());
        table.push(table.written("sections").error_here(Code::LIMIT, message));
    }
    let mut places = table.places();
    places.insert("sections".to_owned(), table.written("sections"));
    let rows = row::rows(table, &drafts, (materials, material.as_ref(), turns), &mut places);
    let (rows, rings) = rows.filter(|_| table.errors() == before)?;
    let planes = Vec::new();
    let dimensions = Dimensions::Sections(Box::new(Sections {
        table: SectionTable { rows, planes, cells },
        rings,
    }));
    Some(Body {
        modes,
        damping,
        mass_damping: 0.0,
        static_correction: StaticCorrection::default(),
        material,
        regions,
        selections,
        mesh: Mesh::Generated(Box::new(GeneratedMesh {
            dimensions,
            table: table.written("sections"),
            places: places.into_iter().collect::<BTreeMap<_, _>>(),
        })),
    })
}

/// The table `cells`.
fn cells(own: &Table) -> TableCells {
    let usual = TableCells::default();
    let tolerance = own.has("tolerance").then(|| own.number_or_middle("tolerance"));
    TableCells {
        sectors: own.optional_count("sectors").unwrap_or(usual.sectors),
        refine: own.optional_count("refine").unwrap_or(usual.refine),
        tolerance: tolerance.unwrap_or(usual.tolerance),
    }
}
