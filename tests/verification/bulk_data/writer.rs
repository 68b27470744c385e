//! Meshes as bulk data, in each of its forms.

use std::fmt::Write;

use whirl_solver::mesh::Mesh;

/// How fields are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Form {
    Small,
    Large,
    Free,
}

/// A number in so many columns, with as many digits as fit.
fn real(value: f64, width: usize) -> String {
    let mut best = (f64::INFINITY, String::new());
    let mut offer = |text: String, read: f64| {
        let off = (read - value).abs();
        if text.len() <= width && off < best.0 {
            best = (off, text);
        }
    };
    for digits in 0..17 {
        let plain = format!("{value:.digits$}");
        let plain = if plain.contains('.') { plain } else { plain + "." };
        let read = plain.parse().unwrap();
        offer(
            plain.replacen(
                "0.",
                ".",
                usize::from(plain.trim_start_matches('-').starts_with("0.") && digits > 0),
            ),
            read,
        );
        let scientific = format!("{value:.digits$e}");
        let (mantissa, exponent) = scientific.split_once('e').unwrap();
        let mantissa =
            if mantissa.contains('.') { mantissa.to_owned() } else { format!("{mantissa}.") };
        let sign = if exponent.starts_with('-') { "" } else { "+" };
        offer(format!("{mantissa}{sign}{exponent}"), scientific.parse().unwrap());
    }
    best.1
}

fn card(text: &mut String, form: Form, name: &str, fields: &[String]) {
    let (per_line, width) = match form {
        Form::Large => (4, 16),
        _ => (8, 8),
    };
    for (number, line) in fields.chunks(per_line).enumerate() {
        let start = match (number, form) {
            (0, Form::Large) => format!("{name}*"),
            (0, _) => name.to_owned(),
            (_, Form::Large) => "*".to_owned(),
            _ => String::new(),
        };
        match form {
            Form::Free => writeln!(text, "{start},{}", line.join(",")).unwrap(),
            _ => {
                let fields: String = line.iter().map(|field| format!("{field:>width$}")).collect();
                writeln!(text, "{}", format!("{start:<8}{fields}").trim_end()).unwrap();
            }
        }
    }
}

fn number(form: Form, value: f64) -> String {
    match form {
        Form::Small => real(value, 8),
        Form::Large => real(value, 16),
        Form::Free => format!("{value:?}"),
    }
}

fn nodes(text: &mut String, mesh: &Mesh, form: Form, first: u64, away: f64) {
    for (label, [x, y, z]) in mesh.labels().iter().zip(mesh.nodes()) {
        let at = [x + away, *y, *z].map(|x| number(form, x));
        let fields = [vec![(label + first).to_string(), String::new()], at.to_vec()].concat();
        card(text, form, "GRID", &fields);
    }
}

fn cells(text: &mut String, mesh: &Mesh, form: Form, first: u64) {
    for (property, block) in mesh.blocks().iter().enumerate() {
        let (name, order) = block.element.nastran.unwrap();
        for (cell, label) in block.cells().zip(&block.labels) {
            let mut fields = vec![(label + first).to_string(), (property + 1).to_string()];
            let own = order.iter().map(|&node| mesh.labels()[cell[node]] + first);
            fields.extend(own.map(|label| label.to_string()));
            card(text, form, name, &fields);
        }
    }
}

fn materials(text: &mut String, mesh: &Mesh, form: Form) {
    for (label, material) in mesh.materials().iter().enumerate() {
        let label = label + 1;
        writeln!(text, "$HMNAME MAT {label}\"{}\" \"MAT1\"", material.name).unwrap();
        let value = |symbol: &str| number(form, material.properties[symbol]);
        let fields = [label.to_string(), value("E"), String::new(), value("nu"), value("rho")];
        card(text, form, "MAT1", &fields);
    }
    for (property, block) in mesh.blocks().iter().enumerate() {
        let fields = [(property + 1).to_string(), (block.material + 1).to_string()];
        card(text, form, "PSOLID", &fields);
    }
}

pub(super) fn write(mesh: &Mesh, form: Form) -> String {
    let mut text = "SOL 103\nCEND\n".to_owned();
    for (label, (name, set)) in mesh.node_sets().iter().enumerate() {
        writeln!(text, "$HMSET {} 1 \"{name}\"", label + 1).unwrap();
        let labels: Vec<String> = set.iter().map(|&node| mesh.labels()[node].to_string()).collect();
        let lines: Vec<String> = labels.chunks(6).map(|line| line.join(",")).collect();
        writeln!(text, "SET {} = {}", label + 1, lines.join(",\n")).unwrap();
    }
    text += "BEGIN BULK\n";
    nodes(&mut text, mesh, form, 0, 0.0);
    cells(&mut text, mesh, form, 0);
    materials(&mut text, mesh, form);
    text + "ENDDATA\n"
}

/// The mesh many times, side by side.
pub(super) fn many(mesh: &Mesh, times: u64) -> String {
    let mut text = String::new();
    for time in 0..times {
        nodes(&mut text, mesh, Form::Free, 10_000 * time, 0.125 * time as f64);
        cells(&mut text, mesh, Form::Free, 10_000 * time);
    }
    materials(&mut text, mesh, Form::Free);
    text
}
