//! Strains, forces and stresses of a shell at poses of the nodes, by elements like those of the run. Motions hold displacements with
//! seven digits: so do the strains relative to displacement over the size of an element.

use lissom_core::flexible::shell::Shell as Element;
use lissom_core::flexible::shell::section::{DRILLING_SHARE, Matrix8, ShellLaw, von_mises};
use lissom_core::kinematics::{Kinematics, NodeMotion};
use lissom_model::scene::Shell;
use lissom_motion::{Motion as Pose, Rotation, Vector3};

use super::normals::normal;

/// The elements of a shell.
pub struct ShellElements {
    elements: Vec<Element>,
    /// First local axis of each element in the axes of its nodes, in the stress-free state.
    firsts: Vec<[Vector3; 4]>,
    /// Thickness of each element [m].
    thickness: Vec<f64>,
    /// Place of the middle of the thickness along the normal [m].
    offset: f64,
    is_homogeneous: bool,
}

/// A surface of a homogeneous shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// On the side of the normal.
    Top,
    /// In the middle of the thickness.
    Middle,
    /// On the other side.
    Bottom,
}

/// The value of an element in a list that has a single one if all are the same.
fn of<T: Clone + Default>(values: &[T], element: usize) -> T {
    values.get(element).or(values.first()).cloned().unwrap_or_default()
}

impl ShellElements {
    /// Elements of a shell.
    pub fn new(shell: &Shell) -> Self {
        let frame = |node: usize| {
            let rotation = Rotation::from_quaternion(shell.axes[node]).unwrap_or_default();
            Pose::new(rotation, Vector3::from(shell.positions[node]))
        };
        let element = |(index, corners): (usize, &[usize; 4])| {
            let frames = corners.map(frame);
            let carried = shell.directors.get(index).copied().unwrap_or([[0.0, 0.0, 1.0]; 4]);
            let directors: [Vector3; 4] =
                std::array::from_fn(|i| frames[i].rotation.apply(&Vector3::from(carried[i])));
            let numbers = of(&shell.stiffness, index);
            let stiffness = Matrix8::from_fn(|i, j| numbers.get(8 * i + j).copied().unwrap_or(0.0));
            let free = of(&shell.free_strains, index);
            let law = ShellLaw { stiffness, free, drilling: DRILLING_SHARE * stiffness[(2, 2)] };
            let direction = Vector3::from(of(&shell.directions, index));
            Element::new(corners.map(|node| shell.nodes[node]), &frames, &directors, Some(direction), law)
        };
        let first = |(index, corners): (usize, &[usize; 4])| {
            let frames = corners.map(frame);
            let normal = normal(&frames.map(|frame| frame.position)).unwrap_or_else(Vector3::z);
            let along = Vector3::from(of(&shell.directions, index));
            let along = (along - normal * normal.dot(&along)).try_normalize(0.0).unwrap_or(along);
            frames.map(|frame| frame.rotation.apply_inverse(&along))
        };
        Self {
            firsts: shell.elements.iter().enumerate().map(first).collect(),
            elements: shell.elements.iter().enumerate().map(element).collect(),
            thickness: (0..shell.elements.len()).map(|index| of(&shell.thickness, index)).collect(),
            offset: shell.offset,
            is_homogeneous: shell.is_homogeneous,
        }
    }

    /// Forces and moments per length N11, N22, N12 [N/m], M11, M22, M12 [N], Q13, Q23 [N/m] of an element at r, s ∈ [-1, 1], in its
    /// local axes.
    pub fn resultants(&self, element: usize, at: &Kinematics, place: (f64, f64)) -> [f64; 8] {
        self.elements[element].resultants_at(at, place)
    }

    /// Strain energy per area of an element at r, s ∈ [-1, 1] [J/m²].
    pub fn energy(&self, element: usize, at: &Kinematics, place: (f64, f64)) -> f64 {
        self.state(element, at, place).1
    }

    /// The resultants with the strain energy per area.
    pub(crate) fn state(&self, element: usize, at: &Kinematics, place: (f64, f64)) -> ([f64; 8], f64) {
        let own = &self.elements[element];
        let (strains, stiffness) = (own.strains_at(at, place), own.law().stiffness);
        let resultants: [f64; 8] =
            std::array::from_fn(|i| (0..8).map(|j| stiffness[(i, j)] * strains[j]).sum());
        let pairs = strains.iter().zip(&resultants);
        (resultants, 0.5 * pairs.map(|(strain, resultant)| strain * resultant).sum::<f64>())
    }

    /// Von Mises stress [Pa] of the stresses in the plane, which are linear over the thickness; none for several layers.
    pub fn von_mises(&self, element: usize, resultants: &[f64; 8], layer: Layer) -> Option<f64> {
        let thickness = self.thickness[element];
        let bending = match layer {
            Layer::Top => 6.0,
            Layer::Middle => 0.0,
            Layer::Bottom => -6.0,
        };
        // Moments are about the surface of the nodes.
        let moment = |k: usize| resultants[3 + k] - self.offset * resultants[k];
        let stress = |k: usize| (resultants[k] + bending * moment(k) / thickness) / thickness;
        self.is_homogeneous.then(|| von_mises([0, 1, 2].map(stress)))
    }

    /// First local axis at the centre of an element, global axes: it rotates with the nodes.
    pub fn first_axis(&self, element: usize, at: &Kinematics) -> Vector3 {
        let nodes = self.elements[element].nodes().map(|node| at.nodes[node].frame);
        let normal = normal(&nodes.map(|frame| frame.position)).unwrap_or_else(Vector3::z);
        let rotated = |(frame, first): (&Pose, &Vector3)| frame.rotation.apply(first);
        let sum: Vector3 = nodes.iter().zip(&self.firsts[element]).map(rotated).sum();
        (sum - normal * normal.dot(&sum)).try_normalize(0.0).unwrap_or(sum)
    }

    /// Area of an element in the stress-free state [m²].
    pub(crate) fn area(&self, element: usize) -> f64 {
        self.elements[element].area()
    }

    /// Thickness of an element [m].
    pub fn thickness(&self, element: usize) -> f64 {
        self.thickness[element]
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.elements.len()
    }
}

/// Nodes at rest at these poses.
pub fn at_rest(poses: &[Pose]) -> Kinematics {
    Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: poses.iter().map(|pose| NodeMotion::at_rest(*pose)).collect(),
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    }
}
