//! Tests of `commands::completions`, a module of it.

use super::*;

#[test]
fn every_page_with_exit_codes_has_a_section_of_them() {
    let mut line = Line::command();
    line.build();
    let commands = line.get_subcommands().cloned().chain([line.clone()]);
    for command in commands {
        let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        let mut page = Vec::new();
        clap_mangen::Man::new(command.clone()).render(&mut page).unwrap();
        let page = with_sections(&String::from_utf8_lossy(&page));
        assert!(!page.contains("EXTRA") && !page.contains("Exit code: "), "{}", command.get_name());
        let is_listed =
            page.contains(".SH \"EXIT STATUS\"\n.TP\n\\fB0\\fR\nsuccess\n.TP\n\\fB2\\fR\nwrong model");
        assert_eq!(is_listed, help.contains("Exit code: 0 success; 2 wrong model"), "{page}");
    }
}
