//! Tests of `results::checkpoint`, a module of it.

use super::*;

#[test]
fn times_and_steps_are_distinguished() {
    let read = |text: &str| text.parse::<CheckpointEvery>();
    assert_eq!(read("10s"), Ok(CheckpointEvery::Time(Duration::from_secs(10))));
    assert_eq!(read("1000steps"), Ok(CheckpointEvery::Steps(1000)));
    for wrong in ["", "10", "0s", "-1s", "0steps", "s", "steps", "1e99s"] {
        assert!(read(wrong).is_err(), "{wrong}");
    }
}
