// Numbers as the explorer writes them, and the words for what is known of a point.

import { short } from "./shared.js";

// What a curve runs along if nothing else is said.
export const SPEED = { name: "speed", unit: "m/s", label: "speed" };

export function withUnit(value, unit, digits = 3) {
  return unit ? `${short(value, digits)} ${unit}` : short(value, digits);
}

// Where an answer flies, and what its hinge or other number along the curve is.
export function place({ speed, axis = SPEED, ...answer }) {
  const more = axis.name === SPEED.name ? "" : `, ${axis.label} ${withUnit(answer[axis.name], axis.unit)}`;
  return `at ${short(speed)} m/s${more}`;
}

// The two ends of a number that may be one value or a range.
export function ends(value) {
  return Array.isArray(value) ? value : [value, value];
}

// Plausible is true, false, or null if too little is known to say.
export const implausible = (point) => point.plausible === false;

export function judged(point) {
  if (!point.certified) return "no certified wingbeat";
  if (point.plausible === null) return "certified, plausibility not known";
  return `certified, ${point.plausible ? "plausible" : "not plausible"}`;
}
