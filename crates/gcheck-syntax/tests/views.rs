//! What the typed views of the tree see in small programs.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_syntax::ast::{
    Binary, Block, Chunk, Comment, Element, Expr, FunctionCall, Group, Statement, Variable, Word,
};
use gcheck_syntax::{SyntaxElement, SyntaxNode, SyntaxProfile, byte_range, parse};

fn chunk(profile: SyntaxProfile, text: &str) -> Chunk {
    Chunk::cast(parse(text, profile).syntax()).unwrap()
}

/// The first block of a text.
fn block(profile: SyntaxProfile, text: &str) -> Block {
    chunk(profile, text).blocks().next().unwrap()
}

/// The first view of its kind in a text.
fn first<T>(profile: SyntaxProfile, text: &str, cast: impl Fn(SyntaxNode) -> Option<T>) -> T {
    parse(text, profile).syntax().descendants().find_map(cast).unwrap()
}

fn written(text: &str, range: std::ops::Range<u32>) -> &str {
    &text[range.start as usize..range.end as usize]
}

/// The element of the token at the first `$` of a text, which is left out.
fn element(profile: SyntaxProfile, text: &str) -> Element {
    let at = text.find('$').unwrap() as u32;
    let text = text.replacen('$', "", 1);
    let root = parse(&text, profile).syntax();
    let mut tokens = root.descendants_with_tokens().filter_map(SyntaxElement::into_token);
    Element::of(tokens.find(|token| byte_range(token.text_range()).contains(&at)).unwrap())
}

const MACRO_B: SyntaxProfile = SyntaxProfile::MACRO_B;
const NGC: SyntaxProfile = SyntaxProfile::NGC;

#[test]
fn the_parts_of_a_block() {
    let block = block(MACRO_B, "/2 N10 G1 x[#1] :7 #100=#101+1. (note)\n");
    assert_eq!(block.block_delete().and_then(|mark| mark.level()), Some(2));
    let words: String = block.words().filter_map(|word| word.letter()).collect();
    assert_eq!(words, "NGXO");
    let assignment = block.assignments().next().unwrap();
    assert_eq!(assignment.target().and_then(|target| target.number()), Some(100));
    assert_eq!(assignment.value().unwrap().range(), 24..31);
    assert_eq!(block.comments().map(|comment| comment.text().to_owned()).collect::<Vec<_>>(), ["note"]);
    assert_eq!(block.variables().filter_map(|variable| variable.number()).collect::<Vec<_>>(), [1, 100, 101]);
    assert!(!block.is_tape_mark());
}

#[test]
fn blocks_of_a_chunk() {
    let chunk = chunk(MACRO_B, "%\nG0 ; X1.\n\n");
    let marks: Vec<bool> = chunk.blocks().map(|block| block.is_tape_mark()).collect();
    assert_eq!(marks, [true, false, false, false]);
    let first: Vec<_> =
        chunk.blocks().map(|block| block.first().map(|token| token.text().to_owned())).collect();
    assert_eq!(first, [Some("%".to_owned()), Some("G0".to_owned()), Some("X1.".to_owned()), None]);
}

#[test]
fn words_with_every_form_of_value() {
    let text = "G01 X1.5 Y#2 Z[#1+1] A B 2 ,R5. , C 3.\n";
    let block = block(MACRO_B, text);
    let words: Vec<Word> = block.words().collect();
    let letters: String = words.iter().filter_map(Word::letter).collect();
    assert_eq!(letters, "GXYZABRC");
    assert_eq!(words.iter().map(Word::is_corner).filter(|is_corner| *is_corner).count(), 2);
    assert_eq!(words[0].text(), "G01");
    assert_eq!(words[5].text(), "B2");
    assert_eq!(words[0].integer(), Some(1));
    assert_eq!(words[1].integer(), None);
    assert!(matches!(words[2].value(), Some(Expr::Variable(_))));
    assert!(matches!(words[3].value(), Some(Expr::Group(_))));
    assert_eq!(words[4].value(), None);
    assert_eq!(words[5].integer(), Some(2));
    assert_eq!(written(text, words[3].range()), "Z[#1+1]");
    assert_eq!(written(text, words[3].head_range()), "Z");
}

#[test]
fn words_of_statements_are_words_of_the_block_as_well() {
    let block = block(MACRO_B, "N1 IF [#1 EQ 2] THEN G1 X2.\n");
    let letters =
        |words: &mut dyn Iterator<Item = Word>| words.filter_map(|w| w.letter()).collect::<String>();
    assert_eq!(letters(&mut block.words()), "N");
    assert_eq!(letters(&mut block.all_words()), "NGX");
}

#[test]
fn a_number_that_blanks_divide_is_one_word() {
    let block = block(NGC, "X1. 5 Y2\n");
    let ranges: Vec<_> = block.all_words().map(|word| word.range()).collect();
    assert_eq!(ranges, [0..5, 6..8]);
}

#[test]
fn numbers_without_blanks() {
    let number = |text: &str| match first(NGC, text, Binary::cast).left() {
        Some(Expr::Number(number)) => (number.text(), number.integer()),
        other => panic!("{other:?}"),
    };
    assert_eq!(number("X[1 . 5+2]"), ("1.5".to_owned(), None));
    assert_eq!(number("X[12.+2]"), ("12.".to_owned(), Some(12)));
}

