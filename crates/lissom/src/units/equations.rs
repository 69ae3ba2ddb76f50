//! Equations of a unit for model exchange, as its description states them: states, and groups of values that depend on the same inputs.

use lissom_model::Problem;
use lissom_model::document::{UnitEntry, UnitEquations, UnitGroup};
use lissom_units::{Equations, Group};

use super::description::{Described, Description, Kind};

/// The equations for the model and for the process of the unit.
pub(super) fn of(
    entry: &UnitEntry,
    description: &Description,
    kind: &Kind,
) -> Result<(UnitEquations, Equations), Box<Problem>> {
    let unit = &entry.name.value;
    let fail = |message: String, help: &str| Box::new(Problem::error(entry.file.span, message).help(help));
    let variables = &description.variables;
    let find = |name: &str| variables.iter().position(|own| own.name == *name);
    let inputs: Vec<usize> = entry.inputs.iter().filter_map(|(name, _)| find(&name.value)).collect();
    for (&index, (name, _)) in inputs.iter().zip(&entry.inputs) {
        if !variables[index].is_continuous {
            let message = format!("the input `{}` of unit `{unit}` is not continuous", name.value);
            let help =
                "remove it: it keeps its start value, which `parameters` may set; or use co-simulation";
            return Err(Box::new(Problem::error(name.span, message).label("here").help(help)));
        }
    }
    let mut states: Vec<&Described> = Vec::new();
    for (index, _) in &description.derivatives {
        let derivative = &variables[*index];
        let state = derivative.derivative.and_then(|number| description.named(number));
        let state = state
            .map(|index| &variables[index])
            .filter(|state| state.is_continuous && derivative.is_continuous);
        states.push(state.ok_or_else(|| {
            let message = format!(
                "unit `{unit}`: the derivative `{}` has no state of type Float64 (Real)",
                derivative.name
            );
            fail(message, "export the unit again; states must be single numbers")
        })?);
    }
    // Inputs of the entry on which a variable depends; all of them if the unit does not declare it.
    let needed = |dependencies: Option<&Vec<usize>>| -> Vec<usize> {
        let is_needed = |own: &usize| dependencies.is_none_or(|list| list.contains(&inputs[*own]));
        (0..inputs.len()).filter(is_needed).collect()
    };
    let mut of_derivatives = UnitGroup { has_derivatives: true, ..UnitGroup::default() };
    if description.indicators > 0 {
        of_derivatives.inputs = needed(None);
    } else {
        let all = description.derivatives.iter().flat_map(|(_, list)| needed(list.as_ref()));
        of_derivatives.inputs = all.collect::<std::collections::BTreeSet<_>>().into_iter().collect();
    }
    let has_derivatives = description.indicators > 0 || !states.is_empty();
    // Each with whether the structure of the unit has all its values: others have no directional derivatives.
    let mut groups = if has_derivatives { vec![(of_derivatives, true)] } else { Vec::new() };
    let outputs: Vec<usize> = entry.outputs.iter().filter_map(|(_, name)| find(&name.value)).collect();
    for (position, &index) in outputs.iter().enumerate() {
        let mut structure = description.outputs.iter().chain(&description.derivatives);
        let known = structure.find(|(own, _)| *own == index);
        // States depend on no input, and variables that change at events alone are constant between them.
        let is_state = states.iter().any(|state| state.reference == variables[index].reference);
        let is_constant = is_state || !variables[index].is_continuous;
        let own = if is_constant { Vec::new() } else { needed(known.and_then(|(_, list)| list.as_ref())) };
        let is_known = is_constant || known.is_some();
        let same = groups.iter_mut().find(|(group, known)| group.inputs == own && *known == is_known);
        if let Some((group, _)) = same {
            group.outputs.push(position);
        } else {
            let group = UnitGroup { inputs: own, outputs: vec![position], has_derivatives: false };
            groups.push((group, is_known));
        }
    }
    let of_process = groups.iter().map(|(group, is_known)| {
        let is_continuous = |&(_, &output): &(usize, &usize)| variables[outputs[output]].is_continuous;
        let continuous = group.outputs.iter().enumerate().filter(is_continuous).map(|(row, _)| row).collect();
        let UnitGroup { inputs, outputs, has_derivatives } = group.clone();
        Group {
            inputs,
            outputs,
            continuous,
            has_derivatives,
            differentiates: *is_known && kind.differentiates,
        }
    });
    let equations = Equations {
        states: states.iter().map(|state| state.reference).collect(),
        derivatives: description.derivatives.iter().map(|(index, _)| variables[*index].reference).collect(),
        indicators: description.indicators,
        nominals: states
            .iter()
            .map(|own| own.nominal)
            .chain(inputs.iter().map(|&own| variables[own].nominal))
            .collect(),
        completes: kind.completes,
        groups: of_process.collect(),
    };
    let states = states.iter().map(|state| (state.name.clone(), state.nominal)).collect();
    let groups = groups.into_iter().map(|(group, _)| group).collect();
    Ok((UnitEquations { states, indicators: description.indicators, groups }, equations))
}
