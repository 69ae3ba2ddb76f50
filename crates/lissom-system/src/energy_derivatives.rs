//! Derivatives of the energies and momenta of a system.
//!
//! Legend: M mass matrix, v velocities, V potential and U strain energy, f forces at rest and in free fall, p momentum.
//!
//! ```text
//! kinetic ½ v·M v:   by velocities M v, by positions ½ v·∂(M v)/∂q          U:  f          V:  -g·∂p/∂v
//! ```

use super::{Mass, System};
use lissom_mechanics::elements::contribution::CoordinateMass;
use lissom_mechanics::elements::{Capabilities, Element, Tangents};
use lissom_mechanics::kinematics::{GROUND, Kinematics, NodeId, split};
use lissom_motion::{Matrix6, Vector3, Vector6, screw};

/// Derivatives of a number with respect to positions, as body variations and coordinates, and to velocities, by row.
#[derive(Clone, Debug)]
pub struct Slopes {
    /// With respect to positions.
    pub by_place: Vec<f64>,
    /// With respect to velocities.
    pub by_rate: Vec<f64>,
}

/// Mass of a node or an element, with what depends on it.
struct Moving<'a> {
    mass: Mass<'a>,
    /// Derivatives of the momenta with respect to positions; none if they are constant in the axes of the node.
    by_place: Option<&'a [f64]>,
}

impl Moving<'_> {
    /// Derivatives of the local momentum `row` with respect to the velocity and the position of the unknown `column`.
    fn entries(&self, row: usize, column: usize) -> [f64; 2] {
        let entry = row * self.mass.rows.len() + column;
        [self.mass.matrix[entry], self.by_place.map_or(0.0, |by_place| by_place[entry])]
    }

    /// Derivatives of the momenta of the local node `node`, in its axes.
    fn of_node(&self, node: usize, column: usize) -> [Vector6; 2] {
        [0, 1].map(|k| Vector6::from_fn(|i, _| self.entries(6 * node + i, column)[k]))
    }
}

impl System {
    /// Derivatives of kinetic, strain and potential energy.
    pub fn energy_slopes(&self, at: &Kinematics) -> [Slopes; 3] {
        let [mut kinetic, mut strain, mut potential] = [(); 3].map(|()| self.no_slopes());
        let fall = stopped(at, |at, node| {
            let weight = at.nodes[node].frame.rotation.apply_inverse(&self.gravity.at(at.time));
            screw(&weight, &Vector3::zeros())
        });
        for batch in &self.batches {
            for (item, element) in batch.elements().enumerate() {
                let rows = batch.rows().of(item);
                let mut slopes = vec![0.0; rows.len()];
                strain_slopes(element, &fall, &mut slopes);
                rows.iter().zip(slopes).for_each(|(&row, slope)| add(&mut strain.by_place, row, slope));
            }
        }
        self.each_mass(at, |moving| {
            let (mass, rates) = (&moving.mass, self.local_rates(&moving.mass, at));
            for (column, &row) in mass.rows.iter().enumerate() {
                for (own, rate) in rates.iter().enumerate() {
                    let [by_rate, by_place] = moving.entries(own, column);
                    add(&mut kinetic.by_rate, row, rate * by_rate);
                    add(&mut kinetic.by_place, row, 0.5 * rate * by_place);
                }
                for (k, &node) in mass.nodes.iter().enumerate() {
                    let (linear, _) = split(&moving.of_node(k, column)[0]);
                    let weight = at.nodes[node].frame.rotation.apply(&linear).dot(&self.gravity.acceleration);
                    add(&mut potential.by_place, row, -weight);
                }
            }
        });
        for CoordinateMass { coordinates, matrix } in &self.coordinate_masses {
            for (i, &own) in coordinates.iter().enumerate() {
                let momentum = coordinates.iter().enumerate();
                let momentum: f64 =
                    momentum.map(|(k, &k_own)| matrix[(i, k)] * at.coordinates[k_own].rate).sum();
                add(&mut kinetic.by_rate, self.layout.coordinate_rows[own.index()], momentum);
            }
        }
        [kinetic, strain, potential]
    }

