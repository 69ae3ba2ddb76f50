//! Elastic solids in models: against closed forms, with every scheme, and what their messages say.

mod contacts;
mod damping;
mod dynamics;
mod examples;
mod mean_motion;
mod meshes;
mod messages;
mod pressure;
mod statics;

/// A block of 2 x 1 x 1 m, held by planes of symmetry, that is pulled along x with `force` [N].
pub(crate) const BLOCK: &str = r#"
lissom = 1
[materials.soft]
E = 1e6
nu = 0.3
density = 1000
[solids.block]
size = [2, 1, 1]
divisions = [2, 1, 1]
material = "soft"
[joints.x]
kind = "point_in_plane"
base = "ground"
tip = "block.west"
axis = "x"
[joints.y]
kind = "point_in_plane"
base = "ground"
tip = "block.south"
axis = "y"
[joints.z]
kind = "point_in_plane"
base = "ground"
tip = "block.bottom"
axis = "z"
[loads.pull]
kind = "force"
on = "block.east"
vector = [1e5, 0, 0]
[outputs.end]
kind = "displacement"
of = "block@1,1,1"
[outputs.middle]
kind = "displacement"
of = "block@0.75,0,1"
[outputs.stress]
kind = "solid_stress"
of = "block@0.5,0,1"
[outputs.wall]
kind = "reaction"
of = "x"
[analysis]
kind = "statics"
end = 1
steps = 2
"#;

/// A cantilever of 10 x 1 x 1 m, E = 1 MPa, with an end load.
pub(crate) const CANTILEVER: &str = r#"
lissom = 1
[materials.soft]
E = 1e6
nu = 0
density = 1000
[solids.bar]
size = [10, 1, 1]
divisions = [10, 2, 2]
material = "soft"
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.west"
[loads.end]
kind = "force"
on = "bar.east"
vector = [0, 0, 1]
[outputs.tip]
kind = "displacement"
of = "bar@1,0,0.5"
[outputs.root]
kind = "reaction"
of = "root"
[outputs.stress]
kind = "solid_stress"
of = "bar@0.5,0,1"
[analysis]
kind = "statics"
end = 1
steps = 1
"#;
