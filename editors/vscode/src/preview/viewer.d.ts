// The viewer and the panel that `gcheck plot` and the preview share: crates/gcheck-toolpath/src/plot/viewer.js says what the
// data mean.

declare module "gcheck-viewer" {
  export interface Tool {
    number: number | null;
    name: string | null;
    color: string;
  }

  /** How fast the tool and the spindle go; what is unknown is null. */
  export interface Drive {
    feed: number | null;
    mode: "minute" | "turn" | "inverse";
    along: number | null;
    rpm: number | null;
  }

  /** Arrays come as base64. */
  export interface Drawing {
    version: number;
    units: "mm" | "inch";
    lathe: boolean;
    diameter: boolean;
    tools: Tool[];
    files: string[];
    count: number;
    points: string;
    seconds: string;
    lines: string;
    kinds: string;
    toolOf: string;
    fileOf: string | null;
    driveOf: string | null;
    drives: Drive[];
    callOf?: string | null;
    calls?: [number, number][][];
    rotary: { axes: string; values: string } | null;
    headings?: { file: number; line: number; name: string }[];
    changes?: [number, number][];
    thinned: boolean;
    cut: [number[], number[]] | null;
    all: [number[], number[]] | null;
    alarms?: { file: number; line: number; at: [number, number, number] | null }[];
  }

  export interface Place {
    piece: number;
    file: number;
    line: number;
    kind: number;
    tool: Tool | null;
    point: [number, number, number];
    angles: { axis: string; degrees: number }[];
    seconds: number;
    drive: Drive | null;
  }

  /** What is measured; `rows` once two places are picked. */
  export interface Measured {
    isOn: boolean;
    picks: { is: string; words: string; text: string }[];
    rows: { name: string; value: string }[];
  }

  export interface Callbacks {
    onPick?(place: Place | null): void;
    onProgress?(place: Place): void;
    onPlay?(isPlaying: boolean): void;
    onMeasure?(state: Measured): void;
    onLook?(): void;
  }

  export interface Viewer {
    setView(name: string): void;
    fit(): void;
    fitSelection(): boolean;
    select(file: number | null, first?: number, last?: number): void;
    setMarks(marks: { file: number; line: number; severity: string }[]): void;
    goTo(piece: number): void;
    goToTime(seconds: number): void;
    step(by: number): void;
    stepBlock(by: number): void;
    stepTool(by: number): void;
    stepOperation(by: number): void;
    play(): void;
    pause(): void;
    setSpeed(factor: number): void;
    setTheme(theme: Record<string, string | number>): void;
    setData(data: Drawing, how?: { keep?: boolean; former?: boolean }): void;
    clear(): void;
    draw(): void;
    destroy(): void;
    place(): Place | null;
    pieces(): number;
    duration(): number;
    isPlaying(): boolean;
    measure: { state(): Measured; start(): void; stop(): void; toggle(): void; take(is: string): boolean };
  }

  export const THEMES: Record<"dark" | "light" | "contrast" | "contrastLight", Record<string, string | number>>;
  export function lengthText(mm: number, units: "mm" | "inch"): string;
  export function timeText(seconds: number): string;
  export function placeText(data: Drawing, place: Place, duration: number): { is: string; words: string }[];
  export function speedsFor(duration: number): { factor: number; words: string; usual: boolean }[];
  export function createViewer(canvas: HTMLCanvasElement, data: Drawing, callbacks?: Callbacks): Viewer;
}

declare module "gcheck-panel" {
  import type { Measured, Viewer } from "gcheck-viewer";

  export interface Panel {
    refresh(wanted?: { keep: boolean }): void;
    look(): void;
    measured(state: Measured): void;
    toggleRapids(): void;
  }

  export function createPanel(
    host: HTMLElement,
    viewer: Viewer,
    how: { save(name: string, blob: Blob): Promise<void> | void; hasFormer?: boolean; turned?(): void },
  ): Panel;
}
