// The manipulability ellipse: where the TCP's velocity can be while the joints' velocities together have length 1.
//
// Its half axes are the singular values of the Jacobian in the directions in which the arm moves, found by turning pairs of rows
// until all are at right angles (Jacobi, one-sided): the small ones stay exact near singular postures, where those of J Jᵀ would not.

import type { MotionSpace } from "./motion_space";

export interface Ellipse {
  /** Half axes, the longest first, in the axes of the lab frame \[m/s\]. */
  readonly axes: readonly (readonly number[])[];
  /** Their lengths, the singular values. */
  readonly lengths: readonly number[];
  /** Yoshikawa's manipulability, sqrt(det(J Jᵀ)): the product of the lengths. */
  readonly manipulability: number;
}

const MOST_SWEEPS = 40;

/** The ellipse of the columns of a Jacobian in the lab frame. */
export function ellipse(columns: readonly (readonly number[])[], { basis }: MotionSpace): Ellipse {
  const rows = basis.map((b) => columns.map((column) => column[0] * b[0] + column[1] * b[1] + column[2] * b[2]));
  // which direction each row belongs to, in parts of the basis
  const turns: number[][] = basis.map((_, i) => basis.map((_, k) => (i === k ? 1 : 0)));
  for (let sweep = 0, more = true; more && sweep < MOST_SWEEPS; sweep++) {
    more = false;
    for (let i = 0; i < rows.length; i++) for (let k = i + 1; k < rows.length; k++) more = turn(rows, turns, i, k) || more;
  }
  const half = rows.map((row, i) => {
    const length = Math.hypot(...row);
    return { length, axis: [0, 1, 2].map((c) => length * turns[i].reduce((sum, part, k) => sum + part * basis[k][c], 0)) };
  });
  half.sort((a, b) => b.length - a.length);
  const lengths = half.map(({ length }) => length);
  return {
    axes: half.map(({ axis }) => axis),
    lengths,
    manipulability: columns.length < basis.length ? 0 : lengths.reduce((product, length) => product * length, 1),
  };
}

/** Turns two rows so that they are at right angles; says whether they were not. */
function turn(rows: number[][], turns: number[][], i: number, k: number): boolean {
  let [a, b, c] = [0, 0, 0];
  rows[i].forEach((x, j) => {
    const y = rows[k][j];
    a += x * x;
    b += y * y;
    c += x * y;
  });
  if (Math.abs(c) <= 1e-16 * Math.sqrt(a * b) || c === 0) return false;
  const zeta = (b - a) / (2 * c);
  const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.sqrt(1 + zeta * zeta));
  const cosine = 1 / Math.sqrt(1 + t * t);
  const sine = cosine * t;
  for (const list of [rows, turns]) {
    list[i].forEach((x, j) => {
      const y = list[k][j];
      list[i][j] = cosine * x - sine * y;
      list[k][j] = sine * x + cosine * y;
    });
  }
  return true;
}

/** A shortest half axis below this part of the longest is as good as none. */
const SINGULAR = 1e-3;
const NEAR = 0.1;

/** What the ellipse says of a posture, in a plain word. */
export function verdict({ lengths }: Ellipse): "singular" | "nearly singular" | "not singular" {
  const [longest, shortest] = [lengths[0] ?? 0, lengths[lengths.length - 1] ?? 0];
  if (!(shortest > SINGULAR * longest)) return "singular";
  return shortest < NEAR * longest ? "nearly singular" : "not singular";
}
