//! Reading the files of a body of matrices.

use std::collections::BTreeMap;
use std::path::Path;

use super::super::format::Format;
use super::super::placed_nodes::PlacedNodes;
use super::super::raw::{LinePosition, MeshReport};
use super::super::text::decode;
use super::super::units::MeshUnits;
use super::super::{Mesh, bdf, inp};
use super::build::{Others, RawMatrices};
use super::dmig::{DmigFile, Dofs};
use super::entries::Entries;
use super::kinds::{self, Kind, file_and_name};
use super::request::{Files, Request, of_job};
use super::{abaqus, calculix, shown, table};
use crate::error::{InputError, InputErrors};

/// Gives the bytes of a file.
pub type Load<'a> = &'a dyn Fn(&Path) -> std::io::Result<Vec<u8>>;

/// A body of matrices with what is to be said of it.
#[derive(Debug, Clone)]
pub struct ReadMatrices {
    /// A mesh without cells, which carries the matrices.
    pub mesh: Mesh,
    /// What looks odd, in the order of the files.
    pub warnings: Vec<InputError>,
}

/// Reads matrices with their dofs; `load` gives the bytes of a file.
///
/// # Errors
/// All that is wrong, each with its file and place, and how to fix it.
pub fn read(request: &Request, load: Load<'_>) -> Result<ReadMatrices, InputErrors> {
    let mut reader = Reader {
        report: MeshReport::new(&shown(request.main())),
        load,
        files: 0,
        by_coordinates: false,
    };
    let read = reader.read(request);
    let Reader { report, .. } = reader;
    let Some(raw) = read.filter(|_| report.error_count() == 0) else {
        return Err(report.into_errors());
    };
    let (mesh, report) = raw.finish(report)?;
    Ok(ReadMatrices { mesh, warnings: report.into_warnings() })
}

struct Reader<'a> {
    report: MeshReport,
    load: Load<'a>,
    /// Files that were asked for.
    files: usize,
    /// Whether K or M are of Abaqus by rows and columns.
    by_coordinates: bool,
}

