// Signs on buttons and of events. Each event has a shape of its own, so that it is recognised without its colour.

import { drawing } from "./dom";
import type { EventKind } from "./data";

const PATHS = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M6 5h4.2v14H6zM13.8 5H18v14h-4.2z",
  back: "M16 5v14l-9-7zM5 5h2.2v14H5z",
  on: "M8 5v14l9-7zM16.8 5H19v14h-2.2z",
  previous: "M20 5v14l-8-7zM12 5v14l-8-7z",
  next: "M4 5v14l8-7zM12 5v14l8-7z",
  loop: "M7 7h9V4l5 4.5-5 4.5v-3H9v3H7zM17 17H8v3l-5-4.5 5-4.5v3h7v-3h2z",
  link: "M10.6 13.4a3.6 3.6 0 0 0 5.1 0l3.4-3.4a3.6 3.6 0 0 0-5.1-5.1l-1.4 1.4 1.4 1.4 1.4-1.4a1.6 1.6 0 0 1 2.3 2.3l-3.4 3.4a1.6 1.6 0 0 1-2.3 0zM13.4 10.6a3.6 3.6 0 0 0-5.1 0L4.9 14a3.6 3.6 0 0 0 5.1 5.1l1.4-1.4-1.4-1.4-1.4 1.4a1.6 1.6 0 0 1-2.3-2.3l3.4-3.4a1.6 1.6 0 0 1 2.3 0z",
  closer: "M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z",
  farther: "M5 11h14v2H5z",
  left: "M14.5 5v14L6 12z",
  right: "M9.5 5v14l8.5-7z",
  up: "M5 14.5h14L12 6z",
  down: "M5 9.5h14L12 18z",
  full: "M4 4h7v2H6v5H4zM20 20h-7v-2h5v-5h2z",
  window: "M11 11H4V9h5V4h2zM13 13h7v2h-5v5h-2z",
  close: "M6.4 5L12 10.6 17.6 5 19 6.4 13.4 12l5.6 5.6-1.4 1.4-5.6-5.6L6.4 19 5 17.6l5.6-5.6L5 6.4z",
} as const;

export type Sign = keyof typeof PATHS;

export function icon(sign: Sign): SVGSVGElement {
  return drawing("svg", { viewBox: "0 0 24 24", "aria-hidden": "true", class: "replay-icon" }, drawing("path", { d: PATHS[sign] }));
}

export function setIcon(button: HTMLElement, sign: Sign): void {
  button.querySelector("path")?.setAttribute("d", PATHS[sign]);
}

/** What an event is called, and its shape in a square of 12. */
export const EVENTS: Record<EventKind, { readonly name: string; readonly path: string }> = {
  contact: { name: "contact", path: "M6 1.5a4.5 4.5 0 1 0 0 9a4.5 4.5 0 1 0 0-9z" },
  limit: { name: "limit", path: "M6 1l5.2 9.5H.8z" },
  saturation: { name: "saturation", path: "M1.8 1.8h8.4v8.4H1.8z" },
  breach: { name: "first breach", path: "M6 .3L11.7 6 6 11.7.3 6z" },
  fell: { name: "fell", path: "M6 11L.8 1.5h10.4z" },
  stop: { name: "stop", path: "M2.6.8L6 4.2 9.4.8l1.8 1.8L7.8 6l3.4 3.4-1.8 1.8L6 7.8l-3.4 3.4L.8 9.4 4.2 6 .8 2.6z" },
  other: { name: "event", path: "M4.5.5h3v11h-3z" },
};

export function mark(kind: EventKind): SVGSVGElement {
  return drawing("svg", { viewBox: "0 0 12 12", "aria-hidden": "true", class: `replay-mark ${kind}` }, drawing("path", { d: EVENTS[kind].path }));
}
