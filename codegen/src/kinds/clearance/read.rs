//! File → clearance.

use std::sync::Arc;

use super::kinds::{self, Measure};
use super::reader::Reader;
use super::{ClearanceSpec, Coordinate, KIND, RING};
use crate::diagnostic::{Diagnostics, Source};
use crate::document::Table;
use crate::kinds::read::{self, Head};
use crate::units::Dimension;

pub(super) fn read(file: &Arc<Source>) -> Result<ClearanceSpec, Diagnostics> {
    read::spec(file, KIND.shape, |document, root, head| {
        Reader::new(document).spec(file, root, head)
    })
}

impl<'d> Reader<'d> {
    fn spec(mut self, file: &Arc<Source>, root: Table<'d>, head: Head) -> Option<ClearanceSpec> {
        let spring = self.coordinates(&root, "spring", &[Dimension::ANGLE]);
        // The second, if there is one, is the journal's radius.
        let constants = self.some_coordinates(&root, "constants", &[Dimension::LENGTH; 2], &[1, 2]);
        let ring_units = [Dimension::ANGLE, Dimension::LENGTH, Dimension::LENGTH];
        let ring = self.coordinates(&root, "ring", &ring_units);
        let radial = self.coordinates(&root, "radial", &[Dimension::LENGTH]);
        let definitions = self.definitions(&root);
        let clearance = self.clearance(&root);
        let axial = self.axial(&root);
        let apart = self.apart(&root);
        let tangential = self.optional_coordinates(&root, "tangential", &[Dimension::LENGTH]);
        let of_section = [Dimension::LENGTH, Dimension::ANGLE, Dimension::ANGLE];
        let bore = [Dimension::LENGTH, Dimension::LENGTH, Dimension::ANGLE];
        let bore = self.whole_or_part(&root, "bore", &bore, &of_section);
        let section = self.whole_or_part(&root, "section", &[Dimension::ANGLE], &of_section);
        let sensor = self.optional_coordinates(&root, "sensor", &[Dimension::LENGTH; 4]);
        let gear = self.optional_coordinates(&root, "gear", &[Dimension::ANGLE; 2]);
        let measures = self.measures(&root);
        let kinds = self.kinds(&root);
        root.finish();
        if self.document.has_errors() {
            return None;
        }
        let [name, title, reference] = head.texts()?;
        let one = |list: Option<Vec<Coordinate>>| list?.into_iter().next();
        let (clearance, formula, value) = clearance?;
        let (axial_variable, axial) = axial?;
        let apart = apart?;
        let (tangential, bore, section) = (tangential?, bore?, section?);
        let (sensor, gear) = (sensor?, gear?);
        let mut constants = constants?.into_iter();
        let mut spec = ClearanceSpec {
            name,
            title,
            reference,
            file: file.clone(),
            spring: one(spring)?,
            constant: constants.next()?,
            radius: constants.next(),
            tangential: tangential.into_iter().next(),
            section,
            sensor,
            gear,
            bore,
            contacts: Vec::new(),
            measures: Vec::new(),
            ring: <[Coordinate; RING]>::try_from(ring?).ok()?,
            radial: one(radial)?,
            definitions: definitions?,
            clearance,
            formula,
            value,
            axial_variable,
            axial,
            apart,
            graph: self.graph,
        };
        let measures: Vec<Measure> =
            std::iter::once(Measure::clearance(&spec)).chain(measures).collect();
        spec.contacts = kinds::bind(self.document, &spec, &measures, &kinds);
        spec.measures = measures.into_iter().map(Measure::named).collect();
        Some(spec)
    }
}
