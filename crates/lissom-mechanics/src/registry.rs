//! Description of a kind of joint or force element: its name, one sentence, a sample, and its parameters. Parser,
//! manual, schema and conformance tests read these tables; this module is independent of mechanics and files.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use lissom_motion::{Matrix6, Vector3};
use nalgebra::DMatrix;

use crate::kinematics::{DiscreteValueId, Switch};
use crate::law::{Enclosure, Interval};
use crate::relation::Relation;

/// A function of time with exact first and second derivatives.
pub trait TimeFunction: Send + Sync + fmt::Debug {
    /// Value at `time` [s].
    fn value(&self, time: f64) -> f64;
    /// First derivative with respect to time at `time` [s].
    fn first_derivative(&self, time: f64) -> f64;
    /// Second derivative with respect to time at `time` [s].
    fn second_derivative(&self, time: f64) -> f64;
    /// Value, first and second derivative at `time` [s].
    fn jet(&self, time: f64) -> [f64; 3] {
        [self.value(time), self.first_derivative(time), self.second_derivative(time)]
    }
    /// Known breakpoints [s], in ascending order. Default: none.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }
    /// An argument at which value or slope jump, if one is known; NaN if only their existence is known. Default: the first
    /// of the [`breakpoints`](Self::breakpoints).
    fn first_kink(&self) -> Option<f64> {
        self.breakpoints().first().copied()
    }
    /// Arguments for which it was specified, if values beyond were not chosen. Default: all.
    fn domain(&self) -> Option<Interval> {
        None
    }
    /// Bounds of the value between two times [s]. Default: none are known.
    fn bounds(&self, _from: f64, _to: f64) -> Option<Interval> {
        None
    }
    /// Bounds of the second derivative between two times [s]; every number where there may be a kink or a jump. Default: none are
    /// known.
    fn curvature(&self, _from: f64, _to: f64) -> Option<Interval> {
        None
    }
    /// Whether the value is constant. Default: it is not.
    fn is_constant(&self) -> bool {
        false
    }
}

/// A shared function of time.
pub type Function = Arc<dyn TimeFunction>;

/// A constant function of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant(pub f64);

impl TimeFunction for Constant {
    fn value(&self, _: f64) -> f64 {
        self.0
    }
    fn first_derivative(&self, _: f64) -> f64 {
        0.0
    }
    fn second_derivative(&self, _: f64) -> f64 {
        0.0
    }
    fn is_constant(&self) -> bool {
        true
    }
}

/// A force, or moment, over two quantities such as an elongation and its rate, with exact derivatives.
pub trait ForceFunction: Send + Sync + fmt::Debug {
    /// The force and its derivatives with respect to the first and the second quantity.
    fn evaluate(&self, first: f64, second: f64) -> [f64; 3];
    /// Bounds of the force over intervals of both quantities. Default: none are known.
    fn bounds(&self, _first: Interval, _second: Interval) -> Option<Interval> {
        None
    }
    /// Bounds of the force and of its derivatives along a path, given those of both quantities. Default: none are known.
    fn enclosure(&self, _first: &Enclosure, _second: &Enclosure) -> Option<Enclosure> {
        None
    }
    /// Whether it depends on the second quantity. Default: it does not.
    fn depends_on_second(&self) -> bool {
        false
    }
    /// Known breakpoints in the first quantity, in ascending order. Default: none.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }
    /// Whether few values between breakpoints determine its integral over the first quantity: not if it oscillates, or jumps at
    /// other positions. Default: they do.
    fn is_integrable(&self) -> bool {
        true
    }
    /// Number of its switching functions, which change sign where it has a kink or a jump. Adaptive steps end there.
    /// Default: none.
    fn switch_count(&self) -> usize {
        0
    }
    /// Passes its switching functions to `visit`, in their order.
    fn switches(&self, _first: f64, _second: f64, _sides: &[f64], _visit: &mut dyn FnMut(Switch)) {}
    /// Evaluates the function as [`evaluate`](Self::evaluate), continued smoothly from the given sides of its switching functions: 1 above
    /// zero, -1 below, 0 if the function itself decides. `sides` is empty if no side is known.
    fn continued(&self, first: f64, second: f64, _sides: &[f64]) -> [f64; 3] {
        self.evaluate(first, second)
    }
}

