//! The table `[body.NAME] matrices`: a body by matrices that another program wrote.

use std::path::PathBuf;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::mesh::matrices::{Files, Request, file_and_name};

use crate::case::library::{FileStore, resolve};
use crate::case::rotor::{Body, MatrixFiles, Mesh, StaticCorrection};
use crate::case::selections;
use crate::case::units::mesh_units;

/// Keys of a mesh that matrices have not, and what to do instead.
const OF_MESH: [(&str, &str); 3] = [
    ("merge", "leave it out: K and M say which nodes are joined"),
    ("material", "leave it out: K and M have the stiffness and the mass of the material"),
    ("regions", "leave it out: K and M have the stiffness and the mass of all materials"),
];
/// Names that Nastran gives to K and M.
const DMIG_NAMES: [&str; 2] = ["KAAX", "MAAX"];
/// Keys by which the program is told that wrote the matrices.
const KINDS: [&str; 3] = ["dmig", "calculix", "dofs"];

/// Reads what a table says of a body of matrices.
pub(super) fn read(store: FileStore, table: &Table) -> Option<Body> {
    let before = table.errors();
    for key in ["mesh", "dimensions"].into_iter().filter(|key| table.has(key)) {
        table.conflict(key, "matrices");
        table.pass_over(key);
    }
    for (key, help) in OF_MESH {
        if table.has(key) {
            table.pass_over(key);
            let message = format!("`{key}` is of a mesh, and this body has `matrices`");
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    let selections = selections::read(table);
    let units = units(table);
    let place = table.written("matrices");
    let all_modes = !table.has("modes");
    // As many as there are is known once the dofs are.
    let modes = if all_modes { 0 } else { table.count_or_one("modes") };
    let damping = table.quantity("damping").unwrap_or(0.0);
    let request = table.in_table("matrices", |own| request(store, own, units?)).flatten();
    let right = table.errors() == before;
    let request = request.filter(|_| right)?;
    Some(Body {
        modes,
        damping,
        mass_damping: 0.0,
        static_correction: StaticCorrection::default(),
        material: None,
        regions: Vec::new(),
        selections,
        mesh: Mesh::Matrices(Box::new(MatrixFiles { request, place, all_modes })),
    })
}

/// Units of the files: SI if none are named; `None` if they are wrong.
fn units(table: &Table) -> Option<MeshUnits> {
    let Some(text) = table.optional_string("units") else { return Some(MeshUnits::default()) };
    let read = mesh_units(text.text());
    read.map_err(|(message, help)| {
        table.push(text.error_here(Code::BAD_VALUE, message).help(help));
    })
    .ok()
}

fn request(store: FileStore, own: &Table, units: MeshUnits) -> Option<Request> {
    let text = |key: &str| own.optional_string(key);
    let (stiffness, mass, dofs) = (text("stiffness"), text("mass"), text("dofs"));
    let (dmig, calculix, nodes) = (text("dmig"), text("calculix"), text("nodes"));
    let others = ["spin_inertia", "spin_coupling", "spin_load", "stiffening"].map(text);
    let given: Vec<&str> = KINDS.into_iter().filter(|key| own.gives(key)).collect();
    if !given.contains(&"dmig") {
        for name in others.iter().flatten() {
            file(store, own, name);
        }
    }
    together(own);
    let files = match given[..] {
        ["dofs"] => {
            own.demand("stiffness");
            own.demand("mass");
            if let Some(nodes) = &nodes {
                let message = "the places of the nodes are in the table of `dofs`";
                let help = "leave `nodes` out";
                own.push(nodes.error_here(Code::BAD_VALUE, message).help(help));
            }
            let [stiffness, mass, dofs] =
                [stiffness?, mass?, dofs?].map(|name| file(store, own, &name));
            Files::Market { stiffness: stiffness?, mass: mass?, dofs: dofs? }
        }
        ["dmig"] => {
            own.demand("nodes");
            let [file, nodes] = [dmig?, nodes?].map(|name| file(store, own, &name));
            let [k, m] = DMIG_NAMES.map(str::to_owned);
            let name = |own: Option<Located>, usual| own.map_or(usual, |own| own.text().to_owned());
            Files::Dmig {
                file: file?,
                nodes: nodes?,
                stiffness: name(stiffness, k),
                mass: name(mass, m),
            }
        }
        [_] => {
            own.demand("nodes");
            for name in [stiffness, mass].into_iter().flatten() {
                let message = "the matrices of CalculiX are JOB.sti and JOB.mas beside JOB.dof";
                let help = "leave this out, and name the job as `calculix = \"JOB\"`";
                own.push(name.error_here(Code::BAD_VALUE, message).help(help));
            }
            let (job, nodes) = (calculix?, file(store, own, &nodes?));
            let path = resolve(job.source(), job.text());
            // The name of the job, or of one of its files.
            let path = match path.extension().and_then(|end| end.to_str()) {
                Some("sti" | "mas" | "dof" | "inp") => path.with_extension(""),
                _ => path,
            };
            for end in [".dof", ".sti", ".mas"] {
                let mut beside = path.clone().into_os_string();
                beside.push(end);
                exists(store, own, &job, &PathBuf::from(beside));
            }
            Files::Calculix { job: path, nodes: nodes? }
        }
        [first, second, ..] => {
            own.conflict(first, second);
            return None;
        }
        [] if nodes.is_some() => {
            own.demand("stiffness");
            own.demand("mass");
            let [stiffness, mass, nodes] =
                [stiffness?, mass?, nodes?].map(|name| file(store, own, &name));
            Files::Abaqus { stiffness: stiffness?, mass: mass?, nodes: nodes? }
        }
        [] => {
            let help = "add `dofs = \"dofs.csv\"` for files of Matrix Market or OUTPUT4, `nodes = \"JOB.inp\"` for those of \
                        Abaqus, `dmig = \"model.pch\"` for a punch file of Nastran, or `calculix = \"JOB\"`";
            own.absent("dofs", help);
            return None;
        }
    };
    let folder = own.source().path.parent().map(std::path::Path::to_path_buf).unwrap_or_default();
    let [spin_inertia, spin_coupling, spin_load, stiffening] =
        others.map(|own| own.map(|own| own.text().to_owned()));
    Some(Request { files, spin_inertia, spin_coupling, spin_load, stiffening, folder, units })
}

/// Notes Y, H and Y x0 of which one is missing.
fn together(own: &Table) {
    const ALL: [&str; 3] = ["spin_inertia", "spin_coupling", "spin_load"];
    let Some(first) = ALL.into_iter().find(|key| own.gives(key)) else { return };
    for key in ALL.into_iter().filter(|key| !own.gives(key)) {
        let message = format!("`{first}` is given without `{key}`");
        let help = "give `spin_inertia` (Y), `spin_coupling` (H) and `spin_load` (Y x0) together";
        own.push(own.written(first).error_here(Code::BAD_VALUE, message).help(help));
    }
}

/// The path of a file, if there is one.
fn file(store: FileStore, table: &Table, name: &Located) -> Option<PathBuf> {
    let path = resolve(name.source(), name.text());
    exists(store, table, name, &file_and_name(&path).0).then_some(path)
}

fn exists(store: FileStore, table: &Table, name: &Located, path: &std::path::Path) -> bool {
    if !store.is_on_disk() || path.is_file() {
        return true;
    }
    let message = format!("there is no file `{}`", path.display());
    let error = name.error_here(Code::BAD_VALUE, message);
    table.push(error.help("paths are relative to the file that names them"));
    false
}
