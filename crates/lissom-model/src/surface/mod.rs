//! Surfaces of bodies as they are drawn: triangles, from solids or from files (`stl`, `gltf`).

mod gltf;
mod stl;

use std::collections::HashMap;

use lissom_contact::forms::{Form, Solid};
use lissom_contact::geometry::curves::Curve;
use lissom_drawing::Shade;
use lissom_motion::{Motion, Vector3};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// The corners of a triangle.
type Triangle = [[f32; 3]; 3];

/// Number of sides of balls and of round ends.
const ROUND: usize = 40;
/// Number of sides of cylinders and tubes, which are often larger in a picture and have few triangles.
const SIDES: usize = 64;
/// Most triangles of a file.
const MAX_TRIANGLES: usize = 500_000;

/// A surface of triangles in body axes, with vertices counterclockwise as seen from outside.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Positions [m].
    pub points: Vec<[f32; 3]>,
    /// Points of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles with colours of their own, in ascending order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub colours: Vec<Painted>,
}

/// Consecutive triangles of one colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Painted {
    /// Index of the first triangle.
    pub first: u32,
    /// Number of triangles.
    pub count: u32,
    /// Red, green and blue.
    pub shade: Shade,
}

/// A file that is no surface.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// It is of no format that is known.
    #[error(
        "it is neither a glTF file nor an STL file, with as many triangles as it says or of `facet` and `vertex`"
    )]
    Foreign,
    /// It is a glTF file that cannot be drawn.
    #[error("as a glTF file, {0}")]
    Gltf(String),
    /// It has none.
    #[error("it holds no triangles")]
    Empty,
    /// There are too many.
    #[error("it holds {0} triangles, and {MAX_TRIANGLES} can be drawn")]
    TooMany(usize),
    /// A number is none.
    #[error("a corner of triangle {0} is not made of finite numbers")]
    NotFinite(usize),
}

impl Surface {
    /// That of a solid about its centre.
    pub(crate) fn of_solid(solid: &Solid, center: &Vector3) -> Self {
        match *solid {
            Solid::Box(sides) => {
                let [a, b, c] = sides.map(|side| 0.5 * side);
                let ring = [(a, b), (-a, b), (-a, -b), (a, -b)];
                let at = |z: f64| ring.map(|(x, y)| Vector3::new(x, y, z)).to_vec();
                Self::of_rings(&[at(-c), at(c)], center, true)
            }
            Solid::Tube { outer, inner, length, axis } => {
                let start = Vector3::ith((axis.iamax() + 1) % 3, 1.0);
                let across = (start - start.dot(&axis) * axis).normalize();
                let other = axis.cross(&across);
                let place = |radius: f64, height: f64, side: usize| {
                    let (sine, cosine) = (std::f64::consts::TAU * side as f64 / SIDES as f64).sin_cos();
                    radius * cosine * across + radius * sine * other + height * axis
                };
                let ring = |radius: f64, height: f64| -> Vec<Vector3> {
                    (0..SIDES).map(|side| place(radius, height, side)).collect()
                };
                let half = 0.5 * length;
                let outside = [ring(outer, -half), ring(outer, half)];
                if inner > 0.0 {
                    let [low, high] = outside;
                    Self::of_rings(
                        &[low.clone(), high, ring(inner, half), ring(inner, -half), low],
                        center,
                        false,
                    )
                } else {
                    Self::of_rings(&outside, center, true)
                }
            }
            Solid::Sphere(radius) => Self::of_rod((radius, 0.0), &Vector3::z(), center),
            Solid::Capsule { radius, length, axis } => Self::of_rod((radius, 0.5 * length), &axis, center),
            Solid::Ellipsoid(axes) => {
                let ball = Self::of_rod((1.0, 0.0), &Vector3::z(), &Vector3::zeros());
                ball.moved(&Motion::translation(*center), &Vector3::from(axes))
            }
        }
    }

