//! Tests of `interrupt`, a module of it.

use super::*;

#[test]
fn only_work_within_is_asked() {
    let asked = Arc::new(AtomicBool::new(true));
    assert_eq!(check(), Ok(()));
    within(Arc::clone(&asked), || {
        assert_eq!(check(), Err(Interrupted));
        within(Arc::new(AtomicBool::new(false)), || assert_eq!(check(), Ok(())));
        assert!(is_asked());
        std::thread::scope(|scope| scope.spawn(|| assert!(!is_asked())).join()).unwrap();
    });
    assert_eq!(check(), Ok(()));
    let _ =
        std::panic::catch_unwind(|| within(Arc::clone(&asked), || std::panic::resume_unwind(Box::new(()))));
    assert_eq!(check(), Ok(()));
}
