//! Cylinders on the displacement of a joint.

use lissom_mechanics::registry::Value as Held;

use super::fluid::ATMOSPHERE;
use super::kind::{DIAMETERS, HydraulicKind, LENGTHS, Port, port};
use super::net::{Net, Part, Term};
use crate::format::keys::{Shape, optional, required};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "cylinder",
    summary: "Cylinder that acts on the displacement of a joint, such as a telescopic rod between two points; the pressure at `a` extends it.",
    ports: &[
        port("a", "node of the chamber at the piston"),
        Port {
            key: "b",
            is_required: false,
            summary: "node of the chamber around the rod; default: open to the atmosphere",
        },
    ],
    keys: || {
        vec![
            required("joint", Shape::Name("joints"), "", "joint with a displacement"),
            required("bore", Shape::Positive, "m", "diameter of the piston").usual(DIAMETERS),
            optional("rod_diameter", Shape::NotNegative, "m", "diameter of the rod in the chamber `b`")
                .or_number(0.0)
                .usual(DIAMETERS),
            optional(
                "stroke",
                Shape::Positive,
                "m",
                "from stop to stop; without it the cylinder has no stops, and its chambers are no part of the volumes",
            )
            .usual(LENGTHS),
            optional(
                "extension",
                Shape::NotNegative,
                "m",
                "of the rod at displacement zero, from 0 to `stroke`",
            ),
            optional("friction", Shape::NotNegative, "N s/m", "viscous friction").or_number(0.0),
            optional("leakage", Shape::NotNegative, "m³/(s Pa)", "past the piston, from `a` to `b`")
                .or_number(0.0),
            optional("stop_stiffness", Shape::Positive, "N/m", "of the stops at the ends of the stroke")
                .or_number(1e8),
            optional("stop_damping", Shape::NotNegative, "N s/m", "of the stops").or_number(1e5),
        ]
    },
    separates_fluids: true,
    components: &[
        ("force", "N"),
        ("flow_a", "m^3/s"),
        ("flow_b", "m^3/s"),
        ("volume_a", "m^3"),
        ("volume_b", "m^3"),
        ("power", "W"),
    ],
    add,
};

fn add(part: &Part<'_, '_, '_>, net: &mut Net<'_, '_>) -> Option<()> {
    let reader = part.reader;
    let (bore, rod) = (reader.number("bore")?, part.number("rod_diameter")?);
    if rod >= bore.value {
        let message = format!("`rod_diameter` of {} is not less than its `bore`", reader.what);
        return reader.context.fail(bore.span, message, "both are diameters [m]");
    }
    let circle = |diameter: f64| std::f64::consts::PI * diameter * diameter / 4.0;
    let joint = reader.name_in("joint")?;
    let of_joint = |word: &str| Term::Name(format!("{}.{word}", joint.value));
    let terms = [
        ("A", circle(bore.value).into()),
        ("B", (circle(bore.value) - circle(rod)).into()),
        ("x", of_joint("displacement")),
        ("v", of_joint("velocity")),
        ("pa", part.pressure(0)),
        ("pb", part.pressure(1)),
        ("p0", ATMOSPHERE.into()),
        ("c", part.number("friction")?.into()),
        ("k", part.number("leakage")?.into()),
    ];
    net.signal(part, "force", ("pa*A - pb*B - p0*(A - B) - c*v", &terms))?;
    net.signal(part, "flow_a", ("A*v + k*(pa - pb)", &terms))?;
    net.signal(part, "flow_b", ("-B*v - k*(pa - pb)", &terms))?;
    net.flow(part, 0, ("flow_a", 1.0));
    net.flow(part, 1, ("flow_b", 1.0));
    net.load(part, &joint, ("joint_force", "force", "force"))?;
    let mut ends = [0.0; 2];
    if reader.has("stroke") {
        let stroke = part.number("stroke")?;
        let Some(extension) = reader.number("extension") else {
            let message = format!("{} has a `stroke`, but no `extension`", reader.what);
            let help = "add `extension = …` [m], that of the rod at displacement zero, from 0 to `stroke`";
            return reader.context.fail(reader.name, message, help);
        };
        if extension.value > stroke {
            let message = format!("`extension` of {} is above its `stroke` of {stroke} m", reader.what);
            return reader.context.fail(extension.span, message, "give a number from 0 to `stroke`");
        }
        ends = [extension.value, stroke - extension.value];
        let number = |key: &str| part.number(key).map(Held::Number);
        let values = vec![
            ("range", Held::Range([-ends[0], ends[1]])),
            ("stiffness", number("stop_stiffness")?),
            ("damping", number("stop_damping")?),
        ];
        net.spring(part, &joint, ("axial_stop", values))?;
        net.volume(part, 0, "volume_a");
        net.volume(part, 1, "volume_b");
    }
    let [back, front] = ends.map(Term::Number);
    let ends = [("back", back), ("front", front)];
    let terms: Vec<_> = terms.into_iter().chain(ends).collect();
    net.signal(part, "volume_a", ("A*(back + x)", &terms))?;
    net.signal(part, "volume_b", ("B*(front - x)", &terms))
}
