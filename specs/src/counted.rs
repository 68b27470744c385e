//! Kernels of cells take as many operations as they say: they are run over a lane type that records what is done, and
//! what leads to a result is counted.

use crate::register::Register;
use crate::traced::{Traced, needed};
use crate::{Batch, CellKernel, ELEMENTS, Lane, Registers};

/// Operations of a kernel for a cell with so many numbers, properties and stored values.
fn counted(kernel: CellKernel, given: usize, material: usize, stored: usize) -> usize {
    let (mut matrices, mut jacobians) = (Batch::storage(1, stored), [0.0]);
    Registers::TRACED.within(|| {
        kernel(&vec![0.0; given], &vec![0.0; material], &mut matrices, &mut jacobians);
    });
    needed()
}

#[test]
fn what_leads_to_nothing_is_not_counted() {
    let (x, mut memory) = (Traced::splat(2.0), [[0.0; 1]; 2]);
    let root = x.mul_add(x, -x).sqrt();
    root.store(&mut memory[0]);
    let _ = root / x;
    // Once, although both results need it.
    (Traced::load(&memory[0]) + 1.0).store(&mut memory[1]);
    assert_eq!(needed(), 2 + 1 + 1);
    assert_eq!(needed(), 0);
}

#[test]
fn kernels_of_cells_take_as_many_operations_as_they_say() {
    let mut wrong = Vec::new();
    for element in ELEMENTS {
        let mut compare = |name: &str, found: usize, said: usize| {
            if found != said {
                wrong.push(format!("{} {name}: {found}, not {said}", element.origin.name));
            }
        };
        for form in element.forms {
            let given = 3 * element.nodes * if form.under_stress { 2 } else { 1 };
            let stored = form.structure.len(element.nodes);
            let found = counted(form.evaluate, given, form.material.len(), stored);
            compare(form.form, found, form.flops);
        }
        for own in element.stresses {
            let (given, stored) = (6 * element.nodes, 6 * own.points.len());
            let found = counted(own.evaluate, given, own.material.len(), stored);
            compare(own.stress, found, own.flops);
        }
    }
    assert!(
        wrong.is_empty(),
        "operations a cell (codegen/src/kinds/cells.rs says those of the functions in this folder):\n{}",
        wrong.join("\n")
    );
}
