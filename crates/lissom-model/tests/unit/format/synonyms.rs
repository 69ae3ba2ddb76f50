use super::*;
use crate::format::suggest;

#[test]
fn words_of_others_lead_to_those_of_the_model_file() {
    let joints = ["clamp", "prismatic", "revolute", "slider"];
    assert_eq!(known_for("Hinge", &joints), Some("revolute"));
    assert_eq!(known_for("linear", &joints), Some("prismatic"));
    assert_eq!(known_for("linear", &["axial", "torsional"]), Some("axial"));
    assert_eq!(known_for("hinge", &["axial"]), None);
    let loads = ["force", "moment", "joint_torque", "joint_force"];
    assert_eq!(suggest::help("joint_moment", loads).as_deref(), Some("did you mean `joint_torque`?"));
    assert!(suggest::help("gravity", loads).unwrap().contains("`gravity = [0, 0, -9.81]`"));
    assert_eq!(known_for("joint_force", &["position", "reaction"]), Some("reaction"));
    assert_eq!(known_for("rod", &["clamp", "distance"]), Some("distance"));
    assert_eq!(
        suggest::help("diameter", ["radius"]).as_deref(),
        Some("write `radius`, half of the diameter")
    );
    assert_eq!(suggest::help("fixed", joints).as_deref(), Some("did you mean `clamp`?"));
}

#[test]
fn every_word_is_one_of_the_model_file() {
    let reference = include_str!("../../../../../docs/reference.md");
    for (own, others) in OTHERS {
        let is_there = |word: String| reference.contains(&word);
        let as_written = [format!("`{own}`"), format!("[{own}"), format!("= \"{own}\"")];
        assert!(as_written.into_iter().any(is_there), "{own}");
        assert!(others.iter().all(|other| *other == other.to_lowercase() && other != own), "{own}");
    }
}
