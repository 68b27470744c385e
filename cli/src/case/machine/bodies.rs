//! Shaft and support: their meshes, materials, and how they are reduced.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::bodies::Rotation;
use whirl_solver::mesh::Material;
use whirl_solver::mesh::crank::CrankThrow;
use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::mesh::shaft::{FINE, SectionCells, SolidShaft};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_specs::Motion;

use super::super::dimensions::Dimensions;
use super::super::library::{FileStore, resolve};
use super::super::named_body::{Form, MeshedBody, NamedBody};
use super::super::rotor::{Body, GeneratedMesh, GroundSpring, Mesh, MeshFile, StaticCorrection};
use super::super::selections;
use super::super::units::mesh_units;
use super::materials::Materials;
use super::motion::{default_motion, motion};

/// The table `[shaft]`: the body, which its drive ties to its frame, and how its rotation is coupled to deformation.
pub(super) fn shaft(
    store: FileStore,
    file: &Table,
    materials: &Materials,
) -> Option<(NamedBody, &'static Motion)> {
    file.table("shaft")?.read(|table| read_shaft(store, table, materials))
}

fn read_shaft(
    store: FileStore,
    table: &Table,
    materials: &Materials,
) -> Option<(NamedBody, &'static Motion)> {
    let make = |own: &Table, material| Dimensions::Shaft(solid_shaft(own, material, Cells::Linear));
    let body = body(store, table, materials, make);
    let motion = motion(table);
    let stiffening = table.optional_boolean("stiffening").unwrap_or(true);
    let static_correction = answers_to_loads(table);
    let axial_restraint = Some(table.text_or_none("axial_restraint"));
    let motion = motion.or_else(default_motion)?;
    let body = Body { static_correction, ..body? };
    let form = MeshedBody { stiffening, axial_restraint, ..MeshedBody::of(body) };
    let own = NamedBody::of(table.heading().text("shaft"), Form::Meshed(Box::new(form)));
    Some((NamedBody { rotation: Some(Rotation::Free), ..own }, motion))
}

/// The table `[support]`.
pub(super) fn support(store: FileStore, file: &Table, materials: &Materials) -> Option<NamedBody> {
    file.table("support")?.read(|table| read_support(store, table, materials))
}

fn read_support(store: FileStore, table: &Table, materials: &Materials) -> Option<NamedBody> {
    let make =
        |own: &Table, material| Dimensions::Support(ring_support(own, material, Cells::Linear));
    let body = body(store, table, materials, make);
    let ground_springs = ground_springs(table);
    let static_correction = static_correction(table);
    let mass_damping = mass_damping(table);
    let held = vec![table.text_or_none("mounts")];
    let body = Body { static_correction, mass_damping, ..body? };
    let form = MeshedBody { held, ground_springs, ..MeshedBody::of(body) };
    Some(NamedBody::of(table.heading().text("support"), Form::Meshed(Box::new(form))))
}

/// What static answers can be to.
const ANSWERED: [&str; 4] = ["loads", "outputs", "bores", "pressure"];

/// Static answers that are kept: to loads if nothing is said, to loads on bores, too, to what a list names, or none.
pub(in crate::case) fn static_correction(table: &Table) -> StaticCorrection {
    const KEY: &str = "static_correction";
    if !table.gives_list(KEY) && !table.gives_text(KEY) {
        let said = table.optional_boolean(KEY);
        let bores = (said == Some(true)).then(|| table.written(KEY));
        let usual = said != Some(false);
        let none = StaticCorrection::default();
        return StaticCorrection { loads: usual, pressure: usual, bores, ..none };
    }
    let none = StaticCorrection::default();
    let mut kept = StaticCorrection { loads: false, pressure: false, ..none };
    for own in table.texts(KEY) {
        match own.text() {
            "loads" => kept.loads = true,
            "outputs" => kept.outputs = true,
            "pressure" => (kept.pressure, kept.pressure_named) = (true, Some(own)),
            "bores" => kept.bores = Some(own),
            other => {
                let message = format!("`{other}` is nothing to which static answers are kept");
                let help =
                    format!("name some of `{}`, or write true or false", ANSWERED.join("`, `"));
                table.push(own.error_here(Code::BAD_VALUE, message).help(help));
            }
        }
    }
    kept
}

/// α of C = αM of a body that stands (1/s).
pub(in crate::case) fn mass_damping(table: &Table) -> f64 {
    table.quantity("mass_damping").unwrap_or(0.0)
}

