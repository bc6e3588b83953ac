// The stretches of a judged curve that lie beyond what earns all points.

import type { Piece } from "./curve";

/** Stretches nearer to each other than this are one, in units of the picture. */
const NEAR = 6;
const MOST = 200;

/** From where to where, across, some piece of a curve lies beyond a height; upwards, where y is less, or downwards. */
export function beyond(curve: readonly Piece[], height: number, upwards: boolean): Array<[from: number, to: number]> {
  const out: Array<[number, number]> = [];
  const over = (y: number): number => (upwards ? height - y : y - height);
  for (const { x, y } of curve) {
    for (let i = 0; i + 1 < x.length; i++) {
      const [a, b] = [over(y[i]), over(y[i + 1])];
      if (a <= 1 && b <= 1) continue;
      // where it goes through the height
      const cut = x[i] + (a === b ? 0 : a / (a - b)) * (x[i + 1] - x[i]);
      const ends = [a > 0 ? x[i] : cut, b > 0 ? x[i + 1] : cut];
      out.push([Math.min(...ends), Math.max(...ends)]);
    }
  }
  out.sort((a, b) => a[0] - b[0]);
  const merged: Array<[number, number]> = [];
  for (const [from, to] of out) {
    const last = merged[merged.length - 1];
    if (last && from <= last[1] + NEAR) last[1] = Math.max(last[1], to);
    else merged.push([from, to]);
  }
  return merged.slice(0, MOST);
}