/// A shared force.
pub type Force = Arc<dyn ForceFunction>;

impl ForceFunction for Constant {
    fn evaluate(&self, _: f64, _: f64) -> [f64; 3] {
        [self.0, 0.0, 0.0]
    }
    fn bounds(&self, _: Interval, _: Interval) -> Option<Interval> {
        Some([self.0; 2])
    }
    fn enclosure(&self, _: &Enclosure, _: &Enclosure) -> Option<Enclosure> {
        Some(Enclosure::of_constant([self.0; 2]))
    }
}

/// An axis of the model: the default of a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelAxis {
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}

impl ModelAxis {
    /// Unit vector along the axis.
    pub fn direction(self) -> Vector3 {
        match self {
            Self::X => Vector3::x(),
            Self::Y => Vector3::y(),
            Self::Z => Vector3::z(),
        }
    }
}

/// Type of a parameter. For three numbers it also declares the axes in which they are expressed: the decoder of model files
/// transforms those in model axes to the axes of the part in which they are written, once, and kinds receive global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterType {
    /// A finite number.
    Number,
    /// A finite number that must be greater than zero.
    Positive,
    /// A finite number that must not be negative.
    NotNegative,
    /// A number from the first to the second, both included.
    Between(f64, f64),
    /// Three finite numbers that are not expressed in model axes: no spatial vector, or one in axes of a body. They are
    /// not transformed.
    Vector,
    /// Three finite numbers: a spatial vector in model axes at the start. It is transformed with the part.
    GlobalVector,
    /// Three finite numbers, not all zero, of which only the direction counts. In model axes, and transformed with the part.
    Direction,
    /// Direction with a default: this axis of the part in which the entry is written. Always given to the kind.
    DirectionOr(ModelAxis),
    /// True or false.
    Flag,
    /// A number or an expression in the time `t`.
    Function,
    /// The size of a load, a factor of all its forces: a number or an expression in the time `t`, inputs, signals,
    /// states and outputs. A load receives functions of time only: if the expression contains more, it multiplies the
    /// unit load.
    Size,
    /// A force over the two named quantities: a number, an expression of them, or a table over the first.
    Force(&'static [&'static str; 2]),
    /// Two ascending numbers, which may be infinite.
    Range,
    /// A number, an expression of one variable of this name, or a table of it.
    FunctionOf(&'static str),
    /// An expression of coordinates of joints and of the time `t`.
    Equation,
    /// The name of an input.
    Input,
    /// Six numbers not less than zero, the diagonal of a matrix, or a symmetric 6 x 6 matrix without negative
    /// eigenvalues.
    Matrix,
    /// Finite numbers, at least one.
    Numbers,
    /// A number, a list of numbers for a diagonal, or a square matrix by rows, of any size.
    SquareMatrix,
    /// One of the listed words.
    Choice(&'static [&'static str]),
    /// Some of the listed words, each at most once.
    Choices(&'static [&'static str]),
    /// Numbers by name, from a tyre property file.
    Coefficients,
    /// A height over x and y: an expression of both, a table over x, a grid, a random profile, or a list of these, which are added.
    HeightField,
}

impl ParameterType {
    /// Whether the value is expressed in model axes, and so transformed with the part in which it is written.
    pub fn is_in_model_axes(self) -> bool {
        match self {
            Self::GlobalVector | Self::Direction | Self::DirectionOr(_) => true,
            // Matrices of kinds are expressed in axes of their own, which are given by directions.
            Self::Vector
            | Self::Matrix
            | Self::Number
            | Self::Positive
            | Self::NotNegative
            | Self::Between(..)
            | Self::Flag
            | Self::Function
            | Self::Size
            | Self::Force(_)
            | Self::Range
            | Self::FunctionOf(_)
            | Self::Equation
            | Self::Input
            | Self::Numbers
            | Self::SquareMatrix
            | Self::Choice(_)
            | Self::Choices(_)
            | Self::Coefficients
            | Self::HeightField => false,
        }
    }
}

