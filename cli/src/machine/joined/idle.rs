//! Keys of loads that change nothing.

use whirl_solver::loads::Onset;
use whirl_solver::model::LoadAction;

use crate::case::{Form, JoinedMachine, Run};

/// Warnings of loads that begin when the run is over, and of places that make no difference.
pub(crate) fn of_loads(joined: &JoinedMachine, run: Option<Run>) -> Vec<String> {
    let mut all = Vec::new();
    for own in &joined.loads {
        let (name, body) = (own.name.text(), &joined.bodies[own.body]);
        let begins = match own.load.onset {
            Onset::Start => None,
            Onset::Step(from) | Onset::Ramp(from, _) => Some(from),
        };
        let end = run.map(Run::end);
        if let (Some(from), Some(end)) = (begins, end)
            && from >= end
        {
            all.push(format!(
                "the load `{name}` begins at {from} s, and the run ends at {end} s: it never acts"
            ));
        }
        let tilts = match &body.form {
            Form::Rigid(rigid) => rigid.transverse_inertia.is_some(),
            Form::Meshed(_) => true,
        };
        let is_couple = matches!(own.load.acting, LoadAction::Couple(_));
        let reason = match (&body.form, is_couple) {
            (Form::Rigid(_), true) => "a couple is the same everywhere on a rigid body",
            _ if !tilts => "without `transverse_inertia` the body does not tilt",
            _ => continue,
        };
        if own.z.is_some() {
            all.push(format!(
                "the `z` of the load `{name}` on `{}` has no effect: {reason}; leave it out",
                body.name.text()
            ));
        }
    }
    all
}
