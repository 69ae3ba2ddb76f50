//! Surfaces of flat faces, and the solids of symbols.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use lissom_model::scene::{Form, Solid, Surface};
use lissom_motion::{Matrix3, Motion as Pose, Rotation, Vector3};

/// Number of sides of round shapes.
const ROUND: usize = 20;

/// A surface. Faces are convex and flat or nearly so; viewed from outside their points are counterclockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions [m].
    pub points: Vec<Vector3>,
    /// Points of every face.
    pub faces: Vec<Vec<u32>>,
    /// Whether it has a border, so that both sides are visible.
    pub is_open: bool,
}

impl Mesh {
    /// Rings with equal numbers of points, each joined to the next, closed by a face at both ends. Points of a ring
    /// are counterclockwise about the direction from the first ring to the last.
    pub fn of_rings(rings: &[Vec<Vector3>]) -> Self {
        let around = rings.first().map_or(0, Vec::len) as u32;
        let points: Vec<Vector3> = rings.iter().flatten().copied().collect();
        let mut faces = vec![(0..around).rev().collect()];
        for ring in 0..(rings.len() as u32).saturating_sub(1) {
            let (here, next) = (ring * around, (ring + 1) * around);
            for side in 0..around {
                let other = (side + 1) % around;
                faces.push(vec![here + side, here + other, next + other, next + side]);
            }
        }
        let last = points.len() as u32 - around;
        faces.push((last..last + around).collect());
        Self { points, faces, is_open: false }
    }

    /// Triangles.
    pub(super) fn of_surface(surface: &Surface) -> Self {
        Self {
            points: surface.points.iter().map(|point| Vector3::from(point.map(f64::from))).collect(),
            faces: surface.triangles.iter().map(|triangle| triangle.to_vec()).collect(),
            is_open: false,
        }
    }

    /// A body of revolution about the second axis from (radius, height) pairs with ascending heights.
    fn turned(profile: &[(f64, f64)], sides: usize) -> Self {
        let point = |radius: f64, height: f64, side: usize| {
            let (sine, cosine) = (TAU * side as f64 / sides as f64).sin_cos();
            Vector3::new(radius * sine, height, radius * cosine)
        };
        let rings: Vec<Vec<Vector3>> =
            profile.iter().map(|&(r, h)| (0..sides).map(|side| point(r, h, side)).collect()).collect();
        Self::of_rings(&rings)
    }

    /// A cylinder about the second axis, its centre at the origin.
    pub fn cylinder(radius: f64, length: f64) -> Self {
        Self::turned(&[(radius, -0.5 * length), (radius, 0.5 * length)], ROUND)
    }

    /// A cone about the second axis with its apex upward.
    pub fn cone(radius: f64, length: f64) -> Self {
        Self::turned(&[(radius, -0.5 * length), (1e-3 * radius, 0.5 * length)], ROUND)
    }

