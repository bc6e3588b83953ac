// The values of a drawn line, read from its paths: steps from point to point, as `m680 900 12-5 3 0`.

/** One stroke or area: x and y of its points in units of the picture. */
export interface Piece {
  readonly x: Float64Array;
  readonly y: Float64Array;
  /** Whether it is a band, from the lowest value to the highest. */
  readonly band: boolean;
  /** The dashes of a stroke, if it has some. */
  readonly dashes: string | null;
}

/** What is read at a place: the upper and the lower end, as heights in units of the picture, y downwards. */
export type Span = readonly [top: number, bottom: number];

/** How far beside its place a point may be drawn: it is a whole unit. */
const BESIDE = 0.5;

/** The pieces of a path; where it is no path of steps, none. */
export function pieces(d: string, band: boolean, dashes: string | null = null): Piece[] {
  if (!/^m[-\d m]*z?$/.test(d)) return [];
  let atX = 0;
  let atY = 0;
  return d.slice(1).split("m").map((part) => {
    const steps = part.match(/-?\d+/g) ?? [];
    const count = steps.length >> 1;
    const x = new Float64Array(count);
    const y = new Float64Array(count);
    for (let i = 0; i < count; i++) {
      x[i] = atX += Number(steps[2 * i]);
      y[i] = atY += Number(steps[2 * i + 1]);
    }
    return { x, y, band, dashes };
  });
}

/** The way through the middle of a band, from left to right, as a path. */
export function middleOf({ x, y }: Piece): string {
  const ends = new Map<number, [number, number]>();
  x.forEach((at, i) => {
    const known = ends.get(at);
    if (known) known[0] = Math.min(known[0], y[i]), (known[1] = Math.max(known[1], y[i]));
    else ends.set(at, [y[i], y[i]]);
  });
  let before = [0, 0];
  const steps = [...ends].sort((a, b) => a[0] - b[0]).map(([at, [top, bottom]]) => {
    const to = [at, Math.round(0.5 * (top + bottom))];
    const step = `${to[0] - before[0]} ${to[1] - before[1]}`;
    before = to;
    return step;
  });
  return steps.length ? `m${steps.join(" ")}` : "";
}

/** All lines and bands of a picture, by their colour in capitals. */
export function drawn(svg: SVGSVGElement): Map<string, Piece[]> {
  const all = new Map<string, Piece[]>();
  for (const path of svg.querySelectorAll("path")) {
    const stroke = path.getAttribute("stroke");
    const colour = (stroke ?? path.getAttribute("fill") ?? "").toUpperCase();
    const found = pieces(path.getAttribute("d") ?? "", stroke === null, path.getAttribute("stroke-dasharray"));
    const known = all.get(colour);
    if (known) known.push(...found);
    else all.set(colour, found);
  }
  return all;
}

/** The pieces of a line of this colour and these dashes; a band has none. */
export function ofLine(all: ReadonlyMap<string, readonly Piece[]> | null, colour: string, dashes: string | null): readonly Piece[] {
  const known = all?.get(colour.toUpperCase()) ?? [];
  return known.filter((piece) => piece.band || piece.dashes === dashes);
}

/** The pieces that lie in a box (left, top, right, bottom); `slack` is how far a point may lie outside. */
export function inside(all: readonly Piece[], box: readonly number[], slack: number): Piece[] {
  const [left, top, right, bottom] = box;
  // the sample in a legend and the lines of other panels have the colour too, but lie elsewhere
  return all.filter(({ x, y }) => {
    let count = 0;
    for (let i = 0; i < x.length; i++) if (x[i] >= left - slack && x[i] <= right + slack && y[i] >= top - slack && y[i] <= bottom + slack) count++;
    return 2 * count > x.length;
  });
}

/** From where to where a line goes at x, or null where it has no value; bands are drawn `pad` higher and lower than their values. */
export function spanAt(all: readonly Piece[], at: number, pad: number): Span | null {
  let top = Infinity;
  let bottom = -Infinity;
  const from = at - BESIDE;
  const to = at + BESIDE;
  for (const { x, y, band } of all) {
    const count = x.length;
    let high = Infinity;
    let low = -Infinity;
    const see = (height: number): void => {
      high = Math.min(high, height);
      low = Math.max(low, height);
    };
    for (let i = 0; i < count; i++) {
      // a band's last point leads back to its first, a line of one point is a dot
      const j = i + 1 < count ? i + 1 : band || count === 1 ? 0 : -1;
      if (j < 0) break;
      const [a, b] = x[i] <= x[j] ? [i, j] : [j, i];
      if (x[b] < from || x[a] > to) continue;
      const slope = x[b] > x[a] ? (y[b] - y[a]) / (x[b] - x[a]) : 0;
      see(x[b] > x[a] ? y[a] + slope * (Math.max(from, x[a]) - x[a]) : y[a]);
      see(x[b] > x[a] ? y[a] + slope * (Math.min(to, x[b]) - x[a]) : y[b]);
    }
    if (high > low) continue;
    top = Math.min(top, band ? high + pad : high);
    bottom = Math.max(bottom, band ? low - pad : low);
  }
  return bottom >= top ? [top, bottom] : null;
}
