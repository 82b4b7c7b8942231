// What the extension and the page of the preview say to each other.

import type { Drawing } from "gcheck-viewer";

/** The server's answer to `gcheck/toolpath`. */
export interface Toolpath {
  data: Drawing;
  /** Moves of the run; more than are drawn when it was thinned. */
  moves: number;
  /** Seconds, as far as they are known. */
  seconds: number;
  /** What a reader of the picture has to know. */
  notes: Note[];
  /** Lowest and highest machine coordinates of X, Y and Z, where the machine's travel is told: millimetres. */
  travel: ([number, number] | null)[];
  /** How the run ended, where it did not reach the program's end. */
  stopped: string | null;
  /** Where the control would stop, and decisions that nobody knows: the picture goes on after them. */
  alarms: Alarm[];
}

/** What a reader of the picture has to know, and the block that it speaks of. */
export interface Note {
  words: string;
  /** The file; empty for the document, null where it speaks of no block. */
  file: string | null;
  /** Its line, from 1. */
  line: number | null;
}

/** A block that the picture goes past. */
export interface Alarm {
  /** The file; empty for the document. */
  file: string;
  /** Its line, from 1. */
  line: number;
  /** What the picture does there, in a few words. */
  words: string;
}

export type ToPage =
  /** The path of the program with this address. */
  | { kind: "toolpath"; uri: string; toolpath: Toolpath }
  | { kind: "nothing"; why: string; alarms: Alarm[]; notes: Note[] }
  | { kind: "lines"; first: number; last: number };

export type FromPage =
  | { kind: "ready" }
  | { kind: "line"; file: string; line: number }
  /** The tool of a run that is played or stepped is at this line. */
  | { kind: "at"; file: string; line: number }
  /** A picture of the view, to be saved. */
  | { kind: "save"; name: string; bytes: Uint8Array }
  /** For tests: what is drawn. */
  | { kind: "drawn"; pieces: number; alarms: number };
