//! The sweep file: which values of a model are varied, how they are sampled, and which scalars are collected from the
//! histories. It yields the overrides of every member and is independent of simulation.
//!
//! ```
//! use lissom_model::sweep::SweepFile;
//!
//! let text = r#"
//! lissom_sweep = 1
//! model = "pendulum.toml"
//! vary."point_masses.bob.mass" = [1, 2, 4]
//! vary."springs.spring.stiffness" = { from = 10, to = 20, count = 2 }
//! collect.highest = "max(bob.y)"
//! "#;
//! let sweep = SweepFile::parse(text, "masses.toml").expect("a good sweep");
//! assert_eq!(sweep.len(), 6);
//! let of_last = [("point_masses.bob.mass", "4"), ("springs.spring.stiffness", "20")];
//! assert_eq!(sweep.overrides(5), of_last.map(|(path, value)| (path.to_owned(), value.to_owned())));
//! ```

mod decode;
mod rainflow;
pub mod sampling;
mod statistic;
mod variation;
mod window;

use serde::Serialize;

pub use rainflow::Fatigue;
pub use statistic::{Accumulator, OF_FATIGUE, STATISTICS, Statistic};
pub use variation::{SweepValue, Variation};
pub use window::{TimeWindow, Window, WindowContext, WindowError, WindowedHistory};

/// The newest version of the format.
pub const VERSION: usize = 1;

/// Most members of a sweep.
pub const MAX_MEMBERS: usize = 10_000_000;

/// A path of the model and its values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Varied {
    /// Path into the model file, such as `point_masses.bob.mass`.
    pub path: String,
    /// The values.
    pub variation: Variation,
}

/// A scalar of each member's history.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Collected {
    /// Name of its column in the table.
    pub name: String,
    /// Statistic of the history.
    pub statistic: &'static str,
    /// Name of the history's column, such as `midspan.u2`, or of an event.
    pub column: String,
    /// Part of the history.
    #[serde(skip_serializing_if = "Window::is_whole")]
    pub window: Window,
    /// File and line where it is written.
    #[serde(skip)]
    pub position: String,
}

impl Collected {
    /// The statistic that [`statistic`](Self::statistic) names.
    ///
    /// # Panics
    /// Never for a sweep that was read from a file, where the name was checked.
    pub fn kind(&self) -> &'static Statistic {
        statistic::find(self.statistic).expect("the name was looked up when it was read")
    }

    /// Whether [`column`](Self::column) names an event.
    pub fn is_of_event(&self) -> bool {
        self.statistic == statistic::OF_EVENTS
    }
}

/// A sweep as written, checked. Its serialisation defines its members and results.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SweepFile {
    /// Path of the model file as it was written, if it was; relative to the sweep file.
    #[serde(skip)]
    pub model: Option<String>,
    /// Values changed in every member, as paths and TOML values.
    pub set: Vec<(String, String)>,
    /// Word of the sampling.
    pub sampling: &'static str,
    /// Start of the random numbers.
    pub seed: u64,
    /// Varied paths.
    pub vary: Vec<Varied>,
    /// Collected scalars.
    pub collect: Vec<Collected>,
    /// Columns whose whole histories are kept.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub histories: Vec<String>,
    members: usize,
    /// Samples of each member, for each varied path: the number, or the index of a listed value.
    #[serde(skip)]
    samples: Vec<f64>,
}

impl SweepFile {
    /// Number of members.
    pub fn len(&self) -> usize {
        self.members
    }

    /// Whether there are none; a file with no members is rejected.
    pub fn is_empty(&self) -> bool {
        self.members == 0
    }

    /// Value of the varied path number `path` in `member`.
    ///
    /// # Panics
    /// If there is no such member or path.
    pub fn value(&self, member: usize, path: usize) -> SweepValue {
        let sample = self.samples[member * self.vary.len() + path];
        match &self.vary[path].variation {
            Variation::Listed(values) => values[sample as usize].clone(),
            _ => SweepValue::Number(sample),
        }
    }

    /// Values changed in `member` in addition to [`set`](Self::set).
    ///
    /// # Panics
    /// If there is no such member.
    pub fn overrides(&self, member: usize) -> Vec<(String, String)> {
        let of = |(path, varied): (usize, &Varied)| (varied.path.clone(), self.value(member, path).to_toml());
        self.vary.iter().enumerate().map(of).collect()
    }
}
