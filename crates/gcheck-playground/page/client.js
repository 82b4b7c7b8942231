// The worker, as the page sees it: questions have answers, or errors with words, and a worker that fails is replaced.
//
// Knows: messages, how long a question may take. Must not know: what is asked, the page.

/** Milliseconds that a question may take. */
export const PATIENCE = 10000;

/** A later question of its kind took the place of this one. */
export class Superseded extends Error {}

/**
 * Loads the module and starts a worker; `ready` is what the worker tells of itself.
 *
 * One question is under way at a time, and of those that wait the last of each kind stays, so that a reader who types never
 * waits for what he has changed.
 */
export async function createClient() {
  const module = await load(new URL("gcheck_bg.wasm", import.meta.url));
  const waiting = [];
  let worker = null, current = null, ready = null, next = 1, timer = 0;

  function start() {
    const fresh = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker = fresh;
    ready = new Promise((resolve, reject) => {
      fresh.addEventListener("message", ({ data }) => {
        if (fresh !== worker) return;
        if (data.ready) { resolve(data.ready); return; }
        if (data.id !== current?.id) return;
        if (data.panic !== undefined) {
          fail(`gcheck has a mistake and stopped at this program:\n${data.panic}`);
        } else if (data.refused !== undefined) {
          end().reject(new Error(data.refused));
        } else {
          end().resolve({ answer: data.answer, took: data.took });
        }
      });
      fresh.addEventListener("error", (event) => {
        event.preventDefault();
        if (fresh !== worker) return;
        const words = `The worker of the page failed: ${event.message ?? "it cannot be loaded"}`;
        reject(new Error(words));
        if (current) fail(words);
      });
    });
    // Who asks first sees it; a worker that nobody asks need not complain.
    ready.catch(() => {});
    fresh.postMessage({ module });
  }

  function end() {
    clearTimeout(timer);
    const ended = current;
    current = null;
    queueMicrotask(go);
    return ended;
  }

  /** Ends the worker with the question under way, and starts another one. */
  function fail(words) {
    worker.terminate();
    start();
    end()?.reject(new Error(words));
  }

  async function go() {
    if (current || !waiting.length) return;
    current = waiting.shift();
    const asked = current, of = worker;
    try {
      await ready;
    } catch (error) {
      if (current === asked) end().reject(error);
      return;
    }
    if (current !== asked || of !== worker) return;
    timer = setTimeout(() => {
      fail(`gcheck took longer than ${PATIENCE / 1000} seconds for this program, and was stopped. On your own machine \`gcheck check\` has no such limit.`);
    }, PATIENCE);
    of.postMessage({ ...asked.question, id: asked.id, ask: asked.ask });
  }

  start();
  return {
    ready: await ready,
    /** Asks; the answer is a promise of { answer, took }, with milliseconds. */
    ask(ask, question = {}) {
      return new Promise((resolve, reject) => {
        const at = waiting.findIndex((other) => other.ask === ask);
        if (at >= 0) waiting.splice(at, 1)[0].reject(new Superseded(ask));
        waiting.push({ id: next++, ask, question, resolve, reject });
        go();
      });
    },
  };
}

async function load(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${address.pathname.split("/").pop()} cannot be loaded: ${response.status}`);
  const isTyped = response.headers.get("content-type")?.startsWith("application/wasm");
  // Some servers do not know the type, and browsers insist on it only where they compile while they load.
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}
