// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! What pulls nodes or joints back, one type per kind.

use super::words;
use crate::builder::entry::{entries, keys};
use crate::builder::expression::Function;
use crate::builder::values::{Matrix, Node, PositionOrNode};
use crate::ids::{InputId, JointId};

entries! {
    /// Spring and damper on a joint's relative displacement.
    Axial => SpringId, kind: "axial" {
        * joint: JointId = "joint", "the joint whose relative displacement it acts on";
        displacement: f64 = "displacement", "Relative displacement without force; default 0 \\[m\\].";
    }

    /// Spring and damper between two points, along the line through them.
    Point => SpringId, kind: "point" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        length: f64 = "length", "Free length; default: the length at the start \\[m\\].";
    }

    /// A wheel, disc or ball on a compliant plane with friction: it may lift off and slide.
    RollingContact => SpringId, kind: "rolling_contact" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * normal: [f64; 3] = "normal", "Normal at the start of the plane, which is fixed in the base, global axes; `at_base` is a point of the plane";
        * wheel_axis: [f64; 3] = "wheel_axis", "Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre";
        * stiffness: f64 = "stiffness", "Normal force per penetration \\[N/m\\]";
        radius: f64 = "radius", "Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for a ball of radius `rim` \\[m\\].";
        rim: f64 = "rim", "Rounding radius of the rim; default 0 \\[m\\].";
        dissipation: f64 = "dissipation", "Relative increase of the normal force per penetration velocity; default 0 \\[s/m\\].";
        damping: f64 = "damping", "Normal force per penetration velocity, while in contact; default 0 \\[N s/m\\].";
        friction_coefficient: f64 = "friction_coefficient", "Coefficient of sliding friction; default 0.";
        slip_velocity: f64 = "slip_velocity", "Velocity v\\_s of the law μ tanh(v/v\\_s), below which the wheel creeps; default 0.01 \\[m/s\\].";
        traction: Function = "traction", "Coefficient of friction over the sliding velocity `slip` \\[m/s\\], instead of the law of `friction_coefficient`.";
        roller_angle: f64 = "roller_angle", "Angle about the normal from the axis of the wheel to that of the roller in contact, for a wheel with free rollers on its rim: friction acts along the axis of the roller \\[rad\\].";
        rolling_friction: f64 = "rolling_friction", "Moment per normal force against rolling, of a wheel about its axis, of a ball about every axis in the plane; default 0 \\[m\\].";
        rolling_damping: f64 = "rolling_damping", "Additional moment per normal force and rolling rate; default 0 \\[m s/rad\\].";
        rolling_rate: f64 = "rolling_rate", "Rate ω\\_s of the law tanh(ω/ω\\_s) of `rolling_friction`, below which the wheel creeps; default 0.01 \\[rad/s\\].";
    }

    /// A tyre on a road, plane or uneven: brush model or Magic Formula with combined slip, relaxation, camber, trail and standstill without creep.
    Tyre => SpringId, kind: "tyre" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * normal: [f64; 3] = "normal", "Normal of the road at the start, which is fixed in the base, global axes; `at_base` is a point of the road";
        * wheel_axis: [f64; 3] = "wheel_axis", "Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre. The tip is the part that rotates";
        radius: f64 = "radius", "Free radius; default: the one with which it touches the road at the start \\[m\\].";
        magic_formula: String = "magic_formula", "Coefficients of PAC2002 or MF-Tyre 5.2: a tyre property file `.tir`, or `{ file = \"…\", LMUY = 0.8 }` with other values of some. They replace the other data of the tyre except for `damping_time`.";
        mounted: words::Mounted = "mounted", "Side of the vehicle, on which `wheel_axis` points to the left; offsets change their sign on the side for which the file was not measured; default: the side of the file.";
        stiffness: f64 = "stiffness", "Normal force per deflection; required without `magic_formula` \\[N/m\\].";
        damping: f64 = "damping", "Normal force per deflection rate, without `magic_formula`; default 0 \\[N s/m\\].";
        friction_coefficient: f64 = "friction_coefficient", "Coefficient of friction; that of dry asphalt is the default; default 0.9.";
        slip_stiffness: f64 = "slip_stiffness", "Longitudinal force per slip and normal force, at small slip; required without `magic_formula`.";
        cornering_stiffness: f64 = "cornering_stiffness", "Lateral force per slip angle and normal force, at small angles; required without `magic_formula`.";
        camber_stiffness: f64 = "camber_stiffness", "Lateral force per camber angle and normal force, towards the side to which the wheel leans; default 0.";
        pneumatic_trail: f64 = "pneumatic_trail", "Distance of the lateral force behind the centre of contact at small angles; default a tenth of the radius \\[m\\].";
        relaxation_length: f64 = "relaxation_length", "Distance over which a lateral force builds up; default the radius \\[m\\].";
        longitudinal_relaxation_length: f64 = "longitudinal_relaxation_length", "The same for a longitudinal force; default half of the radius \\[m\\].";
        damping_time: f64 = "damping_time", "Damping of the tread over its stiffness, which fades beyond 1 m/s; default 5e-3 \\[s\\].";
        rolling_resistance: f64 = "rolling_resistance", "Resistance to rolling over the normal force; default 0.";
        load_sensitivity: f64 = "load_sensitivity", "Decrease of friction with the normal force: μ/(1 + this N); default 0 \\[1/N\\].";
        road: Function = "road", "Height of an uneven road above the plane, along `normal`: an expression of `x` and `y`, a table over `x`, a grid `{ file = \"…\" }`, or a random profile `{ class = \"C\" }` of ISO 8608; x and y from `at_base`, in the plane \\[m\\].";
        road_direction: [f64; 3] = "road_direction", "Direction of x of the road at the start, global axes; its part in the plane counts.";
        width: f64 = "width", "Width of the contact on an uneven road; default three fifths of the radius \\[m\\].";
        contact_length: f64 = "contact_length", "Length of the contact on an uneven road; default two fifths of the radius \\[m\\].";
    }

    /// Rope that slides over several points without friction: pulleys, and hoists by its free length.
    Rope => SpringId, kind: "rope" {
        * along: Vec<(Node, PositionOrNode)> = "along", "points over which it passes, from one end to the other \\[m\\]";
        drums: Vec<JointId> = "drums", "Coordinates of joints that pay it out, such as \"drum.angle\"; the name of a joint stands for all its coordinates.";
        stiffness: f64 = "stiffness", "Stiffness of the whole rope; default 0 \\[N/m\\].";
        damping: f64 = "damping", "Damping of the whole rope; default 0 \\[N s/m\\].";
        force: Function = "force", "Tension over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` \\[N\\].";
        damper_force: Function = "damper_force", "Tension over `rate` and `elongation`, in addition to `damping`; a table is over `rate` \\[N\\].";
        limits: [f64; 2] = "limits", "Minimum and maximum tension; default: none \\[N\\].";
        length: Function = "length", "Free length of the whole rope; a function of time for a winch; default: the length at the start \\[m\\].";
        drum_radii: Vec<f64> = "drum_radii", "Length of rope paid out by each of `drums` per rad or m of its coordinate; negative if it winds the rope up \\[m\\].";
        diameter: f64 = "diameter", "Diameter with which it is drawn; default: a thin line \\[m\\].";
    }

    /// Spring and damper on a joint's relative rotation.
    Torsional => SpringId, kind: "torsional" {
        * joint: JointId = "joint", "the joint whose relative rotation it acts on";
        stiffness: f64 = "stiffness", "Stiffness; default 0 \\[N m/rad\\].";
        damping: f64 = "damping", "Damping; default 0 \\[N m s/rad\\].";
        moment: Function = "moment", "Moment over `rotation` and `rate`, in addition to `stiffness`; a table is over `rotation` \\[N m\\].";
        damper_moment: Function = "damper_moment", "Moment over `rate` and `rotation`, in addition to `damping`; a table is over `rate` \\[N m\\].";
        side: words::SignedSide = "side", "Where it acts: above its free rotation (\"positive\"), below it (\"negative\"), or both; default `\"both\"`.";
        limits: [f64; 2] = "limits", "Minimum and maximum moment; default: none \\[N m\\].";
        backlash: f64 = "backlash", "Width of the backlash about the free rotation, without moment; default 0 \\[rad\\].";
        angle: f64 = "angle", "Relative rotation without moment; default 0 \\[rad\\].";
        preload: f64 = "preload", "Moment at the start, positive if it resists a positive rotation, instead of the rotation without moment \\[N m\\].";
    }

    /// Dry and viscous friction on a joint's relative displacement; sticking is free of creep.
    AxialFriction => SpringId, kind: "axial_friction" {
        * joint: JointId = "joint", "the joint whose relative displacement it acts on";
        * coulomb: f64 = "coulomb", "Force of sliding friction \\[N\\]";
        breakaway: f64 = "breakaway", "Additional force of friction at rest; default none \\[N\\].";
        stribeck: f64 = "stribeck", "Velocity at which the additional force has fallen to 1/e; default 0.01 \\[m/s\\].";
        viscous: f64 = "viscous", "Additional force per velocity; default 0 \\[N s/m\\].";
        deflection: f64 = "deflection", "Elastic displacement before it slips; default 1e-4 \\[m\\].";
        damping: f64 = "damping", "Damping of the elastic displacement; default 0 \\[N s/m\\].";
    }

    /// Dry and viscous friction on a joint's relative rotation; sticking is free of creep.
    TorsionalFriction => SpringId, kind: "torsional_friction" {
        * joint: JointId = "joint", "the joint whose relative rotation it acts on";
        * coulomb: f64 = "coulomb", "Moment of sliding friction \\[N m\\]";
        breakaway: f64 = "breakaway", "Additional moment of friction at rest; default none \\[N m\\].";
        stribeck: f64 = "stribeck", "Rate at which the additional moment has fallen to 1/e; default 0.01 \\[rad/s\\].";
        viscous: f64 = "viscous", "Additional moment per rate; default 0 \\[N m s/rad\\].";
        deflection: f64 = "deflection", "Elastic rotation before it slips; default 1e-4 \\[rad\\].";
        damping: f64 = "damping", "Damping of the elastic rotation; default 0 \\[N m s/rad\\].";
    }

    /// Springs and dampers along and about three axes, with full matrices, also between coincident points.
    Bushing => SpringId, kind: "bushing" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        stiffness: Matrix = "stiffness", "6 x 6 or its diagonal: displacements along the axes, rotations about them; default 0 \\[N/m, N, N m/rad\\].";
        damping: Matrix = "damping", "6 x 6 or its diagonal, as `stiffness`; default 0 \\[N s/m, N s, N m s/rad\\].";
        form: words::Form = "form", "Displacement and rotation in the axes of the base (\"base\\_axes\"), or as a screw, which is the same from both sides; default `\"base_axes\"`.";
    }

    /// Bearing of a rotating shaft: stiffness and damping matrices, which may be unsymmetric and depend on the speed.
    Bearing => SpringId, kind: "bearing" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        stiffness: Vec<Vec<f64>> = "stiffness", "For displacements across the shaft (2 x 2), along it and across (3 x 3), across with rotations about both axes (4 x 4), or all (5 x 5); a number is for both directions across; default 0 \\[N/m, N, N m/rad\\].";
        damping: Vec<Vec<f64>> = "damping", "As `stiffness`; default 0 \\[N s/m, N s, N m s/rad\\].";
        k22: Function = "k22", "Stiffness over `speed` \\[rad/s\\], added to `stiffness`: force along axis 2 per displacement along it \\[N/m\\].";
        k23: Function = "k23", "The same for a displacement along axis 3 \\[N/m\\].";
        k32: Function = "k32", "Force along axis 3 per displacement along axis 2 \\[N/m\\].";
        k33: Function = "k33", "The same for a displacement along axis 3 \\[N/m\\].";
        c22: Function = "c22", "Damping over `speed` \\[rad/s\\], added to `damping`, as `k22` \\[N s/m\\].";
        c23: Function = "c23", "As `k23` \\[N s/m\\].";
        c32: Function = "c32", "As `k32` \\[N s/m\\].";
        c33: Function = "c33", "As `k33` \\[N s/m\\].";
    }

    /// Short journal bearing with a fluid film, or squeeze-film damper of a shaft that does not rotate in it.
    JournalBearing => SpringId, kind: "journal_bearing" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * radius: f64 = "radius", "Radius of the journal \\[m\\]";
        * length: f64 = "length", "Length along the shaft, short against the diameter \\[m\\]";
        * clearance: f64 = "clearance", "Radial clearance \\[m\\]";
        * viscosity: f64 = "viscosity", "Dynamic viscosity of the lubricant \\[Pa s\\]";
        film: words::Film = "film", "Film where the pressure is positive (\"ruptured\"), or everywhere (\"full\"); default `\"ruptured\"`.";
    }

    /// Mass, damping and stiffness matrices on coordinates: `M q'' + D q' + K (q - rest)` in their equations.
    CoordinateDynamics => SpringId, kind: "coordinate_dynamics" {
        * coordinates: Vec<JointId> = "coordinates", "coordinates on which it acts, such as \"arm.angle\", in the order of its matrices; the name of a joint stands for all its coordinates";
        mass: Vec<Vec<f64>> = "mass", "Mass matrix, symmetric, without negative eigenvalues; default 0 \\[kg, kg m or kg m²\\].";
        damping: Vec<Vec<f64>> = "damping", "Damping matrix; it may be unsymmetric (gyroscopic forces) or negative; default 0 \\[N s/m, N s or N m s/rad\\].";
        stiffness: Vec<Vec<f64>> = "stiffness", "Stiffness matrix; it may be unsymmetric (circulatory forces); default 0 \\[N/m, N/rad or N m/rad\\].";
        rest: Vec<f64> = "rest", "Values of the coordinates without force of `stiffness`; default zeros \\[m or rad\\].";
    }

    /// Stops at the ends of the range of a joint's relative displacement.
    AxialStop => SpringId, kind: "axial_stop" {
        * joint: JointId = "joint", "the joint whose relative displacement it acts on";
        * range: [f64; 2] = "range", "Displacements of the two stops; none at an infinite end \\[m\\]";
        * stiffness: f64 = "stiffness", "Force at a penetration of 1 m \\[N/m^n\\]";
        dissipation: f64 = "dissipation", "Factor a of the penetration rate; default 0 \\[s/m\\].";
        damping: f64 = "damping", "Force per penetration rate, while in contact; default 0 \\[N s/m\\].";
        restitution: f64 = "restitution", "Instead of `dissipation`: velocity after an impact over that before, 0.01 to 1, at `impact_velocity`.";
        impact_velocity: f64 = "impact_velocity", "Velocity of that impact \\[m/s\\].";
    }

    /// Stops at the ends of the range of a joint's relative rotation.
    TorsionalStop => SpringId, kind: "torsional_stop" {
        * joint: JointId = "joint", "the joint whose relative rotation it acts on";
        * range: [f64; 2] = "range", "Rotations of the two stops; none at an infinite end \\[rad\\]";
        * stiffness: f64 = "stiffness", "Moment at a penetration of 1 rad \\[N m/rad^n\\]";
        dissipation: f64 = "dissipation", "Factor a of the penetration rate; default 0 \\[s/rad\\].";
        damping: f64 = "damping", "Moment per penetration rate, while in contact; default 0 \\[N m s/rad\\].";
        restitution: f64 = "restitution", "Instead of `dissipation`: rate after an impact over that before, 0.01 to 1, at `impact_velocity`.";
        impact_velocity: f64 = "impact_velocity", "Rate of that impact \\[rad/s\\].";
    }

    /// Locks a joint's relative displacement at its current value while an input is set: latches and releases.
    AxialLatch => SpringId, kind: "axial_latch" {
        * joint: JointId = "joint", "the joint whose relative displacement it acts on";
        * engaged: InputId = "engaged", "Input that engages it: locked above 0.5, otherwise free; set by events";
    }

    /// Locks a joint's relative rotation at its current value while an input is set: latches and releases.
    TorsionalLatch => SpringId, kind: "torsional_latch" {
        * joint: JointId = "joint", "the joint whose relative rotation it acts on";
        * engaged: InputId = "engaged", "Input that engages it: locked above 0.5, otherwise free; set by events";
    }
}