#[test]
fn binary_expressions_nest_by_precedence() {
    let sum = first(MACRO_B, "#1=#2+3*#4", Binary::cast);
    assert_eq!(sum.operator().unwrap().text(), "+");
    assert!(matches!(sum.left(), Some(Expr::Variable(_))));
    let Some(Expr::Binary(product)) = sum.right() else { panic!() };
    assert_eq!(product.operator().unwrap().text(), "*");
    assert!(matches!(product.left(), Some(Expr::Number(_))));
    assert_eq!(product.right().unwrap().as_variable().and_then(|v| v.number()), Some(4));
}

#[test]
fn an_operand_that_is_missing_is_none() {
    let sum = first(MACRO_B, "#1=#2+", Binary::cast);
    assert_eq!(sum.operator().unwrap().text(), "+");
    assert_eq!(sum.right(), None);
}

#[test]
fn signs_have_operands() {
    let block = block(MACRO_B, "X-[#1]\n");
    let Some(Expr::Unary(sign)) = block.words().next().unwrap().value() else { panic!() };
    assert_eq!(sign.operand().unwrap().as_variable().and_then(|v| v.number()), Some(1));
}

#[test]
fn function_calls_have_a_name_and_arguments() {
    let call = first(MACRO_B, "#1=ATAN[#2]/[3.]", FunctionCall::cast);
    assert_eq!(call.name().unwrap().text(), "ATAN");
    let arguments: Vec<_> = call.arguments().map(|group| group.range()).collect();
    assert_eq!(arguments, [7..11, 12..16]);
    let call = first(MACRO_B, "#1=POW[#2,3.]", FunctionCall::cast);
    assert_eq!(call.arguments().next().unwrap().expressions().count(), 2);
}

#[test]
fn groups_know_what_is_inside_of_them() {
    let groups: Vec<_> = block(MACRO_B, "X[#1+[2]\n").groups().collect();
    assert_eq!(groups.iter().map(Group::is_closed).collect::<Vec<_>>(), [false, true]);
    assert_eq!((6..=8).map(|at| groups[1].surrounds(at)).collect::<Vec<_>>(), [true, true, false]);
    assert!(groups[0].surrounds(8));
    assert!(!groups[0].surrounds(1));
}

#[test]
fn variables_of_every_form() {
    let text = "#100.=#<Old depth>+##3\n";
    let mut variables = block(NGC, text).variables();
    let Some(numbered @ Variable::Numbered(_)) = variables.next() else { panic!() };
    assert_eq!(numbered.number(), Some(100));
    assert_eq!(numbered.name(), Some((1..4, "100")));
    assert!(numbered.is_target());
    let Some(named @ Variable::Named(_)) = variables.next() else { panic!() };
    assert_eq!(named.name(), Some((8..17, "Old depth")));
    assert!(!named.is_target());
    let Some(Variable::Indirect(indirect)) = variables.next() else { panic!() };
    assert_eq!(indirect.number().unwrap().as_variable().and_then(|v| v.number()), Some(3));
    assert!(matches!(variables.next(), Some(Variable::Numbered(_))));
    assert_eq!(variables.next(), None);
}

#[test]
fn the_number_of_an_indirect_target_is_read() {
    let targets: Vec<bool> = block(MACRO_B, "##1=#2\n").variables().map(|v| v.is_target()).collect();
    assert_eq!(targets, [true, false, false]);
}

#[test]
fn conditions_jumps_and_consequences() {
    let statements: Vec<_> = block(MACRO_B, "IF [#1 EQ #0] GOTO 90\n").statements().collect();
    let [Statement::If(statement)] = statements.as_slice() else { panic!() };
    assert_eq!(statement.keyword().unwrap().text(), "IF");
    let Some(Expr::Group(group)) = statement.condition() else { panic!() };
    let Some(Expr::Binary(test)) = group.expressions().next() else { panic!() };
    assert_eq!(test.operator().unwrap().text(), "EQ");
    let Some(Expr::Number(target)) = statement.goto().and_then(|goto| goto.target()) else { panic!() };
    assert_eq!(target.integer(), Some(90));
    let statements: Vec<_> = block(MACRO_B, "IF [#1 EQ #0] THEN #2=1.\n").statements().collect();
    let [Statement::If(statement)] = statements.as_slice() else { panic!() };
    assert_eq!(statement.goto(), None);
    assert_eq!(statement.assignments().count(), 1);
    let Some(Statement::Condition(condition)) = block(MACRO_B, "[#1 LT 10] M99 P10").statements().next()
    else {
        panic!()
    };
    assert_eq!(condition.group().unwrap().range(), 0..10);
}

