//! Where a law changes its formula: everything that it compares, found in its graph.

use whirl_codegen::expression::{Function, Graph, Id, Node};
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::schedule::{Request, schedule};
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

    /// Which of the steps along one input change no formula, on either side of a point.
    pub(super) fn clear(&self, point: &[f64], input: usize, steps: &[f64]) -> Vec<bool> {
        const SHARES: [f64; 5] = [0.0, -1.0, -0.5, 0.5, 1.0];
        let moved = steps.iter().flat_map(|step| SHARES.map(|share| point[input] + share * step));
        let moved: Vec<f64> = moved.collect();
        let differences = along(&self.tape, point, input, &moved);
        let signs = |place: usize| differences.iter().map(move |row| row[place] < 0.0);
        (0..steps.len())
            .map(|step| {
                let first = step * SHARES.len();
                (1..SHARES.len()).all(|other| signs(first + other).eq(signs(first)))
            })
            .collect()
    }
}

/// Rows of a tape where one input takes several values: [output][value of the input].
pub(super) fn along(tape: &Tape, point: &[f64], input: usize, values: &[f64]) -> Vec<Vec<f64>> {
    let rows = point.iter().enumerate().flat_map(|(place, x)| {
        values.iter().map(move |value| if place == input { *value } else { *x })
    });
    let rows: Vec<f64> = rows.collect();
    let mut outputs = vec![0.0; tape.outputs() * values.len()];
    tape.evaluate(values.len(), &rows, &mut outputs, &mut vec![0.0; tape.workspace()]);
    (0..tape.outputs()).map(|i| outputs[i * values.len()..][..values.len()].to_vec()).collect()
}
