//! Kernels of cells on every kind of register that this processor has.

use whirl_codegen::operation::Function;
use whirl_specs::{Batch, CellMatrix, ELEMENTS, Element, FormKernel, Registers};

/// Not a whole number of registers of any width.
const CELLS: usize = 11;

/// Distorted cells, each another one.
fn cells(element: &Element) -> Vec<f64> {
    let nodes = (0..CELLS).flat_map(|_| element.reference_nodes.iter().flatten());
    nodes.enumerate().map(|(i, x)| 0.01 * (x + 0.05 * (1.3 * i as f64 + 0.7).sin())).collect()
}

fn evaluate(kernel: &FormKernel, nodes: usize, cells: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let value = |name| match name {
        "E" => 200e9,
        "nu" => 0.3,
        _ => 7860.0,
    };
    let material: Vec<f64> = kernel.material.iter().map(|m| value(m.name)).collect();
    let count = cells.len() / (3 * nodes);
    let stored = kernel.structure.len(nodes);
    let mut matrices = Batch::storage(count, stored);
    matrices.fill(Batch([f64::NAN; Batch::CELLS]));
    let mut jacobians = vec![f64::NAN; count];
    // Under a stress the displacements of a cell stand behind its coordinates.
    let displaced = |x: &f64| 1e-3 * (x + 0.02 * (150.0 * x).sin());
    let with_displacement = |cell: &[f64]| -> Vec<f64> {
        cell.iter().copied().chain(cell.iter().map(displaced)).collect()
    };
    let given = match kernel.under_stress {
        true => cells.chunks(3 * nodes).flat_map(with_displacement).collect(),
        false => cells.to_vec(),
    };
    (kernel.evaluate)(&given, &material, &mut matrices, &mut jacobians);
    let cells = (0..count).flat_map(|cell| CellMatrix::new(&matrices, stored, cell).values());
    (cells.collect(), jacobians)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Lanes test all functions that they have: those of formulas are among them. |a| is an operator of theirs.
#[test]
fn lanes_have_the_functions_of_formulas() {
    let of_formulas = Function::ALL.iter().map(|function| function.lane());
    let of_formulas: Vec<&str> = of_formulas.filter(|name| *name != "abs").collect();
    assert_eq!(of_formulas, whirl_specs::FUNCTIONS);
}

/// What the processor says of itself decides what is tested: none that it has is left out.
#[test]
fn all_registers_of_this_processor_are_tested() {
    let mut expected = vec!["one value at a time"];
    let mut lacking = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        let avx512 = avx2 && is_x86_feature_detected!("avx512f");
        for (name, here) in [("AVX2 with FMA", avx2), ("AVX-512", avx512)] {
            if here { expected.push(name) } else { lacking.push(name) }
        }
    }
    let tested: Vec<&str> = Registers::all().iter().map(|registers| registers.name()).collect();
    assert_eq!(tested, expected);
    assert_eq!(Registers::absent(), lacking);
    assert_eq!(Registers::current().name(), expected[expected.len() - 1]);
    // Each does what it is asked to within itself.
    for registers in Registers::all() {
        assert_eq!(registers.within(|| Registers::current().name()), registers.name());
    }
}

#[test]
fn all_registers_give_the_same_matrices_to_rounding() {
    for element in ELEMENTS {
        let cells = cells(element);
        for kernel in element.forms {
            let (single, jacobians) =
                Registers::SINGLE.within(|| evaluate(kernel, element.nodes, &cells));
            assert!(jacobians.iter().all(|det| *det > 0.0), "{}", element.origin.name);
            let largest = single.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            for registers in Registers::all() {
                let (found, dets) = registers.within(|| evaluate(kernel, element.nodes, &cells));
                // A few hundred products, rounded once instead of twice, and a condensation.
                let tolerance = 1e-12 * largest;
                let same = found.iter().zip(&single).all(|(a, b)| (a - b).abs() <= tolerance);
                let (name, form) = (element.origin.name, kernel.form);
                assert!(same, "{name} {form} with {}", registers.name());
                let dets = dets.iter().zip(&jacobians);
                assert!(dets.clone().all(|(a, b)| (a / b - 1.0).abs() < 1e-13), "{name} {form}");
            }
        }
    }
}

#[test]
fn a_cell_does_not_depend_on_its_neighbours() {
    for element in ELEMENTS {
        let cells = cells(element);
        for kernel in element.forms {
            for registers in Registers::all() {
                registers.within(|| {
                    let (block, jacobians) = evaluate(kernel, element.nodes, &cells);
                    let stored = block.chunks(kernel.structure.len(element.nodes));
                    let alone = cells.chunks(3 * element.nodes);
                    for ((cell, matrix), det) in alone.zip(stored).zip(jacobians) {
                        let (own, own_det) = evaluate(kernel, element.nodes, cell);
                        assert_eq!(bits(&own), bits(matrix), "{}", element.origin.name);
                        assert_eq!(own_det[0].to_bits(), det.to_bits());
                    }
                });
            }
        }
    }
}

/// Kernels keep their memory from call to call.
#[test]
fn what_a_kernel_left_in_memory_does_not_matter() {
    for element in ELEMENTS {
        let cells = cells(element);
        let nothing = vec![f64::NAN; cells.len()];
        for kernel in element.forms {
            for registers in Registers::all() {
                registers.within(|| {
                    let (before, _) = evaluate(kernel, element.nodes, &cells);
                    let (spoilt, _) = evaluate(kernel, element.nodes, &nothing);
                    assert!(spoilt.iter().all(|value| value.is_nan()));
                    let (after, _) = evaluate(kernel, element.nodes, &cells);
                    assert_eq!(bits(&before), bits(&after), "{}", element.origin.name);
                });
            }
        }
    }
}
