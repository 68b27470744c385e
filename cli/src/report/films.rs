//! What is in oil films, where a case wants it: which columns belong together.

use whirl_solver::machine::Machine;
use whirl_solver::output::Wanted;

use super::angle;
use crate::case::Case;

/// Columns that have one axis.
pub(crate) struct FilmChart {
    /// The output, and what it is.
    pub(crate) title: String,
    /// What the axis is called, and its unit.
    pub(crate) quantity: &'static str,
    pub(crate) unit: &'static str,
    /// Columns, and what they are called.
    pub(crate) lines: Vec<(String, String)>,
    /// The column of the angle of the journal over which it is shown; none of what is looked up.
    pub(crate) angle: Option<String>,
}

/// All of a case.
pub(crate) fn films(case: &Case, machine: &Machine) -> Vec<FilmChart> {
    let mut all = Vec::new();
    for output in machine.outputs() {
        let Wanted::Film { joint, openings, integrals } = &output.what else { continue };
        let name = &output.name;
        let body = case.machine.joints[*joint].sides[0].body.unwrap_or(0);
        let turned = angle(case, machine, body);
        let mut add = |what: &str, (quantity, unit), lines: Vec<(String, String)>, shown: bool| {
            let (title, angle) = (format!("{name}, film: {what}"), turned.clone());
            let angle = angle.filter(|_| shown);
            all.push(FilmChart { title, quantity, unit, lines, angle });
        };
        let one = |column: String, called: &str| vec![(column, called.to_owned())];
        let pressure = one(format!("pmax_{name}_MPa"), "largest pressure");
        add("largest pressure", ("pressure", "MPa"), pressure, true);
        let gap = one(format!("hmin_{name}_um"), "smallest gap");
        add("smallest gap", ("gap", "µm"), gap, true);
        let flows = openings.iter();
        let flows = flows.map(|own| (format!("q_{own}_{name}_mL_s"), own.clone())).collect();
        add("what enters at its openings", ("flow", "mL/s"), flows, true);
        for own in integrals.iter().filter(|own| own.unit == "W") {
            let column = one(format!("{}_{name}_W", own.name), &own.name);
            add(&own.meaning, ("power", "W"), column, true);
        }
        let moments = [("mz", "on the journal"), ("mz_bore", "on the bore")];
        let moments = moments.map(|(own, on)| (format!("{own}_{name}_Nm"), on.to_owned()));
        add("moment about the axis", ("moment", "N·m"), moments.to_vec(), false);
        for (end, unit, axis) in [("angle", "deg", ("angle", "°")), ("z", "mm", ("z", "mm"))] {
            let both = [("pmax", "largest pressure"), ("hmin", "smallest gap")];
            let lines = both.map(|(own, of)| (format!("{own}_{end}_{name}_{unit}"), of.to_owned()));
            add(&format!("{} of pressure and gap", axis.0), axis, lines.to_vec(), false);
        }
    }
    all
}
