//! Work and power of elements' forces on nodes and coordinates.

use std::cell::RefCell;

use lissom_motion::Vector3;

use super::element::{Element, Tangents, Unknowns};
use super::scratch::with_scratch;
use crate::kinematics::work::along;
use crate::kinematics::{Kinematics, USUAL_UNKNOWNS};
use crate::signals::measurement::Gradient;

thread_local! {
    /// Derivatives of forces, for gradients of powers and wrenches.
    static TANGENTS: RefCell<Tangents> = RefCell::new(Tangents::new(USUAL_UNKNOWNS));
}

/// Work of an element's forces on its nodes and coordinates between two configurations, times `factors` there: forces in
/// inertial axes along the displacement of their nodes, moments along the rotation, forces on coordinates along their
/// change.
pub fn work<E: Element + ?Sized>(
    element: &E,
    (from, to): (&Kinematics, &Kinematics),
    factors: [f64; 2],
) -> f64 {
    let size = element.unknowns().force_count();
    with_scratch(2 * size, |locals| {
        let (first, second) = locals.split_at_mut(size);
        let mut locals = [first, second];
        for ((at, local), factor) in [from, to].into_iter().zip(&mut locals).zip(factors) {
            element.forces(at, local);
            local.iter_mut().for_each(|force| *force *= factor);
        }
        work_along(element.unknowns(), (from, to), &locals)
    })
}

/// The work of these forces.
fn work_along(
    unknowns: Unknowns<'_>,
    (from, to): (&Kinematics, &Kinematics),
    locals: &[&mut [f64]; 2],
) -> f64 {
    let elapsed = to.time - from.time;
    let mut sum = 0.0;
    for (k, &node) in unknowns.nodes.iter().enumerate() {
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
    for (k, &coordinate) in unknowns.coordinates.iter().enumerate() {
        let position = 6 * unknowns.nodes.len() + k;
        let [start, end] = [from, to].map(|at| at.coordinates[coordinate]);
        let forces = [locals[0][position], locals[1][position]];
        sum += along(forces, end.value - start.value, [start.rate, end.rate], elapsed);
    }
    // Forces are on the left-hand side of the equations of motion.
    -sum
}

/// Power of an element's forces on its nodes and coordinates [W].
pub fn power<E: Element + ?Sized>(element: &E, at: &Kinematics) -> f64 {
    let unknowns = element.unknowns();
    with_scratch(unknowns.force_count(), |forces| {
        element.forces(at, forces);
        // Forces are on the left-hand side of the equations of motion.
        -unknowns.rates(at).zip(forces).map(|(rate, force)| rate * *force).sum::<f64>()
    })
}

/// Passes the derivatives of an element's forces to `read`.
pub(super) fn with_tangents<E: Element + ?Sized>(element: &E, at: &Kinematics, read: impl FnOnce(&Tangents)) {
    TANGENTS.with_borrow_mut(|tangents| {
        tangents.clear(element.unknowns().force_count());
        element.linearize(at, tangents);
        read(tangents);
    });
}

/// Gradient of the power of an element's forces with respect to its local unknowns; none if there are more than those of a
/// gradient, or multipliers among them.
///
/// ```text
/// P = -v·f,      ∂P/∂q = -Kᵀ v,      ∂P/∂v = -f - Cᵀ v,      ∂P/∂a = -Mᵀ v
/// ```
pub fn power_gradient<E: Element + ?Sized>(element: &E, at: &Kinematics) -> Option<Gradient> {
    let unknowns = element.unknowns();
    let size = unknowns.force_count();
    if size > USUAL_UNKNOWNS || !unknowns.multipliers.is_empty() {
        return None;
    }
    let mut gradient = Gradient::zero();
    element.forces(at, &mut gradient.by_rate[..size]);
    gradient.by_rate.iter_mut().for_each(|force| *force = -*force);
    with_tangents(element, at, |tangents| {
        for (row, rate) in unknowns.rates(at).enumerate() {
            for (own, matrix) in [
                (&mut gradient.by_place, &tangents.stiffness),
                (&mut gradient.by_rate, &tangents.damping),
                (&mut gradient.by_acceleration, &tangents.mass),
            ] {
                let entries = &matrix[row * size..(row + 1) * size];
                own.iter_mut().zip(entries).for_each(|(own, entry)| *own -= rate * entry);
            }
        }
    });
    Some(gradient)
}
