//! From the outputs of a document to channels: expressions find what they name, observers their nodes.

use std::cell::RefCell;
use std::sync::Arc;

use lissom_system::accumulated::Accumulated;
use lissom_system::{State, System};

use crate::document::{AnalysisKind, Document};
use crate::expression::Formula;
use crate::format::suggest;
use crate::output::component::component_position;
use crate::outputs::channel_components::components;
use crate::outputs::channels::Channel;
use crate::outputs::entry::{Output, OutputSource, ReactionAxes};
use crate::outputs::expression::Expression;
use crate::outputs::kinds::OutputKind;
use crate::outputs::signal::SignalValue;
use crate::outputs::{Build, Evaluation, Found, OutputQuantity, Resolver, Subjects};
use crate::text::report::{Located, Problem, Span};

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
        let quantity = match &output.source {
            OutputSource::Expression(formula) => self.expression(output, formula, path)?,
            _ => self.quantity(output)?,
        };
        let quantity_of = |coordinate| self.system.layout().coordinate_quantity(coordinate);
        let (components, units) = components(output.kind, &*quantity, &quantity_of);
        let own_unit = |unit: &'static str| output.unit.clone().unwrap_or_else(|| unit.to_owned());
        let units = units.into_iter().map(own_unit).collect();
        let (name, kind, fatigue) = (output.name.value.clone(), output.kind, output.fatigue);
        Ok(Channel { name, kind, components, units, plot: output.plot.clone(), fatigue, quantity })
    }

    fn quantity(&self, output: &Output) -> Found {
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
        match output.kind.build() {
            Build::Motion(build) => build(output, &subjects),
            Build::Element(_, build) | Build::System(_, build) => build(output, self.system, &subjects),
            Build::Accumulated(build) => {
                self.check_motion(output)?;
                let number = build(output, self.system, &subjects)?;
                let mut accumulated = self.accumulated.borrow_mut();
                accumulated.push(number);
                Ok(Arc::new(AccumulatedNumber(accumulated.len() - 1)))
            }
            Build::Expression => {
                Err(Problem::error(output.name.span, "an expression has no value".to_owned()))
            }
        }
    }

    /// Whether there is a motion along which a number can be accumulated.
    fn check_motion(&self, output: &Output) -> Result<(), Problem> {
        let analysis = &self.document.analysis.kind;
        if matches!(analysis, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. }) {
            return Ok(());
        }
        let message = format!(
            "output `{}` adds up along a motion, which `{}` does not have",
            output.name.value,
            analysis.name()
        );
        Err(Problem::error(output.name.span, message).help("leave it out, or use `dynamics` or `statics`"))
    }

    /// An expression of components of other outputs, of joints' coordinates, signals, inputs and states.
    fn expression(&self, output: &Output, formula: &Located<Formula>, path: &mut Vec<String>) -> Found {
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
        Ok(Arc::new(Expression { formula: formula.value.clone(), arguments }))
    }

    /// The channel and the component that a name in an expression means.
    fn argument(
        &self,
        name: &str,
        place: Span,
        path: &mut Vec<String>,
    ) -> Result<Option<(Channel, String)>, Problem> {
        if let Some(&argument) = self.names.signals.get(name) {
            let (components, units) = (vec!["value".to_owned()], vec![String::new()]);
            let (kind, quantity) = (OutputKind::Signal, Arc::new(SignalValue(argument)));
            let name = name.to_owned();
            let channel = Channel { name, kind, components, units, plot: None, fatigue: None, quantity };
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
            station: None,
            unit: None,
            plot: None,
            fatigue: None,
        };
        Ok(Some((self.channel(&output, path)?, component.to_owned())))
    }
}

/// What the simulation accumulates, by its position.
struct AccumulatedNumber(usize);

impl OutputQuantity for AccumulatedNumber {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.push(at.state.accumulated.get(self.0).copied().unwrap_or(f64::NAN));
    }
}
