// The reader's own files: measured flights behind the curve, a wing's motion in the plots, species files and polars.

import { Faults, isPolar, tableOf, tooLarge } from "./csv.js";
import { SPEED } from "./numbers.js";
import { flightsOf, kindOf, motionOf } from "./own_tables.js";
import { make } from "./shared.js";

const HELP =
  "A CSV file of measured flights has the columns speed [m/s] and mechanical power [W] or frequency [Hz], and may " +
  "have error and label. A CSV file of a wingbeat has phase or time [s], and columns such as flap_deg or pitch_deg. With time, the " +
  "rows are one beat from the first to the last, unless a line “# frequency [Hz] = 8.2” says how long a beat is. " +
  "A polar has alpha, CL and CD; those of XFOIL, XFLR5, AeroDyn and others are read as they are.";
const UNKNOWN =
  "The first line must name the columns: speed with power or frequency, for measured flights; phase or time with " +
  "flap_deg and others, for a wingbeat; or alpha, CL and CD, for a polar.";
const PRIVATE =
  "Drop a file anywhere on this page, or choose one. A CSV file of flights or a wingbeat stays in your browser: nothing of it " +
  "is uploaded.";
const POLAR = /\.(dat|pol|plr|polar|drg|lft)$/i; // and .csv, .tsv and .txt by their content

// A name as one word of a command.
const word = (name) => (/\s/.test(name) ? `"${name}"` : name);

export class OwnData {
  // `face`: the explorer whose curve and plots show the data.
  constructor(face) {
    this.face = face;
    this.shown = []; // {title, kind, points or curves}
    const about = { type: "file", multiple: true, accept: ".csv,.txt,.tsv,.toml,.dat,.pol,.plr,.polar,.drg,.lft" };
    this.input = make("input", { ...about, onchange: () => this.chosen() });
    const choose = make("label", { class: "wbx-file" }, make("span", {}, "Choose a file"), this.input);
    this.list = make("ul", { class: "wbx-own-list" });
    this.state = make("div", { class: "wbx-own-state", role: "status" });
    this.element = make(
      "section",
      { class: "wbx-own-data" },
      make("h2", {}, "Your own data"),
      make("p", {}, PRIVATE),
      choose,
      this.list,
      this.state,
      make("details", { class: "wbx-more" }, make("summary", {}, "What the file must hold"), make("p", {}, HELP)),
    );
    this.listen();
  }

  // Files may be dropped anywhere on the page, for a browser would else open them in its place.
  listen() {
    const stop = new AbortController();
    const holdsFiles = (event) => event.dataTransfer?.types.includes("Files");
    const { signal } = stop;
    const on = (name, act) => document.addEventListener(name, (event) => holdsFiles(event) && act(event), { signal });
    const mark = (state) => this.face.root.classList.toggle("wbx-dropping", state);
    on("dragover", (event) => {
      event.preventDefault();
      mark(true);
    });
    on("dragleave", (event) => event.relatedTarget === null && mark(false));
    on("drop", (event) => {
      event.preventDefault();
      mark(false);
      this.take([...event.dataTransfer.files]);
    });
    this.destroy = () => stop.abort();
  }

  chosen() {
    this.take([...this.input.files]);
    this.input.value = "";
  }

  async take(files) {
    this.state.replaceChildren();
    this.sent = {};
    for (const file of files) await this.read(file);
  }

  async read(file) {
    if (!/\.(csv|tsv|txt)$/i.test(file.name)) return this.other(file);
    const faults = new Faults();
    const large = tooLarge(file);
    const text = large ? "" : await file.text();
    if (isPolar(text)) return this.other(file, true);
    if (large) faults.add(large);
    else this.interpret(file.name, text, faults);
    if (faults.texts.length) this.refuse(file.name, faults.told);
  }

  interpret(title, text, faults) {
    const table = tableOf(text, faults);
    if (!table) return;
    const { kind, clock, columns } = kindOf(table.header);
    if (kind === "flights") {
      const left = columns.metabolic && `; not drawn, because the curve shows mechanical power: ${columns.metabolic.text}`;
      this.add({ title, kind, points: flightsOf(table, columns, faults), left: left ?? "" }, faults);
    } else if (kind === "motion") this.add({ title, kind, curves: motionOf(table, clock, columns, faults) }, faults);
    else faults.add(UNKNOWN);
  }

