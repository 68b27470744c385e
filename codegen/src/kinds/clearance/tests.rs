use super::*;
use crate::diagnostic::Source;
use crate::expression::{Id, Rational};

const JOURNAL: &str = include_str!("../../../../specs/motion/clearance.toml");

fn read(text: &str) -> Result<ClearanceSpec, String> {
    ClearanceSpec::read(&Source::new("motion/clearance.toml", text))
        .map_err(|errors| errors.iter().map(|e| format!("{e}\n")).collect())
}

#[test]
fn the_journal_is_read() {
    let spec = read(JOURNAL).expect("a clearance");
    assert_eq!(spec.ring.each_ref().map(|c| c.name.as_str()), ["theta", "eps_x", "eps_y"]);
    assert_eq!((spec.clearance.as_str(), spec.radial.name.as_str()), ("h", "delta"));
    let names: Vec<_> = spec.definitions.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["u_x", "u_y"]);
}

#[test]
fn a_force_does_no_work_that_the_clearance_does_not_do() {
    // Σ (generalised force) · (rate) = Q ḣ.
    let spec = read(JOURNAL).expect("a clearance");
    let mut d = spec.derive(&spec.contacts[0]).expect("derivatives");
    let g = &mut d.graph;
    let mut work = g.integer(0);
    for (force, rate) in d.force.iter().zip(&d.rates) {
        let part = g.mul(*force, rate.symbol);
        work = g.add(work, part);
    }
    let expected = g.mul(d.forces[0].1, d.inputs[1]);
    assert!(crate::expression::normal::equal(g, work, expected));
    assert!(!g.is_zero(d.force[0]), "the force on the rotation is not zero");
}

#[test]
fn forces_of_every_kind_of_law_do_the_work_of_their_measures() {
    // Σ (generalised force) · (rate) = Σ F_m ẋ_m, and no kind works on a uniform motion of shaft and bore.
    let spec = read(JOURNAL).expect("a clearance");
    assert_eq!(spec.contacts.len(), 6);
    for contact in &spec.contacts {
        let mut d = spec.derive(contact).expect("derivatives");
        let coordinates: Vec<Id> = spec.ring.iter().map(|c| c.symbol).collect();
        let g = &mut d.graph;
        let mut work = g.integer(0);
        for (force, rate) in d.force.iter().zip(&d.rates) {
            let part = g.mul(*force, rate.symbol);
            work = g.add(work, part);
        }
        let mut expected = g.integer(0);
        for ((_, symbol), force) in d.forces.iter().zip(&contact.forces) {
            for (place, rate) in d.rates.iter().enumerate() {
                let own = contact.bore.get(place.wrapping_sub(RING)).map(|(_, own)| own.symbol);
                let coordinate = own.unwrap_or_else(|| coordinates[place]);
                let slope = g.differentiate(force.measure, coordinate).expect("smooth");
                let part = g.product(&[
                    (*symbol, Rational::from(1)),
                    (slope, Rational::from(1)),
                    (rate.symbol, Rational::from(1)),
                ]);
                expected = g.add(expected, part);
            }
        }
        assert!(crate::expression::normal::equal(g, work, expected), "{}", contact.name);
        assert!(!g.is_zero(d.force[0]), "{}: a torque on the shaft", contact.name);
    }
}

#[test]
fn kinds_of_laws_know_what_they_need() {
    let spec = read(JOURNAL).expect("a clearance");
    let [normal, spring, ring, joint, sensor, gear] = spec.contacts.as_slice() else {
        panic!("six kinds")
    };
    let places = [normal, spring, ring, joint, sensor, gear].map(|own| own.place);
    let once = [Place::Joint; 3];
    assert_eq!(places[..3], [Place::Spring, Place::Spring, Place::Ring]);
    assert_eq!(places[3..], once);
    let motions = |contact: &Contact| contact.bore.iter().map(|(m, _)| *m).collect::<Vec<_>>();
    use BoreMotion::{MeanTurn, MeanX, MeanY, Radial, SectionTurn, Tangential};
    assert_eq!(motions(normal), [Radial]);
    assert_eq!(motions(spring), [Radial, Tangential, MeanTurn, SectionTurn]);
    assert_eq!(motions(ring), [MeanX, MeanY, MeanTurn, SectionTurn]);
    use BoreMotion::{MeanTiltX, MeanTiltY, MeanZ, SectionTiltX, SectionTiltY, SectionZ};
    let of_sections = [MeanZ, MeanTiltX, MeanTiltY, SectionZ, SectionTiltX, SectionTiltY];
    assert_eq!(motions(joint), [motions(ring), of_sections.to_vec()].concat());
    assert_eq!(motions(sensor), [motions(ring), SENSOR.to_vec()].concat());
    use BoreMotion::{SecondFrame, SecondTurn};
    assert_eq!(motions(gear), [MeanX, MeanY, SectionTurn, SecondFrame, SecondTurn]);
    let units = |contact: &Contact| {
        contact.inputs.iter().map(|input| input.unit.clone()).collect::<Vec<_>>()
    };
    assert_eq!(units(spring), ["m", "m/s", "rad", "rad/s", "m/s", "rad"]);
    assert_eq!(ring.forces[2].unit, "N*m");
    // Q works on h, which laws may take; T on s, which they may not.
    let measures = spring.forces.iter().map(|force| spring.measure(force));
    assert_eq!(measures.collect::<Vec<_>>(), [0, 6]);
}

