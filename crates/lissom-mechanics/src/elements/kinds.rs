//! The tables of kinds of springs and loads.

use super::kind::ElementKind;
use super::{
    bearing, bushing, coordinate_dynamics, coordinate_spring, force, force_between, friction, gyrostat,
    joint_load, latch, moment, point_spring, rolling_contact, rope, stop, tyre,
};

/// Springs and dampers, one line each.
pub static SPRINGS: &[ElementKind] = &[
    coordinate_spring::AXIAL,
    point_spring::KIND,
    rolling_contact::KIND,
    tyre::KIND,
    rope::KIND,
    coordinate_spring::TORSIONAL,
    friction::AXIAL,
    friction::TORSIONAL,
    bushing::KIND,
    bearing::matrices::KIND,
    bearing::film::KIND,
    coordinate_dynamics::KIND,
    stop::AXIAL,
    stop::TORSIONAL,
    latch::AXIAL,
    latch::TORSIONAL,
];

/// Loads, one line each.
pub static LOADS: &[ElementKind] =
    &[force::KIND, moment::KIND, force_between::KIND, joint_load::TORQUE, joint_load::FORCE, gyrostat::KIND];
