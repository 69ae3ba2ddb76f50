//! A field on shells and solids: its values and their colours.

use lissom_core::kinematics::{Kinematics, NodeId};
use lissom_model::output::Shade;
use lissom_model::scene::{ElasticSolid, Scene, Shell};
use lissom_motion::{Motion as Pose, Vector3};

use super::paint::between;
use crate::pictures::geometry::{Layer, Piece, Role, ShellElements, SolidElements, at_rest};

/// A quantity by which shells and solids are coloured.
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
    /// Strain energy per area of shells [J/m²].
    Energy,
    /// Von Mises stress of solids [Pa].
    Stress,
    /// Strain energy per volume of solids [J/m³].
    EnergyPerVolume,
}

impl Field {
    /// Name and unit of the field.
    pub fn title(self) -> (&'static str, &'static str) {
        match self {
            Self::Displacement => ("displacement", "m"),
            Self::StressTop => ("von Mises stress, top", "Pa"),
            Self::StressMiddle => ("von Mises stress, middle", "Pa"),
            Self::StressBottom => ("von Mises stress, bottom", "Pa"),
            Self::Energy => ("strain energy per area", "J/m²"),
            Self::Stress => ("von Mises stress", "Pa"),
            Self::EnergyPerVolume => ("strain energy per volume", "J/m³"),
        }
    }

    /// Whether it is known for a shell or solid in a scene: stresses of shells are those of one layer.
    pub fn is_in(self, scene: &Scene) -> bool {
        let is_of_solids = matches!(self, Self::Stress | Self::EnergyPerVolume);
        if is_of_solids || (self == Self::Displacement && scene.shells.is_empty()) {
            return !scene.elastic_solids.is_empty();
        }
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

/// A field on the shells and solids of a scene.
pub(super) struct ShellField {
    pub(super) field: Field,
    shells: Vec<(Shell, ShellElements)>,
    solids: Vec<(ElasticSolid, SolidElements)>,
    /// The largest value at the centres of elements at the instants of a picture.
    pub(super) most: f64,
}

/// A shell or solid at one instant.
pub(super) enum Part<'f> {
    Shell(&'f Shell, &'f ShellElements, Box<Kinematics>),
    /// With the values at the nodes.
    Solid(&'f ElasticSolid, Vec<f64>),
}

impl ShellField {
    /// With a scale for poses of the nodes at several instants.
    pub(super) fn new(field: Field, scene: &Scene, instants: &[Vec<Pose>]) -> Self {
        let shells = scene.shells.iter().map(|shell| (shell.clone(), ShellElements::new(shell))).collect();
        let solids = scene.elastic_solids.iter().map(|own| (own.clone(), SolidElements::new(own))).collect();
        let mut own = Self { field, shells, solids, most: 0.0 };
        for poses in instants {
            let at = at_rest(poses);
            let shells = own.shells.iter().map(|shell| (Self::shell(shell, &at), shell.1.count()));
            let solids =
                own.solids.iter().filter_map(|solid| Some((own.solid(solid, &at)?, solid.0.elements.len())));
            let values = shells.chain(solids).flat_map(|(part, count)| {
                (0..count).filter_map(|face| own.value(&part, face, (0.0, 0.0))).collect::<Vec<_>>()
            });
            own.most = values.fold(own.most, f64::max);
        }
        own
    }

    fn shell<'s>((shell, elements): &'s (Shell, ShellElements), at: &Kinematics) -> Part<'s> {
        Part::Shell(shell, elements, Box::new(at.clone()))
    }

    fn solid<'f>(
        &self,
        (solid, elements): &'f (ElasticSolid, SolidElements),
        at: &Kinematics,
    ) -> Option<Part<'f>> {
        let shift = |(node, position): (&NodeId, &[f64; 3])| {
            (at.nodes[*node].frame.position - Vector3::from(*position)).norm()
        };
        let values = match self.field {
            Field::Displacement => solid.nodes.iter().zip(&solid.positions).map(shift).collect(),
            Field::Stress => elements.numbers(at).iter().map(|[stress, _]| *stress).collect(),
            Field::EnergyPerVolume => elements.numbers(at).iter().map(|[_, energy]| *energy).collect(),
            _ => return None,
        };
        Some(Part::Solid(solid, values))
    }

    /// The shell or solid that is drawn by a piece.
    pub(super) fn part_of(&self, piece: &Piece, at: &Kinematics) -> Option<Part<'_>> {
        match piece.role {
            Role::Shell => {
                Some(Self::shell(self.shells.iter().find(|(shell, _)| shell.name == piece.name)?, at))
            }
            Role::Solid => self.solid(self.solids.iter().find(|(solid, _)| solid.name == piece.name)?, at),
            _ => None,
        }
    }

    /// The colour at r, s ∈ [-1, 1] of a face of a part, if the field is known there.
    pub(super) fn shade(&self, part: &Part<'_>, face: usize, place: (f64, f64)) -> Option<Shade> {
        let value = self.value(part, face, place)?;
        Some(colour(if self.most > 0.0 { value / self.most } else { 0.0 }))
    }

    fn value(&self, part: &Part<'_>, element: usize, place: (f64, f64)) -> Option<f64> {
        let (shell, elements, at) = match part {
            Part::Solid(solid, values) => {
                let corners = solid.elements[element].map(|node| Vector3::repeat(values[node]));
                return Some(between(&corners, place).x);
            }
            Part::Shell(shell, elements, at) => (shell, elements, at),
        };
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
            Field::Stress | Field::EnergyPerVolume => None,
        }
    }
}
