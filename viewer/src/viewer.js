// The viewer: picture, controls and plots in step at one phase of the beat.

import { gradient } from "./colours.js";
import { addControls, fold, FORCES, RATES, TINTS } from "./controls.js";
import { make } from "./elements.js";
import { Flight } from "./flight.js";
import { Measures } from "./measures.js";
import { Plots } from "./plots.js";
import { Pushes } from "./pushes.js";
import { CAMERAS, Stage } from "./stage.js";
import plotStyles from "./plots.css";
import { Share } from "./share.js";
import shareStyles from "./share.css";
import { restore, stateOf } from "./state.js";
import styles from "./style.css";
import { round, short } from "./writing.js";

let made = 0;

export class Viewer {
  // With `compact` all but picture and player is folded; the page that holds the viewer sets its theme.
  constructor(element, scene, { theme = "system", playing = true, compact = false, share = {} } = {}) {
    this.id = `wb${++made}`;
    this.look = { strips: false, colour: "alpha", arrows: new Set(["force"]) };
    Object.assign(this.look, { trails: true, ground: true, wake: false, laps: 0 });
    this.calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.look.still = this.calm; // the ground does not pass where less motion is asked for
    this.rate = 0.1;
    // A pale copy in the same place compares two flights of one kind of animal; of two kinds one would hide the other.
    this.ghost = new Set(scene.flights.map(({ shape }) => shape.kind)).size < 2;
    this.phase = 0;
    this.frame = 0;
    this.root = make("section", { class: "wb-viewer", "aria-label": "Wingbeat viewer", tabindex: "0" });
    this.root.append(make("style", {}, styles + plotStyles + shareStyles));
    this.root.viewer = this;
    this.canvas = make("canvas", { class: "wb-canvas", role: "img" });
    this.share = new Share(this, share);
    this.build();
    if (compact) fold(this);
    element.append(this.root);
    this.root.addEventListener("keydown", (event) => this.key(event));
    this.setTheme(theme);
    this.media = window.matchMedia("(prefers-color-scheme: dark)");
    this.onTheme = () => this.tint();
    this.media.addEventListener("change", this.onTheme);
    this.replace(scene);
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(this.picture);
    if (playing && !this.calm) this.play();
  }

  build() {
    const { above, player, below } = addControls(this);
    this.heading = make("div", { class: "wb-heading" });
    this.legend = make("div", { class: "wb-scale" });
    this.measures = new Measures();
    this.warning = make("p", { class: "wb-warning" }); // what the page that holds the viewer warns of, in the picture
    this.picture = make("div", { class: "wb-picture" }, this.canvas, this.heading, this.warning);
    const legends = make("div", { class: "wb-legends" }, this.legend, this.measures.element);
    const frame = make("div", { class: "wb-frame" }, this.picture, legends);
    this.pushes = new Pushes(this.id, (scene, once) => this.demonstrate(scene, once));
    this.side = make("div", { class: "wb-side" });
    const stage = make("div", { class: "wb-stage" }, above, frame, player, below, this.pushes.element);
    this.root.append(stage, this.side);
  }

