//! Faces of surfaces as they are painted: with the colours of parts or of a field, and shells divided so that they look round.

use lissom_model::output::Shade;
use lissom_model::scene::Scene;
use lissom_motion::{Motion as Pose, Vector3};

use super::field::{Field, ShellField};
use super::painter::shade_of;
use crate::pictures::geometry::{Mesh, Normals, Piece, at_rest};

/// Number of faces of shells in a picture up to which elements are divided, and maximum number of parts of their sides.
const FACES: usize = 6000;
const MOST_PARTS: usize = 4;
/// Angle [4°] between the normals of a part.
const ANGLE: f64 = 0.07;

/// Look of a face: its colour, and the normal by which it is shaded.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub(super) shade: Shade,
    pub(super) normal: Vector3,
}

/// How the surfaces of a picture are painted.
#[derive(Default)]
pub struct Paint {
    field: Option<ShellField>,
    /// Maximum number of parts of the sides of an element.
    parts: usize,
}

impl Paint {
    /// For poses of the nodes at several instants, with a field or the colours of parts.
    pub fn new(field: Option<Field>, scene: &Scene, instants: &[Vec<Pose>]) -> Self {
        let count = instants.len()
            * (scene.shells.iter().map(|shell| shell.elements.len()).sum::<usize>()
                + scene.elastic_solids.iter().map(|solid| solid.elements.len()).sum::<usize>());
        let parts = (1..=MOST_PARTS).rev().find(|parts| parts * parts * count <= FACES).unwrap_or(1);
        Self { field: field.map(|field| ShellField::new(field, scene, instants)), parts }
    }

    /// The field with its largest value, if there is one.
    pub(super) fn scale(&self) -> Option<(Field, f64)> {
        self.field.as_ref().map(|own| (own.field, own.most))
    }

    /// Colours of the faces of a piece with this surface at poses of the nodes.
    pub(super) fn shades(&self, piece: &Piece, mesh: &Mesh, poses: &[Pose]) -> Vec<Shade> {
        let shade = self.shade_at(piece, poses);
        (0..mesh.faces.len()).map(|face| shade(face, (0.0, 0.0))).collect()
    }

    /// The colour of a piece at r, s ∈ [-1, 1] of a face.
    fn shade_at(&self, piece: &Piece, poses: &[Pose]) -> impl Fn(usize, (f64, f64)) -> Shade {
        let field =
            self.field.as_ref().and_then(|field| Some((field, field.part_of(piece, &at_rest(poses))?)));
        let plain = shade_of(piece.colour);
        move |face, place| {
            let of_field = field.as_ref().and_then(|(own, part)| own.shade(part, face, place));
            of_field.unwrap_or(plain)
        }
    }

    /// The surface of a piece that is at `mesh`, with the looks of its faces; those of shells are divided where they are curved.
    pub(super) fn surface(&self, piece: &Piece, mesh: &Mesh, poses: &[Pose]) -> (Mesh, Vec<Look>) {
        let shade = self.shade_at(piece, poses);
        let normals = Normals::of(mesh);
        let (mut divided, mut looks) = (Mesh { is_open: mesh.is_open, ..Mesh::default() }, Vec::new());
        let is_coloured = self.field.is_some();
        for (index, face) in mesh.faces.iter().enumerate() {
            let Some(own) = normals.face(index) else { continue };
            let &[a, b, c, d] = face.as_slice() else { continue };
            let corners = [a, b, c, d].map(|point| mesh.points[point as usize]);
            let round = [a, b, c, d].map(|point| normals.at(point, &own));
            let angle = round.iter().map(|normal| normal.angle(&own)).fold(0.0, f64::max);
            let parts = if is_coloured { MOST_PARTS } else { (2.0 * angle / ANGLE).ceil() as usize };
            let parts = parts.min(self.parts).max(1);
            let half = 1.0 / parts as f64;
            for (r, s) in places(parts) {
                let first = divided.points.len() as u32;
                let around = [(-half, -half), (half, -half), (half, half), (-half, half)];
                divided.points.extend(around.map(|(x, y)| between(&corners, (r + x, s + y))));
                divided.faces.push((first..first + 4).collect());
                let normal = between(&round, (r, s)).try_normalize(0.0).unwrap_or(own);
                looks.push(Look { shade: shade(index, (r, s)), normal });
            }
        }
        (divided, looks)
    }
}

/// r, s ∈ [-1, 1] of the centres of the parts of an element whose sides have so many parts.
fn places(parts: usize) -> impl Iterator<Item = (f64, f64)> {
    let at = move |k: usize| (2 * k + 1) as f64 / parts as f64 - 1.0;
    (0..parts * parts).map(move |k| (at(k % parts), at(k / parts)))
}

/// The bilinear vector at r, s ∈ [-1, 1] between those of four corners.
pub(super) fn between([a, b, c, d]: &[Vector3; 4], (r, s): (f64, f64)) -> Vector3 {
    0.25 * ((1.0 - r) * ((1.0 - s) * a + (1.0 + s) * d) + (1.0 + r) * ((1.0 - s) * b + (1.0 + s) * c))
}
