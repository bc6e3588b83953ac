// Moments and values in words.

import type { RunEvent } from "./data";
import { EVENTS } from "./icon";

/** Decimals that distinguish every step of a run, at most six. */
export function decimals(stepS: number): number {
  return Math.min(6, Math.max(0, Math.ceil(-Math.log10(stepS) - 1e-9)));
}

/** A moment without needless zeros, as links have it. */
export function moment(t: number, stepS: number): string {
  return String(Number(t.toFixed(Math.min(9, decimals(stepS) + 1))));
}

/** A moment as it is said: `2.35 s`. */
export function seconds(t: number, stepS: number): string {
  return `${moment(t, stepS)} s`;
}

/** A number with fixed decimals and no minus before zero. */
export function fixed(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** A name that may go on in a new line after each of its parts. */
export function breakable(name: string): Array<string | HTMLElement> {
  return name.split(/(?<=[_.:/-])/).flatMap((part, i) => (i > 0 ? [document.createElement("wbr"), part] : [part]));
}

/** What an event is, with its kind where its own words do not name it. */
export function eventWords(event: RunEvent): string {
  const kind = EVENTS[event.kind].name;
  return event.kind === "other" || event.text.toLowerCase().includes(kind) ? event.text : `${kind}: ${event.text}`;
}
