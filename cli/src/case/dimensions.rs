//! Dimensions from which meshes are made.

use whirl_codegen::diagnostic::Located;
use whirl_solver::error::Error;
use whirl_solver::mesh::crank::CrankThrow;
use whirl_solver::mesh::sections::SectionTable;
use whirl_solver::mesh::shaft::SolidShaft;
use whirl_solver::mesh::support::RingSupport;
use whirl_solver::mesh::{Fineness, Material, Mesh};
use whirl_specs::Element;

use crate::ring::Ring;

/// A part of what a row has beside its cells, where its mass reaches farther out than its stiffness.
#[derive(Debug, Clone)]
pub(crate) struct RowRing {
    /// The row.
    pub(crate) place: Located,
    /// What it is.
    pub(crate) ring: Ring,
}

/// A table of sections as a case has it.
#[derive(Debug, Clone)]
pub(crate) struct Sections {
    /// Of which the mesh is made.
    pub(crate) table: SectionTable,
    /// What its cells lack.
    pub(crate) rings: Vec<RowRing>,
}

/// Dimensions from which a mesh is made.
#[derive(Debug, Clone)]
pub(crate) enum Dimensions {
    /// Of a solid shaft.
    Shaft(SolidShaft),
    /// Of one throw of a crankshaft.
    Crank(CrankThrow),
    /// Of rings below a beam.
    Support(RingSupport),
    /// Of a round body, by its sections.
    Sections(Box<Sections>),
}

impl Dimensions {
    /// The mesh.
    ///
    /// # Errors
    /// Dimensions of which none can be made.
    pub(crate) fn mesh(&self, elements: &[&'static Element]) -> Result<Mesh, Error> {
        match self {
            Dimensions::Shaft(shaft) => shaft.mesh(elements),
            Dimensions::Crank(crank) => crank.mesh(elements),
            Dimensions::Support(support) => support.mesh(elements),
            Dimensions::Sections(own) => own.table.mesh(elements),
        }
    }

    /// How fine the layers of the mesh are, where that is known.
    pub(crate) fn fineness(&self) -> Option<Fineness> {
        match self {
            Dimensions::Shaft(shaft) => shaft.fineness(),
            Dimensions::Crank(_) => None,
            Dimensions::Support(support) => support.fineness(),
            Dimensions::Sections(own) => own.table.fineness(),
        }
    }

    /// The materials of rows; none where one material is that of all cells.
    pub(crate) fn materials(&self) -> Vec<&Material> {
        match self {
            Dimensions::Sections(own) => own.table.rows.iter().map(|row| &row.material).collect(),
            _ => Vec::new(),
        }
    }
}
