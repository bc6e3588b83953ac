// Links without a shape, as sticks from joint to joint: so an arm that is given by its lengths alone is visible.

import type { SceneNode, Scenery } from "./data";
import { place } from "./pose";
import type { Placed } from "./world";

export interface Bone {
  /** Node at whose origin it begins. */
  readonly from: number;
  /** Node on which it ends, and where on it. */
  readonly to: number;
  readonly tip: readonly number[];
  readonly ghost: boolean;
}

const ORIGIN = [0, 0, 0];
const bare = (node: SceneNode): boolean => node.shapes.length === 0 && (node.kind === "link" || node.kind === "ghost");

/** The sticks of a run: from each link without a shape to the links that hang on it, or where none does to the frames on it. */
export function bones(replay: Scenery): Bone[] {
  const { nodes, frames } = replay;
  const out: Bone[] = [];
  const hung = new Set<number>();
  nodes.forEach((node, to) => {
    if (node.parent === null) return;
    hung.add(node.parent);
    if (bare(nodes[node.parent])) out.push({ from: node.parent, to, tip: ORIGIN, ghost: node.kind === "ghost" });
  });
  for (const { node, pose } of frames) {
    if (node !== null && bare(nodes[node]) && !hung.has(node)) out.push({ from: node, to: node, tip: pose.slice(0, 3), ghost: nodes[node].kind === "ghost" });
  }
  return out;
}

/** Writes where a stick ends in the world; it begins at the origin of its node. */
export function reach(out: Float64Array, world: Placed, bone: Bone): void {
  place(out, 0, world.poses, 7 * bone.to, bone.tip[0], bone.tip[1], bone.tip[2]);
}
