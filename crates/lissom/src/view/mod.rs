//! The page of results: one self-contained HTML file, without network requests.
//!
//! The page itself is bundled from `viewer/`; here the results are inserted.

pub(crate) mod modes;
mod packed;

use lissom_model::output::{Column, Record};
use lissom_model::scene::Scene;
use serde::Serialize;
use serde_json::Value;

use crate::motion::{Motion, MotionError};

pub(crate) use packed::base64;

/// The page without results, as built by `viewer/build.js`.
const PAGE: &str = include_str!("viewer.html");
/// Maximum number of values of the table in a page; rows of longer ones are omitted.
const MAX_NUMBERS: usize = 1_500_000;

/// A note for the reader of a page about the results.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Notice {
    /// `warning` or `error`.
    kind: &'static str,
    /// Its text.
    text: String,
    /// Whether it is an excerpt of a file, shown verbatim.
    is_code: bool,
}

impl Notice {
    /// A warning.
    pub fn warning(text: impl Into<String>) -> Self {
        Self { kind: "warning", text: text.into(), is_code: false }
    }

    /// An error.
    pub fn error(text: impl Into<String>) -> Self {
        Self { kind: "error", text: text.into(), is_code: false }
    }

    /// The same, with lines of the model in it.
    #[must_use]
    pub fn with_code(self) -> Self {
        Self { is_code: true, ..self }
    }
}

/// Results for a page.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Results {
    /// Name of the model or of the folder.
    name: String,
    /// One line about the model.
    title: String,
    /// A short text about the run.
    facts: String,
    notices: Vec<Notice>,
    scene: Value,
    motion: Option<packed::Motion>,
    modes: Vec<modes::Mode>,
    columns: Vec<Value>,
    history: Option<String>,
    #[serde(skip)]
    effort: packed::Effort,
}

impl Results {
    /// Empty, for the model called `name`.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// For a waiting local page: data added from now on are compressed faster and less.
    #[must_use]
    pub fn packed_soon(self) -> Self {
        Self { effort: packed::Effort::Soon, ..self }
    }

    /// With one line about the model.
    #[must_use]
    pub fn with_title(self, title: &str) -> Self {
        Self { title: title.to_owned(), ..self }
    }

    /// With contents of `summary.json`: title, counts, and the reason if a run has ended early.
    #[must_use]
    pub fn with_summary(mut self, summary: &Value) -> Self {
        let word = |name: &str| summary[name].as_str().unwrap_or_default();
        if !word("title").is_empty() {
            word("title").clone_into(&mut self.title);
        }
        if let (Some(unknowns), Some(steps)) = (summary["unknowns"].as_u64(), summary["steps"].as_u64()) {
            let method = if word("analysis") == "path" { "equilibrium path" } else { word("scheme") };
            self.facts = format!("{method} · {unknowns} unknowns · {steps} steps");
        }
        let time = summary["time"].as_f64().unwrap_or_default();
        match word("stopped") {
            "failed" => self.notices.push(Notice::error(format!("The run failed: {}", word("error")))),
            "interrupted" => {
                self.notices.push(Notice::warning(format!("The run was interrupted at t = {time} s.")));
            }
            _ => {}
        }
        self
    }

    /// With a scene and its motion, as in the files of a run.
    ///
    /// # Errors
    /// If the bytes are not a motion file.
    pub fn with_motion(mut self, scene: Value, motion: &[u8]) -> Result<Self, MotionError> {
        let motion = Motion::from_bytes(motion)?;
        self.scene = scene;
        self.motion = Some(packed::Motion::of(&motion, self.effort));
        Ok(self)
    }

    /// With a model at its start.
    ///
    /// # Errors
    /// If the bytes are not a motion file.
    ///
    /// # Panics
    /// Never: plain numbers and texts are valid JSON.
    pub fn with_scene(self, scene: &Scene, motion: &[u8]) -> Result<Self, MotionError> {
        let scene = serde_json::to_value(scene).expect("plain numbers and texts can always be said in JSON");
        self.with_motion(scene, motion)
    }

    /// With natural modes, from the tables `modes.csv` and `shapes.csv`; none if they do not belong to the motion given
    /// before, which is the state about which the model is linearised.
    #[must_use]
    pub fn with_modes(mut self, modes: &str, shapes: &str) -> Option<Self> {
        self.modes = modes::read(modes, shapes, self.motion.as_ref()?.node_count())?;
        self.facts = format!("{} modes", self.modes.len());
        Some(self)
    }

    /// With the table of results.
    #[must_use]
    pub fn with_record(mut self, record: &Record) -> Self {
        let column = |column: &Column| serde_json::json!({ "name": column.name(), "quantity": column.quantity, "unit": column.unit });
        self.columns = record.columns.iter().map(column).collect();
        let numbers = record.times.len() * (record.columns.len() + 1);
        let stride = numbers.div_ceil(MAX_NUMBERS).max(1);
        if stride > 1 {
            let text = format!(
                "The plots show every {stride}th row of the table, which is longer than a page should be."
            );
            self.notices.push(Notice::warning(text));
        }
        self.history = Some(packed::table(record, stride, self.effort));
        self
    }

    /// With a note for the reader.
    #[must_use]
    pub fn with_notice(mut self, notice: Notice) -> Self {
        self.notices.push(notice);
        self
    }

    /// As the text of a JSON object, in the page's format.
    ///
    /// # Panics
    /// Never: plain numbers and texts are valid JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain numbers and texts can always be said in JSON")
    }

    /// The page with these results in it.
    pub fn page(&self) -> String {
        let title = if self.title.is_empty() { &self.name } else { &self.title };
        // An end tag within a text would end the script that contains it.
        fill(title, "'none'", &self.to_json().replace('<', "\\u003c"))
    }
}

/// A page without results, which requests them from its server.
pub fn empty_page(title: &str) -> String {
    fill(title, "'self'", "")
}

fn fill(title: &str, connect: &str, result: &str) -> String {
    let escaped = title.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let (head, rest) = PAGE.split_once("{{connect}}").unwrap_or((PAGE, ""));
    let (middle, rest) = rest.split_once("{{title}}").unwrap_or((rest, ""));
    let (before, after) = rest.split_once("{{result}}").unwrap_or((rest, ""));
    [head, connect, middle, &escaped, before, result, after].concat()
}
