//! Fields of shells and solids on the page: those of pictures and exports, from the same elements.

use std::fs;

use lissom::ResultFolder;
use lissom::motion::{NodeId, RecordedRun};
use lissom::pictures::geometry::{ShellElements, SolidElements, at_rest};

use super::view::{Packed, results};
use crate::support::{Folder, lissom};

/// A sheet that swings on an arm of 10 m, which it follows without stress except for its weight, and a block of rubber that is pushed.
const MODEL: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[materials.steel]
E = 2e11
nu = 0.3
density = 7850
[materials.rubber]
E = 1e6
nu = 0.45
density = 1000
[shells.sheet]
corners = [[0, 0, 0], [0.6, 0, 0], [0.6, 0.3, 0], [0, 0.3, 0]]
divisions = [6, 3]
thickness = 0.004
material = "steel"
[solids.block]
volume = ["0.1*u + 2", "0.1*v", "0.1*w"]
divisions = [3, 3, 3]
material = "rubber"
[joints.root]
kind = "clamp"
base = "ground"
tip = "sheet.west"
[joints.foot]
kind = "clamp"
base = "ground"
tip = "block.bottom"
[loads.push]
kind = "force"
on = "block.top"
vector = [30, 0, 0]
scale = "sin(20*t)"
[analysis]
kind = "dynamics"
end = 0.2
step = 5e-3
"#;

/// The numbers of a part by frames, in the order of the page.
type Numbers = Vec<Vec<f64>>;

fn of_elements(run: &RecordedRun) -> [Numbers; 2] {
    let frames = 0..run.motion.times().len();
    let shell = ShellElements::new(&run.scene.shells[0]);
    let solid = &run.scene.elastic_solids[0];
    let elements = SolidElements::new(solid);
    let mut surface: Vec<usize> = solid.elements.iter().flatten().copied().collect();
    surface.sort_unstable();
    surface.dedup();
    assert!(surface.len() < solid.nodes.len(), "some nodes are within");
    let at = |frame| {
        let nodes = NodeId::first(run.motion.reference().len());
        at_rest(&nodes.map(|node| run.motion.pose(frame, node)).collect::<Vec<_>>())
    };
    let sheet = |frame| {
        let at = at(frame);
        let numbers = |element| {
            let energy: f64 = shell.energy(element, &at, (0.0, 0.0));
            shell.resultants(element, &at, (0.0, 0.0)).into_iter().chain([energy.sqrt()])
        };
        (0..shell.count()).flat_map(numbers).collect()
    };
    let block = |frame| {
        let at = at(frame);
        let all = elements.numbers(&at);
        surface.iter().flat_map(|&node| [all[node][0], all[node][1].max(0.0).sqrt()]).collect()
    };
    [frames.clone().map(sheet).collect(), frames.map(block).collect()]
}

#[test]
fn fields_of_a_page_are_those_of_its_elements() {
    let folder = Folder::new("page-fields");
    folder.write("both.toml", MODEL);
    let view = lissom(&["view", "both.toml", "--out", "out", "-q"], folder.path());
    assert_eq!(view.code, 0, "{}", view.errors);
    let page = results(&fs::read_to_string(folder.path().join("out/view.html")).unwrap());
    let run = ResultFolder::recorded(&folder.path().join("out")).unwrap();
    for name in ["stiffness", "axes", "cells"] {
        let parts = [&page["scene"]["shells"][0], &page["scene"]["elastic_solids"][0]];
        assert!(parts.iter().all(|part| part[name].is_null()), "{name}");
    }
    let (frames, nodes) = (run.motion.times().len(), run.motion.reference().len());
    let mut packed = Packed::of(&page);
    for _ in 0..frames + 7 * nodes {
        packed.double();
    }
    for _ in 0..6 * nodes {
        packed.channel(frames);
    }
    assert_eq!(page["motion"]["field_stride"], 1);
    let [sheet, block] = of_elements(&run);
    for (part, (wanted, each, constants)) in [(sheet, 9, 4), (block, 2, 0)].into_iter().enumerate() {
        for _ in 0..wanted[0].len() / each * constants {
            packed.double();
        }
        for number in 0..wanted[0].len() {
            let (found, quantum) = packed.channel(frames);
            let most = wanted.iter().map(|frame| frame[number].abs()).fold(0.0, f64::max);
            let largest = wanted.iter().flat_map(|frame| frame.iter().skip(number % each).step_by(each));
            let largest = largest.fold(0.0_f64, |most, value| most.max(value.abs()));
            // Transverse shear is seen least: it is the small difference of large rotations.
            assert!(quantum <= most / 1000.0 + largest / 50.0, "{part} {number}: {quantum} of {most}");
            for (found, wanted) in found.iter().zip(&wanted) {
                let away = (found - wanted[number]).abs();
                assert!(
                    away <= 0.51 * quantum + 1e-6 * most,
                    "{part} {number}: {found} for {}",
                    wanted[number]
                );
            }
        }
    }
    assert!(packed.is_read());
    // Of a long motion every second frame has fields, and the last one.
    let file = folder.path().join("out/motion.bin");
    let bytes = fs::read(&file).unwrap();
    let start = bytes.len() - frames * run.motion.header().frame_bytes;
    let frames = 14 * frames;
    fs::write(&file, [&bytes[..start], &bytes[start..].repeat(14)].concat()).unwrap();
    assert_eq!(lissom(&["view", "out", "-q"], folder.path()).code, 0);
    let page = results(&fs::read_to_string(folder.path().join("out/view.html")).unwrap());
    assert_eq!((&page["motion"]["frames"], &page["motion"]["field_stride"]), (&frames.into(), &2.into()));
    let mut packed = Packed::of(&page);
    for _ in 0..frames + 7 * nodes {
        packed.double();
    }
    for _ in 0..6 * nodes {
        packed.channel(frames);
    }
    for (count, constants) in [(18 * 9, 18 * 4), (2 * of_elements(&run)[1][0].len() / 2, 0)] {
        for _ in 0..constants {
            packed.double();
        }
        for _ in 0..count {
            packed.channel(frames / 2 + 1);
        }
    }
    assert!(packed.is_read());
}
