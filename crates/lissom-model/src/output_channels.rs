//! From the outputs of a document to channels: expressions find what they name, observers their nodes.

use std::cell::RefCell;
use std::sync::Arc;

use lissom_core::analysis::accumulated::Accumulated;
use lissom_core::kinematics::{CarriedFrame, GROUND};
use lissom_core::system::{State, System};
use lissom_motion::Vector3;

use crate::accumulated::{Actor, AngleAboutAxis, Work};
use crate::channel_components::{component_position, components};
use crate::channels::{Channel, Resolver, Source, source};
use crate::document::{AnalysisKind, Document, Feature, Output, OutputKind, OutputSource, ReactionAxes};
use crate::expression::Formula;
use crate::outputs::{Subjects, carried_frame};
use crate::report::{Located, Problem, Span};
use crate::suggest;

/// Channels of all outputs of a document.
pub(crate) fn of(
    document: &Document,
    system: &System,
    (drawn, state): (&State, &State),
    names: &Resolver<'_>,
    problems: &mut Vec<Problem>,
) -> (Vec<Channel>, Vec<Arc<dyn Accumulated>>) {
    let mut channels = Vec::new();
    let made = Made { document, system, drawn, state, names, accumulated: RefCell::default() };
    for output in &document.outputs {
        match made.channel(output, &mut Vec::new()) {
            Ok(channel) => channels.push(channel),
            Err(problem) => problems.push(problem),
        }
    }
    (channels, made.accumulated.into_inner())
}

/// What channels are made of.
struct Made<'a> {
    document: &'a Document,
    system: &'a System,
    /// As the model describes it.
    drawn: &'a State,
    /// From which the motion starts.
    state: &'a State,
    names: &'a Resolver<'a>,
    /// What the channels so far accumulate.
    accumulated: RefCell<Vec<Arc<dyn Accumulated>>>,
}

