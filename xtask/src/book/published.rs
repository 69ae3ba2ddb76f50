//! Tables 2.1 and 2.2 of [Epple 2008], as printed: condition numbers of the iteration matrix of the pendulum at
//! convergence of the last step.

/// One row: what is varied, then the condition numbers without scaling, with s = 1 and with s of eq. (2.6).
pub(super) type Row = (&'static str, [&'static str; 3]);

/// Table 2.1: step sizes [s], for m = 1 kg by the text.
pub(super) const STEPS: [Row; 9] = [
    ("1e-1", ["4e4", "10", "12"]),
    ("5e-2", ["6e5", "8.9", "13"]),
    ("1e-2", ["3e8", "9.2", "14"]),
    ("5e-3", ["5e9", "9.2", "14"]),
    ("1e-3", ["3e12", "9.2", "14"]),
    ("5e-4", ["5e13", "9.2", "14"]),
    ("1e-4", ["3e16", "9.2", "14"]),
    ("5e-5", ["5e17", "9.2", "14"]),
    ("1e-5", ["3e20", "9.2", "14"]),
];

/// Table 2.2: masses [kg], for h = 0.01 s.
pub(super) const MASSES: [Row; 7] = [
    ("1e-2", ["3e6", "2e1", "13"]),
    ("1e-1", ["3e8", "9e0", "14"]),
    ("1e0", ["3e10", "4e2", "14"]),
    ("1e1", ["3e12", "3e4", "14"]),
    ("1e2", ["3e14", "3e6", "14"]),
    ("1e3", ["3e16", "3e8", "14"]),
    ("1e4", ["3e18", "3e10", "14"]),
];
