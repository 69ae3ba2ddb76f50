//! The simulated model: an immutable system, and the state that changes.

pub mod accumulated;
mod assembly;
mod builder;
mod constraints;
pub mod element_quantity;
pub mod energy_derivatives;
mod feedback;
mod limits;
mod mass;
mod output_derivatives;
mod parameter_difference;
mod reading;
mod rotors;
pub mod schemes;
pub mod settings;
pub mod solver_features;
mod state;
mod step_stages;
mod touch;
pub mod tuning;

use std::collections::BTreeMap;
use std::sync::Arc;

pub use accumulated::Need;
pub use builder::{BeamChain, BuildError, Builder, JointAttachment, PlaceOnTip, Placement};
pub use lissom_mechanics::evaluation::batch::ElementId;
pub use lissom_mechanics::evaluation::threads::Threads;
pub use lissom_mechanics::evaluation::{Blend, Linearization, Scratch, Sum, TangentAssembler, WORTH_WHILE};
pub use lissom_mechanics::joints::Drive;
pub use mass::Mass;
pub use output_derivatives::OutputDerivatives;
pub use parameter_difference::ParameterDifference;
pub use reading::{Quantity, Reading};
pub use state::State;
pub use step_stages::StepPoint;
pub use touch::{Touch, TouchKey};

use lissom_motion::Vector3;
use lissom_solver::Structure;

pub use constraints::rows_of_port;
use constraints::{Constraints, Placed};
pub use feedback::{DrivenBatch, Feedback, LeastValue, ScaledPower};
use lissom_contact::rigid::RigidContact;
use lissom_contact::set::ContactSet;
use lissom_flexible::beam::section_error::ExaminedBeams;
use lissom_mechanics::elements::contribution::CoordinateMass;
use lissom_mechanics::elements::inertia::{Gravity, Inertia};
use lissom_mechanics::elements::{Capabilities, Element, Energy, ForceLaws, Load, Unknowns};
use lissom_mechanics::evaluation::batch::AnyBatch;
use lissom_mechanics::evaluation::scatter_map::ScatterMap;
use lissom_mechanics::evaluation::work::{power, work};
use lissom_mechanics::joints::Constraint;
use lissom_mechanics::joints::attached::AttachedJoint;
use lissom_mechanics::joints::blocks::{Batches, JointBatch};
use lissom_mechanics::joints::constraint::{Port, ports_of};
use lissom_mechanics::joints::coupling::Coupling;
use lissom_mechanics::joints::latch::Latch;
use lissom_mechanics::joints::mean_motion::MeanMotion;
use lissom_mechanics::joints::slider::Slider;
use lissom_mechanics::joints::starts::JointStarts;
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, LOCKED, Layout, NodeId, Subject, Switch};
use lissom_mechanics::law::VisitLaw;
use lissom_mechanics::registry::Function;
use lissom_mechanics::signals::{Graph, SignalError};

/// Nodes, elements and joints with their numbering. Constant during a simulation, and independent of time and state.
pub struct System {
    /// Numbering of the unknowns.
    pub layout: Layout,
    /// Elements by kind, then the targets of signals.
    pub batches: Vec<Arc<dyn AnyBatch>>,
    /// All constraints.
    pub constraints: Constraints,
    /// The joints as they are evaluated.
    pub joint_lanes: JointLanes,
    /// Location of constraints that are not evaluated in lanes.
    pub placed: Vec<Placed>,
    /// Mass matrices of coordinates within elements.
    pub coordinate_masses: Vec<CoordinateMass>,
    /// Coordinates of no joint between nodes.
    pub free_coordinates: Vec<CoordinateId>,
    /// Parts and joint coordinates whose velocity at the start is given, even if it is zero.
    pub given_velocities: GivenVelocities,
    /// Functions of time of loads, springs and drives, with their description.
    pub functions: Vec<(Subject, Function)>,
    /// Pattern of the tangent, and groups of unknowns that are eliminated together.
    pub structure: Structure,
    /// Inertia of bodies and lumped masses of beams.
    pub inertias: Vec<Inertia>,
    /// Gravity.
    pub gravity: Gravity,
    /// Signals and their targets.
    pub feedback: DrivenBatch,
    /// Quantities that sampled signals depend on at samples alone.
    pub readings: Vec<Reading>,
    /// Beams whose strains and section forces are examined.
    pub beams: ExaminedBeams,
    /// Parts that touch without elements.
    pub contacts: Arc<ContactSet>,
}

