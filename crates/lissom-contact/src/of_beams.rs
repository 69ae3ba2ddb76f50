//! Contact of a part with a section of a beam: [`Contact`] between the part and the frame of the section, whose forces act on the
//! nodes of the beam.
//!
//! Legend: b and s base and section, F, K, C forces of the contact and their derivatives by positions and twists of both, B_i and E_i
//! derivatives of position and twist of the section by positions of node i, see [`Section`]; G_ij derivatives of B_iᵀ F_s at
//! constant F_s.
//!
//! ```text
//! F_i = B_iᵀ F_s,      K_ij = B_iᵀ (K_ss B_j + C_ss E_j) + G_ij,      C_ij = B_iᵀ C_ss B_j
//! ```

use std::cell::RefCell;
use std::sync::Arc;

use lissom_motion::{Matrix6, Vector6};
use nalgebra::{Matrix3x6, Matrix6x3, SMatrix};

use crate::elastic::{Contact, ContactFriction, Dissipation, STATES};
use crate::geometry::gap::Pair;
use crate::reading::{ContactElement, ContactReading};
use lissom_flexible::beam::section::{Section, SectionMotion};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::{
    Capabilities, Element, Energy, ForceLaws, Limit, LimitKind, Place, Spring, StrainSlopes, Tangents,
    Unknowns, Validity, add_block,
};
use lissom_mechanics::evaluation::switch_states::{SwitchStates, frozen_branch};
use lissom_mechanics::kinematics::{
    CarriedFrame, CoordinateId, CoordinateMotion, GROUND, Kinematics, MAX_NODES, NodeId, NodeMotion, Switch,
};
use lissom_mechanics::law::VisitLaw;
use lissom_mechanics::signals::measurement::Gradient;

/// Base and section as nodes of the contact between them.
const BASE: NodeId = NodeId::new(0);
const SECTION: NodeId = NodeId::new(1);
/// Rows of the section, and of the states of the bristles, in the equations of that contact.
const SECTION_ROWS: usize = 6;
const BRISTLES: usize = 12;

/// A part and a section of a beam that may touch.
#[derive(Clone, Debug)]
pub struct BeamContact {
    /// Between base and section as two nodes.
    contact: Contact,
    base: NodeId,
    section: Section,
    bristles: Vec<CoordinateId>,
    /// Nodes of the contact, each once, without the ground.
    nodes: Vec<NodeId>,
    switch_states: SwitchStates,
}

/// Base and section as two nodes, and the derivatives of their contact.
struct Scratch {
    at: Kinematics,
    tangents: Tangents,
}

thread_local! {
    static SCRATCH: RefCell<Option<Scratch>> = const { RefCell::new(None) };
}

/// A node on which the contact acts: its slot among the local nodes, which of base and section it carries, and B and E.
struct Carrier {
    slot: usize,
    row: usize,
    columns: Matrix6,
    twist_by: Matrix6,
}

impl BeamContact {
    /// Between a base and a section.
    pub fn new(
        base: CarriedFrame,
        section: Section,
        pair: Arc<dyn Pair>,
        (compliance, dissipation): (Compliance, f64),
        friction: Option<ContactFriction>,
    ) -> Self {
        let bristles = friction.as_ref().map(|friction| friction.bristles.clone()).unwrap_or_default();
        let friction =
            friction.map(|own| ContactFriction { bristles: CoordinateId::first(STATES).collect(), ..own });
        let frames = [CarriedFrame { node: BASE, offset: base.offset }, CarriedFrame::of_node(SECTION)];
        let law = (compliance, Dissipation::Factor(dissipation));
        let mut contact = Contact::new(frames, pair, law, friction);
        if let Some(states) = contact.switch_states() {
            *states = SwitchStates::held_at(0, 1);
        }
        let mut nodes = Vec::new();
        for node in [base.node].into_iter().chain(section.frames().map(|frame| frame.node)) {
            if node != GROUND && !nodes.contains(&node) {
                nodes.push(node);
            }
        }
        Self { contact, base: base.node, section, bristles, nodes, switch_states: SwitchStates::default() }
    }

    /// Sets the name that warnings contain.
    pub fn with_name(mut self, name: &str) -> Self {
        self.contact = self.contact.with_name(name);
        self
    }

