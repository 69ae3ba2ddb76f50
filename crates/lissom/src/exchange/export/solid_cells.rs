//! Stresses and energies of solids at the faces of their surfaces, as arrays with a value for each cell of a file.

use lissom_model::scene::{ElasticSolid, Scene};
use lissom_motion::Motion as Pose;

use super::vtk::CellArray;
use crate::pictures::geometry::{Geometry, Role, SolidElements, at_rest};

/// The solids of a scene.
pub(super) struct SolidCells(Vec<(ElasticSolid, SolidElements)>);

impl SolidCells {
    pub(super) fn new(scene: &Scene) -> Self {
        Self(scene.elastic_solids.iter().map(|solid| (solid.clone(), SolidElements::new(solid))).collect())
    }

    /// The arrays at poses of the nodes for cells of `pieces`, each with its number of cells: means of the values at the nodes of a face,
    /// zero outside solids. None without solids.
    pub(super) fn arrays(
        &self,
        geometry: &Geometry,
        pieces: &[(usize, usize)],
        poses: &[Pose],
    ) -> Vec<CellArray> {
        if self.0.is_empty() {
            return Vec::new();
        }
        let at = at_rest(poses);
        let mut values: [Vec<f32>; 2] = Default::default();
        for &(index, count) in pieces {
            let piece = &geometry.pieces[index];
            let known =
                self.0.iter().find(|(solid, _)| piece.role == Role::Solid && solid.name == piece.name);
            let Some((solid, elements)) = known else {
                for own in &mut values {
                    own.resize(own.len() + count, 0.0);
                }
                continue;
            };
            let numbers = elements.numbers(&at);
            for (k, own) in values.iter_mut().enumerate() {
                let mean = |face: &[usize; 4]| {
                    // The last corner of a triangle stands twice.
                    let corners = if face[2] == face[3] { &face[..3] } else { &face[..] };
                    corners.iter().map(|&node| numbers[node][k]).sum::<f64>() / corners.len() as f64
                };
                own.extend(solid.elements.iter().map(|face| mean(face) as f32));
            }
        }
        let names = ["von Mises stress of solids [Pa]", "strain energy of solids [J/m^3]"];
        names.into_iter().zip(values).map(|(name, values)| (name, 1, values)).collect()
    }
}