/// Whether the answers of a body without bores to loads are kept.
fn answers_to_loads(table: &Table) -> StaticCorrection {
    let own = static_correction(table);
    if let Some(place) = own.bores {
        let message =
            "`static_correction` keeps the answers to loads on bores, and the shaft has none";
        let help = "leave it out: answers to the `[[load]]`s are kept anyway";
        table.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    StaticCorrection { bores: None, ..own }
}

/// The springs of a body to the ground.
pub(in crate::case) fn ground_springs(table: &Table) -> Vec<GroundSpring> {
    let ground_spring = |spring: &Table| GroundSpring {
        set: spring.text_or_none("set"),
        direction: match spring.optional_word("direction") {
            Some("z") => 2,
            Some("y") => 1,
            _ => 0,
        },
        stiffness: spring.quantity_or_one("stiffness"),
    };
    let springs = table.tables("ground_spring").into_iter();
    springs.map(|table| table.read(ground_spring)).collect()
}

/// What both tables may say.
pub(in crate::case) fn body(
    store: FileStore,
    table: &Table,
    materials: &Materials,
    make: impl Fn(&Table, Material) -> Dimensions,
) -> Option<Body> {
    let material = materials.of(table);
    let regions = materials.regions(table);
    let selections = selections::read(table);
    let mesh = mesh(store, table, material.as_ref(), make);
    Some(Body {
        modes: table.count_or_one("modes"),
        damping: table.quantity("damping").unwrap_or(0.0),
        mass_damping: 0.0,
        static_correction: StaticCorrection::default(),
        material,
        regions,
        selections,
        mesh: mesh?,
    })
}

/// A mesh by the file named as `mesh`, or made from the table `dimensions`.
fn mesh(
    store: FileStore,
    table: &Table,
    material: Option<&Material>,
    make: impl Fn(&Table, Material) -> Dimensions,
) -> Option<Mesh> {
    let before = table.errors();
    let dimensions = table.optional_table("dimensions");
    let (units, merge) = (units(table), merge(table));
    match (table.optional_string("mesh"), dimensions) {
        (Some(_), Some(dimensions)) => {
            table.conflict("mesh", "dimensions");
            // Read all the same, so that its keys are not unknown ones.
            dimensions.read(|dimensions| make(dimensions, no_material()));
            None
        }
        (Some(name), None) => {
            let path = resolve(name.source(), name.text());
            if store.is_on_disk() && !path.is_file() {
                let message = format!("there is no file `{}`", path.display());
                let error = name.error_here(Code::BAD_VALUE, message);
                table.push(error.help("paths are relative to the file that names them"));
                return None;
            }
            let units_given = table.gives("units");
            Some(Mesh::File(MeshFile { path, name, units: units?, units_given, merge }))
        }
        (None, Some(dimensions)) => {
            if !table.has("material") {
                table.absent("material", "a mesh made from dimensions needs `material = \"…\"`");
            }
            // Read without a material too, for the same reason.
            let (place, places) = (dimensions.heading().text(""), dimensions.places());
            let material_or_none = material.cloned().unwrap_or_else(no_material);
            let generated = dimensions.read(|dimensions| make(dimensions, material_or_none));
            // Of dimensions that are wrong, nothing is made.
            let right = table.errors() == before && material.is_some();
            right.then_some(Mesh::Generated(Box::new(GeneratedMesh {
                dimensions: generated,
                table: place,
                places,
            })))
        }
        (None, None) => {
            if !table.has("mesh") && !table.has("dimensions") {
                let help = "add `mesh = \"body.inp\"`, or a table of `dimensions`";
                table.absent("mesh", help);
            }
            None
        }
    }
}

/// Units of a mesh file: SI if none are named; `None` if they are wrong.
fn units(table: &Table) -> Option<MeshUnits> {
    let Some(text) = table.optional_string("units") else { return Some(MeshUnits::default()) };
    let read = match table.gives("mesh") {
        true => mesh_units(text.text()),
        false => Err((
            "`units` is of a mesh file".to_owned(),
            "leave it out: other quantities of a case name their units".to_owned(),
        )),
    };
    read.map_err(|(message, help)| {
        table.push(text.error_here(Code::BAD_VALUE, message).help(help));
    })
    .ok()
}

/// How far nodes of a mesh file may be apart that are to be one (m).
fn merge(table: &Table) -> Option<f64> {
    let merge = table.quantity("merge");
    if table.gives("merge") && !table.gives("mesh") {
        let message = "`merge` is of a mesh file";
        let help = "leave it out: a mesh made from dimensions has each node once";
        table.push(table.written("merge").error_here(Code::BAD_VALUE, message).help(help));
    }
    merge
}

fn no_material() -> Material {
    Material { name: String::new(), properties: BTreeMap::new() }
}

/// How the cells of a mesh made from dimensions are chosen where the table does not say it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Cells {
    /// Linear ones in layers that the table counts.
    Linear,
    /// Quadratic ones in layers that may be left open.
    Quadratic,
}

/// What the table `cells` says of all kinds of bodies: the order, and how far frequencies of bending may be off.
struct Order {
    order: usize,
    tolerance: f64,
    /// Where the case says the tolerance.
    given: Option<Located>,
}

impl Cells {
    fn order(self, cells: &Table) -> Order {
        let usual = if self == Cells::Linear { 1 } else { 2 };
        let order = cells.optional_count("order").unwrap_or(usual);
        let given = self == Cells::Quadratic && cells.has("tolerance");
        let tolerance = if given { cells.number_or_middle("tolerance") } else { FINE };
        Order { order, tolerance, given: given.then(|| cells.written("tolerance")) }
    }