    /// Evaluates the contact between base and section as two nodes.
    fn between<R>(
        &self,
        at: &Kinematics,
        work: impl FnOnce(&Contact, &mut Scratch, &SectionMotion) -> R,
    ) -> R {
        // Taken out while it is in use, so that a law that evaluates another contact finds none and makes its own.
        let mut scratch = SCRATCH.take().unwrap_or_else(|| Scratch {
            at: Kinematics {
                time: 0.0,
                elapsed: 0.0,
                nodes: vec![NodeMotion::at_rest(lissom_motion::Motion::identity()); 2],
                coordinates: vec![CoordinateMotion::default(); STATES],
                held: vec![0.0],
                multipliers: Vec::new(),
                units: Vec::new(),
            },
            tangents: Tangents::new(BRISTLES + STATES),
        });
        let section = self.section.motion(at);
        let two = &mut scratch.at;
        (two.time, two.elapsed) = (at.time, at.elapsed);
        two.nodes[BASE] = at.nodes[self.base];
        two.nodes[SECTION] = section.motion;
        for (own, &bristle) in two.coordinates.iter_mut().zip(&self.bristles) {
            *own = at.coordinates[bristle];
        }
        two.held[0] = self.switch_states.of(at).first().copied().unwrap_or(0.0);
        let result = work(&self.contact, &mut scratch, &section);
        SCRATCH.set(Some(scratch));
        result
    }

    fn slot(&self, node: NodeId) -> Option<usize> {
        self.nodes.iter().position(|own| *own == node)
    }

    fn carriers(&self, section: &SectionMotion, has_twists: bool) -> impl Iterator<Item = (usize, Carrier)> {
        let columns = section.columns();
        let twist_by = if has_twists { section.twist_by() } else { [Matrix6::zeros(); MAX_NODES] };
        let of_base = self.slot(self.base).map(|slot| {
            let (columns, twist_by) = (Matrix6::identity(), Matrix6::zeros());
            (MAX_NODES, Carrier { slot, row: 0, columns, twist_by })
        });
        let of_section = self.section.frames().enumerate().filter_map(move |(i, frame)| {
            let slot = self.slot(frame.node)?;
            let (columns, twist_by) = (columns[i], twist_by[i]);
            Some((i, Carrier { slot, row: SECTION_ROWS, columns, twist_by }))
        });
        of_base.into_iter().chain(of_section)
    }

    /// Adds to the equations of the nodes what acts on base, section and bristles.
    fn add(&self, section: &SectionMotion, local: &[f64; BRISTLES + STATES], out: &mut [f64]) {
        for (_, Carrier { slot, row, columns, .. }) in self.carriers(section, false) {
            let force = columns.tr_mul(&Vector6::from_column_slice(&local[row..row + 6]));
            out[6 * slot..6 * slot + 6].iter_mut().zip(&force).for_each(|(sum, own)| *sum += own);
        }
        let states = &mut out[6 * self.nodes.len()..];
        states.iter_mut().zip(&local[BRISTLES..]).for_each(|(sum, own)| *sum += own);
    }
}

/// A block of a matrix of the contact between two nodes.
fn block<const R: usize, const C: usize>(
    matrix: &[f64],
    size: usize,
    (row, column): (usize, usize),
) -> SMatrix<f64, R, C> {
    SMatrix::from_fn(|i, j| matrix[(row + i) * size + column + j])
}

