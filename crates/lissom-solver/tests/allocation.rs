//! Factorisations and solves of the solvers without pivoting do not allocate.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use lissom_solver::kind;

mod samples;

use samples::{chain, grid, right_hand_side};

thread_local! {
    /// Of this thread alone: the thread that runs the tests allocates when it likes.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

#[expect(unsafe_code, reason = "an allocator cannot be written without")]
// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller keeps the contract of the same method.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of the same method.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn factoring_and_solving_allocate_nothing() {
    assert_eq!(allocations(|| drop(vec![1])), 1, "the counter counts");
    for model in [chain(300), grid(600)] {
        let structure = model.structure();
        let values = model.values::<f64>(&structure.pattern, 1, 1.0);
        let refused = model.values::<f64>(&structure.pattern, 1, 0.0);
        let mut solver = (kind("sparse").unwrap().real)(&structure);
        let mut x = right_hand_side::<f64>(model.size, 2);
        let count = allocations(|| {
            for _ in 0..3 {
                let _ = solver.factor(&refused);
                solver.factor(&values).unwrap();
                solver.solve(&mut x);
                solver.solve_transposed(&mut x);
            }
        });
        assert_eq!(count, 0);
    }
}
