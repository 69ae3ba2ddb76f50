//! What is said about wrong solids.

use super::BLOCK;
use crate::support::refused::refused;

#[test]
fn messages_name_what_is_wrong_and_the_remedy() {
    let cases = [
        ("tip = \"block.west\"", "tip = \"block.left\"", "has no set of nodes called `left`"),
        ("tip = \"block.west\"", "tip = \"block\"", "is a volume, not a node"),
        ("of = \"block@1,1,1\"", "of = \"block@1,1\"", "no position on the solid"),
        ("of = \"block@1,1,1\"", "of = \"block@0.9,1,1\"", "has no node at 0.9,1,1"),
        ("of = \"block@1,1,1\"", "of = \"block.east\"", "names 8 nodes, and one is needed"),
        ("divisions = [2, 1, 1]", "divisions = [2, 0, 1]", "must be whole numbers from 1"),
        ("divisions = [2, 1, 1]\n", "", "lacks `divisions`"),
        ("size = [2, 1, 1]", "size = [2, -1, 1]", "three lengths greater than zero"),
        ("size = [2, 1, 1]", "volume = [\"v\", \"u\", \"w\"]", "is inverted or has no volume"),
        ("size = [2, 1, 1]", "volume = [\"u\", \"v\", \"q\"]", "cannot name `q`"),
        ("size = [2, 1, 1]", "size = [2, 1, 1]\ngroup = \"g\"", "not used with `size`"),
        ("size = ", "mesh = \"none.msh\"\nsize = ", "has several volumes"),
        ("size = [2, 1, 1]", "size = [2, 1, 1]\nscale = 1e-3", "not used with `size`"),
        ("divisions = [2, 1, 1]", "divisions = [500, 500, 500]", "more than 1000000"),
        ("nu = 0.3", "nu = 0.49", "model = \"neo-hookean\""),
        (
            "material = \"soft\"",
            "material = \"soft\"\npressure = { inside = 1 }",
            "no set of nodes called `inside`",
        ),
        (
            "material = \"soft\"",
            "material = \"soft\"\npressure = { e = 1 }\nsets = { e = { near = [0, 0, 0] } }",
            "contains no outer face",
        ),
        (
            "[loads.pull]",
            "[sections.s]\nshape = \"circle\"\nradius = 0.1\nmaterial = \"soft\"\n[beams.b]\nfrom = \"block@1,1,1\"\nto = [3, 1, 1]\nsection = \"s\"\nelements = 1\n[loads.pull]",
            "cannot share a node of the solid",
        ),
        (
            "kind = \"displacement\"\nof = \"block@1,1,1\"",
            "kind = \"shell_stress\"\nof = \"block@1,1,1\"",
            "is of a shell",
        ),
        (
            "kind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"block.west\"",
            "kind = \"revolute\"\nbase = \"ground\"\ntip = \"block.west\"",
            "no rotation",
        ),
    ];
    for (from, to, wanted) in cases {
        assert!(BLOCK.contains(from), "{from}");
        let report = refused(&BLOCK.replace(from, to));
        let flat = report.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(wanted), "{to}:\n{report}");
    }
}
