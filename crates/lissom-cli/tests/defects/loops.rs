//! Loops that a slider along a beam closes are loops like those of joints.

use crate::support::sessions::session;

const SLIDER: &str = include_str!("slider-loop.toml");
const JOINT: &str = include_str!("point-on-line-loop.toml");

/// Codes of the warnings of a run, and the columns whose values are not unique.
fn reported(text: &str) -> (Vec<String>, Option<String>) {
    let mut session = session(text);
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    let mut codes: Vec<String> = session.warnings().map(|warning| warning.code().to_owned()).collect();
    // Round-off decides whether the motion continues beyond a singular position.
    if let Some(error) = report.error() {
        assert!(error.to_string().contains("singular position"), "{error}");
        codes.push("singular-position".to_owned());
    }
    codes.sort();
    let mut words = session.warnings().map(ToString::to_string);
    let columns = words.find_map(|words| Some(words.split_once(" are not unique")?.0.to_owned()));
    (codes, columns)
}

/// A driven slider crank with equal links, guided by a line or by a beam clamped at both ends.
#[test]
fn guides_along_lines_and_beams_give_the_same_warnings() {
    let [by_beam, by_joint] = [SLIDER, JOINT].map(reported);
    assert!(by_joint.0.contains(&"singular-position".to_owned()), "{by_joint:?}");
    assert_eq!(by_beam, by_joint);
}

/// A point mass that only a slider holds closes no loop, nor does a slider on a beam that nothing else holds.
#[test]
fn sliders_at_the_end_of_a_tree_close_no_loop() {
    let hanging = SLIDER
        .replace("[joints.b]\nkind = \"spherical\"\nbase = \"rod\"\ntip = \"block\"\nat = [1.6,0,0]\n", "");
    assert_ne!(hanging, SLIDER);
    assert_eq!(reported(&hanging).0, Vec::<String>::new());
    let free = SLIDER
        .replace("[joints.c1]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"rail.start\"\n", "")
        .replace("[joints.c2]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"rail.end\"\n", "");
    assert_ne!(free, SLIDER);
    let (codes, columns) = reported(&free);
    assert!(
        !codes.iter().any(|code| code == "singular-position") && columns.is_none(),
        "{codes:?} {columns:?}"
    );
}
