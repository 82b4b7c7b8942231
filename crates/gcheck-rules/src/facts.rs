//! What rules know of machining together: one module a subject, each free of any rule.
//!
//! Knows: the list of subjects. Must not know: any rule, wording of findings. A module here is used by several rules, or holds
//! what a rule would otherwise have to take from another rule.

pub(crate) mod arcs;
pub(crate) mod bar_feed;
pub(crate) mod beside;
pub(crate) mod block_delete;
pub(crate) mod boundary;
pub(crate) mod broaching;
pub(crate) mod callers;
pub(crate) mod cancelled_length;
pub(crate) mod compensation;
pub(crate) mod computed_words;
pub(crate) mod coolant;
pub(crate) mod cuts;
pub(crate) mod cutting;
pub(crate) mod cycles;
pub(crate) mod depth;
pub(crate) mod do_loops;
pub(crate) mod dwell;
pub(crate) mod earlier_rates;
pub(crate) mod edge;
pub(crate) mod empty_variables;
pub(crate) mod feed;
pub(crate) mod five_axis;
pub(crate) mod lasting;
pub(crate) mod live_tool;
pub(crate) mod loop_conditions;
pub(crate) mod mode_left_on;
pub(crate) mod modes;
pub(crate) mod notation;
pub(crate) mod offset_schemes;
pub(crate) mod parting;
pub(crate) mod past_alarm;
pub(crate) mod pockets;
pub(crate) mod probing;
pub(crate) mod program_calls;
pub(crate) mod program_numbers;
pub(crate) mod reach;
pub(crate) mod second_spindle;
pub(crate) mod sections;
pub(crate) mod shared_list;
pub(crate) mod smoothing;
pub(crate) mod thread_cycles;
pub(crate) mod thread_passes;
pub(crate) mod threads;
pub(crate) mod tool_comment;
pub(crate) mod tool_words;
pub(crate) mod turned;
pub(crate) mod turned_backwards;
pub(crate) mod turning;
pub(crate) mod units;
pub(crate) mod usage;
pub(crate) mod word_sets;
pub(crate) mod work_offset;
pub(crate) mod workholding;
