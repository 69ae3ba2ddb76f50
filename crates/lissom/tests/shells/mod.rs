//! Shells in models: against closed forms, with every scheme, and what their messages say.

mod contacts;
mod dynamics;
mod examples;
mod linear;
mod messages;
mod sections;
mod statics;

/// A cantilever of 10 x 1 x 0.1 m, E = 1.2 MPa, with an end load.
pub(crate) const CANTILEVER: &str = r#"
lissom = 1
[materials.soft]
E = 1.2e6
nu = 0
density = 1000
[shells.plate]
corners = [[0, 0, 0], [10, 0, 0], [10, 1, 0], [0, 1, 0]]
divisions = [16, 1]
thickness = 0.1
material = "soft"
[joints.root]
kind = "clamp"
base = "ground"
tip = "plate.west"
[loads.end]
kind = "force"
on = "plate.east"
vector = [0, 0, 4]
[outputs.tip]
kind = "displacement"
of = "plate@1,0"
[outputs.root]
kind = "reaction"
of = "root"
[analysis]
kind = "statics"
end = 1
steps = 4
"#;
