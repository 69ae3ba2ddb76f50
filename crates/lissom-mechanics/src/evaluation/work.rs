//! Work and power of elements' forces on nodes and coordinates.

use lissom_motion::Vector3;

use super::scratch::with_scratch;
use crate::elements::Element;
use crate::kinematics::Kinematics;
use crate::kinematics::work::along;

/// Work of an element's forces on its nodes and coordinates between two configurations, times `factors` there: forces in
/// inertial axes along the displacement of their nodes, moments along the rotation, forces on coordinates along their
/// change.
pub fn work<E: Element + ?Sized>(
    element: &E,
    (from, to): (&Kinematics, &Kinematics),
    factors: [f64; 2],
) -> f64 {
    let size = 6 * element.nodes().len() + element.coordinates().len();
    with_scratch(2 * size, |locals| {
        let (first, second) = locals.split_at_mut(size);
        let mut locals = [first, second];
        for ((at, local), factor) in [from, to].into_iter().zip(&mut locals).zip(factors) {
            element.forces(at, local);
            local.iter_mut().for_each(|force| *force *= factor);
        }
        work_along(element, (from, to), &locals)
    })
}

/// The work of these forces.
fn work_along<E: Element + ?Sized>(
    element: &E,
    (from, to): (&Kinematics, &Kinematics),
    locals: &[&mut [f64]; 2],
) -> f64 {
    let elapsed = to.time - from.time;
    let mut sum = 0.0;
    for (k, &node) in element.nodes().iter().enumerate() {
        let motions = [from, to].map(|at| &at.nodes[node]);
        let rotations = motions.map(|motion| motion.frame.rotation);
        let inertial = |values: &[f64], side: usize| {
            rotations[side].apply(&Vector3::new(values[0], values[1], values[2]))
        };
        let turn = (rotations[1] * rotations[0].inverse()).logarithm();
        let way = motions[1].frame.position - motions[0].frame.position;
        for (first, way) in [(0, way), (3, turn)] {
            let forces = [0, 1].map(|side| inertial(&locals[side][6 * k + first..], side));
            let speeds = [0, 1].map(|side| inertial(&motions[side].twist.as_slice()[first..], side));
            sum += (0..3)
                .map(|c| along(forces.map(|f| f[c]), way[c], speeds.map(|v| v[c]), elapsed))
                .sum::<f64>();
        }
    }
    for (k, &coordinate) in element.coordinates().iter().enumerate() {
        let position = 6 * element.nodes().len() + k;
        let [start, end] = [from, to].map(|at| at.coordinates[coordinate]);
        let forces = [locals[0][position], locals[1][position]];
        sum += along(forces, end.value - start.value, [start.rate, end.rate], elapsed);
    }
    // Forces are on the left-hand side of the equations of motion.
    -sum
}

/// Power of an element's forces on its nodes and coordinates [W].
pub fn power<E: Element + ?Sized>(element: &E, at: &Kinematics) -> f64 {
    let size = 6 * element.nodes().len() + element.coordinates().len();
    with_scratch(size, |forces| {
        element.forces(at, forces);
        let twists = element.nodes().iter().flat_map(|&node| at.nodes[node].twist.iter().copied());
        let rates = element.coordinates().iter().map(|&own| at.coordinates[own].rate);
        // Forces are on the left-hand side of the equations of motion.
        -twists.chain(rates).zip(forces).map(|(rate, force)| rate * *force).sum::<f64>()
    })
}