    /// Surface of what is no solid about its centre; a prism has this length, and what is unbounded is not drawn.
    pub(crate) fn of_form(form: &Form, length: f64) -> Self {
        match form {
            Form::Solid(solid) => Self::of_solid(solid, &Vector3::zeros()),
            Form::HalfSpace => Self::default(),
            Form::Outline(outline) => {
                let curve = outline.curve();
                let of = |&t: &f64| {
                    [curve.at(t)[0], curve.at(t + 0.5 * curve.length() / curve.samples().len() as f64)[0]]
                };
                Self::of_prism(&curve.samples().iter().flat_map(of).collect::<Vec<_>>(), length)
            }
            Form::Polygon(polygon) => Self::of_prism(polygon.corners(), length),
            Form::Hull(mesh) => Self {
                points: mesh.corners().map(|corner| corner.cast::<f32>().into()).collect(),
                triangles: mesh.triangles().to_vec(),
                colours: Vec::new(),
            },
            Form::HeightField(field) => {
                let columns = field.columns() as u32;
                let points: Vec<[f32; 3]> = field.points().map(|point| point.cast::<f32>().into()).collect();
                let rows = points.len() as u32 / columns;
                let cells =
                    (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| row * columns + column));
                let of = |a: u32| [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]];
                Self { points, triangles: cells.flat_map(of).collect(), colours: Vec::new() }
            }
            Form::Mesh(own) => Self {
                points: own.points.iter().map(|point| point.cast::<f32>().into()).collect(),
                triangles: own.triangles.clone(),
                colours: Vec::new(),
            },
        }
    }

    /// A prism along the third axis about the origin, over an outline counterclockwise.
    fn of_prism(outline: &[Vector2<f64>], length: f64) -> Self {
        let ring = |z: f64| outline.iter().map(|p| Vector3::new(p.x, p.y, z)).collect::<Vec<_>>();
        let mut sides = Self::of_rings(&[ring(-0.5 * length), ring(0.5 * length)], &Vector3::zeros(), false);
        let count = outline.len() as u32;
        for [a, b, c] in ears(outline) {
            sides.triangles.extend([[c, b, a], [a + count, b + count, c + count]]);
        }
        sides
    }

    /// A rod with hemispherical ends, by its radius and half its length.
    fn of_rod((radius, half): (f64, f64), axis: &Vector3, center: &Vector3) -> Self {
        let start = Vector3::ith((axis.iamax() + 1) % 3, 1.0);
        let across = (start - start.dot(axis) * axis).normalize();
        let other = axis.cross(&across);
        let ring = |row: usize, shift: f64| -> Vec<Vector3> {
            let (sine, cosine) = (std::f64::consts::PI * row as f64 / (ROUND / 2) as f64).sin_cos();
            let of = |side: usize| {
                let (s, c) = (std::f64::consts::TAU * side as f64 / ROUND as f64).sin_cos();
                radius * (sine * c * across + sine * s * other - cosine * axis) + shift * axis
            };
            (0..ROUND).map(of).collect()
        };
        let lower = (0..=ROUND / 4).map(|row| ring(row, -half));
        let first_upper = if half > 0.0 { ROUND / 4 } else { ROUND / 4 + 1 };
        let rings: Vec<Vec<Vector3>> =
            lower.chain((first_upper..=ROUND / 2).map(|row| ring(row, half))).collect();
        Self::of_rings(&rings, center, true)
    }

    /// This surface stretched along its axes and placed in others. A reflection turns the order of the corners.
    pub(crate) fn moved(&self, frame: &Motion, scale: &Vector3) -> Self {
        let place = |point: &[f32; 3]| {
            let point = Vector3::from(point.map(f64::from)).component_mul(scale);
            frame.transform_point(&point).cast::<f32>().into()
        };
        let is_mirrored = scale.product() < 0.0;
        let corners = |[a, b, c]: &[u32; 3]| if is_mirrored { [*a, *c, *b] } else { [*a, *b, *c] };
        Self {
            points: self.points.iter().map(place).collect(),
            triangles: self.triangles.iter().map(corners).collect(),
            colours: self.colours.clone(),
        }
    }

    /// This surface in one colour, or in that of its part.
    pub(crate) fn painted(mut self, shade: Option<Shade>) -> Self {
        let count = self.triangles.len() as u32;
        self.colours = shade.map(|shade| Painted { first: 0, count, shade }).into_iter().collect();
        self
    }

    /// Adds another surface.
    pub(crate) fn append(&mut self, other: &Self) {
        let first = self.triangles.len() as u32;
        self.colours.extend(other.colours.iter().map(|own| Painted { first: first + own.first, ..*own }));
        let first = self.points.len() as u32;
        self.points.extend(&other.points);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
    }

    /// Rings of equally many points, each joined to the next, counterclockwise about the way from the first to the last; with
    /// lids at both ends or without.
    fn of_rings(rings: &[Vec<Vector3>], center: &Vector3, has_lids: bool) -> Self {
        let around = rings.first().map_or(0, Vec::len) as u32;
        let points = rings.iter().flatten().map(|point| (point + center).cast::<f32>().into()).collect();
        let mut triangles = Vec::new();
        for ring in 0..rings.len().saturating_sub(1) as u32 {
            for side in 0..around {
                let [a, b] = [ring * around + side, ring * around + (side + 1) % around];
                triangles.push([a, b, b + around]);
                triangles.push([a, b + around, a + around]);
            }
        }
        if has_lids {
            let last = (rings.len() as u32 - 1) * around;
            for side in 1..around - 1 {
                triangles.push([0, side + 1, side]);
                triangles.push([last, last + side, last + side + 1]);
            }
        }
        Self { points, triangles, colours: Vec::new() }
    }

    /// Reads an STL or a glTF file, which its first bytes decide; `beside` reads the buffers that a glTF file names. Corners
    /// at one place become one point.
    ///
    /// # Errors
    /// If it is none of both, has no triangles or too many, or a corner is not finite.
    pub fn of_file(
        bytes: &[u8],
        beside: &dyn Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, SurfaceError> {
        let is_gltf = bytes.starts_with(gltf::MAGIC) || bytes.trim_ascii_start().starts_with(b"{");
        let corners = if is_gltf { gltf::triangles(bytes, beside)? } else { stl::triangles(bytes)? };
        if corners.is_empty() {
            return Err(SurfaceError::Empty);
        }
        if corners.len() > MAX_TRIANGLES {
            return Err(SurfaceError::TooMany(corners.len()));
        }
        let mut surface = Self::default();
        let mut known: HashMap<[u32; 3], u32> = HashMap::new();
        for (index, triangle) in corners.iter().enumerate() {
            if !triangle.iter().flatten().all(|number| number.is_finite()) {
                return Err(SurfaceError::NotFinite(index + 1));
            }
            let points = triangle.map(|place| {
                *known.entry(place.map(f32::to_bits)).or_insert_with(|| {
                    surface.points.push(place);
                    surface.points.len() as u32 - 1
                })
            });
            surface.triangles.push(points);
        }
        Ok(surface)
    }
}

