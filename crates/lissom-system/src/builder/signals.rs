//! Adds held values, first-order states, measurements, signals and events, and loads scaled by a signal.

use std::sync::Arc;

use lissom_motion::Motion;

use super::Builder;
use crate::ElementId;
use crate::element_quantity::{ElementQuantity, Of};
use crate::feedback::{LeastValue, Target};
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::elements::initial_model::Coordinate;
use lissom_mechanics::kinematics::{
    CarriedFrame, CoordinateId, CoordinateMotion, GROUND, Kinematics, Subject,
};
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::delay::{Delay, Past, Piece, window_size};
use lissom_mechanics::signals::event::Event;
use lissom_mechanics::signals::frame_quantity::{FrameQuantity, Of::Position};
use lissom_mechanics::signals::measurement::{Component, Measurement};
use lissom_mechanics::signals::unit_ports::UnitPorts;
use lissom_mechanics::signals::{
    Argument, DiscreteValueId, Function, MAX_ARGUMENTS, MeasurementId, Signal, SignalId,
};

impl Builder {
    /// Adds a held value, an input or the last sample of a signal, with its initial value.
    pub fn add_held(&mut self, name: &str, start: f64) -> DiscreteValueId {
        self.graph.held.push((name.to_owned(), start));
        DiscreteValueId::new(self.graph.held.len() - 1)
    }

    /// Adds a held value that has a quantity of the state at samples, see [`assign_readings`](crate::System::assign_readings).
    pub fn add_reading(&mut self, name: &str) -> DiscreteValueId {
        let held = self.add_held(name, 0.0);
        self.graph.readings.push(held);
        held
    }

    /// Adds a unit of another program after what it is connected to; outputs at samples are readings.
    pub fn add_unit(&mut self, unit: UnitPorts) {
        self.graph.units.push(unit);
    }

    /// Number of events.
    pub fn event_count(&self) -> usize {
        self.graph.events.len()
    }

    /// Adds a first-order state with its value at the start and its usual magnitude. Its derivative is given with
    /// [`drive_state`](Self::drive_state).
    pub fn add_state(&mut self, name: &str, value: f64, magnitude: f64) -> CoordinateId {
        let mut contribution = Contribution::to(&self.model);
        let state = contribution.add_state(name.to_owned(), value, magnitude);
        self.add(contribution);
        state
    }

    /// Adds an algebraic unknown with a first guess of its value and its usual magnitude: the rate of a state, see
    /// `Target::Balance`. Its equation is given with [`balance`](Self::balance).
    pub fn add_unknown(&mut self, name: &str, guess: f64, magnitude: f64) -> CoordinateId {
        let state = self.add_state(name, 0.0, magnitude);
        self.model.coordinates[state.index()].rate = guess;
        state
    }

    /// Adds a lower limit that monitors check.
    pub fn limit_below(&mut self, of: Subject, value: MeasurementId, least: f64) {
        self.least_values.push(LeastValue { of, value, least });
    }

    /// Makes a signal zero by the value of an unknown, on which it depends.
    pub fn balance(&mut self, unknown: CoordinateId, signal: SignalId) {
        self.targets.push((Target::Balance([unknown]), signal));
    }

