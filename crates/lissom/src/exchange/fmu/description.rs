//! The description of a unit: `modelDescription.xml` of FMI 3.0.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::{Causality, Interface, LIBRARY, PackedModel, Variable};

/// The text of the description.
pub(super) fn xml(packed: &PackedModel, interface: &Interface) -> String {
    let name = std::path::Path::new(&packed.name).file_stem().unwrap_or_default().to_string_lossy();
    let [start, end] = interface.span;
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    let mut line = |words: &str| {
        text.push_str(words);
        text.push('\n');
    };
    line(&format!(
        "<fmiModelDescription fmiVersion=\"3.0\" modelName=\"{}\" instantiationToken=\"{}\" description=\"{}\" generationTool=\"Lissom {}\" \
         variableNamingConvention=\"flat\">",
        escaped(&name),
        packed.token(),
        escaped(&interface.title),
        escaped(&packed.version)
    ));
    line(&format!(
        "  <CoSimulation modelIdentifier=\"{LIBRARY}\" canHandleVariableCommunicationStepSize=\"true\" canGetAndSetFMUState=\"true\" \
         canSerializeFMUState=\"true\"/>"
    ));
    let units: BTreeSet<&str> =
        interface.variables.iter().map(|of| of.unit.as_str()).filter(|unit| !unit.is_empty()).collect();
    line("  <UnitDefinitions>");
    for unit in units {
        line(&format!("    <Unit name=\"{}\"/>", escaped(unit)));
    }
    line("  </UnitDefinitions>");
    let step = interface.step.map_or_else(String::new, |step| format!(" stepSize=\"{step:?}\""));
    line(&format!("  <DefaultExperiment startTime=\"{start:?}\" stopTime=\"{end:?}\"{step}/>"));
    line("  <ModelVariables>");
    for (reference, variable) in interface.variables.iter().enumerate() {
        line(&of_variable(reference, variable));
    }
    line("  </ModelVariables>");
    line("  <ModelStructure>");
    for kind in ["Output", "InitialUnknown"] {
        for (reference, variable) in interface.variables.iter().enumerate() {
            if variable.causality == Causality::Output {
                line(&format!("    <{kind} valueReference=\"{reference}\"/>"));
            }
        }
    }
    line("  </ModelStructure>");
    line("</fmiModelDescription>");
    text
}

fn of_variable(reference: usize, variable: &Variable) -> String {
    let (causality, rest) = match variable.causality {
        Causality::Independent => ("independent", "variability=\"continuous\""),
        Causality::Input => ("input", "variability=\"discrete\""),
        Causality::Parameter => ("parameter", "variability=\"fixed\" initial=\"exact\""),
        Causality::Output => ("output", "variability=\"continuous\" initial=\"calculated\""),
    };
    let mut text = format!(
        "    <Float64 name=\"{}\" valueReference=\"{reference}\" causality=\"{causality}\" {rest}",
        escaped(&variable.name)
    );
    // Writing to a string cannot fail.
    if !variable.quantity.is_empty() {
        let _ = write!(text, " description=\"{}\"", escaped(&variable.quantity));
    }
    if !variable.unit.is_empty() {
        let _ = write!(text, " unit=\"{}\"", escaped(&variable.unit));
    }
    if let Some(start) = variable.start {
        let _ = write!(text, " start=\"{start:?}\"");
    }
    text + "/>"
}

/// A text escaped for the value of an attribute.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            letter if letter.is_control() => safe.push(' '),
            letter => safe.push(letter),
        }
    }
    safe
}
