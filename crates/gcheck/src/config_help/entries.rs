//! Where a configuration has an entry for what a program names: a tool, a work offset, a code.
//!
//! Knows: the tables of entries, which of them rule over a program. Must not know: programs' texts.

use std::ops::Range;
use std::path::Path;

use gcheck_controls::{CodeNumber, Control};
use gcheck_server::Configured;

use super::outline::{Outline, Step};
use crate::config::{PathPattern, work_offset};

/// The keys of the entries for what a program names, those that win first.
pub(crate) fn entries(
    text: &str,
    folder: &Path,
    program: &Path,
    control: &Control,
    named: Configured,
) -> Vec<Range<usize>> {
    let outline = Outline::read(text);
    let key = |name: &str| Step::Key(name.to_owned());
    let table = match named {
        Configured::Tool(_) => "tools",
        Configured::Offset(_) => "offsets",
        Configured::Code(_) => "codes",
    };
    let fits = |name: &str| match named {
        Configured::Tool(number) => name.parse() == Ok(number),
        Configured::Offset(number) => work_offset(name, control) == Some(number),
        Configured::Code(number) => CodeNumber::parse(&name.to_ascii_uppercase()) == Some(number),
    };
    let rules_over = |item: &[Step]| {
        let files = [item, &[key("files")]].concat();
        outline.values_of(&files).any(|pattern| {
            let pattern = text.get(pattern.range.clone()).unwrap_or_default().trim_matches(['"', '\'']);
            PathPattern::new(folder, pattern).is_ok_and(|pattern| pattern.fits(program))
        })
    };
    let entry_in = |before: &[Step]| {
        let table = [before, &[key(table)]].concat();
        let mut keys = outline.keys_of(&table);
        keys.find(|(name, _)| fits(name)).map(|(_, place)| place.range.clone())
    };
    let overrides = outline.items_of(&[key("overrides")]).into_iter().rev();
    // Most have no entry for it; their patterns need not be read.
    let overrides = overrides.filter_map(|item| entry_in(&item).filter(|_| rules_over(&item)));
    overrides.chain(entry_in(&[])).collect()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::path::Path;
    use std::time::{Duration, Instant};

    use gcheck_controls::CodeNumber;
    use gcheck_server::Configured;

    use super::entries;

    /// Lines of the entries, counted from 1, with the key.
    fn found(text: &str, program: &str, named: Configured) -> Vec<String> {
        let control = gcheck_controls::load("haas-mill").unwrap();
        let ranges = entries(text, Path::new("/shop"), Path::new(program), &control, named);
        let line = |range: &std::ops::Range<usize>| text[..range.start].matches('\n').count() + 1;
        ranges.iter().map(|range| format!("{}: {}", line(range), &text[range.clone()])).collect()
    }

    #[test]
    fn tools_offsets_and_codes_by_any_way_of_writing() {
        let text = "[tools]\n3 = { length = 1 }\n[tools.7]\nlength = 2\n[tools.7.offset]\nX = 1\n[offsets]\nG54 = { X = 1 }\n\"g154 p2\" = { X = 1 }\n[codes]\nm51 = { title = \"door\" }\n";
        let at = |named| found(text, "/shop/a.nc", named);
        assert_eq!(at(Configured::Tool(3)), ["2: 3"]);
        assert_eq!(at(Configured::Tool(7)), ["3: 7"]);
        assert_eq!(at(Configured::Tool(4)), [] as [&str; 0]);
        assert_eq!(at(Configured::Offset(1)), ["8: G54"]);
        let control = gcheck_controls::load("haas-mill").unwrap();
        let number = crate::config::work_offset("G154 P2", &control).unwrap();
        assert_eq!(at(Configured::Offset(number)), ["9: \"g154 p2\""]);
        assert_eq!(at(Configured::Code(CodeNumber::m(51))), ["11: m51"]);
        assert_eq!(at(Configured::Code(CodeNumber::m(52))), [] as [&str; 0]);
    }

    #[test]
    fn what_overrides_comes_first_where_it_rules() {
        let text = "[tools]\n3 = { length = 1 }\n[[overrides]]\nfiles = [\"lathe/**\"]\n[overrides.tools]\n3 = { length = 2 }\n";
        assert_eq!(found(text, "/shop/lathe/a.nc", Configured::Tool(3)), ["6: 3", "2: 3"]);
        assert_eq!(found(text, "/shop/mill/a.nc", Configured::Tool(3)), ["2: 3"]);
    }

    #[test]
    fn a_large_configuration_is_answered_soon() {
        let mut text = "[tools]\n3 = { length = 1 }\n".to_owned();
        for number in 0..4_000 {
            let _ = write!(text, "[[overrides]]\nfiles = [\"x{number}/**\"]\n[overrides.tools]\n3 = {{}}\n");
        }
        let start = Instant::now();
        assert_eq!(found(&text, "/shop/x3999/a.nc", Configured::Tool(3)), ["16002: 3", "2: 3"]);
        let most = Duration::from_millis(if cfg!(debug_assertions) { 2_000 } else { 200 });
        assert!(start.elapsed() < most, "{:?}", start.elapsed());
    }

    #[test]
    fn a_broken_text_has_the_entries_that_can_be_read() {
        assert_eq!(
            found("control = \n[tools\n[tools]\n3 = {\n", "/shop/a.nc", Configured::Tool(3)),
            ["4: 3"]
        );
    }
}
