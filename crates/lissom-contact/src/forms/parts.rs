//! Parts of forms with which they touch others.

use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3};

use super::{Form, Solid};
use crate::geometry::curves::{Curve, Segment};
use crate::geometry::gap::Pair;
use crate::geometry::pairs::{CurveOnSurface, EllipsoidOnPlane, PointOnSurface, RimOnPlane};
use crate::geometry::surfaces::{Mesh, MeshError};

/// Radius of the edges of boxes and outlines where both solids have edges, of the shortest side: edges that cross then have a direction
/// between them, and faces of one width, flush with each other, touch.
const EDGE_ROUNDING: f64 = 0.02;

/// Parts of a tip that touch a base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parts {
    /// The centre of a sphere or of a roller.
    Middle,
    /// Centres of the ends of a capsule.
    Ends,
    /// Axis of a capsule.
    Axis,
    /// Corners of a box, a hull or an outline; of a mesh those of its hull.
    Corners,
    /// Edges of a box.
    Edges,
    /// Rims of a cylinder.
    Rims,
    /// A smooth outline.
    Curve,
    /// An ellipsoid, on a plane.
    Whole,
}

impl Parts {
    /// In words.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Middle | Self::Axis | Self::Whole => "yes",
            Self::Ends => "both ends",
            Self::Corners => "corners",
            Self::Edges => "edges",
            Self::Rims => "both rims",
            Self::Curve => "curve",
        }
    }
}

/// Radius of the edges of a box or an outline where both solids have edges [m]; zero for other forms.
pub(super) fn edge_rounding(form: &Form) -> f64 {
    match form {
        Form::Solid(Solid::Box(sides)) => EDGE_ROUNDING * sides.iter().copied().fold(f64::INFINITY, f64::min),
        Form::Polygon(polygon) => EDGE_ROUNDING * polygon.shortest_side(),
        _ => 0.0,
    }
}

/// The pair of a base and of a part of a tip, and the location of the part in the axes of the tip.
type Touching = (Arc<dyn Pair>, Motion);

/// Pairs of a base and of parts of a tip. Edges of both are rounded by these radii [m].
pub(super) fn touching(
    base: &Form,
    (tip, parts): (&Form, Parts),
    [own, round]: [f64; 2],
) -> Result<Vec<Touching>, MeshError> {
    // The surface of an outline keeps its edges: those of the other one are rounded.
    let own = if matches!(base, Form::Polygon(_)) { 0.0 } else { own };
    let Some(surface) = base.surface(own)? else { return Ok(Vec::new()) };
    let ball = |radius: f64| -> Arc<dyn Pair> {
        Arc::new(PointOnSurface { rounding: own + radius, surface: surface.clone() })
    };
    let line = |curve: Arc<dyn Curve>, radius: f64| -> Arc<dyn Pair> {
        Arc::new(CurveOnSurface { curve, rounding: own + radius, surface: surface.clone() })
    };
    let along = |height: f64| Motion::translation(height * Vector3::z());
    let one = |pair: Arc<dyn Pair>| vec![(pair, Motion::IDENTITY)];
    Ok(match (parts, tip) {
        (Parts::Middle, Form::Solid(Solid::Sphere(radius) | Solid::Tube { outer: radius, .. })) => {
            one(ball(*radius))
        }
        (Parts::Ends, Form::Solid(Solid::Capsule { radius, length, .. })) => {
            [-0.5, 0.5].map(|side| (ball(*radius), along(side * length))).into()
        }
        (Parts::Axis, Form::Solid(Solid::Capsule { radius, length, .. })) => {
            one(line(Arc::new(Segment::new(0.5 * length)), *radius))
        }
        (Parts::Corners, _) => {
            let all = corners(tip, round)?.into_iter();
            all.map(|(place, radius)| (ball(radius), Motion::translation(place))).collect()
        }
        (Parts::Edges, Form::Solid(Solid::Box(sides))) => {
            edges(sides, round).map(|(edge, frame)| (line(Arc::new(edge), round), frame)).collect()
        }
        (Parts::Rims, Form::Solid(Solid::Tube { outer, length, .. })) => {
            let rim: Arc<dyn Pair> = Arc::new(RimOnPlane { radius: *outer, rounding: 0.0 });
            let half = (0.5 * length - RimOnPlane::inset(*outer)).max(0.0);
            [-1.0, 1.0].map(|side| (rim.clone(), along(side * half))).into()
        }
        (Parts::Curve, Form::Outline(outline)) => one(line(Arc::new(outline.curve().clone()), 0.0)),
        (Parts::Whole, Form::Solid(Solid::Ellipsoid(axes))) => {
            one(Arc::new(EllipsoidOnPlane { semi_axes: *axes }))
        }
        _ => Vec::new(),
    })
}

/// The corners of a form with their radii, at most `inset` [m], by which the faces of boxes and outlines are moved inwards.
fn corners(form: &Form, inset: f64) -> Result<Vec<(Vector3, f64)>, MeshError> {
    let sharp = |place: Vector3| (place, 0.0);
    Ok(match form {
        Form::Solid(Solid::Box(sides)) => {
            let place = |bit: usize| Vector3::from_fn(|k, _| signed(bit >> k, 0.5 * sides[k] - inset));
            (0..8).map(|bit| (place(bit), inset)).collect()
        }
        Form::Hull(mesh) => mesh.corners().map(sharp).collect(),
        Form::Mesh(own) => Mesh::hull(&own.points)?.corners().map(sharp).collect(),
        Form::Polygon(polygon) => {
            polygon.round_corners(inset).map(|(own, radius)| (own.push(0.0), radius)).collect()
        }
        _ => Vec::new(),
    })
}

/// The twelve edges of such a box.
fn edges(sides: &[f64; 3], inset: f64) -> impl Iterator<Item = (Segment, Motion)> {
    let half = sides.map(|side| 0.5 * side - inset);
    let quarter = std::f64::consts::FRAC_PI_2;
    // Rotations of the third axis to each of the three.
    let turns = [quarter * Vector3::y(), -quarter * Vector3::x(), Vector3::zeros()];
    let of = move |axis: usize, bit: usize| {
        let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
        let mut place = Vector3::zeros();
        (place[next], place[last]) = (signed(bit, half[next]), signed(bit >> 1, half[last]));
        (Segment::new(half[axis]), Motion::new(Rotation::exponential(&turns[axis]), place))
    };
    (0..12).map(move |index| of(index / 4, index % 4))
}

/// A length with the sign of a bit.
fn signed(bit: usize, length: f64) -> f64 {
    if bit & 1 == 1 { length } else { -length }
}