    /// A four-sided frustum about the second axis, drawn below joints on the ground.
    pub fn plinth(top: f64, bottom: f64, height: f64) -> Self {
        let (top, bottom) = (top * 0.5_f64.sqrt(), bottom * 0.5_f64.sqrt());
        let ring = |half: f64, at: f64| {
            [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)]
                .map(|(x, z)| Vector3::new(half * x, at, half * z))
                .to_vec()
        };
        Self::of_rings(&[
            ring(bottom, -0.5 * height).into_iter().rev().collect(),
            ring(top, 0.5 * height).into_iter().rev().collect(),
        ])
        .outward()
    }

    /// A ball about the origin.
    pub fn ball(radius: f64) -> Self {
        let rows = 10;
        let profile: Vec<(f64, f64)> = (0..=rows)
            .map(|row| {
                let (sine, cosine) = (PI * f64::from(row) / f64::from(rows) - FRAC_PI_2).sin_cos();
                (radius * cosine.max(1e-3), radius * sine)
            })
            .collect();
        Self::turned(&profile, ROUND)
    }

    /// A box about the origin with these sides.
    pub fn block(sides: [f64; 3]) -> Self {
        let [a, b, c] = sides.map(|side| 0.5 * side);
        let ring = |y: f64| [(a, c), (a, -c), (-a, -c), (-a, c)].map(|(x, z)| Vector3::new(x, y, z)).to_vec();
        Self::of_rings(&[ring(-b), ring(b)]).outward()
    }

    /// A ring about the second axis.
    pub fn ring(radius: f64, tube: f64) -> Self {
        let (around, across) = (28, 8);
        let mut mesh = Self::default();
        for k in 0..around {
            let (s, c) = (TAU * k as f64 / around as f64).sin_cos();
            for j in 0..across {
                let (up, out) = (TAU * j as f64 / across as f64).sin_cos();
                let reach = radius + tube * out;
                mesh.points.push(Vector3::new(reach * s, tube * up, reach * c));
                let at = |k: usize, j: usize| ((k % around) * across + j % across) as u32;
                mesh.faces.push(vec![at(k, j), at(k + 1, j), at(k + 1, j + 1), at(k, j + 1)]);
            }
        }
        mesh
    }

    /// An octahedron about the origin.
    pub fn octahedron(radius: f64) -> Self {
        let points: Vec<Vector3> =
            (0..6).map(|k| Vector3::ith(k / 2, if k % 2 == 0 { radius } else { -radius })).collect();
        let mut faces = Vec::new();
        for [x, y, z] in
            [[0, 2, 4], [1, 2, 4], [0, 3, 4], [1, 3, 4], [0, 2, 5], [1, 2, 5], [0, 3, 5], [1, 3, 5]]
        {
            faces.push(vec![x, y, z]);
        }
        Self { points, faces, is_open: false }.outward()
    }

    /// A coil of unit length about the second axis from -0.5 to 0.5: `turns` turns of a wire. The wire is round if the
    /// coil is stretched to `length`.
    pub fn coil(radius: f64, wire: f64, turns: f64, length: f64) -> Self {
        let (along, across) = (160, 6);
        let ring = |k: usize| -> Vec<Vector3> {
            let t = k as f64 / along as f64;
            let body = ((t - 0.08) / 0.84).clamp(0.0, 1.0);
            let reach = radius * (14.0 * body.min(1.0 - body)).min(1.0);
            let angle = TAU * turns * body;
            let (sine, cosine) = angle.sin_cos();
            let out = Vector3::new(cosine, 0.0, sine);
            let tangent = Vector3::new(-TAU * turns * reach * sine, length, TAU * turns * reach * cosine);
            let tangent = tangent.normalize();
            let other = tangent.cross(&out);
            let centre = reach * out;
            let place = |j: usize| {
                let (s, c) = (TAU * j as f64 / across as f64).sin_cos();
                let at = centre + wire * (c * out + s * other);
                // The wire's own extent along the coil refers to the stretched length.
                Vector3::new(at[0], t - 0.5 + at[1] / length, at[2])
            };
            (0..across).map(place).collect()
        };
        Self::of_rings(&(0..=along).map(ring).collect::<Vec<_>>())
    }

    /// A solid of a symbol, drawn at a radius.
    pub fn of_solid(solid: &Solid, radius: f64) -> Self {
        let [a, b, c] = solid.size.map(|size| radius * size);
        let mesh = match solid.form {
            Form::Cylinder => Self::cylinder(a, b),
            Form::Cone => Self::cone(a, b),
            Form::Ball => Self::ball(a),
            Form::Block => Self::block([a, b, c]),
            Form::Ring => Self::ring(a, b),
            Form::Octahedron => Self::octahedron(a),
        };
        let place = radius * Vector3::from(solid.place);
        let axis = Vector3::from(solid.axis);
        let turn = solid.side.map_or_else(|| turn_to(&axis), |side| turn_of(&Vector3::from(side), &axis));
        mesh.moved(&Pose::new(turn, place))
    }

    /// Orients faces away from the origin, for a convex solid about it.
    fn outward(mut self) -> Self {
        for face in &mut self.faces {
            let [a, b, c] = [0, 1, 2].map(|k| self.points[face[k] as usize]);
            if (b - a).cross(&(c - a)).dot(&(a + b + c)) < 0.0 {
                face.reverse();
            }
        }
        self
    }

    /// Moves the mesh.
    #[must_use]
    pub fn moved(mut self, pose: &Pose) -> Self {
        for point in &mut self.points {
            *point = pose.transform_point(point);
        }
        self
    }

    /// Multiplies lengths along the axes.
    #[must_use]
    pub fn stretched(mut self, by: &Vector3) -> Self {
        for point in &mut self.points {
            *point = point.component_mul(by);
        }
        self
    }

    /// Adds the faces of another mesh.
    pub fn append(&mut self, other: Self) {
        let first = self.points.len() as u32;
        self.points.extend(other.points);
        self.faces.extend(other.faces.into_iter().map(|face| face.into_iter().map(|k| k + first).collect()));
    }

    /// A closed mesh of faces between points of this one, without the other points.
    pub(super) fn with_faces(&self, mut faces: Vec<Vec<u32>>) -> Self {
        let mut points = Vec::new();
        let mut known: Vec<Option<u32>> = vec![None; self.points.len()];
        for corner in faces.iter_mut().flatten() {
            let old = *corner as usize;
            *corner = *known[old].get_or_insert_with(|| {
                points.push(self.points[old]);
                points.len() as u32 - 1
            });
        }
        Self { points, faces, is_open: false }
    }

    /// Triangles of the mesh: faces are divided from their first points.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let fan = |face: &Vec<u32>| {
            let first = face[0];
            face[1..].windows(2).map(|pair| [first, pair[0], pair[1]]).collect::<Vec<_>>()
        };
        self.faces.iter().flat_map(fan).collect()
    }
}

/// The smallest rotation from the second axis to `direction`, a unit vector.
pub fn turn_to(direction: &Vector3) -> Rotation {
    let from = Vector3::y();
    let axis = from.cross(direction);
    let sine = axis.norm();
    let cosine = from.dot(direction);
    if sine < 1e-12 {
        return if cosine > 0.0 { Rotation::identity() } else { Rotation::about_axis(&Vector3::x(), PI) };
    }
    Rotation::about_axis(&(axis / sine), sine.atan2(cosine))
}

/// The rotation that leads from the first two axes to these perpendicular directions.
fn turn_of(first: &Vector3, second: &Vector3) -> Rotation {
    Rotation::from_matrix(&Matrix3::from_columns(&[*first, *second, first.cross(second)]))
}

#[cfg(test)]
#[path = "../../../tests/unit/pictures/geometry/mesh.rs"]
mod tests;
