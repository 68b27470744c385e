//! Cells of every element in Abaqus input: node order, and the name of a cell that is inverted.

use std::fmt::Write;

use whirl_solver::assembly::{assemble, mass_properties};
use whirl_solver::mesh::{Mesh, inp};
use whirl_specs::{ELEMENTS, Element};

/// One cell, of twice the size of the reference cell, as the first Abaqus type of the element; mirrored in x
/// if `sign` is −1. Node labels are 10, 20, … in the element's own order.
fn input(element: &Element, sign: f64) -> String {
    let mut text = "*NODE\n".to_owned();
    for (a, [x, y, z]) in element.reference_nodes.iter().enumerate() {
        writeln!(text, "{}, {}, {}, {}", 10 * (a + 1), sign * 2.0 * x, 2.0 * y, 2.0 * z).unwrap();
    }
    writeln!(text, "*ELEMENT, TYPE={}, ELSET=ALL", element.abaqus[0]).unwrap();
    let labels: Vec<String> =
        element.abaqus_order.iter().map(|node| (10 * (node + 1)).to_string()).collect();
    // At most sixteen entries stand on a line.
    let entries = [vec!["7".to_owned()], labels].concat();
    let lines: Vec<String> = entries.chunks(16).map(|line| line.join(", ")).collect();
    text += &lines.join(",\n");
    text += "\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2e11, 0.3\n*DENSITY\n7860\n\
             *SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n";
    text
}

fn read(element: &Element, sign: f64) -> Mesh {
    let elements: Vec<&'static Element> = ELEMENTS.iter().collect();
    let read = inp::read(&input(element, sign), "cell.inp", &elements);
    read.unwrap_or_else(|errors| panic!("{}: {errors}", element.origin.name)).mesh
}

#[test]
fn cells_of_every_element_are_read_in_the_order_of_abaqus() {
    for element in ELEMENTS {
        let mesh = read(element, 1.0);
        let block = &mesh.blocks()[0];
        assert_eq!(block.element.origin.name, element.origin.name);
        assert!(block.connectivity.iter().copied().eq(0..element.nodes), "{}", element.origin.name);
        let cell = super::spec(element).cell;
        let volume = cell.monomial([0; 3]);
        let volume = volume.numer().to_string().parse::<f64>().unwrap()
            / volume.denom().to_string().parse::<f64>().unwrap();
        let found = mass_properties(&mesh).unwrap().volume;
        assert!((found / (8.0 * volume) - 1.0).abs() < 1e-13, "{}", element.origin.name);
    }
}

#[test]
fn an_inverted_cell_of_any_element_is_named() {
    for element in ELEMENTS {
        let mesh = read(element, -1.0);
        let error = assemble(&mesh, "stiffness").unwrap_err().to_string();
        let expected = format!("cell 7 ({}, smallest det J = -", element.origin.name);
        assert!(error.contains(&expected), "{error}");
    }
}
