// The frames that are shown by name: the robot's and, first, the lab's.

import type { Frame, Replay } from "./data";

export function namedFrames(replay: Replay): readonly Frame[] {
  return replay.frames.some((frame) => frame.name === replay.lab.name) ? replay.frames : [replay.lab, ...replay.frames];
}
