//! Forces, moments and stresses of shells at their nodes: those at the Gauss points of the elements, extrapolated to the node, turned into
//! the axes of the node, and their mean over its elements by area. Where elements differ at a node, the mean has an error of about this
//! difference.
//!
//! Legend: n mean normal of the elements at the node, a mean of their first axes projected on the surface, R the smallest rotation from n to the
//! normal of an element. The first axis of the node in this element is R a.

use std::sync::Arc;

use lissom_flexible::shell::Shell;
use lissom_flexible::shell::section::{Ply, von_mises};
use lissom_motion::Vector3;
use lissom_system::System;

use super::frames::node_of;
use super::meshes::BuiltShell;
use super::touched::Touched;
use super::{Build, Evaluation, Found, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::reading::node_reference::NodeReference;
use crate::text::report::Problem;

/// Why signals depend on them at samples only.
const OF_ELEMENTS: &str = "it is the mean over the elements at the node";

/// Registry entry.
pub(crate) const SHELL_FORCE: Declaration = Declaration {
    word: "shell_force",
    summary: "Forces per length in a shell, local axes of the node: in the surface and across it.",
    subject: Subject::ShellNode,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[("n11", "N/m"), ("n22", "N/m"), ("n12", "N/m"), ("q13", "N/m"), ("q23", "N/m")],
    build: Build::System(OF_ELEMENTS, |output, _, subjects| of(output, subjects, What::Force)),
};
/// Registry entry.
pub(crate) const SHELL_MOMENT: Declaration = Declaration {
    word: "shell_moment",
    summary: "Bending moments and torsion per length in a shell, local axes of the node; positive where the side of the normal is in tension.",
    subject: Subject::ShellNode,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[("m11", "N"), ("m22", "N"), ("m12", "N")],
    build: Build::System(OF_ELEMENTS, |output, _, subjects| of(output, subjects, What::Moment)),
};
/// Registry entry.
pub(crate) const SHELL_STRESS: Declaration = Declaration {
    word: "shell_stress",
    summary: "Stresses at both faces of a shell, local axes of the node, von Mises stresses at the faces and in the middle, and an estimate of their error.",
    subject: Subject::ShellNode,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[
        ("top11", "Pa"),
        ("top22", "Pa"),
        ("top12", "Pa"),
        ("bottom11", "Pa"),
        ("bottom22", "Pa"),
        ("bottom12", "Pa"),
        ("mises_top", "Pa"),
        ("mises_middle", "Pa"),
        ("mises_bottom", "Pa"),
        ("error", "Pa"),
    ],
    build: Build::System(OF_ELEMENTS, |output, _, subjects| of(output, subjects, What::Stress)),
};

/// What is recorded.
#[derive(Clone, Copy)]
enum What {
    Force,
    Moment,
    Stress,
}

/// An element at a node, with its corner there.
struct Corner {
    element: Arc<Shell>,
    at: usize,
    plies: Arc<[Ply]>,
    /// Place of the middle of the thickness along the normal [m].
    offset: f64,
    /// Share of the corner in the mean.
    share: f64,
    /// Cosine and sine of the angle from its first axis to that of the node.
    turn: [f64; 2],
}

struct OfShell {
    corners: Vec<Corner>,
    what: What,
}

fn of(output: &Output, subjects: &Subjects<'_>, what: What) -> Found {
    let (node, _) = node_of(output)?;
    let found = match &node.value {
        NodeReference::Mesh { part, .. } => subjects.names.meshes.shells.get(part),
        _ => None,
    };
    let Some(shell) = found else {
        let message = format!("output `{}` is of a shell, and this is no node of one", output.name.value);
        return Err(Problem::error(node.span, message).help("name a node such as \"panel@0.5,1\""));
    };
    let place = shell.nodes.one_index(node)?;
    let mut corners = shell.corners(place);
    let whole: f64 = corners.iter().map(|corner| corner.share).sum();
    for corner in &mut corners {
        corner.share /= whole;
    }
    align(&mut corners);
    Ok(Arc::new(OfShell { corners, what }))
}

impl BuiltShell {
    /// The elements at a node.
    fn corners(&self, node: usize) -> Vec<Corner> {
        let of = |(index, element): (usize, [usize; 4])| {
            let at = element.iter().position(|&own| own == node)?;
            let (element, plies) = (Arc::clone(&self.elements[index]), self.plies_of(index));
            Some(Corner { share: element.area(), element, at, plies, offset: self.offset, turn: [1.0, 0.0] })
        };
        self.nodes.mesh.quadrilaterals().enumerate().filter_map(of).collect()
    }
}

/// Sets the angles from the axes of the elements to common ones.
fn align(corners: &mut [Corner]) {
    let axes: Vec<[Vector3; 2]> =
        corners.iter().map(|corner| corner.element.axes_at_corner(corner.at)).collect();
    let mean = |k: usize| {
        let sum: Vector3 = corners.iter().zip(&axes).map(|(corner, axes)| corner.share * axes[k]).sum();
        sum.try_normalize(1e-3).unwrap_or(axes[0][k])
    };
    let normal = mean(1);
    let along = mean(0);
    let along = (along - normal * along.dot(&normal)).try_normalize(1e-3).unwrap_or(axes[0][0]);
    for (corner, [first, own]) in corners.iter_mut().zip(&axes) {
        // The smallest rotation from n to m: a - (a·m) (n + m)/(1 + n·m) for a perpendicular to n.
        let fold = 1.0 + normal.dot(own);
        let turned = if fold > 1e-6 { along - (normal + own) * (along.dot(own) / fold) } else { along };
        let second = own.cross(first);
        let (x, y) = (turned.dot(first), turned.dot(&second));
        corner.turn = [x / x.hypot(y), y / x.hypot(y)];
    }
}

impl Corner {
    /// Components 11, 22, 12 in the axes of the node.
    fn tensor(&self, [a, b, shear]: [f64; 3]) -> [f64; 3] {
        let [c, s] = self.turn;
        let twice = 2.0 * c * s * shear;
        [
            c * c * a + s * s * b + twice,
            s * s * a + c * c * b - twice,
            c * s * (b - a) + (c * c - s * s) * shear,
        ]
    }

    /// Forces and moments per length in the axes of the node, as those of the element.
    fn resultants(&self, strains: &[f64; 8]) -> [f64; 8] {
        let law = &self.element.law().stiffness;
        let own: [f64; 8] = std::array::from_fn(|k| (0..8).map(|j| law[(k, j)] * strains[j]).sum());
        let [n11, n22, n12, m11, m22, m12, q13, q23] = own;
        let ([n11, n22, n12], [m11, m22, m12]) = (self.tensor([n11, n22, n12]), self.tensor([m11, m22, m12]));
        let [c, s] = self.turn;
        [n11, n22, n12, m11, m22, m12, c * q13 + s * q23, c * q23 - s * q13]
    }

    /// Stresses 11, 22, 12 at the top, in the middle and at the bottom, in the axes of the node.
    fn stresses(&self, strains: &[f64; 8]) -> [[f64; 3]; 3] {
        let (Self { plies, offset, .. }, free) = (self, &self.element.law().free);
        let half = 0.5 * plies.iter().map(|ply| ply.thickness).sum::<f64>();
        let places = [(plies.len() - 1, half), (plies.len() / 2, 0.0), (0, -half)];
        places.map(|(ply, height)| {
            let (stiffness, height) = (plies[ply].in_plane(), offset + height);
            let whole = |j: usize| strains[j] + free[j];
            let stretched = |j: usize| whole(j) + height * whole(3 + j);
            self.tensor(std::array::from_fn(|k| {
                plies[ply].initial[k] + (0..3).map(|j| stiffness[(k, j)] * stretched(j)).sum::<f64>()
            }))
        })
    }
}

impl OutputQuantity for OfShell {
    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        touched.nodes.extend(self.corners.iter().flat_map(|corner| corner.element.nodes()));
        Some(touched)
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let strains = |corner: &Corner| corner.element.strains_at_corner(at.motion(), corner.at);
        let resultants = || {
            let mut sums = [0.0; 8];
            for corner in &self.corners {
                let own = corner.resultants(&strains(corner));
                sums.iter_mut().zip(own).for_each(|(sum, value)| *sum += corner.share * value);
            }
            sums
        };
        match self.what {
            What::Force => {
                let [n11, n22, n12, .., q13, q23] = resultants();
                out.extend([n11, n22, n12, q13, q23]);
            }
            What::Moment => out.extend_from_slice(&resultants()[3..6]),
            What::Stress => {
                let mut stresses = [[0.0; 3]; 3];
                for corner in &self.corners {
                    let own = corner.stresses(&strains(corner));
                    for (sum, stress) in stresses.iter_mut().flatten().zip(own.iter().flatten()) {
                        *sum += corner.share * stress;
                    }
                }
                let [top, _, bottom] = stresses;
                out.extend(top.into_iter().chain(bottom));
                out.extend(stresses.map(von_mises));
                let apart = |own: &[[f64; 3]; 3], k: usize| {
                    von_mises(std::array::from_fn(|j| own[k][j] - stresses[k][j]))
                };
                let errors = self.corners.iter().map(|corner| {
                    let own = corner.stresses(&strains(corner));
                    apart(&own, 0).max(apart(&own, 2))
                });
                out.push(errors.fold(0.0, f64::max));
            }
        }
    }
}
