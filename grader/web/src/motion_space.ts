// The directions in which an arm can move its TCP at all: a line, a plane or space; and which joints take part.

import { Posture, postures, type Chain } from "./chain";
import { columnsInLab } from "./jacobian";

export interface MotionSpace {
  /** Directions of length 1 at right angles, in the axes of the lab frame: those of the frame itself where they will do. */
  readonly basis: readonly (readonly number[])[];
  /** Joints that move the TCP somewhere. */
  readonly active: readonly number[];
  /** In how many directions at once the TCP can move in most postures. */
  readonly rank: number;
}

const SAMPLES = 24;
/** A part this small of the longest column is none. */
const SMALL = 1e-7;

const dot = (a: readonly number[], b: readonly number[]): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Makes `v` of length 1 and at right angles to `basis`; nothing where less than `least` of it is left. */
function beside(v: readonly number[], basis: readonly (readonly number[])[], least: number): number[] | null {
  let left = [...v];
  // twice, since the first time leaves rounding errors of what it takes away
  for (let pass = 0; pass < 2; pass++) for (const b of basis) left = left.map((x, c) => x - dot(left, b) * b[c]);
  const length = Math.hypot(...left);
  return length > least ? left.map((x) => x / length) : null;
}

/** Directions that span the columns. */
function span(columns: readonly (readonly number[])[], least: number): number[][] {
  const basis: number[][] = [];
  // the longest first: short ones say little of directions
  for (const column of [...columns].sort((a, b) => dot(b, b) - dot(a, a))) {
    const next = basis.length < 3 ? beside(column, basis, least) : null;
    if (next) basis.push(next);
  }
  return basis;
}

export function motionSpace(chain: Chain): MotionSpace {
  const posture = new Posture(chain);
  const samples = postures(chain, SAMPLES).map((q) => columnsInLab(posture.put(q)));
  const longest = Math.max(0, ...samples.flat().map((column) => Math.hypot(...column)));
  const least = SMALL * longest;
  const moves = span(samples.flat(), least);
  // the frame's own axes where they lie in that span, so that a plane is its x and y
  const basis: number[][] = [];
  for (const axis of [[1, 0, 0], [0, 1, 0], [0, 0, 1]]) {
    const inside = axis.map((_, c) => moves.reduce((sum, b) => sum + dot(axis, b) * b[c], 0));
    const next = basis.length < moves.length ? beside(inside, basis, 1e-6) : null;
    // rounding errors of the samples are no direction
    if (next) basis.push(Math.hypot(...next.map((x, c) => x - axis[c])) < 1e-9 ? axis : next);
  }
  return {
    basis,
    active: chain.q.flatMap((_, i) => (samples.some((columns) => Math.hypot(...columns[i]) > least) ? [i] : [])),
    rank: Math.max(0, ...samples.map((columns) => span(columns, least).length)),
  };
}
