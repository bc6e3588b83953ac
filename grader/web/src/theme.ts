// The colours of the replay, for light and dark; those of lines are the plots' own, so that a colour means one thing on the page.

import type { NodeKind } from "./data";

export interface Theme {
  readonly link: readonly [base: string, odd: string, even: string];
  /** What is around every shape. */
  readonly edge: string;
  readonly fixed: string;
  readonly driven: string;
  readonly free: string;
  readonly ghost: string;
  readonly trail: string;
  /** The trail where the path to follow was left. */
  readonly left: string;
  /** The trail where it is still to come. */
  readonly future: string;
  readonly reference: string;
  readonly goal: string;
  readonly contact: string;
  /** The velocity of the TCP, and that which was commanded. */
  readonly velocity: string;
  readonly wanted: string;
  readonly path: string;
  readonly axes: readonly [x: string, y: string, z: string];
  readonly grid: string;
  readonly sky: string;
  readonly earth: string;
  /** Strength of the light from everywhere, and of the sun. */
  readonly light: readonly [everywhere: number, sun: number];
  readonly shadow: number;
}

export const LIGHT: Theme = {
  link: ["#5d6b7d", "#8ba4c0", "#c6d2df"],
  edge: "#566375",
  fixed: "#c3b297",
  driven: "#86aa9d",
  free: "#e0b040",
  ghost: "#9e4a80",
  trail: "#006cae",
  left: "#be1e2d",
  future: "#4a90c2",
  reference: "#9e4a80",
  goal: "#007e5c",
  contact: "#c65200",
  velocity: "#1c222c",
  wanted: "#926400",
  path: "#007e5c",
  axes: ["#c8102e", "#007e3a", "#1f4fd8"],
  grid: "#8a96a5",
  sky: "#ffffff",
  earth: "#b9b2a8",
  light: [1.9, 2.0],
  shadow: 0.2,
};

export const DARK: Theme = {
  link: ["#5f6d80", "#7d9ac0", "#b6c4d4"],
  edge: "#8794a5",
  fixed: "#8f8069",
  driven: "#5f8f80",
  free: "#d2a338",
  ghost: "#e69cc8",
  trail: "#62b8f0",
  left: "#ff787d",
  future: "#487a9b",
  reference: "#e69cc8",
  goal: "#38c89c",
  contact: "#ff9452",
  velocity: "#e8ebf0",
  wanted: "#e2b240",
  path: "#38c89c",
  axes: ["#ff7a85", "#5fd38a", "#86a8ff"],
  grid: "#5b6675",
  sky: "#e6eefc",
  earth: "#2a2f38",
  light: [1.3, 2.0],
  shadow: 0.45,
};

const dark = matchMedia("(prefers-color-scheme: dark)");

export const theme = (): Theme => (dark.matches ? DARK : LIGHT);

/** Calls when the page turns light or dark, until what it returns is called. */
export function onTheme(listener: () => void): () => void {
  dark.addEventListener("change", listener);
  return () => dark.removeEventListener("change", listener);
}

/** Which colour each node has, by its place in the list: the links take turns, so that each differs from the next. */
export function turns(nodes: ReadonlyArray<{ readonly kind: NodeKind }>): Turn[] {
  let links = 0;
  return nodes.map(({ kind }) => (kind === "link" ? turn(links++) : kind));
}

/** Of the links, the first has a colour of its own. */
export function turn(order: number): "base" | "odd" | "even" {
  return order === 0 ? "base" : order % 2 === 1 ? "odd" : "even";
}

export type Turn = ReturnType<typeof turn> | Exclude<NodeKind, "link">;

export function colourOf(theme: Theme, turn: Turn): string {
  const place = ["base", "odd", "even"].indexOf(turn);
  return place < 0 ? theme[turn as Exclude<NodeKind, "link">] : theme.link[place];
}