    /// Derivatives of momentum and angular momentum about the origin, in inertial axes.
    ///
    /// ```text
    /// δ(R p) = R (δp + θ × p),      δ(R l + x × R p) = R (δl + θ × l) + x × R (δp + θ × p) + R u × R p
    /// ```
    pub fn momentum_slopes(&self, at: &Kinematics) -> [Slopes; 6] {
        let mut all = [(); 6].map(|()| self.no_slopes());
        let mut note = |row: u32, is_rate: bool, change: &Vector6| {
            for (slopes, &value) in all.iter_mut().zip(change.iter()) {
                add(if is_rate { &mut slopes.by_rate } else { &mut slopes.by_place }, row, value);
            }
        };
        self.each_mass(at, |moving| {
            let (mass, rates) = (&moving.mass, self.local_rates(&moving.mass, at));
            let mut momenta = vec![0.0; rates.len()];
            mass.times(&rates, |row, value| momenta[row] = value);
            for (k, &node) in mass.nodes.iter().enumerate() {
                let frame = &at.nodes[node].frame;
                let about_origin = |local: &Vector6| {
                    let (linear, angular) = split(local);
                    let linear = frame.rotation.apply(&linear);
                    screw(&linear, &(frame.rotation.apply(&angular) + frame.position.cross(&linear)))
                };
                for (column, &row) in mass.rows.iter().enumerate() {
                    let [by_rate, by_place] = moving.of_node(k, column);
                    note(row, true, &about_origin(&by_rate));
                    note(row, false, &about_origin(&by_place));
                }
                let (p, l) = split(&Vector6::from_column_slice(&momenta[6 * k..6 * k + 6]));
                for i in 0..3 {
                    let unit = Vector3::ith(i, 1.0);
                    let moved = frame.rotation.apply(&unit.cross(&p));
                    note(mass.rows[6 * k + i], false, &screw(&Vector3::zeros(), &moved));
                    let turned = about_origin(&screw(&unit.cross(&p), &unit.cross(&l)));
                    note(mass.rows[6 * k + 3 + i], false, &turned);
                }
            }
        });
        for element in self.elements_with(|own| own.inertia) {
            let momentum = element.angular_momentum(at);
            let Some(&node) = element.unknowns().nodes.first() else { continue };
            for i in 0..3 {
                let axis = at.nodes[node].frame.rotation.apply(&Vector3::ith(i, 1.0));
                let turned = screw(&Vector3::zeros(), &axis.cross(&momentum));
                note(self.layout.rows_of_node(node)[3 + i], false, &turned);
            }
        }
        all
    }

    fn no_slopes(&self) -> Slopes {
        let zeros = vec![0.0; self.layout.coordinate_count()];
        Slopes { by_place: zeros.clone(), by_rate: zeros }
    }

    /// Calls `each` for the mass of every node and element, with the derivatives of M v with respect to positions, which are
    /// those of M a at rest for a = v.
    fn each_mass(&self, at: &Kinematics, mut each: impl FnMut(&Moving<'_>)) {
        for inertia in &self.inertias {
            let matrix: &Matrix6 = inertia.mass();
            let node = inertia.node();
            let rows = self.layout.rows_of_node(node);
            // Symmetric: columns are rows.
            let mass = Mass { nodes: &[node], rows, matrix: matrix.as_slice() };
            each(&Moving { mass, by_place: None });
        }
        let rest = stopped(at, |_, _| Vector6::zeros());
        let mut thrust = stopped(at, |at, node| at.nodes[node].twist);
        for (own, moving) in thrust.coordinates.iter_mut().zip(&at.coordinates) {
            own.acceleration = moving.rate;
        }
        self.each_own_mass(&thrust, |element, mass| {
            let [mut slopes, mut still] = [(); 2].map(|()| Tangents::new(mass.rows.len()));
            element.linearize(&thrust, &mut slopes);
            element.linearize(&rest, &mut still);
            slopes.stiffness.iter_mut().zip(&still.stiffness).for_each(|(own, still)| *own -= still);
            each(&Moving { mass: *mass, by_place: Some(&slopes.stiffness) });
        });
    }
}

/// Adds the derivatives of an element's strain energy, from the configuration at rest and in free fall. Without inertia and weight other
/// forces than loads are these derivatives, unless the element has its own.
fn strain_slopes(element: &dyn Element, fall: &Kinematics, out: &mut [f64]) {
    match element.capabilities() {
        Capabilities { strain: Some(own), .. } => own.strain_slopes(fall, out),
        Capabilities { load: Some(load), .. } if load.is_active() => {}
        _ => element.forces(fall, out),
    }
}

/// Configuration `at` without velocities; `acceleration` is that of a node.
fn stopped(at: &Kinematics, acceleration: impl Fn(&Kinematics, NodeId) -> Vector6) -> Kinematics {
    let mut stopped = at.clone();
    for (id, node) in NodeId::enumerate(&mut stopped.nodes) {
        node.acceleration = if id == GROUND { Vector6::zeros() } else { acceleration(at, id) };
        node.twist = Vector6::zeros();
    }
    for own in &mut stopped.coordinates {
        (own.rate, own.acceleration) = (0.0, 0.0);
    }
    stopped
}

/// Adds to the entry of a row, unless the row is locked or of a multiplier.
fn add(to: &mut [f64], row: u32, value: f64) {
    if let Some(own) = to.get_mut(row as usize) {
        *own += value;
    }
}
