// Reads messages of ROS 2 by their .msg files, and compares them with what was written.
//   node decode.mjs CASES LANELOOM_MSGS
// A line of CASES is a message: type, bytes (hexadecimal), and the fields that it must have. LANELOOM_MSGS is the
// folder of the package. What was read is written again, and must give the same bytes.
//   node decode.mjs --odometry | --objects
// writes an odometry, or tracked objects, to standard output, as hexadecimal bytes.
import { parse } from "@foxglove/rosmsg";
import common from "@foxglove/rosmsg-msgs-common";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";

// A message's definition and those that it is made of, from the distribution's.
function standard(distribution, type) {
  const found = new Map();
  const add = (name) => {
    if (found.has(name)) return;
    const definition = distribution[name];
    assert.ok(definition, name);
    found.set(name, definition);
    for (const field of definition.definitions) if (field.isComplex) add(field.type);
  };
  add(type);
  return [...found.values()].map((definition) => (definition.name === type ? { ...definition, name: undefined } : definition));
}

function concatenated(root, others) {
  const rest = Object.entries(others).map(([name, text]) => `\n${"=".repeat(80)}\nMSG: ${name}\n${text}`);
  return parse([root, ...rest].join(""), { ros2: true });
}

function packaged(folder, type) {
  const texts = Object.fromEntries(
    readdirSync(`${folder}/msg`).map((file) => [
      `laneloom_msgs/${file.replace(".msg", "")}`,
      readFileSync(`${folder}/msg/${file}`, "utf8"),
    ]),
  );
  const { [type]: root, ...others } = texts;
  return concatenated(root, others);
}

function roadSegments() {
  const prefix = "autoware_mapless_planning_msgs";
  return concatenated("std_msgs/Header header\nSegment[] segments\ngeometry_msgs/Pose pose\n", {
    [`${prefix}/Segment`]:
      "uint16 id\nLinestring[2] linestrings\nint32[] successor_segment_id\nint32[] neighboring_segment_id\n",
    [`${prefix}/Linestring`]: "geometry_msgs/Pose[] poses\n",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "geometry_msgs/Pose": "Point position\nQuaternion orientation\n",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
  });
}

function trackedObjects() {
  const prefix = "autoware_perception_msgs";
  const six = (name) => `${name} ${name.toLowerCase()}\nfloat64[36] covariance\n`;
  const vectors = "Vector3 linear\nVector3 angular\n";
  return concatenated("std_msgs/Header header\nTrackedObject[] objects\n", {
    [`${prefix}/TrackedObject`]:
      "unique_identifier_msgs/UUID object_id\nfloat32 existence_probability\nObjectClassification[] classification\n" +
      "TrackedObjectKinematics kinematics\nShape shape\n",
    [`${prefix}/ObjectClassification`]: "uint8 label\nfloat32 probability\n",
    [`${prefix}/TrackedObjectKinematics`]:
      "geometry_msgs/PoseWithCovariance pose_with_covariance\ngeometry_msgs/TwistWithCovariance twist_with_covariance\n" +
      "geometry_msgs/AccelWithCovariance acceleration_with_covariance\nuint8 orientation_availability\nbool is_stationary\n",
    [`${prefix}/Shape`]: "uint8 type\ngeometry_msgs/Polygon footprint\ngeometry_msgs/Vector3 dimensions\n",
    "unique_identifier_msgs/UUID": "uint8[16] uuid\n",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "geometry_msgs/PoseWithCovariance": six("Pose"),
    "geometry_msgs/TwistWithCovariance": six("Twist"),
    "geometry_msgs/AccelWithCovariance": six("Accel"),
    "geometry_msgs/Pose": "Point position\nQuaternion orientation\n",
    "geometry_msgs/Twist": vectors,
    "geometry_msgs/Accel": vectors,
    "geometry_msgs/Polygon": "Point32[] points\n",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/Point32": "float32 x\nfloat32 y\nfloat32 z\n",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
  });
}

function definitions(distribution, folder, type) {
  if (type.startsWith("laneloom_msgs/")) return packaged(folder, type);
  if (type.startsWith("autoware_")) return roadSegments();
  return standard(distribution, type);
}

/// The value as JSON has it: numbers of 64 bits as text, typed arrays as lists.
function plain(value) {
  if (typeof value === "bigint") return value.toString();
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (value !== null && typeof value === "object")
    return Object.fromEntries(Object.entries(value).map(([key, field]) => [key, plain(field)]));
  return value;
}

/// Every field that `wanted` has; lists are compared as a whole.
function compare(read, wanted, path) {
  if (wanted === null || typeof wanted !== "object") return assert.deepEqual(read, wanted, `${path}: ${read}, not ${wanted}`);
  if (Array.isArray(wanted)) assert.equal(read.length, wanted.length, path);
  for (const [key, field] of Object.entries(wanted)) compare(read[key], field, `${path}.${key}`);
}

function check(distribution, folder, { type, bytes, wanted }) {
  const written = Buffer.from(bytes, "hex");
  const described = definitions(distribution, folder, type);
  const read = new MessageReader(described).readMessage(written);
  compare(plain(read), wanted, type);
  assert.equal(Buffer.from(new MessageWriter(described).writeMessage(read)).toString("hex"), bytes, type);
}

function odometry() {
  const message = {
    header: { stamp: { sec: 1700000000, nsec: 250000000 }, frame_id: "map" },
    child_frame_id: "base_link",
    pose: {
      pose: { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
      covariance: new Float64Array(36).fill(0.5),
    },
    twist: {
      twist: { linear: { x: 4, y: 5, z: 6 }, angular: { x: 7, y: 8, z: 9 } },
      covariance: new Float64Array(36).fill(0.25),
    },
  };
  return new MessageWriter(standard(common.ros2humble, "nav_msgs/Odometry")).writeMessage(message);
}

function objects() {
  const zero = { x: 0, y: 0, z: 0 };
  const object = (last, label) => ({
    object_id: { uuid: new Uint8Array(16).fill(3, 0, last) },
    existence_probability: 0.5,
    classification: [
      { label: 1, probability: 0.25 },
      { label, probability: 0.75 },
    ],
    kinematics: {
      pose_with_covariance: {
        pose: { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
        covariance: new Float64Array(36).fill(0.25),
      },
      twist_with_covariance: { twist: { linear: { x: 4, y: 5, z: 6 }, angular: zero }, covariance: new Float64Array(36) },
      acceleration_with_covariance: { accel: { linear: zero, angular: zero }, covariance: new Float64Array(36).fill(0.125) },
      orientation_availability: 2,
      is_stationary: false,
    },
    shape: {
      type: 2,
      footprint: { points: [zero, { x: 5, y: 6, z: 7 }] },
      dimensions: { x: 12, y: 2.5, z: 3 },
    },
  });
  const header = { stamp: { sec: 1700000000, nsec: 250000000 }, frame_id: "map" };
  return new MessageWriter(trackedObjects()).writeMessage({ header, objects: [object(15, 2), object(16, 3)] });
}

const [cases, folder] = process.argv.slice(2);
if (cases === "--odometry") {
  process.stdout.write(Buffer.from(odometry()).toString("hex"));
} else if (cases === "--objects") {
  process.stdout.write(Buffer.from(objects()).toString("hex"));
} else {
  const lines = readFileSync(cases, "utf8").trim().split("\n").map((line) => JSON.parse(line));
  for (const distribution of [common.ros2humble, common.ros2jazzy])
    for (const line of lines) check(distribution, folder, line);
  console.log(`${lines.length} messages are as they were written`);
}
