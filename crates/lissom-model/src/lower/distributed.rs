//! Forces per length of beams as forces at their nodes.
//!
//! Legend: r reference line, s its fraction, n number of elements, w weights of the Gauss-Lobatto rule, whose points the
//! nodes are.
//!
//! ```text
//! F_k = Σ w_k |r'(s_k)|/(2n) f(s_k, t)          over the elements that node k belongs to
//! ```
//!
//! So is the mass of a beam laid to its nodes.

use std::sync::Arc;

use lissom_flexible::beam::line::BeamLine;
use lissom_mechanics::elements::quadrature::gauss_lobatto;
use lissom_mechanics::elements::{Attached, force};
use lissom_mechanics::registry::{Function, Parameters, Value};
use lissom_motion::Vector3;
use lissom_system::Builder;

use crate::document::{Beam, DistributedForce, Document};
use crate::functions::{Ramp, of_expression};
use crate::text::report::Problem;

/// Instants of the analysis at which a force must be finite.
const INSTANTS: u32 = 16;

/// Adds the forces per length of a beam that is built.
pub(super) fn add(
    document: &Document,
    beam: &Beam,
    line: &BeamLine,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let weights = lengths(beam, line);
    for distributed in &beam.distributed {
        for k in 0..line.nodes.len() {
            let frame = builder.initial_frame(line.nodes[k]).rotation * line.offsets[k].rotation;
            for (axis, formula) in distributed.components.iter().enumerate() {
                let arguments = vec![line.places[k]; formula.arguments().len()];
                let function = of_expression(formula.with_arguments(&arguments));
                check(document, beam, distributed, &function, line.places[k])?;
                let axes = distributed.axes.unwrap_or(frame);
                let vector = weights[k] * axes.apply(&Vector3::ith(axis, 1.0));
                let constant = function.is_constant().then(|| function.value(document.analysis.start));
                if constant == Some(0.0) {
                    continue;
                }
                let span = (document.analysis.start, document.analysis.end);
                let scale: Function = match constant {
                    Some(value) if document.analysis.ramp => Arc::new(Ramp { value, span }),
                    _ => function,
                };
                let parameters = Parameters::new()
                    .with("vector", Value::Vector(vector))
                    .with("scale", Value::Function(scale))
                    .with("follower", Value::Flag(distributed.axes.is_none()));
                let attached = Attached::to_nodes([(line.nodes[k], line.offsets[k].position)]);
                builder
                    .add_of_kind(&force::KIND, attached, &parameters)
                    .map_err(|error| Problem::error(distributed.span, error.to_string()))?;
            }
        }
    }
    Ok(())
}

/// The length of the line that belongs to each node [m].
pub(super) fn lengths(beam: &Beam, line: &BeamLine) -> Vec<f64> {
    let count = line.elements.len();
    let mut lengths = vec![0.0; line.nodes.len()];
    for element in 0..count {
        for (i, (_, weight)) in gauss_lobatto(line.order + 1).iter().enumerate() {
            let k = element * line.order + i;
            lengths[k] += weight * beam.line.derivative(line.places[k]).norm() / (2 * count) as f64;
        }
    }
    lengths
}

/// A force must be finite during the analysis.
fn check(
    document: &Document,
    beam: &Beam,
    distributed: &DistributedForce,
    function: &Function,
    s: f64,
) -> Result<(), Problem> {
    let (start, end) = (document.analysis.start, document.analysis.end);
    let mut times = (0..=INSTANTS).map(|i| start + (end - start) * f64::from(i) / f64::from(INSTANTS));
    match times.find(|time| !function.value(*time).is_finite()) {
        None => Ok(()),
        Some(time) => {
            let name = &beam.name.value;
            let message = format!(
                "a force per length of beam `{name}` is not a finite number at s = {s:.4}, t = {time}"
            );
            Err(Problem::error(distributed.span, message))
        }
    }
}
