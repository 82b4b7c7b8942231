// Answers questions about a program, away from the page, so that the page never waits.
//
// Knows: the module. Must not know: the page.
//
// The first message has the compiled module; each later one is a question { id, ask, … }. An answer is { id, answer },
// { id, refused: words } or { id, panic: words }. After a panic nothing here can be trusted, and the page ends it.

import { Playground, controls, initSync, last_panic, limits, panic_on_purpose } from "./gcheck.js";

let playground = null;

const ASKED = {
  check: ({ text, control }) => playground.check(text, control),
  hover: ({ text, control, line, column }) => playground.hover(text, control, line, column),
  toolpath: ({ text, control }) => playground.toolpath(text, control),
  panic: () => panic_on_purpose(),
};

addEventListener("message", ({ data }) => {
  if (data.module) {
    initSync({ module: data.module });
    playground = new Playground();
    postMessage({ ready: { controls: JSON.parse(controls()), limits: JSON.parse(limits()) } });
    return;
  }
  const { id, ask } = data, began = performance.now();
  try {
    const answer = JSON.parse(ASKED[ask](data));
    postMessage({ id, answer, took: performance.now() - began });
  } catch (error) {
    // A trap is a panic, and so is a stack that is used up; what is refused has words of its own.
    const isPanic = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
    if (!isPanic) { postMessage({ id, refused: error.message }); return; }
    let words = "";
    try { words = last_panic(); } catch { /* The trap's own words are left. */ }
    postMessage({ id, panic: words || error.message });
  }
});
