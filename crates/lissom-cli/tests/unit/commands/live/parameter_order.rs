//! Tests of `commands::live::parameter_order`, a module of it.

use super::*;

#[test]
fn parameters_have_the_order_and_the_comments_of_the_file() {
    let text = "title = \"a = b\"\n[parameters]\n# Speed of the vehicle, m/s\nspeed = 12\n\nb = \"a # b\"  # [kg]\na = 2\n# of none\n\n\
                    c = 3\n[bodies.d]\nmass = 1 # x\n";
    let found = parameters_of(text);
    let expected = [("speed", "Speed of the vehicle, m/s"), ("b", "[kg]"), ("a", ""), ("c", "")];
    assert_eq!(found, expected.map(|(name, comment)| (name.to_owned(), comment.to_owned())));
}
