//! Outputs as they are requested.

use lissom_motion::Vector3;

use super::kinds::OutputKind;
use crate::expression::Formula;
use crate::reading::node_reference::NodeReference;
use crate::sweep::Fatigue;
use crate::text::report::Located;

/// Whose quantity is recorded.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputSource {
    /// A node, at its own place or at a point [m] (place at the start) that it carries.
    Node {
        /// The node.
        node: Located<NodeReference>,
        /// The point.
        point: Option<Vector3>,
    },
    /// A joint, by name.
    Joint(Located<String>),
    /// A spring, by name.
    Spring(Located<String>),
    /// A contact, by name.
    Contact(Located<String>),
    /// A local load.
    LocalLoad(Located<String>),
    /// A spring, a load, a drive or a joint with friction, by name.
    Actor(Located<String>),
    /// A whole beam, by name.
    Beam(Located<String>),
    /// A superelement, by name.
    Superelement(Located<String>),
    /// The whole model.
    Model,
    /// A signal, an input or a state, by name.
    Signal(Located<String>),
    /// An expression.
    Expression(Located<Formula>),
}

/// Axes in which a joint's reaction is reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReactionAxes {
    /// Global ones.
    #[default]
    Ground,
    /// Axes of the joint frame that the base carries.
    Base,
    /// Axes of the joint frame that the tip carries.
    Tip,
}

impl ReactionAxes {
    /// Words in the model file.
    pub(crate) const WORDS: [&'static str; 3] = ["ground", "base", "tip"];

    pub(crate) fn named(word: &str) -> Self {
        match word {
            "base" => Self::Base,
            "tip" => Self::Tip,
            _ => Self::Ground,
        }
    }
}

/// One recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name.
    pub name: Located<String>,
    /// Quantity.
    pub kind: OutputKind,
    /// Whose.
    pub source: OutputSource,
    /// In which axes, for a reaction.
    pub axes: ReactionAxes,
    /// The node in whose axes its vectors are reported; global axes, or those of the observer, where there is none.
    pub seen_in: Option<Located<NodeReference>>,
    /// The node relative to which it is measured; the ground if there is none.
    pub relative_to: Option<Located<NodeReference>>,
    /// The axis of an angle, at the start, global axes.
    pub axis: Option<Vector3>,
    /// The fraction of the length of a beam at which it is recorded.
    pub station: Option<Located<f64>>,
    /// Unit of the output, if it is given.
    pub unit: Option<String>,
    /// The plot in which it is drawn; its own if there is none.
    pub plot: Option<String>,
    /// How the cycles of its components are counted, if they are.
    pub fatigue: Option<Fatigue>,
}
