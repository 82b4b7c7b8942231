//! Laws of the whole, as tests: see `tests/`. This library is empty on purpose.
//!
//! Knows: nothing. The package exists so that tests over several crates have a home that no crate depends on.
