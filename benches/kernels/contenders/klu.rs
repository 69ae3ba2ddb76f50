//! KLU of SuiteSparse (`libsuitesparse-dev`) through its C interface, with its own ordering and defaults: pivots are
//! chosen in the first factorisation and kept in the following ones.

#![expect(unsafe_code, reason = "a C library is called, for comparison only")]
#![expect(clippy::cast_possible_wrap, reason = "sizes and indices are far below 2^63")]

use std::ffi::c_void;

use lissom_solver::Pattern;

use super::Contender;

/// At least as large as `klu_l_common`; KLU fills it in.
#[repr(C, align(16))]
struct Common([u8; 1024]);

#[link(name = "klu")]
unsafe extern "C" {
    fn klu_l_defaults(common: *mut Common) -> i64;
    fn klu_l_analyze(size: i64, starts: *const i64, rows: *const i64, common: *mut Common) -> *mut c_void;
    fn klu_l_factor(
        starts: *const i64,
        rows: *const i64,
        values: *const f64,
        symbolic: *mut c_void,
        common: *mut Common,
    ) -> *mut c_void;
    fn klu_l_refactor(
        starts: *const i64,
        rows: *const i64,
        values: *const f64,
        symbolic: *mut c_void,
        numeric: *mut c_void,
        common: *mut Common,
    ) -> i64;
    fn klu_l_solve(
        symbolic: *mut c_void,
        numeric: *mut c_void,
        leading: i64,
        count: i64,
        vector: *mut f64,
        common: *mut Common,
    ) -> i64;
    fn klu_l_free_symbolic(symbolic: *mut *mut c_void, common: *mut Common) -> i64;
    fn klu_l_free_numeric(numeric: *mut *mut c_void, common: *mut Common) -> i64;
}

/// Symbolic and numeric objects of KLU.
pub(crate) struct Klu {
    starts: Vec<i64>,
    rows: Vec<i64>,
    common: Box<Common>,
    symbolic: *mut c_void,
    numeric: *mut c_void,
}

impl Klu {
    /// Symbolic analysis and a first factorisation, which chooses the pivots.
    pub(crate) fn new(pattern: &Pattern, values: &[f64]) -> Self {
        let whole = |numbers: &[usize]| numbers.iter().map(|&number| number as i64).collect::<Vec<_>>();
        let (starts, rows) = (whole(pattern.column_starts()), whole(pattern.row_indices()));
        let mut common = Box::new(Common([0; 1024]));
        // SAFETY: the arrays describe a square matrix by columns, as KLU expects, and outlive both objects.
        let (symbolic, numeric) = unsafe {
            klu_l_defaults(&raw mut *common);
            let symbolic =
                klu_l_analyze(pattern.size() as i64, starts.as_ptr(), rows.as_ptr(), &raw mut *common);
            assert!(!symbolic.is_null(), "KLU has analysed the pattern");
            let numeric =
                klu_l_factor(starts.as_ptr(), rows.as_ptr(), values.as_ptr(), symbolic, &raw mut *common);
            (symbolic, numeric)
        };
        assert!(!numeric.is_null(), "KLU has factored the matrix");
        Self { starts, rows, common, symbolic, numeric }
    }
}

impl Contender for Klu {
    fn factor(&mut self, values: &[f64]) {
        assert_eq!(values.len(), self.rows.len());
        // SAFETY: pattern and objects are those of `new`, and there is a value for each entry.
        let done = unsafe {
            klu_l_refactor(
                self.starts.as_ptr(),
                self.rows.as_ptr(),
                values.as_ptr(),
                self.symbolic,
                self.numeric,
                &raw mut *self.common,
            )
        };
        assert_eq!(done, 1, "KLU has refactored the matrix");
    }
    fn solve(&mut self, vector: &mut [f64]) {
        let size = self.starts.len() - 1;
        assert_eq!(vector.len(), size);
        // SAFETY: the vector has as many numbers as the matrix has rows.
        let done = unsafe {
            klu_l_solve(
                self.symbolic,
                self.numeric,
                size as i64,
                1,
                vector.as_mut_ptr(),
                &raw mut *self.common,
            )
        };
        assert_eq!(done, 1, "KLU has solved");
    }
}

impl Drop for Klu {
    fn drop(&mut self) {
        // SAFETY: both objects were made by KLU with this `common` and are freed once.
        unsafe {
            klu_l_free_numeric(&raw mut self.numeric, &raw mut *self.common);
            klu_l_free_symbolic(&raw mut self.symbolic, &raw mut *self.common);
        }
    }
}
