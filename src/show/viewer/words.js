// Verdicts, rows and audits in plain words.
import { short, seconds } from "./dom.js";
import { spoken } from "./decode.js";

export const verdicts = {
  optimal: ["good", "Solved",
    "Every rule holds, and no small change of the motion costs less."],
  feasible: ["good", "Holds every rule",
    "Every rule holds. That no small change of the motion costs less was not shown."],
  optimal_at_nodes: ["bad", "Solved at the nodes only",
    "Every rule holds at the time nodes, and between them one is broken by more than ten times its " +
    "tolerance. No body moves like this between the nodes; finer grids or the settings below help."],
  feasible_at_nodes: ["bad", "Holds at the nodes only",
    "Every rule holds at the time nodes, and between them one is broken by more than ten times its " +
    "tolerance. No body moves like this between the nodes; finer grids or the settings below help."],
  infeasible: ["bad", "No solution",
    "This motion breaks at least one of the rules of the problem. It is shown because it comes " +
    "near; its numbers are no prediction."],
  not_converged: ["bad", "Not converged",
    "This motion breaks at least one of the rules of the problem, but nothing shows that the rules " +
    "contradict each other. It is no prediction."],
  numeric_failure: ["bad", "Numbers broke down",
    "A value was not finite, or no matrix could be factored. The motion is no prediction."],
  limit: ["bad", "Stopped by a limit",
    "Time, iterations or evaluations ran out before every rule held. The motion is no prediction."],
  interrupted: ["bad", "Interrupted",
    "The solve was stopped from outside. This is the best point until then, no prediction."],
};
export const verdictOf = (summary) => verdicts[summary.verdict] ??
  ["bad", spoken(summary.verdict ?? "no verdict", false), ""];

// the row that makes the verdict what it is, at the nodes or between them
export const worstOf = (summary) => summary.verdict?.endsWith("_at_nodes")
  ? summary.audit?.dense_violation : summary.audit?.violation;

const families = {
  ground_penetration: "a foot and the ground's height",
  foot_strike: "a foot and its foothold",
  contact: "a contact and its place",
  clearance: "the way of a foot in the air",
  zmp: "balance: the zero-moment point under the feet",
  normal_force: "the ground may push, not pull",
  friction: "friction: the ground's force along the ground",
  pressure: "the centre of pressure under the foot",
  free_moment: "the ground's twist on a foot",
  joint_limit: "the range of a joint",
  speed_limit: "the largest speed of a joint",
  torque_limit: "the largest torque of a joint",
  flight: "no force on a body in the air",
  collision: "parts of the body that keep apart",
  obstacle: "the body and an obstacle",
  reach: "a point that has to be at a place",
  mirrored: "the end is the beginning, mirrored",
  periodic: "the end is the beginning again",
  initial: "how the motion begins",
  final: "how the motion ends",
  tracking_tube: "the way that is prescribed",
  slip: "a loaded foot that stays where it is",
  ground_force: "the ground's force between the times of the table",
};
export const familyWords = (family) => families[family] ?? spoken(family, false);

// 0.0312 m as 3.12 cm, 0.02 rad as 1.1 degrees
export function amount(value, unit) {
  if (value === null || value === undefined) return "not finite";
  const size = Math.abs(value);
  if (unit === "rad" && size >= 1e-4) return `${short((value * 180) / Math.PI, 3)}°`;
  if (unit === "m" && size >= 1e-5 && size < 0.01) return `${short(value * 1000, 3)} mm`;
  if (unit === "m" && size >= 0.01 && size < 1) return `${short(value * 100, 3)} cm`;
  return `${short(value, 3)} ${unit ?? ""}`.trim();
}

const sides = {
  "forward lower": "too far back", "forward upper": "too far ahead", "left lower": "too far right",
  "left upper": "too far left", "up lower": "too low", "up upper": "too high",
};
const limited = { joint_limit: "its range", speed_limit: "its speeds", torque_limit: "its torques" };

// which side of a row is left: "lower" of a range is below it
function detailWords(v) {
  if (v.family === "reach" && sides[v.detail]) return sides[v.detail];
  const what = limited[v.family];
  if (what && v.detail === "lower") return `below ${what}`;
  if (what && v.detail === "upper") return `above ${what}`;
  return v.detail;
}

// what a row is about: "ball arc, left: ahead"
export const rowWords = (v) => [v.row ? spoken(v.row) : "", detailWords(v)].filter(Boolean).join(": ");

export function violationWords(v) {
  if (!v || !v.family) return null;
  return `${familyWords(v.family)} (${rowWords(v)}): off by ${amount(v.worst, v.unit)} at ${seconds(v.time)}`;
}

export const termWords = (name) => spoken(name, false);

// one line under the title: what kind of motion this is
export function taskWords(summary, scene) {
  const g = summary.gait;
  const parts = [];
  if (g) {
    parts.push(`${short(g.speed)} m/s`, `steps of ${short(g.step_length)} m in ${short(g.step_time)} s`);
    if (g.flight_time > 0) parts.push(`${short(g.flight_time * 1000)} ms of flight a step`);
  } else if (summary.center_of_mass && scene.feet.length
    && Math.abs(summary.center_of_mass.distance) > 0.3) {
    parts.push(`${short(summary.center_of_mass.distance)} m forward`);
  }
  parts.push(`${short(scene.duration)} s shown`);
  if (scene.mass) parts.push(`${short(scene.mass)} kg`);
  if (scene.stature) parts.push(`${short(scene.stature)} m tall`);
  return parts.map((part) => part.replace(/ /g, "\u00a0")).join("\u00a0· "); // breaks between them
}
