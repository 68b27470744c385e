//! Which files a body of matrices has, and their reading.

use std::path::{Path, PathBuf};

use super::super::format::Format;
use super::super::placed_nodes::PlacedNodes;
use super::super::raw::{LinePosition, MeshReport};
use super::super::text::decode;
use super::super::units::MeshUnits;
use super::super::{Mesh, bdf, inp};
use super::build::{Others, RawMatrices};
use super::dmig::{DmigFile, Dofs};
use super::entries::Entries;
use super::{calculix, market, shown, table};
use crate::error::{InputError, InputErrors};

/// Gives the bytes of a file.
pub type Load<'a> = &'a dyn Fn(&Path) -> std::io::Result<Vec<u8>>;

/// The files of K and M, by the program that wrote them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Files {
    /// Matrix Market files.
    Market {
        /// K.
        stiffness: PathBuf,
        /// M.
        mass: PathBuf,
        /// A table of the dofs.
        dofs: PathBuf,
    },
    /// Cards `DMIG` of Nastran.
    Dmig {
        /// The punch file, or bulk data.
        file: PathBuf,
        /// Bulk data with the grid points.
        nodes: PathBuf,
        /// Name of K.
        stiffness: String,
        /// Name of M.
        mass: String,
    },
    /// `JOB.sti`, `JOB.mas` and `JOB.dof` of CalculiX.
    Calculix {
        /// Path of the job, without what stands behind the point.
        job: PathBuf,
        /// The input file, with the nodes.
        nodes: PathBuf,
    },
}

/// What is to be read.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// K and M.
    pub files: Files,
    /// Y, H, Y x0 and G, where they are given: Matrix Market files, or names of DMIG in the file of K.
    pub spin_inertia: Option<String>,
    /// H.
    pub spin_coupling: Option<String>,
    /// Y x0, one column.
    pub spin_load: Option<String>,
    /// G.
    pub stiffening: Option<String>,
    /// Folder from which the names of these files count.
    pub folder: PathBuf,
    /// Units of all numbers.
    pub units: MeshUnits,
}

impl Request {
    /// All files that it names.
    pub fn paths(&self) -> Vec<PathBuf> {
        let (mut paths, others) = match &self.files {
            Files::Market { stiffness, mass, dofs } => {
                (vec![stiffness.clone(), mass.clone(), dofs.clone()], true)
            }
            // Others are names of cards in it.
            Files::Dmig { file, nodes, .. } => (vec![file.clone(), nodes.clone()], false),
            Files::Calculix { job, nodes } => {
                let [dofs, stiffness, mass] = of_job(job);
                (vec![dofs, stiffness, mass, nodes.clone()], true)
            }
        };
        if others {
            let Request { spin_inertia, spin_coupling, spin_load, stiffening, .. } = self;
            let more = [spin_inertia, spin_coupling, spin_load, stiffening].into_iter().flatten();
            paths.extend(more.map(|own| self.folder.join(own)));
        }
        paths
    }
}

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
    let mut reader = Reader { report: MeshReport::new(&shown(request.main())), load, files: 0 };
    let read = reader.read(request);
    let Reader { report, .. } = reader;
    let Some(raw) = read.filter(|_| report.error_count() == 0) else {
        return Err(report.into_errors());
    };
    let (mesh, report) = raw.finish(report)?;
    Ok(ReadMatrices { mesh, warnings: report.into_warnings() })
}

impl Request {
    /// The file that the others are beside.
    fn main(&self) -> &Path {
        match &self.files {
            Files::Market { stiffness, .. } => stiffness,
            Files::Dmig { file, .. } => file,
            Files::Calculix { job, .. } => job,
        }
    }
}

/// The files of the dofs, of K and of M that a job of CalculiX leaves.
fn of_job(job: &Path) -> [PathBuf; 3] {
    [".dof", ".sti", ".mas"].map(|end| {
        let mut path = job.as_os_str().to_owned();
        path.push(end);
        PathBuf::from(path)
    })
}

struct Reader<'a> {
    report: MeshReport,
    load: Load<'a>,
    /// Files that were asked for.
    files: usize,
}

impl Reader<'_> {
    /// The text of a file, and its index in the report; of one that cannot be read there is none.
    fn text(&mut self, path: &Path) -> (String, usize) {
        // The report begins with a file, which is the first one that is read.
        match self.files {
            0 => self.report.files[0] = shown(path),
            _ => self.report.files.push(shown(path)),
        }
        self.files += 1;
        let file = self.report.files.len() - 1;
        match (self.load)(path) {
            Ok(bytes) => (decode(bytes), file),
            Err(error) => {
                let at = LinePosition { file, line: 0, column: 0 };
                let help = "paths are relative to the case; its name is as the case has it";
                self.report.error(at, format!("it cannot be read: {error}"), help);
                (String::new(), file)
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
            [(stiffness, "K"), (mass, "M")].map(|(path, name)| self.market(path, name, size));
        let others = self.others(request, size);
        Some(RawMatrices {
            dofs: list,
            nodes,
            stiffness: k?,
            mass: m?,
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

    fn market(&mut self, path: &Path, name: &str, size: usize) -> Option<Entries> {
        let (before, (text, file)) = (self.report.error_count(), self.text(path));
        match self.report.error_count() > before {
            true => None,
            false => market::matrix(&text, (name, file), size, &mut self.report),
        }
    }

    /// The other matrices as Matrix Market files.
    fn others(&mut self, request: &Request, size: usize) -> Others {
        let mut matrix = |own: &Option<String>, name: &str| {
            let path = request.folder.join(own.as_ref()?);
            self.market(&path, name, size)
        };
        let inertia = matrix(&request.spin_inertia, "Y");
        let coupling = matrix(&request.spin_coupling, "H");
        let stiffening = matrix(&request.stiffening, "G");
        let load = request.spin_load.as_ref().and_then(|own| {
            let (text, file) = self.text(&request.folder.join(own));
            match self.failed() {
                true => None,
                false => market::column(&text, ("Y x0", file), size, &mut self.report),
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
            other @ (Format::Msh | Format::Unv) => {
                let file = self.report.files.len() - 1;
                let what = match other {
                    Format::Msh => "nodes of matrices are not read from meshes of Gmsh",
                    _ => "nodes of matrices are not read from universal files",
                };
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
