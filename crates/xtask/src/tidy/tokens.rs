//! A Rust file as a flat list of tokens, without comments and documentation.
//!
//! Knows: Rust's tokens, and which of them belong to tests. Must not know: any law.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::problem::Problem;
use crate::workspace::TextFile;

/// A token, as far as the checks look at it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Token {
    /// A name or keyword.
    Word(String),
    /// A string literal, with quotes as written.
    Text(String),
    /// One punctuation character or bracket.
    Mark(char),
}

/// A token with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Placed {
    pub(super) line: usize,
    pub(super) in_test: bool,
    pub(super) token: Token,
}

/// A Rust file, read for the checks.
pub(super) struct RustFile<'f> {
    pub(super) path: &'f str,
    pub(super) text: &'f str,
    tokens: Vec<Placed>,
}

impl<'f> RustFile<'f> {
    /// Reads a file; text that is not a sequence of Rust tokens is a problem of its own.
    pub(super) fn new(file: &'f TextFile) -> Result<Self, Problem> {
        let stream: TokenStream = file.text.parse().map_err(|e: proc_macro2::LexError| {
            Problem::new(&file.path, e.span().start().line, "is not Rust")
        })?;
        let mut tokens = Vec::new();
        flatten(stream, is_test_file(&file.path), &mut tokens);
        Ok(Self { path: &file.path, text: &file.text, tokens })
    }

    /// All tokens.
    pub(super) fn tokens(&self) -> &[Placed] {
        &self.tokens
    }

    /// The tokens outside of tests.
    pub(super) fn product(&self) -> Vec<&Placed> {
        self.tokens.iter().filter(|placed| !placed.in_test).collect()
    }

    /// All of the file belongs to tests.
    pub(super) fn mark_as_test(&mut self) {
        for placed in &mut self.tokens {
            placed.in_test = true;
        }
    }

    /// The crate's folder name, if the file is a source of a crate: `gcheck-rules` of `crates/gcheck-rules/src/lib.rs`.
    pub(super) fn source_of(&self) -> Option<&'f str> {
        let (name, rest) = self.path.strip_prefix("crates/")?.split_once('/')?;
        rest.starts_with("src/").then_some(name)
    }
}

/// Files under `tests/` or `benches/`, and the modules of a source folder that are by name for tests.
fn is_test_file(path: &str) -> bool {
    path.split('/').any(|part| matches!(part, "tests" | "benches" | "tests.rs" | "testing" | "testing.rs"))
}

fn flatten(stream: TokenStream, in_test: bool, out: &mut Vec<Placed>) {
    let mut trees = stream.into_iter().peekable();
    // The item after `#[cfg(test)]` or `#[test]`, to its `{…}` or `;`.
    let mut in_item = false;
    while let Some(tree) = trees.next() {
        let line = tree.span().start().line;
        let mut put = |token, in_item| out.push(Placed { line, in_test: in_test || in_item, token });
        match tree {
            TokenTree::Punct(punct) if punct.as_char() == '#' => {
                let inner =
                    trees.next_if(|next| matches!(next, TokenTree::Punct(p) if p.as_char() == '!')).is_some();
                match trees.peek() {
                    Some(TokenTree::Group(attribute)) if attribute.delimiter() == Delimiter::Bracket => {
                        let attribute = attribute.stream();
                        if first_word(&attribute).is_some_and(|word| word == "doc") {
                            trees.next();
                            continue;
                        }
                        if inner && is_test_attribute(&attribute) {
                            // `#![cfg(test)]`: all that follows.
                            return flatten(trees.collect(), true, out);
                        }
                        in_item |= is_test_attribute(&attribute);
                        put(Token::Mark('#'), in_item);
                    }
                    _ => put(Token::Mark('#'), in_item),
                }
            }
            TokenTree::Punct(punct) => {
                put(Token::Mark(punct.as_char()), in_item);
                in_item &= punct.as_char() != ';';
            }
            TokenTree::Ident(word) => put(Token::Word(word.to_string()), in_item),
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                if text.contains('"') {
                    put(Token::Text(text), in_item);
                }
            }
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ('(', ')'),
                    Delimiter::Brace => ('{', '}'),
                    Delimiter::Bracket => ('[', ']'),
                    Delimiter::None => (' ', ' '),
                };
                put(Token::Mark(open), in_item);
                flatten(group.stream(), in_test || in_item, out);
                let line = group.span_close().start().line;
                out.push(Placed { line, in_test: in_test || in_item, token: Token::Mark(close) });
                in_item &= group.delimiter() != Delimiter::Brace;
            }
        }
    }
}

fn first_word(stream: &TokenStream) -> Option<String> {
    match stream.clone().into_iter().next()? {
        TokenTree::Ident(word) => Some(word.to_string()),
        _ => None,
    }
}

/// `test`, or a `cfg` that holds only in tests.
fn is_test_attribute(attribute: &TokenStream) -> bool {
    let mut words = Vec::new();
    let mut rest: Vec<TokenTree> = attribute.clone().into_iter().collect();
    while let Some(tree) = rest.pop() {
        match tree {
            TokenTree::Ident(word) => words.push(word.to_string()),
            TokenTree::Group(group) => rest.extend(group.stream()),
            _ => {}
        }
    }
    let has = |word: &str| words.iter().any(|w| w == word);
    match first_word(attribute).as_deref() {
        Some("test") => true,
        Some("cfg") => has("test") && !has("not") && !has("any"),
        _ => false,
    }
}

/// Does the run of tokens start with these words and marks?
pub(super) fn starts_with(tokens: &[&Placed], pattern: &[&str]) -> bool {
    pattern.len() <= tokens.len()
        && tokens.iter().zip(pattern).all(|(placed, wanted)| match &placed.token {
            Token::Word(word) => word == wanted,
            Token::Mark(mark) => wanted.chars().eq([*mark]),
            Token::Text(_) => false,
        })
}

#[cfg(test)]
mod tests {
    use super::{RustFile, Token};
    use crate::workspace::TextFile;

    fn product_words(text: &str) -> Vec<String> {
        let file = TextFile { path: "crates/a/src/lib.rs".to_owned(), text: text.to_owned() };
        let rust = RustFile::new(&file).unwrap();
        rust.product()
            .into_iter()
            .filter_map(|placed| match &placed.token {
                Token::Word(word) | Token::Text(word) => Some(word.clone()),
                Token::Mark(_) => None,
            })
            .collect()
    }

    #[test]
    fn comments_documentation_and_tests_are_left_out() {
        let text = r#"
            //! doc
            /// doc
            fn a() { let b = "text"; /* comment */ }
            #[cfg(test)]
            mod tests { fn hidden() {} }
            #[test]
            fn hidden() -> bool { true }
            #[cfg(test)]
            use hidden::it;
            #[cfg(not(test))]
            fn c() {}
        "#;
        assert_eq!(product_words(text), ["fn", "a", "let", "b", "\"text\"", "cfg", "not", "test", "fn", "c"]);
    }
}
