// A button of the viewer, with a sign or in words, and a named group of buttons.

import { element } from "./dom";
import { icon, type Sign } from "./icon";

/** A button in words, or where it has a sign with its name for who points at it; `null` for its keys sets words and sign side by side. */
export function button(name: string, sign: Sign | null, act: () => void, keys?: string | null): HTMLButtonElement {
  const worded = sign === null || keys === null;
  const made = element("button", { type: "button", class: worded ? "replay-word" : "replay-sign" });
  if (worded) made.append(name);
  else {
    made.setAttribute("aria-label", name);
    made.title = keys ? `${name} (${keys})` : name;
  }
  if (sign) made.append(icon(sign));
  made.addEventListener("click", act);
  return made;
}

export function group(name: string, ...children: HTMLElement[]): HTMLElement {
  return element("div", { role: "group", "aria-label": name, class: "replay-group" }, ...children);
}
