//! The shape of trees, mistakes included.

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_syntax::{SyntaxElement, SyntaxNode, SyntaxProfile, parse};

/// The one boundary helper: a text, its tree and its mistakes.
fn check_tree(profile: SyntaxProfile, text: &str, expected: &Expect) {
    let parsed = parse(text, profile);
    let mut out = String::new();
    dump(&parsed.syntax(), 0, &mut out);
    for error in parsed.errors() {
        let _ = writeln!(
            out,
            "! {:?} {:?}",
            error.kind,
            &text[error.range.start as usize..error.range.end as usize]
        );
    }
    expected.assert_eq(&out);
}

fn dump(node: &SyntaxNode, depth: usize, out: &mut String) {
    let _ = writeln!(out, "{}{:?}", "  ".repeat(depth), node.kind());
    for child in node.children_with_tokens() {
        match child {
            SyntaxElement::Node(node) => dump(&node, depth + 1, out),
            SyntaxElement::Token(token) => {
                let _ = writeln!(out, "{}{:?} {:?}", "  ".repeat(depth + 1), token.kind(), token.text());
            }
        }
    }
}

#[test]
fn plain_words_are_tokens_of_their_block() {
    check_tree(
        SyntaxProfile::MACRO_B,
        "/1 N10 G1 X-1.5 (cut)\r\n",
        &expect![[r#"
        CHUNK
          BLOCK
            BLOCK_DELETE
              SLASH "/"
              NUMBER "1"
            WHITESPACE " "
            WORD "N10"
            WHITESPACE " "
            WORD "G1"
            WHITESPACE " "
            WORD "X-1.5"
            WHITESPACE " "
            COMMENT "(cut)"
            NEWLINE "\r\n"
    "#]],
    );
}

#[test]
fn expressions_nest_by_precedence() {
    check_tree(
        SyntaxProfile::MACRO_B,
        "X[#1+2*SIN[30.]]",
        &expect![[r##"
        CHUNK
          BLOCK
            ADDRESS
              LETTER "X"
              GROUP
                L_BRACKET "["
                BINARY
                  VARIABLE "#1"
                  PLUS "+"
                  BINARY
                    NUMBER "2"
                    STAR "*"
                    FUNCTION_CALL
                      FUNCTION "SIN"
                      GROUP
                        L_BRACKET "["
                        NUMBER "30."
                        R_BRACKET "]"
                R_BRACKET "]"
    "##]],
    );
}

#[test]
fn o_word_statements() {
    check_tree(
        SyntaxProfile::NGC,
        "o<probe> call [1] ; go\n",
        &expect![[r#"
        CHUNK
          BLOCK
            O_STATEMENT
              O_NAME "o<probe>"
              WHITESPACE " "
              CALL_KW "call"
              WHITESPACE " "
              GROUP
                L_BRACKET "["
                NUMBER "1"
                R_BRACKET "]"
            WHITESPACE " "
            LINE_COMMENT "; go"
            NEWLINE "\n"
    "#]],
    );
}

#[test]
fn a_form_of_another_control_has_a_tree_and_a_mistake() {
    check_tree(
        SyntaxProfile::NGC,
        "IF [#1 EQ 2] GOTO 5",
        &expect![[r##"
        CHUNK
          BLOCK
            IF_STATEMENT
              IF_KW "IF"
              WHITESPACE " "
              GROUP
                L_BRACKET "["
                BINARY
                  VARIABLE "#1"
                  WHITESPACE " "
                  COMPARISON "EQ"
                  WHITESPACE " "
                  NUMBER "2"
                R_BRACKET "]"
              WHITESPACE " "
              GOTO_STATEMENT
                GOTO_KW "GOTO"
                WHITESPACE " "
                NUMBER "5"
        ! Foreign(MacroStatement) "IF"
    "##]],
    );
}

#[test]
fn what_cannot_be_used_stands_in_error_nodes() {
    check_tree(
        SyntaxProfile::MACRO_B,
        "G1 ) X& [1",
        &expect![[r#"
            CHUNK
              BLOCK
                WORD "G1"
                WHITESPACE " "
                ERROR
                  R_PAREN ")"
                WHITESPACE " "
                ADDRESS
                  LETTER "X"
                ERROR
                  UNKNOWN "&"
                WHITESPACE " "
                CONDITION
                  GROUP
                    L_BRACKET "["
                    NUMBER "1"
            ! StrayParenthesis ")"
            ! AddressWithoutValue "X"
            ! Unexpected "&"
            ! UnclosedBracket "["
        "#]],
    );
}

#[test]
fn a_number_may_be_divided_by_blanks() {
    check_tree(
        SyntaxProfile::NGC,
        "X 1 . 5 Y[. 5 * * 2]\n",
        &expect![[r#"
        CHUNK
          BLOCK
            ADDRESS
              LETTER "X"
              WHITESPACE " "
              NUMBER "1"
              WHITESPACE " "
              UNKNOWN "."
              WHITESPACE " "
              NUMBER "5"
            WHITESPACE " "
            ADDRESS
              LETTER "Y"
              GROUP
                L_BRACKET "["
                BINARY
                  DIVIDED_NUMBER
                    UNKNOWN "."
                    WHITESPACE " "
                    NUMBER "5"
                  WHITESPACE " "
                  STAR "*"
                  WHITESPACE " "
                  STAR "*"
                  WHITESPACE " "
                  NUMBER "2"
                R_BRACKET "]"
            NEWLINE "\n"
    "#]],
    );
}
