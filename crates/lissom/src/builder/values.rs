//! Values of entries: nodes, positions, masses, matrices.

use super::entries::sections::SliceMass;
use super::written::{Fields, NameOf, Written};
use crate::ids::{
    AnyId, BeamId, BodyId, ContactId, FluidId, HydraulicId, InputId, JointId, LocalLoadId, MaterialId, Part,
    PointMassId, Quantity, SectionId, SpringId, SuperelementId,
};

/// A node: the ground, a body, a point mass, or a position along a beam; for contacts also a whole beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node(pub(crate) Option<(AnyId, At)>);

/// A location on a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum At {
    Itself,
    Start,
    End,
    Fraction(f64),
    Interface(&'static str),
}

/// The fixed frame.
pub const GROUND: Node = Node(None);

impl BeamId {
    /// The beam's first node.
    pub fn start(self) -> Node {
        Node(Some((self.0, At::Start)))
    }

    /// The beam's last node.
    pub fn end(self) -> Node {
        Node(Some((self.0, At::End)))
    }

    /// The node at a fraction of the beam, from 0 to 1.
    pub fn at(self, fraction: f64) -> Node {
        Node(Some((self.0, At::Fraction(fraction))))
    }
}

impl SuperelementId {
    /// The node of the interface of this name.
    pub fn interface(self, name: &'static str) -> Node {
        Node(Some((self.0, At::Interface(name))))
    }
}

impl From<BodyId> for Node {
    fn from(body: BodyId) -> Self {
        Self(Some((body.0, At::Itself)))
    }
}

/// A whole beam, for contacts alone.
impl From<BeamId> for Node {
    fn from(beam: BeamId) -> Self {
        Self(Some((beam.0, At::Itself)))
    }
}

impl From<PointMassId> for Node {
    fn from(mass: PointMassId) -> Self {
        Self(Some((mass.0, At::Itself)))
    }
}

impl From<Node> for Written {
    fn from(node: Node) -> Self {
        Self::Node(node)
    }
}

/// A position [m], or a node of another part, which is then shared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PositionOrNode {
    /// Three coordinates [m].
    Point([f64; 3]),
    /// A node.
    Node(Node),
}

impl From<[f64; 3]> for PositionOrNode {
    fn from(point: [f64; 3]) -> Self {
        Self::Point(point)
    }
}

impl From<Node> for PositionOrNode {
    fn from(node: Node) -> Self {
        Self::Node(node)
    }
}

impl From<BodyId> for PositionOrNode {
    fn from(body: BodyId) -> Self {
        Self::Node(body.into())
    }
}

impl From<PositionOrNode> for Written {
    fn from(place: PositionOrNode) -> Self {
        match place {
            PositionOrNode::Point(point) => point.into(),
            PositionOrNode::Node(node) => node.into(),
        }
    }
}

/// One of several positions: its node, and its initial location.
impl From<(Node, PositionOrNode)> for Written {
    fn from((on, at): (Node, PositionOrNode)) -> Self {
        let mut fields = Fields::default();
        fields.set("on", on);
        fields.set("at", at);
        Self::Fields(fields)
    }
}

/// An interface of a superelement: its name and its position in the axes of the part [m].
impl From<(String, [f64; 3])> for Written {
    fn from((name, at): (String, [f64; 3])) -> Self {
        let mut fields = Fields::default();
        fields.set("name", name);
        fields.set("at", at);
        Self::Fields(fields)
    }
}

macro_rules! written_names {
    ($($id:ident)*) => {
        $(impl From<$id> for Written {
            fn from(id: $id) -> Self {
                Self::Name(NameOf(id.0))
            }
        })*
    };
}

written_names! { MaterialId SectionId FluidId HydraulicId JointId SpringId ContactId LocalLoadId InputId BeamId SuperelementId Part Quantity }

/// The mass of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mass {
    /// A number [kg].
    Given(f64),
    /// Mass per volume [kg/m³] of the solid that gives the inertia.
    Density(f64),
}

impl From<f64> for Mass {
    fn from(mass: f64) -> Self {
        Self::Given(mass)
    }
}

impl From<Mass> for Written {
    fn from(mass: Mass) -> Self {
        match mass {
            Mass::Given(mass) => mass.into(),
            Mass::Density(density) => {
                let mut fields = Fields::default();
                fields.set("density", density);
                fields.into()
            }
        }
    }
}

