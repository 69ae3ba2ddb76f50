//! Two springs that lean on each other: the model of equilibrium paths that has closed forms.

use std::fmt::Display;

/// Springs of rate 1000 N/m over feet 2 m apart meet `height` above them [m], under a load of `force` downwards [N]. `rest` is
/// the end of the file.
pub(crate) fn truss(height: impl Display, force: impl Display, rest: &str) -> String {
    format!(
        r#"lissom = 1
[point_masses.top]
mass = 1.0
position = [0, {height}, 0]
plane = "xy"
[springs.left]
kind = "point"
base = "ground"
at_base = [-1, 0, 0]
tip = "top"
stiffness = 1000.0
[springs.right]
kind = "point"
base = "ground"
at_base = [1, 0, 0]
tip = "top"
stiffness = 1000.0
[loads.down]
kind = "force"
on = "top"
vector = [0, {force}, 0]
[outputs.top]
kind = "position"
of = "top"
{rest}"#
    )
}
