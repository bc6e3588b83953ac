// The way from one frame to the next: how much each of the four frames around a moment counts for where something is at it.
// The page's maker takes the same way (report/replay/between.rs) and chose the frames so that it is near the run's everywhere.

import type { Track } from "./track";
import { normalize } from "./pose";

/** One thing's frames, and what those around the moment last asked for count for it. */
export class Way {
  private row = 0;
  private readonly rows = new Int32Array(4);
  private readonly weights = new Float64Array(4);

  /** `ticks` has a tick for every row of the track, in order, and one at least; between them it is `within` of the run \[m or rad\]. */
  constructor(
    readonly ticks: Float64Array,
    readonly track: Track,
    readonly within: number,
  ) {}

  /** The last frame at or before a tick. */
  private find(tick: number): number {
    const ticks = this.ticks;
    const last = ticks.length - 1;
    const row = this.row;
    // while it plays, the frame is the one of before or the next
    if (ticks[row] <= tick && (row === last || tick < ticks[row + 1])) return row;
    if (row < last && ticks[row + 1] <= tick && (row + 1 === last || tick < ticks[row + 2])) return row + 1;
    return lastAt(ticks, tick);
  }

  /**
   * Goes to a tick; before the first frame and after the last, to that. Between two the way is the cubic through them whose slope at each
   * is that of the parabola through a frame and its neighbours; at an end, of the line to its one neighbour.
   */
  at(tick: number): void {
    const { ticks, rows, weights } = this;
    const i = (this.row = this.find(tick));
    const last = ticks.length - 1;
    const k = Math.min(i + 1, last);
    rows[0] = Math.max(i - 1, 0);
    rows[1] = i;
    rows[2] = k;
    rows[3] = Math.min(k + 1, last);
    const step = ticks[k] - ticks[i];
    const f = k > i ? Math.min(1, Math.max(0, (tick - ticks[i]) / step)) : 0;
    const before = ticks[i] - ticks[rows[0]];
    const after = ticks[rows[3]] - ticks[k];
    // how much of a slope is the line between both frames; the rest is the line beyond
    const near = before > 0 ? before / (before + step) : 1;
    const far = after > 0 ? after / (after + step) : 1;
    // the slopes, times the step between both frames
    const lower = before > 0 ? (1 - near) * (step / before) : 0;
    const upper = after > 0 ? (1 - far) * (step / after) : 0;
    const leaving = f * (1 - f) * (1 - f);
    const arriving = -f * f * (1 - f);
    const rise = f * f * (3 - 2 * f);
    weights[0] = -leaving * lower;
    weights[1] = 1 - rise + leaving * (lower - near) - arriving * far;
    weights[2] = rise + leaving * near + arriving * (far - upper);
    weights[3] = arriving * upper;
  }

  /** Whether the moment is a frame's, so that what is shown is what was recorded. */
  get isFrame(): boolean {
    return this.weights[1] === 1 || this.weights[2] === 1;
  }

  /** Column `c` at the moment. */
  number(c: number): number {
    const { rows, weights } = this;
    const { values, width } = this.track;
    return (
      weights[0] * values[rows[0] * width + c] +
      weights[1] * values[rows[1] * width + c] +
      weights[2] * values[rows[2] * width + c] +
      weights[3] * values[rows[3] * width + c]
    );
  }

  /** Writes the pose at the moment, of a track of poses whose quaternions do not change sign from row to row. */
  pose(out: Float64Array, o: number): void {
    for (let c = 0; c < 7; c++) out[o + c] = this.number(c);
    normalize(out, o);
  }
}

/** The row of the last of `ticks` at or before `tick`; the first where there is none. */
export function lastAt(ticks: Float64Array, tick: number): number {
  let low = 0;
  let high = ticks.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (ticks[middle] <= tick) low = middle;
    else high = middle - 1;
  }
  return low;
}
