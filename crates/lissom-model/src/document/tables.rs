//! The tables of a model file and their keys, for the decoder, the schema and the reference.

use std::borrow::Cow;

use super::analysis_tables::analyses;
use crate::format::keys::{Key, Shape, choice, of_parameter, of_port, optional, required, unitless};
use crate::format::part_tables::{initial, part, placed_in, superelement};
use crate::format::top_level::{Variant, Variants};
use crate::outputs::kinds::{Feature, OutputKind, Subject};
use crate::registry::{KindEntry, Registry};
use crate::sections::{GENERAL, KINDS, NAMES};

impl Variants {
    /// The words that choose.
    pub(crate) fn words(&self) -> Vec<&'static str> {
        self.all.iter().map(|variant| variant.word).collect()
    }

    /// The keys of all forms, of which those are required that every form requires.
    pub(crate) fn merged_keys(&self) -> Vec<Key> {
        let mut keys: Vec<Key> = Vec::new();
        for key in self.all.iter().flat_map(|form| &form.keys) {
            if !keys.iter().any(|known| known.name == key.name) {
                let requires =
                    |form: &Variant| form.keys.iter().any(|own| own.name == key.name && own.required);
                keys.push(Key { required: self.all.iter().all(requires), ..key.clone() });
            }
        }
        keys
    }

    /// The forms that have types of their own in code: one if it may be inferred.
    pub(crate) fn in_code(self) -> Self {
        if !self.is_inferred {
            return self;
        }
        Self { tag: None, is_inferred: false, all: vec![single(self.merged_keys())] }
    }
}

/// The forms of the tables under the word `name`.
pub(crate) fn variants(name: &str, registry: &Registry) -> Variants {
    let (tag, all) = match name {
        "materials" => (None, vec![single(material())]),
        "sections" => (Some("shape"), sections()),
        "beams" => (None, vec![single(beam())]),
        "shells" => (None, vec![single(super::shells::keys())]),
        "solids" => (None, vec![single(super::elastic_solids::keys())]),
        "bodies" => (None, vec![single(body())]),
        "parts" => (None, vec![single(part())]),
        "point_masses" => (None, vec![single(point_mass())]),
        "superelements" => (None, vec![single(superelement())]),
        "joints" => (Some("kind"), joints(&registry.joints)),
        "springs" => (Some("kind"), kinds(&registry.springs)),
        "loads" => (Some("kind"), kinds(&registry.loads)),
        "local_loads" => (None, vec![single(super::local_loads::keys())]),
        "ground" => (None, vec![single(super::ground::keys())]),
        "contacts" => return super::contacts::variants(),
        "states" => (None, vec![single(state())]),
        "events" => (None, vec![single(super::events::keys())]),
        "units" => (None, vec![single(super::units::keys())]),
        "fluids" => (None, vec![single(super::hydraulics::fluid_keys())]),
        "hydraulics" => (Some("kind"), super::hydraulics::variants()),
        "initial" => (None, vec![single(initial())]),
        "assembly" => (None, vec![single(super::assembly::keys())]),
        "outputs" => (Some("kind"), outputs()),
        "analysis" => (Some("kind"), analyses(registry)),
        _ => (None, Vec::new()),
    };
    Variants { tag, is_inferred: false, all }
}

fn single(keys: Vec<Key>) -> Variant {
    Variant { word: "", summary: "", keys }
}

fn material() -> Vec<Key> {
    vec![
        required("E", Shape::Positive, "Pa", "Young's modulus"),
        unitless("nu", Shape::Number, "Poisson's ratio; either it or `G` is required"),
        optional("G", Shape::Positive, "Pa", "shear modulus; either it or `nu` is required"),
        required("density", Shape::Positive, "kg/m³", "mass density"),
        optional("expansion", Shape::Number, "1/K", "strain per change of temperature").or_number(0.0),
    ]
}

fn sections() -> Vec<Variant> {
    let form = |word: &'static str, summary: &'static str, mut own: Vec<Key>| {
        let mut keys = vec![required("shape", choice(&NAMES), "", "its shape")];
        if word != GENERAL {
            keys.push(required("material", Shape::Name("materials"), "", "name of a material"));
            let words =
                "shear coefficient: one or two numbers (along 2 and 3), \"cowper\" (default) or \"renton\"";
            own.push(unitless("shear", Shape::Shear, words));
        }
        keys.append(&mut own);
        let damping = "damping in proportion to the stiffness";
        keys.push(optional("damping", Shape::NotNegative, "s", damping));
        Variant { word, summary, keys }
    };
    let order = "6 x 6 or its diagonal: axial, shear 2, shear 3, torsion, bending 2, bending 3";
    let general = vec![
        required("stiffness", Shape::Stiffness, "N, N m²", order),
        required(
            "mass",
            Shape::SectionMass,
            "kg/m, kg m",
            "6 x 6, or { per_length, inertia = [J11, J22, J33], center = [c2, c3] }",
        ),
        optional("expansion", Shape::Number, "1/K", "strain per change of temperature").or_number(0.0),
    ];
    let shapes = KINDS.iter().map(|kind| form(kind.name, kind.summary, (kind.keys)()));
    shapes.chain([form(GENERAL, "Specified by its stiffness and mass matrices.", general)]).collect()
}

