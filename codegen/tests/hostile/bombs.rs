//! Small files that stand for much work: each is refused, or done, in a moment.

/// Files that are refused or done, as it comes.
#[allow(dead_code, reason = "the example measures them; a build for tests is too slow")]
pub(crate) fn all() -> Vec<String> {
    let groups =
        [powers(), chains(), long_formulas(), pieces(), forms(), words(), elements(), repeated()];
    groups.into_iter().flatten().collect()
}

fn law(definitions: &str, value: &str) -> String {
    format!(
        "kind = \"law\"\nname = \"bomb\"\ntitle = \"t\"\nsource = \"s\"\n[inputs.h]\nunit = \"mm\"\n\
         [definitions]\n{definitions}\n[outputs.Q]\nunit = \"N\"\nvalue = '{value}'\n"
    )
}

fn motion(energy: &str) -> String {
    format!(
        "kind = \"motion\"\nname = \"bomb\"\ntitle = \"t\"\nsource = \"s\"\nkinetic_energy = '{energy}'\n\
         [coordinates]\ntheta = \"scalar\"\neta = \"vector\"\n\
         [tensors]\nJ = \"scalar\"\na = \"vector\"\nb = \"vector\"\nM = \"symmetric\"\nH = \"skew\"\n"
    )
}

fn powers() -> Vec<String> {
    let sum = "J + dot(a, eta) + dot(b, eta) + dot(eta, M*eta) + dot(a, M*eta) + dot(b, H*eta)";
    let power = |power| motion(&format!("1/2*theta_dot^2*({sum})^{power}"));
    [3, 8, 20, 50, 100].map(power).to_vec()
}

/// Definitions upon definitions.
fn chains() -> Vec<String> {
    let mut texts = Vec::new();
    for step in [
        "sin(#) + cos(#)",
        "(# + 1)*(# + 2)",
        "min(#, # + 1)",
        "#^2 + 1",
        "sqrt(#*# + 1)",
        "exp(-#)/(1 + exp(-#))",
        "#*(2 - #)",
        "#*h + h",
        "abs(# - h)",
        "sinh(#)",
        "max(#, -#)*h",
    ] {
        for count in [10, 100, 600] {
            let mut text = String::new();
            let mut last = "h".to_owned();
            for place in 0..count {
                text += &format!("d{place} = '{}'\n", step.replace('#', &last));
                last = format!("d{place}");
            }
            texts.push(law(&text, &last));
        }
    }
    texts
}

fn long_formulas() -> Vec<String> {
    let fill = |piece: &str, between: &str| {
        let count = 8000 / (piece.len() + between.len());
        vec![piece; count].join(between)
    };
    let each = |count: usize, between: &str, term: &dyn Fn(usize) -> String| {
        (1..count).map(term).collect::<Vec<_>>().join(between)
    };
    let values = [
        fill("h", "*"),
        fill("h", "+"),
        fill("sin(h)", "*"),
        fill("(h+1)", "*"),
        fill("h^1.5", "+"),
        fill("1/(h+1)", "+"),
        fill("abs(h-1)", "+"),
        fill("exp(h)", "*"),
        format!("min({})", fill("h", ",")),
        each(500, "+", &|i| format!("sin({i}*h)")),
        each(500, "*", &|i| format!("(h+{i})")),
        each(400, "+", &|i| format!("1/(h+{i})")),
        each(400, "*", &|i| format!("abs(h-{i})")),
        format!("max({})", each(900, ",", &|i| format!("h*{i}"))),
        format!("{}h{}", "sin(".repeat(60), ")".repeat(60)),
        format!("h{}", "^1.01".repeat(60)),
        "sum(i, 0, 63, sum(j, 0, 7, sin(i*h + j)*cos(j*h + i)))".to_owned(),
    ];
    values.iter().map(|value| law("", value)).collect()
}

fn pieces() -> Vec<String> {
    let whens = ["h < #", "h*h < #", "sin(h) < #"];
    let law = |when: &str| {
        let pieces = (0..450).map(|i| {
            format!("  {{ when = '{}', value = 'h*{i}' }},\n", when.replace('#', &format!("{i}")))
        });
        let pieces: String = pieces.collect();
        format!(
            "kind = \"law\"\nname = \"bomb\"\ntitle = \"t\"\nsource = \"s\"\n[inputs.h]\nunit = \"mm\"\n\
             [outputs.Q]\nunit = \"N\"\njump = \"accept\"\npieces = [\n{pieces}  {{ value = '0' }},\n]\n"
        )
    };
    whens.map(law).to_vec()
}

fn forms() -> Vec<String> {
    let forms = [
        vec!["E*inner(grad(u), grad(v))"; 300].join(" + "),
        format!("{}*dot(u, v)", vec!["(E + 1)"; 100].join("*")),
        format!("{}*dot(u, v)", vec!["(E + n + k)^8"; 20].join("*")),
    ];
    let text = |form: &String| {
        format!(
            "kind = \"form\"\nname = \"bomb\"\ntitle = \"t\"\nsource = \"s\"\n\
             [material]\nE = {{ unit = \"1\", title = \"t\" }}\nn = {{ unit = \"1\", title = \"t\" }}\n\
             k = {{ unit = \"1\", title = \"t\" }}\n[forms]\nf = '{form}'\n"
        )
    };
    forms.iter().map(text).collect()
}

