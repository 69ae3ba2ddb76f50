//! Error of section forces, which follow from the strains of one element, by comparison with the equilibrium of its ends.
//!
//! Legend: i end of an element, F internal forces of the elements on both sides of it, u the mass and load that the rule of
//! Gauss and Lobatto lays there from one side, S section forces in equilibrium, ξ coordinate along the element.
//!
//! ```text
//! S_i = F⁻_i + u_i = -(F⁺_i + u_i),   u_i = -(F⁻_i + F⁺_i)/2,   at ends of the beam u extrapolated
//! e(ξ) = (1 - ξ)/2 (S_i - S(-1)) + (1 + ξ)/2 (S_i+1 - S(1))
//! ```
//!
//! Forces in equilibrium converge faster than those by strains. Where another part is attached to a node, forces jump, and nothing is
//! concluded from it.

use std::sync::Arc;

use lissom_motion::Vector6;

use super::line::{BeamLine, BeamProbe};
use lissom_mechanics::kinematics::{Kinematics, NodeId};

/// The beams of a system, as far as they are examined.
#[derive(Default)]
pub struct ExaminedBeams {
    /// Names, and elements.
    pub elements: Vec<(String, Vec<Arc<dyn BeamProbe>>)>,
    /// Errors of the section forces that are recorded.
    pub section_errors: Vec<SectionError>,
    /// Beside joints whose reactions are recorded.
    pub sections_at_joints: Vec<SectionError>,
}

impl ExaminedBeams {
    /// A beam that is compressed by more than its length, so that its sections overlap.
    pub fn overlapping(&self, at: &Kinematics) -> Option<&str> {
        let mut beams = self.elements.iter();
        let found = beams.find(|(_, elements)| elements.iter().any(|element| element.overlaps(at)));
        found.map(|(name, _)| name.as_str())
    }
}

/// Section forces at one position of a beam, with the elements that show their error.
pub struct SectionError {
    /// Name of the beam.
    pub beam: String,
    /// Number of its elements.
    pub element_count: usize,
    /// The elements of the beam.
    elements: Vec<Arc<dyn BeamProbe>>,
    /// Whether only neighbours and loads per length act at the ends of elements.
    is_plain: Vec<bool>,
    element: usize,
    xi: f64,
    /// First component that is recorded: of the force, or of the moment.
    first: usize,
}

impl SectionError {
    /// Error of the force or the moment at `fraction` of a beam, whose `first` component is 0 or 3. `attached` counts other elements and
    pub fn new(
        beam: &str,
        line: &BeamLine,
        (fraction, first): (f64, usize),
        attached: impl Fn(NodeId) -> usize,
    ) -> Self {
        let (probe, xi) = line.locate(fraction);
        let element = line.elements.iter().position(|other| Arc::ptr_eq(other, probe)).unwrap_or(0);
        let last = line.nodes.len() - 1;
        let others = |k: usize| {
            let own = if k == 0 || k == last || !k.is_multiple_of(line.order) { 1 } else { 2 };
            attached(line.nodes[k]).saturating_sub(own)
        };
        let least = (0..=last).map(others).min().unwrap_or(0);
        let ends = (0..=last).step_by(line.order);
        Self {
            beam: beam.to_owned(),
            element_count: line.elements.len(),
            elements: line.elements.clone(),
            is_plain: ends.map(|k| others(k) == least).collect(),
            element,
            xi,
            first,
        }
    }

    /// Whether it is of moments.
    pub fn is_moment(&self) -> bool {
        self.first >= 3
    }

    /// Largest derivatives of the axial and the shear force, or of the torsion and the bending moment, with respect to displacements over
    /// `length` and rotations [N, N m].
    pub fn stiffnesses(&self, at: &Kinematics, length: f64) -> [f64; 2] {
        let columns = self.elements[self.element].section_force_derivatives_at(at, self.xi).by_place;
        let mut largest = [0.0_f64; 2];
        for (k, column) in columns.iter().enumerate() {
            let unit = if k % 6 < 3 { length } else { 1.0 };
            for (j, size) in (0..3).map(|j| (j, unit * column[self.first + j].abs())) {
                largest[j.min(1)] = largest[j.min(1)].max(size);
            }
        }
        largest
    }

    /// Axial and shear force [N], or torsion and bending moment [N m], by component.
    pub fn forces(&self, at: &Kinematics) -> [f64; 3] {
        let forces = self.elements[self.element].section_forces_at(at, self.xi);
        std::array::from_fn(|k| forces[self.first + k])
    }

    /// Size and error of the axial and the shear force [N], or of the torsion and the bending moment [N m]; none where forces jump
    /// on both sides.
    pub fn of(&self, at: &Kinematics) -> Option<[[f64; 2]; 2]> {
        let probe = &self.elements[self.element];
        let missed = |side: usize, xi: f64| {
            let by_strain = probe.section_forces_at(at, xi);
            self.in_equilibrium(at, self.element + side).map(|force| force - by_strain)
        };
        let error = match (missed(0, -1.0), missed(1, 1.0)) {
            (Some(left), Some(right)) => 0.5 * ((1.0 - self.xi) * left + (1.0 + self.xi) * right),
            (one, other) => one.or(other)?,
        };
        let size = probe.section_forces_at(at, self.xi);
        let groups = [(self.first, 1), (self.first + 1, 2)];
        Some(groups.map(|(first, count)| [&size, &error].map(|all| all.rows(first, count).norm())))
    }

    /// Section forces in equilibrium at the end `i` of an element.
    fn in_equilibrium(&self, at: &Kinematics, i: usize) -> Option<Vector6> {
        let last = self.elements.len();
        match i {
            0 => Some(-self.elements[0].end_forces(at)[0] - self.extrapolated_share(at, 1, 2)?),
            _ if i == last => Some(
                self.elements[last - 1].end_forces(at)[1]
                    + self.extrapolated_share(at, last - 1, last.wrapping_sub(2))?,
            ),
            _ => {
                let share = self.share(at, i)?;
                Some(self.elements[i - 1].end_forces(at)[1] + share)
            }
        }
    }

    /// u_i.
    fn share(&self, at: &Kinematics, i: usize) -> Option<Vector6> {
        if i == 0 || i >= self.elements.len() || !self.is_plain[i] {
            return None;
        }
        let [before, after] = [self.elements[i - 1].end_forces(at)[1], self.elements[i].end_forces(at)[0]];
        Some(-0.5 * (before + after))
    }

    /// u at the end of the beam next to `near`, which is followed by `far`.
    fn extrapolated_share(&self, at: &Kinematics, near: usize, far: usize) -> Option<Vector6> {
        let near = self.share(at, near)?;
        Some(self.share(at, far).map_or(near, |far| 2.0 * near - far))
    }
}
