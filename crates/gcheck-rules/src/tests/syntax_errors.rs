//! Every kind of syntax error is reported by one rule.

use std::collections::BTreeMap;

use gcheck_syntax::{ForeignForm, SyntaxErrorKind as Kind};

use gcheck_lint::Run;

use crate::RULES;

/// A kind that is added to the grammar must be added here, and then has no rule until one is written.
fn every_kind() -> Vec<Kind> {
    let all = |kind| match kind {
        Kind::UnclosedComment
        | Kind::NestedComment
        | Kind::StrayParenthesis
        | Kind::UnclosedBracket
        | Kind::StrayBracket
        | Kind::TooDeep
        | Kind::LineTooLong
        | Kind::AddressWithoutValue
        | Kind::ValueWithoutAddress
        | Kind::MalformedNumber
        | Kind::MissingOperand
        | Kind::NeedsBrackets
        | Kind::MissingEquals
        | Kind::IfWithoutConsequence
        | Kind::MissingCondition
        | Kind::MissingNumber
        | Kind::WhileWithoutDo
        | Kind::OWordWithoutKeyword
        | Kind::StrayKeyword
        | Kind::Unexpected
        | Kind::TextAfterEndOfBlock
        | Kind::Foreign(
            ForeignForm::OWord
            | ForeignForm::MacroStatement
            | ForeignForm::Variable
            | ForeignForm::Expression
            | ForeignForm::NamedParameter
            | ForeignForm::PowerOperator
            | ForeignForm::SystemCommand,
        ) => kind,
    };
    let forms = [
        ForeignForm::OWord,
        ForeignForm::MacroStatement,
        ForeignForm::Variable,
        ForeignForm::Expression,
        ForeignForm::NamedParameter,
        ForeignForm::PowerOperator,
        ForeignForm::SystemCommand,
    ];
    let plain = [
        Kind::UnclosedComment,
        Kind::NestedComment,
        Kind::StrayParenthesis,
        Kind::UnclosedBracket,
        Kind::StrayBracket,
        Kind::TooDeep,
        Kind::LineTooLong,
        Kind::AddressWithoutValue,
        Kind::ValueWithoutAddress,
        Kind::MalformedNumber,
        Kind::MissingOperand,
        Kind::NeedsBrackets,
        Kind::MissingEquals,
        Kind::IfWithoutConsequence,
        Kind::MissingCondition,
        Kind::MissingNumber,
        Kind::WhileWithoutDo,
        Kind::OWordWithoutKeyword,
        Kind::StrayKeyword,
        Kind::Unexpected,
        Kind::TextAfterEndOfBlock,
    ];
    plain.into_iter().chain(forms.map(Kind::Foreign)).map(all).collect()
}

#[test]
fn every_kind_of_mistake_has_one_rule() {
    // Two kinds are shared by two rules, which look at the text to tell which of them speaks.
    let shared = BTreeMap::from([
        ("Unexpected", ["non-ascii-text", "unexpected-text"]),
        ("ValueWithoutAddress", ["value-without-address", "zero-for-letter-o"]),
    ]);
    for kind in every_kind() {
        let speakers: Vec<&str> = RULES
            .iter()
            .filter(|rule| matches!(rule.run, Run::Token { on, .. } if on(kind)))
            .map(|rule| rule.meta.id)
            .collect();
        match shared.get(format!("{kind:?}").as_str()) {
            Some(two) => assert_eq!(speakers, two, "{kind:?}"),
            None => assert_eq!(speakers.len(), 1, "{kind:?}: {speakers:?}"),
        }
    }
}

#[test]
fn alarms_name_rules() {
    for name in gcheck_controls::names() {
        let control = gcheck_controls::load(name).unwrap();
        let unknown: Vec<&str> = control.rules_with_alarms().filter(|id| RULES.by_id(id).is_none()).collect();
        assert!(unknown.is_empty(), "{name}: alarms.toml names rules that do not exist: {unknown:?}");
    }
}
