//! Messages without the lines of their frames.

use super::refused::refused;

/// Why a model is rejected, on one line.
pub(crate) fn refused_on_one_line(text: &str) -> String {
    refused(text).split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}
