//! Records frames of a running session.
//!
//! Target instants of frames are equidistant. A shorter step contributes its end, if it is the first at or after a target
//! instant; a longer one its end and states between, interpolated to the order of the scheme. So frames depend only on the
//! steps, and a run that is resumed from a checkpoint records the same as an uninterrupted one.

use std::io::{self, Write};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::start::Lowered;
use lissom_core::flexible::beam::line::BeamProbe;
use lissom_core::kinematics::{Kinematics, NodeMotion};
use lissom_core::simulation::Simulation;
use lissom_core::system::State;

use super::checksum;
use super::header::{Header, POINTS};
use crate::run::state_writer::StateWriter;

/// Maximum number of frames if no rate is given.
const FRAMES: f64 = 600.0;
/// Instants within this distance of a target, relative to the interval of frames, are equal to it.
const WHOLE: f64 = 1e-9;
/// Maximum time for which frames remain in the buffer.
const PATIENCE: Duration = Duration::from_secs(1);

/// Writes a motion file.
pub struct MotionRecorder<W> {
    to: W,
    /// Complete frames only, so that the file seldom ends within one.
    buffer: Vec<u8>,
    flushed: Instant,
    header: Header,
    reference: Vec<NodeMotion>,
    probes: Vec<Arc<dyn BeamProbe>>,
    start: f64,
    interval: f64,
    /// Time of the last frame [s].
    last: Option<f64>,
    between: Option<State>,
}

impl<W: Write + Send> MotionRecorder<W> {
    /// A recorder of the model `lowered` that writes to `to`; `frames_per_second` [1/s] of simulated time, or at most 600
    /// distributed over the run.
    pub fn new(lowered: &Lowered, frames_per_second: Option<f64>, to: W) -> Self {
        let plan = &lowered.plan;
        let probes = lowered.names.lines.values().flat_map(|line| line.elements.iter().cloned());
        Self {
            to,
            buffer: Vec::new(),
            flushed: Instant::now(),
            header: Header::of(lowered),
            reference: lowered.state.kinematics.nodes.clone(),
            probes: probes.collect(),
            start: plan.start,
            interval: frames_per_second.map_or((plan.end - plan.start) / FRAMES, f64::recip),
            last: None,
            between: None,
        }
    }

    /// This recorder, writing to `to`.
    pub fn writing_to<V: Write + Send>(self, to: V) -> MotionRecorder<V> {
        let Self { buffer, flushed, header, reference, probes, start, interval, last, between, .. } = self;
        MotionRecorder { to, buffer, flushed, header, reference, probes, start, interval, last, between }
    }

    /// Continues after the frame of the time `last` [s], which has already been written.
    pub fn resume_after(&mut self, last: f64) {
        self.last = Some(last);
    }

    /// Writes the header and one frame: a picture at rest.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_still(&mut self, at: &Kinematics) -> io::Result<()> {
        let head = self.header.to_bytes(&self.reference);
        self.buffer.extend_from_slice(&head);
        self.frame(at);
        self.flush()
    }

    /// Writes the header and these frames, whose times must ascend.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn write_frames(&mut self, frames: &[Kinematics]) -> io::Result<()> {
        let head = self.header.to_bytes(&self.reference);
        self.buffer.extend_from_slice(&head);
        for at in frames {
            self.frame(at);
        }
        self.flush()
    }

    /// Uses section forces of the elements of another system from now on, with the same nodes and beams.
    pub fn read_elements_of(&mut self, lowered: &Lowered) {
        self.probes = lowered.names.lines.values().flat_map(|line| line.elements.iter().cloned()).collect();
    }

    /// Writes the next frame, preceded by the header if it is the first.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_next(&mut self, at: &Kinematics) -> io::Result<()> {
        if self.last.is_none() {
            let head = self.header.to_bytes(&self.reference);
            self.buffer.extend_from_slice(&head);
        }
        self.frame(at);
        self.flush_if_full()
    }

    /// The next target instant of a frame [s].
    fn due(&self) -> f64 {
        self.last.map_or(self.start, |last| {
            let passed = ((last - self.start) / self.interval + WHOLE).floor();
            self.start + (passed + 1.0) * self.interval
        })
    }

    fn frame(&mut self, at: &Kinematics) {
        let begin = self.buffer.len();
        self.buffer.extend_from_slice(&at.time.to_le_bytes());
        let mut put = |numbers: &[f64]| {
            self.buffer.extend(numbers.iter().flat_map(|number| (*number as f32).to_le_bytes()));
        };
        for (node, start) in at.nodes.iter().zip(&self.reference) {
            put((node.frame.position - start.frame.position).as_slice());
        }
        for (node, start) in at.nodes.iter().zip(&self.reference) {
            put((node.frame.rotation * start.frame.rotation.inverse()).logarithm().as_slice());
        }
        for probe in &self.probes {
            for xi in POINTS {
                put(probe.section_forces_at(at, xi).as_slice());
            }
        }
        self.buffer.extend(checksum(&self.buffer[begin..]));
        self.last = Some(at.time);
    }

    fn flush_if_full(&mut self) -> io::Result<()> {
        if self.buffer.len() > 1 << 16 || self.flushed.elapsed() > PATIENCE { self.flush() } else { Ok(()) }
    }
}

impl<W: Write + Send> StateWriter for MotionRecorder<W> {
    fn begin(&mut self, simulation: &Simulation) -> io::Result<()> {
        self.write_still(&simulation.state().kinematics)
    }

    fn is_due(&self, time: f64) -> bool {
        time >= self.due() - WHOLE * self.interval
    }

    fn step(&mut self, simulation: &Simulation, known_from: f64) -> io::Result<()> {
        let end = &simulation.state().kinematics;
        let duration = end.time - known_from;
        let parts = (duration / self.interval - WHOLE).ceil();
        if parts > 1.0 {
            let mut between = self.between.take().unwrap_or_else(|| simulation.state().clone());
            for part in 1..parts as u64 {
                simulation.interpolate(known_from + duration * (part as f64 / parts), &mut between);
                self.frame(&between.kinematics);
                self.flush_if_full()?;
            }
            self.between = Some(between);
        }
        self.frame(end);
        self.flush_if_full()
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.write_all(&self.buffer)?;
        self.buffer.clear();
        self.flushed = Instant::now();
        self.to.flush()
    }

    fn finish(&mut self, simulation: &Simulation) -> io::Result<()> {
        let end = &simulation.state().kinematics;
        if self.last != Some(end.time) {
            self.frame(end);
        }
        self.flush()
    }
}
