//! Bodies before their reduction, and what they carry.

use std::io;

use super::place::Place;
use crate::attached::{Disc, PointMass, Unbalance};
use crate::bodies::{Body, Rotation};
use crate::body::{BodyNode, BodySpec};
use crate::cache::{Cache, Found, Key};
use crate::error::Error;
use crate::linalg::Matrix;
use crate::measure::MeanMotion;
use crate::mesh::{Mesh, NodeSetMean};
use crate::reduced::{BodyKind, Reduced};
use crate::rigid::{RigidBody, RigidInertia};
use crate::shaft::Shaft;
use crate::support::Support;

/// A body before its reduction.
#[derive(Debug, Clone)]
pub struct BodyModel<'a> {
    /// Its name in messages and results.
    pub name: &'a str,
    /// What it is.
    pub form: Form<'a>,
    /// How it turns; none of a body that does not.
    pub rotation: Option<Rotation>,
    /// What it carries, if it turns.
    pub carried: Vec<Attachment>,
}

/// What a body is.
#[derive(Debug, Clone)]
pub enum Form<'a> {
    /// A mesh that deforms.
    Flexible(MeshModel<'a>),
    /// A mesh taken as rigid, and whether it may move along z.
    RigidMesh(MeshModel<'a>, bool),
    /// Numbers, with the positions of its points (m).
    Rigid(&'a RigidBody, &'a [[f64; 3]]),
    /// What never moves.
    Ground,
}

/// A mesh, with what joints and loads see of it.
#[derive(Debug, Clone, Copy)]
pub struct MeshModel<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// How it is reduced.
    pub spec: &'a BodySpec,
    /// The points of the body, in the order of their places: nodes and means of the spec.
    pub points: &'a [Point],
    /// Place of the retained motion that follows from the others, in the frame in which deformations have no angular
    /// momentum; none in a frame that the constraints of the spec tie to the body.
    pub follows: Option<usize>,
}

/// A point of a body of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Point {
    /// One of the nodes of the spec.
    Node(usize),
    /// A place (m) that moves with one of its means.
    OnMean(usize, [f64; 3]),
}

/// Something on a section of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// The mean motion of the section; or a point, of a body that is rigid.
    pub at: Place,
    /// Its place along z (m).
    pub z: f64,
    /// What it is.
    pub kind: AttachmentKind,
}

/// What a section carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AttachmentKind {
    /// A rigid disc, its centre of mass on the axis.
    Disc {
        /// kg.
        mass: f64,
        /// I_p, about the axis (kg·m²).
        polar_inertia: f64,
        /// I_d, about a diameter (kg·m²).
        diametral_inertia: f64,
    },
    /// A point mass.
    Mass {
        /// kg.
        mass: f64,
        /// Along x and y of the turning frame (m).
        offset: [f64; 2],
    },
    /// Mass times eccentricity along x and y of the turning frame (kg·m).
    Unbalance([f64; 2]),
}

/// A body, ready to be joined to others.
#[derive(Debug)]
pub struct ReducedBody {
    /// The body.
    pub body: Body,
    /// How it was reduced, if it was.
    pub reduction: Option<Reduction>,
}

/// How a body was reduced.
#[derive(Debug)]
pub struct Reduction {
    /// A hash of what the body and its points depend on.
    pub content: Key,
    /// Whether it was found in the cache.
    pub cached: bool,
    /// Why it could not be kept there.
    pub unkept: Option<io::Error>,
}

impl BodyModel<'_> {
    /// The key under which a reduction of its mesh is kept; none without a mesh.
    pub(super) fn key(&self) -> Option<Key> {
        match &self.form {
            Form::Flexible(own) | Form::RigidMesh(own, _) => {
                Some(Reduced::key(self.kind(), own.mesh, own.spec))
            }
            _ => None,
        }
    }

    fn kind(&self) -> BodyKind {
        if self.rotation.is_some() { BodyKind::Shaft } else { BodyKind::Support }
    }

    /// The body; its reduction may use one of so many equal parts of the memory that its spec allows.
    pub(super) fn reduce(
        &self,
        cache: Option<&Cache>,
        sharing: usize,
    ) -> Result<ReducedBody, Error> {
        let mut reduction = None;
        let body = match (&self.form, &self.rotation) {
            (Form::Flexible(own), rotation) => {
                let (found, how) = own.reduce(self.kind(), cache, sharing)?;
                reduction = Some(how);
                match rotation {
                    Some(rotation) => {
                        let shaft = found.shaft(own.spec)?;
                        let nodes = own.seen(&shaft.nodes, &shaft.measures);
                        let shaft = self.carrying(Shaft { nodes, ..shaft });
                        Body::turning(self.name, own.in_frame(shaft), rotation.clone())
                    }
                    None => {
                        let support = found.support(own.spec)?;
                        let nodes = own.seen(&support.nodes, &support.measures);
                        Body::standing(self.name, Support { nodes, ..support })
                    }
                }
            }
            (Form::RigidMesh(own, along), Some(rotation)) => {
                let (inertia, positions) = own.rigid(*along)?;
                let measures = inertia.measures(&own.centres(), true);
                let shaft = inertia.turning(&positions);
                let nodes = own.seen(&shaft.nodes, &measures);
                let shaft = self.carrying(Shaft { nodes, measures, ..shaft });
                Body::turning(self.name, shaft, rotation.clone())
            }
            (Form::RigidMesh(own, along), None) => {
                let (inertia, positions) = own.rigid(*along)?;
                let measures = inertia.measures(&own.centres(), false);
                let support = inertia.standing(&positions, [0.0; 2], [0.0; 2]);
                let nodes = own.seen(&support.nodes, &measures);
                Body::standing(self.name, Support { nodes, measures, ..support })
            }
            (Form::Rigid(own, points), Some(rotation)) => {
                Body::turning(self.name, self.carrying(own.turning(points)), rotation.clone())
            }
            (Form::Rigid(own, points), None) => Body::standing(self.name, own.standing(points)),
            (Form::Ground, _) => Body::standing(self.name, Support::rigid(&[])),
        };
        Ok(ReducedBody { body, reduction })
    }

    /// A shaft with all that the body carries.
    fn carrying(&self, shaft: Shaft) -> Shaft {
        self.carried.iter().fold(shaft, |shaft, own| own.on(shaft))
    }
}