/// Parts and joint coordinates with a given velocity at the start.
#[derive(Clone, Debug, Default)]
pub struct GivenVelocities {
    /// Nodes of bodies and point masses.
    pub nodes: Vec<NodeId>,
    /// Coordinates of joints.
    pub coordinates: Vec<CoordinateId>,
}

/// Joints by kind, several evaluated at a time, and where their equations are.
pub struct JointLanes {
    /// Joints by kind, in lanes.
    batches: Batches,
    /// Rows of every joint's local unknowns and equations, concatenated.
    rows: Vec<u32>,
    /// Offset of each joint's rows.
    starts: Vec<usize>,
    /// Positions of every joint's local matrix in the tangent.
    positions: ScatterMap,
}

impl System {
    /// Numbering of the unknowns.
    #[inline]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Sparsity and elimination groups of the tangent.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// A shared handle to the tangent's pattern.
    pub fn pattern(&self) -> Arc<lissom_solver::Pattern> {
        Arc::clone(&self.structure.pattern)
    }

    /// All joints between nodes.
    pub fn joints(&self) -> &[AttachedJoint] {
        &self.constraints.joints
    }

    /// Stores data of joints at the start of a step.
    #[inline]
    pub fn begin_step(&self, start: &Kinematics, out: &mut JointStarts) {
        self.joint_lanes.batches.begin(start, out);
    }

    /// All prescribed coordinates.
    pub fn drives(&self) -> &[Drive] {
        &self.constraints.drives
    }

    /// All relations between coordinates.
    pub fn couplings(&self) -> &[Coupling] {
        &self.constraints.couplings
    }

    /// All sliders along beams.
    pub fn sliders(&self) -> &[Slider] {
        &self.constraints.sliders
    }

    /// All bodies with the mean motion of a set of nodes.
    pub fn mean_motions(&self) -> &[MeanMotion] {
        &self.constraints.mean_motions
    }

    /// All latches.
    pub fn latches(&self) -> &[Latch] {
        &self.constraints.latches
    }

    /// All rigid contacts.
    pub fn rigid_contacts(&self) -> impl ExactSizeIterator<Item = &RigidContact> {
        self.constraints.rigid_contacts.iter().map(|own| &*own.contact)
    }

    /// Events at which the modes of rigid contacts may change, each with the index of its contact.
    pub fn contact_events(&self) -> &[(usize, usize)] {
        &self.constraints.contact_events
    }

    /// Parts that touch without elements.
    pub fn contacts(&self) -> &Arc<ContactSet> {
        &self.contacts
    }

    /// Whether there are rigid contacts.
    pub fn has_rigid_contacts(&self) -> bool {
        !self.constraints.rigid_contacts.is_empty()
    }

    /// Inertia of every node that has mass.
    pub fn inertias(&self) -> &[Inertia] {
        &self.inertias
    }

    /// The signals, and their inputs.
    pub fn signals(&self) -> &Graph {
        &self.feedback.graph
    }

    /// Whether forces of elements depend on multipliers.
    pub fn sees_multipliers(&self) -> bool {
        self.batches.iter().any(|batch| batch.sees_multipliers())
    }

