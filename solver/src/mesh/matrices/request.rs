//! Which files a body of matrices has.

use std::path::{Path, PathBuf};

use super::super::units::MeshUnits;
use super::kinds::file_and_name;

/// The files of K and M, by the program that wrote them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Files {
    /// Files that list entries by rows and columns: Matrix Market, OUTPUT4 of Nastran, `FORMAT=COORDINATE` of Abaqus.
    Market {
        /// K; the name of a matrix among several of a file stands behind a colon.
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
    /// Files of Abaqus that list entries by nodes and dofs.
    Abaqus {
        /// K.
        stiffness: PathBuf,
        /// M.
        mass: PathBuf,
        /// The input file, with the nodes.
        nodes: PathBuf,
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
    /// Y, H, Y x0 and G, where they are given: files as those of K and M, or names of DMIG in the file of K.
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
            Files::Market { stiffness, mass, dofs: other }
            | Files::Abaqus { stiffness, mass, nodes: other } => {
                (vec![file_and_name(stiffness).0, file_and_name(mass).0, other.clone()], true)
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
            paths.extend(more.map(|own| file_and_name(&self.folder.join(own)).0));
        }
        paths
    }
}

impl Request {
    /// The file that the others are beside.
    pub(super) fn main(&self) -> &Path {
        match &self.files {
            Files::Market { stiffness, .. } | Files::Abaqus { stiffness, .. } => stiffness,
            Files::Dmig { file, .. } => file,
            Files::Calculix { job, .. } => job,
        }
    }
}

/// The files of the dofs, of K and of M that a job of CalculiX leaves.
pub(super) fn of_job(job: &Path) -> [PathBuf; 3] {
    [".dof", ".sti", ".mas"].map(|end| {
        let mut path = job.as_os_str().to_owned();
        path.push(end);
        PathBuf::from(path)
    })
}
