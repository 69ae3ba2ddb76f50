//! The page of results: one self-contained HTML file, without network requests.
//!
//! The page itself is bundled from `viewer/`; here the results are inserted.

pub(crate) mod campbell;
mod fields;
pub(crate) mod modes;
mod packed;

use lissom_core::diagnostics::{Diagnose, Severity};
use lissom_model::output::{Column, Record, quantity_of};
use lissom_model::scene::Scene;
use serde::Serialize;
use serde_json::Value;

use crate::diagnostic::facts;
use crate::motion::{Motion, MotionError};

pub(crate) use packed::base64;

/// The page without results, as built by `viewer/build.js`.
const PAGE: &str = include_str!("viewer.html");
/// Maximum number of values of the table in a page; rows of longer ones are omitted.
const MAX_NUMBERS: usize = 1_500_000;
/// Maximum number of values of the fields in a page; longer motions have them in fewer frames.
const MAX_FIELDS: usize = 8_000_000;
/// What shells and solids have in a scene for their fields alone, which a page has from here.
const ONLY_FOR_FIELDS: [&str; 4] = ["axes", "directions", "stiffness", "cells"];

/// A note for the reader of a page about the results.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Notice {
    /// `warning` or `error`.
    kind: &'static str,
    /// Text of the notice.
    text: String,
    /// Whether it is an excerpt of a file, shown verbatim.
    is_code: bool,
    /// Code, remedy, part and time of a diagnostic, as in `summary.json`.
    code: Value,
    remedy: Value,
    part: Value,
    time: Value,
}

impl Notice {
    /// A warning.
    pub fn warning(text: impl Into<String>) -> Self {
        Self { kind: "warning", text: text.into(), ..Self::default() }
    }

    /// An error.
    pub fn error(text: impl Into<String>) -> Self {
        Self { kind: "error", text: text.into(), ..Self::default() }
    }

    /// A warning or failure with its code, remedy, part and time.
    pub fn of(diagnostic: &impl Diagnose) -> Self {
        let contents = diagnostic.diagnostic();
        let is_warning = contents.severity == Severity::Warning;
        let notice = if is_warning { Self::warning(contents.cause) } else { Self::error(contents.cause) };
        notice.with_facts(&facts(diagnostic))
    }

    /// A run that did not reach its end, by the contents of `summary.json`.
    pub(crate) fn of_end(summary: &Value) -> Option<Self> {
        let word = |name: &str| summary[name].as_str().unwrap_or_default();
        let time = summary["time"].as_f64().unwrap_or_default();
        match word("stopped") {
            "failed" => {
                let failure = &summary["failure"];
                let cause = failure["cause"].as_str().unwrap_or(word("error"));
                Some(Self::error(format!("The run failed: {cause}")).with_facts(failure))
            }
            "interrupted" => Some(Self::warning(format!("The run was interrupted at t = {time} s."))),
            "running" => {
                Some(Self::warning("The run is incomplete: it was killed, or is still in progress."))
            }
            _ => None,
        }
    }

    /// Text of the notice.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    fn with_facts(self, facts: &Value) -> Self {
        let of = |name: &str| facts[name].clone();
        Self { code: of("code"), remedy: of("remedy"), part: of("part"), time: of("time"), ..self }
    }

    /// This notice, with lines of the model in it.
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
    campbell: Option<campbell::Diagram>,
    columns: Vec<Value>,
    history: Option<String>,
    events: Vec<Value>,
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

    /// With contents of `summary.json`: title, counts, the reason if a run has ended early, and warnings.
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
        self.notices.extend(Notice::of_end(summary));
        let list = |name: &str| summary[name].as_array().into_iter().flatten();
        // Summaries of earlier versions have the texts only.
        let diagnostics = list("diagnostics").chain(std::iter::repeat(&Value::Null));
        let warnings = list("warnings").zip(diagnostics).map(|(text, facts)| {
            let text = facts["cause"].as_str().or(text.as_str()).unwrap_or_default();
            Notice::warning(text).with_facts(facts)
        });
        self.notices.extend(warnings);
        self
    }

    /// With a scene and its motion.
    ///
    /// # Errors
    /// If the bytes are not a motion file, or that of another scene.
    ///
    /// # Panics
    /// Never: plain numbers and texts are valid JSON.
    pub fn with_scene(mut self, scene: &Scene, motion: &[u8]) -> Result<Self, MotionError> {
        let motion = Motion::from_bytes(motion)?;
        if scene.most_node().index() >= motion.reference().len() {
            return Err(MotionError::Damaged);
        }
        let work = if self.effort == packed::Effort::Soon { MAX_FIELDS / 4 } else { MAX_FIELDS };
        self.motion = Some(packed::Motion::of(&motion, &fields::of(scene, &motion, work), self.effort));
        self.scene = serde_json::to_value(scene).expect("plain numbers and texts can always be said in JSON");
        for list in ["shells", "elastic_solids"] {
            let parts = self.scene.get_mut(list).and_then(Value::as_array_mut);
            for part in parts.into_iter().flatten().filter_map(Value::as_object_mut) {
                part.retain(|key, _| !ONLY_FOR_FIELDS.contains(&key.as_str()));
            }
        }
        Ok(self)
    }

    /// With natural modes, from the tables `modes.csv` and `shapes.csv`, and their names; none if they do not belong to the
    /// motion given before, which is the state about which the model is linearised.
    #[must_use]
    pub fn with_modes(mut self, modes: &str, shapes: &str, names: Vec<String>) -> Option<Self> {
        self.modes = modes::read(modes, shapes, self.motion.as_ref()?.node_count())?;
        self.modes.iter_mut().zip(names).for_each(|(mode, name)| mode.name = name);
        self.facts = format!("{} modes", self.modes.len());
        Some(self)
    }

    /// With a Campbell diagram, from the table `campbell.csv` and the contents of `summary.json`; none if the table is
    /// invalid.
    #[must_use]
    pub fn with_campbell(mut self, table: &str, summary: &Value) -> Option<Self> {
        let diagram = campbell::read(table, summary)?;
        self.facts = diagram.facts();
        self.campbell = Some(diagram);
        Some(self)
    }

    /// With the table of results.
    #[must_use]
    pub fn with_record(mut self, record: &Record) -> Self {
        let column = |(column, is_round_off): (&Column, bool)| {
            serde_json::json!({
                "name": column.name(),
                "quantity": quantity_of(column),
                "unit": column.unit,
                "plot": column.plot,
                "is_round_off": is_round_off,
            })
        };
        self.columns = record.columns.iter().zip(record.round_off()).map(column).collect();
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

    /// With the instants of events, from the table `events.csv`: time and name; lines of another form are omitted.
    #[must_use]
    pub fn with_events(mut self, table: &str) -> Self {
        let event = |line: &str| {
            let (time, name) = line.split_once(',')?;
            let time = time.parse::<f64>().ok().filter(|time| time.is_finite())?;
            Some(serde_json::json!({ "time": time, "name": name.trim_matches('"') }))
        };
        self.events = table.lines().skip(1).filter_map(event).collect();
        self
    }

    /// With a note for the reader.
    #[must_use]
    pub fn with_notice(self, notice: Notice) -> Self {
        self.with_notices([notice])
    }

    /// With notes for the reader.
    #[must_use]
    pub fn with_notices(mut self, notices: impl IntoIterator<Item = Notice>) -> Self {
        self.notices.extend(notices);
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
