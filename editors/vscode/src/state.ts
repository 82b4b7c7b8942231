// The state at the cursor as text: what `gcheck/stateAt` answers, in lines that people read.

/** A place in the program, lines and columns from 0. */
interface Place {
  line: number;
  character: number;
}

/** A point by axis; `null` where it is not known. */
export type Axes = Record<string, number | null>;

/** The state before or after a block; the server's documentation says what each part is. */
export interface Side {
  units: string;
  diameter: boolean;
  modes: { group: string; codes: string[]; setAt: Place | null }[];
  feed: string | null;
  speed: string | null;
  spindle: string;
  tool: string | null;
  toolIs: { name: string | null; length: number | null; diameter: number | null } | null;
  surfaceSpeed: string | null;
  chipLoad: string | null;
  selectedTool: string | null;
  lengthOffset: string | null;
  cutterOffset: string | null;
  workOffset: string | null;
  origin: Axes;
  programmed: Axes;
  work: Axes;
  machine: Axes;
  tip: Axes;
  length: Axes;
  shift: Axes;
  variables: { name: string; value: string }[];
}

/** The server's answer. */
export interface State {
  line: number;
  onEveryPath: boolean;
  visits: number;
  /** What the state rests on that nobody can know. */
  assumed: string | null;
  /** The blocks that call the program of the block, lines from 1; an empty file is the program itself. */
  calls: { text: string; file: string; line: number }[];
  before: Side;
  after: Side | null;
}

/** The state around a block as a page of plain text; `block` is the block's text. */
export function stateText(state: State, block: string): string {
  const times = state.visits > 1 ? `, ${state.visits} times` : "";
  const way = state.onEveryPath ? `every path comes here${times}` : `some paths come here${times}`;
  const head = [`line ${state.line + 1}: ${block}`, way, ...(state.assumed === null ? [] : [state.assumed])];
  const after =
    state.after === null ? ["", "AFTER", "the program does not go on from here"] : ["", "AFTER", ...side(state.after)];
  return [...head, "", "BEFORE", ...side(state.before), ...after, ""].join("\n");
}

function side(state: Side): string[] {
  const units = state.diameter ? `${state.units}, X as a diameter` : state.units;
  const rows: [string, string | null][] = [
    ["units", units],
    ["position, work", pointText(state.work)],
    ["position, programmed", differs(state.programmed, state.work)],
    ["position, machine", pointText(state.machine)],
    ["position, tool tip", differs(state.tip, state.work)],
    ["work offset", state.workOffset && [state.workOffset, pointText(state.origin)].filter(Boolean).join(" at ")],
    ["shift", nonZero(state.shift)],
    ["tool", state.tool && [state.tool, state.toolIs?.name].filter(Boolean).join(" ")],
    ["tool called for", state.selectedTool],
    ["length offset", state.lengthOffset && `H${state.lengthOffset}`],
    ["length in effect", nonZero(state.length)],
    ["cutter offset", state.cutterOffset && `D${state.cutterOffset}`],
    ["feed", state.feed && [state.feed, state.chipLoad].filter(Boolean).join(", ")],
    ["speed", state.speed && [state.speed, state.surfaceSpeed].filter(Boolean).join(", ")],
    ["spindle", state.spindle],
  ];
  const modes = state.modes.map(({ group, codes, setAt }): [string, string] => [
    codes.join(" or "),
    setAt === null ? group : `${group}, set in line ${setAt.line + 1}`,
  ]);
  const variables = state.variables.map(({ name, value }): [string, string] => [name, value]);
  return [...table(rows), "", ...table(modes), ...(variables.length > 0 ? ["", ...table(variables)] : [])];
}

/** Rows with their second column in line; those without a value are left out. */
function table(rows: [string, string | null][]): string[] {
  const told = rows.filter((row): row is [string, string] => row[1] !== null && row[1] !== "");
  const width = Math.max(...told.map(([name]) => name.length), 0);
  return told.map(([name, value]) => `${name.padEnd(width)}  ${value}`);
}

export function pointText(axes: Axes): string {
  return Object.entries(axes)
    .filter(([, value]) => value !== null)
    .map(([axis, value]) => `${axis}${value}`)
    .join(" ");
}

function differs(axes: Axes, from: Axes): string | null {
  const text = pointText(axes);
  return text === pointText(from) ? null : text;
}

function nonZero(axes: Axes): string | null {
  return pointText(Object.fromEntries(Object.entries(axes).filter(([, value]) => value !== 0)));
}
