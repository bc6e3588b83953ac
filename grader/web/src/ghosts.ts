// What of a ghost is worth drawing: not what stands where the run has the same, which would only tint it.

import type { Scenery, SceneNode } from "./data";

/** Whether a ghost's node never moves and a link of the run of the same shapes stands there as well. */
export function hidden(replay: Scenery, node: SceneNode): boolean {
  const { pose } = node;
  if (node.kind !== "ghost" || pose === null) return false;
  const shapes = JSON.stringify(node.shapes);
  return replay.nodes.some(
    (other) =>
      other.kind === "link" &&
      other.pose !== null &&
      other.pose.every((value, i) => Math.abs(value - pose[i]) < 1e-6) &&
      JSON.stringify(other.shapes) === shapes,
  );
}
