//! Relations between coordinates of joints: gears, cams and equations.

use std::sync::Arc;

use lissom_mechanics::joints::Constraint as _;
use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::registry::{Parameters, Value};
use lissom_mechanics::relation::{MAX_COUPLED, Relation, RelationPoint};
use lissom_mechanics::signals::SignalFunction as _;
use lissom_mechanics::signals::coordinate::Of;
use lissom_system::{Builder, State, System};

use super::names::Names;
use super::signals::relative_components;
use crate::document::{Component, Document};
use crate::expression::{Formula, Kink, Name};
use crate::format::suggest;
use crate::text::report::{Located, Problem};

/// Value of an equation at the start that is round-off of given numbers [m, rad].
const SAME_PLACE: f64 = 1e-6;

/// An expression of coordinates: each argument is one of them.
#[derive(Debug)]
struct Equation {
    formula: Formula,
    /// Which coordinate each argument is.
    arguments: Vec<usize>,
}

impl Relation for Equation {
    fn depends_on_time(&self) -> bool {
        self.formula.depends_on_time()
    }

    fn jet(&self, (time, values): RelationPoint<'_>, (of_time, direction): RelationPoint<'_>) -> [f64; 3] {
        self.formula.jet((time, of_time), |argument| {
            let coordinate = self.arguments[argument];
            (values[coordinate], direction[coordinate])
        })
    }

    fn bounds(&self, time: Interval, coordinates: &[Interval]) -> Option<Interval> {
        if self.formula.is_polynomial() {
            return None;
        }
        let mut arguments = [[0.0; 2]; MAX_COUPLED];
        for (argument, &coordinate) in arguments.iter_mut().zip(&self.arguments) {
            *argument = coordinates[coordinate];
        }
        self.formula.bounds(time, &arguments[..self.arguments.len()])
    }

    fn enclosure(&self, time: &Enclosure, coordinates: &[Enclosure]) -> Option<Enclosure> {
        let mut arguments = [Enclosure::of_constant([0.0; 2]); MAX_COUPLED];
        for (argument, &coordinate) in arguments.iter_mut().zip(&self.arguments) {
            *argument = coordinates[coordinate];
        }
        self.formula.enclosure(time, &arguments[..self.arguments.len()])
    }
}

/// The coordinates that the expression of a component names, and its parameters with the relation between them; none if it
/// names no coordinates.
pub(super) fn equation(
    document: &Document,
    component: &Component,
    builder: &Builder,
    names: &Names,
) -> Result<Option<(Vec<CoordinateId>, Parameters)>, Problem> {
    let (true, Some((key, formula))) = (component.ports.name_coordinates(), &component.signal) else {
        return Ok(None);
    };
    let name = &component.name.value;
    let (mut coordinates, mut arguments) = (Vec::new(), Vec::new());
    for argument in formula.value.arguments() {
        let coordinate = named(document, (component, formula), argument, builder, names)?;
        let known = coordinates.iter().position(|&known| known == coordinate);
        arguments.push(known.unwrap_or(coordinates.len()));
        if known.is_none() {
            coordinates.push(coordinate);
        }
    }
    if let Some(kink) = formula.value.first_kink() {
        return Err(kinked(name, formula, &kink));
    }
    if coordinates.is_empty() || coordinates.len() > MAX_COUPLED {
        let message = format!("equation `{name}` names {} coordinates of joints", coordinates.len());
        return Err(Problem::error(component.span_of(key), message)
            .help(format!("name at least one and at most {MAX_COUPLED}, such as `arm.angle`")));
    }
    let relation: Arc<dyn Relation> = Arc::new(Equation { formula: formula.value.clone(), arguments });
    let parameters = component.parameters.clone().with(key, Value::Relation(relation));
    Ok(Some((coordinates, parameters)))
}