/// What an omitted value is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// This number, in SI units.
    Number(f64),
    /// True or false.
    Flag(bool),
    /// One of the words of a choice.
    Word(&'static str),
}

impl fmt::Display for DefaultValue {
    /// As in a model file.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) if *number != 0.0 && !(1e-2..1e6).contains(&number.abs()) => {
                write!(out, "{number:e}")
            }
            Self::Number(number) => write!(out, "{number}"),
            Self::Flag(flag) => write!(out, "`{flag}`"),
            Self::Word(word) => write!(out, "`\"{word}\"`"),
        }
    }
}

impl DefaultValue {
    /// `summary` followed by the default, if there is one.
    pub fn in_words(default: Option<Self>, summary: &str) -> String {
        let Some(default) = default else { return summary.to_owned() };
        let sentence = summary.trim_end_matches('.');
        let stop = &summary[sentence.len()..];
        format!("{sentence}; default {default}{stop}")
    }
}

/// A range in which a number usually is, and what a number outside of it is likely to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    /// Smallest and largest size; zero is usual.
    pub range: [f64; 2],
    /// The likely mistake, such as a unit.
    pub instead: &'static str,
}

impl Usual {
    /// From a least to a largest size, with what a number beyond is likely to be.
    pub const fn new(least: f64, most: f64, instead: &'static str) -> Self {
        Self { range: [least, most], instead }
    }

    /// Whether a number is unusual.
    pub fn excludes(&self, number: f64) -> bool {
        let [least, most] = self.range;
        number != 0.0 && !(least..=most).contains(&number.abs())
    }
}

/// A parameter of a kind, or another key of a model file, with what its type of values is described by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Declared<T> {
    /// Key in the model file.
    pub name: &'static str,
    /// Type of its value.
    pub holds: T,
    /// Whether it must be given.
    pub required: bool,
    /// Unit, such as `N m/rad`; empty for none.
    pub unit: &'static str,
    /// One sentence, without the default.
    pub summary: &'static str,
    /// Value where the parameter is omitted; none if that follows from others or means that something is absent.
    pub default: Option<DefaultValue>,
    /// Where it usually is; none if any number may be meant.
    pub usual: Option<Usual>,
}

/// One parameter of a kind.
pub type Parameter = Declared<ParameterType>;

/// A key that must be given.
pub const fn required<T>(
    name: &'static str,
    holds: T,
    unit: &'static str,
    summary: &'static str,
) -> Declared<T> {
    Declared { name, holds, required: true, unit, summary, default: None, usual: None }
}

/// A key that may be omitted.
pub const fn optional<T>(
    name: &'static str,
    holds: T,
    unit: &'static str,
    summary: &'static str,
) -> Declared<T> {
    Declared { name, holds, required: false, unit, summary, default: None, usual: None }
}

/// A key without a unit that may be omitted.
pub const fn unitless<T>(name: &'static str, holds: T, summary: &'static str) -> Declared<T> {
    optional(name, holds, "", summary)
}

impl<T> Declared<T> {
    const fn or(mut self, default: DefaultValue) -> Self {
        self.default = Some(default);
        self
    }

    /// This parameter with this number as its default.
    #[must_use]
    pub const fn or_number(self, value: f64) -> Self {
        self.or(DefaultValue::Number(value))
    }

    /// This parameter with this count as its default.
    #[must_use]
    pub const fn or_count(self, value: usize) -> Self {
        self.or_number(value as f64)
    }

    /// This parameter with this flag as its default.
    #[must_use]
    pub const fn or_flag(self, value: bool) -> Self {
        self.or(DefaultValue::Flag(value))
    }

