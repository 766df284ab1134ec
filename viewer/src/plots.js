// Time series beside the picture: one panel a quantity, downstroke shaded, with a cursor that moves with the phase.

import { round, written } from "./colours.js";
import { draw, make } from "./elements.js";

const [WIDTH, HEIGHT] = [320, 150];
const EDGE = { left: 46, right: 8, top: 24, bottom: 22 };
const INNER = { width: WIDTH - EDGE.left - EDGE.right, height: HEIGHT - EDGE.top - EDGE.bottom };

function ticks(low, high) {
  const step = round((high - low) / 4);
  const found = [];
  for (let at = Math.ceil(low / step - 1e-9) * step; at <= high + 1e-9 * step; at += step) found.push(at);
  return found.map((at) => (Math.abs(at) < 1e-9 * step ? 0 : at));
}

class Panel {
  constructor(panel, flights, last, seek) {
    const curves = flights.flatMap((flight, which) =>
      panel.curves.map((curve, nth) => ({ ...curve, which, nth, flight, values: flight.arrays[curve.array] })),
    );
    let [low, high] = [Infinity, -Infinity];
    for (const { values } of curves) {
      for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
    }
    if (low > 0 && low < 0.4 * high) low = 0;
    const margin = 0.06 * (high - low || Math.abs(high) || 1);
    [this.low, this.high, this.last] = [low - margin, high + margin, last];
    this.cursor = draw("line", { class: "wb-cursor", y1: EDGE.top, y2: HEIGHT - EDGE.bottom });
    this.svg = draw(
      "svg",
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": `${panel.title} along the beat` },
      draw("text", { class: "wb-title", x: EDGE.left, y: 14 }, `${panel.title} [${panel.unit}]`),
      ...this.shades(flights[0]),
      ...this.axes(),
      ...curves.map((curve) => this.curve(curve)),
      this.cursor,
      ...this.legend(panel.curves),
    );
    const at = (event) => {
      const box = this.svg.getBoundingClientRect();
      const share = (((event.clientX - box.left) / box.width) * WIDTH - EDGE.left) / INNER.width;
      seek(Math.min(Math.max(share, 0), 1) * last);
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      at(event);
    });
    this.svg.addEventListener("pointermove", (event) => event.buttons && at(event));
  }

  x(phase) {
    return EDGE.left + (phase / this.last) * INNER.width;
  }

  y(value) {
    return EDGE.top + ((this.high - value) / (this.high - this.low)) * INNER.height;
  }

  shades(flight) {
    return flight.downstrokes.map(([from, to]) =>
      draw("rect", {
        class: "wb-downstroke",
        x: this.x(from),
        y: EDGE.top,
        width: this.x(to) - this.x(from),
        height: INNER.height,
      }),
    );
  }

  axes() {
    const marks = ticks(this.low, this.high).flatMap((value) => [
      draw("line", {
        class: value === 0 ? "wb-zero" : "wb-grid",
        x1: EDGE.left,
        x2: WIDTH - EDGE.right,
        y1: this.y(value),
        y2: this.y(value),
      }),
      draw("text", { class: "wb-tick", x: EDGE.left - 5, y: this.y(value) + 3.5, "text-anchor": "end" }, written(value)),
    ]);
    const phases = ticks(0, this.last).map((value) =>
      draw("text", { class: "wb-tick", x: this.x(value), y: HEIGHT - 8, "text-anchor": "middle" }, written(value)),
    );
    return [...marks, ...phases];
  }

  curve({ flight, values, which, nth }) {
    const points = Array.from(values, (value, k) => `${this.x(flight.phase[k]).toFixed(1)},${this.y(value).toFixed(1)}`);
    return draw("polyline", { class: `wb-curve wb-curve-${nth} wb-flight-${which}`, points: points.join(" ") });
  }

  legend(curves) {
    if (curves.length < 2) return [];
    const text = draw("text", { class: "wb-legend", x: WIDTH - EDGE.right, y: 14, "text-anchor": "end" });
    curves.forEach((curve, nth) => {
      if (nth) text.append("  ");
      text.append(draw("tspan", { class: `wb-ink-${nth}` }, curve.label));
    });
    return [text];
  }

  show(phase) {
    this.cursor.setAttribute("x1", this.x(phase));
    this.cursor.setAttribute("x2", this.x(phase));
  }
}

export class Plots {
  constructor(panels, flights, last, seek) {
    this.panels = panels.map((panel) => new Panel(panel, flights, last, seek));
    this.element = make("div", { class: "wb-plots" }, ...this.panels.map((panel) => panel.svg));
    if (flights.length > 1) {
      this.element.append(
        make("p", { class: "wb-note" }, `solid: ${flights[0].label}; dashed: ${flights[1].label}`),
      );
    }
    this.element.append(make("p", { class: "wb-note" }, "Along the phase of the beat; the downstroke is shaded."));
  }

  show(phase) {
    for (const panel of this.panels) panel.show(phase);
  }
}
