//! Steps of a compiled expression, and their evaluation on a stack.

use lissom_mechanics::kinematics::Switch;

use super::breakpoints;
use super::jet::Function;
use super::number::{Number, Point};

/// Depth of the stack an expression may need.
pub(super) const STACK: usize = 32;
/// That of short expressions.
const SMALL_STACK: usize = 12;

/// A step of a compiled expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    Constant(f64),
    Variable,
    Argument(usize),
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Negate,
    Call(Function),
    Call2(Function),
    Call3(Function),
}

/// What steps leave, for a variable and arguments.
pub(super) fn run<N: Number>(steps: &[Step], variable: N, argument: impl Fn(usize) -> N) -> N {
    run_with(steps, variable, argument, |_, _| None)
}

/// Runs the steps with functions continued from known `sides` of their switches, in the order of the switches; none for all by
/// their arguments. Passes the switching functions to `visit`.
pub(super) fn run_continued<N: Point>(
    steps: &[Step],
    variable: N,
    argument: impl Fn(usize) -> N,
    sides: &[f64],
    mut visit: impl FnMut(Switch),
) -> N {
    let mut next = 0;
    run_with(steps, variable, &argument, |step, arguments| {
        let function = match step {
            Step::Power | Step::Call(Function::Sqrt) if is_root_of_negative(step, arguments) => {
                // Beyond a switch its base may be negative, as that of `max(0, x)^1.5` by round-off: the odd continuation.
                let [base, exponent, _] = arguments;
                let opposite = base.scaled(-1.0);
                let root = if *step == Step::Power {
                    opposite.to_the(exponent)
                } else {
                    opposite.of(Function::Sqrt)
                };
                return is_beyond(steps, variable, &argument, sides).then(|| root.scaled(-1.0));
            }
            Step::Call(function) | Step::Call2(function) | Step::Call3(function) => *function,
            _ => return None,
        };
        let first = next;
        next += breakpoints::switch_count(function);
        let own = sides.get(first..next).unwrap_or_default();
        breakpoints::switches(function, arguments.map(N::value), own, &mut visit);
        breakpoints::continued(function, own, arguments)
    })
}

/// Whether a step has no value by itself: a power of a negative number that is no whole one, or its square root.
fn is_root_of_negative<N: Point>(step: &Step, [base, exponent, _]: [N; 3]) -> bool {
    base.value() < 0.0 && (*step != Step::Power || exponent.value().fract() != 0.0)
}

/// Whether a switch is beyond its known side.
fn is_beyond<N: Point>(steps: &[Step], variable: N, argument: impl Fn(usize) -> N, sides: &[f64]) -> bool {
    let (mut next, mut found) = (0, false);
    run_with(steps, variable, argument, |step, arguments| {
        let (Step::Call(function) | Step::Call2(function) | Step::Call3(function)) = *step else {
            return None;
        };
        let first = next;
        next += breakpoints::switch_count(function);
        let own = sides.get(first..next).unwrap_or_default();
        let mut known = own.iter();
        breakpoints::switches(function, arguments.map(N::value), own, |switch| {
            found |= known.next().is_some_and(|side| side * switch.number < 0.0);
        });
        breakpoints::continued(function, own, arguments)
    });
    found
}

/// Runs the steps with functions and powers that are `replaced` by other values.
#[inline]
fn run_with<N: Number>(
    steps: &[Step],
    variable: N,
    argument: impl Fn(usize) -> N,
    replaced: impl FnMut(&Step, [N; 3]) -> Option<N>,
) -> N {
    // Each value takes a step to enter, and a step removes two at most: the stack of a short expression is small, and to clear a large
    // one would be as expensive as the steps.
    if steps.len() <= SMALL_STACK + SMALL_STACK / 2 {
        run_on(&mut [N::constant(0.0); SMALL_STACK], steps, variable, argument, replaced)
    } else {
        run_on(&mut [N::constant(0.0); STACK], steps, variable, argument, replaced)
    }
}

#[inline]
fn run_on<N: Number>(
    stack: &mut [N],
    steps: &[Step],
    variable: N,
    argument: impl Fn(usize) -> N,
    mut replaced: impl FnMut(&Step, [N; 3]) -> Option<N>,
) -> N {
    let mut top = 0;
    for step in steps {
        match *step {
            Step::Constant(value) => stack[top] = N::constant(value),
            Step::Variable => stack[top] = variable,
            Step::Argument(index) => stack[top] = argument(index),
            Step::Negate => stack[top - 1] = stack[top - 1].scaled(-1.0),
            Step::Call(function) => {
                let own = stack[top - 1];
                stack[top - 1] = replaced(step, [own; 3]).unwrap_or_else(|| own.of(function));
            }
            Step::Add => stack[top - 2] = stack[top - 2].plus(stack[top - 1]),
            Step::Subtract => stack[top - 2] = stack[top - 2].minus(stack[top - 1]),
            Step::Multiply => stack[top - 2] = stack[top - 2].times(stack[top - 1]),
            Step::Divide => stack[top - 2] = stack[top - 2].over(stack[top - 1]),
            Step::Power => {
                let (base, exponent) = (stack[top - 2], stack[top - 1]);
                stack[top - 2] =
                    replaced(step, [base, exponent, exponent]).unwrap_or_else(|| base.to_the(exponent));
            }
            Step::Call2(function) => {
                let (one, other) = (stack[top - 2], stack[top - 1]);
                stack[top - 2] =
                    replaced(step, [one, other, other]).unwrap_or_else(|| one.of_two(function, other));
            }
            Step::Call3(function) => {
                let [one, other, third] = [stack[top - 3], stack[top - 2], stack[top - 1]];
                stack[top - 3] = replaced(step, [one, other, third])
                    .unwrap_or_else(|| one.of_three(function, other, third));
            }
        }
        top = top + 1 - step.operands();
    }
    stack[0]
}

impl Step {
    /// Values it takes from the stack; it leaves one.
    pub(super) fn operands(self) -> usize {
        match self {
            Step::Constant(_) | Step::Variable | Step::Argument(_) => 0,
            Step::Negate | Step::Call(_) => 1,
            Step::Call3(_) => 3,
            _ => 2,
        }
    }
}
