// The guided tours. A step names the flight, the view and the part of the page to look at; `tell` writes two or three
// sentences from the answer on the page (`now`), those of earlier steps (`seen`) and the push that is shown. No number
// of a result is typed in.

import { robot, tumbling } from "./stories_of_motion.js";
import { coefficients, hovering } from "./stories_of_power.js";

export const STORIES = [hovering, coefficients, robot, tumbling];

// Speeds that a step can ask for, chosen among the certified points of a curve.
export const SPEEDS = {
  slowest: (points) => points[0].speed,
  fastest: (points) => points.at(-1).speed,
  cheapest: (points) => cheapest(points).speed,
  slow: (points) => nearest(points, 0.75 * points[0].speed + 0.25 * cheapest(points).speed).speed,
};

function cheapest(points) {
  return points.reduce((best, each) => (each.power < best.power ? each : best));
}

function nearest(points, wanted) {
  return points.reduce((best, each) => (Math.abs(each.speed - wanted) < Math.abs(best.speed - wanted) ? each : best));
}
