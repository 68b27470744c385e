//! Shape functions and their reference gradients at the points of a rule: exact, then the nearest f64.

use std::collections::BTreeMap;

use super::exact;
use super::quadrature::Quadrature;
use crate::diagnostic::{Code, Diagnostic};
use crate::expression::{Graph, Id, Rational, normal};
use crate::spec::element::{ElementSpec, Function};

/// Values at the points of a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Weight of every point.
    pub weights: Vec<f64>,
    /// points × nodes: N_a.
    pub values: Vec<Vec<f64>>,
    /// points × nodes: ∂N_a/∂(ξ, η, ζ).
    pub slopes: Vec<Vec<[f64; 3]>>,
    /// points × modes: ∂M_m/∂(ξ, η, ζ).
    pub mode_slopes: Vec<Vec<[f64; 3]>>,
    /// nodes: ∂N_a/∂(ξ, η, ζ) at the centre of the cell.
    pub centre_slopes: Vec<[f64; 3]>,
}

/// w N_a N_b at the points, for all pairs a ≤ b of nodes; equal rows are kept once.
#[derive(Debug, Clone, PartialEq)]
pub struct Products {
    /// distinct rows × points.
    pub rows: Vec<Vec<f64>>,
    /// The row of every pair: (0,0), (0,1), …, (1,1), …
    pub places: Vec<usize>,
}

impl Table {
    /// The values at the points of the rule of a form.
    ///
    /// # Errors
    /// A function that has no exact value at a point.
    pub fn new(element: &ElementSpec, form: &str) -> Result<Self, Box<Diagnostic>> {
        let mut graph = element.graph.clone();
        let mut at = Evaluation { graph: &mut graph, coordinates: element.coordinates };
        let modes = element.enhanced.as_ref().map_or(&[][..], |enhanced| &enhanced.modes);
        let centre = element.cell.centre().map(|x| at.graph.number(x));
        let centre_slopes = at.slopes(&element.shape, &centre)?;
        let mut table = Table {
            weights: Vec::new(),
            values: Vec::new(),
            slopes: Vec::new(),
            mode_slopes: Vec::new(),
            centre_slopes,
        };
        for point in &element.rule(form).points {
            let weight = exact::to_f64(at.graph, point.weight);
            table.weights.push(weight.unwrap_or(f64::NAN));
            let values: Result<_, _> = (element.shape.iter())
                .map(|function| at.number(function.value, function, &point.at))
                .collect();
            table.values.push(values?);
            table.slopes.push(at.slopes(&element.shape, &point.at)?);
            table.mode_slopes.push(at.slopes(modes, &point.at)?);
        }
        Ok(table)
    }
}

impl Products {
    /// The products for a rule.
    ///
    /// # Errors
    /// A shape function that has no exact value at a point.
    pub fn new(element: &ElementSpec, rule: &Quadrature) -> Result<Self, Box<Diagnostic>> {
        let mut graph = element.graph.clone();
        let mut at = Evaluation { graph: &mut graph, coordinates: element.coordinates };
        let mut values: Vec<Vec<Id>> = Vec::with_capacity(rule.points.len());
        for point in &rule.points {
            let row = element.shape.iter().map(|f| at.exact(f.value, f, &point.at));
            values.push(row.collect::<Result<_, _>>()?);
        }
        let mut products = Products { rows: Vec::new(), places: Vec::new() };
        let mut known: BTreeMap<Vec<Id>, usize> = BTreeMap::new();
        for a in 0..element.nodes.len() {
            for b in a..element.nodes.len() {
                let mut row = Vec::with_capacity(rule.points.len());
                for (point, values) in rule.points.iter().zip(&values) {
                    let product = [point.weight, values[a], values[b]];
                    let factors = product.map(|factor| (factor, Rational::from_integer(1.into())));
                    let product = graph.product(&factors);
                    row.push(normal::expand(&mut graph, product));
                }
                let place = *known.entry(row.clone()).or_insert_with(|| {
                    let numbers = row.iter().map(|id| exact::to_f64(&graph, *id));
                    products.rows.push(numbers.map(|x| x.unwrap_or(f64::NAN)).collect());
                    products.rows.len() - 1
                });
                products.places.push(place);
            }
        }
        Ok(products)
    }
}

struct Evaluation<'g> {
    graph: &'g mut Graph,
    coordinates: [Id; 3],
}

impl Evaluation<'_> {
    fn exact(&mut self, id: Id, of: &Function, at: &[Id; 3]) -> Result<Id, Box<Diagnostic>> {
        let by: BTreeMap<Id, Id> = self.coordinates.into_iter().zip(*at).collect();
        let value = self.graph.substitute(id, &by);
        let value = normal::expand(self.graph, value);
        if exact::approximate(self.graph, value).is_some() {
            return Ok(value);
        }
        let at = at.map(|x| exact::display(self.graph, x)).join(", ");
        let message = format!("this function has no exact value at the point ({at})");
        Err(Box::new(of.text.error_here(Code::SHAPE_FUNCTION, message)))
    }

    fn number(&mut self, id: Id, of: &Function, at: &[Id; 3]) -> Result<f64, Box<Diagnostic>> {
        let value = self.exact(id, of, at)?;
        Ok(exact::to_f64(self.graph, value).unwrap_or(f64::NAN))
    }

    fn slopes(
        &mut self,
        functions: &[Function],
        at: &[Id; 3],
    ) -> Result<Vec<[f64; 3]>, Box<Diagnostic>> {
        let slopes = functions.iter().map(|function| {
            let [xi, eta, zeta] = function.gradient.map(|slope| self.number(slope, function, at));
            Ok([xi?, eta?, zeta?])
        });
        slopes.collect()
    }
}
