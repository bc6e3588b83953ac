// The velocity of the TCP as an arrow: what it is, and where joints are driven by velocities, what was commanded.

import type { Scenery } from "./data";

/** An arrow at the greatest speed is as long as this part of the run's size. */
const LONGEST = 0.45;
/** A step back and forward from a moment, over which a velocity is taken. */
const AROUND = 1;

export class Velocity {
  /** Length of an arrow for each metre in a second \[m s/m\]. */
  private readonly scale: number;

  /** `unit` is the size of the run \[m\]. */
  constructor(
    private readonly replay: Pick<Scenery, "tcp" | "ticks" | "stepS" | "wanted">,
    unit: number,
  ) {
    const { count } = replay.tcp;
    let greatest = 0;
    const at = new Float64Array(3);
    for (let k = 0; k < count; k++) {
      this.actual(at, k);
      greatest = Math.max(greatest, Math.hypot(at[0], at[1], at[2]));
      if (this.wanted(at, k)) greatest = Math.max(greatest, Math.hypot(at[0], at[1], at[2]));
    }
    this.scale = greatest > 0 ? (LONGEST * unit) / greatest : 0;
  }

  /** Writes the velocity at a step \[m/s\]. */
  actual(out: Float64Array, progress: number): void {
    const { ticks, stepS, tcp } = this.replay;
    const step = Math.round(progress);
    const from = Math.max(0, step - AROUND);
    const to = Math.min(tcp.count - 1, step + AROUND);
    const time = (ticks[to] - ticks[from]) * stepS;
    for (let c = 0; c < 3; c++) out[c] = time > 0 ? (tcp.values[3 * to + c] - tcp.values[3 * from + c]) / time : 0;
  }

  /** Writes the velocity that was commanded at a step \[m/s\]; false where none was. */
  wanted(out: Float64Array, progress: number): boolean {
    const { wanted } = this.replay;
    if (!wanted) return false;
    // a command is held until the next
    const step = Math.min(wanted.count - 1, Math.floor(progress + 1e-9));
    for (let c = 0; c < 3; c++) out[c] = wanted.values[3 * step + c];
    return true;
  }

  /** Writes the tip of the arrow of a velocity at a place. */
  tip(out: Float64Array, place: ArrayLike<number>): void {
    for (let c = 0; c < 3; c++) out[c] = place[c] + this.scale * out[c];
  }
}
