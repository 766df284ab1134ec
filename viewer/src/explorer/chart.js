// What the power curve is drawn with: scales, ticks, lines between neighbours, marks, and measured ranges behind.

import { ends, implausible } from "./numbers.js";
import { draw } from "./shared.js";

export const MARGIN = { left: 46, right: 16, top: 14, bottom: 38 };

export function axes(scale, quantity) {
  const { axis, x, y, width, height, xTicks, yTicks } = scale;
  const bottom = height - MARGIN.bottom;
  const text = (at, to, anchor, words, kind = "wbx-tick") =>
    draw("text", { x: at, y: to, "text-anchor": anchor, class: kind }, words);
  return draw(
    "g",
    { "aria-hidden": "true" },
    ...yTicks.flatMap((value) => [
      draw("line", { class: "wbx-grid", x1: MARGIN.left, x2: width - MARGIN.right, y1: y(value), y2: y(value) }),
      text(MARGIN.left - 7, y(value) + 4, "end", String(value)),
    ]),
    ...xTicks.map((value) => text(x(value), bottom + 16, "middle", String(value))),
    draw("line", { class: "wbx-axis", x1: MARGIN.left, x2: width - MARGIN.right, y1: bottom, y2: bottom }),
    text(width - MARGIN.right, bottom + 31, "end", axis.unit === "1" ? axis.label : `${axis.label} [${axis.unit}]`),
    text(MARGIN.left + 2, MARGIN.top - 3, "start", `${quantity.label} [${quantity.unit}]`),
  );
}

// Lines between neighbours that are both certified; dashed where one of them is not plausible.
export function lines(points, { axis, x, y }, name) {
  const found = [];
  for (let nth = 1; nth < points.length; nth++) {
    const [before, after] = [points[nth - 1], points[nth]];
    if (!before.certified || !after.certified) continue;
    const kind = [before, after].some(implausible) ? "wbx-curve wbx-dashed" : "wbx-curve";
    const at = { x1: x(before[axis.name]), y1: y(before[name]), x2: x(after[axis.name]), y2: y(after[name]) };
    found.push(draw("line", { class: kind, ...at }));
  }
  return draw("g", {}, ...found);
}

export function dots(points, { axis, x, y, height }, name) {
  const found = points.map((point) => {
    const at = x(point[axis.name]);
    if (!point.certified) return cross(at, height - MARGIN.bottom - 9);
    return draw("circle", { class: implausible(point) ? "wbx-dot wbx-hollow" : "wbx-dot", cx: at, cy: y(point[name]), r: 4 });
  });
  return draw("g", {}, ...found);
}

// Values that are still to be computed.
export function rings(values, { x, height }) {
  const y = height - MARGIN.bottom;
  return draw("g", {}, ...values.map((value) => draw("circle", { class: "wbx-pending", cx: x(value), cy: y, r: 4 })));
}

function cross(x, y) {
  return draw("path", { class: "wbx-gap", d: `M${x - 4} ${y - 4}l8 8m0-8l-8 8` });
}

// One measured value or range, against speed. `tell` is called with its words while it is pointed at or focused, and with nothing after.
export function measured(one, { x, y, height, width }, name, tell) {
  const [slow, fast] = ends(one.speed).map(x);
  const [low, high] = one[name] === undefined ? [] : ends(one[name]).map(y);
  const words = `${one.label}. Source: ${one.source}`;
  const attributes = {
    class: `wbx-measured wbx-${one.basis ?? "measured"}`,
    tabindex: "0",
    role: "img",
    "aria-label": words,
    onpointerenter: () => tell(words),
    onpointerleave: () => tell(""),
    onfocus: () => tell(words),
    onblur: () => tell(""),
  };
  const top = high ?? MARGIN.top;
  const bottom = low ?? height - MARGIN.bottom;
  // Even one value is large enough to point at.
  const across = Math.max(fast - slow, 10);
  const tall = Math.max(bottom - top, 10);
  const left = Math.min((slow + fast - across) / 2, width - MARGIN.right - across);
  const body = { x: left, y: (top + bottom - tall) / 2, width: across, height: tall, rx: 3 };
  return draw("g", attributes, draw("rect", body));
}
