// Sentences with numbers of answers in them. Every number that a tour says is made here, from an answer that was shown.

import { withUnit } from "./numbers.js";
import { make, short } from "./shared.js";

export const watts = (value) => `${short(value)} W`;
export const speed = (answer) => (answer.speed ? `at ${short(answer.speed)} m/s` : "in hover");
export const degrees = (value) => `${short(value)} deg`;
export const percent = (share) => `${short(100 * share, 2)} %`;

// A line of "More numbers", as it stands there.
export function listed(answer, label) {
  const row = answer.numbers.find(([name]) => name === label);
  return row && [row[1], row[2]].filter(Boolean).join(" ");
}

export const figure = (answer, label) => parseFloat(listed(answer, label));

// Where an answer lies on the axis of its curve.
export const along = (answer) => withUnit(answer[answer.axis.name], answer.axis.unit);

export function gauge(answer, name) {
  return answer.gauges.find((each) => each.name === name && each.value !== null);
}

// A sentence about an earlier step's answer, if there is one.
export const since = (before, tell) => (before ? [tell(before)] : []);

// How a number differs from one before, in words that are true whichever way it went.
export function moved(before, now, write = watts) {
  const [from, to] = [write(before), write(now)];
  if (from === to) return `stays at ${to}`;
  return `${now > before ? "rises" : "falls"} from ${from} to ${to}`;
}

// Of what is spent on the air, one part's share.
export function shareOf({ spent }, part) {
  const whole = Object.values(spent).reduce((sum, each) => sum + each, 0);
  return spent[part] / whole;
}

// Numbers with a unit stand out, as in the sentence on top of the page.
const NUMBERS = /(\d[\d.]*(?:e[+-]?\d+)? (?:m\/s|N m\/rad|W\/kg|W|Hz|%|deg|g|m|beats?)(?![\w/]))/;

// What stands between backticks is to be typed.
export function emphasised(text) {
  const inner = (words) => words.split(NUMBERS).map((part, nth) => (nth % 2 ? make("b", {}, part) : part));
  return text.split(/`([^`]*)`/).flatMap((part, nth) => (nth % 2 ? [make("code", {}, part)] : inner(part)));
}

const PARTS = {
  profile: "profile power, the drag of the wings",
  induced: "induced power itself",
  parasite: "the drag of body and tail",
  unsteady: "that of rotation and added mass",
};

// The largest part of what is spent on the air, with its power.
export function largest({ spent }) {
  const [name, value] = Object.entries(spent).reduce((most, each) => (each[1] > most[1] ? each : most));
  return `${PARTS[name]}, with ${watts(value)}`;
}

// Where a number lies in its plausible range.
export function judgement({ value, low, high, unit, inside }) {
  const write = (number) => [short(number), unit].filter(Boolean).join(" ");
  if (inside === null) return `${write(value)}; no plausible range is known`;
  if (inside) return `${write(value)}, inside the plausible range`;
  const bound = value > high ? `at most ${write(high)}` : `at least ${write(low)}`;
  return `${write(value)}; plausible is ${bound}`;
}

const FROM = { upward: "from below", downward: "from above", head: "from ahead", tail: "from behind" };

export function gust({ direction, size }) {
  return `a gust ${FROM[direction]} of up to ${short(size)} m/s`;
}

export const hertz = (value) => `${short(value)} Hz`;

export const metres = (value) => `${short(value)} m`;

export function amplitude(answer) {
  const found = gauge(answer, "flap_amplitude");
  return found ? [`The wings flap ${short(found.value)} ${found.unit} to either side of their mean.`] : [];
}

export function enough(have, need) {
  return have >= need ? "has enough for that" : `would lack ${watts(need - have)}`;
}

export function stability(answer) {
  const fate = listed(answer, "a small disturbance");
  if (fate === "decays") return ["A small disturbance decays."];
  return fate === "grows" ? ["But a small disturbance grows, as long as the wingbeat does not react."] : [];
}

// For which values of the axis a flight holds its course, in runs of neighbours.
export function stableAlong(points, { name, unit }) {
  const runs = [];
  points.forEach((point, nth) => {
    if (point.stable && points[nth - 1]?.stable) runs.at(-1).push(point[name]);
    else if (point.stable) runs.push([point[name]]);
  });
  if (!runs.length) return ["In none of the flights computed here does a small disturbance decay."];
  const words = runs.map(([first, ...rest]) =>
    rest.length ? `from ${short(first)} to ${withUnit(rest.at(-1), unit)}` : `at ${withUnit(first, unit)}`,
  );
  const growing = points.filter(({ stable }) => stable === false).length;
  const others = growing ? ` In the other ${growing} it grows, as long as the wingbeat does not react.` : "";
  return [`A small disturbance decays ${words.join(" and ")}.${others}`];
}

// The command that solves the flight of an answer whose axis is a number of the pitch hinge.
export function command({ axis, species, speed, ...answer }) {
  const damping = figure(answer, "damping of the pitch hinges");
  const settings = `${axis.name}=${answer[axis.name]} pitch_hinge.damping=${damping}`;
  return `wingbeat orbit ${species} --model ${answer.model} --speed ${speed} --set ${settings}`;
}
