//! No function of the product is longer than a reader can hold: 80 lines from its `fn` to its closing brace.
//!
//! Knows: how long a function may be. Must not know: any function. Tests and generated files do not count; documentation and
//! attributes above the `fn` do not either, comments within do.

use super::problem::Problem;
use super::tokens::{Placed, RustFile, Token};

/// Lines that a function may have.
const MOST: usize = 80;

/// Functions of a crate's sources that are too long.
pub(super) fn problems(file: &RustFile<'_>) -> Vec<Problem> {
    if file.source_of().is_none() || file.path.ends_with("/generated.rs") {
        return Vec::new();
    }
    let tokens = file.product();
    let mut problems = Vec::new();
    for (at, name) in functions(&tokens) {
        let Some((first, last)) = lines_of(&tokens, at) else { continue };
        let length = last + 1 - first;
        if length > MOST {
            let message =
                format!("`{name}` has {length} lines, {MOST} are the most; a part of it has a name");
            problems.push(Problem::new(file.path, first, message));
        }
    }
    problems
}

/// Each `fn` with a name, by the place of its `fn` among the tokens.
fn functions<'t>(tokens: &'t [&'t Placed]) -> impl Iterator<Item = (usize, &'t str)> {
    tokens.windows(2).enumerate().filter_map(|(at, pair)| match pair {
        [Placed { token: Token::Word(word), .. }, Placed { token: Token::Word(name), .. }]
            if word == "fn" =>
        {
            Some((at, name.as_str()))
        }
        _ => None,
    })
}

/// First and last line of the function whose `fn` is at a place; `None` when it has no body.
fn lines_of(tokens: &[&Placed], at: usize) -> Option<(usize, usize)> {
    let first = tokens.get(at)?.line;
    // Brackets that are open; the body is the first brace outside of all others.
    let mut open: Vec<char> = Vec::new();
    for placed in tokens.get(at..)? {
        match placed.token {
            Token::Mark(mark @ ('(' | '[' | '{')) => open.push(mark),
            Token::Mark(')' | ']') => {
                open.pop();
            }
            Token::Mark('}') => {
                open.pop();
                if open.is_empty() {
                    return Some((first, placed.line));
                }
            }
            Token::Mark(';') if open.is_empty() => return None,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::problems;
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    fn found_in(path: &str, text: &str) -> Vec<String> {
        let file = TextFile { path: path.to_owned(), text: text.to_owned() };
        problems(&RustFile::new(&file).unwrap()).iter().map(ToString::to_string).collect()
    }

    /// A function of so many lines.
    fn function(name: &str, lines: usize) -> String {
        format!("fn {name}(a: [u8; 2]) -> u8 {{\n{}}}\n", "    work();\n".repeat(lines - 2))
    }

    #[test]
    fn a_function_above_eighty_lines_is_found_with_its_place_and_length() {
        let text = format!("trait T {{ fn declared(); }}\n{}", function("long", 81));
        let found = found_in("crates/a/src/b.rs", &text);
        assert_eq!(
            found,
            ["crates/a/src/b.rs:2: `long` has 81 lines, 80 are the most; a part of it has a name"]
        );
    }

    #[test]
    fn functions_of_eighty_lines_tests_and_generated_files_are_fine() {
        let text = format!(
            "{}{}\n#[cfg(test)]\nmod tests {{\n{}}}\n",
            function("one", 80),
            function("two", 80),
            function("test", 200)
        );
        assert_eq!(found_in("crates/a/src/b.rs", &text), [""; 0]);
        let long = function("long", 100);
        assert_eq!(found_in("crates/a/src/rules/generated.rs", &long), [""; 0]);
        assert_eq!(found_in("crates/a/tests/b.rs", &long), [""; 0]);
        assert_eq!(found_in("tests/tests/b.rs", &long), [""; 0]);
    }

    #[test]
    fn a_long_function_within_a_short_one_makes_both_long() {
        let text = format!("impl A {{\n    fn outer() {{\n{}    }}\n}}\n", function("inner", 90));
        let found = found_in("crates/a/src/b.rs", &text);
        assert!(
            found.len() == 2 && found[0].contains("`outer`") && found[1].contains("`inner`"),
            "{found:?}"
        );
    }
}
