//! Expressions that are made or damaged by chance, for tests of whatever reads them.

use super::damage::Damage;

/// Words, names, numbers and signs that damaged expressions are made of, beside their own.
const EXPRESSION_WORDS: [&str; 76] = [
    "sin(",
    "cos(",
    "tan(",
    "asin(",
    "acos(",
    "atan(",
    "atan2(",
    "sinh(",
    "cosh(",
    "tanh(",
    "asinh(",
    "acosh(",
    "atanh(",
    "exp(",
    "ln(",
    "log10(",
    "sqrt(",
    "cbrt(",
    "abs(",
    "sign(",
    "step(",
    "smoothstep(",
    "min(",
    "max(",
    "clamp(",
    "if(",
    "mod(",
    "floor(",
    "ceil(",
    "round(",
    "hypot(",
    "foo(",
    "sin",
    "(",
    ")",
    ")",
    ")",
    ",",
    ",",
    "+",
    "-",
    "*",
    "/",
    "^",
    "<",
    ">",
    "<=",
    ">=",
    "=",
    "**",
    "0",
    "1",
    "2",
    "0.5",
    ".5",
    "1.",
    "-1",
    "1e308",
    "1e400",
    "1e-320",
    "1e",
    "3.5.2",
    "t",
    "t",
    "t",
    "s",
    "T",
    "pi",
    "x",
    "arm.rate",
    "tip.u1",
    "a.",
    " ",
    "\n",
    "é",
    "\u{0}",
];

/// Words, blanks and signs of an expression.
pub(crate) fn expression_words(text: &str) -> Vec<String> {
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
    let mut words: Vec<String> = Vec::new();
    let mut was_word = false;
    for c in text.chars() {
        match words.last_mut() {
            Some(word) if was_word && is_word(c) => word.push(c),
            _ => words.push(c.to_string()),
        }
        was_word = is_word(c);
    }
    words
}

/// An expression of words by chance, or one of those `known` in which some are damaged. `below` draws a number below another.
pub(crate) fn damaged_expression(known: &[Vec<String>], below: &mut dyn FnMut(usize) -> usize) -> String {
    if known.is_empty() || below(4) == 0 {
        let count = 1 + below(24);
        return (0..count).map(|_| EXPRESSION_WORDS[below(EXPRESSION_WORDS.len())]).collect();
    }
    let mut words = known[below(known.len())].clone();
    for _ in 0..=below(4) {
        if words.is_empty() {
            break;
        }
        let place = below(words.len());
        match below(7) {
            0 => Damage::Remove.apply(&mut words, place),
            1 => Damage::Double.apply(&mut words, place),
            2 => Damage::Swap(below(words.len())).apply(&mut words, place),
            3 => {
                let other = &known[below(known.len())];
                if !other.is_empty() {
                    Damage::Replace(&other[below(other.len())]).apply(&mut words, place);
                }
            }
            // Too deep, or too long, now and then.
            4 if below(16) == 0 => words[place] = words[place].repeat(below(300)),
            4 | 5 => words.insert(place, EXPRESSION_WORDS[below(EXPRESSION_WORDS.len())].to_owned()),
            _ => Damage::Replace(EXPRESSION_WORDS[below(EXPRESSION_WORDS.len())]).apply(&mut words, place),
        }
    }
    words.concat()
}
