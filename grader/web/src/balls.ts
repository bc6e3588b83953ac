// The outline of shapes as balls: whatever hulls the balls hulls the shape. A box is its eight corners with radius 0.

import type { Mesh, Shape } from "./data";
import { place } from "./pose";

/** x, y, z and radius of each ball \[m\], in the frame of the node. */
export type Balls = Float64Array;

/** Vertices a mesh's outline has at most. */
const MOST_VERTICES = 96;

/** Evenly spread directions (a Fibonacci lattice), three numbers each. */
function directions(count: number): Float64Array {
  const out = new Float64Array(3 * count);
  const golden = Math.PI * (3 - Math.sqrt(5));
  for (let i = 0; i < count; i++) {
    const z = 1 - (2 * i + 1) / count;
    const r = Math.sqrt(1 - z * z);
    out.set([r * Math.cos(golden * i), r * Math.sin(golden * i), z], 3 * i);
  }
  return out;
}

/** The indices of the points that lie farthest out in evenly spread directions; `stride` numbers a point, a fourth is its radius. */
export function farthest(points: ArrayLike<number>, stride: 3 | 4, count: number): number[] {
  const found = new Set<number>();
  const ways = directions(count);
  const length = points.length / stride;
  for (let w = 0; w < count; w++) {
    let best = -Infinity;
    let at = -1;
    for (let i = 0; i < length; i++) {
      const p = stride * i;
      let out = points[p] * ways[3 * w] + points[p + 1] * ways[3 * w + 1] + points[p + 2] * ways[3 * w + 2];
      if (stride === 4) out += points[p + 3];
      if (out > best) {
        best = out;
        at = i;
      }
    }
    if (at >= 0) found.add(at);
  }
  return [...found];
}

function vertices(mesh: Mesh): number[] {
  const count = mesh.vertices.length / 3;
  const kept = count <= MOST_VERTICES ? Array.from({ length: count }, (_, i) => i) : farthest(mesh.vertices, 3, MOST_VERTICES);
  return kept.flatMap((i) => [mesh.vertices[3 * i], mesh.vertices[3 * i + 1], mesh.vertices[3 * i + 2], 0]);
}

/** The balls of a shape, in the frame of its node. */
export function balls(shape: Shape, meshes: readonly Mesh[]): Balls {
  const solid = shape.solid;
  const local: number[] = [];
  switch (solid.kind) {
    case "box": {
      const [x, y, z] = solid.size;
      for (const i of [-0.5, 0.5]) for (const j of [-0.5, 0.5]) for (const k of [-0.5, 0.5]) local.push(i * x, j * y, k * z, 0);
      break;
    }
    case "cylinder":
      for (const end of [-0.5, 0.5]) {
        for (let i = 0; i < 24; i++) {
          const angle = (2 * Math.PI * i) / 24;
          local.push(solid.radius * Math.cos(angle), solid.radius * Math.sin(angle), end * solid.length, 0);
        }
      }
      break;
    case "capsule":
      local.push(0, 0, -0.5 * solid.length, solid.radius, 0, 0, 0.5 * solid.length, solid.radius);
      break;
    case "sphere":
      local.push(0, 0, 0, solid.radius);
      break;
    case "mesh":
      local.push(...vertices(meshes[solid.mesh]));
  }
  const out = new Float64Array(local);
  for (let i = 0; i < out.length; i += 4) place(out, i, shape.pose, 0, local[i], local[i + 1], local[i + 2]);
  return out;
}
