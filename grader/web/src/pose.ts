// Poses as seven numbers in larger arrays: x, y, z in m and the quaternion w, x, y, z. Nothing here makes an object.

export type Numbers = Float64Array | readonly number[];

/** Writes pose `a` followed by pose `b` (a_from_b): `out = a * b`. `out` may be neither of them. */
export function compose(out: Float64Array, o: number, a: Numbers, i: number, b: Numbers, j: number): void {
  place(out, o, a, i, b[j], b[j + 1], b[j + 2]);
  const aw = a[i + 3], ax = a[i + 4], ay = a[i + 5], az = a[i + 6];
  const bw = b[j + 3], bx = b[j + 4], by = b[j + 5], bz = b[j + 6];
  out[o + 3] = aw * bw - ax * bx - ay * by - az * bz;
  out[o + 4] = aw * bx + ax * bw + ay * bz - az * by;
  out[o + 5] = aw * by - ax * bz + ay * bw + az * bx;
  out[o + 6] = aw * bz + ax * by - ay * bx + az * bw;
}

/** Writes the point x, y, z of the frame `a` as the world sees it. */
export function place(out: Float64Array, o: number, a: Numbers, i: number, x: number, y: number, z: number): void {
  const w = a[i + 3], qx = a[i + 4], qy = a[i + 5], qz = a[i + 6];
  // p + 2 w (q x p) + 2 q x (q x p)
  const cx = 2 * (qy * z - qz * y), cy = 2 * (qz * x - qx * z), cz = 2 * (qx * y - qy * x);
  out[o] = a[i] + x + w * cx + qy * cz - qz * cy;
  out[o + 1] = a[i + 1] + y + w * cy + qz * cx - qx * cz;
  out[o + 2] = a[i + 2] + z + w * cz + qx * cy - qy * cx;
}

/** Makes the quaternion of a pose a unit one; a quaternion of no length is no turn. */
export function normalize(pose: Float64Array, o: number): void {
  const w = pose[o + 3], x = pose[o + 4], y = pose[o + 5], z = pose[o + 6];
  const length = Math.sqrt(w * w + x * x + y * y + z * z);
  const scale = length > 1e-9 ? 1 / length : 0;
  pose[o + 3] = scale > 0 ? w * scale : 1;
  pose[o + 4] = x * scale;
  pose[o + 5] = y * scale;
  pose[o + 6] = z * scale;
}
