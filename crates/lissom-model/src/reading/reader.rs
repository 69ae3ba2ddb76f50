//! Reads one table key by key against its description: unknown and missing keys are reported at once, and every
//! value is checked against the shape of its key.

use std::f64::consts::TAU;

use lissom_mechanics::registry::{
    DefaultValue, Function, Parameter, ParameterType, Parameters, Value as Held,
};
use lissom_motion::{Matrix3, Vector3};

use crate::expression::Formula;
use crate::format::keys::{Key, Shape};
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::function_values::Size;
use crate::text::ScopeId;
use crate::text::report::{Located, Problem, Span};
use crate::text::{Node, Table, Value};

/// One table being read.
pub(crate) struct Reader<'c, 'a> {
    pub(crate) context: &'c Context<'a>,
    table: &'c Table,
    /// The table in words, as in "beam `mast`".
    pub(crate) what: String,
    /// Name of the table in the text.
    pub(crate) name: Span,
    /// Where it was written.
    pub(crate) scope: ScopeId,
    keys: Vec<Key>,
}

/// The word that decides which keys a table has, if it is one of `known`; otherwise the error is noted.
pub(crate) fn tag<'n>(
    context: &Context<'_>,
    node: &'n Node,
    key: &str,
    (known, elsewhere): (&[&str], impl Fn(&str) -> Option<&'static str>),
    (what, name): (&str, Span),
) -> Option<Located<&'n str>> {
    let Value::Table(table) = &node.value else {
        return context.wrong_type(node, what, "a table");
    };
    let Some(value) = table.get(key).map(|entry| &entry.node) else {
        let problem = Problem::error(name, format!("{what} lacks `{key}`")).label("here");
        context.report(problem.help(format!("choose one of {}", suggest::list(known.iter().copied()))));
        return None;
    };
    let Value::Text(word) = &value.value else {
        return context.wrong_type(value, &format!("`{key}` of {what}"), "a text");
    };
    if known.contains(&word.as_str()) {
        return Some(Located::new(word.as_str(), value.span));
    }
    let problem = Problem::error(value.span, format!("{what} has an unknown {key} `{word}`"));
    let elsewhere = elsewhere(word).map(|table| format!("it is a kind of `[{table}]`"));
    context.report(problem.maybe_help(elsewhere.or_else(|| suggest::help(word, known.iter().copied()))));
    None
}

impl<'c, 'a> Reader<'c, 'a> {
    /// Opens a table whose keys are known, and reports which ones are unknown or missing.
    pub(crate) fn open(
        context: &'c Context<'a>,
        node: &'c Node,
        (what, name): (String, Span),
        keys: Vec<Key>,
    ) -> Option<Self> {
        let Value::Table(table) = &node.value else {
            return context.wrong_type(node, &what, "a table");
        };
        for (word, entry) in table {
            if !keys.iter().any(|known| known.name == word) {
                let help = suggest::help(word, keys.iter().map(|known| known.name));
                let problem = Problem::error(entry.key, format!("{what} has an unknown key `{word}`"));
                context.report(problem.label("unknown").maybe_help(help));
            }
        }
        for key in keys.iter().filter(|key| key.required && !table.contains_key(key.name)) {
            let problem = Problem::error(name, format!("{what} lacks `{}`", key.name)).label("here");
            let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
            context.report(problem.help(format!("add `{} = …`{unit}: {}", key.name, key.summary)));
        }
        Some(Self { context, table, what, name, scope: node.scope, keys })
    }