fn beam() -> Vec<Key> {
    vec![
        placed_in(),
        unitless(
            "section",
            Shape::Name("sections"),
            "name of a section; either it or `stations` is required",
        ),
        unitless(
            "stations",
            Shape::Stations,
            "[{ at = 0, section = \"a\" }, …, { at = 1, … }], interpolated linearly",
        ),
        optional(
            "from",
            Shape::PlaceOrNode,
            "m",
            "start: a position, or a node of another part, which is then shared",
        ),
        optional(
            "to",
            Shape::PlaceOrNode,
            "m",
            "end: a position, or a node of another part, which is then shared",
        ),
        optional("through", Shape::Place, "m", "an intermediate point: the beam is a circular arc"),
        optional("curve", Shape::Curve, "m", "instead of `from` and `to`: three expressions of s in 0..1"),
        required("elements", Shape::Count(1, 100_000), "", "number of elements"),
        unitless("order", Shape::Count(1, 3), "1, 2 or 3: elements of 2, 3 or 4 nodes").or_count(3),
        unitless("up", Shape::Direction, "direction towards which local axis 3 is oriented"),
        optional(
            "force_per_length",
            Shape::Distribution,
            "N/m",
            "in global axes, fixed in direction: three numbers or expressions of s and t",
        ),
        optional(
            "section_force_per_length",
            Shape::SectionDistribution,
            "N/m",
            "in the section's axes 1, 2 and 3, with which it rotates: three numbers or expressions of s and t",
        ),
        optional(
            "twist",
            Shape::Profile,
            "rad",
            "rotation about the tangent, a number or an expression of s",
        ),
        optional(
            "temperature",
            Shape::Profile,
            "K",
            "above that of the state without stress, over the whole analysis: a number or an expression of s",
        ),
        optional(
            "temperature_slope",
            Shape::Pair,
            "K/m",
            "change of the temperature along axes 2 and 3 of the section: it bends the beam",
        ),
    ]
}

fn body() -> Vec<Key> {
    vec![
        placed_in(),
        required(
            "mass",
            Shape::Mass,
            "kg",
            "mass, or { density } of the solid in `inertia`; 0, also for `inertia`, is a frame between joints",
        ),
        required(
            "inertia",
            Shape::Inertia,
            "kg m²",
            "about the centre of mass, in body axes: 3 numbers, 3 x 3, or a solid such as { kind = \"box\", sides = [a, b, c] }",
        ),
        optional("position", Shape::Place, "m", "position of the reference frame"),
        optional("rotation", Shape::Rotation, "rad", "rotation vector of the reference frame"),
        unitless("axes", Shape::Axes, "instead of `rotation`: first and second body axis"),
        optional("center_of_mass", Shape::Vector, "m", "in body axes, from the reference point"),
        unitless(
            "shape",
            Shape::Solid,
            "what is drawn of it, about the centre of mass; default: a solid with its inertia; [] draws nothing",
        ),
        unitless(
            "mesh",
            Shape::Text,
            "instead of `shape`: an STL or glTF file in metres and body axes; path relative to this file",
        ),
        optional("velocity", Shape::GlobalVector, "m/s", "of the reference point at the start, global axes"),
        optional("angular_velocity", Shape::Vector, "rad/s", "at the start, body axes"),
    ]
}

fn point_mass() -> Vec<Key> {
    vec![
        placed_in(),
        required("mass", Shape::Positive, "kg", "mass"),
        optional("position", Shape::Place, "m", "position at the start"),
        unitless("plane", choice(&["xy", "yz", "zx"]), "restricts the motion to this plane"),
        unitless("shape", Shape::Solid, "solid to be drawn about its position; default: a ball"),
        unitless(
            "mesh",
            Shape::Text,
            "instead of `shape`: an STL or glTF file in metres, along the global axes; path relative to this file",
        ),
        optional("velocity", Shape::GlobalVector, "m/s", "at the start, global axes"),
    ]
}

fn kinds(table: &[KindEntry]) -> Vec<Variant> {
    let words: Vec<&'static str> = table.iter().map(|entry| entry.name).collect();
    let variant = |entry: &KindEntry| {
        let mut keys = vec![required("kind", Shape::Choice(Cow::Owned(words.clone())), "", "its kind")];
        keys.push(placed_in());
        keys.extend(entry.ports.0.iter().filter_map(of_port));
        keys.extend(entry.parameters.iter().map(of_parameter));
        Variant { word: entry.name, summary: entry.summary, keys }
    };
    table.iter().map(variant).collect()
}

