// The picture between two computed flights of one animal: every array of the beat, blended sample by sample. It is a
// picture only; no number on the page follows from it.

import { withUnit } from "./numbers.js";
import { Flight, short } from "./shared.js";

// Wings that are farther apart than this, in semi-spans, beat in different ways, and nothing lies between them. From one
// default speed of pigeon and bat to the next they move by at most 0.40, and where the wingbeat jumps by 0.97 or more.
const APART = 0.5;

export class Between {
  // `answers`: of one animal and model, along an axis.
  constructor(answers, axis) {
    this.answers = answers;
    this.axis = axis;
    this.flights = new Map();
  }

  // The flight to draw at a value; undefined at a computed one, and where the flights at both sides do not suit.
  at(value) {
    const { name, unit } = this.axis;
    const after = this.answers.findIndex((answer) => answer[name] >= value);
    const [low, high] = [this.answers[after - 1], this.answers[after]];
    if (!low || !high || high[name] === value || !flies(low) || !flies(high)) return undefined;
    const [one, other] = [this.flight(low), this.flight(high)];
    if (!alike(one, other)) return undefined;
    const share = (value - low[name]) / (high[name] - low[name]);
    const summary = `Picture between the wingbeats at ${short(low[name])} and ${withUnit(high[name], unit)}`;
    return { ...blended(one, other, share), summary };
  }

  flight(answer) {
    if (!this.flights.has(answer)) this.flights.set(answer, new Flight(answer.scene.flights[0]));
    return this.flights.get(answer);
  }
}

const flies = ({ status, scene }) => status === "converged" && scene;

// Whether two flights have the same samples, and wings that are near one another at each of them.
function alike(one, other) {
  const [first, second] = [one.arrays.corners, other.arrays.corners];
  if (one.samples !== other.samples || first.length !== second.length) return false;
  const most = (APART * one.semi_span) ** 2;
  for (let i = 0; i < first.length; i += 3) {
    const square = [0, 1, 2].reduce((sum, k) => sum + (second[i + k] - first[i + k]) ** 2, 0);
    if (square > most) return false;
  }
  return true;
}

// What has no samples, such as the phases of the downstroke, is that of the nearer flight.
function blended(one, other, share) {
  const nearer = share < 0.5 ? one : other;
  const arrays = {};
  for (const name of Object.keys(nearer.arrays)) {
    const [from, to] = [one.arrays[name], other.arrays[name]];
    const both = from?.length === to?.length;
    arrays[name] = both ? from.map((value, i) => value + share * (to[i] - value)) : nearer.arrays[name];
  }
  return { ...nearer, arrays, frequency: one.frequency + share * (other.frequency - one.frequency) };
}
