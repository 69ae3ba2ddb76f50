//! A model that several tests share.

/// A mass of 1 kg on a rail along x that starts with `velocity` [m/s]; `tables` and keys of the analysis, which ends at `end` [s],
/// are added.
pub(crate) fn rail(end: f64, velocity: f64, tables: &str, analysis: &str) -> String {
    format!(
        r#"
lissom = 1
[bodies.ball]
mass = 1
inertia = [1, 1, 1]
velocity = [{velocity}, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "ball"
axis = [1, 0, 0]
[outputs.rail]
kind = "relative"
of = "rail"
{tables}
[analysis]
kind = "dynamics"
end = {end}
{analysis}
"#
    )
}

/// A constant force [N] along it, or one that depends on the motion.
pub(crate) fn force(size: &str) -> String {
    format!("[loads.push]\nkind = \"joint_force\"\njoint = \"rail\"\nforce = \"{size}\"\n")
}
