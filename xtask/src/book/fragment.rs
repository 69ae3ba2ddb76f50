//! Result of a generator: Markdown and its drawings. Independent of the numbers.

use std::fmt::Write;

use lissom::Override;
use lissom_model::output::LogFigure;

use super::BookError;

/// Text for the region of a chapter.
#[derive(Default)]
pub(super) struct Fragment {
    /// Markdown; paths of drawings are relative to docs/.
    pub(super) text: String,
    /// Paths below docs/ and contents.
    pub(super) drawings: Vec<(String, String)>,
}

impl Fragment {
    /// The commands that make the same numbers.
    pub(super) fn commands(&mut self, commands: &[String]) {
        let _ = write!(self.text, "```sh\n{}\n```\n\n", commands.join("\n"));
    }

    /// A table.
    pub(super) fn table(&mut self, heading: &[&str], rows: &[Vec<String>]) {
        let _ = writeln!(self.text, "| {} |\n|{}", heading.join(" | "), "---|".repeat(heading.len()));
        for row in rows {
            let _ = writeln!(self.text, "| {} |", row.join(" | "));
        }
        self.text.push('\n');
    }

    /// A drawing.
    pub(super) fn figure(&mut self, name: &str, caption: &str, figure: &LogFigure) -> Result<(), BookError> {
        let drawing = figure.draw()?.svg()?;
        self.drawing(&format!("generated/{name}.svg"), caption, drawing);
        Ok(())
    }

    /// A drawing as a text, by its path below docs/.
    pub(super) fn drawing(&mut self, path: &str, caption: &str, drawing: String) {
        let _ = write!(self.text, "![{caption}]({path})\n\n");
        self.drawings.push((path.to_owned(), drawing));
    }
}

/// A command line of a study.
pub(super) fn study_command(
    study: &str,
    example: &str,
    options: &[(&str, &str)],
    set: &[Override],
) -> String {
    let mut line = format!("lissom study {study} examples/{example}.toml");
    let quoted = |text: &str| {
        if text.contains(['(', '*', '[', ' ']) { format!("'{text}'") } else { text.to_owned() }
    };
    for (option, value) in options {
        let _ = write!(line, " --{option} {}", quoted(value));
    }
    for (path, value) in set {
        let _ = write!(line, " --set {}", quoted(&format!("{path}={value}")));
    }
    line
}

/// Values to put into a model.
pub(super) fn overrides(set: &[(&str, &str)]) -> Vec<Override> {
    set.iter().map(|&(path, value)| (path.to_owned(), value.to_owned())).collect()
}

/// Texts for a study.
pub(super) fn texts(list: &[&str]) -> Vec<String> {
    list.iter().map(|&text| text.to_owned()).collect()
}
