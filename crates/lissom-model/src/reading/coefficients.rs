//! Coefficients of a tyre: a tyre property file, or a table that names it and has other values of some of them.

use std::collections::BTreeMap;

use lissom_mechanics::elements::tyre::magic_formula::COEFFICIENTS;

use crate::files::tyre_file::tyre_file;
use crate::format::suggest;
use crate::parts::context::Context;
use crate::text::report::Problem;
use crate::text::{Node, Value};

impl Context<'_> {
    /// Coefficients by name.
    pub(crate) fn coefficients(&self, node: &Node, what: &str) -> Option<BTreeMap<String, f64>> {
        let table = match &node.value {
            Value::Text(name) => return self.of_tyre_file(node, name, what),
            Value::Table(table) => table,
            _ => {
                return self.wrong_type(
                    node,
                    what,
                    "a tyre property file, or `{ file = \"…\", LMUY = 0.8 }`",
                );
            }
        };
        let mut all = match table.get("file").map(|entry| &entry.node) {
            Some(file) => match &file.value {
                Value::Text(name) => self.of_tyre_file(file, name, what)?,
                _ => return self.wrong_type(file, &format!("`file` of {what}"), "the path of a file"),
            },
            None => BTreeMap::new(),
        };
        for (name, entry) in table {
            if name == "file" {
                continue;
            }
            let Some(known) = COEFFICIENTS.iter().find(|known| known.eq_ignore_ascii_case(name)) else {
                let problem = Problem::error(entry.key, format!("{what} has no coefficient `{name}`"));
                self.report(
                    problem
                        .label("unknown here")
                        .maybe_help(suggest::help(name, COEFFICIENTS.iter().copied())),
                );
                return None;
            };
            all.insert((*known).to_owned(), self.number(&entry.node, &format!("`{name}` of {what}"))?);
        }
        Some(all)
    }

    fn of_tyre_file(&self, file: &Node, name: &str, what: &str) -> Option<BTreeMap<String, f64>> {
        let text = self.file_text(file, name, what)?;
        let read = match tyre_file(&text) {
            Ok(read) => read,
            Err(error) => {
                let message = format!("{what}: `{name}`: {error}");
                return self.fail(
                    file.span,
                    message,
                    "specify a tyre property file of PAC2002 or MF-Tyre 5.2 in SI units or millimetres",
                );
            }
        };
        if !read.unused.is_empty() {
            let message =
                format!("{what}: `{name}` has coefficients that are not used: {}", read.unused.join(", "));
            let problem = Problem::warning(file.span, message);
            self.report(
                problem
                    .label("named here")
                    .help("the forces are those of PAC2002 and MF-Tyre 5.2 without them"),
            );
        }
        Some(read.coefficients)
    }
}
