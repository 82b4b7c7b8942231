//! The module as JavaScript sees it: answers are JSON, and what cannot be answered is an exception with words for the page.
//!
//! Knows: wasm-bindgen. Must not know: what is asked.

use std::panic;
use std::sync::{Mutex, PoisonError};

use serde::Serialize;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::place::Place;
use crate::session::{MAX_BLOCKS, MAX_FINDINGS, MAX_TEXT, Session};

/// Words of the last panic: a trap in a browser has none.
static LAST_PANIC: Mutex<String> = Mutex::new(String::new());

/// A [`Session`] for JavaScript.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Playground {
    session: Session,
}

#[wasm_bindgen]
impl Playground {
    /// Without a program.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        panic::set_hook(Box::new(|panic| {
            *LAST_PANIC.lock().unwrap_or_else(PoisonError::into_inner) = panic.to_string();
        }));
        Self::default()
    }

    /// [`Session::check`], as JSON of [`crate::Findings`].
    pub fn check(&mut self, text: &str, control: &str) -> Result<String, JsError> {
        json(&self.session.check(text, control)?)
    }

    /// [`Session::hover`], as JSON of [`crate::Shown`] or `null`.
    pub fn hover(&mut self, text: &str, control: &str, line: u32, column: u32) -> Result<String, JsError> {
        json(&self.session.hover(text, control, Place { line, column })?)
    }

    /// [`Session::toolpath`], as JSON of [`gcheck_ide::Toolpath`].
    pub fn toolpath(&mut self, text: &str, control: &str) -> Result<String, JsError> {
        json(&self.session.toolpath(text, control)?)
    }
}

/// [`Session::controls`], as JSON.
#[wasm_bindgen]
pub fn controls() -> Result<String, JsError> {
    json(&Session::controls())
}

/// What the playground is limited to, as JSON.
#[wasm_bindgen]
pub fn limits() -> Result<String, JsError> {
    #[derive(Serialize)]
    struct Limits {
        text: usize,
        findings: usize,
        blocks: u64,
    }
    json(&Limits { text: MAX_TEXT, findings: MAX_FINDINGS, blocks: MAX_BLOCKS })
}

/// What the last panic said; empty when there was none.
#[wasm_bindgen]
pub fn last_panic() -> String {
    LAST_PANIC.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// For the test that the page goes on after a panic.
///
/// # Panics
/// Always.
#[wasm_bindgen]
pub fn panic_on_purpose() {
    panic!("on purpose");
}

fn json(answer: &impl Serialize) -> Result<String, JsError> {
    Ok(serde_json::to_string(answer)?)
}
