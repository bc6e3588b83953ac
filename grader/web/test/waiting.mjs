// How tests wait: for a state, with a limit that a busy machine keeps, never for a time in which it should have come.

/**
 * The longest wait for anything \[ms\]. A state comes in a fraction of a second; with eight others busy on two cores, forty frames of
 * software rendering took two minutes.
 */
export const PATIENCE_MS = 600_000;

/** Repeats a check until it holds; past the limit it fails with its own words. */
export async function soon(check, patience = PATIENCE_MS) {
  for (const began = Date.now(); ; ) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() - began > patience) throw error;
      await new Promise((next) => setTimeout(next, 50));
    }
  }
}

/** Lets the page draw so many frames. */
export const frames = (page, count) =>
  page.evaluate((count) => new Promise((done) => {
    const next = () => (count-- > 0 ? requestAnimationFrame(next) : done());
    next();
  }), count);