    /// This parameter with this word as its default.
    #[must_use]
    pub const fn or_word(self, word: &'static str) -> Self {
        self.or(DefaultValue::Word(word))
    }

    /// This parameter with the range in which it usually is.
    #[must_use]
    pub const fn usual(mut self, usual: Usual) -> Self {
        self.usual = Some(usual);
        self
    }

    /// Summary with the default.
    pub fn meaning(&self) -> String {
        DefaultValue::in_words(self.default, self.summary)
    }
}

/// The initial relative rotation of a joint.
pub(crate) const ANGLE_AT_START: Parameter = optional(
    "angle",
    ParameterType::Number,
    "rad",
    "Value of the relative rotation in the given positions; moves no part, except with `[assembly]`.",
)
.or_number(0.0);

/// The initial rate of a joint's relative rotation.
pub(crate) const RATE_AT_START: Parameter = optional(
    "rate",
    ParameterType::Number,
    "rad/s",
    "Rate of the relative rotation at the start, which parts without a given velocity follow.",
);

/// The initial relative displacement of a joint.
pub(crate) const DISPLACEMENT_AT_START: Parameter = optional(
    "displacement",
    ParameterType::Number,
    "m",
    "Value of the relative displacement in the given positions; moves no part, except with `[assembly]`.",
)
.or_number(0.0);

/// The initial velocity of a joint's relative displacement.
pub(crate) const VELOCITY_AT_START: Parameter = optional(
    "velocity",
    ParameterType::Number,
    "m/s",
    "Velocity of the relative displacement at the start, which parts without a given velocity follow.",
);

/// Which coordinate of a joint that has several.
pub(crate) const COORDINATE: Parameter = unitless(
    "coordinate",
    ParameterType::Positive,
    "Number of the joint's coordinate, from 1; default: the first suitable one.",
);

/// Which coordinate of the first joint, for kinds that couple two.
pub(crate) const WHICH_COORDINATE: Parameter = unitless(
    "coordinate",
    ParameterType::Positive,
    "Number of the coordinate of `joint`, from 1; may be omitted if there is only one.",
);

/// Which coordinate of the other joint, for kinds that couple two.
pub(crate) const OTHER_COORDINATE: Parameter = unitless(
    "other_coordinate",
    ParameterType::Positive,
    "Number of the coordinate of `other`, from 1; may be omitted if there is only one.",
);

/// A parameter's value.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number.
    Number(f64),
    /// Three numbers.
    Vector(Vector3),
    /// True or false.
    Flag(bool),
    /// A word.
    Text(String),
    /// Several words.
    Words(Vec<String>),
    /// A function of time.
    Function(Function),
    /// A force.
    Force(Force),
    /// Two ascending numbers.
    Range([f64; 2]),
    /// An equation between coordinates.
    Relation(Arc<dyn Relation>),
    /// A 6 x 6 matrix.
    Matrix(Box<Matrix6>),
    /// Several numbers.
    Numbers(Vec<f64>),
    /// A square matrix of any size.
    SquareMatrix(DMatrix<f64>),
    /// An input, by its index among the held values.
    Input(DiscreteValueId),
    /// Numbers by name.
    Coefficients(BTreeMap<String, f64>),
}

/// The parameters given for one component, by name. What is not given has the default of its declaration.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    values: BTreeMap<String, Value>,
    /// Declarations, whose defaults apply to what is not given.
    declared: &'static [Parameter],
}

/// A parameter that is missing or of the wrong kind.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{parameter}` {problem}")]
pub struct ParameterError {
    /// Name of the parameter.
    pub parameter: String,
    /// What is wrong, to follow the name in a sentence.
    pub problem: String,
}

impl ParameterError {
    /// An error about `parameter`.
    pub fn new(parameter: &str, problem: impl Into<String>) -> Self {
        Self { parameter: parameter.to_owned(), problem: problem.into() }
    }
}

impl Parameters {
    /// No parameters.
    pub fn new() -> Self {
        Self::default()
    }

