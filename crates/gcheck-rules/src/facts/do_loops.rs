//! Pairing `DO` with `END`.
//!
//! Knows: which `END` closes which `DO`, and what is wrong if none does. Must not know: any rule, wording.

use crate::FileCx;
use gcheck_program::Loop;

use crate::facts::sections::sections;

/// What is wrong with a `DO` or `END`. Each place has one fault.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LoopFault<'s> {
    /// A `DO` that no `END` closes.
    EndMissing(&'s Loop),
    /// An `END` that closes nothing.
    BeginMissing(&'s Loop),
    /// `DO1 DO2 END1 END2`.
    Crossed { end: &'s Loop, begin: &'s Loop, inner: &'s Loop },
    /// A `DO` inside more loops than there are numbers.
    TooDeep { begin: &'s Loop, outermost: &'s Loop },
    /// A `DO` whose number an enclosing loop has.
    NumberInUse { begin: &'s Loop, outer: &'s Loop },
}

/// Pairs the loops of one program. `depth` is how many may be nested, if known.
///
/// A computed or missing number could pair with anything: then there are no faults.
fn faults(loops: &[Loop], depth: Option<usize>) -> Vec<LoopFault<'_>> {
    let mut faults = Vec::new();
    if loops.iter().any(|l| l.number.is_none()) {
        return faults;
    }
    let mut open: Vec<&Loop> = Vec::new();
    for (ix, this) in loops.iter().enumerate() {
        if this.begins {
            // Real programs nest a few loops.
            if open.len() >= 256 {
                return faults;
            }
            if depth.is_some_and(|depth| open.len() >= depth) {
                faults.extend(open.first().map(|outermost| LoopFault::TooDeep { begin: this, outermost }));
            } else if let Some(outer) = open.iter().rev().find(|l| l.number == this.number) {
                faults.push(LoopFault::NumberInUse { begin: this, outer });
            }
            open.push(this);
            continue;
        }
        let Some(at) = open.iter().rposition(|l| l.number == this.number) else {
            faults.push(LoopFault::BeginMissing(this));
            continue;
        };
        let rest = loops.get(ix + 1..).unwrap_or_default();
        let inner = open.split_off(at);
        let [begin, inner @ ..] = inner.as_slice() else { continue };
        let mut is_told = false;
        for inside in inner {
            // The inner loop has its END further on, or none at all.
            if ends_later(inside, rest) {
                if !is_told {
                    faults.push(LoopFault::Crossed { end: this, begin, inner: inside });
                    is_told = true;
                }
                open.push(inside);
            } else {
                faults.push(LoopFault::EndMissing(inside));
            }
        }
    }
    faults.extend(open.into_iter().map(LoopFault::EndMissing));
    faults
}

fn ends_later(begin: &Loop, rest: &[Loop]) -> bool {
    rest.iter().find(|l| l.number == begin.number).is_some_and(|l| !l.begins)
}

/// Faults in the loops of every program of the file; none on controls without such loops.
pub(crate) fn loop_faults<'a>(cx: &FileCx<'a>) -> Vec<LoopFault<'a>> {
    let mut all = Vec::new();
    if cx.file_index.loops.is_empty() || !cx.control().syntax().macro_statements {
        return all;
    }
    let depth =
        cx.control().limits().do_numbers.map(|[first, last]| usize::from(last.saturating_sub(first)) + 1);
    let loops = cx.file_index.loops.as_slice();
    let mut from = 0;
    for section in sections(cx) {
        let to = loops.partition_point(|l| l.range.start < section.range.end);
        all.extend(faults(loops.get(from..to).unwrap_or_default(), depth));
        from = to;
    }
    all
}
