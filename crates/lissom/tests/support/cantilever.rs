//! A model that several tests share.

/// A cantilever under a small tip force.
pub(crate) const CANTILEVER: &str = r#"
lissom = 1

[sections.bar]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 200, 200]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }

[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
order = 2

[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"

[loads.tip]
kind = "force"
on = "bar.end"
vector = [0, 0, 1]
scale = "3*t"

[outputs.tip]
kind = "displacement"
of = "bar.end"

[outputs.root]
kind = "reaction"
of = "root"

[analysis]
kind = "statics"
steps = 4
"#;