    /// These parameters, with the defaults of these declarations.
    #[must_use]
    pub fn declared(&self, declared: &'static [Parameter]) -> Self {
        Self { values: self.values.clone(), declared }
    }

    fn default_of(&self, name: &str) -> Option<&'static DefaultValue> {
        self.declared.iter().find(|parameter| parameter.name == name)?.default.as_ref()
    }

    /// Adds or replaces a value.
    #[must_use]
    pub fn with(mut self, name: &str, value: Value) -> Self {
        self.insert(name, value);
        self
    }

    /// Adds or replaces a value.
    pub fn insert(&mut self, name: &str, value: Value) {
        self.values.insert(name.to_owned(), value);
    }

    /// The functions of time among them, by name.
    pub fn functions(&self) -> impl Iterator<Item = (&str, &Function)> {
        self.values.iter().filter_map(|(name, value)| match value {
            Value::Function(function) => Some((name.as_str(), function)),
            _ => None,
        })
    }

    /// These parameters except for some.
    #[must_use]
    pub fn without<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Self {
        let mut rest = self.clone();
        for name in names {
            rest.values.remove(name);
        }
        rest
    }

    /// Whether `name` was given.
    pub fn has(&self, name: &str) -> bool {
        self.values.contains_key(name)
    }

    /// A number that is given or has a default.
    ///
    /// # Errors
    /// If it is missing or not a number.
    pub fn number(&self, name: &str) -> Result<f64, ParameterError> {
        match (self.values.get(name), self.default_of(name)) {
            (Some(Value::Number(value)), _) | (None, Some(DefaultValue::Number(value))) => Ok(*value),
            (other, _) => Err(wrong(name, "a number", other)),
        }
    }

    /// A number, or `default` if it is not given.
    ///
    /// # Errors
    /// If it is given and not a number.
    pub fn number_or(&self, name: &str, default: f64) -> Result<f64, ParameterError> {
        if self.has(name) { self.number(name) } else { Ok(default) }
    }

    /// A required vector.
    ///
    /// # Errors
    /// If it is missing or not a vector.
    pub fn vector(&self, name: &str) -> Result<Vector3, ParameterError> {
        match self.values.get(name) {
            Some(Value::Vector(value)) => Ok(*value),
            other => Err(wrong(name, "three numbers", other)),
        }
    }

    /// A vector, or `default` if it is not given.
    ///
    /// # Errors
    /// If it is given and not a vector.
    pub(crate) fn vector_or(&self, name: &str, default: Vector3) -> Result<Vector3, ParameterError> {
        if self.has(name) { self.vector(name) } else { Ok(default) }
    }

    /// A required equation between coordinates.
    ///
    /// # Errors
    /// If it is missing or not an equation.
    pub fn relation(&self, name: &str) -> Result<Arc<dyn Relation>, ParameterError> {
        match self.values.get(name) {
            Some(Value::Relation(value)) => Ok(Arc::clone(value)),
            other => Err(wrong(name, "an expression of coordinates", other)),
        }
    }

    /// A flag that is given or has a default.
    ///
    /// # Errors
    /// If it is missing or not a flag.
    pub fn flag(&self, name: &str) -> Result<bool, ParameterError> {
        match (self.values.get(name), self.default_of(name)) {
            (Some(Value::Flag(value)), _) | (None, Some(DefaultValue::Flag(value))) => Ok(*value),
            (other, _) => Err(wrong(name, "true or false", other)),
        }
    }

    /// Several required words.
    ///
    /// # Errors
    /// If they are missing or not words.
    pub fn words(&self, name: &str) -> Result<&[String], ParameterError> {
        match self.values.get(name) {
            Some(Value::Words(words)) => Ok(words),
            other => Err(wrong(name, "a list of words", other)),
        }
    }

    /// A function of time that is given or has a default; a number is a constant function.
    ///
    /// # Errors
    /// If it is missing or neither function nor number.
    pub fn function(&self, name: &str) -> Result<Function, ParameterError> {
        match (self.values.get(name), self.default_of(name)) {
            (Some(Value::Function(value)), _) => Ok(Arc::clone(value)),
            (Some(Value::Number(value)), _) | (None, Some(DefaultValue::Number(value))) => {
                Ok(Arc::new(Constant(*value)))
            }
            (other, _) => Err(wrong(name, "a number or an expression in t", other)),
        }
    }

    /// A force, if it is given; a number is a constant force.
    ///
    /// # Errors
    /// If it is given and neither force nor number.
    pub fn force(&self, name: &str) -> Result<Option<Force>, ParameterError> {
        match self.values.get(name) {
            None => Ok(None),
            Some(Value::Force(value)) => Ok(Some(Arc::clone(value))),
            Some(Value::Number(value)) => Ok(Some(Arc::new(Constant(*value)))),
            other => Err(wrong(name, "a force", other)),
        }
    }

    /// Two ascending numbers, if they are given.
    ///
    /// # Errors
    /// If they are given and not a range, or do not ascend.
    pub fn range(&self, name: &str) -> Result<Option<[f64; 2]>, ParameterError> {
        match self.values.get(name) {
            None => Ok(None),
            Some(Value::Range([low, high])) if low < high => Ok(Some([*low, *high])),
            other => Err(wrong(name, "two ascending numbers", other)),
        }
    }

    /// A 6 x 6 matrix, or zeros if it is not given.
    ///
    /// # Errors
    /// If it is given and not a matrix.
    pub(crate) fn matrix_or_zero(&self, name: &str) -> Result<Matrix6, ParameterError> {
        match self.values.get(name) {
            None => Ok(Matrix6::zeros()),
            Some(Value::Matrix(value)) => Ok(**value),
            other => Err(wrong(name, "six numbers or a 6 x 6 matrix", other)),
        }
    }

    /// Several required numbers.
    ///
    /// # Errors
    /// If they are missing or not numbers.
    pub fn numbers(&self, name: &str) -> Result<&[f64], ParameterError> {
        match self.values.get(name) {
            Some(Value::Numbers(values)) => Ok(values),
            other => Err(wrong(name, "a list of numbers", other)),
        }
    }

    /// Required numbers by name.
    ///
    /// # Errors
    /// If they are missing or not numbers by name.
    pub fn coefficients(&self, name: &str) -> Result<&BTreeMap<String, f64>, ParameterError> {
        match self.values.get(name) {
            Some(Value::Coefficients(values)) => Ok(values),
            other => Err(wrong(name, "numbers by name", other)),
        }
    }

    /// A required square matrix.
    ///
    /// # Errors
    /// If it is missing or not a square matrix.
    pub fn square_matrix(&self, name: &str) -> Result<&DMatrix<f64>, ParameterError> {
        match self.values.get(name) {
            Some(Value::SquareMatrix(matrix)) => Ok(matrix),
            other => Err(wrong(name, "a number, a diagonal or a square matrix", other)),
        }
    }

    /// A required input.
    ///
    /// # Errors
    /// If it is missing or not an input.
    pub fn input(&self, name: &str) -> Result<DiscreteValueId, ParameterError> {
        match self.values.get(name) {
            Some(Value::Input(held)) => Ok(*held),
            other => Err(wrong(name, "the name of an input", other)),
        }
    }

    /// A word that is given or has a default.
    ///
    /// # Errors
    /// If it is missing or not text.
    pub fn word(&self, name: &str) -> Result<&str, ParameterError> {
        match (self.values.get(name), self.default_of(name)) {
            (Some(Value::Text(word)), _) => Ok(word),
            (None, Some(DefaultValue::Word(word))) => Ok(word),
            (other, _) => Err(wrong(name, "a word", other)),
        }
    }
}

fn wrong(name: &str, wanted: &str, found: Option<&Value>) -> ParameterError {
    let problem = match found {
        None => format!("is missing: it must be {wanted}"),
        Some(_) => format!("must be {wanted}"),
    };
    ParameterError::new(name, problem)
}
