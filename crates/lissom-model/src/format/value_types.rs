//! Types of values of a model file: of each its description, its schema, and its types in Rust and Python. The reader of tables has a
//! function for each.

use std::borrow::Cow;

use lissom_mechanics::registry::{DefaultValue, ModelAxis};
use serde_json::{Map, Value, json};

use super::keys::{Key, table_keys};
use super::top_level::VERSION;

/// Shape of the value of a key.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A text.
    Text,
    /// The version of the format.
    Version,
    /// A finite number. Every number may also be a text: an expression of the parameters.
    Number,
    /// A number greater than zero.
    Positive,
    /// A number not less than zero.
    NotNegative,
    /// A number from the first to the second, both included.
    Between(f64, f64),
    /// A whole number from the first to the second, both included.
    Count(usize, usize),
    /// True or false.
    Flag,
    /// Three numbers that are not transformed with the part.
    Vector,
    /// Three numbers in global axes; those of the part inside of one.
    GlobalVector,
    /// Three numbers, or a position in the frame of a part.
    Point,
    /// A list of names of parts.
    Names,
    /// Entries as in the table of this name at the top.
    Entries(&'static str),
    /// Three numbers, not all zero, in global axes; those of the part inside of one.
    Direction,
    /// Direction in global axes with a default: this axis of the part.
    DirectionOr(ModelAxis),
    /// Direction in axes of a body, which is not transformed.
    BodyDirection,
    /// One of the words.
    Choice(Cow<'static, [&'static str]>),
    /// A number, an expression of this variable, or a table of it.
    FunctionOf(&'static str),
    /// An expression of coordinates of joints and of `t`.
    Equation,
    /// Some of these words, each at most once.
    Choices(&'static [&'static str]),
    /// The name of an entry of a table.
    Name(&'static str),
    /// The name of a point, or three numbers.
    Place,
    /// The name of a point, three numbers, or a node of another part.
    PlaceOrNode,
    /// A node: `ground`, a body, a point mass, `beam.start`, `beam.end` or `beam@fraction`.
    Node,
    /// A list of nodes.
    Nodes,
    /// Lists of nodes.
    GroupsOfNodes,
    /// A number, an expression of the time `t`, or a table.
    Function,
    /// A number, an expression of time, inputs, signals, states and outputs, or a table.
    Size,
    /// A number, or an expression of time, inputs, signals, states and outputs.
    Formula,
    /// A formula, or a table of a formula, its sample period and its start.
    Signal,
    /// A number, or an expression of `s`.
    Profile,
    /// Three numbers or expressions of `s`.
    Curve,
    /// Three numbers or expressions of `s` and `t`, in global axes; those of the part inside of one.
    Distribution,
    /// Three numbers or expressions of `s` and `t`, in the axes of the section.
    SectionDistribution,
    /// Four positions.
    Corners,
    /// Three numbers or expressions of `u` and `v`, in global axes; those of the part inside of one.
    Surface,
    /// Two whole numbers.
    Divisions,
    /// Three numbers or expressions of `u`, `v` and `w`, in global axes; those of the part inside of one.
    Volume,
    /// Three whole numbers.
    VolumeDivisions,
    /// A number, or an expression of `u` and `v`.
    Thickness,
    /// A number, or an expression of `x`, `y` and `z`.
    Field,
    /// A number, or an expression of `u`, `v` and `t`.
    AreaSize,
    /// Three of them, in global axes; those of the part inside of one.
    AreaDistribution,
    /// A list of layers.
    Plies,
    /// Two axes of a frame, in the axes around it.
    Axes,
    /// Rotation vector of a frame, in the axes around it.
    Rotation,
    /// A number greater than zero, or a table of a density.
    Mass,
    /// Three numbers, a 3 x 3 matrix, or a table of a solid.
    Inertia,
    /// A table of a solid.
    Solid,
    /// A table of friction in a joint.
    Friction,
    /// A table of a latch on a joint.
    Latch,
    /// Six numbers, or a 6 x 6 matrix.
    Stiffness,
    /// A 6 x 6 matrix, or a table of mass per length, inertia and centre.
    SectionMass,
    /// A number, two numbers, or the name of a theory.
    Shear,
    /// A list of sections and where they are.
    Stations,
    /// A list of nodes and locations on them.
    Places,
    /// A list of names and positions in the axes of the part.
    Interfaces,
    /// A list of pairs of numbers.
    Rows,
    /// A list of lists of equally many numbers.
    NumberRows,
    /// Two numbers.
    Pair,
    /// Two texts.
    Words,
    /// A number, an expression of the two named quantities, or a table over the first.
    Force(&'static [&'static str; 2]),
    /// Two ascending numbers, which may be infinite.
    Range,
    /// A list of numbers.
    Numbers,
    /// A number, a list of numbers, or a square list of lists of numbers.
    SquareMatrix,
    /// A list of joints, or of their coordinates, such as `arm.angle`.
    Coordinates,
    /// A tyre property file, or a table that names it and has other values of some of its coefficients.
    Coefficients,
    /// A height over x and y.
    HeightField,
    /// A table that is read entry by entry.
    Table,
}

