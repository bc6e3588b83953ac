// Whether the browser draws in 3D.

let able: boolean | null = null;

/** Whether there is WebGL, asked once and given back at once, since contexts are few. */
export function webgl(): boolean {
  if (able === null) {
    try {
      const context = document.createElement("canvas").getContext("webgl2");
      able = context !== null;
      context?.getExtension("WEBGL_lose_context")?.loseContext();
    } catch {
      able = false;
    }
  }
  return able;
}
