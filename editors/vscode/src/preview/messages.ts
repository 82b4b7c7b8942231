// What the extension and the page of the preview say to each other.

import type { Drawing } from "gcheck-viewer";

/** The server's answer to `gcheck/toolpath`. */
export interface Toolpath {
  drawing: Drawing;
  /** How the run ended, when it did not come to its end. */
  remark: string | null;
  /** Moves of the run; more than are drawn when it was thinned. */
  moves: number;
  /** Travel limits of the machine in work coordinates, millimetres, where they are known. */
  travel: [number[], number[]] | null;
}

export type ToPage =
  | { kind: "toolpath"; name: string; toolpath: Toolpath }
  | { kind: "nothing"; why: string }
  | { kind: "lines"; first: number; last: number };

export type FromPage =
  | { kind: "ready" }
  | { kind: "line"; file: string; line: number }
  /** For tests: what is drawn. */
  | { kind: "drawn"; pieces: number };
