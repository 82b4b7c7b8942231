//! What the keywords of statements and expressions do, in one line each.
//!
//! Knows: every keyword. Must not know: where it is written, what a condition comes to.

use gcheck_program::OKeyword;
use gcheck_syntax::SyntaxKind;

/// What a keyword does, without its name; `None` for what is not a keyword. `text` is the keyword in capitals; `is_o_word` says
/// that it belongs to an O-word.
pub(crate) fn does(kind: SyntaxKind, text: &str, is_o_word: bool) -> Option<&'static str> {
    Some(match (kind, text) {
        (SyntaxKind::COMPARISON, "EQ") => "is true when both sides are equal",
        (SyntaxKind::COMPARISON, "NE") => "is true when the sides differ",
        (SyntaxKind::COMPARISON, "GT") => "is true when the left side is greater than the right side",
        (SyntaxKind::COMPARISON, "GE") => {
            "is true when the left side is greater than the right side, or equal"
        }
        (SyntaxKind::COMPARISON, "LT") => "is true when the left side is less than the right side",
        (SyntaxKind::COMPARISON, "LE") => "is true when the left side is less than the right side, or equal",
        (SyntaxKind::AND_KW, _) => "is true when both sides are true",
        (SyntaxKind::OR_KW, "XOR") => "is true when exactly one side is true",
        (SyntaxKind::OR_KW, _) => "is true when one side is true, or both",
        (SyntaxKind::MOD_KW, _) => "gives the remainder of a division",
        (SyntaxKind::IF_KW, _) if is_o_word => {
            "executes the blocks up to `else`, `elseif` or `endif` when the condition holds"
        }
        (SyntaxKind::IF_KW, _) => "executes the rest of the block when the condition holds",
        (SyntaxKind::THEN_KW, _) => "begins what the block does when the condition holds",
        (SyntaxKind::ELSE_KW, _) => "begins the blocks that are executed when no condition above holds",
        (SyntaxKind::ELSEIF_KW, _) => {
            "begins the blocks that are executed when no condition above holds, and this one does"
        }
        (SyntaxKind::ENDIF_KW, _) => "ends the blocks of `if`",
        (SyntaxKind::WHILE_KW, _) if is_o_word => {
            "repeats the blocks up to `endwhile` as long as the condition holds"
        }
        (SyntaxKind::WHILE_KW, _) => {
            "repeats the blocks from `DO` to its `END` as long as the condition holds"
        }
        (SyntaxKind::ENDWHILE_KW, _) => "ends the loop: the condition is looked at again",
        (SyntaxKind::DO_KW, _) if is_o_word => {
            "repeats the blocks up to `while`, whose condition is looked at after them"
        }
        (SyntaxKind::DO_KW, _) => "begins the blocks of a loop, which end at `END` with the same number",
        (SyntaxKind::END_KW, _) => "ends the loop that `DO` with the same number begins",
        (SyntaxKind::GOTO_KW, _) => "goes on at the block with this sequence number",
        (SyntaxKind::SUB_KW, _) => "begins a subroutine, which is executed when it is called",
        (SyntaxKind::ENDSUB_KW, _) => "ends a subroutine: goes back to the caller",
        (SyntaxKind::CALL_KW, _) => {
            "calls a subroutine with arguments, which it reads as `#1`, `#2` and so on"
        }
        (SyntaxKind::RETURN_KW, _) => "goes back to the caller at once",
        (SyntaxKind::REPEAT_KW, _) => "repeats the blocks up to `endrepeat` as often as the number says",
        (SyntaxKind::ENDREPEAT_KW, _) => "ends the blocks of `repeat`",
        (SyntaxKind::BREAK_KW, _) => "leaves the loop",
        (SyntaxKind::CONTINUE_KW, _) => "goes on with the next turn of the loop",
        (SyntaxKind::PRINT_KW, _) => "writes text and values of variables to the open port",
        (SyntaxKind::PORT_KW, "POPEN") => "opens the port that `DPRNT` and `BPRNT` write to",
        (SyntaxKind::PORT_KW, _) => "closes the port that `DPRNT` and `BPRNT` write to",
        _ => return None,
    })
}

/// The keywords that may follow the label of an O-word, in the order in which people need them; `opened` is the one that a
/// statement with the same label has opened before and not closed.
pub(crate) fn after_label(opened: Option<OKeyword>) -> Vec<(OKeyword, SyntaxKind)> {
    let all = [
        (OKeyword::Sub, SyntaxKind::SUB_KW),
        (OKeyword::Call, SyntaxKind::CALL_KW),
        (OKeyword::If, SyntaxKind::IF_KW),
        (OKeyword::While, SyntaxKind::WHILE_KW),
        (OKeyword::Do, SyntaxKind::DO_KW),
        (OKeyword::Repeat, SyntaxKind::REPEAT_KW),
        (OKeyword::EndSub, SyntaxKind::ENDSUB_KW),
        (OKeyword::Return, SyntaxKind::RETURN_KW),
        (OKeyword::Else, SyntaxKind::ELSE_KW),
        (OKeyword::ElseIf, SyntaxKind::ELSEIF_KW),
        (OKeyword::EndIf, SyntaxKind::ENDIF_KW),
        (OKeyword::EndWhile, SyntaxKind::ENDWHILE_KW),
        (OKeyword::EndRepeat, SyntaxKind::ENDREPEAT_KW),
        (OKeyword::Break, SyntaxKind::BREAK_KW),
        (OKeyword::Continue, SyntaxKind::CONTINUE_KW),
    ];
    let first: &[OKeyword] = match opened {
        Some(OKeyword::Sub) => &[OKeyword::EndSub, OKeyword::Return],
        Some(OKeyword::If) => &[OKeyword::EndIf, OKeyword::Else, OKeyword::ElseIf],
        Some(OKeyword::While) => &[OKeyword::EndWhile, OKeyword::Break, OKeyword::Continue],
        Some(OKeyword::Do) => &[OKeyword::While, OKeyword::Break, OKeyword::Continue],
        // The interpreter refuses `break` and `continue` in it.
        Some(OKeyword::Repeat) => &[OKeyword::EndRepeat],
        _ => &[],
    };
    let place = |keyword: OKeyword| first.iter().position(|other| *other == keyword).unwrap_or(first.len());
    let mut all = all.to_vec();
    all.sort_by_key(|(keyword, _)| place(*keyword));
    all
}
