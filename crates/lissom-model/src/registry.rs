//! The kinds of joints, springs and loads, and the schemes and solvers, that a model file may name.
//! The tables are an input of the decoder, so that this crate is independent of mechanics.

use lissom_core::kinematics::Quantity;
use lissom_core::registry::Parameter;

/// Frame that a joint between two nodes requires in addition to its location.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameRule {
    /// No direction matters.
    None,
    /// One direction: `axis`.
    Axis,
    /// Two directions: `axis` and `second_axis`, perpendicular or made so.
    TwoAxes,
    /// Two directions, or none of both: then global x and y.
    GivenOrGlobal,
}

/// Attachment of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActsOn {
    /// Nodes `base` and `tip` at one location `at`.
    TwoNodes(FrameRule),
    /// Nodes `base` and `tip`, each at its own location `at_base`, `at_tip`.
    TwoPlaces,
    /// One node `on` at location `at`.
    OneNode,
    /// Positions one after the other: `along`, a list of nodes `on` and locations `at`.
    Places,
    /// A relative coordinate of `joint`: a rotation or a displacement.
    JointCoordinate(Quantity),
    /// A relative coordinate of `joint` and one of `other`.
    TwoJointCoordinates,
    /// The relative coordinates that an expression names.
    NamedCoordinates,
    /// Several relative coordinates: `coordinates`.
    Coordinates,
    /// Beams one after the other, `beams`, and a node `tip` at location `at`.
    AlongBeams,
    /// Nothing: it defines its own coordinates.
    Nothing,
}

/// One kind of joint, spring or load.
#[derive(Clone, Copy, Debug)]
pub struct KindEntry {
    /// Word in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// A minimal entry of a model file, without its heading.
    pub sample: &'static str,
    /// Parameters in addition to those that `acts_on` requires.
    pub parameters: &'static [Parameter],
    /// Its attachment.
    pub acts_on: ActsOn,
}

/// One scheme or solver.
#[derive(Clone, Copy, Debug)]
pub struct ChoiceEntry {
    /// Word in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Its parameters in the table `[analysis]`.
    pub parameters: &'static [Parameter],
    /// Its default `tolerance` of Newton's iterations, if different from that of other schemes.
    pub tolerance: Option<f64>,
}

/// All the tables.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    /// Kinds of `[joints.*]`.
    pub joints: Vec<KindEntry>,
    /// Kinds of `[springs.*]`.
    pub springs: Vec<KindEntry>,
    /// Kinds of `[loads.*]`.
    pub loads: Vec<KindEntry>,
    /// Words for `analysis.scheme`; the first is the default.
    pub schemes: Vec<ChoiceEntry>,
    /// Words for `analysis.solver`; the first is the default.
    pub solvers: Vec<ChoiceEntry>,
}
