//! From a sweep file, or a case and what the command line varies, to a sweep.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, suggest};
use whirl_codegen::document::tree::{Place, Tree};
use whirl_codegen::document::{Document, Table};

use super::axis::{Along, Axis};
use super::definition::{Keep, Sweep};
use super::random::Random;
use super::schema::MOST_POINTS;
use super::vary::{self, Values, Varied};
use crate::case::{CaseText, FileStore};
use crate::errors::Failure;
use crate::values::level::{Level, as_toml, quoted};

/// What messages call the arguments of the command line.
const COMMAND_LINE: &str = "--vary";
const ANALYSE: &str = "--analyse";

impl Sweep {
    /// Reads a sweep file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place; whether the case has the keys and takes the values shows where its
    /// points are read ([`Sweep::case`]).
    pub fn of_file(path: &Path) -> Result<Self, Failure> {
        let source = FileStore::Disk.read(path).map_err(|message| {
            Diagnostics::from(Diagnostic::new(
                &Source::new(path, ""),
                Code::BAD_VALUE,
                None,
                message,
            ))
        })?;
        Self::of_text(&source)
    }

    /// As [`Sweep::of_file`], of a text.
    ///
    /// # Errors
    /// As [`Sweep::of_file`].
    pub fn of_text(source: &Arc<Source>) -> Result<Self, Failure> {
        let (tree, errors) = Tree::parse(source);
        errors.into_result(())?;
        let name = source.path.file_stem().map_or("sweep".into(), |stem| stem.to_string_lossy());
        let (sweep, errors) = assemble(source, tree, &name);
        Ok(errors.into_result(sweep)?.expect("without errors there is a sweep"))
    }
}

/// Whether the file called `name` is a sweep: one says what it varies.
pub(crate) fn is_sweep(name: &str) -> bool {
    let path = Path::new(name);
    path.is_file()
        && FileStore::Disk
            .read(path)
            .is_ok_and(|source| Tree::parse(&source).0.entries.contains_key("vary"))
}

/// The sweep of a case by what the command line says: what varies, each as `KEY=RANGE`, and names of analyses.
///
/// # Errors
/// As [`Sweep::of_file`].
pub(super) fn of_arguments(
    case: &str,
    varied: &[String],
    analyses: &[String],
) -> Result<Sweep, Failure> {
    let mut text = String::new();
    for own in varied {
        let Some((key, values)) = own.split_once('=') else {
            return Err(Failure::Argument {
                message: format!("`--vary {own}` has no `=`"),
                help: "write a key of the case and its values: `--vary \"springs.radial_clearance=20 um .. 60 um, 9\"`"
                    .to_owned(),
            });
        };
        text += &format!("{} = {}\n", key.trim(), listed(values.trim()));
    }
    let source = Source::new(COMMAND_LINE, text);
    let (tree, errors) = Tree::parse(&source);
    errors.into_result(())?;
    let mut errors = Diagnostics::new();
    let place = Place { source: source.clone(), span: 0..source.text.trim_end().len() };
    let content = whirl_codegen::document::tree::Content::Table(tree);
    let keys = vary::read(&whirl_codegen::document::tree::Node { place, content }, &mut errors);
    let keys = axes(keys, &Options::default(), &mut errors);
    let base = CaseText::find(case, None).map_err(|found| errors.append(found)).ok();
    let (keys, base) = errors.into_result((keys, base))?;
    let (keys, axes, along) = keys.expect("without errors there are axes");
    let base = base.expect("without errors there is a case");
    let stem = base.path().file_stem().map_or("case".into(), |stem| stem.to_string_lossy());
    let name = format!("{stem}-sweep");
    Ok(Sweep {
        name,
        title: String::new(),
        base,
        source,
        keys,
        axes,
        along,
        samples: None,
        keep: Keep::Nothing,
        marches: analyses.is_empty(),
        analyses: analyses.iter().map(|own| Located::alone(ANALYSE, own)).collect(),
    })
}

/// Values of a key on the command line as a file has them: `20 um, 30 um` is a list, `20 um .. 60 um, 9` a range.
fn listed(values: &str) -> String {
    if values.starts_with(['[', '"', '\'', '{']) || values.contains("..") || !values.contains(',') {
        return as_toml(values);
    }
    let each: Vec<String> = values.split(',').map(|own| as_toml(own.trim())).collect();
    format!("[{}]", each.join(", "))
}

