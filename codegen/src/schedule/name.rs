//! Names of values: the spec's own where it gives one, else made from the names of the operands, else
//! from the output that the value serves.

use std::collections::{BTreeMap, BTreeSet};

use crate::operation::{Operand, Operation};

/// Longest name made from operands.
const LONGEST: usize = 22;

/// A name for every operation. `given`: names that the spec gives, the first for a value counts;
/// `inputs`: names that are taken.
pub(super) fn names(
    operations: &[Operation<Operand>],
    inputs: &[&str],
    given: &[(Operand, String)],
) -> Vec<String> {
    let mut naming = Naming {
        inputs,
        taken: inputs.iter().map(|name| name.to_string()).collect(),
        numbers: BTreeMap::new(),
        names: vec![String::new(); operations.len()],
        powers: BTreeMap::new(),
        atoms: vec![1; operations.len()],
    };
    for (operand, name) in given {
        if let Operand::Value(place) = operand
            && naming.names[*place].is_empty()
        {
            naming.names[*place] = naming.free(name);
        }
    }
    let owners = owners(operations, &naming.names);
    for (place, operation) in operations.iter().enumerate() {
        let own = naming.own(place, *operation);
        if naming.names[place].is_empty() {
            let name = own.unwrap_or_else(|| {
                // Such a name says little, so none is made from it.
                naming.atoms[place] = LONGEST;
                let owner = owners[place].map_or("value", |owner| &naming.names[owner]);
                format!("{owner}_part")
            });
            naming.names[place] = naming.free(&name);
        }
    }
    naming.names
}

/// The named value that each value serves: that of its last user, or the user itself if it has a name.
fn owners(operations: &[Operation<Operand>], names: &[String]) -> Vec<Option<usize>> {
    let mut owners: Vec<Option<usize>> = vec![None; operations.len()];
    for place in (0..operations.len()).rev() {
        let owner = if names[place].is_empty() { owners[place] } else { Some(place) };
        for operand in operations[place].operands() {
            if let Operand::Value(operand) = operand {
                owners[operand] = owner.or(owners[operand]);
            }
        }
    }
    owners
}

struct Naming<'a> {
    inputs: &'a [&'a str],
    taken: BTreeSet<String>,
    /// The next number to try behind a name.
    numbers: BTreeMap<String, usize>,
    names: Vec<String>,
    /// Base and exponent of values that are powers.
    powers: BTreeMap<usize, (Operand, u64)>,
    /// How many names a made name joins.
    atoms: Vec<usize>,
}

impl Naming<'_> {
    fn of(&self, operand: Operand) -> Option<&str> {
        match operand {
            Operand::Constant(_) => None,
            Operand::Input(place) => Some(self.inputs[place]),
            Operand::Value(place) => Some(&self.names[place]),
        }
    }

    fn power_of(&self, operand: Operand) -> (Operand, u64) {
        match operand {
            Operand::Value(place) => self.powers.get(&place).copied().unwrap_or((operand, 1)),
            _ => (operand, 1),
        }
    }

    /// The name that says what the operation does, if it is short enough.
    fn own(&mut self, place: usize, operation: Operation<Operand>) -> Option<String> {
        let name = match operation {
            Operation::Mul(a, b) => {
                let ((base, m), (other, n)) = (self.power_of(a), self.power_of(b));
                if base == other && !matches!(base, Operand::Constant(_)) {
                    self.powers.insert(place, (base, m + n));
                    format!("{}_{}", self.of(base)?, m + n)
                } else {
                    self.joined(place, a, b, "_")?
                }
            }
            Operation::Div(Operand::Constant(1.0), b) => format!("inverse_{}", self.of(b)?),
            Operation::Div(a, b) => self.joined(place, a, b, "_per_")?,
            Operation::Sqrt(a) => format!("sqrt_{}", self.of(a)?),
            Operation::Function(function, a) => format!("{}_{}", function.lane(), self.of(a)?),
            Operation::Compare(_, a, b) => match (self.of(a), self.of(b)) {
                (Some(a), Some(b)) => format!("{a}_below_{b}"),
                (Some(a), None) => format!("{a}_below"),
                (None, Some(b)) => format!("{b}_above"),
                (None, None) => return None,
            },
            Operation::Not(a) => format!("not_{}", self.of(a)?),
            Operation::Neg(a) => format!("minus_{}", self.of(a)?),
            _ => return None,
        };
        (name.len() <= LONGEST).then_some(name)
    }

    /// The names of both operands, if they join no more than three names.
    fn joined(&mut self, place: usize, a: Operand, b: Operand, by: &str) -> Option<String> {
        let atoms = |operand| match operand {
            Operand::Value(value) => self.atoms[value],
            _ => 1,
        };
        let count = atoms(a) + atoms(b);
        let name = format!("{}{by}{}", self.of(a)?, self.of(b)?);
        self.atoms[place] = count;
        (count <= 3).then_some(name)
    }

    /// The name, with a number behind it if it is taken.
    fn free(&mut self, name: &str) -> String {
        if self.taken.insert(name.to_string()) {
            return name.to_string();
        }
        let joint = if name.ends_with(|c: char| c.is_ascii_digit()) { "_" } else { "" };
        let number = self.numbers.entry(name.to_string()).or_insert(2);
        loop {
            let free = format!("{name}{joint}{number}");
            *number += 1;
            if self.taken.insert(free.clone()) {
                return free;
            }
        }
    }
}