    /// Adds the first component of a measurement.
    pub fn add_measurement<M: Measurement + 'static>(&mut self, measurement: M) -> MeasurementId {
        self.add_component(Component { of: Arc::new(measurement), component: 0 })
    }

    /// Adds a component of a measurement.
    pub fn add_component(&mut self, component: Component) -> MeasurementId {
        self.graph.measurements.push(component);
        MeasurementId::new(self.graph.measurements.len() - 1)
    }

    /// Adds a measurement of an element that is not added yet, see [`measure_element`](Self::measure_element).
    pub fn add_later_measurement(&mut self) -> MeasurementId {
        // The constant of a node that does not move.
        let ground = CarriedFrame::of_node(GROUND);
        self.add_measurement(FrameQuantity::new(Position, ground, None, None, Motion::identity()))
    }

    /// Connects a measurement to one component of an element's quantity. Returns whether the quantity has a gradient. Loads
    /// scaled by signals, and elements without an elongation or with too many unknowns, have none.
    pub fn measure_element(
        &mut self,
        measurement: MeasurementId,
        element: ElementId,
        (of, component): (Of, usize),
    ) -> bool {
        let Some(index) = element.batch else { return false };
        let batch = &*self.batches[index];
        let Some(quantity) = ElementQuantity::new(of, batch, element.item).map(Arc::new) else {
            return false;
        };
        self.graph.measurements[measurement] = Component { of: quantity.clone(), component };
        self.element_quantities.push((index, quantity));
        true
    }

    /// The frames of outputs of a joint between two nodes, base first.
    pub fn output_frames(&self, joint: &str) -> Option<[CarriedFrame; 2]> {
        let joint = self.constraints.joints.iter().find(|known| known.name == joint)?;
        Some(joint.output_frames)
    }

    /// Motion of nodes and coordinates at the start, as far as they are added.
    pub fn initial_kinematics(&self) -> Kinematics {
        let coordinate =
            |own: &Coordinate| CoordinateMotion { value: own.value, rate: own.rate, acceleration: 0.0 };
        Kinematics {
            time: 0.0,
            elapsed: 0.0,
            nodes: self.model.nodes.iter().map(|node| node.motion).collect(),
            coordinates: self.model.coordinates.iter().map(coordinate).collect(),
            held: Vec::new(),
            multipliers: Vec::new(),
            units: Vec::new(),
        }
    }

    /// Adds a signal, after those that it names.
    ///
    /// # Errors
    /// If it refers to a later signal, or has too many arguments.
    pub fn add_signal(&mut self, signal: Signal) -> Result<SignalId, ParameterError> {
        let next = SignalId::new(self.graph.signals.len());
        let is_there = |argument: &Argument| match *argument {
            Argument::Held(held) => held.index() < self.graph.held.len(),
            Argument::Signal(earlier) => earlier < next,
            Argument::Measured(measurement) => measurement.index() < self.graph.measurements.len(),
        };
        if !signal.arguments.iter().all(is_there) {
            return Err(ParameterError::new(&signal.subject.to_string(), "names what is not there yet"));
        }
        if signal.arguments.len() > MAX_ARGUMENTS {
            let problem = format!("names more than {MAX_ARGUMENTS} quantities");
            return Err(ParameterError::new(&signal.subject.to_string(), problem));
        }
        self.graph.signals.push(signal);
        Ok(next)
    }

    /// Adds a signal that is another one, its source, `delay` [s] earlier, and `start` before the start of the simulation, or the
    /// value of the source there. Earlier and later signals may refer to it. The source is given with
    /// [`set_source`](Self::set_source).
    ///
    /// # Errors
    /// If the delay is not positive and finite, or `start` is not finite.
    pub fn add_delay(
        &mut self,
        subject: Subject,
        delay: f64,
        start: Option<f64>,
    ) -> Result<SignalId, ParameterError> {
        if !(delay > 0.0 && delay.is_finite() && start.is_none_or(f64::is_finite)) {
            return Err(ParameterError::new(
                &subject.to_string(),
                "needs a delay above 0, and finite numbers",
            ));
        }
        let window = DiscreteValueId::new(self.graph.held.len());
        let words = subject.clone().component("the past");
        let before = Piece::constant([-delay, 0.0], start.unwrap_or(0.0)).to_values();
        let values = before.into_iter().cycle().take(window_size());
        let values: Vec<DiscreteValueId> =
            values.map(|value| self.add_held(&words.to_string(), value)).collect();
        let signal = self.add_signal(Signal {
            subject,
            text: format!("its value {delay} s earlier"),
            function: Function::Own(Arc::new(Past { delay })),
            arguments: values.into_iter().map(Argument::Held).collect(),
            sampling: None,
        })?;
        self.graph.delays.push(Delay::new(signal, window, delay, start));
        Ok(signal)
    }

    /// Makes `source` the signal of which `delayed` is the past.
    pub fn set_source(&mut self, delayed: SignalId, source: SignalId) {
        for delay in self.graph.delays.iter_mut().filter(|delay| delay.signal == delayed) {
            delay.source = Some(source);
        }
    }

    /// Makes a signal the derivative of a first-order state.
    pub fn drive_state(&mut self, state: CoordinateId, signal: SignalId) {
        self.targets.push((Target::State([state]), signal));
    }

    /// Adds an event.
    ///
    /// # Errors
    /// If it refers to signals or held values that do not exist.
    pub fn add_event(&mut self, event: Event) -> Result<(), ParameterError> {
        let is_there = |&(held, signal): &(DiscreteValueId, SignalId)| {
            held.index() < self.graph.held.len() && signal.index() < self.graph.signals.len()
        };
        if event.root.index() >= self.graph.signals.len() || !event.sets.iter().all(is_there) {
            return Err(ParameterError::new(&event.name, "names what is not there"));
        }
        self.graph.events.push(event);
        Ok(())
    }
}