    /// The value of `key`, if given.
    pub(crate) fn node(&self, key: &str) -> Option<&'c Node> {
        debug_assert!(self.keys.iter().any(|known| known.name == key), "`{key}` is not described");
        self.table.get(key).map(|entry| &entry.node)
    }

    /// Whether `key` is given.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// The key in words, as in "`E` of material `steel`".
    pub(crate) fn words(&self, key: &str) -> String {
        format!("`{key}` of {}", self.what)
    }

    /// Shape of `key`; a key without description may be any number or text.
    fn shape(&self, key: &str) -> &Shape {
        self.keys.iter().find(|known| known.name == key).map_or(&Shape::Number, |known| &known.holds)
    }

    /// The default of a key.
    fn default(&self, key: &str) -> Option<DefaultValue> {
        self.keys.iter().find(|known| known.name == key)?.default
    }

    fn default_number(&self, key: &str) -> Option<Located<f64>> {
        let Some(DefaultValue::Number(number)) = self.default(key) else { return None };
        Some(Located::new(number, self.name))
    }

    /// A number in the range its key allows, or its default.
    pub(crate) fn number(&self, key: &str) -> Option<Located<f64>> {
        let Some(node) = self.node(key) else { return self.default_number(key) };
        let what = self.words(key);
        let value = self.context.number(node, &what)?;
        let wanted = match *self.shape(key) {
            Shape::Positive if value <= 0.0 => "greater than zero".to_owned(),
            Shape::NotNegative | Shape::Mass if value < 0.0 => "zero or greater".to_owned(),
            Shape::Between(least, most) if !(least..=most).contains(&value) => {
                format!("from {least} to {most}")
            }
            _ => {
                self.warn_of_unusual(key, value, node.span);
                return Some(Located::new(value, node.span));
            }
        };
        self.context.fail(
            node.span,
            format!("{what} must be {wanted}, not {value}"),
            format!("give a number {wanted}"),
        )
    }

    /// A whole number in the range its key allows, or its default.
    pub(crate) fn count(&self, key: &str) -> Option<Located<usize>> {
        let Some(node) = self.node(key) else {
            return self.default_number(key).map(|number| number.map(|number| number as usize));
        };
        let what = self.words(key);
        let value = self.context.number(node, &what)?;
        let (least, most) = match *self.shape(key) {
            Shape::Count(least, most) => (least, most),
            _ => (0, usize::MAX >> 12),
        };
        if value.fract() == 0.0 && value >= least as f64 && value <= most as f64 {
            return Some(Located::new(value as usize, node.span));
        }
        let wanted = format!("a whole number from {least} to {most}");
        self.context.fail(
            node.span,
            format!("{what} must be {wanted}, not {value}"),
            format!("give {wanted}"),
        )
    }

    /// A text.
    pub(crate) fn text(&self, key: &str) -> Option<Located<&'c str>> {
        let node = self.node(key)?;
        let Value::Text(text) = &node.value else {
            return self.context.wrong_type(node, &self.words(key), "a text");
        };
        Some(Located::new(text.as_ref(), node.span))
    }

    /// One of the words its key allows, or its default.
    pub(crate) fn choice(&self, key: &str) -> Option<Located<&'c str>> {
        if let (false, Some(DefaultValue::Word(word))) = (self.has(key), self.default(key)) {
            return Some(Located::new(word, self.name));
        }
        let text = self.text(key)?;
        let Shape::Choice(known) = self.shape(key) else { return Some(text) };
        if known.contains(&text.value) {
            return Some(text);
        }
        let message = format!("{} cannot be `{}`", self.words(key), text.value);
        let help = suggest::help(text.value, known.iter().copied());
        self.context.report(Problem::error(text.span, message).maybe_help(help));
        None
    }

    /// Some of the words its key allows, each at most once.
    pub(crate) fn choices(&self, key: &str) -> Option<Vec<String>> {
        let node = self.node(key)?;
        let (context, words) = (self.context, self.words(key));
        let Shape::Choices(known) = *self.shape(key) else { return None };
        let Value::List(list) = &node.value else {
            return context.wrong_type(node, &words, "a list of words");
        };
        let mut chosen: Vec<String> = Vec::new();
        for entry in list {
            let Value::Text(word) = &entry.value else {
                return context.wrong_type(entry, &format!("each entry of {words}"), "a word");
            };
            if !known.contains(&word.as_str()) {
                let help = suggest::help(word, known.iter().copied());
                let problem = Problem::error(entry.span, format!("{words} cannot contain `{word}`"));
                context.report(problem.maybe_help(help));
                return None;
            }
            if chosen.contains(word) {
                return context.fail(
                    entry.span,
                    format!("{words} contains `{word}` twice"),
                    "remove one of them",
                );
            }
            chosen.push(word.clone());
        }
        if chosen.is_empty() {
            return context.fail(
                node.span,
                format!("{words} is empty"),
                format!("name some of {}", known.join(", ")),
            );
        }
        Some(chosen)
    }

    /// The name of an entry of the table its key names.
    pub(crate) fn name_in(&self, key: &str) -> Option<Located<String>> {
        let text = self.text(key)?;
        let Shape::Name(table) = *self.shape(key) else { return Some(text.map(str::to_owned)) };
        let what = self.words(key);
        let name = self.context.entry_named(table, text.value, self.node(key)?, &what)?;
        let is_known = self.context.is_known(table, &name, text.span, &what);
        is_known.then(|| Located::new(name, text.span))
    }

    /// True or false, or the default.
    pub(crate) fn flag(&self, key: &str) -> Option<Located<bool>> {
        if let (false, Some(DefaultValue::Flag(flag))) = (self.has(key), self.default(key)) {
            return Some(Located::new(flag, self.name));
        }
        let node = self.node(key)?;
        let Value::Flag(flag) = &node.value else {
            return self.context.wrong_type(node, &self.words(key), "true or false");
        };
        Some(Located::new(*flag, node.span))
    }

    /// Three numbers. This is the only function that transforms vectors and directions from the axes of a part to global
    /// axes; the key's shape declares whether it does. A direction with a default is never missing.
    pub(crate) fn vector(&self, key: &str) -> Option<Located<Vector3>> {
        let shape = self.shape(key);
        let Some(node) = self.node(key) else {
            let Shape::DirectionOr(axis) = shape else {
                return self.default_number(key).map(|number| number.map(Vector3::repeat));
            };
            return Some(Located::new(self.context.turned(self.scope, &axis.direction())?, self.name));
        };
        let what = self.words(key);
        let own = match shape {
            Shape::Direction | Shape::DirectionOr(_) => self.context.own_direction(node, &what)?,
            _ => self.context.vector(node, &what)?,
        };
        let in_global_axes = match shape {
            Shape::GlobalVector | Shape::Direction | Shape::DirectionOr(_) => {
                self.context.turned(node.scope, &own)?
            }
            _ => own,
        };
        Some(Located::new(in_global_axes, node.span))
    }

    /// The inertia matrix of a body of this mass.
    pub(crate) fn inertia(&self, key: &str, mass: f64) -> Option<Located<Matrix3>> {
        let node = self.node(key)?;
        Some(Located::new(self.context.inertia(node, &self.words(key), mass)?, node.span))
    }

    /// A function of time.
    pub(crate) fn function(&self, key: &str) -> Option<Located<Function>> {
        let node = self.node(key)?;
        Some(Located::new(self.context.function(node, &self.words(key))?, node.span))
    }

    /// An expression of time and of named quantities.
    pub(crate) fn formula(&self, key: &str) -> Option<Located<Formula>> {
        let node = self.node(key)?;
        let formula = self.context.formula(node, &self.words(key))?;
        let number = formula.arguments().is_empty().then(|| formula.with_arguments(&[]).constant()).flatten();
        if let Some(number) = number {
            self.warn_of_unusual(key, number, node.span);
        }
        Some(Located::new(formula, node.span))
    }

    /// The size of a load.
    fn size(&self, key: &str) -> Option<Size> {
        let node = self.node(key)?;
        self.context.size(node, &self.words(key))
    }

    /// A function of a variable.
    fn function_of(&self, key: &str, variable: &'static str) -> Option<Function> {
        self.context.function_of(self.node(key)?, variable, &self.words(key))
    }

    /// An equation, or the size of a load that is more than a function of time, and its key.
    pub(crate) fn signal(&self, table: &[Parameter]) -> Option<(&'static str, Located<Formula>)> {
        if let Some(parameter) = table.iter().find(|parameter| parameter.holds == ParameterType::Equation) {
            return Some((parameter.name, self.formula(parameter.name)?));
        }
        let parameter = table.iter().find(|parameter| parameter.holds == ParameterType::Size)?;
        let node = self.node(parameter.name)?;
        match self.context.size_unreported(node)? {
            Size::Signal(formula) => Some((parameter.name, Located::new(formula, node.span))),
            Size::OfTime(_) => None,
        }
    }

    /// Warns of a number that is likely to be in another unit.
    pub(crate) fn warn_of_unusual(&self, key: &str, number: f64, span: Span) {
        let known = self.keys.iter().find(|known| known.name == key);
        let Some((usual, unit)) = known.and_then(|known| Some((known.usual?, known.unit))) else { return };
        if !usual.excludes(number) {
            return;
        }
        let [least, most] = usual.range;
        let [low, high] = [least, most].map(|size| DefaultValue::Number(size).to_string());
        let range = if least == 0.0 { format!("at most {high}") } else { format!("{low} to {high}") };
        let message = format!("{} is {number} {unit}, usual is {range}", self.words(key));
        let help = format!("convert it if it is {}; otherwise this is no mistake", usual.instead);
        self.context.report(Problem::warning(span, message.replace(" ,", ",")).label("unusual").help(help));
    }

    /// Warns of an angle [rad] that seems to be in degrees.
    pub(crate) fn warn_of_degrees(&self, key: &str, angle: f64) {
        let Some(node) = self.node(key) else { return };
        let message = format!("{} is {:.1} revolutions", self.words(key), angle.abs() / TAU);
        let help = "angles are in radians: write \"pi/2\" for 90 degrees";
        self.context.report(Problem::warning(node.span, message).help(help));
    }

    /// The registered parameters that are given, and the directions that have a default.
    pub(crate) fn parameters(&self, table: &'static [Parameter]) -> (Parameters, Vec<(String, Span)>) {
        let mut parameters = Parameters::new().declared(table);
        let mut places = Vec::new();
        let has_default = |holds: &ParameterType| matches!(holds, ParameterType::DirectionOr(_));
        for Parameter { name, holds, unit, .. } in table {
            if !self.has(name) && !has_default(holds) {
                continue;
            }
            let value = match holds {
                ParameterType::Number
                | ParameterType::Positive
                | ParameterType::NotNegative
                | ParameterType::Between(..) => self.number(name).map(|number| Held::Number(number.value)),
                ParameterType::Vector
                | ParameterType::GlobalVector
                | ParameterType::Direction
                | ParameterType::DirectionOr(_) => self.vector(name).map(|vector| Held::Vector(vector.value)),
                ParameterType::Flag => self.flag(name).map(|flag| Held::Flag(flag.value)),
                ParameterType::Function => self.function(name).map(|function| Held::Function(function.value)),
                ParameterType::Size => self.size(name).map(|size| match size {
                    Size::OfTime(function) => Held::Function(function),
                    // The load of size one is multiplied.
                    Size::Signal(_) => Held::Number(1.0),
                }),
                ParameterType::FunctionOf(variable) => self.function_of(name, variable).map(Held::Function),
                // Resolved later, with the whole model.
                ParameterType::Equation => None,
                ParameterType::Numbers => {
                    let read = |node| self.context.number_list(node, &self.words(name)).map(Held::Numbers);
                    self.node(name).and_then(read)
                }
                ParameterType::SquareMatrix => {
                    let read =
                        |node| self.context.square_matrix(node, &self.words(name)).map(Held::SquareMatrix);
                    self.node(name).and_then(read)
                }
                ParameterType::Input => self.name_in(name).map(|name| Held::Text(name.value)),
                ParameterType::Choices(_) => self.choices(name).map(Held::Words),
                ParameterType::Force(names) => self
                    .node(name)
                    .and_then(|node| self.context.force(node, &self.words(name), names).map(Held::Force)),
                ParameterType::HeightField => self
                    .node(name)
                    .and_then(|node| self.context.height_field(node, &self.words(name)).map(Held::Force)),
                ParameterType::Coefficients => self.node(name).and_then(|node| {
                    self.context.coefficients(node, &self.words(name)).map(Held::Coefficients)
                }),
                ParameterType::Matrix => self.node(name).and_then(|node| {
                    self.context
                        .semidefinite_matrix(node, &self.words(name))
                        .map(|matrix| Held::Matrix(Box::new(matrix)))
                }),
                ParameterType::Range => self
                    .node(name)
                    .and_then(|node| self.context.range(node, &self.words(name)).map(Held::Range)),
                ParameterType::Choice(_) => self.choice(name).map(|word| Held::Text(word.value.to_owned())),
            };
            if let Some(value) = value {
                if *unit == "rad"
                    && let Some(angle) = angle_in_degrees(&value)
                {
                    self.warn_of_degrees(name, angle);
                }
                parameters.insert(name, value);
                places.extend(self.node(name).map(|node| ((*name).to_owned(), node.span)));
            }
        }
        (parameters, places)
    }
}

/// An angle [rad] of a parameter that is probably in degrees: a whole number and more than one revolution.
fn angle_in_degrees(value: &Held) -> Option<f64> {
    let angles = match value {
        Held::Number(angle) => &[*angle][..],
        Held::Range(ends) => ends,
        _ => return None,
    };
    let is_suspect = |angle: &&f64| angle.is_finite() && angle.abs() > TAU && angle.fract() == 0.0;
    angles.iter().find(is_suspect).copied()
}
