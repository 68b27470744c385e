//! Shape functions and their reference gradients at the points of a rule: the f64 nearest to the exact
//! numbers.

use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;
use num_traits::Zero;

use super::function::Function;
use crate::diagnostic::{Code, Diagnostic};
use crate::element::Cell;
use crate::element::algebraic::{self, Algebraic};
use crate::element::polynomial::{Exponents, Polynomial};
use crate::element::quadrature::{Point, Quadrature, variable};
use crate::rational::nearest;

/// Values at the points of a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Weight of every point.
    pub(crate) weights: Vec<f64>,
    /// points × nodes: N_a.
    pub values: Vec<Vec<f64>>,
    /// points × nodes: ∂N_a/∂(ξ, η, ζ).
    pub slopes: Vec<Vec<[f64; 3]>>,
    /// points × modes: ∂M_m/∂(ξ, η, ζ).
    pub mode_slopes: Vec<Vec<[f64; 3]>>,
    /// nodes: ∂N_a/∂(ξ, η, ζ) at the centre of the cell.
    pub(crate) centre_slopes: Vec<[f64; 3]>,
    /// w N_a N_b, if they are few.
    pub products: Option<Products>,
}

/// Most products of pairs at points that are computed: kernels with more sum them up in loops.
const PRODUCTS: usize = 500;

/// w N_a N_b at the points, for all pairs a ≤ b of nodes; equal rows are kept once.
#[derive(Debug, Clone, PartialEq)]
pub struct Products {
    /// distinct rows × points.
    pub(crate) rows: Vec<Vec<f64>>,
    /// The row of every pair: (0,0), (0,1), …, (1,1), …
    pub(crate) places: Vec<usize>,
}

impl Table {
    /// The values at the points of a rule.
    ///
    /// # Errors
    /// A function that has no value at a point or at the centre.
    pub(crate) fn new(
        cell: Cell,
        shape: &[Function],
        modes: &[Function],
        rule: &Quadrature,
    ) -> Result<Self, Box<Diagnostic>> {
        let mut table = Table {
            weights: rule.points.iter().map(|point| rule.field.to_f64(&point.weight)).collect(),
            values: Vec::new(),
            slopes: Vec::new(),
            mode_slopes: Vec::new(),
            centre_slopes: Vec::new(),
            products: None,
        };
        let centre = cell.centre();
        for function in shape {
            let slopes = function.slopes.each_ref().map(|slope| slope.at(cell, &centre));
            let [Some(xi), Some(eta), Some(zeta)] = slopes else {
                return Err(without_value(function, "the centre of the cell"));
            };
            table.centre_slopes.push([xi, eta, zeta].map(|slope| nearest(&slope)));
        }
        let mut exact = Vec::with_capacity(rule.points.len());
        for point in &rule.points {
            let powers = Powers::new(cell, rule, point, shape.iter().chain(modes));
            let values: Result<Vec<BigInt>, _> = (shape.iter())
                .map(|function| powers.value(&function.polynomial, function, rule, point))
                .collect();
            let values = values?;
            table.values.push(values.iter().map(algebraic::rounded).collect());
            let slopes = |functions: &[Function]| -> Result<Vec<[f64; 3]>, Box<Diagnostic>> {
                let of = |function: &Function| {
                    let slope = |axis: usize| -> Result<f64, Box<Diagnostic>> {
                        let slope = powers.value(&function.slopes[axis], function, rule, point)?;
                        Ok(algebraic::rounded(&slope))
                    };
                    Ok([slope(0)?, slope(1)?, slope(2)?])
                };
                functions.iter().map(of).collect()
            };
            table.slopes.push(slopes(shape)?);
            table.mode_slopes.push(slopes(modes)?);
            exact.push((rule.field.fixed(&point.weight), values));
        }
        let pairs = shape.len() * (shape.len() + 1) / 2;
        table.products = (pairs * exact.len() <= PRODUCTS).then(|| Products::new(&exact));
        Ok(table)
    }
}

impl Products {
    /// For every point its weight and the values of the shape functions.
    fn new(points: &[(BigInt, Vec<BigInt>)]) -> Self {
        let nodes = points.first().map_or(0, |(_, values)| values.len());
        let mut products = Products { rows: Vec::new(), places: Vec::new() };
        let mut known: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
        let weighted: Vec<Vec<BigInt>> = (points.iter())
            .map(|(weight, values)| values.iter().map(|n| algebraic::product(weight, n)).collect())
            .collect();
        for a in 0..nodes {
            for b in a..nodes {
                let product = |((_, values), weighted): (&(BigInt, Vec<BigInt>), &Vec<BigInt>)| {
                    algebraic::rounded(&algebraic::product(&weighted[a], &values[b]))
                };
                let row: Vec<f64> = points.iter().zip(&weighted).map(product).collect();
                let bits = row.iter().map(|value| value.to_bits()).collect();
                let place = *known.entry(bits).or_insert_with(|| {
                    products.rows.push(row);
                    products.rows.len() - 1
                });
                products.places.push(place);
            }
        }
        products
    }
}

/// The powers of a point's coordinates that functions need, as fixed-point numbers.
struct Powers {
    of: BTreeMap<Exponents, BigInt>,
}

impl Powers {
    fn new<'f>(
        cell: Cell,
        rule: &Quadrature,
        point: &Point,
        functions: impl Iterator<Item = &'f Function>,
    ) -> Self {
        let polynomials = functions.flat_map(|f| std::iter::once(&f.polynomial).chain(&f.slopes));
        let used: BTreeSet<Exponents> = polynomials
            .flat_map(|polynomial| polynomial.terms().map(|(powers, _)| *powers))
            .collect();
        let variables: [Algebraic; 3] =
            std::array::from_fn(|axis| variable(cell, axis, &point.at[axis]));
        let mut known: BTreeMap<(usize, i32), Option<BigInt>> = BTreeMap::new();
        let mut power = |axis: usize, exponent: i32| {
            let power = || {
                let power = rule.field.power(&variables[axis], exponent)?;
                Some(rule.field.fixed(&power))
            };
            known.entry((axis, exponent)).or_insert_with(power).clone()
        };
        let mut of = BTreeMap::new();
        for exponents in used {
            let [xi, eta, zeta] = [0, 1, 2].map(|axis| power(axis, exponents[axis]));
            let (Some(xi), Some(eta), Some(zeta)) = (xi, eta, zeta) else { continue };
            of.insert(exponents, algebraic::product(&algebraic::product(&xi, &eta), &zeta));
        }
        Powers { of }
    }

    fn value(
        &self,
        polynomial: &Polynomial,
        function: &Function,
        rule: &Quadrature,
        point: &Point,
    ) -> Result<BigInt, Box<Diagnostic>> {
        let mut sum = BigInt::zero();
        for (exponents, c) in polynomial.terms() {
            let Some(power) = self.of.get(exponents) else {
                let at = point.at.each_ref().map(|x| rule.field.display(x)).join(", ");
                return Err(without_value(function, &format!("the point ({at})")));
            };
            sum += power * c.numer() / c.denom();
        }
        Ok(sum)
    }
}

fn without_value(function: &Function, place: &str) -> Box<Diagnostic> {
    let message = format!("this function or its gradient has no value at {place}");
    Box::new(function.text.error_here(Code::SHAPE_FUNCTION, message))
}
