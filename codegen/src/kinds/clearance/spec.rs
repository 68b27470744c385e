//! A clearance as it is read.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::diagnostic::Source;
use crate::expression::{Graph, Id};
use crate::formula::Formula;
use crate::kinds::kind::About;

/// Ring coordinates: an angle and two displacements.
pub const RING: usize = 3;
/// Coordinates of the mean motion of a bore: those of a ring, and of a section beside them.
pub(crate) const BORE: [BoreMotion; 6] = [
    BoreMotion::MeanX,
    BoreMotion::MeanY,
    BoreMotion::MeanTurn,
    BoreMotion::MeanZ,
    BoreMotion::MeanTiltX,
    BoreMotion::MeanTiltY,
];
/// Coordinates of a journal's section in the frame of its body: its turn, and those of a whole section beside it.
pub(crate) const SECTION: [BoreMotion; 4] = [
    BoreMotion::SectionTurn,
    BoreMotion::SectionZ,
    BoreMotion::SectionTiltX,
    BoreMotion::SectionTiltY,
];
/// Coordinates of a sensor: the journal's body where it looks, in the frame of that body, and what it stands on.
pub(crate) const SENSOR: [BoreMotion; 4] =
    [BoreMotion::SeenX, BoreMotion::SeenY, BoreMotion::BaseX, BoreMotion::BaseY];
/// Coordinates of the second of two gears beside its mean motion: the turn of its frame, and its own by which teeth move.
pub(crate) const GEAR: [BoreMotion; 2] = [BoreMotion::SecondFrame, BoreMotion::SecondTurn];
/// Rings of a bearing, between which the axial functions interpolate.
pub(crate) const RINGS: usize = 3;

/// A clearance, ready to be differentiated and scheduled.
#[derive(Debug, Clone)]
pub struct ClearanceSpec {
    /// Name of the spec.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Paper and equation.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// The fixed angle of a spring.
    pub spring: Coordinate,
    /// The radial clearance of the undeformed bearing.
    pub constant: Coordinate,
    /// Ring coordinates, in the order of the file.
    pub ring: [Coordinate; RING],
    /// The coordinate of each spring.
    pub radial: Coordinate,
    /// Radius of the journal, if the spec has it.
    pub(crate) radius: Option<Coordinate>,
    /// Displacement of the bore along the tangent at each spring, if the spec has it.
    pub(crate) tangential: Option<Coordinate>,
    /// Mean motion of the bore, as many of [`BORE`] as the spec has.
    pub(crate) bore: Vec<Coordinate>,
    /// Motion of the journal's section in the frame of its body, as many of [`SECTION`] as the spec has.
    pub(crate) section: Vec<Coordinate>,
    /// What a sensor sees and what it stands on, [`SENSOR`], if the spec has them.
    pub(crate) sensor: Vec<Coordinate>,
    /// Turns of the second of two gears, [`GEAR`], if the spec has them.
    pub(crate) gear: Vec<Coordinate>,
    /// Kinds of laws, that of Q(h, ḣ) first.
    pub contacts: Vec<Contact>,
    /// Names and values of the measures, the clearance first.
    pub(crate) measures: Vec<(String, Id)>,
    /// Definitions in the order of the file, with what they stand for.
    pub(crate) definitions: Vec<(String, Id)>,
    /// Name of the clearance, such as `h`.
    pub(crate) clearance: String,
    /// Its formula.
    pub(crate) formula: Formula,
    /// Its value in the graph.
    pub value: Id,
    /// The variable of the axial functions.
    pub(crate) axial_variable: Coordinate,
    /// The axial functions in the graph.
    pub(crate) axial: [Id; RINGS],
    /// What axes that are apart add to the ring's displacements.
    pub(crate) apart: Apart,
    /// Symbols and values of the measures, the axial functions and of axes that are apart, all SI.
    pub graph: Graph,
}

/// A way in which a bore moves, or the journal's section in its body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoreMotion {
    /// Outwards at a spring.
    Radial,
    /// Along the tangent at a spring.
    Tangential,
    /// All around, along x.
    MeanX,
    /// All around, along y.
    MeanY,
    /// All around, turning.
    MeanTurn,
    /// The whole section, along z.
    MeanZ,
    /// The whole section, about x.
    MeanTiltX,
    /// The whole section, about y.
    MeanTiltY,
    /// None of the bore: the journal's section, turning against the frame of its body.
    SectionTurn,
    /// The journal's section, along z.
    SectionZ,
    /// The journal's section, about x of its body.
    SectionTiltX,
    /// The journal's section, about y of its body.
    SectionTiltY,
    /// Where a sensor looks at the journal's body, along x of that body.
    SeenX,
    /// The same along y.
    SeenY,
    /// What the sensor stands on, along x.
    BaseX,
    /// The same along y.
    BaseY,
    /// The frame of the second of two gears, turning in space.
    SecondFrame,
    /// The second of two gears, turning in space, times the ratio of their base radii.
    SecondTurn,
}

