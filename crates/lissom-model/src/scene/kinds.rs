//! Symbols of all kinds of joints, springs and loads, one line for each. Rotating symbols are round about their axis, sliding
//! ones are parallel to it. A test fails for kinds without a symbol.

use super::solids::{Axes, Form, Solid, Tone};

use Tone::{Dark, Drive, Light, Load, Moment, Spring, Stop};

/// Axes of a symbol on the base and on the tip; the same where there is one node.
pub(super) type Both = [Axes; 2];

/// How a kind is drawn.
#[derive(Clone, Copy)]
pub(super) enum Drawn {
    /// Solids on base and tip, and the connection between them.
    Solids(fn(&Both) -> [Vec<Solid>; 2]),
    /// Solids on base and tip, with a rod from base to tip.
    WithRod(fn(&Both) -> [Vec<Solid>; 2]),
    /// By a coil from base to tip.
    Coil,
    /// By an arrow in proportion to its size.
    Arrow,
}

/// How a kind of joint, spring or load is drawn; none for kinds that are not known.
pub(super) fn drawn(kind: &str) -> Option<Drawn> {
    joint(kind).or_else(|| spring_or_load(kind))
}

fn joint(kind: &str) -> Option<Drawn> {
    use Drawn::{Solids, WithRod};
    Some(match kind {
        "revolute" => {
            Solids(|[b, _]| base(vec![b.cylinder(0, 0.62, 1.5, Dark), b.cylinder(0, 0.95, 0.7, Light)]))
        }
        "spherical" => Solids(|[b, _]| base(vec![b.ball(0.85, [0.0; 3], Light)])),
        "universal" => {
            Solids(|[b, _]| base(vec![b.cylinder(0, 0.4, 2.4, Light), b.cylinder(1, 0.4, 2.4, Dark)]))
        }
        "constant_velocity" => Solids(|[b, t]| {
            let stub =
                |axes: &Axes, at| axes.solid(Form::Cylinder, [0.38, 1.8, 0.0], (0, [at, 0.0, 0.0]), Dark);
            [vec![b.ball(0.9, [0.0; 3], Light), stub(b, -1.4)], vec![stub(t, 1.4)]]
        }),
        "prismatic" => Solids(|[b, _]| {
            base(vec![b.block([1.3, 2.2, 1.3], [0.0; 3], Light), b.block([0.55, 4.6, 0.55], [0.0; 3], Dark)])
        }),
        "cylindrical" => {
            Solids(|[b, _]| base(vec![b.cylinder(0, 0.85, 2.0, Light), b.cylinder(0, 0.4, 4.6, Dark)]))
        }
        "screw" => Solids(|[b, _]| {
            let threads = [-2.1, -1.7, -1.3, 1.3, 1.7, 2.1].map(|at| b.ring(0.45, 0.16, at, Dark));
            let nut = b.cylinder(0, 0.9, 1.8, Light);
            base([vec![nut, b.cylinder(0, 0.4, 4.8, Dark)], threads.to_vec()].concat())
        }),
        "planar" => Solids(|[b, t]| {
            let slider = t.block([0.9, 0.6, 0.9], [0.4, 0.0, 0.0], Dark);
            [vec![b.cylinder(0, 2.0, 0.16, Light)], vec![slider]]
        }),
        "point_in_plane" => {
            Solids(|[b, t]| [vec![b.cylinder(0, 2.0, 0.16, Light)], vec![t.ball(0.6, [0.0; 3], Dark)]])
        }
        "point_on_line" | "inline" => {
            Solids(|[b, t]| [vec![b.cylinder(0, 0.24, 6.0, Dark)], vec![t.ball(0.8, [0.0; 3], Light)]])
        }
        "parallel_axes" => Solids(|[b, t]| {
            let beside = t.solid(Form::Cylinder, [0.3, 3.2, 0.0], (0, [0.0, 0.0, 0.9]), Dark);
            [vec![b.cylinder(0, 0.3, 3.2, Light)], vec![beside]]
        }),
        "perpendicular_axes" => Solids(|[b, t]| {
            let across = t.solid(Form::Cylinder, [0.3, 3.2, 0.0], (1, [0.0, 0.0, 0.7]), Dark);
            [vec![b.cylinder(0, 0.3, 3.2, Light)], vec![across]]
        }),
        "generic" => Solids(|[b, _]| {
            let pins = [0, 1, 2].map(|along| b.cylinder(along, 0.25, 2.8, Dark));
            base([vec![b.block([1.3, 1.3, 1.3], [0.0; 3], Light)], pins.to_vec()].concat())
        }),
        "clamp" => Solids(|[b, _]| base(vec![b.block([1.5, 1.5, 1.5], [0.0; 3], Dark)])),
        "mean_motion" => WithRod(|[b, t]| {
            [vec![b.ball(0.5, [0.0; 3], Light)], vec![t.block([1.1, 1.1, 1.1], [0.0; 3], Dark)]]
        }),
        "distance" => {
            WithRod(|[b, t]| [vec![b.ball(0.6, [0.0; 3], Light)], vec![t.ball(0.6, [0.0; 3], Light)]])
        }
        "telescopic_rod" => WithRod(|[b, t]| {
            let sleeve = b.block([0.5, 0.5, 0.5], [0.0; 3], Dark);
            [vec![b.ball(0.6, [0.0; 3], Light), sleeve], vec![t.ball(0.6, [0.0; 3], Light)]]
        }),
        "rigid_link" => WithRod(|[b, t]| {
            let end = |axes: &Axes| vec![axes.block([1.1, 1.1, 1.1], [0.0; 3], Dark)];
            [end(b), end(t)]
        }),
        "swing_arm" => {
            WithRod(|[b, t]| [vec![b.cylinder(0, 0.75, 1.2, Light)], vec![t.ball(0.6, [0.0; 3], Light)]])
        }
        "rolling" => {
            Solids(|[_, t]| [Vec::new(), vec![t.ring(1.5, 0.2, 0.0, Dark), t.cylinder(0, 0.3, 0.6, Light)]])
        }
        // A rail, and the wheel on it.
        "wheel_on_rail" => Solids(|[b, t]| {
            let rail = [
                b.block([0.7, 0.5, 9.0], [0.0, -0.25, 0.0], Light),
                b.block([0.25, 1.2, 9.0], [0.0, -1.1, 0.0], Light),
            ];
            [rail.to_vec(), vec![t.cylinder(0, 1.5, 0.5, Dark), t.cylinder(0, 0.3, 1.2, Light)]]
        }),
        "prescribed_motion" => Solids(|[b, _]| base([b.arrow(Drive), b.turn(Drive)].concat())),
        "prescribed_rotation" => Solids(|[b, _]| base(b.turn(Drive))),
        "prescribed_displacement" => Solids(|[b, _]| base(b.arrow(Drive))),
        "gear" => Solids(|[b, t]| [wheel(b), wheel(t)]),
        "cam" => Solids(|[b, t]| {
            let disc = b.solid(Form::Cylinder, [1.5, 0.35, 0.0], (0, [0.0, 0.6, 0.0]), Dark);
            [vec![disc], vec![t.ring(0.9, 0.25, 0.0, Dark)]]
        }),
        "slider" => Solids(|[b, _]| {
            base(vec![b.block([1.4, 0.9, 0.9], [0.0; 3], Light), b.ball(0.55, [0.0; 3], Dark)])
        }),
        "generalized_coordinates" => Solids(|[b, _]| base(vec![b.ball(0.3, [0.0; 3], Light)])),
        "equation" => Solids(|[b, _]| {
            let bar = |at| b.solid(Form::Block, [0.3, 1.7, 0.3], (0, [0.0, 2.3, at]), Dark);
            base(vec![bar(-0.35), bar(0.35)])
        }),
        _ => return None,
    })
}

