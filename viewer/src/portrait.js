// A phase portrait: one series against another through the beat, the downstroke with a thick line.

import { Axes, INNER, scaled } from "./axes.js";
import { draw } from "./elements.js";
import { ends, valueAt, valuesOf } from "./series.js";
import { capital } from "./writing.js";

const CLOSED = 1e-3; // of the range: closer than this, the last sample is the first of the next beat

export class Portrait extends Axes {
  constructor(across, along, flights, { seek }) {
    super(`${capital(along.label)} against ${across.label}`, [across.unit, along.unit]);
    [this.xs, this.ys] = [across, along].map((series) => flights.map((flight) => valuesOf(flight, series)));
    [this.series, this.flights] = [[across, along], flights];
    this.wholes = [ends(this.xs), ends(this.ys)];
    this.seekPhase = seek;
    this.dots = flights.map((_, which) => draw("circle", { class: `wb-dot wb-dot-0 wb-at-${which}`, r: 4 }));
    this.front.append(...this.dots);
    this.draw(...this.wholes);
  }

  draw(across, along) {
    this.setEnds(across, along);
    this.curves.replaceChildren(
      ...this.flights.flatMap((flight, which) => [
        ...flight.downstrokes.map((ends) => this.loop(which, "polyline", "wb-thick", ...this.samples(flight, ends))),
        this.loop(which, this.closed(which) ? "polygon" : "polyline", ""),
      ]),
      this.start(),
    );
  }

  samples(flight, phases) {
    return phases.map((phase) => {
      const { low, share } = flight.locate(phase);
      return low + Math.round(share);
    });
  }

  loop(which, tag, more, from, to) {
    const points = this.path(this.xs[which], this.ys[which], from, to);
    return draw(tag, { class: `wb-curve wb-curve-0 wb-flight-${which} ${more}`, points });
  }

  closed(which) {
    const last = this.flights[which].samples - 1;
    return [
      [this.xs[which], this.wholes[0]],
      [this.ys[which], this.wholes[1]],
    ].every(([values, [low, high]]) => Math.abs(values[last] - values[0]) < CLOSED * (high - low));
  }

  // A small ring at phase 0 of the first flight.
  start() {
    return draw("circle", { class: "wb-start", cx: this.x(this.xs[0][0]), cy: this.y(this.ys[0][0]), r: 3.5 });
  }

  // The sample of the first flight nearest to where the reader points, as the eye sees it.
  seek(x, y) {
    let [best, least] = [0, Infinity];
    const [wide, high] = [this.across, this.along].map(([low, top]) => top - low);
    for (let k = 0; k < this.flights[0].samples; k++) {
      const away =
        (((this.xs[0][k] - x) / wide) * INNER.width) ** 2 + (((this.ys[0][k] - y) / high) * INNER.height) ** 2;
      if (away < least) [best, least] = [k, away];
    }
    this.seekPhase(this.flights[0].phase[best]);
  }

  zoomBy(factor, x, y = this.values?.[1][0] ?? 0) {
    this.draw(scaled(this.across, factor, x, this.wholes[0]), scaled(this.along, factor, y, this.wholes[1]));
    this.show(this.phase);
  }

  zoomTo(from, to) {
    this.draw([Math.min(from, to), Math.max(from, to)], this.along);
    this.show(this.phase);
  }

  reset() {
    this.draw(...this.wholes);
    this.show(this.phase);
  }

  // Move to a phase; returns the values there, of x and of y, each with one value a flight.
  show(phase) {
    this.phase = phase;
    const at = this.flights.map((flight) => flight.locate(phase));
    this.values = this.series.map((series) =>
      this.flights.map((flight, which) => valueAt(flight, series, at[which])),
    );
    this.dots.forEach((dot, which) => {
      dot.setAttribute("cx", this.x(this.values[0][which]));
      dot.setAttribute("cy", this.y(this.values[1][which]));
    });
    return this.values;
  }
}
