// The reader's own measured flights behind the curve: a diamond a row, with its error as a line.

import { MARGIN } from "./chart.js";
import { withUnit } from "./numbers.js";
import { draw } from "./shared.js";

const MOST_WORDS = 400; // of more marks than these, none says its row

// `tell` is called with the words of the mark that is pointed at, and with nothing after.
export function ownMarks({ title, points }, nth, { x, y, height }, { name, unit }, tell) {
  const shown = points.filter((point) => point[name] !== undefined);
  const says = shown.length <= MOST_WORDS;
  const marks = shown.map((point) => {
    const [at, to] = [x(point.speed), y(point[name])];
    const error = point[`${name}Error`];
    const bottom = Math.min(y(point[name] - error), height - MARGIN.bottom);
    const bar = error ? [draw("path", { d: `M${at} ${y(point[name] + error)}V${bottom}` })] : [];
    const mark = draw("path", { class: "wbx-own-mark", d: `M${at} ${to - 5}l5 5l-5 5l-5 -5z` });
    if (!says) return draw("g", {}, ...bar, mark);
    const words = `${point.label || title}: ${withUnit(point[name], unit)} at ${withUnit(point.speed, "m/s")}.`;
    return draw("g", { onpointerenter: () => tell(words), onpointerleave: () => tell("") }, ...bar, mark);
  });
  const label = `${title}: ${shown.length} measured points of your own`;
  return draw("g", { class: `wbx-own wbx-own-${nth % 3}`, role: "img", "aria-label": label }, ...marks);
}