/// That a file is no sweep, where the command line varies nothing.
///
/// # Errors
/// Always: what it is, and what to write.
pub(super) fn of_no_sweep(name: &str) -> Result<Sweep, Failure> {
    CaseText::find(name, None)?;
    Err(Failure::Argument {
        message: format!("`{name}` is a case, and nothing says what varies"),
        help: format!(
            "write a sweep file with `case = {}` and a table `[vary]`, or add `--vary \"springs.radial_clearance=20 um .. 60 um, 9\"`",
            quoted(name)
        ),
    })
}

/// What a sweep says beside the keys that vary.
#[derive(Default)]
struct Options {
    together: Vec<Vec<Located>>,
    samples: Option<(usize, Located)>,
    seed: Option<Located>,
    continued: Option<(&'static str, Located)>,
    along: Option<Located>,
    random: u64,
}

fn assemble(source: &Arc<Source>, tree: Tree, name: &str) -> (Option<Sweep>, Diagnostics) {
    let varied = tree.entries.get("vary").map(|(_, node)| node.clone());
    let document = Document::of_case(source, tree).called("sweep");
    let mut errors = Diagnostics::new();
    let (title, case, options, keep, (marches, analyses)) =
        document.root(Sweep::SHAPE).read(|file| {
            let title =
                file.optional_string("title").map_or(String::new(), |own| own.text().to_owned());
            file.has("vary");
            let keep = match file.optional_word("keep") {
                Some("histories") => Keep::Histories,
                _ => Keep::Nothing,
            };
            let options = options(file);
            let done = done(file, &options, keep);
            (title, file.optional_string("case"), options, keep, done)
        });
    let keys = varied.map(|node| vary::read(&node, &mut errors)).unwrap_or_default();
    let base = case.and_then(|case| {
        let beside = source.path.parent().map_or(case.text().into(), |own| own.join(case.text()));
        if is_sweep(&beside.to_string_lossy()) {
            let message = format!("`{}` is a sweep, not a case", case.text());
            let help = "name the case that it varies, and let all keys vary here";
            errors.push(case.error_here(Code::BAD_VALUE, message).help(help));
            return None;
        }
        let found = CaseText::find(case.text(), Some(source));
        found.map_err(|found| errors.append(at_name(&case, found))).ok()
    });
    let broken = !errors.is_empty();
    let mut all = document.into_errors();
    let keys = if broken || keys.is_empty() { None } else { axes(keys, &options, &mut errors) };
    all.append(errors);
    let samples = options.samples.map(|(samples, _)| samples);
    let sweep = keys.zip(base).map(|((keys, axes, along), base)| Sweep {
        name: name.to_owned(),
        title,
        base,
        source: source.clone(),
        keys,
        axes,
        along,
        samples,
        keep,
        marches,
        analyses,
    });
    (sweep, all)
}

fn options(file: &Table) -> Options {
    let seed = file.optional_count("seed");
    Options {
        together: file.lists_of_texts("together"),
        samples: file.optional_count("samples").map(|samples| (samples, file.written("samples"))),
        seed: seed.map(|_| file.written("seed")),
        random: seed.unwrap_or(0) as u64,
        continued: file.optional_word("continue").map(|word| (word, file.written("continue"))),
        along: file.optional_string("along"),
    }
}

/// Whether points are marched, and which analyses are done of them.
fn done(file: &Table, options: &Options, keep: Keep) -> (bool, Vec<Located>) {
    let analyses = file.texts("analyse");
    let march = file.optional_boolean("march");
    let marches = match file.gives("analyse") {
        true => march == Some(true),
        false => true,
    };
    let refuse = |place: &Located, message: &str, help: &str| {
        file.push(place.error_here(Code::BAD_VALUE, message).help(help));
    };
    if let (Some(false), false) = (march, file.gives("analyse")) {
        let help = "name analyses by `analyse`, or leave it out";
        refuse(&file.written("march"), "points are neither run nor analysed", help);
    }
    if let (Some((_, place)), false) = (&options.continued, marches) {
        let help = "leave out `continue`, or add `march = true`";
        refuse(place, "only runs can start as the one before ended", help);
    }
    if (keep, marches) == (Keep::Histories, false) {
        let help = "leave out `keep`, or add `march = true`";
        refuse(&file.written("keep"), "points that are only analysed have no histories", help);
    }
    for (place, own) in analyses.iter().enumerate() {
        if analyses[..place].iter().any(|other| other.text() == own.text()) {
            refuse(own, &format!("`{}` stands twice", own.text()), "leave it out");
        }
    }
    (marches, analyses)
}

/// That there is no such case, where the sweep names it.
fn at_name(case: &Located, found: Diagnostics) -> Diagnostics {
    let mut all = Diagnostics::new();
    for error in found {
        all.push(case.error_here(Code::BAD_VALUE, error.message).maybe_help(error.help));
    }
    all
}

/// The axes of a sweep: keys that vary in step are one, and so are all of a Latin hypercube. The last one varies fastest.
fn axes(
    mut keys: Vec<Varied>,
    options: &Options,
    errors: &mut Diagnostics,
) -> Option<(Vec<Varied>, Vec<Axis>, Option<Along>)> {
    let before = errors.iter().count();
    let axes = match &options.samples {
        Some((samples, _)) => hypercube(&mut keys, *samples, options, errors),
        None => grid(&keys, options, errors),
    };
    if errors.iter().count() > before {
        return None;
    }
    let passes = options.continued.as_ref().map_or(1, |(word, _)| Along::new(word).passes());
    let points =
        axes.iter().fold(passes as u128, |all, axis| all.saturating_mul(axis.count as u128));
    if points > MOST_POINTS as u128 {
        let counts: Vec<String> = axes.iter().map(|axis| axis.count.to_string()).collect();
        let product =
            if counts.len() > 1 { format!("{} = ", counts.join(" × ")) } else { String::new() };
        let message = format!("{product}{points} points: a sweep has at most {MOST_POINTS}");
        let first = axes.iter().max_by_key(|axis| axis.count).map_or(0, |axis| axis.keys[0]);
        let help = "write fewer values, or `samples = 1000` for a Latin hypercube over all keys";
        errors.push(keys[first].error(Code::LIMIT, message).help(help));
        return None;
    }
    let mut axes = axes;
    let along = along(&keys, &mut axes, options, errors);
    (errors.iter().count() == before).then_some((keys, axes, along))
}

fn grid(keys: &[Varied], options: &Options, errors: &mut Diagnostics) -> Vec<Axis> {
    let mut axes: Vec<Axis> = Vec::new();
    if let Some(seed) = &options.seed {
        let help = "add `samples = 200`, or leave out `seed`";
        errors.push(seed.error_here(Code::BAD_VALUE, "`seed` is of a Latin hypercube").help(help));
    }
    let groups = groups(keys, options, errors);
    for (place, key) in keys.iter().enumerate() {
        let group = groups.iter().find(|group| group.contains(&place));
        let range = if let Values::Ranged(range) = &key.values { Some(range) } else { None };
        if let Some(range) = range.filter(|range| range.count.is_none()) {
            let help = format!(
                "write `{} = \"{}\"` for nine values with both ends",
                key.name,
                range.with_count(9)
            );
            let message = format!("`{}` does not say how many values", key.name);
            errors.push(key.error(Code::BAD_VALUE, message).help(help));
        }
        if let (Some(range), None) = (range.filter(|range| range.falls()), group) {
            let help = format!(
                "write `{}`; keys that vary `together` may descend, and `continue = \"down\"` starts at the end",
                range.reversed()
            );
            let message = format!("the range of `{}` is descending", key.name);
            errors.push(key.error(Code::BAD_VALUE, message).help(help));
        }
        match group {
            Some(group) if group[0] == place => {
                let count = key.count().unwrap_or(0);
                for other in group.iter().map(|other| &keys[*other]) {
                    let own = other.count().unwrap_or(count);
                    if own != count && count > 0 {
                        let message = format!(
                            "`{}` has {own} values, and `{}`, which varies together with it, {count}",
                            other.name, key.name
                        );
                        let help = "write as many values for each of them";
                        errors.push(other.error(Code::BAD_VALUE, message).help(help));
                    }
                }
                axes.push(Axis::new(group.clone(), count));
            }
            Some(_) => {}
            None => axes.push(Axis::new(vec![place], key.count().unwrap_or(0))),
        }
    }
    if errors.is_empty() {
        axes.iter().for_each(|axis| twice(keys, axis, errors));
    }
    axes
}

/// Places of keys that vary in step, the first one first.
fn groups(keys: &[Varied], options: &Options, errors: &mut Diagnostics) -> Vec<Vec<usize>> {
    let names: Vec<&str> = keys.iter().map(|key| key.name.as_str()).collect();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for own in &options.together {
        let mut group = Vec::new();
        for name in own {
            match find(name, &names) {
                Ok(place)
                    if group.contains(&place) || groups.iter().any(|all| all.contains(&place)) =>
                {
                    let message = format!("`{}` is listed twice in `together`", name.text());
                    errors.push(name.error_here(Code::BAD_VALUE, message));
                }
                Ok(place) => group.push(place),
                Err(error) => errors.push(*error),
            }
        }
        group.sort_unstable();
        if group.len() > 1 {
            groups.push(group);
        }
    }
    groups
}

fn find(name: &Located, names: &[&str]) -> Result<usize, Box<Diagnostic>> {
    names.iter().position(|own| *own == name.text()).ok_or_else(|| {
        let message = format!("`{}` does not vary", name.text());
        let help = suggest(name.text(), names);
        Box::new(name.error_here(Code::BAD_VALUE, message).maybe_help(help))
    })
}

/// Notes values that stand twice: two points would be the same.
fn twice(keys: &[Varied], axis: &Axis, errors: &mut Diagnostics) {
    let listed = |key: &&Varied| matches!(key.values, Values::Listed(_));
    if !axis.keys.iter().map(|place| &keys[*place]).all(|key| listed(&key)) {
        return;
    }
    let mut seen: BTreeMap<Vec<String>, Vec<String>> = BTreeMap::new();
    for k in 0..axis.count {
        let levels: Vec<_> = axis.keys.iter().map(|place| keys[*place].level(k)).collect();
        let written = levels.iter().map(|own| own.literal.clone()).collect::<Vec<_>>();
        if let Some(first) = seen.insert(levels.iter().map(Level::value).collect(), written.clone())
        {
            let message = match first == written {
                true => format!("{} stands twice", levels[0].literal),
                false => format!("{} is {} once more", written.join(", "), first.join(", ")),
            };
            errors.push(levels[0].node.place.error(Code::BAD_VALUE, message).help("leave it out"));
        }
    }
}

fn hypercube(
    keys: &mut [Varied],
    samples: usize,
    options: &Options,
    errors: &mut Diagnostics,
) -> Vec<Axis> {
    let place = options.samples.as_ref().map(|(_, place)| place);
    let excluded = [
        options.together.first().and_then(|own| own.first()).map(|own| ("together", own)),
        options.continued.as_ref().map(|(_, own)| ("continue", own)),
    ];
    for (key, other) in excluded.into_iter().flatten() {
        let message = format!("`samples` and `{key}` exclude each other");
        let help = "every key of a Latin hypercube varies by itself: leave out one of them";
        errors.push(place.unwrap_or(other).error_here(Code::BAD_VALUE, message).help(help));
    }
    let mut random = Random::new(options.random);
    for key in &mut *keys {
        if let Values::Ranged(range) = &key.values {
            if range.count.is_some() {
                let message = format!("`{}` says how many values, and so does `samples`", key.name);
                errors.push(key.error(Code::BAD_VALUE, message).help("write both ends only"));
            }
            if range.falls() {
                let message = format!("the range of `{}` is descending", key.name);
                errors.push(
                    key.error(Code::BAD_VALUE, message)
                        .help(format!("write `{}`", range.reversed())),
                );
            }
        }
        key.sampled(&mut random, samples);
    }
    vec![Axis::new((0..keys.len()).collect(), samples)]
}

/// How points are continued, if they are: the axis goes to the end, so that what follows each other has numbers that do.
fn along(
    keys: &[Varied],
    axes: &mut Vec<Axis>,
    options: &Options,
    errors: &mut Diagnostics,
) -> Option<Along> {
    let Some((word, _)) = &options.continued else {
        if let Some(key) = &options.along {
            let help = "add `continue = \"up\"`, or leave out `along`";
            errors.push(
                key.error_here(Code::BAD_VALUE, "`along` says along what a sweep is continued")
                    .help(help),
            );
        }
        return None;
    };
    let names: Vec<&str> = keys.iter().map(|key| key.name.as_str()).collect();
    let key = match &options.along {
        Some(name) => find(name, &names).map_err(|error| errors.push(*error)).ok()?,
        None => axes.last()?.keys[0],
    };
    let place = axes.iter().position(|axis| axis.keys.contains(&key))?;
    let axis = axes.remove(place);
    let values: Option<Vec<f64>> =
        super::column::numbers(&keys[key], axis.count).map(|(_, values)| values);
    let rises = values.is_some_and(|all| all.windows(2).all(|pair| pair[0] < pair[1]));
    if !rises {
        let message =
            format!("the sweep continues along `{}`, whose values do not rise", keys[key].name);
        let help = "write numbers of one unit in rising order, or name another key by `along`";
        errors.push(keys[key].error(Code::BAD_VALUE, message).help(help));
    }
    let along = Along::new(word);
    axes.push(Axis { count: along.passes() * axis.count, ..axis });
    Some(along)
}
