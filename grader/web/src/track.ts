// Numbers of a run as the page carries them: columns of integers, each given by how far it is from where the two before it lead.

/** Values of every row, row after row: value `c` of row `i` is `values[i * width + c]`. */
export interface Track {
  readonly width: number;
  readonly count: number;
  readonly values: Float64Array;
}

/** Bytes of a base64 text. Throws where it is none. */
export function bytes(text: string): Uint8Array {
  const native = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array }).fromBase64;
  if (native) return native(text);
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) out[i] = binary.charCodeAt(i);
  return out;
}

/** Reads varints of seven bits each, lowest first; the lowest bit of the number is its sign. */
class Differences {
  at = 0;

  constructor(private readonly data: Uint8Array) {}

  get done(): boolean {
    return this.at >= this.data.length;
  }

  next(): number {
    const data = this.data;
    let byte = data[this.at++];
    if (byte < 0x80) return byte & 1 ? -((byte + 1) >> 1) : byte >> 1;
    // beyond 31 bits a shift would wrap, so it is multiplied
    let value = byte & 0x7f;
    let scale = 128;
    do {
      if (this.at >= data.length) throw new Error("a number ends before its last byte");
      if (scale > 2 ** 49) throw new Error("a number is longer than 53 bits");
      byte = data[this.at++];
      value += (byte & 0x7f) * scale;
      scale *= 128;
    } while (byte >= 0x80);
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }
}

/** The whole numbers of one column, as many as its bytes hold. */
export function column(text: string): Float64Array {
  const data = bytes(text);
  const numbers = new Differences(data);
  const out = new Float64Array(data.length);
  let count = 0;
  let value = 0;
  let step = 0;
  while (!numbers.done) {
    const next = numbers.next();
    if (count === 0) value = next;
    else {
      step += next;
      value += step;
    }
    out[count++] = value;
  }
  return out.subarray(0, count);
}

/**
 * A track of `quanta.length` columns with `count` numbers each, at `ticks`, or at a fixed period where that is null. Throws where the bytes
 * hold fewer or more.
 */
export function track(text: string, quanta: readonly number[], count: number, ticks: Float64Array | null): Track {
  const width = quanta.length;
  const data = bytes(text);
  // a number takes a byte at least, so a false count costs no memory
  if (data.length < width * count) throw new Error(`${data.length} bytes hold no ${width} columns of ${count} numbers`);
  const numbers = new Differences(data);
  const values = new Float64Array(width * count);
  for (let c = 0; c < width; c++) {
    const quantum = quanta[c];
    let value = 0;
    let step = 0;
    for (let i = 0, at = c; i < count; i++, at += width) {
      if (numbers.at >= data.length) throw new Error(`column ${c + 1} of ${width} ends after ${i} of ${count} numbers`);
      // most numbers are a byte, which is worth a way of its own
      const byte = data[numbers.at];
      let next: number;
      if (byte < 0x80) {
        numbers.at++;
        next = (byte >> 1) ^ -(byte & 1);
      } else next = numbers.next();
      const before = value;
      if (i < 2) value += next;
      else {
        const ratio = ticks === null ? 1 : (ticks[i] - ticks[i - 1]) / (ticks[i - 1] - ticks[i - 2]);
        value += Math.floor(step * ratio + 0.5) + next;
      }
      step = value - before;
      values[at] = value * quantum;
    }
  }
  if (!numbers.done) throw new Error(`there are more than ${width} columns of ${count} numbers`);
  return { width, count, values };
}
