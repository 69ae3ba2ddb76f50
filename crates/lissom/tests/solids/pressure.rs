//! Pressures that depend on the present place: bodies that float.

use crate::support::runs::{last, run};

/// A raft of 2 x 2 x 0.5 m and 500 kg/m³ in water, which may heave, roll and pitch. Its middle plane is at the surface.
fn raft(hull: &str) -> String {
    format!(
        "lissom = 1\ngravity = [0, 0, -9.81]\n[materials.wood]\nE = 1e9\nnu = 0.3\ndensity = 500\n{hull}\n\
         [joints.x]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"raft@0.5,0.5,0\"\naxis = \"x\"\n\
         [joints.y]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"raft@0.5,0.5,0\"\naxis = \"y\"\n\
         [joints.yaw]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"raft@1,0.5,0\"\naxis = \"y\"\n\
         [loads.down]\nkind = \"force\"\non = \"raft@1,0.5,0\"\nvector = [0, 0, -5]\n\
         [loads.up]\nkind = \"force\"\non = \"raft@0,0.5,0\"\nvector = [0, 0, 5]\n\
         [outputs.east]\nkind = \"displacement\"\nof = \"raft@1,0.5,0\"\n[outputs.west]\nkind = \"displacement\"\nof = \"raft@0,0.5,0\"\n\
         [analysis]\nkind = \"statics\"\nend = 1\nramp = false\n"
    )
}

/// A moment M inclines a floating body by M/(ρ g V GM), GM = I/V - BG with the area's moment of inertia I, the volume V under water and the
/// distance BG of the centres of gravity and buoyancy.
#[test]
fn a_floating_raft_has_its_metacentre() {
    let block = "[solids.raft]\nsize = [2, 2, 0.5]\norigin = [-1, -1, -0.25]\ndivisions = [2, 2, 2]\nmaterial = \"wood\"\n\
                 pressure = { all = \"-9810*min(z, 0)\" }";
    let record = run(&raft(block), &[]);
    let [east, west] = ["east", "west"].map(|name| last(&record, name, "u3"));
    // I/V = 2³ 2/12/1, BG = 0.125.
    let exact = 2.0 * 5.0 / (9810.0 * (4.0 / 3.0 - 0.125));
    let angle = (west - east) / 2.0;
    assert!((angle / exact - 1.0).abs() < 2e-3, "{angle:e} {exact:e}");
    assert!((0.5 * (east + west)).abs() < 1e-5, "{east} {west}");
}

/// Water that stands against a wall: its force is ρ g h²/2 per width, at a third of the height.
#[test]
fn water_against_a_wall_has_its_force_and_moment() {
    let text = "lissom = 1\n[materials.stiff]\nE = 1e11\nnu = 0.3\ndensity = 1000\n\
                [shells.wall]\ncorners = [[0, 0, 0], [0, 3, 0], [0, 3, 2], [0, 0, 2]]\ndivisions = [3, 2]\nthickness = 0.2\nmaterial = \"stiff\"\n\
                pressure = \"9810*(2 - z)\"\n[joints.foot]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"wall.south\"\n\
                [outputs.foot]\nkind = \"reaction\"\nof = \"foot\"\n[analysis]\nkind = \"statics\"\nend = 1\n";
    let record = run(text, &[]);
    let [force, moment] = ["f1", "m2"].map(|component| last(&record, "foot", component).abs());
    let exact = 9810.0 * 2.0 * 3.0;
    assert!((force / exact - 1.0).abs() < 1e-4, "{force} {exact}");
    assert!((moment / (exact * 2.0 / 3.0) - 1.0).abs() < 1e-3, "{moment}");
}