/// Numbers, names and units of any length.
fn words() -> Vec<String> {
    let (digits, name) = ("9".repeat(7000), "n".repeat(7000));
    let many: String = (0..4000).map(|i| format!("+x{i}")).collect();
    vec![
        law("", &digits),
        law("", &format!("0.{digits}*h")),
        law("", &format!("1e{digits}*h")),
        law(&format!("{name} = '2*h'"), &name),
        law("", &"θ̇".repeat(1500)),
        law("", "h*1e308^3*1e-308^3"),
        law("", &format!("h{}", &many[..8000])),
    ]
}

/// Files that are refused, each with the code.
pub(crate) fn refused() -> Vec<(String, &'static str)> {
    let head = "kind = \"motion\"\n";
    let joined = "a.".repeat(20_000);
    let mut texts = vec![
        (motion("1/2*theta_dot^2*(J + dot(a, eta) + dot(b, eta) + dot(eta, M*eta))^100"), "E015"),
        (format!("{head}a = {}{}", "[".repeat(20_000), "]".repeat(20_000)), "E001"),
        (format!("{head}a = {}1{}", "{b=".repeat(20_000), "}".repeat(20_000)), "E001"),
        (format!("{head}{joined}a = 1\n"), "E015"),
        (format!("{head}[{joined}a]\n"), "E015"),
        (format!("{head}{}a = 1\n", "\"a\".".repeat(20_000)), "E015"),
        (format!("kind = \"element\"\n# {}", "x".repeat(1_000_000)), "E015"),
        (law("", "h").replace("\"mm\"", &format!("\"{}\"", "mm*".repeat(2000))), "E020"),
    ];
    for number in [
        "(((sqrt(2)+sqrt(3)+1)^64+1)^64+1)^64",
        "1/(((sqrt(2)+sqrt(3)+1)^8+1)^8+1)^8",
        "(sqrt(2)+1)*(sqrt(3)+1)*(sqrt(5)+1)*(sqrt(7)+1)*(sqrt(11)+1)*(sqrt(13)+1)*(sqrt(17)+1)",
    ] {
        texts.push((points(number), "E015"));
    }
    for power in ["h^(1/997)*h^(1/991)*h^(1/983)*h^(1/977)", "((h^(1/997))^(1/991))^(1/983)"] {
        texts.push((law("", &format!("({power})^0*{power}")), "E014"));
    }
    let node = |i: usize| format!("[{}, {}, {}]", i % 4, (i / 4) % 4, i / 16);
    for (shape, count, code) in
        [("(1 + xi_a*xi)*(1 + eta_a*eta)*(1 + zeta_a*zeta)/8", 64, "E050"), ("xi", 10_000, "E004")]
    {
        let nodes: Vec<String> = (0..count).map(node).collect();
        texts.push((element(&nodes.join(", "), shape), code));
    }
    texts
}

/// Expressions that use what is below them twice, level upon level.
pub(crate) fn repeated() -> Vec<String> {
    let nested = |function: &str, of: &str| {
        format!("{}{of}{}", format!("{function}(").repeat(40), ")".repeat(40))
    };
    let mut texts = Vec::new();
    for scale in [nested("sinh", "det"), nested("cosh", "det0/det"), nested("abs", "sinh(det)")] {
        texts.push(
            include_str!("../../../specs/elements/hex8i.toml")
                .replace("scale = 'det0/det'", &format!("scale = '{scale}'")),
        );
    }
    let shape = format!("xi*{}", nested("sinh", "xi"));
    let nodes = "[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], \
                 [-1, 1, 1]";
    texts.push(element(nodes, &shape));
    texts.push(points(&nested("sinh", "1")));
    texts.push(law("", &nested("sinh", "h")));
    texts
}

/// An element whose rule has this number for a coordinate.
fn points(number: &str) -> String {
    include_str!("../../../specs/elements/tet4.toml")
        .replace("rule = [\"tetrahedron(4)\"]", &format!("points = [['{number}', 0, 0, '1/6']]"))
}

/// Shape functions that are much when they are multiplied out, on the nodes of a cube.
fn elements() -> Vec<String> {
    let nodes = "[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], \
                 [-1, 1, 1]";
    let shapes = [
        "(xi + eta + zeta + xi_a)^20",
        "(xi + eta + zeta + xi_a)^100",
        "((xi + 1)/(eta + 2) + (zeta + 3)/(xi_a + 4))^9",
        "(1 + xi)^50*(1 + eta)^50*(1 + zeta)^50",
        "1/((xi + 2)*(eta + 3)*(zeta + 4)) + 1/(xi + eta + zeta + 5)^30",
        "sqrt(xi + 2)*sin(eta) + xi_a",
    ];
    shapes.map(|shape| element(nodes, shape)).to_vec()
}

fn element(nodes: &str, shape: &str) -> String {
    format!(
        "kind = \"element\"\nname = \"bomb\"\ntitle = \"t\"\nsource = \"s\"\ncell = \"hexahedron\"\n\
         nodes = [{nodes}]\nshape = '{shape}'\n[quadrature]\n\
         rule = [\"gauss(4)\", \"gauss(4)\", \"gauss(4)\"]\ndegree = 12\n\
         [abaqus]\ntypes = [\"X\"]\n[vtk]\ntype = 1\n"
    )
}
