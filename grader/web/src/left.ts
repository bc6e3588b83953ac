// Where the path to follow was left: farther from it than earns all points, after the TCP came onto it and before it came to its end.

import type { Path, Scenery } from "./data";

/** Writes the point of a path that is nearest to a point, and returns how far it is \[m\]. */
export function nearest(out: Float64Array, path: Path, p: ArrayLike<number>, o = 0): number {
  let best = Infinity;
  const { points } = path;
  for (let i = 0; i < points.length; i++) {
    const a = points[i];
    const b = points[Math.min(i + 1, points.length - 1)];
    const along = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    const square = along[0] ** 2 + along[1] ** 2 + along[2] ** 2;
    const share = square > 0 ? ((p[o] - a[0]) * along[0] + (p[o + 1] - a[1]) * along[1] + (p[o + 2] - a[2]) * along[2]) / square : 0;
    const f = Math.min(1, Math.max(0, share));
    const at = [a[0] + f * along[0], a[1] + f * along[1], a[2] + f * along[2]];
    const far = Math.hypot(p[o] - at[0], p[o + 1] - at[1], p[o + 2] - at[2]);
    if (far < best) {
      best = far;
      out.set(at);
    }
  }
  return best;
}

/** A path of a run that was left, and at which steps the TCP was off it. */
export interface Left {
  readonly path: Path;
  readonly full: number;
  readonly off: Uint8Array;
}

/** The paths with a tolerance that the TCP left. */
export function left(replay: Scenery): Left[] {
  const { values, count } = replay.tcp;
  const spot = new Float64Array(3);
  const out: Left[] = [];
  for (const path of replay.paths) {
    const { full, points } = path;
    if (full === null || !(full > 0) || points.length < 2) continue;
    const last = points[points.length - 1];
    const off = new Uint8Array(count);
    let on = false;
    let away = false;
    let some = false;
    for (let k = 0; k < count; k++) {
      const far = nearest(spot, path, values, 3 * k);
      on ||= far <= full;
      // who came to the end of the path has followed it; a path that ends where it begins has its end only later
      away ||= on && Math.hypot(spot[0] - last[0], spot[1] - last[1], spot[2] - last[2]) > 2 * full;
      if (away && far <= full && Math.hypot(spot[0] - last[0], spot[1] - last[1], spot[2] - last[2]) < full) break;
      if (on && far > full) some = !!(off[k] = 1);
    }
    if (some) out.push({ path, full, off });
  }
  return out;
}

/** The path that is off at a step, or null. */
export function offAt(all: readonly Left[], progress: number): Left | null {
  const step = Math.round(progress);
  for (const one of all) if (one.off[Math.min(one.off.length - 1, step)]) return one;
  return null;
}
