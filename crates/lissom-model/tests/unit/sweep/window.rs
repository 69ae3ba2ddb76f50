//! Tests of `sweep::window`, a module of it.

use super::*;
use crate::sweep::statistic::find;

fn resolve(text: &str) -> Result<TimeWindow, WindowError> {
    let parameters = BTreeMap::from([("omega".to_owned(), 4.0)]);
    let context = WindowContext { events: &["impact"], parameters: &parameters, start: 0.0, end: 1.0 };
    Window::parse(text)?.resolve(&context)
}

/// First, last and largest value of t (1 - t) at eleven records, with events at 0.25 s and 0.75 s.
fn statistics(text: &str) -> Result<[f64; 3], WindowError> {
    let mut history = WindowedHistory::new(resolve(text)?, None);
    for time in (0..=10).map(|index| f64::from(index) / 10.0) {
        history.add(time, time * (1.0 - time));
    }
    let inside = history.close(&[("impact", 0.25), ("impact", 0.75)])?;
    Ok(["time_of_min", "final", "max"].map(|name| find(name).unwrap().of(&inside).unwrap()))
}

#[test]
fn windows_contain_the_records_between_their_limits() {
    for (text, [from, to, most]) in [
        ("", [0.0, 1.0, 0.5]),
        ("after=0.6", [1.0, 1.0, 0.6]),
        ("from = 0.6, until = '0.9'", [0.9, 0.9, 0.6]),
        ("last=0.3", [1.0, 1.0, 0.7]),
        ("last=1/omega", [1.0, 1.0, 0.8]),
        ("before=max(0.2, 1/omega)", [0.0, 0.2, 0.2]),
        ("after=impact, before=impact[2]", [0.3, 0.7, 0.5]),
        ("after=impact[-1]", [1.0, 1.0, 0.8]),
        ("after=impact[-2], before=0.4", [0.3, 0.4, 0.4]),
    ] {
        let value = |time: f64| time * (1.0 - time);
        let found = statistics(text).unwrap();
        let wanted = [from, value(to), value(most)];
        assert!(
            found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-12),
            "{text}: {found:?}"
        );
    }
}

#[test]
fn wrong_windows_are_rejected_with_a_remedy() {
    for (text, words) in [
        ("0.5", "no limit of a window"),
        ("aftr=0.5", "did you mean `after`"),
        ("after=", "has no value"),
        ("after=0.1, from=0.2", "two limits `after`"),
        ("after=0.6, before=0.2", "is empty"),
        ("after=omega, before=5", "begins at 4 s, but the analysis ends at 1 s"),
        ("before=1.1", "ends at 1.1 s"),
        ("before=-1", "is empty"),
        ("last=2", "are not a part"),
        ("last=0", "are not a part"),
        ("last=impact", "write `after=impact[-1]`"),
        ("after=impct", "did you mean `impact`"),
        ("after=latch", "the events are `impact`"),
        ("after=impact[x]", "`impact[1]` is the first"),
        ("after=impact[3]", "has happened 2 times"),
        ("after=0.51, before=0.59", "no records in the window"),
    ] {
        let error = statistics(text).unwrap_err();
        let all = format!("{}; {}", error.message, error.remedy);
        assert!(all.contains(words), "{text}: {all}");
    }
}
