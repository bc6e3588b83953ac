// What is read off a plot, in words that claim no more than the drawing shows.

import type { Span } from "./curve";
import { fixed } from "./words";

/** How heights of a panel are values. */
export interface Scale {
  /** Heights of the foot and of the top, y downwards. */
  readonly foot: number;
  readonly top: number;
  /** Values there. */
  readonly low: number;
  readonly high: number;
  /** Whether equal ways up are equal ratios. */
  readonly log: boolean;
}

export interface Doubt {
  /** How far above or below what is drawn a value may lie, in units of the picture. */
  readonly off: number;
  /** The size at which values are cut off. */
  readonly cut?: number | undefined;
}

/** A way up that reads as from one value to another, in units of the picture: a pixel. */
const WIDE = 10;

function value(scale: Scale, at: number): number {
  const share = (scale.foot - at) / (scale.foot - scale.top);
  return scale.log ? scale.low * (scale.high / scale.low) ** share : scale.low + share * (scale.high - scale.low);
}

/** A number that may be `off` more or less: its last digit is off by one at most. */
export function rounded(number: number, off: number): string {
  const digits = Math.floor(-Math.log10(Math.max(2 * off, 1e-12)) + 1e-9);
  if (digits >= 0) return fixed(number, Math.min(9, digits));
  const step = 10 ** Math.min(300, -digits);
  return String(Math.round(number / step) * step || 0);
}

/** The value at a height that may be `off` higher or lower, and whether it lies beyond what is drawn. */
function valueText(scale: Scale, at: number, off: number, cut: number | undefined): string {
  const number = value(scale, at);
  const doubt = Math.max(Math.abs(value(scale, at - off) - number), Math.abs(value(scale, at + off) - number));
  if (cut !== undefined && Math.abs(number) >= cut - doubt) {
    const end = String(Number(cut.toPrecision(4)));
    return number > 0 ? `at least ${end}` : `at most -${end}`;
  }
  if (scale.log && at >= scale.foot - off) return `at most ${Number(scale.low.toPrecision(2))}`;
  return rounded(number, doubt);
}

/** What stands at a place: a value, or from where to where the run went there. */
export function words(scale: Scale, [top, bottom]: Span, { off, cut }: Doubt): string {
  const half = 0.5 * (bottom - top);
  if (2 * half <= WIDE) return valueText(scale, top + half, off + half, cut);
  const [least, greatest] = [valueText(scale, bottom, off, cut), valueText(scale, top, off, cut)];
  return least === greatest ? least : `${least} … ${greatest}`;
}
