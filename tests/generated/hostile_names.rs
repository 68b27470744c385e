//! Specs whose names are words of Rust, of its prelude and of the kernels themselves: the crate that is made
//! from them compiles.

use std::collections::BTreeSet;

use whirl_codegen::formula;
use whirl_specs::generated::FILES;

use crate::workspace::{Workspace, text};

/// Keywords of all editions, those kept for later, those that are words only in places; what the prelude and
/// the core library call things.
const WORDS: &str = "abstract as async auto await become box break const continue crate default do dyn else \
    enum extern false final fn for gen if impl in let loop macro macro_rules match mod move mut override priv \
    pub raw ref return safe self Self static struct super trait true try type typeof union unsafe unsized use \
    virtual where while yield \
    None Some Ok Err Option Result Vec Box String ToString Drop drop Clone Copy Send Sync Sized Fn FnMut FnOnce \
    Default Iterator IntoIterator Extend Into From AsRef AsMut Eq Ord PartialEq PartialOrd Debug Hash ToOwned \
    TryFrom TryInto FromIterator DoubleEndedIterator ExactSizeIterator Future IntoFuture \
    size_of size_of_val align_of align_of_val bool char str i8 i32 i64 u8 u64 usize isize f32 f64 \
    std core alloc main assert panic vec include concat env matches println test derive ENTRY Batch Kernel";

/// Names for which the language of specs has a meaning, so that it refuses them.
const MEANT: [&str; 10] =
    ["u", "v", "Q", "theta", "theta_dot", "theta_ddot", "eta", "eta_dot", "eta_ddot", "pi"];

/// All of these, then every identifier of the kernels that are made from the shipped specs.
fn words() -> Vec<String> {
    let mut words: Vec<String> = WORDS.split_whitespace().map(str::to_owned).collect();
    let mut own = BTreeSet::new();
    for (_, text) in FILES {
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        let apart = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
        own.extend(code.flat_map(|line| line.split(apart)));
    }
    words.extend(own.into_iter().map(str::to_owned));
    let mut seen = BTreeSet::new();
    words.retain(|word| {
        let short = word.len() < 24 && !word.ends_with('_') && !MEANT.contains(&word.as_str());
        let named = formula::name(word).is_ok_and(|name| name == *word);
        short && named && seen.insert(word.clone())
    });
    words
}

fn head(kind: &str, name: &str) -> String {
    format!("kind = \"{kind}\"\nname = \"{name}\"\ntitle = \"t\"\nsource = \"s\"\n")
}

/// A law of this name; those of parameters and definitions never reach Rust.
fn law(name: &str) -> String {
    format!(
        "{}[inputs.h]\nunit = \"mm\"\n[outputs.Q]\nunit = \"N\"\nvalue = '2 - 3*h'\n",
        head("law", name)
    )
}

/// Forms with these names over a material with those.
fn forms(name: &str, forms: &[&String], material: &[String]) -> String {
    let mut text = head("form", name);
    for property in material {
        text += &format!("[material.{property}]\nunit = \"1\"\ntitle = \"t\"\n");
    }
    // Every coefficient in a product of its own keeps its name.
    let sum = |from: usize| {
        let some = material.iter().skip(from).step_by(forms.len().max(1));
        some.map(String::as_str).collect::<Vec<_>>().join(" + ")
    };
    text += "[coefficients]\nk_given = '2*";
    text += &format!("{}'\n[forms]\n", material[0]);
    for (place, form) in forms.iter().enumerate() {
        // Of values only, of gradients only, symmetric and not.
        let product = match place % 3 {
            0 => "dot(u, v)",
            1 => "inner(eps(u), eps(v))",
            _ => "(dot(u, v) + inner(grad(u), grad(v)))",
        };
        text += &format!("{form} = '(k_given + {})*{product}'\n", sum(place));
    }
    text
}

/// An element of a name of its own, whose rules and modes belong to these forms.
fn element(path: &str, name: &str, form: &str, kind: &str) -> String {
    let text = text(path).replace("\"stiffness\"", &format!("\"{form}\""));
    text.lines()
        .map(|line| match line.split_once(" = ") {
            Some(("name", _)) => format!("name = \"{name}\"\n"),
            Some(("types", _)) => format!("types = [\"{kind}\"]\n"),
            // The common rule for all: those of single forms are named after shipped ones.
            _ => format!("{line}\n"),
        })
        .collect()
}

