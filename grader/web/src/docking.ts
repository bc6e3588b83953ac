// How the picture of a run stays in sight while its checks and plots are read: beside them where the window is wide, else as a small
// picture in the corner.

import { button } from "./button";
import { element } from "./dom";
import { bring } from "./sections";

/** The frame around the picture, which keeps its room on the page while the picture is in the corner. */
export function framed(root: HTMLElement, stage: HTMLElement): HTMLElement {
  const corner = element("div", { class: "replay-corner" });
  const frame = element("div", { class: "replay-frame" }, stage, corner);
  const section = root.closest("section");
  if (!section) return frame;
  let above = false;
  let read = false;
  let wanted = true;
  const put = (): void => {
    root.classList.toggle("small", above && read && wanted);
  };
  corner.append(
    button("Back to the replay", "up", () => bring(root, false)),
    button("Hide the small picture", "close", () => {
      wanted = false;
      put();
    }),
  );
  new IntersectionObserver((all) => {
    const { isIntersecting, boundingClientRect } = all[all.length - 1];
    above = !isIntersecting && boundingClientRect.height > 0;
    put();
    // what lies below counts as seen, so that a jump past the picture is noticed too
  }, { rootMargin: "0px 0px 10000000px 0px" }).observe(frame);
  // what stands in the upper half is what is read
  new IntersectionObserver((all) => {
    read = all[all.length - 1].isIntersecting;
    put();
  }, { rootMargin: "0px 0px -50% 0px" }).observe(section);
  return frame;
}

/** Puts what follows the replay in the section of a task beside it; the style sheet says from which width on. */
export function dock(root: HTMLElement): void {
  const section = root.parentElement;
  if (!section?.matches("section.task") || !root.nextElementSibling) return;
  const beside = element("div", { class: "replay-pane" });
  while (root.nextSibling) beside.append(root.nextSibling);
  const panes = element("div", { class: "replay-panes" });
  root.before(panes);
  panes.append(root, beside);
}
