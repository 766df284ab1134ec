// The guided tours. A step names the flight, the view and the part of the page to look at; `tell` writes two or three
// sentences from the answer on the page (`now`), those of earlier steps (`seen`), the points of its curve and the push
// that is shown. No number of a result is typed in.

import { hinges } from "./stories_of_hinges.js";
import { robot, tumbling } from "./stories_of_motion.js";
import { coefficients, hovering } from "./stories_of_power.js";

export const STORIES = [hovering, coefficients, robot, hinges, tumbling];

// Points that a step can ask for, chosen among the certified ones of a curve; `name` is that of the axis.
export const PLACES = {
  first: (points) => points[0],
  last: (points) => points.at(-1),
  cheapest,
  stable: (points) => cheapest(points.some(isStable) ? points.filter(isStable) : points),
  early: (points, name) => nearest(points, name, 0.75 * points[0][name] + 0.25 * cheapest(points)[name]),
};

const isStable = ({ stable }) => stable;

function cheapest(points) {
  return points.reduce((best, each) => (each.power < best.power ? each : best));
}

function nearest(points, name, wanted) {
  const away = (point) => Math.abs(point[name] - wanted);
  return points.reduce((best, each) => (away(each) < away(best) ? each : best));
}