/// Tensors of every shape.
fn motion(name: &str, scalars: &[String], others: &[String]) -> String {
    let (vectors, matrices) = others.split_at(others.len() / 2);
    let mut text = head("motion", name);
    let sum = scalars.join(" + ");
    let mut energy = format!("1/2*theta_dot^2*({sum} + dot(eta, eta)) + 1/2*dot(eta_dot, eta_dot)");
    for vector in vectors {
        energy += &format!(" + theta_dot*dot({vector}, eta_dot)");
    }
    for matrix in matrices {
        energy += &format!(" + theta_dot*dot(eta, {matrix}*eta_dot)");
    }
    text += &format!("kinetic_energy = '{energy}'\n");
    text += "[coordinates]\ntheta = \"scalar\"\neta = \"vector\"\n[tensors]\n";
    let shapes = (scalars.iter().map(|name| (name, "scalar")))
        .chain(vectors.iter().map(|name| (name, "vector")))
        .chain(
            matrices
                .iter()
                .zip(["matrix", "symmetric", "skew"].iter().cycle())
                .map(|(name, shape)| (name, *shape)),
        );
    text.extend(shapes.map(|(name, shape)| format!("{name} = \"{shape}\"\n")));
    text
}

/// Names that the shipped clearance gives to its own things, and its kinds of laws.
const OWN_NAMES: usize = 25;
const KINDS: usize = 4;

/// The shipped clearance with other names for its coordinates, definitions, measures, forces and kinds of laws, but for the
/// quantities that laws know.
fn clearance(name: &str, words: &[String]) -> String {
    const OWN: [&str; OWN_NAMES] = [
        "psi", "c", "R", "eps_x", "eps_y", "delta", "tau", "b_x", "b_y", "beta", "u_x", "u_y", "s",
        "alpha", "phi", "D_x", "D_y", "b_z", "g_x", "g_y", "gamma", "s_z", "a_x", "a_y", "lambda",
    ];
    let kinds = &words[OWN.len()..];
    let other = |word: &str| match OWN.iter().position(|own| *own == word) {
        Some(place) => words[place].clone(),
        None => match (word.strip_suffix("_dot"), word) {
            (Some(rate), _) if OWN.contains(&rate) => {
                format!("{}_dot", words[OWN.iter().position(|own| *own == rate).expect("it is")])
            }
            (_, "spring_law") => kinds[0].clone(),
            (_, "ring_law") => kinds[1].clone(),
            (_, "joint_law") => kinds[2].clone(),
            (_, "gear_law") => kinds[3].clone(),
            _ => word.to_owned(),
        },
    };
    let text = text("specs/motion/clearance.toml")
        .replace("laws.spring", "laws.spring_law")
        .replace("laws.ring", "laws.ring_law")
        .replace("laws.joint", "laws.joint_law")
        .replace("laws.gear", "laws.gear_law");
    let plain = text.lines().filter(|line| {
        !["title", "source", "#", "kind", "name"].iter().any(|start| line.starts_with(start))
    });
    let mut out = head("clearance", name);
    for line in plain {
        let (key, value) = line.split_once(" = ").map_or((line, None), |(k, v)| (k, Some(v)));
        let mut word = String::new();
        // Units, and keys of tables, are no names of the spec.
        let fixed = ["unit", "value", "rate", "force", "inputs", "forces"].contains(&key);
        let mut write = |text: &str, rename: bool| {
            for c in text.chars().chain(['\n']) {
                if c.is_ascii_alphanumeric() || c == '_' {
                    word.push(c);
                    continue;
                }
                let taken = std::mem::take(&mut word);
                out.push_str(&if rename { other(&taken) } else { taken });
                if c != '\n' {
                    out.push(c);
                }
            }
        };
        write(key, !fixed);
        if let Some(value) = value {
            write(" = ", false);
            write(value, key != "unit" && key != "rate");
        }
        out.push('\n');
    }
    out
}

/// A film whose fields, numbers and definitions have these names, six at least.
fn film(name: &str, names: &[String]) -> String {
    let [p, r, h, u, nodal, defined, numbers @ ..] = names else { panic!("{} names", names.len()) };
    let mut text = head("film", name);
    text += "[cell]\naround = 2\nalong = 2\n";
    for (table, name, unit) in
        [("unknowns", p, "Pa"), ("unknowns", r, "1"), ("gap", h, "m"), ("speed", u, "m/s")]
    {
        text += &format!("[{table}.{name}]\nunit = \"{unit}\"\n");
    }
    for name in numbers {
        text += &format!("[parameters.{name}]\nvalue = 1\nunit = \"1\"\n");
    }
    let product = numbers.iter().map(|name| format!("(1 + {name})")).collect::<Vec<_>>().join("*");
    text += "[parameters.viscosity_given]\nvalue = 1\nunit = \"Pa*s\"\n";
    text += &format!("[nodal]\n{nodal} = '1 - {r}'\n");
    text += &format!("[definitions]\n{defined} = '{product}/viscosity_given'\n");
    text += &format!("[stored]\nvalue = '{nodal}*{h}'\n[residual]\n");
    let points = "points = [\"midpoint\", \"gauss(2)\"]";
    text += &format!("{p} = {{ value = '{h}^3*{defined}*ddx({p})*ddx(v)', {points} }}\n");
    text += &format!("{r} = {{ value = '-{u}*{h}*upstream({nodal}, {u})*ddx(v)', {points} }}\n");
    text += &format!("[forces]\n{p} = {{ on = \"h\", value = '{p}' }}\n");
    text += &format!("{h} = {{ on = \"s_mean\", value = '-{h}*ddx({p})' }}\n");
    text += &format!("[edges.{r}]\ngiven = [\"{p}\"]\ncomplementary = [\"out\", \"{r}\"]\n");
    text += &format!(
        "[outputs.{u}]\nunit = \"N\"\nterms.{u} = {{ value = '{p}', points = \"nodes\" }}\n"
    );
    text
}

