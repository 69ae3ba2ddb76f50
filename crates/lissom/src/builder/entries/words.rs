// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Words that keys choose among.

use crate::builder::entry::words;

words! {
    About { Static = "static", Undeformed = "undeformed" }
    Axes { Section = "section", Global = "global", Part = "part" }
    AxesOfTip { Ground = "ground", Base = "base", Tip = "tip" }
    Contacts { Elements = "elements", Set = "set" }
    Control { Positions = "positions", Forces = "forces" }
    Direction { Both = "both", Rising = "rising", Falling = "falling" }
    Directions { Exact = "exact", SmallAngles = "small_angles" }
    Film { Ruptured = "ruptured", Full = "full" }
    Form { BaseAxes = "base_axes", Screw = "screw" }
    Free { X = "x", Y = "y", Z = "z", Rx = "rx", Ry = "ry", Rz = "rz" }
    Kind { Compliant = "compliant", Rigid = "rigid", Along = "along", Nearest = "nearest", Nodes = "nodes" }
    Locked { X = "x", Y = "y", Z = "z", Rx = "rx", Ry = "ry", Rz = "rz" }
    Model { StVenantKirchhoff = "st-venant-kirchhoff", NeoHookean = "neo-hookean", MooneyRivlin = "mooney-rivlin" }
    Mounted { Left = "left", Right = "right" }
    Orientation { Free = "free", Tangent = "tangent", Section = "section" }
    Plane { Xy = "xy", Yz = "yz", Zx = "zx" }
    Scaling { Physical = "physical", Unit = "unit", None = "none" }
    Scheme { GeneralizedAlpha = "generalized-alpha", Hht = "hht", RadauIia = "radau-iia", RadauIia5 = "radau-iia-5", RadauIia9 = "radau-iia-9", RadauIia13 = "radau-iia-13", EnergyDecaying = "energy-decaying", BackwardEuler = "backward-euler" }
    Side { Both = "both", Tension = "tension", Compression = "compression" }
    SignedSide { Both = "both", Positive = "positive", Negative = "negative" }
    Solver { Sparse = "sparse", Pivoting = "pivoting", Strict = "strict" }
    Without { Prediction = "prediction", Secants = "secants", SingleCorrection = "single-correction", Account = "account", BackOff = "back-off", StartStresses = "start-stresses", Parts = "parts", StillAxes = "still-axes" }
}