impl BoreMotion {
    /// Whether rings have it not, but whole sections.
    pub(crate) fn is_of_whole_section(self) -> bool {
        let of_sections = [&BORE[3..], &SECTION[1..], &SENSOR, &GEAR];
        of_sections.iter().any(|own| own.contains(&self))
    }
}

/// Axes of journal and bore that are apart.
#[derive(Debug, Clone)]
pub(crate) struct Apart {
    /// Angle of the journal's body.
    pub(crate) angle: Coordinate,
    /// How far its axis stands from that of the bore, in space.
    pub(crate) distances: [Coordinate; 2],
    /// What is added to the displacements of the ring.
    pub(crate) values: [Id; 2],
}

/// A symbol of the spec.
#[derive(Debug, Clone)]
pub struct Coordinate {
    /// Name, such as `theta`.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// SI unit.
    pub unit: String,
    /// The symbol in the graph.
    pub symbol: Id,
}

/// A kind of law: what it may take and give, and through which motions of the bore it acts. The first of every
/// clearance is that of normal forces Q(h, ḣ).
#[derive(Debug, Clone)]
pub struct Contact {
    /// Name of the kind, such as `spring`.
    pub name: String,
    /// Whether such a law acts at every spring, once a ring or once a joint.
    pub(crate) place: Place,
    /// Motions of the bore that it needs.
    pub(crate) bore: Vec<(BoreMotion, Coordinate)>,
    /// What laws may take.
    pub inputs: Vec<ContactInput>,
    /// What laws may give.
    pub forces: Vec<ContactForce>,
}

/// How often a law acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// At every spring.
    Spring,
    /// Once a ring.
    Ring,
    /// Once a joint.
    Joint,
}

impl Place {
    /// In words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Place::Spring => "at every spring",
            Place::Ring => "once a ring",
            Place::Joint => "once a joint",
        }
    }
}

/// An input of a kind of law.
#[derive(Debug, Clone)]
pub struct ContactInput {
    /// What laws call it.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub(crate) taken: Taken,
}

/// What an input is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Taken {
    /// An expression in the coordinates.
    Value(Id),
    /// The rate of one.
    Rate(Id),
}

impl Taken {
    /// The expression, itself or that of the rate.
    pub(crate) fn expression(self) -> Id {
        match self {
            Taken::Value(id) | Taken::Rate(id) => id,
        }
    }
}

/// A force of a kind of law.
#[derive(Debug, Clone)]
pub struct ContactForce {
    /// What laws call it.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it works on.
    pub(crate) measure: Id,
}

/// Name of the kind of normal forces Q(h, ḣ).
pub(super) const NORMAL: &str = "normal";

impl Contact {
    /// Names of ∂F/∂z: one row a force, one entry an input.
    pub fn slopes(&self) -> Vec<Vec<String>> {
        let mut taken = BTreeSet::new();
        let mut slope = |force: &ContactForce, input: &ContactInput| {
            let mut name = format!("d{}_d{}", force.name, input.name);
            // d(F_da)_db and dF_d(a_db) are spelt alike.
            while !taken.insert(name.clone()) {
                name.push('2');
            }
            name
        };
        let mut row =
            |force| self.inputs.iter().map(|input| slope(force, input)).collect::<Vec<String>>();
        self.forces.iter().map(&mut row).collect()
    }

    /// Forces that work on measures which are no inputs, one a measure.
    pub(crate) fn further_measures(&self) -> impl Iterator<Item = &ContactForce> {
        let is_input = |own: &ContactForce| {
            self.inputs.iter().any(|input| input.taken == Taken::Value(own.measure))
        };
        self.forces.iter().enumerate().filter_map(move |(place, own)| {
            let before = self.forces[..place].iter().any(|other| other.measure == own.measure);
            (!before && !is_input(own)).then_some(own)
        })
    }

    /// For a force the place of the measure that it works on among the inputs and the further measures.
    pub(crate) fn measure(&self, force: &ContactForce) -> usize {
        let inputs = self.inputs.iter().map(|input| match input.taken {
            Taken::Value(value) => Some(value),
            Taken::Rate(_) => None,
        });
        let mut rows = inputs.chain(self.further_measures().map(|own| Some(own.measure)));
        rows.position(|measure| measure == Some(force.measure)).expect("an input or a further one")
    }

    /// Number of coordinates of the ring and the bore.
    pub(crate) fn coordinates(&self) -> usize {
        RING + self.bore.len()
    }
}

impl ClearanceSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let ClearanceSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// Kinds of laws of this name; those of springs are laws Q(h, ḣ), too.
    pub(crate) fn contacts_of<'s>(&'s self, name: &'s str) -> impl Iterator<Item = &'s Contact> {
        self.contacts.iter().filter(move |contact| {
            contact.name == name || contact.name == NORMAL && name == "spring"
        })
    }
}
