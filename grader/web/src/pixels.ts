// How many pixels of the screen make one of the page: it changes as a window moves to another screen or is zoomed.

/** Calls when it changed, until what it returns is called. */
export function onPixels(listener: () => void): () => void {
  let query = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
  const changed = (): void => {
    // a query is of one ratio only
    query = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    query.addEventListener("change", changed, { once: true });
    listener();
  };
  query.addEventListener("change", changed, { once: true });
  return () => query.removeEventListener("change", changed);
}
