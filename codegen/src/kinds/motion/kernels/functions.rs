//! Which kernels a motion has, and each as a documented function.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::kernel::{ResultKind, Writer};
use super::plan::{Asked, KernelPlan, plan};
use crate::emit::documented;
use crate::expression::{Graph, Id, Rational, display};
use crate::kinds::motion::MotionSpec;
use crate::kinds::motion::lagrange::Blocks;
use crate::schedule::ScheduleError;

/// Names of the outputs of vector kernels; the second begins the names of coefficients.
const ROWS: [&str; 2] = ["theta_row", "by"];
/// Names of the outputs of matrix kernels, likewise.
const BLOCKS: [&str; 4] = ["corner", "row", "column", "block"];

/// A kernel to be written.
#[derive(Debug)]
struct Kernel {
    name: &'static str,
    title: &'static str,
    kind: ResultKind,
    /// Outputs in the order of their kind.
    expressions: Vec<Id>,
    /// Whether it takes a1 and a2.
    newmark: bool,
}

/// A kernel of a motion before it is written.
#[derive(Debug)]
pub struct Planned {
    kernel: Kernel,
    /// What it computes.
    pub plan: KernelPlan,
    /// The graph in which the plan names things: the motion's, and more.
    pub graph: Graph,
}

impl Planned {
    /// Name of the function.
    pub fn name(&self) -> &'static str {
        self.kernel.name
    }

    /// What its outputs are.
    pub fn kind(&self) -> ResultKind {
        self.kernel.kind
    }
}

/// The kernels of a motion before they are written, in the order of the text.
///
/// # Errors
/// Terms that cannot be written as loops over matrix–vector products.
pub fn planned(spec: &MotionSpec) -> Result<Vec<Planned>, ScheduleError> {
    let mut graph = spec.graph.clone();
    let kernels = kernels(spec, &mut graph);
    let planned = kernels.into_iter().map(|kernel| {
        let mut graph = graph.clone();
        let plan = plan(&mut graph, &asked(&kernel))?;
        Ok(Planned { kernel, plan, graph })
    });
    planned.collect()
}

fn asked(kernel: &Kernel) -> Vec<Asked> {
    let names: &[&'static str] = match kernel.kind {
        ResultKind::Value => &["value"],
        ResultKind::Rows => &ROWS,
        ResultKind::Blocks => &BLOCKS,
    };
    let outputs = names.iter().zip(&kernel.expressions);
    outputs.map(|(name, expression)| Asked { name, expression: *expression }).collect()
}

fn kernels(spec: &MotionSpec, graph: &mut Graph) -> Vec<Kernel> {
    let (equations, derived) = (&spec.equations, &spec.derivatives);
    let minus = -Rational::from(1);
    let inertia_force: Vec<Id> = (equations.quadratic_velocity.iter())
        .zip(&derived.mass_times_acceleration)
        .map(|(q_v, ma)| {
            let ma = graph.times(minus.clone(), *ma);
            graph.add(*q_v, ma)
        })
        .collect();
    let flat = |blocks: &Blocks| blocks.concat();
    let (mass, pf, b, p) =
        (flat(&equations.mass), flat(&derived.pf), flat(&derived.b), flat(&derived.p));
    let (a1, a2) = (graph.scalar("a1_"), graph.scalar("a2_"));
    let minus_a1 = graph.times(minus.clone(), a1);
    let tangent = (0..mass.len())
        .map(|place| {
            let (mass, p) = (graph.mul(a2, mass[place]), graph.mul(minus_a1, p[place]));
            let b = graph.times(minus.clone(), b[place]);
            [pf[place], p, b].into_iter().fold(mass, |sum, part| graph.add(sum, part))
        })
        .collect();
    let rows = |name, title, expressions: &[Id]| Kernel {
        name,
        title,
        kind: ResultKind::Rows,
        expressions: expressions.to_vec(),
        newmark: false,
    };
    let blocks = |name, title, expressions| Kernel {
        name,
        title,
        kind: ResultKind::Blocks,
        expressions,
        newmark: false,
    };
    let mut kernels = Vec::new();
    kernels.extend(equations.kinetic_energy.map(|energy| Kernel {
        name: "kinetic_energy",
        title: "Kinetic energy T (J).",
        kind: ResultKind::Value,
        expressions: vec![energy],
        newmark: false,
    }));
    let momentum = equations.momentum.as_ref();
    kernels.extend(momentum.map(|p| rows("momentum", "Momenta ∂T/∂q̇.", p)));
    kernels.extend([
        rows("inertia_force", "Q_v − M q̈.", &inertia_force),
        rows("quadratic_velocity", "Q_v, eq. (27).", &equations.quadratic_velocity),
        rows("mass_times_acceleration", "M q̈.", &derived.mass_times_acceleration),
        blocks("mass", "M(q), eq. (31).", mass),
        blocks("pf", "PF = ∂(M q̈)/∂q, eqs. (37), (40).", pf),
        blocks("b", "B = ∂Q_v/∂q, eqs. (38), (41).", b),
        blocks("p", "P = ∂Q_v/∂q̇, eqs. (39), (42).", p),
        Kernel {
            name: "tangent",
            title: "a2·M + PF − a1·P − B, the motion's part of eq. (46).",
            kind: ResultKind::Blocks,
            expressions: tangent,
            newmark: true,
        },
    ]);
    kernels
}

