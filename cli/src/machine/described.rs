//! A case as the solver takes it: from there through its pipeline to a machine.

use std::time::Instant;

use whirl_codegen::diagnostic::{Diagnostics, Located};
use whirl_solver::bodies::Body;
use whirl_solver::cache::Cache;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::machine::MachineParts;
use whirl_solver::model::{Form, Model};

use super::built::{BodyFact, BodyFacts, Built, Counts, FieldMesh};
use super::forces;
use super::plan::BodyPlan;
use super::springs::explain;
use crate::case::{Gravity, LawSource};
use crate::errors::Failure;

/// A model with what results and messages say of it.
pub(super) struct Described<'a> {
    /// What the solver takes.
    pub(super) model: Model<'a>,
    /// The plan of each body that has a mesh.
    pub(super) plans: Vec<Option<&'a BodyPlan>>,
    /// x and y in space of where the coordinates of each mesh count from (m).
    pub(super) axes: Vec<[f64; 2]>,
    /// How the bodies begin.
    pub(super) initial: Vec<BodyStart>,
    /// Gravity, as the case says it.
    pub(super) gravity: Option<&'a Gravity>,
    /// The laws as the case uses them, and hashes of what they were made from.
    pub(super) laws: Vec<LawSource>,
    pub(super) law_hashes: Vec<(String, String)>,
    /// Where the case says the law of each bearing, and the sets of its bore.
    pub(super) law_places: Vec<&'a Located>,
    pub(super) bore_places: Vec<&'a [Located]>,
}

impl Described<'_> {
    /// The machine; reduced bodies come from the cache where it has them. `warnings` are added to.
    ///
    /// # Errors
    /// What keeps a body from being reduced, or a law from being placed.
    pub(super) fn build(
        self,
        cache: Option<&Cache>,
        warnings: &mut Vec<String>,
    ) -> Result<Built, Failure> {
        let (bodies, facts) = self.reduce(cache, warnings)?;
        let fields = self.model.fields.iter().filter_map(|&(body, _)| {
            let flexible = matches!(self.model.bodies[body].form, Form::Flexible(_));
            let mesh = self.plans[body]?.mesh.clone();
            Some(FieldMesh { mesh, axis: self.axes[body], flexible })
        });
        let fields = fields.collect();
        let Described { model, initial, laws, law_hashes, law_places, bore_places, .. } = self;
        let clearances = model.bearings.iter().map(|bearing| bearing.clearance).collect();
        let machine =
            model.machine(bodies).map_err(|error| explain(error, &law_places, &bore_places))?;
        Ok(Built { machine, initial, clearances, laws, law_hashes, bodies: facts, fields })
    }

    /// What the machine is made from.
    ///
    /// # Errors
    /// As [`Described::build`].
    pub(super) fn parts(self, warnings: &mut Vec<String>) -> Result<MachineParts, Failure> {
        let (bodies, _) = self.reduce(None, warnings)?;
        Ok(self.model.parts(bodies))
    }

    /// The bodies, and facts about those that were reduced.
    fn reduce(
        &self,
        cache: Option<&Cache>,
        warnings: &mut Vec<String>,
    ) -> Result<(Vec<Body>, Option<BodyFacts>), Failure> {
        let start = Instant::now();
        let reduced = self.model.reduce(cache);
        let wall = start.elapsed().as_secs_f64();
        let (mut bodies, mut facts, mut cached) = (Vec::new(), Vec::new(), true);
        let (mut errors, mut rest) = (Diagnostics::new(), None);
        for (own, plan) in reduced.into_iter().zip(&self.plans) {
            let own = match (own, plan) {
                (Ok(own), _) => own,
                (Err(error), plan) => {
                    let failure = match plan {
                        Some(plan) => plan.explain(error),
                        None => error.into(),
                    };
                    match failure {
                        Failure::Input(found) => errors.append(found),
                        other => rest = rest.or(Some(other)),
                    }
                    continue;
                }
            };
            if let (Some(reduction), Some(plan)) = (own.reduction, plan) {
                let folder = cache.and_then(Cache::folder);
                if let (Some(error), Some(folder)) = (reduction.unkept, folder) {
                    let folder = folder.display();
                    warnings.push(format!("cannot keep a reduced body in {folder}: {error}"));
                }
                cached &= reduction.cached;
                let (counts, hertz) = (plan.counts(), own.body.hertz().to_vec());
                facts.push(BodyFact {
                    name: own.body.name().to_owned(),
                    // Of what was kept, answers to loads and a mode's partner among it.
                    counts: Counts {
                        craig_bampton_dofs: hertz.len() + counts.retained_dofs,
                        ..counts
                    },
                    hertz,
                    content: reduction.content,
                });
            }
            bodies.push(own.body);
        }
        errors.into_result(())?;
        if let Some(failure) = rest {
            return Err(failure);
        }
        warnings.extend(forces::unmoved(self.gravity, &bodies));
        let facts = (!facts.is_empty()).then_some(BodyFacts { bodies: facts, wall, cached });
        Ok((bodies, facts))
    }
}
