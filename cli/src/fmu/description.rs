//! modelDescription.xml of a unit, after FMI 2.0.4.

use super::units;
use super::variables::{Role, Variable};
use super::xml::attribute;
use crate::case::Case;
use crate::version;

/// What the standard leaves open, of a unit of this program: it takes one communication step after the other, each a whole
/// number of its time steps.
const ABILITIES: &str = " canHandleVariableCommunicationStepSize=\"false\" canInterpolateInputs=\"true\" \
                         maxOutputDerivativeOrder=\"0\" canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
                         providesDirectionalDerivative=\"false\"";

/// The text. `begins`: time of its start (s); `token`: hash of the content of the unit.
pub(super) fn text(
    (case, begins): (&Case, f64),
    variables: &[Variable],
    identifier: &str,
    token: &str,
) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription");
    let tool = format!("whirl {}", version::PACKAGE);
    let head = [
        ("fmiVersion", "2.0"),
        ("modelName", case.name.as_str()),
        ("guid", token),
        ("description", case.title.as_str()),
        ("generationTool", tool.as_str()),
        ("variableNamingConvention", "flat"),
        ("numberOfEventIndicators", "0"),
    ];
    head.iter().for_each(|(name, value)| text += &attribute(name, value));
    text += ">\n  <CoSimulation";
    text += &attribute("modelIdentifier", identifier);
    text += ABILITIES;
    text += "/>\n  <UnitDefinitions>\n";
    let mut known: Vec<&str> = variables.iter().map(|own| own.unit.as_str()).collect();
    known.sort_unstable();
    known.dedup();
    known.iter().for_each(|unit| text += &units::element(unit));
    text += "  </UnitDefinitions>\n  <LogCategories>\n";
    let categories = [
        ("logStatusWarning", "What may be wrong with the numbers"),
        ("logStatusError", "Why a call was refused or failed"),
    ];
    for (name, description) in categories {
        text += "    <Category";
        text += &attribute("name", name);
        text += &attribute("description", description);
        text += "/>\n";
    }
    let march = case.march();
    let step = march.time_step * march.output_every as f64;
    text += "  </LogCategories>\n  <DefaultExperiment";
    text += &attribute("startTime", &format!("{begins:?}"));
    text += &attribute("stopTime", &format!("{:?}", begins + march.duration()));
    text += &attribute("stepSize", &format!("{step:?}"));
    text += "/>\n  <ModelVariables>\n";
    for (reference, own) in variables.iter().enumerate() {
        text += &scalar(reference, own);
    }
    text += "  </ModelVariables>\n  <ModelStructure>\n";
    let is_output = |own: &&(usize, &Variable)| matches!(own.1.role, Role::Output(_));
    for list in ["Outputs", "InitialUnknowns"] {
        text += &format!("    <{list}>\n");
        for (place, _) in variables.iter().enumerate().filter(|own| is_output(&own)) {
            text += &format!("      <Unknown index=\"{}\"/>\n", place + 1);
        }
        text += &format!("    </{list}>\n");
    }
    text + "  </ModelStructure>\n</fmiModelDescription>\n"
}

fn scalar(reference: usize, own: &Variable) -> String {
    let (causality, variability, initial) = match own.role {
        Role::Output(_) => ("output", "continuous", Some("calculated")),
        Role::Load(..) | Role::Speed(_) => ("input", "continuous", None),
        Role::Parameter(_) => ("parameter", "fixed", Some("exact")),
    };
    let mut text = String::from("    <ScalarVariable");
    text += &attribute("name", &own.name);
    text += &attribute("valueReference", &reference.to_string());
    text += &attribute("description", &own.description);
    text += &attribute("causality", causality);
    text += &attribute("variability", variability);
    if let Some(initial) = initial {
        text += &attribute("initial", initial);
    }
    text += "><Real";
    text += &attribute("unit", &own.unit);
    if let Some(start) = own.start {
        text += &attribute("start", &format!("{start:?}"));
    }
    text + "/></ScalarVariable>\n"
}

/// A name of the library that C could have.
pub(super) fn identifier(name: &str) -> String {
    let letter = |own: char| if own.is_ascii_alphanumeric() { own } else { '_' };
    let text: String = name.chars().map(letter).collect();
    if text.starts_with(|own: char| own.is_ascii_alphabetic()) {
        text
    } else {
        format!("unit_{text}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn libraries_have_names_of_c() {
        let pairs = [
            ("hu2003-1", "hu2003_1"),
            ("2 stufig", "unit_2_stufig"),
            ("größe", "gr__e"),
            ("", "unit_"),
        ];
        for (name, expected) in pairs {
            assert_eq!(identifier(name), expected);
        }
    }
}
