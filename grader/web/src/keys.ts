// The keys of a replay, while it has focus.

/** What the keys move: the run itself, or what is looked at of it. */
export interface Steered {
  readonly start: number;
  readonly end: number;
  readonly loop: boolean;
  step(frames: number): void;
  seek(t: number): void;
  toggle(): void;
  setLoop(loop: boolean): void;
}

/** Elements that do something of their own with the space bar or with arrows. */
const PRESSED = "button, select, a, summary, input:not([type=range]), textarea";

/** Keys that switch something on or off. */
const SWITCHES = [" ", "l", "L"];

export function listen(root: HTMLElement, cursor: Steered, event: (direction: 1 | -1) => void): void {
  root.addEventListener("keydown", (key) => {
    // many keyboards have the brackets behind AltGr, which counts as both others
    const plain = !(key.ctrlKey || key.metaKey || key.altKey) || key.getModifierState("AltGraph");
    if (!plain || key.defaultPrevented) return;
    const target = key.target instanceof Element ? key.target : root;
    const many = key.shiftKey ? 10 : 1;
    const acts: Record<string, () => void> = {
      ArrowLeft: () => cursor.step(-many),
      ArrowRight: () => cursor.step(many),
      Home: () => cursor.seek(cursor.start),
      End: () => cursor.seek(cursor.end),
      "[": () => event(-1),
      "]": () => event(1),
      l: () => cursor.setLoop(!cursor.loop),
      L: () => cursor.setLoop(!cursor.loop),
    };
    if (target.matches("input[type=range]")) {
      acts.ArrowDown = acts.ArrowLeft;
      acts.ArrowUp = acts.ArrowRight;
      acts.PageDown = () => cursor.step(-10);
      acts.PageUp = () => cursor.step(10);
    }
    if (!target.matches(PRESSED)) acts[" "] = () => cursor.toggle();
    // a list of speeds keeps its keys, and a box that scrolls its arrows
    if (target.matches("select")) return;
    const act = acts[key.key];
    if (!act) return;
    key.preventDefault();
    // a key that is held steps on, and does not switch to and fro
    if (key.repeat && SWITCHES.includes(key.key)) return;
    act();
  });
}