  key(event) {
    if (event.target.matches("select") || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = (event.shiftKey ? 0.05 : 0.01) * (event.key === "ArrowLeft" ? -1 : 1);
    const view = Object.keys(CAMERAS)[Number(event.key) - 1];
    if (event.key === " " && !event.target.matches("button, summary, input[type=checkbox]")) this.playing ? this.pause() : this.play();
    else if (event.key === "ArrowLeft" || event.key === "ArrowRight") this.step(step);
    else if (event.key === "Home" || event.key === "End") this.step(event.key === "Home" ? -this.phase : this.last - this.phase);
    else if (view) this.setCamera(view);
    else return;
    event.preventDefault();
  }

  // State ---------------------------------------------------------------------------------------------------------

  // Show another scene, and keep phase, camera and choices.
  replace(scene) {
    const ended = this.once && this.phase >= this.last; // the flight of a push stops by itself
    this.once = false;
    this.pushes.offer(scene);
    this.show(scene);
    if (ended && !this.calm) this.play();
  }

  // Show the flight of a push once from its start, or the scene before it.
  demonstrate(scene, once) {
    const { playing } = this;
    this.pause();
    this.once = once;
    this.show(scene);
    this.set(0);
    if (playing || (once && !this.calm)) this.play();
  }

  show(scene) {
    this.share.stop();
    this.flights = scene.flights.map((raw) => new Flight(raw));
    this.last = Math.min(...this.flights.map((flight) => flight.last));
    this.scrubber.max = this.last;
    if (this.stage) this.stage.setFlights(this.flights, this.ghost);
    else this.makeStage();
    this.pairing.hidden = this.flights.length < 2;
    this.wakeToggle.hidden = !this.flights.some((flight) => flight.wake);
    if (this.wakeToggle.hidden) this.look.wake = this.wakeToggle.querySelector("input").checked = false;
    Object.keys(FORCES).forEach((name, nth) => {
      this.forces[nth].hidden = !this.flights.some((flight) => name in flight.arrays);
    });
    this.look.laps = 0;
    this.look.tipForce = Measures.tipForce(this.flights);
    this.plot(scene);
    const lines = this.flights.map(({ label, summary }) => (summary.startsWith(label) ? summary : `${label}: ${summary}`));
    this.heading.replaceChildren(...(lines.length > 1 ? lines : [this.flights[0].summary]).map((line) => make("p", {}, line)));
    this.canvas.setAttribute("aria-label", `Animation of ${this.flights.map((flight) => flight.label).join(" and ")}`);
    const force = Math.max(...this.flights.map((flight) => flight.largest("force", 3)));
    this.look.scale = force > 0 ? (0.55 * this.stage.span) / force : 0;
    this.look.thickness = 0.009 * this.stage.span;
    this.scaleTint();
    this.measure();
    this.setCamera(this.stage.view);
    this.set(Math.min(this.phase, this.last));
  }

  plot(scene) {
    if (this.plots?.about === Plots.about(scene, this.flights)) {
      this.plots.renew(this.flights, this.last);
      return;
    }
    const before = JSON.stringify(scene.panels) === this.panels ? this.plots : undefined;
    this.panels = JSON.stringify(scene.panels);
    this.plots = new Plots(scene, this.flights, this.last, (phase) => {
      this.pause();
      this.set(phase);
    });
    this.plots.choose(before?.choices ?? []);
    if (before?.last === this.last) this.plots.zoom(before.range);
    this.plots.overlay(this.overlaid ?? []);
    this.side.replaceChildren(this.plots.element);
    this.unfold();
  }

  // Plots are drawn only where the reader has unfolded them.
  unfold() {
    if (this.folded && !this.folded.open) this.plots.sleep();
    else this.plots.wake();
  }

  // Draw curves of the reader's own into the plots, each with name, phase and values in SI units; returns the names of
  // those that the plots have.
  overlay(curves) {
    this.overlaid = curves;
    const names = this.plots.overlay(curves);
    this.plots.include(names);
    if (names.length && this.folded) this.folded.open = true;
    this.unfold();
    return names;
  }

  makeStage() {
    this.stage = new Stage(this.canvas, this.flights, this.ghost);
    this.stage.controls.addEventListener("start", () => (this.eye = undefined));
    this.stage.onDraw = () => this.measures.follow(this.stage, this.look, this.flights[0]);
    this.tint();
  }

  // Show the second flight as a ghost, or beside the first.
  arrange() {
    this.stage.setFlights(this.flights, this.ghost);
    this.set(this.phase);
  }

  scaleTint() {
    const { label, unit, scale, most } = TINTS[this.look.colour];
    const largest = Math.max(...this.flights.map((flight) => flight.largest(this.look.colour)), 1e-12);
    const range = round(Math.min(largest, most) * scale, [1, 1.5, 2, 3, 4, 5, 6, 8, 10]);
    this.look.range = range / scale;
    const scaleBar = [
      make("div", { class: "wb-gradient", style: `background:${gradient()}` }),
      make("div", { class: "wb-ends" }, ...[-range, 0, range].map((value) => make("span", {}, short(value)))),
      make("div", {}, `${label} [${unit}]`),
    ];
    const schematic = this.flights.some((flight) => flight.shape.schematic);
    this.legend.replaceChildren(
      ...(this.look.strips ? scaleBar : []),
      ...(schematic ? [make("div", {}, "shape of the animal: schematic")] : []),
    );
  }

  measure() {
    this.measures.show(this.look, this.flights[0], this.stage.ground.cell);
  }

  setCamera(name) {
    this.eye = undefined;
    this.stage.setCamera(name);
    for (const button of this.cameras) button.setAttribute("aria-pressed", String(button.textContent === name));
  }

  // Look from a place, in semi-spans from the point that the camera looks at, until the camera is moved.
  setEye(eye) {
    this.eye = eye;
    if (!eye) return;
    const { camera, controls, span } = this.stage;
    camera.position.set(...eye).multiplyScalar(span).add(controls.target);
    controls.update();
  }

  // Choose the rate at which a beat takes nearest to so many seconds.
  setBeat(seconds) {
    const away = ([rate]) => Math.abs(Math.log(seconds * rate * this.flights[0].frequency));
    const [rate] = RATES.reduce((best, each) => (away(each) < away(best) ? each : best));
    this.rate = rate;
    this.rates.querySelector("select").value = rate;
  }

  setTheme(theme) {
    this.root.dataset.theme = theme;
    if (this.stage) this.tint();
  }

  tint() {
    this.stage.tint(getComputedStyle(this.root).color);
  }

  resize() {
    const { clientWidth, clientHeight } = this.picture;
    if (clientWidth && clientHeight) this.stage.resize(clientWidth, clientHeight);
    this.setEye(this.eye); // a new shape of the picture puts the camera back
  }

  // Time ----------------------------------------------------------------------------------------------------------

  get playing() {
    return this.clock !== undefined;
  }

  // `passing`: beats from one picture to the next while it plays.
  set(phase, passing = 0) {
    this.look.passing = passing;
    this.phase = Math.min(Math.max(phase, 0), this.last);
    this.frame += 1;
    this.stage.show(this.phase, this.look);
    this.plots.show(this.phase);
    this.scrubber.value = this.phase;
    const place = this.flights[0].locate(this.phase);
    const time = 1000 * this.flights[0].number("time", place);
    this.readout.textContent = `phase ${this.phase.toFixed(3)}, ${time.toFixed(1)} ms`;
  }

  step(by) {
    this.pause();
    this.set(this.phase + by);
  }

  play() {
    if (this.playing) return;
    if (this.once && this.phase >= this.last) this.set(0);
    let before = performance.now();
    const tick = (now) => {
      const beats = (now - before) * 0.001 * this.rate * this.flights[0].frequency;
      before = now;
      const next = this.phase + Math.max(beats, 0);
      if (!this.once) this.look.laps += Math.floor(next / this.last);
      this.set(this.once ? next : next % this.last, beats);
      if (this.once && this.phase >= this.last) return this.pause();
      this.clock = requestAnimationFrame(tick);
    };
    this.clock = requestAnimationFrame(tick);
    this.tellPlaying("❚❚", "Pause (space)");
  }

  pause() {
    cancelAnimationFrame(this.clock);
    this.clock = undefined;
    if (this.look.passing) this.set(this.phase); // the ground is sharp again
    this.tellPlaying("▶", "Play (space)");
  }

  tellPlaying(sign, label) {
    this.playButton.textContent = sign;
    this.playButton.title = label;
    this.playButton.setAttribute("aria-label", label);
  }

  // What the reader sees and has chosen, as a text for the fragment of an address; `restore` shows it again.
  get state() {
    return stateOf(this);
  }

  restore(state) {
    restore(this, state);
  }

  // What is drawn of a flight's wing now, in the world of its data: corners [m] and normals of every strip, flat lists.
  drawn(flight = 0, side = "left") {
    return this.stage.animals[flight].drawn(side);
  }

  // Points of the left wing's skin [m], in the world of its data: given as [span fraction, metres ahead of the axis].
  skinPoints(points, flight = 0) {
    return this.stage.animals[flight].skinPoints(points);
  }

  corners(flight = 0, side = "left") {
    return this.drawn(flight, side).corners;
  }

  destroy() {
    this.share.stop();
    this.pause();
    this.watcher.disconnect();
    this.media.removeEventListener("change", this.onTheme);
    this.stage.dispose();
    this.root.remove();
  }
}