    /// Number of elements and constraints that act on each node.
    pub fn attached(&self) -> Vec<usize> {
        let mut of_row = vec![None; self.layout.size()];
        for (node, rows) in self.layout.node_rows.iter().enumerate() {
            for &row in rows.iter().filter(|&&row| row != LOCKED) {
                of_row[row as usize] = Some(node);
            }
        }
        let mut counts = vec![0; self.layout.node_rows.len()];
        let of_elements = self.batches.iter().flat_map(|batch| batch.rows().cliques());
        let nodes_of =
            |rows: Vec<usize>| rows.into_iter().filter_map(|row| of_row[row]).collect::<Vec<usize>>();
        let of_constraints = self.constraints().map(|constraint| {
            let own = ports_of(constraint).into_iter();
            own.filter_map(|port| if let Port::Node(node) = port { Some(node.index()) } else { None })
                .collect()
        });
        for mut nodes in of_elements.chain(self.feedback.cliques()).map(nodes_of).chain(of_constraints) {
            nodes.sort_unstable();
            nodes.dedup();
            for node in nodes {
                counts[node] += 1;
            }
        }
        counts
    }

    /// Whether forces depend on the motion through signals or the functions of loads, or there are states.
    pub fn has_feedback(&self) -> bool {
        self.has_signal_feedback() || self.has_loads_of_motion()
    }

    /// Whether forces depend on the motion through signals, or there are states.
    pub fn has_signal_feedback(&self) -> bool {
        self.feedback.depends_on_motion() || self.layout.state_count() > 0
    }

    /// Values with a lower limit.
    pub fn least_values(&self) -> &[LeastValue] {
        &self.feedback.least_values
    }

    /// Whether rates of states are algebraic unknowns.
    pub fn has_balances(&self) -> bool {
        self.feedback.has_balances()
    }

    /// Whether loads depend on the motion beyond the rotation of their nodes, such as pressure.
    pub fn has_loads_of_motion(&self) -> bool {
        self.elements_with(|own| own.load).any(Load::depends_on_motion)
    }

    /// Full gravity [m/s²].
    pub fn gravity(&self) -> &Vector3 {
        &self.gravity.acceleration
    }

    /// The fraction of gravity that acts at `time` [s].
    pub fn gravity_factor(&self, time: f64) -> f64 {
        self.gravity.factor.as_ref().map_or(1.0, |factor| factor.value(time))
    }

    /// An element; none for a load scaled by a signal.
    pub fn element(&self, id: ElementId) -> Option<&dyn Element> {
        self.batches.get(id.batch?)?.element(id.item)
    }

    /// All elements with a capability.
    pub fn elements_with<'s, C: ?Sized + 's>(
        &'s self,
        capability: impl Fn(Capabilities<'s>) -> Option<&'s C> + Copy + 's,
    ) -> impl Iterator<Item = &'s C> {
        self.batches.iter().flat_map(move |batch| batch.elements_with(capability))
    }

    /// Kinetic, elastic and potential energy of all elements [J]; of touches without elements see [`energy_of`](Self::energy_of).
    pub fn energy(&self, at: &Kinematics) -> Energy {
        let of =
            |batch: &Arc<dyn AnyBatch>| batch.elements().map(|element| element.energy(at)).sum::<Energy>();
        self.batches.iter().map(of).sum()
    }

    /// Kinetic, elastic and potential energy of a state with its touches [J].
    pub fn energy_of(&self, state: &State) -> Energy {
        [self.energy(&state.kinematics), state.touch_energy()].into_iter().sum()
    }

    /// Elongation, its rate and the opposing force [SI] of a spring or similar element.
    pub fn spring_motion(&self, element: ElementId, at: &Kinematics) -> Option<[f64; 3]> {
        Some(self.element(element)?.capabilities().spring?.spring_motion(at))
    }

    /// Power that an element supplies to the rest of the model [W]: negative while it stores or dissipates energy.
    pub fn power(&self, element: ElementId, at: &Kinematics) -> f64 {
        match element.batch {
            None => self.feedback.power(element.item, at),
            Some(_) => self.element(element).map_or(0.0, |element| power(element, at)),
        }
    }

