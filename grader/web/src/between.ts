// The way from one frame to the next: how much each of the four frames around a moment counts for where everything is at it.

import type { Track } from "./track";
import { normalize } from "./pose";

/** Of four frames around a moment, the rows and what each counts for; the moment lies between the second and the third. */
export interface Blend {
  readonly rows: Int32Array;
  readonly weights: Float64Array;
}

export function blend(): Blend {
  return { rows: new Int32Array(4), weights: new Float64Array(4) };
}

/**
 * Sets a blend for `tick`, which is not before row `i` of `ticks` and not after the next.
 *
 * Straight, the two frames beside it count. Else the way is the cubic through these two whose slope at each is that of the parabola
 * through a frame and its neighbours (at an end, of the line to its one neighbour): what is smooth is met far better between frames
 * far from each other, and what has a kink worse.
 */
export function setBlend(out: Blend, ticks: Float64Array, i: number, tick: number, straight: boolean): void {
  const { rows, weights } = out;
  const last = ticks.length - 1;
  const k = Math.min(i + 1, last);
  rows[0] = Math.max(i - 1, 0);
  rows[1] = i;
  rows[2] = k;
  rows[3] = Math.min(k + 1, last);
  const step = ticks[k] - ticks[i];
  const f = k > i ? Math.min(1, Math.max(0, (tick - ticks[i]) / step)) : 0;
  if (straight || k === i) {
    weights[0] = weights[3] = 0;
    weights[1] = 1 - f;
    weights[2] = f;
    return;
  }
  const before = ticks[i] - ticks[rows[0]];
  const after = ticks[rows[3]] - ticks[k];
  // how much of a slope is the line between both frames, the rest is the line beyond
  const near = before > 0 ? before / (before + step) : 1;
  const far = after > 0 ? after / (after + step) : 1;
  const leaving = f * (1 - f) * (1 - f);
  const arriving = -f * f * (1 - f);
  // the slopes, times the step between both frames
  const lower = before > 0 ? (1 - near) * (step / before) : 0;
  const upper = after > 0 ? (1 - far) * (step / after) : 0;
  const rise = f * f * (3 - 2 * f);
  weights[0] = -leaving * lower;
  weights[1] = 1 - rise + leaving * (lower - near) - arriving * far;
  weights[2] = rise + leaving * near + arriving * (far - upper);
  weights[3] = arriving * upper;
}

/** The number of column `c` of a track at a blend. */
export function blended(track: Track, c: number, { rows, weights }: Blend): number {
  const { values, width } = track;
  return (
    weights[0] * values[rows[0] * width + c] +
    weights[1] * values[rows[1] * width + c] +
    weights[2] * values[rows[2] * width + c] +
    weights[3] * values[rows[3] * width + c]
  );
}

/** Writes the pose of a track of poses at a blend. Of a turn and its negative, which are the same, the one near the second frame's counts. */
export function blendedPose(out: Float64Array, o: number, track: Track, { rows, weights }: Blend): void {
  const { values } = track;
  const near = 7 * rows[1];
  for (let c = 0; c < 7; c++) out[o + c] = 0;
  for (let r = 0; r < 4; r++) {
    const weight = weights[r];
    if (weight === 0) continue;
    const at = 7 * rows[r];
    const dot =
      values[at + 3] * values[near + 3] + values[at + 4] * values[near + 4] + values[at + 5] * values[near + 5] + values[at + 6] * values[near + 6];
    const turn = dot < 0 ? -weight : weight;
    for (let c = 0; c < 3; c++) out[o + c] += weight * values[at + c];
    for (let c = 3; c < 7; c++) out[o + c] += turn * values[at + c];
  }
  normalize(out, o);
}
