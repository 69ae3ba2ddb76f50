//! Wheels with rounded rims, balls, and wheels that creep.

use lissom_core::joints;
use lissom_core::registry::{Parameters, Value};
use lissom_core::system::{Builder, Freedoms, Placement};
use lissom_motion::{Motion, Vector3};

use crate::check;
use crate::configuration::Random;

#[test]
fn round_and_creeping_wheels() {
    let kind = joints::KINDS.iter().find(|kind| kind.name == "rolling").expect("there");
    for (seed, (rim, creep, is_ball)) in
        [(0.3, 0.0, false), (0.0, 0.4, false), (0.2, 0.7, false), (0.9, 0.0, true), (0.9, 0.5, true)]
            .into_iter()
            .enumerate()
    {
        let mut random = Random::new(seed as u64 + 5);
        let mut builder = Builder::new();
        let plane = random.motion();
        let base = builder.add_node("base", random.motion(), Freedoms::Full);
        let centre = plane.transform_point(&Vector3::new(0.3, -0.2, -0.9));
        let tip = builder.add_node(
            "tip",
            Motion::translation(centre)
                * Motion::exponential(
                    &(0.3 * random.screw())
                        .map_with_location(|row, _, value| if row < 3 { 0.0 } else { value }),
                ),
            Freedoms::Full,
        );
        let placement = Placement {
            nodes: [base, tip],
            at: plane.position,
            at_tip: None,
            axis: Some(plane.rotation.apply(&Vector3::z())),
            second_axis: None,
        };
        let axis = plane.rotation.apply(&Vector3::new(0.3, 1.0, 0.4));
        let mut parameters = Parameters::new()
            .with("wheel_axis", Value::Vector(axis))
            .with("rim", Value::Number(rim))
            .with("creep", Value::Number(creep));
        if is_ball {
            parameters.insert("radius", Value::Number(0.0));
        }
        builder.add_joint("joint", kind, &placement, &parameters).expect("valid");
        let (system, state) = builder.build(0.0).expect("valid");
        check("rolling", &system, &state, 0.3, &mut random);
    }
}