    /// What `read` makes of the table `cells`, or of an empty one, with its order.
    fn read<T>(self, table: &Table, none: T, read: impl Fn(&Table) -> T) -> (T, Order) {
        let found = table.in_table("cells", |cells| (read(cells), self.order(cells)));
        let order = if self == Cells::Linear { 1 } else { 2 };
        found.unwrap_or((none, Order { order, tolerance: FINE, given: None }))
    }

    /// The counts of layers: those of the table, or as `chosen` by the tolerance where quadratic cells leave them open; a
    /// tolerance by which nothing is chosen is noted.
    fn layers(
        self,
        table: &Table,
        keys: [&str; 2],
        (order, given): (usize, Option<Located>),
        chosen: [usize; 2],
    ) -> [usize; 2] {
        let mut counts = chosen;
        let open = order == 2 && keys.iter().any(|key| !table.has(key));
        for (count, key) in counts.iter_mut().zip(keys) {
            if self == Cells::Quadratic && order == 1 {
                table.demand(key);
            }
            *count = match order {
                1 => table.count_or_one(key),
                _ => table.optional_count(key).unwrap_or(*count),
            };
        }
        if let Some(given) = given.filter(|_| !open) {
            let message = "no layers are chosen by this `tolerance`: it is of quadratic cells along a beam, in layers that \
                           are left out";
            let help = format!("leave it out, or leave out `{}` and `{}`", keys[0], keys[1]);
            table.push(given.error_here(Code::BAD_VALUE, message).help(help));
        }
        counts
    }
}

fn section(cells: &Table) -> SectionCells {
    let usual = SectionCells::default();
    SectionCells {
        sectors: cells.optional_count("sectors").unwrap_or(usual.sectors),
        rings: cells.optional_count("rings").unwrap_or(usual.rings),
        ..usual
    }
}

const IN_SUPPORT: [&str; 2] = ["layers_in_support", "layers_between"];

pub(in crate::case) fn crank_throw(table: &Table, material: Material, cells: Cells) -> CrankThrow {
    let (section, Order { order, given, .. }) = cells.read(table, SectionCells::default(), section);
    let mut own = CrankThrow {
        throw: table.quantity_or_one("throw"),
        diameter: table.quantity_or_one("diameter"),
        support_length: table.quantity_or_one("support_length"),
        pin_diameter: table.quantity_or_one("pin_diameter"),
        pin_length: table.quantity_or_one("pin_length"),
        web_width: table.quantity_or_one("web_width"),
        web_thickness: table.quantity_or_one("web_thickness"),
        layers_in_support: 0,
        layers_between: 0,
        section: SectionCells { order, ..section },
        material,
    };
    [own.layers_in_support, own.layers_between] =
        cells.layers(table, IN_SUPPORT, (order, None), own.default_layers());
    if let Some(given) = given {
        let message = "no layers are chosen by this `tolerance`: a crank is no beam";
        let help = "leave it out";
        table.push(given.error_here(Code::BAD_VALUE, message).help(help));
    }
    own
}

pub(in crate::case) fn solid_shaft(table: &Table, material: Material, cells: Cells) -> SolidShaft {
    let (section, Order { order, tolerance, given }) =
        cells.read(table, SectionCells::default(), section);
    let mut own = SolidShaft {
        length: table.quantity_or_one("length"),
        diameter: table.quantity_or_one("diameter"),
        supports: table.quantities("supports"),
        support_length: table.quantity_or_one("support_length"),
        layers_in_support: 0,
        layers_between: 0,
        loads: table.quantities("loads"),
        sections: Vec::new(),
        section: SectionCells { order, ..section },
        material,
    };
    [own.layers_in_support, own.layers_between] =
        cells.layers(table, IN_SUPPORT, (order, given), own.layers_for(tolerance));
    own
}

pub(in crate::case) fn ring_support(
    table: &Table,
    material: Material,
    cells: Cells,
) -> RingSupport {
    let section = |cells: &Table| {
        let usual = SupportCells::default();
        let count = |key, usual| cells.optional_count(key).unwrap_or(usual);
        SupportCells {
            height: count("height", usual.height),
            width: count("width", usual.width),
            pedestal: count("pedestal", usual.pedestal),
            around: count("around", usual.around),
            radial: count("radial", usual.radial),
            ..usual
        }
    };
    let (section, Order { order, tolerance, given }) =
        cells.read(table, SupportCells::default(), section);
    let mut own = RingSupport {
        start: table.quantity_or_one("start"),
        length: table.quantity_or_one("length"),
        height: table.quantity_or_one("height"),
        width: table.quantity_or_one("width"),
        pedestal_height: table.quantity_or_one("pedestal_height"),
        rings: table.quantities("rings"),
        ring_length: table.quantity_or_one("ring_length"),
        ring_thickness: table.quantity_or_one("ring_thickness"),
        bore_radius: table.quantity_or_one("bore_radius"),
        layers_in_ring: 0,
        layers_between: 0,
        section: SupportCells { order, ..section },
        material,
    };
    [own.layers_in_ring, own.layers_between] = cells.layers(
        table,
        ["layers_in_ring", "layers_between"],
        (order, given),
        own.layers_for(tolerance),
    );
    own
}
