//! Where a law changes its formula: everything that it compares, found in its graph.

use whirl_codegen::expression::{Function, Graph, Id, Node};
use whirl_codegen::schedule::{Request, schedule};
use whirl_codegen::spec::law::LawSpec;
use whirl_codegen::tape::Tape;

/// The differences whose signs decide which formulas apply.
pub(super) struct Breaks {
    tape: Tape,
}

impl Breaks {
    pub(super) fn of(law: &LawSpec) -> Self {
        let mut graph: Graph = law.graph.clone();
        let values: Vec<Id> = law.outputs.iter().map(|output| output.value).collect();
        let mut differences = Vec::new();
        for id in graph.reachable(&values) {
            match *graph.node(id) {
                Node::Compare(_, a, b) => differences.push(graph.sub(a, b)),
                Node::Function(Function::Abs, a) => differences.push(a),
                _ => {}
            }
        }
        let names: Vec<String> = (0..differences.len()).map(|i| format!("difference{i}")).collect();
        let outputs: Vec<_> = names.iter().map(String::as_str).zip(differences).collect();
        let inputs: Vec<_> = law.inputs.iter().map(|i| (i.name.as_str(), i.symbol)).collect();
        let program = schedule(&mut graph, &Request::flat(&inputs, &outputs)).expect("a schedule");
        Breaks { tape: Tape::new(&program) }
    }

    fn signs(&self, inputs: &[f64]) -> Vec<bool> {
        let mut differences = vec![0.0; self.tape.outputs()];
        let mut workspace = vec![0.0; self.tape.workspace()];
        self.tape.evaluate(1, inputs, &mut differences, &mut workspace);
        differences.iter().map(|difference| *difference < 0.0).collect()
    }

    /// Whether a formula changes within `step` of a point, along one input.
    pub(super) fn straddled(&self, point: &[f64], input: usize, step: f64) -> bool {
        let at = |share: f64| {
            let mut inputs = point.to_vec();
            inputs[input] += share * step;
            self.signs(&inputs)
        };
        let here = at(0.0);
        [-1.0, -0.5, 0.5, 1.0].into_iter().any(|share| at(share) != here)
    }
}
