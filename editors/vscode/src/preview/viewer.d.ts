// The viewer that `gcheck plot` and the preview share: crates/gcheck-toolpath/src/plot/viewer.js says what its data means.

declare module "gcheck-viewer" {
  export interface Tool {
    number: number | null;
    name: string | null;
    color: string;
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
    seconds: number;
  }

  export interface Callbacks {
    onPick?(place: Place | null): void;
    onProgress?(place: Place): void;
    onPlay?(isPlaying: boolean): void;
  }

  export interface Viewer {
    setView(name: string): void;
    fit(): void;
    select(file: number | null, first?: number, last?: number): void;
    goTo(piece: number): void;
    goToTime(seconds: number): void;
    step(by: number): void;
    stepBlock(by: number): void;
    stepTool(by: number): void;
    play(): void;
    pause(): void;
    setSpeed(factor: number): void;
    showRapids(yes: boolean): void;
    showTool(index: number, yes: boolean): void;
    setTheme(theme: Record<string, string>): void;
    setData(data: Drawing): void;
    draw(): void;
    destroy(): void;
    place(): Place | null;
    pieces(): number;
    duration(): number;
    isPlaying(): boolean;
  }

  export const KIND: Record<"START" | "RAPID" | "FEED" | "ARC" | "PROBE" | "SPINDLE", number>;
  export const THEMES: Record<"dark" | "light", Record<string, string>>;
  export function lengthText(mm: number, units: "mm" | "inch"): string;
  export function createViewer(canvas: HTMLCanvasElement, data: Drawing, callbacks?: Callbacks): Viewer;
}
