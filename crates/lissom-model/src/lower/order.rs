//! Numbering of the entries of a model: by name, independent of the order of the file. Sums are then taken in the same order,
//! and a file with its tables in another order gives bitwise identical results.

use std::cmp::Ordering;
use std::iter::Peekable;
use std::str::Chars;

/// The entries by name.
pub(super) fn by_name<T>(entries: &[T], name: impl Fn(&T) -> &str) -> Vec<&T> {
    let mut sorted: Vec<&T> = entries.iter().collect();
    sorted.sort_by(|a, b| compare(name(a), name(b)));
    sorted
}

/// Compares names as people count: `leg2` before `leg10`, which keeps neighbours of a row together.
fn compare(a: &str, b: &str) -> Ordering {
    let (mut left, mut right) = (a.chars().peekable(), b.chars().peekable());
    loop {
        let order = match (left.peek(), right.peek()) {
            (Some(x), Some(y)) if x.is_ascii_digit() && y.is_ascii_digit() => {
                let (x, y) = (number(&mut left), number(&mut right));
                x.len().cmp(&y.len()).then_with(|| x.cmp(&y))
            }
            (Some(_), Some(_)) => left.next().cmp(&right.next()),
            // Numbers with zeros before them may differ in nothing else.
            (None, None) => return a.cmp(b),
            (x, y) => return x.cmp(&y),
        };
        if order != Ordering::Equal {
            return order;
        }
    }
}

/// The next digits, without leading zeros.
fn number(text: &mut Peekable<Chars<'_>>) -> String {
    let mut digits = String::new();
    while let Some(digit) = text.next_if(char::is_ascii_digit) {
        if !(digits.is_empty() && digit == '0') {
            digits.push(digit);
        }
    }
    digits
}

#[cfg(test)]
#[path = "../../tests/unit/lower/order.rs"]
mod tests;
