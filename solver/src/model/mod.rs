//! The pipeline of this crate: meshes → bodies → machine → integration.
//!
//! A [`Model`] is a machine as it is described. [`Model::reduce`] makes its bodies, each by itself; [`Model::machine`] joins
//! and loads them; [`crate::dynamics::march`] integrates the machine. Each stage is an immutable type of its own:
//!
//! | Stage | Module |
//! |---|---|
//! | mesh, from a file, from dimensions, or matrices in its place | [`crate::mesh`] |
//! | sparse K, M, Y, H, and G under the centrifugal stress | [`crate::assembly`], `stiffening` |
//! | what is held, tied and retained | [`crate::constraints`], [`crate::reduction`] |
//! | reduced body, which a cache keeps | [`crate::reduced`], [`crate::cache`] |
//! | body that turns, body that stands, rigid body | [`crate::shaft`], [`crate::support`], [`crate::rigid`] |
//! | bodies in the order of q, with joints and loads: the machine | [`crate::bodies`], [`crate::bearing`], [`crate::machine`] |
//! | residual and tangents at an instant | [`crate::equations`] |
//! | march, from a start to a history | [`crate::dynamics`], [`crate::history`] |
//! | modes at constant speeds, in place of a march | [`crate::linear`] |
//!
//! ```
//! use std::ops::ControlFlow;
//! use whirl_solver::bodies::{Body, Rotation};
//! use whirl_solver::dynamics::{Integrator, MarchOptions, NewtonOptions, SteadyRule, march};
//! use whirl_solver::loads::{Frame, Onset, TimeFunction};
//! use whirl_solver::model::{BodyModel, Form, LoadAction, LoadModel, Model, Place};
//! use whirl_solver::rigid::RigidBody;
//! use whirl_specs::{CLEARANCES, MOTIONS};
//!
//! // A wheel of 0.5 kg m² under a couple of 2 N m turns with 4 rad/s after a second.
//! let wheel = RigidBody {
//!     along: false,
//!     rocks: false,
//!     mass: 3.0,
//!     polar_inertia: 0.5,
//!     transverse_inertia: None,
//!     centre: [0.0; 3],
//!     stiffness: [0.0; 2],
//!     damping: [0.0; 2],
//! };
//! let model = Model {
//!     bodies: vec![BodyModel {
//!         name: "wheel",
//!         form: Form::Rigid(&wheel, &[]),
//!         rotation: Some(Rotation::Free),
//!         carried: Vec::new(),
//!     }],
//!     motion: &MOTIONS[0],
//!     clearance: &CLEARANCES[0],
//!     laws: Vec::new(),
//!     bearings: Vec::new(),
//!     loads: vec![LoadModel {
//!         name: "load.spin".to_owned(),
//!         body: 0,
//!         place: Place::Mean(0),
//!         action: LoadAction::Couple([0.0, 0.0, 2.0]),
//!         time_function: TimeFunction::Constant,
//!         onset: Onset::Start,
//!         frame: Frame::Space,
//!     }],
//!     gravity: [0.0; 3],
//!     ground: [None, None, None],
//!     outputs: Vec::new(),
//!     fields: Vec::new(),
//! };
//! let reduced: Result<Vec<_>, _> = model.reduce(None).into_iter().collect();
//! let bodies: Vec<Body> = reduced?.into_iter().map(|own| own.body).collect();
//! let machine = model.machine(bodies)?;
//! let options = MarchOptions {
//!     time_step: 1e-3,
//!     automatic: None,
//!     steps: 1000,
//!     integrator: Integrator::default(),
//!     newton: NewtonOptions::default(),
//!     cycle: None,
//!     steady_rule: SteadyRule::default(),
//!     stop_when_steady: false,
//!     initial: Vec::new(),
//!     laws_at_rest: false,
//! };
//! let done = march(&machine, &options, &mut |_| ControlFlow::Continue(())).map_err(|failure| failure.error)?;
//! assert!((done.history.column("omega_rad_s").unwrap().last().unwrap() - 4.0).abs() < 1e-9);
//! # Ok::<(), whirl_solver::Error>(())
//! ```

mod body;
mod load;
mod place;

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use whirl_specs::{Clearance, Motion};

pub use self::body::{
    Attachment, AttachmentKind, BodyModel, Form, MeshModel, Point, ReducedBody, Reduction,
};
pub use self::load::{LoadAction, LoadModel};
pub use self::place::Place;
use crate::bearing::{Bearing, SpringLaw};
use crate::bodies::Body;
use crate::cache::{Cache, Key};
use crate::curve::Curve;
use crate::error::Error;
use crate::gravity::{shaken, weights};
use crate::machine::{Field, Machine, MachineParts};
use crate::output::{Output, Wanted};

