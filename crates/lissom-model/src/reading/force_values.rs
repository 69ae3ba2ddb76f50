//! Forces over an elongation and its rate as they are written in a model file: a number, an expression, or a table.

use std::sync::Arc;

use lissom_mechanics::kinematics::Switch;
use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::registry::{Constant, Force, ForceFunction};
use lissom_mechanics::signals::SignalFunction;

use crate::expression::Formula;
use crate::format::suggest;
use crate::functions::table::Extrapolation;
use crate::parts::context::Context;
use crate::text::report::Problem;
use crate::text::{Node, Value};

/// An expression of two quantities.
#[derive(Debug)]
struct Expressed {
    formula: Formula,
    /// Which argument of the expression each of them is.
    places: [Option<usize>; 2],
    breakpoints: Vec<f64>,
}

impl Expressed {
    /// The arguments of the expression, of which the first [`count`](Self::count) are used.
    fn arguments<T: Copy>(&self, first: T, second: T) -> [T; 2] {
        // A place that no argument takes is not read.
        let mut arguments = [first; 2];
        for (place, value) in self.places.iter().zip([first, second]) {
            if let Some(place) = place {
                arguments[*place] = value;
            }
        }
        arguments
    }

    fn count(&self) -> usize {
        self.formula.arguments().len()
    }
}

impl ForceFunction for Expressed {
    fn evaluate(&self, first: f64, second: f64) -> [f64; 3] {
        self.continued(first, second, &[])
    }

    fn bounds(&self, first: Interval, second: Interval) -> Option<Interval> {
        self.formula.bounds([0.0; 2], &self.arguments(first, second)[..self.count()])
    }

    fn enclosure(&self, first: &Enclosure, second: &Enclosure) -> Option<Enclosure> {
        let time = Enclosure::of_constant([0.0; 2]);
        self.formula.enclosure(&time, &self.arguments(*first, *second)[..self.count()])
    }

    fn depends_on_second(&self) -> bool {
        self.places[1].is_some()
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.breakpoints.clone()
    }

    fn is_integrable(&self) -> bool {
        self.places[0].is_none_or(|first| self.formula.is_integrable(first))
    }

    fn switch_count(&self) -> usize {
        self.formula.switch_count()
    }

    fn switches(&self, first: f64, second: f64, sides: &[f64], visit: &mut dyn FnMut(Switch)) {
        self.formula.visit_switches(0.0, &self.arguments(first, second)[..self.count()], sides, visit);
    }

    fn continued(&self, first: f64, second: f64, sides: &[f64]) -> [f64; 3] {
        let arguments = self.arguments(first, second);
        let arguments = &arguments[..self.count()];
        let mut gradient = [0.0; 2];
        let value = self.formula.value(0.0, arguments, sides);
        self.formula.gradient(0.0, arguments, sides, &mut gradient[..arguments.len()]);
        let [by_first, by_second] = self.places.map(|place| place.map_or(0.0, |place| gradient[place]));
        [value, by_first, by_second]
    }
}

impl Context<'_> {
    /// A number, an expression of two named quantities, or a table over the first.
    pub(crate) fn force(&self, node: &Node, what: &str, names: &[&str; 2]) -> Option<Force> {
        match &node.value {
            Value::Number(_) => Some(Arc::new(Constant(self.number(node, what)?))),
            Value::Table(own) => {
                if let Some(period) = own.get("period") {
                    let message =
                        format!("{what} cannot have a `period`: the energy it stores would have a jump");
                    let help = "write an expression, such as \"0.2*sin(6*rotation)\"";
                    return self.fail(period.node.span, message, help);
                }
                Some(Arc::new(self.read_table(node, what, Extrapolation::Linear)?))
            }
            Value::Text(text) => {
                let formula = self.own_formula(node, what)?;
                let known = || names.iter().copied();
                let stranger = formula.arguments().iter().find(|name| !known().any(|own| own == name.text));
                if let Some(name) = stranger {
                    let place = self.sources.within(node.span, text, &name.range);
                    let problem = Problem::error(place, format!("{what} cannot name `{}`", name.text));
                    let help = suggest::help(&name.text, known()).unwrap_or_default();
                    self.report(
                        problem
                            .label("unknown here")
                            .help(format!("it may name `{}` and `{}`; {help}", names[0], names[1])),
                    );
                    return None;
                }
                if formula.depends_on_time() {
                    let message = format!("{what} cannot name the time `t`: it is the law of a spring");
                    return self.fail(node.span, message, "a force that changes in time is a load");
                }
                let place = |name: &str| formula.arguments().iter().position(|own| own.text == name);
                let places = names.map(place);
                let breakpoints = places[0].map_or_else(Vec::new, |first| formula.breakpoints_of(first));
                Some(Arc::new(Expressed { formula, places, breakpoints }))
            }
            Value::List(_) | Value::Flag(_) | Value::Date => self.wrong_type(
                node,
                what,
                &format!("a number, an expression of {} and {}, or {{ table = [[…]] }}", names[0], names[1]),
            ),
        }
    }

    /// Two ascending numbers, either of which may be infinite.
    pub(crate) fn range(&self, node: &Node, what: &str) -> Option<[f64; 2]> {
        let list = self.list(node, 2, what)?;
        let number = |entry: &Node| match entry.value {
            Value::Number(value) if value.is_infinite() => Some(value),
            _ => self.number(entry, what),
        };
        let (low, high) = (number(&list[0]), number(&list[1]));
        let (low, high) = (low?, high?);
        if low < high {
            return Some([low, high]);
        }
        self.fail(
            node.span,
            format!("{what} must ascend, but {low} is not below {high}"),
            "write [minimum, maximum]",
        )
    }
}
