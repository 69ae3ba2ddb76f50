//! Distribution of a mode's energy over parts, and its effective masses along and about each axis.

use std::collections::BTreeMap;

use lissom_motion::{Vector3, Vector6, screw};
use num_complex::Complex64;

use super::DISPLACEMENT;
use super::mode::Mode;
use super::model::LinearModel;
use super::shapes::part_of;
use crate::elements::Unknowns;
use crate::kinematics::{GROUND, Kinematics, LOCKED, NodeId, Quantity};
use crate::node_motion::displace;

use crate::system::Mass;

/// Effective masses: translations along x, y and z [kg], rotations about them through the centre of mass [kg m²].
pub type EffectiveMasses = [f64; 6];

impl LinearModel<'_> {
    /// Share of each part in the strain energy of a mode, by name: second differences of the energy of its elements along the
    /// shape, so that forces at the state are included. An element belongs to the part of its first node that is not the
    /// ground, or to the joint on whose coordinate it acts. The sum is 1; parts under compression may have shares below 0.
    /// Empty for a mode without strain.
    pub fn strain_shares(&self, mode: &Mode) -> BTreeMap<String, f64> {
        let mut shares = BTreeMap::new();
        for take in [(|value: &Complex64| value.re) as fn(&Complex64) -> f64, |value| value.im] {
            let rows: Vec<f64> = mode.shape.iter().map(take).collect();
            let largest = self.largest(&rows);
            if largest == 0.0 {
                continue;
            }
            let step = DISPLACEMENT / largest;
            for (sense, weight) in [(1.0, 1.0), (-1.0, 1.0), (0.0, -2.0)] {
                let at = self.displaced(&rows, sense * step);
                for element in self.system.batches.iter().flat_map(|batch| batch.elements()) {
                    let energy = element.energy(&at).strain;
                    if energy != 0.0 {
                        let name = self.owner(element.unknowns());
                        *shares.entry(name).or_insert(0.0) += weight * energy / (step * step);
                    }
                }
            }
        }
        let total: f64 = shares.values().sum();
        let all: f64 = shares.values().map(|value| value.abs()).sum();
        // Differences for a rigid motion are round-off.
        let rate = mode.eigenvalue.norm_sqr();
        if rate == 0.0 || total <= DISPLACEMENT * all {
            return BTreeMap::new();
        }
        for share in shares.values_mut() {
            *share /= total;
        }
        shares
    }

    /// Effective masses of modes of unit modal mass: the square of the participation in a rigid motion of the model along and
    /// about each axis of space. The sum over all modes of a model is that of [`masses`](Self::masses), minus the mass fixed
    /// to the ground.
    pub fn effective_masses(&self, modes: &[Mode]) -> Vec<EffectiveMasses> {
        let momenta = self.rigid_momenta();
        let participation = |mode: &Mode, momenta: &[f64]| {
            let products = mode.shape.iter().zip(momenta).map(|(shape, momentum)| shape.conj() * *momentum);
            products.sum::<Complex64>().norm_sqr()
        };
        modes.iter().map(|mode| std::array::from_fn(|k| participation(mode, &momenta[k]))).collect()
    }

    /// Momenta of all coordinates in the six rigid motions of unit speed about the centre of mass.
    fn rigid_momenta(&self) -> [Vec<f64>; 6] {
        let (centre, layout) = (self.centre(), self.system.layout());
        let mut momenta = [(); 6].map(|()| vec![0.0; layout.coordinate_count()]);
        for (k, all) in momenta.iter_mut().enumerate() {
            for inertia in self.system.inertias() {
                let rows = layout.rows_of_node(inertia.node());
                let momentum = inertia.mass() * self.rigid_twist(inertia.node(), k, &centre);
                for (&row, value) in rows.iter().zip(momentum.iter()).filter(|(row, _)| **row != LOCKED) {
                    all[row as usize] += value;
                }
            }
        }
        self.system.masses(&self.at, &mut |mass| {
            for (k, all) in momenta.iter_mut().enumerate() {
                mass.times(&self.rigid_rates(mass, k, &centre), |row, momentum| {
                    if mass.rows[row] != LOCKED {
                        all[mass.rows[row] as usize] += momentum;
                    }
                });
            }
        });
        momenta
    }

    /// Mass [kg], three times, and moments of inertia about the axes of space through the centre of mass [kg m²].
    pub fn masses(&self) -> EffectiveMasses {
        let centre = self.centre();
        [0, 1, 2, 3, 4, 5].map(|k| {
            let of = |inertia: &crate::elements::inertia::Inertia| {
                let twist = self.rigid_twist(inertia.node(), k, &centre);
                twist.dot(&(inertia.mass() * twist))
            };
            let mut sum: f64 = self.system.inertias().iter().map(of).sum();
            self.system.masses(&self.at, &mut |mass| {
                let rigid = self.rigid_rates(mass, k, &centre);
                mass.times(&rigid, |row, momentum| sum += rigid[row] * momentum);
            });
            sum
        })
    }

    /// Twists of an element's nodes in the rigid motion `k` of unit speed about `centre`; its coordinates are at rest.
    fn rigid_rates(&self, mass: &Mass<'_>, k: usize, centre: &Vector3) -> Vec<f64> {
        let twists = mass.nodes.iter().map(|&node| self.rigid_twist(node, k, centre));
        let mut rates: Vec<f64> =
            twists.flat_map(|twist| twist.iter().copied().collect::<Vec<_>>()).collect();
        rates.resize(mass.rows.len(), 0.0);
        rates
    }

    /// The state displaced along the real part of a mode's shape, scaled so that the largest displacement over the model's
    /// length, or the largest rotation, is `largest`.
    pub fn moved_along(&self, mode: &Mode, largest: f64) -> Kinematics {
        let rows: Vec<f64> = mode.shape.iter().map(|value| value.re).collect();
        let own = self.largest(&rows);
        self.displaced(&rows, if own > 0.0 { largest / own } else { 0.0 })
    }

    /// Twist of a node, in its axes, in the rigid motion `k` of unit speed about `centre`.
    fn rigid_twist(&self, node: NodeId, k: usize, centre: &Vector3) -> Vector6 {
        let frame = self.at.nodes[node].frame;
        let axis = Vector3::from_fn(|i, _| if i == k % 3 { 1.0 } else { 0.0 });
        let (velocity, turning) =
            if k < 3 { (axis, Vector3::zeros()) } else { (axis.cross(&(frame.position - centre)), axis) };
        screw(&frame.rotation.apply_inverse(&velocity), &frame.rotation.apply_inverse(&turning))
    }

    /// Centre of mass [m].
    fn centre(&self) -> Vector3 {
        let (mut mass, mut moment) = (0.0, Vector3::zeros());
        for inertia in self.system.inertias() {
            let matrix = inertia.mass();
            let own = matrix[(0, 0)];
            if own <= 0.0 {
                continue;
            }
            // Momentum of a rotation is -m c\u{303}, c the centre in the node's axes.
            let offset = Vector3::new(matrix[(2, 4)], matrix[(0, 5)], matrix[(1, 3)]) / -own;
            mass += own;
            moment += own * self.at.nodes[inertia.node()].frame.transform_point(&offset);
        }
        self.system.masses(&self.at, &mut |own| {
            let origin = Vector3::zeros();
            let product = |one: usize, other: usize| {
                let (one, other) =
                    (self.rigid_rates(own, one, &origin), self.rigid_rates(own, other, &origin));
                let mut sum = 0.0;
                own.times(&other, |row, momentum: f64| sum += one[row] * momentum);
                sum
            };
            mass += product(0, 0);
            moment += Vector3::new(product(1, 5), product(2, 3), product(0, 4));
        });
        if mass > 0.0 { moment / mass } else { moment }
    }

    /// Largest displacement over the model's length, or rotation.
    fn largest(&self, rows: &[f64]) -> f64 {
        let length = self.representative.length;
        let length = if length > 0.0 { length } else { 1.0 };
        let scaled =
            rows.iter().zip(self.system.layout().quantities()).map(|(value, quantity)| match quantity {
                Quantity::Length => value.abs() / length,
                Quantity::Angle | Quantity::State => value.abs(),
            });
        scaled.fold(0.0, f64::max)
    }

    /// The state moved by `share` of displacements by row.
    fn displaced(&self, rows: &[f64], share: f64) -> Kinematics {
        let mut at = self.at.clone();
        displace(&mut at, self.system.layout(), rows, share);
        at
    }

    /// The part or joint to which an element with these unknowns belongs: that of its first node that is not the ground, or of its
    /// first coordinate.
    fn owner(&self, unknowns: Unknowns<'_>) -> String {
        let layout = self.system.layout();
        if let Some(&node) = unknowns.nodes.iter().find(|&&node| node != GROUND) {
            return part_of(layout.node_name(node)).to_owned();
        }
        let name = unknowns.coordinates.first().map_or("ground", |&own| layout.coordinate_name(own));
        name.rsplit_once('.').map_or(name, |(joint, _)| joint).to_owned()
    }
}
