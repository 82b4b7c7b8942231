//! What holds for all rules together, with the rules as they are.
//!
//! Knows: the table of rules. Must not know: a rule by itself; that is tested in the rule's file.

mod computed;
mod edited_is_fresh;
mod empty_words;
mod every_rule;
mod faults;
mod missing_programs;
mod one_condition;
mod past_alarms;
mod proposed_fixes;
mod syntax_errors;
