// The sections of tasks on the page, and how one is brought where it is seen.

import { reducedMotion } from "./motion";

/** The section of each task. */
export function sections(): Map<string, HTMLElement> {
  const out = new Map<string, HTMLElement>();
  for (const named of document.querySelectorAll<HTMLElement>("[data-task]")) {
    const section = named.closest("section") ?? named;
    const task = named.dataset.task ?? "";
    if (task !== "" && section instanceof HTMLElement && !out.has(task)) out.set(task, section);
  }
  return out;
}

/** Scrolls to a part of the page and puts the focus there; what it is folded into is unfolded. */
export function bring(part: HTMLElement, atOnce: boolean): void {
  for (let at = part.parentElement; at; at = at.parentElement) if (at instanceof HTMLDetailsElement) at.open = true;
  if (part.tabIndex < 0 && !part.hasAttribute("tabindex")) part.tabIndex = -1;
  const { top, bottom } = part.getBoundingClientRect();
  // what stays beside the text is there already
  const seen = part.offsetHeight > 0 && top >= 0 && bottom <= innerHeight;
  if (!seen) part.scrollIntoView({ block: part.offsetHeight < innerHeight ? "center" : "start", behavior: atOnce || reducedMotion() ? "auto" : "smooth" });
  part.focus({ preventScroll: true });
}