/// Joints may have friction, and different positions on base and tip.
fn joints(table: &[KindEntry]) -> Vec<Variant> {
    let mut variants = kinds(table);
    for (variant, entry) in variants.iter_mut().zip(table) {
        if entry.ports.may_have_friction() {
            let words = "friction on its only coordinate";
            variant.keys.push(unitless("friction", Shape::Friction, words));
            let words = "latch that engages when its only coordinate first reaches the value `at`, and locks it there";
            variant.keys.push(unitless("latch", Shape::Latch, words));
            let words = "the latch releases when this expression rises through zero; without `latch` it is engaged from the start";
            variant.keys.push(unitless("release", Shape::Formula, words));
        }
        variant.keys.extend(super::assembly::keys_on_tip(entry.ports));
    }
    variants
}

fn state() -> Vec<Key> {
    vec![
        required("derivative", Shape::Formula, "1/s", "time derivative"),
        unitless(
            "algebraic",
            Shape::Flag,
            "whether the value makes `derivative` zero at all times, as that of an infinitely fast state; `start` is a first guess",
        )
        .or_flag(false),
        unitless("start", Shape::Number, "value at the start").or_number(0.0),
        unitless(
            "magnitude",
            Shape::Positive,
            "typical magnitude, relative to which errors are measured unless its value is larger",
        )
        .or_number(1.0),
    ]
}

fn outputs() -> Vec<Variant> {
    let words: Vec<&'static str> = OutputKind::all().map(OutputKind::name).collect();
    let variant = |kind: OutputKind| {
        let mut keys = vec![required("kind", Shape::Choice(Cow::Owned(words.clone())), "", "its kind")];
        keys.extend(output_subject(kind.subject()));
        keys.extend(kind.features().iter().flat_map(|&feature| output_option(feature)));
        let words = "plot in which it is drawn together with other outputs of the same word; default its own";
        keys.push(unitless("plot", Shape::Text, words));
        Variant { word: kind.name(), summary: kind.summary(), keys }
    };
    OutputKind::all().map(variant).collect()
}

/// Key with the part to which an output refers; none for the whole model.
fn output_subject(subject: Subject) -> Option<Key> {
    Some(match subject {
        Subject::Node | Subject::Section => required("of", Shape::Node, "", "the node, such as \"beam@0.5\""),
        Subject::SolidNode => {
            required("of", Shape::Node, "", "the node of a solid, such as \"block@0.5,1,0\"")
        }
        Subject::ShellNode => required("of", Shape::Node, "", "the node of a shell, such as \"panel@0.5,1\""),
        Subject::Joint => required("of", Shape::Name("joints"), "", "the joint"),
        Subject::Spring => required("of", Shape::Name("springs"), "", "the spring"),
        Subject::Contact => required("of", Shape::Name("contacts"), "", "the contact"),
        Subject::LocalLoad => required("of", Shape::Name("local_loads"), "", "the local load"),
        Subject::Actor => {
            let words = "the name of a spring, a load, a drive or a joint with friction";
            required("of", Shape::Text, "", words)
        }
        Subject::Beam => required("of", Shape::Name("beams"), "", "the beam"),
        Subject::Superelement => required("of", Shape::Name("superelements"), "", "the superelement"),
        Subject::Signal => required(
            "of",
            Shape::Text,
            "",
            "the name of a signal, an input or a state, or of a component of a hydraulic part",
        ),
        Subject::Expression => {
            let words = "expression such as \"hypot(a.x - b.x, a.y - b.y)\", of components of outputs";
            required("value", Shape::Formula, "", words)
        }
        Subject::Model => return None,
    })
}

/// The keys of a feature of outputs.
fn output_option(feature: Feature) -> Vec<Key> {
    match feature {
        Feature::JointAxes => vec![
            unitless(
                "axes",
                choice(&super::ReactionAxes::WORDS),
                "global axes, or those of the joint frame fixed in base or tip",
            )
            .or_word("ground"),
        ],
        Feature::AngleAxis => vec![required(
            "axis",
            Shape::Direction,
            "",
            "axis at the start, global axes; it is fixed in `relative_to`",
        )],
        Feature::Station => {
            let words = "fraction of the length of the beam along which the load acts, at one of its nodes; default the whole load";
            vec![unitless("station", Shape::Between(0.0, 1.0), words)]
        }
        Feature::Unit => vec![unitless(
            "unit",
            Shape::Text,
            "unit of its values, such as \"kN\", for plots and tables; default none",
        )],
        Feature::Fatigue => vec![
            unitless(
                "woehler_exponent",
                Shape::Positive,
                "exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component",
            ),
            unitless(
                "reference_cycles",
                Shape::Positive,
                "number of cycles of the damage equivalent range; default one per second of the run",
            ),
        ],
        Feature::Observer => {
            let words = "body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground";
            vec![unitless("relative_to", Shape::Node, words)]
        }
        Feature::Axes => {
            let words = "body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`";
            vec![unitless("in", Shape::Node, words)]
        }
        Feature::Point => {
            vec![optional(
                "point",
                Shape::Place,
                "m",
                "position at the start of a point fixed to the node, global axes; default: the node",
            )]
        }
        Feature::Velocities | Feature::Accelerations | Feature::InternalForces | Feature::Accumulated => {
            Vec::new()
        }
    }
}
