//! Where an expression is not smooth: roots of straight lines under functions that have a kink or a jump.

use lissom_mechanics::kinematics::Switch;
use lissom_mechanics::kinematics::switch::level_of_side;

use super::jet::Function;
use super::noise;
use super::number::Point;
use super::program::{STACK, Step};

/// a + b x, or none for what is no straight line.
pub(crate) type Line = Option<(f64, f64)>;

/// What is known of steps of a stack machine over their variable before they are run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Course {
    /// The straight line that they are.
    pub(crate) line: Line,
    /// Values of the variable at which they have a kink or a jump, in ascending order.
    pub(crate) breakpoints: Vec<f64>,
    /// Whether the zeros of each switch, in the order of [`switches`], are among the breakpoints, and none are elsewhere.
    pub(crate) are_known: Vec<bool>,
}

/// The course of steps whose arguments are these lines, none for those that are not given.
pub(super) fn of(steps: &[Step], arguments: &[Line]) -> Course {
    let (mut breakpoints, mut are_known) = (Vec::new(), Vec::new());
    let mut stack: [Line; STACK] = [None; STACK];
    let mut top = 0;
    for step in steps {
        let first = top - step.operands().min(top);
        let operands = [0, 1, 2].map(|k| stack[(first + k).min(STACK - 1)]);
        if let Step::Call(function) | Step::Call2(function) | Step::Call3(function) = *step {
            // Levels have no end.
            let has_levels = level_argument(function, [0.0, 1.0]).is_some();
            let is_known = !has_levels && operands[..step.operands()].iter().all(Option::is_some);
            are_known.resize(are_known.len() + switch_count(function), is_known);
        }
        stack[first] = match *step {
            Step::Argument(index) => arguments.get(index).copied().flatten(),
            step => line(step, operands, &mut breakpoints),
        };
        top = first + 1;
    }
    breakpoints.sort_by(f64::total_cmp);
    breakpoints.dedup();
    Course { line: stack[0], breakpoints, are_known }
}

/// The number whose integer part is the level on which a function is smooth; none where it has no levels.
fn level_argument(function: Function, [one, other]: [f64; 2]) -> Option<f64> {
    match function {
        Function::Floor | Function::Ceil => Some(one),
        Function::Round => Some(one + 0.5),
        Function::Mod => Some(one / other.abs()),
        Function::Random | Function::Normal => Some(other + 0.5),
        _ => None,
    }
}

/// Passes the switching functions of a function, given its arguments and known sides, to `visit`.
pub(super) fn switches(
    function: Function,
    [one, other, third]: [f64; 3],
    sides: &[f64],
    mut visit: impl FnMut(Switch),
) {
    if let Some(argument) = level_argument(function, [one, other]) {
        return visit(Switch::of_level(argument, sides.first().copied().unwrap_or_default()));
    }
    let mut hand = |number: f64| visit(number.into());
    match function {
        Function::Abs | Function::Sign | Function::Step => hand(one),
        Function::Smoothstep => [one, one - 1.0].into_iter().for_each(&mut hand),
        Function::Min
        | Function::Max
        | Function::Less
        | Function::LessOrEqual
        | Function::Greater
        | Function::GreaterOrEqual => hand(one - other),
        Function::Clamp => [one - other, one - third].into_iter().for_each(&mut hand),
        _ => {}
    }
}

/// How many switching functions [`switches`] passes on.
pub(super) fn switch_count(function: Function) -> usize {
    let mut count = 0;
    switches(function, [0.0; 3], &[], |_| count += 1);
    count
}

/// A function continued from the sides of its switches that are given by their signs, whatever its arguments; none where
/// it is smooth enough, or a side is not known.
pub(super) fn continued<N: Point>(
    function: Function,
    sides: &[f64],
    [one, other, third]: [N; 3],
) -> Option<N> {
    if sides.is_empty() || sides.contains(&0.0) {
        return None;
    }
    let is_above = sides[0] > 0.0;
    let level = level_of_side(sides[0]);
    let truth = |holds: bool| N::constant(f64::from(u8::from(holds)));
    match function {
        Function::Floor | Function::Round => Some(N::constant(level)),
        Function::Ceil => Some(N::constant(level + 1.0)),
        Function::Mod => Some(one.plus(other.scaled(-level * other.value().signum()))),
        Function::Random => Some(N::constant(noise::uniform(one.value(), level))),
        Function::Normal => Some(N::constant(noise::normal(one.value(), level))),
        Function::Abs => Some(one.scaled(sides[0])),
        Function::Sign => Some(N::constant(sides[0])),
        Function::Step | Function::Greater | Function::GreaterOrEqual => Some(truth(is_above)),
        Function::Less | Function::LessOrEqual => Some(truth(!is_above)),
        Function::Min => Some(if is_above { other } else { one }),
        Function::Clamp if sides[1] > 0.0 => Some(third),
        Function::Max | Function::Clamp => Some(if is_above { one } else { other }),
        _ => None,
    }
}

/// The line a step leaves, and the kinks it makes.
fn line(step: Step, [one, other, third]: [Line; 3], found: &mut Vec<f64>) -> Line {
    let mut root = |line: (f64, f64), value: f64| {
        let root = (value - line.0) / line.1;
        if line.1 != 0.0 && root.is_finite() {
            found.push(root);
        }
    };
    match step {
        Step::Constant(value) => Some((value, 0.0)),
        Step::Variable => Some((0.0, 1.0)),
        Step::Negate => one.map(|(a, b)| (-a, -b)),
        Step::Add => one.zip(other).map(|((a, b), (c, d))| (a + c, b + d)),
        Step::Subtract => one.zip(other).map(|((a, b), (c, d))| (a - c, b - d)),
        Step::Multiply => match (one, other) {
            (Some((a, b)), Some((c, 0.0))) | (Some((c, 0.0)), Some((a, b))) => Some((a * c, b * c)),
            _ => None,
        },
        Step::Divide => match (one, other) {
            (Some((a, b)), Some((c, 0.0))) => Some((a / c, b / c)),
            _ => None,
        },
        Step::Call(function) => {
            if let Some(line) = one {
                match function {
                    Function::Abs | Function::Sign | Function::Step => root(line, 0.0),
                    Function::Smoothstep => [0.0, 1.0].map(|value| root(line, value)).into_iter().collect(),
                    _ => {}
                }
            }
            None
        }
        Step::Call3(Function::Clamp) => {
            for ((a, b), (c, d)) in [one.zip(other), one.zip(third)].into_iter().flatten() {
                root((a - c, b - d), 0.0);
            }
            None
        }
        Step::Call2(
            Function::Min
            | Function::Max
            | Function::Less
            | Function::LessOrEqual
            | Function::Greater
            | Function::GreaterOrEqual,
        ) => {
            if let Some(((a, b), (c, d))) = one.zip(other) {
                root((a - c, b - d), 0.0);
            }
            None
        }
        Step::Argument(_) | Step::Power | Step::Call2(_) | Step::Call3(_) => None,
    }
}
