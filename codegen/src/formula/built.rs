//! Functions that are built of others, alike in the graph and in bytecode.

use crate::operation::{Function, Operation, Relation};

/// What takes operations one after another.
pub(super) trait Takes {
    /// What operations work on.
    type Value: Copy;

    /// The value of an operation.
    fn take(&mut self, operation: Operation<Self::Value>) -> Self::Value;

    /// So many right angles.
    fn turn(&mut self, quarters: i64) -> Self::Value;

    /// The first of all; another where the first of its pair with the best so far is less than the second.
    fn best(
        &mut self,
        all: &[Self::Value],
        pair: fn(Self::Value, Self::Value) -> [Self::Value; 2],
    ) -> Self::Value {
        all[1..].iter().fold(all[0], |best, &other| {
            let [low, high] = pair(best, other);
            let better = self.take(Operation::Compare(Relation::Less, low, high));
            self.take(Operation::Select(better, other, best))
        })
    }

    /// The angle of (x, y) from the axis x: one arctangent of the smaller over the larger of the two, so that
    /// it divides by zero at the origin only.
    fn angle(&mut self, y: Self::Value, x: Self::Value) -> Self::Value {
        use Operation::{Compare, Select};
        use Relation::{Less, LessOrEqual};
        let [zero, back, up, down, behind] = [0, -2, 1, -1, 2].map(|quarters| self.turn(quarters));
        let [tall, wide] = [y, x].map(|side| self.take(Operation::Function(Function::Abs, side)));
        let flat = self.take(Compare(LessOrEqual, tall, wide));
        let minus = self.take(Operation::Sub(zero, x));
        let above = self.take(Select(flat, y, minus));
        let below = self.take(Select(flat, x, y));
        let ratio = self.take(Operation::Div(above, below));
        let angle = self.take(Operation::Function(Function::Atan, ratio));
        let right = self.take(Compare(Less, zero, x));
        let upper = self.take(Compare(Less, zero, y));
        let not_lower = self.take(Compare(LessOrEqual, zero, y));
        let left = self.take(Select(not_lower, behind, back));
        let beside = self.take(Select(right, zero, left));
        let over = self.take(Select(upper, up, down));
        let offset = self.take(Select(flat, beside, over));
        self.take(Operation::Add(offset, angle))
    }
}
