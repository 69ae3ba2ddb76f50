//! Schemes in lists on the command line: the name in the model file, with the parameter in parentheses.

use lissom_core::schemes::{self, Scheme};

use super::StudyError;

/// The scheme of a text such as `radau-iia` or `hht(-0.3)`. The parameter is optional.
///
/// # Errors
/// If there is no such scheme, or it has no such parameter.
pub(super) fn scheme_of(text: &str) -> Result<Scheme, StudyError> {
    let wrong = |reason: String| StudyError::SchemeWord { word: text.to_owned(), reason };
    let (word, parameter) = match text.trim().split_once('(') {
        None => (text.trim(), None),
        Some((word, rest)) => {
            let number = rest.trim_end().strip_suffix(')').and_then(|inside| inside.trim().parse().ok());
            let number: f64 = number
                .ok_or_else(|| wrong("its parameter must be a number, as in `hht(-0.3)`".to_owned()))?;
            (word.trim_end(), Some(number))
        }
    };
    let Some(kind) = schemes::kind(word) else {
        let known: Vec<_> = schemes::KINDS.iter().map(|kind| kind.name).collect();
        return Err(wrong(format!("schemes are {}", known.join(", "))));
    };
    if parameter.is_some() && kind.parameters.is_empty() {
        return Err(wrong("it takes no parameter".to_owned()));
    }
    kind.scheme(parameter).map_err(|error| wrong(error.to_string()))
}

#[cfg(test)]
#[path = "../../../tests/unit/analyses/study/scheme_words.rs"]
mod tests;