    /// Work of an element's forces on the rest of the model between two configurations [J], for forces that change
    /// linearly along the path.
    pub fn work_of(&self, element: ElementId, from: &Kinematics, to: &Kinematics) -> f64 {
        match element.batch {
            None => self.feedback.work(element.item, from, to),
            Some(_) => self.element(element).map_or(0.0, |element| work(element, (from, to), [1.0; 2])),
        }
    }

    /// Offset of each item's local values, for every batch of elements and every batch of joints.
    pub fn starts_of_batches(&self) -> impl Iterator<Item = &[usize]> {
        let elements = self.batches.iter().map(|batch| batch.rows().starts());
        elements.chain(self.joint_lanes.batches.iter().map(JointBatch::starts))
    }

    /// Work of loads between two configurations [J], for forces that change linearly in time between them and positions
    /// that are cubic polynomials.
    #[inline]
    pub fn work_of_loads(&self, from: &Kinematics, to: &Kinematics) -> f64 {
        self.sum_over_loads(|load| load.work(from, to), || self.feedback.work_of_all(from, to))
    }

    /// Power of loads [W].
    pub fn power_of_loads(&self, at: &Kinematics) -> f64 {
        self.sum_over_loads(|load| load.power(at), || self.feedback.power_of_all(at))
    }

    /// Sum over loads, first of every kind, and over those scaled by signals.
    fn sum_over_loads(&self, of: impl Fn(&dyn Load) -> f64, of_scaled: impl Fn() -> f64) -> f64 {
        let loads = |batch: &Arc<dyn AnyBatch>| {
            batch.elements_with(|own| own.load).filter(|load| load.is_active()).map(&of).sum::<f64>()
        };
        self.batches.iter().map(loads).chain([of_scaled()]).sum()
    }

    /// Power of prescribed motions, with all multipliers [W].
    pub fn power_of_drives(&self, at: &Kinematics, multipliers: &[f64]) -> f64 {
        if self.placed.is_empty() {
            return 0.0;
        }
        self.constraints.others().map(|constraint| constraint.power(at, multipliers)).sum()
    }

    /// Work of prescribed motions between two configurations with their multipliers, likewise [J].
    pub fn work_of_drives(&self, from: (&Kinematics, &[f64]), to: (&Kinematics, &[f64])) -> f64 {
        if self.placed.is_empty() {
            return 0.0;
        }
        self.constraints.others().map(|constraint| constraint.work(from, to)).sum()
    }

    /// Checks that all signals, and all functions of loads, have values.
    ///
    /// # Errors
    /// If one is not finite.
    pub fn check_functions(&self, at: &Kinematics) -> Result<(), SignalError> {
        self.signals().check(at)?;
        self.elements_with(|own| own.load).try_for_each(|load| load.check(at))
    }

    /// The first function of time that has no finite value, or no finite derivative, at `time` [s]: its description
    /// and the value.
    pub fn function_without_value(&self, time: f64) -> Option<(&Subject, f64)> {
        self.functions.iter().find_map(|(words, function)| {
            function.jet(time).into_iter().find(|value| !value.is_finite()).map(|value| (words, value))
        })
    }

    /// Known breakpoints of loads, prescribed motions, states and event functions [s], in ascending order.
    pub fn breakpoints(&self) -> Vec<f64> {
        let of_constraints = self.constraints.others().flat_map(Constraint::breakpoints);
        let of_events = self.signals().breakpoints_of(self.signals().events().iter().map(|event| event.root));
        let of_loads =
            self.elements_with(|own| own.load).flat_map(Load::breakpoints).chain(self.feedback.breakpoints());
        let mut breakpoints: Vec<f64> = of_loads.chain(of_constraints).chain(of_events).collect();
        breakpoints.sort_by(f64::total_cmp);
        breakpoints.dedup();
        breakpoints
    }

