//! Law 2: blocks from the tree are the blocks from the tokens.
//!
//! Knows: block tables. Must not know: what is made of them.

use gcheck_program::{Dialect, Loaded, ToolNames, lower, lower_tree};
use gcheck_syntax::parse;

use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let case = programs::case(bytes);
    let dialect = Dialect::new(case.control);
    let flat = lower(&case.text, &dialect);
    let tree = lower_tree(&parse(&case.text, dialect.profile()), &case.text, &dialect);
    // A label that is not a number is held as NaN, which equals nothing, itself neither; as text it does.
    if flat != tree {
        assert_eq!(format!("{flat:?}"), format!("{tree:?}"), "the tree and the tokens give the same blocks");
    }
    let mut tools = ToolNames::new(case.control);
    let loaded = Loaded::new(&case.text, &dialect, |_, table, text| tools.look(table, text));
    let blocks = loaded.flow_graph().blocks();
    for block in 0..blocks {
        assert!(loaded.place(block, &dialect).is_some(), "block {block} of {blocks} has a place");
    }
}
