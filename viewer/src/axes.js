// Two axes with ticks, and what a reader does with them: choose a place, drag a range, zoom by wheel or by key.

import { draw } from "./elements.js";
import { inUnit } from "./series.js";
import { short, ticks } from "./writing.js";

const [WIDTH, HEIGHT] = [320, 150];
const EDGE = { left: 46, right: 10, top: 16, bottom: 24 };
export const INNER = { width: WIDTH - EDGE.left - EDGE.right, height: HEIGHT - EDGE.top - EDGE.bottom };
const SHORTEST_DRAG = 6; // of the picture's units; a shorter one is a click
let made = 0;

export class Axes {
  // `units`: of x and of y. A subclass has `seek(x, y)`, `zoomBy(factor, x, y)`, `zoomTo(from, to)` and `reset()`.
  constructor(label, units) {
    this.units = units;
    const clip = `wb-clip-${++made}`;
    this.back = draw("g", {});
    this.curves = draw("g", { "clip-path": `url(#${clip})` });
    this.front = draw("g", { "clip-path": `url(#${clip})` });
    this.chosen = draw("rect", { class: "wb-range", y: EDGE.top, height: INNER.height, visibility: "hidden" });
    const frame = { x: EDGE.left, y: EDGE.top, width: INNER.width, height: INNER.height };
    const handle = draw("rect", {
      class: "wb-axis",
      x: EDGE.left,
      y: HEIGHT - EDGE.bottom,
      width: INNER.width,
      height: EDGE.bottom,
    });
    handle.append(draw("title", {}, "Drag to zoom"));
    this.svg = draw(
      "svg",
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": label },
      draw("defs", {}, draw("clipPath", { id: clip }, draw("rect", frame))),
      this.back,
      this.curves,
      this.front,
      this.chosen,
      handle,
    );
    this.listen();
  }

  x(value) {
    return EDGE.left + ((value - this.across[0]) / (this.across[1] - this.across[0])) * INNER.width;
  }

  y(value) {
    return EDGE.top + ((this.along[1] - value) / (this.along[1] - this.along[0])) * INNER.height;
  }

  // Set the ends of both axes, and draw grid, ticks and units.
  setEnds(across, along, ...shades) {
    [this.across, this.along] = [across, along];
    const [right, foot] = [WIDTH - EDGE.right, HEIGHT - EDGE.bottom];
    const rows = ticks(...along, 4).flatMap((value) => [
      this.line(value, { x1: EDGE.left, x2: right, y1: this.y(value), y2: this.y(value) }),
      draw(
        "text",
        { class: "wb-tick", x: EDGE.left - 5, y: this.y(value) + 3.5, "text-anchor": "end" },
        short(value),
      ),
    ]);
    const columns = ticks(...across, 5).flatMap((value) => [
      this.line(value, { x1: this.x(value), x2: this.x(value), y1: EDGE.top, y2: foot }),
      draw("text", { class: "wb-tick", x: this.x(value), y: foot + 13, "text-anchor": "middle" }, short(value)),
    ]);
    const units = [
      draw("text", { class: "wb-unit", x: EDGE.left - 5, y: 10, "text-anchor": "end" }, inUnit(this.units[1])),
      draw(
        "text",
        { class: "wb-unit", x: EDGE.left - 12, y: foot + 13, "text-anchor": "end" },
        inUnit(this.units[0]),
      ),
    ];
    this.back.replaceChildren(...shades.map((shade) => this.shade(shade)), ...rows, ...columns, ...units);
  }

  line(value, ends) {
    return draw("line", { class: value === 0 ? "wb-zero" : "wb-grid", ...ends });
  }

  shade([from, to]) {
    const [left, right] = [from, to].map((at) => Math.min(Math.max(this.x(at), EDGE.left), WIDTH - EDGE.right));
    return draw("rect", { class: "wb-downstroke", x: left, y: EDGE.top, width: right - left, height: INNER.height });
  }

  path(xs, ys, from = 0, to = xs.length - 1) {
    const points = [];
    for (let k = from; k <= to; k++) {
      if (Number.isFinite(ys[k])) points.push(`${this.x(xs[k]).toFixed(2)},${this.y(ys[k]).toFixed(2)}`);
    }
    return points.join(" ");
  }

  // Pointer ---------------------------------------------------------------------------------------------------------

  place(event) {
    const box = this.svg.getBoundingClientRect();
    const px = ((event.clientX - box.left) / box.width) * WIDTH;
    const py = ((event.clientY - box.top) / box.height) * HEIGHT;
    const [right, up] = [(px - EDGE.left) / INNER.width, 1 - (py - EDGE.top) / INNER.height].map((share) =>
      Math.min(Math.max(share, 0), 1),
    );
    const mix = ([low, high], share) => low + share * (high - low);
    return { px, x: mix(this.across, right), y: mix(this.along, up), onAxis: py > HEIGHT - EDGE.bottom };
  }

  listen() {
    let start;
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      start = this.place(event);
      if (!start.onAxis) this.seek(start.x, start.y);
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (!event.buttons || !start) return;
      const here = this.place(event);
      if (start.onAxis) this.showRange(start.x, here.x);
      else this.seek(here.x, here.y);
    });
    this.svg.addEventListener("pointerup", (event) => {
      const here = this.place(event);
      if (start?.onAxis && Math.abs(here.px - start.px) >= SHORTEST_DRAG) this.zoomTo(start.x, here.x);
      else if (start?.onAxis) this.seek(here.x, here.y);
      this.forget();
      start = undefined;
    });
    this.svg.addEventListener("pointercancel", () => {
      this.forget();
      start = undefined;
    });
    this.svg.addEventListener("dblclick", () => this.reset());
    this.svg.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  // Over a plot that the reader has not chosen, the wheel scrolls the page.
  wheel(event) {
    const here = this.place(event);
    if (!here.onAxis && !event.ctrlKey && !this.svg.parentElement.contains(document.activeElement)) return;
    event.preventDefault();
    this.zoomBy(Math.exp(0.0015 * Math.min(Math.max(event.deltaY, -300), 300)), here.x, here.y);
  }

  showRange(from, to) {
    const [left, right] = [Math.min(from, to), Math.max(from, to)].map((at) => this.x(at));
    this.chosen.setAttribute("x", left);
    this.chosen.setAttribute("width", right - left);
    this.chosen.setAttribute("visibility", "visible");
  }

  forget() {
    this.chosen.setAttribute("visibility", "hidden");
  }
}

// A range made shorter or longer about a place in it, within the ends that it can have.
export function scaled([from, to], factor, about, [least, most]) {
  const length = Math.min(Math.max((to - from) * factor, 1e-3 * (most - least)), most - least);
  const start = about - ((about - from) / (to - from)) * length;
  const first = Math.min(Math.max(start, least), most - length);
  return [first, first + length];
}