    /// Appends switching functions, which change their sign where forces of elements have a kink or a jump: the same
    /// number at every configuration.
    pub fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        self.elements_with(|own| own.laws).for_each(|element| element.switches(at, out));
    }

    /// Updates the [`switches`](Self::switches) of elements with a function that is wanted, from the index `first` of `out` on; others keep
    pub fn update_switches(
        &self,
        at: &Kinematics,
        (first, are_wanted): (usize, &[bool]),
        out: &mut Vec<Switch>,
    ) {
        let (mut next, end) = (first, out.len());
        for element in self.elements_with(|own| own.laws) {
            let own = next..next + element.switch_count();
            next = own.end;
            if are_wanted[own.clone()].contains(&true) {
                element.switches(at, out);
                out.copy_within(end.., own.start);
                out.truncate(end);
            }
        }
    }

    /// For each switching function or law of the elements, the index of the first one in its group, or its own index if it has no
    /// group. `count` returns their number for an element.
    fn leaders(&self, count: impl Fn(&dyn ForceLaws) -> usize) -> Vec<usize> {
        let mut first = BTreeMap::new();
        let mut leaders = Vec::new();
        for element in self.elements_with(|own| own.laws) {
            let own = leaders.len();
            let leader = element.group().map_or(own, |group| *first.entry(group).or_insert(own));
            leaders.extend((0..count(element)).map(|k| leader + k));
        }
        leaders
    }

    /// For each of the [`switches`](Self::switches) the index of the first one in its group.
    pub fn leaders_of_switches(&self) -> Vec<usize> {
        self.leaders(ForceLaws::switch_count)
    }

    /// For each law of an element the index of the first one in its group. The laws of signals precede these.
    pub fn leaders_of_laws(&self, at: &Kinematics) -> Vec<usize> {
        self.leaders(|element| {
            let mut count = 0;
            element.laws(at, &mut |_, _| count += 1);
            count
        })
    }

    /// Passes the scalar laws of signals, elements and relations that depend on the motion to `visit`, with their arguments:
    /// the same laws in the same order at every configuration.
    pub fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        self.signals().laws(at, visit);
        self.elements_with(|own| own.laws).for_each(|element| element.laws(at, visit));
        self.constraints.others().for_each(|constraint| constraint.laws(at, visit));
    }

    /// Description of the law of this index.
    pub fn name_of_law(&self, which: usize, at: &Kinematics) -> Subject {
        let mut names = self.signals().names_of_laws();
        for element in self.elements_with(|own| own.laws) {
            element.laws(at, &mut |_, _| names.push(self.subject_of(element.unknowns())));
        }
        for constraint in self.constraints.others() {
            let words = format!("the relation `{}`", constraint.name());
            constraint
                .laws(at, &mut |_, _| names.push(Subject::new("", constraint.name()).called(words.clone())));
        }
        names.get(which).cloned().unwrap_or_else(|| Subject::nameless("a law"))
    }

    /// Description of the switch of this index: those of signals are first.
    pub fn name_of_switch(&self, which: usize) -> Subject {
        let mut names = self.signals().names_of_switches();
        for element in self.elements_with(|own| own.laws) {
            let subject = || self.subject_of(element.unknowns());
            let own = element.switch_subjects();
            names.extend(own.unwrap_or_else(|| vec![subject(); element.switch_count()]));
        }
        names.get(which).cloned().unwrap_or_else(|| Subject::nameless("a force with a kink or a jump"))
    }

    /// The force of an element, by where it acts.
    fn subject_of(&self, unknowns: Unknowns<'_>) -> Subject {
        let coordinates = unknowns.coordinates.iter().map(|&own| self.layout.coordinate_name(own));
        let names: Vec<&str> =
            coordinates.chain(unknowns.nodes.iter().map(|&node| self.layout.name_of_node(node))).collect();
        let words = format!("the force on `{}`", names.join("` and `"));
        Subject::new("", names.first().copied().unwrap_or_default()).called(words)
    }
}