/// What is known of a type of value.
pub(crate) struct ValueType {
    /// Description, to follow "holds".
    pub(crate) words: Cow<'static, str>,
    /// Schema (JSON Schema, draft 2020-12).
    pub(crate) schema: Value,
    /// Type in Rust.
    pub(crate) rust: RustType,
    /// Type in Python.
    pub(crate) python: Cow<'static, str>,
}

/// Type of a value in Rust.
pub(crate) enum RustType {
    /// This type.
    Fixed(&'static str),
    /// An enumeration of these words.
    Words(Vec<&'static str>),
    /// A list of these words.
    ListOfWords(Vec<&'static str>),
    /// The id of an entry of this table.
    Id(&'static str),
    /// Not used in code.
    Absent,
}

impl Shape {
    /// Whether the value is expressed in model axes, so that the decoder transforms it with the part in which it is written. Others
    /// have no axes, or those of a body, a section or an element.
    pub(crate) fn is_in_model_axes(&self) -> bool {
        matches!(
            self,
            Self::GlobalVector
                | Self::Point
                | Self::Direction
                | Self::DirectionOr(_)
                | Self::Place
                | Self::PlaceOrNode
                | Self::Places
                | Self::Curve
                | Self::Distribution
                | Self::Corners
                | Self::Surface
                | Self::Volume
                | Self::AreaDistribution
                | Self::Axes
                | Self::Rotation
        )
    }

    /// The row of the table of types.
    #[expect(clippy::too_many_lines, reason = "one row per type")]
    pub(crate) fn value_type(&self) -> ValueType {
        use RustType::{Absent, Fixed, Id, ListOfWords, Words};
        let number = || number_in(&json!({}));
        let text = || json!({ "type": "string", "minLength": 1 });
        let vector = || list(&number(), 3);
        let list_of =
            |item: Value, least: usize| json!({ "type": "array", "minItems": least, "items": item });
        let row = |words: &'static str, schema: Value, rust: RustType, python: &'static str| ValueType {
            words: words.into(),
            schema,
            rust,
            python: python.into(),
        };
        let phrase = |words: String, schema: Value, rust: RustType, python: &'static str| ValueType {
            words: words.into(),
            schema,
            rust,
            python: python.into(),
        };
        match self {
            Self::Text => row("a text", json!({ "type": "string" }), Fixed("String"), "str"),
            Self::Version => row("the number 1", json!({ "const": VERSION }), Absent, "Count"),
            Self::Number => row("a number", number(), Fixed("f64"), "Number"),
            Self::Positive => {
                row("a number > 0", number_in(&json!({ "exclusiveMinimum": 0 })), Fixed("f64"), "Number")
            }
            Self::NotNegative => {
                row("a number ≥ 0", number_in(&json!({ "minimum": 0 })), Fixed("f64"), "Number")
            }
            Self::Between(least, most) => phrase(
                format!("a number from {} to {}", short(*least), short(*most)),
                number_in(&json!({ "minimum": least, "maximum": most })),
                Fixed("f64"),
                "Number",
            ),
            Self::Count(least, most) => phrase(
                format!("a whole number from {least} to {most}"),
                number_in(&json!({ "type": "integer", "minimum": least, "maximum": most })),
                Fixed("usize"),
                "Count",
            ),
            Self::Flag => row("`true` or `false`", json!({ "type": "boolean" }), Fixed("bool"), "bool"),
            Self::Vector | Self::GlobalVector | Self::Rotation => {
                row("three numbers", vector(), Fixed("[f64; 3]"), "Vector")
            }
            Self::Point => {
                let placed = json!({
                    "type": "object",
                    "properties": { "in": text(), "at": vector() },
                    "required": ["in"],
                    "additionalProperties": false,
                });
                let words = "three numbers, or `{ in = \"part\", at = [x, y, z] }`";
                row(words, any_of(&[vector(), placed]), Fixed("[f64; 3]"), "Vector | Table")
            }
            Self::Names => row("a list of names of parts", list_of(text(), 1), Fixed("Vec<Part>"), "Names"),
            Self::Entries(table) => phrase(
                format!("entries as in `[{table}]`"),
                json!({ "$ref": format!("#/properties/{table}") }),
                Absent,
                "Tables",
            ),
            Self::Direction | Self::DirectionOr(_) | Self::BodyDirection => {
                let schema = any_of(&[vector(), json!({ "enum": ["x", "y", "z", "-x", "-y", "-z"] })]);
                row("a direction", schema, Fixed("[f64; 3]"), "Vector | str")
            }
            Self::Choice(words) => ValueType {
                words: quoted(words, "`\"", "\"`").into(),
                schema: json!({ "enum": words }),
                rust: Words(words.to_vec()),
                python: format!("Literal[{}]", quoted(words, "\"", "\"")).into(),
            },
            Self::Choices(words) => ValueType {
                words: format!("a list of {}", quoted(words, "`\"", "\"`")).into(),
                schema: json!({ "type": "array", "minItems": 1, "uniqueItems": true, "items": { "enum": words } }),
                rust: ListOfWords(words.to_vec()),
                python: format!("list[Literal[{}]]", quoted(words, "\"", "\"")).into(),
            },
            Self::Name(table) => {
                phrase(format!("the name of an entry of `[{table}]`"), text(), Id(table), "str")
            }
            Self::Place => row("a position", any_of(&[text(), vector()]), Fixed("[f64; 3]"), "Place"),
            Self::PlaceOrNode => {
                row("a position or a node", any_of(&[text(), vector()]), Fixed("PositionOrNode"), "Place")
            }
            Self::Node => row("a node", text(), Fixed("Node"), "str"),
            Self::Nodes => row("a list of nodes", list_of(text(), 1), Fixed("Vec<Node>"), "list[str]"),
            Self::GroupsOfNodes => row(
                "lists of nodes",
                list_of(list_of(text(), 2), 1),
                Fixed("Vec<Vec<Node>>"),
                "list[list[str]]",
            ),
            Self::Function => row("a function of time", or_table(), Fixed("Function"), "Function"),
            Self::FunctionOf(variable) => phrase(
                format!("an expression of `{variable}`, or a table of it written as a function of time"),
                or_table(),
                Fixed("Function"),
                "Function",
            ),
            Self::Equation => {
                let words = "an expression of coordinates of joints, such as `arm.angle`, and of `t`";
                row(words, number(), Fixed("Expression"), "Number")
            }
            Self::Size => row("a size", or_table(), Fixed("Function"), "Function"),
            Self::Formula => row("an expression of signals", number(), Fixed("Expression"), "Number"),
            Self::Signal => {
                let words = "an expression of signals, `{ value, sample, start, numerator, denominator }`, or `{ of, table }` with the keys of a table";
                let schema = any_of(&[number(), schema_of_keys(&Self::signal_keys())]);
                row(words, schema, Fixed("Expression"), "Function")
            }
            Self::Profile => row("a number or an expression of `s`", number(), Fixed("Function"), "Number"),
            Self::Curve => row("three expressions of `s`", vector(), Fixed("[Expression; 3]"), "Vector"),
            Self::Distribution | Self::SectionDistribution => {
                row("three expressions of `s` and `t`", vector(), Fixed("[Expression; 3]"), "Vector")
            }
            Self::Corners => {
                let place = any_of(&[text(), vector()]);
                row("four positions", list(&place, 4), Fixed("[[f64; 3]; 4]"), "list[Place]")
            }
            Self::Surface => {
                row("three expressions of `u` and `v`", vector(), Fixed("[Expression; 3]"), "Vector")
            }
            Self::Divisions => {
                let count = number_in(&json!({ "type": "integer", "minimum": 1 }));
                row("two whole numbers", list(&count, 2), Fixed("[f64; 2]"), "Vector")
            }
            Self::Volume => {
                row("three expressions of `u`, `v` and `w`", vector(), Fixed("[Expression; 3]"), "Vector")
            }
            Self::VolumeDivisions => {
                let count = number_in(&json!({ "type": "integer", "minimum": 1 }));
                row("three whole numbers", list(&count, 3), Fixed("[f64; 3]"), "Vector")
            }
            Self::Thickness => {
                row("a number or an expression of `u` and `v`", number(), Fixed("Expression"), "Number")
            }
            Self::Field => {
                row("a number or an expression of `x`, `y` and `z`", number(), Fixed("Expression"), "Number")
            }
            Self::AreaSize => {
                row("a number or an expression of `u`, `v` and `t`", number(), Fixed("Expression"), "Number")
            }
            Self::AreaDistribution => {
                row("three expressions of `u`, `v` and `t`", vector(), Fixed("[Expression; 3]"), "Vector")
            }
            Self::Plies => {
                let schema = list_of(schema_of_keys(&Self::ply_keys()), 1);
                row("a list of layers", schema, Absent, "list[Table]")
            }
            Self::Axes => row("two vectors", list(&vector(), 2), Fixed("[[f64; 3]; 2]"), "list[Vector]"),
            Self::Mass => {
                let mass = number_in(&json!({ "minimum": 0 }));
                let schema = any_of(&[mass, schema_of_keys(&Self::density_keys())]);
                row("a number ≥ 0, or `{ density }`", schema, Fixed("Mass"), "Function")
            }
            Self::Inertia => {
                let schema = any_of(&[vector(), matrix(3), schema_of_keys(&Self::solid_keys())]);
                let python = "Vector | list[Vector] | Table";
                row("three numbers, a 3 x 3 matrix, or a solid", schema, Fixed("Inertia"), python)
            }
            Self::Solid => {
                let solid = schema_of_keys(&Self::drawn_keys());
                let schema = any_of(&[solid.clone(), list_of(solid, 0)]);
                row("a solid, or a list of solids", schema, Fixed("Solid"), "Table | list[Table]")
            }
            Self::Friction => {
                let words = "`{ coulomb, static, stribeck, viscous, deflection, damping }`";
                row(words, schema_of_keys(&Self::friction_keys()), Fixed("Friction"), "Table")
            }
            Self::Latch => row("`{ at }`", schema_of_keys(&Self::latch_keys()), Fixed("Latch"), "Table"),
            Self::Stiffness => {
                let schema = any_of(&[list(&number(), 6), matrix(6)]);
                row("six numbers or a 6 x 6 matrix", schema, Fixed("Matrix"), "Vector | list[Vector]")
            }
            Self::SectionMass => {
                let schema =
                    any_of(&[list(&number(), 6), matrix(6), schema_of_keys(&Self::slice_mass_keys())]);
                let python = "Vector | list[Vector] | Table";
                row("six numbers, a 6 x 6 matrix, or a table", schema, Fixed("SectionMass"), python)
            }
            Self::Shear => {
                let schema = any_of(&[number(), list(&number(), 2)]);
                row("a number, two numbers, or a word", schema, Fixed("Shear"), "Number | Vector")
            }
            Self::Stations => {
                let schema = list_of(schema_of_keys(&Self::station_keys()), 2);
                row("a list of tables", schema, Fixed("Vec<(f64, SectionId)>"), "list[Table]")
            }
            Self::Places => {
                let schema = list_of(schema_of_keys(&Self::place_keys()), 2);
                let rust = Fixed("Vec<(Node, PositionOrNode)>");
                row(
                    "a list of `{ on, at }`, `at` may be omitted; sheaves and drums also have `radius`, `axis`, `sense` and `joint`",
                    schema,
                    rust,
                    "list[Table]",
                )
            }
            Self::Interfaces => {
                let schema = list_of(schema_of_keys(&Self::interface_keys()), 1);
                row("a list of `{ name, at }`", schema, Fixed("Vec<(String, [f64; 3])>"), "list[Table]")
            }
            Self::Rows => row("a list of pairs", list_of(list(&number(), 2), 2), Absent, "list[Vector]"),
            Self::NumberRows => {
                let schema = list_of(list_of(number(), 2), 2);
                row("a list of lists of equally many numbers", schema, Absent, "list[Vector]")
            }
            Self::Pair => row("two numbers", list(&number(), 2), Fixed("[f64; 2]"), "Vector"),
            Self::Words => row("two texts", list(&text(), 2), Absent, "Names"),
            Self::Force([first, second]) => phrase(
                format!("a number, an expression of `{first}` and `{second}`, or a table over `{first}`"),
                or_table(),
                Fixed("Function"),
                "Function",
            ),
            Self::Range => {
                let words = "two ascending numbers, which may be `-inf` and `inf`";
                row(words, list(&number(), 2), Fixed("[f64; 2]"), "Vector")
            }
            Self::Numbers => row("a list of numbers", list_of(number(), 1), Fixed("Vec<f64>"), "Vector"),
            Self::SquareMatrix => {
                let words = "a number, a list of numbers (a diagonal), or a square matrix by rows";
                let schema = any_of(&[number(), list_of(number(), 1), list_of(list_of(number(), 1), 1)]);
                row(words, schema, Fixed("Vec<Vec<f64>>"), "Number | Vector | list[Vector]")
            }
            Self::Coordinates => {
                let words =
                    "a list of coordinates of joints, such as `\"arm.angle\"`, or of joints: all of theirs";
                row(words, list_of(text(), 1), Fixed("Vec<JointId>"), "Names")
            }
            Self::Coefficients => row(
                "a tyre property file, or `{ file = \"…\", NAME = number }`",
                any_of(&[text(), json!({ "type": "object" })]),
                Fixed("String"),
                "str | Table",
            ),
            Self::HeightField => {
                let words = "a number, an expression of `x` and `y`, `{ file = \"…\" }`, `{ grid = \"…\" }`, `{ class = \"C\" }`, or a list of these, which are added";
                let schema = any_of(&[number(), text(), json!({ "type": ["object", "array"] })]);
                row(words, schema, Fixed("Function"), "Function | list[Function]")
            }
            Self::Table => row("a table", json!({ "type": "object" }), Absent, "Table"),
        }
    }
}

/// A number with four decimals at most.
fn short(number: f64) -> String {
    if number == 0.0 || number.abs() >= 1e-3 {
        ((number * 1e4).round() / 1e4).to_string()
    } else {
        format!("{number:e}")
    }
}

fn quoted(words: &[&str], open: &str, close: &str) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("{open}{word}{close}")).collect();
    quoted.join(", ")
}

/// Schema of a table with these keys.
pub(crate) fn schema_of_keys(keys: &[Key]) -> Value {
    let mut properties = Map::new();
    for key in keys {
        let mut value = key.holds.value_type().schema;
        let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
        if let Value::Object(object) = &mut value {
            object.insert("description".to_owned(), json!(format!("{}{unit}", key.meaning())));
            if let Some(default) = default_of(key) {
                object.insert("default".to_owned(), default);
            }
        }
        properties.insert(key.name.to_owned(), value);
    }
    let required: Vec<&str> = keys.iter().filter(|key| key.required).map(|key| key.name).collect();
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

/// The default of a key as a value; none if it stands for each of three numbers.
fn default_of(key: &Key) -> Option<Value> {
    match key.default? {
        DefaultValue::Number(_) if key.holds == Shape::Vector => None,
        DefaultValue::Number(number) => Some(json!(number)),
        DefaultValue::Flag(flag) => Some(json!(flag)),
        DefaultValue::Word(word) => Some(json!(word)),
    }
}

/// A number in a range, or an expression.
fn number_in(range: &Value) -> Value {
    let mut number = json!({ "type": "number" });
    if let (Value::Object(number), Value::Object(range)) = (&mut number, range) {
        number.extend(range.clone());
    }
    any_of(&[number, json!({ "type": "string", "minLength": 1 })])
}

/// A number, an expression or a table.
fn or_table() -> Value {
    any_of(&[number_in(&json!({})), schema_of_keys(&table_keys())])
}

fn list(item: &Value, length: usize) -> Value {
    json!({ "type": "array", "items": item, "minItems": length, "maxItems": length })
}

fn matrix(size: usize) -> Value {
    list(&list(&number_in(&json!({})), size), size)
}

/// One of these schemas.
pub(crate) fn any_of(choices: &[Value]) -> Value {
    json!({ "anyOf": choices })
}
