// The values of a drawn line, read from its polylines.

/** One unbroken piece: x and y of its points in units of the picture, x never falling. */
export interface Piece {
  readonly x: Float64Array;
  readonly y: Float64Array;
}

/** The pieces of the line of a colour in a box (left, top, right, bottom); `slack` is how far a point may lie outside. */
export function curve(svg: SVGSVGElement, colour: string, box: readonly number[], slack: number): Piece[] {
  const wanted = colour.toUpperCase();
  const [left, top, right, bottom] = box;
  const pieces: Piece[] = [];
  for (const line of svg.querySelectorAll("polyline")) {
    if ((line.getAttribute("stroke") ?? "").toUpperCase() !== wanted) continue;
    const numbers = (line.getAttribute("points") ?? "").trim().split(/[\s,]+/).map(Number);
    const count = numbers.length >> 1;
    if (count === 0 || numbers.some((n) => !Number.isFinite(n))) continue;
    const x = new Float64Array(count);
    const y = new Float64Array(count);
    let inside = 0;
    for (let i = 0; i < count; i++) {
      x[i] = numbers[2 * i];
      y[i] = numbers[2 * i + 1];
      if (x[i] >= left - slack && x[i] <= right + slack && y[i] >= top - slack && y[i] <= bottom + slack) inside++;
    }
    // the sample in a legend has the colour too, but lies elsewhere
    if (2 * inside > count) pieces.push({ x, y });
  }
  return pieces;
}

/** The height of a line at x: between two points on the straight line, on a step its end; null where it has none. */
export function valueAt(pieces: readonly Piece[], at: number): number | null {
  for (const { x, y } of pieces) {
    const last = x.length - 1;
    // the ends are whole units, so half a unit is on them
    if (at < x[0] - 0.5 || at > x[last] + 0.5) continue;
    let low = 0;
    let high = last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (x[middle] <= at) low = middle;
      else high = middle - 1;
    }
    if (low === last || x[low + 1] === x[low]) return y[low];
    const f = Math.min(1, Math.max(0, (at - x[low]) / (x[low + 1] - x[low])));
    return y[low] + f * (y[low + 1] - y[low]);
  }
  return null;
}
