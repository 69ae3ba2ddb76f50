//! What is said about wrong shells.

use super::CANTILEVER;
use crate::support::refused::refused;

#[test]
fn messages_name_what_is_wrong_and_the_remedy() {
    let cases = [
        ("tip = \"plate.west\"", "tip = \"plate.left\"", "has no set of nodes called `left`"),
        ("tip = \"plate.west\"", "tip = \"plate\"", "is a surface, not a node"),
        ("tip = \"plate.west\"", "tip = \"plate@2,0\"", "no position on the shell"),
        ("of = \"plate@1,0\"", "of = \"plate@0.47,0\"", "has no node at 0.47,0"),
        ("of = \"plate@1,0\"", "of = \"plate.east\"", "names 2 nodes, and one is needed"),
        ("divisions = [16, 1]", "divisions = [16, 0]", "must be whole numbers from 1"),
        ("thickness = 0.1", "thickness = \"0.1 - v\"", "the thickness of shell `plate` is"),
        ("thickness = 0.1", "thickness = \"0.1*w\"", "cannot name `w`"),
        ("thickness = 0.1\n", "", "lacks `thickness`"),
        ("material = \"soft\"\n[joints", "[joints", "lacks `material`"),
        ("[10, 1, 0], [0, 1, 0]]", "[10, 1, 0]]", "must be four positions"),
        ("[10, 1, 0], [0, 1, 0]]", "[0, 1, 0], [10, 1, 0]]", "not convex"),
        ("corners = ", "mesh = \"none.msh\"\ncorners = ", "has several surfaces"),
        ("kind = \"displacement\"", "kind = \"section_force\"", "not on a beam"),
        (
            "material = \"soft\"\n[joints",
            "material = \"soft\"\ndirection = [0, 0, 2]\n[joints",
            "is normal to its element 1",
        ),
        ("corners = ", "scale = 1e-3\ncorners = ", "used with a `mesh` only"),
        (
            "[outputs.tip]",
            "[signals]\ngiven = \"push.power\"\n[outputs.push]\nkind = \"power\"\nof = \"end\"\n[outputs.tip]",
            "spread over a set of nodes",
        ),
        (
            "kind = \"force\"\non = \"plate.east\"\nvector = [0, 0, 4]",
            "kind = \"torque\"\njoint = \"root\"\nscale = 1",
            "root",
        ),
    ];
    for (from, to, wanted) in cases {
        assert!(CANTILEVER.contains(from), "{from}");
        let report = refused(&CANTILEVER.replace(from, to));
        let flat = report.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(wanted), "{to}:\n{report}");
    }
}