fn spring_or_load(kind: &str) -> Option<Drawn> {
    use Drawn::Solids;
    Some(match kind {
        "point" => Drawn::Coil,
        // A pulley at every position, and the rope between.
        "rope" => {
            Drawn::WithRod(|[b, t]| [vec![b.ring(0.5, 0.2, 0.0, Dark)], vec![t.ring(0.5, 0.2, 0.0, Dark)]])
        }
        "rolling_contact" | "tyre" => Solids(|[_, t]| {
            [Vec::new(), vec![t.ring(1.5, 0.4, 0.0, Spring), t.cylinder(0, 0.35, 0.7, Light)]]
        }),
        "bushing" => {
            Solids(|[b, t]| [vec![b.ring(0.95, 0.5, 0.0, Spring)], vec![t.cylinder(0, 0.4, 1.9, Dark)]])
        }
        "bearing" | "journal_bearing" => Solids(|[b, t]| {
            let outer = [-0.3, 0.3].map(|at| b.ring(1.0, 0.35, at, Spring));
            [outer.to_vec(), vec![t.cylinder(0, 0.6, 2.4, Dark)]]
        }),
        "torsional" => {
            Solids(|[b, _]| base([1.2, 1.55, 1.9].map(|radius| b.ring(radius, 0.1, 0.5, Spring)).to_vec()))
        }
        "torsional_latch" | "axial_latch" => {
            Solids(|[b, _]| base(vec![b.block([0.9, 0.5, 0.5], [0.0, 1.3, 0.0], Stop)]))
        }
        "axial" => Solids(|[b, _]| {
            base([-1.8, -1.2, -0.6, 0.0, 0.6, 1.2, 1.8].map(|at| b.ring(1.1, 0.12, at, Spring)).to_vec())
        }),
        "torsional_friction" => Solids(|[b, _]| {
            let pad = |at| b.block([0.5, 0.7, 0.9], [-0.6, at, 0.0], Stop);
            base(vec![b.ring(1.3, 0.16, -0.6, Dark), pad(1.5), pad(-1.5)])
        }),
        "axial_friction" => Solids(|[b, _]| {
            let pad = |at| b.block([0.4, 1.4, 0.9], [0.0, at, 0.0], Stop);
            base(vec![pad(1.1), pad(-1.1)])
        }),
        "torsional_stop" => Solids(|[b, _]| {
            let block = |at: [f64; 3]| b.block([0.55, 0.8, 0.55], at, Stop);
            base(vec![block([0.0, 1.5, 1.1]), block([0.0, 1.5, -1.1])])
        }),
        "axial_stop" => Solids(|[b, _]| {
            let disc = |at| b.solid(Form::Cylinder, [1.1, 0.35, 0.0], (0, [at, 0.0, 0.0]), Stop);
            base(vec![disc(-2.6), disc(2.6)])
        }),
        "coordinate_dynamics" => Solids(|[b, _]| {
            base(vec![b.block([0.8, 0.8, 0.8], [0.0, 2.2, 0.0], Dark), b.ring(0.6, 0.12, 1.2, Spring)])
        }),
        "force" | "moment" => Drawn::Arrow,
        "force_between" => {
            Drawn::WithRod(|[b, t]| [vec![b.ball(0.5, [0.0; 3], Load)], vec![t.ball(0.5, [0.0; 3], Load)]])
        }
        "joint_torque" => Solids(|[b, _]| base(b.turn(Moment))),
        "joint_force" => Solids(|[b, _]| base(b.arrow(Load))),
        "gyrostat" => {
            Solids(|[b, _]| base(vec![b.cylinder(0, 1.8, 0.6, Light), b.cylinder(0, 0.3, 2.6, Dark)]))
        }
        _ => return None,
    })
}

fn base(solids: Vec<Solid>) -> [Vec<Solid>; 2] {
    [solids, Vec::new()]
}

/// A wheel with twelve teeth.
fn wheel(axes: &Axes) -> Vec<Solid> {
    let tooth = |k: u32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::TAU / 12.0).sin_cos();
        axes.block([0.4, 0.34, 0.4], [0.0, 1.75 * cosine, 1.75 * sine], Dark)
    };
    std::iter::once(axes.cylinder(0, 1.6, 0.3, Dark)).chain((0..12).map(tooth)).collect()
}

#[cfg(test)]
#[path = "../../tests/unit/scene/kinds.rs"]
mod tests;
