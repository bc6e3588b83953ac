// Links to a moment: `#task=move&t=2.35`.

export interface Moment {
  readonly task: string;
  /** Seconds, or null where the link names the task alone. */
  readonly t: number | null;
}

/** Reads the part of an address after its `#`; what is no link to a moment is null. */
export function parse(hash: string): Moment | null {
  const text = hash.replace(/^#/, "");
  if (!text.startsWith("task=")) return null;
  const values = new Map<string, string>();
  for (const part of text.split("&")) {
    const [name, value = ""] = part.split("=", 2);
    try {
      values.set(name, decodeURIComponent(value));
    } catch {
      return null;
    }
  }
  const task = values.get("task");
  if (!task) return null;
  const told = values.get("t");
  const t = told === undefined || told.trim() === "" ? null : Number(told);
  return { task, t: t !== null && Number.isFinite(t) ? t : null };
}

export function format(task: string, t: string): string {
  return `#task=${encodeURIComponent(task)}&t=${t}`;
}

/** Writes the link of the moment into the address, a little later, since browsers allow only so many in a while. */
export class Address {
  private timer = 0;
  private next = "";

  write(hash: string): void {
    this.next = hash;
    if (this.timer) return;
    this.timer = window.setTimeout(() => this.flush(), 120);
  }

  flush(): void {
    if (!this.timer) return;
    clearTimeout(this.timer);
    this.timer = 0;
    try {
      history.replaceState(history.state, "", this.next);
    } catch {
      // a page in a frame without an address of its own has none to write
    }
  }
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