/// Triangles of a polygon, counterclockwise: its ears are cut off one after the other [Meisters 1975].
fn ears(outline: &[Vector2<f64>]) -> Vec<[u32; 3]> {
    let turn = |a: usize, b: usize, c: usize| (outline[b] - outline[a]).perp(&(outline[c] - outline[b]));
    let mut rest: Vec<usize> = (0..outline.len()).collect();
    let mut triangles = Vec::new();
    while rest.len() > 2 {
        let count = rest.len();
        let corners = |k: usize| (rest[(k + count - 1) % count], rest[k], rest[(k + 1) % count]);
        let is_ear = |&k: &usize| {
            let (a, b, c) = corners(k);
            let is_inside = |&p: &usize| {
                p != a
                    && p != b
                    && p != c
                    && turn(a, b, p) >= 0.0
                    && turn(b, c, p) >= 0.0
                    && turn(c, a, p) >= 0.0
            };
            turn(a, b, c) > 0.0 && !rest.iter().any(is_inside)
        };
        // Of an outline that crosses itself nothing is an ear: any triangle is then drawn.
        let ear = (0..count).find(is_ear).unwrap_or(0);
        let (a, b, c) = corners(ear);
        triangles.push([a, b, c].map(|corner| corner as u32));
        rest.remove(ear);
    }
    triangles
}

#[cfg(test)]
#[path = "../../tests/unit/surface/mod.rs"]
mod tests;