impl Made<'_> {
    /// The channel of an output; `path` are the expressions that led to it.
    fn channel(&self, output: &Output, path: &mut Vec<String>) -> Result<Channel, Problem> {
        let source = match &output.source {
            OutputSource::Expression(formula) => self.expression(output, formula, path)?,
            _ if output.kind.has(Feature::Accumulated) => self.accumulated(output)?,
            _ => self.source(output)?,
        };
        let (components, units) = components(output.kind, &source, self.system);
        let (name, kind, fatigue) = (output.name.value.clone(), output.kind, output.fatigue);
        Ok(Channel { name, kind, components, units, fatigue, source })
    }

    fn source(&self, output: &Output) -> Result<Source, Problem> {
        let joint_frames = |name: &str| {
            let mut joints = self.system.joints().iter();
            joints.find(|joint| joint.name == name).map(|joint| joint.output_frames)
        };
        let subjects = Subjects {
            names: self.names,
            drawn: &self.drawn.kinematics,
            start: &self.state.kinematics,
            joint_frames: &joint_frames,
        };
        source(output, self.system, self.state, &subjects)
    }

    /// A number that the simulation accumulates.
    fn accumulated(&self, output: &Output) -> Result<Source, Problem> {
        let (document, at) = (self.document, &self.state.kinematics);
        if !matches!(document.analysis.kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. }) {
            let kind = document.analysis.kind.name();
            let message = format!(
                "output `{}` adds up along a motion, which `{kind}` does not have",
                output.name.value
            );
            return Err(Problem::error(output.name.span, message)
                .help("leave it out, or use `dynamics` or `statics`"));
        }
        let name = output.name.value.clone();
        let number: Arc<dyn Accumulated> = match self.source(output)? {
            Source::Power(element) => Arc::new(Work { name, of: Actor::Element(element) }),
            Source::DrivePower(drive) => Arc::new(Work { name, of: Actor::Drive(drive) }),
            Source::Angle(location) => {
                let start = location.motion(at).frame;
                let observer =
                    output.relative_to.as_ref().map(|node| carried_frame(node, self.names)).transpose()?;
                let observer = observer.unwrap_or(CarriedFrame::of_node(GROUND));
                let own = observer.frame(at).rotation;
                let axis = output.axis.unwrap_or_else(Vector3::z);
                let axis = observer.frame(&self.drawn.kinematics).rotation.apply_inverse(&axis).normalize();
                let start = own.inverse() * start.rotation;
                Arc::new(AngleAboutAxis { name, location, observer, axis, start })
            }
            other => return Ok(other),
        };
        let mut accumulated = self.accumulated.borrow_mut();
        accumulated.push(number);
        Ok(Source::Accumulated(accumulated.len() - 1))
    }

    /// An expression of components of other outputs, of joints' coordinates, signals, inputs and states.
    fn expression(
        &self,
        output: &Output,
        formula: &Located<Formula>,
        path: &mut Vec<String>,
    ) -> Result<Source, Problem> {
        let own = &output.name.value;
        if path.contains(own) {
            let message = format!("the output `{own}` is an expression of itself");
            return Err(Problem::error(formula.span, message).help("leave one of these names out"));
        }
        path.push(own.clone());
        let mut arguments = Vec::new();
        for name in formula.value.arguments() {
            let place = self.document.within(formula.span, formula.value.text(), &name.range);
            let fault =
                |message: String| Problem::error(place, format!("output `{own}`: {message}")).label("here");
            let (channel, component) = self.argument(&name.text, place, path)?.ok_or_else(|| {
                let outputs = self.document.outputs.iter().map(|output| output.name.value.as_str());
                let known = outputs.chain(self.names.coordinates.keys().map(String::as_str));
                let owner = name.text.rsplit_once('.').map_or(name.text.as_str(), |(owner, _)| owner);
                let help = suggest::help(owner, known);
                fault(format!("there is no `{}`", name.text))
                    .help(
                        "name a component of another output, such as `tip.u1`, a joint's coordinate, or a signal",
                    )
                    .maybe_help(help)
            })?;
            let index = component_position(channel.components.iter().map(String::as_str), &component)
                .ok_or_else(|| {
                    let help = suggest::help(&component, channel.components.iter().map(String::as_str));
                    fault(format!("`{}` has no component `{component}`", channel.name)).maybe_help(help)
                })?;
            arguments.push((channel, index));
        }
        path.pop();
        Ok(Source::Expression(formula.value.clone(), arguments))
    }

    /// The channel and the component that a name in an expression means.
    fn argument(
        &self,
        name: &str,
        place: Span,
        path: &mut Vec<String>,
    ) -> Result<Option<(Channel, String)>, Problem> {
        if let Some(&argument) = self.names.signals.get(name) {
            let (components, units) = (vec!["value".to_owned()], vec![""]);
            let (kind, source) = (OutputKind::Signal, Source::Signal(argument));
            let name = name.to_owned();
            let channel = Channel { name, kind, components, units, fatigue: None, source };
            return Ok(Some((channel, "value".to_owned())));
        }
        let Some((owner, component)) = name.rsplit_once('.') else { return Ok(None) };
        let output = self.document.outputs.iter().find(|output| output.name.value == owner);
        if let Some(output) = output {
            return Ok(Some((self.channel(output, path)?, component.to_owned())));
        }
        if self.names.coordinates.get(owner).is_none_or(Vec::is_empty) {
            return Ok(None);
        }
        let joint = Located::new(owner.to_owned(), place);
        let (source, kind) = (OutputSource::Joint(joint.clone()), OutputKind::Relative);
        let output = Output {
            name: joint,
            kind,
            source,
            axes: ReactionAxes::Ground,
            seen_in: None,
            relative_to: None,
            axis: None,
            fatigue: None,
        };
        Ok(Some((self.channel(&output, path)?, component.to_owned())))
    }
}
