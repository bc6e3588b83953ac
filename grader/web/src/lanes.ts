// Which marks of events are drawn and how high: none hides another kind of event at the same moment.

import type { EventKind } from "./data";

export interface Placed {
  readonly kind: EventKind;
  /** Place along the line \[px\]. */
  readonly x: number;
  /** 0 is the lowest. */
  readonly lane: number;
}

/** Width of a mark \[px\]. */
export const MARK = 12;
/** Two marks of a kind closer than this are one \[px\]. */
const SAME = 4;
const MOST_LANES = 3;

/** The worse comes first: where there is no room for all, it stays. */
const WORSE: readonly EventKind[] = ["stop", "breach", "fell", "contact", "limit", "saturation", "other"];

/** Lays marks, in order of x, into lanes. Where more kinds meet than there are lanes, the mildest is left out. */
export function lanes(events: ReadonlyArray<{ readonly kind: EventKind; readonly x: number }>): Placed[] {
  const worse = (a: EventKind, b: EventKind): number => WORSE.indexOf(a) - WORSE.indexOf(b);
  const sorted = [...events].sort((a, b) => a.x - b.x || worse(a.kind, b.kind));
  const out: Placed[] = [];
  // the last mark of each lane, as its place in what goes out
  const last: number[] = [];
  for (const { kind, x } of sorted) {
    const near = last.map((at) => x - out[at].x < MARK);
    const alike = last.findIndex((at, lane) => near[lane] && out[at].kind === kind);
    if (alike >= 0 && x - out[last[alike]].x < SAME) continue;
    let lane = alike >= 0 ? alike : near.indexOf(false);
    if (lane < 0 && last.length < MOST_LANES) lane = last.length;
    if (lane < 0) {
      const mildest = last.reduce((a, b, i) => (worse(out[last[a]].kind, out[b].kind) < 0 ? i : a), 0);
      if (worse(kind, out[last[mildest]].kind) < 0) out[last[mildest]] = { kind, x, lane: mildest };
      continue;
    }
    last[lane] = out.push({ kind, x, lane }) - 1;
  }
  return out;
}
