//! Time per step of other programs on the scenes: figures for comparison, not measured here. Independent of the scenes.

/// A figure of the fastest other program.
pub(crate) struct Peer {
    /// Processor time of the solve per step [µs].
    pub(crate) microseconds: f64,
    /// The program.
    pub(crate) program: &'static str,
}

const EXUDYN: &str = "Exudyn 1.13.6";
const MBDYN: &str = "MBDyn";
const KYNEMA: &str = "Kynema";

/// Measured on one core of the same kind (AMD Zen 5), index-3 schemes of second order at the same step, the best
/// setting of each program; medians, ± 20-30 %.
const FIGURES: &[(&str, f64, &str)] = &[
    ("planar-pendulum", 1.2, EXUDYN),
    ("chain-s-10", 42.0, MBDYN),
    ("chain-s-100", 743.0, MBDYN),
    ("chain-s-1000", 9523.0, MBDYN),
    ("chain-r-10", 80.0, MBDYN),
    ("chain-r-100", 1086.0, EXUDYN),
    ("chain-r-1000", 10_072.0, EXUDYN),
    ("soft-beam-8", 35.0, MBDYN),
    ("soft-beam-64", 373.0, MBDYN),
    ("soft-beam-512", 3514.0, KYNEMA),
    ("aluminium-8", 65.0, MBDYN),
    ("aluminium-64", 531.0, MBDYN),
    ("aluminium-512", 4210.0, EXUDYN),
    ("tip-crank-1e-3", 325.0, MBDYN),
    ("tip-crank-1e-4", 188.0, MBDYN),
];

/// The figure for a scene, if there is one. A cubic element spans as many nodes as three of two nodes.
pub(crate) fn fastest(scene: &str) -> Option<Peer> {
    let twin = scene.rsplit_once("-cubic-").map(|(family, size)| {
        let elements = match size {
            "3" => "8",
            "21" => "64",
            "171" => "512",
            _ => "none",
        };
        format!("{family}-{elements}")
    });
    let name = twin.as_deref().unwrap_or(scene);
    let found = FIGURES.iter().find(|(known, ..)| *known == name)?;
    Some(Peer { microseconds: found.1, program: found.2 })
}