  // Species files and polars have to be solved, which a page without a server cannot do.
  other(file, polar = POLAR.test(file.name)) {
    if (this.face.onfile) return this.send(file, polar ? "polar" : "species file");
    if (polar) return this.fly(file.name);
    if (!/\.toml$/i.test(file.name)) {
      return this.refuse(file.name, ["Its name must end in .csv, in .toml for a species file, or in .pol or .dat for a polar."]);
    }
    const command = `wingbeat explore --static my-explorer --animals ${word(file.name)}`;
    const words = `${file.name} is a species file. Its flights must be solved, which this page cannot do.`;
    this.say(make("p", {}, `${words} This command makes a page with them:`), make("code", {}, command));
  }

  // A flight has one polar and one animal: a second file would replace the first.
  send(file, kind) {
    const first = this.sent[kind];
    if (first) return this.refuse(file.name, [`${first} is read, and a flight has one ${kind}. Drop this one alone.`]);
    this.sent[kind] = file.name;
    return this.face.onfile(file);
  }

  fly(name) {
    const { species, speed } = this.face.answer ?? { species: "pigeon", speed: 10 };
    const words = `${name} is a polar. Flights with it must be solved, which this page cannot do.`;
    const command = `wingbeat orbit ${species} --speed ${speed} --aero ${word(name)}`;
    this.say(make("p", {}, `${words} This command flies it:`), make("code", {}, command));
  }

  refuse(title, texts) {
    this.say(make("p", {}, `${title} is not shown:`), make("ul", {}, ...texts.map((text) => make("li", {}, text))));
  }

  say(...parts) {
    this.state.append(...parts);
    this.state.scrollIntoView({ block: "nearest" }); // the file may have been dropped far above
  }

  // What is shown -----------------------------------------------------------------------------------------------------

  add(data, faults) {
    if (faults.texts.length) return;
    this.shown = [...this.shown.filter(({ title }) => title !== data.title), data];
    this.show();
    if (data.points) this.face.curve.element.scrollIntoView({ block: "nearest" });
  }

  remove(data) {
    this.shown = this.shown.filter((each) => each !== data);
    this.show();
    this.input.focus();
  }

  show() {
    const flights = this.shown.filter(({ kind }) => kind === "flights");
    this.face.curve.showOwn(flights);
    this.overlay();
    this.list.replaceChildren(...this.shown.map((data) => this.row(data, flights.indexOf(data))));
  }

  // Draw the curves of a wingbeat over the viewer's plots, where the plots have such series.
  overlay() {
    const { viewer } = this.face;
    const curves = this.shown.flatMap(({ title, curves = [] }) => curves.map((curve) => ({ ...curve, file: title })));
    this.drawn = viewer?.overlay(curves) ?? [];
  }

  row(data, nth) {
    const kind = nth < 0 ? "wbx-own-line" : `wbx-own-${nth % 3}`;
    const sign = make("span", { class: `wbx-own-key ${kind}`, "aria-hidden": "true" });
    const about = { type: "button", "aria-label": `Remove ${data.title}` };
    const button = make("button", { ...about, onclick: () => this.remove(data) }, "Remove");
    return make("li", {}, sign, make("span", {}, this.words(data)), button);
  }

  words({ title, points, curves, left: undrawn }) {
    const { viewer, blind } = this.face;
    const { axis } = this.face.curve;
    if (points && axis.name !== SPEED.name) return `${title}: not drawn, because this curve shows the ${axis.label}, not the speed`;
    if (points) return `${title}: ${points.length} ${points.length === 1 ? "point" : "points"} behind the curve${undrawn}`;
    if (!viewer) return `${title}: ${blind ? "not drawn, because the page has no picture" : "drawn with the first picture"}`;
    const [found, others] = [true, false].map((drawn) => {
      const those = curves.filter(({ name }) => this.drawn.includes(name) === drawn);
      return those.map((curve) => curve.title).join(", ");
    });
    const left = others && `; not drawn, because the plots have no such series: ${others}`;
    return found ? `${title}: ${found} as dashed lines in the plots${left}` : `${title}${left}`;
  }
}
