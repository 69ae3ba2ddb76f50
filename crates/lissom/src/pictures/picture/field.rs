//! A field on shells: its values and their colours.

use lissom_core::kinematics::Kinematics;
use lissom_model::output::Shade;
use lissom_model::scene::{Scene, Shell};
use lissom_motion::{Motion as Pose, Vector3};

use super::paint::between;
use crate::pictures::geometry::{Layer, Piece, Role, ShellElements, at_rest};

/// A quantity by which shells are coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Distance from the position in the stress-free state [m].
    Displacement,
    /// Von Mises stress on the side of the normal [Pa].
    StressTop,
    /// Von Mises stress in the middle of the thickness [Pa].
    StressMiddle,
    /// Von Mises stress on the other side [Pa].
    StressBottom,
    /// Strain energy per area [J/m²].
    Energy,
}

impl Field {
    /// Its name and unit.
    pub fn title(self) -> (&'static str, &'static str) {
        match self {
            Self::Displacement => ("displacement", "m"),
            Self::StressTop => ("von Mises stress, top", "Pa"),
            Self::StressMiddle => ("von Mises stress, middle", "Pa"),
            Self::StressBottom => ("von Mises stress, bottom", "Pa"),
            Self::Energy => ("strain energy per area", "J/m²"),
        }
    }

    /// Whether it is known for a shell in a scene: stresses are those of one layer.
    pub fn is_in(self, scene: &Scene) -> bool {
        let is_stress = matches!(self, Self::StressTop | Self::StressMiddle | Self::StressBottom);
        scene.shells.iter().any(|shell| shell.is_homogeneous || !is_stress)
    }
}

/// Viridis at equal distances, as on the page.
const COLOURS: [Shade; 11] = [
    [68, 1, 84],
    [72, 36, 117],
    [65, 68, 135],
    [53, 95, 141],
    [42, 120, 142],
    [33, 145, 140],
    [34, 168, 132],
    [68, 191, 112],
    [122, 209, 81],
    [189, 223, 38],
    [253, 231, 37],
];
/// The colour of a share from 0 to 1 of the largest value.
pub(super) fn colour(share: f64) -> Shade {
    let x = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let k = (x as usize).min(COLOURS.len() - 2);
    std::array::from_fn(|i| {
        let [from, to] = [k, k + 1].map(|k| f64::from(COLOURS[k][i]));
        (from + (x - k as f64) * (to - from)).round() as u8
    })
}

/// A field on the shells of a scene.
pub(super) struct ShellField {
    pub(super) field: Field,
    shells: Vec<(Shell, ShellElements)>,
    /// The largest value at the centres of elements at the instants of a picture.
    pub(super) most: f64,
}

impl ShellField {
    /// With a scale for poses of the nodes at several instants.
    pub(super) fn new(field: Field, scene: &Scene, instants: &[Vec<Pose>]) -> Self {
        let shells = scene.shells.iter().map(|shell| (shell.clone(), ShellElements::new(shell))).collect();
        let mut own = Self { field, shells, most: 0.0 };
        for poses in instants {
            let at = at_rest(poses);
            let of = |shell: usize| (0..own.shells[shell].1.count()).map(move |element| (shell, element));
            let all = (0..own.shells.len()).flat_map(of);
            own.most = all.filter_map(|place| own.value(place, (0.0, 0.0), &at)).fold(own.most, f64::max);
        }
        own
    }

    /// The shell that is drawn by a piece.
    pub(super) fn shell_of(&self, piece: &Piece) -> Option<usize> {
        let is_drawn = |(shell, _): &(Shell, _)| piece.role == Role::Shell && shell.name == piece.name;
        self.shells.iter().position(is_drawn)
    }

    /// The colour at r, s ∈ [-1, 1] of an element of a shell, if the field is known there.
    pub(super) fn shade(&self, of: (usize, usize), place: (f64, f64), at: &Kinematics) -> Option<Shade> {
        self.value(of, place, at).map(|value| colour(if self.most > 0.0 { value / self.most } else { 0.0 }))
    }

    fn value(&self, (shell, element): (usize, usize), place: (f64, f64), at: &Kinematics) -> Option<f64> {
        let (shell, elements) = &self.shells[shell];
        let stress = |layer| elements.von_mises(element, &elements.resultants(element, at, place), layer);
        match self.field {
            Field::Displacement => {
                let shift = shell.elements[element].map(|node| {
                    at.nodes[shell.nodes[node]].frame.position - Vector3::from(shell.positions[node])
                });
                Some(between(&shift, place).norm())
            }
            Field::StressTop => stress(Layer::Top),
            Field::StressMiddle => stress(Layer::Middle),
            Field::StressBottom => stress(Layer::Bottom),
            Field::Energy => Some(elements.energy(element, at, place)),
        }
    }
}
