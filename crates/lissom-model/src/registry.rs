//! The kinds of joints, springs and loads, and the schemes and solvers, that a model file may name.
//! The tables are an input of the decoder, so that this crate is independent of mechanics.

use lissom_mechanics::ports::Ports;
use lissom_mechanics::registry::Parameter;

/// One kind of joint, spring or load.
#[derive(Clone, Copy, Debug)]
pub struct KindEntry {
    /// Word in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// A minimal entry of a model file, without its heading.
    pub sample: &'static str,
    /// Parameters in addition to its ports.
    pub parameters: &'static [Parameter],
    /// What it is attached to.
    pub ports: Ports,
}

/// One scheme or solver.
#[derive(Clone, Copy, Debug)]
pub struct ChoiceEntry {
    /// Word in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Parameters of the choice in the table `[analysis]`.
    pub parameters: &'static [Parameter],
    /// Default `tolerance` of Newton's iterations, if different from that of other schemes.
    pub tolerance: Option<f64>,
}

/// The defaults of `analysis.scheme`.
pub const DEFAULT_SCHEMES: &str = "with `step`, the first is the default; without, `radau-iia-9`, and `radau-iia-5` for tolerances above 3e-5";

/// All the tables.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    /// Kinds of `[joints.*]`.
    pub joints: Vec<KindEntry>,
    /// Kinds of `[springs.*]`.
    pub springs: Vec<KindEntry>,
    /// Kinds of `[loads.*]`.
    pub loads: Vec<KindEntry>,
    /// Words for `analysis.scheme`; see [`DEFAULT_SCHEMES`].
    pub schemes: Vec<ChoiceEntry>,
    /// Words for `analysis.solver`; the first is the default.
    pub solvers: Vec<ChoiceEntry>,
}

impl Registry {
    /// The table that has entries of this kind.
    pub(crate) fn table_of(&self, kind: &str) -> Option<&'static str> {
        let tables = [("joints", &self.joints), ("springs", &self.springs), ("loads", &self.loads)];
        let has_it = |(_, kinds): &(&str, &Vec<KindEntry>)| kinds.iter().any(|entry| entry.name == kind);
        tables.into_iter().find(has_it).map(|(table, _)| table)
    }
}