impl Reader<'_> {
    /// The text of a file, and its index in the report; of one that cannot be read there is none.
    fn text(&mut self, path: &Path) -> (String, usize) {
        let (bytes, file) = self.bytes(path);
        (decode(bytes), file)
    }

    /// The bytes of a file, and its index in the report; of one that cannot be read there are none.
    fn bytes(&mut self, path: &Path) -> (Vec<u8>, usize) {
        // The report begins with a file, which is the first one that is read.
        match self.files {
            0 => self.report.files[0] = shown(path),
            _ => self.report.files.push(shown(path)),
        }
        self.files += 1;
        let file = self.report.files.len() - 1;
        match (self.load)(path) {
            Ok(bytes) => (bytes, file),
            Err(error) => {
                let at = LinePosition { file, line: 0, column: 0 };
                let help = "paths are relative to the case; its name is as the case has it";
                self.report.error(at, format!("it cannot be read: {error}"), help);
                (Vec::new(), file)
            }
        }
    }

    fn failed(&self) -> bool {
        self.report.error_count() > 0
    }

    fn read(&mut self, request: &Request) -> Option<RawMatrices> {
        match &request.files {
            Files::Market { stiffness, mass, dofs } => {
                self.of_market(request, [stiffness, mass], dofs)
            }
            Files::Calculix { job, nodes } => self.of_calculix(request, job, nodes),
            Files::Abaqus { stiffness, mass, nodes } => {
                self.of_abaqus(request, [stiffness, mass], nodes)
            }
            Files::Dmig { file, nodes, stiffness, mass } => {
                self.of_nastran(request, (file, nodes), [stiffness, mass])
            }
        }
    }

    fn of_market(
        &mut self,
        request: &Request,
        [stiffness, mass]: [&Path; 2],
        dofs: &Path,
    ) -> Option<RawMatrices> {
        let (text, file) = self.text(dofs);
        if self.failed() {
            return None;
        }
        let (list, nodes) = table::read(&text, file, &request.units, &mut self.report);
        if self.failed() {
            return None;
        }
        let size = list.len();
        let [k, m] =
            [(stiffness, "K"), (mass, "M")].map(|(path, name)| self.matrix(path, name, size));
        let others = self.others(request, size);
        let (k, m) = (k?, m?);
        if self.by_coordinates {
            abaqus::complete([&k, &m], |dof| list[dof].called(), size, &mut self.report);
        }
        Some(RawMatrices {
            dofs: list,
            nodes,
            stiffness: k,
            mass: m,
            others,
            units: request.units,
            origin: shown(stiffness),
            placed_by: shown(dofs),
        })
    }

    fn of_calculix(&mut self, request: &Request, job: &Path, nodes: &Path) -> Option<RawMatrices> {
        let [dofs, stiffness, mass] = of_job(job);
        let (text, file) = self.text(&dofs);
        if self.failed() {
            return None;
        }
        let list = calculix::dofs(&text, file, &mut self.report);
        let placed = self.nodes(nodes, request.units);
        if self.failed() {
            return None;
        }
        let size = list.len();
        let [k, m] = [("K", &stiffness), ("M", &mass)].map(|(name, path)| {
            let before = self.report.error_count();
            let (text, file) = self.text(path);
            let right = self.report.error_count() == before;
            right.then(|| calculix::matrix(&text, (name, file), size, &mut self.report))
        });
        let others = self.others(request, size);
        Some(RawMatrices {
            dofs: list,
            nodes: placed,
            stiffness: k?,
            mass: m?,
            others,
            units: request.units,
            origin: shown(&stiffness),
            placed_by: shown(nodes),
        })
    }

    fn of_nastran(
        &mut self,
        request: &Request,
        (file, nodes): (&Path, &Path),
        [stiffness, mass]: [&str; 2],
    ) -> Option<RawMatrices> {
        let (text, index) = self.text(file);
        let include = |path: &Path| (self.load)(path).map(decode);
        let matrices = bdf::matrices(&text, &include, &mut self.report);
        let placed = match nodes == file {
            true => self.placed(&text, file, request.units),
            false => self.nodes(nodes, request.units),
        };
        if self.failed() {
            return None;
        }
        let own = DmigFile { matrices, file: index };
        let names = [("stiffness", stiffness), ("mass", mass)];
        let dofs = own.dofs(&names, &mut self.report);
        if self.failed() {
            return None;
        }
        let [k, m] = [(names[0], "K"), (names[1], "M")]
            .map(|(name, called)| own.entries(name, called, &dofs, &mut self.report));
        let others = self.of_dmig(request, &own, &dofs);
        Some(RawMatrices {
            dofs: dofs.list,
            nodes: placed,
            stiffness: k?,
            mass: m?,
            others,
            units: request.units,
            origin: shown(file),
            placed_by: shown(nodes),
        })
    }

    fn of_abaqus(
        &mut self,
        request: &Request,
        [stiffness, mass]: [&Path; 2],
        nodes: &Path,
    ) -> Option<RawMatrices> {
        let mut own = DmigFile { matrices: BTreeMap::new(), file: 0 };
        let Request { spin_inertia, spin_coupling, spin_load, stiffening, .. } = request;
        let beside = |name: &String| request.folder.join(name);
        let others = [spin_inertia, spin_coupling, stiffening].map(|own| own.as_ref().map(beside));
        let [inertia, coupling, stiff] = others;
        let named = [
            ("K", Some(stiffness.to_owned())),
            ("M", Some(mass.to_owned())),
            ("Y", inertia),
            ("H", coupling),
            ("G", stiff),
        ];
        let load = spin_load.as_ref().map(|name| ("Y x0", beside(name)));
        for (name, path) in
            named.into_iter().filter_map(|(name, path)| Some((name, path?))).chain(load)
        {
            let before = self.report.error_count();
            let (bytes, file) = self.bytes(&path);
            if self.report.error_count() == before {
                let read = kinds::labelled(bytes, (name, file), &mut self.report);
                own.matrices.extend(read.map(|read| (name.to_ascii_uppercase(), read)));
            }
        }
        let placed = self.nodes(nodes, request.units);
        if self.failed() {
            return None;
        }
        let names = [("stiffness", "K"), ("mass", "M")];
        let dofs = own.dofs(&names, &mut self.report);
        let report = &mut self.report;
        let mut entries = |key: &str, name: &str| own.entries((key, name), name, &dofs, report);
        let (k, m) = (entries("stiffness", "K")?, entries("mass", "M")?);
        let inertia = spin_inertia.as_ref().and_then(|_| entries("spin_inertia", "Y"));
        let coupling = spin_coupling.as_ref().and_then(|_| entries("spin_coupling", "H"));
        let stiffening = stiffening.as_ref().and_then(|_| entries("stiffening", "G"));
        let load = spin_load.as_ref();
        let spin_load =
            load.and_then(|_| own.column(("spin_load", "Y x0"), &dofs, &mut self.report));
        abaqus::complete(
            [&k, &m],
            |dof| dofs.list[dof].called(),
            dofs.list.len(),
            &mut self.report,
        );
        Some(RawMatrices {
            dofs: dofs.list,
            nodes: placed,
            stiffness: k,
            mass: m,
            others: Others {
                spin_inertia: inertia,
                spin_coupling: coupling,
                stiffening,
                spin_load,
            },
            units: request.units,
            origin: shown(stiffness),
            placed_by: shown(nodes),
        })
    }

    /// A matrix by rows and columns, in whichever format it is.
    fn matrix(&mut self, path: &Path, name: &str, size: usize) -> Option<Entries> {
        let (path, wanted) = file_and_name(path);
        let (before, (bytes, file)) = (self.report.error_count(), self.bytes(&path));
        if self.report.error_count() > before {
            return None;
        }
        let kind = kinds::kind(&bytes);
        self.by_coordinates |= kind == Kind::Coordinate;
        kinds::matrix(kind, bytes, (name, file), wanted.as_deref(), size, &mut self.report)
    }

    /// The other matrices as files of their own.
    fn others(&mut self, request: &Request, size: usize) -> Others {
        let mut matrix = |own: &Option<String>, name: &str| {
            let path = request.folder.join(own.as_ref()?);
            self.matrix(&path, name, size)
        };
        let inertia = matrix(&request.spin_inertia, "Y");
        let coupling = matrix(&request.spin_coupling, "H");
        let stiffening = matrix(&request.stiffening, "G");
        let load = request.spin_load.as_ref().and_then(|own| {
            let (path, wanted) = file_and_name(&request.folder.join(own));
            let (bytes, file) = self.bytes(&path);
            match self.failed() {
                true => None,
                false => {
                    kinds::column(bytes, ("Y x0", file), wanted.as_deref(), size, &mut self.report)
                }
            }
        });
        Others { spin_inertia: inertia, spin_coupling: coupling, stiffening, spin_load: load }
    }

    /// The other matrices as DMIG.
    fn of_dmig(&mut self, request: &Request, file: &DmigFile, dofs: &Dofs) -> Others {
        let report = &mut self.report;
        let mut matrix = |key: &str, own: &Option<String>, called: &str| {
            file.entries((key, own.as_ref()?), called, dofs, report)
        };
        let inertia = matrix("spin_inertia", &request.spin_inertia, "Y");
        let coupling = matrix("spin_coupling", &request.spin_coupling, "H");
        let stiffening = matrix("stiffening", &request.stiffening, "G");
        let load = request.spin_load.as_ref();
        let load = load.and_then(|own| file.column(("spin_load", own), dofs, &mut self.report));
        Others { spin_inertia: inertia, spin_coupling: coupling, stiffening, spin_load: load }
    }

    /// Where the nodes of a file are (m): input of Abaqus or CalculiX, or bulk data.
    fn nodes(&mut self, path: &Path, units: MeshUnits) -> PlacedNodes {
        let (text, _) = self.text(path);
        match self.failed() {
            true => PlacedNodes::default(),
            false => self.placed(&text, path, units),
        }
    }

    /// The same of the text of the last file of the report.
    fn placed(&mut self, text: &str, path: &Path, units: MeshUnits) -> PlacedNodes {
        let include = |path: &Path| (self.load)(path).map(decode);
        let path = shown(path);
        let mut nodes = match Format::of(text.as_bytes(), &path) {
            Format::Inp => inp::placed_nodes(text, &path, &mut self.report),
            Format::Bdf => bdf::grid_points(text, &include, &mut self.report),
            other => {
                let file = self.report.files.len() - 1;
                let what = format!(
                    "nodes of matrices are not read from this kind of file ({})",
                    other.called()
                );
                let help = "name the input file of CalculiX or Abaqus, or bulk data of Nastran";
                self.report.error(LinePosition { file, line: 0, column: 0 }, what, help);
                PlacedNodes::default()
            }
        };
        for place in nodes.places.values_mut() {
            *place = place.map(|x| units.length(x));
        }
        nodes
    }
}