#[test]
fn a_kind_acts_at_springs_or_on_whole_sections() {
    let error = read(&JOURNAL.replace("\"h\", \"h_dot\", \"psi\"", "\"h\", \"h_dot\", \"e_z\""));
    let error = error.expect_err("an error");
    assert!(error.contains("`spring` has measures of springs and of whole sections"), "{error}");
}

#[test]
fn errors_of_kinds_name_the_place() {
    let error = |from: &str, to: &str| read(&JOURNAL.replace(from, to)).expect_err("an error");
    assert!(error("[laws.ring]", "[laws.normal]").contains("`normal` is the kind of laws"));
    let wrong = error("\"omega\", \"v_t\"", "\"omega\", \"v_y\"");
    assert!(wrong.contains("`v_y` is no measure, rate or coordinate"), "{wrong}");
    assert!(error("[\"Q\", \"T\"]", "[\"Q\", \"S\"]").contains("`S` is no force of a measure"));
    assert!(error("force = \"T\"", "force = \"R\"").contains("the name `R` is taken"));
    assert!(error("'theta + gamma - beta'", "'theta - b_x'").contains("clearance.toml:"));
    assert!(
        error("'cos(beta)*(u_x - b_x) + sin(beta)*(u_y - b_y)'", "'(u_x - b_x)^2'")
            .contains("a length or an angle")
    );
    assert!(error("[bore.beta]", "[bore.gamma]").contains("beta"));
}

#[test]
fn errors_name_the_place() {
    let error = |from: &str, to: &str| read(&JOURNAL.replace(from, to)).expect_err("an error");
    assert!(error("[ring.eps_y]", "[ring.psi]").contains("the name `psi` is taken"));
    assert!(
        error("unit = \"m\"\ntitle = \"radial clearance", "unit = \"mm\"\ntitle = \"r")
            .contains("SI")
    );
    assert!(error("+ delta'", "+ dleta'").contains("delta"));
    assert!(error("'2*s^2 - s'", "'2*s^2 - psi'").contains("psi"));
    assert!(error(", '2*s^2 - s'", "").contains("2 axial functions, but 3 are needed"));
    assert!(error("c - cos(psi)*u_x", "theta - cos(psi)*u_x").contains("clearance.toml:"));
    assert!(error("[ring.theta]", "[ring.j_]").contains("`j_` ends in `_`"));
    assert!(error("[ring.theta]", "[ring.Q]").contains("the name `Q` is that of the normal force"));
    assert!(error("[ring.theta]", "[ring.x_dot]").contains("that of a rate"));
    assert!(error("[ring.theta]", "[ring.dT_dh]").contains("that of a slope"));
    let part = error("[section.a_y]", "[bore.a_y]");
    assert!(part.contains("`section` must declare 1 or 4 names, not 3"), "{part}");
    assert!(part.contains("`bore` must declare 3 or 6 names, not 7"), "{part}");
}

/// A name of a quantity that is changed in the clearance alone is wrong there and in every law that has it.
#[test]
fn laws_and_clearances_have_the_same_quantities() {
    use crate::generate::{SpecFile, generate};
    let law = |name: &str, input: &str| SpecFile {
        path: format!("laws/{name}.toml"),
        text: format!(
            "kind = \"law\"\nname = \"{name}\"\ntitle = \"t\"\nsource = \"s\"\n\
             [inputs.h]\nunit = \"m\"\n[inputs.{input}]\nunit = \"rad/s\"\n\
             [outputs.Q]\nunit = \"N\"\nvalue = '1e6*h + 2*omega'\n"
        ),
    };
    let errors = |from: &str, to: &str| {
        let clearance =
            SpecFile { path: "motion/clearance.toml".to_owned(), text: JOURNAL.replace(from, to) };
        let made = generate(&[law("turned", "omega"), clearance]);
        made.map_or_else(|errors| errors.to_string(), |_| String::new())
    };
    assert_eq!(errors("", ""), "");
    let renamed = errors("\"omega\"", "\"spin\"");
    assert!(
        renamed.contains("law files have no quantity `spin` for a law of a spring"),
        "{renamed}"
    );
    assert!(renamed.contains("law files have no quantity `spin` for a law of a ring"), "{renamed}");
    assert!(
        renamed.contains("`motion/clearance.toml` gives no `omega` of a law of a spring"),
        "{renamed}"
    );
    let listed = errors("\"omega\", \"v_t\"", "\"v_t\"");
    assert!(listed.contains("gives no `omega` of a law of a spring"), "{listed}");
}