/// A kernel as a Rust function over a lane type, with its documentation.
pub(super) fn function(
    spec: &MotionSpec,
    Planned { kernel, plan, graph }: &Planned,
) -> TokenStream {
    let name = format_ident!("{}", kernel.name);
    let header = documented(&header(spec, graph, kernel, plan));
    let writer = Writer { spec, graph, plan };
    let body = writer.body(kernel.kind);
    let tensors = if writer.takes_tensors() { "tensors_" } else { "_tensors_" };
    let tensors = format_ident!("{tensors}");
    let workspace = if plan.products.is_empty() { "_workspace_" } else { "workspace_" };
    let workspace = format_ident!("{workspace}");
    let newmark = kernel.newmark.then(|| quote!(a1_: f64, a2_: f64,));
    let lanes = kernel.newmark.then(|| {
        quote! {
            let a1_ = L::splat(a1_);
            let a2_ = L::splat(a2_);
        }
    });
    let (out, result) = match kernel.kind {
        ResultKind::Value => (quote!(), quote!(-> L)),
        _ => (quote!(out_: &mut [L]), quote!()),
    };
    quote! {
        #header
        #[inline(always)]
        pub fn #name<L: Lane>(
            #tensors: &[&[f64]],
            state_: &MotionState<L>,
            #newmark
            #workspace: &mut [L],
            #out
        ) #result {
            #lanes
            #body
        }
    }
}

/// Title, equations and counts.
fn header(spec: &MotionSpec, graph: &Graph, kernel: &Kernel, plan: &KernelPlan) -> String {
    let mut text = format!("{}\n\n```text\n", kernel.title);
    let names: Vec<&str> = spec.coordinates.iter().map(|c| c.name.as_str()).collect();
    for (place, expression) in kernel.expressions.iter().enumerate() {
        let place = match kernel.kind {
            ResultKind::Value => "T".to_owned(),
            ResultKind::Rows => names[place].to_owned(),
            ResultKind::Blocks => {
                format!("{}.{}", names[place / names.len()], names[place % names.len()])
            }
        };
        text.push_str(&format!("{place} = {}\n", display(graph, *expression)));
    }
    text.push_str("```\n\n");
    let products: Vec<&str> = plan.products.iter().map(|product| plan.name(product.id)).collect();
    let products = match products.len() {
        0 => "No matrix–vector product".to_owned(),
        1 => format!("One matrix–vector product ({})", products[0]),
        count => format!("{count} matrix–vector products ({})", products.join(", ")),
    };
    let combined: usize = plan.outputs.iter().map(|form| form.matrices().len()).sum();
    let matrices = match combined {
        0 => String::new(),
        1 => ", one stored matrix written".to_owned(),
        count => format!(", {count} stored matrices combined"),
    };
    text.push_str(&format!(
        "{products}{matrices}, {} of n values",
        match plan.dots.len() {
            0 => "no dot product".to_owned(),
            1 => "one dot product".to_owned(),
            count => format!("{count} dot products"),
        }
    ));
    text.push_str(&format!("; scalars: {}.", plan.scalars.total_counts()));
    text
}
