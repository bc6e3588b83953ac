// How many pixels of the screen make one of the page: it changes as a window moves to another screen or is zoomed.
//
// Not every browser sends an event for every way this can happen, so the number itself is looked at: at once where the element's
// own pixels change, and every half second besides.

/** How often the number is looked at \[ms\]. */
const LOOK_MS = 500;

/** Calls `listener` when the number changed while `element` is on the page, until what it returns is called. */
export function onPixels(element: HTMLElement, listener: () => void): () => void {
  let known = devicePixelRatio;
  const look = (): void => {
    if (devicePixelRatio === known) return;
    known = devicePixelRatio;
    listener();
  };
  const observer = new ResizeObserver(look);
  try {
    observer.observe(element, { box: "device-pixel-content-box" });
  } catch {
    // a browser that cannot observe these pixels: the timer sees the change
  }
  const timer = setInterval(look, LOOK_MS);
  return () => {
    observer.disconnect();
    clearInterval(timer);
  };
}