#[test]
fn loops_have_numbers() {
    let chunk = chunk(MACRO_B, "WHILE [#1 LT 3] DO2\nEND2\nDO1\n");
    let statements: Vec<_> = chunk.blocks().flat_map(|block| block.statements()).collect();
    let [Statement::While(begin), Statement::End(end), Statement::While(bare)] = statements.as_slice() else {
        panic!("{statements:?}")
    };
    assert!(begin.keyword().is_some() && begin.condition().is_some());
    let integer = |number: Option<Expr>| match number {
        Some(Expr::Number(number)) => number.integer(),
        _ => None,
    };
    assert_eq!([begin.number(), end.number(), bare.number()].map(integer), [Some(2), Some(2), Some(1)]);
    assert!(bare.keyword().is_none() && bare.condition().is_none());
}

#[test]
fn o_words_have_a_label_a_keyword_and_arguments() {
    let o = |text: &str| match block(NGC, text).statements().next() {
        Some(Statement::O(statement)) => statement,
        other => panic!("{other:?}"),
    };
    let call = o("o<probe> call [1] [#2]\n");
    assert_eq!(call.label().unwrap().name(), Some("probe"));
    assert_eq!(call.keyword().unwrap().text(), "call");
    assert_eq!(call.arguments().len(), 2);
    assert_eq!(call.operand(), None);
    let arguments = [13, 15, 16, 17, 19].map(|at| call.argument_at(at));
    assert_eq!(arguments, [0, 0, 0, 1, 1]);
    assert_eq!(o("o<probe> call [1] [2\n").argument_at(20), 1);
    let begin = o("o100 while [#1 LT 3]\n");
    assert_eq!(begin.label().unwrap().number(), Some(100));
    assert!(begin.operand().is_some() && begin.arguments().is_empty());
    assert_eq!(o("o[#1] sub\n").label().unwrap().number(), None);
    assert_eq!(o("o<100> sub\n").label().unwrap().number(), Some(100));
}

#[test]
fn a_label_is_there_before_its_keyword() {
    let number = |text: &str| block(NGC, text).o_label().and_then(|label| label.number());
    assert_eq!(number("o100 \n"), Some(100));
    assert_eq!(number("o100 sub\n"), Some(100));
    assert_eq!(number("N10 o100 if [1]\n"), Some(100));
    assert_eq!(number("N10 G1\n"), None);
    assert_eq!(block(NGC, "o<a>\n").o_label().unwrap().name(), Some("a"));
}

#[test]
fn other_statements() {
    let kinds = |text: &str| block(MACRO_B, text).statements().next().unwrap();
    assert!(matches!(kinds("GOTO 10\n"), Statement::Goto(_)));
    assert!(matches!(kinds("DPRNT[X#1[42]]\n"), Statement::Print(_)));
    let Statement::Print(print) = kinds("DPRNT[X#1[42]\n") else { panic!() };
    assert_eq!([5, 6, 13].map(|at| print.surrounds(at)), [false, true, true]);
    assert!(matches!(kinds("POPEN\n"), Statement::Port(_)));
    assert!(matches!(kinds("$H\n"), Statement::Command(_)));
}

#[test]
fn comments_without_what_encloses_them() {
    let comments = |profile, text: &str| -> Vec<(String, bool)> {
        let comments = block(profile, text).comments();
        comments.map(|comment: Comment| (comment.text().to_owned(), comment.is_closed())).collect()
    };
    assert_eq!(comments(MACRO_B, "(A) G0 ( B )\n"), [("A".to_owned(), true), (" B ".to_owned(), true)]);
    assert_eq!(comments(MACRO_B, "(A\n"), [("A".to_owned(), false)]);
    assert_eq!(comments(MACRO_B, "(A (B) C)\n"), [("A (B) C".to_owned(), false)]);
    assert_eq!(comments(NGC, "G0 ; A (B)\n"), [(" A (B)".to_owned(), false)]);
}

#[test]
fn elements_are_the_smallest_views_around_a_token() {
    assert!(matches!(element(MACRO_B, "G0 $X1."), Element::Word(word) if word.letter() == Some('X')));
    assert!(matches!(element(MACRO_B, "G0 X $1."), Element::Word(word) if word.letter() == Some('X')));
    assert!(matches!(element(MACRO_B, "G0 X - $.5"), Element::Word(word) if word.letter() == Some('X')));
    assert!(matches!(element(MACRO_B, "X[#1$+2]"), Element::Operator(_)));
    assert!(
        matches!(element(MACRO_B, "X[$#1+2]"), Element::Variable(variable) if variable.number() == Some(1))
    );
    assert!(matches!(element(MACRO_B, "X$##1"), Element::Variable(Variable::Indirect(_))));
    assert!(matches!(element(MACRO_B, "X[#1+$2]"), Element::Token(_)));
    assert!(matches!(element(MACRO_B, "X[$SIN[2]]"), Element::Function(name) if name.text() == "SIN"));
    assert!(matches!(element(MACRO_B, "$GOTO 5"), Element::Keyword(_)));
    assert!(matches!(element(MACRO_B, "G0 $(A)"), Element::Comment(_)));
    assert!(matches!(element(MACRO_B, "/$3 G0"), Element::BlockDelete(_)));
    assert!(matches!(element(MACRO_B, "G0$ X1."), Element::Token(_)));
    assert!(matches!(element(NGC, "$o<a> sub"), Element::Label(_)));
}
