// An MCAP log as another implementation reads it: messages by topic, and the frames of /tf put together.
import { readFileSync } from "node:fs";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import protobuf from "protobufjs";
import "protobufjs/ext/descriptor/index.js";

const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };
const text = new TextDecoder("utf-8", { fatal: true });

/** What `make` gives for a path, made once. */
const once = (make) => {
  const made = new Map();
  return (path) => made.get(path) ?? made.set(path, make(path)).get(path);
};

/** What reads the messages of a schema: `{ encoding, data, name }` of MCAP. */
export function decoder({ encoding, data, name }) {
  if (encoding === "jsonschema") return (bytes) => JSON.parse(text.decode(bytes));
  if (encoding !== "protobuf") throw new Error(`a schema in ${encoding}`);
  const root = protobuf.Root.fromDescriptor(protobuf.descriptor.FileDescriptorSet.decode(data));
  const type = root.lookupType(name);
  // numbers of enumerations, and every field that has no presence of its own, as in the JSON form
  const form = { enums: Number, longs: Number, arrays: true, defaults: false };
  return (bytes) => inJsonForm(type, type.toObject(type.decode(bytes), form));
}

/** A message of protobuf as Foxglove's JSON form has it: times in `sec` and `nsec`, numbers and texts also where they are zero or empty. */
function inJsonForm(type, message) {
  if (/^\.google\.protobuf\.(Timestamp|Duration)$/.test(type.fullName)) return { sec: message.seconds ?? 0, nsec: message.nanos ?? 0 };
  const all = {};
  for (const field of type.fieldsArray) {
    field.resolve();
    const value = message[field.name];
    const inner = field.resolvedType?.fieldsArray ? (one) => inJsonForm(field.resolvedType, one) : (one) => one;
    // the name as the schema has it
    const name = field.name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
    if (field.repeated) all[name] = (value ?? []).map(inner);
    else if (value !== undefined) all[name] = inner(value);
    else if (!field.hasPresence) all[name] = field.typeDefault;
  }
  return all;
}

/** All records in the order of the file, every CRC checked. */
export const records = once((path) => {
  const reader = new McapStreamReader({ includeChunks: true, validateCrcs: true, decompressHandlers });
  reader.append(readFileSync(path));
  const all = [];
  for (let record; (record = reader.nextRecord()); ) all.push(record);
  if (!reader.done() || reader.bytesRemaining() !== 0) throw new Error(`${path}: the log does not end where it should`);
  return all;
});

/** The log by its index, as a viewer reads it: `{ reader, topics, attachments, metadata }`; a topic is a list of `{ ns, content }`. */
export const log = once(async (path) => {
  const bytes = readFileSync(path);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const topics = new Map([...reader.channelsById.values()].map((channel) => [channel.topic, []]));
  const decoders = new Map([...reader.schemasById.values()].map((schema) => [schema.id, decoder(schema)]));
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const { topic, schemaId } = reader.channelsById.get(message.channelId);
    topics.get(topic).push({ ns: Number(message.logTime), content: decoders.get(schemaId)(message.data) });
  }
  const attachments = new Map();
  for await (const attachment of reader.readAttachments({ validateCrcs: true })) attachments.set(attachment.name, attachment);
  const metadata = new Map();
  for await (const record of reader.readMetadata()) metadata.set(record.name, record.metadata);
  return { reader, topics, attachments, metadata };
});

// a pose is { p: [x, y, z], q: [w, x, y, z] }

/** `q` as a turn of `v`. */
function turned([w, x, y, z], [a, b, c]) {
  const [tx, ty, tz] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/** `a_from_b` and `b_from_c` to `a_from_c`. */
export function composed(a, b) {
  const [w, x, y, z] = a.q;
  const [r, i, j, k] = b.q;
  const q = [w * r - x * i - y * j - z * k, w * i + x * r + y * k - z * j, w * j - x * k + y * r + z * i, w * k + x * j - y * i + z * r];
  return { p: turned(a.q, b.p).map((value, axis) => value + a.p[axis]), q };
}

/** `a_from_b` to `b_from_a`. */
export function inverse({ p, q: [w, x, y, z] }) {
  const q = [w, -x, -y, -z];
  return { p: turned(q, p).map((value) => -value), q };
}

/** A pose of a message. */
export function poseOf(translation, { w, x, y, z }) {
  return { p: [translation.x, translation.y, translation.z], q: [w, x, y, z] };
}

/** The pose in `world` of every frame of a /tf message. Throws where the frames are no tree under the world. */
export function framesInWorld({ transforms }) {
  const branches = new Map();
  for (const branch of transforms) {
    if (branches.has(branch.child_frame_id)) throw new Error(`frame ${branch.child_frame_id} hangs twice`);
    branches.set(branch.child_frame_id, branch);
  }
  const found = new Map([["world", { p: [0, 0, 0], q: [1, 0, 0, 0] }]]);
  const find = (name, depth) => {
    if (found.has(name)) return found.get(name);
    const branch = branches.get(name);
    if (!branch || depth > branches.size) throw new Error(`frame ${name} does not hang on the world`);
    const pose = composed(find(branch.parent_frame_id, depth + 1), poseOf(branch.translation, branch.rotation));
    found.set(name, pose);
    return pose;
  };
  for (const name of branches.keys()) find(name, 0);
  return found;
}

/** How far apart two points are [m]. */
export const distance = (a, b) => Math.hypot(...a.map((value, axis) => value - b[axis]));