/// A machine before its bodies are reduced.
pub struct Model<'a> {
    /// The bodies.
    pub bodies: Vec<BodyModel<'a>>,
    /// How rotation and deformation of a turning body are coupled.
    pub motion: &'static Motion,
    /// The kernels of the clearance.
    pub clearance: &'static Clearance,
    /// The laws of the springs.
    pub laws: Vec<Box<dyn SpringLaw>>,
    /// Journals in their bores, by places of points.
    pub bearings: Vec<Bearing>,
    /// External loads.
    pub loads: Vec<LoadModel>,
    /// Acceleration by gravity along x, y, z (m/s²).
    pub gravity: [f64; 3],
    /// Acceleration of the ground along x, y, z (m/s²) over t (s), where there is one.
    pub ground: [Option<Arc<Curve>>; 3],
    /// Outputs by request. Their points, by place, are the last of their bodies: a machine does without them, as what is
    /// asked for changes nothing that is computed.
    pub outputs: Vec<Output<usize>>,
    /// Bodies of which all nodes are wanted, with the place of the first of these among their points; taken off as those of
    /// outputs.
    pub fields: Vec<(usize, usize)>,
}

impl Model<'_> {
    /// Meshes → bodies: each in its order or why it cannot be, found in the cache or reduced, on all processors. Bodies
    /// that do not fit into memory side by side are reduced one after the other.
    pub fn reduce(&self, cache: Option<&Cache>) -> Vec<Result<ReducedBody, Error>> {
        let reduced: Vec<_> = self.bodies.iter().map(|_| Mutex::new(None)).collect();
        let next = AtomicUsize::new(0);
        let flexible = self.bodies.iter().filter(|body| matches!(body.form, Form::Flexible(_)));
        let processors = thread::available_parallelism().map_or(1, NonZero::get);
        let workers = flexible.count().clamp(1, processors);
        let work = || {
            loop {
                let place = next.fetch_add(1, Ordering::Relaxed);
                let Some(body) = self.bodies.get(place) else { return };
                let made = body.reduce(cache, workers);
                *reduced[place].lock().unwrap_or_else(PoisonError::into_inner) = Some(made);
            }
        };
        thread::scope(|scope| {
            for _ in 1..workers {
                scope.spawn(work);
            }
            work();
        });
        let whole =
            reduced.into_iter().map(|own| own.into_inner().unwrap_or_else(PoisonError::into_inner));
        let whole = whole.map(|own| own.expect("all were reduced"));
        let alone = |(made, body): (Result<ReducedBody, Error>, &BodyModel)| match made {
            Err(Error::Reduction(error)) if workers > 1 && error.is_of_memory() => {
                body.reduce(cache, 1)
            }
            made => made,
        };
        whole.zip(&self.bodies).map(alone).collect()
    }

    /// Hashes of the bodies that have meshes or matrices, with all that these include: of what is reduced, the keys under which it
    /// is kept.
    pub fn keys(&self) -> Vec<Key> {
        self.bodies.iter().filter_map(BodyModel::key).collect()
    }

    /// Bodies, as [`Model::reduce`] gives them, → machine.
    ///
    /// # Errors
    /// As [`Machine::new`].
    pub fn machine(mut self, bodies: Vec<Body>) -> Result<Machine, Error> {
        let (outputs, fields) =
            (std::mem::take(&mut self.outputs), std::mem::take(&mut self.fields));
        let mut parts = self.parts(bodies);
        let placed = outputs.iter().map(|own| own.clone().on(&parts.bodies)).collect();
        let fields = fields.into_iter().map(|(body, first)| {
            let all = parts.bodies[body].nodes_mut();
            let nodes = all.split_off(first);
            Field { body, nodes }
        });
        let fields: Vec<Field> = fields.collect();
        for own in outputs {
            if let Wanted::Motion { body, point, .. } = own.what {
                parts.bodies[body].nodes_mut().truncate(point);
            }
        }
        let mut machine = Machine::new(parts)?.with_outputs(placed)?;
        machine.fields = fields;
        Ok(machine)
    }

    /// What the machine is made from, outputs by request left out.
    pub fn parts(self, bodies: Vec<Body>) -> MachineParts {
        let Model { motion, clearance, laws, bearings, loads, gravity, ground, .. } = self;
        let mut placed: Vec<_> = loads.iter().flat_map(|load| load.on(&bodies)).collect();
        if gravity != [0.0; 3] {
            placed.extend(weights(&bodies, gravity));
        }
        placed.extend(shaken(&bodies, &ground));
        MachineParts { bodies, motion, clearance, laws, bearings, loads: placed }
    }
}
