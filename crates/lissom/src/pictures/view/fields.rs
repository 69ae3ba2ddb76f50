//! Fields of shells and solids over a motion, evaluated by elements like those of the run.
//!
//! Numbers of a shell are those at the centres of its elements: N11, N22, N12 [N/m], M11, M22, M12 [N], Q13, Q23 [N/m], and the root of the
//! strain energy per area [√(J/m²)]. Numbers of a solid are those at the nodes of its surface in ascending order: the von Mises stress [Pa] and
//! the root of the strain energy per volume [√(J/m³)]. The roots are proportional to small strains, as the others.

use std::collections::BTreeSet;

use lissom_core::kinematics::{Kinematics, NodeId};
use lissom_model::scene::{ElasticSolid, Scene, Shell};
use lissom_motion::{Motion as Pose, Rotation, Vector3};

use crate::motion::Motion;
use crate::pictures::geometry::{ShellElements, SolidElements, at_rest};

/// Which numbers of an element or node have the same unit and a common scale.
const SHELL_KINDS: &[usize] = &[0, 0, 0, 1, 1, 1, 2, 2, 3];
const SOLID_KINDS: &[usize] = &[0, 1];
/// The evaluation of an element of a solid takes as long as that of so many numbers of shells.
const SOLID_WORK: usize = 20;
/// Distance of numbers in single precision relative to them.
const SINGLE: f64 = 1.0 / 16_777_216.0;

type Evaluate<'s> = Box<dyn Fn(&Kinematics) -> Vec<f32> + 's>;

/// The fields of one shell or solid.
pub(super) struct PartField {
    /// Kinds of the numbers of each element or node.
    pub(super) kinds: &'static [usize],
    /// Area [m²] and first local axis of each element of a shell, as the model describes it.
    pub(super) constants: Vec<f64>,
    /// Number of elements or nodes, times that of their numbers.
    pub(super) count: usize,
    /// The numbers, frame by frame.
    pub(super) values: Vec<f32>,
    /// Errors of the numbers of each kind because motions have single precision.
    pub(super) noise: Vec<f64>,
}

/// Fields of all shells, and after them of all solids of a scene, in every nth frame and the last one, with n, which `work` determines.
pub(super) fn of(scene: &Scene, motion: &Motion, work: usize) -> (usize, Vec<PartField>) {
    let rest = at_rest(motion.reference());
    let disturbed = disturbed(motion);
    let mut parts: Vec<(PartField, usize, Evaluate<'_>)> = (scene.shells.iter())
        .map(|shell| of_shell(shell, &rest))
        .chain(scene.elastic_solids.iter().map(of_solid))
        .collect();
    let per_frame: usize = parts.iter().map(|(_, work, _)| work).sum();
    let stride = (motion.times().len() * per_frame).div_ceil(work).max(1);
    for frame in recorded(if per_frame > 0 { motion.times().len() } else { 0 }, stride) {
        let poses = NodeId::first(motion.reference().len()).map(|node| motion.pose(frame, node));
        let at = at_rest(&poses.collect::<Vec<_>>());
        for (field, _, evaluate) in &mut parts {
            field.values.extend(evaluate(&at));
        }
    }
    for (field, _, evaluate) in &mut parts {
        let kinds = field.kinds.iter().cycle();
        for ((one, other), kind) in evaluate(&rest).into_iter().zip(evaluate(&disturbed)).zip(kinds) {
            field.noise[*kind] = field.noise[*kind].max(f64::from((one - other).abs()));
        }
    }
    (stride, parts.into_iter().map(|(field, ..)| field).collect())
}

/// The frames that have fields.
pub(super) fn recorded(frames: usize, stride: usize) -> impl Iterator<Item = usize> {
    (0..frames).filter(move |frame| frame % stride == 0 || frame + 1 == frames)
}

/// A field without values, its work in a frame in numbers of shells, and how it is evaluated.
fn of_shell<'s>(shell: &'s Shell, rest: &Kinematics) -> (PartField, usize, Evaluate<'s>) {
    let elements = ShellElements::new(shell);
    let constants = (0..elements.count()).flat_map(|element| {
        let axis = elements.first_axis(element, rest);
        [elements.area(element), axis.x, axis.y, axis.z]
    });
    let field = PartField::new(SHELL_KINDS, elements.count(), constants.collect());
    let evaluate = move |at: &Kinematics| {
        let numbers = |element| {
            let (resultants, energy) = elements.state(element, at, (0.0, 0.0));
            resultants.into_iter().chain([energy.max(0.0).sqrt()])
        };
        (0..elements.count()).flat_map(numbers).map(|number| number as f32).collect()
    };
    let work = field.count;
    (field, work, Box::new(evaluate))
}

fn of_solid(solid: &ElasticSolid) -> (PartField, usize, Evaluate<'_>) {
    let elements = SolidElements::new(solid);
    let surface: BTreeSet<usize> = solid.elements.iter().flatten().copied().collect();
    let field = PartField::new(SOLID_KINDS, surface.len(), Vec::new());
    let evaluate = move |at: &Kinematics| {
        let all = elements.numbers(at);
        let numbers = |&node: &usize| [all[node][0], all[node][1].max(0.0).sqrt()];
        surface.iter().flat_map(numbers).map(|number| number as f32).collect()
    };
    let work = field.count + SOLID_WORK * solid.cells.values().map(Vec::len).sum::<usize>();
    (field, work, Box::new(evaluate))
}

impl PartField {
    fn new(kinds: &'static [usize], count: usize, constants: Vec<f64>) -> Self {
        Self { kinds, constants, count: count * kinds.len(), values: Vec::new(), noise: vec![0.0; 4] }
    }
}

/// The nodes where the model describes them, with errors that are fractions of the distance of numbers of the motion.
fn disturbed(motion: &Motion) -> Kinematics {
    let nodes = motion.reference().len();
    let frames = 0..motion.times().len();
    let error = |number: usize| {
        let most = frames.clone().map(|frame| motion.frame(frame)[number].abs()).fold(0.0, f32::max);
        // Multiples of the golden ratio are spread evenly.
        SINGLE * f64::from(most) * (2.0 * (number as f64 * 0.618_033_988_75).fract() - 1.0)
    };
    let vector = |node: usize| Vector3::from_fn(|k, _| error(3 * node + k));
    let pose = |(node, pose): (usize, &Pose)| {
        Pose::new(Rotation::exponential(&vector(nodes + node)) * pose.rotation, pose.position + vector(node))
    };
    at_rest(&motion.reference().iter().enumerate().map(pose).collect::<Vec<_>>())
}