impl MeshModel<'_> {
    /// From the cache, or reduced and kept there.
    fn reduce(
        &self,
        kind: BodyKind,
        cache: Option<&Cache>,
        sharing: usize,
    ) -> Result<(Reduced, Reduction), Error> {
        let MeshModel { mesh, spec, .. } = *self;
        let key = Reduced::key(kind, mesh, spec);
        // Which nodes and means are output, as what is applied to the body afterwards.
        let means: Vec<_> = spec.means.iter().map(|mean| (mean.nodes(), mean.weights())).collect();
        let content = Key::of(&(key.hex(), &spec.nodes, means));
        let spec = BodySpec { memory: spec.memory / sharing, ..spec.clone() };
        let make = || Reduced::new(kind, mesh, &spec);
        let Found { value, cached, unkept } = match cache {
            Some(cache) => cache.load_or_make(&key, make)?,
            None => Found { value: make()?, cached: false, unkept: None },
        };
        Ok((value, Reduction { content, cached, unkept }))
    }

    /// The points, of the nodes and means of the spec.
    fn seen(&self, nodes: &[BodyNode], means: &[MeanMotion]) -> Vec<BodyNode> {
        let point = |point: &Point| match *point {
            Point::Node(node) => nodes[node].clone(),
            Point::OnMean(mean, position) => means[mean].node_at(position),
        };
        self.points.iter().map(point).collect()
    }

    /// The inertia of the mesh, and where the nodes of the spec are (m).
    fn rigid(&self, along: bool) -> Result<(RigidInertia, Vec<[f64; 3]>), Error> {
        let positions = self.spec.nodes.iter().map(|&node| self.mesh.nodes()[node]).collect();
        Ok((RigidInertia::of(self.mesh, along)?, positions))
    }

    fn centres(&self) -> Vec<[f64; 3]> {
        self.spec.means.iter().map(NodeSetMean::centre).collect()
    }

    /// The shaft in its frame, with all that it carries.
    fn in_frame(&self, shaft: Shaft) -> Shaft {
        let name = self.follows.map(|place| self.spec.retained[place].name.as_str());
        let coordinate = shaft.coordinates.iter().rposition(|own| Some(own.as_str()) == name);
        match coordinate {
            Some(follows) => shaft.in_mean_frame(follows),
            None => shaft,
        }
    }
}

impl Attachment {
    /// The shaft with it.
    fn on(&self, shaft: Shaft) -> Shaft {
        let [x, y] = match self.kind {
            AttachmentKind::Mass { offset, .. } => offset,
            AttachmentKind::Disc { .. } | AttachmentKind::Unbalance(_) => [0.0; 2],
        };
        let (centre, mean) = match &self.at {
            Place::Nodes(places) => (shaft.nodes[places[0]].clone(), None),
            Place::Mean(place) => {
                let mean = shaft.measures[*place].clone();
                (mean.node_at([x, y, self.z]), Some(mean))
            }
        };
        // A point of a rigid body turns as the body does, whose motion as a whole is its one measure.
        let turn = match mean.as_ref().or(shaft.measures.first()) {
            Some(mean) => mean.rotation.clone(),
            None => Matrix::zeros(3, shaft.size()),
        };
        match (self.kind, mean) {
            (AttachmentKind::Unbalance(moment), _) => {
                shaft.with_unbalance(&Unbalance { moment, node: &centre })
            }
            (AttachmentKind::Mass { mass, .. }, _) => {
                shaft.with_point_mass(&PointMass { mass, node: &centre, turn: &turn })
            }
            (AttachmentKind::Disc { mass, polar_inertia, diametral_inertia }, Some(mean)) => {
                let rows = |first: usize, count: usize| {
                    Matrix::from_fn(count, mean.rotation.cols, |i, j| mean.rotation[(first + i, j)])
                };
                let (tilt, twist) = (rows(0, 2), rows(2, 1));
                shaft.with_disc(&Disc {
                    mass,
                    polar_inertia,
                    diametral_inertia,
                    z: self.z,
                    displacement: &centre.shapes,
                    tilt: &tilt,
                    twist: Some(&twist.data),
                })
            }
            (AttachmentKind::Disc { .. }, None) => {
                unreachable!("a disc stands on a mean motion, which shows its tilts")
            }
        }
    }
}