/// An equation that is not smooth: velocities would jump without an impact, and energy would vanish.
fn kinked(name: &str, formula: &Located<Formula>, kink: &Kink) -> Problem {
    let names = formula.value.arguments().iter().map(|argument| argument.text.as_str());
    let mut values: Vec<String> =
        names.zip(&kink.arguments).map(|(name, value)| format!("{name} = {value:.6}")).collect();
    if formula.value.depends_on_time() {
        values.push(format!("t = {:.6}", kink.variable));
    }
    let at = if kink.variable.is_nan() {
        String::new()
    } else {
        format!(", for example at {}", values.join(", "))
    };
    Problem::error(formula.span, format!("the relation `{name}` has a kink{at}"))
        .label("velocities would jump")
        .help("use a smooth function, such as `smoothstep` or a cam with a spline table; for stops and one-sided contact, springs")
}

/// The coordinate that an expression names.
fn named(
    document: &Document,
    (component, expression): (&Component, &Located<Formula>),
    name: &Name,
    builder: &Builder,
    names: &Names,
) -> Result<CoordinateId, Problem> {
    let problem = |message: String| {
        let place = document.within(expression.span, expression.value.text(), &name.range);
        Problem::error(place, format!("equation `{}` cannot be read: {message}", component.name.value))
            .label("here")
    };
    let Some((owner, word)) = name.text.rsplit_once('.') else {
        let known = document.parameters.keys().map(String::as_str).chain(["t", "pi"]);
        let help = match suggest::help(&name.text, known) {
            Some(help) => help,
            None => "name coordinates of joints, such as `arm.angle` or `slide.displacement`".to_owned(),
        };
        return Err(problem(format!("unknown name `{}`", name.text)).help(help));
    };
    let Some(coordinates) = names.coordinates.get(owner) else {
        let known = names.coordinates.keys().map(String::as_str);
        let message = format!("there is no joint `{owner}` that has coordinates");
        return Err(problem(message).maybe_help(suggest::help(owner, known)));
    };
    let components = relative_components(coordinates, builder);
    match components.iter().find(|(known, ..)| known == word) {
        Some((_, coordinate, Of::Value)) => Ok(*coordinate),
        Some(_) => Err(problem(format!("`{}` is a rate, and equations relate positions", name.text))
            .help("for forces that depend on rates use a damper, or a load with an expression")),
        None => {
            let known = components.iter().map(|(known, ..)| known.as_str());
            let message = format!("`{owner}` has no coordinate `{word}`");
            Err(problem(message).maybe_help(suggest::help(word, known)))
        }
    }
}

/// Rejects relations that are not satisfied at the start.
pub(super) fn check(document: &Document, system: &System, state: &State, problems: &mut Vec<Problem>) {
    for coupling in system.couplings() {
        let Some(component) = document.joints.iter().find(|joint| joint.name.value == coupling.name) else {
            continue;
        };
        let mut violation = [0.0];
        coupling.violation(&state.kinematics, &mut violation);
        let [violation] = violation;
        // A value that is not a number is rejected too.
        if violation.abs() <= SAME_PLACE {
            continue;
        }
        let layout = system.layout();
        let values = coupling.coordinates.iter().map(|&coordinate| {
            let unit = if layout.coordinate_quantity(coordinate) == Quantity::Angle { "rad" } else { "m" };
            let name = layout.name_of(layout.row_of_coordinate(coordinate));
            format!("{name} = {} {unit}", state.kinematics.coordinates[coordinate].value)
        });
        let values: Vec<String> = values.collect();
        let key = if component.signal.is_some() { "equation" } else { "profile" };
        let message = format!(
            "`{}` does not hold at the start: it misses by {}, with {}",
            coupling.name,
            lissom_mechanics::number::Written(violation),
            values.join(", ")
        );
        let help =
            "place the parts and give the joints' values at the start so that they agree, or add a constant";
        problems
            .push(Problem::error(component.span_of(key), message).label("not zero at the start").help(help));
    }
}
