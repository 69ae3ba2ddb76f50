//! Forms of bodies that touch, and their surfaces.

use std::sync::Arc;

use lissom_motion::{Motion, Vector3};

use super::Solid;
use crate::geometry::surfaces::{
    Cuboid, HalfSpace, HeightField, Mesh, MeshError, Outline, Polygon, Ring, Rod, Rounded, Surface,
};

/// Points of a beam may be this far apart over the radius of what they touch: 30°.
const MAX_ANGLE: f64 = 0.5;

/// What touches.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A solid about its centre.
    Solid(Solid),
    /// Everything below the plane z = 0.
    HalfSpace,
    /// A prism along the third axis with a smooth outline.
    Outline(Arc<Outline>),
    /// A prism along the third axis with straight sides.
    Polygon(Arc<Polygon>),
    /// A convex polyhedron.
    Hull(Arc<Mesh>),
    /// Everything below a surface.
    HeightField(Arc<HeightField>),
    /// Triangles that may enclose a solid.
    Mesh(Arc<Triangles>),
}

/// Triangles of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangles {
    /// Their corners [m].
    pub points: Vec<Vector3>,
    /// Indices of the corners of each.
    pub triangles: Vec<[u32; 3]>,
}

/// A form at its position in a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedSolid {
    /// Form of the solid.
    pub form: Form,
    /// Axes of the solid in those of the part; the third is the axis of a round one and the normal of a plane.
    pub frame: Motion,
}

/// The kinds of forms with their words: a macro, so that none is missing among `ALL`.
macro_rules! kinds {
    ($($kind:ident $words:literal)*) => {
        /// Kinds of forms.
        #[expect(missing_docs, reason = "their words are those of messages")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum FormKind { $($kind),* }

        impl FormKind {
            /// All kinds.
            pub const ALL: &[Self] = &[$(Self::$kind),*];

            /// In words.
            pub fn words(self) -> &'static str {
                match self { $(Self::$kind => $words),* }
            }
        }
    };
}

kinds! {
    Plane "a plane" Sphere "a sphere" Capsule "a capsule" Cylinder "a cylinder" Tube "a tube" Box "a box" Hull "a hull"
    Polygon "an outline" Outline "a smooth outline" Ellipsoid "an ellipsoid" Mesh "a mesh" HeightField "a height field"
}

impl Form {
    /// Kind of the form.
    pub fn kind(&self) -> FormKind {
        match self {
            Self::Solid(Solid::Box(_)) => FormKind::Box,
            Self::Solid(Solid::Tube { inner, .. }) if *inner > 0.0 => FormKind::Tube,
            Self::Solid(Solid::Tube { .. }) => FormKind::Cylinder,
            Self::Solid(Solid::Sphere(_)) => FormKind::Sphere,
            Self::Solid(Solid::Capsule { .. }) => FormKind::Capsule,
            Self::Solid(Solid::Ellipsoid(_)) => FormKind::Ellipsoid,
            Self::HalfSpace => FormKind::Plane,
            Self::Outline(_) => FormKind::Outline,
            Self::Polygon(_) => FormKind::Polygon,
            Self::Hull(_) => FormKind::Hull,
            Self::HeightField(_) => FormKind::HeightField,
            Self::Mesh(_) => FormKind::Mesh,
        }
    }

    /// Surface of the form, for a box, a hull or a cylinder with edges of this radius [m]; none where the distance from it is not known.
    ///
    /// # Errors
    /// If it is a mesh that encloses no solid.
    pub fn surface(&self, rounding: f64) -> Result<Option<Arc<dyn Surface>>, MeshError> {
        let found: Arc<dyn Surface> = match self {
            Self::HalfSpace => Arc::new(HalfSpace),
            Self::Solid(Solid::Box(sides)) => {
                Arc::new(Cuboid { half_sides: sides.map(|side| 0.5 * side - rounding) })
            }
            Self::Solid(Solid::Tube { outer, inner, length, .. }) => {
                Arc::new(Ring { radii: [*inner, *outer - rounding], half_length: 0.5 * length - rounding })
            }
            Self::Solid(_) => return Ok(self.rod().map(|rod| -> Arc<dyn Surface> { Arc::new(rod) })),
            Self::Outline(outline) => outline.clone(),
            Self::Polygon(polygon) => polygon.clone(),
            Self::Hull(mesh) if rounding > 0.0 => Arc::new(mesh.inset(rounding)?),
            Self::Hull(mesh) => mesh.clone(),
            Self::HeightField(field) => field.clone(),
            Self::Mesh(own) => Arc::new(Mesh::new(&own.points, &own.triangles)?),
        };
        let is_rounded =
            rounding > 0.0 && matches!(self, Self::Hull(_) | Self::Solid(Solid::Box(_) | Solid::Tube { .. }));
        Ok(Some(if is_rounded { Arc::new(Rounded { inner: found, radius: rounding }) } else { found }))
    }

    /// A sphere or a capsule as a rod along the third axis.
    pub fn rod(&self) -> Option<Rod> {
        match self {
            Self::Solid(Solid::Sphere(radius)) => Some(Rod { half_length: 0.0, radius: *radius }),
            Self::Solid(Solid::Capsule { radius, length, .. }) => {
                Some(Rod { half_length: 0.5 * length, radius: *radius })
            }
            _ => None,
        }
    }

    /// Radius of a sphere about its origin that contains it [m]; infinite for a plane, a prism or a height field.
    pub fn radius(&self) -> f64 {
        let farthest =
            |points: &mut dyn Iterator<Item = Vector3>| points.map(|point| point.norm()).fold(0.0, f64::max);
        match self {
            Self::Solid(solid) => match solid {
                Solid::Box(sides) => 0.5 * Vector3::from(*sides).norm(),
                Solid::Tube { outer, length, .. } => outer.hypot(0.5 * length),
                Solid::Sphere(radius) => *radius,
                Solid::Capsule { radius, length, .. } => radius + 0.5 * length,
                Solid::Ellipsoid(axes) => axes.iter().copied().fold(0.0, f64::max),
            },
            Self::Hull(mesh) => farthest(&mut mesh.corners()),
            Self::Mesh(own) => farthest(&mut own.points.iter().copied()),
            Self::HalfSpace | Self::Outline(_) | Self::Polygon(_) | Self::HeightField(_) => f64::INFINITY,
        }
    }

    /// Curvature of a sphere or a plane [1/m].
    pub fn curvature(&self) -> Option<f64> {
        match self {
            Self::Solid(Solid::Sphere(radius)) => Some(1.0 / *radius),
            Self::HalfSpace => Some(0.0),
            _ => None,
        }
    }

    /// Largest distance between points of a beam of a radius between which it does not pass [m]; none if no beam can touch it.
    pub fn spacing(&self, radius: f64) -> Option<f64> {
        match self {
            Self::HalfSpace => Some(f64::INFINITY),
            Self::Solid(Solid::Sphere(own) | Solid::Capsule { radius: own, .. }) => {
                Some(spacing_of_rounds(own + radius))
            }
            Self::Solid(Solid::Tube { outer, inner, length, .. }) => {
                let round = if *inner > 0.0 { *inner } else { outer + radius };
                Some(spacing_of_rounds(round).min(0.5 * length + radius))
            }
            Self::Solid(Solid::Box(sides)) => {
                Some(0.5 * sides.iter().copied().fold(f64::INFINITY, f64::min) + radius)
            }
            _ => None,
        }
    }
}

/// Spacing for a round form, by the sum of both radii or the radius of the bore.
pub fn spacing_of_rounds(radius: f64) -> f64 {
    MAX_ANGLE * radius
}
