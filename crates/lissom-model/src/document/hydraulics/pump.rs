//! Pumps and motors of a displacement.

use std::f64::consts::TAU;

use lissom_mechanics::registry::Usual;

use super::kind::{HydraulicKind, port};
use super::net::{Net, Part, Term};
use crate::format::keys::{Shape, optional, required};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "pump",
    summary: "Pump or motor: moves its displacement from `inlet` to `outlet` per revolution of a prescribed speed or of a joint.",
    ports: &[port("inlet", "node from which it pumps"), port("outlet", "node into which it pumps")],
    keys: || {
        vec![
            required(
                "displacement",
                Shape::Formula,
                "m³",
                "volume per revolution, a number or an expression",
            )
            .usual(Usual::new(0.0, 0.1, "in cm³: divide it by a million")),
            optional(
                "speed",
                Shape::Formula,
                "rad/s",
                "a number or an expression; either it or `joint` is required",
            ),
            optional(
                "joint",
                Shape::Name("joints"),
                "",
                "joint with the rotation of the shaft, on which its torque acts",
            ),
            optional("leakage", Shape::NotNegative, "m³/(s Pa)", "from `outlet` to `inlet`").or_number(0.0),
            optional("friction", Shape::NotNegative, "N m s/rad", "viscous friction on the joint")
                .or_number(0.0),
        ]
    },
    separates_fluids: false,
    components: &[("flow", "m^3/s"), ("torque", "N m"), ("power", "W")],
    add,
};

fn add(part: &Part<'_, '_, '_>, net: &mut Net<'_, '_>) -> Option<()> {
    let reader = part.reader;
    let shaft = match (reader.has("speed"), reader.has("joint")) {
        (true, false) => {
            net.expression(part, "speed", reader.formula("speed")?);
            None
        }
        (false, true) => Some(reader.name_in("joint")?),
        _ => {
            let message = format!("{} needs either `speed` or `joint`", reader.what);
            return reader.context.fail(reader.name, message, "specify one of them");
        }
    };
    net.expression(part, "displacement", reader.formula("displacement")?);
    let speed =
        shaft.as_ref().map_or_else(|| part.component("speed"), |joint| format!("{}.rate", joint.value));
    let terms = [
        ("D", Term::Name(part.component("displacement"))),
        ("turn", TAU.into()),
        ("w", speed.into()),
        ("k", part.number("leakage")?.into()),
        ("c", part.number("friction")?.into()),
        ("pi0", part.pressure(0)),
        ("po", part.pressure(1)),
    ];
    net.signal(part, "flow", ("D/turn*w - k*(po - pi0)", &terms))?;
    net.signal(part, "torque", ("-D/turn*(po - pi0) - c*w", &terms))?;
    if let Some(joint) = shaft {
        net.load(part, &joint, ("joint_torque", "torque", "torque"))?;
    }
    net.through(part);
    Some(())
}
