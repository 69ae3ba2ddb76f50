//! Subject of a message.

use std::borrow::Cow;
use std::fmt::{self, Display};

use serde::{Deserialize, Serialize};

/// Subject of a message: the kind and the name of an entry of the model, and the words for it in sentences.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subject {
    /// Kind of the entry: `node`, `joint`, `load`, `signal`; empty if it has none.
    pub kind: Cow<'static, str>,
    /// Name of the entry, as in the model file; empty if it has none.
    pub name: String,
    /// Words for sentences, such as "translation 1 of node `bar.2`".
    words: String,
}

impl Subject {
    /// An entry, in sentences "kind `name`".
    pub fn new(kind: impl Into<Cow<'static, str>>, name: impl Into<String>) -> Self {
        let (kind, name) = (kind.into(), name.into());
        let words = format!("{kind} `{name}`");
        Self { kind, name, words }
    }

    /// Something that is not an entry of the model, such as "the mode of the bifurcation".
    pub fn nameless(words: impl Into<String>) -> Self {
        Self { kind: Cow::Borrowed(""), name: String::new(), words: words.into() }
    }

    /// This entry with other words for sentences.
    #[must_use]
    pub fn called(self, words: impl Into<String>) -> Self {
        Self { words: words.into(), ..self }
    }

    /// A component of the entry, in sentences "component of kind `name`".
    #[must_use]
    pub fn component(self, component: &str) -> Self {
        let words = format!("{component} of {}", self.words);
        self.called(words)
    }

    /// Several subjects in one sentence, separated by commas; the first is the entry.
    pub fn list(subjects: Vec<Self>) -> Self {
        let words: Vec<String> = subjects.iter().map(Self::to_string).collect();
        subjects.into_iter().next().unwrap_or_else(|| Self::nameless("")).called(words.join(", "))
    }

    /// Name of the entry, if there is one.
    pub fn entry(&self) -> Option<&str> {
        Some(self.name.as_str()).filter(|name| !name.is_empty())
    }
}

impl Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

impl From<&Self> for Subject {
    fn from(subject: &Self) -> Self {
        subject.clone()
    }
}

#[cfg(test)]
#[path = "../../tests/unit/kinematics/subject.rs"]
mod tests;
