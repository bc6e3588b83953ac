// Moving the camera with a mouse, a pen, fingers, or keys.

import type { Orbit } from "./orbit";

const TURN = Math.PI / 36;

/** Listens on the stage; a wheel zooms only with Ctrl, so that it does not catch a reader who scrolls. */
export function listen(stage: HTMLElement, orbit: Orbit): void {
  const pointers = new Map<number, { x: number; y: number }>();

  const two = (): { x: number; y: number; apart: number } | null => {
    if (pointers.size !== 2) return null;
    const [a, b] = [...pointers.values()];
    return { x: 0.5 * (a.x + b.x), y: 0.5 * (a.y + b.y), apart: Math.hypot(a.x - b.x, a.y - b.y) };
  };

  stage.addEventListener("pointerdown", (event) => {
    if (event.target !== stage && !(event.target instanceof HTMLCanvasElement)) return;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    stage.setPointerCapture(event.pointerId);
    stage.dataset.held = "";
  });
  stage.addEventListener("pointermove", (event) => {
    const pointer = pointers.get(event.pointerId);
    if (!pointer) return;
    const height = Math.max(1, stage.clientHeight);
    const before = two();
    const dx = event.clientX - pointer.x;
    const dy = event.clientY - pointer.y;
    pointer.x = event.clientX;
    pointer.y = event.clientY;
    const after = two();
    if (before && after) {
      if (before.apart > 0 && after.apart > 0) orbit.zoom(before.apart / after.apart);
      orbit.shift((before.x - after.x) / height, (after.y - before.y) / height);
    } else if (event.shiftKey || event.buttons & 6 || orbit.panning) orbit.shift(-dx / height, dy / height);
    else orbit.turn((-Math.PI * dx) / height, (Math.PI * dy) / height);
  });
  const end = (event: PointerEvent): void => {
    pointers.delete(event.pointerId);
    if (pointers.size === 0) delete stage.dataset.held;
  };
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"] as const) stage.addEventListener(name, end);
  stage.addEventListener("contextmenu", (event) => {
    if (event.target instanceof HTMLCanvasElement) event.preventDefault();
  });
  stage.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      orbit.zoom(Math.exp(Math.min(0.4, Math.max(-0.4, 0.0016 * lines * event.deltaY))));
    },
    { passive: false },
  );
  stage.addEventListener("keydown", (event) => {
    if (event.target !== stage || event.ctrlKey || event.metaKey || event.altKey) return;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => (event.shiftKey ? orbit.shift(-0.05, 0) : orbit.turn(-TURN, 0)),
      ArrowRight: () => (event.shiftKey ? orbit.shift(0.05, 0) : orbit.turn(TURN, 0)),
      ArrowUp: () => (event.shiftKey ? orbit.shift(0, 0.05) : orbit.turn(0, TURN)),
      ArrowDown: () => (event.shiftKey ? orbit.shift(0, -0.05) : orbit.turn(0, -TURN)),
      "+": () => orbit.zoom(1 / 1.15),
      "=": () => orbit.zoom(1 / 1.15),
      "-": () => orbit.zoom(1.15),
    };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    // the keys that step through the run are the stage's own while it has focus
    event.stopPropagation();
    move();
  });
}
