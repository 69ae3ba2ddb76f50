//! The text of a model, read once, and the documents it becomes under overrides.

use std::path::Path;
use std::sync::Arc;

use crate::Document;
use crate::document::decode::from_tree;
use crate::files::library::Library;
use crate::registry::Registry;
use crate::text::report::Report;
use crate::text::toml_text;
use crate::text::{self, Patch, Tree};

/// A model's text as a tree of values. It is read once and opened many times, with different overrides.
#[derive(Clone, Debug)]
pub struct ModelText(Tree);

impl ModelText {
    /// Reads `text` and lays `overrides` over it, as [`Document::parse_with`] does. `file_name` is for messages, and the
    /// files that the model includes are looked for beside it.
    ///
    /// # Errors
    /// If the text is not TOML, or the path of an override does not exist.
    pub fn read(text: &str, file_name: &str, overrides: &[(String, String)]) -> Result<Self, Report> {
        Self::read_with(text, file_name, overrides, Arc::new(Library::beside(Path::new(file_name))))
    }

    /// Reads `text` with included files from `library`.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_with(
        text: &str,
        file_name: &str,
        overrides: &[(String, String)],
        library: Arc<Library>,
    ) -> Result<Self, Report> {
        Self::read_without(text, (file_name, &[]), overrides, library)
    }

    /// Reads `text` without the values and entries that the paths `left_out` lead to.
    ///
    /// # Errors
    /// As [`read`](Self::read); also if there is nothing to leave out at a path.
    pub fn read_without(
        text: &str,
        (file_name, left_out): (&str, &[String]),
        overrides: &[(String, String)],
        library: Arc<Library>,
    ) -> Result<Self, Report> {
        let mut tree = text::read(text, file_name, &[], library);
        tree.leave_out(left_out);
        tree.lay(overrides);
        if tree.problems.is_empty() { Ok(Self(tree)) } else { Err(Report::new(tree.problems, &tree.sources)) }
    }

    /// The checked document, with further `overrides` put in place.
    ///
    /// # Errors
    /// All that is wrong with the model or with an override.
    pub fn document(&self, registry: &Registry, overrides: &[(String, String)]) -> Result<Document, Report> {
        let mut tree = self.0.clone();
        tree.lay(overrides);
        from_tree(tree, registry)
    }

    /// The included files, as far as they have been read.
    pub fn library(&self) -> &Library {
        &self.0.library
    }

    /// Overrides inside parts, each as `path = value`; [`to_toml`](Self::to_toml) cannot express them.
    pub fn overrides_inside_parts(&self) -> Vec<String> {
        let line = |patch: &Patch| {
            let path: Vec<String> = patch.path.iter().map(|(name, _)| toml_text::key(name)).collect();
            format!("{} = {}", path.join("."), toml_text::inline(&patch.value))
        };
        self.0.deferred.iter().map(line).collect()
    }

    /// The model as TOML, overrides in place except those inside of parts, without comments. Files stay included. Every
    /// number is reproduced to the last bit.
    pub fn to_toml(&self) -> String {
        toml_text::file(&self.0.root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
lissom = 1
title = "a \"b\"" # a comment
[parameters]
length = 0.1
area = "length^2"
[point_masses."my ball"]
mass = 0.30000000000000004
velocity = [3, 0, "sqrt(2)"]
[outputs.ball]
kind = "position"
of = "my ball"
[analysis]
kind = "dynamics"
end = 1
step = 1e-300
"#;

    fn set(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect()
    }

    #[test]
    fn a_text_opened_twice_is_the_same_as_a_text_read_twice() {
        let registry = Registry::default();
        let text = ModelText::read(TEXT, "a.toml", &set(&[("analysis.end", "2")])).unwrap();
        for step in ["1e-1", "1e-2"] {
            let both = set(&[("analysis.end", "2"), ("analysis.step", step)]);
            let once = text.document(&registry, &both[1..]).unwrap();
            let twice = Document::parse_with(TEXT, "a.toml", &registry, &both).unwrap();
            assert_eq!(format!("{once:?}"), format!("{twice:?}"));
        }
        let report = text.document(&registry, &set(&[("analysis.stepp", "1")])).unwrap_err().render(false);
        assert!(report.contains("stepp") && report.contains("[override:1"), "{report}");
    }

    #[test]
    fn what_is_left_out_counts_as_never_written() {
        let registry = Registry::default();
        let without = |paths: &[&str], overrides: &[(&str, &str)]| {
            let paths: Vec<String> = paths.iter().map(|path| (*path).to_owned()).collect();
            let text = ModelText::read_without(TEXT, ("a.toml", &paths), &set(overrides), Arc::default());
            text.and_then(|text| text.document(&registry, &[]))
        };
        let document = without(&["title", "point_masses.\"my ball\".velocity"], &[]).unwrap();
        assert_eq!(document.title, None);
        let document = without(&["parameters.area"], &[("parameters.length", "3")]).unwrap();
        assert_eq!(document.parameters.keys().collect::<Vec<_>>(), ["length"]);
        for (path, words) in [
            ("titel", "did you mean `title`"),
            ("analysis.stepp", "did you mean `step`"),
            ("title.x", "is a value"),
            ("bodies.b", "no `bodies` here"),
        ] {
            let problem = without(&[path], &[]).unwrap_err().render(false);
            assert!(problem.contains(words) && problem.contains("[override:1:"), "{path}: {problem}");
        }
        // A removed value is reported as if it had never existed.
        let problem = without(&["point_masses.\"my ball\".mass"], &[]).unwrap_err().render(false);
        assert!(problem.contains("mass"), "{problem}");
    }

    #[test]
    fn overrides_inside_parts_are_reported() {
        let text = format!("{TEXT}[parts.leg.point_masses.foot]\nmass = 1\n");
        let read = |value: &str| {
            let changes = set(&[("leg.foot.mass", value), ("analysis.end", "2")]);
            ModelText::read(&text, "a.toml", &changes).unwrap().overrides_inside_parts()
        };
        assert_eq!(read("3"), ["leg.foot.mass = 3"]);
        assert_ne!(read("3"), read("4"));
    }

    #[test]
    fn a_text_written_anew_means_the_same() {
        let registry = Registry::default();
        let changed =
            set(&[("point_masses.\"my ball\".mass", "0.1"), ("analysis.scheme", "generalized-alpha")]);
        let text = ModelText::read(TEXT, "a.toml", &changed[..1]).unwrap();
        let again = text.to_toml();
        assert!(again.contains("mass = 0.1\n") && again.contains("step = 1e-300\n"), "{again}");
        assert!(again.find("length").unwrap() < again.find("area").unwrap(), "order matters: {again}");
        let first = text.document(&registry, &[]).unwrap();
        let second = Document::parse(&again, "a.toml", &registry).unwrap();
        assert_eq!(
            first.point_masses[0].velocity.unwrap().value,
            second.point_masses[0].velocity.unwrap().value
        );
        assert_eq!(first.parameters, second.parameters);
        assert_eq!(first.title, second.title);
        assert_eq!(ModelText::read(&again, "a.toml", &[]).unwrap().to_toml(), again);
    }
}
