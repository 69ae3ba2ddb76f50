//! Forces, moments and stresses at the centres of the elements of shells, as arrays with a value for each cell of a file.

use lissom_model::scene::Scene;
use lissom_motion::Motion as Pose;

use super::vtk::CellArray;
use crate::pictures::geometry::{Geometry, Layer, Role, ShellElements, at_rest};

/// Layers with the names of the arrays of their stresses.
const LAYERS: [(Layer, &str); 3] = [
    (Layer::Top, "von Mises stress top [Pa]"),
    (Layer::Middle, "von Mises stress middle [Pa]"),
    (Layer::Bottom, "von Mises stress bottom [Pa]"),
];

/// The shells of a scene.
pub(super) struct ShellCells(Vec<(String, ShellElements)>);

impl ShellCells {
    pub(super) fn new(scene: &Scene) -> Self {
        Self(scene.shells.iter().map(|shell| (shell.name.clone(), ShellElements::new(shell))).collect())
    }

    /// The arrays at poses of the nodes for cells of `pieces`, each with its number of cells. Zero outside shells; stresses of
    /// several layers are not a number. None without shells.
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
        // Normal forces and shear in the plane, moments, transverse shear, thickness, local axis 1, stresses.
        let sizes = [3, 3, 2, 1, 3, 1, 1, 1];
        let mut values: [Vec<f32>; 8] = Default::default();
        for &(index, count) in pieces {
            let piece = &geometry.pieces[index];
            let known = self.0.iter().find(|(name, _)| piece.role == Role::Shell && *name == piece.name);
            let Some((_, shell)) = known else {
                values
                    .iter_mut()
                    .zip(sizes)
                    .for_each(|(own, size)| own.resize(own.len() + size * count, 0.0));
                continue;
            };
            for element in 0..count {
                let resultants = shell.resultants(element, &at, (0.0, 0.0));
                let mut put = |array: usize, numbers: &[f64]| {
                    values[array].extend(numbers.iter().map(|own| *own as f32));
                };
                put(0, &resultants[..3]);
                put(1, &resultants[3..6]);
                put(2, &resultants[6..]);
                put(3, &[shell.thickness(element)]);
                put(4, shell.first_axis(element, &at).as_slice());
                for (k, (layer, _)) in LAYERS.iter().enumerate() {
                    put(5 + k, &[shell.von_mises(element, &resultants, *layer).unwrap_or(f64::NAN)]);
                }
            }
        }
        let names =
            ["N11, N22, N12 [N/m]", "M11, M22, M12 [N]", "Q13, Q23 [N/m]", "thickness [m]", "local axis 1"];
        let names = names.into_iter().chain(LAYERS.map(|(_, name)| name));
        names.zip(sizes).zip(values).map(|((name, size), values)| (name, size, values)).collect()
    }
}
