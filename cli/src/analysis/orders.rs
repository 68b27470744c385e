//! Orders of the speed that excite, and whose turns they are.

use whirl_solver::linear::LinearMachine;

use crate::case::Analysis;

/// How near an order is to the turns of a body that is meant by it.
const SAME: f64 = 1e-9;
/// Digits in which people read one.
const DIGITS: usize = 6;

/// Orders of the speed of a body, ascending.
pub(super) struct Orders {
    all: Vec<Order>,
}

/// One of them.
struct Order {
    order: f64,
    /// What turns once in it: whether that is the body itself, and names of the others.
    own: bool,
    others: Vec<String>,
}

impl Orders {
    /// Those that are asked for; if there are none, once a turn of every body that turns in proportion to body `of`, as their
    /// unbalances excite.
    pub(super) fn of(linear: &LinearMachine, (of, analysis): (usize, &Analysis)) -> Self {
        let turns: Vec<(usize, f64)> = linear
            .turns_in_one(of, &analysis.ratios)
            .into_iter()
            .enumerate()
            .filter_map(|(body, turns)| Some((body, turns?.abs())))
            .collect();
        let mut orders = match analysis.orders.as_slice() {
            [] => turns.iter().map(|own| own.1).chain([1.0]).collect(),
            asked => asked.to_vec(),
        };
        orders.sort_by(f64::total_cmp);
        orders.dedup_by(|a, b| (*a - *b).abs() <= SAME * *b);
        let of_order = |order: f64| {
            let once = || turns.iter().filter(move |own| (own.1 - order).abs() <= SAME * order);
            let name = |body: usize| linear.machine().bodies[body].name().to_owned();
            Order {
                order,
                own: (order - 1.0).abs() <= SAME,
                others: once().filter(|own| own.0 != of).map(|own| name(own.0)).collect(),
            }
        };
        Orders { all: orders.into_iter().map(of_order).collect() }
    }

    /// As multiples of the speed.
    pub(super) fn values(&self) -> Vec<f64> {
        self.all.iter().map(|own| own.order).collect()
    }

    /// In a few digits.
    pub(super) fn rounded(order: f64) -> f64 {
        whirl_text::rounded(order, DIGITS)
    }

    /// What a line in a figure is called: `2X`, or `1X of low` where that is another body's.
    pub(super) fn called(&self, order: f64) -> String {
        match self.find(order) {
            Some(own) if !own.own && !own.others.is_empty() => {
                format!("1X of {}", own.others.join(", "))
            }
            _ => format!("{}X", Self::rounded(order)),
        }
    }

    /// The bodies besides that of the speed that turn once in it.
    pub(super) fn others(&self, order: f64) -> &[String] {
        self.find(order).map_or(&[], |own| &own.others)
    }

    /// Lines for people about orders of other bodies.
    pub(super) fn told(&self) -> String {
        let others = self.all.iter().filter(|own| !own.own && !own.others.is_empty());
        let line = |own: &Order| {
            format!(
                "order {}: once a turn of {}\n",
                Self::rounded(own.order),
                own.others.join(", ")
            )
        };
        others.map(line).collect()
    }

    fn find(&self, order: f64) -> Option<&Order> {
        self.all.iter().find(|own| own.order == order)
    }
}