/// The inertia of a body about its centre of mass, in body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Inertia {
    /// Principal moments [kg m²].
    Principal([f64; 3]),
    /// A symmetric matrix [kg m²].
    Matrix([[f64; 3]; 3]),
    /// That of a box with these sides along the body axes [m].
    Box([f64; 3]),
    /// That of a cylinder about the z axis: radius and length [m].
    Cylinder([f64; 2]),
    /// That of a tube about the z axis: outer radius, inner radius and length [m].
    Tube([f64; 3]),
    /// That of a sphere of this radius [m].
    Sphere(f64),
}

impl From<[f64; 3]> for Inertia {
    fn from(principal: [f64; 3]) -> Self {
        Self::Principal(principal)
    }
}

impl From<[[f64; 3]; 3]> for Inertia {
    fn from(matrix: [[f64; 3]; 3]) -> Self {
        Self::Matrix(matrix)
    }
}

impl From<Inertia> for Written {
    fn from(inertia: Inertia) -> Self {
        let mut fields = Fields::default();
        match inertia {
            Inertia::Principal(moments) => return moments.into(),
            Inertia::Matrix(matrix) => return matrix.into(),
            Inertia::Box(sides) => fields.set("box", sides),
            Inertia::Cylinder(sizes) => fields.set("cylinder", sizes),
            Inertia::Tube(sizes) => fields.set("tube", sizes),
            Inertia::Sphere(radius) => fields.set("sphere", radius),
        }
        fields.into()
    }
}

/// A solid about the centre of mass, in body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Solid {
    /// A box with these sides along the body axes [m].
    Box([f64; 3]),
    /// A cylinder about the z axis: radius and length [m].
    Cylinder([f64; 2]),
    /// A tube about the z axis: outer radius, inner radius and length [m].
    Tube([f64; 3]),
    /// A sphere of this radius [m].
    Sphere(f64),
}

impl From<Solid> for Written {
    fn from(solid: Solid) -> Self {
        let mut fields = Fields::default();
        match solid {
            Solid::Box(sides) => fields.set("box", sides),
            Solid::Cylinder(sizes) => fields.set("cylinder", sizes),
            Solid::Tube(sizes) => fields.set("tube", sizes),
            Solid::Sphere(radius) => fields.set("sphere", radius),
        }
        fields.into()
    }
}

/// A 6 x 6 matrix, or its diagonal.
#[derive(Clone, Debug, PartialEq)]
pub enum Matrix {
    /// Diagonal of the matrix.
    Diagonal([f64; 6]),
    /// The full matrix.
    Full(Box<[[f64; 6]; 6]>),
}

impl From<[f64; 6]> for Matrix {
    fn from(diagonal: [f64; 6]) -> Self {
        Self::Diagonal(diagonal)
    }
}

impl From<[[f64; 6]; 6]> for Matrix {
    fn from(matrix: [[f64; 6]; 6]) -> Self {
        Self::Full(Box::new(matrix))
    }
}

impl From<Matrix> for Written {
    fn from(matrix: Matrix) -> Self {
        match matrix {
            Matrix::Diagonal(diagonal) => diagonal.into(),
            Matrix::Full(rows) => (*rows).into(),
        }
    }
}

/// The mass of a section per length of the beam.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionMass(Written);

impl From<[f64; 6]> for SectionMass {
    fn from(diagonal: [f64; 6]) -> Self {
        Self(diagonal.into())
    }
}

impl From<[[f64; 6]; 6]> for SectionMass {
    fn from(matrix: [[f64; 6]; 6]) -> Self {
        Self(matrix.into())
    }
}

impl From<SliceMass> for SectionMass {
    fn from(mass: SliceMass) -> Self {
        Self(mass.into())
    }
}

impl From<SectionMass> for Written {
    fn from(mass: SectionMass) -> Self {
        mass.0
    }
}

/// The shear coefficients of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shear {
    /// One value for both directions.
    Both(f64),
    /// Along axes 2 and 3.
    Each([f64; 2]),
    /// By Cowper's theory.
    Cowper,
    /// By Renton's theory.
    Renton,
}

impl From<f64> for Shear {
    fn from(coefficient: f64) -> Self {
        Self::Both(coefficient)
    }
}

impl From<[f64; 2]> for Shear {
    fn from(coefficients: [f64; 2]) -> Self {
        Self::Each(coefficients)
    }
}

impl From<Shear> for Written {
    fn from(shear: Shear) -> Self {
        match shear {
            Shear::Both(coefficient) => coefficient.into(),
            Shear::Each(coefficients) => coefficients.into(),
            Shear::Cowper => "cowper".to_owned().into(),
            Shear::Renton => "renton".to_owned().into(),
        }
    }
}
