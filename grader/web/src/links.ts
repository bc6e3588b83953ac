// Links to a moment: `#task=move&t=2.35`.

export interface Moment {
  readonly task: string;
  /** Seconds, or null where the link names the task alone. */
  readonly t: number | null;
  /** What stands for the time and is none. */
  readonly unread: string | null;
}

/** What may follow a link in a sentence, and comes along when it is copied. */
const AFTER = /[\s.,;:!?)\]}>'"\u2019\u201d\u00bb\u2026]+$/;
const SECONDS = /^-?(?:\d+(?:[.,]\d*)?|[.,]\d+)$/;

/** A part of an address as it was before it was coded; what is not coded well stays as it is. */
function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Reads the part of an address after its `#`; what names no task is null. */
export function parse(hash: string): Moment | null {
  const values = new Map<string, string>();
  for (const part of hash.replace(/^#/, "").split("&")) {
    const [name, ...value] = part.split("=");
    values.set(name, decoded(value.join("=")));
  }
  const task = values.get("task");
  if (!task) return null;
  const text = (values.get("t") ?? "").trim();
  const bare = text.replace(AFTER, "");
  if (bare === "") return { task, t: null, unread: text === "" ? null : text };
  // a comma is what many write for the point
  if (SECONDS.test(bare)) return { task, t: Number(bare.replace(",", ".")), unread: null };
  return { task, t: null, unread: text };
}

/** Of the names of tasks, the one that a link means; a full stop after a link is none of its name. */
export function meant(task: string, names: readonly string[]): string | undefined {
  return names.find((name) => name === task) ?? names.find((name) => name === task.replace(AFTER, ""));
}

export function format(task: string, t: string): string {
  return `#task=${encodeURIComponent(task)}&t=${t}`;
}

/** Safari takes 100 changes in 30 s. */
const EVERY_MS = 400;

/** Writes the link of the moment into the address, a little later, since browsers allow only so many in a while. */
export class Address {
  private timer = 0;
  private next = "";

  write(hash: string): void {
    this.next = hash;
    if (this.timer) return;
    this.timer = window.setTimeout(() => this.flush(), EVERY_MS);
  }

  /** Leaves the address as it is. */
  forget(): void {
    clearTimeout(this.timer);
    this.timer = 0;
  }

  flush(): void {
    if (!this.timer) return;
    this.forget();
    try {
      history.replaceState(history.state, "", this.next);
    } catch {
      // a page in a frame without an address of its own has none to write
    }
  }
}

/** A link as others can use it: of a page on this machine's disk its own name, since the way to it is nowhere else. */
export function shareable(page: Location, hash: string): string {
  const whole = page.href.replace(/#.*$/, "");
  return (page.protocol === "file:" ? decoded(whole.replace(/^.*\//, "")) : whole) + hash;
}

/** Puts a text where it can be pasted from. Says whether it did. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // a page from disk may lack the newer way
    const box = document.createElement("textarea");
    box.value = text;
    box.setAttribute("readonly", "");
    box.style.position = "fixed";
    box.style.opacity = "0";
    const focused = document.activeElement;
    document.body.append(box);
    box.select();
    let done = false;
    try {
      done = document.execCommand("copy");
    } catch {
      done = false;
    }
    box.remove();
    if (focused instanceof HTMLElement) focused.focus({ preventScroll: true });
    return done;
  }
}
