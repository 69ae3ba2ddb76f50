//! Functions of time by expressions, whose last values are remembered. A step evaluates a drive at few instants, its start, its
//! stages and its end, but many times at each: in every iteration, for velocities and accelerations, and in checks.

use std::cell::RefCell;
use std::sync::atomic::{AtomicU64, Ordering};

use lissom_mechanics::law::Interval;
use lissom_mechanics::registry::TimeFunction;

use crate::expression::Expression;

/// Number of values that each thread remembers: a power of two.
const SLOTS: usize = 256;

/// An expression of time.
#[derive(Debug)]
pub(crate) struct Remembered {
    expression: Expression,
    /// Different for all functions of the process, and not 0.
    id: u64,
}

/// A value with its derivatives.
#[derive(Clone, Copy)]
struct Entry {
    /// The function; 0 for none.
    id: u64,
    /// Bits of the time.
    time: u64,
    jet: [f64; 3],
}

thread_local! {
    static ENTRIES: RefCell<[Entry; SLOTS]> =
        const { RefCell::new([Entry { id: 0, time: 0, jet: [0.0; 3] }; SLOTS]) };
}

impl Remembered {
    pub(crate) fn new(expression: Expression) -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        Self { expression, id: NEXT.fetch_add(1, Ordering::Relaxed) }
    }

    /// Where the value at this time is remembered, by Fibonacci hashing [Knuth 1998].
    fn slot(&self, time: u64) -> usize {
        const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
        ((time ^ self.id.rotate_right(16)).wrapping_mul(GOLDEN) >> (u64::BITS - SLOTS.ilog2())) as usize
    }

    /// The remembered jet at a time.
    fn known(&self, time: f64) -> Option<[f64; 3]> {
        let time = time.to_bits();
        let entry = ENTRIES.with_borrow(|entries| entries[self.slot(time)]);
        (entry.id == self.id && entry.time == time).then_some(entry.jet)
    }
}

impl TimeFunction for Remembered {
    fn value(&self, time: f64) -> f64 {
        self.known(time).map_or_else(|| self.expression.value(time), |[value, ..]| value)
    }
    fn first_derivative(&self, time: f64) -> f64 {
        self.jet(time)[1]
    }
    fn second_derivative(&self, time: f64) -> f64 {
        self.jet(time)[2]
    }
    fn jet(&self, time: f64) -> [f64; 3] {
        self.known(time).unwrap_or_else(|| {
            let jet = TimeFunction::jet(&self.expression, time);
            let entry = Entry { id: self.id, time: time.to_bits(), jet };
            ENTRIES.with_borrow_mut(|entries| entries[self.slot(entry.time)] = entry);
            jet
        })
    }
    fn breakpoints(&self) -> Vec<f64> {
        self.expression.breakpoints()
    }
    fn first_kink(&self) -> Option<f64> {
        self.expression.first_kink()
    }
    fn bounds(&self, from: f64, to: f64) -> Option<Interval> {
        TimeFunction::bounds(&self.expression, from, to)
    }
    fn curvature(&self, from: f64, to: f64) -> Option<Interval> {
        self.expression.curvature(from, to)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/functions/remembered.rs"]
mod tests;
