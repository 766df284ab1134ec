// Curves along the phase of the beat: downstroke shaded, with a cursor that moves with the phase.

import { Axes, scaled } from "./axes.js";
import { draw } from "./elements.js";
import { ends, valueAt, valuesOf } from "./series.js";
import { capital } from "./writing.js";

export class Panel extends Axes {
  // `curves`: series of one unit; `range`: of the phases shown at first; `seek(phase)` and `zoom(range)`: what the reader
  // chooses here; `own()`: curves of the reader's own.
  constructor(curves, flights, last, range, { seek, zoom, own }) {
    super(`${capital(curves.map((curve) => curve.label).join(" and "))} along the beat`, ["", curves[0].unit]);
    [this.series, this.flights, this.whole] = [curves, flights, [0, last]];
    this.seek = seek;
    this.zoom = zoom;
    this.own = own;
    this.cursor = draw("line", { class: "wb-cursor", y1: 0, y2: 150 });
    this.dots = this.each((curve, nth, flight, which) =>
      draw("circle", { class: `wb-dot wb-dot-${nth} wb-at-${which}`, r: 3 }),
    );
    this.front.append(this.cursor, ...this.dots.flat());
    this.draw(range);
  }

  // A list a curve, with something for each flight.
  each(act) {
    return this.series.map((curve, nth) => this.flights.map((flight, which) => act(curve, nth, flight, which)));
  }

  draw(range) {
    const seen = this.flights.map((flight) => {
      const [from, to] = range.map((phase) => flight.locate(phase));
      return [from.low, to.high];
    });
    const inSight = this.each((curve, _, flight, which) =>
      valuesOf(flight, curve).subarray(seen[which][0], seen[which][1] + 1),
    );
    const own = this.owned();
    this.setEnds(range, ends([...inSight.flat(), ...own.map(({ values }) => values)]), ...this.flights[0].downstrokes);
    const lines = this.each((curve, nth, flight, which) =>
      draw("polyline", {
        class: `wb-curve wb-curve-${nth} wb-flight-${which}`,
        points: this.path(flight.phase, valuesOf(flight, curve), ...seen[which]),
      }),
    );
    const ownLines = own.map(({ phase, values, file }) =>
      draw("polyline", { class: "wb-curve wb-own", points: this.path(phase, values) }, draw("title", {}, file)),
    );
    this.curves.replaceChildren(...lines.flat(), ...ownLines);
  }

  // The reader's own curves of these series, in the units of this plot.
  owned() {
    return this.series.flatMap(({ name, scale }) =>
      this.own()
        .filter((one) => one.name === name)
        .map((one) => ({ ...one, values: one.values.map((value) => value * scale) })),
    );
  }

  zoomBy(factor, phase) {
    this.zoom(scaled(this.across, factor, phase, this.whole));
  }

  zoomTo(from, to) {
    this.zoom([Math.min(from, to), Math.max(from, to)]);
  }

  reset() {
    this.zoom(this.whole);
  }

  // Move to a phase; returns the values there, a list a curve with one value a flight.
  show(phase) {
    const at = this.x(phase);
    this.cursor.setAttribute("x1", at);
    this.cursor.setAttribute("x2", at);
    return this.each((curve, nth, flight, which) => {
      const value = valueAt(flight, curve, flight.locate(phase));
      const dot = this.dots[nth][which];
      dot.setAttribute("cx", at);
      dot.setAttribute("cy", this.y(value));
      return value;
    });
  }
}