impl Element for BeamContact {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.nodes, coordinates: &self.bristles, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        self.between(at, |contact, scratch, section| {
            let mut local = [0.0; BRISTLES + STATES];
            contact.forces(&scratch.at, &mut local[..BRISTLES + self.bristles.len()]);
            self.add(section, &local, out);
        });
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.between(at, |contact, scratch, section| {
            let own = BRISTLES + self.bristles.len();
            let mut local = [0.0; BRISTLES + STATES];
            contact.forces(&scratch.at, &mut local[..own]);
            let wrench = Vector6::from_column_slice(&local[SECTION_ROWS..SECTION_ROWS + 6]);
            let Scratch { at, tangents } = scratch;
            tangents.clear(own);
            contact.linearize(at, tangents);
            let (stiffness, damping) = (&tangents.stiffness, &tangents.damping);
            let (size, states) = (out.size(), 6 * self.nodes.len());
            let geometric = section.forces_by(&wrench);
            let has_states = !self.bristles.is_empty();
            let mut carriers = [const { None }; MAX_NODES + 1];
            carriers.iter_mut().zip(self.carriers(section, true)).for_each(|(own, each)| *own = Some(each));
            for (j, column) in carriers.iter().flatten() {
                // Of base and section, by the motion of the node.
                let of_both = [0, SECTION_ROWS].map(|row| {
                    let [k, c] = [stiffness, damping].map(|of| block::<6, 6>(of, own, (row, column.row)));
                    [k * column.columns + c * column.twist_by, c * column.columns]
                });
                for (i, row) in carriers.iter().flatten() {
                    let [by_place, by_rate] = &of_both[usize::from(row.row == SECTION_ROWS)];
                    let mut by_place = row.columns.tr_mul(by_place);
                    if *i < MAX_NODES && *j < MAX_NODES {
                        by_place += geometric[*i][*j];
                    }
                    let place = (6 * row.slot, 6 * column.slot);
                    add_block(&mut out.stiffness, size, place, &by_place);
                    add_block(&mut out.damping, size, place, &row.columns.tr_mul(by_rate));
                }
                if has_states {
                    let [k, c]: [Matrix3x6<f64>; 2] =
                        [stiffness, damping].map(|of| block(of, own, (BRISTLES, column.row)));
                    let place = (states, 6 * column.slot);
                    let by_place = k * column.columns + c * column.twist_by;
                    add_block(&mut out.stiffness, size, place, &by_place);
                    add_block(&mut out.damping, size, place, &(c * column.columns));
                    let by_state: Matrix6x3<f64> = block(stiffness, own, (column.row, BRISTLES));
                    let by_state = column.columns.tr_mul(&by_state);
                    add_block(&mut out.stiffness, size, (6 * column.slot, states), &by_state);
                }
            }
            if has_states {
                for (of, out) in [(stiffness, &mut out.stiffness), (damping, &mut out.damping)] {
                    let own = block::<STATES, STATES>(of, own, (BRISTLES, BRISTLES));
                    add_block(out, size, (states, states), &own);
                }
            }
        });
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        if self.is_idle(at) {
            return Energy::default();
        }
        self.between(at, |contact, scratch, _| contact.energy(&scratch.at))
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities {
            spring: Some(self),
            validity: Some(self),
            laws: Some(self),
            strain: Some(self),
            ..Capabilities::default()
        }
    }
}

impl ContactElement for BeamContact {
    fn reading(&self, at: &Kinematics) -> ContactReading {
        self.between(at, |contact, scratch, _| contact.reading(&scratch.at))
    }
}

impl Spring for BeamContact {
    fn dissipates(&self) -> bool {
        self.contact.dissipates()
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        self.between(at, |contact, scratch, _| contact.spring_motion(&scratch.at))
    }

    fn spring_gradients(&self, at: &Kinematics) -> Option<[Gradient; 3]> {
        self.between(at, |contact, scratch, section| {
            let of_two = contact.spring_gradients(&scratch.at)?;
            let mut all = [Gradient::zero(), Gradient::zero(), Gradient::zero()];
            for (_, Carrier { slot, row, columns, twist_by }) in self.carriers(section, true) {
                for (own, two) in all.iter_mut().zip(&of_two) {
                    let [by_place, by_rate] =
                        [&two.by_place, &two.by_rate].map(|of| Vector6::from_column_slice(&of[row..row + 6]));
                    let moved = columns.tr_mul(&by_place) + twist_by.tr_mul(&by_rate);
                    let turned = columns.tr_mul(&by_rate);
                    for k in 0..6 {
                        own.by_place[6 * slot + k] += moved[k];
                        own.by_rate[6 * slot + k] += turned[k];
                    }
                }
            }
            Some(all)
        })
    }
}

impl Validity for BeamContact {
    fn limits(&self) -> &'static [LimitKind] {
        self.contact.limits()
    }

    fn limit(&self, kind: LimitKind, [_, at]: [&Kinematics; 2]) -> Option<Limit<'_>> {
        if self.is_idle(at) {
            return None;
        }
        let [value, limit] = self.between(at, |contact, scratch, _| {
            contact.limit(kind, [&scratch.at; 2]).map(|own| [own.value, own.limit])
        })?;
        Some(Limit { value, limit, place: Place::Contact(self.contact.name()) })
    }
}

impl ForceLaws for BeamContact {
    fn switch_count(&self) -> usize {
        1
    }

    fn is_idle(&self, at: &Kinematics) -> bool {
        frozen_branch(self.switch_states.of(at).first()) == Some(false)
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        self.between(at, |contact, scratch, _| contact.switches(&scratch.at, out));
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        self.between(at, |contact, scratch, _| contact.laws(&scratch.at, visit));
    }
}

impl StrainSlopes for BeamContact {
    fn strain_slopes(&self, fall: &Kinematics, out: &mut [f64]) {
        self.between(fall, |contact, scratch, section| {
            let mut local = [0.0; BRISTLES + STATES];
            contact.strain_slopes(&scratch.at, &mut local[..BRISTLES + self.bristles.len()]);
            self.add(section, &local, out);
        });
    }
}
