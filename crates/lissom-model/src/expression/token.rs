//! Splits the text of an expression into numbers, names and signs.

use std::ops::Range;

use super::error::ExpressionError;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(f64),
    Name(&'t str),
    Sign(char),
    End,
}

/// A token and its bytes.
pub(super) type Placed<'t> = (Token<'t>, Range<usize>);

pub(super) fn tokens(text: &str) -> Result<Vec<Placed<'_>>, ExpressionError> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(next) = text[at..].chars().next() {
        let end = match next {
            _ if next.is_whitespace() => {
                at += next.len_utf8();
                continue;
            }
            '0'..='9' | '.' => at + number_length(&text[at..]),
            _ if next.is_ascii_alphabetic() || next == '_' => at + name_length(&text[at..]),
            '<' | '>' if text[at + 1..].starts_with('=') => at + 2,
            _ => at + next.len_utf8(),
        };
        let word = &text[at..end];
        let token = match next {
            '0'..='9' | '.' => Token::Number(number(word, at..end)?),
            // With an equals sign: not less, not greater.
            '<' if word.len() == 2 => Token::Sign('≤'),
            '>' if word.len() == 2 => Token::Sign('≥'),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' | '<' | '>' => Token::Sign(next),
            _ if next.is_ascii_alphabetic() || next == '_' => Token::Name(word),
            _ => {
                let message = format!("`{next}` has no meaning in an expression");
                let help = Some("signs are + - * / ^ ( ) < > <= >= and the comma".to_owned());
                return Err(ExpressionError { message, help, range: at..end });
            }
        };
        found.push((token, at..end));
        at = end;
    }
    found.push((Token::End, text.len()..text.len()));
    Ok(found)
}

/// Letters, digits and `_`; a point followed by a letter belongs to the name, as in `tip.u1`.
fn name_length(text: &str) -> usize {
    let word = |from: usize| {
        let rest = &text[from..];
        from + rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len())
    };
    let mut end = word(0);
    while text[end..].starts_with('.') && text[end + 1..].starts_with(|c: char| c.is_ascii_alphabetic()) {
        end = word(end + 1);
    }
    end
}

/// Digits, one point, digits, and an exponent with its sign.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        end += 1;
        if matches!(bytes.get(end), Some(b'+' | b'-')) {
            end += 1;
        }
        end = digits(end);
    }
    end
}

fn number(word: &str, range: Range<usize>) -> Result<f64, ExpressionError> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => {
            Err(ExpressionError { message: format!("the number {word} is too large"), help: None, range })
        }
        Err(_) => Err(ExpressionError { message: format!("`{word}` is not a number"), help: None, range }),
    }
}