keys! {
    [Axial, Point]
        stiffness: f64 = "stiffness", "Stiffness; default 0 \\[N/m\\].";
        damping: f64 = "damping", "Damping; default 0 \\[N s/m\\].";
        force: Function = "force", "Force over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` \\[N\\].";
        damper_force: Function = "damper_force", "Force over `rate` and `elongation`, in addition to `damping`; a table is over `rate` \\[N\\].";
        side: words::Side = "side", "Where it acts: beyond its free length (\"tension\"), below it (\"compression\"), or both; default `\"both\"`.";
        limits: [f64; 2] = "limits", "Minimum and maximum force; default: none \\[N\\].";
        backlash: f64 = "backlash", "Width of the backlash about the free length, without force; default 0 \\[m\\].";
        preload: f64 = "preload", "Force at the start, positive if it pulls, instead of the position without force \\[N\\].";
}

keys! {
    [Axial, Torsional, AxialFriction, TorsionalFriction, AxialStop, TorsionalStop, AxialLatch, TorsionalLatch]
        coordinate: f64 = "coordinate", "Number of the joint's coordinate, from 1; default: the first suitable one.";
}

keys! {
    [Point, RollingContact, Tyre, Bushing, Bearing, JournalBearing]
        at_base: [f64; 3] = "at_base", "Location on the base; default: the node's position \\[m\\].";
        at_tip: [f64; 3] = "at_tip", "Location on the tip; default: the node's position \\[m\\].";
}

keys! {
    [Bushing, Bearing, JournalBearing]
        axis: [f64; 3] = "axis", "First axis at the start, global axes; default global x. The axes rotate with the base.";
}

keys! {
    [Bushing, Bearing]
        second_axis: [f64; 3] = "second_axis", "Second axis at the start, global axes, made perpendicular to the first; default global y.";
}

keys! {
    [AxialStop, TorsionalStop]
        exponent: f64 = "exponent", "Exponent n, at least 1; default 1.";
}
