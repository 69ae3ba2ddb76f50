//! Mechanisms against closed forms and other programs: wheels that roll, prescribed motions, robots from files, and the models of
//! the gallery.

mod gallery;
mod hydraulics;
mod import;
mod import_chains;
mod import_faults;
mod mjcf;
mod mjcf_scenes;
mod prescribed_motion;
mod ready_made_parts;
mod rolling;
mod sdf;
mod sensors;
mod starts;
mod to_urdf;
mod touching;
mod vehicles;
