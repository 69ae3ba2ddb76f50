//! Texts that are damaged word by word, for tests of whatever reads them.

/// What stands in for a word. A seed of `cargo xtask fuzz` means the same texts only as long as these do not change.
pub(crate) const STRANGERS: [&str; 40] = [
    "nan",
    "-inf",
    "1e400",
    "-0",
    "0",
    "-1",
    "1e-320",
    "1e308",
    "9223372036854775808",
    "\"\"",
    "\"t\"",
    "\"s^\"",
    "\"1/t\"",
    "\"sqrt(-t)\"",
    "\"step(t - 0.5)\"",
    "\"((((\"",
    "true",
    "[]",
    "{}",
    "[[]]",
    "[0, 0]",
    "[0, 0, 1e300]",
    "\"ground\"",
    "\"beam@0.5\"",
    "\"beam@nan\"",
    "ground",
    "start",
    "parameters",
    "\n",
    "=",
    "\"",
    "'''",
    "]",
    "[",
    "#",
    ".",
    "0x10",
    "1979-05-27",
    "\u{0}",
    "é",
];

/// Words, numbers, signs, blanks and line ends.
pub(crate) fn tokens(text: &str) -> Vec<String> {
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '-' | '+');
    let mut tokens: Vec<String> = Vec::new();
    let mut was_word = false;
    for c in text.chars() {
        match tokens.last_mut() {
            Some(token) if was_word && is_word(c) => token.push(c),
            _ => tokens.push(c.to_string()),
        }
        was_word = is_word(c);
    }
    tokens
}

/// What is done to a token.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Damage<'a> {
    /// It is omitted.
    Remove,
    /// It is there twice.
    Double,
    /// It changes places with this one.
    Swap(usize),
    /// This is in its place.
    Replace(&'a str),
}

impl Damage<'_> {
    /// Damages the token at `place`.
    pub(crate) fn apply(self, tokens: &mut Vec<String>, place: usize) {
        match self {
            Self::Remove => drop(tokens.remove(place)),
            Self::Double => tokens.insert(place, tokens[place].clone()),
            Self::Swap(other) => tokens.swap(place, other),
            Self::Replace(stranger) => stranger.clone_into(&mut tokens[place]),
        }
    }
}
