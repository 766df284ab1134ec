// The curve against speed, or another axis, which is the control of it: a point on it that one drags or moves with the
// keyboard.

import { axes, dots, lines, MARGIN, measured, rings } from "./chart.js";
import { ends, implausible, judged, SPEED, withUnit } from "./numbers.js";
import { ownMarks } from "./own_marks.js";
import { capital, draw, make, short, ticks } from "./shared.js";

const QUANTITIES = [
  { name: "power", label: "Power", unit: "W" },
  { name: "frequency", label: "Wingbeats", unit: "Hz" },
];
const KEYS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 3, PageDown: -3 };
const STEP = 0.5; // m/s, of a key, where the point may rest between computed speeds

export class Curve {
  // `act` is called with a value that the reader chooses on the axis. With `snap` only computed ones can be chosen.
  constructor(act, snap) {
    this.act = act;
    this.onslide = () => {}; // called with each value on the way of the point, and with none when it rests
    this.snap = snap;
    this.quantity = QUANTITIES[0];
    this.data = { points: [], measured: [], pending: [] };
    this.own = [];
    this.axis = SPEED;
    this.at = 0;
    this.svg = draw("svg", { class: "wbx-chart" });
    this.buttons = QUANTITIES.map((each) =>
      make("button", { type: "button", "aria-pressed": "false", onclick: () => this.choose(each) }, each.label),
    );
    const choice = make("div", { class: "wbx-pair", role: "group", "aria-label": "Curve shown" }, ...this.buttons);
    this.note = make("p", { class: "wbx-note" });
    this.title = make("h2");
    const head = make("div", { class: "wbx-row" }, this.title, choice);
    this.element = make("div", { class: "wbx-curve-box", "data-part": "curve" }, head, this.svg, this.note);
    this.buildHandle();
    this.svg.addEventListener("pointerdown", (event) => this.take(event));
    this.svg.addEventListener("pointermove", (event) => this.dragging && this.drag(event));
    for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, () => this.release());
    this.watcher = new ResizeObserver(() => this.draw());
    this.watcher.observe(this.svg);
    this.turn(SPEED);
    this.choose(QUANTITIES[0]);
  }

  // Let the point move along an axis: `name` is that of its value in points and answers, with unit and label.
  turn(axis) {
    this.axis = axis;
    const moves = axis.name === SPEED.name;
    this.title.textContent = moves ? "Drag the point to fly faster or slower" : `Drag the point to change the ${axis.label}`;
    this.handle.setAttribute("aria-label", capital(axis.label));
  }

  buildHandle() {
    this.guide = draw("line", { class: "wbx-guide" });
    this.knob = draw("circle", { class: "wbx-knob", r: 9 });
    this.tag = draw("text", { class: "wbx-tag", "text-anchor": "middle" });
    const about = { role: "slider", tabindex: "0", "aria-orientation": "horizontal" };
    this.handle = draw("g", { class: "wbx-handle", ...about }, this.guide, this.knob, this.tag);
    this.handle.addEventListener("keydown", (event) => this.key(event));
  }

  choose(quantity) {
    this.quantity = quantity;
    this.buttons.forEach((button, nth) => button.setAttribute("aria-pressed", String(QUANTITIES[nth] === quantity)));
    this.draw();
  }

  // `range` is what the point can reach where nothing is computed yet; `pending` are values that are being computed.
  show({ points, measured = [], range, pending = [] }, axis = SPEED) {
    this.turn(axis);
    const sorted = [...points].sort((one, other) => one[axis.name] - other[axis.name]);
    this.data = { points: sorted, measured, range, pending };
    this.draw();
  }

  // Show measured flights of the reader's own, each with title and points, behind the curve.
  showOwn(own) {
    this.own = own;
    this.draw();
  }

  // Place the point at the value of the answer on the page.
  mark(at) {
    if (this.dragging) return;
    this.at = at;
    this.place(at);
  }

  // Mark a certified answer for comparison; without one the mark goes.
  pin(point) {
    if (point === this.pinned) return;
    this.pinned = point;
    this.draw();
  }

  // Drawing -------------------------------------------------------------------------------------------------------

  draw() {
    const { clientWidth: width, clientHeight: height } = this.svg;
    if (!width || !height) return;
    const { name } = this.quantity;
    const { points } = this.data;
    // The speed of minimum power has no value; it belongs to the curve of power.
    const ofCurve = (one) => name === "power" && one.frequency === undefined;
    const shown = this.data.measured.filter((one) => one[name] !== undefined || ofCurve(one));
    this.scale = this.scales(width, height, shown);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const tell = (words) => (this.note.textContent = words || this.legend(shown));
    const focused = document.activeElement === this.handle;
    this.svg.replaceChildren(
      axes(this.scale, this.quantity),
      ...shown.map((one) => measured(one, this.scale, name, tell)),
      ...this.drawn.map((one, nth) => ownMarks(one, nth, this.scale, this.quantity, tell)),
      lines(points, this.scale, name),
      rings(this.data.pending, this.scale),
      dots(points, this.scale, name),
      ...this.drawPin(name),
      this.handle,
    );
    if (focused) this.handle.focus({ preventScroll: true });
    tell("");
    this.place(this.at);
  }

  // The reader's measured flights, which have speeds.
  get drawn() {
    return this.axis.name === SPEED.name ? this.own : [];
  }

  scales(width, height, measured) {
    const { points } = this.data;
    const { name } = this.quantity;
    const { axis } = this;
    const values = [...points.map((point) => point[axis.name]), ...(this.data.range ?? [])];
    const [first, last] = values.length ? [Math.min(...values), Math.max(...values)] : [0, 20];
    // Measured speeds are in the picture too, even where the point cannot go.
    const own = this.drawn.flatMap((each) => each.points);
    const ownSpeeds = own.map((point) => point.speed);
    const all = [first, last, ...measured.flatMap(({ speed }) => ends(speed)), ...ownSpeeds];
    const room = Math.max(0.04 * (last - first), 0.02 * Math.abs(last)) || 0.2;
    const least = Math.min(...all);
    const [low, high] = [least < 0 ? least - room : Math.max(least - room, 0), Math.max(...all) + room];
    const heights = points.filter((point) => point.certified).map((point) => point[name]);
    const tops = measured.filter((one) => one[name] !== undefined).map((one) => ends(one[name])[1]);
    const ownTops = own.filter((point) => point[name] !== undefined).map((point) => point[name]);
    const top = 1.12 * Math.max(...heights, ...tops, ...ownTops, 1e-9);
    const x = (at) => MARGIN.left + ((at - low) / (high - low)) * (width - MARGIN.left - MARGIN.right);
    const y = (value) => height - MARGIN.bottom - (value / top) * (height - MARGIN.bottom - MARGIN.top);
    const valueAt = (px) => low + ((px - MARGIN.left) / (width - MARGIN.left - MARGIN.right)) * (high - low);
    const xTicks = ticks(low, high, width < 500 ? 5 : 10);
    return { axis, x, y, width, height, valueAt, first, last, xTicks, yTicks: ticks(0, top, 4) };
  }

  drawPin(name) {
    if (this.pinned?.[this.axis.name] === undefined) return [];
    const { x, y } = this.scale;
    const [at, to] = [x(this.pinned[this.axis.name]), y(this.pinned[name])];
    return [draw("path", { class: "wbx-pin", d: `M${at} ${to - 8}l8 8l-8 8l-8 -8z` })];
  }

  legend(shown) {
    const { points } = this.data;
    const parts = [];
    if (points.some((point) => point.certified && implausible(point))) parts.push("dashed: not plausible");
    if (points.some((point) => !point.certified)) parts.push("cross: no certified wingbeat");
    if (this.data.pending.length) parts.push("rings on the axis: still to be computed");
    if (shown.length) parts.push("bars behind: real animals (point at one for its source)");
    return parts.join("; ");
  }

  // Put the point at a value, on the line if there is one.
  place(value) {
    if (!this.scale) return;
    const { x, y, height, first, last } = this.scale;
    const { name, unit } = this.quantity;
    const at = x(Math.min(Math.max(value, first), last));
    const level = this.heightAt(value, name);
    const base = height - MARGIN.bottom;
    const to = level === undefined ? base - 9 : y(level);
    for (const [key, number] of Object.entries({ x1: at, x2: at, y1: to, y2: base })) this.guide.setAttribute(key, number);
    this.knob.setAttribute("cx", at);
    this.knob.setAttribute("cy", to);
    this.tag.setAttribute("x", at);
    this.tag.setAttribute("y", to < MARGIN.top + 20 ? to + 26 : to - 16);
    const point = this.nearest(value);
    const exact = point && Math.abs(point[this.axis.name] - value) < 1e-9 ? point : undefined;
    this.tag.textContent = exact?.certified && !this.dragging ? `${short(exact[name])} ${unit}` : "";
    this.handle.setAttribute("aria-valuemin", first);
    this.handle.setAttribute("aria-valuemax", last);
    this.handle.setAttribute("aria-valuenow", value);
    const told = exact?.certified ? `${short(exact.power)} W, ${short(exact.frequency)} Hz, ` : "";
    this.handle.setAttribute("aria-valuetext", withUnit(value, this.axis.unit) + (exact ? `: ${told}${judged(exact)}` : ""));
  }

  // What the drawn line has at a value; only the place of the point, never a number on the page, follows from it.
  heightAt(value, name) {
    const { points } = this.data;
    const at = (point) => point[this.axis.name];
    const after = points.findIndex((point) => at(point) >= value - 1e-9);
    if (after < 0) return undefined;
    const [high, low] = [points[after], points[after - 1]];
    if (Math.abs(at(high) - value) < 1e-9) return high.certified ? high[name] : undefined;
    if (!low?.certified || !high.certified) return undefined;
    const share = (value - at(low)) / (at(high) - at(low));
    return low[name] + share * (high[name] - low[name]);
  }

  // Moving --------------------------------------------------------------------------------------------------------

  nearest(value) {
    const away = (point) => Math.abs(point[this.axis.name] - value);
    return this.data.points.reduce((best, point) => (best && away(best) <= away(point) ? best : point), undefined);
  }

  take(event) {
    if (event.button !== 0 || !this.scale) return;
    this.dragging = true;
    this.svg.setPointerCapture(event.pointerId);
    this.handle.focus({ preventScroll: true });
    this.drag(event);
  }

  drag(event) {
    const { first, last, valueAt } = this.scale;
    const across = event.clientX - this.svg.getBoundingClientRect().left;
    const value = Math.min(Math.max(valueAt(across), first), last);
    this.place(value);
    this.ask(this.snap ? this.nearest(value)?.[this.axis.name] : Math.round(10 * value) / 10);
    this.onslide(value);
  }

  release() {
    if (!this.dragging) return;
    this.dragging = false;
    this.place(this.at);
    this.onslide();
  }

  key(event) {
    const by = KEYS[event.key];
    const end = { Home: "first", End: "last" }[event.key];
    if ((!by && !end) || event.ctrlKey || event.metaKey || event.altKey || !this.scale) return;
    event.preventDefault();
    event.stopPropagation();
    if (end) this.ask(this.scale[end]);
    else if (this.snap) this.ask(this.beside(by));
    else this.ask(Math.min(Math.max(this.at + by * STEP, this.scale.first), this.scale.last));
    this.place(this.at);
  }

  // The computed value that lies so many places further.
  beside(by) {
    const { points } = this.data;
    const now = points.indexOf(this.nearest(this.at));
    return points[Math.min(Math.max(now + by, 0), points.length - 1)]?.[this.axis.name];
  }

  ask(value) {
    if (value === undefined || value === this.at) return;
    this.at = value;
    this.act(value);
  }

  destroy() {
    this.watcher.disconnect();
  }
}
