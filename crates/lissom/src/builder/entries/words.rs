// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Words that keys choose among.

use crate::builder::entry::words;

words! {
    /// One of `static`, `undeformed`.
    About;
    Static = "static";
    Undeformed = "undeformed";
}

words! {
    /// One of `section`, `global`, `part`.
    Axes;
    Section = "section";
    Global = "global";
    Part = "part";
}

words! {
    /// One of `ground`, `base`, `tip`.
    AxesOfTip;
    Ground = "ground";
    Base = "base";
    Tip = "tip";
}

words! {
    /// One of `elements`, `set`.
    Contacts;
    Elements = "elements";
    Set = "set";
}

words! {
    /// One of `positions`, `forces`.
    Control;
    Positions = "positions";
    Forces = "forces";
}

words! {
    /// One of `both`, `rising`, `falling`.
    Direction;
    Both = "both";
    Rising = "rising";
    Falling = "falling";
}

words! {
    /// One of `exact`, `small_angles`.
    Directions;
    Exact = "exact";
    SmallAngles = "small_angles";
}

words! {
    /// One of `ruptured`, `full`.
    Film;
    Ruptured = "ruptured";
    Full = "full";
}

words! {
    /// One of `base_axes`, `screw`.
    Form;
    BaseAxes = "base_axes";
    Screw = "screw";
}

words! {
    /// One of `x`, `y`, `z`, `rx`, `ry`, `rz`.
    Free;
    X = "x";
    Y = "y";
    Z = "z";
    Rx = "rx";
    Ry = "ry";
    Rz = "rz";
}

words! {
    /// One of `compliant`, `rigid`, `along`, `nearest`, `nodes`.
    Kind;
    Compliant = "compliant";
    Rigid = "rigid";
    Along = "along";
    Nearest = "nearest";
    Nodes = "nodes";
}

words! {
    /// One of `x`, `y`, `z`, `rx`, `ry`, `rz`.
    Locked;
    X = "x";
    Y = "y";
    Z = "z";
    Rx = "rx";
    Ry = "ry";
    Rz = "rz";
}

words! {
    /// One of `st-venant-kirchhoff`, `neo-hookean`, `mooney-rivlin`.
    Model;
    StVenantKirchhoff = "st-venant-kirchhoff";
    NeoHookean = "neo-hookean";
    MooneyRivlin = "mooney-rivlin";
}

words! {
    /// One of `free`, `tangent`, `section`.
    Orientation;
    Free = "free";
    Tangent = "tangent";
    Section = "section";
}

words! {
    /// One of `xy`, `yz`, `zx`.
    Plane;
    Xy = "xy";
    Yz = "yz";
    Zx = "zx";
}

words! {
    /// One of `physical`, `unit`, `none`.
    Scaling;
    Physical = "physical";
    Unit = "unit";
    None = "none";
}

words! {
    /// One of `generalized-alpha`, `hht`, `radau-iia`, `radau-iia-5`, `radau-iia-9`, `radau-iia-13`, `energy-decaying`, `backward-euler`.
    Scheme;
    GeneralizedAlpha = "generalized-alpha";
    Hht = "hht";
    RadauIia = "radau-iia";
    RadauIia5 = "radau-iia-5";
    RadauIia9 = "radau-iia-9";
    RadauIia13 = "radau-iia-13";
    EnergyDecaying = "energy-decaying";
    BackwardEuler = "backward-euler";
}

words! {
    /// One of `both`, `tension`, `compression`.
    Side;
    Both = "both";
    Tension = "tension";
    Compression = "compression";
}

words! {
    /// One of `both`, `positive`, `negative`.
    SignedSide;
    Both = "both";
    Positive = "positive";
    Negative = "negative";
}

words! {
    /// One of `sparse`, `skyline`, `pivoting`, `dense`.
    Solver;
    Sparse = "sparse";
    Skyline = "skyline";
    Pivoting = "pivoting";
    Dense = "dense";
}

words! {
    /// One of `prediction`, `secants`, `single-correction`, `account`, `back-off`, `start-stresses`, `parts`.
    Without;
    Prediction = "prediction";
    Secants = "secants";
    SingleCorrection = "single-correction";
    Account = "account";
    BackOff = "back-off";
    StartStresses = "start-stresses";
    Parts = "parts";
}