#[test]
fn specs_of_hostile_names_compile() {
    let words = words();
    assert!(words.len() > 400, "{}", words.len());
    let workspace = Workspace::new("hostile", "\"specs\"", &[]);
    let name = |word: &String| word.clone();
    // Modules: laws can be called what formulas cannot.
    let rust: Vec<String> = WORDS.split_whitespace().map(str::to_owned).collect();
    for word in rust.iter().chain(&["_".to_owned(), "a.b".to_owned(), "forms".to_owned()]) {
        workspace.write(&format!("specs/laws/{word}.toml"), &law(word));
    }
    // Functions are named after forms: in small letters.
    let lower: Vec<&String> = (words.iter())
        .filter(|word| !word.chars().any(|c| c.is_ascii_uppercase()))
        .step_by(40)
        .take(9)
        .collect();
    let mut named: Vec<&String> = lower;
    let (fixed, gen_) = ("matrix".to_owned(), "gen".to_owned());
    named.extend(
        [&fixed, &gen_].into_iter().filter(|word| !named.contains(word)).collect::<Vec<_>>(),
    );
    let material: Vec<String> =
        words.iter().filter(|word| *word != "k_given").take(500).map(name).collect();
    workspace.write("specs/forms/self.toml", &forms("self", &named, &material));
    // The symmetric form of gradients has the modes.
    let condensed = named[1];
    for (place, (path, name)) in
        [("specs/elements/tet4.toml", "Self"), ("specs/elements/hex8i.toml", "gen")]
            .iter()
            .enumerate()
    {
        let mut text = element(path, name, condensed, &format!("X{place}"));
        if let Some(single) = text.find("# Their gradients are constant.") {
            let end = text[single..].find("[abaqus]").expect("a table") + single;
            text.replace_range(single..end, "");
        }
        workspace.write(&format!("specs/elements/{place}.toml"), &text);
    }
    // Names that films have a meaning for.
    let meant = ["v", "dx", "dz", "ddx", "ddz", "upstream", "viscosity_given"];
    let of_films: Vec<String> =
        words.iter().filter(|word| !meant.contains(&word.as_str())).map(name).collect();
    for (place, some) in of_films.chunks(60).filter(|some| some.len() > 6).enumerate() {
        workspace.write(
            &format!("specs/films/film-{place}.toml"),
            &film(&format!("self-{place}"), some),
        );
    }
    for (place, some) in words.chunks(120).enumerate() {
        let (scalars, others) = some.split_at(some.len() / 2);
        let path = format!("specs/motion/motion-{place}.toml");
        workspace.write(&path, &motion(&format!("self-{place}"), scalars, others));
    }
    // The names of rates and forces that laws take and give stay what they are.
    let kept = [
        "v_t", "omega", "F_x", "F_y", "F_z", "h", "theta", "e_x", "e_y", "e_z", "alpha_x",
        "alpha_y", "e_n", "Q", "T", "M_x", "M_y", "M_z", "F_n", "T_m", "s_mean",
    ];
    let mut free: Vec<String> = (words.iter())
        .filter(|word| !word.ends_with("_dot"))
        .filter(|word| !(word.starts_with('d') && word.contains("_d")))
        .filter(|word| !kept.contains(&word.as_str()))
        .map(name)
        .collect();
    // What kernels call their own things is short.
    free.sort_by_key(|word| word.len());
    for (place, some) in free.chunks_exact(OWN_NAMES + KINDS).take(14).enumerate() {
        let path = format!("specs/motion/clearance-{place}.toml");
        workspace.write(&path, &clearance(&format!("crate-{place}"), some));
    }
    workspace.cargo(&["check", "--package", "whirl-specs"]);
}
