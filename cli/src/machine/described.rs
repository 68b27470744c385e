//! A case as the solver takes it: from there through its pipeline to a machine.

use std::time::Instant;

use whirl_codegen::diagnostic::Diagnostics;
use whirl_solver::bodies::Body;
use whirl_solver::cache::Cache;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::machine::MachineParts;
use whirl_solver::model::{Form, Model};

use super::built::{BodyFact, BodyFacts, Built, Counts, FieldMesh};
use super::forces;
use super::joined::{self, JoinedPlan, PlannedBody};
use super::springs::explain;
use crate::case::{Case, JoinedMachine, LawSource, NamedBody};
use crate::errors::Failure;

/// A model with what results and messages say of it.
pub(super) struct Described<'a> {
    /// What the solver takes.
    pub(super) model: Model<'a>,
    /// What it was made from.
    pub(super) joined: &'a JoinedMachine,
    pub(super) plan: &'a JoinedPlan,
    /// The laws as the case uses them, and hashes of what they were made from.
    pub(super) laws: Vec<LawSource>,
    pub(super) law_hashes: Vec<(String, String)>,
}

impl<'a> Described<'a> {
    /// A case by its own plan.
    ///
    /// # Errors
    /// Whatever is wrong with laws.
    pub(super) fn of(case: &'a Case, plan: &'a JoinedPlan) -> Result<Self, Failure> {
        let (model, (laws, law_hashes)) = joined::model(case, plan)?;
        Ok(Described { model, joined: &case.machine, plan, laws, law_hashes })
    }

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
        let Described { model, joined, plan, laws, law_hashes } = self;
        let fields = model.fields.iter().filter_map(|&(body, _)| {
            let flexible = matches!(model.bodies[body].form, Form::Flexible(_));
            let (mesh, own) = (plan.bodies[body].meshed()?.mesh.clone(), &joined.bodies[body]);
            // The coordinates of what turns count from its axis.
            let axis = if own.turns() { own.axis } else { [0.0; 2] };
            Some(FieldMesh { mesh, axis, flexible })
        });
        let fields = fields.collect();
        let start = |own: &NamedBody| BodyStart {
            speed: own.initial_speed.unwrap_or(0.0),
            ..own.start.clone()
        };
        let initial = joined.bodies.iter().map(start).collect();
        let clearances = model.bearings.iter().map(|bearing| bearing.clearance).collect();
        let machine = model.machine(bodies).map_err(|error| explain(error, &joined.joints))?;
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
        for (place, own) in reduced.into_iter().enumerate() {
            let plan = self.plan.bodies.get(place).and_then(PlannedBody::meshed);
            let own = match own {
                Ok(own) => own,
                Err(error) => {
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
        warnings.extend(forces::unmoved(self.joined, &bodies));
        let facts = (!facts.is_empty()).then_some(BodyFacts { bodies: facts, wall, cached });
        Ok((bodies, facts))
    }
}
