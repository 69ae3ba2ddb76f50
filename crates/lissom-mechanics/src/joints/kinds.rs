//! The table of kinds of joints.

use super::kind::JointKind;
use super::{
    cam, clamp, constant_velocity, cylindrical, distance, equation, gear, generalized_coordinates, generic,
    inline, mean_motion, parallel_axes, perpendicular_axes, planar, point_in_plane, point_on_line,
    prescribed_displacement, prescribed_motion, prescribed_rotation, prismatic, revolute, rigid_link,
    rolling, screw, slider, spherical, swing_arm, telescopic_rod, universal, wheel_on_rail,
};

/// All kinds of joints, one line each.
pub static KINDS: &[JointKind] = &[
    cam::KIND,
    clamp::KIND,
    constant_velocity::KIND,
    cylindrical::KIND,
    distance::KIND,
    equation::KIND,
    gear::KIND,
    generalized_coordinates::KIND,
    generic::KIND,
    inline::KIND,
    mean_motion::KIND,
    parallel_axes::KIND,
    perpendicular_axes::KIND,
    planar::KIND,
    point_in_plane::KIND,
    point_on_line::KIND,
    prescribed_displacement::KIND,
    prescribed_motion::KIND,
    prescribed_rotation::KIND,
    prismatic::KIND,
    revolute::KIND,
    rigid_link::KIND,
    rolling::KIND,
    screw::KIND,
    slider::KIND,
    spherical::KIND,
    swing_arm::KIND,
    telescopic_rod::KIND,
    universal::KIND,
    wheel_on_rail::KIND,
];
