//! What a film says and what follows from it.

use super::spec::{FilmSpec, Term};
use crate::expression::display_rounded;
use crate::kinds::law::short;
use crate::kinds::page::{Page, count};
use crate::schedule::Program;

impl FilmSpec {
    /// What was found about a film when it was read.
    pub(in crate::kinds) fn report(&self, page: &mut Page) {
        let [around, along] = self.nodes;
        page.heading("Cell");
        page.item(&format!("{around} nodes around, {along} along the bore"));
        page.item(
            "what a node holds is never negative, and moments on both surfaces balance: checked",
        );
    }

    /// Everything about a film but its code.
    pub(in crate::kinds) fn explain(&self, page: &mut Page) {
        self.report(page);
        page.heading("Unknowns: at every node both at least zero, one of them zero");
        let rows = self
            .unknowns
            .iter()
            .map(|own| vec![own.name.clone(), own.unit.clone(), own.title.clone()]);
        page.columns(&rows.collect::<Vec<_>>());
        page.heading("Given by the motion");
        let given = [&self.gap, &self.speed].into_iter();
        let rows = given.map(|own| vec![own.name.clone(), own.unit.clone(), own.title.clone()]);
        page.columns(&rows.collect::<Vec<_>>());
        page.heading("Parameters");
        let rows = self.parameters.iter().map(|own| {
            let unit =
                if own.unit.text() == "1" { String::new() } else { format!(" {}", own.unit) };
            let value = short(num_traits::ToPrimitive::to_f64(&own.written).unwrap_or(f64::NAN));
            vec![format!("{} = {value}{unit}", own.name), own.title.clone()]
        });
        page.columns(&rows.collect::<Vec<_>>());
        page.heading("At the nodes");
        for field in &self.nodal {
            page.item(&format!("{} = {}", field.name, field.formula.text.text()));
        }
        page.item(&format!("stored (m) = {}", self.stored.0.text.text()));
        page.heading("Weak form, summed over the points of the cells");
        for (name, formula, _) in &self.definitions {
            page.item(&format!("{name} = {}", formula.text.text()));
        }
        terms(page, &self.terms);
        page.heading("Forces per area, at the nodes");
        let rows = self.forces.iter().map(|own| {
            vec![
                format!("{} (Pa)", own.name),
                format!("on {}", own.on.text()),
                own.formula.text.text().to_owned(),
            ]
        });
        page.columns(&rows.collect::<Vec<_>>());
        page.heading("Edges and openings");
        let rows = self.edges.iter().map(|own| {
            let given = self.unknowns.iter().zip(own.given).filter(|(_, given)| *given);
            let given: Vec<&str> = given.map(|(own, _)| own.name.as_str()).collect();
            let pair = match own.out {
                true => format!("out >= 0, {0} >= 0, out*{0} = 0", self.unknowns[1].name),
                false => String::new(),
            };
            vec![own.name.clone(), format!("{} given", given.join(", ")), pair]
        });
        page.columns(&rows.collect::<Vec<_>>());
        for output in &self.outputs {
            page.heading(&format!("{} ({}), {}", output.name, output.unit, output.title));
            terms(page, &output.terms);
        }
        self.derived(page);
    }

    /// What the generator made of it.
    fn derived(&self, page: &mut Page) {
        page.heading("As derived");
        if let Ok(nodal) = self.nodal_values() {
            let names = [&self.unknowns[0].name, &self.unknowns[1].name, &self.gap.name];
            for (name, values) in &nodal.values {
                for (by, slope) in names.into_iter().zip(&values[1..]) {
                    if !nodal.graph.is_zero(*slope) {
                        page.item(&format!(
                            "d{name}_d{by} = {}",
                            display_rounded(&nodal.graph, *slope)
                        ));
                    }
                }
            }
        }
        let programs = [
            ("residual of a cell", self.residual_program()),
            ("forces and outputs of a cell", self.surface_program()),
        ];
        for (what, program) in programs {
            match program {
                Ok((derived, program)) => {
                    let slopes: usize = derived.values.iter().map(|own| own.slopes.len()).sum();
                    let fields: Vec<&str> =
                        derived.fields.iter().map(|(_, name, _)| name.as_str()).collect();
                    page.item(&format!(
                        "{what}: {} over {}, with {} that are not zero; {}",
                        count(derived.values.len(), "value"),
                        fields.join(", "),
                        count(slopes, "slope"),
                        Program::total_counts(&program)
                    ));
                }
                Err(errors) => page.paragraph(2, &format!("not derived: {errors}")),
            }
        }
    }
}

fn terms(page: &mut Page, terms: &[Term]) {
    let rows = terms.iter().map(|own| {
        let points = own.rules.each_ref().map(|rule| rule.text.as_str()).join(" x ");
        vec![own.name.clone(), own.formula.text.text().to_owned(), points]
    });
    page.columns(&rows.collect::<Vec<_>>());
}
