//! Parts of forms with which they touch others.

use std::f64::consts::TAU;
use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3};

use super::{Form, Solid};
use crate::geometry::curves::{Curve, Segment};
use crate::geometry::gap::Pair;
use crate::geometry::pairs::{CurveOnSurface, EllipsoidsOnSurface, PointOnSurface};
use crate::geometry::surfaces::{Mesh, MeshError, Surface};

/// Radius of edges and rims where both solids have some, of the shortest side: edges that cross then have a direction
/// between them, and faces of one width, flush with each other, touch.
const EDGE_ROUNDING: f64 = 0.02;

/// Number of points on which an end of a cylinder stands.
const STANDS: usize = 8;
/// Their radius, of that of the cylinder: on its rim they would touch where it rolls.
const STAND_RADIUS: f64 = 0.95;

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
    /// Edges of a box or a hull.
    Edges,
    /// Rims of a cylinder.
    Rims,
    /// Rims and crowned side of a cylinder.
    Round,
    /// Points on the ends of a cylinder, which do not travel along its rims.
    Stands,
    /// A smooth outline.
    Curve,
    /// An ellipsoid.
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
            Self::Round => "side and rims",
            Self::Stands => "points of both ends",
            Self::Curve => "curve",
        }
    }
}

/// Radius of the edges or rims of a form where both solids have some [m]; zero for forms without, and of tubes.
pub(super) fn edge_rounding(form: &Form) -> f64 {
    match form {
        Form::Solid(Solid::Box(sides)) => EDGE_ROUNDING * sides.iter().copied().fold(f64::INFINITY, f64::min),
        Form::Solid(Solid::Tube { outer, inner: 0.0, length, .. }) => EDGE_ROUNDING * length.min(2.0 * outer),
        Form::Hull(mesh) => EDGE_ROUNDING * 2.0 * mesh.depth(),
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
        Arc::new(PointOnSurface { rounding: radius, surface: surface.clone() })
    };
    let line = |curve: Arc<dyn Curve>, radius: f64| -> Arc<dyn Pair> {
        Arc::new(CurveOnSurface { curve, rounding: radius, surface: surface.clone() })
    };
    let sum = |semi_axes, (radius, depth): (f64, f64)| -> Arc<dyn Pair> {
        Arc::new(EllipsoidsOnSurface { semi_axes, rounding: radius, depth, surface: surface.clone() })
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
        (Parts::Edges, Form::Hull(mesh)) => {
            let edge = |[from, to]: [Vector3; 2]| {
                let half = 0.5 * (to - from);
                (line(Arc::new(Segment::new(half.norm())), round), aligned(0.5 * (from + to), half))
            };
            mesh.edges(round).into_iter().map(edge).collect()
        }
        (Parts::Rims | Parts::Round, Form::Solid(Solid::Tube { outer, length, .. })) => {
            let radius = outer - round;
            let rim = EllipsoidsOnSurface::rim(radius);
            let half = (0.5 * length - round - rim[2]).max(0.0);
            let rim = sum(vec![rim], (round, 2.0 * outer));
            let mut all: Vec<Touching> = [-1.0, 1.0].map(|side| (rim.clone(), along(side * half))).into();
            if parts == Parts::Round && half > 0.0 {
                let side = EllipsoidsOnSurface::side(radius, half);
                all.push((sum(side, (round, 2.0 * outer)), Motion::IDENTITY));
            }
            all
        }
        (Parts::Stands, Form::Solid(Solid::Tube { inner, outer, length, .. })) => {
            let radius = (STAND_RADIUS * outer).max(0.5 * (inner + outer)) - round;
            let point = |index: usize| {
                let (sine, cosine) = (TAU * (index / 2) as f64 / STANDS as f64).sin_cos();
                let height = signed(index, 0.5 * length - round);
                (ball(round), Motion::translation(Vector3::new(radius * cosine, radius * sine, height)))
            };
            (0..2 * STANDS).map(point).collect()
        }
        (Parts::Curve, Form::Outline(outline)) => one(line(Arc::new(outline.curve().clone()), 0.0)),
        (Parts::Whole, Form::Solid(Solid::Ellipsoid(axes))) => {
            one(sum(vec![*axes], (0.0, 2.0 * axes.iter().copied().fold(f64::INFINITY, f64::min))))
        }
        _ => Vec::new(),
    })
}

/// Axes at a position, the third of which is along a direction.
fn aligned(position: Vector3, direction: Vector3) -> Motion {
    let along = direction.normalize() * 1.0_f64.copysign(direction.z);
    let axis = Vector3::z().cross(&along);
    let turn = axis.try_normalize(0.0).unwrap_or_default() * axis.norm().atan2(along.z);
    Motion::new(Rotation::exponential(&turn), position)
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
